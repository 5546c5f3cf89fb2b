// SPDX-License-Identifier: GPL-3.0-or-later
// A model while its deck is being read: growing lists of drafts, finished by model_build once the
// deck has ended. Statements (src/model/statement/) fill it.
#ifndef JOSTLE_BUILDER_H
#define JOSTLE_BUILDER_H

#include "core/arena.h"
#include "jostle/model.h"
#include "model/name_index.h"

enum { OUTPUT_EVERY_MAX = 1000000000 };  // steps from row to row

// A growing array in an arena.
struct list {
    void *item;
    int n, capacity;
};

enum damping_kind {
    DAMPING_RATIOS,        // Rayleigh: value[0] at mode[0], value[1] at mode[1]
    DAMPING_COEFFICIENTS,  // Rayleigh: alpha, beta
    DAMPING_MODAL,         // value[m] of mode m+1
    DAMPING_DASHPOT,       // value[i] of storey i
};

// One statement; those of a building add up.
struct damping_draft {
    enum damping_kind kind;
    struct word word;  // for messages
    int n;
    const double *value;  // (n) see damping_kind
    int mode[2];          // of DAMPING_RATIOS
};

struct building_draft {
    const char *name;
    struct word word;
    int n_floor;                        // 0: wrong in the deck, which is reported
    double *mass, *stiffness, *height;  // (n_floor); stiffness of shear storeys; height NULL: none
    bool any_stiffness;                 // some shear storey has been given one, right or wrong
    bool any_part;                      // a statement gives a part, right or wrong
    struct list parts;                  // of struct part, beside the shear storeys
    struct list damping;                // of struct damping_draft
    struct storey *storey;              // (n_floor)
    struct word *storey_word;  // (n_floor) where its law was given; text NULL: elastic by default
    double *displacement, *velocity;  // (n_floor)
    struct word *initial;             // (n_floor) where they were given; text NULL: at rest
};

// A record still to be scaled to a pseudo-spectral acceleration, once the buildings' periods are
// known.
struct spectral_scaling {
    double acceleration;  // [L/T^2]; 0: none is asked for
    double period;        // [T]; 0: the first one of `building`
    double damping;       // ratio
    int building;
    struct word word;  // that asks for it
};

struct ground_draft {
    struct signal signal;
    struct spectral_scaling scaling;
    bool bare;            // scaled to a -pga or -sa that has no unit
    bool judged;          // the reader has warned of its size, which no -pga or -sa replaces
    int n_building;       // 0: all
    const int *building;  // (n_building)
    struct word word;
};

struct load_draft {
    int building, floor;
    struct word word;
    struct signal signal;
};

struct link_draft {
    struct link link;
    struct word word;
    bool named;    // by the user
    bool floors;   // named by the user, on both sides
    bool overlap;  // an initial penetration is wanted
};

struct builder {
    struct deck *deck;
    struct arena *arena;  // of the deck
    struct shelf *records;
    struct list buildings, grounds, links, loads;
    struct name_index building_index;

    struct word integrator, newton, step, duration, output;  // text NULL: not given
    enum integrator method;                                  // that the integrator names
    bool adaptive;                                           // kind of step
    double beta, gamma, tolerance, dt, run_time;
    struct step_control control;  // shortest 0: not given
    int iterations;
    struct output out;
    double out_interval;             // 0: not given
    struct word of_runs;             // output -histories; text NULL: not given
    double longest;                  // end of the longest record or load history; 0: none
    bool any_building, any_history;  // the deck has such a statement, right or wrong
};

// What finds no memory gives NULL or false and is not reported: the arena knows, and builder_finish
// asks it.

// Room for one more zeroed item of `size` bytes at the end of the list. Items may move.
void *builder_append(struct builder *b, struct list *list, size_t size);

// Expands the list given for `row` to `n` values: one for all, or n. Reports other lengths. `owner`
// names what there are n of ("floors of building A").
double *builder_spread(struct builder *b, const struct argument *a, int n, const char *owner);

// True if `least` to `most` plain words follow the command; else reports what is missing or too
// much, and shows `usage`.
bool builder_plain(struct builder *b, const struct statement *s, int least, int most,
                   const char *usage);

// Which of the variants of its statement `w` names; -1 after having reported that it is none, as an
// unknown `what`.
int builder_variant(struct builder *b, const struct word *w, const char *what,
                    const struct statement_kind *kind);

// The building of this name, which need not end with 0; -1: there is none.
int builder_find_building(const struct builder *b, const char *name, size_t length);

// The building named by the whole word; -1 after having reported that there is none.
int builder_building(struct builder *b, const struct word *w);
struct building_draft *builder_draft(struct builder *b, int i);

// Room for a building of this new name.
struct building_draft *builder_add_building(struct builder *b, const char *name);

// Adds a part to the building, and gives it a name: that of its kind, with a number from the second
// one on.
void builder_add_part(struct builder *b, struct building_draft *d, const struct part *part);

// A selection of floors, `BUILDING[:FLOORS]` or `wall`.
struct selection {
    int building;      // WALL, or index
    bool all;          // no floors were given
    bool named;        // by the numbers of the floors
    int lowest;        // floor that may be named
    int n_floor;       // selected
    const int *floor;  // (n_floor) from 1, in the order written
};

// Parses `w`; reports and returns false if it is wrong. GROUND_ALLOWED: a wall, or floor 0.
enum wall_use { WALL_REFUSED, WALL_ALLOWED, GROUND_ALLOWED };
bool builder_select(struct builder *b, const struct word *w, enum wall_use walls,
                    struct selection *out);

// Marks a statement that may be given once; reports and returns false if `mark` is taken.
bool builder_once(struct builder *b, struct word *mark, const struct statement *s);

// Turns the drafts into a const model; src/model/finish.c.
int builder_finish(struct builder *b, struct model *m, struct error *e);

// The descriptors of statements. A statement is one file in src/model/statement/ with a const
// descriptor (jostle/model.h), and one line in statement_list.inc. Parsing, `jostle deck` and the
// deck reference come from the descriptor.
#define STATEMENT(descriptor) extern const struct statement_kind descriptor;
#include "model/statement_list.inc"
#undef STATEMENT

#endif
