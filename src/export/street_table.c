// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/street_table.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "core/arena.h"
#include "core/text.h"

static const double G = 9.80665;  // [m/s^2]

static const struct dimension dimension_area = OF_AREA;
const struct street_column street_columns[STREET_KEYS] = {
    [STREET_NAME] = {.name = "name"},
    [STREET_TYPE] = {.name = "type"},
    [STREET_CODE] = {.name = "code"},
    [STREET_LAW] = {.name = "law"},
    [STREET_STOREYS] = {"storeys", &dimension_none, 1, 1000, true},
    [STREET_YEAR] = {"year", &dimension_none, 1000, 3000, true},
    [STREET_STOREY_HEIGHT] = {"storey-height", &dimension_length, 0.1, 100, false},
    [STREET_HEIGHT] = {"height", &dimension_length, 0.1, 1e4, false},
    [STREET_AREA] = {"area", &dimension_area, 0.01, 1e6, false},
    [STREET_MASS] = {"mass", &dimension_mass, 1, 1e9, false},
    [STREET_PERIOD] = {"period", &dimension_time, 0.01, 100, false},
    [STREET_STIFFNESS] = {"stiffness", &dimension_stiffness, 1, 1e15, false},
    [STREET_YIELD] = {"yield", &dimension_none, 1e-6, 100, false},
    [STREET_HARDENING] = {"hardening", &dimension_none, 0, 1, false},
    [STREET_DAMPING] = {"damping", &dimension_none, 0, 0.9, false},
    [STREET_GAP] = {"gap", &dimension_length, 0, 1e3, false},
    [STREET_K] = {"k", &dimension_stiffness, 1, 1e15, false},
    [STREET_E] = {"e", &dimension_none, 0.01, 1, false},
};

void street_table_report(struct street_table *r, enum severity severity, struct piece at,
                         const char *format, ...) {
    char text[400];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    const struct piece whole = r->lines.whole;
    const struct diagnostic item = {
        .severity = severity,
        .file = r->text.path,
        .line = r->lines.number,
        .column = (int)text_columns(whole.text, (size_t)(at.text - whole.text)) + 1,
        .width = at.n > 0 ? (int)text_columns(at.text, at.n) : 1,
        .source_line = arena_text(r->arena, whole.text, whole.n)};
    diagnostics_add(r->d, &item, "%s", text);
}

// Takes a cell off the line; false: none is left.
static bool next_cell(struct piece *rest, char separator, struct piece *cell) {
    if (!rest->text) {
        return false;
    }
    const char *end = rest->n > 0 ? memchr(rest->text, separator, rest->n) : NULL;
    const size_t n = end ? (size_t)(end - rest->text) : rest->n;
    *cell = lines_trim((struct piece){rest->text, n});
    *rest = end ? (struct piece){end + 1, rest->n - n - 1} : (struct piece){NULL, 0};
    return true;
}

// Blank lines and comments do not count.
static bool next_line(struct street_table *r) {
    while (lines_next(&r->lines)) {
        if (r->lines.line.n > 0 && r->lines.line.text[0] != '#') {
            return true;
        }
    }
    return false;
}

const char *street_table_text(struct street_table *r, struct piece p) {
    const char *text = arena_text(r->arena, p.text, p.n);
    return text ? text : "";
}

// The unit of a column in SI; "1" of numbers, "none" of texts.
static const char *si_unit(const struct street_column *c, char *text, size_t size) {
    struct unit_system si;
    unit_system_init(&si);
    snprintf(text, size, "none");
    if (c->dimension) {
        unit_text(&si, *c->dimension, text, size);
    }
    return text;
}

// --- headings ------------------------------------------------------------------------------------

// The key of a heading without its unit; upper case, spaces and _ do not matter. -1: there is none.
static int key_of(struct piece heading) {
    char name[32] = "";
    for (size_t i = 0; i < heading.n && i + 1 < sizeof name; i++) {
        const char c = heading.text[i];
        name[i] = c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c == ' ' || c == '_' ? '-' : c;
    }
    for (int k = 0; k < STREET_KEYS; k++) {
        if (heading.n < sizeof name && strcmp(street_columns[k].name, name) == 0) {
            return k;
        }
    }
    return -1;
}

static void read_unit(struct street_table *r, int key, struct piece unit) {
    const char *text = street_table_text(r, unit), *end;
    struct dimension found;
    double size;
    const struct street_column *c = &street_columns[key];
    if (!c->dimension || !unit_parse(text, G, &end, &found, &size) || *end ||
        !dimension_equal(found, *c->dimension)) {
        char si[64];
        street_table_report(r, SEVERITY_ERROR, unit, "'%s' is not a unit of %s; SI has %s",
                            lines_excerpt(unit).text, c->name, si_unit(c, si, sizeof si));
    } else {
        r->unit[key] = size;
    }
}

static void read_heading(struct street_table *r, int column, struct piece heading) {
    struct piece rest = heading, unit, name = heading;
    const bool bracket = lines_bracket(&rest, &unit);
    if (bracket) {
        name = lines_trim((struct piece){heading.text, (size_t)(unit.text - 1 - heading.text)});
    }
    const int key = key_of(name);
    const char *known[STREET_KEYS];
    for (int k = 0; k < STREET_KEYS; k++) {
        known[k] = street_columns[k].name;
        if (key >= 0 && k < column && r->key[k] == key) {
            street_table_report(r, SEVERITY_ERROR, heading, "a second column %s",
                                street_columns[key].name);
            return;
        }
    }
    r->key[column] = key;
    if (key < 0) {
        const char *near = text_nearest(street_table_text(r, name), known, STREET_KEYS);
        street_table_report(r, SEVERITY_WARNING, heading, "column '%s' is not used%s%s%s",
                            lines_excerpt(name).text, near ? "; did you mean '" : "",
                            near ? near : "", near ? "'?" : "");
    } else if (bracket) {
        read_unit(r, key, lines_trim(unit));
    }
}

void street_table_begin(struct street_table *r) {
    lines_init(&r->lines, &r->text);
    if (!next_line(r)) {
        street_table_report(r, SEVERITY_ERROR, r->lines.line, "the file has no headings");
        return;
    }
    struct piece rest = r->lines.line, cell;
    r->separator = memchr(rest.text, '\t', rest.n)  ? '\t'
                   : memchr(rest.text, ';', rest.n) ? ';'
                                                    : ',';
    while (next_cell(&rest, r->separator, &cell)) {
        if (r->n_column == STREET_COLUMNS_MAX) {
            street_table_report(r, SEVERITY_ERROR, cell, "more than %d columns",
                                STREET_COLUMNS_MAX);
            return;
        }
        r->key[r->n_column] = -1;
        read_heading(r, r->n_column++, cell);
    }
    bool there = false;
    for (int i = 0; i < r->n_column; i++) {
        there = there || r->key[i] == STREET_STOREYS;
    }
    if (!there) {
        street_table_report(r, SEVERITY_ERROR, r->lines.line,
                            "the headings have no column 'storeys'");
    }
}

// --- cells ---------------------------------------------------------------------------------------

static double read_number(struct street_table *r, int key) {
    const struct street_column *c = &street_columns[key];
    const char *text = street_table_text(r, r->cell[key]), *end;
    struct dimension found;
    double value, size = r->unit[key];
    if (text_number(text, &end, &value) != TEXT_NUMBER_OK) {
        street_table_report(r, SEVERITY_ERROR, r->cell[key], "%s is '%s'; it must be a number",
                            c->name, lines_excerpt(r->cell[key]).text);
        return NAN;
    }
    end += strspn(end, " ");
    if (*end) {
        const char *unit = end;
        if (!unit_parse(unit, G, &end, &found, &size) || *end ||
            !dimension_equal(found, *c->dimension)) {
            street_table_report(r, SEVERITY_ERROR, r->cell[key], "'%s' is not %s with its unit",
                                lines_excerpt(r->cell[key]).text, c->name);
            return NAN;
        }
    } else if (size == 0.0 && !dimension_equal(*c->dimension, dimension_none)) {
        street_table_report(
            r, SEVERITY_ERROR, r->cell[key],
            "%s has no unit; write it in the heading, as in 'gap [mm]', or behind the number",
            c->name);
        return NAN;
    }
    value *= size > 0.0 ? size : 1.0;
    if (!(value >= c->least && value <= c->most) || (c->whole && value != floor(value))) {
        char unit[64];
        street_table_report(
            r, SEVERITY_ERROR, r->cell[key], "%s is %s; it must be %s>= %g and <= %g%s%s", c->name,
            text, c->whole ? "whole, " : "", c->least, c->most,
            *unit_suffix(si_unit(c, unit, sizeof unit)) ? " " : "", unit_suffix(unit));
        return NAN;
    }
    return value;
}

bool street_table_is(struct piece p, const char *word) {
    return p.n == strlen(word) && memcmp(p.text, word, p.n) == 0;
}

static bool read_cells(struct street_table *r) {
    struct piece rest = r->lines.line, cell;
    const int errors = r->d->n_error;
    for (int k = 0; k < STREET_KEYS; k++) {
        r->cell[k] = (struct piece){r->lines.line.text, 0};
        r->value[k] = NAN;
    }
    int n = 0;
    for (; next_cell(&rest, r->separator, &cell); n++) {
        if (n >= r->n_column) {
            if (cell.n > 0) {
                street_table_report(r, SEVERITY_ERROR, cell,
                                    "a cell without a heading; there are %d headings", r->n_column);
            }
        } else if (r->key[n] >= 0) {
            r->cell[r->key[n]] = cell;
            if (memchr(cell.text, '"', cell.n)) {
                street_table_report(r, SEVERITY_ERROR, cell,
                                    "quotation marks are not read; leave them out");
            }
        }
    }
    for (int k = STREET_STOREYS; k < STREET_KEYS && r->d->n_error == errors; k++) {
        if (r->cell[k].n > 0 && !(k == STREET_GAP && street_table_is(r->cell[k], "none"))) {
            r->value[k] = read_number(r, k);
        }
    }
    return r->d->n_error == errors;
}

bool street_table_next(struct street_table *r, bool *good) {
    if (!next_line(r)) {
        return false;
    }
    *good = read_cells(r);
    return true;
}
