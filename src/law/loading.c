// SPDX-License-Identifier: GPL-3.0-or-later
#include "law/loading.h"

#include <assert.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

// Rounding of a shear on a line, relative to the shear.
static const double ROUNDING = 1e-13;

static inline struct loading_line loading_line_at(const struct loading_rule *rule, const double *h,
                                                  int i) {
    const double *p = h + rule->path + (ptrdiff_t)3 * i;
    return (struct loading_line){p[0], p[1], p[2]};
}

static inline double loading_line_shear(const struct loading_line *l, double drift) {
    return l->shear + l->slope * (drift - l->drift);
}

static void loading_add(const struct loading_rule *rule, double *h, double drift, double shear,
                        double slope) {
    const int n = (int)h[LOADING_N];
    assert(n < LOADING_LINES_MAX);
    double *p = h + rule->path + (ptrdiff_t)3 * n;
    p[0] = drift;
    p[1] = shear;
    p[2] = slope;
    h[LOADING_N] = n + 1;
}

double loading_path_slope(const struct loading_rule *rule, const double *h) {
    return loading_line_at(rule, h, (int)h[LOADING_AT]).slope;
}

// Copies what the history says; behind the last line it says nothing.
static inline void loading_copy(const struct loading_rule *rule, const double *h, double *to) {
    const int n = rule->path + 3 * (int)h[LOADING_N];
    memcpy(to, h, (size_t)n * sizeof *to);
}

// Where the line of slope `slope` through (*drift, shear), which lies below line *i, meets the
// lines; *i becomes the line it meets. False: nowhere.
static bool loading_meet(const struct loading_line *line, int n, int *i, double *drift,
                         double shear, double slope) {
    for (; *i < n; ++*i) {
        const struct loading_line *l = &line[*i];
        const double end = *i + 1 < n ? line[*i + 1].drift : INFINITY;
        const double above = loading_line_shear(l, *drift) - shear;
        const double way = l->slope < slope ? above / (slope - l->slope) : INFINITY;
        // A line may begin with a jump downwards.
        const double meet = fmax(*drift + way, l->drift);
        if (meet < end) {
            *drift = meet;
            return true;
        }
    }
    return false;
}

void loading_follow(const struct loading_rule *rule, double *h, const struct loading_line *line,
                    int n) {
    const double slope = h[LOADING_SLOPE];
    double drift = h[LOADING_DRIFT], shear = h[LOADING_SHEAR];
    h[LOADING_N] = h[LOADING_AT] = 0.0;
    int i = 0;
    while (i + 1 < n && line[i + 1].drift <= drift) {
        i++;
    }
    while (i < n) {
        const double on = loading_line_shear(&line[i], drift);
        const bool below = shear < on - ROUNDING * fabs(on);
        if (!below && line[i].slope <= slope) {
            loading_add(rule, h, drift, on, line[i].slope);
            i++;
            if (i < n) {
                shear = loading_line_shear(&line[i - 1], line[i].drift);
                drift = line[i].drift;
            }
        } else {
            loading_add(rule, h, drift, shear, slope);
            if (!loading_meet(line, n, &i, &drift, shear, slope)) {
                return;
            }
            shear = loading_line_shear(&line[i], drift);
        }
    }
}

// The line of the path at `drift`, from the anchor on.
static inline int loading_find(const struct loading_rule *rule, const double *h, double drift) {
    const int n = (int)h[LOADING_N];
    int i = (int)h[LOADING_AT];
    while (i + 1 < n && h[rule->path + 3 * (i + 1)] <= drift) {
        i++;
    }
    return i;
}

// Moves the anchor of history h along the path to `drift`, and stores it in `after`, which has a
// copy of h or is h.
static struct storey_response loading_advance(const struct loading_rule *rule, const double *c,
                                              const double *h, double drift, double *after) {
    const double side = h[LOADING_SIDE], anchor = h[LOADING_DRIFT];
    const int to = loading_find(rule, h, drift);
    double work = h[LOADING_WORK], shear = 0.0;
    struct loading_line l = {0};
    for (int i = (int)h[LOADING_AT]; i <= to; i++) {
        l = loading_line_at(rule, h, i);
        const double end = i < to ? h[rule->path + 3 * (i + 1)] : drift;
        const double from = l.drift > anchor ? l.drift : anchor;
        const double mean = loading_line_shear(&l, (from + end) / 2.0);
        work += mean * (end - from);
        shear = loading_line_shear(&l, end);
    }
    after[LOADING_WORK] = work;
    after[LOADING_SHEAR] = shear;
    after[LOADING_DRIFT] = drift;
    after[LOADING_AT] = to;
    after[LOADING_TURNED] = 0.0;
    if (rule->arrive) {
        rule->arrive(c, after);
    }
    return (struct storey_response){side * shear, l.slope};
}

static void loading_turn(const struct loading_rule *rule, const double *c, double *h) {
    h[LOADING_TURNED] = 1.0;
    const double slope = h[LOADING_SLOPE];
    if (rule->turn) {
        rule->turn(c, h);
    }
    if (h[LOADING_SLOPE] != slope) {
        struct loading_line line[LOADING_LINES_MAX];
        const int at = (int)h[LOADING_AT], n = (int)h[LOADING_N] - at;
        for (int i = 0; i < n; i++) {
            line[i] = loading_line_at(rule, h, at + i);
        }
        loading_follow(rule, h, line, n);
    }
}

// From the anchor down to zero shear, and to the other side.
static void loading_cross(const struct loading_rule *rule, const double *c, double *h) {
    const double down = h[LOADING_SHEAR] / h[LOADING_SLOPE];
    h[LOADING_WORK] -= h[LOADING_SHEAR] * down / 2.0;
    h[LOADING_DRIFT] = down - h[LOADING_DRIFT];
    h[LOADING_SHEAR] = 0.0;
    h[LOADING_SIDE] = -h[LOADING_SIDE];
    h[LOADING_TURNED] = 0.0;
    rule->enter(c, h);
    h[LOADING_WORK] = 0.0;
}

static void loading_start(const struct loading_rule *rule, const double *c, double side,
                          double *h) {
    memset(h, 0, (size_t)(rule->path + LOADING_PATH_SIZE) * sizeof *h);
    h[LOADING_SIDE] = side;
    h[LOADING_SLOPE] = c[LOADING_STIFFNESS];
    rule->start(c, h);
    rule->enter(c, h);
}

// The response from history h, which is changed: the storey unloads to `drift` from its path, or
// beyond the path of this side.
static struct storey_response loading_leave(const struct loading_rule *rule, const double *c,
                                            double *h, double drift) {
    const double along = h[LOADING_SIDE] * drift;
    if (h[LOADING_TURNED] == 0.0) {
        loading_turn(rule, c, h);
    }
    const double slope = h[LOADING_SLOPE];
    const double shear = h[LOADING_SHEAR] + slope * (along - h[LOADING_DRIFT]);
    if (shear > 0.0) {
        return (struct storey_response){h[LOADING_SIDE] * shear, slope};
    }
    loading_cross(rule, c, h);
    return loading_advance(rule, c, h, fmax(h[LOADING_SIDE] * drift, h[LOADING_DRIFT]), h);
}

// Before the first yield: `to` becomes the history.
static struct storey_response loading_first(const struct loading_rule *rule, const double *c,
                                            double drift, double *to) {
    const bool left = drift < 0.0;
    const double yield = c[left ? LOADING_YIELD_LEFT : LOADING_YIELD];
    if (fabs(drift) <= yield) {
        to[LOADING_SIDE] = 0.0;
        return (struct storey_response){c[LOADING_STIFFNESS] * drift, c[LOADING_STIFFNESS]};
    }
    loading_start(rule, c, left ? -1.0 : 1.0, to);
    return loading_advance(rule, c, to, fabs(drift), to);
}

struct storey_response loading_respond(const struct loading_rule *rule, const double *c,
                                       const double *h, double drift, double *after) {
    double own[STOREY_HISTORY_MAX];
    double *to = after ? after : own;
    if (h[LOADING_SIDE] == 0.0) {
        return loading_first(rule, c, drift, to);
    }
    const double along = h[LOADING_SIDE] * drift;
    if (along >= h[LOADING_DRIFT]) {
        if (!after) {
            const struct loading_line l = loading_line_at(rule, h, loading_find(rule, h, along));
            return (struct storey_response){h[LOADING_SIDE] * loading_line_shear(&l, along),
                                            l.slope};
        }
        if (after != h) {
            loading_copy(rule, h, after);
        }
        return loading_advance(rule, c, h, along, after);
    }
    const double slope = h[LOADING_SLOPE];
    const double shear = h[LOADING_SHEAR] + slope * (along - h[LOADING_DRIFT]);
    const bool unloads = h[LOADING_TURNED] != 0.0 && shear > 0.0;
    if (to != h && (after || !unloads)) {
        loading_copy(rule, h, to);
    }
    return unloads ? (struct storey_response){h[LOADING_SIDE] * shear, slope}
                   : loading_leave(rule, c, to, drift);
}

// What unloading would give back.
double loading_stored(const struct loading_rule *rule, const double *c, const double *h,
                      double drift) {
    double after[STOREY_HISTORY_MAX] = {0};
    const double shear = loading_respond(rule, c, h, drift, after).shear;
    if (after[LOADING_SIDE] == 0.0) {
        return c[LOADING_STIFFNESS] * drift * drift / 2.0;
    }
    if (after[LOADING_TURNED] == 0.0) {
        loading_turn(rule, c, after);
    }
    return shear * shear / (2.0 * after[LOADING_SLOPE]);
}
