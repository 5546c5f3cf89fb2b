// SPDX-License-Identifier: GPL-3.0-or-later
// What an axis shows.
#include "plot/canvas.h"

#include <math.h>

const struct span span_none = {INFINITY, -INFINITY};

// Sums and ratios of such numbers neither overflow nor become 0.
static const double LARGEST = 1e300, SMALLEST = 1e-300;

void span_add(struct span *r, double value) {
    if (fabs(value) <= LARGEST) {
        value = fabs(value) < SMALLEST ? 0 : value;
        r->low = fmin(r->low, value);
        r->high = fmax(r->high, value);
    }
}

void span_join(struct span *r, struct span other) {
    span_add(r, other.low);
    span_add(r, other.high);
}

struct span span_with_room(struct span r, double from) {
    span_add(&r, from);
    if (r.low > r.high) {
        return (struct span){0, 1};
    }
    const double size = r.high - r.low;
    const double room = size > 0 ? 0.05 * size : r.high != 0 ? 0.5 * fabs(r.high) : 1;
    return (struct span){r.low == from ? r.low : r.low - room,
                         r.high == from && r.low < from ? r.high : r.high + room};
}
