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
#include "solve/dp.h"

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

// v = v0 + h times the sum of the first n accelerations a and u = u0 + c v0 + h^2 times theirs.
// Where this is expanded n is a constant, so that the compiler makes one loop in lanes of it.
static inline void combine(int n, const struct sums *s, const double *const *a, double h, int n_dof,
                           double c, const double *restrict u0, const double *restrict v0,
                           double *restrict u, double *restrict v) {
    const double *restrict a0 = a[0], *restrict a1 = a[1], *restrict a2 = a[2];
    const double *restrict a3 = a[3], *restrict a4 = a[4], *restrict a5 = a[5];
    double v_0 = s->v[0], v_1 = s->v[1], v_2 = s->v[2], v_3 = s->v[3], v_4 = s->v[4];
    double u_0 = s->u[0], u_1 = s->u[1], u_2 = s->u[2], u_3 = s->u[3], u_4 = s->u[4];
    double v_5 = s->v[5], u_5 = s->u[5];
    double h2 = h * h;
    for (int i = 0, end = lanes_whole(n_dof); i < end; i++) {
        double to_v = v_0 * a0[i];
        double to_u = u_0 * a0[i];
        to_v += n > 1 ? v_1 * a1[i] : 0.0;
        to_u += n > 1 ? u_1 * a1[i] : 0.0;
        to_v += n > 2 ? v_2 * a2[i] : 0.0;
        to_u += n > 2 ? u_2 * a2[i] : 0.0;
        to_v += n > 3 ? v_3 * a3[i] : 0.0;
        to_u += n > 3 ? u_3 * a3[i] : 0.0;
        to_v += n > 4 ? v_4 * a4[i] : 0.0;
        to_u += n > 4 ? u_4 * a4[i] : 0.0;
        to_v += n > 5 ? v_5 * a5[i] : 0.0;
        to_u += n > 5 ? u_5 * a5[i] : 0.0;
        v[i] = v0[i] + h * to_v;
        u[i] = u0[i] + (c * v0[i] + h2 * to_u);
    }
}

typedef void combine_fn(const struct sums *s, const double *const *a, double h, int n_dof, double c,
                        const double *u0, const double *v0, double *u, double *v);

LANES static void combine_1(const struct sums *s, const double *const *a, double h, int n_dof,
                            double c, const double *u0, const double *v0, double *u, double *v) {
    combine(1, s, a, h, n_dof, c, u0, v0, u, v);
}

LANES static void combine_2(const struct sums *s, const double *const *a, double h, int n_dof,
                            double c, const double *u0, const double *v0, double *u, double *v) {
    combine(2, s, a, h, n_dof, c, u0, v0, u, v);
}

LANES static void combine_3(const struct sums *s, const double *const *a, double h, int n_dof,
                            double c, const double *u0, const double *v0, double *u, double *v) {
    combine(3, s, a, h, n_dof, c, u0, v0, u, v);
}

LANES static void combine_4(const struct sums *s, const double *const *a, double h, int n_dof,
                            double c, const double *u0, const double *v0, double *u, double *v) {
    combine(4, s, a, h, n_dof, c, u0, v0, u, v);
}

LANES static void combine_5(const struct sums *s, const double *const *a, double h, int n_dof,
                            double c, const double *u0, const double *v0, double *u, double *v) {
    combine(5, s, a, h, n_dof, c, u0, v0, u, v);
}

LANES static void combine_6(const struct sums *s, const double *const *a, double h, int n_dof,
                            double c, const double *u0, const double *v0, double *u, double *v) {
    combine(6, s, a, h, n_dof, c, u0, v0, u, v);
}

static combine_fn *const combine_terms[TERMS_MAX + 1] = {NULL,      combine_1, combine_2, combine_3,
                                                         combine_4, combine_5, combine_6};

// The sums over the stages' accelerations.
static void sum_stages(const struct dp *p, const struct sums *s, double c, const double *u0,
                       const double *v0, double *u, double *v) {
    combine_terms[s->n](s, p->term[s->terms], p->h, p->model->n_dof, c, u0, v0, u, v);
}

void dp_stages_bind(struct dp *p) {
    for (int s = 0; s < DP_STAGES; s++) {
        p->term[DP_ALL][s] = p->stage[s].a;
    }
    for (int s = 0; s + 1 < DP_STAGES; s++) {
        p->term[DP_BUT_SECOND][s] = p->stage[s == 0 ? 0 : s + 1].a;
    }
}

void dp_stages_take(struct dp *p, double h, double end) {
    p->h = h;
    p->next.time = end;
    for (int s = 1; s < DP_STAGES; s++) {
        struct dp_rates *stage = &p->stage[s];
        sum_stages(p, &stage_sums[s], node[s] * h, p->now.u, p->now.v, stage->u, stage->v);
        dp_system_rates(&p->system, &p->now, node[s] == 1.0 ? end : p->now.time + node[s] * h,
                        stage);
    }
}

void dp_stages_gaps(const struct model *m, struct state *s, double *rate) {
    const double *restrict u = s->u;
    const double *restrict v = s->v;
    for (int k = 0; k < m->n_link; k++) {
        const struct link *l = &m->link[k];
        static_assert(WALL == -1, "a wall is the zero in front of an array");
        s->delta[k] = u[l->dof[0]] - u[l->dof[1]] - l->gap;
        rate[k] = v[l->dof[0]] - v[l->dof[1]];
    }
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
    dp_stages_gaps(p->model, next, p->rate[1]);
    memset(next->force, 0, (size_t)p->model->n_link * sizeof *next->force);
    for (int i = 0; i < p->now.n_live; i++) {
        next->force[p->now.live[i]] = p->stage[DP_STAGES - 1].force[i];
    }
}

// The Hermite polynomial of degree 5 and its slope: sums over what is known at both ends.
void dp_stages_between(const struct dp *p, double x, double *u, double *v) {
    const struct state *now = &p->now;
    const struct state *next = &p->next;
    double h = p->h;
    double y = 1.0 - x;
    double x2 = x * x;
    double y2 = y * y;
    double rise = x2 * x * (10.0 + x * (6.0 * x - 15.0));
    double slope = 30.0 * x2 * y2 / h;
    const double *const of[] = {now->u, now->v, now->a, next->u, next->v, next->a};
    const struct sums sums = {
        .u = {1.0 - rise, h * x * y2 * y * (1.0 + 3.0 * x), h * h * x2 * y2 * y / 2.0, rise,
              -h * x2 * x * y * (1.0 + 3.0 * y), h * h * x2 * x * y2 / 2.0},
        .v = {-slope, y2 * (1.0 + x * (2.0 - 15.0 * x)), h * x * y2 * (2.0 - 5.0 * x) / 2.0, slope,
              x2 * (1.0 + y * (2.0 - 15.0 * y)), -h * x2 * y * (2.0 - 5.0 * y) / 2.0},
    };
    combine_6(&sums, of, 1.0, p->model->n_dof, 0.0, p->zero, p->zero, u, v);
}

// Errors in u and v over their sizes; the larger one takes the place of that in u.
LANES static void scale_errors(int n, const double *restrict scale_u,
                               const double *restrict scale_v, double *restrict u,
                               const double *restrict v) {
    for (int i = 0, end = lanes_whole(n); i < end; i++) {
        double of_u = fabs(u[i]) * scale_u[i];
        double of_v = fabs(v[i]) * scale_v[i];
        u[i] = of_v > of_u ? of_v : of_u;
    }
}

double dp_stages_error(struct dp *p) {
    double largest = 0.0;
    double sum = 0.0;
    int n = p->model->n_dof;
    sum_stages(p, &error_sums, 0.0, p->zero, p->zero, p->error_u, p->error_v);
    scale_errors(n, p->scales.over_u, p->scales.over_v, p->error_u, p->error_v);
    for (int i = 0; i < n; i++) {
        double error = p->error_u[i];
        largest = error > largest ? error : largest;
        sum += error;
    }
    return isfinite(sum) ? largest / p->model->control.tolerance : INFINITY;
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
