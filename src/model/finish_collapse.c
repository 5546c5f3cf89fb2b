// SPDX-License-Identifier: GPL-3.0-or-later
// The drift at which each storey ends the run. Where several statements name a storey, the smallest
// limit counts. A storey whose building can yield and has P-delta loses its equilibrium without
// bounds: it ends the run at the latest when its drift is its height.
#include <math.h>

#include "deck/reader.h"
#include "model/finish.h"

// Takes the limit of a statement to storey i (from 0) of building k; false after a report.
static bool take(struct builder *b, const struct collapse_draft *c, int k, int i, double *limit) {
    const struct building_draft *d = builder_draft(b, k);
    if (c->is_ratio && !d->height) {
        return deck_error(
            b->deck, &c->word,
            "a limit of the drift ratio needs the storey heights of building %s; give "
            "building -height, or a limit of the drift",
            d->name);
    }
    const double drift = c->is_ratio ? c->limit * d->height[i] : c->limit;
    limit[i] = fmin(limit[i], drift);
    return true;
}

static void take_statement(struct builder *b, const struct model *m, const struct collapse_draft *c,
                           double *limit) {
    for (int k = 0; k < (c->storeys ? c->n_selection : m->n_building); k++) {
        const struct selection *s = c->storeys ? &c->storeys[k] : NULL;
        const int building = s ? s->building : k;
        const struct building *g = &m->building[building];
        for (int i = 0; i < (s ? s->n_floor : g->n_floor); i++) {
            if (!take(b, c, building, s ? s->floor[i] - 1 : i, limit + g->first)) {
                return;
            }
        }
    }
}

// The heights of storeys that may lose their equilibrium; true if there are any.
static bool take_heights(const struct model *m, double *limit) {
    bool any = false;
    for (int k = 0; k < m->n_building; k++) {
        const struct building *g = &m->building[k];
        for (int i = 0; g->axial && !g->elastic && i < g->n_floor; i++) {
            limit[g->first + i] = g->height[i];
            any = true;
        }
    }
    return any;
}

// Reports a storey whose limit is reached at the start.
static void check_start(struct builder *b, const struct model *m, const double *limit) {
    for (int k = 0; k < m->n_building; k++) {
        const struct building *g = &m->building[k];
        for (int i = 0; i < g->n_floor; i++) {
            const int at = g->first + i;
            const double drift = m->displacement[at] - (i > 0 ? m->displacement[at - 1] : 0.0);
            if (fabs(drift) >= limit[at]) {
                const struct word *given = builder_draft(b, k)->initial;
                deck_error(b->deck, given[i].text ? &given[i] : &given[i - 1],
                           "the initial drift of storey %d of building %s is %.4g, beyond the "
                           "limit of %.4g at which it collapses",
                           i + 1, g->name, fabs(drift), limit[at]);
                return;
            }
        }
    }
}

void finish_collapse(struct builder *b, struct model *m) {
    const struct collapse_draft *c = b->collapses.item;
    double *limit = arena_alloc(b->arena, (size_t)m->n_dof, sizeof *limit);
    if (!limit) {
        return;
    }
    for (int i = 0; i < m->n_dof; i++) {
        limit[i] = INFINITY;
    }
    const bool any = take_heights(m, limit);
    for (int i = 0; i < b->collapses.n; i++) {
        take_statement(b, m, &c[i], limit);
    }
    check_start(b, m, limit);
    m->collapse = any || b->collapses.n > 0 ? limit : NULL;
}
