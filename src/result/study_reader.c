// SPDX-License-Identifier: GPL-3.0-or-later
// Opens a study file: its sweeps, and the table of what its runs gave.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "result/seal.h"
#include "result/study_reader.h"
#include "result/study_sweep.h"

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
        h5_no_memory(&f->file.h);
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
        h5_fail(&f->file.h, "dataset '%s' is not all there, or has chunks of more than 64 MiB",
                name);
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
        h5_fail(&f->file.h, "dataset '%s' does not have the dimensions of the study", name);
    } else if (width > VALUES_LIMIT) {
        h5_fail(&f->file.h, "a run has more than %d values of '%s'", VALUES_LIMIT, name);
    } else {
        check_stored(f, dataset, name);
    }
    return f->file.h.failed ? 0 : (size_t)width;
}

static herr_t visit(hid_t group, const char *name, const H5L_info_t *info, void *context) {
    (void)info;
    const struct spot *p = context;
    struct study_file *f = p->file;
    if (!grow(f)) {
        return -1;
    }
    const bool swept = study_sweep_has(f->dim, f->n_dim, name);
    hid_t dataset = swept ? -1 : h5_open_object(&f->file.h, group, name);
    const bool result = H5Iget_type(dataset) == H5I_DATASET && is_result(dataset);
    const size_t n = result ? values_of_run(f, dataset, name) : 0;
    if (n == 0) {
        h5_close(&f->file.h, dataset);
        return f->file.h.failed ? -1 : 0;
    }
    struct study_table *t = &f->view.table;
    f->dataset[t->n_item] = dataset;
    f->item[t->n_item++] = (struct study_item){
        .parent = p->parent,
        .owner = p->owner,
        .leaf = p->leaf,
        .name = h5_copy(&f->file.h, f->view.arena, name),
        .long_name = h5_get_text(&f->file.h, f->view.arena, dataset, "long_name"),
        .units = h5_get_line(&f->file.h, f->view.arena, dataset, "units"),
        .scale = p->scale,
        .first = t->n_value,
        .n = n,
    };
    t->n_value += n;
    h5_take(&f->file.h, n, sizeof(double));
    return f->file.h.failed ? -1 : 0;
}

static void get_group(const struct spot *p) {
    char path[GROUP_MAX];
    struct study_file *f = p->file;
    snprintf(path, sizeof path, "/%s%s%s%s%s", p->parent, p->owner ? "/" : "",
             p->owner ? p->owner : "", p->leaf ? "/" : "", p->leaf ? p->leaf : "");
    hid_t group = h5_open_object(&f->file.h, f->file.h.file, path);
    if (group >= 0) {
        h5_failed(&f->file.h,
                  H5Literate(group, H5_INDEX_NAME, H5_ITER_NATIVE, NULL, visit, (void *)p));
    }
    h5_close(&f->file.h, group);
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
                           .owner = h5_copy(&f->file.h, f->view.arena, name),
                           .scale = "floor"};
    if (!f->file.h.failed) {
        get_both(p);
    }
    return f->file.h.failed ? -1 : 0;
}

// The scale of dimension `i` of /status.
static void get_dimension(struct study_file *f, hid_t scale, int i) {
    char name[256] = "";
    if (f->file.h.failed || h5_failed(&f->file.h, H5Iget_name(scale, name, sizeof name))) {
        return;
    }
    const char *slash = strrchr(name, '/');
    hid_t group = h5_get_group(&f->file.h, f->file.h.file, "sweep");
    f->dim[i] = study_sweep_get(&f->file.h, f->view.arena, group, scale, slash ? slash + 1 : name);
    h5_close(&f->file.h, group);
    if (f->dim[i]) {
        f->n_dim++;
        f->view.n_run *= f->dim[i]->n;
        if (f->view.n_run > STUDY_RUNS_MAX) {
            h5_fail(&f->file.h, "it has more than %d runs", STUDY_RUNS_MAX);
        }
    }
}

static void get_sweeps(struct study_file *f) {
    f->status = h5_open_object(&f->file.h, f->file.h.file, "status");
    f->message = h5_open_object(&f->file.h, f->file.h.file, "message");
    check_stored(f, f->status, "status");
    check_stored(f, f->message, "message");
    hid_t space = f->file.h.failed ? -1 : H5Dget_space(f->status);
    const int n = space >= 0 ? H5Sget_simple_extent_ndims(space) : 0;
    if (space >= 0) {
        H5Sclose(space);
    }
    if (!f->file.h.failed && (n < 1 || n > STUDY_SWEEPS_MAX)) {
        h5_fail(&f->file.h, "it has %d sweeps; 1 to %d are allowed", n, STUDY_SWEEPS_MAX);
    }
    f->view.n_run = 1;
    for (int i = 0; i < n && !f->file.h.failed; i++) {
        hid_t scale = h5_get_scale(&f->file.h, f->status, n, i);
        get_dimension(f, scale, i);
        h5_close(&f->file.h, scale);
    }
    if (h5_has(&f->file.h, f->file.h.file, "part")) {
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
    struct h5 *h = &f->file.h;
    struct study_view *v = &f->view;
    reader_get(&f->file);
    const struct report *r = f->file.report;
    v->title = r->title;
    v->version = r->version;
    v->units = r->units;
    v->n_contact = r->n_contact;
    v->contact = r->contact;
    v->n_link = r->n_link;
    v->link = r->link;
    v->n_kept = h5_get_long(h, h->file, "runs_kept");
    v->n_thread = (int)h5_get_long(h, h->file, "threads");
    v->seconds = h5_get_double(h, h->file, "wall_seconds");
    if (!h->failed && H5Aexists(h->file, "parts") > 0) {
        v->n_part = (int)h5_get_long(h, h->file, "parts");
    }
    v->has_histories = h5_has(h, h->file, "runs");
    study_origin_get(f);
    get_sweeps(f);
    hid_t buildings = h5_get_group(h, h->file, "buildings");
    if (!h->failed) {
        h5_failed(h, H5Literate(buildings, H5_INDEX_NAME, H5_ITER_INC, NULL, visit_building, f));
    }
    h5_close(h, buildings);
    get_both((struct spot){.file = f, .parent = "contacts", .scale = "contact"});
    if (v->link) {
        get_both((struct spot){.file = f, .parent = "links", .scale = "link"});
    }
    get_group(&(struct spot){.file = f, .parent = "energy"});
    get_group(&(struct spot){.file = f, .parent = "totals"});
    v->table.item = f->item;
}

int study_file_verify(struct study_file *f, struct error *e) {
    struct result_sums sums;
    const int status = seal_check(&f->file.h, &sums);
    if (status == STATUS_OK && !f->view.origin.study) {
        h5_fail(&f->file.h, "it does not tell what its runs come from");
    }
    return !f->file.h.failed ? STATUS_OK
                             : error_set(e, status == STATUS_SYSTEM ? status : STATUS_INPUT,
                                         "%s: %s", f->view.path, f->file.h.cause);
}

// Reads all of a file.
static int read_file(struct study_file *f, const char *path, struct error *e) {
    int status = reader_init(&f->file, path, READ_SHAPE, e);
    status = status == STATUS_OK ? reader_open(&f->file, path, SIEVE_BYTES, e) : status;
    if (status != STATUS_OK) {
        return status;
    }
    f->view.arena = f->file.report->arena;
    f->view.path = f->file.path;
    if (!h5_has(&f->file.h, f->file.root, "sweep")) {
        return error_set(e, STATUS_INPUT, "%s is one analysis, not a study", path);
    }
    get_all(f);
    return f->file.h.failed ? h5_damaged(&f->file.h, path, e) : STATUS_OK;
}

int study_file_open(const char *path, struct study_file **out, struct error *e) {
    struct study_file *f = calloc(1, sizeof *f);
    if (!f) {
        return error_no_memory(e);
    }
    f->status = f->message = -1;
    const int status = read_file(f, path, e);
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
        h5_close(&f->file.h, f->dataset[i]);
    }
    h5_close(&f->file.h, f->status);
    h5_close(&f->file.h, f->message);
    reader_close(&f->file);
    free(f->item);
    free(f->dataset);
    free(f);
}

// The file stays as it is: the report is read once more, as it has another owner.
int study_file_report(struct study_file *f, struct report **out, struct error *e) {
    struct result_file copy;
    int status = reader_init(&copy, f->view.path, READ_SHAPE, e);
    if (status == STATUS_OK) {
        copy.h = f->file.h;
        copy.root = f->file.root;
        reader_get(&copy);
        status = copy.h.failed ? h5_damaged(&copy.h, copy.path, e) : STATUS_OK;
        f->file.h = copy.h;
    }
    if (status != STATUS_OK) {
        report_free(copy.report);
        return status;
    }
    *out = copy.report;
    return STATUS_OK;
}

const struct study_view *study_file_view(const struct study_file *f) {
    return &f->view;
}
