// SPDX-License-Identifier: GPL-3.0-or-later
// The picture of response spectra: pseudo-acceleration against the logarithm of the period.
#ifndef JOSTLE_PLOT_RESPONSE_H
#define JOSTLE_PLOT_RESPONSE_H

#include <stdio.h>

#include "jostle/intensity.h"
#include "jostle/spectrum.h"

// What is drawn, in SI units; periods of 0 are left out.
struct response_sheet {
    const struct spectra *spectra;
    const char *const *name;            // (n_record)
    const struct intensity *intensity;  // (n_record)
    double gravity;                     // [m/s^2] the unit g
    const char *version;                // of the program
};

// Writes a stand-alone script that makes the file `picture`. One damping ratio: each record, and of
// several the mean and the band from 16 to 84 %. Several ratios: the record, or the mean of all.
// Errors: STATUS_INPUT (the name has no ending of a picture). Write errors of `to` are the
// caller's.
int response_write(const struct response_sheet *sheet, const char *picture, FILE *to,
                   struct error *e);

#endif
