// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/law_impacts.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/root.h"
#include "model/law_choice.h"

enum { M1, M2, VELOCITY, N_ROW };

static const struct row rows[N_ROW] = {
    [M1] = {"m1", ROW_NUMBER, ROW_REQUIRED, {1, -1, 2}, &range_positive, NAN, "mass of one body"},
    [M2] = {"m2", ROW_NUMBER, 0, {1, -1, 2}, &range_positive, NAN, "mass of the other body"},
    [VELOCITY] =
        {"v", ROW_NUMBER, ROW_REQUIRED, {0, 1, -1}, &range_positive, NAN, "approach velocity"},
};

// True if the option belongs to an estimate of stiffness.
static bool estimates(const char *key) {
    bool found = strcmp(key, law_choice_rows[LAW_CHOICE_K_FROM].key) == 0;
    for (int i = 0; i < n_stiffness_estimate; i++) {
        found |= row_find(stiffness_estimates[i].row, stiffness_estimates[i].n_row, key) >= 0;
    }
    return found;
}

static bool has_key(const void *context, const char *key) {
    const struct contact_law *law = context;
    return contact_law_row(law, key) >= 0 ||
           (law->exact && strcmp(key, law_choice_rows[LAW_CHOICE_CALIBRATE].key) == 0) ||
           (contact_law_row(law, "k") >= 0 && estimates(key));
}

// Numbers that were lent must mean the same to both laws.
static bool check_lent(struct deck *d, const struct law_choice *first, const struct law_choice *c) {
    for (int r = 0; r < c->law->n_row; r++) {
        const struct row *row = &c->law->row[r];
        const int at = contact_law_row(first->law, row->key);
        if (!c->given[r].given || at < 0) {
            continue;
        }
        const struct dimension wanted = row_dimension(row, law_choice_power(c));
        const struct dimension got = row_dimension(&first->law->row[at], law_choice_power(first));
        if (!dimension_equal(wanted, got)) {
            char has[64], needs[64];
            unit_text(&d->units, got, has, sizeof has);
            unit_text(&d->units, wanted, needs, sizeof needs);
            return deck_error(d, &c->given[r].key,
                              "-%s of %s is in %s, that of %s in %s: give it options of its own, "
                              "--compare \"%s -%s ...\"",
                              row->key, first->law->name, has, c->law->name, needs, c->law->name,
                              row->key);
        }
    }
    return true;
}

// True for a row that a fit finds, or one that could replace it. A peak force tells k only.
static bool is_found(const struct contact_law *law, int row, bool fits) {
    const char *key = law->row[row].key;
    if (strcmp(key, "k") == 0 || !fits || contact_law_row(law, "zeta") < 0) {
        return strcmp(key, "k") == 0;
    }
    return strcmp(key, "e") == 0 || strcmp(key, "zeta") == 0 ||
           (law->row[row].flags & ROW_ONE_OF) != 0;
}

// False after a report if the option is given.
static bool check_absent(struct deck *d, const struct statement *s, const char *key, bool fits) {
    int n;
    const struct word *given = deck_option(s, key, &n);
    if (given) {
        deck_error(d, given - 1, "%s cannot be given: --%s finds it", given[-1].text,
                   fits ? "fit" : "peak");
    }
    return !given;
}

// The law with the rows that a fit or a peak force finds taken out of what must be given.
static const struct contact_law *law_to_fit(struct deck *d, const struct statement *s,
                                            const struct contact_law *law, bool fits) {
    struct row *row = deck_array(d, (size_t)law->n_row, sizeof *row);
    struct contact_law *copy = deck_array(d, 1, sizeof *copy);
    if (!row || !copy) {
        return NULL;
    }
    memcpy(row, law->row, (size_t)law->n_row * sizeof *row);
    bool good = check_absent(d, s, law_choice_rows[LAW_CHOICE_K_FROM].key, fits);
    for (int r = 0; r < law->n_row; r++) {
        if (is_found(law, r, fits)) {
            good &= check_absent(d, s, row[r].key, fits);
            row[r].flags &= ~(unsigned)(ROW_REQUIRED | ROW_ONE_OF);
        }
    }
    memcpy(copy, law, sizeof *copy);
    copy->row = row;
    return good ? copy : NULL;
}

// A number in place of what was not given.
static bool put(struct deck *d, struct law_choice *c, const char *key, double value) {
    const int row = contact_law_row(c->law, key);
    double *number = deck_array(d, 1, sizeof *number);
    if (row >= 0 && number) {
        *number = value;
        c->given[row].number = number;
        c->given[row].n = 1;
    }
    return number;
}

static int fit(struct law_impacts *l, struct law_impact *i, struct error *e) {
    struct deck *d = l->deck;
    const struct fit_request request = {.law = i->choice.law,
                                        .value = i->value,
                                        .mass = l->mass,
                                        .velocity = l->velocity,
                                        .n = l->measured.n,
                                        .time = l->measured.time,
                                        .force = l->measured.value};
    int status = fit_run(&request, &i->fit, e);
    if (status == STATUS_OK &&
        !(put(d, &i->choice, "k", i->fit.k.value) &&
          (isnan(i->fit.zeta.value) || put(d, &i->choice, "zeta", i->fit.zeta.value)) &&
          law_choice_prepare(d, &i->choice, l->mass, &i->value, &i->constant))) {
        status = error_no_memory(e);
    }
    return status;
}

// The search for the stiffness of a peak force: over the logarithm of k, on which the logarithm of
// the force is nearly a straight line.
struct law_search {
    struct law_impacts *l;
    struct law_impact *i;
    double peak;
    int status;
    struct error *e;
};

// The logarithm of the peak force over the one that is asked for. NAN after an error.
static double excess(double log_k, void *context) {
    struct law_search *s = context;
    struct isolated_impact impact;
    if (!put(s->l->deck, &s->i->choice, "k", exp(log_k)) ||
        !law_choice_prepare(s->l->deck, &s->i->choice, s->l->mass, &s->i->value, &s->i->constant)) {
        s->status = error_set(s->e, STATUS_INPUT, "%s has no impact at k = %.6g",
                              s->i->choice.law->name, exp(log_k));
        return (double)NAN;
    }
    s->status = isolated_run(s->i->choice.law, s->i->constant, s->l->mass, s->l->velocity, NULL,
                             &impact, s->e);
    return s->status == STATUS_OK ? log(impact.peak_force / s->peak) : (double)NAN;
}

// Finds k. The force grows with k; a bracket is found by factors of 100 from that of a spring.
static int find_stiffness(struct law_impacts *l, struct law_impact *i, double peak,
                          struct error *e) {
    enum { FACTORS_MAX = 20 };
    static const double factor = 4.6051701859880918;  // ln 100
    struct law_search s = {l, i, peak, STATUS_OK, e};
    double low = 2.0 * log(peak / l->velocity) - log(l->mass), high = low;
    double at = excess(low, &s);
    const double way = at > 0.0 ? -factor : factor;
    for (int n = 0; n < FACTORS_MAX && at * way < 0.0; n++) {
        low = high;
        high += way;
        at = excess(high, &s);
    }
    if (s.status == STATUS_OK && !(at * way >= 0.0)) {
        return error_set(e, STATUS_INPUT, "no k of %s gives a peak force of %.6g N",
                         i->choice.law->name, peak);
    }
    const double root = s.status == STATUS_OK && at != 0.0
                            ? root_find(excess, &s, fmin(low, high), fmax(low, high), 1e-14)
                            : high;
    (void)excess(root, &s);
    return s.status;
}

// Reads one law; `first` is the statement of the first one, NULL for itself.
static bool read_law(struct law_impacts *l, const struct law_words *words, struct statement *s,
                     const struct statement *first, struct argument *own) {
    struct deck *d = l->deck;
    struct law_impact *i = &l->impact[l->n];
    const bool lent = first && s->n_word == 1;
    const struct contact_law *law = law_choice_find(d, &s->word[0]);
    if (!law || (lent && !law_words_lend(d, first, has_key, law, s))) {
        return false;
    }
    if (words->peak > 0.0 && contact_law_row(law, "k") < 0) {
        return deck_error(d, &s->word[0], "the law %s has no -k that --peak could find", law->name);
    }
    law = words->fit || words->peak > 0.0 ? law_to_fit(d, s, law, words->fit != NULL) : law;
    const struct row_set set = {rows, first ? 0 : N_ROW, own};
    if (!law || !law_choice_read(d, s, law, &s->word[0], &set, &i->choice) ||
        (lent && !check_lent(d, &l->impact[0].choice, &i->choice))) {
        return false;
    }
    const int e = contact_law_row(law, "e");
    i->nominal = e >= 0 && i->choice.given[e].given ? i->choice.given[e].number[0] : NAN;
    if ((words->fit || words->peak > 0.0) && !put(d, &i->choice, "k", 1.0)) {
        return false;
    }
    if (words->fit && !put(d, &i->choice, "zeta", 0.0)) {
        return false;
    }
    l->n++;
    return true;
}

// Reads all laws; what is wrong is in the deck's diagnostics.
static void read_laws(struct law_impacts *l, const struct law_words *words) {
    struct argument own[N_ROW] = {0};
    struct statement first = {.n_word = 0};
    struct statement s;
    bool good = true;
    for (int n = 0; good && deck_next(l->deck, &s); n++) {
        good =
            law_words_take_name(l->deck, &s) && read_law(l, words, &s, n > 0 ? &first : NULL, own);
        first = n == 0 ? s : first;
        if (n == 0 && good) {
            assert(own[M1].number && own[VELOCITY].number);
            l->m1 = own[M1].number[0];
            l->m2 = own[M2].n > 0 ? own[M2].number[0] : NAN;
            l->velocity = own[VELOCITY].number[0];
            l->mass = isnan(l->m2) ? l->m1 : l->m1 / (1.0 + l->m1 / l->m2);
        }
    }
    for (int i = 0; i < l->n && good; i++) {
        struct law_impact *at = &l->impact[i];
        good = law_choice_prepare(l->deck, &at->choice, l->mass, &at->value, &at->constant);
    }
}

static void count(void *context, const struct isolated_point *p) {
    (void)p;
    ++*(size_t *)context;
}

struct points {
    struct isolated_point *point;
    size_t n;
};

static void keep(void *context, const struct isolated_point *p) {
    struct points *points = context;
    points->point[points->n++] = *p;
}

// The impact, once to count its points and once to keep them.
static int run(struct law_impacts *l, struct law_impact *i, struct error *e) {
    const struct contact_law *law = i->choice.law;
    struct points points = {.n = 0};
    const struct isolated_observer counter = {.point = count, .context = &points.n};
    const struct isolated_observer keeper = {.point = keep, .context = &points};
    int status = isolated_run(law, i->constant, l->mass, l->velocity, &counter, &i->impact, e);
    if (status != STATUS_OK) {
        return status;
    }
    points.point = arena_alloc(l->deck->arena, points.n, sizeof *points.point);
    if (!points.point) {
        return error_no_memory(e);
    }
    points.n = 0;
    status = isolated_run(law, i->constant, l->mass, l->velocity, &keeper, &i->impact, e);
    i->point = points.point;
    i->n_point = points.n;
    return status;
}

static int fail(struct law_impacts *l, const struct error *e) {
    law_impacts_free(l);
    return command_fail(e);
}

int law_impacts_run(const struct law_words *words, struct law_impacts *out) {
    size_t n_law = 0;
    struct error e;
    *out = (struct law_impacts){.deck = NULL};
    if (law_words_open(words, &out->deck, &n_law, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    out->impact = deck_array(out->deck, n_law, sizeof *out->impact);
    if (out->impact) {
        read_laws(out, words);
    }
    if (law_words_check(out->deck, &e) != STATUS_OK || !out->impact) {
        return fail(out, &e);
    }
    int status = STATUS_OK;
    if (words->fit) {
        const struct time_series_column column[TIME_SERIES_COLUMNS] = {
            {.name = "time", .dimension = dimension_time, .unit = 1.0},
            {.name = "value", .dimension = dimension_force, .unit = 1.0},
        };
        status = time_series_read(out->deck->arena, words->fit, column, &out->measured, &e);
    }
    for (int i = 0; i < out->n && status == STATUS_OK; i++) {
        if (words->fit) {
            status = fit(out, &out->impact[i], &e);
        } else if (words->peak > 0.0) {
            out->found_k = true;
            status = find_stiffness(out, &out->impact[i], words->peak, &e);
        }
        if (status == STATUS_OK) {
            status = run(out, &out->impact[i], &e);
        }
    }
    return status == STATUS_OK ? EXIT_DONE : fail(out, &e);
}

void law_impacts_free(struct law_impacts *l) {
    deck_free(l->deck);
    l->deck = NULL;
}
