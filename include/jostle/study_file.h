// SPDX-License-Identifier: GPL-3.0-or-later
// The result file of a study: the tree of one analysis without histories and impacts, each value
// with the dimensions of the sweeps in front.
#ifndef JOSTLE_STUDY_FILE_H
#define JOSTLE_STUDY_FILE_H

#include <stdint.h>

#include "jostle/deck.h"
#include "jostle/names.h"
#include "jostle/result.h"

JOSTLE_C_BEGIN

enum { STUDY_MESSAGE_MAX = 512 };

// Part `number` of `n`, from 1; n = 0: the whole study.
struct study_shard {
    long number, n;
};

// What tells a run from all others: the SHA-256 of what it depends on (study/keys.h). All zero:
// not known.
struct study_key {
    unsigned char byte[32];
};

// A file that runs have read.
struct study_source {
    const char *path;     // relative to the folder of the deck where it lies below it
    struct checksum sum;  // of an included deck: of what it means
};

// What the runs of a study come from.
struct study_origin {
    int numerics;          // the version of the numerics
    const char *study;     // which study it is: see study/origin.h
    const char *define;    // its -D NAME=VALUE, a line each
    const char *programs;  // checksums of the programs that made runs or parts, a line each
    int n_source;          // in the order of their paths
    const struct study_source *source;  // (n_source)
    const struct study_key *key;        // (n_run of the file); NULL: none are written, or read
};

// What the file of a part says besides the results of its runs.
struct study_part {
    struct study_shard shard;
    const double *run;  // (n_run of the file) the numbers of its runs in the study, from 1, rising
    long n_failed;      // runs of the part
};

// One dataset: some of the values that every run gives.
struct study_item {
    const char *parent, *owner, *leaf;  // group: "buildings", "A", "envelope"; NULL: none
    const char *name, *long_name;
    const struct dimension *dimension;  // NULL: a pure number
    const char *units;                  // of the values: "m", "1"
    const char *scale;                  // dimension of the values: "floor"; NULL: one value
    bool property;                      // of the model, known before the run
    size_t first, n;                    // values [first, first + n) of a run
};

// What the runs of a study give, in the order of a run's values.
struct study_table {
    struct arena *arena;  // owns everything
    int n_item;
    const struct study_item *item;  // (n_item)
    size_t n_value;                 // of a run
};

// The table for runs with the buildings, contacts and links of `r`, whose names are borrowed. *out
// must be given to study_table_free. Errors: STATUS_SYSTEM (no memory).
int study_table_create(const struct report *r, struct study_table **out, struct error *e);
void study_table_free(struct study_table *t);  // NULL is allowed

// The item of `t` that is `wanted`, as a file lists its items in another order; -1: none.
int study_table_find(const struct study_table *t, const struct study_item *wanted);

// The value of a run that is 1 if it has collapsed, else 0; -1: there is none.
long study_table_collapsed(const struct study_table *t);

// The values of one run, (n_value).
void study_table_read(const struct report *r, double *value);

// How a run ended.
enum study_status { STUDY_DONE = 0, STUDY_FAILED = 1, STUDY_MISSING = 2 };
struct study_outcome {
    int status;                       // enum study_status
    char message[STUDY_MESSAGE_MAX];  // "" if done
};

// A finished study. Runs are numbered from 0, the last sweep varying fastest.
struct study_content {
    const struct report *first;       // of the first run, before or after it
    const struct study_table *table;  // of it
    const struct sweep *sweeps;
    const struct study_origin *origin;
    const struct study_part *part;  // NULL: the file has all runs
    long n_run;                     // of the file
    int n_part;                     // the parts it is made of; 0: it was run as a whole
    long n_kept;                    // of them, runs of an earlier start
    int n_thread;                   // of this one
    double seconds;                 // wall time of this one

    // The outcomes (n) and values (n, n_value) of runs first ... first + n - 1; NaN where a run
    // failed or is missing.
    int (*read)(void *context, long first, long n, struct study_outcome *outcome, double *value,
                struct error *e);

    const unsigned char *chosen;  // (n_run) not 0: runs that have histories; NULL: all have

    // Writes run `run` of the file as the result of one analysis into a place, or nothing. NULL:
    // histories are not wanted.
    int (*write_run)(void *context, long run, const struct result_place *place, struct error *e);
    void *context;
};

// Can the file be written under these names? Errors: STATUS_INPUT (it exists; names of buildings or
// sweeps that it cannot have).
int study_file_check(const struct study_content *c, const struct result_options *o,
                     struct error *e);

// Writes the file as PATH.part and gives it its name when it is complete. Memory does not depend on
// the number of runs. Errors as of study_file_check, STATUS_SYSTEM, or what `read` returns.
int study_file_write(const struct study_content *c, const struct result_options *o,
                     struct error *e);

struct study_file;

// What a study file says apart from its values.
struct study_view {
    struct arena *arena;  // owns everything below
    const char *path, *title, *version;
    struct unit_system units;
    int n_sweep;
    const struct sweep *sweep[STUDY_SWEEPS_MAX];
    long n_run;                  // of the file
    long n_study;                // of the study
    struct study_part part;      // shard.n = 0: the file has all runs
    struct study_origin origin;  // study NULL: an earlier version wrote the file
    int n_part;                  // the parts that were joined; 0: it was run as a whole
    bool has_histories;
    long n_kept;
    int n_thread;
    double seconds;
    struct study_table table;
    int n_building, n_contact, n_link, n_column;
    const struct report_building *building;  // (n_building) names and members
    const struct report_link *contact;       // (n_contact) names and floors
    const struct report_link *link;          // (n_link)
    const struct report_link *column;        // (n_column) springs of struck columns
};

// Whether value `i` of `item` is the peak acceleration of a floor that was hit in the run with
// these values (report_floor_was_hit); -1: the item is not accelerations.
int study_view_hit(const struct study_view *v, const struct study_item *item, size_t i,
                   const double *value);

// Does value `i` of `item` enter the largest value of all? All do but those of floors and storeys
// of isolators (floor_is_summarised). Storey shears do.
bool study_view_counts(const struct study_view *v, const struct study_item *item, size_t i);

// The building whose "members" or "foundation" have the values of `item`; NULL: others have.
const struct report_building *study_view_building(const struct study_view *v,
                                                  const struct study_item *item, const char *owner);

// True if the file at `path` is the complete result of a study.
bool study_file_is_study(const char *path);

// Opens a study file. Errors: STATUS_SYSTEM, STATUS_INPUT (not one, damaged); they name the path.
int study_file_open(const char *path, struct study_file **out, struct error *e);
void study_file_close(struct study_file *f);  // NULL is allowed
const struct study_view *study_file_view(const struct study_file *f);

// Checks that the data of the file are as they were written and tell what its runs come from.
// Errors: STATUS_INPUT (they are not, or there is no checksum), STATUS_SYSTEM; they name the path.
int study_file_verify(struct study_file *f, struct error *e);

// The keys of the runs of the file, (n_run), to be freed; NULL: it has none, as an earlier version
// wrote it. Errors as of study_file_open.
int study_file_keys(struct study_file *f, struct study_key **out, struct error *e);

// How each run ended, (n_run), to be freed: its status, and with it STUDY_COLLAPSED. Errors as of
// study_file_open.
enum { STUDY_STATUS = 3, STUDY_COLLAPSED = 4 };  // masks
int study_file_endings(struct study_file *f, int **out, struct error *e);

// The number in the study, from 0, of run `i` of the file; which value of sweep `i` a run of the
// study has.
long study_view_run(const struct study_view *v, long i);
int study_view_choice(const struct study_view *v, long run, int i);

// What the first run has in common with all others, for a file made of this one: a report without
// results. To be given to report_free. Errors as of study_file_open.
int study_file_report(struct study_file *f, struct report **out, struct error *e);

// The outcomes (n) and values (n, n_value) of runs first ... first + n - 1 of the file.
int study_file_read(struct study_file *f, long first, long n, struct study_outcome *outcome,
                    double *value, struct error *e);

struct study_run {
    long number;  // in the study, from 0
    const struct study_outcome *outcome;
    const double *value;  // (n_value)
};

// Calls `take` for each run of the file in turn, of which a block is in memory. Errors:
// STATUS_INPUT (a damaged file), STATUS_SYSTEM, and those of `take`, which end it.
typedef int study_run_function(void *context, const struct study_run *r, struct error *e);
int study_file_each(struct study_file *f, study_run_function *take, void *context, struct error *e);

JOSTLE_C_END

#endif
