// SPDX-License-Identifier: GPL-3.0-or-later
#include <string.h>

#include "model/builder.h"
#include "model/signals.h"
#include "motion/record_cache.h"

enum {
    R_FORMAT,
    R_CHANNEL,
    R_UNIT,
    R_DT,
    R_DEMEAN,
    R_SCALE,
    R_PGA,
    R_SA,
    R_PERIOD,
    R_BUILDING,
    R_DAMPING,
    R_DELAY,
    R_BUILDINGS,
    N_RECORD_ROW
};
enum { S_DELAY = SINE_ROWS, S_BUILDINGS, N_SINE_ROW };

static const struct range channel_range = {.min = 1.0, .max = 1000.0, .text = ">= 1 and <= 1000"};

static const struct row record_rows[N_RECORD_ROW] = {
    [R_FORMAT] = {"format", ROW_TEXT, 0, OF_NONE, NULL, NAN,
                  "format of the file; default: detected from its content"},
    [R_CHANNEL] = {"channel", ROW_INTEGER, 0, OF_NONE, &channel_range, NAN,
                   "number of the channel, if the file has several"},
    [R_UNIT] = {"unit", ROW_TEXT, 0, OF_NONE, NULL, NAN,
                "unit of the values, such as g, m/s2 or gal; default: that in the file"},
    [R_DT] = {"dt", ROW_NUMBER, 0, OF_TIME, &range_positive, NAN,
              "time between samples; default: that in the file"},
    [R_DEMEAN] = {"demean", ROW_FLAG, 0, OF_NONE, NULL, NAN, "subtracts the mean of the values"},
    [R_SCALE] = {"scale", ROW_NUMBER, 0, OF_NONE, NULL, 1.0,
                 "factor; a negative factor reverses the direction"},
    [R_PGA] = {"pga", ROW_NUMBER, 0, OF_ACCELERATION, &range_positive, NAN,
               "peak ground acceleration to scale to"},
    [R_SA] = {"sa", ROW_NUMBER, 0, OF_ACCELERATION, &range_positive, NAN,
              "pseudo-spectral acceleration to scale to"},
    [R_PERIOD] = {"period", ROW_NUMBER, 0, OF_TIME, &signals_period_range, NAN,
                  "period for -sa; default: the first period of a building"},
    [R_BUILDING] = {"building", ROW_TEXT, 0, OF_NONE, NULL, NAN,
                    "building that gives the period for -sa; default: the first one of -buildings"},
    [R_DAMPING] = {"damping", ROW_NUMBER, 0, OF_NONE, &signals_damping_range, 0.05,
                   "damping ratio for -sa"},
    [R_DELAY] = {"delay", ROW_NUMBER, 0, OF_TIME, &range_non_negative, 0.0,
                 "time of the first sample"},
    [R_BUILDINGS] = {"buildings", ROW_TEXTS, 0, OF_NONE, NULL, NAN,
                     "buildings on this ground; default: all"},
};

static const struct row sine_rows[N_SINE_ROW] = {
    [SINE_AMPLITUDE] = {"amplitude", ROW_NUMBER, ROW_REQUIRED, OF_ACCELERATION, NULL, NAN,
                        "peak ground acceleration"},
    SINE_SHAPE_ROWS,
    [S_DELAY] = {"delay", ROW_NUMBER, 0, OF_TIME, &range_non_negative, 0.0, "time of the start"},
    [S_BUILDINGS] = {"buildings", ROW_TEXTS, 0, OF_NONE, NULL, NAN,
                     "buildings on this ground; default: all"},
};

enum { RECORD, SINE, N_VARIANT };
static const struct statement_variant variants[N_VARIANT] = {
    [RECORD] = {"record", "acceleration from a file", record_rows, N_RECORD_ROW},
    [SINE] = {"sine", "A sin(2 pi F t + P), with t from the start", sine_rows, N_SINE_ROW},
};

// Reads the indices of the buildings in -buildings; false after a report.
static bool read_buildings(struct builder *b, const struct argument *a, struct ground_draft *g) {
    if (!a->given) {
        return true;
    }
    int *building = arena_alloc(b->arena, (size_t)a->n, sizeof *building);
    bool good = building != NULL;
    for (int i = 0; building && i < a->n; i++) {
        building[i] = builder_building(b, &a->word[i]);
        for (int k = 0; k < i && building[i] >= 0; k++) {
            if (building[k] == building[i]) {
                deck_error(b->deck, &a->word[i], "building %s is named twice", a->text[i]);
                good = false;
            }
        }
        good &= building[i] >= 0;
    }
    g->building = building;
    g->n_building = a->n;
    return good;
}

// Reads -sa and its options, after the buildings of the draft; false after a report.
static bool read_scaling(struct builder *b, const struct argument *a, struct ground_draft *g) {
    static const int for_sa[] = {R_PERIOD, R_BUILDING, R_DAMPING};
    for (size_t i = 0; !a[R_SA].given && i < sizeof for_sa / sizeof for_sa[0]; i++) {
        if (a[for_sa[i]].given) {
            return deck_error(b->deck, &a[for_sa[i]].key, "-%s is for -sa, which is not given",
                              record_rows[for_sa[i]].key);
        }
    }
    if (!a[R_SA].given) {
        return true;
    }
    if (a[R_PERIOD].given && a[R_BUILDING].given) {
        return deck_error(b->deck, &a[R_BUILDING].key, "give -period or -building, not both");
    }
    g->scaling = (struct spectral_scaling){
        .acceleration = a[R_SA].number[0],
        .period = a[R_PERIOD].given ? a[R_PERIOD].number[0] : 0.0,
        .damping = a[R_DAMPING].number[0],
        .building = g->n_building > 0 ? g->building[0] : 0,
        .word = a[R_SA].key,
    };
    if (a[R_BUILDING].given) {
        g->scaling.building = builder_building(b, &a[R_BUILDING].word[0]);
    }
    return g->scaling.building >= 0;
}

// Adds a ground motion. `record`: the arguments of a record; NULL: it is a sine.
static void append(struct builder *b, const struct statement *s, struct ground_draft g,
                   const struct argument *buildings, const struct argument *record) {
    g.word = s->word[0];
    if (read_buildings(b, buildings, &g) && (!record || read_scaling(b, record, &g))) {
        struct ground_draft *d = builder_append(b, &b->grounds, sizeof *d);
        if (d) {
            *d = g;
            signals_longest(b, &g.signal);
        }
    }
}

// The factor from the values of the file to accelerations of the deck, without -sa; false after a
// report.
static bool record_scale(struct builder *b, const struct argument *a, const struct word *file,
                         const struct record *r, double *scale) {
    *scale = a[R_SCALE].number[0] * r->unit / unit_size(&b->deck->units, dimension_acceleration);
    const struct argument *to = a[R_SA].given ? &a[R_SA] : &a[R_PGA];
    if (!to->given) {
        return true;
    }
    const char *key = a[R_SA].given ? "sa" : "pga";
    if (a[R_SCALE].given || (a[R_SA].given && a[R_PGA].given)) {
        return deck_error(b->deck, &to->key, "give -%s or -%s, not both",
                          a[R_SCALE].given ? "scale" : "pga", key);
    }
    if (r->peak == 0.0) {
        return deck_error(b->deck, file,
                          "every value of the record is 0; it cannot be scaled to a %s",
                          a[R_SA].given ? "spectral acceleration" : "PGA");
    }
    if (a[R_SA].given) {
        return true;
    }
    *scale = a[R_PGA].number[0] / r->peak;
    return true;
}

// The word of the statement that an error of the record belongs to.
static const struct word *blamed(const struct statement *s, const struct argument *a,
                                 enum record_part wrong) {
    static const int row[] = {[RECORD_CHANNEL] = R_CHANNEL,
                              [RECORD_FORMAT_NAME] = R_FORMAT,
                              [RECORD_DT] = R_DT,
                              [RECORD_UNIT] = R_UNIT};
    return wrong == RECORD_PATH ? &s->word[2] : &a[row[wrong]].word[0];
}

// Reads the record in the file `path`; false after a report.
static bool read_record(struct builder *b, const struct statement *s, const struct argument *a,
                        const char *path, struct record *r) {
    const struct record_request request = {
        .path = path,
        .format = a[R_FORMAT].given ? a[R_FORMAT].text[0] : NULL,
        .unit = a[R_UNIT].given ? a[R_UNIT].text[0] : NULL,
        .dt = a[R_DT].given ? a[R_DT].number[0] * b->deck->units.time : 0.0,
        .gravity = deck_gravity(b->deck),
        .channel = a[R_CHANNEL].given ? (int)a[R_CHANNEL].number[0] : 0,
        .demean = a[R_DEMEAN].given,
    };
    struct error e;
    if (record_cache_read(b->records, b->arena, &request, r, &e) != STATUS_OK) {
        deck_error_of(b->deck, blamed(s, a, r->wrong), &e);
        return false;
    }
    for (int i = 0; i < r->n_warning; i++) {
        deck_warning(b->deck, &s->word[2], "%s", r->warning[i]);
    }
    return true;
}

static void build_record(struct builder *b, const struct statement *s) {
    b->any_history = true;
    struct argument a[N_RECORD_ROW] = {0};
    bool good = builder_plain(b, s, 2, 2, statement_ground.usage);
    good &= deck_options(b->deck, s, &(struct row_set){record_rows, N_RECORD_ROW, a}, 1);
    const char *name = good ? deck_text_of_file(b->deck, &s->word[2]) : NULL;
    const char *path = name ? deck_file(b->deck, &s->word[2], name) : NULL;
    if (!path) {
        return;
    }
    struct record r;
    double scale;
    struct ground_draft g = {0};
    struct error e;
    if (read_record(b, s, a, path, &r) && record_scale(b, a, &s->word[2], &r, &scale) &&
        signal_init_samples(&g.signal, b->arena, r.value, r.n, r.dt / b->deck->units.time, scale,
                            a[R_DELAY].number[0], &e) == STATUS_OK) {
        g.signal.name = name;
        g.signal.mean = scale * r.mean;
        g.bare = a[R_PGA].bare || a[R_SA].bare;
        g.judged = r.large && !a[R_PGA].given && !a[R_SA].given;
        append(b, s, g, &a[R_BUILDINGS], a);
    }
}

static void build(struct builder *b, const struct statement *s) {
    if (s->n_plain < 2) {
        deck_error(b->deck, &s->word[0], "ground needs 'record' or 'sine'");
        return;
    }
    const int variant = builder_variant(b, &s->word[1], "ground motion", &statement_ground);
    if (variant == RECORD) {
        build_record(b, s);
    } else if (variant == SINE) {
        struct argument a[N_SINE_ROW] = {0};
        bool good = builder_plain(b, s, 1, 1, statement_ground.usage);
        if (deck_options(b->deck, s, &(struct row_set){sine_rows, N_SINE_ROW, a}, 1) && good) {
            const struct ground_draft g = {.signal = signals_sine(b, a, a[S_DELAY].number[0])};
            append(b, s, g, &a[S_BUILDINGS], NULL);
        }
    }
}

const struct statement_kind statement_ground = {
    .name = "ground",
    .usage = "record FILE [-format F] [-channel N] [-unit U] [-dt DT] [-demean] [-scale S | -pga A "
             "| -sa A "
             "[-period T | -building NAME] [-damping Z]] [-delay T] [-buildings NAMES] | sine "
             "-amplitude A -frequency F [-phase P] [-cycles N] [-delay T] [-buildings NAMES]",
    .summary = "ground acceleration; several statements for one building add up",
    .example = "ground record records/ELCENTRO_1940_NS.AT2 -pga 0.35g",
    .variant = variants,
    .n_variant = N_VARIANT,
    .build = build,
};
