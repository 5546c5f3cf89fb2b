// SPDX-License-Identifier: GPL-3.0-or-later
// From the smallest to the largest of some values: what an axis shows.
#ifndef JOSTLE_SPAN_H
#define JOSTLE_SPAN_H

struct span {
    double low, high;
};
// Widens `r` by a value, or by another span; values that are not finite, or beyond 1e300, are
// passed over, and those below 1e-300 are 0. Begin with span_none.
extern const struct span span_none;
void span_add(struct span *r, double value);
void span_join(struct span *r, struct span other);
// Some room at both ends, at `from` none; never empty. `from` is NAN where there is no such end.
struct span span_with_room(struct span r, double from);

#endif
