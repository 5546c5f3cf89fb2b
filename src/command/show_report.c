// SPDX-License-Identifier: GPL-3.0-or-later
// A report as one long table, or as JSON. One walk over the report gives both.
//
// The table has a line for each value: table, name, quantity, location, value, unit, time, hit. The
// location is a floor, or the number of an impact. The time is that of a peak, or of an impact's
// start. hit is 1 for the acceleration of a floor that was hit, and 0 for that of any other floor.
// JSON has null for values that are not numbers.
#include <math.h>
#include <string.h>

#include "command/show.h"
#include "core/safe.h"
#include "core/text.h"
#include "result/layout.h"

struct sink {
    const struct report *r;
    FILE *to;
    struct printer *table;  // NULL: JSON
    bool follows;           // of JSON: a comma goes before the next value
};

// The times of the values in the long table: one for all; those of peaks, which are in the next
// column, "NAME_time"; the end of the run for energies, 0 for the initial one.
enum times { TIME_OF_ALL, TIMES_OF_PEAKS, TIMES_OF_ENERGIES };

// The columns of a table for one owner.
struct group {
    const char *table, *name;  // in the long table; table NULL: only JSON has the values
    const struct column_table *of;
    const void *base;
    int n;          // values of an array, over floors
    long location;  // of other values; 0: none
    enum times times;
    double time;       // NAN: none
    bool never_first;  // the first value has never occurred and has no time
};

// --- the long table ------------------------------------------------------------------------------

static bool has_times(const struct group *g, int c) {
    const struct column *column = g->of->column;
    const size_t n = strlen(column[c].name);
    return g->times == TIMES_OF_PEAKS && c + 1 < g->of->n_column &&
           strncmp(column[c + 1].name, column[c].name, n) == 0 &&
           strcmp(column[c + 1].name + n, "_time") == 0;
}

static double time_of(const struct group *g, int c, size_t i) {
    if (g->times == TIMES_OF_ENERGIES) {
        return c < ENERGY_COUNT ? g->time : c == ENERGY_COUNT ? 0.0 : (double)NAN;
    }
    const bool peak = has_times(g, c) && !(g->never_first && c == 0);
    return peak ? *(const double *)layout_at(g->of, c + 1, g->base, i) : g->time;
}

// The line of value `i` of a column; none for texts, and arrays that are not there.
static void put_line(const struct sink *o, const struct group *g, int c, size_t i) {
    const struct column *column = &g->of->column[c];
    const void *at = layout_at(g->of, c, g->base, i);
    const bool array = column->kind == COLUMN_ARRAY;
    const long location = array ? (long)i + 1 : g->location;
    const double time = time_of(g, c, i);
    struct printer *t = o->table;
    char unit[64] = "1";
    if (!at || column->kind == COLUMN_TEXT) {
        return;
    }
    printer_text(t, g->table);
    printer_text(t, g->name);
    printer_text(t, column->name);
    if (location > 0) {
        printer_whole(t, location);
    } else {
        printer_empty(t);
    }
    if (array || column->kind == COLUMN_DOUBLE) {
        printer_number(t, layout_number(column, at));
    } else {
        printer_whole(t, layout_whole(column, at));
    }
    if (column->dimension) {
        unit_text(&o->r->units, *column->dimension, unit, sizeof unit);
    }
    printer_text(t, unit);
    if (isnan(time)) {
        printer_empty(t);
    } else {
        printer_number(t, time);
    }
    const bool acceleration = array && strcmp(column->name, peak_names[PEAK_ACCELERATION]) == 0;
    printer_sign(t, acceleration ? report_floor_was_hit(o->r, g->name, (int)location) : -1);
    printer_line(t);
}

// --- JSON ----------------------------------------------------------------------------------------

static void put_key(struct sink *o, const char *name) {
    fputs(o->follows ? ",\n" : "\n", o->to);
    if (name) {
        safe_put(o->to, SAFE_JSON, name);
        fputs(": ", o->to);
    }
    o->follows = true;
}

static void put_number(const struct sink *o, double value) {
    struct text_exact t;
    fputs(isfinite(value) ? text_exact(&t, value) : "null", o->to);
}

static void put_member(struct sink *o, const struct group *g, int c) {
    const struct column *column = &g->of->column[c];
    const void *at = layout_at(g->of, c, g->base, 0);
    if (!at) {
        return;  // an array that is not there
    }
    put_key(o, column->name);
    switch (column->kind) {
        case COLUMN_TEXT:
            safe_put(o->to, SAFE_JSON, *(const char *const *)at);
            break;
        case COLUMN_DOUBLE:
            put_number(o, *(const double *)at);
            break;
        case COLUMN_ARRAY:
            for (int i = 0; i < g->n; i++) {
                fputs(i == 0 ? "[" : ", ", o->to);
                put_number(o, ((const double *)at)[i]);
            }
            fputs("]", o->to);
            break;
        default:
            fprintf(o->to, "%ld", layout_whole(column, at));
    }
}

// The table has no brackets, and no texts and numbers but those of groups.

static void open_bracket(struct sink *o, const char *name, char bracket) {
    if (!o->table) {
        put_key(o, name);
        fputc(bracket, o->to);
        o->follows = false;
    }
}

static void close_bracket(struct sink *o, char bracket) {
    if (!o->table) {
        fprintf(o->to, "\n%c", bracket);
        o->follows = true;
    }
}

static void put_text(struct sink *o, const char *name, const char *text) {
    if (!o->table) {
        put_key(o, name);
        safe_put(o->to, SAFE_JSON, text);
    }
}

static void put_count(struct sink *o, const char *name, int n) {
    if (!o->table) {
        put_key(o, name);
        fprintf(o->to, "%d", n);
    }
}

// --- the walk ------------------------------------------------------------------------------------

static void put(struct sink *o, const struct group *g, const struct column_table *of) {
    struct group own = *g;
    own.of = of;
    for (int c = 0; c < of->n_column; c++) {
        const int n = of->column[c].kind == COLUMN_ARRAY ? g->n : 1;
        if (!o->table) {
            put_member(o, &own, c);
            continue;
        }
        for (int i = 0; g->table && i < n; i++) {
            put_line(o, &own, c, (size_t)i);
        }
        c += has_times(&own, c);
    }
}

// The members of frames and walls, named BUILDING/MEMBER in the table.
static void put_members(struct sink *o, const struct report_building *b) {
    char name[160];
    open_bracket(o, "members", '[');
    for (int i = 0; i < b->n_member; i++) {
        snprintf(name, sizeof name, "%s/%s", b->name, b->member[i].name);
        const struct group g = {.table = "members",
                                .name = name,
                                .base = &b->member[i],
                                .n = 1,
                                .time = NAN,
                                .times = TIMES_OF_PEAKS};
        open_bracket(o, NULL, '{');
        put(o, &g, &layout_member);
        put(o, &g, &layout_member_peak[b->hinged]);
        if (b->extremes) {
            put(o, &g, &layout_member_extreme[b->hinged]);
        }
        close_bracket(o, '}');
    }
    close_bracket(o, ']');
}

// The shares of what resists, named BUILDING/PART in the table.
static void put_shares(struct sink *o, const struct report_building *b) {
    char name[160];
    open_bracket(o, "parts", '[');
    for (int i = 0; i < b->n_share; i++) {
        snprintf(name, sizeof name, "%s/%s", b->name, b->share[i].name);
        const struct group g = {.table = "parts",
                                .name = name,
                                .base = &b->share[i],
                                .n = b->n_floor,
                                .time = NAN,
                                .times = TIMES_OF_PEAKS};
        open_bracket(o, NULL, '{');
        put(o, &g, &layout_share);
        put(o, &g, &layout_share_peak);
        close_bracket(o, '}');
    }
    close_bracket(o, ']');
}

static void put_building(struct sink *o, const struct report_building *b) {
    struct group g = {.table = "buildings",
                      .name = b->name,
                      .base = b,
                      .n = b->n_floor,
                      .time = NAN,
                      .times = TIMES_OF_PEAKS};
    open_bracket(o, NULL, '{');
    put_text(o, "name", b->name);
    put_count(o, "floors", b->n_floor);
    if (b->isolated > 0) {
        put_count(o, layout_isolated_name, b->isolated);
    }
    put(o, &g, &layout_building);
    put(o, &g, &layout_pdelta);
    open_bracket(o, "envelope", '{');
    put(o, &g, &layout_peak);
    close_bracket(o, '}');
    if (b->n_member > 0) {
        put_members(o, b);
    }
    if (b->n_share > 0) {
        put_shares(o, b);
    }
    if (b->foundation) {
        g.table = "foundations";
        g.base = b->foundation;
        open_bracket(o, "foundation", '{');
        put(o, &g, &layout_foundation);
        close_bracket(o, '}');
    }
    close_bracket(o, '}');
}

static void put_links(struct sink *o, const struct link_group *links,
                      const struct report_link *link, int n) {
    const bool contacts = links == &layout_contacts;
    open_bracket(o, links->name, '[');
    for (int i = 0; i < n; i++) {
        struct group g = {
            .table = links->name, .name = link[i].name, .base = &link[i], .n = 1, .time = NAN};
        open_bracket(o, NULL, '{');
        put(o, &g, &layout_link);
        if (!o->table && layout_has_levels(&link[i], 1)) {
            put(o, &g, &layout_level);
        }
        g.times = contacts ? TIMES_OF_PEAKS : TIME_OF_ALL;
        g.never_first = contacts && link[i].peak.impacts == 0;
        open_bracket(o, "envelope", '{');
        put(o, &g, links->peaks);
        close_bracket(o, '}');
        close_bracket(o, '}');
    }
    close_bracket(o, ']');
}

static void put_impacts(struct sink *o) {
    open_bracket(o, "impacts", '[');
    for (long i = 0; i < o->r->n_impact; i++) {
        const struct impact *p = &o->r->impact[i];
        const struct group g = {.table = "impacts",
                                .name = o->r->contact[p->contact].name,
                                .base = p,
                                .n = 1,
                                .location = i + 1,
                                .time = p->t_start};
        open_bracket(o, NULL, '{');
        put(o, &g, &layout_impact);
        close_bracket(o, '}');
    }
    close_bracket(o, ']');
}

static void put_report(struct sink *o) {
    const struct report *r = o->r;
    struct group g = {.name = "", .base = r, .n = 1, .time = NAN};
    put(o, &g, &layout_root);
    open_bracket(o, "units", '{');
    put_text(o, "force", r->units.force_name);
    put_text(o, "length", r->units.length_name);
    put_text(o, "time", r->units.time_name);
    close_bracket(o, '}');
    open_bracket(o, "buildings", '[');
    for (int i = 0; i < r->n_building; i++) {
        put_building(o, &r->building[i]);
    }
    close_bracket(o, ']');
    put_links(o, &layout_contacts, r->contact, r->n_contact);
    put_links(o, &layout_links, r->link, r->n_link);
    put_links(o, &layout_columns, r->column, r->n_column);
    put_impacts(o);
    open_bracket(o, "energy", '{');
    g.table = "energy";
    g.times = TIMES_OF_ENERGIES;
    g.time = r->collapse.happened ? r->collapse.time : r->duration;
    put(o, &g, &layout_energy);
    close_bracket(o, '}');
    open_bracket(o, "totals", '{');
    g = (struct group){.table = "totals", .name = "", .base = r, .n = 1, .time = NAN};
    put(o, &g, &layout_totals);
    put(o, &g, &layout_collapse);
    close_bracket(o, '}');
}

void show_json(const struct report *r, FILE *to) {
    struct sink o = {.r = r, .to = to};
    fputc('{', to);
    put_report(&o);
    fputs("\n}\n", to);
}

int show_table(const struct report *r, enum printer_form form, FILE *to) {
    static const struct printer_column columns[] = {
        COLUMN_DATA("table"), COLUMN_DATA("name"), COLUMN_DATA("quantity"), COLUMN_DATA("location"),
        COLUMN_DATA("value"), COLUMN_DATA("unit"), COLUMN_DATA("time"),     COLUMN_DATA("hit")};
    struct printer t = {.to = to, .form = form};
    PRINTER_ADD(&t, columns);
    printer_head(&t);
    put_report(&(struct sink){.r = r, .to = to, .table = &t});
    return printer_close(&t);
}
