// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/origin.h"

#include <stdlib.h>
#include <string.h>

#include "core/checksum.h"
#include "deck/parameter.h"
#include "jostle/numerics.h"
#include "jostle/study_merge.h"

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
    const char *text = arena_format(a, "the version of the numerics\t%d\nthe deck\t%s\n-D\t%s\n",
                                    q->numerics, meaning.digits, define.digits);
    for (const struct sweep *w = d->sweeps; w && text; w = w->next) {
        const struct checksum values = sum_sweep(w);
        text = arena_format(a, "%sthe list of values of '%s'\t%d %s\n", text, w->name, w->n,
                            values.digits);
    }
    *out = text ? arena_format(a, "%sthe number of results\t%zu\n", text, n_value) : NULL;
    return *out ? STATUS_OK : error_no_memory(e);
}

const char *origin_journal(struct arena *a, const struct study_table *t) {
    struct checksum_sum sum;
    struct checksum out;
    checksum_start(&sum);
    for (int i = 0; i < t->n_item; i++) {
        const struct study_item *item = &t->item[i];
        checksum_add_text(&sum, item->parent);
        checksum_add_text(&sum, item->owner ? item->owner : "");
        checksum_add_text(&sum, item->leaf ? item->leaf : "");
        checksum_add_text(&sum, item->name);
        checksum_add_number(&sum, item->n);
    }
    checksum_end(&sum, &out);
    return arena_format(a, "values of a run\t%zu %s\n", t->n_value, out.digits);
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

const char *origin_join_lines(struct arena *a, const char *to, const char *lines) {
    while (*lines && to) {
        const size_t n = strcspn(lines, "\n");
        const char *at = to;
        while (*at && !(strncmp(at, lines, n) == 0 && at[n] == '\n')) {
            at += strcspn(at, "\n") + 1;
        }
        to = *at ? to : arena_format(a, "%s%.*s\n", to, (int)n, lines);
        lines += n + (lines[n] == '\n');
    }
    return to;
}

static int compare(const void *a, const void *b) {
    return strcmp(((const struct study_source *)a)->path, ((const struct study_source *)b)->path);
}

// The files of the manifest in the order of their paths; NULL: no memory.
static struct study_source *list_sources(const struct manifest *m, int *n) {
    *n = (int)m->n_file;
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
    out->programs = origin_join_lines(m->arena, out->programs, q->program.digits);
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

// Compares what the runs of a file come from with the study of the text `study`. Errors:
// STATUS_INPUT with the name of the first difference, STATUS_SYSTEM.
static int compare_origin(struct manifest *m, const char *study, const struct study_origin *o,
                          struct error *e) {
    int length;
    if (strcmp(o->study, study) != 0) {
        const char *cause = origin_difference(o->study, study, &length);
        return error_set(e, STATUS_INPUT, "%.*s", length, cause);
    }
    for (int i = 0; i < o->n_source; i++) {
        const struct study_source *s = &o->source[i];
        const int status = manifest_expect(m, s->path, &s->sum, e);
        if (status != STATUS_OK) {
            return status;
        }
    }
    return STATUS_OK;
}

int origin_check(struct manifest *m, const struct plan *p, const struct study_view *v,
                 struct error *e) {
    const struct study_request study = {.first = p->first,
                                        .define = p->define,
                                        .n_define = p->n_define,
                                        .numerics = NUMERICS_VERSION};
    const char *current = NULL;
    if (!v->origin.study) {
        return error_set(e, STATUS_INPUT, "%s does not tell what its runs come from", v->path);
    }
    int status = origin_study(m->arena, &study, p->table->n_value, &current, e);
    if (status == STATUS_OK && current) {
        status = compare_origin(m, current, &v->origin, e);
    }
    if (status != STATUS_INPUT) {
        return status;
    }
    const struct error cause = *e;
    return error_set(e, STATUS_INPUT, "%s cannot be computed again: %s has changed since", v->path,
                     cause.message);
}
