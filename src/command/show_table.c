// SPDX-License-Identifier: GPL-3.0-or-later
// A report as one long table: table, name, quantity, location, value, unit, time, hit. The location
// is a floor, or the number of an impact; the time is that of a peak, or of an impact's start; hit
// is 1 for the acceleration of a floor that was hit, and 0 for that of any other floor.
#include <math.h>
#include <string.h>

#include "command/show.h"
#include "result/layout.h"

struct table {
    struct printer *printer;
    const struct report *r;
    const char *name;  // of the table
};

// One row for value `i` of a column; texts are left out, and arrays that are not there.
static void row(const struct table *t, const struct column_table *of, int c, const void *base,
                size_t i, const char *name, long location, double time, int hit) {
    const struct column *column = &of->column[c];
    const void *at = layout_at(of, c, base, i);
    char unit[64] = "1";
    if (!at || column->kind == COLUMN_TEXT) {
        return;
    }
    printer_text(t->printer, t->name);
    printer_text(t->printer, name);
    printer_text(t->printer, column->name);
    if (location > 0) {
        printer_whole(t->printer, location);
    } else {
        printer_empty(t->printer);
    }
    if (column->kind == COLUMN_DOUBLE || column->kind == COLUMN_ARRAY) {
        printer_number(t->printer, layout_number(column, at));
    } else {
        printer_whole(t->printer, layout_whole(column, at));
    }
    if (column->dimension) {
        unit_text(&t->r->units, *column->dimension, unit, sizeof unit);
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

// The column with the times of the peaks in column `c`: the next one, "NAME_time"; -1: there is
// none.
static int time_column(const struct column_table *t, int c) {
    const size_t n = strlen(t->column[c].name);
    const bool is = c + 1 < t->n_column &&
                    strncmp(t->column[c + 1].name, t->column[c].name, n) == 0 &&
                    strcmp(t->column[c + 1].name + n, "_time") == 0;
    return is ? c + 1 : -1;
}

// The columns over the floors of a building, peaks with their times.
static void building(const struct table *t, const struct report_building *b,
                     const struct column_table *of) {
    for (int c = 0, at; c < of->n_column; c = at < 0 ? c + 1 : at + 1) {
        const bool acceleration = strcmp(of->column[c].name, peak_names[PEAK_ACCELERATION]) == 0;
        at = time_column(of, c);
        for (int i = 0; i < b->n_floor; i++) {
            const double time =
                at < 0 ? (double)NAN : *(const double *)layout_at(of, at, b, (size_t)i);
            row(t, of, c, b, (size_t)i, b->name, i + 1, time,
                acceleration ? report_floor_was_hit(t->r, b->name, i + 1) : -1);
        }
    }
}

// The forces of a member of a frame, extremes with their times.
static void member(const struct table *t, const char *name, const struct report_building *b,
                   int number) {
    const struct column_table *peak = &layout_member_peak[b->hinged];
    const struct column_table *of = &layout_member_extreme[b->hinged];
    const struct report_member *m = &b->member[number];
    for (int c = 0; c < peak->n_column; c++) {
        row(t, peak, c, m, 0, name, 0, NAN, -1);
    }
    for (int c = 0; b->extremes && c < of->n_column; c += 2) {
        row(t, of, c, m, 0, name, 0, *(const double *)layout_at(of, c + 1, m, 0), -1);
    }
}

// The members and shares of a building, named BUILDING/MEMBER and BUILDING/PART.
static void forces(const struct table *t, const struct table *parts,
                   const struct report_building *b) {
    char name[160];
    for (int i = 0; i < b->n_member; i++) {
        snprintf(name, sizeof name, "%s/%s", b->name, b->member[i].name);
        member(t, name, b, i);
    }
    for (int i = 0; i < b->n_share; i++) {
        snprintf(name, sizeof name, "%s/%s", b->name, b->share[i].name);
        for (int k = 0; k < b->n_floor; k++) {
            row(parts, &layout_share_peak, 0, &b->share[i], (size_t)k, name, k + 1,
                b->share[i].shear_time[k], -1);
        }
    }
}

// One row for each member of a struct.
static void members(const struct table *t, const struct column_table *of, const char *name,
                    const void *base, long location, double time) {
    for (int c = 0; c < of->n_column; c++) {
        row(t, of, c, base, 0, name, location, time, -1);
    }
}

// The peaks of one thing, each with its time where it has one. `never`: the first one is not there.
static void peaks(const struct table *t, const struct column_table *of, const char *name,
                  const void *base, int never) {
    for (int c = 0, at; c < of->n_column; c = at < 0 ? c + 1 : at + 1) {
        at = time_column(of, c);
        row(t, of, c, base, 0, name, 0,
            at < 0 || (never && c == 0) ? (double)NAN : *(const double *)layout_at(of, at, base, 0),
            -1);
    }
}

int show_table(const struct report *r, enum printer_form form, FILE *to) {
    static const struct printer_column columns[] = {
        COLUMN_DATA("table"), COLUMN_DATA("name"), COLUMN_DATA("quantity"), COLUMN_DATA("location"),
        COLUMN_DATA("value"), COLUMN_DATA("unit"), COLUMN_DATA("time"),     COLUMN_DATA("hit")};
    struct printer c = {.to = to, .form = form};
    const struct table buildings = {&c, r, "buildings"}, contacts = {&c, r, "contacts"};
    const struct table columns_of = {&c, r, "columns"};
    const struct table links = {&c, r, "links"}, impacts = {&c, r, "impacts"};
    const struct table of_members = {&c, r, "members"}, parts = {&c, r, "parts"};
    const struct table foundations = {&c, r, "foundations"};
    const struct table energy = {&c, r, "energy"}, totals = {&c, r, "totals"};
    PRINTER_ADD(&c, columns);
    printer_head(&c);
    for (int i = 0; i < r->n_building; i++) {
        building(&buildings, &r->building[i], &layout_building);
        building(&buildings, &r->building[i], &layout_pdelta);
        building(&buildings, &r->building[i], &layout_peak);
        forces(&of_members, &parts, &r->building[i]);
        if (r->building[i].foundation) {
            peaks(&foundations, &layout_foundation, r->building[i].name, r->building[i].foundation,
                  0);
        }
    }
    for (int i = 0; i < r->n_contact; i++) {
        members(&contacts, &layout_link, r->contact[i].name, &r->contact[i], 0, NAN);
        peaks(&contacts, &layout_contact, r->contact[i].name, &r->contact[i],
              r->contact[i].peak.impacts == 0);  // the force
    }
    for (int i = 0; i < r->n_link; i++) {
        members(&links, &layout_link, r->link[i].name, &r->link[i], 0, NAN);
        members(&links, &layout_link_peak, r->link[i].name, &r->link[i], 0, NAN);
    }
    for (int i = 0; i < r->n_column; i++) {
        members(&columns_of, &layout_link, r->column[i].name, &r->column[i], 0, NAN);
        members(&columns_of, &layout_column_peak, r->column[i].name, &r->column[i], 0, NAN);
    }
    for (long i = 0; i < r->n_impact; i++) {
        members(&impacts, &layout_impact, r->contact[r->impact[i].contact].name, &r->impact[i],
                i + 1, r->impact[i].t_start);
    }
    for (int i = 0; i < layout_energy.n_column; i++) {
        const double end = r->collapse.happened ? r->collapse.time : r->duration;
        const double time = i < ENERGY_COUNT ? end : i == ENERGY_COUNT ? 0.0 : (double)NAN;
        row(&energy, &layout_energy, i, r, 0, "", 0, time, -1);
    }
    members(&totals, &layout_totals, "", r, 0, NAN);
    members(&totals, &layout_collapse, "", r, 0, NAN);
    return printer_close(&c);
}
