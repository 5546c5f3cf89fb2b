// SPDX-License-Identifier: GPL-3.0-or-later
// Parts to the file of a study. All parts stay open; each block of the new file is read from those
// that have its runs. What parts have in common is compared before anything is written.
#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/arena.h"
#include "core/checksum.h"
#include "jostle/study_merge.h"
#include "study/number_list.h"
#include "study/origin.h"
#include "study/take.h"

struct merge {
    const struct study_merge_request *request;
    struct take_file *input;  // (n_path)
    struct report *report;
    struct study_table *table;
    struct study_merged *out;
    struct arena *arena;         // owned
    struct study_origin origin;  // of the file; its arrays are from the arena or the inputs
    struct study_key *key;       // (n_run); NULL: a part has none
    double *value;               // (n_value) of a run that is compared
};

static const char *path_of(const struct merge *m, int k) {
    return m->request->path[k];
}

// Part `k` is read from now on; -1: none.
static void tell(const struct merge *m, int k) {
    if (m->request->reading) {
        m->request->reading(m->request->context, k < 0 ? NULL : path_of(m, k));
    }
}

static int open_part(struct merge *m, int k, struct error *e) {
    struct take_file *in = &m->input[k];
    const char *path = path_of(m, k);
    tell(m, k);
    int status = take_open(in, path, e);
    if (status == STATUS_INPUT && access(path, F_OK) == 0 && !study_file_is_study(path)) {
        return error_set(e, STATUS_INPUT, "%s is not the file of a part of a study", path);
    }
    if (status != STATUS_OK) {
        return status;
    }
    if (in->view->part.shard.n == 0) {
        return error_set(e, STATUS_INPUT, "%s is a whole study, not a part of one", path);
    }
    const char *first = m->input[0].view->origin.study, *study = in->view->origin.study;
    if (strcmp(first, study) != 0) {
        int length;
        const char *cause = origin_difference(first, study, &length);
        return error_set(e, STATUS_INPUT, "%s and %s are parts of different studies: %.*s differs",
                         path_of(m, 0), path, length, cause);
    }
    if (in->view->n_study != m->input[0].view->n_study) {
        return error_set(e, STATUS_INPUT, "%s is damaged: it is of a study of %ld runs", path,
                         in->view->n_study);
    }
    return STATUS_OK;
}

// A file that the runs of a part have read.
struct reading {
    const struct study_source *source;
    int input;
};

static int compare(const void *a, const void *b) {
    const struct reading *one = a, *other = b;
    const int order = strcmp(one->source->path, other->source->path);
    return order ? order : one->input - other->input;
}

// All parts have read the same files; the file of the study lists each once.
static int join_sources(struct merge *m, struct error *e) {
    size_t n = 0;
    for (int k = 0; k < m->request->n_path; k++) {
        n += (size_t)m->input[k].view->origin.n_source;
    }
    struct reading *all = calloc(n + 1, sizeof *all);
    struct study_source *source = arena_alloc(m->arena, n, sizeof *source);
    if (!all || !source) {
        free(all);
        return error_no_memory(e);
    }
    n = 0;
    for (int k = 0; k < m->request->n_path; k++) {
        const struct study_origin *o = &m->input[k].view->origin;
        for (int i = 0; i < o->n_source; i++) {
            all[n++] = (struct reading){&o->source[i], k};
        }
    }
    qsort(all, n, sizeof *all, compare);
    int status = STATUS_OK;
    for (size_t i = 0; i < n && status == STATUS_OK; i++) {
        const struct reading *a = &all[i > 0 ? i - 1 : 0], *b = &all[i];
        const bool again = i > 0 && strcmp(a->source->path, b->source->path) == 0;
        if (!again) {
            source[m->origin.n_source++] = *b->source;
        } else if (!checksum_equal(&a->source->sum, &b->source->sum)) {
            status = error_set(e, STATUS_INPUT,
                               "%s and %s are parts of different studies: the file %s differs",
                               path_of(m, a->input), path_of(m, b->input), a->source->path);
        }
    }
    m->origin.source = source;
    free(all);
    return status;
}

static int join_origins(struct merge *m, struct error *e) {
    const struct study_origin *first = &m->input[0].view->origin;
    m->origin = (struct study_origin){.numerics = first->numerics,
                                      .study = first->study,
                                      .define = first->define,
                                      .programs = ""};
    for (int k = 0; k < m->request->n_path; k++) {
        m->origin.programs =
            origin_join_lines(m->arena, m->origin.programs, m->input[k].view->origin.programs);
        if (!m->origin.programs) {
            return error_no_memory(e);
        }
    }
    return join_sources(m, e);
}

// The keys of all runs; if a part has none, the file has none.
static int join_keys(struct merge *m, struct error *e) {
    m->key = calloc((size_t)m->out->n_run + 1, sizeof *m->key);
    int status = m->key ? STATUS_OK : error_no_memory(e);
    for (int k = 0; k < m->request->n_path && m->key && status == STATUS_OK; k++) {
        const struct study_view *v = m->input[k].view;
        struct study_key *part = NULL;
        status = study_file_keys(m->input[k].file, &part, e);
        if (status == STATUS_OK && !part) {
            free(m->key);
            m->key = NULL;
        }
        for (long i = 0; m->key && status == STATUS_OK && i < v->n_run; i++) {
            m->key[study_view_run(v, i)] = part[i];
        }
        free(part);
    }
    m->origin.key = m->key;
    return status;
}

// Says which runs are missing: by their parts if all parts are of one division.
static void name_missing(const struct merge *m, const unsigned char *there) {
    struct study_merged *o = m->out;
    long n = m->input[0].view->part.shard.n;
    for (int k = 1; k < m->request->n_path; k++) {
        n = m->input[k].view->part.shard.n == n ? n : 0;
    }
    char text[192] = "";
    struct number_list list = {.text = text, .size = sizeof text};
    for (long part = 1; part <= n; part++) {
        const struct study_shard shard = {part, n};
        if (study_shard_size(&shard, o->n_run) > 0 && !there[study_shard_run(&shard, 0)]) {
            number_list_add(&list, part);
        }
    }
    for (long i = 0; n == 0 && i < o->n_run; i++) {
        if (!there[i]) {
            number_list_add(&list, i + 1);
        }
    }
    number_list_end(&list);
    snprintf(o->missing, sizeof o->missing, "%s%s %s of %ld", n > 0 ? "part" : "run",
             list.n == 1 ? "" : "s", text, n > 0 ? n : o->n_run);
}

static int check_missing(struct merge *m, struct error *e) {
    struct study_merged *o = m->out;
    unsigned char *there = calloc((size_t)o->n_run + 1, 1);
    if (!there) {
        return error_no_memory(e);
    }
    o->n_missing = o->n_run;
    for (int k = 0; k < m->request->n_path; k++) {
        const struct study_view *v = m->input[k].view;
        for (long i = 0; i < v->n_run; i++) {
            unsigned char *run = &there[study_view_run(v, i)];
            o->n_missing -= !*run;
            *run = 1;
        }
    }
    if (o->n_missing > 0) {
        name_missing(m, there);
    }
    free(there);
    return o->n_missing > 0 && m->request->gaps == STUDY_WHOLE
               ? error_set(e, STATUS_FAILED,
                           "%ld of %ld runs are missing: %s; --partial writes the others",
                           o->n_missing, o->n_run, o->missing)
               : STATUS_OK;
}

// The first run of the file that is `run` of the study or a later one.
static long find_row(const struct study_view *v, long run) {
    long low = 0, high = v->n_run;
    while (low < high) {
        const long middle = low + (high - low) / 2;
        if (study_view_run(v, middle) < run) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

// Where the runs [first, first + n) of the new file go.
struct target {
    long first, n;
    struct study_outcome *outcome;  // (n)
    double *value;                  // (n, n_value)
};

// Brings a row of part `k` to its place; a run that is there already must be the same.
static int place(const struct merge *m, int k, long row, const struct target *to, struct error *e) {
    const size_t n_value = m->table->n_value;
    const long run = study_view_run(m->input[k].view, row);
    struct study_outcome *outcome = &to->outcome[run - to->first], new;
    double *value = to->value + (size_t)(run - to->first) * n_value;
    const bool known = outcome->status != STUDY_MISSING;
    const int status =
        take_row(&m->input[k], row, known ? &new : outcome, known ? m->value : value, e);
    if (status != STATUS_OK || !known) {
        return status;
    }
    const bool same = outcome->status == new.status && !strcmp(outcome->message, new.message) &&
                      memcmp(value, m->value, n_value * sizeof *value) == 0;
    return same ? STATUS_OK
                : error_set(e, STATUS_INPUT,
                            "run %ld has other results in %s than in a part before it", run + 1,
                            path_of(m, k));
}

static int read_part(const struct merge *m, int k, const struct target *to, struct error *e) {
    const struct study_view *v = m->input[k].view;
    const long end = find_row(v, to->first + to->n);
    int status = STATUS_OK;
    tell(m, k);
    for (long row = find_row(v, to->first); row < end && status == STATUS_OK; row++) {
        status = place(m, k, row, to, e);
    }
    tell(m, -1);
    return status;
}

static int read_runs(void *context, long first, long n, struct study_outcome *outcome,
                     double *value, struct error *e) {
    struct merge *m = context;
    const struct target to = {first, n, outcome, value};
    for (long i = 0; i < n; i++) {
        outcome[i] = (struct study_outcome){.status = STUDY_MISSING};
    }
    for (size_t i = 0; i < (size_t)n * m->table->n_value; i++) {
        value[i] = NAN;
    }
    int status = STATUS_OK;
    for (int k = 0; k < m->request->n_path && status == STATUS_OK; k++) {
        status = m->request->poll ? m->request->poll(m->request->context, e) : STATUS_OK;
        status = status == STATUS_OK ? read_part(m, k, &to, e) : status;
    }
    for (long i = 0; i < n; i++) {
        m->out->n_failed += outcome[i].status == STUDY_FAILED;
    }
    return status;
}

// The sweeps of the first part as a list; times of all parts add up.
static void describe(const struct merge *m, struct sweep *list, struct study_content *c) {
    const struct study_view *v = m->input[0].view;
    for (int i = 0; i < v->n_sweep; i++) {
        list[i] = *v->sweep[i];
        list[i].next = i + 1 < v->n_sweep ? &list[i + 1] : NULL;
    }
    c->sweeps = list;
    for (int k = 0; k < m->request->n_path; k++) {
        v = m->input[k].view;
        m->out->left_histories |= v->has_histories;
        c->n_kept += v->n_kept;
        c->n_thread = v->n_thread > c->n_thread ? v->n_thread : c->n_thread;
        c->seconds += v->seconds;
    }
}

static int join(struct merge *m, struct error *e) {
    struct sweep list[STUDY_SWEEPS_MAX];
    struct study_content content = {.first = m->report,
                                    .table = m->table,
                                    .origin = &m->origin,
                                    .n_run = m->out->n_run,
                                    .n_part = m->request->n_path,
                                    .read = read_runs,
                                    .context = m};
    describe(m, list, &content);
    int status = study_file_check(&content, &m->request->result, e);
    for (int k = 0; k < m->request->n_path && status == STATUS_OK; k++) {
        status = take_map(&m->input[k], m->table, NULL, e);
        if (status == STATUS_OK && m->input[k].lacks) {
            status = error_set(e, STATUS_INPUT, "%s is damaged: it lacks properties of its models",
                               path_of(m, k));
        }
    }
    m->value = malloc((m->table->n_value + 1) * sizeof *m->value);
    if (status == STATUS_OK && !m->value) {
        status = error_no_memory(e);
    }
    status = status == STATUS_OK ? join_keys(m, e) : status;
    return status == STATUS_OK ? study_file_write(&content, &m->request->result, e) : status;
}

static int open_and_join(struct merge *m, struct error *e) {
    int status = m->request->n_path > 0 ? STATUS_OK
                                        : error_set(e, STATUS_INPUT, "there are no parts to join");
    for (int k = 0; k < m->request->n_path && status == STATUS_OK; k++) {
        status = open_part(m, k, e);
    }
    if (status != STATUS_OK) {
        return status;
    }
    assert(m->input[0].view);
    m->out->n_run = m->input[0].view->n_study;
    status = join_origins(m, e);
    status = status == STATUS_OK ? check_missing(m, e) : status;
    status = status == STATUS_OK ? study_file_report(m->input[0].file, &m->report, e) : status;
    status = status == STATUS_OK ? study_table_create(m->report, &m->table, e) : status;
    return status == STATUS_OK ? join(m, e) : status;
}

int study_merge(const struct study_merge_request *q, struct study_merged *out, struct error *e) {
    struct merge m = {.request = q, .out = out, .arena = arena_create()};
    *out = (struct study_merged){.n_run = 0};
    m.input = calloc((size_t)q->n_path + 1, sizeof *m.input);
    int status = m.input && m.arena ? open_and_join(&m, e) : error_no_memory(e);
    for (int k = 0; m.input && k < q->n_path; k++) {
        tell(&m, k);
        take_close(&m.input[k]);
    }
    free(m.input);
    free(m.key);
    free(m.value);
    study_table_free(m.table);
    report_free(m.report);
    arena_free(m.arena);
    return status;
}
