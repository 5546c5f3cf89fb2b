// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/link_end.h"

double link_end_row(const struct link_row *row, const double *x) {
    double sum = 0.0;
    for (int i = 0; i < row->n; i++) {
        sum += row->entry[i].weight * x[row->entry[i].dof];
    }
    return sum;
}
