// SPDX-License-Identifier: GPL-3.0-or-later
// A report as JSON. What JSON has no number for (NaN) is null.
#include <math.h>
#include <string.h>

#include "command/show.h"
#include "core/safe.h"
#include "core/text.h"
#include "result/layout.h"

// A comma goes before every value but the first of a list.
struct json {
    FILE *to;
    bool follows;
};

static void key(struct json *j, const char *name) {
    fputs(j->follows ? ",\n" : "\n", j->to);
    if (name) {
        safe_put(j->to, SAFE_JSON, name);
        fputs(": ", j->to);
    }
    j->follows = true;
}

static void open_list(struct json *j, const char *name, char bracket) {
    key(j, name);
    fputc(bracket, j->to);
    j->follows = false;
}

static void close_list(struct json *j, char bracket) {
    fprintf(j->to, "\n%c", bracket);
    j->follows = true;
}

static void value(FILE *to, double number) {
    struct text_exact t;
    fputs(isfinite(number) ? text_exact(&t, number) : "null", to);
}

static void put_text(struct json *j, const char *name, const char *text) {
    key(j, name);
    safe_put(j->to, SAFE_JSON, text);
}

static void put_number(struct json *j, const char *name, double number) {
    key(j, name);
    value(j->to, number);
}

static void put_array(struct json *j, const char *name, const double *number, int n) {
    key(j, name);
    for (int i = 0; i < n; i++) {
        fputs(i == 0 ? "[" : ", ", j->to);
        value(j->to, number[i]);
    }
    fputs(n == 0 ? "[]" : "]", j->to);
}

static void put_members(struct json *j, const struct column_table *t, const void *base) {
    for (int c = 0; c < t->n_column; c++) {
        const struct column *column = &t->column[c];
        const void *at = layout_at(t, c, base, 0);
        if (column->kind == COLUMN_TEXT) {
            put_text(j, column->name, *(const char *const *)at);
        } else if (column->kind == COLUMN_DOUBLE) {
            put_number(j, column->name, *(const double *)at);
        } else {
            key(j, column->name);
            fprintf(j->to, "%ld", layout_whole(column, at));
        }
    }
}

static void put_building(struct json *j, const struct report_building *b) {
    open_list(j, NULL, '{');
    put_text(j, "name", b->name);
    put_number(j, "floors", b->n_floor);
    for (int c = 0; c < layout_building.n_column; c++) {
        const double *const *number = layout_at(&layout_building, c, b, 0);
        put_array(j, layout_building.column[c].name, *number, b->n_floor);
    }
    open_list(j, "envelope", '{');
    for (int p = 0; p < PEAK_COUNT; p++) {
        char name[64];
        snprintf(name, sizeof name, "%s_time", peak_names[p]);
        put_array(j, peak_names[p], b->peak[p], b->n_floor);
        put_array(j, name, b->peak_time[p], b->n_floor);
    }
    if (b->residual_drift) {
        put_array(j, layout_residual_drift_name, b->residual_drift, b->n_floor);
    }
    close_list(j, '}');
    close_list(j, '}');
}

static void put_link(struct json *j, const struct report_link *l,
                     const struct column_table *peaks) {
    open_list(j, NULL, '{');
    put_members(j, &layout_link, l);
    if (layout_has_levels(l, 1)) {
        put_members(j, &layout_level, l);
    }
    open_list(j, "envelope", '{');
    put_members(j, peaks, l);
    close_list(j, '}');
    close_list(j, '}');
}

static void put_units(struct json *j, const struct report *r) {
    open_list(j, "units", '{');
    put_text(j, "force", r->units.force_name);
    put_text(j, "length", r->units.length_name);
    put_text(j, "time", r->units.time_name);
    close_list(j, '}');
}

static void put_energy(struct json *j, const struct report *r) {
    open_list(j, "energy", '{');
    for (int i = 0; i < ENERGY_COUNT; i++) {
        put_number(j, energy_names[i], r->energy[i]);
    }
    put_number(j, "initial", r->initial_energy);
    put_number(j, "residual_peak", r->residual_peak);
    close_list(j, '}');
    open_list(j, "totals", '{');
    put_members(j, &layout_totals, &r->totals);
    close_list(j, '}');
}

void show_json(const struct report *r, FILE *to) {
    struct json j = {.to = to};
    fputc('{', to);
    put_members(&j, &layout_root, r);
    put_units(&j, r);
    open_list(&j, "buildings", '[');
    for (int i = 0; i < r->n_building; i++) {
        put_building(&j, &r->building[i]);
    }
    close_list(&j, ']');
    open_list(&j, "contacts", '[');
    for (int i = 0; i < r->n_contact; i++) {
        put_link(&j, &r->contact[i], &layout_contact);
    }
    close_list(&j, ']');
    open_list(&j, "links", '[');
    for (int i = 0; i < r->n_link; i++) {
        put_link(&j, &r->link[i], &layout_link_peak);
    }
    close_list(&j, ']');
    open_list(&j, "impacts", '[');
    for (long i = 0; i < r->n_impact; i++) {
        open_list(&j, NULL, '{');
        put_members(&j, &layout_impact, &r->impact[i]);
        close_list(&j, '}');
    }
    close_list(&j, ']');
    put_energy(&j, r);
    fputs("\n}\n", to);
}
