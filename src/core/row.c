// SPDX-License-Identifier: GPL-3.0-or-later
// The ranges that most rows use, rows by their keys, and dimensions that depend on an exponent.
#include "jostle/row.h"

#include <math.h>
#include <string.h>

const struct range range_positive = {.min = 0, .max = INFINITY, .min_open = true, .text = "> 0"};

const struct range range_non_negative = {.min = 0, .max = INFINITY, .text = ">= 0"};

bool range_holds(const struct range *r, double value) {
    return !r || ((r->min_open ? value > r->min : value >= r->min) &&
                  (r->max_open ? value < r->max : value <= r->max));
}

int row_find(const struct row *row, int n, const char *key) {
    int r = n - 1;
    while (r >= 0 && strcmp(row[r].key, key) != 0) {
        r--;
    }
    return r;
}

struct dimension row_dimension(const struct row *row, double power) {
    struct dimension dimension = row->dimension;
    if (row->flags & (ROW_PER_LENGTH_POWER | ROW_PER_VELOCITY_POWER)) {
        dimension.length -= power;
    }
    if (row->flags & ROW_PER_VELOCITY_POWER) {
        dimension.time += power;
    }
    return dimension;
}
