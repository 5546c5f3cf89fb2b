// SPDX-License-Identifier: GPL-3.0-or-later
// What `make bench` measures: one row of a table per case, with the way to measure it.
#ifndef JOSTLE_BENCH_H
#define JOSTLE_BENCH_H

#include <time.h>

#include "jostle/model.h"

#define BENCH_TOLERANCE "3e-6"  // within 1e-6 m on the pair: docs/performance.md
#define BENCH_RECORD "records/ELCENTRO_1940_NS.AT2"  // from input/

struct bench_case;

// What a measurement needs besides its case.
struct bench_place {
    const char *program;  // path of jostle
    const char *folder;   // for what is written
};

// Runs the case once, from start to end, and stores the seconds it took.
typedef int bench_measure(const struct bench_case *c, const struct model *m,
                          const struct bench_place *place, double *seconds, struct error *e);

struct bench_case {
    const char *name;
    int n_building;          // 0: the pair of 8 and 5 storeys
    int n_floor;             // of each building of a row
    const char *contact;     // options of the contacts
    const char *statements;  // further lines of the deck; NULL: none
    double dt, duration;     // [s] dt = 0: adaptive steps of Dormand & Prince
    bench_measure *measure;
    double limit, target;  // [ns/step] see docs/performance.md; 0: none
};

extern const struct bench_case bench_cases[];  // for the table of times
extern const int n_bench_case;
extern const struct bench_case bench_built[];  // for the table of reading and building, by size
extern const int n_bench_built;
extern const struct bench_case bench_counted[];  // for the counts of instructions
extern const int n_bench_counted;

// The deck of a case as text, to be freed; NULL: no memory. Its record has the path in the param
// `record`, which is right for a deck in input/.
char *bench_deck(const struct bench_case *c);

// The model of a case.
int bench_model(const struct bench_case *c, struct model **out, struct error *e);

// CPU time of the thread in analysis_run, without an observer.
bench_measure bench_analysis;

// CPU time of ENSEMBLE_MAX runs of the case with gaps 1 mm apart, in lockstep, for each of them.
bench_measure bench_ensemble;

// The same as bench_analysis with the result file written.
bench_measure bench_histories;

// Wall time of `jostle run`, from fork to its end.
bench_measure bench_program;

// CPU time of the thread in reading the deck and building the model.
bench_measure bench_build;

// The clock of the processor [GHz]; 0: not known.
double bench_clock(void);

// Time [s] of a clock of the system.
double bench_seconds(clockid_t clock);

enum layout { LAYOUT_TABLE, LAYOUT_TABS };

// Prints date, machine and its clock, compiler and its options.
void bench_head(enum layout layout);

// Measures and prints the cases whose names contain `filter`, one line each.
int bench_table(const struct bench_place *place, const char *filter, enum layout layout,
                struct error *e);

// The same for reading and building.
int bench_table_built(const struct bench_place *place, enum layout layout, struct error *e);

#endif
