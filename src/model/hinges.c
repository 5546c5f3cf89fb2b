// SPDX-License-Identifier: GPL-3.0-or-later
// Each law is its initial line and a departure s from it, m = k r + s. With K = S_rr + diag(k), and
// F = -S_rd, the rotations in equilibrium are
//     r = P d - B s(r),   B = K^-1,   P = B F,   and   V = (S_dd - F' P) d + P' s.
// B and P are found once. Hinges that have not yielded have s = 0, so an elastic step is the product
// P d and a look at the laws.
//
// Newton's method finds the rotations from u = K r + s - F d, the unbalanced moments. With the
// tangents k - e of the laws, only hinges with e != 0 (set A) enter the system
//     (1/e - B_AA) y = -(B u)_A,   dr = B (y - u),
// and u = s(r + dr) - s(r) + y is left. For laws whose tangent is not negative, u is the gradient of
// a convex potential: a step that goes too far is shortened until u is small along it. The
// consistent tangent is S_dd - F' P - P_A' (1/e - B_AA)^-1 P_A.
//
// K - diag(e) is positive definite if and only if the factorisation L D L' of 1/e - B_AA has a
// positive pivot for each e > 0 and a negative one for each e < 0; those come first. Otherwise the
// frame has no stable equilibrium (laws that soften), or a joint can turn without resistance (all its
// hinges yield at constant moments). Then the tangents of the laws are raised to SOFTEST times k.
#include "model/hinges.h"

#include <assert.h>
#include <float.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

#include "core/lanes.h"
#include "core/number.h"

struct hinges {
    int n, n_floor;
    int stride;  // n in whole lanes
    int n_history;
    const struct hinge *hinge;  // (n)
    double *by_drift;   // [1/L] (n_floor, stride) P, transposed
    double *by_moment;  // [1/(F L)] (n, stride) B
    double *initial;    // [F/L] (n_floor, n_floor) of the frame with its hinges on their first lines
};

// Iterations, and trials along one step.
enum { ITERATIONS_MAX = 200, TRIALS_MAX = 40 };

// A pivot this small, relative to its entry, is rounding.
static const double HELD = 1e-12;
static const double SOFTEST = 1e-6;

// A departure from k r this small, relative to the moment, is rounding of the law.
static const double ROUNDING = 4.0 * DBL_EPSILON;

// Unbalanced moments this small against the largest of all hinges are rounding: laws compute their
// moments from k r.
static const double BALANCED = 256.0 * DBL_EPSILON;
// Where rounding lets no step improve them further, they may be so large.
static const double BALANCED_LEAST = 1e-10;

// A step is short enough if the slope of the potential at its end is this share of that at its
// start at most.
static const double FLAT = 0.9;

// Rotations and the laws there.
struct hinges_point {
    double *turn;       // (n) rotations
    double *departure;  // [F L] (n) s
    double *softening;  // [F L] (n) e
    double *unbalance;  // [F L] (n) u
    double size;        // [F L] the largest moment of which unbalanced moments are the rounding
};

// The search for the rotations, in scratch.
struct hinges_search {
    const struct hinges *h;
    const double *history;  // of the laws
    double *after;          // of the laws; NULL: not asked for
    struct hinges_point at, trial;
    double *step;         // (n) dr
    double *push;         // [F L] (n) y, and 0 outside the set A; then y - u
    double *inverse;      // (n) of pivots
    double *factor;       // (n, n) row j: entries from j on
    double *right;        // (n, n_floor)
    int *order;           // (n) numbers of the hinges of set A
    int n_active;
};

enum { VECTORS = 13 };

int hinges_n_history(const struct hinges *h) {
    return h->n_history;
}

int hinges_n_scratch(const struct hinges *h) {
    return VECTORS * h->stride + h->n * (h->n + h->n_floor);
}

const struct hinge *hinges_at(const struct plane_frame *f, int i) {
    assert(f->hinges && i >= 0 && i < f->hinges->n);
    return &f->hinges->hinge[i];
}

static struct hinges_search hinges_begin(const struct hinges *h, const double *history,
                                         double *scratch) {
    double *vector[VECTORS];
    for (int i = 0; i < VECTORS; i++) {
        vector[i] = scratch + (ptrdiff_t)i * h->stride;
    }
    double *matrix = scratch + (ptrdiff_t)VECTORS * h->stride;
    return (struct hinges_search){
        .h = h,
        .history = history + 2 * h->n,
        .at = {vector[0], vector[1], vector[2], vector[3], 0.0},
        .trial = {vector[4], vector[5], vector[6], vector[7], 0.0},
        .step = vector[8],
        .push = vector[9],
        .inverse = vector[10],
        .order = (int *)vector[11],
        .factor = matrix,
        .right = matrix + (ptrdiff_t)h->n * h->n,
    };
}

// Adds to x (n) the product of B and the moments (n), most of which are 0.
LANES static void hinges_flex(const struct hinges *h, const double *moment, double sign,
                              double *restrict x) {
    const ptrdiff_t n = h->stride;
    for (int j = 0; j < h->n; j++) {
        const double *restrict row = h->by_moment + j * n;
        const double m = sign * moment[j];
        for (ptrdiff_t i = 0; m != 0.0 && i < n; i++) {
            x[i] += row[i] * m;
        }
    }
}

// The rotations at these drifts and departures.
LANES static void hinges_place(const struct hinges *h, const double *drift, const double *departure,
                               double *restrict turn) {
    const ptrdiff_t n = h->stride;
    memset(turn, 0, (size_t)n * sizeof *turn);
    for (int j = 0; j < h->n_floor; j++) {
        const double *restrict row = h->by_drift + j * n;
        for (ptrdiff_t i = 0; i < n; i++) {
            turn[i] += row[i] * drift[j];
        }
    }
    hinges_flex(h, departure, -1.0, turn);
}

// Takes the laws at the rotations of a point.
static void hinges_respond_laws(const struct hinges_search *x, struct hinges_point *p) {
    p->size = 0.0;
    for (int i = 0; i < x->h->n; i++) {
        const struct hinge *hinge = &x->h->hinge[i];
        const struct storey *s = &hinge->storey;
        const struct storey_response r =
            s->law->respond(s->constant, x->history + s->history, p->turn[i],
                            x->after ? x->after + s->history : NULL);
        const double line = hinge->stiffness * p->turn[i], departure = r.shear - line;
        const double size = fabs(r.shear) + fabs(line);
        p->departure[i] = fabs(departure) > ROUNDING * size ? departure : 0.0;
        p->softening[i] = hinge->stiffness - r.tangent;
        p->size = number_max(p->size, size);
    }
}

static double hinges_unbalance(const struct hinges *h, const struct hinges_point *p) {
    double most = 0.0;
    for (int i = 0; i < h->n; i++) {
        most = number_max(most, fabs(p->unbalance[i]));
    }
    return isfinite(p->size) ? most : INFINITY;
}

// Lists set A: hinges that are stiffer than at first, then softer ones.
static void hinges_list_active(struct hinges_search *x) {
    const double *e = x->at.softening;
    x->n_active = 0;
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < x->h->n; i++) {
            if (pass == 0 ? e[i] < 0.0 : e[i] > 0.0) {
                x->order[x->n_active++] = i;
            }
        }
    }
}

static double hinges_entry(const struct hinges_search *x, int i, int j) {
    return x->h->by_moment[(ptrdiff_t)x->order[i] * x->h->stride + x->order[j]];
}

// Factorises 1/e - B_AA with tangents of at least `least` times the initial ones. False: a pivot
// has the wrong sign.
LANES static bool hinges_factorise(struct hinges_search *x, double least) {
    const int n = x->n_active;
    for (int i = 0; i < n; i++) {
        const int hinge = x->order[i];
        const double most = (1.0 - least) * x->h->hinge[hinge].stiffness;
        double *row = x->factor + (ptrdiff_t)i * n;
        for (int j = i; j < n; j++) {
            row[j] = -hinges_entry(x, i, j);
        }
        row[i] += 1.0 / fmin(x->at.softening[hinge], most);
    }
    for (int j = 0; j < n; j++) {
        const double *restrict row = x->factor + (ptrdiff_t)j * n;
        const double e = x->at.softening[x->order[j]];
        if (!(row[j] * copysign(1.0, e) > HELD / fabs(e))) {
            return false;
        }
        x->inverse[j] = 1.0 / row[j];
        for (int i = j + 1; i < n; i++) {
            double *restrict below = x->factor + (ptrdiff_t)i * n;
            const double share = row[i] * x->inverse[j];
            for (int k = i; k < n; k++) {
                below[k] -= share * row[k];
            }
        }
    }
    return true;
}

// Finds y and with it the step dr.
static void hinges_find_step(const struct hinges_search *x) {
    const int n = x->n_active;
    const struct hinges *h = x->h;
    double *y = x->right;
    memset(x->step, 0, (size_t)h->stride * sizeof *x->step);
    hinges_flex(h, x->at.unbalance, 1.0, x->step);
    for (int i = 0; i < n; i++) {
        y[i] = -x->step[x->order[i]];
    }
    for (int j = 0; j < n; j++) {
        const double *row = x->factor + (ptrdiff_t)j * n;
        const double share = y[j] * x->inverse[j];
        for (int k = j + 1; k < n; k++) {
            y[k] -= share * row[k];
        }
    }
    memset(x->push, 0, (size_t)h->stride * sizeof *x->push);
    for (int j = n - 1; j >= 0; j--) {
        const double *row = x->factor + (ptrdiff_t)j * n;
        for (int k = j + 1; k < n; k++) {
            y[j] -= row[k] * y[k];
        }
        y[j] *= x->inverse[j];
        x->push[x->order[j]] = y[j];
    }
    for (int i = 0; i < h->n; i++) {
        x->step[i] = -x->step[i];
    }
    hinges_flex(h, x->push, 1.0, x->step);
}

// Goes a share of the step: the trial point, and the slope of the potential there.
static double hinges_try(struct hinges_search *x, double share) {
    const struct hinges_point *at = &x->at;
    struct hinges_point *to = &x->trial;
    double slope = 0.0;
    for (int i = 0; i < x->h->n; i++) {
        to->turn[i] = at->turn[i] + share * x->step[i];
    }
    hinges_respond_laws(x, to);
    for (int i = 0; i < x->h->n; i++) {
        to->unbalance[i] = (1.0 - share) * at->unbalance[i] + to->departure[i] - at->departure[i] +
                           share * x->push[i];
        slope += to->unbalance[i] * x->step[i];
    }
    return slope;
}

// Takes the step, or a share of it at whose end the potential is flat enough.
static void hinges_advance(struct hinges_search *x) {
    const struct hinges_point start = x->at;
    double slope_0 = 0.0, share = 1.0;
    for (int i = 0; i < x->h->n; i++) {
        slope_0 += x->at.unbalance[i] * x->step[i];
    }
    double slope = hinges_try(x, share);
    for (int i = 0; i < TRIALS_MAX && slope > FLAT * fabs(slope_0); i++) {
        share /= 2.0;
        slope = hinges_try(x, share);
    }
    x->at = x->trial;
    x->trial = start;
}

// Finds the rotations at these drifts; false: they are not found.
static bool hinges_find(struct hinges_search *x, const double *drift, const double *departure) {
    const struct hinges *h = x->h;
    hinges_place(h, drift, departure, x->at.turn);
    hinges_respond_laws(x, &x->at);
    for (int i = 0; i < h->n; i++) {
        x->at.unbalance[i] = x->at.departure[i] - departure[i];
    }
    double most = hinges_unbalance(h, &x->at), before = INFINITY;
    for (int i = 0; i < ITERATIONS_MAX && most > BALANCED * x->at.size &&
                    (most < before || most > BALANCED_LEAST * x->at.size);
         i++) {
        before = most;
        hinges_list_active(x);
        if (!hinges_factorise(x, -INFINITY) && !hinges_factorise(x, SOFTEST)) {
            return false;
        }
        hinges_find_step(x);
        hinges_advance(x);
        most = hinges_unbalance(h, &x->at);
    }
    return most <= BALANCED_LEAST * x->at.size;
}

// Adds the storey shears in equilibrium.
static void hinges_add_shear(const struct hinges_search *x, const double *drift, double *shear) {
    const struct hinges *h = x->h;
    for (int i = 0; i < h->n_floor; i++) {
        const double *row = h->by_drift + (ptrdiff_t)i * h->stride;
        double sum = 0.0;
        for (int j = 0; j < h->n_floor; j++) {
            sum += h->initial[i * h->n_floor + j] * drift[j];
        }
        for (int k = 0; k < h->n; k++) {
            sum += row[k] * x->at.departure[k];
        }
        shear[i] += sum;
    }
}

// Does some law soften?
static bool hinges_soften(const struct hinges_search *x) {
    bool soften = false;
    for (int i = 0; i < x->h->n; i++) {
        soften |= x->at.softening[i] > x->h->hinge[i].stiffness;
    }
    return soften;
}

// P_A with the factor L^-1 before it, in `right`. False: the equilibrium is not stable.
static bool hinges_reduce(struct hinges_search *x) {
    const int n = x->n_active, n_floor = x->h->n_floor;
    if (!hinges_factorise(x, -INFINITY) && (hinges_soften(x) || !hinges_factorise(x, SOFTEST))) {
        return false;
    }
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n_floor; j++) {
            x->right[i * n_floor + j] = x->h->by_drift[(ptrdiff_t)j * x->h->stride + x->order[i]];
        }
    }
    for (int i = 0; i < n; i++) {
        const double *row = x->factor + (ptrdiff_t)i * n, *own = x->right + i * n_floor;
        for (int k = i + 1; k < n; k++) {
            const double share = row[k] * x->inverse[i];
            for (int j = 0; j < n_floor; j++) {
                x->right[k * n_floor + j] -= share * own[j];
            }
        }
    }
    return true;
}

// Adds the consistent tangent; false: the equilibrium is not stable.
static bool hinges_add_tangent(struct hinges_search *x, double *by_drift) {
    const int n_floor = x->h->n_floor;
    hinges_list_active(x);
    if (!hinges_reduce(x)) {
        return false;
    }
    for (int i = 0; i < n_floor; i++) {
        for (int j = 0; j <= i; j++) {
            double sum = x->h->initial[i * n_floor + j];
            for (int k = 0; k < x->n_active; k++) {
                const double *row = x->right + k * n_floor;
                sum -= row[i] * row[j] * x->inverse[k];
            }
            by_drift[i * n_floor + j] += sum;
            by_drift[j * n_floor + i] += i == j ? 0.0 : sum;
        }
    }
    return true;
}

static const struct hinges *hinges_of(const struct part *p) {
    return ((const struct plane_frame *)p->data)->hinges;
}

// The history has the rotations and departures of all hinges, then what their laws have.
static void hinges_respond(const struct part *p, const double *history, const double *drift,
                           const double *rate, const struct part_sums *to, double *after) {
    const struct hinges *h = hinges_of(p);
    const int n = h->n;
    (void)rate;
    assert(to->scratch);
    struct hinges_search x = hinges_begin(h, history, to->scratch);
    x.after = after && after != history ? after + 2 * n : NULL;
    const bool found = hinges_find(&x, drift, history + n);
    if (found && to->shear) {
        hinges_add_shear(&x, drift, to->shear);
    }
    if (!found || (to->by_drift && !hinges_add_tangent(&x, to->by_drift))) {
        *(to->shear ? to->shear : to->by_drift) = (double)NAN;
    }
    if (after == history) {
        x.after = after + 2 * n;
        hinges_respond_laws(&x, &x.at);
    }
    if (after) {
        memcpy(after, x.at.turn, (size_t)n * sizeof *after);
        memcpy(after + n, x.at.departure, (size_t)n * sizeof *after);
    }
}

static double hinges_stored(const struct part *p, const double *history, const double *drift) {
    const struct plane_frame *f = p->data;
    const int n = f->n_action;
    double sum = 0.0;
    for (int i = 0; i < n; i++) {
        const double own = i < f->n_floor ? drift[i] : history[i - f->n_floor];
        for (int j = 0; j < n; j++) {
            const double other = j < f->n_floor ? drift[j] : history[j - f->n_floor];
            sum += own * f->stiffness[i * n + j] * other / 2.0;
        }
    }
    for (int i = 0; i < f->n_hinge; i++) {
        const struct storey *s = &hinges_at(f, i)->storey;
        sum += s->law->stored(s->constant, history + 2 * f->n_hinge + s->history, history[i]);
    }
    return sum;
}

const struct part_kind hinges_part = {
    .name = "frame",
    .respond = hinges_respond,
    .stored = hinges_stored,
};
const struct part_kind hinges_straight_part = {
    .name = "frame",
    .traits = PART_STRAIGHT,
    .respond = hinges_respond,
    .stored = hinges_stored,
};

const struct part_kind *hinges_kind(const struct hinges *h) {
    bool straight = true;
    for (int i = 0; i < h->n; i++) {
        straight &= (h->hinge[i].storey.law->traits & STOREY_STRAIGHT) != 0;
    }
    return straight ? &hinges_straight_part : &hinges_part;
}

// Copies the hinges and gives them their initial stiffnesses and the places of their histories.
static struct hinge *hinges_take(struct hinges *h, const struct hinge *hinge, struct arena *a) {
    static const double unyielded[STOREY_HISTORY_MAX];
    struct hinge *own = arena_alloc(a, (size_t)h->n, sizeof *own);
    int n_history = 0;
    for (int i = 0; own && i < h->n; i++) {
        own[i] = hinge[i];
        struct storey *s = &own[i].storey;
        s->history = n_history;
        n_history += s->law->n_history;
        own[i].stiffness = s->law->respond(s->constant, unyielded, 0.0, NULL).tangent;
    }
    h->n_history = 2 * h->n + n_history;
    return own;
}

// B = (S_rr + diag(k))^-1, in `by_moment`. False: it is not finite.
static bool hinges_invert(const struct plane_frame *f, struct hinges *h) {
    const size_t n = (size_t)h->n;
    gsl_matrix_view b = gsl_matrix_view_array_with_tda(h->by_moment, n, n, (size_t)h->stride);
    for (int i = 0; i < h->n; i++) {
        for (int j = 0; j < h->n; j++) {
            const int at = (f->n_floor + i) * f->n_action + f->n_floor + j;
            h->by_moment[(ptrdiff_t)i * h->stride + j] =
                f->stiffness[at] + (i == j ? h->hinge[i].stiffness : 0.0);
        }
    }
    return gsl_linalg_cholesky_decomp1(&b.matrix) == 0 &&
           gsl_linalg_cholesky_invert(&b.matrix) == 0;
}

// P = -B S_rd and S_dd + S_dr P.
static void hinges_reduce_at_first(const struct plane_frame *f, struct hinges *h) {
    const int n = f->n_action, n_floor = f->n_floor;
    for (int j = 0; j < n_floor; j++) {
        double *row = h->by_drift + (ptrdiff_t)j * h->stride;
        for (int i = 0; i < h->n; i++) {
            for (int k = 0; k < h->n; k++) {
                row[i] -= h->by_moment[(ptrdiff_t)i * h->stride + k] *
                          f->stiffness[(n_floor + k) * n + j];
            }
        }
    }
    for (int i = 0; i < n_floor; i++) {
        for (int j = 0; j <= i; j++) {
            double sum = f->stiffness[i * n + j];
            for (int k = 0; k < h->n; k++) {
                sum += f->stiffness[i * n + n_floor + k] *
                       h->by_drift[(ptrdiff_t)j * h->stride + k];
            }
            h->initial[i * n_floor + j] = h->initial[j * n_floor + i] = sum;
        }
    }
}

int hinges_create(struct plane_frame *f, const struct hinge *hinge, struct arena *a,
                  struct error *e) {
    struct hinges *h = arena_alloc(a, 1, sizeof *h);
    if (!h) {
        return error_no_memory(e);
    }
    const size_t n_floor = (size_t)f->n_floor, stride = (size_t)lanes_whole(f->n_hinge);
    *h = (struct hinges){.n = f->n_hinge, .n_floor = f->n_floor, .stride = (int)stride};
    h->hinge = hinges_take(h, hinge, a);
    h->by_drift = arena_alloc(a, n_floor * stride, sizeof *h->by_drift);
    h->by_moment = arena_alloc(a, (size_t)h->n * stride, sizeof *h->by_moment);
    h->initial = arena_alloc(a, n_floor * n_floor, sizeof *h->initial);
    if (!h->hinge || !h->by_drift || !h->by_moment || !h->initial) {
        return error_no_memory(e);
    }
    f->hinges = h;
    if (!hinges_invert(f, h)) {
        return error_set(e, STATUS_INPUT, "the stiffness of its hinges is not finite");
    }
    hinges_reduce_at_first(f, h);
    return STATUS_OK;
}
