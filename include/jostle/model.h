// SPDX-License-Identifier: GPL-3.0-or-later
// The model: everything an analysis needs that does not change while it runs. Built from a deck,
// const afterwards. All quantities are in the deck's units: [F] force, [L] length, [T] time,
// [M] = [F T^2/L].
#ifndef JOSTLE_MODEL_H
#define JOSTLE_MODEL_H

#include <stdbool.h>

#include "jostle/contact_law.h"
#include "jostle/deck.h"
#include "jostle/names.h"
#include "jostle/part.h"
#include "jostle/signal.h"
#include "jostle/storey_law.h"

JOSTLE_C_BEGIN

enum { FLOORS_MAX = 1000 };  // of one building
enum { WALL = -1 };          // in place of a building or degree of freedom

// A rigid slab below a building, on springs and dashpots against the ground.
struct foundation {
    double mass, inertia;                  // [M] [M L^2] of the slab
    double sway, rocking;                  // [F/L] [F L] stiffness
    double sway_dashpot, rocking_dashpot;  // [F T/L] [F L T]
};

// What a foundation does: it sways [L], it rocks (clockwise), and its springs hold it by a force
// [F] and a moment [F L], without its dashpots.
enum foundation_quantity {
    FOUNDATION_SWAY,
    FOUNDATION_ROCKING,
    FOUNDATION_FORCE,
    FOUNDATION_MOMENT,
    FOUNDATION_QUANTITIES
};

// A building: shear storeys, and parts that couple them. Floors are numbered from 1; array index 0
// is floor 1, storey i is below floor i.
struct tangent_damping;
struct building {
    const char *name;
    int n_dof;     // degrees of freedom: the floors, then sway and rocking of a foundation
    int n_floor;   // floors
    int first;     // index of floor 1 among all degrees of freedom
    int isolated;  // storey of the isolators, from 1; 0: none
    const struct building *fixed;         // the same without its foundation; NULL: it has none
    const struct foundation *foundation;  // NULL: none
    const double *mass;                   // [M] (n_dof)
    const double
        *stiffness;        // [F/L] (n_dof) initial, of the storey below each floor, all its parts
                           // together: its shear over its drift where no other storey drifts
    const double *spring;  // [F/L] (n_dof) the same of the shear storeys alone, and of P-delta,
                           // which takes P/h off: it may be negative beside parts
    const double *axial;   // [F] (n_dof) gravity load P that each storey carries, for P-delta;
                           // NULL: without P-delta. The next three have values only with it
    const double *pdelta;  // [F/L] (n_dof) P/h, which P-delta takes off the stiffness
    const double *theta;   // (n_dof) stability coefficient P drift / (V h) in the first mode
    double buckling;       // factor on all P at which the building buckles on initial stiffness
    const double *height;  // [L] (n_dof) storey heights; NULL: not given
    const double *omega;   // [1/T] (n_dof) circular frequencies of the building alone, ascending
    const double *shape;   // (n_dof, n_dof) row m: mode m+1, largest entry 1
    const double *damping_diagonal;  // [F T/L] (n_dof) of the damping matrix
    const double *damping_off;       // [F T/L] (n_dof) entry i couples floors i+1 and i+2; last 0
    const double *damping_full;      // (n_dof, n_dof) symmetric to the bit; NULL: the two above
    int n_part;                      // beside the shear storeys; with any that is not
                                     // PART_DIAGONAL, damping_full is there
    const struct part *part;         // (n_part)
    const double *part_stiffness;    // [F/L] (n_dof, n_dof) initial d shear / d drift of all
                                     // parts; NULL: there is none
    const double *part_dashpot;      // [F T/L] (n_dof, n_dof) initial d shear / d drift rate
    int n_force, force;              // forces that follow from its drifts (model/forces.h), and the
                                     // index of the first among those of all buildings
    const double *force_by_action;   // (building_n_action, n_force in whole lanes) transposed: by
                                     // unit drifts, unit departures of hinges from their lines, and
                                     // unit displacements of the struck points of its frame
    int n_hinge;                     // of its frame
    int n_struck;                    // struck points of its frame
    const int *struck;               // (n_struck) their degrees of freedom
    int departure, first_hinge;      // offset of these in the state's storey history, and the index
                                     // of the first among those of all buildings
    bool storeys_linear;             // every shear storey is elastic
    double damping_alpha;            // [1/T] Rayleigh's alpha, of the mass; 0: none
    const double *damping_storey;    // [F T/L] (n_dof) and beta times the initial stiffness of
                                     // each storey, unless it is left out
    struct tangent_damping *tangent;  // damping on the tangent stiffness; NULL: none
    const struct word *damping;       // the last statement of Rayleigh damping; NULL: none
    bool elastic;                     // every storey is, and every part is linear
    bool smooth;                      // the tangent of some storey or part changes all the time
    bool predictable;                 // it is of straight lines: its shears may be foretold by its
                                      // tangents
    int part_tangent;                 // of a predictable one with parts: offset of their tangents
                                      // among those that a run remembers
    int ground;                       // index into model.ground
};

// Do floor `i` (from 0) of n and the storey below it enter summaries? All do but those of
// isolators, unless there are no others.
static inline bool floor_is_summarised(int isolated, int n, int i) {
    return i + 1 != isolated || n == 1;
}

// All floors of all buildings as one chain, for loops over flat arrays whatever the number of
// buildings. The joint between the roof of one building and the first floor of the next is 0.
// Arrays are those of core/lanes.h.
struct chain {
    int n;                    // degrees of freedom, in whole lanes
    const double *mass;       // [M] (n)
    const double *stiffness;  // [F/L] (n) initial, of the shear storey below
    const double *joint;      // (n + 1) 1: floor i stands on floor i - 1; else 0
    const double *damping_below, *damping, *damping_above;  // [F T/L] (n) bands of C; 0 where full
    bool full_damping;  // some building has a full matrix C, as those whose parts couple storeys
    bool parts;         // some building has parts
};

// Constants of the damage index that a deck gives: [L] the ultimate drift; and beta.
enum { STOREY_DAMAGE_ULTIMATE, STOREY_DAMAGE_BETA, STOREY_DAMAGE_COUNT };

// The restoring law of one storey.
struct storey {
    const struct storey_law *law;
    const double *constant;  // (law->n_constant)
    double yield;            // [F] shear at yield; infinite: elastic
    double pdelta;           // [F/L] P/h of a storey with a history; elastic laws have it inside
    int history;             // offset of its values in the state's storey history
    const double *damage;    // (STOREY_DAMAGE_COUNT) of the damage index, NAN: as its law has it;
                             // NULL: all are so
};

// The end of a link that is not one floor: a sparse row b over the degrees of freedom of one
// building. The end moves by b u, and a force f on the end acts on the floors by b' f.
struct link_entry {
    int dof;
    double weight;
};
struct link_row {
    int n;                           // 0: the end is the floor link.dof, or a wall
    const struct link_entry *entry;  // (n)
};

// A unilateral contact or a bilateral connection between two ends, which are floors, levels between
// two floors, or a wall. Closing velocity and penetration are delta = x_left - x_right - gap. A
// link within one building has one row, on the left, for the difference of both ends; its right end
// counts as a wall.
struct link {
    const char *name;
    int building[2];         // left, right; WALL
    int floor[2];            // from 1; 0: the wall, or the ground of a link within a building; of a
                             // level, the floor above
    double level[2];         // [L] above the ground, of ends between two floors; NAN: others
    double weight[2];        // of that floor at such an end; the one below has the rest
    bool within;             // both ends are in building[0]
    int dof[2];              // left, right; WALL; of a row, its first entry
    struct link_row row[2];  // left, right
    int column[2];           // index into model.column of the column that the end strikes; -1: none
    double gap;              // [L]; 0 for bilateral links
    double mass;             // [M] effective mass m*
    bool bilateral;          // acts whatever the sign of delta
    const struct contact_law *law;
    const double *value;      // (contact_law_n_value) of the law's rows; NAN: not given
    const double *constant;   // (contact_law_n_constant)
    double restitution;       // coefficient asked for; NAN: none
    bool calibrated;          // the damping is the one that delivers it exactly
    int history;              // offset of its values in the state's link history
    bool moving_ground;       // the grounds of its ends move differently
    const struct word *word;  // that names it in its statement, for messages
};

// Forces in one of the columns that are struck together: shears are the force to the right
// on the upper end of a part, moments act on ends and are positive counterclockwise.
enum column_force {
    COLUMN_SHEAR_BELOW,   // [F] of the part below the struck point
    COLUMN_SHEAR_ABOVE,   // [F] of the part above it
    COLUMN_MOMENT_BELOW,  // [F L] at the floor below
    COLUMN_MOMENT_POINT,  // [F L] at the struck point, on the part below it
    COLUMN_MOMENT_ABOVE,  // [F L] at the floor above
    COLUMN_FORCE_COUNT
};

// A column that is struck between the floors of its storey. The struck point has a mass and one
// degree of freedom, which is a body of the model. A spring, one of the links, joins the body to
// the floors below and above, in which the column is clamped, or to all floors of its frame. The
// rotation of the point has no inertia. The spring may have a law. The storey keeps the stiffness
// of all its columns.
struct struck_column {
    const char *name;
    int building;      // index into model.building
    int floor;         // above the point, from 1
    double level;      // [L] of the point above the ground of its building
    double height;     // [L] of the storey
    double below;      // [L] from the floor below to the point
    double weight;     // of the floor above in the displacement of a point without force; the floor
                       // below has the rest
    double mass;       // [M] of the point
    double bending;    // [F L^2] E I of all columns that are struck together
    double stiffness;  // [F/L] of the point, the floors at rest
    double dashpot;    // [F T/L]
    double n;          // columns that are struck together
    double shear_strength, moment_strength;  // [F] [F L] of one of them; infinite: not given
    int line;   // of the frame, whose joints turn at its ends; 0: it is clamped in the floors
    int point;  // among those of the frame
    const double *rest;   // (n_dof of its building) the displacement of the point without a force
    int n_dof;            // degrees of freedom on which its forces depend
    const int *dof;       // (n_dof) the struck point, then those of its building
    const double *force;  // (COLUMN_FORCE_COUNT, n_dof) [F/L] or [F] for unit displacements
    bool yields;          // the spring has a law, and the forces also have
    double by_spring[COLUMN_FORCE_COUNT];  // 1 or [L] for its unit force; 0: elastic
};

// The ground acceleration under some buildings: the sum of the signals.
struct ground {
    int n_signal;
    const struct signal *signal;  // (n_signal) [L/T^2]
};

// A force on one degree of freedom.
struct load {
    int dof;
    struct signal signal;  // [F]
};

enum field {
    FIELD_DISPLACEMENT = 1,
    FIELD_VELOCITY = 2,
    FIELD_ACCELERATION = 4,
    FIELD_DRIFT = 8,
    FIELD_STOREY_SHEAR = 16,
    FIELD_FORCE = 32,
    FIELD_PENETRATION = 64,
    FIELD_ALL = 127,
    FIELD_MEMBERS = 128,  // forces of members, and shares of parts
};
extern const char *const field_names[];  // in the order of the bits; NULL-terminated

struct output {
    int every;         // steps between two rows of the histories
    unsigned fields;   // enum field
    bool single;       // histories as 32-bit floats
    int compress;      // level of deflate for histories, 1 to 9; 0: none
    const char *file;  // result file named by the deck; NULL: none
    bool of_runs;      // studies write the histories of each run
};

// An adaptive analysis that needs more steps than this is refused, or given up.
enum { ADAPTIVE_STEPS_MAX = 2000000 };

enum integrator { INTEGRATOR_NEWMARK, INTEGRATOR_DORMAND_PRINCE };

// How the steps of an adaptive analysis are chosen.
struct step_control {
    double tolerance;  // error of one step relative to the largest displacement and velocity
    double longest;    // [T] may be infinite
    double shortest;   // [T] a run that needs shorter steps ends with an error
};

struct model {
    struct deck *deck;  // owned: texts and units live there
    int n_building, n_dof, n_contact, n_link, n_ground, n_load, n_column;
    int n_body;                       // the buildings, then the struck points of the columns
    const struct building *building;  // (n_body) from left to right; a struck point is a free body
                                      // of one floor
    const struct struck_column *column;  // (n_column); its spring is link n_link - n_column + i
    const double *mass;                  // [M] (n_dof)
    struct chain chain;                  // the same floors
    const struct storey *storey;         // (n_dof) the storey below each floor
    bool elastic;                        // every building is
    bool storeys_differ;      // drifts or shears of some storeys are not those of the degrees of
                              // freedom (model/foundation.h)
    const double *collapse;   // [L] (n_dof) drift of the storey below each floor at which a run
                              // ends, collapsed; infinite: none. NULL: no storey has one
    const struct link *link;  // (n_link) contacts first (n_contact), then bilateral links
    const struct ground *ground;           // (n_ground)
    const struct load *load;               // (n_load)
    const double *displacement;            // [L] (n_dof) initial, relative to the ground
    const double *velocity;                // [L/T] (n_dof)
    int n_storey_history, n_link_history;  // of storeys and parts; of links
    int n_part_scratch;                    // the most that a part needs
    int n_part_tangent;                    // struct building.part_tangent of all buildings
    int n_force;  // that follow from the drifts of all buildings, each in whole lanes
    int n_hinge;  // of all buildings

    double beta, gamma;  // Newmark
    double tolerance;    // of the contact iteration, relative
    int iterations;      // of the contact iteration, before the step is rejected
    enum integrator integrator;
    bool adaptive;                // steps with error control
    struct step_control control;  // adaptive
    double dt;                    // [T] fixed step; adaptive: from row to row of output
    double duration;              // [T]
    long n_step;                  // of size dt; the last one may be shorter
    struct word step;             // the statement that says it, for messages
    struct output output;
};

// Reads the deck to its end and builds the model. Whatever is wrong is in deck->diagnostics; then
// STATUS_INPUT. The model owns the deck when the call succeeds, and only then.
int model_build(struct deck *deck, struct model **out, struct error *e);

// The same with records from a cache (motion/record_cache.h) that many builds share; NULL: none.
struct record_cache;
int model_build_shared(struct deck *deck, struct record_cache *records, struct model **out,
                       struct error *e);
void model_free(struct model *m);  // NULL is allowed

// Rows of the histories: t = 0, every output.every-th step, and the end.
long model_rows(const struct model *m);

// The damping forces C v of building `g`; v and force are (n_dof) [L/T] [F].
void building_damping_force(const struct building *g, const double *v, double *force);

// The actions that its forces follow from.
static inline int building_n_action(const struct building *g) {
    return g->n_dof + g->n_hinge + g->n_struck;
}

// The tangents of its storeys (n_dof), and with parts theirs by drifts and by rates: full matrices
// where the building has such, else their diagonals.
static inline int building_n_tangent(const struct building *g) {
    return g->n_dof + (g->n_part > 0 ? 2 * g->n_dof * (g->damping_full ? g->n_dof : 1) : 0);
}

// Damping ratio of a mode (from 1) of the building alone, phi^T C phi / (2 omega phi^T M phi); NAN
// for a rigid-body mode.
double building_damping_ratio(const struct building *g, int mode);

// No circular frequency of the model in which building `i` takes part is above this [1/T]: its own
// largest one and its bilateral links; contacts are left out.
double model_fastest(const struct model *m, int i);

// Time at the end of step `n` [T]: n dt, but the duration for the last.
double model_time(const struct model *m, long n);

// Those of n steps, the first of which is step number `first`.
void model_times(const struct model *m, long first, int n, double *time);

// The model at a step 2^level times shorter, with the rows of output at the same times. It borrows
// everything from `m` and is not given to model_free. Adaptive: at a tolerance so much
// tighter that steps are about 2^level times shorter, 32^level with Dormand & Prince's method and
// 8^level with Newmark's, 4^level where that damps.
struct model model_refined(const struct model *m, int level);

// The order in which errors of a smooth response go down with these steps: 2 by Newmark's method, 1
// where gamma > 1/2, 5 by Dormand & Prince's.
double model_order(const struct model *m);

// Options that a statement has only in one of its forms, as `ground record` has others than `ground
// sine`.
struct statement_variant {
    const char *name;     // the word that chooses the form; NULL: options that are always there
    const char *summary;  // half a sentence; NULL where there is no name
    const struct row *row;
    int n_row;
};

struct builder;

// A statement of the deck that builds the model, for parsing and help texts.
struct statement_kind {
    const char *name;
    const char *usage;      // without the name
    const char *summary;    // one line
    const char *example;    // a line of a deck
    const struct row *row;  // its own options; those of a law it names come on top
    int n_row;
    const struct statement_variant *variant;  // (n_variant) NULL: it has one form
    int n_variant;
    // Reads the statement into the builder; reports what is wrong in the deck's diagnostics.
    void (*build)(struct builder *b, const struct statement *s);
};
extern const struct statement_kind *const statement_kinds[];
extern const int n_statement_kind;

JOSTLE_C_END

#endif
