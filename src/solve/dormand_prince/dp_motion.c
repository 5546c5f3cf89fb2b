// SPDX-License-Identifier: GPL-3.0-or-later
// The dense output: see dp.h.
#include <math.h>

#include "core/root.h"
#include "solve/dormand_prince/dp.h"

static const double PRECISION = 1e-9;  // of x; the next correction would be about its square

static double dp_motion_at(double x, void *context, double *slope) {
    *slope = dp_motion_slope(context, x);
    return dp_motion_value(context, x);
}

double dp_motion_root(struct polynomial p, double low, double high) {
    double start = dp_motion_value(&p, low);
    double end = dp_motion_value(&p, high);
    if (start == 0.0 || start == end) {
        return low;
    }
    const struct root r = {low, high, end > start ? 1.0 : -1.0};
    return root_newton(dp_motion_at, &p, r, root_between(&r, start, end), PRECISION);
}

struct polynomial dp_motion_velocity(const struct motion *m) {
    double c1 = m->h * m->a[0];
    double end = m->h * m->a[1];
    double rise = m->v[1] - m->v[0];
    return (struct polynomial){
        {m->v[0], c1, 3.0 * rise - 2.0 * c1 - end, c1 + end - 2.0 * rise, 0.0, 0.0}};
}
int dp_motion_extrema(const struct polynomial *p, double *at) {
    double a = 3.0 * p->c[3];
    double b = p->c[2];  // a x^2 + 2 b x + c
    double c = p->c[1];
    bool same_sign = c * (a + 2.0 * b + c) > 0.0;
    if (same_sign && b * (a + b) >= 0.0) {
        return 0;  // it is monotone between ends of one sign
    }
    double square = b * b - a * c;
    if (!(square > 0.0)) {
        return 0;
    }
    double q = -(b + copysign(sqrt(square), b));
    double root[2] = {q / a, c / q};
    if (!(root[0] <= root[1])) {
        double first = root[1];
        root[1] = root[0];
        root[0] = first;
    }
    int n = 0;
    for (int i = 0; i < 2; i++) {
        if (root[i] > 0.0 && root[i] < 1.0) {
            at[n++] = root[i];
        }
    }
    return n;
}

// Instants 0 < x < 1 at which the velocity changes its sign, ascending; returns how many.
static int dp_motion_turns(const struct motion *m, double *at) {
    bool same_sign = m->v[0] * m->v[1] > 0.0;
    if (same_sign && m->v[0] * m->a[0] >= 0.0 && m->v[1] * m->a[1] <= 0.0) {
        return 0;  // no cubic with these ends comes back to zero
    }
    struct polynomial v = dp_motion_velocity(m);
    double end[TURNS_MAX + 1];
    int n_end = dp_motion_extrema(&v, end);
    end[n_end++] = 1.0;
    int n = 0;
    double low = 0.0;
    for (int i = 0; i < n_end; i++) {
        if (dp_motion_value(&v, low) * dp_motion_value(&v, end[i]) < 0.0) {
            double x = dp_motion_root(v, low, end[i]);
            if (x > 0.0 && x < 1.0) {
                at[n++] = x;
            }
        }
        low = end[i];
    }
    return n;
}

struct motion_pieces dp_motion_cut(const struct motion *m) {
    struct motion_pieces s = {.path = dp_motion_path(m), .n = 1};
    s.n += dp_motion_turns(m, s.x + 1);
    s.x[0] = 0.0;
    s.x[s.n] = 1.0;
    s.d[0] = m->d[0];
    s.d[s.n] = m->d[1];
    for (int i = 1; i < s.n; i++) {
        s.d[i] = dp_motion_value(&s.path, s.x[i]);
    }
    return s;
}

struct motion dp_motion_link(const struct dp *p, int k) {
    const struct link *l = &p->model->link[k];
    return (struct motion){
        .d = {p->now.delta[k], p->next.delta[k]},
        .v = {p->rate[0][k], p->rate[1][k]},
        .a = {dp_system_across(l, p->model, p->now.a, p->now.ground_a),
              dp_system_across(l, p->model, p->next.a, p->next.ground_a)},
        .h = p->h,
    };
}

// The ground is the zero in front of the arrays.
struct motion dp_motion_floor(const struct dp *p, int i, int below) {
    const struct state *now = &p->now, *next = &p->next;
    return (struct motion){
        .d = {now->u[i] - now->u[below], next->u[i] - next->u[below]},
        .v = {now->v[i] - now->v[below], next->v[i] - next->v[below]},
        .a = {now->a[i] - now->a[below], next->a[i] - next->a[below]},
        .h = p->h,
    };
}

double dp_motion_noise(const struct dp *p, int k) {
    const struct link *l = &p->model->link[k];
    double size = fabs(l->gap) + p->scales.most_u;  // bodies at rest move by rounding
    for (int i = 0; i < 2; i++) {
        size += fmax(link_size_at(l, i, p->now.u), link_size_at(l, i, p->next.u));
        if (l->moving_ground) {
            size += fabs(p->now.ground_u[p->model->building[l->building[i]].ground]);
        }
    }
    return SCALE_ROUNDING * size;
}

// A motion that goes beyond both its ends does so by a fraction of its way at the larger rate.
LANES void dp_motion_reach(struct dp *p) {
    const double *restrict d0 = p->now.delta, *restrict d1 = p->next.delta;
    const double *restrict v0 = p->rate[0], *restrict v1 = p->rate[1];
    const double *restrict deepest = p->results->deepest;
    double *restrict reach = p->reach;
    double h = p->h;
    int64_t closes = 0;
    int64_t deepens = 0;
    for (int i = 0, n = p->model->n_contact; i < n; i++) {
        double d = d0[i] > d1[i] ? d0[i] : d1[i];
        double v = fabs(v0[i]) > fabs(v1[i]) ? fabs(v0[i]) : fabs(v1[i]);
        double most = d + h * v;
        reach[i] = most;
        closes |= most > 0.0;
        deepens |= most > deepest[i];
    }
    p->closes = closes != 0;
    p->deepens = deepens != 0;
}
