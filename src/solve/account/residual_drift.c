// SPDX-License-Identifier: GPL-3.0-or-later
// A storey that stands still without loads has no shear. Laws know the shear at any drift that is
// reached straight from their history, so that this drift is a root of the shear, on the side to
// which it pulls.
#include "solve/account/residual_drift.h"

#include <float.h>
#include <math.h>

#include "core/root.h"
#include "solve/account/settle.h"

enum { DOUBLINGS = 60 };

struct unloading {
    const struct storey *storey;
    const double *history;
};

static double residual_drift_shear(double drift, void *context) {
    const struct unloading *u = context;
    return u->storey->law->respond(u->storey->constant, u->history, drift, NULL).shear;
}

// The way back is that at the initial stiffness, or longer where the law softens or yields back.
static double residual_drift_unload(struct unloading u, double stiffness, double drift) {
    const double shear = residual_drift_shear(drift, &u);
    double way = -shear / stiffness;
    for (int i = 0; i < DOUBLINGS && residual_drift_shear(drift + way, &u) * shear > 0.0; i++) {
        way *= 2.0;
    }
    const double low = fmin(drift, drift + way), high = fmax(drift, drift + way);
    return shear == 0.0 ? drift : root_find(residual_drift_shear, &u, low, high, DBL_EPSILON);
}

void residual_drifts(const struct model *m, const struct state *s, double *out) {
    for (int k = 0; k < m->n_building; k++) {
        const struct building *b = &m->building[k];
        if (b->n_part > 0 && !b->elastic) {
            settle_drifts(m, s, b, out + b->first);
            continue;
        }
        for (int i = b->first; i < b->first + b->n_floor; i++) {
            const struct storey *storey = &m->storey[i];
            const struct unloading u = {storey, s->storey_history + storey->history};
            out[i] = storey->law->n_history == 0
                         ? 0.0
                         : fabs(residual_drift_unload(u, b->stiffness[i - b->first], s->drift[i]));
        }
    }
}
