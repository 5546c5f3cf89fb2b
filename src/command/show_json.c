// SPDX-License-Identifier: GPL-3.0-or-later
// A report as JSON. What JSON has no number for (NaN) is null.
#include <math.h>

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

// The members of a struct; arrays have `n` values.
static void put_members(struct json *j, const struct column_table *t, const void *base, int n) {
    for (int c = 0; c < t->n_column; c++) {
        const struct column *column = &t->column[c];
        const void *at = layout_at(t, c, base, 0);
        if (!at) {
            continue;  // an array that is not there
        }
        key(j, column->name);
        switch (column->kind) {
            case COLUMN_TEXT:
                safe_put(j->to, SAFE_JSON, *(const char *const *)at);
                break;
            case COLUMN_DOUBLE:
                value(j->to, *(const double *)at);
                break;
            case COLUMN_ARRAY:
                for (int i = 0; i < n; i++) {
                    fputs(i == 0 ? "[" : ", ", j->to);
                    value(j->to, ((const double *)at)[i]);
                }
                fputs("]", j->to);
                break;
            default:
                fprintf(j->to, "%ld", layout_whole(column, at));
        }
    }
}

// The members of frames and walls, and the shares of what resists.
static void put_forces(struct json *j, const struct report_building *b) {
    if (b->n_member > 0) {
        open_list(j, "members", '[');
        for (int i = 0; i < b->n_member; i++) {
            open_list(j, NULL, '{');
            put_members(j, &layout_member, &b->member[i], 1);
            put_members(j, &layout_member_peak[b->hinged], &b->member[i], 1);
            if (b->extremes) {
                put_members(j, &layout_member_extreme[b->hinged], &b->member[i], 1);
            }
            close_list(j, '}');
        }
        close_list(j, ']');
    }
    if (b->n_share > 0) {
        open_list(j, "parts", '[');
        for (int i = 0; i < b->n_share; i++) {
            open_list(j, NULL, '{');
            put_members(j, &layout_share, &b->share[i], 1);
            put_members(j, &layout_share_peak, &b->share[i], b->n_floor);
            close_list(j, '}');
        }
        close_list(j, ']');
    }
}

static void put_foundation(struct json *j, const struct report_building *b) {
    if (b->foundation) {
        open_list(j, "foundation", '{');
        put_members(j, &layout_foundation, b->foundation, 1);
        close_list(j, '}');
    }
}

static void put_building(struct json *j, const struct report_building *b) {
    open_list(j, NULL, '{');
    put_text(j, "name", b->name);
    key(j, "floors");
    fprintf(j->to, "%d", b->n_floor);
    put_members(j, &layout_building, b, b->n_floor);
    put_members(j, &layout_pdelta, b, b->n_floor);
    open_list(j, "envelope", '{');
    put_members(j, &layout_peak, b, b->n_floor);
    close_list(j, '}');
    put_forces(j, b);
    put_foundation(j, b);
    close_list(j, '}');
}

static void put_link(struct json *j, const struct report_link *l,
                     const struct column_table *peaks) {
    open_list(j, NULL, '{');
    put_members(j, &layout_link, l, 1);
    if (layout_has_levels(l, 1)) {
        put_members(j, &layout_level, l, 1);
    }
    open_list(j, "envelope", '{');
    put_members(j, peaks, l, 1);
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

void show_json(const struct report *r, FILE *to) {
    struct json j = {.to = to};
    fputc('{', to);
    put_members(&j, &layout_root, r, 1);
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
    open_list(&j, "columns", '[');
    for (int i = 0; i < r->n_column; i++) {
        put_link(&j, &r->column[i], &layout_column_peak);
    }
    close_list(&j, ']');
    open_list(&j, "impacts", '[');
    for (long i = 0; i < r->n_impact; i++) {
        open_list(&j, NULL, '{');
        put_members(&j, &layout_impact, &r->impact[i], 1);
        close_list(&j, '}');
    }
    close_list(&j, ']');
    open_list(&j, "energy", '{');
    put_members(&j, &layout_energy, r, 1);
    close_list(&j, '}');
    open_list(&j, "totals", '{');
    put_members(&j, &layout_totals, r, 1);
    put_members(&j, &layout_collapse, r, 1);
    close_list(&j, '}');
    fputs("\n}\n", to);
}
