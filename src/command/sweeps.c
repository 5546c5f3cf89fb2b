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

void sweeps_print_line(const struct sweep *s, const char *units, FILE *to) {
    const char *suffix = unit_suffix(units);
    if (s->fixed) {
        fprintf(to, "  %-16s fixed by -D: ", s->name);
    } else {
        fprintf(to, "  %-16s %6d value%s  ", s->name, s->n, s->n == 1 ? ": " : "s:");
    }
    print_values(s, to);
    fprintf(to, "%s%s\n", suffix[0] ? " " : "", suffix);
}

void sweeps_print_along(const struct sweep *s, const struct unit_system *u, FILE *to) {
    for (const struct sweep *p = s->along; p; p = p->along) {
        char name[32], units[64] = "";
        if (p->units) {
            snprintf(units, sizeof units, "%s", p->units);
        } else if (p->known) {
            unit_text(u, p->dimension, units, sizeof units);
        }
        struct sweep shown = *p;
        snprintf(name, sizeof name, "  %s", p->name);
        shown.name = name;
        sweeps_print_line(&shown, units, to);
    }
}

static void print_all(const struct deck *d) {
    printf("study of %ld run%s\n", d->n_run, d->n_run == 1 ? "" : "s");
    for (const struct sweep *s = d->sweeps; s; s = s->next) {
        char units[64] = "";
        if (s->number && s->known) {
            unit_text(&d->units, s->dimension, units, sizeof units);
        }
        sweeps_print_line(s, units, stdout);
        sweeps_print_along(s, &d->units, stdout);
    }
}

void sweeps_print_first(const struct deck *d, const char *before, const char *after) {
    if (d->sweeps) {
        printf("%s", before);
        print_all(d);
        printf("the model of the first run:\n%s", after);
    }
}
