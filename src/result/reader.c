// SPDX-License-Identifier: GPL-3.0-or-later
// Opens a result file and reads everything but its histories into a report.
#include "result/reader.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/arena.h"

// What a file may claim before it is taken for damaged.
enum { BUILDINGS_LIMIT = 1 << 20, LIST_LIMIT = 1 << 26 };
enum { SIEVE_BYTES = 1 << 16 };

static int damaged(const struct h5 *h, const char *path, struct error *e) {
    return h5_lacks_memory(h) ? error_no_memory(e)
                              : error_set(e, STATUS_INPUT, "%s is damaged: %s", path, h->cause);
}

int reader_check_format(struct h5 *h, hid_t root, struct arena *a, const char *path,
                        struct error *e) {
    const char *format = h5_get_text(h, a, root, "format");
    if (h->failed && h5_lacks_memory(h)) {
        return error_no_memory(e);
    }
    if (!format || strcmp(format, "jostle") != 0) {
        return error_set(e, STATUS_INPUT, "%s is not a result file of jostle", path);
    }
    const long version = h5_get_long(h, root, "format_version");
    const char *status = h5_get_text(h, a, root, "status");
    if (h->failed) {
        return damaged(h, path, e);
    }
    if (version < 1 || version > RESULT_FORMAT_VERSION) {
        return error_set(e, STATUS_INPUT,
                         "%s has format version %ld; this program reads versions up to %d", path,
                         version, RESULT_FORMAT_VERSION);
    }
    if (strcmp(status, "complete") != 0) {
        return error_set(e, STATUS_INPUT, "%s is not complete: its status is '%s'", path, status);
    }
    return STATUS_OK;
}

static const double *get_doubles(struct result_file *f, const struct reader_place *p,
                                 const char *name, size_t n) {
    return h5_get_doubles(&f->h, f->report->arena, reader_place_holder(f, p, name), name, n);
}

// The same of a file of one run, or of that of the study which the run is of.
static int check_format(struct result_file *f, struct error *e) {
    const int status = reader_check_format(&f->h, f->h.file, f->report->arena, f->path, e);
    if (status == STATUS_OK && !reader_is_run(f) && h5_has(&f->h, f->root, "sweep")) {
        return error_set(e, STATUS_INPUT,
                         "%s is the result of a study, not of one analysis; "
                         "jostle show prints it",
                         f->path);
    }
    return status;
}

static void get_attributes(struct result_file *f) {
    struct report *r = f->report;
    h5_get_units(&f->h, r->arena, &r->units);
    for (int c = 0; c < layout_root.n_column; c++) {
        const bool is_own = !reader_is_run(f) || H5Aexists(f->root, layout_root.column[c].name) > 0;
        h5_get_member(&f->h, r->arena, is_own ? f->root : f->h.file, &layout_root, c, r);
    }
    for (int c = 0; c < layout_totals.n_column; c++) {
        h5_get_member(&f->h, r->arena, f->root, &layout_totals, c, &r->totals);
    }
    r->n_row = (long)h5_get_length(&f->h, f->root, "time", (size_t)1 << 30);
    if (r->n_row < 1) {
        h5_fail(&f->h, "dataset 'time' has no values");
    }
}

// Of a run of a study, an attribute says whether it has residual drifts.
static bool has_residual_drift(struct result_file *f, const struct reader_place *building,
                               const struct reader_place *envelope) {
    return envelope->own >= 0 ? h5_has(&f->h, envelope->own, layout_residual_drift_name)
                              : h5_get_long(&f->h, building->own, "yields") != 0;
}

static void get_envelope(struct result_file *f, const struct reader_place *building,
                         struct report_building *b) {
    const struct reader_place envelope = reader_place_open(f, building, "envelope");
    const size_t n = (size_t)b->n_floor;
    for (int p = 0; p < PEAK_COUNT && !f->h.failed; p++) {
        const char *time = arena_format(f->report->arena, "%s_time", peak_names[p]);
        if (!time) {
            h5_no_memory(&f->h);
            break;
        }
        b->peak[p] = get_doubles(f, &envelope, peak_names[p], n);
        b->peak_time[p] = get_doubles(f, &envelope, time, n);
    }
    if (!f->h.failed && has_residual_drift(f, building, &envelope)) {
        b->residual_drift = get_doubles(f, &envelope, layout_residual_drift_name, n);
    }
    reader_place_close(f, &envelope);
}

static void get_building(struct result_file *f, const struct reader_place *building,
                         struct report_building *b) {
    b->n_floor = (int)h5_get_length(&f->h, building->own, "floor", FLOORS_MAX);
    if (b->n_floor < 1) {
        h5_fail(&f->h, "building '%s' has no floors", b->name);
    }
    for (int c = 0; c < layout_building.n_column && !f->h.failed; c++) {
        const double **to = layout_to(&layout_building, c, b, 0);
        *to = get_doubles(f, building, layout_building.column[c].name, (size_t)b->n_floor);
    }
    get_envelope(f, building, b);
}

struct report_building *reader_building(struct h5 *h, hid_t group, const char *name,
                                        struct report *r) {
    const long position = h5_get_long(h, group, "position");
    char *copy = h5_copy(h, r->arena, name);
    if (!h->failed && (position < 0 || position >= r->n_building || r->building[position].name)) {
        h5_fail(h, "building '%s' has the position %ld", name, position);
    }
    if (h->failed) {
        return NULL;
    }
    r->building[position].name = copy;
    return &r->building[position];
}

void reader_buildings(struct h5 *h, hid_t root, struct report *r, H5L_iterate_t visit,
                      void *context) {
    hid_t group = h5_get_group(h, root, "buildings");
    H5G_info_t info = {.nlinks = 0};
    if (!h->failed && !h5_failed(h, H5Gget_info(group, &info)) &&
        (info.nlinks < 1 || info.nlinks > BUILDINGS_LIMIT)) {
        h5_fail(h, "it has %llu buildings; 1 to %d are allowed", (unsigned long long)info.nlinks,
                BUILDINGS_LIMIT);
    }
    r->building = h->failed ? NULL : h5_alloc(h, r->arena, info.nlinks, sizeof *r->building);
    if (r->building) {
        r->n_building = (int)info.nlinks;
        h5_failed(h, H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, NULL, visit, context));
    }
    h5_close(h, group);
}

static herr_t visit_building(hid_t parent, const char *name, const H5L_info_t *info,
                             void *context) {
    (void)info, (void)parent;
    struct result_file *f = context;
    struct report *r = f->report;
    const struct reader_place root = reader_place_root(f),
                              all = reader_place_open(f, &root, "buildings");
    const struct reader_place building = reader_place_open(f, &all, name);
    const hid_t group = building.own;
    struct report_building *b = reader_building(&f->h, group, name, r);
    for (int i = 0; i < FLOOR_FIELD_COUNT && b == r->building; i++) {
        r->fields |= h5_has(&f->h, group, field_names[i]) ? 1U << i : 0;
    }
    if (b) {
        get_building(f, &building, b);
    }
    reader_place_close(f, &building);
    reader_place_close(f, &all);
    return f->h.failed ? -1 : 0;
}

static void get_columns(struct result_file *f, const struct reader_place *p,
                        const struct column_table *t, void *base, size_t n) {
    for (int c = 0; c < t->n_column && !f->h.failed; c++) {
        const hid_t group = reader_place_holder(f, p, t->column[c].name);
        h5_get_column(&f->h, f->report->arena, group, t, c, base, n);
    }
}

static struct report_link *get_links(struct result_file *f, const struct link_group *g,
                                     int *n_link) {
    struct arena *a = f->report->arena;
    const struct reader_place root = reader_place_root(f),
                              links = reader_place_open(f, &root, g->name);
    const size_t n = h5_get_length(&f->h, links.own, g->scale, LIST_LIMIT);
    struct report_link *link = h5_alloc(&f->h, a, n, sizeof *link);
    get_columns(f, &links, &layout_link, link, n);
    for (size_t i = 0; i < n; i++) {
        link[i].left_below = link[i].left_floor;
        link[i].right_below = link[i].right_floor;
        link[i].left_level = link[i].right_level = NAN;
    }
    const char *level = layout_level.column[0].name;
    if (n > 0 && h5_has(&f->h, reader_place_holder(f, &links, level), level)) {
        get_columns(f, &links, &layout_level, link, n);
    }
    for (size_t i = 0; i < n && !f->h.failed; i++) {
        if (link[i].left_floor > FLOORS_MAX || link[i].right_floor > FLOORS_MAX) {
            h5_fail(&f->h, "a link of /%s is at floor %d; there are at most %d", g->name,
                    link[i].left_floor > FLOORS_MAX ? link[i].left_floor : link[i].right_floor,
                    FLOORS_MAX);
        }
    }
    for (int i = 0; i < 2; i++) {
        const unsigned bit = 1U << (FLOOR_FIELD_COUNT + i);
        f->report->fields |= h5_has(&f->h, links.own, g->field[i]) ? bit : 0;
    }
    const struct reader_place envelope = reader_place_open(f, &links, "envelope");
    get_columns(f, &envelope, g->peaks, link, n);
    reader_place_close(f, &envelope);
    reader_place_close(f, &links);
    *n_link = (int)n;
    return link;
}

static void get_impacts(struct result_file *f) {
    struct report *r = f->report;
    hid_t group = h5_get_group(&f->h, f->root, "impacts");
    const size_t n = h5_get_length(&f->h, group, "impact", LIST_LIMIT);
    r->impact = h5_alloc(&f->h, r->arena, n, sizeof *r->impact);
    for (int c = 0; c < layout_impact.n_column && !f->h.failed; c++) {
        h5_get_column(&f->h, r->arena, group, &layout_impact, c, r->impact, n);
    }
    r->n_impact = (long)n;
    for (size_t i = 0; i < n && !f->h.failed; i++) {
        if (r->impact[i].contact < 0 || r->impact[i].contact >= r->n_contact) {
            h5_fail(&f->h, "impact %zu is of contact %d; there are %d", i + 1,
                    r->impact[i].contact + 1, r->n_contact);
        }
    }
    h5_close(&f->h, group);
}

static void get_energy(struct result_file *f) {
    hid_t group = h5_get_group(&f->h, f->root, "energy");
    f->report->initial_energy = h5_get_double(&f->h, group, "initial");
    f->report->residual_peak = h5_get_double(&f->h, group, "residual_peak");
    for (int i = 0; i < ENERGY_COUNT && !f->h.failed; i++) {
        hid_t history = h5_has(&f->h, group, energy_names[i])
                            ? H5Dopen2(group, energy_names[i], H5P_DEFAULT)
                            : -1;
        if (history < 0) {
            h5_fail(&f->h, "dataset '%s' is missing", energy_names[i]);
        }
        f->report->energy[i] = h5_get_double(&f->h, history, "final");
        h5_close(&f->h, history);
    }
    h5_close(&f->h, group);
}

// The number after the last # of the path of a run in a study, and that of the study in *file; 0
// where the path is that of a file.
static long split(struct result_file *f, const char **file) {
    const char *mark = strrchr(f->path, '#');
    char *end;
    *file = f->path;
    if (!mark || access(f->path, F_OK) == 0) {
        return 0;
    }
    const long run = strtol(mark + 1, &end, 10);
    if (mark[1] < '0' || mark[1] > '9' || *end != '\0' || run < 1) {
        return 0;
    }
    *file = arena_text(f->report->arena, f->path, (size_t)(mark - f->path));
    return run;
}

// The group of a run in a study.
static int open_run(struct result_file *f, const char *file, long run, struct error *e) {
    char name[32];
    snprintf(name, sizeof name, "runs/%06ld", run);
    if (!h5_has(&f->h, f->h.file, "runs")) {
        return error_set(e, STATUS_INPUT,
                         "%s has no histories of single runs; 'output -histories' in the deck of a "
                         "study writes them",
                         file);
    }
    if (!h5_has(&f->h, f->h.file, name)) {
        return error_set(e, STATUS_INPUT, "%s has no histories of run %ld", file, run);
    }
    f->root = h5_get_group(&f->h, f->h.file, name);
    f->report->run = run;
    reader_place_find(f, run);
    return f->h.failed ? damaged(&f->h, f->path, e) : STATUS_OK;
}

static int open_file(struct result_file *f, struct error *e) {
    const char *file;
    const long run = split(f, &file);
    if (!file) {
        return error_no_memory(e);
    }
    int status = h5_check_file(file, e);
    if (status != STATUS_OK) {
        return status;
    }
    if (!h5_start(&f->h)) {
        return damaged(&f->h, f->path, e);
    }
    if (H5Fis_hdf5(file) <= 0) {
        h5_fail(&f->h, "not an HDF5 file");
        return h5_lacks_memory(&f->h) ? error_no_memory(e)
                                      : error_set(e, STATUS_INPUT, "%s is %s", file, f->h.cause);
    }
    h5_open(&f->h, file, SIEVE_BYTES);
    if (f->h.failed) {
        return h5_lacks_memory(&f->h)
                   ? error_no_memory(e)
                   : error_set(e, STATUS_INPUT, "cannot read %s: %s", file, f->h.cause);
    }
    f->root = f->h.file;
    return run > 0 ? open_run(f, file, run, e) : STATUS_OK;
}

static int read_file(struct result_file *f, struct error *e) {
    int status = open_file(f, e);
    if (status == STATUS_OK) {
        status = check_format(f, e);
    }
    if (status != STATUS_OK) {
        return status;
    }
    get_attributes(f);
    reader_buildings(&f->h, f->root, f->report, visit_building, f);
    f->report->contact = get_links(f, &layout_contacts, &f->report->n_contact);
    if (h5_has(&f->h, f->root, layout_links.name)) {
        f->report->link = get_links(f, &layout_links, &f->report->n_link);
    }
    get_impacts(f);
    get_energy(f);
    return f->h.failed ? damaged(&f->h, f->path, e) : STATUS_OK;
}

int result_open(const char *path, struct result_file **out, struct error *e) {
    struct arena *a = arena_create();
    struct result_file *f = calloc(1, sizeof *f);
    struct report *r = a ? arena_alloc(a, 1, sizeof *r) : NULL;
    if (!f || !r) {
        free(f);
        arena_free(a);
        return error_no_memory(e);
    }
    r->arena = a;
    f->report = r;
    f->h.file = f->root = -1;
    f->path = arena_text(a, path, strlen(path));
    r->file = f->path;
    int status = f->path ? read_file(f, e) : error_no_memory(e);
    if (status != STATUS_OK) {
        result_close(f);
        return status;
    }
    *out = f;
    return STATUS_OK;
}

void result_close(struct result_file *f) {
    if (!f) {
        return;
    }
    h5_close_types(&f->h);
    if (f->root >= 0 && f->root != f->h.file) {
        h5_close(&f->h, f->root);
    }
    h5_close_file(&f->h);
    report_free(f->report);
    free(f);
}

const struct report *result_report(const struct result_file *f) {
    return f->report;
}
