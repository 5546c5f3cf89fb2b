// SPDX-License-Identifier: GPL-3.0-or-later
// Two floors meet at most about as fast as the root of the sum of the squares of what each does
// alone (floor_velocity.h); where neither moves by itself, as the fastest pair of the model. The
// duration is that of an isolated impact of the two masses at that velocity; laws that stiffen are
// over the sooner the faster it is, so slower impacts last longer. Storeys make little
// difference as long as contacts are stiffer.
//
// The stiffness of a contact is that of the linear one that lasts as long, t = pi sqrt(m*/k): k =
// m* (pi / t)^2. Of two spheres (Hertz) that is 0.73 times the stiffness of the same peak force.
//
// Average acceleration is wrong by (omega h)^2 / 12 in the period of an oscillator, and a contact
// is about half a period: 50 steps in it are wrong by pi^2 / 12 / 50^2 = 3e-4, and 20 in a period
// by 0.8 %. Laws of a lower order (docs/accuracy.md) are wrong by more.
#include "model/guidance.h"

#include <float.h>
#include <gsl/gsl_math.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "law/isolated.h"
#include "model/floor_velocity.h"
#include "model/link_end.h"

// Velocities of the floors that the contacts join, and of nobody else; `rate` is scratch.
static int find_velocities(const struct model *m, int n_contact, double *velocity, double *rate,
                           struct error *e) {
    for (int i = 0; i < m->n_building; i++) {
        const struct building *g = &m->building[i];
        bool hit = false;
        for (int k = 0; k < n_contact; k++) {
            hit |= m->link[k].building[0] == i || m->link[k].building[1] == i;
        }
        if (hit && floor_velocity(m, i, velocity + g->first, rate, e) != STATUS_OK) {
            return e->status;
        }
    }
    return STATUS_OK;
}

static double closing_velocity(const struct link *l, const double *velocity) {
    return hypot(link_at(l, 0, velocity), link_at(l, 1, velocity));
}

// Effective mass of the floors, whatever -meff says of the law.
static double effective_mass(const struct model *m, const struct link *l) {
    return 1.0 / link_mobility(l, m->mass);
}

static bool same_impact(const struct model *m, int a, int b, const struct guidance_contact *c) {
    const struct link *x = &m->link[a];
    const struct link *y = &m->link[b];
    int n = contact_law_n_constant(x->law, x->value);
    return x->law == y->law && c[a].velocity == c[b].velocity &&
           effective_mass(m, x) == effective_mass(m, y) &&
           n == contact_law_n_constant(y->law, y->value) &&
           memcmp(x->constant, y->constant, (size_t)n * sizeof *x->constant) == 0;
}

// Stiffness of the stiffest storey below or above the floors that the link joins.
static double stiffest_beside(const struct model *m, const struct link *l) {
    double stiffest = 0.0;
    for (int i = 0; i < 2; i++) {
        const struct building *g = l->building[i] == WALL ? NULL : &m->building[l->building[i]];
        for (int k = 0; g && k < link_entries(l, i); k++) {
            const int floor = link_entry(l, i, k).dof - g->first;
            for (int j = floor; j <= floor + 1 && j < g->n_floor; j++) {
                stiffest = fmax(stiffest, g->stiffness[j]);
            }
        }
    }
    return stiffest;
}

static double count_storeys(const struct model *m, const struct link *l, double duration) {
    const double storey = stiffest_beside(m, l);
    return duration > 0.0 && storey > 0.0 && !(l->law->traits & CONTACT_BUMPER)
               ? effective_mass(m, l) * pow(M_PI / duration, 2.0) / storey
               : NAN;
}

static int find_duration(const struct model *m, int k, struct guidance_contact *c,
                         struct error *e) {
    const struct link *l = &m->link[k];
    if (k > 0 && same_impact(m, k, k - 1, c)) {
        c[k].duration = c[k - 1].duration;
        return STATUS_OK;
    }
    c[k].duration = l->law->rebound ? 0.0 : NAN;
    if (c[k].velocity > 0.0 &&
        isolated_duration(l->law, l->constant, effective_mass(m, l), c[k].velocity, &c[k].duration,
                          e) == STATUS_SYSTEM) {
        return STATUS_SYSTEM;
    }
    return STATUS_OK;
}

static int find_contacts(const struct model *m, struct guidance *g, struct error *e) {
    struct arena *a = m->deck->arena;
    g->n_contact = m->n_contact < GUIDANCE_CONTACTS_MAX ? m->n_contact : GUIDANCE_CONTACTS_MAX;
    struct guidance_contact *c = arena_alloc(a, (size_t)g->n_contact, sizeof *c);
    double *velocity = arena_alloc(a, (size_t)m->n_dof, sizeof *velocity);
    double *rate = arena_alloc(a, (size_t)m->n_dof, sizeof *rate);
    if (!c || !velocity || !rate) {
        return error_no_memory(e);
    }
    int status = find_velocities(m, g->n_contact, velocity, rate, e);
    double fastest = 0.0;
    for (int k = 0; k < g->n_contact && status == STATUS_OK; k++) {
        c[k].velocity = closing_velocity(&m->link[k], velocity);
        fastest = fmax(fastest, c[k].velocity);
    }
    g->contact = c;
    g->shortest = -1;
    for (int k = 0; k < g->n_contact && status == STATUS_OK; k++) {
        c[k].velocity = c[k].velocity > 0.0 ? c[k].velocity : fastest;
        status = find_duration(m, k, c, e);
        c[k].storeys = count_storeys(m, &m->link[k], c[k].duration);
        bool first = g->shortest < 0 || c[k].duration < c[g->shortest].duration;
        g->shortest = c[k].duration > 0.0 && first ? k : g->shortest;
    }
    return status;
}

static void take_signal(struct guidance *g, const struct signal *s) {
    if (s->value) {
        g->sampling = fmin(g->sampling, s->dt);
    } else if (s->omega > 0.0) {
        g->sine = fmin(g->sine, 2.0 * M_PI / s->omega);
    }
}

double guidance_round(double step) {
    double power = pow(10.0, floor(log10(step)));
    double share = step / power * (1.0 + 8.0 * DBL_EPSILON);
    return share < 1.0 ? 0.5 * power
                       : (share < 2.0    ? 1.0
                          : share < 5.0  ? 2.0
                          : share < 10.0 ? 5.0
                                         : 10.0) *
                             power;
}

int guidance_find(const struct model *m, struct guidance *out, struct error *e) {
    *out = (struct guidance){.period = INFINITY, .sampling = INFINITY, .sine = INFINITY};
    int status = find_contacts(m, out, e);
    if (status != STATUS_OK) {
        return status;
    }
    for (int i = 0; i < m->n_building; i++) {
        out->period = fmin(out->period, 2.0 * M_PI / model_fastest(m, i));
    }
    for (int i = 0; i < m->n_ground; i++) {
        for (int j = 0; j < m->ground[i].n_signal; j++) {
            take_signal(out, &m->ground[i].signal[j]);
        }
    }
    for (int i = 0; i < m->n_load; i++) {
        take_signal(out, &m->load[i].signal);
    }
    double step = fmin(fmin(out->period, out->sine) / GUIDANCE_PERIOD_STEPS, out->sampling);
    if (out->shortest >= 0) {
        step = fmin(step, out->contact[out->shortest].duration / GUIDANCE_CONTACT_STEPS);
    }
    out->bound = step;
    out->step = isfinite(step) ? guidance_round(step) : INFINITY;
    return STATUS_OK;
}
