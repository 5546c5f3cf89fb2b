// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/account/account.h"

#include <math.h>

#include "core/arena.h"
#include "core/number.h"
#include "model/foundation.h"
#include "model/frame.h"
#include "model/hinges.h"
#include "model/storey_force.h"

static const struct fields_row list[] = {
    FIELD_ARRAY(struct yielding, deformation, FIELD_ACTIONS),
    FIELD_ARRAY(struct yielding, force, FIELD_ACTIONS),
    FIELD_ARRAY(struct yielding, work_2x, FIELD_ACTIONS),
    FIELD_ARRAYS(struct yielding, most, FIELD_ACTIONS),
    FIELD_ARRAY(struct yielding, stored, FIELD_ACTIONS),
};
const struct fields yielding_fields = FIELDS(list);

bool yielding_differs(const struct storey *s) {
    const struct storey_figures f = storey_law_figures(s->law, s->constant);
    return f.yield[0] != f.yield[1];
}

// Storey `i` (from 0) of a building; law NULL: it is not noted.
static struct yielding_law yielding_storey(const struct model *m, const struct building *g, int i) {
    const struct storey *s = foundation_storey(m, g, i);
    const bool noted = s->law->n_history > 0 && (g->n_part > 0 || yielding_differs(s));
    struct yielding_law law = {
        .storey = noted ? s : NULL, .building = g, .history = s->history, .dof = g->first + i};
    for (int k = 0; k < g->n_part; k++) {
        const bool in_part = g->fixed ? k == 0 : g->part[k].data == s - i;
        law.history += in_part ? g->part[k].history : 0;
    }
    return law;
}

static struct yielding_law yielding_hinge(const struct building *g, const struct plane_frame *f,
                                          int i) {
    const struct hinge *h = hinges_at(f, i);
    return (struct yielding_law){.storey = &h->storey,
                                 .building = g,
                                 .history = g->departure + g->n_hinge + h->storey.history,
                                 .dof = -1,
                                 .hinge = g->first_hinge + i,
                                 .stiffness = h->stiffness};
}

bool yielding_alloc(struct yielding *y, const struct model *m, struct arena *a) {
    struct yielding_law *law = arena_alloc(a, (size_t)fields_actions(m), sizeof *law);
    *y = (struct yielding){.model = m, .law = law};
    for (int k = 0; law && k < m->n_building && !m->elastic; k++) {
        const struct building *g = &m->building[k];
        for (int i = 0; i < g->n_floor; i++) {
            law[y->n] = yielding_storey(m, g, i);
            y->n += law[y->n].storey != NULL;
        }
        const struct building *own = g->fixed ? g->fixed : g;
        for (int p = 0; p < own->n_part && g->n_hinge > 0; p++) {
            const struct plane_frame *f = frame_of(&own->part[p]);
            for (int i = 0; f && i < f->n_hinge; i++) {
                law[y->n++] = yielding_hinge(g, f, i);
            }
        }
    }
    return law != NULL;
}

// The deformation and the force of law `i` in a state.
static void yielding_read(const struct yielding *y, int i, const struct state *s,
                          double *deformation, double *force) {
    const struct yielding_law *l = &y->law[i];
    const double *history = s->storey_history;
    if (l->dof < 0) {
        const int own = l->hinge - l->building->first_hinge;
        const double *departure = history + l->building->departure + own;
        *deformation = departure[-l->building->n_hinge];
        *force = l->stiffness * *deformation + *departure;
        return;
    }
    const struct storey_law *law = l->storey->law;
    const double *constant = l->storey->constant, *own = history + l->history;
    *deformation = foundation_drift(y->model, l->building, l->dof, s->u);
    if (law->respond_at_rate) {
        const double rate = foundation_drift(y->model, l->building, l->dof, s->v);
        *force = law->respond_at_rate(constant, own, *deformation, rate, NULL).shear;
    } else {
        *force = law->respond(constant, own, *deformation, NULL).shear;
    }
}

static double yielding_stored(const struct yielding_law *l, const struct state *s, double x) {
    return l->storey->law->stored(l->storey->constant, s->storey_history + l->history, x);
}

void yielding_start(struct yielding *y, const struct state *s) {
    for (int i = 0; i < y->n; i++) {
        yielding_read(y, i, s, &y->deformation[i], &y->force[i]);
        y->most[0][i] = number_max(y->deformation[i], 0.0);
        y->most[1][i] = number_max(-y->deformation[i], 0.0);
        y->stored[i] = yielding_stored(&y->law[i], s, y->deformation[i]);
    }
}

void yielding_note(struct yielding *y, const struct state *s) {
    for (int i = 0; i < y->n; i++) {
        double x, force;
        yielding_read(y, i, s, &x, &force);
        y->work_2x[i] += (force + y->force[i]) * (x - y->deformation[i]);
        y->deformation[i] = x;
        y->force[i] = force;
        y->most[0][i] = number_max(y->most[0][i], x);
        y->most[1][i] = number_max(y->most[1][i], -x);
    }
}

// The figures of a law, with the constants of its damage index that the deck gives.
static struct storey_figures yielding_figures(const struct storey *s) {
    struct storey_figures f = storey_law_figures(s->law, s->constant);
    const double *given = s->damage;
    if (given && !isnan(given[STOREY_DAMAGE_ULTIMATE])) {
        f.ultimate[0] = f.ultimate[1] = given[STOREY_DAMAGE_ULTIMATE];
    }
    f.beta = given && !isnan(given[STOREY_DAMAGE_BETA]) ? given[STOREY_DAMAGE_BETA] : f.beta;
    return f;
}

// What a law has gone through, at `to`, with its history at the end. Laws only dissipate: what is
// below 0 is rounding.
static void yielding_demand(const struct storey *s, const double *history, const double most[2],
                            double hysteretic, struct yield_demand *to) {
    const struct storey_figures f = yielding_figures(s);
    const double consumed = s->law->consumed ? s->law->consumed(s->constant, history) : 0.0;
    to->value[YIELD_DUCTILITY] = storey_law_ductility(&f, most);
    to->value[YIELD_HYSTERETIC] = number_max(hysteretic, 0.0);
    to->value[YIELD_DETERIORATION] = consumed / f.capacity;
    to->value[YIELD_DAMAGE] = storey_law_damage(&f, most, hysteretic);
}

// The storeys of buildings without parts, from the account of energy and the peaks.
static void yielding_plain(const struct model *m, const struct energy_account *energy,
                           const struct state *s, struct results *r) {
    static const double none[STOREY_HISTORY_MAX];
    for (const struct building *g = m->building; g < m->building + m->n_building; g++) {
        for (int i = g->first; g->n_part == 0 && i < g->first + g->n_floor; i++) {
            const struct storey *own = &m->storey[i];
            if (own->law->n_history == 0) {
                continue;
            }
            const double *u = m->displacement + i;
            const double start = u[0] - (i > g->first ? u[-1] : 0.0);
            struct storey without = *own;
            without.history = 0;
            const double stored = storey_stored(own, s->storey_history, s->drift[i]) -
                                  storey_stored(&without, none, start);
            const double most[] = {r->peak[PEAK_DRIFT][i], r->peak[PEAK_DRIFT][i]};
            yielding_demand(own, s->storey_history + own->history, most,
                            energy->storey_2x[i] / 2.0 + energy->storey_own[i] - stored,
                            &r->storey_demand[i]);
        }
    }
}

void yielding_finish(struct yielding *y, const struct energy_account *energy, const struct state *s,
                     struct results *r) {
    yielding_note(y, s);
    yielding_plain(y->model, energy, s, r);
    for (int i = 0; i < y->n; i++) {
        const struct yielding_law *l = &y->law[i];
        const bool even = l->dof >= 0 && !yielding_differs(l->storey);
        const double peak = even ? r->peak[PEAK_DRIFT][l->dof] : 0.0;
        const double most[] = {number_max(y->most[0][i], peak), number_max(y->most[1][i], peak)};
        struct yield_demand *to =
            l->dof < 0 ? &r->hinge_demand[l->hinge] : &r->storey_demand[l->dof];
        const double stored = yielding_stored(l, s, y->deformation[i]) - y->stored[i];
        const double hysteretic =
            l->building->n_part > 0 ? y->work_2x[i] / 2.0 - stored : to->value[YIELD_HYSTERETIC];
        yielding_demand(l->storey, s->storey_history + l->history, most, hysteretic, to);
    }
}
