// SPDX-License-Identifier: GPL-3.0-or-later
// What ground motions and loads do at an instant: at any instant from their signals, and between
// two corners from pieces.
//
// At a corner signal_value has one value, but a step that ends there needs the limit from the left
// and the step that begins there the limit from the right. So a piece is taken by the instant from
// which on it holds, and is evaluated up to its end.
#include "solve/forcing.h"

#include <float.h>
#include <math.h>
#include <string.h>

// A corner this close, relative to a sample or to the size of the time, is reached.
static const double AT_SAMPLE = 1e-6, AT_TIME = 1e-12;

// A smaller change of the value, relative to what it is made of, is rounding.
static const double JUMP = 1e-12;

static const struct fields_row list[] = {
    FIELD_ARRAY(struct forcing, ground, FIELD_SIGNALS),
    FIELD_ARRAY(struct forcing, load, FIELD_LOADS),
    FIELD_ARRAY(struct forcing, lines, FIELD_GROUNDS),
    FIELD_VALUES(struct forcing, sines, corner),
};
const struct fields forcing_fields = FIELDS(list);

static double forcing_slack(const struct signal *s, double t) {
    return s->value ? AT_SAMPLE * s->dt : AT_TIME * (1.0 + fabs(t));
}

// The piece of a signal that holds from t on.
static struct piece forcing_piece_from(const struct signal *s, double t) {
    const double near = forcing_slack(s, t);
    if (t < s->start - near) {
        return (struct piece){.end = s->start};
    }
    if (t >= s->end - near) {
        return (struct piece){.end = INFINITY};
    }
    if (!s->value) {
        return (struct piece){.sine = s, .end = s->end};
    }
    const double x = (t - s->start) / s->dt + AT_SAMPLE;
    size_t j = x > 0.0 ? (size_t)x : 0;
    j = j < s->n - 2 ? j : s->n - 2;
    return (struct piece){
        .end = j + 2 < s->n ? s->start + (double)(j + 1) * s->dt : s->end,
        .line = {.start = s->start + (double)j * s->dt,
                 .value = s->value[j],
                 .slope = (s->value[j + 1] - s->value[j]) / s->dt},
    };
}

static double forcing_sine(const struct signal *s, double t) {
    return s->amplitude * sin(s->omega * (t - s->start) + s->phase);
}

static double forcing_value(const struct piece *p, double t) {
    return p->sine ? forcing_sine(p->sine, t) : forcing_on_line(&p->line, t);
}

// What rounding makes of the value of a piece at its end, where the sum may cancel: that of its
// terms, and of the time.
static double forcing_rounding(const struct piece *p, double t) {
    if (p->sine) {
        return JUMP * fabs(p->sine->amplitude);
    }
    double terms = fabs(p->line.value) + fabs(p->line.slope * (t - p->line.start));
    return JUMP * terms + 4.0 * DBL_EPSILON * fabs(p->line.slope * t);
}

// Replaces the piece by the next one where it has ended. True if the signal jumps there.
static bool forcing_turn_piece(struct piece *p, const struct signal *s, double t) {
    if (t < p->end - forcing_slack(s, t)) {
        return false;
    }
    double before = forcing_value(p, t);
    double error = forcing_rounding(p, t);
    *p = forcing_piece_from(s, t);
    return fabs(forcing_value(p, t) - before) > fmax(error, forcing_rounding(p, t));
}

bool forcing_turn(struct forcing *f, double t) {
    const struct model *m = f->model;
    bool jumps = false;
    double corner = INFINITY;
    struct piece *p = f->ground;
    if (t >= m->duration * (1.0 - FORCING_SAME_TIME)) {
        f->corner = INFINITY;
        return false;
    }
    f->sines = false;
    for (int k = 0; k < m->n_ground; k++) {
        struct sloping lines = {.start = t};
        for (int i = 0; i < m->ground[k].n_signal; i++, p++) {
            jumps |= forcing_turn_piece(p, &m->ground[k].signal[i], t);
            corner = fmin(corner, p->end);
            f->sines |= p->sine != NULL;
            lines.value += p->sine ? 0.0 : forcing_on_line(&p->line, t);
            lines.slope += p->line.slope;
        }
        f->lines[k] = lines;
    }
    for (int k = 0; k < m->n_load; k++) {
        jumps |= forcing_turn_piece(&f->load[k], &m->load[k].signal, t);
        corner = fmin(corner, f->load[k].end);
    }
    f->corner = corner;
    return jumps;
}

// The velocities and displacements of the grounds at any time t.
static void forcing_integrals(const struct model *m, double t, const struct forcing_values *out) {
    for (int k = 0; k < m->n_ground; k++) {
        out->v[k] = out->u[k] = 0.0;
        for (int i = 0; i < m->ground[k].n_signal; i++) {
            double v, u;
            signal_integrals(&m->ground[k].signal[i], t, &v, &u);
            out->v[k] += v;
            out->u[k] += u;
        }
    }
}

void forcing_ground(const struct forcing *f, double t, struct forcing_values *out) {
    const struct piece *p = f->ground;
    for (int k = 0; k < f->model->n_ground; k++) {
        out->a[k] = forcing_lines(f, k, t);
        for (int i = 0; f->sines && i < f->model->ground[k].n_signal; i++, p++) {
            out->a[k] += p->sine ? forcing_sine(p->sine, t) : 0.0;
        }
    }
    if (f->model->n_ground > 1) {
        forcing_integrals(f->model, t, out);
    }
}

double forcing_load(const struct forcing *f, int k, double t) {
    return forcing_value(&f->load[k], t);
}

// The motion of the grounds at any t. With one ground under all, nothing depends on its velocity
// and displacement.
static void forcing_grounds_at(struct state *s, const struct model *m, double t) {
    for (int k = 0; k < m->n_ground; k++) {
        s->ground_a[k] = s->ground_v[k] = s->ground_u[k] = 0.0;
        for (int i = 0; i < m->ground[k].n_signal; i++) {
            s->ground_a[k] += signal_value(&m->ground[k].signal[i], t);
        }
    }
    if (m->n_ground > 1) {
        forcing_integrals(m, t, &(struct forcing_values){.v = s->ground_v, .u = s->ground_u});
    }
}

void forcing_floors(struct state *s, const struct model *m, const struct forcing *f, double t) {
    for (const struct building *g = m->building; g < m->building + m->n_body; g++) {
        const double a = s->ground_a[g->ground];
        for (int i = g->first; i < g->first + g->n_dof; i++) {
            s->base[i] = a;
            s->external[i] = -m->mass[i] * a;
        }
    }
    for (int k = 0; k < m->n_load; k++) {
        const struct load *load = &m->load[k];
        s->external[load->dof] += f ? forcing_load(f, k, t) : signal_value(&load->signal, t);
    }
}

void forcing_at(struct state *s, const struct model *m, double t) {
    forcing_grounds_at(s, m, t);
    forcing_floors(s, m, NULL, t);
}

void forcing_of_pieces(struct state *s, const struct forcing *f, double t) {
    struct forcing_values ground = {.a = s->ground_a, .v = s->ground_v, .u = s->ground_u};
    forcing_ground(f, t, &ground);
    forcing_floors(s, f->model, f, t);
}

void forcing_foresee(struct forcing_ahead *x, const struct model *m, long n) {
    if (n < x->from || n >= x->from + FORCING_AHEAD) {
        x->from = n;
        model_times(m, n, FORCING_AHEAD, x->time);
        memset(x->ground, 0, sizeof x->ground);
        for (int i = 0; state_is_uniform(m) && i < m->ground[0].n_signal; i++) {
            signal_add_values(&m->ground[0].signal[i], FORCING_AHEAD, x->time, x->ground);
        }
    }
    x->sought = n - x->from;
}

void forcing_known(const struct forcing_ahead *x, struct state *s, const struct model *m,
                   double t) {
    if (!state_is_uniform(m)) {
        forcing_at(s, m, t);
    } else if (x->time[x->sought] == t) {
        s->ground_a[0] = x->ground[x->sought];
    } else {
        forcing_grounds_at(s, m, t);
    }
}
