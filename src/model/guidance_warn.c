// SPDX-License-Identifier: GPL-3.0-or-later
// The contact of a small steel ball lasts 9 us (docs/verification.md), and no bumper gives way by a
// metre where floors meet at velocities that earthquakes give them. How far a contact does is
// estimated as that of a linear one, v t / pi.
#include <gsl/gsl_math.h>
#include <math.h>

#include "core/text.h"
#include "model/guidance.h"

enum { STEPS_FEW = 10 };                  // longer steps are cut, see docs/theory.md
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
                 "%.2g steps%s; fewer than %d are cut; step fixed %g resolves it",
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
