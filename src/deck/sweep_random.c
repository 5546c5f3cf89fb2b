// SPDX-License-Identifier: GPL-3.0-or-later
// Random sweeps of a deck are sampled together: value i of each belongs to run i of their sample,
// which is one dimension of the study, a sweep over the numbers 1 ... N.
#include "deck/sweep_random.h"

#include <math.h>
#include <string.h>

#include "deck/random.h"

static const char default_sample[] = "sample";

// A sample and the place of the first of its random sweeps.
struct sampling {
    struct sweep *sweep;
    const struct sweep *bound;  // the same in the bound deck; NULL: none
    struct sweep *last;         // along it
    int n;                      // values, although -D may choose one
    int choice;                 // from 0, of this run
    bool sound;                 // false: what is wrong with it has been reported
    struct place place;
    struct sampling *next;
};

enum { N, SEED, LHS, MIN, MAX, AS, N_ROW };

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
    [AS] = {"as", ROW_TEXT, 0, {0, 0, 0}, NULL, NAN, "name of the sample"},
};

// The statement as read.
struct request {
    const struct statement *statement;
    struct random_values values;
    struct argument argument[N_ROW];
    struct word sample;      // its name, where messages about it point
    struct parameter first;  // a, whose unit is that of the values
};

static const struct distribution *find_distribution(struct deck *d, const struct word *w) {
    const char *known[8];
    for (int i = 0; i < n_random_distribution; i++) {
        known[i] = random_distributions[i]->name;
    }
    const int i = deck_keyword(d, w, "distribution", known, n_random_distribution);
    return i >= 0 ? random_distributions[i] : NULL;
}

// b where it has no dimension.
static bool read_pure(struct deck *d, const struct word *w, const char *name, struct parameter *p) {
    struct quantity_text t;
    parameter_read(d, w, p);
    if (p->kind == PARAMETER_NUMBER && p->number.known &&
        !dimension_equal(p->number.dimension, dimension_none)) {
        deck_error(d, w, "%s is a pure number; this is %s", name,
                   quantity_describe(&d->units, p->number.dimension, &t));
        return false;
    }
    if (p->kind == PARAMETER_TEXT) {
        deck_error(d, w, "%s is a number; this is a text", name);
    }
    return p->kind == PARAMETER_NUMBER;
}

// Reads `w` as a value beside `first`. A bare one beside one with a unit could be meant as a share
// of it; only a bare 0 cannot.
static bool read_alike(struct deck *d, const struct word *w, struct parameter *first,
                       struct parameter *p) {
    const struct quantity before = first->number;
    if (!sweep_value(d, w, first, p)) {
        return false;
    }
    const double bare = p->number.known ? before.value : p->number.value;
    if (p->number.known != before.known && bare != 0.0) {
        deck_error(d, w, "either all values have a unit or none has");
        return false;
    }
    return true;
}

static bool read_shape(struct deck *d, struct request *q) {
    const struct statement *s = q->statement;
    struct random_values *r = &q->values;
    struct parameter b;
    r->distribution = find_distribution(d, &s->word[3]);
    if (!r->distribution) {
        return false;
    }
    if (s->n_plain != 6) {
        deck_error(d, &s->word[3], "%s is followed by %s", r->distribution->name,
                   r->distribution->arguments);
        return false;
    }
    if (!sweep_value(d, &s->word[4], NULL, &q->first)) {
        return false;
    }
    if (q->first.kind == PARAMETER_TEXT) {
        deck_error(d, &s->word[4], "a random value is a number; this is a text");
        return false;
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

// -min or -max.
static bool read_limit(struct deck *d, struct request *q, int row, double *limit) {
    const struct argument *a = &q->argument[row];
    struct parameter p;
    if (!a->given) {
        return true;
    }
    if (!q->values.distribution->score) {
        deck_error(d, &a->key, "%s has its limits already: %s", q->values.distribution->name,
                   q->values.distribution->arguments);
        return false;
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
        deck_error(d, &q->argument[MAX].word[0], "-max must be above -min");
        return false;
    }
    return low && high;
}

static bool read_sample(struct deck *d, struct request *q) {
    const struct argument *as = &q->argument[AS];
    q->sample = as->given ? as->word[0] : q->statement->word[2];
    q->sample.text = as->given ? as->text[0] : default_sample;
    if (strcmp(q->sample.text, q->values.name) == 0) {
        deck_error(d, &q->sample, "a sample needs another name than its parameters; -as gives it");
        return false;
    }
    return true;
}

static bool read_request(struct deck *d, struct request *q) {
    struct row_set set = {rows, N_ROW, q->argument};
    d->reader->swept = false;
    const bool options = deck_options(d, q->statement, &set, 1);
    if (!read_shape(d, q) || !options || !read_limits(d, q) || !read_sample(d, q)) {
        return false;
    }
    if (d->reader->swept) {
        deck_error(d, &q->statement->word[2],
                   "the values of a sweep cannot depend on a swept parameter");
        return false;
    }
    q->values.n = (int)q->argument[N].number[0];
    q->values.seed = (int)q->argument[SEED].number[0];
    q->values.plan = q->argument[LHS].given ? RANDOM_LATIN : RANDOM_INDEPENDENT;
    return true;
}

// Defines the parameter that numbers the sample and decides which number it has in this run.
static bool number_sample(struct deck *d, const struct request *q, struct sampling *of) {
    const struct define *define = define_find(d, q->sample.text);
    of->bound = sweep_bound(d, q->sample.text, &of->choice);
    struct parameter p = {.kind = PARAMETER_NUMBER, .swept = true, .used = true};
    p.number = (struct quantity){of->choice + 1, true, dimension_none};
    if (!parameter_keep(d, &q->sample, BY_SAMPLE, &p)) {
        return true;
    }
    const double x = p.kind == PARAMETER_NUMBER ? p.number.value : 1.0;
    if (!(x >= 1.0 && x <= of->n && x == floor(x))) {
        deck_error(d, &define->value, "'%s' is numbered from 1 to %d", q->sample.text, of->n);
        return false;
    }
    of->choice = (int)x - 1;
    sweep_fix(d, &p, of->sweep);
    return p.kind == PARAMETER_NUMBER;
}

// Begins a sample, which stays in the list where it is wrong; NULL: no memory.
static struct sampling *begin_sampling(struct deck *d, const struct request *q) {
    const int n = q->values.n;
    struct sampling *of = deck_array(d, 1, sizeof *of);
    struct sweep *sweep = deck_array(d, 1, sizeof *sweep);
    double *number = deck_array(d, (size_t)n, sizeof *number);
    if (!of || !sweep || !number) {
        return NULL;
    }
    for (int i = 0; i < n; i++) {
        number[i] = i + 1;
    }
    *sweep = (struct sweep){.name = q->sample.text,
                            .n = n,
                            .number = number,
                            .known = true,
                            .dimension = dimension_none};
    *of = (struct sampling){
        .sweep = sweep, .n = n, .place = q->statement->word[0].place, .next = d->reader->sampling};
    d->reader->sampling = of;
    of->sound = parameter_is_free(d, &q->sample, BY_SAMPLE) && number_sample(d, q, of) &&
                sweep_append(d, &q->sample, sweep);
    return of;
}

// The sample of that name, which is begun if there is none yet; NULL: something is wrong.
static struct sampling *find_sampling(struct deck *d, const struct request *q) {
    struct sampling *of = d->reader->sampling;
    while (of && strcmp(of->sweep->name, q->sample.text) != 0) {
        of = of->next;
    }
    of = of ? of : begin_sampling(d, q);
    if (of && of->n != q->values.n) {
        const struct word *n = &q->argument[N].word[0];
        deck_error(d, n,
                   "'%s' has %d values since %s, so all that is sampled together has; a sample "
                   "of its own needs another name: -as NAME",
                   of->sweep->name, of->n, source_mention(d, &of->place, &n->place));
        return NULL;
    }
    return of && of->sound ? of : NULL;
}

// The values drawn by the bound deck; NULL: it has none.
static const double *bound_values(const struct sampling *of, const struct random_values *r) {
    const struct sweep *s = of->bound ? of->bound->along : NULL;
    while (s && strcmp(s->name, r->name) != 0) {
        s = s->along;
    }
    return s && s->n == r->n ? s->number : NULL;
}

static const double *draw(struct deck *d, const struct request *q) {
    struct error e;
    double *value = deck_array(d, (size_t)q->values.n, sizeof *value);
    int *order = deck_array(d, (size_t)q->values.n, sizeof *order);
    if (!value || !order) {
        return NULL;
    }
    int status = random_draw(&q->values, order, value, &e);
    if (status == STATUS_SYSTEM) {
        diagnostics_no_memory(&d->diagnostics);
    } else if (status != STATUS_OK) {
        deck_error_of(d, &q->statement->word[3], &e);
    }
    return status == STATUS_OK ? value : NULL;
}

// Draws the values of `own` and adds it to its sample; false after having reported an error.
static bool join(struct deck *d, const struct request *q, struct sweep *own, double *now) {
    struct sampling *of = find_sampling(d, q);
    const double *value = of ? bound_values(of, &q->values) : NULL;
    value = of && !value ? draw(d, q) : value;
    if (!value) {
        return false;
    }
    *now = value[of->choice];
    own->fixed = of->sweep->fixed;
    own->n = own->fixed ? 1 : q->values.n;
    own->number = own->fixed ? value + of->choice : value;
    struct sweep *before = of->last ? of->last : of->sweep;
    before->along = own;
    of->last = own;
    return true;
}

void sweep_random(struct deck *d, const struct statement *s, struct sweep *own) {
    struct request q = {.statement = s, .values = {.name = own->name}};
    struct parameter p = {.kind = PARAMETER_WRONG, .swept = true};
    const bool fixed = define_find(d, own->name) != NULL;
    if (read_request(d, &q)) {
        own->known = q.first.number.known;
        own->dimension = q.first.number.dimension;
        p.number = q.first.number;
        const bool good = fixed || join(d, &q, own, &p.number.value);
        p.kind = good ? PARAMETER_NUMBER : PARAMETER_WRONG;
        p.swept = !own->fixed;
    }
    const bool good = p.kind != PARAMETER_WRONG;
    if (parameter_keep(d, &s->word[1], BY_SWEEP, &p) && good) {
        sweep_fix(d, &p, own);
        sweep_append(d, &s->word[1], own);
    }
}
