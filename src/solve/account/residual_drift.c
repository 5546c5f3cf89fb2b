// SPDX-License-Identifier: GPL-3.0-or-later
// A storey that stands still without loads has no shear. From its state at the end it gets there on
// the path of its law: the drift goes back in small steps, which the history follows, until the
// shear has changed its sign.
#include "solve/account/residual_drift.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "law/root.h"

// Steps of the way back at the initial stiffness, and how many times as long the way may be.
enum { STEPS = 200, WAYS = 20 };

// A storey on its way.
struct unloading {
    const struct storey *storey;
    double history[STOREY_HISTORY_MAX];
};

static double shear_at(double drift, void *context) {
    const struct unloading *u = context;
    return u->storey->law->shear(u->storey->constant, u->history, drift).shear;
}

static double unload(const struct storey *storey, const double *history, double stiffness,
                     double drift) {
    struct unloading u = {.storey = storey};
    memcpy(u.history, history, (size_t)storey->law->n_history * sizeof *history);
    const double shear = shear_at(drift, &u);
    const double step = -shear / stiffness / STEPS;
    for (int i = 0; i < WAYS * STEPS && shear != 0.0; i++) {
        const double next = drift + step;
        if (shear_at(next, &u) * shear <= 0.0) {
            return root_find(shear_at, &u, fmin(drift, next), fmax(drift, next), DBL_EPSILON);
        }
        storey->law->commit(storey->constant, u.history, next);
        drift = next;
    }
    return shear == 0.0 ? drift : (double)NAN;
}

void residual_drifts(const struct model *m, const struct state *s, double *out) {
    for (int k = 0; k < m->n_building; k++) {
        const struct building *b = &m->building[k];
        for (int i = b->first; i < b->first + b->n_floor; i++) {
            const struct storey *storey = &m->storey[i];
            out[i] = storey->law->n_history == 0
                         ? 0.0
                         : fabs(unload(storey, s->storey_history + storey->history,
                                       b->stiffness[i - b->first], s->drift[i]));
        }
    }
}
