// SPDX-License-Identifier: GPL-3.0-or-later
// Ground motions of the model: records scaled to spectra, and the sum of signals below each
// building.
#include <assert.h>
#include <gsl/gsl_math.h>
#include <string.h>

#include "core/arena.h"
#include "jostle/spectrum.h"
#include "model/finish.h"
#include "model/signals.h"

// The period at which the spectrum of the record is scaled; 0 after a report.
static double scaling_period(struct builder *b, const struct building *building,
                             const struct spectral_scaling *s) {
    if (s->period > 0.0) {
        return s->period;
    }
    const struct building *g = &building[s->building];
    const double period = 2.0 * M_PI / g->omega[0], seconds = period * b->deck->units.time;
    if (!(seconds >= signals_period_range.min && seconds <= signals_period_range.max)) {
        deck_error(b->deck, &s->word,
                   "the first period of building %s is %.4g s; it must be %s, or give -period",
                   g->name, seconds, signals_period_range.text);
        return 0.0;
    }
    return period;
}

// Multiplies the record by a factor, so that its spectrum has the requested value at the period.
static void scale_record(struct builder *b, const struct building *building,
                         struct ground_draft *g) {
    const struct spectral_scaling *s = &g->scaling;
    const double period = scaling_period(b, building, s);
    if (period == 0.0) {
        return;
    }
    const double unscaled = spectrum_at(&g->signal, period, s->damping).value[SPECTRUM_PSA];
    const double factor = s->acceleration / unscaled;
    if (!isfinite(factor) || factor == 0.0) {
        deck_error(b->deck, &s->word,
                   "the record has a spectral acceleration of %.4g at a period of %.4g %s; it "
                   "cannot be scaled",
                   unscaled, period, b->deck->units.time_name);
        return;
    }
    struct error e;
    const struct signal raw = g->signal;
    char unit[64];
    unit_text(&b->deck->units, dimension_acceleration, unit, sizeof unit);
    if (signal_init_samples(&g->signal, b->arena, raw.value, raw.n, raw.dt, factor, raw.start,
                            &e) != STATUS_OK) {
        return;
    }
    g->signal.name = raw.name;
    g->signal.mean = factor * raw.mean;
    g->signal.scaled = arena_format(
        b->arena, "scaled by %.6g to a PSA of %.6g %s at a period of %.6g %s, %.4g %% damping",
        factor, s->acceleration, unit, period, b->deck->units.time_name, 100.0 * s->damping);
}

bool finish_acts_under(const struct ground_draft *g, int building) {
    for (int i = 0; i < g->n_building; i++) {
        if (g->building[i] == building) {
            return true;
        }
    }
    return g->n_building == 0;
}

static void add_ground(struct builder *b, struct ground *g, const bool *mark, int n) {
    const struct ground_draft *draft = b->grounds.item;
    struct signal *signal = arena_alloc(b->arena, (size_t)n, sizeof *signal);
    if (!signal) {
        return;
    }
    *g = (struct ground){.n_signal = n, .signal = signal};
    for (int k = 0, j = 0; k < b->grounds.n; k++) {
        if (mark[k]) {
            signal[j++] = draft[k].signal;
        }
    }
}

void finish_grounds(struct builder *b, struct model *m, struct building *building) {
    struct ground_draft *draft = b->grounds.item;
    for (int k = 0; k < b->grounds.n; k++) {
        if (draft[k].scaling.acceleration > 0.0) {
            scale_record(b, building, &draft[k]);
        }
    }
    size_t n_draft = (size_t)b->grounds.n;
    bool *set = arena_alloc(b->arena, (size_t)m->n_building * n_draft, sizeof *set);
    struct ground *ground = arena_alloc(b->arena, (size_t)m->n_building, sizeof *ground);
    if (!set || !ground) {
        return;
    }
    for (int i = 0; i < m->n_building; i++) {
        bool *mark = set + (size_t)m->n_ground * n_draft;
        // mark[k]: draft k acts below building i.
        int n = 0;
        for (int k = 0; k < b->grounds.n; k++) {
            mark[k] = finish_acts_under(&draft[k], i);
            n += mark[k];
        }
        int same = 0;
        while (same < m->n_ground && memcmp(set + (size_t)same * n_draft, mark, n_draft) != 0) {
            same++;
        }
        building[i].ground = same;
        if (same == m->n_ground) {
            add_ground(b, &ground[m->n_ground++], mark, n);
        }
    }
    assert(m->n_ground <= m->n_building);
    m->ground = ground;
}
