// SPDX-License-Identifier: GPL-3.0-or-later
// The force of the dashpots of Rayleigh damping in storeys that yield. A storey has the initial
// stiffness k, the yield shear V_y and the drift rate r. Rayleigh damping with the coefficients
// alpha and beta gives the storey a dashpot beta k beside its spring. If the storey is an isolator
// (soft, and all storeys above it stay elastic), the mass M above it moves at the rate r, too, and
// its dashpots to the ground have the force alpha M r. Both forces together are the share
//
//     s = (beta k + alpha M) r / V_y
//
// of the yield shear. Dashpots do not yield. In a cycle of harmonic drift between -u and u, the
// dashpots dissipate pi s V_y u. An elastoplastic spring with the yield drift u_y dissipates
// 4 V_y (u - u_y). So at s = 10 % the dashpots add at least 8 % to the hysteretic energy, and the
// computed drifts are a few per cent too small. J. F. Hall (2006), Problems encountered from the
// use (or misuse) of Rayleigh damping, Earthquake Eng. Struct. Dyn. 35, 525-545.
#include "model/guidance.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>

#include "core/arena.h"
#include "model/rate_storeys.h"

static const double SHARE_MAX = 0.1;

// The force of the dashpots divided by the yield shear: of the dashpots alpha M, and of all.
struct share {
    int storey;  // from 1; 0: no storey yields
    double mass, all;
};

// The yield shear of storey i; infinite: it stays elastic.
static double yield_of(const struct model *m, const struct building *g, int i) {
    const struct storey *s = rate_storeys_of(g, i);
    return s ? s->yield : m->storey[g->first + i].yield;
}

// True if storey i is an isolator: less than half as stiff as the storey above, and all storeys
// above stay elastic.
static bool isolates(const struct model *m, const struct building *g, int i) {
    bool elastic = i + 1 < g->n_floor && g->stiffness[i] < 0.5 * g->stiffness[i + 1];
    for (int j = i + 1; elastic && j < g->n_floor; j++) {
        elastic = isinf(yield_of(m, g, j));
    }
    return elastic;
}

// Does Rayleigh damping give the building dashpots that do not follow the tangent stiffness?
static bool has_dashpots(const struct building *g) {
    bool has = g->damping_alpha > 0.0;
    for (int i = 0; i < g->n_floor; i++) {
        has |= g->damping_storey[i] > 0.0;
    }
    return has;
}

double damping_warning(const struct model *m, const struct building *g, const double *rate,
                       const char *known, char text[DAMPING_TEXT_SIZE]) {
    assert(rate && known && text);
    const struct unit_system *u = &m->deck->units;
    // The storey with the largest share.
    struct share share = {0};
    double above = 0.0;
    for (int i = g->n_floor - 1; i >= 0; i--) {
        above += g->mass[i];
        const double by_rate = rate[i] / yield_of(m, g, i);
        const double mass = isolates(m, g, i) ? g->damping_alpha * above * by_rate : 0.0;
        const double all = mass + g->damping_storey[i] * by_rate;
        if (all > share.all) {
            share = (struct share){i + 1, mass, all};
        }
    }
    const bool by_mass = share.all - share.mass <= SHARE_MAX;
    if (share.all > SHARE_MAX) {
        snprintf(text, DAMPING_TEXT_SIZE,
                 "the Rayleigh damping of building %s has dashpots %s storeys that yield: in "
                 "storey %d their force is %.2g times the yield force at the %slargest drift rate "
                 "of %.3g %s/%s, so drifts come out too small; %s",
                 g->name, by_mass ? "between the ground and floors above" : "in", share.storey,
                 share.all, known, rate[share.storey - 1], u->length_name, u->time_name,
                 by_mass ? "give rayleigh -beta without -alpha"
                         : "leave such storeys out with -storeys, or use -tangent");
    }
    return share.all > SHARE_MAX ? share.all : 0.0;
}

int damping_find(const struct model *m, bool warns, struct damping_finding *most, struct error *e) {
    double *velocity = arena_alloc(m->deck->arena, (size_t)2 * FLOORS_MAX, sizeof *velocity);
    double *rate = velocity + FLOORS_MAX;
    struct damping_finding found;
    most->share = 0.0;
    if (!velocity) {
        return error_no_memory(e);
    }
    for (int k = 0; k < m->n_building; k++) {
        const struct building *g = &m->building[k];
        if (g->elastic || !has_dashpots(g)) {
            continue;
        }
        if (floor_velocity(m, k, velocity, rate, e) != STATUS_OK) {
            return e->status;
        }
        found.building = k;
        found.share = damping_warning(m, g, rate, "estimated ", found.text);
        if (found.share > 0.0 && warns) {
            deck_warning(m->deck, g->damping, "%s", found.text);
        }
        if (found.share > most->share) {
            *most = found;
        }
    }
    return STATUS_OK;
}
