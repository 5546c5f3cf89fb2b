// SPDX-License-Identifier: GPL-3.0-or-later
// A bearing of constant strength Q, stiffness k_d when it yields or slides and initial stiffness
// k_i is a bilinear storey: R = k_d / k_i and V_y = Q / (1 - R). So are bearings of lead and
// rubber, and those that slide with constant friction: Q = mu W and k_d = W / radius. Where the
// friction depends on the velocity, the law is fps.
#include "model/isolator.h"

#include <assert.h>
#include <math.h>

#include "law/lists.h"
#include "model/storey_choice.h"

// Initial stiffness of a bearing of lead and rubber over that after yield, if it is not given: a
// usual value (Naeim & Kelly 1999, Design of Seismic Isolated Structures, chapter 4).
static const double LEAD_RUBBER_RATIO = 10.0;

static double isolator_weight(struct builder *b, const struct building_draft *d,
                              const struct isolator_draft *q) {
    double sum = 0.0;
    for (int i = q->storey; i < d->n_floor; i++) {
        sum += d->load ? d->load[i] : d->mass[i] * builder_gravity(b);
    }
    return isnan(q->weight) ? sum : q->weight;
}

// A value of a row of a law, by its key.
struct isolator_value {
    const char *key;
    double value;
};

// Gives the storey the law with n values; rows without one have their fallbacks.
static void isolator_set(struct builder *b, struct building_draft *d,
                         const struct isolator_draft *q, const struct storey_law *law,
                         const struct isolator_value *of, int n, double ki) {
    double value[STOREY_ROWS_MAX];
    for (int r = 0; r < law->n_row; r++) {
        value[r] = law->row[r].fallback;
    }
    for (int i = 0; i < n; i++) {
        const int row = row_find(law->row, law->n_row, of[i].key);
        assert(row >= 0);
        value[row] = of[i].value;
    }
    d->stiffness[q->storey] = ki;
    storey_choices_law(b, &q->word, law, value, ki, &d->storey[q->storey]);
}

// The law of strength `strength` and stiffnesses kd, ki.
static void isolator_set_bilinear(struct builder *b, struct building_draft *d,
                                  const struct isolator_draft *q, double strength, double kd,
                                  double ki) {
    const struct isolator_value of[] = {{"yield", strength / (1.0 - kd / ki)},
                                        {"hardening", kd / ki}};
    d->storey[q->storey].yield = of[0].value;
    isolator_set(b, d, q, &storey_bilinear, of, 2, ki);
}

static void isolator_set_sliding(struct builder *b, struct building_draft *d,
                                 const struct isolator_draft *q) {
    const double weight = isolator_weight(b, d, q);
    const double kd = isnan(q->radius) ? 0.0 : weight / q->radius;
    const double strength = q->mu * weight, ki = kd + strength / q->yield_drift;
    if (isnan(q->mu_slow) && isnan(q->rate)) {
        isolator_set_bilinear(b, d, q, strength, kd, ki);
        return;
    }
    const struct isolator_value of[] = {{"weight", weight},
                                        {"radius", q->radius},
                                        {"mu", q->mu},
                                        {"mu-slow", q->mu_slow},
                                        {"rate", q->rate}};
    d->storey[q->storey].yield = ki * q->yield_drift;
    isolator_set(b, d, q, &storey_fps, of, 5, ki);
}

void isolator_finish(struct builder *b) {
    const struct isolator_draft *q = b->isolators.item;
    for (int i = 0; i < b->isolators.n; i++, q++) {
        struct building_draft *d = builder_draft(b, q->building);
        if (!d->mass || !d->stiffness || !d->storey) {
            continue;
        }
        if (q->slides) {
            isolator_set_sliding(b, d, q);
        } else {
            isolator_set_bilinear(b, d, q, q->q, q->kd,
                                  isnan(q->ki) ? LEAD_RUBBER_RATIO * q->kd : q->ki);
        }
    }
}
