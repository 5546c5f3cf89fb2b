// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/founded.h"

#include <assert.h>
#include <string.h>

#include "law/lists.h"
#include "model/parts.h"
#include "model/rate_storeys.h"
#include "model/storey_force.h"

static void founded_add_storey(const struct founded *f, int i, struct storey_rate_response r,
                               const struct part_sums *to) {
    const int n = f->n + 2;
    for (int j = 0; j < n; j++) {
        const double entry = founded_entry(f, i, j);
        if (to->shear) {
            to->shear[j] += entry * r.shear;
        }
        for (int k = 0; to->by_drift && k < n; k++) {
            to->by_drift[j * n + k] += r.tangent * (entry * founded_entry(f, i, k));
        }
        for (int k = 0; to->by_rate && k < n; k++) {
            to->by_rate[j * n + k] += r.dashpot * (entry * founded_entry(f, i, k));
        }
    }
}

// Scratch: deformations and their rates (n), shears (n), tangents D (n, n), D B (n, n + 2), that of
// the parts.
enum { DEFORMATION, RATE, SHEAR, N_VECTOR };

int founded_n_scratch(int n, int inner) {
    return n * (N_VECTOR + n + n + 2) + inner;
}

// Adds B' D B, symmetric to the bit.
static void founded_add_tangent(const struct founded *f, const double *tangent, double *product,
                                double *by_drift) {
    const int n = f->n, all = n + 2;
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < all; k++) {
            double sum = 0.0;
            for (int l = 0; l < n; l++) {
                sum += tangent[i * n + l] * founded_entry(f, l, k);
            }
            product[i * all + k] = sum;
        }
    }
    for (int j = 0; j < all; j++) {
        for (int k = 0; k <= j; k++) {
            double sum = 0.0;
            for (int i = 0; i < n; i++) {
                sum += founded_entry(f, i, j) * product[i * all + k];
            }
            by_drift[j * all + k] += sum;
            by_drift[k * all + j] += j != k ? sum : 0.0;
        }
    }
}

// Adds what the parts that are not linear do.
static void founded_add_parts(const struct founded *f, const double *history, const double *drift,
                              const double *rate, const struct part_sums *to, double *after) {
    const size_t n = (size_t)f->n;
    double *x = to->scratch, *tangent = x + N_VECTOR * n, *product = tangent + n * n;
    const struct founded_motion slab = founded_motion(f, drift), speed = founded_motion(f, rate);
    assert(x);
    memset(x, 0, (N_VECTOR + n) * n * sizeof *x);
    for (int i = 0; i < f->n; i++) {
        x[DEFORMATION * f->n + i] = founded_deformation(f, i, drift, slab);
        x[RATE * f->n + i] = founded_deformation(f, i, rate, speed);
    }
    const struct part_sums own = {.shear = to->shear ? x + SHEAR * n : NULL,
                                  .by_drift = to->by_drift ? tangent : NULL,
                                  .scratch = product + n * (n + 2)};
    for (int k = 0; k < f->n_part; k++) {
        const struct part *p = &f->part[k];
        p->kind->respond(p, history + p->history, x + DEFORMATION * n, x + RATE * n, &own,
                         after ? after + p->history : NULL);
    }
    for (int j = 0; to->shear && j < f->n + 2; j++) {
        for (int i = 0; i < f->n; i++) {
            to->shear[j] += founded_entry(f, i, j) * x[SHEAR * f->n + i];
        }
    }
    if (to->by_drift) {
        founded_add_tangent(f, tangent, product, to->by_drift);
    }
}

static void founded_respond(const struct part *p, const double *history, const double *drift,
                            const double *rate, const struct part_sums *to, double *after) {
    const struct founded *f = p->data;
    const struct founded_motion slab = founded_motion(f, drift);
    const struct founded_motion speed = founded_motion(f, rate);
    parts_linear_respond(p, history, drift, rate, to, after);
    for (int i = 0; i < f->n; i++) {
        const struct storey *s = &f->storey[i];
        if (s->law->n_history > 0) {
            const double deformation = founded_deformation(f, i, drift, slab);
            founded_add_storey(f, i,
                               storey_respond_at_rate(s, history, deformation,
                                                      founded_deformation(f, i, rate, speed),
                                                      after),
                               to);
        }
    }
    if (f->n_part > 0) {
        founded_add_parts(f, history, drift, rate, to, after);
    }
}

static double founded_stored(const struct part *p, const double *history, const double *drift) {
    const struct founded *f = p->data;
    const struct founded_motion slab = founded_motion(f, drift);
    double sum = parts_linear_stored(p, history, drift), deformation[FLOORS_MAX];
    for (int i = 0; i < f->n; i++) {
        const struct storey *s = &f->storey[i];
        deformation[i] = founded_deformation(f, i, drift, slab);
        if (s->law->n_history > 0) {
            sum += s->law->stored(s->constant, history + s->history, deformation[i]);
        }
    }
    for (int k = 0; k < f->n_part; k++) {
        const struct part *own = &f->part[k];
        sum += own->kind->stored(own, history + own->history, deformation);
    }
    return sum;
}

const struct part_kind founded_linear = {
    .name = "foundation",
    .traits = PART_LINEAR,
    .respond = parts_linear_respond,
    .stored = parts_linear_stored,
};
const struct part_kind founded_yields = {
    .name = "foundation",
    .respond = founded_respond,
    .stored = founded_stored,
};
