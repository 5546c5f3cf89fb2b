// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/portion.h"

#include <stdlib.h>
#include <string.h>

#include "jostle/study_merge.h"
#include "study/identity.h"

// A path below the folder of the deck without it: parts may come from machines where it lies
// elsewhere.
static const char *relative(const char *deck, const char *path) {
    const size_t folder = identity_folder(deck);
    return strncmp(path, deck, folder) == 0 ? path + folder : path;
}

static const char *absolute(struct arena *a, const char *deck, const char *path) {
    return path[0] == '/' ? path
                          : arena_format(a, "%.*s%s", (int)identity_folder(deck), deck, path);
}

static int compare(const void *a, const void *b) {
    return strcmp(((const struct study_source *)a)->path, ((const struct study_source *)b)->path);
}

// The files of the ledger in the order of their paths; NULL: no memory.
static struct study_source *list_sources(const struct plan *p, const struct ledger *l, int *n) {
    *n = 0;
    for (const struct ledger_file *f = l->file; f; f = f->next) {
        ++*n;
    }
    struct study_source *source = arena_alloc(l->arena, (size_t)*n, sizeof *source);
    int i = 0;
    for (const struct ledger_file *f = l->file; f && source; f = f->next) {
        source[i++] = (struct study_source){relative(p->first->deck->path, f->path), f->sum};
    }
    if (source && *n > 0) {
        qsort(source, (size_t)*n, sizeof *source, compare);
    }
    return source;
}

int portion_origin(const struct study_request *q, const struct plan *p, const struct ledger *l,
                   struct study_origin *out, struct error *e) {
    const char *define = "";
    for (int i = 0; i < q->n_define && define; i++) {
        define = arena_format(l->arena, "%s%s\n", define, q->define[i]);
    }
    out->source = list_sources(p, l, &out->n_source);
    out->define = define;
    out->programs = arena_format(l->arena, "%s\n", q->program.digits);
    out->numerics = q->numerics;
    return define && out->source && out->programs ? STATUS_OK : error_no_memory(e);
}

int portion_describe(const struct plan *p, const struct ledger *l, struct study_part *out,
                     struct error *e) {
    double *run = arena_alloc(l->arena, (size_t)p->n_mine, sizeof *run);
    if (!run) {
        return error_no_memory(e);
    }
    for (long k = 0; k < p->n_mine; k++) {
        run[k] = (double)(study_shard_run(&p->shard, k) + 1);
    }
    *out = (struct study_part){.shard = p->shard, .run = run};
    return STATUS_OK;
}

int portion_compare(const struct study_request *q, struct ledger *l, const char *study,
                    const struct study_origin *o, struct error *e) {
    int length;
    if (strcmp(o->study, study) != 0) {
        const char *cause = identity_difference(o->study, study, &length);
        return error_set(e, STATUS_INPUT, "%.*s", length, cause);
    }
    for (int i = 0; i < o->n_source; i++) {
        const struct study_source *s = &o->source[i];
        const char *path = absolute(l->arena, q->first->deck->path, s->path);
        int status = path ? ledger_expect(l, path, &s->sum, e) : error_no_memory(e);
        if (status != STATUS_OK) {
            return status;
        }
        if (ledger_unchanged(l, e) != STATUS_OK) {
            return error_set(e, STATUS_INPUT, "%s", path);
        }
    }
    return STATUS_OK;
}

static int compare_part(const struct study_request *q, struct ledger *l, const char *study,
                        struct study_file *f, struct error *e) {
    const struct study_view *v = study_file_view(f);
    if (v->part.shard.n != q->shard.n || v->part.shard.number != q->shard.number) {
        return error_set(e, STATUS_INPUT,
                         "%s exists and holds part %ld of %ld; --force overwrites it",
                         q->result.path, v->part.shard.number, v->part.shard.n);
    }
    int status = study_file_verify(f, e);
    const bool whole = status == STATUS_OK;
    status = whole ? portion_compare(q, l, study, &v->origin, e) : status;
    const struct error cause = *e;
    if (status == STATUS_INPUT && whole) {
        return error_set(e, STATUS_INPUT,
                         "%s exists, but %s has changed since it was made; --force overwrites it",
                         q->result.path, cause.message);
    }
    return status == STATUS_INPUT
               ? error_set(e, STATUS_INPUT, "%s; --force overwrites it", cause.message)
               : status;
}

int portion_find(const struct study_request *q, struct ledger *l, const char *study, bool *found,
                 long *n_failed, struct error *e) {
    *found = false;
    if (q->shard.n == 0 || q->journal == STUDY_RESTART || q->result.existing == RESULT_REPLACE ||
        !study_file_is_study(q->result.path)) {
        return STATUS_OK;  // whoever writes the file says that it exists
    }
    struct study_file *f;
    int status = study_file_open(q->result.path, &f, e);
    if (status != STATUS_OK) {
        return status;
    }
    const struct study_part *part = &study_file_view(f)->part;
    if (part->shard.n > 0) {
        status = compare_part(q, l, study, f, e);
        *found = status == STATUS_OK;
        *n_failed = part->n_failed;
    }
    study_file_close(f);
    return status;
}
