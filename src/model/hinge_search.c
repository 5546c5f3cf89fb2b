// SPDX-License-Identifier: GPL-3.0-or-later
// Each law is its initial line and a departure s from it, m = k r + s. With K = S_rr + diag(k), and
// F = -S_rd, the rotations in equilibrium are
//     r = P d - B s(r),   B = K^-1,   P = B F,   and   V = (S_dd - F' P) d + P' s.
// B and P are found once. Hinges that have not yielded have s = 0, so an elastic step is the
// product P d and a look at the laws.
//
// Newton's method finds the rotations from u = K r + s - F d, the unbalanced moments. With the
// tangents k - e of the laws, only hinges with e != 0 (set A) enter the system
//     (1/e - B_AA) y = -(B u)_A,   dr = B (y - u),
// and u = s(r + dr) - s(r) + y is left. For laws whose tangent is not negative, u is the gradient
// of a convex potential: a step that goes too far is shortened until u is small along it. The
// consistent tangent is S_dd - F' P - P_A' (1/e - B_AA)^-1 P_A.
//
// K - diag(e) is positive definite if and only if the factorisation L D L' of 1/e - B_AA has a
// positive pivot for each e > 0 and a negative one for each e < 0; those come first. It is not
// where laws soften, or where a joint can turn without resistance as all its hinges yield at
// constant moments. Then the tangents of the laws are raised to SOFTEST times k for a step, which
// so goes downhill, and ends at another equilibrium if the hinges soften faster than the members
// unload. Equal hinges that soften together keep together, although one of them alone would do: the
// tangent there is that of this path.
#include "model/hinge_search.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "core/lanes.h"
#include "core/number.h"

// Iterations, and trials along one step.
enum { ITERATIONS_MAX = 200, TRIALS_MAX = 40 };

// A pivot this small, relative to its entry, is rounding.
static const double HELD = 1e-12;
static const double SOFTEST = 1e-6;

// A change of the departure from k r this small, relative to the moment, is rounding of the law.
static const double ROUNDING = 8.0 * DBL_EPSILON;

// Unbalanced moments this small against the largest of all hinges are rounding: laws compute their
// moments from k r.
static const double BALANCED = 256.0 * DBL_EPSILON;
// Where rounding lets a further step not improve them, they may be so large.
static const double BALANCED_LEAST = 1e-10;

// A share of a step is large enough if the slope of the potential at its end is this share of that
// at its start at most.
static const double FLAT = 0.25;

// Vectors (stride) of the scratch.
enum { VECTORS = 12 };

int hinge_search_n_scratch(const struct hinges *h) {
    return VECTORS * h->stride + h->n * (h->n + h->n_floor);
}

struct hinge_search hinge_search_begin(const struct hinges *h, const double *history, double *after,
                                       double *scratch) {
    double *vector[VECTORS];
    for (int i = 0; i < VECTORS; i++) {
        vector[i] = scratch + (ptrdiff_t)i * h->stride;
    }
    double *matrix = scratch + (ptrdiff_t)VECTORS * h->stride;
    return (struct hinge_search){
        .h = h,
        .departure = history + h->n,
        .history = history + hinges_of_laws(h->n),
        .after = after ? after + hinges_of_laws(h->n) : NULL,
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
LANES static void hinge_search_flex(const struct hinges *h, const double *moment, double sign,
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
LANES static void hinge_search_place(const struct hinges *h, const double *drift,
                                     const double *departure, double *restrict turn) {
    const ptrdiff_t n = h->stride;
    memset(turn, 0, (size_t)n * sizeof *turn);
    for (int j = 0; j < h->n_floor; j++) {
        const double *restrict row = h->by_drift + j * n;
        for (ptrdiff_t i = 0; i < n; i++) {
            turn[i] += row[i] * drift[j];
        }
    }
    hinge_search_flex(h, departure, -1.0, turn);
}

void hinge_search_laws(const struct hinge_search *x, struct hinge_point *p) {
    p->size = 0.0;
    for (int i = 0; i < x->h->n; i++) {
        const struct hinge *hinge = &x->h->hinge[i];
        const struct storey *s = &hinge->storey;
        const struct storey_response r =
            s->law->respond(s->constant, x->history + s->history, p->turn[i],
                            x->after ? x->after + s->history : NULL);
        const double line = hinge->stiffness * p->turn[i], departure = r.shear - line;
        const double size = fabs(r.shear) + fabs(line);
        const bool stays = fabs(departure - x->departure[i]) <= ROUNDING * size;
        p->departure[i] = stays ? x->departure[i] : departure;
        p->softening[i] = hinge->stiffness - r.tangent;
        p->size = number_max(p->size, size);
    }
}

// Are the unbalanced moments at a point this small against `size`?
static bool hinge_search_is_balanced(const struct hinge_search *x, const struct hinge_point *p,
                                     double share) {
    double most = 0.0;
    for (int i = 0; i < x->h->n; i++) {
        most = number_max(most, fabs(p->unbalance[i]));
    }
    return most <= share * p->size;
}

// Lists set A: hinges that are stiffer than at first, then softer ones.
static void hinge_search_list_active(struct hinge_search *x) {
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

static double hinge_search_entry(const struct hinge_search *x, int i, int j) {
    return x->h->by_moment[(ptrdiff_t)x->order[i] * x->h->stride + x->order[j]];
}

// Factorises 1/e - B_AA with tangents of at least `least` times the initial ones. False: a pivot
// has the wrong sign, or with ANY_SIGN is rounding.
enum pivots { RIGHT_SIGN, ANY_SIGN };
LANES static bool hinge_search_factorise(struct hinge_search *x, double least, enum pivots pivots) {
    const int n = x->n_active;
    for (int i = 0; i < n; i++) {
        const int hinge = x->order[i];
        const double most = (1.0 - least) * x->h->hinge[hinge].stiffness;
        double *row = x->factor + (ptrdiff_t)i * n;
        for (int j = i; j < n; j++) {
            row[j] = -hinge_search_entry(x, i, j);
        }
        row[i] += 1.0 / fmin(x->at.softening[hinge], most);
    }
    for (int j = 0; j < n; j++) {
        const double *restrict row = x->factor + (ptrdiff_t)j * n;
        const double e = x->at.softening[x->order[j]];
        const double pivot = pivots == ANY_SIGN ? fabs(row[j]) : row[j] * copysign(1.0, e);
        if (!(pivot > HELD / fabs(e))) {
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
static void hinge_search_find_step(const struct hinge_search *x) {
    const int n = x->n_active;
    const struct hinges *h = x->h;
    double *y = x->right;
    memset(x->step, 0, (size_t)h->stride * sizeof *x->step);
    hinge_search_flex(h, x->at.unbalance, 1.0, x->step);
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
    hinge_search_flex(h, x->push, 1.0, x->step);
}

// Goes a share of the step: the trial point, and the slope of the potential there.
static double hinge_search_try(struct hinge_search *x, double share) {
    const struct hinge_point *at = &x->at;
    struct hinge_point *to = &x->trial;
    double slope = 0.0;
    for (int i = 0; i < x->h->n; i++) {
        to->turn[i] = at->turn[i] + share * x->step[i];
    }
    hinge_search_laws(x, to);
    for (int i = 0; i < x->h->n; i++) {
        to->unbalance[i] = (1.0 - share) * at->unbalance[i] + to->departure[i] - at->departure[i] +
                           share * x->push[i];
        slope += to->unbalance[i] * x->step[i];
    }
    return slope;
}

// Takes the step, or a share of it up to which the potential falls all the way, nearly to its least
// value on the step.
static void hinge_search_advance(struct hinge_search *x) {
    const struct hinge_point start = x->at;
    double low = 0.0, high = 1.0, share = 1.0, slope_0 = 0.0;
    for (int i = 0; i < x->h->n; i++) {
        slope_0 += x->at.unbalance[i] * x->step[i];
    }
    double slope = hinge_search_try(x, share), slope_low = slope_0, slope_high = slope;
    bool good = slope <= 0.0 || hinge_search_is_balanced(x, &x->trial, BALANCED_LEAST);
    for (int i = 0; !good && i < TRIALS_MAX; i++) {
        const double secant = low + (high - low) * slope_low / (slope_low - slope_high);
        share = i % 2 == 0 ? secant : (low + high) / 2.0;
        slope = hinge_search_try(x, share);
        *(slope > 0.0 ? &high : &low) = share;
        *(slope > 0.0 ? &slope_high : &slope_low) = slope;
        good = slope <= 0.0 && slope >= FLAT * slope_0;
    }
    x->at = x->trial;
    x->trial = start;
}

bool hinge_search_find(struct hinge_search *x, const double *drift) {
    const struct hinges *h = x->h;
    const double *departure = x->departure;
    hinge_search_place(h, drift, departure, x->at.turn);
    hinge_search_laws(x, &x->at);
    for (int i = 0; i < h->n; i++) {
        x->at.unbalance[i] = x->at.departure[i] - departure[i];
    }
    for (int i = 0; i < ITERATIONS_MAX && !hinge_search_is_balanced(x, &x->at, BALANCED); i++) {
        hinge_search_list_active(x);
        if (!hinge_search_factorise(x, -INFINITY, RIGHT_SIGN) &&
            !hinge_search_factorise(x, SOFTEST, RIGHT_SIGN)) {
            return false;
        }
        const bool nearly = hinge_search_is_balanced(x, &x->at, BALANCED_LEAST);
        hinge_search_find_step(x);
        hinge_search_advance(x);
        if (nearly) {  // rounding may not let it become better
            break;
        }
    }
    return hinge_search_is_balanced(x, &x->at, BALANCED_LEAST);
}

void hinge_search_add_shear(const struct hinge_search *x, const double *drift, double *shear) {
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

// P_A with the factor L^-1 before it, in `right`. False: there is none.
static bool hinge_search_reduce(struct hinge_search *x) {
    const int n = x->n_active, n_floor = x->h->n_floor;
    if (!hinge_search_factorise(x, -INFINITY, RIGHT_SIGN) &&
        !hinge_search_factorise(x, -INFINITY, ANY_SIGN) &&
        !hinge_search_factorise(x, SOFTEST, RIGHT_SIGN)) {
        return false;
    }
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n_floor; j++) {
            x->right[i * n_floor + j] = x->h->by_drift[(ptrdiff_t)j * x->h->stride + x->order[i]];
        }
    }
    for (int i = 0; i < n; i++) {
        const double *row = x->factor + (ptrdiff_t)i * n, *own = x->right + (ptrdiff_t)i * n_floor;
        for (int k = i + 1; k < n; k++) {
            const double share = row[k] * x->inverse[i];
            for (int j = 0; j < n_floor; j++) {
                x->right[k * n_floor + j] -= share * own[j];
            }
        }
    }
    return true;
}

bool hinge_search_add_tangent(struct hinge_search *x, double *by_drift) {
    const int n_floor = x->h->n_floor;
    hinge_search_list_active(x);
    if (!hinge_search_reduce(x)) {
        return false;
    }
    for (int i = 0; i < n_floor; i++) {
        for (int j = 0; j <= i; j++) {
            double sum = x->h->initial[i * n_floor + j];
            for (int k = 0; k < x->n_active; k++) {
                const double *row = x->right + (ptrdiff_t)k * n_floor;
                sum -= row[i] * row[j] * x->inverse[k];
            }
            by_drift[i * n_floor + j] += sum;
            by_drift[j * n_floor + i] += i == j ? 0.0 : sum;
        }
    }
    return true;
}
