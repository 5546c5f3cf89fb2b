// SPDX-License-Identifier: GPL-3.0-or-later
// Bearings below a storey: friction pendulums, flat sliders, lead and rubber.
#include "model/isolator.h"
#include "deck/reader.h"
#include "model/builder.h"
#include "model/storey_choice.h"

enum { MU, MU_SLOW, RATE, WEIGHT, YIELD_DRIFT, N_SLIDING_ROW, RADIUS = N_SLIDING_ROW, N_FPS_ROW };
enum { Q, KD, KI, N_LRB_ROW };

#define SLIDING_ROWS                                                                               \
    [MU] = ROW_OF("mu", ROW_NUMBER, ROW_REQUIRED, OF_NONE, &range_positive, NAN,                   \
                  "coefficient of friction when it slides fast"),                                  \
    [MU_SLOW] = ROW_OF("mu-slow", ROW_NUMBER, 0, OF_NONE, &range_positive, NAN,                    \
                       "coefficient of friction when it slides slowly; mu if not given"),          \
    [RATE] = ROW_OF("rate", ROW_NUMBER, 0, OF_PER_VELOCITY, &range_positive, NAN,                  \
                    "a, how fast the friction grows with the velocity; with -mu-slow"),            \
    [WEIGHT] =                                                                                     \
        ROW_OF("weight", ROW_NUMBER, 0, OF_FORCE, &range_positive, NAN,                            \
               "weight on all bearings; that of the floors above if not given, or of pdelta"),     \
    [YIELD_DRIFT] = ROW_OF("yield-drift", ROW_NUMBER, 0, OF_LENGTH, &range_positive, 0.5e-3,       \
                           "drift at which it begins to slide with mu, for the initial stiffness")

static const struct row fps_rows[N_FPS_ROW] = {
    SLIDING_ROWS,
    [RADIUS] = ROW_OF("radius", ROW_NUMBER, ROW_REQUIRED, OF_LENGTH, &range_positive, NAN,
                      "radius of the surface, for the pendulum's stiffness, weight over radius"),
};
static const struct row sliding_rows[N_SLIDING_ROW] = {SLIDING_ROWS};
static const struct row lrb_rows[N_LRB_ROW] = {
    [Q] = ROW_OF("q", ROW_NUMBER, ROW_REQUIRED, OF_FORCE, &range_positive, NAN,
                 "strength: the force at drift 0 of a loop"),
    [KD] = ROW_OF("kd", ROW_NUMBER, ROW_REQUIRED, OF_STIFFNESS, &range_positive, NAN,
                  "stiffness after yield"),
    [KI] = ROW_OF("ki", ROW_NUMBER, 0, OF_STIFFNESS, &range_positive, NAN,
                  "initial stiffness; 10 kd if not given"),
};

enum { FPS, SLIDING, LRB, N_VARIANT };
static const struct statement_variant variants[N_VARIANT] = {
    [FPS] = {"fps", "friction pendulum, on a surface of a radius", fps_rows, N_FPS_ROW},
    [SLIDING] = {"sliding", "flat slider", sliding_rows, N_SLIDING_ROW},
    [LRB] = {"lrb", "rubber with a lead core", lrb_rows, N_LRB_ROW},
};

static double number_of(const struct argument *a) {
    return a->n > 0 ? a->number[0] : (double)NAN;
}

static void take(struct isolator_draft *q, int kind, const struct argument *a) {
    if (kind == LRB) {
        q->q = number_of(&a[Q]);
        q->kd = number_of(&a[KD]);
        q->ki = number_of(&a[KI]);
        return;
    }
    q->slides = true;
    q->radius = kind == FPS ? number_of(&a[RADIUS]) : (double)NAN;
    q->mu = number_of(&a[MU]);
    q->mu_slow = number_of(&a[MU_SLOW]);
    q->rate = number_of(&a[RATE]);
    q->weight = number_of(&a[WEIGHT]);
    q->yield_drift = number_of(&a[YIELD_DRIFT]);
}

// Reports values of the bearing that do not go together; true if there are none.
static bool is_possible(struct builder *b, int kind, const struct argument *a) {
    if (kind == LRB && a[KI].given && a[KI].number[0] <= a[KD].number[0]) {
        return deck_error(b->deck, a[KI].word, "ki is %g; it must be > kd, which is %g",
                          a[KI].number[0], a[KD].number[0]);
    }
    return true;
}

static void build(struct builder *b, const struct statement *s) {
    if (!builder_plain(b, s, 2, 2, statement_isolator.usage)) {
        return;
    }
    struct selection storey;
    const bool selected = builder_select(b, &s->word[1], WALL_REFUSED, &storey);
    const int kind = builder_variant(b, &s->word[2], "isolator", &statement_isolator);
    struct argument a[N_FPS_ROW] = {0};
    if (kind < 0 ||
        !deck_options(b->deck, s, &(struct row_set){variants[kind].row, variants[kind].n_row, a},
                      1) ||
        !selected || !is_possible(b, kind, a)) {
        return;
    }
    struct building_draft *d = builder_draft(b, storey.building);
    if (storey.n_floor != 1) {
        deck_error(b->deck, &s->word[1], "an isolator is one storey; write %s:1", d->name);
        return;
    }
    const int i = storey.floor[0] - 1;
    if (!d->storey || !storey_choices_take(b, d, i, s) ||
        !storey_choices_isolate(b, d, i, &s->word[1])) {
        return;
    }
    d->any_stiffness |= d->n_floor == 1;
    struct isolator_draft *q = builder_append(b, &b->isolators, sizeof *q);
    if (q) {
        *q = (struct isolator_draft){.building = storey.building, .storey = i, .word = s->word[2]};
        take(q, kind, a);
    }
}

const struct statement_kind statement_isolator = {
    .name = "isolator",
    .usage = "NAME:STOREY fps -radius R -mu MU [-mu-slow M -rate A] [-weight W] [-yield-drift D] | "
             "sliding -mu MU [-mu-slow M -rate A] [-weight W] [-yield-drift D] | lrb -q Q -kd K "
             "[-ki K]",
    .summary = "bearings as the storey below a floor, all together: its law and initial stiffness",
    .example = "isolator A:1 fps -radius 2m -mu 6% -mu-slow 3% -rate 30s/m",
    .variant = variants,
    .n_variant = N_VARIANT,
    .build = build,
};
