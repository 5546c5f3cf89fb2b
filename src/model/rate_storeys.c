// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/rate_storeys.h"

#include <assert.h>
#include <string.h>

#include "core/arena.h"
#include "model/parts.h"
#include "model/storey_force.h"

// The storeys of the part; law NULL: in the chain.
static const struct storey *rate_storeys_all(const struct part *p) {
    return p->data;
}

static void rate_storeys_respond(const struct part *p, const double *history, const double *drift,
                                 const double *rate, const struct part_sums *to, double *after) {
    const struct storey *storey = rate_storeys_all(p);
    for (int i = 0; i < p->n; i++) {
        if (!storey[i].law) {
            continue;
        }
        const struct storey_rate_response r =
            storey_respond_at_rate(&storey[i], history, drift[i], rate[i], after);
        if (to->shear) {
            to->shear[i] += r.shear;
        }
        if (to->by_drift) {
            to->by_drift[parts_diagonal(to, p->n, i)] += r.tangent;
        }
        if (to->by_rate) {
            to->by_rate[parts_diagonal(to, p->n, i)] += r.dashpot;
        }
    }
}

static double rate_storeys_stored(const struct part *p, const double *history,
                                  const double *drift) {
    const struct storey *storey = rate_storeys_all(p);
    double sum = 0.0;
    for (int i = 0; i < p->n; i++) {
        if (storey[i].law) {
            sum += storey[i].law->stored(storey[i].constant, history + storey[i].history, drift[i]);
        }
    }
    return sum;
}

static const struct part_kind rate_storeys = {
    .name = "rate-storeys",
    .traits = PART_SHARELESS | PART_DIAGONAL,
    .respond = rate_storeys_respond,
    .stored = rate_storeys_stored,
};

void rate_storeys_put(struct builder *b, struct building_draft *d, struct building *g) {
    const size_t n = (size_t)d->n_floor;
    int n_rate = 0, n_history = 0;
    for (size_t i = 0; i < n; i++) {
        n_rate += d->storey[i].law && d->storey[i].law->respond_at_rate;
    }
    if (n_rate == 0 || d->foundation) {
        return;
    }
    struct storey *storey = arena_alloc(b->arena, n, sizeof *storey);
    double *spring = arena_alloc(b->arena, n, sizeof *spring);
    if (!storey || !spring) {
        return;
    }
    for (size_t i = 0; i < n; i++) {
        const struct storey *s = &d->storey[i];
        const bool rated = s->law && s->law->respond_at_rate;
        spring[i] = rated ? 0.0 : g->spring[i];
        if (rated) {
            storey[i] = *s;
            storey[i].history = n_history;
            n_history += s->law->n_history;
        }
    }
    g->spring = spring;
    builder_add_part(
        b, d,
        &(struct part){
            .kind = &rate_storeys, .n = d->n_floor, .data = storey, .n_history = n_history});
}

const struct storey *rate_storeys_of(const struct building *g, int i) {
    assert(i >= 0 && i < g->n_dof);
    for (int k = 0; k < g->n_part; k++) {
        if (g->part[k].kind == &rate_storeys && rate_storeys_all(&g->part[k])[i].law) {
            return &rate_storeys_all(&g->part[k])[i];
        }
    }
    return NULL;
}
