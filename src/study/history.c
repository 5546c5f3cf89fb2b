// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/history.h"

#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/hash.h"
#include "model/forces.h"

// Members of a row: the fields in the order of enum field's bits up to the seventh, time, ground,
// energies and the forces of members.
enum { FIELDS = 7, TIME = FIELDS, GROUND, ENERGIES, FORCES, MEMBERS, FLOOR_FIELDS = 5 };

// How many numbers of each member a row has; 0: the file is not to hold it. Returns the sum.
static size_t row_sizes(const struct model *m, size_t n[MEMBERS]) {
    size_t sum = 0;
    for (int i = 0; i < FIELDS; i++) {
        const int all = i < FLOOR_FIELDS ? m->n_dof : m->n_link;
        n[i] = m->output.fields >> i & 1 ? (size_t)all : 0;
    }
    n[TIME] = 1;
    n[GROUND] = (size_t)m->n_ground;
    n[ENERGIES] = ENERGY_COUNT;
    n[FORCES] = forces_in_rows(m) ? (size_t)m->n_force : 0;
    for (int i = 0; i < MEMBERS; i++) {
        sum += n[i];
    }
    return sum;
}

uint64_t history_shape(const struct model *m) {
    uint64_t sum = hash_start;
    const long size[] = {m->n_dof, m->n_link, m->n_ground, model_rows(m), m->n_force};
    sum = hash_add(sum, size, sizeof size);
    sum = hash_add(sum, &m->output.fields, sizeof m->output.fields);
    sum = hash_add(sum, &m->output.every, sizeof m->output.every);
    sum = hash_add(sum, &m->dt, sizeof m->dt);
    const char may_collapse = m->collapse != NULL;
    sum = hash_add(sum, &may_collapse, sizeof may_collapse);
    return sum ? sum : 1;
}

void history_start(struct history_writer *w, const struct model *m) {
    const uint64_t shape = history_shape(m);
    w->model = m;
    w->used = sizeof shape;
    memcpy(w->block, &shape, sizeof shape);
}

static int flush(struct history_writer *w, struct error *e) {
    const size_t n = w->used;
    w->used = 0;
    return n > 0 ? w->put(w->context, w->block, n, e) : STATUS_OK;
}

static int put(struct history_writer *w, const void *from, size_t n, struct error *e) {
    const char *bytes = from;
    int status = STATUS_OK;
    while (n > 0 && status == STATUS_OK) {
        const size_t room = sizeof w->block - w->used, part = n < room ? n : room;
        memcpy(w->block + w->used, bytes, part);
        w->used += part;
        bytes += part;
        n -= part;
        status = w->used == sizeof w->block ? flush(w, e) : STATUS_OK;
    }
    return status;
}

// Of a model that may collapse there is a 1 before each row, and a 0 behind the last.
static int put_mark(struct history_writer *w, double mark, struct error *e) {
    return w->model->collapse ? put(w, &mark, sizeof mark, e) : STATUS_OK;
}

int history_put_row(struct history_writer *w, const struct row_view *row, struct error *e) {
    const double *const from[MEMBERS] = {
        row->displacement, row->velocity, row->acceleration, row->drift,
        row->storey_shear, row->force,    row->penetration,  &row->time,
        row->ground,       row->energy,   row->member_force,
    };
    size_t n[MEMBERS];
    int status = put_mark(w, 1.0, e);
    row_sizes(w->model, n);
    for (int i = 0; i < MEMBERS && status == STATUS_OK; i++) {
        status = n[i] > 0 ? put(w, from[i], n[i] * sizeof *from[i], e) : STATUS_OK;
    }
    return status;
}

// Members of struct results.
struct span {
    void *at;
    size_t size;
};
enum { SPANS = 2 * PEAK_COUNT + 15 };

static void find_spans(struct results *r, const struct model *m, struct span s[SPANS]) {
    const size_t floors = (size_t)m->n_dof * sizeof(double);
    for (int p = 0; p < PEAK_COUNT; p++) {
        *s++ = (struct span){r->peak[p], floors};
        *s++ = (struct span){r->peak_time[p], floors};
    }
    *s++ = (struct span){r->residual_drift, floors};
    *s++ = (struct span){r->storey_demand, (size_t)m->n_dof * sizeof *r->storey_demand};
    *s++ = (struct span){r->hinge_demand, (size_t)m->n_hinge * sizeof *r->hinge_demand};
    double *const force[] = {r->force_max, r->force_max_time, r->force_min, r->force_min_time};
    for (int i = 0; i < 4; i++) {
        *s++ = (struct span){force[i], (size_t)m->n_force * sizeof(double)};
    }
    *s++ = (struct span){r->link, (size_t)m->n_link * sizeof *r->link};
    *s++ = (struct span){r->column, (size_t)m->n_column * sizeof *r->column};
    *s++ = (struct span){r->impact, (size_t)r->n_impact * sizeof *r->impact};
    *s++ = (struct span){r->energy, sizeof r->energy};
    *s++ = (struct span){&r->initial_energy, sizeof r->initial_energy};
    *s++ = (struct span){&r->residual_peak, sizeof r->residual_peak};
    *s++ = (struct span){&r->totals, sizeof r->totals};
    *s++ = (struct span){&r->collapse, sizeof r->collapse};
}

int history_put_results(struct history_writer *w, const struct results *r, struct error *e) {
    struct results copy = *r;
    struct span span[SPANS];
    find_spans(&copy, w->model, span);
    int status = put_mark(w, 0.0, e);
    status = status == STATUS_OK ? put(w, &r->n_impact, sizeof r->n_impact, e) : status;
    for (int i = 0; i < SPANS && status == STATUS_OK; i++) {
        status = span[i].size > 0 ? put(w, span[i].at, span[i].size, e) : STATUS_OK;
    }
    return status == STATUS_OK ? flush(w, e) : status;
}

// Being read.
struct source {
    struct journal *journal;
    long run;
    int64_t *offset;  // (n_block) of the blocks; heap
    long n_block, block;
    const unsigned char *bytes;  // (left) not yet read of the block before `block`
    size_t left;
};

static int get(struct source *s, void *to, size_t n, struct error *e) {
    char *bytes = to;
    while (n > 0) {
        if (s->left == 0) {
            if (s->block == s->n_block) {
                return error_set(e, STATUS_SYSTEM, "%s: the histories of run %ld are too short",
                                 s->journal->path, s->run + 1);
            }
            const int status = journal_read_block(s->journal, s->run, s->offset[s->block++],
                                                  &s->bytes, &s->left, e);
            if (status != STATUS_OK) {
                return status;
            }
        }
        const size_t part = n < s->left ? n : s->left;
        memcpy(bytes, s->bytes, part);
        bytes += part;
        s->bytes += part;
        s->left -= part;
        n -= part;
    }
    return STATUS_OK;
}

// Is there another row, after `i` of them?
static int get_mark(struct source *s, const struct model *m, long i, bool *more, struct error *e) {
    double mark = i < model_rows(m);
    const int status = m->collapse ? get(s, &mark, sizeof mark, e) : STATUS_OK;
    *more = mark != 0.0;
    return status == STATUS_OK && *more && i == model_rows(m)
               ? error_set(e, STATUS_SYSTEM, "%s: the histories of run %ld are too long",
                           s->journal->path, s->run + 1)
               : status;
}

static int show_rows(struct source *s, const struct model *m, const struct observer *observer,
                     double *row, struct error *e) {
    struct row_view view = {0};
    const double *time = row;
    const double **const to[MEMBERS] = {
        &view.displacement, &view.velocity, &view.acceleration, &view.drift,
        &view.storey_shear, &view.force,    &view.penetration,  &time,
        &view.ground,       &view.energy,   &view.member_force,
    };
    size_t n[MEMBERS], at = 0;
    const size_t sum = row_sizes(m, n);
    for (int i = 0; i < MEMBERS; i++) {
        *to[i] = row + at;
        at += n[i];
    }
    bool more = false;
    int status = get_mark(s, m, 0, &more, e);
    for (long i = 1; more && status == STATUS_OK; i++) {
        status = get(s, row, sum * sizeof *row, e);
        view.time = *time;
        status = status == STATUS_OK ? observer->row(observer->context, &view, e) : status;
        status = status == STATUS_OK ? get_mark(s, m, i, &more, e) : status;
    }
    return status;
}

// Room for the results of a run of `m`.
static struct results *new_results(const struct model *m, long n_impact) {
    struct arena *a = arena_create();
    struct results *r = a ? arena_alloc(a, 1, sizeof *r) : NULL;
    if (!r) {
        arena_free(a);
        return NULL;
    }
    r->arena = a;
    for (int p = 0; p < PEAK_COUNT; p++) {
        r->peak[p] = arena_alloc(a, (size_t)m->n_dof, sizeof *r->peak[p]);
        r->peak_time[p] = arena_alloc(a, (size_t)m->n_dof, sizeof *r->peak_time[p]);
    }
    r->residual_drift = arena_alloc(a, (size_t)m->n_dof, sizeof *r->residual_drift);
    r->storey_demand = arena_alloc(a, (size_t)m->n_dof, sizeof *r->storey_demand);
    r->hinge_demand = arena_alloc(a, (size_t)m->n_hinge, sizeof *r->hinge_demand);
    double **const force[] = {&r->force_max, &r->force_max_time, &r->force_min, &r->force_min_time};
    for (int i = 0; i < 4; i++) {
        *force[i] = arena_alloc(a, (size_t)m->n_force, sizeof **force[i]);
    }
    r->link = arena_alloc(a, (size_t)m->n_link, sizeof *r->link);
    r->column = arena_alloc(a, (size_t)m->n_column, sizeof *r->column);
    r->impact = malloc(((size_t)n_impact + 1) * sizeof *r->impact);
    r->n_impact = r->impact_capacity = n_impact;
    if (!r->impact || arena_failed(a)) {
        results_free(r);
        return NULL;
    }
    return r;
}

static int get_results(struct source *s, const struct model *m, struct results **out,
                       struct error *e) {
    long n_impact = 0;
    struct span span[SPANS];
    int status = get(s, &n_impact, sizeof n_impact, e);
    if (status != STATUS_OK) {
        return status;
    }
    struct results *r = new_results(m, n_impact);
    if (!r) {
        return error_no_memory(e);
    }
    find_spans(r, m, span);
    for (int i = 0; i < SPANS && status == STATUS_OK; i++) {
        status = get(s, span[i].at, span[i].size, e);
    }
    if (status != STATUS_OK) {
        results_free(r);
        return status;
    }
    *out = r;
    return STATUS_OK;
}

// Begins to read: was the run one of this model?
static int open_source(struct source *s, struct journal *j, long run, const struct model *m,
                       bool *fits, struct error *e) {
    uint64_t shape = 0;
    *s = (struct source){.journal = j, .run = run, .n_block = j->chain[run].n};
    int status = journal_find_blocks(j, run, &s->offset, e);
    if (status == STATUS_OK) {
        status = get(s, &shape, sizeof shape, e);
    }
    *fits = shape == history_shape(m);
    return status;
}

int history_replay(struct journal *j, long run, const struct model *m,
                   const struct observer *observer, struct results **out, struct error *e) {
    size_t n[MEMBERS];
    struct source s = {.offset = NULL};
    bool fits = true;
    double *row = malloc(row_sizes(m, n) * sizeof *row);
    if (!row) {
        return error_no_memory(e);
    }
    int status = open_source(&s, j, run, m, &fits, e);
    if (status == STATUS_OK && !fits) {
        status = error_set(e, STATUS_SYSTEM, "%s: the histories of run %ld are of another model",
                           j->path, run + 1);
    }
    if (status == STATUS_OK) {
        status = show_rows(&s, m, observer, row, e);
    }
    if (status == STATUS_OK) {
        status = get_results(&s, m, out, e);
    }
    free(s.offset);
    free(row);
    return status;
}
