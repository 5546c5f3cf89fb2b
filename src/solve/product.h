// SPDX-License-Identifier: GPL-3.0-or-later
// The product of a matrix and a vector in lanes, column by column of the result.
#ifndef JOSTLE_PRODUCT_H
#define JOSTLE_PRODUCT_H

#include "core/lanes.h"

// y (LANES_WIDTH) = sum of r_i times row i, from row 0 on, of n rows of LANES_WIDTH numbers each
// that are `stride` apart. Two rows a turn save half the loop.
static inline void product_of_columns(const double *row, int stride, const double *r, int n,
                                      lanes *y) {
    lanes y0 = {0.0}, y1 = {0.0};
    for (int i = 0; i + 1 < n; i += 2, row += 2 * stride) {
        const double *second = row + stride;
        y0 += r[i] * *(const lanes *)row;
        y1 += r[i] * *(const lanes *)(row + LANES_VECTOR);
        y0 += r[i + 1] * *(const lanes *)second;
        y1 += r[i + 1] * *(const lanes *)(second + LANES_VECTOR);
    }
    if (n % 2 == 1) {
        y0 += r[n - 1] * *(const lanes *)row;
        y1 += r[n - 1] * *(const lanes *)(row + LANES_VECTOR);
    }
    y[0] = y0;
    y[1] = y1;
}

#endif
