// SPDX-License-Identifier: GPL-3.0-or-later
#include "law/points.h"

#include <assert.h>
#include <math.h>
#include <string.h>

// Targets beyond are of no use; with damage at every zero shear they grow exponentially.
static const double FAR = 1e6;

void points_prepare(double stiffness, const double *drift, const double *shear, int n, double last,
                    double *c) {
    assert(n > 0 && n <= POINTS_MAX);
    memset(c, 0, POINTS_CONSTANTS * sizeof *c);
    c[LOADING_STIFFNESS] = stiffness;
    c[LOADING_YIELD] = c[LOADING_YIELD_LEFT] = drift[0];
    c[POINTS_LEFT] = 1.0;
    c[POINTS_N] = n;
    for (int i = 0; i < n; i++) {
        c[POINTS_DRIFT + i] = drift[i];
        c[POINTS_SHEAR + i] = shear[i];
        c[POINTS_SLOPE + i] =
            i + 1 < n ? (shear[i + 1] - shear[i]) / (drift[i + 1] - drift[i]) : last;
    }
    c[POINTS_PINCH_DRIFT] = c[POINTS_PINCH_SHEAR] = 1.0;
}

void points_resize(double *c, double left) {
    if (!isnan(left)) {
        c[POINTS_LEFT] = left;
        c[LOADING_YIELD_LEFT] = left * c[LOADING_YIELD];
    }
}

// Adds the lines of the backbone of that size from `drift` on.
static int points_backbone(const double *c, double size, double drift, struct loading_line *line) {
    const int n = (int)c[POINTS_N];
    int i = 0, used = 0;
    while (i + 1 < n && size * c[POINTS_DRIFT + i + 1] <= drift) {
        i++;
    }
    for (; i < n; i++) {
        const double slope = c[POINTS_SLOPE + i], start = size * c[POINTS_DRIFT + i];
        const double from = fmax(drift, start);
        const double shear = size * c[POINTS_SHEAR + i] + slope * (from - start);
        line[used++] = (struct loading_line){from, fmax(shear, 0.0), shear > 0.0 ? slope : 0.0};
    }
    assert(used > 0);
    // A backbone that falls ends at zero shear.
    const struct loading_line *last = &line[used - 1];
    if (last->slope < 0.0) {
        line[used] = (struct loading_line){last->drift - last->shear / last->slope, 0.0, 0.0};
        used++;
    }
    return used;
}

static double points_area_of(const double *c, double size, double drift) {
    struct loading_line line[POINTS_MAX + 1];
    double area = size * size * c[POINTS_SHEAR] * c[POINTS_DRIFT] / 2.0;
    const int n = points_backbone(c, size, size * c[POINTS_DRIFT], line);
    for (int i = 0; i < n && line[i].drift < drift; i++) {
        const double way = (i + 1 < n ? fmin(line[i + 1].drift, drift) : drift) - line[i].drift;
        area += (line[i].shear + line[i].slope * way / 2.0) * way;
    }
    return area;
}

double points_area(const double *c, double drift) {
    return points_area_of(c, 1.0, drift) + points_area_of(c, c[POINTS_LEFT], drift);
}

void points_describe(const double *c, int i, struct storey_figures *out) {
    for (int at = 0; at < 2; at++) {
        out->yield[at] = points_size(c, at) * c[POINTS_DRIFT + i];
        out->strength[at] = points_size(c, at) * c[POINTS_SHEAR + i];
    }
}

// The index of the direction of the path: 0 right, 1 left.
static int points_side(const double *h) {
    return h[LOADING_SIDE] > 0.0 ? 0 : 1;
}

static double points_most(const double *c, double size, double drift) {
    struct loading_line line[POINTS_MAX + 1];
    points_backbone(c, size, drift, line);
    return line[0].shear;
}

// The drift at which direction `at` leaves the first line.
static double points_first(const double *c, int at) {
    return points_size(c, at) * c[POINTS_DRIFT];
}

// The unloading stiffness of direction `at` with that largest drift.
static double points_slope(const double *c, int at, double largest) {
    const double b = c[POINTS_EXPONENT], first = points_first(c, at);
    const double share = b > 0.0 && largest > first ? pow(largest / first, -b) : 1.0;
    return fmax(share * c[LOADING_STIFFNESS],
                points_most(c, points_size(c, at), largest) / largest);
}

static void points_start(const double *c, double *h) {
    for (int i = 0; i < 2; i++) {
        h[POINTS_LARGEST + i] = h[POINTS_COUNTED + i] = points_first(c, i);
    }
}

static void points_turn(const double *c, double *h) {
    const double drift = h[LOADING_DRIFT], shear = h[LOADING_SHEAR];
    const double own = c[POINTS_ORIGIN] != 0.0 && shear > 0.0
                           ? 0.0
                           : points_slope(c, points_side(h), h[POINTS_LARGEST + points_side(h)]);
    const double to_origin = drift > 0.0 ? shear / drift : 0.0;
    // The path may be steeper than the line down from its end, which would make energy.
    const double path = loading_path_slope(&points_rule, h);
    h[LOADING_SLOPE] = fmin(fmax(fmax(own, path), to_origin), c[LOADING_STIFFNESS]);
}

// What the other direction has done to the target of side `at`.
static void points_damage(const double *c, double *h, int at) {
    const double other = h[POINTS_LARGEST + !at], first = points_first(c, !at);
    if (other <= first) {
        return;
    }
    double damage = c[POINTS_DAMAGE_ENERGY] * h[POINTS_ENERGY];
    if (c[POINTS_EVERY] != 0.0 || other > h[POINTS_COUNTED + !at]) {
        damage += c[POINTS_DAMAGE_PEAK] * (other - first) / first;
        h[POINTS_COUNTED + !at] = other;
    }
    // Only drifts that are reached later do damage of their own: targets would grow without end.
    const double target = h[POINTS_LARGEST + at] * (1.0 + damage);
    h[POINTS_LARGEST + at] = h[POINTS_COUNTED + at] = fmin(target, FAR * points_first(c, at));
}

static void points_enter(const double *c, double *h) {
    const int at = points_side(h);
    h[POINTS_ENERGY] += h[LOADING_WORK];
    points_damage(c, h, at);
    const double size = points_size(c, at);
    h[LOADING_SLOPE] = points_slope(c, at, h[POINTS_LARGEST + at]);
    struct loading_line line[LOADING_LINES_MAX];
    const double z = h[LOADING_DRIFT], target = h[POINTS_LARGEST + at];
    int n = 0;
    if (z < target) {
        const double most = points_most(c, size, target), low = c[POINTS_PINCH_SHEAR] * most;
        const double back = target - (most - low) / h[LOADING_SLOPE];
        const double way = c[POINTS_PINCH_DRIFT] * (back - z);
        line[n++] = (struct loading_line){z, 0.0, most / (target - z)};
        if (way > 0.0 && z + way < target) {
            line[0].slope = low / way;
            line[n++] = (struct loading_line){z + way, low, (most - low) / (target - z - way)};
        }
    }
    n += points_backbone(c, size, fmax(z, target), line + n);
    loading_follow(&points_rule, h, line, n);
}

static void points_arrive(const double *c, double *h) {
    (void)c;
    double *largest = &h[POINTS_LARGEST + points_side(h)];
    *largest = fmax(*largest, h[LOADING_DRIFT]);
}

const struct loading_rule points_rule = {
    .path = POINTS_PATH,
    .start = points_start,
    .turn = points_turn,
    .enter = points_enter,
    .arrive = points_arrive,
};
