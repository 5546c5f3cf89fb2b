// SPDX-License-Identifier: GPL-3.0-or-later
// Dormand & Prince (1980), J. Comp. Appl. Math. 6, 19-26: seven stages of order 5 with an error
// estimate of order 4; the last stage is the first of the next step. Coefficients as in Hairer,
// Norsett & Wanner (1993), Solving Ordinary Differential Equations I, table II.5.2.
//
// As u' = v, the stages of u need no velocities of other stages: with the coefficients A of the
// method and Q = A A,
//     V_s = v + h sum A_sj a_j,    U_s = u + c_s h v + h^2 sum Q_sj a_j,
// which is the same method with half the sums (ibid., section II.14). The error estimates h E and
// h^2 (E A) follow in the same way.
#include <assert.h>
#include <math.h>
#include <string.h>

#include "core/lanes.h"
#include "core/number.h"
#include "solve/dp.h"
#include "solve/dp_floors.h"

static const double node[DP_STAGES] = {0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0};

// Sums over the accelerations of n stages.
enum { TERMS_MAX = 6 };
struct sums {
    int n;
    enum dp_terms terms;
    double v[TERMS_MAX], u[TERMS_MAX];
};

// Rows of A and of A A.
static const struct sums stage_sums[DP_STAGES] = {
    {0},
    {1, DP_ALL, {1.0 / 5.0}, {0.0}},
    {2, DP_ALL, {3.0 / 40.0, 9.0 / 40.0}, {9.0 / 200.0, 0.0}},
    {3, DP_ALL, {44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0}, {-12.0 / 25.0, 4.0 / 5.0, 0.0}},
    {4,
     DP_ALL,
     {19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0},
     {-12248.0 / 6561.0, 7208.0 / 2187.0, -6784.0 / 6561.0, 0.0}},
    {5,
     DP_ALL,
     {9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0},
     {-533.0 / 264.0, 91.0 / 22.0, -56.0 / 33.0, 7.0 / 88.0, 0.0}},
    {5,
     DP_BUT_SECOND,
     {35.0 / 384.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0},
     {35.0 / 384.0, 50.0 / 159.0, 25.0 / 192.0, -243.0 / 6784.0, 0.0}},
};

// The difference of the solutions of order 5 and 4.
static const struct sums error_sums = {
    6,
    DP_BUT_SECOND,
    {71.0 / 57600.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339200.0, 22.0 / 525.0,
     -1.0 / 40.0},
    {611.0 / 230400.0, -514.0 / 83475.0, 391.0 / 38400.0, -4617.0 / 1356800.0, -11.0 / 3360.0, 0.0},
};

// v = v0 + h times the sum of the first n accelerations a, and u = u0 + c v0 + h^2 times theirs, of
// which the last one has no share. Where this is expanded n is a constant, so that the compiler
// makes one loop in lanes of it.
LANES_INLINE void combine(int n, const struct sums *s, const double *const *a, double h, int n_dof,
                          double c, const double *u0, const double *v0, double *u, double *v) {
    const double *a0 = a[0], *a1 = a[1], *a2 = a[2], *a3 = a[3], *a4 = a[4], *a5 = a[5];
    double v_0 = s->v[0], v_1 = s->v[1], v_2 = s->v[2], v_3 = s->v[3], v_4 = s->v[4];
    double u_0 = s->u[0], u_1 = s->u[1], u_2 = s->u[2], u_3 = s->u[3], u_4 = s->u[4];
    double v_5 = s->v[5];
    double h2 = h * h;
    LANES_LOOP
    for (int i = 0, end = lanes_whole(n_dof); i < end; i++) {
        double to_v = v_0 * a0[i];
        double to_u = n > 1 ? u_0 * a0[i] : 0.0;
        to_v += n > 1 ? v_1 * a1[i] : 0.0;
        to_u += n > 2 ? u_1 * a1[i] : 0.0;
        to_v += n > 2 ? v_2 * a2[i] : 0.0;
        to_u += n > 3 ? u_2 * a2[i] : 0.0;
        to_v += n > 3 ? v_3 * a3[i] : 0.0;
        to_u += n > 4 ? u_3 * a3[i] : 0.0;
        to_v += n > 4 ? v_4 * a4[i] : 0.0;
        to_u += n > 5 ? u_4 * a4[i] : 0.0;
        to_v += n > 5 ? v_5 * a5[i] : 0.0;
        v[i] = v0[i] + h * to_v;
        u[i] = u0[i] + (n > 1 ? c * v0[i] + h2 * to_u : c * v0[i]);
    }
}

void dp_stages_bind(struct dp *p) {
    for (int s = 0; s < DP_STAGES; s++) {
        p->term[DP_ALL][s] = p->stage[s].a;
    }
    for (int s = 0; s + 1 < DP_STAGES; s++) {
        p->term[DP_BUT_SECOND][s] = p->stage[s == 0 ? 0 : s + 1].a;
    }
}

// Stage number s of the step, at time t.
LANES_INLINE void take_stage(struct dp *p, int s, double t) {
    const struct sums *sums = &stage_sums[s];
    struct dp_rates *r = &p->stage[s];
    combine(sums->n, sums, p->term[sums->terms], p->h, p->model->n_dof, node[s] * p->h, p->now.u,
            p->now.v, r->u, r->v);
    dp_floors_rates(&p->system, dp_system_ground(&p->system, t, r), r);
    dp_system_add(&p->system, &p->now, t, r);
}

LANES static void take_stages(struct dp *p) {
    double start = p->now.time;
    take_stage(p, 1, start + node[1] * p->h);
    take_stage(p, 2, start + node[2] * p->h);
    take_stage(p, 3, start + node[3] * p->h);
    take_stage(p, 4, start + node[4] * p->h);
    take_stage(p, 5, p->next.time);
    take_stage(p, 6, p->next.time);
}

void dp_stages_take(struct dp *p, double h, double end) {
    p->h = h;
    p->next.time = end;
    take_stages(p);
}

// The differences of u and v over the links, a run of links at a time.
LANES static void differences(const struct gaps *g, const double *restrict u,
                              const double *restrict v, double *restrict delta,
                              double *restrict rate) {
    for (int i = 0; i < g->n_run; i++) {
        const struct gap_run *r = &g->run[i];
        for (int j = 0; j < r->n; j++) {
            delta[r->first + j] = u[r->left + j] - u[r->right + j] - g->gap[r->first + j];
            rate[r->first + j] = v[r->left + j] - v[r->right + j];
        }
    }
}

void dp_stages_gaps(const struct dp *p, struct state *s, double *rate) {
    const struct model *m = p->model;
    differences(&p->gaps, s->u, s->v, s->delta, rate);
    for (int k = 0; m->n_ground > 1 && k < m->n_link; k++) {
        s->delta[k] = state_gap(&m->link[k], m, s->u, s->ground_u) - m->link[k].gap;
        rate[k] = state_rate(s, m, k);
    }
}

LANES static void drifts(const struct chain *c, const double *restrict u, double *restrict drift) {
    const double *restrict joint = c->joint;
    for (int i = 0, end = lanes_whole(c->n); i < end; i++) {
        drift[i] = u[i] - joint[i] * u[i - 1];
    }
}

void dp_stages_ends(struct dp *p) {
    struct state *next = &p->next;
    drifts(&p->model->chain, next->u, next->drift);
    dp_stages_gaps(p, next, p->rate[1]);
}

enum { ENDS = 6 };

// u and v as sums over what is known at both ends.
LANES static void sum_ends(int n, const double *const *of, const double *to_u, const double *to_v,
                           double *restrict u, double *restrict v) {
    for (int i = 0, end = lanes_whole(n); i < end; i++) {
        u[i] = v[i] = 0.0;
        for (int q = 0; q < ENDS; q++) {
            u[i] += to_u[q] * of[q][i];
            v[i] += to_v[q] * of[q][i];
        }
    }
}

// The Hermite polynomial of degree 5 and its slope.
void dp_stages_between(const struct dp *p, double x, double *u, double *v) {
    const struct state *now = &p->now;
    const struct state *next = &p->next;
    double h = p->h;
    double y = 1.0 - x;
    double x2 = x * x;
    double y2 = y * y;
    double rise = x2 * x * (10.0 + x * (6.0 * x - 15.0));
    double slope = 30.0 * x2 * y2 / h;
    const double *const of[ENDS] = {now->u, now->v, now->a, next->u, next->v, next->a};
    const double to_u[ENDS] = {
        1.0 - rise, h * x * y2 * y * (1.0 + 3.0 * x),  h * h * x2 * y2 * y / 2.0,
        rise,       -h * x2 * x * y * (1.0 + 3.0 * y), h * h * x2 * x * y2 / 2.0};
    const double to_v[ENDS] = {
        -slope, y2 * (1.0 + x * (2.0 - 15.0 * x)), h * x * y2 * (2.0 - 5.0 * x) / 2.0,
        slope,  x2 * (1.0 + y * (2.0 - 15.0 * y)), -h * x2 * y * (2.0 - 5.0 * y) / 2.0};
    sum_ends(p->model->n_dof, of, to_u, to_v, u, v);
}

// The larger one of the errors of a floor in u and v over their sizes, of all floors. Numbers that
// are not negative stand in the order of their bits, and what is not a number stands above all.
LANES static double largest_error(const struct dp *p) {
    double *u = p->error_u, *v = p->error_v;
    const double *scale_u = p->scales.over_u, *scale_v = p->scales.over_v;
    int n_dof = p->model->n_dof;
    combine(error_sums.n, &error_sums, p->term[error_sums.terms], p->h, n_dof, 0.0, p->zero,
            p->zero, u, v);
    int64_t largest = 0;
    for (int i = 0, end = lanes_whole(n_dof); i < end; i++) {
        int64_t of_u = number_bits(u[i] * scale_u[i]) & INT64_MAX;
        int64_t of_v = number_bits(v[i] * scale_v[i]) & INT64_MAX;
        of_u = of_u > of_v ? of_u : of_v;
        largest = of_u > largest ? of_u : largest;
    }
    double error;
    memcpy(&error, &largest, sizeof error);
    return error;
}

double dp_stages_error(const struct dp *p) {
    double largest = largest_error(p);
    return isfinite(largest) ? largest / p->model->control.tolerance : INFINITY;
}

const double dp_stages_whole[DP_STAGES] = {
    35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0, 0.0};

// The continuous extension of order 4: Shampine (1986), Math. Comp. 46, 135-150; here as in Hairer,
// Norsett & Wanner, eq. II.6.12.
void dp_stages_weights(double x, double *weight) {
    const double *b = dp_stages_whole;
    double rise = x * x * (3.0 - 2.0 * x);
    double bump = x * x * (x - 1.0) * (x - 1.0);
    weight[0] = rise * b[0] + x * (x - 1.0) * (x - 1.0) -
                bump * 5.0 * (2558722523.0 - 31403016.0 * x) / 11282082432.0;
    weight[1] = 0.0;
    weight[2] = rise * b[2] + bump * 100.0 * (882725551.0 - 15701508.0 * x) / 32700410799.0;
    weight[3] = rise * b[3] - bump * 25.0 * (443332067.0 - 31403016.0 * x) / 1880347072.0;
    weight[4] = rise * b[4] + bump * 32805.0 * (23143187.0 - 3489224.0 * x) / 199316789632.0;
    weight[5] = rise * b[5] - bump * 55.0 * (29972135.0 - 7076736.0 * x) / 822651844.0;
    weight[6] = x * x * (x - 1.0) + bump * 10.0 * (7414447.0 - 829305.0 * x) / 29380423.0;
}
