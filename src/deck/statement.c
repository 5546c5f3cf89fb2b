// SPDX-License-Identifier: GPL-3.0-or-later
// The statements of the language itself: title, units, gravity, param, sweep, include.
#include <stdio.h>
#include <string.h>

#include "core/text.h"
#include "deck/definition.h"
#include "deck/expression.h"
#include "deck/reader.h"
#include "deck/sweep.h"

const struct deck_statement deck_statements[] = {
    {"title", "title \"TEXT\"", "title of the analysis"},
    {"units", "units FORCE LENGTH TIME",
     "units of the deck, default N m s; the unit of mass is FORCE*TIME^2/LENGTH"},
    {"gravity", "gravity G", "acceleration of gravity; default: 9.80665 m/s^2"},
    {"param", "param NAME VALUE", "a named value; -D NAME=VALUE replaces it"},
    {"sweep", sweep_usage,
     "a parameter that takes one value after another; it replaces a param of the same name. Sweeps "
     "multiply. Sweeps with the same -as are paired, and so are random sweeps. Distributions: "
     "normal MEAN SD, lognormal MEDIAN DISPERSION, uniform LOW HIGH"},
    {"include", "include FILE", "reads another deck at this position"},
};
const int n_deck_statement = sizeof deck_statements / sizeof deck_statements[0];

// False after having reported that the statement has options, or more or fewer than `n` words.
static bool check_words(struct deck *d, const struct statement *s, int n, const char *usage) {
    if (s->n_plain < s->n_word) {
        struct text_short t;
        const struct word *option = &s->word[s->n_plain];
        return deck_error(d, option, "'%s' is not expected here; the statement is %s",
                          text_short(&t, option->text), usage);
    }
    if (s->n_word > n) {
        struct text_short t;
        return deck_error(d, &s->word[n], "'%s' is one word too many; the statement is %s",
                          text_short(&t, s->word[n].text), usage);
    }
    return s->n_word == n ||
           deck_error(d, &s->word[0], "a word is missing; the statement is %s", usage);
}

// Notes the place of a statement that may occur once; false after having reported a second one.
static bool check_once(struct deck *d, const struct word *w, struct place *place) {
    if (place->source) {
        return deck_error(d, w, "%s is already given in %s", w->text,
                          source_mention(d, place, &w->place));
    }
    *place = w->place;
    return true;
}

static void run_title(struct deck *d, const struct statement *s) {
    if (check_words(d, s, 2, "title \"TEXT\"") && check_once(d, s->word, &d->reader->title)) {
        const char *text = deck_text_of_file(d, &s->word[1]);
        d->title = text ? text : "";
    }
}

// Reads a unit of the dimension `wanted` into `size` and `name`; false after having reported an
// error.
static bool read_unit(struct deck *d, const struct word *w, struct dimension wanted,
                      const char *what, double *size, char *name) {
    const char *known[64];
    const char *end;
    struct dimension dimension;
    double si;
    int n = 0;
    bool exists = false;
    for (int i = 0; unit_names[i] && n < 64; i++) {
        unit_parse(unit_names[i], d->units.gravity, &end, &dimension, &si);
        exists = exists || strcmp(unit_names[i], w->text) == 0;
        if (dimension_equal(dimension, wanted)) {
            known[n++] = unit_names[i];
            if (strcmp(unit_names[i], w->text) == 0) {
                *size = si;
                snprintf(name, UNIT_NAME_MAX, "%s", w->text);
                return true;
            }
        }
    }
    if (!exists) {
        deck_unknown(d, w, w->text, what, known, n);
        return false;
    }
    unit_parse(w->text, d->units.gravity, &end, &dimension, &si);
    const char *noun = dimension_noun(dimension);
    return deck_error(d, w, "%s is a unit of %s; a %s is needed", w->text,
                      noun ? noun : "another kind", what);
}

static void run_units(struct deck *d, const struct statement *s) {
    const struct reader *r = d->reader;
    if (!check_words(d, s, 4, "units FORCE LENGTH TIME") ||
        !check_once(d, s->word, &d->reader->units)) {
        return;
    }
    if (r->other.source) {
        deck_error(d, s->word,
                   "units must be above all other statements except title and include; "
                   "the first is in %s",
                   source_mention(d, &r->other, &s->word->place));
        return;
    }
    struct unit_system u = d->units;
    bool force = read_unit(d, &s->word[1], dimension_force, "force unit", &u.force, u.force_name);
    bool length =
        read_unit(d, &s->word[2], dimension_length, "length unit", &u.length, u.length_name);
    bool time = read_unit(d, &s->word[3], dimension_time, "time unit", &u.time, u.time_name);
    if (force && length && time) {
        d->units = u;
    }
}

// On earth gravity is 9.764 to 9.834 m/s^2 (Hirt et al. 2013, Geophys. Res. Lett. 40, 4279-4283).
// A value outside these limits is probably not in the units of the deck [m/s^2].
static const double GRAVITY_MIN = 9.0, GRAVITY_MAX = 11.0;

static void run_gravity(struct deck *d, const struct statement *s) {
    const struct row row = {
        .key = "gravity",
        .kind = ROW_NUMBER,
        .dimension = dimension_acceleration,
        .range = &range_positive,
    };
    struct argument value;
    if (!check_words(d, s, 2, "gravity G") || !check_once(d, s->word, &d->reader->gravity) ||
        !deck_values(d, &row, 0, &s->word[1], 1, &value)) {
        return;
    }
    if (d->reader->gravity_used) {
        deck_error(d, s->word, "gravity must be above the first use of the unit g");
        return;
    }
    const double g = unit_convert(value.number[0], unit_size(&d->units, dimension_acceleration), 1);
    if (g < GRAVITY_MIN || g > GRAVITY_MAX) {
        deck_warning(d, &s->word[1], "gravity is %.4g m/s^2; is it in the units of the deck?", g);
    }
    d->units.gravity = g;
}

static void run_param(struct deck *d, const struct statement *s) {
    if (check_words(d, s, 3, "param NAME VALUE")) {
        parameter_define(d, &s->word[1], &s->word[2]);
    }
}

static bool is_same_file(const struct source *a, const struct source *b) {
    if (a->on_disk && b->on_disk) {
        return a->device == b->device && a->inode == b->inode;
    }
    return strcmp(a->name, b->name) == 0;
}

// Reads the file at `path`, unless it was read before; NULL after having reported an error.
static struct source *load(struct deck *d, const struct word *w, const char *path) {
    for (struct source *s = d->reader->source; s; s = s->next) {
        if (strcmp(s->name, path) == 0) {
            return s;
        }
    }
    char *text;
    size_t size;
    struct error e;
    int status = text_file(d->arena, path, DECK_BYTES_MAX, &text, &size, &e);
    if (status != STATUS_OK) {
        deck_error_of(d, w, &e);
        return NULL;
    }
    struct source *s = source_add(d, path, text, size);
    if (!s) {
        diagnostics_no_memory(&d->diagnostics);
    }
    return s;
}

// False after having reported why `s` cannot be read here.
static bool check_include(struct deck *d, const struct word *w, const struct source *s) {
    const struct reader *r = d->reader;
    for (int i = 0; i < r->n_frame; i++) {
        if (is_same_file(r->frame[i].source, s)) {
            struct text_short t;
            return deck_error(d, w, "%s includes itself%s", text_short(&t, s->name),
                              i + 1 < r->n_frame ? " through other decks" : "");
        }
    }
    if (r->n_frame == INCLUDE_DEPTH_MAX) {
        return deck_error(d, w, "more than %d decks include one another", INCLUDE_DEPTH_MAX);
    }
    return r->bytes + s->size <= DECK_BYTES_MAX ||
           deck_error(d, w, "the deck and its includes have more than %d bytes", DECK_BYTES_MAX);
}

static void run_include(struct deck *d, const struct statement *s) {
    const struct word *w = &s->word[1];
    const char *name = check_words(d, s, 2, "include FILE") ? deck_text(d, w) : NULL;
    struct deck_path *file = name ? deck_path_enter(d, w, name) : NULL;
    struct source *source = file ? load(d, w, file->path) : NULL;
    if (file) {
        file->included = true;
    }
    if (source) {
        source->absolute = file->absolute;
    }
    if (source && check_include(d, w, source)) {
        source_enter(d, source);
    } else {
        d->torn = true;
    }
}

// The function of each statement, in the order of deck_statements.
static void (*const runs[])(struct deck *, const struct statement *) = {
    run_title, run_units, run_gravity, run_param, sweep_run, run_include,
};
_Static_assert(sizeof runs / sizeof runs[0] == sizeof deck_statements / sizeof deck_statements[0],
               "a function for each statement");

bool statement_run(struct deck *d, const struct statement *s) {
    int i = 0;
    while (i < n_deck_statement && strcmp(deck_statements[i].name, s->word[0].text) != 0) {
        i++;
    }
    bool own = i < n_deck_statement;
    if (own) {
        runs[i](d, s);
    }
    bool before_units =
        own && (runs[i] == run_title || runs[i] == run_units || runs[i] == run_include);
    if (!before_units && !d->reader->other.source) {
        d->reader->other = s->word[0].place;
    }
    return own;
}
