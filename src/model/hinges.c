// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/hinges.h"

#include <assert.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

#include "core/lanes.h"
#include "model/hinge_search.h"

int hinges_n_history(const struct hinges *h) {
    return h->n_history;
}

int hinges_n_scratch(const struct hinges *h) {
    return hinge_search_n_scratch(h);
}

const struct hinge *hinges_at(const struct plane_frame *f, int i) {
    assert(f->hinges && i >= 0 && i < f->hinges->n);
    return &f->hinges->hinge[i];
}

// With r = P d - B s.
void hinges_on_departures(const struct plane_frame *f, const double *row, double *out) {
    const struct hinges *h = f->hinges;
    for (int j = 0; j < f->n_action; j++) {
        const int own = j - f->n_floor;
        const double *by = own < 0 ? h->by_drift + (ptrdiff_t)j * h->stride
                                   : h->by_moment + (ptrdiff_t)own * h->stride;
        double sum = 0.0;
        for (int k = 0; k < h->n; k++) {
            sum += row[f->n_floor + k] * by[k];
        }
        out[j] = own < 0 ? row[j] + sum : -sum;
    }
}

static const struct hinges *hinges_of(const struct part *p) {
    return ((const struct plane_frame *)p->data)->hinges;
}

static void hinges_respond(const struct part *p, const double *history, const double *drift,
                           const double *rate, const struct part_sums *to, double *after) {
    const struct hinges *h = hinges_of(p);
    const int n = h->n;
    (void)rate;
    assert(to->scratch);
    struct hinge_search x =
        hinge_search_begin(h, history, after != history ? after : NULL, to->scratch);
    const bool found = hinge_search_find(&x, drift);
    if (found && to->shear) {
        hinge_search_add_shear(&x, drift, to->shear);
    }
    if (!found || (to->by_drift && !hinge_search_add_tangent(&x, to->by_drift))) {
        *(to->shear ? to->shear : to->by_drift) = (double)NAN;
    }
    if (after == history) {
        x.after = after + hinges_of_laws(n);
        hinge_search_laws(&x, &x.at);
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
        sum += s->law->stored(s->constant, history + hinges_of_laws(f->n_hinge) + s->history,
                              history[i]);
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
    h->n_history = (int)hinges_of_laws(h->n) + n_history;
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
                sum +=
                    f->stiffness[i * n + n_floor + k] * h->by_drift[(ptrdiff_t)j * h->stride + k];
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
