// SPDX-License-Identifier: GPL-3.0-or-later
// The result of one analysis: the HDF5 file written while it runs, the file read back, and the
// report, which holds everything but the histories and is the same from either side.
#ifndef JOSTLE_RESULT_H
#define JOSTLE_RESULT_H

#include <stdio.h>

#include "jostle/analysis.h"
#include "jostle/checksum.h"
#include "jostle/model.h"
#include "jostle/names.h"

JOSTLE_C_BEGIN

enum { RESULT_FORMAT_VERSION = 1 };

// A member of a frame or a wall: moments on its ends, counterclockwise positive; its shear; its
// normal force, tension positive, NAN of beams and walls, as floors are rigid.
enum member_force { MEMBER_M_I, MEMBER_M_J, MEMBER_V, MEMBER_N, MEMBER_FORCES };
// Members of a building with hinges have these besides, NAN where an end has no hinge: how far the
// end of the member turns more than the joint, and the plastic part of that.
enum member_rotation {
    MEMBER_ROTATION_I = MEMBER_FORCES,
    MEMBER_ROTATION_J,
    MEMBER_PLASTIC_I,
    MEMBER_PLASTIC_J,
    MEMBER_QUANTITIES
};
extern const char *const report_force_names[];  // (MEMBER_QUANTITIES)
struct member_extreme {
    double max, max_time, min, min_time;  // [F] or [F L]; [T]
};
struct report_member {
    const char *name;             // "column_2_3": storey 2, third line; "beam_1_2": floor 1, bay 2
    double moment, shear, axial;  // largest absolute values; moment: of both ends
    struct member_extreme extreme[MEMBER_QUANTITIES];
    double plastic;  // largest absolute plastic rotation of its hinges; 0: it has none
    // Of its hinges; 0: it has none. Their energies add up, of the others the largest counts.
    struct yield_demand demand;
};

// What resists in a building beside others: a part, or its shear storeys.
struct report_share {
    const char *name;
    const double *shear, *shear_time;  // [F] [T] (n_floor) largest absolute storey shears
};

// What the foundation of a building has done: largest absolute values and their times (enum
// foundation_quantity).
struct report_foundation {
    double size[FOUNDATION_QUANTITIES], time[FOUNDATION_QUANTITIES];
};
extern const char *const report_foundation_names[];  // (FOUNDATION_QUANTITIES)

// One building of a report. Arrays (n_floor) in the deck's units; floor 1 first.
struct report_building {
    const char *name;
    int n_floor;
    int isolated;                            // storey of the isolators, from 1; 0: none
    const double *mass;                      // [M]
    const double *stiffness;                 // [F/L]
    const double *height;                    // [L] 0 where not given
    const double *period;                    // [T] of the building alone, elastic, longest first
    const double *axial, *theta;             // [F] and 1, as in struct building; NULL: no P-delta
    const double *peak[PEAK_COUNT];          // largest absolute values; NULL before the run
    const double *peak_time[PEAK_COUNT];     // [T]
    const double *residual_drift;            // [L] of the storeys; NULL: none can yield
    const double *demand[YIELD_QUANTITIES];  // the same
    int n_member, n_share;                   // shares: 0 where one alone resists
    struct report_member *member;            // (n_member)
    struct report_share *share;              // (n_share)
    struct report_foundation *foundation;    // NULL: it has none
    bool extremes;                           // those of members are known, not only the sizes
    bool hinged;                             // its members have rotations besides
    const char *path, *parts;                // of its group in the file, and of its shares
};

// A contact or a bilateral link of a report.
struct report_link {
    const char *name, *left, *right;  // building names or "wall"
    const char *law, *constants;      // constants of the law as text, in the order the law has them
    int left_floor, right_floor;  // from 1; 0: the wall, or the ground; of a level, the floor above
    int left_below, right_below;  // the floor below a level, 0: the ground; else as above
    double left_level, left_weight;  // [L] struct link.level and weight; NAN: at a floor or a wall
    double right_level, right_weight;
    double gap;          // [L]
    double mass;         // [M] effective
    double restitution;  // coefficient asked for; NAN: none
    bool calibrated;     // the damping delivers it exactly
    struct link_peak peak;
    // Of the spring of a struck column: forces in one column, the largest shear and moment of any
    // sign, and the larger of both over its strength (NAN: none is given).
    struct column_peak column[COLUMN_FORCE_COUNT];
    double shear, moment, demand;
};

// How a run has collapsed (struct collapse).
struct report_collapse {
    long happened;         // 1; 0: it has not
    double time;           // [T] 0: it has not
    const char *building;  // "": it has not
    long storey;           // from 1; 0: it has not
    double drift;          // [L] with its sign; 0: it has not
};

// What a result file says apart from its histories.
struct report {
    struct arena *arena;  // owns everything below
    const char *file;     // the result file; NULL: none
    long run;             // number of the run in a study, from 1; 0: the file holds one run
    const char *title, *program, *version, *created;
    const char *deck_file, *deck, *includes, *parameters, *command_line;
    struct unit_system units;
    double duration, dt;  // [T] dt 0: adaptive steps
    unsigned fields;      // enum field: the histories in the file
    long n_row;           // rows of the histories
    int n_building, n_contact, n_link, n_column;
    struct report_building *building;  // (n_building) from left to right
    struct report_link *contact;       // (n_contact)
    struct report_link *link;          // (n_link) bilateral
    struct report_link *column;        // (n_column) springs of struck columns
    long n_impact;
    struct impact *impact;        // (n_impact) in order of time
    double energy[ENERGY_COUNT];  // [F L] at the end
    double initial_energy;        // [F L] kinetic, strain and contact energy at t = 0
    double residual_peak;         // [F L]
    struct totals totals;
    struct report_collapse collapse;
};

// The report of a run from memory. `file` and `version` are copied; `r` may be NULL: before the
// run. *out must be given to report_free. Errors: STATUS_SYSTEM (no memory).
int report_create(const struct model *m, const struct results *r, const char *file,
                  const char *version, struct report **out, struct error *e);
void report_free(struct report *r);  // NULL is allowed

// Whether a contact force has acted on the floor (from 1) of the building of this name: the peak
// acceleration of such a floor grows with the stiffness of the contact. Rigid contacts do not
// count.
bool report_floor_was_hit(const struct report *r, const char *building, int floor);
bool report_link_joins(const struct report_link *c, const char *building, int floor);

// How tables explain the mark of such a floor, and how legends name it.
extern const char report_hit_note[], report_hit_name[];

// Writes the summary an engineer reads, at most 100 columns wide. Errors: STATUS_SYSTEM (no
// memory); those of `to` are the caller's.
int report_print(const struct report *r, FILE *to, struct error *e);

// What to do where the file exists.
enum result_existing { RESULT_KEEP, RESULT_REPLACE };

struct result_options {
    const char *path;  // the file, complete under this name only
    enum result_existing existing;
    const char *command_line;
    const char *version;  // of the program
};

struct result_writer;
struct result_place;

// Opens PATH.part for the model, which is borrowed until the writer is gone. At most 64 MiB of rows
// are kept in memory. Errors: STATUS_INPUT (the file exists, a name that the file cannot have),
// STATUS_SYSTEM (cannot write; names the path and the cause).
int result_create(const struct model *m, const struct result_options *options,
                  struct result_writer **out, struct error *e);

// The same in a place of a file that somebody else writes, such as that of one run of a study.
int result_create_in(const struct result_place *place, const struct model *m, const char *version,
                     struct result_writer **out, struct error *e);

// Hands the rows of analysis_run to the writer. A row that cannot be written ends the run.
struct observer result_observer(struct result_writer *w);

// Writes the envelopes, impacts and totals, marks the file complete and gives it its name. The
// writer is freed whatever happens; on an error nothing is left behind. Errors: STATUS_SYSTEM,
// STATUS_INPUT (the file has come into being meanwhile).
int result_finish(struct result_writer *w, const struct results *r, struct error *e);

// Removes PATH.part and frees the writer. NULL is allowed.
void result_abort(struct result_writer *w);

// Runs the writer's model, writes what comes and finishes the file; *out must be given to
// results_free. `watch` has the poll of the analysis and no rows; NULL: nothing is asked. The
// writer is freed whatever happens. Errors: those of analysis_run and of result_finish.
int result_analyse(struct result_writer *w, const struct observer *watch, struct results **out,
                   struct error *e);

// Whether a file may be made at `path`, asked before the work is done. Errors: STATUS_INPUT (exists
// and is to be kept, or is not a regular file: a folder, a device, a symbolic link).
int result_check_path(const char *path, enum result_existing existing, struct error *e);

// Gives the complete file `partial` the name `path` in the same folder. `file` is the open file,
// which the caller has locked. The content is on disk before the name appears, and the name is on
// disk when this returns. An existing file survives RESULT_KEEP even when it comes into being at
// the same moment; with RESULT_REPLACE there is always the old file or the new one. `partial` is
// gone afterwards. Errors: STATUS_INPUT (exists, is not a regular file), STATUS_SYSTEM.
int result_publish(int file, const char *partial, const char *path, enum result_existing existing,
                   struct error *e);

// The checksums of a result file, which do not depend on how the file stores its data.
struct result_sums {
    struct checksum data;     // of all names, attributes and values: what the file notes
    struct checksum results;  // of the names and values of datasets: the same for the same model
};

// Checks that the data of a result file of any kind are as they were written. Errors: STATUS_FAILED
// (they differ), STATUS_INPUT (does not exist, is not HDF5, is damaged, has no checksum),
// STATUS_SYSTEM; they name the path.
int result_verify(const char *path, struct result_sums *out, struct error *e);

struct result_file;

// Opens a complete result file and reads its report; FILE#7 is run 7 of a study that was written
// with its histories. Errors: STATUS_SYSTEM (cannot open, no
// memory), STATUS_INPUT (does not exist, not HDF5, not of jostle, newer, incomplete, damaged; names
// the path).
int result_open(const char *path, struct result_file **out, struct error *e);
void result_close(struct result_file *f);  // NULL is allowed

// Borrowed from the file.
const struct report *result_report(const struct result_file *f);

// Whether `n_column` histories take no more memory than a file of this size should: compression can
// hide a thousand times its size. Errors: STATUS_INPUT (they do; names both sizes).
int result_check_memory(const struct result_file *f, int n_column, struct error *e);

// A history in a result file.
enum history_kind {
    HISTORY_TIME,
    HISTORY_FLOOR,
    HISTORY_CONTACT,
    HISTORY_LINK,  // FIELD_FORCE, or FIELD_PENETRATION for its shortening
    HISTORY_GROUND,
    HISTORY_ENERGY
};

struct history {
    enum history_kind kind;
    int field;  // enum field, or enum energy
    int index;  // building, contact or link, from 0
    int floor;  // from 0
};

// Reads a history; `out` has room for n_row values. Errors: STATUS_INPUT (the file does not hold
// it), STATUS_SYSTEM.
int result_history(const struct result_file *f, const struct history *h, double *out,
                   struct error *e);

JOSTLE_C_END

#endif
