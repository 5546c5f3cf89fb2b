// SPDX-License-Identifier: GPL-3.0-or-later
// Intensity measures of the ground motions of runs, by names such as `PGA`, `Sa(1s,2%)` or
// `Sa_avg(0.2s:2s)`. They are of the record as the run has it: scaled, and up to the end of the
// run. A study file does not store them: they follow from the deck and the records, which must be
// those of the file.
#ifndef JOSTLE_MEASURE_H
#define JOSTLE_MEASURE_H

#include "jostle/study_file.h"
#include "study/plan.h"

enum measure_kind { MEASURE_OF_RECORD, MEASURE_SA, MEASURE_SA_AVG };

struct measure {
    const char *text;      // as asked for
    const char *building;  // whose ground it is; NULL: all have the same
    enum measure_kind kind;
    size_t at;         // MEASURE_OF_RECORD: the member of struct intensity
    double period[2];  // [T] MEASURE_SA has the first
    double damping;    // ratio
    struct dimension dimension;
    const char *units;  // "1": a number
};

// What a measure can be, a line each.
extern const char measure_help[];

// Whether a text begins as a measure does.
bool measure_is_named(const char *text);

// Reads NAME, Sa(PERIOD), Sa(PERIOD,DAMPING), Sa_avg(FROM:TO) or Sa_avg(FROM:TO,DAMPING), and what
// may follow, :BUILDING. What lasts is from `a`. Errors: STATUS_INPUT, STATUS_SYSTEM.
int measure_parse(const struct unit_system *u, const char *text, struct arena *a,
                  struct measure *out, struct error *e);

// Of the ground of a model. Errors: STATUS_INPUT (there is no such building, its ground is not one
// record, or buildings have different grounds and none is named).
int measure_of(const struct measure *m, const struct model *model, double *out, struct error *e);

struct measure_request {
    const struct model *first;  // the model of the deck of the study
    const char *const *define;  // (n_define) NAME=VALUE it was read with
    int n_define;
    int n_thread;
    int (*poll)(void *context, long n_done, struct error *e);  // every 0.1 s; NULL: never
    void *context;
};

// The measures (n) of each run of a study file: value (n_run, n), NAN where a run has no model.
// Errors: STATUS_INPUT (the deck or a record has changed; those of measure_of, with the run),
// STATUS_SYSTEM, and what poll returned.
int measure_runs(const struct study_view *v, const struct measure_request *q,
                 const struct measure *measure, int n, double *value, struct error *e);

#endif
