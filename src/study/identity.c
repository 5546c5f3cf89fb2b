// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/identity.h"

#include <string.h>

#include "core/checksum.h"

static const char numerics[] = "the version of the numerics", deck[] = "the deck",
                  folder[] = "the folder of the deck";

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

static struct checksum sum_define(const struct study_request *q) {
    struct checksum_sum sum;
    struct checksum out;
    checksum_start(&sum);
    for (int i = 0; i < q->n_define; i++) {
        checksum_add_text(&sum, q->define[i]);
    }
    checksum_end(&sum, &out);
    return out;
}

int identity_study(struct arena *a, const struct study_request *q, size_t n_value, const char **out,
                   struct error *e) {
    const struct deck *d = q->first->deck;
    struct checksum meaning;
    int status = deck_meaning(d->text, &meaning, e);
    if (status != STATUS_OK) {
        return status;
    }
    const struct checksum define = sum_define(q);
    const char *text = arena_format(a, "%s\t%d\n%s\t%s\n-D\t%s\n", numerics, q->numerics, deck,
                                    meaning.digits, define.digits);
    for (const struct sweep *w = d->sweeps; w && text; w = w->next) {
        const struct checksum sum = sum_sweep(w);
        text = arena_format(a, "%sthe list of values of '%s'\t%d %s\n", text, w->name, w->n,
                            sum.digits);
    }
    *out = text ? arena_format(a, "%sthe number of results\t%zu\n", text, n_value) : NULL;
    return *out ? STATUS_OK : error_no_memory(e);
}

const char *identity_journal(struct arena *a, const struct study_request *q, const char *study) {
    const char *text = arena_format(a, "%s%s\t%s\n", study, folder, q->first->deck->path);
    return text && q->shard.n > 0
               ? arena_format(a, "%sthe part\t%ld/%ld\n", text, q->shard.number, q->shard.n)
               : text;
}

const char *identity_difference(const char *old, const char *new, int *length) {
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
    return is_named(line, numerics) || is_named(line, deck) || is_named(line, folder);
}

int identity_accept(struct arena *a, const char *old, const char *new, const char **accepted,
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

size_t identity_folder(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}
