// SPDX-License-Identifier: GPL-3.0-or-later
#include "law/restitution.h"

#include <assert.h>
#include <math.h>

#include "core/root.h"
#include "law/isolated.h"

// The impacts are integrated to about 1e-12.
static const double TOLERANCE = 1e-12;
// The result may differ from the guess by a factor of at most 2 to this power.
enum { DOUBLINGS_MAX = 20 };

struct wanted {
    const struct contact_law *law;
    double restitution;
};

// The delivered restitution minus the requested one; NAN if the impact cannot be computed.
static double excess(double zeta, void *context) {
    const struct wanted *w = context;
    double value[CONTACT_ROWS_MAX];
    for (int i = 0; i < w->law->n_row; i++) {
        value[i] = w->law->row[i].fallback;
    }
    value[contact_law_row(w->law, "k")] = 1.0;
    value[contact_law_row(w->law, "zeta")] = zeta;
    double constant[CONTACT_CONSTANTS_MAX];
    struct isolated_impact impact;
    struct error e;
    if (w->law->prepare(value, 1.0, constant, &e) != STATUS_OK ||
        isolated_run(w->law, constant, 1.0, 1.0, NULL, &impact, &e) != STATUS_OK) {
        return NAN;
    }
    return impact.restitution - w->restitution;
}

double calibrate_by_impact(const struct contact_law *law, double e, double guess) {
    assert(law && e > 0.0 && e <= 1.0);
    if (e == 1.0) {
        return 0.0;
    }
    struct wanted wanted = {.law = law, .restitution = e};
    double low = guess;
    double high = guess;
    for (int i = 0; i < DOUBLINGS_MAX && excess(low, &wanted) < 0.0; i++) {
        low /= 2.0;
    }
    for (int i = 0; i < DOUBLINGS_MAX && excess(high, &wanted) > 0.0; i++) {
        high *= 2.0;
    }
    if (low == high) {
        return excess(low, &wanted) == 0.0 ? low : NAN;
    }
    return root_find(excess, &wanted, low, high, TOLERANCE);
}
