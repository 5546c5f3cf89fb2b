// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/printer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/safe.h"
#include "core/text.h"

const struct option_row printer_rows[] = {
    {"csv", .kind = OPTION_SET, .set = FORM_CSV,
     .doc = "the same, separated by commas and quoted as RFC 4180 says"},
    {"json", .kind = OPTION_SET, .set = FORM_JSON,
     .doc = "the same as {\"columns\": [...], \"data\": [[...], ...]}; a missing number is null"},
    {0}};

void printer_add(struct printer *t, const struct printer_column *column, int n) {
    if (t->n_column + n > t->capacity) {
        const int capacity = 2 * t->capacity + n + 16;
        struct printer_column *more = realloc(t->column, (size_t)capacity * sizeof *more);
        if (!more) {
            t->failed = true;
            return;
        }
        t->column = more;
        t->capacity = capacity;
    }
    memcpy(t->column + t->n_column, column, (size_t)n * sizeof *column);
    t->n_column += n;
}

// Blanks wait for what follows them, so that no line ends in one.
static void put_aligned(struct printer *t, const struct printer_column *c, const char *text) {
    const int n = text_columns(text, strlen(text));
    if (t->n_shown == 0) {
        t->blanks += t->indent;
    } else {
        t->blanks += c->width > 0 ? 1 : 2;
    }
    if (c->look == LOOK_TAIL) {
        fprintf(t->to, "%*s", t->blanks, "");
        safe_cell(t->to, text, -c->width);
        t->blanks = 0;
        return;
    }
    t->blanks += c->width > n ? c->width - n : 0;
    if (n > 0) {
        fprintf(t->to, "%*s", t->blanks, "");
        safe_put(t->to, SAFE_TERMINAL, text);
        t->blanks = 0;
    }
    t->blanks += -c->width > n ? -c->width - n : 0;
}

// A cell: in text `text`; in data the literal `data`, or where that is NULL the text made safe.
static void put(struct printer *t, const char *text, const char *data) {
    static const enum safe safe[] = {
        [FORM_TSV] = SAFE_TSV, [FORM_CSV] = SAFE_CSV, [FORM_JSON] = SAFE_JSON};
    if (t->failed || !t->column || t->at >= t->n_column) {
        return;
    }
    const struct printer_column *c = &t->column[t->at++];
    if (!(t->form == FORM_TEXT ? c->head : c->key)) {
        return;
    }
    if (t->form == FORM_TEXT) {
        put_aligned(t, c, text);
    } else {
        static const char *const between[] = {
            [FORM_TSV] = "\t", [FORM_CSV] = ",", [FORM_JSON] = ", "};
        if (t->n_shown > 0) {
            fputs(between[t->form], t->to);
        } else if (t->form == FORM_JSON) {
            fputs(t->n_line == 0 ? "{\"columns\": [" : t->n_line == 1 ? "\n[" : ",\n[", t->to);
        }
        if (data) {
            fputs(data, t->to);
        } else {
            safe_put(t->to, safe[t->form], text);
        }
    }
    t->n_shown++;
}

void printer_text(struct printer *t, const char *text) {
    put(t, text, NULL);
}

void printer_read(double value, int digits, char *text, size_t size) {
    const bool whole = fabs(value) >= 1e4 && fabs(value) < 999999.5;
    if (isnan(value)) {
        snprintf(text, size, "-");
    } else {
        snprintf(text, size, whole ? "%.*f" : "%.*g", whole ? 0 : digits, value);
    }
}

void printer_number(struct printer *t, double value) {
    static const char *const format[] = {[LOOK_G] = "%.*g", [LOOK_F] = "%.*f", [LOOK_E] = "%.*e"};
    const bool in_text = t->form == FORM_TEXT && t->at < t->n_column;
    const struct printer_column *c = in_text ? &t->column[t->at] : NULL;
    struct text_exact exact;
    char text[64] = "-";
    if (c && c->look == LOOK_READ) {
        printer_read(value, c->digits, text, sizeof text);
    } else if (c && !isnan(value)) {
        snprintf(text, sizeof text, format[c->look], c->digits, value);
    }
    const bool null = t->form == FORM_JSON && !isfinite(value);
    put(t, text, null ? "null" : isnan(value) ? "nan" : text_exact(&exact, value));
}

void printer_numbers(struct printer *t, const double *value, int n) {
    for (int i = 0; i < n; i++) {
        printer_number(t, value[i]);
    }
}

void printer_whole(struct printer *t, long value) {
    char text[32];
    snprintf(text, sizeof text, "%ld", value);
    put(t, text, text);
}

void printer_sign(struct printer *t, int value) {
    if (value < 0) {
        printer_empty(t);
    } else {
        printer_whole(t, value);
    }
}

void printer_empty(struct printer *t) {
    put(t, "", t->form == FORM_JSON ? "null" : "");
}

void printer_line(struct printer *t) {
    if (t->failed) {
        return;
    }
    while (t->form != FORM_TEXT && t->at < t->n_column) {
        printer_empty(t);
    }
    fputs(t->form != FORM_JSON ? "\n" : t->n_line == 0 ? "],\n\"data\": [" : "]", t->to);
    t->at = t->n_shown = t->blanks = 0;
    t->n_line++;
}

static void put_name(struct printer *t, const char *name, const char *unit, bool within) {
    char text[1024];
    snprintf(text, sizeof text, "%s [%s]", name, unit);
    put(t, within && unit[0] ? text : name, NULL);
}

static void put_unit(struct printer *t, const char *unit) {
    char text[72];
    snprintf(text, sizeof text, "[%s]", unit);
    put(t, t->at_head == UNITS_BELOW && unit[0] ? text : unit, NULL);
}

void printer_head(struct printer *t) {
    const bool below = t->form == FORM_TEXT && t->at_head != UNITS_BEHIND;
    for (int line = 0; line < (below ? 2 : 1); line++) {
        for (int i = 0; i < t->n_column; i++) {
            const struct printer_column *c = &t->column[i];
            const char *name = t->form == FORM_TEXT ? c->head : c->key;
            char text[64] = "";
            if (!c->unit && c->dimension) {
                unit_text(t->units, *c->dimension, text, sizeof text);
            }
            const char *unit = c->unit ? c->unit : text;
            if (line == 0) {
                put_name(t, name ? name : "", unit, !below);
            } else {
                put_unit(t, unit);
            }
        }
        printer_line(t);
    }
}

static void end(struct printer *t) {
    fputs(t->form == FORM_JSON && !t->failed ? "\n]}\n" : "", t->to);
    free(t->column);
    t->column = NULL;
}

int printer_close(struct printer *t) {
    end(t);
    return t->failed ? command_no_memory() : EXIT_DONE;
}

int printer_end(struct printer *t, int status, struct error *e) {
    end(t);
    return status == STATUS_OK && t->failed ? error_no_memory(e) : status;
}

void printer_add_sweep(struct printer *t, const struct sweep *sweep) {
    for (const struct sweep *s = sweep; s; s = s->along) {
        printer_add(t, &(struct printer_column)COLUMN_DATA(s->name), 1);
    }
}

void printer_show_sweep(struct printer *t, const struct sweep *sweep) {
    for (const struct sweep *s = sweep; s; s = s->along) {
        printer_add(t,
                    &(struct printer_column){.head = s->name,
                                             .key = s->name,
                                             .width = s->number ? 12 : -24,
                                             .digits = 6,
                                             .look = s->number ? LOOK_G : LOOK_TAIL},
                    1);
    }
}

void printer_sweep(struct printer *t, const struct sweep *sweep, int choice) {
    for (const struct sweep *s = sweep; s; s = s->along) {
        if (s->number) {
            printer_number(t, s->number[choice]);
        } else {
            printer_text(t, s->label[choice]);
        }
    }
}
