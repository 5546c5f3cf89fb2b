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

int portion_describe(const struct plan *p, const struct ledger *l, const char *study,
                     struct study_part *out, struct error *e) {
    int n = 0;
    for (const struct ledger_file *f = l->file; f; f = f->next) {
        n++;
    }
    struct study_source *source = arena_alloc(l->arena, (size_t)n, sizeof *source);
    double *run = arena_alloc(l->arena, (size_t)p->n_mine, sizeof *run);
    if (!source || !run) {
        return error_no_memory(e);
    }
    int i = 0;
    for (const struct ledger_file *f = l->file; f; f = f->next) {
        source[i++] = (struct study_source){relative(p->first->deck->path, f->path), f->sum};
    }
    if (n > 0) {
        qsort(source, (size_t)n, sizeof *source, compare);
    }
    for (long k = 0; k < p->n_mine; k++) {
        run[k] = (double)(study_shard_run(&p->shard, k) + 1);
    }
    *out = (struct study_part){
        .shard = p->shard, .run = run, .study = study, .n_source = n, .source = source};
    return STATUS_OK;
}

static int refuse(const struct study_request *q, const char *cause, int length, struct error *e) {
    return error_set(e, STATUS_INPUT,
                     "%s exists, but %.*s has changed since it was made; --force overwrites it",
                     q->result.path, length, cause);
}

static int compare_part(const struct study_request *q, struct ledger *l, const char *study,
                        const struct study_part *part, struct error *e) {
    int length;
    if (part->shard.n != q->shard.n || part->shard.number != q->shard.number) {
        return error_set(e, STATUS_INPUT,
                         "%s exists and holds part %ld of %ld; --force overwrites it",
                         q->result.path, part->shard.number, part->shard.n);
    }
    if (strcmp(part->study, study) != 0) {
        const char *cause = identity_difference(part->study, study, &length);
        return refuse(q, cause, length, e);
    }
    for (int i = 0; i < part->n_source; i++) {
        const struct study_source *s = &part->source[i];
        const char *path = absolute(l->arena, q->first->deck->path, s->path);
        if (!path) {
            return error_no_memory(e);
        }
        int status = ledger_expect(l, path, s->sum, e);
        if (status != STATUS_OK) {
            return status == STATUS_INPUT ? refuse(q, path, (int)strlen(path), e) : status;
        }
    }
    return STATUS_OK;
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
        status = compare_part(q, l, study, part, e);
        *found = status == STATUS_OK;
        *n_failed = part->n_failed;
    }
    study_file_close(f);
    return status;
}
