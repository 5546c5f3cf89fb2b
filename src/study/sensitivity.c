// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/sensitivity.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "deck/random.h"
#include "motion/record_cache.h"
#include "study/design.h"
#include "study/trial.h"
#include "study/workers.h"

// The runs of a design.
struct runs_of_design {
    struct design design;
    struct sensitivity *out;
    struct record_cache *records;
    double *demand;  // (n_group, n_set)
    // The first run that failed or collapsed, by its number, and why it failed. Under the lock.
    long bad;
    struct study_outcome outcome;
};

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
    const int i = parameter_of(c->design->of, sweep);
    return i < 0 ? NULL : &c->design->value[design_at(c->design, c->set, i)];
}

static int do_job(void *context, struct workers *workers, long number, void *scratch,
                  struct error *e) {
    struct runs_of_design *r = context;
    const struct chosen_set set = {&r->design, number / r->out->n_group};
    const long group = number % r->out->n_group;
    double *demand = &r->demand[group * r->design.n_set + set.set];
    struct study_outcome outcome;
    struct plan_fixed at;
    plan_fix(r->design.request->plan, number_in_set, &set, &at);
    const struct trial_question question = {.plan = &at.plan,
                                            .run = group,
                                            .edp = &r->design.request->edp,
                                            .records = r->records,
                                            .workers = workers,
                                            .all = scratch};
    const int status = trial_ask(&question, demand, &outcome, e);
    if (status == STATUS_OK && !isfinite(*demand)) {
        workers_lock(workers);
        r->out->n_failed += outcome.status == STUDY_FAILED;
        r->out->n_collapsed += outcome.status != STUDY_FAILED;
        if (number < r->bad) {
            r->bad = number;
            r->outcome = outcome;
        }
        workers_unlock(workers);
    }
    return status;
}

static int poll_design(void *context, struct workers *workers, long n_done, struct error *e) {
    const struct sensitivity_request *q = ((const struct runs_of_design *)context)->design.request;
    (void)workers;
    return q->poll ? q->poll(q->context, n_done, e) : STATUS_OK;
}

static void append(struct sensitivity *s, const char *name, double value) {
    const size_t used = strlen(s->why);
    snprintf(s->why + used, sizeof s->why - used, "%s%s = %.6g", used > 0 ? ", " : "", name, value);
}

// Says at which values the first bad run is, and why it has no demand.
static void explain(const struct runs_of_design *r) {
    struct sensitivity *s = r->out;
    int choice[STUDY_SWEEPS_MAX], n = 0;
    plan_choose(&s->others.plan, r->bad % s->n_group, choice);
    for (int i = 0; i < s->n_parameter; i++) {
        append(s, s->parameter[i]->name,
               r->design.value[design_at(&r->design, r->bad / s->n_group, i)]);
    }
    for (const struct sweep *v = s->others.plan.first->deck->sweeps; v; v = v->next, n++) {
        if (!v->fixed && v->number) {
            append(s, v->name, v->number[choice[n]]);
        } else if (!v->fixed) {
            const size_t used = strlen(s->why);
            snprintf(s->why + used, sizeof s->why - used, ", %s = %s", v->name,
                     v->label[choice[n]]);
        }
    }
    const size_t used = strlen(s->why);
    snprintf(s->why + used, sizeof s->why - used, ": %s",
             r->outcome.status == STUDY_FAILED ? r->outcome.message : "it collapsed");
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

static void find_swings(const struct runs_of_design *r, long group, double *size) {
    const struct design *d = &r->design;
    struct sensitivity_group *to = &r->out->group[group];
    const double *demand = r->demand + group * d->n_set;
    to->middle = demand[0];
    for (int i = 0; i < r->out->n_parameter; i++) {
        for (int k = 0; k < 2; k++) {
            const long set = 1 + 2L * i + k;
            to->swing[i].at[k] = d->value[design_at(d, set, i)];
            to->swing[i].demand[k] = demand[set];
        }
        size[i] = fabs(to->swing[i].demand[1] - to->swing[i].demand[0]);
    }
}

static int find_effects(const struct runs_of_design *r, long group, double *size, struct error *e) {
    struct sensitivity_group *to = &r->out->group[group];
    const struct design *d = &r->design;
    const int status = morris_find(&d->morris, r->demand + group * d->n_set, d->u[1] - d->u[0],
                                   to->effect, &to->n_left_out, e);
    for (int i = 0; i < r->out->n_parameter; i++) {
        size[i] = to->effect[i].mu_star.value;
    }
    return status;
}

static int find_shares(const struct runs_of_design *r, long group, struct arena *a, double *size,
                       struct error *e) {
    struct sensitivity_group *to = &r->out->group[group];
    const int n_parameter = r->out->n_parameter;
    const size_t n = (size_t)r->out->n_row;
    double *step = arena_alloc(a, (size_t)n_parameter * n, sizeof *step);
    if (!step) {
        return error_no_memory(e);
    }
    for (int i = 0; i < n_parameter; i++) {
        const double *u = r->design.u + (long)i * r->design.n_level;
        for (size_t k = 0; k < n; k++) {
            step[(size_t)i * n + k] = u[k + n] - u[k];
        }
    }
    const struct sobol_runs runs = {n, n_parameter, r->demand + group * r->design.n_set, step};
    const int status = sobol_find(&runs, to->share, &to->summary, e);
    to->n_left_out = to->summary.n_left_out;
    for (int i = 0; i < n_parameter; i++) {
        size[i] = to->share[i].total.value;
    }
    return status;
}

static int conclude(const struct runs_of_design *r, struct arena *a, struct error *e) {
    struct sensitivity *s = r->out;
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
                                         .effect = arena_alloc(a, n, sizeof *to->effect),
                                         .share = arena_alloc(a, n, sizeof *to->share),
                                         .order = arena_alloc(a, n, sizeof *to->order)};
        if (!to->swing || !to->effect || !to->share || !to->order) {
            return error_no_memory(e);
        }
        if (r->design.request->method == SENSITIVITY_VARIANCE) {
            status = find_shares(r, g, a, size, e);
        } else if (r->design.request->method == SENSITIVITY_MORRIS) {
            status = find_effects(r, g, size, e);
        } else {
            find_swings(r, g, size);
        }
        set_order(s, size, to);
    }
    return status;
}

static bool has_random(const struct sweep *s) {
    bool random = false;
    for (const struct sweep *v = s->along; v; v = v->along) {
        random |= v->random;
    }
    return random && !s->fixed;
}

// Finds the parameters, and how many combinations the other sweeps have.
static int find_parameters(const struct plan *p, struct sensitivity *out, struct error *e) {
    out->n_group = p->n_run;
    for (const struct sweep *s = p->first->deck->sweeps; s; s = s->next) {
        if (!has_random(s)) {
            continue;
        }
        const struct sweep *other = sweep_named(s->along);
        if (other) {
            return error_set(
                e, STATUS_INPUT,
                "'%s' is paired with '%s', which is not random: it cannot change alone",
                s->along->name, other->name);
        }
        out->n_group /= s->n;
        for (const struct sweep *v = s->along; v; v = v->along) {
            if (out->n_parameter < PLAN_PAIRED_MAX) {
                out->parameter[out->n_parameter] = v;
            }
            out->n_parameter++;
        }
    }
    return out->n_parameter == 0
               ? error_set(e, STATUS_INPUT,
                           "the deck has no parameter that is random: sweep NAME random ...")
           : out->n_parameter > PLAN_PAIRED_MAX
               ? error_set(e, STATUS_INPUT, "more than %d random sweeps", PLAN_PAIRED_MAX)
               : STATUS_OK;
}

// Effects of one parameter have no meaning if another one follows it.
static int check_independence(const struct sensitivity *s, struct error *e) {
    for (int i = 0; i < s->n_parameter; i++) {
        for (int k = 0; k < s->n_parameter; k++) {
            const struct sweep *of = s->parameter[i], *other = s->parameter[k];
            if (random_is_correlated(of->law, other->law)) {
                return error_set(e, STATUS_INPUT,
                                 "'%s' is correlated with '%s': it does not change alone; fix one "
                                 "of them with -D, or leave out -correlated",
                                 of->name, other->name);
            }
        }
    }
    return STATUS_OK;
}

int sensitivity_find(const struct sensitivity_request *q, struct arena *a, struct sensitivity *out,
                     struct error *e) {
    const struct sweep **parameter = arena_alloc(a, PLAN_PAIRED_MAX, sizeof(const struct sweep *));
    *out = (struct sensitivity){.parameter = parameter};
    if (!parameter) {
        return error_no_memory(e);
    }
    int status = find_parameters(q->plan, out, e);
    if (status == STATUS_OK) {
        status = check_independence(out, e);
    }
    if (status != STATUS_OK) {
        return status;
    }
    out->n_row = q->n_row > 0 ? q->n_row : out->parameter[0]->n / 2;
    if (q->method != SENSITIVITY_ONE_AT_A_TIME && out->n_row < 2) {
        return error_set(e, STATUS_INPUT, "'%s' has %d values (-n); at least 4 are needed",
                         out->parameter[0]->name, out->parameter[0]->n);
    }
    const double n = (double)design_count_sets(q, out) * (double)out->n_group;
    out->n_run = (long)fmin(n, 2.0 * STUDY_RUNS_MAX);
    return out->n_run <= STUDY_RUNS_MAX
               ? STATUS_OK
               : error_set(e, STATUS_INPUT, "%.6g runs; at most %d are made", n, STUDY_RUNS_MAX);
}

static int make_runs(const struct sensitivity_request *q, struct runs_of_design *r, struct arena *a,
                     struct error *e) {
    struct sensitivity *s = r->out;
    const struct chosen_set first = {&r->design, 0};
    const struct workers_request request = {.n_thread = q->n_thread,
                                            .scratch =
                                                (q->plan->table->n_value + 1) * sizeof(double),
                                            .n_job = s->n_run,
                                            .work = do_job,
                                            .poll = poll_design,
                                            .context = r};
    plan_fix(q->plan, number_in_set, &first, &s->others);
    int status = workers_run(&request, e);
    if (status == STATUS_OK && r->bad < s->n_run) {
        explain(r);
    }
    if (status != STATUS_OK) {
        return status;
    }
    status = conclude(r, a, e);
    const struct error cause = *e;
    return status == STATUS_FAILED ? error_set(e, status, "%s; %s", cause.message, s->why) : status;
}

int sensitivity_run(const struct sensitivity_request *q, struct arena *a, struct sensitivity *s,
                    struct error *e) {
    struct runs_of_design r = {.out = s,
                               .records = record_cache_create(RECORD_CACHE_BYTES),
                               .demand = arena_alloc(a, (size_t)s->n_run, sizeof *r.demand),
                               .bad = s->n_run};
    int status = r.records && r.demand ? design_init(&r.design, q, s, a, e) : error_no_memory(e);
    if (status == STATUS_OK) {
        status = make_runs(q, &r, a, e);
    }
    record_cache_free(r.records);
    return status;
}
