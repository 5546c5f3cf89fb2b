// SPDX-License-Identifier: GPL-3.0-or-later
// `ops.node(1, 0.0, 0.0)` in Python, `node 1 0.0 0.0` in Tcl.
#include "export/emit.h"

#include <assert.h>
#include <stdarg.h>
#include <string.h>

#include "core/safe.h"
#include "core/text.h"

enum { NOTE_SIZE = 1000, NUMBERS_IN_A_LINE = 8 };

static bool emit_is_tcl(const struct emitter *s) {
    return s->language == EMIT_TCL;
}

static void emit_indent(const struct emitter *s) {
    if (emit_is_tcl(s)) {
        fprintf(s->to, "%*s", 4 * s->indent, "");
    }
}

// A comment in one of the first two lines of Python may choose the encoding: the title comes later.
void emit_start(const struct emitter *s, const char *module) {
    fprintf(s->to, "# %s\n", emit_is_tcl(s) ? "OpenSees" : "OpenSeesPy");
    fprintf(s->to, emit_is_tcl(s) ? "\n" : "import %s as ops\n", module);
}

void emit_begin(const struct emitter *s, const char *name) {
    emit_indent(s);
    fprintf(s->to, emit_is_tcl(s) ? "%s" : "ops.%s(", name);
}

static void emit_separate(const struct emitter *s, int place) {
    fputs(emit_is_tcl(s) ? " " : place > 0 ? ", " : "", s->to);
}

void emit_word(const struct emitter *s, int place, const char *word) {
    emit_separate(s, place);
    fprintf(s->to, emit_is_tcl(s) ? "%s" : "\"%s\"", word);
}

void emit_whole(const struct emitter *s, int place, int value) {
    emit_separate(s, place);
    fprintf(s->to, "%d", value);
}

// A number with a point or an exponent: Python tells whole numbers from others. The sum makes 0 of
// -0, which a gap of 0 becomes in a material.
static void emit_value(const struct emitter *s, double value) {
    struct text_exact t;
    const char *text = text_exact(&t, value + 0.0);
    fprintf(s->to, strpbrk(text, ".e") ? "%s" : "%s.0", text);
}

void emit_number(const struct emitter *s, int place, double value) {
    emit_separate(s, place);
    emit_value(s, value);
}

void emit_numbers(const struct emitter *s, int place, const double *value, size_t n) {
    emit_separate(s, place);
    fputs(emit_is_tcl(s) ? "{" : "*[", s->to);
    for (size_t i = 0; i < n; i++) {
        const char *line = i > 0 && i % NUMBERS_IN_A_LINE == 0 ? "\n    " : i > 0 ? " " : "";
        fprintf(s->to, "%s%s", i > 0 && !emit_is_tcl(s) ? "," : "", line);
        emit_value(s, value[i]);
    }
    fputs(emit_is_tcl(s) ? "}" : "]", s->to);
}

void emit_end(const struct emitter *s) {
    fputs(emit_is_tcl(s) ? "\n" : ")\n", s->to);
}

void emit_put(const struct emitter *s, const char *name, const char *form, ...) {
    va_list list;
    va_start(list, form);
    emit_begin(s, name);
    for (int i = 0; form[i]; i++) {
        if (form[i] == 'w') {
            emit_word(s, i, va_arg(list, const char *));
        } else if (form[i] == 'i') {
            emit_whole(s, i, va_arg(list, int));
        } else {
            assert(form[i] == 'n');
            emit_number(s, i, va_arg(list, double));
        }
    }
    emit_end(s);
    va_end(list);
}

void emit_pattern(struct emitter *s, int tag, int series) {
    emit_begin(s, "pattern");
    emit_word(s, 0, "Plain");
    emit_whole(s, 1, tag);
    emit_whole(s, 2, series);
    fputs(emit_is_tcl(s) ? " {\n" : ")\n", s->to);
    s->indent++;
}

void emit_close(struct emitter *s) {
    s->indent--;
    fputs(emit_is_tcl(s) ? "}\n" : "", s->to);
}

void emit_must(const struct emitter *s, const char *name, int count, double value,
               const char *message) {
    fputs(emit_is_tcl(s) ? "if {[" : "if ", s->to);
    emit_begin(s, name);
    emit_whole(s, 0, count);
    emit_number(s, 1, value);
    if (emit_is_tcl(s)) {
        fprintf(s->to, "] != 0} {\n    puts stderr {%s}\n    exit 1\n}\n", message);
    } else {
        fprintf(s->to, ") != 0:\n    raise SystemExit(\"%s\")\n", message);
    }
}

void emit_note(const struct emitter *s, const char *format, ...) {
    char line[NOTE_SIZE];
    va_list list;
    assert(s->indent == 0);
    va_start(list, format);
    (void)text_compose(line, sizeof line, format, list);
    va_end(list);
    fputs("# ", s->to);
    safe_put(s->to, SAFE_COMMENT, line);
    fputc('\n', s->to);
}
