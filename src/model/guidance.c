// SPDX-License-Identifier: GPL-3.0-or-later
// Estimates of the contacts of a model and of the step that they need, before an analysis.
//
// Velocity: the largest closing velocity of two floors is about the square root of the sum of
// squares of their velocities (floor_velocity). If neither floor moves, it is the closing velocity
// of the fastest pair of the model.
// Duration: that of an isolated impact of the two masses at this velocity. The contacts of laws
// that stiffen last longer at smaller velocities. Storeys have little effect on the duration,
// because contacts are stiffer. Stiffness: that of a linear contact of the same duration t = pi
// sqrt(m*/k), which is k = m* (pi / t)^2. For two spheres (Hertz) it is 0.73 times the stiffness
// with the same peak force. Step: the method of average acceleration has an error of (omega h)^2 /
// 12 in the period of an oscillator. A contact is about half a period. So 50 steps in a contact
// have an error of pi^2 / 12 / 50^2 = 3e-4, and 20 steps in a period an error of 0.8 %. Laws of a
// lower order (docs/accuracy.md) have larger errors.
#include "model/guidance.h"

#include <assert.h>
#include <float.h>
#include <gsl/gsl_math.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "core/text.h"
#include "law/isolated.h"
#include "model/link_end.h"
#include "model/struck_column.h"

// Computes the velocities of the floors of all buildings with contacts. `rate` is scratch.
static int find_velocities(const struct model *m, int n_contact, double *velocity, double *rate,
                           struct error *e) {
    for (int i = 0; i < m->n_building; i++) {
        const struct building *g = &m->building[i];
        bool hit = false;
        for (int k = 0; k < n_contact; k++) {
            const int *at = m->link[k].building;
            hit |= struck_column_host(m, at[0]) == i || struck_column_host(m, at[1]) == i;
        }
        if (hit && floor_velocity(m, i, velocity + g->first, rate, e) != STATUS_OK) {
            return e->status;
        }
    }
    for (int i = 0; i < m->n_column; i++) {
        const struct link *spring = &m->link[struck_column_spring(m, i)];
        velocity[m->column[i].dof[0]] = link_at(spring, 0, velocity);
    }
    return STATUS_OK;
}

static double closing_velocity(const struct link *l, const double *velocity) {
    return hypot(link_at(l, 0, velocity), link_at(l, 1, velocity));
}

// The effective mass of the floors; -meff does not change it.
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

static double count_storeys(const struct model *m, const struct link *l, double duration) {
    // The stiffness of the stiffest storey directly below or above the ends of the link,
    // but for isolators, which slide.
    double storey = 0.0;
    for (int i = 0; i < 2; i++) {
        const struct building *g = l->building[i] == WALL ? NULL : &m->building[l->building[i]];
        for (int k = 0; g && k < link_entries(l, i); k++) {
            const int floor = link_entry(l, i, k).dof - g->first;
            for (int j = floor; j <= floor + 1 && j < g->n_dof; j++) {
                storey = fmax(storey, j + 1 == g->isolated ? 0.0 : g->stiffness[j]);
            }
        }
    }
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
    for (int i = 0; i < m->n_body; i++) {
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

// Limits of the warnings. The contact of a small steel ball lasts 9 us (docs/verification.md). At
// the velocities of floors in earthquakes no bumper has a penetration of a metre. The penetration
// is estimated as that of a linear contact, v t / pi.
enum { STEPS_FEW = 10 };                  // the solver rejects longer steps, see docs/theory.md
static const double DURATION_MIN = 1e-6;  // [s]
static const double VELOCITY_MAX = 20.0;  // [m/s]
static const double DEPTH_MAX = 1.0;      // [m]

// The contacts of one warning: the first one, and their number.
struct finding {
    int n, first;
};

static void find(struct finding *f, int k) {
    f->first = f->n++ == 0 ? k : f->first;
}

// Estimated penetration [L].
static double depth(const struct guidance_contact *c) {
    return c->velocity * c->duration / M_PI;
}

static void warn_step(const struct model *m, const struct guidance *g, int n_short) {
    const struct guidance_contact *c = &g->contact[g->shortest];
    const struct unit_system *u = &m->deck->units;
    deck_warning(m->deck, &m->step,
                 "step %.6g %s covers contact %s, which lasts about %.2g %s at %.2g %s/%s, by "
                 "%.2g steps%s; fewer than %d are rejected; step fixed %g resolves it",
                 m->dt, u->time_name, m->link[g->shortest].name, c->duration, u->time_name,
                 c->velocity, u->length_name, u->time_name, c->duration / m->dt,
                 n_short > 1 ? ", others too" : "", STEPS_FEW,
                 guidance_round(c->duration / GUIDANCE_CONTACT_STEPS));
}

static bool is_soft(const struct model *m, const struct guidance_contact *c) {
    const double metre = m->deck->units.length;
    return c->velocity * metre / m->deck->units.time <= VELOCITY_MAX &&
           depth(c) * metre > DEPTH_MAX;
}

// Least stiffness of a contact, in stiffnesses of the stiffest storey beside it. In five pairs of
// buildings the drifts with ten storey stiffnesses differed by up to 5 % from those with rigid
// contacts, and with one storey stiffness by up to 23 %.
static const double STOREYS_MIN = 10.0;

static bool same_statement(const struct link *a, const struct link *b) {
    const struct place *x = &a->word->place, *y = &b->word->place;
    return x->source == y->source && x->line == y->line;
}

void guidance_warn_storeys(const struct model *m, int n_contact,
                           const struct guidance_contact *contact, guidance_where *where,
                           void *context) {
    assert(n_contact >= 0 && n_contact <= m->n_contact);
    for (int first = 0, last; first < n_contact; first = last + 1) {
        const struct link *l = &m->link[first];
        int softest = first;
        for (last = first; last + 1 < n_contact && same_statement(l, &m->link[last + 1]); last++) {
            bool softer = !(contact[softest].storeys <= contact[last + 1].storeys);
            softest = softer ? last + 1 : softest;
        }
        if (contact[softest].storeys < STOREYS_MIN) {
            deck_warning(m->deck, l->word,
                         "contact %s is only %.2g times as stiff as the stiffest storey beside "
                         "it%s; below %g drifts depend on the stiffness of the contact: compare "
                         "with stiffer ones; a bumper has law rubber or table",
                         m->link[softest].name, contact[softest].storeys,
                         where ? where(context, softest) : "", STOREYS_MIN);
        }
    }
}

void guidance_warn(const struct model *m, const struct guidance *g) {
    struct finding hard = {0}, soft = {0}, endless = {0}, unresolved = {0};
    for (int k = 0; k < g->n_contact; k++) {
        const struct guidance_contact *c = &g->contact[k];
        if (isnan(c->duration) && c->velocity > 0.0) {
            find(&endless, k);
        } else if (c->duration > 0.0 && c->duration * m->deck->units.time < DURATION_MIN) {
            find(&hard, k);
        } else if (is_soft(m, c)) {
            find(&soft, k);
        }
        if (!m->adaptive && c->duration > 0.0 && c->duration < STEPS_FEW * m->dt) {
            find(&unresolved, k);
        }
    }
    if (hard.n > 0) {
        const struct link *l = &m->link[hard.first];
        struct text_more more;
        deck_warning(m->deck, l->word,
                     "contact %s%s lasts about %.2g %s, shorter than any contact of bodies; is its "
                     "stiffness in the units of the deck?",
                     l->name, text_more(&more, hard.n), g->contact[hard.first].duration,
                     m->deck->units.time_name);
    } else if (unresolved.n > 0) {
        warn_step(m, g, unresolved.n);
    }
    if (soft.n > 0) {
        const struct unit_system *u = &m->deck->units;
        const struct guidance_contact *c = &g->contact[soft.first];
        const struct link *l = &m->link[soft.first];
        struct text_more more;
        deck_warning(m->deck, l->word,
                     "contact %s%s gives way by about %.2g %s at %.2g %s/%s; is its stiffness in "
                     "the units of the deck?",
                     l->name, text_more(&more, soft.n), depth(c), u->length_name, c->velocity,
                     u->length_name, u->time_name);
    }
    if (endless.n > 0) {
        const struct finding *f = &endless;
        const struct unit_system *u = &m->deck->units;
        const struct link *l = &m->link[f->first];
        struct text_more more;
        deck_warning(m->deck, l->word,
                     "contact %s%s does not part bodies that meet at %.2g %s/%s: its damping is so "
                     "strong that they stick",
                     l->name, text_more(&more, f->n), g->contact[f->first].velocity, u->length_name,
                     u->time_name);
    }
}
