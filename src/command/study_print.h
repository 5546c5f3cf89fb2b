// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces of the tables that `show` prints of a study.
#ifndef JOSTLE_STUDY_PRINT_H
#define JOSTLE_STUDY_PRINT_H

#include <limits.h>
#include <stdio.h>

#include "command/printer.h"
#include "jostle/study_file.h"
#include "study/bootstrap.h"
#include "study/hazard.h"

// Where a quantity of the envelopes is largest over all runs.
struct study_peak {
    bool found;
    bool hit;  // of a floor that was hit
    double value;
    long run;
    size_t at;  // among its values
};
struct study_peaks {
    struct study_peak *peak;  // (n_item)
    long n_failed, n_missing, n_collapsed;
    long failed;  // the first run that did
    char message[STUDY_MESSAGE_MAX];
};

// Takes a run into the peaks, or into the counts of those that failed or are missing.
void study_peaks_add(struct study_peaks *p, const struct study_view *v, const struct study_run *r);
// Prints the sweeps of a study, its peaks with their runs, and the first failure.
void study_peaks_print(const struct study_peaks *p, const struct study_view *v, FILE *to);

// An acceleration in g, "2.072", and as an addition to a sentence, " (2.072 g)"; "" for values in
// other `units`.
struct study_g {
    char text[24], added[32];
};
struct study_g study_print_g(const struct unit_system *u, const char *units, double value);

// A line with the parameters of a curve that was fitted, the median in `unit`.
void study_print_curve(const struct fragility *f, const char *unit, const struct unit_system *u);

// A line with the intervals of a bootstrap, unless none was made (n_draw 0), and columns of data.
void study_print_bootstrap(const struct bootstrap *b, const char *unit);
void study_print_bootstrap_columns(struct printer *t);
void study_print_bootstrap_cells(const struct bootstrap *b, struct printer *t);

// How often in a year a limit with this fragility is exceeded; NAN: there is no hazard curve (NULL)
// or no fragility. Warns on stderr where the hazard curve is too short for the rate. `unit` is that
// of the intensity.
double study_print_find_rate(const struct hazard *h, const struct fragility *f, const char *unit);
// A line with that rate.
void study_print_rate(double rate);

// Rows of --bootstrap, which draws `drawn` ("records"), of its --seed, and of --hazard.
#define STUDY_PRINT_BOOTSTRAP_ROW(place, drawn)                                                    \
    {                                                                                              \
        "bootstrap", 0, "N", OPTION_WHOLE, 0, place, 1, BOOTSTRAP_MAX,                             \
            .what = "a number of bootstraps",                                                      \
            .doc = "fits N times again, with " drawn                                               \
                   " drawn at random, and prints between which values 95 % of the medians and "    \
                   "dispersions are"                                                               \
    }
#define STUDY_PRINT_SEED_ROW(place)                                                                \
    {                                                                                              \
        "seed", 0, "S", OPTION_WHOLE, 0, place, 1, INT_MAX,                                        \
            .doc = "seed of these draws, a whole number from 1; default: 1"                        \
    }
#define STUDY_PRINT_HAZARD_ROW(place)                                                              \
    {                                                                                              \
        "hazard", 0, "FILE", OPTION_TEXT, 0, place,                                                \
            .doc = "rows of intensity and mean annual rate of exceedance at the site: prints "     \
                   "how often in a year the limit is exceeded"                                     \
    }

// "done", "failed", or "missing": not in the file.
const char *study_print_status(const struct study_outcome *outcome);

// The building, contact or link of value `i`; "" if there is none.
const char *study_print_name(const struct study_view *v, const struct study_item *item, size_t i);

#endif
