// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/apart.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics.h>
#include <math.h>
#include <stdlib.h>

#include "core/number.h"
#include "model/link_end.h"

// The first mode of the building alone.
static void first_mode(const struct model *m, int building, double *period, double *damping) {
    *period = *damping = NAN;
    if (building != WALL) {
        const struct building *g = &m->building[building];
        *period = 2.0 * M_PI / g->omega[0];
        *damping = building_damping_ratio(g, 1);
    }
}

static void read_contact(const struct model *m, const struct model *deck, const struct results *r,
                         int i, double *value) {
    const struct link *l = &m->link[i];
    struct separation_ends ends;
    for (int side = 0; side < 2; side++) {
        first_mode(m, l->building[side], &ends.period[side], &ends.damping[side]);
        ends.displacement[side] = link_at(l, side, r->peak[PEAK_DISPLACEMENT]);
        value[APART_LEFT + side] = ends.displacement[side];
        value[APART_PERIOD_LEFT + side] = ends.period[side];
        value[APART_DAMPING_LEFT + side] = ends.damping[side];
    }
    value[APART_GAP] = deck->link[i].gap;
    value[APART_CLOSING] = r->link[i].penetration + l->gap;
    value[APART_RHO] = separation_correlation(ends.period, ends.damping);
    for (int k = 0; k < SEPARATION_RULES; k++) {
        value[APART_RULE + k] = separation_by(&separation_rules[k], &ends);
    }
}

static int read_run(void *context, const struct model *m, const struct model *deck,
                    const struct results *r, double *value, struct error *e) {
    (void)context, (void)e;
    for (int i = 0; i < m->n_contact; i++) {
        read_contact(m, deck, r, i, value + (size_t)i * APART_VALUES);
    }
    return STATUS_OK;
}

// Whether two runs differ in nothing but their gaps.
static bool same_run(const struct apart *a, long one, long other) {
    bool same = a->outcome[one].status == a->outcome[other].status;
    for (int i = 0; i < a->n_contact && same; i++) {
        const double *x = apart_values(a, one, i), *y = apart_values(a, other, i);
        for (int j = APART_CLOSING; j < APART_VALUES; j++) {
            same = same && number_bits(x[j]) == number_bits(y[j]);
        }
    }
    return same;
}

// Finds the sweeps that change nothing; of their values the first counts. `later` is how many runs
// each value of a sweep has in a row.
static void find_idle(const struct plan *plan, struct apart *a) {
    long later = a->n_run;
    int k = 0;
    for (const struct sweep *s = plan->first->deck->sweeps; s; s = s->next, k++) {
        later /= s->n;
        a->idle[k] = s->n > 1;
        for (long run = 0; run < a->n_run && a->idle[k]; run++) {
            a->idle[k] = same_run(a, run, run - run / later % s->n * later);
        }
        for (long run = 0; run < a->n_run; run++) {
            a->counts[run] = a->counts[run] && !(a->idle[k] && run / later % s->n > 0);
        }
    }
}

static void count_runs(const struct plan *plan, struct apart *a) {
    for (long run = 0; run < a->n_run; run++) {
        a->counts[run] = true;
        a->n_failed += a->outcome[run].status == STUDY_FAILED;
    }
    find_idle(plan, a);
}

int apart_run(const struct plan *plan, const struct gap_runs *how, struct apart *out,
              struct error *e) {
    const struct gap_runs_case which = {.plan = plan, .gap = INFINITY};
    struct gap_runs s = *how;
    const size_t n_run = (size_t)plan->n_run;
    s.which = &which;
    s.n_case = 1;
    s.n_value = (size_t)plan->first->n_contact * APART_VALUES;
    s.read = read_run;
    *out = (struct apart){.n_run = plan->n_run, .n_contact = plan->first->n_contact};
    s.outcome = out->outcome = calloc(n_run, sizeof *out->outcome);
    s.value = out->value = calloc(n_run * s.n_value + 1, sizeof *out->value);
    out->counts = calloc(n_run, sizeof *out->counts);
    if (!s.outcome || !s.value || !out->counts) {
        return error_no_memory(e);
    }
    int status = gap_runs_run(&s, e);
    if (status == STATUS_OK) {
        count_runs(plan, out);
    }
    return status;
}

void apart_close(struct apart *a) {
    free(a->outcome);
    free(a->value);
    free(a->counts);
    *a = (struct apart){.n_run = 0};
}

const double *apart_values(const struct apart *a, long run, int contact) {
    return a->value + ((size_t)run * (size_t)a->n_contact + (size_t)contact) * APART_VALUES;
}

struct apart_summary apart_summarise(const struct apart *a, int contact, int value, int below,
                                     double *scratch) {
    struct apart_summary s = {NAN, NAN, NAN, NAN, NAN, NAN, 0};
    size_t n = 0;
    for (long run = 0; run < a->n_run; run++) {
        const double *v = apart_values(a, run, contact);
        const double x = below == APART_VALUES ? v[value]
                         : v[below] > 0.0      ? v[value] / v[below]
                                               : NAN;
        if (!isnan(x) && (a->counts[run] || value == APART_GAP)) {
            s.run = n == 0 || x > s.largest ? run : s.run;
            s.largest = n == 0 || x > s.largest ? x : s.largest;
            scratch[n++] = x;
        }
    }
    if (n > 0) {
        gsl_sort(scratch, 1, n);
        s.least = scratch[0];
        s.mean = gsl_stats_mean(scratch, 1, n);
        s.low = gsl_stats_quantile_from_sorted_data(scratch, 1, n, 0.16);
        s.median = gsl_stats_quantile_from_sorted_data(scratch, 1, n, 0.5);
        s.high = gsl_stats_quantile_from_sorted_data(scratch, 1, n, 0.84);
    }
    return s;
}

long apart_hits(const struct apart *a, int contact) {
    long n = 0;
    for (long run = 0; run < a->n_run; run++) {
        const double *v = apart_values(a, run, contact);
        n += v[APART_CLOSING] > v[APART_GAP];
    }
    return n;
}
