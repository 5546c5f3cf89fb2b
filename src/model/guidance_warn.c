// SPDX-License-Identifier: GPL-3.0-or-later
// The contact of a small steel ball lasts 9 us (docs/verification.md), and no bumper gives way by a
// metre where floors meet at velocities that earthquakes give them. How far a contact does is
// estimated as that of a linear one, v t / pi.
#include <gsl/gsl_math.h>
#include <math.h>

#include "core/text.h"
#include "model/guidance.h"

enum { STEPS_FEW = 10 };                  // longer steps are rejected, see docs/theory.md
static const double DURATION_MIN = 1e-6;  // [s]
static const double VELOCITY_MAX = 20.0;  // [m/s]
static const double DEPTH_MAX = 1.0;      // [m]

// Contacts that a warning is about: the first of them, and how many there are.
struct finding {
    int n, first;
};

static void find(struct finding *f, int k) {
    f->first = f->n++ == 0 ? k : f->first;
}

// [L]
static double depth(const struct guidance_contact *c) {
    return c->velocity * c->duration / M_PI;
}

static void warn_hard(const struct model *m, const struct guidance *g, const struct finding *f) {
    const struct link *l = &m->link[f->first];
    struct text_more more;
    deck_warning(m->deck, l->word,
                 "contact %s%s lasts about %.2g %s, shorter than any contact of bodies; is its "
                 "stiffness in the units of the deck?",
                 l->name, text_more(&more, f->n), g->contact[f->first].duration,
                 m->deck->units.time_name);
}

static void warn_soft(const struct model *m, const struct guidance *g, const struct finding *f) {
    const struct unit_system *u = &m->deck->units;
    const struct guidance_contact *c = &g->contact[f->first];
    const struct link *l = &m->link[f->first];
    struct text_more more;
    deck_warning(m->deck, l->word,
                 "contact %s%s gives way by about %.2g %s at %.2g %s/%s; is its stiffness in the "
                 "units of the deck?",
                 l->name, text_more(&more, f->n), depth(c), u->length_name, c->velocity,
                 u->length_name, u->time_name);
}

static void warn_endless(const struct model *m, const struct guidance *g, const struct finding *f) {
    const struct unit_system *u = &m->deck->units;
    const struct link *l = &m->link[f->first];
    struct text_more more;
    deck_warning(m->deck, l->word,
                 "contact %s%s does not part bodies that meet at %.2g %s/%s: its damping is so "
                 "strong that they stick",
                 l->name, text_more(&more, f->n), g->contact[f->first].velocity, u->length_name,
                 u->time_name);
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

// In five pairs of buildings drifts changed by up to 5 % from ten storeys to rigid contacts, from
// one storey by up to 23 %.
static const double STOREYS_MIN = 10.0;

static bool same_statement(const struct link *a, const struct link *b) {
    const struct place *x = &a->word->place, *y = &b->word->place;
    return x->source == y->source && x->line == y->line;
}

void guidance_warn_storeys(const struct model *m, int n_contact,
                           const struct guidance_contact *contact, guidance_where *where,
                           void *context) {
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
        warn_hard(m, g, &hard);
    } else if (unresolved.n > 0) {
        warn_step(m, g, unresolved.n);
    }
    if (soft.n > 0) {
        warn_soft(m, g, &soft);
    }
    if (endless.n > 0) {
        warn_endless(m, g, &endless);
    }
}
