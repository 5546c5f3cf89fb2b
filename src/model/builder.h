// SPDX-License-Identifier: GPL-3.0-or-later
// The builder holds a model while its deck is read: growing lists of drafts, which the statements
// (src/model/statement/) fill. At the end of the deck, model_build makes the model from the drafts.
#ifndef JOSTLE_BUILDER_H
#define JOSTLE_BUILDER_H

#include "core/arena.h"
#include "jostle/model.h"
#include "model/name_index.h"

enum { OUTPUT_EVERY_MAX = 1000000000 };  // largest number of steps from row to row

// A growing array in an arena.
struct list {
    void *item;
    int n, capacity;
};

struct selection;

enum damping_kind {
    DAMPING_RATIOS,        // Rayleigh: value[0] at mode[0], value[1] at mode[1]
    DAMPING_COEFFICIENTS,  // Rayleigh: alpha, beta
    DAMPING_MODAL,         // value[m] of mode m+1
    DAMPING_DASHPOT,       // value[i] of storey i
};

// One statement of damping. All statements of a building add up.
struct damping_draft {
    enum damping_kind kind;
    struct word word;  // for messages
    int n;
    const double *value;  // (n) see damping_kind
    int mode[2];          // of DAMPING_RATIOS
    // Rayleigh damping is on the initial stiffness of these storeys. NULL: of all but isolators.
    const struct selection *storeys;
    struct word tangent;  // that asks for the tangent stiffness instead; text NULL: none
};

struct building_draft {
    const char *name;
    struct word word;
    int n_floor;                        // 0: wrong in the deck, and reported
    double *mass, *stiffness, *height;  // (n_floor); stiffness of shear storeys; height NULL: none
    bool any_stiffness;                 // a shear storey has a stiffness, right or wrong
    bool any_height;                    // it has -height, right or wrong
    bool any_part;                      // a statement gives a part, right or wrong
    bool any_frame, any_wall;           // the same of a frame, of a wall
    struct word pdelta;                 // its building word in pdelta; text NULL: no P-delta
    double *load;                       // (n_floor) gravity loads there, for P-delta; NULL: none
    struct list parts;                  // of struct part, beside the shear storeys
    struct frame_draft *frame;          // model/frame_draft.h; NULL: it has none
    struct list walls;                  // of struct wall_draft
    struct base_draft *base;            // of all lines and walls; NULL: fixed
    struct list damping;                // of struct damping_draft
    int isolated;                       // storey of the isolators, from 1; 0: none
    struct storey *storey;              // (n_floor)
    struct word *storey_word;           // (n_floor) the word that gives the law; text NULL: elastic
    double *displacement, *velocity;    // (n_floor)
    struct word *initial;               // (n_floor) the word that gives them; text NULL: at rest
    const struct foundation *foundation;  // NULL: none
};

// The scaling of a record to a pseudo-spectral acceleration, which needs the periods of the
// buildings.
struct spectral_scaling {
    double acceleration;  // [L/T^2]; 0: the record is not scaled to one
    double period;        // [T]; 0: the first period of `building`
    double damping;       // ratio
    int building;
    struct word word;  // that requests it
};

struct ground_draft {
    struct signal signal;
    struct spectral_scaling scaling;
    bool bare;       // scaled to a -pga or -sa without a unit
    bool judged;     // the reader of records has warned about its size, and it has no -pga or -sa
    int n_building;  // 0: all
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
    bool overlap;  // an initial penetration is allowed
};

// A limit of drift at which a run ends.
struct collapse_draft {
    bool is_ratio;  // of the storey height
    double limit;   // [L] or ratio
    int n_selection;
    const struct selection *storeys;  // (n_selection); NULL: all
    struct word word;
};

struct struck_draft {
    struct struck_column column;
    double damping;  // ratio
    // By unit drifts of the storeys of its building (n_floor): the displacement of the point
    // against the floor below, and the moments at the lower and upper end of one column.
    const double *rest, *below, *above;
    double by_force[COLUMN_FORCE_COUNT];  // of one column, by a unit force on its point
    const struct storey_choice *choice;   // the law of one column; NULL: it is elastic
    const struct contact_law *law;        // of its spring, with the values of its rows
    const double *value, *constant;
    struct word word;  // for messages
};

struct builder {
    struct deck *deck;
    struct arena *arena;  // of the deck
    struct record_cache *records;
    struct list buildings, grounds, links, loads, columns;
    struct list column_storeys;  // of struct struck_storeys (model/struck_column.h)
    struct list collapses;       // of struct collapse_draft
    struct list isolators;       // of struct isolator_draft (model/isolator.h)
    struct name_index building_index;

    struct word integrator, newton, step, duration, output;  // text NULL: not given
    enum integrator method;                                  // of the integrator statement
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

// Functions without memory return NULL or false and do not report it: builder_finish checks the
// arena.

// Room for one more zeroed item of `size` bytes at the end of the list. Items may move.
void *builder_append(struct builder *b, struct list *list, size_t size);

// Expands the list of an option to `n` values. The list has one value for all, or n. Reports other
// lengths. `owner` names the n items ("floors of building A").
double *builder_spread(struct builder *b, const struct argument *a, int n, const char *owner);

// True if `least` to `most` plain words follow the command. Otherwise reports that words are
// missing or not expected, with `usage`.
bool builder_plain(struct builder *b, const struct statement *s, int least, int most,
                   const char *usage);

// The index of the variant of the statement that `w` names. -1 after a report of an unknown `what`.
int builder_variant(struct builder *b, const struct word *w, const char *what,
                    const struct statement_kind *kind);

// The index of the building with this name, which need not end with 0; -1: not found.
int builder_find_building(const struct builder *b, const char *name, size_t length);

// The index of the building that the whole word names; -1 after a report that there is none.
int builder_building(struct builder *b, const struct word *w);
struct building_draft *builder_draft(struct builder *b, int i);

// Adds a building with this new name; NULL: no memory.
struct building_draft *builder_add_building(struct builder *b, const char *name);

// The acceleration of gravity [L/T^2], for weights of masses.
double builder_gravity(struct builder *b);

// True if the building has storey heights. Otherwise reports at `w` that `what` ("a level") needs
// them, unless its statement gives some that are wrong.
bool builder_has_heights(struct builder *b, const struct building_draft *d, const struct word *w,
                         const char *what);

// Adds a part to the building. Its name is that of its kind, with a number from the second part on.
void builder_add_part(struct builder *b, struct building_draft *d, const struct part *part);

// A selection of floors, `BUILDING[:FLOORS]` or `wall`.
struct selection {
    int building;      // WALL, or index
    bool all;          // no floors were given
    bool named;        // floors were given by their numbers
    int lowest;        // lowest floor that is allowed: 1, or 0
    int n_floor;       // number of selected floors
    const int *floor;  // (n_floor) from 1, in the order written
};

// Parses `w`; false after a report. GROUND_ALLOWED: `w` may be a wall, or select floor 0.
enum wall_use { WALL_REFUSED, WALL_ALLOWED, GROUND_ALLOWED };
bool builder_select(struct builder *b, const struct word *w, enum wall_use walls,
                    struct selection *out);

// Parses the floors of building `i` in `w`, such as 2:7.
bool builder_floors(struct builder *b, const struct word *w, int i, struct selection *out);

// Marks a statement that may be given once; reports and returns false if `mark` is taken.
bool builder_once(struct builder *b, struct word *mark, const struct statement *s);

// Makes the const model from the drafts (src/model/finish.c).
int builder_finish(struct builder *b, struct model *m, struct error *e);

// The descriptors of statements. A statement is one file in src/model/statement/ with a const
// descriptor (jostle/model.h), and one line in statement_list.inc. Parsing, `jostle deck` and the
// deck reference come from the descriptor.
#define STATEMENT(descriptor) extern const struct statement_kind descriptor;
#include "model/statement_list.inc"
#undef STATEMENT

#endif
