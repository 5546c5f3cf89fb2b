// SPDX-License-Identifier: GPL-3.0-or-later
// Warnings about magnitudes that no building, gap or ground motion has. They come from mixed-up
// units. The limits are far beyond the values of real structures:
//
//   - Period: the highest tower has 11.3 s (Baker, Korista & Novak 2007, The Structural Design of
//     Tall and Special Buildings 16, 361-375). Stiff masonry has about 0.05 s per storey. A stiff
//     containment of 0.2 s, modelled by 20 lumped masses, has 0.01 s per storey.
//   - Height: the same tower is 828 m high. Storeys of models on shaking tables are a few
//     centimetres high.
//   - Gap and initial displacement: twice the largest drift that ASCE 7-22 allows, 2.5 %
//     (table 12.12-1), of a height of 100 m.
//   - Initial velocity: that of such a displacement at a period of 1.5 s.
//   - Ground acceleration: the largest recorded horizontal value is 2.75 g (K-NET MYG004, Tohoku
//     2011). People do not feel less than 0.0005 g (ShakeMap, Worden et al. 2012, Bull. Seism. Soc.
//     Am. 102, 204-221). Users often mean g by a -pga or -sa without a unit. So the limit of such
//     values is 0.05 g, below which EN 1998-1:2004, 3.2.1 (5), speaks of very low seismicity.
#include <assert.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_statistics_double.h>

#include "core/text.h"
#include "model/finish.h"

static const double G = 9.80665;  // [m/s^2]

// One kind of magnitude, its limits and their unit.
struct magnitude {
    const char *what, *doubt, *unit;
    double min, max;
};
static const double STOREY_PERIOD_MIN = 0.01;  // [s]
static struct magnitude first_period(int n_floor) {
    return (struct magnitude){"first period of building",
                              "are its mass and stiffness in the units of the deck?", "s",
                              STOREY_PERIOD_MIN * n_floor, 15.0};
}
static const struct magnitude mean_storey = {"mean storey height of building",
                                             "are its heights in the units of the deck?", "m", 0.01,
                                             200.0};
static const struct magnitude total_height = {
    "height of building", "are its heights those of single storeys, in the units of the deck?", "m",
    0.0, 1000.0};
static const struct magnitude initial_displacement = {
    "initial displacement of building", "is it in the units of the deck?", "m", 0.0, 5.0};
static const struct magnitude initial_velocity = {
    "initial velocity of building", "is it in the units of the deck?", "m/s", 0.0, 20.0};
static const struct magnitude clear_gap = {"gap of contact", "is it in the units of the deck?", "m",
                                           0.0, 5.0};
static const struct magnitude ground_peak = {"peak of the ground motion",
                                             "are its unit and its scale right?", "g", 0.0005, 3.0};
static const struct magnitude bare_peak = {
    "peak of the ground motion", "is the number of -pga or -sa in g? give its unit, as in 0.35g",
    "g", 0.05, 3.0};

// Values beyond the limits of one kind: the first one, and their number.
struct finding {
    struct magnitude kind;  // kind of the first value
    const struct word *word;
    const char *name;  // of the owner of the value
    double value;
    int n;
};

static void look(const struct magnitude *kind, struct finding *f, const struct word *w,
                 const char *name, double value) {
    if ((value < kind->min || value > kind->max) && f->n++ == 0) {
        f->kind = *kind;
        f->word = w;
        f->name = name;
        f->value = value;
    }
}

static void report(struct builder *b, const struct finding *f) {
    const struct magnitude *kind = &f->kind;
    struct text_more more;
    if (f->n > 0) {
        deck_warning(b->deck, f->word, "the %s %s%s is %.4g %s, outside %.4g to %.4g %s; %s",
                     kind->what, f->name, text_more(&more, f->n), f->value, kind->unit, kind->min,
                     kind->max, kind->unit, kind->doubt);
    }
}

bool finish_stands(const struct building *g) {
    assert(g->n_dof > 0);
    return gsl_stats_min(g->stiffness, 1, (size_t)g->n_dof) > 0.0;
}

static void check_buildings(struct builder *b, const struct model *m) {
    const struct unit_system *u = &b->deck->units;
    struct finding period = {0}, storey = {0}, height = {0};
    for (int i = 0; i < m->n_building; i++) {
        const struct building *g = &m->building[i];
        const struct word *w = &builder_draft(b, i)->word;
        if (finish_stands(g)) {
            const struct magnitude kind = first_period(g->n_floor);
            look(&kind, &period, w, g->name, 2.0 * M_PI / g->omega[0] * u->time);
        }
        if (g->height) {
            const double mean = gsl_stats_mean(g->height, 1, (size_t)g->n_floor) * u->length;
            look(&mean_storey, &storey, w, g->name, mean);
            look(&total_height, &height, w, g->name, mean * g->n_floor);
        }
    }
    report(b, &period);
    report(b, &storey);
    if (storey.n == 0) {
        report(b, &height);
    }
}

static void check_initial(struct builder *b, const struct model *m) {
    const struct unit_system *u = &b->deck->units;
    struct finding displacement = {0}, velocity = {0};
    for (int k = 0; k < m->n_building; k++) {
        const struct building_draft *d = builder_draft(b, k);
        for (int i = 0; i < d->n_floor; i++) {
            const double size = fabs(d->displacement[i]) * u->length;
            const double rate = fabs(d->velocity[i]) * unit_size(u, dimension_velocity);
            look(&initial_displacement, &displacement, &d->initial[i], d->name, size);
            look(&initial_velocity, &velocity, &d->initial[i], d->name, rate);
        }
    }
    report(b, &displacement);
    report(b, &velocity);
}

static void check_gaps(struct builder *b) {
    const struct link_draft *draft = b->links.item;
    struct finding gap = {0};
    for (int i = 0; i < b->links.n; i++) {
        const struct link *l = &draft[i].link;
        if (!l->bilateral) {
            look(&clear_gap, &gap, &draft[i].word, l->name, fabs(l->gap) * b->deck->units.length);
        }
    }
    report(b, &gap);
}

static void check_grounds(struct builder *b) {
    const double unit = unit_size(&b->deck->units, dimension_acceleration) / G;
    const struct ground_draft *draft = b->grounds.item;
    struct finding peak = {0};
    for (int i = 0; i < b->grounds.n; i++) {
        const double value = signal_peak(&draft[i].signal) * unit;
        if (value > 0.0 && !draft[i].judged) {
            const struct magnitude *kind = draft[i].bare ? &bare_peak : &ground_peak;
            look(kind, &peak, &draft[i].word, draft[i].signal.name, value);
        }
    }
    report(b, &peak);
}

void finish_magnitudes(struct builder *b, const struct model *m) {
    check_buildings(b, m);
    check_initial(b, m);
    check_gaps(b);
    check_grounds(b);
}
