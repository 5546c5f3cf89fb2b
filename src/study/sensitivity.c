// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/sensitivity.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <string.h>

#include "motion/record_cache.h"
#include "study/trial.h"
#include "study/workers.h"

enum { VALUES_MIN = 4 };

// A design: which value each parameter has in which run.
struct design {
    const struct sensitivity_request *request;
    struct sensitivity *out;
    struct record_cache *records;
    size_t **order;  // (n_parameter) (n) its values in ascending order, by their numbers
    double **rank;   // (n_parameter) (n) probability of a smaller value than this one
    long n_set;      // of values of the parameters
    double *demand;  // (n_group, n_set)
};

// Number of the value of parameter `i` in set `set`.
static size_t design_choice(const struct design *d, long set, int i) {
    if (d->request->method == SENSITIVITY_VARIANCE) {
        const long row = set / (d->out->n_parameter + SOBOL_PARAMETER);
        const long column = set % (d->out->n_parameter + SOBOL_PARAMETER);
        const bool from_b = column == SOBOL_B || column == SOBOL_PARAMETER + i;
        return (size_t)(row + (from_b ? d->out->n_value / 2 : 0));
    }
    // Set 0 has all medians, sets 1 + 2 i and 2 + 2 i the two quantiles of parameter i.
    const double share = d->request->share;
    const double fraction = set == 1 + 2L * i ? share : set == 2 + 2L * i ? 1.0 - share : 0.5;
    return d->order[i][lround(fraction * (d->out->n_value - 1))];
}

// Which parameter a sweep is; -1: none.
static int parameter_of(const struct sensitivity *s, const struct sweep *sweep) {
    for (int i = 0; i < s->n_parameter; i++) {
        if (strcmp(s->parameter[i]->name, sweep->name) == 0) {
            return i;
        }
    }
    return -1;
}

struct chosen_set {
    const struct design *design;
    long set;
};

static const double *number_in_set(const void *context, const struct sweep *sweep) {
    const struct chosen_set *c = context;
    const int i = parameter_of(c->design->out, sweep);
    return i < 0 ? NULL : &sweep->number[design_choice(c->design, c->set, i)];
}

static int do_job(void *context, struct workers *workers, long number, void *scratch,
                  struct error *e) {
    const struct design *d = context;
    const struct chosen_set set = {d, number / d->out->n_group};
    const long group = number % d->out->n_group;
    struct study_outcome outcome;
    struct plan_fixed at;
    plan_fix(d->request->plan, number_in_set, &set, &at);
    const struct trial_question question = {.plan = &at.plan,
                                            .run = group,
                                            .edp = &d->request->edp,
                                            .records = d->records,
                                            .workers = workers,
                                            .all = scratch};
    return trial_ask(&question, &d->demand[group * d->n_set + set.set], &outcome, e);
}

static int poll_design(void *context, struct workers *workers, long n_done, struct error *e) {
    const struct sensitivity_request *q = ((const struct design *)context)->request;
    (void)workers;
    return q->poll ? q->poll(q->context, n_done, e) : STATUS_OK;
}

// Sorts the values of each parameter. False: no memory.
static bool design_rank(struct design *d, struct arena *a) {
    const size_t n = (size_t)d->out->n_value, n_parameter = (size_t)d->out->n_parameter;
    d->order = arena_alloc(a, n_parameter, sizeof *d->order);
    d->rank = arena_alloc(a, n_parameter, sizeof *d->rank);
    for (size_t i = 0; d->order && d->rank && i < n_parameter; i++) {
        d->order[i] = arena_alloc(a, n, sizeof *d->order[i]);
        d->rank[i] = arena_alloc(a, n, sizeof *d->rank[i]);
        if (!d->order[i] || !d->rank[i]) {
            return false;
        }
        gsl_sort_index(d->order[i], d->out->parameter[i]->number, 1, n);
        for (size_t k = 0; k < n; k++) {
            d->rank[i][d->order[i][k]] = ((double)k + 0.5) / (double)n;
        }
    }
    return d->order && d->rank;
}

// Sorts the parameters by what `size` says, the largest first.
static void set_order(const struct sensitivity *s, double *size, struct sensitivity_group *to) {
    for (int i = 0; i < s->n_parameter; i++) {
        int at = i;
        while (at > 0 && size[i] > size[to->order[at - 1]]) {
            to->order[at] = to->order[at - 1];
            at--;
        }
        to->order[at] = i;
    }
}

static void find_swings(const struct design *d, long group, double *size) {
    struct sensitivity_group *to = &d->out->group[group];
    const double *demand = d->demand + group * d->n_set;
    to->middle = demand[0];
    for (int i = 0; i < d->out->n_parameter; i++) {
        for (int k = 0; k < 2; k++) {
            const long set = 1 + 2L * i + k;
            to->swing[i].at[k] = d->out->parameter[i]->number[design_choice(d, set, i)];
            to->swing[i].demand[k] = demand[set];
        }
        size[i] = fabs(to->swing[i].demand[1] - to->swing[i].demand[0]);
    }
}

static int find_shares(const struct design *d, long group, struct arena *a, double *size,
                       struct error *e) {
    struct sensitivity_group *to = &d->out->group[group];
    const int n_parameter = d->out->n_parameter;
    const size_t n = (size_t)(d->out->n_value / 2);
    double *step = arena_alloc(a, (size_t)n_parameter * n, sizeof *step);
    if (!step) {
        return error_no_memory(e);
    }
    for (int i = 0; i < n_parameter; i++) {
        for (size_t k = 0; k < n; k++) {
            step[(size_t)i * n + k] = d->rank[i][k + n] - d->rank[i][k];
        }
    }
    const struct sobol_runs runs = {n, n_parameter, d->demand + group * d->n_set, step};
    const int status = sobol_find(&runs, to->share, &to->summary, e);
    for (int i = 0; i < n_parameter; i++) {
        size[i] = to->share[i].total.value;
    }
    return status;
}

static int conclude(const struct design *d, struct arena *a, struct error *e) {
    struct sensitivity *s = d->out;
    const size_t n = (size_t)s->n_parameter;
    double *size = arena_alloc(a, n, sizeof *size);
    s->group = arena_alloc(a, (size_t)s->n_group, sizeof *s->group);
    if (!size || !s->group) {
        return error_no_memory(e);
    }
    int status = STATUS_OK;
    for (long g = 0; g < s->n_group && status == STATUS_OK; g++) {
        struct sensitivity_group *to = &s->group[g];
        *to = (struct sensitivity_group){.swing = arena_alloc(a, n, sizeof *to->swing),
                                         .share = arena_alloc(a, n, sizeof *to->share),
                                         .order = arena_alloc(a, n, sizeof *to->order)};
        if (!to->swing || !to->share || !to->order) {
            return error_no_memory(e);
        }
        if (d->request->method == SENSITIVITY_VARIANCE) {
            status = find_shares(d, g, a, size, e);
        } else {
            find_swings(d, g, size);
        }
        set_order(s, size, to);
    }
    return status;
}

// Random sweeps are paired: an error where one that is not random goes with them, or where these
// have another number of values than those before.
static int check_sweep(const struct sweep *s, int *n_value, struct error *e) {
    if (sweep_named(s->along)) {
        return error_set(e, STATUS_INPUT,
                         "'%s' is paired with '%s', which is not random: it cannot change alone",
                         s->along->name, sweep_named(s->along)->name);
    }
    for (const struct sweep *v = s->along; v; v = v->along) {
        if (*n_value > 0 && v->n != *n_value) {
            return error_set(e, STATUS_INPUT,
                             "'%s' has %d values and others %d; give all random sweeps as many",
                             v->name, v->n, *n_value);
        }
        *n_value = v->n;
    }
    return STATUS_OK;
}

static bool has_random(const struct sweep *s) {
    bool random = false;
    for (const struct sweep *v = s->along; v; v = v->along) {
        random |= v->random;
    }
    return random && !s->fixed;
}

// Finds the parameters, their number of values, and how many combinations the other sweeps have.
static int find_parameters(const struct plan *p, struct sensitivity *out, struct error *e) {
    int status = STATUS_OK;
    out->n_group = p->n_run;
    for (const struct sweep *s = p->first->deck->sweeps; s && status == STATUS_OK; s = s->next) {
        if (!has_random(s)) {
            continue;
        }
        status = check_sweep(s, &out->n_value, e);
        out->n_group /= s->n;
        for (const struct sweep *v = s->along; v; v = v->along) {
            if (out->n_parameter < PLAN_PAIRED_MAX) {
                out->parameter[out->n_parameter] = v;
            }
            out->n_parameter++;
        }
    }
    if (status == STATUS_OK && (out->n_parameter == 0 || out->n_value < VALUES_MIN)) {
        return error_set(e, STATUS_INPUT,
                         out->n_parameter == 0
                             ? "the deck has no parameter that is random: sweep NAME random ..."
                             : "the random sweeps need %d values (-n) or more",
                         VALUES_MIN);
    }
    return status == STATUS_OK && out->n_parameter > PLAN_PAIRED_MAX
               ? error_set(e, STATUS_INPUT, "more than %d random sweeps", PLAN_PAIRED_MAX)
               : status;
}

static long count_sets(const struct sensitivity_request *q, const struct sensitivity *s) {
    return q->method == SENSITIVITY_VARIANCE
               ? (long)(s->n_parameter + SOBOL_PARAMETER) * (s->n_value / 2)
               : 1 + 2L * s->n_parameter;
}

int sensitivity_find(const struct sensitivity_request *q, struct arena *a, struct sensitivity *out,
                     struct error *e) {
    const struct sweep **parameter = arena_alloc(a, PLAN_PAIRED_MAX, sizeof(const struct sweep *));
    *out = (struct sensitivity){.parameter = parameter};
    if (!parameter) {
        return error_no_memory(e);
    }
    const int status = find_parameters(q->plan, out, e);
    if (status != STATUS_OK) {
        return status;
    }
    const double n = (double)count_sets(q, out) * (double)out->n_group;
    out->n_run = (long)fmin(n, 2.0 * STUDY_RUNS_MAX);
    return out->n_run <= STUDY_RUNS_MAX
               ? STATUS_OK
               : error_set(e, STATUS_INPUT, "%.6g runs; at most %d are made", n, STUDY_RUNS_MAX);
}

int sensitivity_run(const struct sensitivity_request *q, struct arena *a, struct sensitivity *s,
                    struct error *e) {
    struct design d = {.request = q,
                       .out = s,
                       .records = record_cache_create(RECORD_CACHE_BYTES),
                       .n_set = count_sets(q, s),
                       .demand = arena_alloc(a, (size_t)s->n_run, sizeof *d.demand)};
    const struct chosen_set first = {&d, 0};
    const struct workers_request request = {
        .n_thread = s->n_run < q->n_thread ? (int)s->n_run : q->n_thread,
        .scratch = (q->plan->table->n_value + 1) * sizeof(double),
        .n_job = s->n_run,
        .work = do_job,
        .poll = poll_design,
        .context = &d};
    int status = STATUS_OK;
    if (d.records && d.demand && design_rank(&d, a)) {
        plan_fix(q->plan, number_in_set, &first, &s->others);
        status = workers_run(&request, e);
        status = status == STATUS_OK ? conclude(&d, a, e) : status;
    } else {
        status = error_no_memory(e);
    }
    record_cache_free(d.records);
    return status;
}
