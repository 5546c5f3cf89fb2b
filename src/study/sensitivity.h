// SPDX-License-Identifier: GPL-3.0-or-later
// How much each random parameter of a study matters for a demand: one parameter at a time, by
// elementary effects, or by the shares of the variance. The values are quantiles of the parameters'
// distributions, not those that the deck has drawn.
#ifndef JOSTLE_SENSITIVITY_H
#define JOSTLE_SENSITIVITY_H

#include "study/edp.h"
#include "study/morris.h"
#include "study/plan.h"
#include "study/sobol.h"

struct arena;

enum sensitivity_method { SENSITIVITY_ONE_AT_A_TIME, SENSITIVITY_MORRIS, SENSITIVITY_VARIANCE };

struct sensitivity_request {
    const struct plan *plan;  // made by plan_init
    struct edp edp;           // of the values of the plan
    enum sensitivity_method method;
    double share;  // the outermost quantiles are share and 1 - share, 0 <= share < 0.5; not of the
                   // variance
    long n_row;    // trajectories, or rows of both samples, >= 2; 0: half the values of the deck
    int n_level;   // of Morris: even
    int n_thread;
    // Called every 0.1 s; a result other than 0 ends the runs with that status. NULL: never.
    int (*poll)(void *context, long n_done, struct error *e);
    void *context;
};

// One at a time: the demand with the parameter at a low and at a high quantile, the others at their
// medians.
struct sensitivity_swing {
    double at[2];      // values of the parameter
    double demand[2];  // infinite: collapsed; NAN: failed
};

// What one combination of the other sweeps came to.
struct sensitivity_group {
    double middle;                    // one at a time: demand at the medians
    struct sobol_summary summary;     // of the variance
    size_t n_left_out;                // rows or trajectories with a demand that is not finite
    struct sensitivity_swing *swing;  // (n_parameter) one at a time
    struct morris_effect *effect;     // (n_parameter) of Morris
    struct sobol_share *share;        // (n_parameter) of the variance
    int *order;                       // (n_parameter) from the one that matters most
};

struct sensitivity {
    int n_parameter;
    const struct sweep **parameter;  // (n_parameter) random sweeps
    long n_row;                      // as of the request, without its 0
    long n_group;                    // combinations of the other sweeps
    long n_run;                      // for all of them
    // Of sensitivity_run:
    struct plan_fixed others;         // the n_group runs for one set of parameters
    struct sensitivity_group *group;  // (n_group)
    long n_failed, n_collapsed;       // runs
    // Of the first of these runs: its parameters, and why it failed.
    char why[512];
};

// Finds the parameters, and how many runs there are. Memory is from `a`. Errors: STATUS_INPUT (no
// random parameter, one is paired with others that are not random, two are correlated, too few
// values or too many runs), STATUS_SYSTEM.
int sensitivity_find(const struct sensitivity_request *q, struct arena *a, struct sensitivity *out,
                     struct error *e);

// Makes all runs of what sensitivity_find has found; what they come to does not depend on the
// number of threads. Errors: STATUS_INPUT (the deck has another shape at a value; a run without a
// value of the demand), STATUS_SYSTEM, or what poll returned.
int sensitivity_run(const struct sensitivity_request *q, struct arena *a, struct sensitivity *s,
                    struct error *e);

#endif
