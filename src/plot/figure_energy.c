// SPDX-License-Identifier: GPL-3.0-or-later
// Where the energy went: the parts of the account (docs/theory.md, section 6) on top of each
// other, what came in as a line, and below what the account misses. The parts that do not come back
// stand below. Two runs stand side by side on the same scale.
#include <math.h>

#include "plot/data.h"
#include "plot/figure.h"
#include "plot/script.h"

enum { BINS = 200, PARTS = 5, TIME = 0, TOTAL = PARTS + 1, RESIDUAL, N_COLUMN };

struct part {
    enum energy energy;
    const char *name, *colour;
};
static const struct part parts[PARTS] = {
    {ENERGY_DAMPING, "damping", "#0072b2"},  {ENERGY_HYSTERETIC, "yielding", "#009e73"},
    {ENERGY_CONTACT, "contacts", "#d55e00"}, {ENERGY_STRAIN, "strain", "#e69f00"},
    {ENERGY_KINETIC, "kinetic", "#56b4e9"},
};

// The parts summed up, from the first to this one; the total, initial + input; the residual.
static int read_run(const struct runs *s, int run, struct data *d, struct error *e) {
    const struct result_file *file = s->file[run];
    int status = data_create(d, s->r[run]->n_row, N_COLUMN, e);
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

struct scale {
    struct span energy, residual;
    double power;  // the residual is drawn in 10^power of its unit
};

static void write_stack(const struct runs *s, struct canvas *c, struct area a, int run,
                        const struct scale *scale) {
    const struct axis x = {.span = {0, runs_duration(s)}, .kind = AXIS_WITHOUT_NUMBERS};
    const struct axis y = {.name = run == 0 ? "energy" : NULL,
                           .dimension = dimension_energy,
                           .span = scale->energy,
                           .kind = run == 0 ? AXIS_FULL : AXIS_WITHOUT_NUMBERS};
    canvas_panel(c, a, &s->r[0]->units, &x, &y);
    if (s->n > 1) {
        canvas_caption(c, a, s->name[run], "");
    }
    fprintf(c->to, "plot");
    for (int p = 0; p < PARTS; p++) {
        fprintf(c->to, " \\\n  $energy%d using 1:(%s):%d with filledcurves fc rgb '%s',", run,
                p == 0 ? "0" : (const char[]){'$', (char)('1' + p), '\0'}, p + 2, parts[p].colour);
    }
    fprintf(c->to, " \\\n  $energy%d using 1:%d with lines lc rgb '#404040' lw 0.8\n", run,
            TOTAL + 1);
    canvas_panel_end(c);
}

static void write_residual(const struct runs *s, struct canvas *c, struct area a, int run,
                           const struct scale *scale) {
    char unit[64], power[32], text[128];
    script_unit(&s->r[0]->units, dimension_energy, unit, sizeof unit);
    script_power((int)scale->power, power, sizeof power);
    snprintf(text, sizeof text, "%s %s", power, unit);
    const struct axis x = {
        .name = "time", .dimension = dimension_time, .span = {0, runs_duration(s)}};
    const struct axis y = {.name = run == 0 ? "residual" : NULL,
                           .unit = text,
                           .span = scale->residual,
                           .kind = run == 0 ? AXIS_FULL : AXIS_WITHOUT_NUMBERS};
    canvas_panel(c, a, &s->r[0]->units, &x, &y);
    fprintf(c->to, "plot $energy%d using 1:($%d/1e%.0f) with lines lc rgb '#404040' lw 0.8\n", run,
            RESIDUAL + 1, scale->power);
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

static void write_head(const struct runs *s, struct canvas *c) {
    const struct report *r = s->r[0];
    char text[256], unit[64], in[32], contact[32];
    script_unit(&r->units, dimension_energy, unit, sizeof unit);
    script_number(r->initial_energy + r->energy[ENERGY_INPUT], in, sizeof in);
    script_number(r->energy[ENERGY_CONTACT], contact, sizeof contact);
    snprintf(text, sizeof text, "energy: %s %s in, %s %s into %s", in, unit, contact, unit,
             work_name(s));
    canvas_head(c, runs_title(s), s->n > 1 ? "where the energy went" : text);
    struct legend l = {0};
    for (int p = 0; p < PARTS; p++) {
        bool any = false;
        for (int k = 0; k < s->n; k++) {
            any =
                any || parts[p].energy < ENERGY_HYSTERETIC || s->r[k]->energy[parts[p].energy] != 0;
        }
        if (any) {
            legend_add(&l, (struct mark){.kind = MARK_AREA, .colour = parts[p].colour},
                       parts[p].energy == ENERGY_CONTACT ? work_name(s) : parts[p].name, "");
        }
    }
    legend_add(&l, (struct mark){.kind = MARK_LINE, .colour = "#404040"},
               r->initial_energy > 0 ? "initial + input" : "input", "");
    legend_write(&l, c);
}

static int write_data(const struct runs *s, struct scale *scale, FILE *to, struct error *e) {
    struct span energy = span_none, residual = span_none;
    int status = STATUS_OK;
    for (int k = 0; k < s->n && status == STATUS_OK; k++) {
        struct data d;
        char name[32];
        status = read_run(s, k, &d, e);
        if (status == STATUS_OK) {
            snprintf(name, sizeof name, "energy%d", k);
            status = data_write(&d, name, "time, parts summed up, total, residual", BINS, to, e);
            data_span(&d, PARTS, &energy);
            data_span(&d, TOTAL, &energy);
            data_span(&d, RESIDUAL, &residual);
        }
        data_free(&d);
    }
    const double most = fmax(fabs(residual.low), fabs(residual.high));
    scale->power = most > 0 && isfinite(most) ? floor(log10(most)) : 0;
    const double unit = pow(10, scale->power);
    scale->energy = span_with_room(energy, 0);
    scale->residual = span_with_room((struct span){residual.low / unit, residual.high / unit}, NAN);
    return status;
}

static int draw(const struct runs *s, struct canvas *c, struct error *e) {
    struct scale scale;
    int status = write_data(s, &scale, c->data, e);
    if (status != STATUS_OK) {
        return status;
    }
    write_head(s, c);
    c->area.left += 5.8;
    const double top = s->n > 1 ? 1.6 : 0.7;
    for (int k = 0; k < s->n; k++) {
        const double left = (double)k / s->n, right = (k + 1.0) / s->n;
        write_stack(s, c, canvas_inset(canvas_part(c, left, right, 0.36, 1), 0, 0.8, 0.4, top), k,
                    &scale);
        write_residual(s, c, canvas_inset(canvas_part(c, left, right, 0, 0.36), 0, 0.8, 3.2, 0.6),
                       k, &scale);
    }
    return STATUS_OK;
}

const struct figure figure_energy = {
    .name = "energy",
    .doc = "where the energy went, part on part, and what the account misses",
    .draw = draw,
};
