// SPDX-License-Identifier: GPL-3.0-or-later
// Files of several channels: the choice of a channel, and files in which each channel is a column.
#include "motion/channels.h"

#include <assert.h>
#include <string.h>

#include "core/arena.h"
#include "motion/values.h"

bool channels_choose(const struct record_reader *r, const struct channels *c, int *chosen) {
    assert(c->n > 0 && c->n <= CHANNELS_MAX);
    const int requested = r->request->channel;
    const int wanted = requested == 0 && c->n == 1 ? 1 : requested;
    if (wanted > 0 && wanted <= c->n) {
        *chosen = wanted - 1;
        return true;
    }
    char list[400] = "";
    size_t n = 0;
    for (int i = 0; i < c->n && n < sizeof list; i++) {
        n += (size_t)snprintf(list + n, sizeof list - n, "%s%d '%s'", i ? ", " : "", i + 1,
                              lines_excerpt(c->name[i]).text);
    }
    if (requested == 0) {
        return record_fail(r, 0, "%d channels: %s; -channel chooses one", c->n, list);
    }
    r->out->wrong = RECORD_CHANNEL;
    return record_fail(r, 0, "the file has no channel %d; available: %s", requested, list);
}

bool channels_seek(const struct record_reader *r, bool (*next)(struct lines *l, void *channel),
                   const char *none, struct lines *l, void *channel) {
    struct channels all = {0};
    struct lines at[CHANNELS_MAX];
    int chosen = 0;
    lines_init(l, r->text);
    for (struct lines last = *l; next(l, channel); last = *l) {
        if (all.n == CHANNELS_MAX) {
            return record_fail(r, l->number, "more than %d channels", CHANNELS_MAX);
        }
        at[all.n] = last;
        all.name[all.n++] = *(const struct piece *)channel;
    }
    if (all.n == 0) {
        return record_fail(r, 0, "%s", none);
    }
    if (!channels_choose(r, &all, &chosen)) {
        return false;
    }
    *l = at[chosen];
    return next(l, channel);
}

static bool next_row(struct lines *l) {
    while (lines_next(l)) {
        if (l->line.n > 0) {
            return true;
        }
    }
    return false;
}

// Reads row `i`, the current line of `l`.
static bool read_row(const struct record_reader *r, const struct channel_rows *rows,
                     const struct lines *l, size_t i) {
    struct piece rest = l->line;
    struct number_field f = {r->text, l->number, "value", i + 1, {0}};
    const size_t n = lines_count(l->line, "");
    if (n != (size_t)rows->n_column) {
        return record_fail(r, l->number, "row of %zu values; the header says %d", n,
                           rows->n_column);
    }
    for (int c = 0; c < rows->n_column; c++) {
        double x;
        lines_field(&rest, "", &f.field);
        if (!record_number(r, &f, &x) ||
            (rows->timed && c == 0 && !values_check_time(r, l->number, i, x))) {
            return false;
        }
        if (c == rows->column) {
            r->out->value[i] = x;
        }
    }
    return true;
}

// True if all rows after the stated number equal the last of them. Some recorders fill files this
// way.
static bool is_filling(struct lines l, double stated) {
    for (double i = 0; i < stated; i++) {
        next_row(&l);
    }
    const struct piece last = l.line;
    bool same = true;
    while (same && next_row(&l)) {
        same = l.line.n == last.n && memcmp(l.line.text, last.text, last.n) == 0;
    }
    return same;
}

static bool check_count(const struct record_reader *r, const struct lines *before, int last_line) {
    struct record_content *out = r->out;
    const size_t n = out->n;
    if ((double)n > out->npts && is_filling(*before, out->npts)) {
        out->n_filling = n - (size_t)out->npts;
    }
    if ((double)n == out->npts || out->n_filling > 0) {
        return true;
    }
    return (double)n < out->npts
               ? record_fail(r, last_line,
                             "the file ends after %zu rows; its header (line %d) says %.0f", n,
                             out->count_line, out->npts)
               : record_fail(r, out->count_line, "the header says %.0f rows; the file holds %zu",
                             out->npts, n);
}

bool channels_read(const struct record_reader *r, const struct channel_rows *rows) {
    assert(rows->column >= 0 && rows->column < rows->n_column);
    struct record_content *out = r->out;
    struct lines l = rows->from;
    int last_line = l.number;
    for (out->n = 0; next_row(&l); out->n++) {
        last_line = l.number;
    }
    if (!check_count(r, &rows->from, last_line)) {
        return false;
    }
    out->value = arena_alloc(r->arena, out->n, sizeof *out->value);
    if (!out->value) {
        return record_fail_memory(r);
    }
    l = rows->from;
    for (size_t i = 0; next_row(&l); i++) {
        if (!read_row(r, rows, &l, i)) {
            return false;
        }
        values_note_peak(out, out->value, i, l.number);
    }
    return true;
}
