// SPDX-License-Identifier: GPL-3.0-or-later
// Demands of all runs of a study file.
#ifndef JOSTLE_DEMANDS_H
#define JOSTLE_DEMANDS_H

#include "study/edp.h"

// What to do with a run that is done and has no value of a demand.
enum demands_absent { DEMANDS_ERROR, DEMANDS_NAN };

struct demands {
    struct study_file *file;
    int n;                  // demands
    const struct edp *edp;  // (n)
    enum demands_absent absent;
    double *value;  // (n_run of the file, n) out; NAN: the run failed or is missing; infinite: a
                    // demand of a building in a run that collapsed
};

// Reads the file. Errors: STATUS_INPUT (a damaged file, a run has no value), STATUS_SYSTEM.
int demands_read(const struct demands *d, struct error *e);

// Reads a demand; `text` NULL: drift-ratio, or drift where the deck gives no heights. What lasts is
// from `a`. Errors as of edp_parse and of study_file_read.
int demands_find(struct study_file *f, const char *text, struct arena *a, struct edp *out,
                 struct error *e);

#endif
