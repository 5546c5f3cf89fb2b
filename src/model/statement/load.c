// SPDX-License-Identifier: GPL-3.0-or-later
#include <gsl/gsl_math.h>

#include "model/builder.h"
#include "model/signals.h"
#include "motion/record_cache.h"

enum { H_DT, H_SCALE, N_HISTORY_ROW };

static const struct row sine_rows[SINE_ROWS] = {
    [SINE_AMPLITUDE] = {"amplitude", ROW_NUMBER, ROW_REQUIRED, OF_FORCE, NULL, NAN, "peak force"},
    SINE_SHAPE_ROWS,
};

static const struct row history_rows[N_HISTORY_ROW] = {
    [H_DT] = {"dt", ROW_NUMBER, 0, OF_TIME, &range_positive, NAN, "time between samples"},
    [H_SCALE] = {"scale", ROW_NUMBER, 0, OF_NONE, NULL, 1.0, "factor"},
};

static const struct row force_row = {"force", ROW_NUMBER, ROW_REQUIRED, OF_FORCE,
                                     NULL,    NAN,        "force"};

enum { CONSTANT, SINE, HISTORY, N_VARIANT };
static const struct statement_variant variants[N_VARIANT] = {
    [CONSTANT] = {"constant", "a constant force", NULL, 0},
    [SINE] = {"sine", "A sin(2 pi F t + P)", sine_rows, SINE_ROWS},
    [HISTORY] = {"history", "forces from a file in the format columns or series", history_rows,
                 N_HISTORY_ROW},
};

static bool read_constant(struct builder *b, const struct statement *s, struct signal *out) {
    struct argument force = {0};
    if (!builder_plain(b, s, 3, 3, "BUILDING:FLOORS constant F") ||
        !deck_options(b->deck, s, NULL, 0) ||
        !deck_values(b->deck, &force_row, 0.0, &s->word[3], 1, &force)) {
        return false;
    }
    *out = (struct signal){
        .end = INFINITY, .amplitude = force.number[0], .phase = M_PI_2, .name = "constant"};
    return true;
}

static bool read_sine(struct builder *b, const struct statement *s, struct signal *out) {
    struct argument a[SINE_ROWS] = {0};
    bool good =
        builder_plain(b, s, 2, 2, "BUILDING:FLOORS sine -amplitude A -frequency F [-phase P]");
    if (!deck_options(b->deck, s, &(struct row_set){sine_rows, SINE_ROWS, a}, 1) || !good) {
        return false;
    }
    *out = signals_sine(b, a, 0.0);
    return true;
}

static bool read_history(struct builder *b, const struct statement *s, struct signal *out) {
    b->any_history = true;
    struct argument a[N_HISTORY_ROW] = {0};
    bool good = builder_plain(b, s, 3, 3, "BUILDING:FLOORS history FILE [-dt DT] [-scale S]");
    good &= deck_options(b->deck, s, &(struct row_set){history_rows, N_HISTORY_ROW, a}, 1);
    const char *name = good ? deck_text_of_file(b->deck, &s->word[3]) : NULL;
    const char *path = name ? deck_file(b->deck, &s->word[3], name) : NULL;
    if (!path) {
        return false;
    }
    double second = b->deck->units.time;
    struct record_request request = {
        .path = path, .plain = true, .dt = a[H_DT].given ? a[H_DT].number[0] * second : 0.0};
    struct record r;
    struct error e;
    if (record_cache_read(b->records, b->arena, &request, &r, &e) != STATUS_OK) {
        deck_error_of(b->deck, r.wrong == RECORD_DT ? &a[H_DT].word[0] : &s->word[3], &e);
        return false;
    }
    if (signal_init_samples(out, b->arena, r.value, r.n, r.dt / second, a[H_SCALE].number[0], 0.0,
                            &e) != STATUS_OK) {
        return false;
    }
    out->name = name;
    return true;
}

static void append(struct builder *b, const struct statement *s, const struct selection *floors,
                   const struct signal *signal) {
    signals_longest(b, signal);
    for (int k = 0; k < floors->n_floor; k++) {
        struct load_draft *d = builder_append(b, &b->loads, sizeof *d);
        if (d) {
            *d = (struct load_draft){.building = floors->building,
                                     .floor = floors->floor[k],
                                     .word = s->word[0],
                                     .signal = *signal};
        }
    }
}

static void build(struct builder *b, const struct statement *s) {
    static bool (*const read[N_VARIANT])(struct builder *, const struct statement *,
                                         struct signal *) = {
        [CONSTANT] = read_constant, [SINE] = read_sine, [HISTORY] = read_history};
    if (s->n_plain < 3) {
        deck_error(b->deck, &s->word[0], "too few words; usage: load %s", statement_load.usage);
        return;
    }
    struct selection floors;
    bool selected = builder_select(b, &s->word[1], WALL_REFUSED, &floors);
    const int variant = builder_variant(b, &s->word[2], "load", &statement_load);
    struct signal signal;
    if (variant >= 0 && read[variant](b, s, &signal) && selected) {
        append(b, s, &floors, &signal);
    }
}

const struct statement_kind statement_load = {
    .name = "load",
    .usage = "BUILDING:FLOORS constant F | sine -amplitude A -frequency F [-phase P] [-cycles N] | "
             "history FILE [-dt DT] [-scale S]",
    .summary = "a force on floors, positive to the right, from t = 0",
    .example = "load A:8 sine -amplitude 50kN -frequency 1.2Hz -cycles 10",
    .variant = variants,
    .n_variant = N_VARIANT,
    .build = build,
};
