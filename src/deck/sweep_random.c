// SPDX-License-Identifier: GPL-3.0-or-later
// Random sweeps are paired. Without -as they share one dimension, named sample.
#include <math.h>
#include <string.h>

#include "core/text.h"
#include "deck/definition.h"
#include "deck/expression.h"
#include "deck/parameter.h"
#include "deck/quantity.h"
#include "deck/random.h"
#include "deck/sweep.h"

static const char default_sample[] = "sample";

enum { N, SEED, LHS, MIN, MAX, CORRELATED, AS, N_ROW };

static const struct range size_range = {
    .min = 1, .max = SWEEP_VALUES_MAX, .text = ">= 1 and <= 1e6"};

static const struct row rows[N_ROW] = {
    [N] = {"n", ROW_INTEGER, ROW_REQUIRED, {0, 0, 0}, &size_range, NAN, "number of values"},
    [SEED] = {"seed",
              ROW_INTEGER,
              ROW_REQUIRED,
              {0, 0, 0},
              &range_non_negative,
              NAN,
              "where the random numbers start: the same seed gives the same values"},
    [LHS] = {"lhs", ROW_FLAG, 0, {0, 0, 0}, NULL, NAN, "Latin hypercube"},
    [MIN] = {"min", ROW_TEXT, 0, {0, 0, 0}, NULL, NAN, "least value"},
    [MAX] = {"max", ROW_TEXT, 0, {0, 0, 0}, NULL, NAN, "largest value"},
    [CORRELATED] = {"correlated",
                    ROW_TEXTS,
                    0,
                    {0, 0, 0},
                    NULL,
                    NAN,
                    "NAME:RHO, a random sweep above and the correlation with it"},
    [AS] = {"as", ROW_TEXT, 0, {0, 0, 0}, NULL, NAN, "dimension of the paired sweeps"},
};

// A distribution that has been read.
struct law {
    const struct random_values *values;
    struct law *next;  // read before this one
};

// What a random sweep statement says.
struct request {
    const struct statement *statement;
    struct random_values values;
    struct argument argument[N_ROW];
    struct parameter first;  // the argument a; the values have its unit
};

// Reads the argument b of a distribution in which b has no dimension.
static bool read_pure(struct deck *d, const struct word *w, const char *name, struct parameter *p) {
    struct quantity_text t;
    parameter_read(d, w, p);
    if (p->kind == PARAMETER_NUMBER && p->number.known &&
        !dimension_equal(p->number.dimension, dimension_none)) {
        return deck_error(d, w, "%s is a pure number; this is %s", name,
                          quantity_describe(&d->units, p->number.dimension, &t));
    }
    if (p->kind == PARAMETER_TEXT) {
        deck_error(d, w, "%s is a number; this is a text", name);
    }
    return p->kind == PARAMETER_NUMBER;
}

// Reads `w` as a value of the same dimension as `first`. If one of the two has a unit and the other
// has none, the bare number must be 0, because any other number could be meant as a ratio.
static bool read_alike(struct deck *d, const struct word *w, struct parameter *first,
                       struct parameter *p) {
    const struct quantity before = first->number;
    if (!sweep_value(d, w, first, p)) {
        return false;
    }
    const double bare = p->number.known ? before.value : p->number.value;
    return p->number.known == before.known || bare == 0.0 ||
           deck_error(d, w, "give a unit with all values or with none");
}

static bool read_shape(struct deck *d, struct request *q) {
    const struct statement *s = q->statement;
    struct random_values *r = &q->values;
    struct parameter b;
    const char *known[8];
    for (int i = 0; i < n_random_distribution; i++) {
        known[i] = random_distributions[i]->name;
    }
    const int i = deck_keyword(d, &s->word[3], "distribution", known, n_random_distribution);
    r->distribution = i >= 0 ? random_distributions[i] : NULL;
    if (!r->distribution) {
        return false;
    }
    if (s->n_plain != 6) {
        return deck_error(d, &s->word[3], "%s is followed by %s", r->distribution->name,
                          r->distribution->arguments);
    }
    if (!sweep_value(d, &s->word[4], NULL, &q->first)) {
        return false;
    }
    if (q->first.kind == PARAMETER_TEXT) {
        return deck_error(d, &s->word[4], "a random value is a number; this is a text");
    }
    if (!(r->distribution->pure_b ? read_pure(d, &s->word[5], r->distribution->pure_b, &b)
                                  : read_alike(d, &s->word[5], &q->first, &b))) {
        return false;
    }
    r->a = q->first.number.value;
    r->b = b.number.value;
    int at;
    const char *fault = r->distribution->fault(r->a, r->b, &at);
    if (fault) {
        deck_error(d, &s->word[4 + at], "%s, not %.6g", fault, at ? r->b : r->a);
    }
    return !fault;
}

// Reads -min or -max, if given, into *limit.
static bool read_limit(struct deck *d, struct request *q, int row, double *limit) {
    const struct argument *a = &q->argument[row];
    struct parameter p;
    if (!a->given) {
        return true;
    }
    if (!q->values.distribution->score) {
        return deck_error(d, &a->key, "%s has its limits already: %s", q->values.distribution->name,
                          q->values.distribution->arguments);
    }
    if (!read_alike(d, &a->word[0], &q->first, &p)) {
        return false;
    }
    *limit = p.number.value;
    return true;
}

static bool read_limits(struct deck *d, struct request *q) {
    struct random_values *r = &q->values;
    r->min = -INFINITY;
    r->max = INFINITY;
    const bool low = read_limit(d, q, MIN, &r->min), high = read_limit(d, q, MAX, &r->max);
    if (low && high && !(r->min < r->max)) {
        return deck_error(d, &q->argument[MAX].word[0], "-max must be above -min");
    }
    return low && high;
}

// Reads NAME:RHO; the place of NAME among the parameters above, and *rho. -1 after having reported
// an error.
static int read_pair(struct deck *d, const struct request *q, int i, double *rho) {
    const struct argument *a = &q->argument[CORRELATED];
    const char *text = a->text[i], *colon = strrchr(text, ':'), *end;
    if (!colon || text_number(colon + 1, &end, rho) != TEXT_NUMBER_OK || *end != '\0') {
        deck_error(d, &a->word[i], "-correlated takes NAME:RHO, such as k:0.5");
        return -1;
    }
    if (!(fabs(*rho) < 1.0)) {
        deck_error(d, &a->word[i], "the correlation is %g; it must be > -1 and < 1", *rho);
        return -1;
    }
    const size_t n = (size_t)(colon - text);
    for (const struct random_values *r = q->values.before; r; r = r->before) {
        if (strlen(r->name) == n && memcmp(r->name, text, n) == 0) {
            if (r->n != q->values.n) {
                deck_error(d, &q->argument[N].word[0], "'%s' has %d values; give '%s' as many",
                           r->name, r->n, q->values.name);
                return -1;
            }
            return r->n_before;
        }
    }
    const struct parameter *p = parameter_find(d, text, n);
    if (p && p->kind == PARAMETER_WRONG) {
        return -1;  // its statement has been reported
    }
    deck_error(d, &a->word[i], "'%.*s' is not a random sweep above this one in the dimension '%s'",
               (int)n, text, q->values.along);
    return -1;
}

// Finds the parameters above of the same dimension, and reads the correlations with them.
static bool read_correlations(struct deck *d, struct request *q) {
    struct random_values *r = &q->values;
    const struct argument *a = &q->argument[CORRELATED];
    for (const struct law *law = d->reader->laws; law && !r->before; law = law->next) {
        r->before = strcmp(law->values->along, r->along) == 0 ? law->values : NULL;
    }
    r->n_before = r->before ? r->before->n_before + 1 : 0;
    if (!a->given) {
        return true;
    }
    double *correlation = deck_array(d, (size_t)r->n_before, sizeof *correlation);
    double *weight = deck_array(d, (size_t)r->n_before + 1, sizeof *weight);
    if (!correlation || !weight) {
        return false;
    }
    for (int i = 0; i < a->n; i++) {
        double rho;
        const int at = read_pair(d, q, i, &rho);
        if (at < 0) {
            return false;
        }
        if (correlation[at] != 0.0) {
            return deck_error(d, &a->word[i], "the correlation with this sweep is given twice");
        }
        correlation[at] = rho;
    }
    r->correlation = correlation;
    r->weight = weight;
    return random_correlate(r, correlation, weight) ||
           deck_error(d, &a->key,
                      "these correlations contradict each other: their matrix is not positive "
                      "definite");
}

static bool read_request(struct deck *d, struct request *q) {
    struct row_set set = {rows, N_ROW, q->argument};
    const bool options = deck_options(d, q->statement, &set, 1);
    if (!read_shape(d, q) || !options || !read_limits(d, q)) {
        return false;
    }
    q->values.n = (int)q->argument[N].number[0];
    q->values.seed = (int)q->argument[SEED].number[0];
    q->values.plan = q->argument[LHS].given ? RANDOM_LATIN : RANDOM_INDEPENDENT;
    return true;
}

static const double *draw(struct deck *d, const struct request *q) {
    struct error e;
    double *value = deck_array(d, (size_t)q->values.n, sizeof *value);
    if (!value) {
        return NULL;
    }
    int status = random_draw(&q->values, value, &e);
    if (status == STATUS_SYSTEM) {
        diagnostics_no_memory(&d->diagnostics);
    } else if (status != STATUS_OK) {
        deck_error_of(d, &q->statement->word[3], &e);
    }
    return status == STATUS_OK ? value : NULL;
}

// The values drawn by the first reading, or new ones; NULL after having reported an error.
static const double *values_of(struct deck *d, const struct request *q) {
    int choice;
    const struct sweep *from = sweep_bound(d, q->values.name, &choice);
    return from && from->number && from->n == q->values.n ? from->number : draw(d, q);
}

bool sweep_note_law(struct deck *d, const struct sweep *own) {
    struct law *law = own->law ? deck_array(d, 1, sizeof *law) : NULL;
    if (law) {
        *law = (struct law){own->law, d->reader->laws};
        d->reader->laws = law;
    }
    return law || !own->law;
}

bool sweep_random(struct deck *d, const struct statement *s, struct sweep *own,
                  struct bundle_request *bundle) {
    struct request q = {.statement = s, .values = {.name = own->name}};
    struct random_values *law = deck_array(d, 1, sizeof *law);
    if (!law || !read_request(d, &q) ||
        !bundle_name(d, &q.argument[AS], &s->word[2], default_sample, own, bundle)) {
        return false;
    }
    q.values.along = bundle->name.text;
    if (!read_correlations(d, &q)) {
        return false;
    }
    *law = q.values;
    own->law = law;
    if (deck_define_find(d, own->name)) {
        return sweep_take(d, own, &q.first, 1);
    }
    bundle->count = &q.argument[N].word[0];
    bundle->noun = "value";
    own->random = true;
    own->n = q.values.n;
    own->known = q.first.number.known;
    own->dimension = q.first.number.dimension;
    own->number = values_of(d, &q);
    return own->number;
}
