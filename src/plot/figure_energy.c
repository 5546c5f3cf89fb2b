// SPDX-License-Identifier: GPL-3.0-or-later
// Where the energy went: the parts of the account (docs/theory.md, section 6) on top of each
// other, what came in as a line, and below what the account misses. The parts that do not come back
// stand below. Two runs stand side by side on the same scale.
#include <math.h>

#include "plot/data.h"
#include "plot/figure.h"
#include "plot/script.h"

enum { BINS = 200, PARTS = 5, TIME = 0, TOTAL = PARTS + 1, RESIDUAL, N_COLUMN };

struct component {
    enum energy energy;
    const char *name, *colour;
};
static const struct component parts[PARTS] = {
    {ENERGY_DAMPING, "damping", "#0072b2"},  {ENERGY_HYSTERETIC, "yielding", "#009e73"},
    {ENERGY_CONTACT, "contacts", "#d55e00"}, {ENERGY_STRAIN, "strain", "#e69f00"},
    {ENERGY_KINETIC, "kinetic", "#56b4e9"},
};

// The parts summed up, from the first to this one; the total, initial + input; the residual.
static int read_run(const struct runs *s, int run, struct data *d, struct error *e) {
    const struct result_file *file = s->file[run];
    int status = runs_data(s, run, N_COLUMN, d, e);
    if (status == STATUS_OK) {
        status = result_time(file, d->column[TIME], e);
    }
    for (int p = 0; p < PARTS && status == STATUS_OK; p++) {
        status = result_energy(file, parts[p].energy, d->column[1 + p], e);
        for (size_t i = 0; i < d->n_row && p > 0; i++) {
            d->column[1 + p][i] += d->column[p][i];
        }
    }
    if (status == STATUS_OK) {
        status = result_energy(file, ENERGY_INPUT, d->column[TOTAL], e);
    }
    for (size_t i = 0; i < d->n_row && status == STATUS_OK; i++) {
        d->column[TOTAL][i] += s->r[run]->initial_energy;
    }
    return status == STATUS_OK ? result_energy(file, ENERGY_RESIDUAL, d->column[RESIDUAL], e)
                               : status;
}

// What all runs hold.
struct extent {
    struct span energy, residual;
    bool part[PARTS];  // whether it is ever other than zero
};

static void write_stack(const struct runs *s, struct canvas *c, struct area a, int run,
                        const struct extent *x) {
    const struct axis time = {.span = {0, runs_duration(s)}, .kind = AXIS_WITHOUT_NUMBERS};
    const struct axis upright = {.name = run == 0 ? "energy" : NULL,
                                 .dimension = dimension_energy,
                                 .span = x->energy,
                                 .kind = run == 0 ? AXIS_FULL : AXIS_WITHOUT_NUMBERS};
    canvas_panel(c, a, &s->r[0]->units, &time, &upright);
    if (s->n > 1) {
        canvas_caption(c, a, s->name[run], "");
    }
    fprintf(c->to, "plot");
    for (int p = 0; p < PARTS; p++) {
        fprintf(c->to, " \\\n  $energy%d using 1:(%s%d):%d with filledcurves fc rgb '%s',", run,
                p > 0 ? "$" : "", p > 0 ? p + 1 : 0, p + 2, parts[p].colour);
    }
    fprintf(c->to, " \\\n  $energy%d using 1:%d with lines lc rgb '#404040' lw 0.8\n", run,
            TOTAL + 1);
    canvas_panel_end(c);
}

static void write_residual(const struct runs *s, struct canvas *c, struct area a, int run,
                           const struct extent *x) {
    const struct axis time = {
        .name = "time", .dimension = dimension_time, .span = {0, runs_duration(s)}};
    const struct axis upright = {.name = run == 0 ? "residual" : NULL,
                                 .dimension = dimension_energy,
                                 .span = x->residual,
                                 .kind = run == 0 ? AXIS_FULL : AXIS_WITHOUT_NUMBERS};
    canvas_panel(c, a, &s->r[0]->units, &time, &upright);
    fprintf(c->to, "plot $energy%d using 1:%d with lines lc rgb '#404040' lw 0.8\n", run,
            RESIDUAL + 1);
    canvas_panel_end(c);
}

// What the work on contacts and links was done on.
static const char *work_name(const struct runs *s) {
    bool contacts = false, links = false;
    for (int k = 0; k < s->n; k++) {
        contacts = contacts || s->r[k]->n_contact > 0;
        links = links || s->r[k]->n_link > 0;
    }
    return !links ? "contacts" : contacts ? "contacts and links" : "links";
}

static void write_subtitle(const struct runs *s, char *text, size_t size) {
    const struct report *r = s->r[0];
    char unit[64], in[32], contact[32];
    if (s->n > 1) {
        snprintf(text, size, "where the energy went");
        return;
    }
    script_unit(&r->units, dimension_energy, unit, sizeof unit);
    script_number(r->initial_energy + r->energy[ENERGY_INPUT], in, sizeof in);
    script_number(r->energy[ENERGY_CONTACT], contact, sizeof contact);
    if (r->n_contact + r->n_link > 0) {
        snprintf(text, size, "energy: %s %s in, %s %s into %s", in, unit, contact, unit,
                 work_name(s));
    } else {
        snprintf(text, size, "energy: %s %s in", in, unit);
    }
}

static void write_head(const struct runs *s, const struct extent *x, struct canvas *c) {
    struct legend l = {0};
    char text[256];
    write_subtitle(s, text, sizeof text);
    canvas_head(c, runs_title(s), text);
    for (int p = 0; p < PARTS; p++) {
        if (x->part[p]) {
            legend_add(&l, (struct mark){.kind = MARK_AREA, .colour = parts[p].colour},
                       parts[p].energy == ENERGY_CONTACT ? work_name(s) : parts[p].name, "");
        }
    }
    legend_add(&l, (struct mark){.kind = MARK_LINE, .colour = "#404040"},
               s->r[0]->initial_energy > 0 ? "initial + input" : "input", "");
    legend_write(&l, c);
}

static void extend(struct extent *x, const struct data *d) {
    data_span(d, PARTS, &x->energy);
    data_span(d, TOTAL, &x->energy);
    data_span(d, RESIDUAL, &x->residual);
    for (int p = 0; p < PARTS; p++) {
        for (size_t i = 0; i < d->n_row; i++) {
            x->part[p] |= d->column[1 + p][i] != (p > 0 ? d->column[p][i] : 0);
        }
    }
}

static int write_data(const struct runs *s, struct extent *x, FILE *to, struct error *e) {
    *x = (struct extent){.energy = span_none, .residual = span_none};
    int status = STATUS_OK;
    for (int k = 0; k < s->n && status == STATUS_OK; k++) {
        struct data d;
        char name[32];
        status = read_run(s, k, &d, e);
        if (status == STATUS_OK) {
            snprintf(name, sizeof name, "energy%d", k);
            status = data_write(&d, name, "time, parts summed up, total, residual", BINS, to, e);
            extend(x, &d);
        }
        data_free(&d);
    }
    x->energy = span_with_room(x->energy, 0);
    x->residual = span_with_room(x->residual, NAN);
    return status;
}

static int draw(const struct runs *s, struct canvas *c, struct error *e) {
    struct extent x;
    int status = write_data(s, &x, c->data, e);
    if (status != STATUS_OK) {
        return status;
    }
    write_head(s, &x, c);
    c->area.left += 5.8;
    const double top = s->n > 1 ? 1.6 : 0.7;
    for (int k = 0; k < s->n; k++) {
        const double left = (double)k / s->n, right = (k + 1.0) / s->n;
        write_stack(s, c, canvas_inset(canvas_part(c, left, right, 0.36, 1), 0, 0.8, 0.4, top), k,
                    &x);
        write_residual(s, c, canvas_inset(canvas_part(c, left, right, 0, 0.36), 0, 0.8, 3.2, 0.6),
                       k, &x);
    }
    return STATUS_OK;
}

const struct figure figure_energy = {
    .name = "energy",
    .doc = "where the energy went, part on part, and what the account misses",
    .draw = draw,
};
