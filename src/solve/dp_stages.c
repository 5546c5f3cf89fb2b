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
//
// Floors are summed in blocks, so that the compiler can use vector instructions.
#include <math.h>

#include "solve/dp.h"
#include "solve/lanes.h"

static const double node[DP_STAGES] = {0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0};

enum { TERMS_MAX = DP_STAGES };
struct sums {
    int n;  // terms
    double v[TERMS_MAX], u[TERMS_MAX];
};

// Rows of A and of A A.
static const struct sums stage_sums[DP_STAGES] = {
    {0},
    {1, {1.0 / 5.0}, {0.0}},
    {2, {3.0 / 40.0, 9.0 / 40.0}, {9.0 / 200.0, 0.0}},
    {3, {44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0}, {-12.0 / 25.0, 4.0 / 5.0, 0.0}},
    {4,
     {19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0},
     {-12248.0 / 6561.0, 7208.0 / 2187.0, -6784.0 / 6561.0, 0.0}},
    {5,
     {9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0},
     {-533.0 / 264.0, 91.0 / 22.0, -56.0 / 33.0, 7.0 / 88.0, 0.0}},
    {6,
     {35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0},
     {35.0 / 384.0, 0.0, 50.0 / 159.0, 25.0 / 192.0, -243.0 / 6784.0, 0.0}},
};

// The difference of the solutions of order 5 and 4.
static const struct sums error_sums = {
    7,
    {71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339200.0, 22.0 / 525.0,
     -1.0 / 40.0},
    {611.0 / 230400.0, 0.0, -514.0 / 83475.0, 391.0 / 38400.0, -4617.0 / 1356800.0, -11.0 / 3360.0,
     0.0},
};

// Sums over the stages' accelerations of some floors from number i on. All are kept in registers.
enum { BLOCK = 4 };
struct block {
    struct lanes v[BLOCK], u[BLOCK];
};

static inline struct block sum_stages(const struct dp *p, const struct sums *s, int i) {
    struct lanes v0 = lanes_of(0.0), v1 = v0, v2 = v0, v3 = v0;
    struct lanes u0 = v0, u1 = v0, u2 = v0, u3 = v0;
    for (int j = 0; j < s->n; j++) {
        const double *a = p->stage[j].a + i;
        struct lanes a0 = lanes_at(a, 0), a1 = lanes_at(a, 1);
        struct lanes a2 = lanes_at(a, 2), a3 = lanes_at(a, 3);
        struct lanes to_v = lanes_of(s->v[j]);
        struct lanes to_u = lanes_of(s->u[j]);
        v0.x += to_v.x * a0.x;
        v1.x += to_v.x * a1.x;
        v2.x += to_v.x * a2.x;
        v3.x += to_v.x * a3.x;
        u0.x += to_u.x * a0.x;
        u1.x += to_u.x * a1.x;
        u2.x += to_u.x * a2.x;
        u3.x += to_u.x * a3.x;
    }
    return (struct block){{v0, v1, v2, v3}, {u0, u1, u2, u3}};
}

static void combine(const struct dp *p, int stage, double h, double *restrict u,
                    double *restrict v) {
    const double *restrict u_start = p->now.u;
    const double *restrict v_start = p->now.v;
    struct lanes drift = lanes_of(node[stage] * h);
    struct lanes h1 = lanes_of(h);
    struct lanes h2 = lanes_of(h * h);
    int n = p->model->n_dof;
    for (int i = 0; i < n; i += BLOCK * LANES) {
        struct block sum = sum_stages(p, &stage_sums[stage], i);
        for (size_t l = 0; l < BLOCK; l++) {
            struct lanes v0 = lanes_at(v_start + i, l);
            struct lanes u0 = lanes_at(u_start + i, l);
            struct lanes v1 = {v0.x + h1.x * sum.v[l].x};
            struct lanes u1 = {u0.x + (drift.x * v0.x + h2.x * sum.u[l].x)};
            lanes_put(v + i, l, v1);
            lanes_put(u + i, l, u1);
        }
    }
}

void dp_stages_take(struct dp *p, double h, double end) {
    p->h = h;
    p->next.time = end;
    for (int s = 1; s < DP_STAGES; s++) {
        bool last = s + 1 == DP_STAGES;
        combine(p, s, h, last ? p->next.u : p->stage_u, last ? p->next.v : p->stage_v);
        dp_system_rates(&p->system, &p->now, node[s] == 1.0 ? end : p->now.time + node[s] * h,
                        &p->stage[s]);
    }
}

// fmax without its care for NaN, which costs half the time of what follows.
static double larger(double x, double y) {
    return y > x ? y : x;
}

void dp_stages_ends(struct dp *p) {
    const struct model *m = p->model;
    struct state *next = &p->next;
    for (int i = 0; i < m->n_dof; i++) {
        next->drift[i] = next->u[i] - (p->system.below[i] < 0 ? 0.0 : next->u[p->system.below[i]]);
    }
    for (int k = 0; k < m->n_link; k++) {
        const struct link *l = &m->link[k];
        next->delta[k] = state_gap(l, m, next->u, next->ground_u) - l->gap;
        next->rate[k] = state_gap(l, m, next->v, next->ground_v);
        next->force[k] = 0.0;
    }
    for (int i = 0; i < p->system.n_active; i++) {
        next->force[p->system.active[i]] = p->stage[DP_STAGES - 1].force[i];
    }
}

// A building that has hardly moved yet is measured by a hundredth of what others have: without
// that, the first touch of a building at rest would take endless steps.
static const double SHARE = 1e-2;

// The larger of the errors of building k in u and v, each over its size; infinite where they are
// not finite.
static double building_error(const struct dp *p, int k) {
    const struct building *g = &p->model->building[k];
    double u_size = fmax(p->largest_u[k], SHARE * p->most_u);
    double v_size = fmax(p->largest_v[k], SHARE * p->most_v);
    double u_error = 0.0;
    double v_error = 0.0;
    double sum = 0.0;
    for (int i = g->first; i < g->first + g->n_floor; i++) {
        double u = p->error_u[i];
        double v = p->error_v[i];
        sum += u + v;
        u_error = larger(u_error, fabs(u));
        v_error = larger(v_error, fabs(v));
        u_size = larger(u_size, fabs(p->next.u[i]));
        v_size = larger(v_size, fabs(p->next.v[i]));
    }
    double u = u_error == 0.0 ? 0.0 : p->h * p->h * u_error / u_size;
    double v = v_error == 0.0 ? 0.0 : p->h * v_error / v_size;
    return isfinite(sum) ? larger(u, v) : INFINITY;
}

double dp_stages_error(struct dp *p) {
    double largest = 0.0;
    for (int i = 0; i < p->model->n_dof; i += BLOCK * LANES) {
        struct block error = sum_stages(p, &error_sums, i);
        for (size_t l = 0; l < BLOCK; l++) {
            lanes_put(p->error_u + i, l, error.u[l]);
            lanes_put(p->error_v + i, l, error.v[l]);
        }
    }
    for (int k = 0; k < p->model->n_building; k++) {
        largest = larger(largest, building_error(p, k));
    }
    return largest / p->model->control.tolerance;
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
