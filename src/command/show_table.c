// SPDX-License-Identifier: GPL-3.0-or-later
// A report as one long table: table, name, quantity, location, value, unit, time, hit. The location
// is a floor, or the number of an impact; the time is that of a peak, or of an impact's start; hit
// is 1 for the acceleration of a floor that was hit, and 0 for that of any other floor.
#include <math.h>

#include "command/show.h"
#include "result/layout.h"

struct table {
    struct printer *printer;
    const struct report *r;
    const char *name;  // of the table
};

static void open_row(const struct table *t, const char *name, const char *quantity, long location) {
    printer_text(t->printer, t->name);
    printer_text(t->printer, name);
    printer_text(t->printer, quantity);
    if (location > 0) {
        printer_whole(t->printer, location);
    } else {
        printer_empty(t->printer);
    }
}

static void close_row(const struct table *t, const struct dimension *dimension, double time,
                      int hit) {
    char unit[64] = "1";
    if (dimension) {
        unit_text(&t->r->units, *dimension, unit, sizeof unit);
    }
    printer_text(t->printer, unit);
    if (isnan(time)) {
        printer_empty(t->printer);
    } else {
        printer_number(t->printer, time);
    }
    printer_sign(t->printer, hit);
    printer_line(t->printer);
}

static void row(const struct table *t, const char *name, const char *quantity, long location,
                double value, const struct dimension *dimension, double time) {
    open_row(t, name, quantity, location);
    printer_number(t->printer, value);
    close_row(t, dimension, time, -1);
}

static void peak(const struct table *t, const struct report_building *b, int p, int i) {
    const bool hit = report_floor_was_hit(t->r, b->name, i + 1);
    open_row(t, b->name, peak_names[p], i + 1);
    printer_number(t->printer, b->peak[p][i]);
    close_row(t, layout_peak[p].dimension, b->peak_time[p][i], p == PEAK_ACCELERATION ? hit : -1);
}

static void building(const struct table *t, const struct report_building *b) {
    for (int c = 0; c < layout_building.n_column; c++) {
        const struct column *column = &layout_building.column[c];
        const double *const *value = layout_at(&layout_building, c, b, 0);
        for (int i = 0; i < b->n_floor; i++) {
            row(t, b->name, column->name, i + 1, (*value)[i], column->dimension, NAN);
        }
    }
    for (int p = 0; p < PEAK_COUNT; p++) {
        for (int i = 0; i < b->n_floor; i++) {
            peak(t, b, p, i);
        }
    }
    for (int i = 0; b->residual_drift && i < b->n_floor; i++) {
        row(t, b->name, layout_residual_drift_name, i + 1, b->residual_drift[i],
            layout_residual_drift.dimension, NAN);
    }
}

// One row a numeric member of a struct; texts are left out.
static void members(const struct table *t, const struct column_table *c, const char *name,
                    const void *base, long location, double time) {
    for (int i = 0; i < c->n_column; i++) {
        const struct column *column = &c->column[i];
        const void *at = layout_at(c, i, base, 0);
        if (column->kind == COLUMN_DOUBLE) {
            row(t, name, column->name, location, *(const double *)at, column->dimension, time);
        } else if (column->kind != COLUMN_TEXT) {
            open_row(t, name, column->name, location);
            printer_whole(t->printer, layout_whole(column, at));
            close_row(t, column->dimension, time, -1);
        }
    }
}

// The peaks of a contact, each with its time where it has one.
static void contact_peak(const struct table *t, const struct report_link *c) {
    const struct link_peak *p = &c->peak;
    row(t, c->name, "force", 0, p->force, &dimension_force,
        p->impacts > 0 ? p->force_time : (double)NAN);
    row(t, c->name, "penetration", 0, p->penetration, &dimension_length, p->penetration_time);
    row(t, c->name, "impulse", 0, p->impulse, &dimension_impulse, NAN);
    row(t, c->name, "impacts", 0, (double)p->impacts, NULL, NAN);
    row(t, c->name, "dissipated", 0, p->dissipated, &dimension_energy, NAN);
}

int show_table(const struct report *r, enum printer_form form, FILE *to) {
    static const struct printer_column columns[] = {
        COLUMN_DATA("table"), COLUMN_DATA("name"), COLUMN_DATA("quantity"), COLUMN_DATA("location"),
        COLUMN_DATA("value"), COLUMN_DATA("unit"), COLUMN_DATA("time"),     COLUMN_DATA("hit")};
    struct printer c = {.to = to, .form = form};
    const struct table buildings = {&c, r, "buildings"}, contacts = {&c, r, "contacts"};
    const struct table links = {&c, r, "links"}, impacts = {&c, r, "impacts"};
    const struct table energy = {&c, r, "energy"}, totals = {&c, r, "totals"};
    PRINTER_ADD(&c, columns);
    printer_head(&c);
    for (int i = 0; i < r->n_building; i++) {
        building(&buildings, &r->building[i]);
    }
    for (int i = 0; i < r->n_contact; i++) {
        members(&contacts, &layout_link, r->contact[i].name, &r->contact[i], 0, NAN);
        contact_peak(&contacts, &r->contact[i]);
    }
    for (int i = 0; i < r->n_link; i++) {
        members(&links, &layout_link, r->link[i].name, &r->link[i], 0, NAN);
        members(&links, &layout_link_peak, r->link[i].name, &r->link[i], 0, NAN);
    }
    for (long i = 0; i < r->n_impact; i++) {
        members(&impacts, &layout_impact, r->contact[r->impact[i].contact].name, &r->impact[i],
                i + 1, r->impact[i].t_start);
    }
    for (int i = 0; i < ENERGY_COUNT; i++) {
        row(&energy, "", energy_names[i], 0, r->energy[i], &dimension_energy, r->duration);
    }
    row(&energy, "", "initial", 0, r->initial_energy, &dimension_energy, 0.0);
    row(&energy, "", "residual_peak", 0, r->residual_peak, &dimension_energy, NAN);
    members(&totals, &layout_totals, "", &r->totals, 0, NAN);
    return printer_close(&c);
}
