// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/law_storey.h"

#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "law/bilateral.h"
#include "motion/time_series.h"

enum { STIFFNESS, AMPLITUDE, PERIOD, FIND, N_ROW };
enum { N_SHARED = 1 };  // rows of all laws: STIFFNESS

static const struct row rows[N_ROW] = {
    [STIFFNESS] = {"stiffness", ROW_NUMBER, ROW_REQUIRED, OF_STIFFNESS, &range_positive, NAN,
                   "initial stiffness"},
    [AMPLITUDE] = {"amplitude", ROW_NUMBER, 0, OF_LENGTH, &range_positive, NAN,
                   "largest deformation of the protocol"},
    [PERIOD] = {"period", ROW_NUMBER, 0, OF_TIME, &range_positive, NAN,
                "time of a cycle of the protocol"},
    [FIND] = {"find", ROW_TEXTS, 0, OF_NONE, NULL, NAN, "further options that --fit finds"},
};

const struct law_storey_kind law_storey_kinds[LAW_STOREY_KINDS] = {
    {"storey", "drift", "shear", OF_LENGTH, OF_FORCE, OF_STIFFNESS, "m", "N", false, false},
    {"hinge", "rotation", "moment", OF_NONE, OF_MOMENT, OF_MOMENT, "rad", "N*m", true, false},
    {"link", "lengthening", "tension", OF_LENGTH, OF_FORCE, OF_STIFFNESS, "m", "N", false, true},
};

enum { PARTS = 60, STEPS = 100, SAMPLE_STEPS = 20 };

static bool has_key(const void *of, const char *key) {
    const struct loop_law *law = of;
    return row_find(law->row, law->n_row, key) >= 0 || strcmp(key, rows[STIFFNESS].key) == 0;
}

// Which rows a fit finds: the stiffness and required numbers that are not given, and those of
// -find. False after a report.
static bool choose_found(struct deck *d, const struct statement *s, bool *found,
                         struct law_storey *out) {
    int n_find, n;
    const struct loop_law *law = &out->law;
    const struct word *find = deck_option(s, rows[FIND].key, &n_find);
    if (!deck_option(s, rows[STIFFNESS].key, &n)) {
        out->found[out->n_found++] = STOREY_FIT_STIFFNESS;
    }
    for (int r = 0; r < law->n_row; r++) {
        const bool required = law->row[r].flags & ROW_REQUIRED;
        found[r] = required && !deck_option(s, law->row[r].key, &n);
    }
    for (int i = 0; find && i < n_find; i++) {
        const int r = row_find(law->row, law->n_row, find[i].text);
        const enum row_kind kind = r >= 0 ? law->row[r].kind : ROW_TEXT;
        if (kind != ROW_NUMBER && kind != ROW_LIST) {
            return deck_error(d, &find[i], "%s has no number -%s that could be found", law->name,
                              find[i].text);
        }
        found[r] = true;
    }
    for (int r = 0; r < law->n_row; r++) {
        if (found[r]) {
            out->found[out->n_found++] = r;
        }
    }
    if (out->n_found == 0) {
        deck_error(d, &s->word[0], "all options of %s are given: --fit has nothing to find",
                   law->name);
    }
    return out->n_found > 0;
}

// Finds the law that the word names. False after a report.
static bool find_law(struct law_storeys *l, const struct word *name, struct loop_law *out) {
    struct link_law link;
    if (l->kind->links) {
        const bool found = storey_choice_find_link(l->deck, name, &link);
        if (found) {
            storey_loop_of_link(&link, out);
        }
        return found;
    }
    const struct storey_law *law = l->kind->turns ? storey_choice_find_rateless(l->deck, name)
                                                  : storey_choice_find(l->deck, name);
    if (law) {
        storey_loop_of_storey(law, out);
    }
    return law != NULL;
}

// A law of links that depends on the velocity needs the time of a cycle. False after a report.
static bool check_rate(struct law_storeys *l, const struct law_words *words, const struct word *w,
                       const struct loop_law *law) {
    if (law->rated && law->link.name && words->fit) {
        return deck_error(l->deck, w, "law %s depends on the velocity, which --fit does not know",
                          law->name);
    }
    if (law->rated && law->link.name && l->period == 0.0) {
        return deck_error(l->deck, w, "law %s depends on the velocity: give -%s, the %s", law->name,
                          rows[PERIOD].key, rows[PERIOD].doc);
    }
    return true;
}

// Reads one law; `first` is the statement of the first one, NULL for itself.
static bool read_law(struct law_storeys *l, const struct law_words *words, struct statement *s,
                     const struct statement *first, struct argument *own) {
    struct deck *d = l->deck;
    struct law_storey *at = &l->storey[l->n];
    bool found[LOOP_ROWS_MAX] = {false};
    struct row row[N_ROW], turned[LOOP_ROWS_MAX];
    if (!find_law(l, &s->word[0], &at->law) ||
        (first && s->n_word == 1 && !law_words_lend(d, first, has_key, &at->law, s)) ||
        (words->fit && !choose_found(d, s, found, at))) {
        return false;
    }
    const struct loop_law *law = &at->law;
    storey_choice_turn(law->row, law->n_row, turned);
    memcpy(row, rows, sizeof row);
    row[STIFFNESS].dimension = l->kind->of_stiffness;
    row[AMPLITUDE].dimension = l->kind->of_deformation;
    const bool dashpot = law->link.law == &bilateral_law;  // which may act without a spring
    if (words->fit || first || dashpot) {
        row[STIFFNESS].flags = 0;
    }
    const struct row_set set = {row, first ? N_SHARED : N_ROW, own};
    if (!storey_choice_read(d, s, l->kind->turns ? turned : law->row, law->n_row, &set,
                            words->fit ? found : NULL, &at->choice)) {
        return false;
    }
    if (words->fit && !first && own[PERIOD].given) {
        return deck_error(d, &own[PERIOD].key, "--fit knows no times; leave out -period");
    }
    l->period = !first && own[PERIOD].n > 0 ? own[PERIOD].number[0] : l->period;
    const struct argument *stiffness = &own[STIFFNESS];
    const bool lent = first && !words->fit && !dashpot;
    at->stiffness = stiffness->n > 0 ? stiffness->number[0] : lent ? l->storey[0].stiffness : NAN;
    l->n++;
    struct error e;
    if (!check_rate(l, words, at->choice.word, law)) {
        return false;
    }
    return words->fit ||
           storey_loop_prepare(law, at->choice.value, at->stiffness, at->constant, &e) ==
               STATUS_OK ||
           deck_error(d, at->choice.word, "%s", e.message);
}

// The targets of the protocol called `name`, or those of the file.
static int find_targets(struct law_storeys *l, const char *name, double amplitude,
                        struct error *e) {
    const struct protocol *p = NULL;
    for (int i = 0; i < n_storey_loop_protocol; i++) {
        p = strcmp(storey_loop_protocols[i].name, name) == 0 ? &storey_loop_protocols[i] : p;
    }
    l->protocol = name;
    if (p) {
        double *target = deck_array(l->deck, PROTOCOL_TARGETS_MAX, sizeof *target);
        l->target = target;
        if (isnan(amplitude)) {
            return error_set(e, STATUS_INPUT, "protocol %s needs -amplitude: %s", name,
                             rows[AMPLITUDE].doc);
        }
        if (!target) {
            return error_no_memory(e);
        }
        l->n_target = (size_t)storey_loop_targets(p, amplitude, target);
        return STATUS_OK;
    }
    const struct time_series_column column = {
        .name = l->kind->deformation, .dimension = l->kind->of_deformation, .unit = 1.0};
    int status = time_series_columns(l->deck->arena, name, &column, 1, &l->target, &l->n_target, e);
    double largest = 0.0;
    for (size_t i = 0; status == STATUS_OK && i < l->n_target; i++) {
        largest = fmax(largest, fabs(l->target[i]));
    }
    double *scaled = status == STATUS_OK && !isnan(amplitude)
                         ? deck_array(l->deck, l->n_target, sizeof *scaled)
                         : NULL;
    for (size_t i = 0; scaled && i < l->n_target; i++) {
        scaled[i] = largest > 0.0 ? l->target[i] / largest * amplitude : 0.0;
    }
    l->target = scaled ? scaled : l->target;
    return status;
}

static int read_loop(struct law_storeys *l, const char *path, struct error *e) {
    const struct time_series_column column[] = {
        {.name = "deformation", .dimension = l->kind->of_deformation, .unit = 1.0},
        {.name = "force", .dimension = l->kind->of_force, .unit = 1.0},
    };
    const double *value[2] = {0};
    const int status = time_series_columns(l->deck->arena, path, column, 2, value, &l->n_target, e);
    l->protocol = path;
    l->target = value[0];
    l->shear = value[1];
    return status;
}

static int fit(struct law_storeys *l, struct law_storey *s, struct error *e) {
    const struct storey_fit_request q = {.law = &s->law,
                                         .value = s->choice.value,
                                         .stiffness = s->stiffness,
                                         .row = s->found,
                                         .n_row = s->n_found,
                                         .n = l->n_target,
                                         .drift = l->target,
                                         .shear = l->shear};
    const int status = storey_fit_run(&q, &s->fit, e);
    if (status == STATUS_OK) {
        memcpy(s->choice.value, s->fit.value, sizeof s->choice.value);
        s->stiffness = s->fit.stiffness;
        return storey_loop_prepare(&s->law, s->choice.value, s->stiffness, s->constant, e);
    }
    return status;
}

static int run(struct law_storeys *l, struct law_storey *s, struct error *e) {
    const struct storey_path path = {.law = &s->law,
                                     .constant = s->constant,
                                     .stiffness = s->stiffness,
                                     .period = l->period,
                                     .target = l->target,
                                     .n_target = l->n_target,
                                     .n_part = l->n_part,
                                     .n_step = l->shear ? SAMPLE_STEPS : STEPS};
    s->point = deck_array(l->deck, l->n_point, sizeof *s->point);
    if (!s->point) {
        return error_no_memory(e);
    }
    storey_loop_run(&path, s->point);
    return STATUS_OK;
}

static void read_laws(struct law_storeys *l, const struct law_words *words, double *amplitude) {
    struct argument own[N_ROW] = {0};
    struct statement first = {.n_word = 0};
    struct statement s;
    bool good = true;
    for (int n = 0; good && deck_next(l->deck, &s); n++) {
        struct argument shared[N_SHARED] = {0};
        good = law_words_take_name(l->deck, &s) &&
               read_law(l, words, &s, n > 0 ? &first : NULL, n > 0 ? shared : own);
        first = n == 0 ? s : first;
    }
    *amplitude = own[AMPLITUDE].n > 0 ? own[AMPLITUDE].number[0] : NAN;
}

static int run_all(struct law_storeys *l, const struct law_storey_words *words, double amplitude,
                   struct error *e) {
    const char *name = words->protocol ? words->protocol : storey_loop_protocols[0].name;
    int status =
        words->laws.fit ? read_loop(l, words->laws.fit, e) : find_targets(l, name, amplitude, e);
    l->n_part = words->laws.fit ? 1 : PARTS;
    l->n_point = l->n_target * (size_t)l->n_part + 1;
    for (int i = 0; i < l->n && status == STATUS_OK; i++) {
        status = words->laws.fit ? fit(l, &l->storey[i], e) : STATUS_OK;
        status = status == STATUS_OK ? run(l, &l->storey[i], e) : status;
    }
    return status;
}

int law_storey_run(const struct law_storey_words *words, struct law_storeys *out) {
    size_t n_law = 0;
    struct error e;
    double amplitude = NAN;
    *out = (struct law_storeys){.kind = words->kind};
    int status = law_words_open(&words->laws, &out->deck, &n_law, &e);
    if (status == STATUS_OK) {
        out->storey = deck_array(out->deck, n_law, sizeof *out->storey);
        if (out->storey) {
            read_laws(out, &words->laws, &amplitude);
        }
        status = law_words_check(out->deck, &e);
    }
    if (status == STATUS_OK && out->storey) {
        status = run_all(out, words, amplitude, &e);
    }
    if (status != STATUS_OK) {
        law_storey_free(out);
        return command_fail(&e);
    }
    return EXIT_DONE;
}

void law_storey_free(struct law_storeys *l) {
    deck_free(l->deck);
    l->deck = NULL;
}
