// SPDX-License-Identifier: GPL-3.0-or-later
// Opens a study file: its sweeps, the table of what its runs gave, and the values.
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "result/seal.h"
#include "result/study_reader.h"
#include "result/study_sweep.h"

// Boxes are read in the order of the file, and merging opens many files with many datasets each.
enum { SIEVE_BYTES = 1024 };

static void check_stored(struct study_file *f, hid_t dataset, const char *name) {
    if (dataset >= 0 && !h5_is_stored(dataset)) {
        h5_fail(&f->file.h, "dataset '%s' is not all there, or has chunks of more than 64 MiB",
                name);
    }
}

// Checks that a run has the values of an item in a dataset over all sweeps.
static void check_item(struct study_file *f, hid_t dataset, const struct study_item *item) {
    struct h5 *h = &f->file.h;
    hsize_t dim[H5S_MAX_RANK];
    if (H5Iget_type(dataset) != H5I_DATASET || !h5_is_number(dataset) || h5_is_scale(dataset)) {
        h5_fail(h, "dataset '%s' is not of the kind expected", item->name);
        return;
    }
    hid_t space = H5Dget_space(dataset);
    const int n = H5Sget_simple_extent_dims(space, dim, NULL);
    H5Sclose(space);
    bool good = n == f->n_dim + (item->scale != NULL) && (!item->scale || dim[n - 1] == item->n);
    for (int i = 0; good && i < f->n_dim; i++) {
        good = dim[i] == (hsize_t)f->dim[i]->n;
    }
    if (!good) {
        h5_fail(h, "dataset '%s' does not have the dimensions of the study", item->name);
    }
    check_stored(f, dataset, item->name);
}

// Opens the dataset of an item, unless there is none, or a sweep in its place.
static void get_item(struct study_file *f, const struct study_item *item) {
    struct h5 *h = &f->file.h;
    struct study_table *t = &f->view.table;
    const char *path = arena_format(f->view.arena, "/%s%s%s%s%s", item->parent,
                                    item->owner ? "/" : "", item->owner ? item->owner : "",
                                    item->leaf ? "/" : "", item->leaf ? item->leaf : "");
    if (!path) {
        h5_no_memory(h);
        return;
    }
    hid_t group = h5_open_object(h, h->file, path);
    const bool is_there = item->n > 0 && !study_sweep_has(f->dim, f->n_dim, item->name) &&
                          h5_has(h, group, item->name);
    hid_t dataset = is_there ? h5_open_object(h, group, item->name) : -1;
    h5_close(h, group);
    if (dataset < 0) {
        return;
    }
    check_item(f, dataset, item);
    f->dataset[t->n_item] = dataset;
    f->item[t->n_item] = *item;
    f->item[t->n_item++].first = t->n_value;
    t->n_value += item->n;
    h5_take(h, item->n, sizeof(double));
}

static int group_rank(const struct study_item *item) {
    static const char *const parents[] = {"buildings", "contacts", "links", "energy"};
    int rank = 0;
    while (rank < 4 && strncmp(item->parent, parents[rank], strlen(parents[rank])) != 0) {
        rank++;
    }
    return rank;
}

// The order of the items: by group and name, what an owner has before what its envelope has.
static int by_name(const void *left, const void *right) {
    const struct study_item *a = left, *b = right;
    const int owner = a->owner && b->owner ? strcmp(a->owner, b->owner) : 0;
    const int rank = group_rank(a) - group_rank(b);
    const int group = rank ? rank : strcmp(a->parent, b->parent);
    const int leaf = (a->leaf != NULL) - (b->leaf != NULL);
    return group ? group : owner ? owner : leaf ? leaf : strcmp(a->name, b->name);
}

// The table of the values, which follows from buildings and links.
static void get_table(struct study_file *f) {
    struct error e;
    if (f->file.h.failed) {
        return;
    }
    struct arena *a = f->view.arena;
    const int status = study_table_create(f->file.report, &f->all, &e);
    const size_t n = status == STATUS_OK ? (size_t)f->all->n_item : 0;
    struct study_item *item = h5_alloc(&f->file.h, a, n, sizeof *item);
    f->item = h5_alloc(&f->file.h, a, n, sizeof *f->item);
    f->dataset = h5_alloc(&f->file.h, a, n, sizeof *f->dataset);
    if (status != STATUS_OK) {
        h5_no_memory(&f->file.h);
        return;
    }
    if (item && f->item && f->dataset) {
        memcpy(item, f->all->item, n * sizeof *item);
        qsort(item, n, sizeof *item, by_name);
    }
    for (size_t i = 0; item && i < n && !f->file.h.failed; i++) {
        get_item(f, &item[i]);
    }
    f->view.table.item = f->item;
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
    h5_drop(space);
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
    v->n_building = r->n_building;
    v->building = r->building;
    v->n_contact = r->n_contact;
    v->contact = r->contact;
    v->n_link = r->n_link;
    v->link = r->link;
    v->n_column = r->n_column;
    v->column = r->column;
    v->n_kept = h5_get_long(h, h->file, "runs_kept");
    v->n_thread = (int)h5_get_long(h, h->file, "threads");
    v->seconds = h5_get_double(h, h->file, "wall_seconds");
    if (!h->failed && H5Aexists(h->file, "parts") > 0) {
        v->n_part = (int)h5_get_long(h, h->file, "parts");
    }
    v->has_histories = h5_has(h, h->file, "runs");
    study_origin_get(f);
    get_sweeps(f);
    get_table(f);
}

int study_file_verify(struct study_file *f, struct error *e) {
    struct result_sums sums;
    const int status = seal_check(&f->file.h, f->view.path, &sums, e);
    if (status == STATUS_OK && !f->view.origin.study) {
        return error_set(e, STATUS_INPUT, "%s: it does not tell what its runs come from",
                         f->view.path);
    }
    e->status = status == STATUS_FAILED ? STATUS_INPUT : e->status;
    return status == STATUS_FAILED ? STATUS_INPUT : status;
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
    study_table_free(f->all);
    reader_close(&f->file);
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

static void read_outcome(struct study_file *f, struct h5_box box, struct study_outcome *out) {
    int status = 0;
    struct h5_reference message = {.byte = {0}};
    h5_get_box(&f->file.h, f->status, &box, H5T_NATIVE_INT, &status);
    h5_get_box(&f->file.h, f->message, &box, f->file.h.heap.reference, &message);
    if (status < STUDY_DONE || status > STUDY_MISSING) {
        h5_fail(&f->file.h, "a run has the status %d", status);
        status = STUDY_MISSING;
    }
    *out = (struct study_outcome){.status = status};
    size_t n;
    const char *text = h5_heap_get(&f->file.h, &message, 1, &n);
    n = n < sizeof out->message ? n : sizeof out->message - 1;
    memcpy(out->message, text, n);
}

int study_file_read(struct study_file *f, long first, long n, struct study_outcome *outcome,
                    double *value, struct error *e) {
    for (long at = 0; at < n && !f->file.h.failed;) {
        const struct study_view *v = &f->view;
        const struct h5_box box = study_sweep_box(f->dim, f->n_dim, first + at, n - at);
        for (long i = 0; i < (long)box.n; i++) {
            read_outcome(f, study_sweep_box(f->dim, f->n_dim, first + at + i, 1), &outcome[at + i]);
        }
        for (int i = 0; i < v->table.n_item && !f->file.h.failed; i++) {
            const struct study_item *item = &v->table.item[i];
            h5_get_columns(&f->file.h, f->dataset[i], box, f->n_dim, item->n, v->table.n_value,
                           value + (size_t)at * v->table.n_value + item->first);
        }
        at += (long)box.n;
    }
    return f->file.h.failed ? h5_damaged(&f->file.h, f->view.path, e) : STATUS_OK;
}

int study_file_each(struct study_file *f, study_run_function *take, void *context,
                    struct error *e) {
    enum { BLOCK_RUNS = 256, BLOCK_VALUES = 1 << 21 };
    const struct study_view *v = &f->view;
    const size_t n_value = v->table.n_value + 1;
    const long most =
        n_value > BLOCK_VALUES / BLOCK_RUNS ? (long)(BLOCK_VALUES / n_value) + 1 : BLOCK_RUNS;
    struct study_outcome *outcome = malloc((size_t)most * sizeof *outcome);
    double *value = malloc((size_t)most * n_value * sizeof *value);
    int status = STATUS_OK;
    if (!outcome || !value) {
        free(outcome);
        free(value);
        return error_no_memory(e);
    }
    for (long first = 0; first < v->n_run && status == STATUS_OK; first += most) {
        const long left = v->n_run - first, n = left < most ? left : most;
        status = study_file_read(f, first, n, outcome, value, e);
        for (long i = 0; i < n && status == STATUS_OK; i++) {
            const struct study_run run = {study_view_run(v, first + i), &outcome[i],
                                          value + (size_t)i * v->table.n_value};
            status = take(context, &run, e);
        }
    }
    free(outcome);
    free(value);
    return status;
}

int study_file_endings(struct study_file *f, int **out, struct error *e) {
    const size_t n = (size_t)f->view.n_run;
    int *ending = malloc((n + 1) * sizeof *ending);
    double *collapsed = calloc(n + 1, sizeof *collapsed);
    const long at = study_table_collapsed(&f->view.table);
    if (!ending || !collapsed) {
        free(ending);
        free(collapsed);
        return error_no_memory(e);
    }
    h5_get_box(&f->file.h, f->status, NULL, H5T_NATIVE_INT, ending);
    for (int i = 0; i < f->view.table.n_item; i++) {
        if ((long)f->view.table.item[i].first == at) {
            h5_get_box(&f->file.h, f->dataset[i], NULL, H5T_NATIVE_DOUBLE, collapsed);
        }
    }
    for (size_t i = 0; i < n && !f->file.h.failed; i++) {
        ending[i] &= STUDY_STATUS;
        ending[i] |= at >= 0 && collapsed[i] > 0.0 ? STUDY_COLLAPSED : 0;
    }
    free(collapsed);
    if (f->file.h.failed) {
        free(ending);
        return h5_damaged(&f->file.h, f->view.path, e);
    }
    *out = ending;
    return STATUS_OK;
}

const struct study_view *study_file_view(const struct study_file *f) {
    return &f->view;
}
