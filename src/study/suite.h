// SPDX-License-Identifier: GPL-3.0-or-later
// One demand parameter of all runs of a study, arranged as engineers look at suites: over one swept
// parameter (an intensity), for each sample (a record), for each group (values of all other
// sweeps).
#ifndef JOSTLE_SUITE_H
#define JOSTLE_SUITE_H

#include "study/edp.h"
#include "study/measure.h"

// What to do with runs that failed: they count as above every value, or are left out.
enum suite_failed { SUITE_FAILED_ABOVE, SUITE_FAILED_LEFT_OUT };

// Which sweep to go along where none is named: the intensity, or any.
enum suite_guess { SUITE_INTENSITY, SUITE_ANY };

struct suite_request {
    const char *edp;        // NULL: drift-ratio, or drift where the deck gives no heights
    bool measured;          // the intensity of each run follows by suite_measure
    const char *abscissa;   // sweep, or parameter along one, that it goes along; NULL: found
    const char *over;       // sweeps whose values are samples, "record,k"; NULL: found; "": none
    const char *const *at;  // (n_at) NAME=VALUE, sweeps of which one value only is looked at
    int n_at;
    enum suite_guess guess;
    enum suite_failed failed;
};

enum { SUITE_NAMED_MAX = 10 };
struct suite {
    struct arena *arena;            // owns everything below
    const struct study_view *view;  // borrowed
    struct edp edp;
    const struct sweep *abscissa;  // or a parameter along it
    const char *mixed;  // "a random parameter": why other things change along it, too; NULL
    bool is_intensity;  // by its name
    const char *im;     // name of the intensity: that of the abscissa
    const char *abscissa_units;  // "" for texts and pure numbers
    struct dimension abscissa_dimension;
    double abscissa_size;  // in SI, of its unit
    int n_point, n_sample, n_group;
    const int *order;               // (n_point) value of the sweep at each point, ascending
    const double *point;            // (n_point) its numbers; 1, 2, ... for texts
    const char *const *point_name;  // (n_point) by the value of the sweep; NULL: they are numbers
    const char *point_title;        // of these names: "measure: gap [m], damper [kN]"
    const char *const *sample;      // (n_sample) "ELCENTRO_1940_NS"
    const char *const *group;       // (n_group) "gap = 0.02 m"; "" where there is one
    const int *group_sweep;         // (n_group_sweep) sweeps of which groups are the values
    int n_group_sweep;
    const char *over;         // names of the sampled sweeps, "record"; "" if none
    const char *fixed;        // "gap = 0.02 m" of --at; ""
    const double *value;      // (n_group, n_sample, n_point); INFINITY: above all, as that of a
                              // building in a run that collapsed; NAN: left out
    const double *reached;    // the same, but for collapsed runs the value up to the collapse
    const bool *collapsed;    // (n_group, n_sample, n_point)
    long n_collapsed;         // of them
    const double *intensity;  // (n_group, n_sample, n_point) of each run; NULL: its point
    const bool *hit;  // (n_group, n_sample, n_point) of edp_hit: the value is of a hit floor
    long n_hit;       // of them
    long n_run;       // n_group n_sample n_point
    const long *row;  // (n_run) of each run in the file; -1: it does not have it
    long n_missing;   // of them, runs that the file does not have; they are left out
    long n_unplaced;  // of them, runs left out as they have no intensity
    long n_failed;    // of them; the first ones are named
    const char *failed[SUITE_NAMED_MAX];  // "run 7 (record X, im 0.3): why"
    enum suite_failed rule;
};

// Reads the file. *out must be given to suite_free. Errors: STATUS_INPUT (an unknown name, a sweep
// whose part is not clear), STATUS_SYSTEM.
int suite_create(struct study_file *f, const struct suite_request *q, struct suite **out,
                 struct error *e);
void suite_free(struct suite *s);  // NULL is allowed

// Gives each run an intensity of its own, in place of the abscissa: value (n_run of the file) in
// units of the measure. Runs without one (NAN) are left out. Errors: STATUS_SYSTEM (no memory).
int suite_measure(struct suite *s, const struct measure *m, const double *value, struct error *e);

// Which value of sweep group_sweep[i] a group has.
int suite_group_choice(const struct suite *s, int group, int i);

// The intensity of a run.
double suite_intensity(const struct suite *s, int group, int sample, int point);

// The demand of a run; NAN where it is left out, infinite where it counts as above every value.
double suite_value(const struct suite *s, int group, int sample, int point);

// What it was up to the collapse of a run that collapsed; else the same.
double suite_reached(const struct suite *s, int group, int sample, int point);

// Whether a run collapsed.
bool suite_collapsed(const struct suite *s, int group, int sample, int point);

// Whether the demand of a run is the peak acceleration of a floor that was hit.
bool suite_hit(const struct suite *s, int group, int sample, int point);

// The finite and infinite values of all samples at a point, ascending, into `value` (n_sample);
// returns how many: those that were not left out.
int suite_samples(const struct suite *s, int group, int point, double *value);

// The quantile of the samples at a point; INFINITY: above all values; NAN: no run is left.
// `work` is (n_sample).
double suite_percentile(const struct suite *s, int group, int point, double fraction, double *work);

#endif
