// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/founded.h"

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
}

static double founded_stored(const struct part *p, const double *history, const double *drift) {
    const struct founded *f = p->data;
    const struct founded_motion slab = founded_motion(f, drift);
    double sum = parts_linear_stored(p, history, drift);
    for (int i = 0; i < f->n; i++) {
        const struct storey *s = &f->storey[i];
        if (s->law->n_history > 0) {
            sum += s->law->stored(s->constant, history + s->history,
                                  founded_deformation(f, i, drift, slab));
        }
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
