// SPDX-License-Identifier: GPL-3.0-or-later
// Energies relative to the ground. The work of a force over a step is the mean of its values at
// both ends times the displacement. For the average acceleration method this is no approximation of
// the balance: m (v1^2 - v0^2) / 2 = (u1 - u0) m (a0 + a1) / 2 holds exactly, so with equilibrium
// at both ends the account closes to rounding, whatever the forces do in between (Hughes (2000),
// The Finite Element Method, section 9.2). For other beta and gamma the residual is what the method
// itself gains or loses.
//
// Where two buildings stand on grounds that move differently, link forces also work on the grounds;
// that work enters by the input.
//
// A link that is closed or strained at t = 0 holds the energy that its force, at rest, would take
// to bring it there; it is initial energy, and the first of the work done on the link.
#include "solve/account/account.h"

#include <gsl/gsl_integration.h>

#include "core/lanes.h"
#include "model/parts.h"
#include "model/storey_force.h"

enum { CQUAD_INTERVALS = 100 };
static const double CQUAD_TOLERANCE = 1e-12;

static const struct fields_row list[] = {
    FIELD_VALUES(struct energy_account, initial, stored_start),
    FIELD_ARRAY(struct energy_account, storey_2x, FIELD_FLOORS),
    FIELD_ARRAY(struct energy_account, storey_own, FIELD_FLOORS),
};
const struct fields energy_fields = FIELDS(list);

static double energy_sum_of(const double x[LANES_WIDTH]) {
    double sum = 0.0;
    for (int i = 0; i < LANES_WIDTH; i++) {
        sum += x[i];
    }
    return sum;
}

// Storeys with parts share shears, so that one that is not elastic makes others of all.
struct energy_sums energy_sums_of(const struct energy_account *a, const struct model *m,
                                  const struct state *s) {
    double kinetic_2x = 0.0, elastic = 0.0, other = 0.0, storey_2x = 0.0, damped = 0.0;
    for (int i = 0; i < m->n_dof; i++) {
        kinetic_2x += m->mass[i] * s->v[i] * s->v[i];
    }
    for (const struct building *g = m->building; g < m->building + m->n_body; g++) {
        for (int i = g->first; i < g->first + g->n_dof; i++) {
            const struct storey *law = &m->storey[i];
            const bool is_elastic = law->law->n_history == 0 && (g->n_part == 0 || g->elastic);
            *(is_elastic ? &elastic : &other) += storey_stored(law, s->storey_history, s->drift[i]);
            storey_2x += is_elastic ? 0.0 : a->storey_2x[i];
        }
        if (g->n_part > 0) {
            *(g->elastic ? &elastic : &other) +=
                parts_stored(g, s->storey_history, s->drift + g->first);
            damped += parts_damped(g, s->storey_history);
        }
    }
    return (struct energy_sums){
        .kinetic = kinetic_2x / 2.0,
        .elastic = elastic,
        .other = other,
        .storey = a->storey + storey_2x / 2.0 - damped,
        .damped = damped,
        .input_2x = energy_sum_of(a->input_2x),
        .damping_2x = energy_sum_of(a->damping_2x),
    };
}

// A link and its history, for the force that it would have at rest.
struct resting_link {
    const struct link *link;
    const double *history;
};

static double energy_resting_force(double d, void *context) {
    const struct resting_link *r = context;
    return r->link->law->force(r->link->constant, r->history, d, 0.0).force;
}

int energy_start(struct energy_account *a, const struct model *m, const struct state *s,
                 struct link_peak *link, struct error *e) {
    state_assert(s, m);
    lanes_assert(a->storey_2x, m->n_dof);
    const struct energy_sums sums = energy_sums_of(a, m, s);
    a->stored_start = sums.other;
    a->initial = sums.kinetic + sums.elastic + sums.other;
    for (int i = 0; i < s->n_live; i++) {
        int k = s->live[i];
        struct resting_link resting = {&m->link[k], s->link_history + m->link[k].history};
        if (s->delta[k] == 0.0 || m->link[k].law->rebound) {
            continue;
        }
        // The integral from 0 to delta of the force at rest; the method stands kinks and infinite
        // slopes.
        gsl_function force = {.function = energy_resting_force, .params = &resting};
        gsl_integration_cquad_workspace *w = gsl_integration_cquad_workspace_alloc(CQUAD_INTERVALS);
        double energy = 0.0;
        if (!w) {
            return error_no_memory(e);
        }
        gsl_integration_cquad(&force, 0.0, s->delta[k], 0.0, CQUAD_TOLERANCE, w, &energy, NULL,
                              NULL);
        gsl_integration_cquad_workspace_free(w);
        a->initial += energy;
        a->contact += energy;
        link[k].dissipated += energy;
    }
    return STATUS_OK;
}

void energy_meet(struct energy_account *a, const struct model *m, const struct state *s,
                 const struct meeting *meeting) {
    for (int k = 0; k < m->n_contact; k++) {
        const struct link *l = &m->link[k];
        a->contact += meeting[k].work;
        if (meeting[k].struck) {
            a->input += meeting[k].impulse * state_ground_gap(l, m, s->ground_v);
        }
    }
}

const char *const energy_names[] = {"input",      "kinetic", "strain",  "damping",
                                    "hysteretic", "contact", "residual"};

void energy_close(const struct energy_account *a, const struct energy_sums *sums, double *energy) {
    energy[ENERGY_INPUT] = a->input + sums->input_2x / 2.0;
    energy[ENERGY_KINETIC] = sums->kinetic;
    energy[ENERGY_STRAIN] = sums->elastic + sums->other;
    energy[ENERGY_DAMPING] = a->damping + sums->damping_2x / 2.0 + sums->damped;
    energy[ENERGY_HYSTERETIC] = sums->storey - (sums->other - a->stored_start);
    energy[ENERGY_CONTACT] = a->contact;
    energy[ENERGY_RESIDUAL] = a->initial + energy[ENERGY_INPUT] - energy[ENERGY_KINETIC] -
                              energy[ENERGY_STRAIN] - energy[ENERGY_DAMPING] -
                              energy[ENERGY_HYSTERETIC] - energy[ENERGY_CONTACT];
}
