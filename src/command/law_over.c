// SPDX-License-Identifier: GPL-3.0-or-later
// Each value takes the place of the option in the words of the command, which are read again. So a
// value may have a unit, and -calibrate and --peak mean what they mean for one impact.
#include "command/law_over.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "command/law_print.h"
#include "core/arena.h"
#include "core/text.h"
#include "plot/pictures.h"

extern const struct command command_law;

enum { VALUES_MAX = 10000 };

// An impact of the list.
struct law_over_impact {
    const char *law;
    double value, k;  // in SI; NAN: the law has no k
    struct isolated_impact impact;
};

struct law_over {
    const struct law_over_request *q;
    struct arena *arena;
    const char *option;  // "-v", "-e", "-k"
    const char **value;  // (n_value)
    int n_value, n_law;
    struct law_over_impact *impact;  // (n_value, n_law)
    char unit[64], bodies[128];
};

static int law_over_refuse(const char *text) {
    return command_usage(&command_law,
                         "--over takes v, e or k with values, v=0.1,0.2,0.5 or v=FROM:TO:N, not "
                         "'%s'",
                         text);
}

// "FROM:TO:N" as N numbers, evenly spaced. False: the text is not a range.
static bool law_over_range(struct law_over *o, const char *text) {
    double from, to, n;
    const char *at = text;
    if (text_number(at, &at, &from) != TEXT_NUMBER_OK || *at++ != ':' ||
        text_number(at, &at, &to) != TEXT_NUMBER_OK || *at++ != ':' ||
        text_number(at, &at, &n) != TEXT_NUMBER_OK || *at != '\0' || n != floor(n) || n < 2.0 ||
        n > VALUES_MAX) {
        return false;
    }
    o->n_value = (int)n;
    o->value = arena_alloc(o->arena, (size_t)o->n_value, sizeof *o->value);
    for (int i = 0; o->value && i < o->n_value; i++) {
        struct text_exact t;
        const double x = i == o->n_value - 1 ? to : from + (to - from) * i / (n - 1.0);
        o->value[i] = arena_format(o->arena, "%s", text_exact(&t, x));
    }
    return true;
}

static int law_over_read(struct law_over *o) {
    const char *text = o->q->text;
    if (!strchr("vek", text[0]) || text[0] == '\0' || text[1] != '=' || text[2] == '\0') {
        return law_over_refuse(text);
    }
    o->option = text[0] == 'v' ? "-v" : text[0] == 'e' ? "-e" : "-k";
    char *list = arena_text(o->arena, text + 2, strlen(text + 2));
    if (!list) {
        return command_no_memory();
    }
    if (strchr(list, ':')) {
        return !law_over_range(o, list) ? law_over_refuse(text)
               : arena_failed(o->arena) ? command_no_memory()
                                        : EXIT_DONE;
    }
    o->value = arena_alloc(o->arena, strlen(list) + 1, sizeof *o->value);
    for (char *at = list; o->value && at; o->n_value++) {
        char *end = strchr(at, ',');
        if (end) {
            *end++ = '\0';
        }
        o->value[o->n_value] = at;
        if (at[0] == '\0') {
            return law_over_refuse(text);
        }
        at = end;
    }
    return o->value ? EXIT_DONE : command_no_memory();
}

// The words of the command with this value of the option, which is added where it is not given.
static struct law_words law_over_words(const struct law_over *o, const char *value,
                                       const char **word) {
    struct law_words words = o->q->words;
    int n = 0;
    bool given = false;
    for (int i = 0; i < words.n_word; i++) {
        word[n++] = words.word[i];
        if (strcmp(words.word[i], o->option) == 0 && i + 1 < words.n_word) {
            word[n++] = value;
            given = true;
            i++;
        }
    }
    if (!given) {
        word[n++] = o->option;
        word[n++] = value;
    }
    words.word = word;
    words.n_word = n;
    return words;
}

// The value of a row of the law; NAN: it has none.
static double law_over_row(const struct law_impact *i, const char *key) {
    const int row = contact_law_row(i->choice.law, key);
    return row >= 0 ? i->value[row] : (double)NAN;
}

// The unit of the values: of k that of the first law.
static void law_over_unit(struct law_over *o, const struct law_impacts *l) {
    struct unit_system si;
    unit_system_init(&si);
    const struct law_choice *c = &l->impact[0].choice;
    const int row = contact_law_row(c->law, "k");
    if (o->option[1] == 'v') {
        snprintf(o->unit, sizeof o->unit, "m/s");
    } else if (o->option[1] == 'k' && row >= 0) {
        unit_text(&si, row_dimension(&c->law->row[row], law_choice_power(c)), o->unit,
                  sizeof o->unit);
    }
}

static int law_over_take(struct law_over *o, int at, const struct law_impacts *l) {
    if (!o->impact) {
        o->n_law = l->n;
        o->impact = arena_alloc(o->arena, (size_t)o->n_value * (size_t)l->n, sizeof *o->impact);
        if (!o->impact) {
            return command_no_memory();
        }
        law_print_bodies(l, o->bodies, sizeof o->bodies);
        law_over_unit(o, l);
    }
    for (int i = 0; i < l->n; i++) {
        const struct law_impact *from = &l->impact[i];
        const char key = o->option[1];
        o->impact[at * l->n + i] =
            (struct law_over_impact){.law = from->choice.law->name,
                                     .value = key == 'v'   ? l->velocity
                                              : key == 'e' ? from->nominal
                                                           : law_over_row(from, "k"),
                                     .k = law_over_row(from, "k"),
                                     .impact = from->impact};
    }
    return EXIT_DONE;
}

static int law_over_run_all(struct law_over *o) {
    const char **word = arena_alloc(o->arena, (size_t)o->q->words.n_word + 2, sizeof *word);
    int status = word ? EXIT_DONE : command_no_memory();
    for (int i = 0; status == EXIT_DONE && i < o->n_value; i++) {
        const struct law_words words = law_over_words(o, o->value[i], word);
        struct law_impacts l;
        status = law_impacts_run(&words, &l);
        if (status == EXIT_DONE) {
            status = law_over_take(o, i, &l);
            law_impacts_free(&l);
        }
    }
    return status;
}

static int law_over_print(const struct law_over *o) {
    const char *name = o->option + 1, *unit = o->unit[0] ? o->unit : NULL;
    const struct printer_column columns[] = {
        {"law", "law", NULL, NULL, -20, 0, LOOK_TAIL},
        {name, name, unit, NULL, 12, 6, LOOK_G},
        {name[0] == 'k' ? NULL : "k", name[0] == 'k' ? NULL : "k", "SI", NULL, 12, 6, LOOK_G},
        {"peak force", "peak_force", "N", NULL, 12, 6, LOOK_G},
        {"duration", "duration", "s", NULL, 11, 5, LOOK_G},
        {"penetration", "max_penetration", "m", NULL, 12, 5, LOOK_G},
        {"restitution", "restitution", NULL, NULL, 12, 6, LOOK_G},
        {NULL, "dissipated", "N*m", NULL, 0, 0, LOOK_G}};
    struct printer t = {.to = stdout, .form = o->q->form, .at_head = UNITS_BELOW_BARE};
    PRINTER_ADD(&t, columns);
    printer_head(&t);
    for (int law = 0; law < o->n_law; law++) {
        for (int i = 0; i < o->n_value; i++) {
            const struct law_over_impact *x = &o->impact[i * o->n_law + law];
            printer_text(&t, x->law);
            printer_number(&t, x->value);
            printer_number(&t, x->k);
            printer_numbers(&t,
                            (const double[]){x->impact.peak_force, x->impact.duration,
                                             x->impact.max_penetration, x->impact.restitution,
                                             x->impact.dissipated},
                            5);
            printer_line(&t);
        }
    }
    return printer_close(&t);
}

static int law_over_draw(void *context, const struct figure_files *to, struct error *e) {
    const struct law_over *o = context;
    struct force_curve curve[IMPACT_FIGURE_CURVES];
    const size_t n = (size_t)o->n_value;
    double *x = arena_alloc(o->arena, n * (size_t)o->n_law, sizeof *x);
    double *y = arena_alloc(o->arena, n * (size_t)o->n_law, sizeof *y);
    if (!x || !y) {
        return error_no_memory(e);
    }
    for (int law = 0; law < o->n_law; law++) {
        curve[law] =
            (struct force_curve){o->impact[law].law, n, x + n * (size_t)law, y + n * (size_t)law};
        for (size_t i = 0; i < n; i++) {
            const struct law_over_impact *at = &o->impact[i * (size_t)o->n_law + (size_t)law];
            x[n * (size_t)law + i] = at->value;
            y[n * (size_t)law + i] = at->impact.peak_force;
        }
    }
    const char key = o->option[1];
    const struct force_figure f = {.subtitle = key == 'v' ? "two bodies" : o->bodies,
                                   .version = JOSTLE_VERSION,
                                   .name = key == 'v'   ? "closing velocity v"
                                           : key == 'e' ? "coefficient of restitution e"
                                                        : "impact stiffness k",
                                   .unit = o->unit,
                                   .logarithmic = key == 'k',
                                   .n_curve = o->n_law,
                                   .curve = curve};
    return impact_figure_write_forces(&f, to, e);
}

int law_over_run(const struct law_over_request *q) {
    struct law_over o = {.q = q, .arena = arena_create(), .option = "-v"};
    struct error e;
    int status = o.arena ? law_over_read(&o) : command_no_memory();
    status = status == EXIT_DONE ? law_over_run_all(&o) : status;
    if (status == EXIT_DONE && picture_is_wanted(&q->picture)) {
        const struct picture_request picture = {
            .options = q->picture, .name = "over", .write = law_over_draw, .context = &o};
        if (o.n_law > IMPACT_FIGURE_CURVES) {
            status = command_usage(&command_law, "a picture shows at most %d laws",
                                   IMPACT_FIGURE_CURVES);
        } else if (picture_make(&picture, &e) != STATUS_OK) {
            status = command_fail(&e);
        }
    }
    status = status == EXIT_DONE ? law_over_print(&o) : status;
    arena_free(o.arena);
    return status;
}
