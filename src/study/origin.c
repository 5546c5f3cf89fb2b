// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/origin.h"

#include <stdlib.h>
#include <string.h>

#include "core/checksum.h"
#include "deck/parameter.h"
#include "jostle/study_merge.h"

static const char numerics_line[] = "the version of the numerics", deck_line[] = "the deck";

static struct checksum sum_sweep(const struct sweep *s) {
    struct checksum_sum sum;
    struct checksum out;
    checksum_start(&sum);
    for (; s; s = s->along) {
        checksum_add_text(&sum, s->name);
        for (int i = 0; i < s->n; i++) {
            if (s->number) {
                checksum_add(&sum, &s->number[i], sizeof s->number[i]);
            } else {
                checksum_add_text(&sum, s->text[i]);
            }
        }
    }
    checksum_end(&sum, &out);
    return out;
}

int origin_study(struct arena *a, const struct study_request *q, size_t n_value, const char **out,
                 struct error *e) {
    const struct deck *d = q->first->deck;
    struct checksum meaning;
    int status = deck_meaning(d->text, &meaning, e);
    if (status != STATUS_OK) {
        return status;
    }
    const char *const *defined = deck_define_texts(d, a);
    if (!defined) {
        return error_no_memory(e);
    }
    struct checksum_sum sum;
    struct checksum define;
    checksum_start(&sum);
    for (int i = 0; i < q->n_define; i++) {
        checksum_add_text(&sum, defined[i]);
    }
    checksum_end(&sum, &define);
    const char *text = arena_format(a, "%s\t%d\n%s\t%s\n-D\t%s\n", numerics_line, q->numerics,
                                    deck_line, meaning.digits, define.digits);
    for (const struct sweep *w = d->sweeps; w && text; w = w->next) {
        const struct checksum values = sum_sweep(w);
        text = arena_format(a, "%sthe list of values of '%s'\t%d %s\n", text, w->name, w->n,
                            values.digits);
    }
    *out = text ? arena_format(a, "%sthe number of results\t%zu\n", text, n_value) : NULL;
    return *out ? STATUS_OK : error_no_memory(e);
}

const char *origin_journal(struct arena *a, const struct study_request *q, const char *study) {
    return q->shard.n > 0
               ? arena_format(a, "%sthe part\t%ld/%ld\n", study, q->shard.number, q->shard.n)
               : study;
}

const char *origin_difference(const char *old, const char *new, int *length) {
    size_t line = 0;
    for (size_t i = 0; old[i] == new[i] && old[i]; i++) {
        line = old[i] == '\n' ? i + 1 : line;
    }
    const char *from = new[line] ? new + line : old + line;
    *length = (int)strcspn(from, "\t\n");
    return from;
}

static bool is_named(const char *line, const char *name) {
    const size_t n = strlen(name);
    return strncmp(line, name, n) == 0 && line[n] == '\t';
}

static bool may_change(const char *line) {
    return is_named(line, numerics_line) || is_named(line, deck_line);
}

int origin_accept(struct arena *a, const char *old, const char *new, const char **accepted,
                  struct error *e) {
    while (*old && *new) {
        const size_t n_old = strcspn(old, "\n"), n_new = strcspn(new, "\n");
        const int name = (int)strcspn(new, "\t\n");
        const bool same = n_old == n_new && memcmp(old, new, n_old) == 0;
        if (!same && (!may_change(new) || strncmp(old, new, (size_t)name + 1) != 0)) {
            return error_set(e, STATUS_INPUT, "%.*s", name, new);
        }
        *accepted = same ? *accepted
                         : arena_format(a, "%s%.*s: %.*s\n", *accepted, name, new,
                                        (int)n_old - name - 1, old + name + 1);
        if (!*accepted) {
            return error_no_memory(e);
        }
        old += n_old + (old[n_old] == '\n');
        new += n_new + (new[n_new] == '\n');
    }
    return *old || *new ? error_set(e, STATUS_INPUT, "the list of sweeps") : STATUS_OK;
}

static int compare(const void *a, const void *b) {
    return strcmp(((const struct study_source *)a)->path, ((const struct study_source *)b)->path);
}

// The files of the manifest in the order of their paths; NULL: no memory.
static struct study_source *list_sources(const struct manifest *m, int *n) {
    *n = 0;
    for (const struct manifest_file *f = m->file; f; f = f->next) {
        ++*n;
    }
    struct study_source *source = arena_alloc(m->arena, (size_t)*n, sizeof *source);
    int i = 0;
    for (const struct manifest_file *f = m->file; f && source; f = f->next) {
        source[i++] = (struct study_source){f->name, f->sum};
    }
    if (source && *n > 0) {
        qsort(source, (size_t)*n, sizeof *source, compare);
    }
    return source;
}

int origin_describe(const struct study_request *q, const struct manifest *m,
                    struct study_origin *out, struct error *e) {
    const char *define = "";
    for (int i = 0; i < q->n_define && define; i++) {
        define = arena_format(m->arena, "%s%s\n", define, q->define[i]);
    }
    out->source = list_sources(m, &out->n_source);
    out->define = define;
    out->programs = arena_format(m->arena, "%s\n", q->program.digits);
    out->numerics = q->numerics;
    return define && out->source && out->programs ? STATUS_OK : error_no_memory(e);
}

int origin_part(const struct plan *p, const struct manifest *m, struct study_part *out,
                struct error *e) {
    double *run = arena_alloc(m->arena, (size_t)p->n_mine, sizeof *run);
    if (!run) {
        return error_no_memory(e);
    }
    for (long k = 0; k < p->n_mine; k++) {
        run[k] = (double)(study_shard_run(&p->shard, k) + 1);
    }
    *out = (struct study_part){.shard = p->shard, .run = run};
    return STATUS_OK;
}

int origin_compare(struct manifest *m, const char *study, const struct study_origin *o,
                   struct error *e) {
    int length;
    if (strcmp(o->study, study) != 0) {
        const char *cause = origin_difference(o->study, study, &length);
        return error_set(e, STATUS_INPUT, "%.*s", length, cause);
    }
    for (int i = 0; i < o->n_source; i++) {
        const struct study_source *s = &o->source[i];
        int status = manifest_expect(m, s->path, &s->sum, e);
        if (status != STATUS_OK) {
            return status;
        }
        if (manifest_unchanged(m, e) != STATUS_OK) {
            return error_set(e, STATUS_INPUT, "%s", s->path);
        }
    }
    return STATUS_OK;
}

static int compare_part(const struct study_request *q, struct manifest *m, const char *study,
                        struct study_file *f, struct error *e) {
    const struct study_view *v = study_file_view(f);
    if (v->part.shard.n != q->shard.n || v->part.shard.number != q->shard.number) {
        return error_set(e, STATUS_INPUT,
                         "%s exists and holds part %ld of %ld; --force overwrites it",
                         q->result.path, v->part.shard.number, v->part.shard.n);
    }
    int status = study_file_verify(f, e);
    const bool whole = status == STATUS_OK;
    status = whole ? origin_compare(m, study, &v->origin, e) : status;
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

int origin_find_part(const struct study_request *q, struct manifest *m, const char *study,
                     bool *found, long *n_failed, struct error *e) {
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
        status = compare_part(q, m, study, f, e);
        *found = status == STATUS_OK;
        *n_failed = part->n_failed;
    }
    study_file_close(f);
    return status;
}
