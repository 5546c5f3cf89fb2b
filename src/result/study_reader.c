// SPDX-License-Identifier: GPL-3.0-or-later
// Opens a study file: its sweeps, and the table of what its runs gave.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "result/reader.h"
#include "result/seal.h"
#include "result/study_along.h"
#include "result/study_reader.h"

// What a file may claim before it is taken for damaged.
enum { ITEMS_LIMIT = 1 << 20, VALUES_LIMIT = 1 << 26, GROUP_MAX = 4096 };
// Boxes are read in the order of the file, and merging opens many files with many datasets each.
enum { SIEVE_BYTES = 1024 };

// Where the items of a group belong.
struct spot {
    struct study_file *file;
    const char *parent, *owner, *leaf;
    const char *scale;
};

static bool grow(struct study_file *f) {
    if (f->view.table.n_item < f->capacity) {
        return true;
    }
    const int capacity = f->capacity ? 2 * f->capacity : 64;
    struct study_item *item = realloc(f->item, (size_t)capacity * sizeof *item);
    f->item = item ? item : f->item;
    hid_t *dataset = realloc(f->dataset, (size_t)capacity * sizeof *dataset);
    f->dataset = dataset ? dataset : f->dataset;
    if (!item || !dataset || capacity > ITEMS_LIMIT) {
        h5_no_memory(&f->h);
        return false;
    }
    f->capacity = capacity;
    return true;
}

// Numbers that are no scale: what runs gave. Scales, and texts and whole numbers of links, are not.
static bool is_result(hid_t dataset) {
    return h5_is_number(dataset) && !h5_is_scale(dataset);
}

static void check_stored(struct study_file *f, hid_t dataset, const char *name) {
    if (dataset >= 0 && !h5_is_stored(dataset)) {
        h5_fail(&f->h, "dataset '%s' is not all there, or has chunks of more than 64 MiB", name);
    }
}

// The values of a run in a dataset over all sweeps; 0: of links that the study does not have, or
// it is damaged.
static size_t values_of_run(struct study_file *f, hid_t dataset, const char *name) {
    hsize_t dim[H5S_MAX_RANK];
    hid_t space = H5Dget_space(dataset);
    const int n = H5Sget_simple_extent_dims(space, dim, NULL);
    H5Sclose(space);
    bool good = n == f->n_dim || n == f->n_dim + 1;
    for (int i = 0; good && i < f->n_dim; i++) {
        good = dim[i] == (hsize_t)f->dim[i]->n;
    }
    const hsize_t width = good && n > f->n_dim ? dim[n - 1] : 1;
    if (!good) {
        h5_fail(&f->h, "dataset '%s' does not have the dimensions of the study", name);
    } else if (width > VALUES_LIMIT) {
        h5_fail(&f->h, "a run has more than %d values of '%s'", VALUES_LIMIT, name);
    } else {
        check_stored(f, dataset, name);
    }
    return f->h.failed ? 0 : (size_t)width;
}

static herr_t visit(hid_t group, const char *name, const H5L_info_t *info, void *context) {
    (void)info;
    const struct spot *p = context;
    struct study_file *f = p->file;
    if (!grow(f)) {
        return -1;
    }
    const bool swept = study_along_has(f->dim, f->n_dim, name);
    hid_t dataset = swept ? -1 : h5_open_object(&f->h, group, name);
    const bool result = H5Iget_type(dataset) == H5I_DATASET && is_result(dataset);
    const size_t n = result ? values_of_run(f, dataset, name) : 0;
    if (n == 0) {
        h5_close(&f->h, dataset);
        return f->h.failed ? -1 : 0;
    }
    struct study_table *t = &f->view.table;
    f->dataset[t->n_item] = dataset;
    f->item[t->n_item++] = (struct study_item){
        .parent = p->parent,
        .owner = p->owner,
        .leaf = p->leaf,
        .name = h5_copy(&f->h, f->view.arena, name),
        .long_name = h5_get_text(&f->h, f->view.arena, dataset, "long_name"),
        .units = h5_get_line(&f->h, f->view.arena, dataset, "units"),
        .scale = p->scale,
        .first = t->n_value,
        .n = n,
    };
    t->n_value += n;
    h5_take(&f->h, n, sizeof(double));
    return f->h.failed ? -1 : 0;
}

static void get_group(const struct spot *p) {
    char path[GROUP_MAX];
    struct study_file *f = p->file;
    snprintf(path, sizeof path, "/%s%s%s%s%s", p->parent, p->owner ? "/" : "",
             p->owner ? p->owner : "", p->leaf ? "/" : "", p->leaf ? p->leaf : "");
    hid_t group = h5_open_object(&f->h, f->h.file, path);
    if (group >= 0) {
        h5_failed(&f->h, H5Literate(group, H5_INDEX_NAME, H5_ITER_NATIVE, NULL, visit, (void *)p));
    }
    h5_close(&f->h, group);
}

static void get_both(struct spot p) {
    get_group(&p);
    p.leaf = "envelope";
    get_group(&p);
}

static herr_t visit_building(hid_t group, const char *name, const H5L_info_t *info, void *context) {
    (void)info, (void)group;
    struct study_file *f = context;
    const struct spot p = {.file = f,
                           .parent = "buildings",
                           .owner = h5_copy(&f->h, f->view.arena, name),
                           .scale = "floor"};
    if (!f->h.failed) {
        get_both(p);
    }
    return f->h.failed ? -1 : 0;
}

struct report_link *study_reader_links(struct study_file *f, struct arena *a,
                                       const struct link_group *g, int *n_link) {
    hid_t group = h5_get_group(&f->h, f->h.file, g->name);
    const size_t n = h5_get_length(&f->h, group, g->scale, ITEMS_LIMIT);
    struct report_link *link = h5_alloc(&f->h, a, n, sizeof *link);
    for (int c = 0; c < layout_link.n_column && !f->h.failed; c++) {
        if (study_tree_is_fixed(&layout_link.column[c])) {
            h5_get_column(&f->h, a, group, &layout_link, c, link, n);
        }
    }
    for (size_t i = 0; link && i < n; i++) {
        link[i].left_below = link[i].left_floor;
        link[i].right_below = link[i].right_floor;
    }
    const bool levels = h5_has(&f->h, group, layout_level.column[0].name);
    for (int c = 0; c < layout_level.n_column && levels && !f->h.failed; c++) {
        if (study_tree_is_fixed(&layout_level.column[c])) {
            h5_get_column(&f->h, a, group, &layout_level, c, link, n);
        }
    }
    h5_close(&f->h, group);
    *n_link = (int)n;
    return link;
}

static const struct report_link *get_links(struct study_file *f, const struct link_group *g,
                                           int *n) {
    const struct report_link *link = study_reader_links(f, f->view.arena, g, n);
    get_both((struct spot){.file = f, .parent = g->name, .scale = g->scale});
    return link;
}

struct sweep *study_reader_sweep(struct study_file *f, hid_t group, hid_t scale, const char *name) {
    struct study_view *v = &f->view;
    struct sweep *s = h5_alloc(&f->h, v->arena, 1, sizeof *s);
    if (!s) {
        return NULL;
    }
    s->name = h5_copy(&f->h, v->arena, name);
    s->n = (int)h5_get_length(&f->h, group, s->name, STUDY_RUNS_MAX);
    s->units = "";
    if (h5_is_number(scale)) {
        s->number = h5_get_doubles(&f->h, v->arena, group, s->name, (size_t)s->n);
        study_along_get(&f->h, v->arena, group, scale, s);
        s->units = h5_get_line(&f->h, v->arena, scale, "units");
    } else {
        s->label = (const char *const *)h5_get_texts(&f->h, v->arena, group, s->name, (size_t)s->n);
        s->text = s->label;
    }
    return f->h.failed ? NULL : s;
}

// The scale of dimension `i` of /status.
static void get_dimension(struct study_file *f, hid_t scale, int i) {
    char name[256] = "";
    if (f->h.failed || h5_failed(&f->h, H5Iget_name(scale, name, sizeof name))) {
        return;
    }
    const char *slash = strrchr(name, '/');
    hid_t group = h5_get_group(&f->h, f->h.file, "sweep");
    f->dim[i] = study_reader_sweep(f, group, scale, slash ? slash + 1 : name);
    h5_close(&f->h, group);
    if (f->dim[i]) {
        f->n_dim++;
        f->view.n_run *= f->dim[i]->n;
        if (f->view.n_run > STUDY_RUNS_MAX) {
            h5_fail(&f->h, "it has more than %d runs", STUDY_RUNS_MAX);
        }
    }
}

static void get_sweeps(struct study_file *f) {
    f->status = h5_open_object(&f->h, f->h.file, "status");
    f->message = h5_open_object(&f->h, f->h.file, "message");
    check_stored(f, f->status, "status");
    check_stored(f, f->message, "message");
    hid_t space = f->h.failed ? -1 : H5Dget_space(f->status);
    const int n = space >= 0 ? H5Sget_simple_extent_ndims(space) : 0;
    if (space >= 0) {
        H5Sclose(space);
    }
    if (!f->h.failed && (n < 1 || n > STUDY_SWEEPS_MAX)) {
        h5_fail(&f->h, "it has %d sweeps; 1 to %d are allowed", n, STUDY_SWEEPS_MAX);
    }
    f->view.n_run = 1;
    for (int i = 0; i < n && !f->h.failed; i++) {
        hid_t scale = h5_get_scale(&f->h, f->status, n, i);
        get_dimension(f, scale, i);
        h5_close(&f->h, scale);
    }
    if (h5_has(&f->h, f->h.file, "part")) {
        study_part_get(f);
        return;
    }
    struct study_view *v = &f->view;
    memcpy(v->sweep, f->dim, sizeof v->sweep);
    v->n_sweep = f->n_dim;
    v->n_study = v->n_run;
}

int study_view_hit(const struct study_view *v, const struct study_item *item, size_t i,
                   const double *value) {
    const struct study_table *t = &v->table;
    if (!item->owner || !item->leaf || strcmp(item->name, peak_names[PEAK_ACCELERATION]) != 0) {
        return -1;
    }
    int hit = 0;
    for (int k = 0; k < t->n_item && hit == 0; k++) {
        const struct study_item *force = &t->item[k];
        const bool of_contacts = strcmp(force->parent, layout_contacts.name) == 0 && force->leaf &&
                                 strcmp(force->name, "force") == 0;
        for (size_t c = 0; of_contacts && c < force->n && c < (size_t)v->n_contact; c++) {
            hit |= value[force->first + c] > 0.0 &&
                   report_link_joins(&v->contact[c], item->owner, (int)i + 1);
        }
    }
    return hit;
}

long study_view_run(const struct study_view *v, long i) {
    return v->part.run ? (long)v->part.run[i] - 1 : i;
}

int study_view_choice(const struct study_view *v, long run, int i) {
    for (int k = v->n_sweep - 1; k > i; k--) {
        run /= v->sweep[k]->n;
    }
    return (int)(run % v->sweep[i]->n);
}

static void get_all(struct study_file *f) {
    struct study_view *v = &f->view;
    v->title = h5_get_text(&f->h, v->arena, f->h.file, "title");
    v->version = h5_get_text(&f->h, v->arena, f->h.file, "version");
    h5_get_units(&f->h, v->arena, &v->units);
    v->n_kept = h5_get_long(&f->h, f->h.file, "runs_kept");
    v->n_thread = (int)h5_get_long(&f->h, f->h.file, "threads");
    v->seconds = h5_get_double(&f->h, f->h.file, "wall_seconds");
    if (!f->h.failed && H5Aexists(f->h.file, "parts") > 0) {
        v->n_part = (int)h5_get_long(&f->h, f->h.file, "parts");
    }
    v->has_histories = h5_has(&f->h, f->h.file, "runs");
    study_origin_get(f);
    get_sweeps(f);
    hid_t buildings = h5_get_group(&f->h, f->h.file, "buildings");
    if (!f->h.failed) {
        h5_failed(&f->h,
                  H5Literate(buildings, H5_INDEX_NAME, H5_ITER_INC, NULL, visit_building, f));
    }
    h5_close(&f->h, buildings);
    v->contact = get_links(f, &layout_contacts, &v->n_contact);
    if (h5_has(&f->h, f->h.file, layout_links.name)) {
        v->link = get_links(f, &layout_links, &v->n_link);
    }
    get_group(&(struct spot){.file = f, .parent = "energy"});
    get_group(&(struct spot){.file = f, .parent = "totals"});
    v->table.item = f->item;
}

int study_reader_fail(const struct study_file *f, struct error *e) {
    const int status = h5_lacks_memory(&f->h) ? STATUS_SYSTEM : STATUS_INPUT;
    return error_set(e, status, "cannot read %s: %s", f->view.path, f->h.cause);
}

// Reads all of an open file.
static int read_file(struct study_file *f, struct error *e) {
    struct study_view *v = &f->view;
    if (f->h.failed) {
        return study_reader_fail(f, e);
    }
    const int status = reader_check_format(&f->h, f->h.file, v->arena, v->path, e);
    if (status != STATUS_OK) {
        return status;
    }
    if (!h5_has(&f->h, f->h.file, "sweep")) {
        return error_set(e, STATUS_INPUT, "%s is one analysis, not a study", v->path);
    }
    get_all(f);
    return f->h.failed ? study_reader_fail(f, e) : STATUS_OK;
}

int study_file_verify(struct study_file *f, struct error *e) {
    struct result_sums sums;
    const int status = seal_check(&f->h, &sums);
    if (status == STATUS_OK && !f->view.origin.study) {
        h5_fail(&f->h, "it does not tell what its runs come from");
    }
    return !f->h.failed ? STATUS_OK
                        : error_set(e, status == STATUS_SYSTEM ? status : STATUS_INPUT, "%s: %s",
                                    f->view.path, f->h.cause);
}

int study_file_open(const char *path, struct study_file **out, struct error *e) {
    int status = h5_check_file(path, e);
    if (status != STATUS_OK) {
        return status;
    }
    struct study_file *f = calloc(1, sizeof *f);
    struct arena *a = f ? arena_create() : NULL;
    if (!a) {
        free(f);
        return error_no_memory(e);
    }
    f->view.arena = a;
    f->status = f->message = -1;
    h5_open(&f->h, path, SIEVE_BYTES);
    f->view.path = path;
    const char *copy = f->h.failed ? NULL : h5_copy(&f->h, a, path);
    f->view.path = copy ? copy : path;
    status = read_file(f, e);
    if (status != STATUS_OK) {
        study_file_close(f);
        return status;
    }
    *out = f;
    return STATUS_OK;
}

void study_file_close(struct study_file *f) {
    if (!f) {
        return;
    }
    for (int i = 0; i < f->view.table.n_item; i++) {
        h5_close(&f->h, f->dataset[i]);
    }
    h5_close(&f->h, f->status);
    h5_close(&f->h, f->message);
    h5_close_types(&f->h);
    h5_close_file(&f->h);
    arena_free(f->view.arena);
    free(f->item);
    free(f->dataset);
    free(f);
}

const struct study_view *study_file_view(const struct study_file *f) {
    return &f->view;
}
