// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/compare.h"

#include <stdlib.h>
#include <string.h>

#include "command/crash.h"
#include "plot/runs.h"
#include "result/layout.h"

// The history that a series is: of a floor of a building, or of a contact.
struct compare_place {
    int owner, floor;  // from 0; floor -1: a contact
};

void compare_replace(char *text, char from, char to) {
    for (; *text; text++) {
        *text = *text == from ? to : *text;
    }
}

// "displacement:A:1" as a field, a building or contact, and a floor.
int compare_read_quantity(struct comparing *c) {
    char *kind = arena_text(c->arena, c->quantity, strlen(c->quantity));
    if (!kind) {
        return command_no_memory();
    }
    char *owner = strchr(kind, ':'), *floor = owner ? strchr(owner + 1, ':') : NULL, *end = NULL;
    if (floor) {
        *floor++ = '\0';
        const long number = strtol(floor, &end, 10);
        if (end == floor || *end || number < 1 || number > FLOORS_MAX) {
            return command_usage(&command_compare, "'%s' is not a floor; give KIND:BUILDING:FLOOR",
                                 floor);
        }
        c->floor = (int)number;
    }
    if (owner) {
        *owner++ = '\0';
        c->owner = owner;
    }
    compare_replace(kind, '-', '_');
    for (int i = 0; i < FIELD_COUNT; i++) {
        if (strcmp(kind, field_names[i]) == 0) {
            c->field = i;
            return EXIT_DONE;
        }
    }
    return command_unknown(&command_compare, "quantity", kind, field_names, FIELD_COUNT);
}

static int compare_open(const char *path, struct result_file **f, struct error *e) {
    crash_reading(NULL, path);
    return result_open(path, f, e);
}

// The places of a run that the quantity names, and how many; `place` may be NULL.
static int compare_places(const struct comparing *c, const struct report *r,
                          struct compare_place *place) {
    const bool floors = c->field < FLOOR_FIELD_COUNT;
    int n = 0;
    for (int i = 0; i < (floors ? r->n_building : r->n_contact); i++) {
        const char *name = floors ? r->building[i].name : r->contact[i].name;
        const int first = floors ? 0 : -1, last = floors ? r->building[i].n_floor - 1 : -1;
        for (int k = first; (!c->owner || strcmp(c->owner, name) == 0) && k <= last; k++) {
            if (c->floor == 0 || c->floor == k + 1) {
                if (place) {
                    place[n] = (struct compare_place){i, k};
                }
                n++;
            }
        }
    }
    return n;
}

static int compare_none(const struct comparing *c, const struct report *r, struct error *e) {
    return error_set(e, STATUS_INPUT, "%s has no %s", r->file,
                     c->quantity ? c->quantity : field_names[c->field]);
}

static int compare_read(struct comparing *c, const struct result_file *f,
                        const struct compare_place *p, struct time_series *out, struct error *e) {
    const struct report *r = result_report(f);
    const size_t n = (size_t)r->n_row;
    double *time = arena_alloc(c->arena, n, sizeof *time);
    double *value = arena_alloc(c->arena, n, sizeof *value);
    if (!time || !value) {
        return error_no_memory(e);
    }
    const struct history h = {p->floor >= 0 ? HISTORY_FLOOR : HISTORY_CONTACT, 1 << c->field,
                              p->owner, p->floor};
    const int status = result_history(f, &(struct history){.kind = HISTORY_TIME}, time, e);
    *out = (struct time_series){n, time, value};
    return status == STATUS_OK ? result_history(f, &h, value, e) : status;
}

static const char *compare_name(struct comparing *c, const struct report *r,
                                const struct compare_place *p) {
    const char *field = field_names[c->field];
    return p->floor >= 0
               ? arena_format(c->arena, "%s:%s:%d", field, r->building[p->owner].name, p->floor + 1)
               : arena_format(c->arena, "%s:%s", field, r->contact[p->owner].name);
}

// The other histories of all places: of a result file, or columns of text.
static int compare_read_others(struct comparing *c, const struct result_file *ours,
                               const char *path, const struct compare_place *place,
                               struct error *e) {
    const char *ending = strstr(path, ".h5");
    if (ending && (ending[3] == '\0' || ending[3] == '#')) {
        struct result_file *f;
        struct runs both;
        int status = compare_open(path, &f, e);
        if (status != STATUS_OK) {
            return status;
        }
        status = runs_init(&both, ours, f, e);
        for (int i = 0; status == STATUS_OK && i < c->n; i++) {
            status = compare_read(c, f, &place[i], &c->pair[i].reference, e);
        }
        result_close(f);
        return status;
    }
    const double *value;
    size_t n_row;
    const int status = time_series_matrix(c->arena, path, c->n + 1, &value, &n_row, e);
    for (int i = 0; status == STATUS_OK && i < c->n; i++) {
        c->pair[i].reference = (struct time_series){n_row, value, value + (size_t)(i + 1) * n_row};
    }
    return status;
}

static int compare_open_two(struct comparing *c, const struct result_file *f, const char *other,
                            struct error *e) {
    const struct report *r = result_report(f);
    c->n = compare_places(c, r, NULL);
    if (c->n == 0) {
        return compare_none(c, r, e);
    }
    struct compare_place *place = arena_alloc(c->arena, (size_t)c->n, sizeof *place);
    c->pair = arena_alloc(c->arena, (size_t)c->n, sizeof *c->pair);
    c->title = arena_text(c->arena, r->title, strlen(r->title));
    if (!place || !c->pair || !c->title) {
        return error_no_memory(e);
    }
    (void)compare_places(c, r, place);
    c->units = r->units;
    int status = result_check_memory(f, 2 * c->n, e);
    for (int i = 0; status == STATUS_OK && i < c->n; i++) {
        c->pair[i].name = compare_name(c, r, &place[i]);
        status = compare_read(c, f, &place[i], &c->pair[i].computed, e);
    }
    return status == STATUS_OK ? compare_read_others(c, f, other, place, e) : status;
}

int compare_two(struct comparing *c, const char *path, const char *other, struct error *e) {
    struct result_file *f;
    int status = compare_open(path, &f, e);
    if (status == STATUS_OK) {
        status = compare_open_two(c, f, other, e);
        result_close(f);
    }
    return status;
}

// The measured history in the units of a run. Units of the file are those of its caption, else
// those of the run.
static int compare_measured(struct comparing *c, const struct unit_system *u,
                            struct time_series *out, struct error *e) {
    const struct dimension what = *layout_field[c->field].dimension;
    const double time = unit_size(u, dimension_time), value = unit_size(u, what);
    const struct time_series_column column[TIME_SERIES_COLUMNS] = {
        {.name = "time", .dimension = dimension_time, .unit = time},
        {.name = "value", .dimension = what, .unit = value}};
    const int status = time_series_read(c->arena, c->measured, column, out, e);
    double *at = arena_alloc(c->arena, out->n, sizeof *at);
    double *of = arena_alloc(c->arena, out->n, sizeof *of);
    if (status != STATUS_OK || !at || !of) {
        return status != STATUS_OK ? status : error_no_memory(e);
    }
    for (size_t i = 0; i < out->n; i++) {
        at[i] = unit_convert(out->time[i], 1.0, time);
        of[i] = unit_convert(out->value[i], 1.0, value);
    }
    *out = (struct time_series){out->n, at, of};
    return STATUS_OK;
}

// A run beside the measurement.
static int compare_one(struct comparing *c, const char *path, struct comparison_pair *pair,
                       struct error *e) {
    struct result_file *f;
    struct compare_place place = {0};
    int status = compare_open(path, &f, e);
    if (status != STATUS_OK) {
        return status;
    }
    const struct report *r = result_report(f);
    const int n = compare_places(c, r, NULL);
    if (n == 1) {
        (void)compare_places(c, r, &place);
        c->units = r->units;
        c->title = c->title ? c->title : arena_text(c->arena, r->title, strlen(r->title));
        pair->name = path;
        status = compare_measured(c, &r->units, &pair->reference, e);
        status = status == STATUS_OK ? compare_read(c, f, &place, &pair->computed, e) : status;
    } else {
        status = n == 0 ? compare_none(c, r, e)
                        : error_set(e, STATUS_INPUT,
                                    "'%s' names %d histories of %s; name one: KIND:BUILDING:FLOOR, "
                                    "or KIND:CONTACT",
                                    c->quantity, n, r->file);
    }
    result_close(f);
    return status;
}

int compare_all(struct comparing *c, const struct words *run, struct error *e) {
    c->n = run->n;
    c->pair = arena_alloc(c->arena, (size_t)c->n, sizeof *c->pair);
    if (!c->pair) {
        return error_no_memory(e);
    }
    int status = STATUS_OK;
    for (int i = 0; status == STATUS_OK && i < c->n; i++) {
        status = compare_one(c, run->word[i], &c->pair[i], e);
    }
    return status;
}
