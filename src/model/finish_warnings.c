// SPDX-License-Identifier: GPL-3.0-or-later
// Warnings about input that is allowed but is probably a mistake.
#include <gsl/gsl_math.h>

#include "core/text.h"
#include "model/finish.h"
#include "model/pairs.h"
#include "model/struck_column.h"

static const double ROUNDING = 1e-9;
static const double STEPS_PER_CYCLE = 10.0;  // fewer steps do not resolve a vibration
static const double SAME_LEVEL = 0.01;       // relative difference of the levels of two floors

static bool same_statement(const struct word *a, const struct word *b) {
    return a->place.line == b->place.line && a->place.source == b->place.source;
}

// True if the signal acts during the analysis. Warns if it does not, or if the step is too long
// for it.
static bool check_signal(struct builder *b, const struct model *m, const struct signal *s,
                         const struct word *w) {
    const char *unit = b->deck->units.time_name;
    if (s->start >= m->duration || signal_peak(s) == 0.0) {
        deck_warning(b->deck, w,
                     s->start >= m->duration ? "%s starts after the end of the analysis"
                                             : "%s is zero throughout",
                     s->name);
        return false;
    }
    if (m->adaptive) {
        return true;
    }
    if (s->value && m->dt > s->dt * (1.0 + ROUNDING)) {
        deck_warning(b->deck, &b->step, "step %.6g %s is longer than the sampling %.6g %s of %s",
                     m->dt, unit, s->dt, unit, s->name);
    }
    double cycle = s->value || s->omega == 0.0 ? INFINITY : 2.0 * M_PI / s->omega;
    if (m->dt * STEPS_PER_CYCLE > cycle * (1.0 + ROUNDING)) {
        deck_warning(b->deck, &b->step, "step %.6g %s is too long for a sine of period %.6g %s",
                     m->dt, unit, cycle, unit);
    }
    return true;
}

static bool share_a_building(const struct model *m, const struct ground_draft *a,
                             const struct ground_draft *b) {
    bool found = false;
    for (int i = 0; i < m->n_building; i++) {
        found |= finish_acts_under(a, i) && finish_acts_under(b, i);
    }
    return found;
}

// The index of the sample with the largest absolute value.
static size_t peak_sample(const struct signal *s) {
    size_t i = 0;
    while (fabs(s->value[i]) < s->peak) {
        i++;
    }
    return i;
}

// True if one record is the other one, multiplied by a factor, at the same times.
static bool same_record(const struct signal *a, const struct signal *b) {
    if (!a->value || !b->value || a->peak * b->peak == 0.0 || a->n != b->n || a->dt != b->dt ||
        a->start != b->start) {
        return false;
    }
    const size_t peak = peak_sample(a);
    const double rounding = ROUNDING * a->peak * b->peak;
    for (size_t i = 0; i < a->n; i++) {
        if (fabs(a->value[i] * b->value[peak] - b->value[i] * a->value[peak]) > rounding) {
            return false;
        }
    }
    return true;
}

static void check_repeated(struct builder *b, const struct model *m) {
    const struct ground_draft *g = b->grounds.item;
    for (int i = 0; i < b->grounds.n; i++) {
        for (int j = 0; j < i; j++) {
            if (same_record(&g[j].signal, &g[i].signal) && share_a_building(m, &g[j], &g[i])) {
                deck_warning(b->deck, &g[i].word,
                             "%s acts twice at the same time under a building, where it adds up",
                             g[i].signal.name);
                return;
            }
        }
    }
}

static bool is_shaken(const struct builder *b, int building) {
    bool found = false;
    for (int i = 0; i < b->grounds.n; i++) {
        found |= finish_acts_under((const struct ground_draft *)b->grounds.item + i, building);
    }
    return found;
}

// Warns about a building without a ground motion: the user probably forgot it in -buildings.
static void check_unshaken(struct builder *b, const struct model *m) {
    const struct ground_draft *g = b->grounds.item;
    int first = -1, n = 0;
    for (int i = m->n_building - 1; i >= 0; i--) {
        if (finish_stands(&m->building[i]) && !is_shaken(b, i)) {
            first = i;
            n++;
        }
    }
    if (n > 0 && b->grounds.n > 0) {
        struct text_more more;
        deck_warning(b->deck, &g[b->grounds.n - 1].word,
                     "no ground motion acts under building %s%s; -buildings does not name it",
                     m->building[first].name, text_more(&more, n));
    }
}

static bool starts_moving(const struct builder *b, const struct model *m) {
    bool moves = false;
    for (int i = 0; i < m->n_dof; i++) {
        moves |= m->displacement[i] != 0.0 || m->velocity[i] != 0.0;
    }
    for (int i = 0; i < b->links.n; i++) {
        moves |= ((const struct link_draft *)b->links.item + i)->link.gap < 0.0;
    }
    return moves;
}

static void check_periods(struct builder *b, const struct model *m) {
    for (int i = 0; !m->adaptive && i < m->n_building; i++) {
        double period = 2.0 * M_PI / m->building[i].omega[0];
        if (m->dt * STEPS_PER_CYCLE > period) {
            const char *unit = b->deck->units.time_name;
            deck_warning(b->deck, &b->step,
                         "step %.6g %s is too long for building %s, whose first period is %.4g %s",
                         m->dt, unit, m->building[i].name, period, unit);
            return;
        }
    }
}

static bool is_linked(const struct builder *b, int building) {
    const struct link_draft *d = b->links.item;
    bool found = false;
    for (int i = 0; i < b->links.n; i++) {
        const struct link *l = &d[i].link;
        found |= l->bilateral && (l->building[0] == building || l->building[1] == building);
    }
    return found;
}

// Warns about a building without damping if other buildings have damping.
static void check_dampings(struct builder *b, const struct model *m) {
    const struct building_draft *first = NULL;
    int n_damped = 0, n = 0;
    for (int i = m->n_building - 1; i >= 0; i--) {
        const struct building_draft *d = builder_draft(b, i);
        if (d->damping.n > 0) {
            n_damped++;
        } else if (finish_stands(&m->building[i]) && !is_linked(b, i)) {
            first = d;
            n++;
        }
    }
    if (first && n_damped > 0) {
        struct text_more more;
        deck_warning(
            b->deck, &first->word,
            "building %s%s has no damping, although others have; write damping %s rayleigh 0 if "
            "that is meant",
            first->name, text_more(&more, n), first->name);
    }
}

static double ground_displacement(const struct ground *g, double t) {
    double sum = 0.0;
    for (int i = 0; i < g->n_signal; i++) {
        double v;
        double u;
        signal_integrals(&g->signal[i], t, &v, &u);
        sum += u;
    }
    return sum;
}

// Warns about grounds that move differently and do not come to rest: their distance at the end of
// the records is an error of the records.
static void check_drift(struct builder *b, const struct model *m) {
    const struct link_draft *draft = b->links.item;
    for (int i = 0; i < b->links.n; i++) {
        const struct link *l = &draft[i].link;
        if (!l->moving_ground || l->bilateral) {
            continue;
        }
        const struct building *left = &m->building[l->building[0]];
        const struct building *right = &m->building[l->building[1]];
        double apart = ground_displacement(&m->ground[right->ground], m->duration) -
                       ground_displacement(&m->ground[left->ground], m->duration);
        if (fabs(apart) > l->gap) {
            deck_warning(b->deck, &draft[i].word,
                         "the grounds of %s and %s end %.4g %s apart, more than the gap of contact "
                         "%s: their accelerations do not integrate to rest",
                         left->name, right->name, apart, b->deck->units.length_name, l->name);
            return;
        }
    }
}

static double level(const struct building *g, int floor) {
    return g->height ? level_of_floor(g->height, floor) : 0.0;
}

// True if the storey heights put the ends of the contact at different levels.
static bool at_two_levels(const struct model *m, const struct link *l, double at[2]) {
    for (int i = 0; i < 2; i++) {
        at[i] = l->building[i] == WALL ? 0.0
                : !isnan(l->level[i])  ? l->level[i]
                                       : level(&m->building[l->building[i]], l->floor[i]);
    }
    return at[0] > 0.0 && at[1] > 0.0 && fabs(at[0] - at[1]) > SAME_LEVEL * fmax(at[0], at[1]);
}

// Warns about different levels in a statement, which made the `n` contacts from `d` on.
static void check_levels(struct builder *b, const struct model *m, const struct link_draft *d,
                         int n) {
    const struct link_draft *first = NULL;
    int count = 0;
    double at[2];
    for (int i = n - 1; i >= 0; i--) {
        const bool level = !isnan(d[i].link.level[0]) || !isnan(d[i].link.level[1]);
        if ((!d[i].floors || level) && at_two_levels(m, &d[i].link, at)) {
            first = &d[i];
            count++;
        }
    }
    if (first && !isnan(fmin(first->link.level[0], first->link.level[1]))) {
        at_two_levels(m, &first->link, at);
        deck_warning(b->deck, &first->word, "the ends of contact %s are at %.4g and %.4g %s",
                     first->link.name, at[0], at[1], b->deck->units.length_name);
    } else if (first) {
        struct text_more more;
        at_two_levels(m, &first->link, at);
        deck_warning(b->deck, &first->word,
                     "the floors of contact %s%s are at %.4g and %.4g %s; name the floors that "
                     "meet, or write BUILDING@LEVEL where a floor hits columns between two floors",
                     first->link.name, text_more(&more, count), at[0], at[1],
                     b->deck->units.length_name);
    }
}

static void check_between(struct builder *b, const struct model *m, const struct link_draft *d) {
    const struct link *l = &d->link;
    if (l->building[0] == WALL || l->building[1] == WALL) {
        return;
    }
    const int right = struck_column_host(m, l->building[1]);
    for (int k = struck_column_host(m, l->building[0]) + 1; k < right; k++) {
        if (m->building[k].n_floor >= l->floor[0] && m->building[k].n_floor >= l->floor[1]) {
            deck_warning(b->deck, &d->word, "building %s is between the floors of contact %s",
                         m->building[k].name, l->name);
        }
    }
}

void finish_warnings(struct builder *b, const struct model *m) {
    // excited: a signal sets the buildings in motion.
    bool excited = false;
    for (int i = 0; i < b->grounds.n; i++) {
        const struct ground_draft *g = (const struct ground_draft *)b->grounds.item + i;
        excited |= check_signal(b, m, &g->signal, &g->word);
        // An analysis that is shorter than the record may end before the strongest shaking.
        const struct signal *s = &g->signal;
        const char *unit = b->deck->units.time_name;
        const double peak = s->value ? s->start + (double)peak_sample(s) * s->dt : 0.0;
        if (s->start < m->duration && peak > m->duration * (1.0 + ROUNDING)) {
            deck_warning(b->deck, &b->duration,
                         "the analysis ends at %.6g %s, before the peak of %s at %.6g %s",
                         m->duration, unit, s->name, peak, unit);
        }
    }
    for (int i = 0; i < b->loads.n; i++) {
        const struct load_draft *l = (const struct load_draft *)b->loads.item + i;
        bool same = i > 0 && same_statement(&l[-1].word, &l->word);
        excited |= same || check_signal(b, m, &l->signal, &l->word);
    }
    if (!excited && !starts_moving(b, m)) {
        deck_warning(b->deck, NULL,
                     "nothing moves the buildings: no ground motion, load or initial state");
    }
    finish_magnitudes(b, m);
    check_periods(b, m);
    check_repeated(b, m);
    check_drift(b, m);
    check_unshaken(b, m);
    check_dampings(b, m);
    // At most one warning of each kind for a statement.
    const struct link_draft *draft = b->links.item;
    for (int i = 0, n; i < b->links.n; i += n) {
        n = 1;
        while (i + n < b->links.n && same_statement(&draft[i].word, &draft[i + n].word)) {
            n++;
        }
        if (!draft[i].link.bilateral) {
            check_levels(b, m, &draft[i], n);
            check_between(b, m, &draft[i]);
        }
    }
}
