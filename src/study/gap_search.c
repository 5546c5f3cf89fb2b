// SPDX-License-Identifier: GPL-3.0-or-later
// The response is no monotone function of the gap, nor a continuous one: so the scan looks for the
// last gap at which the limit is broken, and bisection only finds where between it and the next gap
// scanned it is broken last, or rather one place there where it changes.
#include "study/gap_search.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdlib.h>

#include "core/arena.h"
#include "study/percentile.h"
#include "study/trial.h"

enum { BISECTIONS_MAX = 200 };  // more than a double has digits

struct search {
    const struct gap_search_request *request;
    struct gap_runs runs;
    struct gap_search *out;
    struct gap_runs_case *which;  // (n)
    struct plan *plan;            // (n) of decks with the parameter set
    long n_run;                   // of each plan
    double *scratch;              // (n_run)
};

static int read_run(void *context, const struct model *m, const struct model *deck,
                    const struct results *r, double *value, struct error *e) {
    (void)deck;
    const struct gap_search_request *q = ((const struct search *)context)->request;
    double *all = malloc(q->plan->table->n_value * sizeof *all);
    const int status = all ? trial_demand(m, r, &q->edp, all, value, e) : error_no_memory(e);
    free(all);
    return status;
}

static int poll_search(void *context, long n_done, struct error *e) {
    const struct search *s = context;
    return s->runs.poll ? s->runs.poll(s->runs.context, n_done, e) : STATUS_OK;
}

// Opens the deck with the parameter at `gap` as the plan of a case, to be given to plan_close_with.
static int open_plan(const struct search *s, double gap, struct plan *out, struct error *e) {
    const struct deck *from = s->request->plan->first->deck;
    // With its unit: a parameter that is no length is refused, not misread.
    const char *define = arena_format(from->arena, "%s=%.17g%s", s->request->parameter, gap,
                                      from->units.length_name);
    if (!define) {
        return error_no_memory(e);
    }
    const int status = plan_open_with(s->request->plan, define, out, e);
    if (status != STATUS_INPUT || out->first) {
        return status;
    }
    const struct error cause = *e;
    return error_set(e, status, "at %s = %.6g: %s", s->request->parameter, gap, cause.message);
}

// The case of a gap.
static int open_case(struct search *s, int i, double gap, struct error *e) {
    s->which[i] = (struct gap_runs_case){.plan = s->request->plan, .gap = gap};
    if (!s->request->parameter) {
        return STATUS_OK;
    }
    const bool open = isinf(gap);
    int status = open_plan(s, open ? s->request->to : gap, &s->plan[i], e);
    s->which[i] = (struct gap_runs_case){.plan = &s->plan[i], .gap = open ? gap : NAN};
    if (status == STATUS_OK && i == 0) {
        s->n_run = s->plan[0].n_run;
    }
    if (status == STATUS_OK &&
        (s->plan[i].n_run != s->n_run || s->n_run > s->request->plan->n_run)) {
        status = error_set(e, STATUS_INPUT, "'%s' changes the number of runs of the deck",
                           s->request->parameter);
    }
    return status;
}

// What the runs of a case say of its gap.
static void judge(struct search *s, int i, struct gap_point *p) {
    const long n_run = s->n_run;
    const double *value = s->runs.value + (size_t)i * (size_t)n_run;
    const struct study_outcome *outcome = s->runs.outcome + (size_t)i * (size_t)n_run;
    for (long run = 0; run < n_run; run++) {
        if (outcome[run].status == STUDY_FAILED && p->n_failed++ == 0) {
            p->run = run;
            snprintf(p->message, sizeof p->message, "%s", outcome[run].message);
        }
        p->run = p->n_failed == 0 && value[run] > value[p->run] ? run : p->run;
        p->n_collapsed += isinf(value[run]) != 0;
        s->scratch[run] = value[run];
    }
    p->value = NAN;
    if (p->n_failed == 0) {
        gsl_sort(s->scratch, 1, (size_t)n_run);
        p->value = percentile_sorted(s->scratch, (size_t)n_run, s->request->percentile / 100.0);
    }
    p->kept = p->n_failed == 0 && p->value <= s->request->limit;
}

static int run_cases(struct search *s, int n, struct error *e) {
    const size_t n_job = (size_t)n * (size_t)s->n_run;
    struct gap_runs runs = s->runs;
    runs.which = s->which;
    runs.n_case = n;
    runs.n_value = 1;
    runs.read = read_run;
    runs.poll = poll_search;
    runs.context = s;
    runs.outcome = calloc(n_job, sizeof *runs.outcome);
    runs.value = calloc(n_job, sizeof *runs.value);
    free(s->runs.outcome);
    free(s->runs.value);
    s->runs.outcome = runs.outcome;
    s->runs.value = runs.value;
    return runs.outcome && runs.value ? gap_runs_run(&runs, e) : error_no_memory(e);
}

// Runs n gaps and adds their points, in the order given.
static int look(struct search *s, enum gap_stage stage, const double *gap, int n, struct error *e) {
    int status = STATUS_OK;
    for (int i = 0; i < n && status == STATUS_OK; i++) {
        status = open_case(s, i, gap[i], e);
    }
    status = status == STATUS_OK ? run_cases(s, n, e) : status;
    for (int i = 0; i < n && status == STATUS_OK; i++) {
        struct gap_point *p = &s->out->point[s->out->n_point++];
        *p = (struct gap_point){.stage = stage, .gap = gap[i]};
        judge(s, i, p);
    }
    for (int i = 0; i < n && s->request->parameter; i++) {
        plan_close_with(&s->plan[i]);
    }
    return status;
}

static int scan(struct search *s, struct error *e) {
    const struct gap_search_request *q = s->request;
    double *gap = malloc((size_t)q->n * sizeof *gap);
    if (!gap) {
        return error_no_memory(e);
    }
    for (int i = 0; i < q->n; i++) {
        gap[i] = (q->from * (q->n - 1 - i) + q->to * i) / (q->n - 1);
    }
    int status = look(s, GAP_SCAN, gap, q->n, e);
    free(gap);
    return status;
}

// Without any contact. Demands of the contacts have no value there.
static int open_all(struct search *s, struct error *e) {
    const double never = INFINITY;
    struct gap_search *out = s->out;
    if (s->request->edp.quantity->owner == EDP_OF_CONTACT) {
        return STATUS_OK;
    }
    int status = look(s, GAP_OPEN, &never, 1, e);
    if (status == STATUS_OK) {
        out->open = out->point[--out->n_point];
        out->opened = true;
    }
    return status;
}

static int bisect(struct search *s, struct error *e) {
    struct gap_search *out = s->out;
    int status = STATUS_OK;
    for (int i = 0; i < BISECTIONS_MAX && status == STATUS_OK; i++) {
        const double middle = out->below + (out->gap - out->below) / 2.0;
        if (!(out->gap - out->below > s->request->tolerance) || middle <= out->below ||
            middle >= out->gap) {
            break;
        }
        status = look(s, GAP_BISECTION, &middle, 1, e);
        if (status == STATUS_OK) {
            *(out->point[out->n_point - 1].kept ? &out->gap : &out->below) = middle;
        }
    }
    return status;
}

static int search(struct search *s, struct error *e) {
    struct gap_search *out = s->out;
    const int n = s->request->n;
    int status = scan(s, e);
    status = status == STATUS_OK ? open_all(s, e) : status;
    if (status != STATUS_OK) {
        return status;
    }
    int first = n;  // of the gaps that keep the limit up to the last
    while (first > 0 && out->point[first - 1].kept) {
        first--;
    }
    out->found = first < n;
    out->gap = out->found ? out->point[first].gap : NAN;
    out->below = first > 0 ? out->point[first - 1].gap : NAN;
    return out->found && first > 0 ? bisect(s, e) : STATUS_OK;
}

int gap_search_run(const struct gap_search_request *q, const struct gap_runs *how,
                   struct gap_search *out, struct error *e) {
    const size_t n = (size_t)q->n, capacity = n + BISECTIONS_MAX;
    struct search s = {.request = q, .runs = *how, .out = out, .n_run = q->plan->n_run};
    *out = (struct gap_search){.gap = NAN, .below = NAN};
    s.runs.outcome = NULL;
    s.runs.value = NULL;
    out->point = calloc(capacity, sizeof *out->point);
    s.which = calloc(n, sizeof *s.which);
    s.plan = calloc(n, sizeof *s.plan);
    s.scratch = calloc((size_t)q->plan->n_run, sizeof *s.scratch);
    int status = out->point && s.which && s.plan && s.scratch ? search(&s, e) : error_no_memory(e);
    out->n_run = s.n_run;
    free(s.runs.outcome);
    free(s.runs.value);
    free(s.which);
    free(s.plan);
    free(s.scratch);
    return status;
}

void gap_search_close(struct gap_search *s) {
    free(s->point);
    *s = (struct gap_search){.n_point = 0};
}
