// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/sweeps.h"

#include <string.h>

#include "core/text.h"

enum { ROOM = 62, VALUE_MAX = 64 };  // characters of the values in a line, and of one value

struct value {
    char text[VALUE_MAX];
};

static const char *value_text(struct value *v, const struct sweep *s, int i) {
    if (s->number) {
        snprintf(v->text, sizeof v->text, "%.6g", s->number[i]);
    } else {
        text_clean(v->text, sizeof v->text, s->label[i], strlen(s->label[i]));
    }
    return v->text;
}

// All values if they fit in a line, else the first ones and the last.
static void print_values(const struct sweep *s, FILE *to) {
    struct value value, last;
    value_text(&last, s, s->n - 1);
    size_t used = 0;
    for (int i = 0; i < s->n; i++) {
        used += strlen(value_text(&value, s, i)) + 1;
        if (i > 0 && i < s->n - 1 && used + strlen(last.text) + 4 > ROOM) {
            fprintf(to, " ... %s", last.text);
            return;
        }
        fprintf(to, "%s%s", i > 0 ? " " : "", value.text);
    }
}

static void print_line(const char *name, const struct sweep *s, const struct unit_system *u,
                       FILE *to) {
    char units[64] = "";
    if (s->units) {
        snprintf(units, sizeof units, "%s", s->units);
    } else if (s->number && s->known) {
        unit_text(u, s->dimension, units, sizeof units);
    }
    struct text_short t, unit;
    const char *suffix = text_short(&unit, unit_suffix(units));
    name = text_short(&t, name);
    if (s->fixed) {
        fprintf(to, "  %-16s fixed with -D: ", name);
    } else {
        fprintf(to, "  %-16s %6d value%s  ", name, s->n, s->n == 1 ? ": " : "s:");
    }
    print_values(s, to);
    fprintf(to, "%s%s\n", suffix[0] ? " " : "", suffix);
}

void sweeps_print(const struct sweep *s, const struct unit_system *u, FILE *to) {
    print_line(s->name, s, u, to);
    for (const struct sweep *p = s->along; p; p = p->along) {
        char name[32];
        snprintf(name, sizeof name, "  %s", p->name);
        print_line(name, p, u, to);
    }
}

void sweeps_print_first(const struct deck *d, const char *before, const char *after) {
    if (d->sweeps) {
        printf("%s", before);
        printf("study of %ld run%s\n", d->n_run, d->n_run == 1 ? "" : "s");
        for (const struct sweep *s = d->sweeps; s; s = s->next) {
            sweeps_print(s, &d->units, stdout);
        }
        printf("the model of the first run:\n%s", after);
    }
}
