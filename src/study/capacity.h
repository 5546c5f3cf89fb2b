// SPDX-License-Identifier: GPL-3.0-or-later
// Adaptive incremental dynamic analysis: for each sample the intensity at which a demand first
// exceeds a limit, by few runs (Vamvatsikos & Cornell 2002, Earthquake Engng Struct. Dyn. 31,
// 491-514, and 2004, Earthquake Spectra 20, 523-553). The search hunts upwards, by a constant
// factor or by steps that grow, until the limit is exceeded. Then it halves the interval between
// the intensities on both sides of the limit. Runs that are left fill the widest gaps below. A
// demand need not grow with the intensity: an exceedance between two intensities, neither of which
// exceeds the limit, is not seen.
#ifndef JOSTLE_CAPACITY_H
#define JOSTLE_CAPACITY_H

#include "study/edp.h"
#include "study/fragility.h"
#include "study/plan.h"

enum { CAPACITY_POINTS_MAX = 200 };  // runs of one sample

// Where the limit is crossed between the intensities on both sides of it: at their geometric mean;
// on a straight line; on a natural cubic spline of the demand through all runs, as Vamvatsikos &
// Cornell (2004) interpolate. A demand that jumps, such as that of a collapse, has no line there:
// then it is the mean.
enum capacity_curve { CAPACITY_SPLINE, CAPACITY_LINE, CAPACITY_MIDDLE };

struct capacity_request {
    const struct plan *plan;  // made by plan_init
    const char *intensity;    // sweep of its deck
    const char *unit;         // of its values, for tables: "m/s^2"; "" for pure numbers
    struct edp edp;           // of the values of the plan
    double limit;             // in its units
    double from, to;          // intensities of the hunt, 0 < from < to
    double factor;            // > 1, of the hunt; capacity_runs says how many runs it may take
    double step, growth;      // step > 0: of the hunt in place of the factor, and what each step
                              // is longer than the one before
    double tolerance;         // > 0: ends the bisection where both sides are so near, relatively
    int n_run;                // of a sample, to be used up; 0: as many as the tolerance needs
    enum capacity_curve curve;
    int n_thread;
    // Called every 0.1 s; a result other than 0 ends the runs with that status. NULL: never.
    int (*poll)(void *context, long n_done, struct error *e);
    void *context;
};

struct capacity_point {
    double intensity;
    double value;   // of the demand; infinite: a collapse that exceeds every limit
    bool exceeded;  // value > limit
};

// One sample. `crossing`: CROSSING_AT between `below` and `above`; CROSSING_ABOVE: not exceeded up
// to `below`; CROSSING_BELOW: exceeded at `from`; CROSSING_NO_RUNS: a run failed, and `failure`
// says why.
struct capacity {
    int n_point;
    struct capacity_point point[CAPACITY_POINTS_MAX];  // by intensity
    enum fragility_crossing crossing;
    double below, above;                    // intensities; NAN: there is none
    double crossing_at;                     // between them, on the curve; NAN
    double value;                           // demand at `below`; NAN
    char failure[STUDY_MESSAGE_MAX + 300];  // with the intensity
};

// An intensity: the value at which its sweep is fixed.
struct capacity_at {
    const char *name;
    double value;
};

struct capacities {
    long n;                   // samples: the runs of the deck at one intensity
    struct capacity *each;    // (n)
    struct plan_fixed at;     // of these runs, at `from`
    struct capacity_at from;  // the intensity of these runs
};

// The most runs that a sample can take for the tolerance; > CAPACITY_POINTS_MAX: the request is
// refused.
int capacity_runs(const struct capacity_request *q);

// Searches all samples; the results do not depend on the number of threads. *out must be given to
// capacity_close, whatever happens. Errors: STATUS_INPUT (the deck has an error at an intensity, or
// another shape; a run without a value of the demand), STATUS_SYSTEM, or what poll returned.
int capacity_search(const struct capacity_request *q, struct capacities *out, struct error *e);
void capacity_close(struct capacities *c);

// The crossing of a sample for fragility_fit_records.
struct fragility_record capacity_record(const struct capacity *c);

// The intensity at which the curve through the points of a sample with a crossing reaches the
// limit.
double capacity_curve_crossing(const struct capacity *c, double limit, enum capacity_curve curve);

// Whether both sides of the limit are as near as the tolerance.
bool capacity_is_found(const struct capacity_request *q, const struct capacity *c);

#endif
