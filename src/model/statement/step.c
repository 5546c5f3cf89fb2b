// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/builder.h"

enum { TOLERANCE, LONGEST, SHORTEST, N_ROW };

static const struct row dt_row = {"step",          ROW_NUMBER, ROW_REQUIRED, OF_TIME,
                                  &range_positive, NAN,        "time step"};

// At the smallest tolerance the error of a step is as small as its rounding error.
static const struct range tolerance_range = {
    .min = 1e-13, .max = 1e-2, .text = ">= 1e-13 and <= 0.01"};

static const struct row adaptive_rows[N_ROW] = {
    [TOLERANCE] = {"tolerance", ROW_NUMBER, 0, OF_NONE, &tolerance_range, 1e-6,
                   "error of a step, relative to the largest displacement and velocity so far"},
    [LONGEST] = {"max", ROW_NUMBER, 0, OF_TIME, &range_positive, NAN,
                 "longest step; default: no limit"},
    [SHORTEST] =
        {"min", ROW_NUMBER, 0, OF_TIME, &range_positive, NAN,
         "shortest step: a run that needs a shorter one ends with an error; default: no limit"},
};

enum { FIXED, ADAPTIVE, N_VARIANT };
static const struct statement_variant variants[N_VARIANT] = {
    [FIXED] = {"fixed",
               "steps of DT; the last one is shorter if the duration is not a multiple of DT", NULL,
               0},
    [ADAPTIVE] = {"adaptive", "steps as long as the tolerance allows; they end at impacts",
                  adaptive_rows, N_ROW},
};

static void build(struct builder *b, const struct statement *s) {
    if (!builder_once(b, &b->step, s) || !builder_plain(b, s, 1, 2, statement_step.usage)) {
        return;
    }
    const char *word = s->word[1].text;
    if ((word[0] >= '0' && word[0] <= '9') || word[0] == '$') {
        deck_error(b->deck, &s->word[1], "step needs its kind; write: step fixed %s", word);
        return;
    }
    const int variant = builder_variant(b, &s->word[1], "kind of step", &statement_step);
    if (variant == FIXED) {
        struct argument dt = {0};
        if (builder_plain(b, s, 2, 2, statement_step.usage) && deck_options(b->deck, s, NULL, 0) &&
            deck_values(b->deck, &dt_row, 0.0, &s->word[2], 1, &dt)) {
            b->dt = dt.number[0];
        }
    } else if (variant == ADAPTIVE) {
        struct argument a[N_ROW] = {0};
        if (builder_plain(b, s, 1, 1, statement_step.usage) &&
            deck_options(b->deck, s, &(struct row_set){adaptive_rows, N_ROW, a}, 1)) {
            b->adaptive = true;
            b->control = (struct step_control){
                .tolerance = a[TOLERANCE].number[0],
                .longest = a[LONGEST].given ? a[LONGEST].number[0] : INFINITY,
                .shortest = a[SHORTEST].given ? a[SHORTEST].number[0] : 0.0,
            };
            if (b->control.shortest > b->control.longest) {
                const char *unit = b->deck->units.time_name;
                deck_error(b->deck, &a[SHORTEST].key,
                           "-min is %.6g %s; it must be <= -max, %.6g %s", b->control.shortest,
                           unit, b->control.longest, unit);
            }
        }
    }
}

const struct statement_kind statement_step = {
    .name = "step",
    .usage = "fixed DT | adaptive [-tolerance T] [-max DT] [-min DT]",
    .summary = "time steps",
    .example = "step fixed 0.5ms",
    .variant = variants,
    .n_variant = N_VARIANT,
    .build = build,
};
