// SPDX-License-Identifier: GPL-3.0-or-later
// A bearing of constant strength Q, stiffness k_d when it yields or slides and initial stiffness
// k_i is a bilinear storey: R = k_d / k_i and V_y = Q / (1 - R). So are bearings of lead and
// rubber, and those that slide with constant friction: Q = mu W and k_d = W / radius. Where the
// friction depends on the velocity, the law is fps.
#include "model/isolator.h"

#include <math.h>

#include "law/lists.h"
#include "model/storey_choices.h"

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

// The law of strength `q` and stiffnesses kd, ki; false after a report.
static bool isolator_set_bilinear(struct builder *b, struct building_draft *d,
                                  const struct isolator_draft *draft, double q, double kd,
                                  double ki) {
    enum { YIELD, HARDENING };  // rows of the law
    const double ratio = kd / ki;
    const double value[] = {[YIELD] = q / (1.0 - ratio), [HARDENING] = ratio};
    d->stiffness[draft->storey] = ki;
    d->storey[draft->storey].yield = value[YIELD];
    return storey_choices_law(b, &draft->word, &storey_bilinear, value, ki,
                              &d->storey[draft->storey]);
}

static bool isolator_set_sliding(struct builder *b, struct building_draft *d,
                                 const struct isolator_draft *q) {
    enum { WEIGHT, RADIUS, MU, MU_SLOW, RATE };  // rows of the law
    const double weight = isolator_weight(b, d, q);
    const double kd = isnan(q->radius) ? 0.0 : weight / q->radius;
    const double strength = q->mu * weight, ki = kd + strength / q->yield_drift;
    if (isnan(q->mu_slow) && isnan(q->rate)) {
        return isolator_set_bilinear(b, d, q, strength, kd, ki);
    }
    const double value[] = {[WEIGHT] = weight,
                            [RADIUS] = q->radius,
                            [MU] = q->mu,
                            [MU_SLOW] = q->mu_slow,
                            [RATE] = q->rate};
    d->stiffness[q->storey] = ki;
    d->storey[q->storey].yield = ki * q->yield_drift;
    return storey_choices_law(b, &q->word, &storey_fps, value, ki, &d->storey[q->storey]);
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
