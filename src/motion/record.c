// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a record: reads the file as text, finds its format, reads its values and checks them.
#include "jostle/record.h"

#include <assert.h>
#include <stdarg.h>
#include <string.h>

#include "core/arena.h"
#include "core/text.h"
#include "motion/record_format.h"

// A day at 200 samples per second with 15 bytes each.
enum { FILE_SIZE_MAX = 256 << 20 };

#define RECORD_FORMAT(name) extern const struct record_format record_##name;
#include "motion/record_list.inc"
#undef RECORD_FORMAT

#define RECORD_FORMAT(name) &record_##name,
const struct record_format *const record_formats[] = {
#include "motion/record_list.inc"
};
#undef RECORD_FORMAT

enum { N_FORMAT = sizeof record_formats / sizeof record_formats[0] };
const int n_record_format = N_FORMAT;

// The format called `name`; NULL after having set the error.
static const struct record_format *find_by_name(const struct record_text *t, const char *name,
                                                struct error *e) {
    const char *names[N_FORMAT];
    char list[256];
    for (int i = 0; i < N_FORMAT; i++) {
        names[i] = record_formats[i]->name;
        if (strcmp(names[i], name) == 0) {
            return record_formats[i];
        }
    }
    const char *near = text_nearest(name, names, N_FORMAT);
    struct excerpt shown = lines_excerpt((struct piece){name, strlen(name)});
    lines_error(e, t->path, 0, "unknown record format '%s'%s%s%s; available: %s", shown.text,
                near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "",
                text_list(list, sizeof list, names, N_FORMAT));
    return NULL;
}

int record_text_open(const char *path, size_t limit, struct record_text *out,
                     struct arena **scratch, struct error *e) {
    *out = (struct record_text){.path = path};
    *scratch = arena_create();
    if (!*scratch) {
        return error_no_memory(e);
    }
    char *text;
    const int status = text_file(*scratch, path, limit, &text, &out->size, e);
    if (status != STATUS_OK) {
        arena_free(*scratch);
        return status;
    }
    out->text = text;
    return STATUS_OK;
}

bool record_fail(const struct record_reader *r, int line, const char *format, ...) {
    char cause[sizeof r->e->message];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(cause, sizeof cause, format, arguments);
    va_end(arguments);
    lines_error(r->e, r->text->path, line, "%s", cause);
    return false;
}

bool record_fail_memory(const struct record_reader *r) {
    error_no_memory(r->e);
    return false;
}

bool record_number(const struct record_reader *r, const struct number_field *f, double *value) {
    return lines_read_number(f, value, r->e) == STATUS_OK;
}

bool record_has_mark(const struct record_text *t, const char *mark, int n_line) {
    struct lines l;
    lines_init(&l, t);
    while (l.number < n_line && lines_next(&l)) {
        if (lines_contain(l.line, mark)) {
            return true;
        }
    }
    return false;
}

// The first format that accepts the text.
static const struct record_format *first_match(const struct record_request *request,
                                               const struct record_text *t, bool certain) {
    for (int i = 0; i < N_FORMAT; i++) {
        const struct record_format *f = record_formats[i];
        const bool allowed = f->certain == certain && (f->plain || !request->plain);
        if (allowed && (f->mark ? record_has_mark(t, f->mark, f->mark_lines) : f->matches(t))) {
            return f;
        }
    }
    return NULL;
}

// The first format that accepts the text; NULL after having set the error.
static const struct record_format *find_by_content(const struct record_request *request,
                                                   const struct record_text *t, struct error *e) {
    const struct record_format *f = first_match(request, t, true);
    if (f) {
        return f;
    }
    const char *foreign = foreign_format(t);
    if (foreign) {
        lines_error(e, t->path, 0, "looks like format %s, which cannot be read yet", foreign);
        return NULL;
    }
    f = first_match(request, t, false);
    if (f) {
        return f;
    }
    lines_error(e, t->path, 0,
                "unknown record format: no header with NPTS and DT, no line of "
                "numbers");
    return NULL;
}

static const struct record_format *find_format(const struct record_request *request,
                                               const struct record_text *t, struct error *e) {
    if (!request->format) {
        return find_by_content(request, t, e);
    }
    const struct record_format *f = find_by_name(t, request->format, e);
    if (f && request->plain && !f->plain) {
        lines_error(e, t->path, 0, "format %s holds accelerations only", f->name);
        return NULL;
    }
    return f;
}

static bool is_control(char c) {
    return c == 0x7f || ((unsigned char)c < 0x20 && (c < '\t' || c > '\r'));
}

int record_clean(const struct record_text *t, struct record_text *out, struct error *e) {
    *out = *t;
    if (out->size >= 3 && memcmp(out->text, "\xef\xbb\xbf", 3) == 0) {
        out->text += 3;
        out->size -= 3;
    }
    size_t end = out->size;
    while (end > 0 && strchr(" \t\r\n\x1a", out->text[end - 1]) && out->text[end - 1] != '\0') {
        end--;
        out->size = out->text[end] == '\x1a' ? end : out->size;
    }
    // The file must be text. Headers may have bytes that are not UTF-8, but no control characters.
    if (out->size == 0) {
        return lines_error(e, out->path, 0, "the file is empty");
    }
    const char *what = foreign_file(out);
    if (what) {
        return lines_error(e, out->path, 0, "this is %s, not a record", what);
    }
    unsigned found = 0;
    for (size_t i = 0; i < out->size; i++) {
        found |= is_control(out->text[i]);
    }
    for (size_t i = 0; found && i < out->size; i++) {
        if (is_control(out->text[i])) {
            return lines_error(e, out->path, 0, "this is not text: byte 0x%02x at offset %zu",
                               (unsigned)(unsigned char)out->text[i], i);
        }
    }
    return STATUS_OK;
}

int record_read_text(struct arena *a, const struct record_request *request,
                     const struct record_text *t, struct record *out, struct error *e) {
    assert(a && request && t && out);
    *out = (struct record){0};
    struct record_text stripped;
    int status = record_clean(t, &stripped, e);
    if (status) {
        return status;
    }
    const struct record_format *f = find_format(request, &stripped, e);
    if (!f) {
        out->wrong = request->format ? RECORD_FORMAT_NAME : RECORD_PATH;
        return STATUS_INPUT;
    }
    if (request->channel > 0 && !f->channels) {
        out->wrong = RECORD_CHANNEL;
        return lines_error(e, t->path, 0, "a file of format %s has one channel; remove -channel",
                           f->name);
    }
    struct record_content content = {0};
    const struct record_reader reader = {a, request, &stripped, &content, e};
    if (!f->read(&reader)) {
        out->wrong = content.wrong;
        return e->status;
    }
    out->format = f->name;
    return record_check(&reader, out) ? STATUS_OK : e->status;
}

int record_read(struct arena *a, const struct record_request *request, struct record *out,
                struct error *e) {
    assert(a && request && out);
    *out = (struct record){.wrong = RECORD_PATH};
    struct record_text t;
    struct arena *scratch;
    int status = record_text_open(request->path, FILE_SIZE_MAX, &t, &scratch, e);
    if (status == STATUS_OK) {
        status = record_read_text(a, request, &t, out, e);
        arena_free(scratch);
    }
    return status;
}
