// SPDX-License-Identifier: GPL-3.0-or-later
// What a step does with every floor, on vectors of one width: see floor_vectors.h. DP_FLOORS is the
// name of what the functions make up.
//
// Dormand & Prince (1980), J. Comp. Appl. Math. 6, 19-26: seven stages of order 5 with an error
// estimate of order 4; the last stage is the first of the next step. Coefficients as in Hairer,
// Norsett & Wanner (1993), Solving Ordinary Differential Equations I, table II.5.2.
//
// As u' = v, the stages of u need no velocities of other stages: with the coefficients A of the
// method and Q = A A,
//     V_s = v + h sum A_sj a_j,    U_s = u + c_s h v + h^2 sum Q_sj a_j,
// which is the same method with half the sums (ibid., section II.14). The error estimates h E and
// h^2 (E A) follow in the same way.
#ifndef JOSTLE_DP_FLOORS_H
#define JOSTLE_DP_FLOORS_H

#include <string.h>

#include "solve/dormand_prince/dp.h"
#include "solve/floors/floor_vectors.h"

// The stages that sums go over: the first ones, or those that the solution is made of.
enum terms { ALL_BEFORE, BUT_SECOND };

// Weights of the accelerations of n stages in the sums for v and for u, in which the last one has
// no share.
enum { TERMS_MAX = 6 };
struct sums {
    int n;
    enum terms terms;
    double v[TERMS_MAX], u[TERMS_MAX];
};

static const double node[DP_STAGES] = {0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0};

// Rows of A and of A A.
static const struct sums stage_sums[DP_STAGES] = {
    {0},
    {1, ALL_BEFORE, {1.0 / 5.0}, {0.0}},
    {2, ALL_BEFORE, {3.0 / 40.0, 9.0 / 40.0}, {9.0 / 200.0, 0.0}},
    {3, ALL_BEFORE, {44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0}, {-12.0 / 25.0, 4.0 / 5.0, 0.0}},
    {4,
     ALL_BEFORE,
     {19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0},
     {-12248.0 / 6561.0, 7208.0 / 2187.0, -6784.0 / 6561.0, 0.0}},
    {5,
     ALL_BEFORE,
     {9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0},
     {-533.0 / 264.0, 91.0 / 22.0, -56.0 / 33.0, 7.0 / 88.0, 0.0}},
    {5,
     BUT_SECOND,
     {35.0 / 384.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0},
     {35.0 / 384.0, 50.0 / 159.0, 25.0 / 192.0, -243.0 / 6784.0, 0.0}},
};

// The difference of the solutions of order 5 and 4.
static const struct sums error_sums = {
    6,
    BUT_SECOND,
    {71.0 / 57600.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339200.0, 22.0 / 525.0,
     -1.0 / 40.0},
    {611.0 / 230400.0, -514.0 / 83475.0, 391.0 / 38400.0, -4617.0 / 1356800.0, -11.0 / 3360.0, 0.0},
};

// The accelerations that sums go over.
LANES_INLINE void dp_gather(const struct dp *p, const struct sums *s, const double **a) {
    for (int j = 0; j < s->n; j++) {
        a[j] = p->stage[s->terms == BUT_SECOND && j > 0 ? j + 1 : j].a;
    }
}

struct motion_part {
    floor_lanes u, v;
};

// The sums of the floors from i on. Where this is expanded n is a constant. The last
// acceleration, for which all else waits, comes last.
LANES_INLINE struct motion_part dp_sum_part(int n, const struct sums *s, const double *const *a,
                                            ptrdiff_t i) {
    struct motion_part sum = {s->u[0] * FLOORS_AT(a[0], i), s->v[0] * FLOORS_AT(a[0], i)};
    for (int j = 1; j < n; j++) {
        if (j + 1 < n) {
            sum.u += s->u[j] * FLOORS_AT(a[j], i);
        }
        sum.v += s->v[j] * FLOORS_AT(a[j], i);
    }
    return sum;
}

// A stage at `to` after the start (u0, v0) of a step of h.
struct stage {
    const struct sums *sums;
    const double *const *a;  // accelerations of the stages before
    const double *u0, *v0;
    double to, h;
};

// The motion at the stage; with n = 0 that at the start.
LANES_INLINE struct motion_part dp_move_part(int n, const struct stage *s, ptrdiff_t i) {
    if (n == 0) {
        return (struct motion_part){FLOORS_AT(s->u0, i), FLOORS_AT(s->v0, i)};
    }
    const double h = s->h, h2 = h * h;
    struct motion_part sum = dp_sum_part(n, s->sums, s->a, i);
    struct motion_part end = {FLOORS_AT(s->u0, i) + s->to * FLOORS_AT(s->v0, i),
                              FLOORS_AT(s->v0, i) + h * sum.v};
    if (n > 1) {
        end.u += h2 * sum.u;
    }
    return end;
}

// Motion and accelerations of the floors from `first` up to `end`, whole lanes, without links,
// loads and what is special, under the ground acceleration `ground`.
LANES_INLINE void dp_take_floors(int n, const struct stage *s, double *const *row, double ground,
                                 ptrdiff_t first, ptrdiff_t end, const struct dp_rates *r) {
    const double *k_below = row[DP_K_BELOW], *c_below = row[DP_C_BELOW];
    const double *k_own = row[DP_K_OWN], *c_own = row[DP_C_OWN];
    const double *k_above = row[DP_K_ABOVE], *c_above = row[DP_C_ABOVE];
    const double *constant = row[DP_CONSTANT], *share = row[DP_GROUND];
    double *u = r->u, *v = r->v, *a = r->a;
    struct motion_part under = {{0.0}, {0.0}}, own = dp_move_part(n, s, first);
    _Pragma("GCC unroll 4") for (ptrdiff_t i = first; i < end; i += FLOORS_VECTOR) {
        struct motion_part over = {{0.0}, {0.0}};
        if (i + FLOORS_VECTOR < end) {
            over = dp_move_part(n, s, i + FLOORS_VECTOR);
        }
        floor_lanes spring = FLOORS_AT(k_below, i) * BELOW(under.u, own.u) +
                             FLOORS_AT(k_own, i) * own.u +
                             FLOORS_AT(k_above, i) * ABOVE(own.u, over.u);
        floor_lanes still = FLOORS_AT(constant, i) - ground * FLOORS_AT(share, i) - spring;
        floor_lanes joined = FLOORS_AT(c_below, i) * BELOW(under.v, own.v) +
                             FLOORS_AT(c_above, i) * ABOVE(own.v, over.v);
        *(floor_lanes *)(u + i) = own.u;
        *(floor_lanes *)(v + i) = own.v;
        *(floor_lanes *)(a + i) = still - FLOORS_AT(c_own, i) * own.v - joined;
        under = own;
        own = over;
    }
}

// The same where the motion is known.
FLOORS_CLONES static void dp_rates(const struct dp *p, double ground, ptrdiff_t first,
                                   ptrdiff_t end, struct dp_rates *r) {
    const struct stage known = {.u0 = r->u, .v0 = r->v};
    dp_take_floors(0, &known, p->system.row, ground, first, end, r);
}

// The states of links at a stage, or with error_sums their errors.
static double dp_creep(const struct dp *p, const struct sums *sums, int link) {
    double sum = 0.0;
    for (int j = 0; j < sums->n; j++) {
        const int stage = sums->terms == BUT_SECOND && j > 0 ? j + 1 : j;
        sum += sums->v[j] * p->stage[stage].link[link].flow;
    }
    return p->h * sum;
}

static void dp_creep_to(const struct dp *p, const struct sums *sums, struct dp_rates *r) {
    for (int i = 0; i < p->now.n_live; i++) {
        r->link[i].creep = p->stage[0].link[i].creep + dp_creep(p, sums, i);
    }
}

// Stage number s of the step, at time t.
LANES_INLINE void dp_take_stage(struct dp *p, int s, double t, ptrdiff_t count) {
    const struct sums *sums = &stage_sums[s];
    struct dp_rates *r = &p->stage[s];
    const double *a[TERMS_MAX];
    dp_gather(p, sums, a);
    const struct stage stage = {
        .sums = sums, .a = a, .u0 = p->now.u, .v0 = p->now.v, .to = node[s] * p->h, .h = p->h};
    double ground = dp_rates_ground(p, t, r);
    dp_take_floors(sums->n, &stage, p->system.row, ground, 0, count, r);
    if (p->system.special || p->now.n_live > 0) {
        if (p->system.creeps) {
            dp_creep_to(p, sums, r);
        }
        dp_rates_add(p, t, DP_ALL, r);
    }
}

LANES_INLINE void dp_take_stages(struct dp *p, ptrdiff_t count) {
    double start = p->now.time;
    dp_take_stage(p, 1, start + node[1] * p->h, count);
    dp_take_stage(p, 2, start + node[2] * p->h, count);
    dp_take_stage(p, 3, start + node[3] * p->h, count);
    dp_take_stage(p, 4, start + node[4] * p->h, count);
    dp_take_stage(p, 5, p->next.time, count);
    dp_take_stage(p, 6, p->next.time, count);
}

// Most small models have so many floors in whole lanes, of which vectors are then in registers.
enum { USUAL = 2 * LANES_WIDTH };

FLOORS_CLONES static void dp_take(struct dp *p) {
    ptrdiff_t count = lanes_whole(p->model->n_dof);
    if (count == USUAL) {
        dp_take_stages(p, USUAL);
    } else {
        dp_take_stages(p, count);
    }
}

#define LARGER(x, y) (((x) & ((x) > (y))) | ((y) & ~((x) > (y))))

// The larger one of the errors of a floor in u and v over their sizes, of all floors. Numbers that
// are not negative stand in the order of their bits, and what is not a number stands above all.
FLOORS_CLONES static double dp_largest_error(const struct dp *p) {
    const double *a[TERMS_MAX];
    dp_gather(p, &error_sums, a);
    const double *scale_u = p->scales.over_u, *scale_v = p->scales.over_v;
    const double h = p->h, h2 = h * h;
    floor_bits largest = {0};
    for (ptrdiff_t i = 0, end = lanes_whole(p->model->n_dof); i < end; i += FLOORS_VECTOR) {
        struct motion_part error = dp_sum_part(TERMS_MAX, &error_sums, a, i);
        floor_bits of_u = (floor_bits)(h2 * error.u * FLOORS_AT(scale_u, i)) & INT64_MAX;
        floor_bits of_v = (floor_bits)(h * error.v * FLOORS_AT(scale_v, i)) & INT64_MAX;
        of_u = LARGER(of_u, of_v);
        largest = LARGER(of_u, largest);
    }
    int64_t most[FLOORS_VECTOR];
    memcpy(most, &largest, sizeof most);
    for (int n = FLOORS_VECTOR / 2; n > 0; n /= 2) {
        for (int i = 0; i < n; i++) {
            most[i] = most[i] > most[i + n] ? most[i] : most[i + n];
        }
    }
    double error;
    memcpy(&error, most, sizeof error);
    for (int i = 0; p->system.creeps && p->scales.most_u > 0.0 && i < p->now.n_live; i++) {
        const double of_link = fabs(dp_creep(p, &error_sums, i)) / p->scales.most_u;
        error = of_link > error || isnan(of_link) ? of_link : error;
    }
    return error;
}

#define ABSOLUTE(x) ((floor_lanes)((floor_bits)(x)&INT64_MAX))
#define LARGER_SIZE(x, y) ((floor_lanes)LARGER((floor_bits)ABSOLUTE(x), (floor_bits)ABSOLUTE(y)))

// Negative where an acceleration may go beyond its peak. Its upper bound is the largest one at the
// start, at the stages at 0.3 and 0.8 and at the end, and what a parabola through three of them
// rises above those that are farthest apart, by Newton's divided differences, and half as much
// again.
LANES_INLINE void dp_bend_part(const struct dp *p, ptrdiff_t i, floor_bits *bends) {
    static const int stages[] = {0, 2, 3, DP_STAGES - 1};
    floor_lanes x[4];
    for (int j = 0; j < 4; j++) {
        const struct dp_rates *r = &p->stage[stages[j]];
        x[j] = FLOORS_AT(r->a, i) + r->ground.a[0] * FLOORS_AT(p->system.row[DP_GROUND], i);
    }
    floor_lanes rise = (x[2] - x[1]) * (1.0 / 0.5);
    floor_lanes early = (rise - (x[1] - x[0]) * (1.0 / 0.3)) * (1.0 / 0.8);
    floor_lanes late = ((x[3] - x[2]) * (1.0 / 0.2) - rise) * (1.0 / 0.7);
    floor_lanes inner = LARGER_SIZE(x[1], x[2]), outer = LARGER_SIZE(x[0], x[3]);
    floor_lanes most = LARGER_SIZE(inner, outer) + 1.5 * 0.25 * 0.25 * LARGER_SIZE(early, late);
    *bends = BEYOND(most, FLOORS_AT(p->results->peak[PEAK_ACCELERATION], i));
}

// Drifts at the end of the step, and which floors could have a new peak in it: a value has at most
// been its last rate times the step beyond that at the end.
FLOORS_CLONES static bool dp_find_candidates(struct dp *p, struct dp_candidates *c) {
    double *const *peak = p->results->peak;
    const double *joint = p->model->chain.joint;
    const double *u = p->next.u, *v = p->next.v, *a = p->next.a;
    const double h = p->h;
    floor_bits any = {0};
    for (ptrdiff_t i = c->first, end = i + lanes_whole(c->n); i < end; i += FLOORS_VECTOR) {
        const floor_lanes own_u = FLOORS_AT(u, i), own_v = FLOORS_AT(v, i);
        const floor_lanes joined = FLOORS_AT(joint, i);
        const floor_lanes drift = own_u - joined * BELOW(FLOORS_AT(u, i - FLOORS_VECTOR), own_u);
        const floor_lanes slip = own_v - joined * BELOW(FLOORS_AT(v, i - FLOORS_VECTOR), own_v);
        const floor_lanes to_u = ABSOLUTE(own_u) + h * ABSOLUTE(own_v);
        const floor_lanes to_v = ABSOLUTE(own_v) + h * ABSOLUTE(FLOORS_AT(a, i));
        const floor_lanes to_drift = ABSOLUTE(drift) + h * ABSOLUTE(slip);
        floor_bits bends;
        dp_bend_part(p, i, &bends);
        const floor_bits hit = bends | BEYOND(to_u, FLOORS_AT(peak[PEAK_DISPLACEMENT], i)) |
                               BEYOND(to_v, FLOORS_AT(peak[PEAK_VELOCITY], i)) |
                               BEYOND(to_drift, FLOORS_AT(peak[PEAK_DRIFT], i));
        *(floor_lanes *)(p->next.drift + i) = drift;
        memcpy(c->bends + (i - c->first), &bends, sizeof bends);
        memcpy(c->hit + (i - c->first), &hit, sizeof hit);
        any |= hit;
    }
    return floors_any(&any);
}

// The stages that have a share in works: never the second one, and the last one within a step only.
static const int working[] = {0, 2, 3, 4, 5, 6};
enum { WORKING = sizeof working / sizeof working[0] };

// Twice the works of ground and dampers on all floors, in the times given to the stages.
FLOORS_CLONES static void dp_add_works(const struct dp *p, const double *time,
                                       struct energy_account *energy) {
    double *const *row = p->system.row;
    const double *carried = row[DP_CARRIED], *own = row[DP_DAMPER], *above = row[DP_DAMPER_ABOVE];
    for (ptrdiff_t i = 0, end = lanes_whole(p->model->n_dof); i < end; i += FLOORS_VECTOR) {
        floor_lanes way = {0.0}, square = {0.0}, product = {0.0};
        for (int j = 0; j < WORKING; j++) {
            const struct dp_rates *r = &p->stage[working[j]];
            floor_lanes v = FLOORS_AT(r->v, i), moved = time[working[j]] * v;
            way += r->ground.a[0] * moved;
            square += moved * v;
            product += moved * ABOVE(v, FLOORS_AT(r->v, i + FLOORS_VECTOR));
        }
        floor_lanes lost = FLOORS_AT(own, i) * square + FLOORS_AT(above, i) * product;
        *(floor_lanes *)(energy->input_2x + i % LANES_WIDTH) -= 2.0 * FLOORS_AT(carried, i) * way;
        *(floor_lanes *)(energy->damping_2x + i % LANES_WIDTH) += 2.0 * lost;
    }
}

const struct dp_floors DP_FLOORS = {dp_take, dp_rates, dp_largest_error, dp_find_candidates,
                                    dp_add_works};

#endif
