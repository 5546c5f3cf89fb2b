// SPDX-License-Identifier: GPL-3.0-or-later
// At a corner signal_value has one value, but a step that ends there needs the limit from the left
// and the step that begins there the limit from the right. So a piece is taken by the instant from
// which on it holds, and is evaluated up to its end.
#include "solve/forcing.h"

#include <float.h>
#include <math.h>

// A corner this close, relative to a sample or to the size of the time, is reached.
static const double AT_SAMPLE = 1e-6, AT_TIME = 1e-12;

// A smaller change of the value, relative to what it is made of, is rounding.
static const double JUMP = 1e-12;

// Times that differ by less than this share of them are the same.
static const double SAME_TIME = 8.0 * DBL_EPSILON;

static const struct fields_row list[] = {
    FIELD_ARRAY(struct forcing, ground, FIELD_SIGNALS),
    FIELD_ARRAY(struct forcing, load, FIELD_LOADS),
    FIELD_ARRAY(struct forcing, lines, FIELD_GROUNDS),
    FIELD_VALUE(struct forcing, sines),
    FIELD_VALUE(struct forcing, corner),
};
const struct fields forcing_fields = FIELDS(list);

void forcing_init(struct forcing *f, const struct model *m) {
    f->model = m;
    f->corner = -INFINITY;
}

bool forcing_alloc(struct forcing *f, const struct model *m, struct arena *a) {
    forcing_init(f, m);
    return fields_alloc(&forcing_fields, m, f, a);
}

static double forcing_slack(const struct signal *s, double t) {
    return s->value ? AT_SAMPLE * s->dt : AT_TIME * (1.0 + fabs(t));
}

static struct piece forcing_line_from(const struct signal *s, double t) {
    double x = (t - s->start) / s->dt + AT_SAMPLE;
    size_t j = x > 0.0 ? (size_t)x : 0;
    j = j < s->n - 2 ? j : s->n - 2;
    return (struct piece){
        .signal = s,
        .shape = PIECE_LINE,
        .start = s->start + (double)j * s->dt,
        .end = j + 2 < s->n ? s->start + (double)(j + 1) * s->dt : s->end,
        .value = s->value[j],
        .slope = (s->value[j + 1] - s->value[j]) / s->dt,
    };
}

// The piece of a signal that holds from t on.
static struct piece forcing_piece_from(const struct signal *s, double t) {
    double near = forcing_slack(s, t);
    if (t < s->start - near) {
        return (struct piece){.signal = s, .shape = PIECE_LINE, .end = s->start};
    }
    if (t >= s->end - near) {
        return (struct piece){.signal = s, .shape = PIECE_LINE, .end = INFINITY};
    }
    if (s->value) {
        return forcing_line_from(s, t);
    }
    return (struct piece){.signal = s, .shape = PIECE_SINE, .end = s->end};
}

static double forcing_sine_value(const struct signal *s, double t) {
    return s->amplitude * sin(s->omega * (t - s->start) + s->phase);
}

static inline double forcing_piece_value(const struct piece *p, double t) {
    return p->shape == PIECE_LINE ? p->value + p->slope * (t - p->start)
                                  : forcing_sine_value(p->signal, t);
}

// What rounding makes of the value of a piece at its end, where the sum may cancel: that of its
// terms, and of the time.
static double forcing_rounding(const struct piece *p, double t) {
    if (p->shape == PIECE_SINE) {
        return JUMP * fabs(p->signal->amplitude);
    }
    double terms = fabs(p->value) + fabs(p->slope * (t - p->start));
    return JUMP * terms + 4.0 * DBL_EPSILON * fabs(p->slope * t);
}

// Replaces the piece by the next one where it has ended. True if the signal jumps there.
static bool forcing_turn_piece(const struct forcing *f, struct piece *p, const struct signal *s,
                               double t) {
    if (f->corner == -INFINITY) {
        *p = forcing_piece_from(s, t);
        return true;
    }
    if (t < p->end - forcing_slack(s, t)) {
        return false;
    }
    double before = forcing_piece_value(p, t);
    double error = forcing_rounding(p, t);
    *p = forcing_piece_from(s, t);
    return fabs(forcing_piece_value(p, t) - before) > fmax(error, forcing_rounding(p, t));
}

// Adds the piece to the lines of its ground if it is a line.
static void forcing_add_line(struct forcing *f, struct sloping *lines, const struct piece *p) {
    if (p->shape == PIECE_LINE) {
        lines->value += forcing_piece_value(p, lines->start);
        lines->slope += p->slope;
    } else {
        f->sines = true;
    }
}

bool forcing_turn(struct forcing *f, double t) {
    const struct model *m = f->model;
    bool jumps = false;
    double corner = INFINITY;
    struct piece *p = f->ground;
    if (f->corner > -INFINITY && t >= m->duration * (1.0 - SAME_TIME)) {
        f->corner = INFINITY;
        return false;
    }
    f->sines = false;
    for (int k = 0; k < m->n_ground; k++) {
        f->lines[k] = (struct sloping){.start = t};
        for (int i = 0; i < m->ground[k].n_signal; i++, p++) {
            jumps |= forcing_turn_piece(f, p, &m->ground[k].signal[i], t);
            corner = fmin(corner, p->end);
            forcing_add_line(f, &f->lines[k], p);
        }
    }
    for (int k = 0; k < m->n_load; k++) {
        jumps |= forcing_turn_piece(f, &f->load[k], &m->load[k].signal, t);
        corner = fmin(corner, f->load[k].end);
    }
    f->corner = corner;
    return jumps;
}

static void forcing_add_sines(const struct forcing *f, double t, double *a) {
    const struct piece *p = f->ground;
    for (int k = 0; k < f->model->n_ground; k++) {
        for (const struct piece *end = p + f->model->ground[k].n_signal; p < end; p++) {
            a[k] += p->shape == PIECE_SINE ? forcing_sine_value(p->signal, t) : 0.0;
        }
    }
}

void forcing_integrals(const struct model *m, double t, struct forcing_values *out) {
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
    for (int k = 0; k < f->model->n_ground; k++) {
        out->a[k] = forcing_lines(f, k, t);
    }
    if (f->sines) {
        forcing_add_sines(f, t, out->a);
    }
    if (f->model->n_ground > 1) {
        forcing_integrals(f->model, t, out);
    }
}

double forcing_load(const struct forcing *f, int k, double t) {
    return forcing_piece_value(&f->load[k], t);
}
