// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of the floors of all runs aboard at once: what chain_floor.h says, as a run alone goes
// through it where storeys are elastic and one ground moves all. Each lane sees the same operations
// in the same order, so that its bits are those of a run alone. A few buildings are taken through
// the whole step before the next ones, while their numbers are at hand; what one floor needs of its
// neighbours is carried along in registers.
//
// A drift that does not exceed its peak brings no shear beyond its own, as rounding keeps order; so
// shears are looked at only where a drift says so.
#include "solve/ensemble_lanes.h"

#define INLINE static inline __attribute__((always_inline))

static const long long SIZE = 0x7fffffffffffffffLL;  // all bits but the sign

// Negative where |x| > peak.
#define UNDER(peak, x) ((wide_bits)((peak) - (wide)((wide_bits)(x)&SIZE)))

// Buildings that are taken through a step together. While the processor waits in the substitution
// of one, where each floor needs the one before, it goes on with the next.
enum { TOGETHER = 2 };

// Floors whose corrections are found at a time, so that as many sums are under way; those left over
// go with the last ones.
enum { ROWS = 4, ROWS_MOST = 2 * ROWS - 1 };
#define EACH_ROW(c, n) _Pragma("GCC unroll 8") for (int c = 0; c < (n); c++)

// A number of floor i, in functions that know `x` and how it is `held`.
#define NUMBER(i, q) ENSEMBLE_AT(x, (i)*NUMBER_COUNT + NUMBER_##q)
#define FACTOR(i, q) ENSEMBLE_AT(x, (i)*FACTOR_COUNT + FACTOR_##q)

// Are the works of the last step still to be taken into account?
enum owed { OWED_NOTHING, OWED_WORKS };

// A building that begins a step; the arrays are of its own floors.
struct begun {
    const struct building *shape;
    const double *x;  // its numbers
    const struct ensemble_state *now, *old;
    struct ensemble_trial *trial;
    struct ensemble_works *works;
    wide ground, ground_2x, h, half;
};

// What the floors above and below want to know of one.
struct neighbour {
    wide u, v, shear;  // at the trial, of the storey below
    wide sum;          // of the velocities before and after the last step
};

// The works of the ground and of damping on floor i in the last step.
INLINE void account_floor(const struct begun *g, enum ensemble_held held, int i, const wide *below,
                          const wide *own, const wide *above) {
    const double *x = g->x;
    const unsigned part = (unsigned)(g->shape->first + i) % LANES_WIDTH;
    const wide du = g->now[i].u - g->old[i].u;
    g->works->input_2x[part] += g->ground_2x * (NUMBER(i, INERTIA) * du);
    g->works->damping_2x[part] +=
        du * (NUMBER(i, BELOW) * *below + NUMBER(i, OWN) * *own + NUMBER(i, ABOVE) * *above);
}

// Floor i at the end of the step, if its acceleration stays.
INLINE void try_floor(const struct begun *g, enum ensemble_held held, enum owed owed, int i,
                      const wide *u_below, struct neighbour *own) {
    const double *x = g->x;
    const struct ensemble_state *s = &g->now[i];
    own->u = s->u + (g->h * s->v + g->half * s->a);
    own->v = s->v + g->h * s->a;
    own->shear = NUMBER(i, STIFFNESS) * (own->u - *u_below);
    if (owed == OWED_WORKS) {
        own->sum = g->old[i].v + s->v;
    }
}

// r = -m (a_ground + a) - C v_t - K u_t of floor i.
INLINE void begin_floor(const struct begun *g, enum ensemble_held held, enum owed owed, int i,
                        const struct neighbour *below, const struct neighbour *own,
                        const struct neighbour *above) {
    const double *x = g->x;
    const wide damping =
        NUMBER(i, BELOW) * below->v + NUMBER(i, OWN) * own->v + NUMBER(i, ABOVE) * above->v;
    const wide residual = NUMBER(i, INERTIA) * g->ground + NUMBER(i, INERTIA) * g->now[i].a -
                          damping - own->shear + above->shear;
    g->trial[i] = (struct ensemble_trial){own->u, own->v, residual};
    if (owed == OWED_WORKS) {
        account_floor(g, held, i, &below->sum, &own->sum, &above->sum);
    }
}

INLINE void begin_floors(const struct begun *g, enum ensemble_held held, enum owed owed) {
    const struct neighbour nothing = {{0.0}, {0.0}, {0.0}, {0.0}};
    const int top = g->shape->n_floor - 1;
    struct neighbour below = nothing, own = nothing, above = nothing;
    try_floor(g, held, owed, 0, &nothing.u, &own);
    for (int i = 0; i < top; i++) {
        try_floor(g, held, owed, i + 1, &own.u, &above);
        begin_floor(g, held, owed, i, &below, &own, &above);
        below = own;
        own = above;
    }
    begin_floor(g, held, owed, top, &below, &own, &nothing);
}

INLINE struct begun begun(const struct ensemble_lanes *e, const struct ensemble_building *b,
                          const wide *ground, struct ensemble_trial *t) {
    const int first = b->shape->first;
    return (struct begun){
        .shape = b->shape,
        .x = b->number,
        .now = e->now + first,
        .old = e->next + first,
        .trial = t,
        .works = e->works,
        .ground = *ground,
        .ground_2x = e->works->ground_2x,
        .h = e->factors->h,
        .half = e->factors->half,
    };
}

// The trial of a building, with its residuals. Its last step is accounted for while its numbers are
// at hand. Functions of their own, as compilers mix up what is in one.
LANES static void begin_once_owing(const struct ensemble_lanes *e,
                                   const struct ensemble_building *b, const wide *ground,
                                   struct ensemble_trial *t) {
    const struct begun g = begun(e, b, ground, t);
    begin_floors(&g, HELD_ONCE, OWED_WORKS);
}

LANES static void begin_once(const struct ensemble_lanes *e, const struct ensemble_building *b,
                             const wide *ground, struct ensemble_trial *t) {
    const struct begun g = begun(e, b, ground, t);
    begin_floors(&g, HELD_ONCE, OWED_NOTHING);
}

LANES static void begin_each_owing(const struct ensemble_lanes *e,
                                   const struct ensemble_building *b, const wide *ground,
                                   struct ensemble_trial *t) {
    const struct begun g = begun(e, b, ground, t);
    begin_floors(&g, HELD_BY_EACH, OWED_WORKS);
}

LANES static void begin_each(const struct ensemble_lanes *e, const struct ensemble_building *b,
                             const wide *ground, struct ensemble_trial *t) {
    const struct begun g = begun(e, b, ground, t);
    begin_floors(&g, HELD_BY_EACH, OWED_NOTHING);
}

INLINE void begin(const struct ensemble_lanes *e, const struct ensemble_building *b,
                  const wide *ground, struct ensemble_trial *t) {
    if (b->held == HELD_ONCE) {
        e->owing ? begin_once_owing(e, b, ground, t) : begin_once(e, b, ground, t);
    } else {
        e->owing ? begin_each_owing(e, b, ground, t) : begin_each(e, b, ground, t);
    }
}

// A building that ends a step; arrays as above.
struct ended {
    const double *inverse, *factor;
    const struct ensemble_state *now;
    const struct ensemble_trial *trial;
    const struct ensemble_peaks *peak;
    struct ensemble_state *next;
    wide *correction;
    int n;
    wide ground, b, g;
    wide u_below;
    wide_bits beyond;  // negative in lanes where a floor exceeds a peak
};

INLINE struct ended ended(const struct ensemble_lanes *e, const struct ensemble_building *b,
                          const wide *ground, const struct ensemble_trial *t) {
    const int first = b->shape->first;
    return (struct ended){
        .inverse = b->inverse,
        .factor = b->factor,
        .now = e->now + first,
        .trial = t,
        .peak = e->peak + first,
        .next = e->next + first,
        .correction = e->correction + first,
        .n = b->shape->n_floor,
        .ground = *ground,
        .b = e->factors->b,
        .g = e->factors->g,
    };
}

// The state of floor i with its correction q, and whether it exceeds a peak.
INLINE void end_floor(struct ended *g, int i, const wide *u_trial, const wide *v_trial,
                      const wide *q) {
    const struct ensemble_peaks *p = &g->peak[i];
    const wide u = *u_trial + g->b * *q;
    const wide v = *v_trial + g->g * *q;
    const wide a = g->now[i].a + *q;
    g->next[i] = (struct ensemble_state){u, v, a};
    g->beyond = g->beyond | UNDER(p->of[PEAK_DISPLACEMENT], u) | UNDER(p->of[PEAK_VELOCITY], v);
    g->beyond = g->beyond | UNDER(p->of[PEAK_ACCELERATION], a + g->ground) |
                UNDER(p->of[PEAK_DRIFT], u - g->u_below);
    g->u_below = u;
}

// `count` floors from floor j on, by as many rows of the inverse, which is stored by columns.
INLINE void end_rows(struct ended *g, enum ensemble_held held, int j, int count) {
    wide q[ROWS_MOST];
    EACH_ROW(c, count) {
        q[c] = (wide){0.0};
    }
    for (int i = 0, at = j; i < g->n; i++, at += g->n) {
        EACH_ROW(c, count) {
            q[c] += g->trial[i].residual * ENSEMBLE_AT(g->inverse, at + c);
        }
    }
    EACH_ROW(c, count) {
        g->correction[j + c] = q[c];
        end_floor(g, j + c, &g->trial[j + c].u, &g->trial[j + c].v, &q[c]);
    }
}

INLINE void multiply(struct ended *g, enum ensemble_held held) {
    int j = 0;
    for (; j + ROWS_MOST < g->n; j += ROWS) {
        end_rows(g, held, j, ROWS);
    }
    switch (g->n - j) {
        case 1:
            end_rows(g, held, j, 1);
            break;
        case 2:
            end_rows(g, held, j, 2);
            break;
        case 3:
            end_rows(g, held, j, 3);
            break;
        case 4:
            end_rows(g, held, j, 4);
            break;
        case 5:
            end_rows(g, held, j, 5);
            break;
        case 6:
            end_rows(g, held, j, 6);
            break;
        default:
            end_rows(g, held, j, ROWS_MOST);
    }
}

// L D L^T, from the ground up and back.
INLINE void substitute(const struct ended *g, enum ensemble_held held) {
    const double *x = g->factor;
    const int n = g->n;
    wide *q = g->correction;
    wide below = g->trial[0].residual;
    q[0] = below;
    for (int i = 1; i < n; i++) {
        below = g->trial[i].residual - FACTOR(i - 1, OFF) * below;
        q[i] = below;
    }
    wide above = below * FACTOR(n - 1, PIVOT);
    q[n - 1] = 0.0 + above;
    for (int i = n - 2; i >= 0; i--) {
        above = q[i] * FACTOR(i, PIVOT) - FACTOR(i, OFF) * above;
        q[i] = 0.0 + above;
    }
}

INLINE void end_floors(struct ended *g) {
    for (int i = 0; i < g->n; i++) {
        const wide q = g->correction[i];
        end_floor(g, i, &g->trial[i].u, &g->trial[i].v, &q);
    }
}

INLINE void end_held(struct ended *g, enum ensemble_held held) {
    if (g->inverse) {
        multiply(g, held);
    } else {
        substitute(g, held);
        end_floors(g);
    }
}

// The state that the residuals of a building lead to. Returns... *beyond: lanes in which a floor
// exceeds a peak.
LANES static void end_once(const struct ensemble_lanes *e, const struct ensemble_building *b,
                           const wide *ground, const struct ensemble_trial *t,
                           wide_bits *beyond) {
    struct ended g = ended(e, b, ground, t);
    end_held(&g, HELD_ONCE);
    *beyond = g.beyond;
}

LANES static void end_each(const struct ensemble_lanes *e, const struct ensemble_building *b,
                           const wide *ground, const struct ensemble_trial *t,
                           wide_bits *beyond) {
    struct ended g = ended(e, b, ground, t);
    end_held(&g, HELD_BY_EACH);
    *beyond = g.beyond;
}

INLINE void end(const struct ensemble_lanes *e, int k, const wide *ground,
                const struct ensemble_trial *t) {
    const struct ensemble_building *b = &e->building[k];
    b->held == HELD_ONCE ? end_once(e, b, ground, t, &e->beyond[k])
                         : end_each(e, b, ground, t, &e->beyond[k]);
}

// Negative in lanes where a contact is nearer than ever or closed.
INLINE void penetrate(const struct ensemble_lanes *e, wide_bits *flags) {
    const struct ensemble_state *t = e->next;
    for (int k = 0; k < e->n_contact; k++) {
        const struct ensemble_contact *c = &e->contact[k];
        *flags |= (wide_bits)(c->limit - (t[e->end[k][0]].u - t[e->end[k][1]].u - c->gap));
    }
}

INLINE void commit(struct ensemble_lanes *e, const wide *ground) {
    struct ensemble_state *old = e->now;
    e->works->ground_2x = e->works->ground + *ground;
    e->works->ground = *ground;
    e->now = e->next;
    e->next = old;
    e->owing = true;
}

// Computes `next`. Negative in lanes where it is beyond a peak.
INLINE void step(struct ensemble_lanes *e, const wide *ground, wide_bits *beyond) {
    const struct ensemble_building *b = e->building;
    for (int first = 0; first < e->n_building; first += TOGETHER) {
        const int last = first + TOGETHER < e->n_building ? first + TOGETHER : e->n_building;
        struct ensemble_trial *t = e->trial - b[first].shape->first;
        for (int k = first; k < last; k++) {
            begin(e, &b[k], ground, t + b[k].shape->first);
        }
        for (int k = first; k < last; k++) {
            end(e, k, ground, t + b[k].shape->first);
            *beyond |= e->beyond[k];
        }
    }
    e->owing = false;
}

LANES int ensemble_march(struct ensemble_lanes *e, const wide *base, int n, bool *presses) {
    for (int i = 0; i < n; i++) {
        wide_bits beyond = {0}, pressed = {0};
        step(e, base + i, &beyond);
        penetrate(e, &pressed);
        const wide_bits flags = beyond | pressed;
        if (ensemble_any(e, &flags)) {
            *presses = ensemble_any(e, &pressed);
            return i;
        }
        commit(e, base + i);
    }
    return n;
}

// The forces that live links begin the step with, link by link as a run alone takes them.
INLINE void push(struct ensemble_lanes *e) {
    for (int k = 0; k < e->n_contact; k++) {
        if (e->acts[k]) {
            e->trial[e->end[k][0]].residual -= e->force[k];
            e->trial[e->end[k][1]].residual += e->force[k];
            e->force[k] = (wide){0.0};
            e->acts[k] = false;
        }
    }
}

LANES void ensemble_move(struct ensemble_lanes *e, const wide *base) {
    for (int k = 0; k < e->n_building; k++) {
        begin(e, &e->building[k], base, e->trial + e->building[k].shape->first);
    }
    e->owing = false;
    push(e);
    for (int k = 0; k < e->n_building; k++) {
        end(e, k, base, e->trial + e->building[k].shape->first);
    }
}

#if defined(__has_builtin) && __has_builtin(__builtin_shufflevector)
#define SHUFFLE(x, y, ...) __builtin_shufflevector(x, y, __VA_ARGS__)
#else
#define SHUFFLE(x, y, ...) __builtin_shuffle(x, y, (wide_bits){__VA_ARGS__})
#endif

// Numbers of WIDE_RUNS floors by lanes, to those of the lanes by floors, or back.
INLINE void transpose(wide *x) {
    wide y[WIDE_RUNS];
    for (int i = 0; i < WIDE_RUNS; i += 2) {
        y[i] = SHUFFLE(x[i], x[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
        y[i + 1] = SHUFFLE(x[i], x[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
    }
    for (int i = 0; i < 2; i++) {
        const wide low = SHUFFLE(y[i], y[i + 2], 0, 1, 4, 5, 8, 9, 12, 13);
        const wide high = SHUFFLE(y[i], y[i + 2], 2, 3, 6, 7, 10, 11, 14, 15);
        const wide under = SHUFFLE(y[i + 4], y[i + 6], 0, 1, 4, 5, 8, 9, 12, 13);
        const wide over = SHUFFLE(y[i + 4], y[i + 6], 2, 3, 6, 7, 10, 11, 14, 15);
        x[i] = SHUFFLE(low, under, 0, 1, 4, 5, 8, 9, 12, 13);
        x[i + 4] = SHUFFLE(low, under, 2, 3, 6, 7, 10, 11, 14, 15);
        x[i + 2] = SHUFFLE(high, over, 0, 1, 4, 5, 8, 9, 12, 13);
        x[i + 6] = SHUFFLE(high, over, 2, 3, 6, 7, 10, 11, 14, 15);
    }
}

// Stores those of the floors from i on in the arrays of the runs.
INLINE void show(wide *x, double *const *array, int i) {
    transpose(x);
    for (int lane = 0; lane < WIDE_RUNS; lane++) {
        *(lanes_wide *)(array[lane] + i) = x[lane];
    }
}

LANES void ensemble_show(struct ensemble_lanes *e, int part) {
    const wide h = e->factors->h, half = e->factors->half;
    const int first = part * WIDE_RUNS;
    wide u[WIDE_RUNS], v[WIDE_RUNS], q[WIDE_RUNS];
    for (int i = 0; i < WIDE_RUNS; i++) {
        const struct ensemble_state *s = &e->now[first + i];
        u[i] = s->u + (h * s->v + half * s->a);
        v[i] = s->v + h * s->a;
        q[i] = e->correction[first + i];
    }
    show(u, e->show.u_trial, first);
    show(v, e->show.v_trial, first);
    show(q, e->show.correction, first);
    e->shown[part] = true;
}

// Building k with the corrections that links have changed.
INLINE void move_pushed(struct ensemble_lanes *e, int k, const wide *ground) {
    const wide h = e->factors->h, half = e->factors->half;
    const struct building *shape = e->building[k].shape;
    struct ended g = ended(e, &e->building[k], ground, NULL);
    for (int first = 0; first < shape->n_floor; first += WIDE_RUNS) {
        wide q[WIDE_RUNS];
        for (int lane = 0; lane < WIDE_RUNS; lane++) {
            q[lane] = *(const lanes_wide *)(e->show.correction[lane] + shape->first + first);
        }
        transpose(q);
        for (int i = 0; i < WIDE_RUNS && first + i < shape->n_floor; i++) {
            const struct ensemble_state *s = &g.now[first + i];
            const struct neighbour own = {
                .u = s->u + (h * s->v + half * s->a),
                .v = s->v + h * s->a,
            };
            end_floor(&g, first + i, &own.u, &own.v, &q[i]);
        }
    }
    e->beyond[k] = g.beyond;
}

LANES void ensemble_move_pushed(struct ensemble_lanes *e, const wide *base) {
    for (int k = 0; k < e->n_building; k++) {
        if (e->building[k].pushed) {
            e->building[k].pushed = false;
            move_pushed(e, k, base);
        }
    }
}

LANES void ensemble_commit(struct ensemble_lanes *e, const wide *base) {
    commit(e, base);
    memset(e->shown, false, (size_t)(e->n_floor / WIDE_RUNS) + 1);
}

INLINE void account(const struct begun *g, enum ensemble_held held) {
    const wide nothing = {0.0};
    const int top = g->shape->n_floor - 1;
    wide below = nothing, own = g->old[0].v + g->now[0].v;
    for (int i = 0; i < top; i++) {
        const wide above = g->old[i + 1].v + g->now[i + 1].v;
        account_floor(g, held, i, &below, &own, &above);
        below = own;
        own = above;
    }
    account_floor(g, held, top, &below, &own, &nothing);
}

LANES void ensemble_settle(struct ensemble_lanes *e) {
    const wide still = {0.0};
    for (int k = 0; e->owing && k < e->n_building; k++) {
        const struct begun g = begun(e, &e->building[k], &still, e->trial);
        if (e->building[k].held == HELD_ONCE) {
            account(&g, HELD_ONCE);
        } else {
            account(&g, HELD_BY_EACH);
        }
    }
    e->owing = false;
}
