// SPDX-License-Identifier: GPL-3.0-or-later
// The picture of response spectra: pseudo-acceleration against the logarithm of the period.
#ifndef JOSTLE_PLOT_RESPONSE_H
#define JOSTLE_PLOT_RESPONSE_H

#include "jostle/intensity.h"
#include "jostle/spectrum.h"
#include "motion/target.h"
#include "plot/figure.h"

// What is drawn, in SI units; periods of 0 are left out.
struct response_sheet {
    const struct spectra *spectra;
    const char *const *name;            // (n_record)
    const struct intensity *intensity;  // (n_record)
    const struct target *target;        // to which they were scaled; NULL: to none
    const double *factor;               // (n_record) by which
    struct span match;                  // the periods between which it was compared
    double gravity;                     // [m/s^2] the unit g
    const char *version;                // of the program
};

// Writes the script and its data. One damping ratio: each record, of several the mean and the band
// from 16 to 84 %, and the target. Several ratios: the record, or the mean of all. Errors:
// STATUS_INPUT (the picture has another ending). Write errors are the caller's.
int response_write(const struct response_sheet *sheet, const struct figure_files *to,
                   struct error *e);

#endif
