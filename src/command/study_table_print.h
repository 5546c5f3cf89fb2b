// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces of the tables that `show` prints of a study.
#ifndef JOSTLE_STUDY_TABLE_PRINT_H
#define JOSTLE_STUDY_TABLE_PRINT_H

#include <stdio.h>

#include "jostle/study_file.h"

// Where a quantity of the envelopes is largest over all runs.
struct table_peak {
    bool found;
    double value;
    long run;
    size_t at;  // among its values
};
struct table_peaks {
    struct table_peak *peak;  // (n_item)
    long n_failed;
    long failed;  // the first run that did
    char message[STUDY_MESSAGE_MAX];
};

void table_peaks_add(struct table_peaks *p, const struct study_view *v, long run,
                     const struct study_outcome *outcome, const double *value);
void table_peaks_print(const struct table_peaks *p, const struct study_view *v, FILE *to);

// The building, contact or link of value `i`; "" if there is none.
const char *table_print_name(const struct study_view *v, const struct study_item *item, size_t i);
// Without what would break a table.
void table_print_text(const char *text, FILE *to);

#endif
