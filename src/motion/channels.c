// SPDX-License-Identifier: GPL-3.0-or-later
// Files of several channels: the choice of a channel, and files in which each channel is a column.
#include "motion/channels.h"

#include <assert.h>
#include <string.h>

#include "core/arena.h"
#include "motion/values.h"

int channels_choose(const struct record_request *request, const struct record_text *t,
                    const struct channels *c, int *chosen, struct record_content *out,
                    struct error *e) {
    assert(c->n > 0 && c->n <= CHANNELS_MAX);
    const int wanted = request->channel == 0 && c->n == 1 ? 1 : request->channel;
    if (wanted > 0 && wanted <= c->n) {
        *chosen = wanted - 1;
        return STATUS_OK;
    }
    char list[400] = "";
    size_t n = 0;
    for (int i = 0; i < c->n && n < sizeof list; i++) {
        n += (size_t)snprintf(list + n, sizeof list - n, "%s%d '%s'", i ? ", " : "", i + 1,
                              lines_excerpt(c->name[i]).text);
    }
    if (request->channel == 0) {
        return lines_error(e, t->path, 0, "%d channels: %s; -channel chooses one", c->n, list);
    }
    out->wrong = RECORD_CHANNEL;
    return lines_error(e, t->path, 0, "the file has no channel %d; available: %s", request->channel,
                       list);
}

int channels_seek(const struct record_request *request, const struct record_text *t,
                  bool (*next)(struct lines *l, struct piece *name), const char *none,
                  struct lines *before, struct record_content *out, struct error *e) {
    struct channels all = {0};
    struct lines at[CHANNELS_MAX];
    struct lines l, last;
    struct piece name;
    lines_init(&l, t);
    for (last = l; next(&l, &name); last = l) {
        if (all.n == CHANNELS_MAX) {
            return lines_error(e, t->path, l.number, "more than %d channels", CHANNELS_MAX);
        }
        at[all.n] = last;
        all.name[all.n++] = name;
    }
    if (all.n == 0) {
        return lines_error(e, t->path, 0, "%s", none);
    }
    int chosen = 0;
    const int status = channels_choose(request, t, &all, &chosen, out, e);
    if (status == STATUS_OK) {
        *before = at[chosen];
    }
    return status;
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
static int read_row(const struct record_text *t, const struct channel_rows *rows,
                    const struct lines *l, size_t i, struct record_content *out, struct error *e) {
    struct piece rest = l->line;
    struct number_field f = {t, l->number, "value", i + 1, {0}};
    const size_t n = lines_count(l->line, "");
    if (n != (size_t)rows->n_column) {
        return lines_error(e, t->path, l->number, "row of %zu values; the header says %d", n,
                           rows->n_column);
    }
    int status = STATUS_OK;
    for (int c = 0; status == STATUS_OK && c < rows->n_column; c++) {
        double x;
        lines_field(&rest, "", &f.field);
        status = lines_read_number(&f, &x, e);
        if (status == STATUS_OK && rows->timed && c == 0) {
            status = values_check_time(t, l->number, i, x, out, e);
        }
        if (status == STATUS_OK && c == rows->column) {
            out->value[i] = x;
        }
    }
    return status;
}

// True if all rows after the stated number equal the last of them. Some recorders fill files this
// way.
static bool is_filling(const struct channel_rows *rows) {
    struct lines l = rows->from;
    for (double i = 0; i < rows->stated; i++) {
        next_row(&l);
    }
    const struct piece last = l.line;
    bool same = true;
    while (same && next_row(&l)) {
        same = l.line.n == last.n && memcmp(l.line.text, last.text, last.n) == 0;
    }
    return same;
}

static int check_count(const struct record_text *t, const struct channel_rows *rows, int last_line,
                       struct record_content *out, struct error *e) {
    const size_t n = out->n;
    if ((double)n > rows->stated && is_filling(rows)) {
        out->n_filling = n - (size_t)rows->stated;
        out->count_line = rows->stated_line;
    }
    if ((double)n == rows->stated || out->n_filling > 0) {
        return STATUS_OK;
    }
    return (double)n < rows->stated
               ? lines_error(e, t->path, last_line,
                             "the file ends after %zu rows; its header (line %d) says %.0f", n,
                             rows->stated_line, rows->stated)
               : lines_error(e, t->path, rows->stated_line,
                             "the header says %.0f rows; the file holds %zu", rows->stated, n);
}

int channels_read(struct arena *a, const struct record_text *t, const struct channel_rows *rows,
                  struct record_content *out, struct error *e) {
    assert(rows->column >= 0 && rows->column < rows->n_column);
    struct lines l = rows->from;
    int last_line = l.number;
    for (out->n = 0; next_row(&l); out->n++) {
        last_line = l.number;
    }
    int status = check_count(t, rows, last_line, out, e);
    if (status != STATUS_OK) {
        return status;
    }
    out->value = arena_alloc(a, out->n, sizeof *out->value);
    if (!out->value) {
        return error_no_memory(e);
    }
    l = rows->from;
    for (size_t i = 0; status == STATUS_OK && next_row(&l); i++) {
        status = read_row(t, rows, &l, i, out, e);
        if (status == STATUS_OK) {
            values_note_peak(out, out->value, i, l.number);
        }
    }
    return status;
}
