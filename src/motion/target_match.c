// SPDX-License-Identifier: GPL-3.0-or-later
// The factor f of a motion minimises the sum over its components and the periods of
// (ln target - ln(f PSA))^2:
//     ln f = mean of ln(target / PSA)
// (PEER 2010, Technical Report for the PEER Ground Motion Database Web Application, with equal
// weights; of two components that is the geometric mean of their spectra). The misfit is the root
// of the mean square that remains: a difference of shape.
//
// Chosen are the motions with the least misfits. Exchanges then follow the greedy algorithm of
// Baker & Lee (2018, Journal of Earthquake Engineering 22, 708-723), here for the misfit of the
// arithmetic mean of the chosen spectra alone: each chosen motion in turn gives way to the motion
// that lowers it most, until a whole turn changes nothing.
#include <assert.h>
#include <math.h>

#include "core/arena.h"
#include "motion/target.h"

struct motions {
    const struct match_request *request;
    int n, n_period;
    double *ratio;   // (n, n_period) mean of f PSA / target over the components
    double *sum;     // (n_period) of the ratios of the chosen motions
    bool *suitable;  // (n) its factor is within the limits
    bool *chosen;    // (n)
};

static double *ratios_of(const struct motions *s, int motion) {
    return s->ratio + (size_t)motion * (size_t)s->n_period;
}

static double misfit_of(const struct motions *s, const struct match *m, int motion) {
    return m->misfit[(size_t)motion * (size_t)s->request->n_component];
}

static void fit(const struct motions *s, int motion, struct match *m) {
    const struct match_request *q = s->request;
    const int first = motion * q->n_component, n = q->n_component * s->n_period;
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < n; i++) {
        const int p = i % s->n_period;
        sum += log(q->goal[p] /
                   spectra_at(q->spectra, first + i / s->n_period, 0, p)->value[SPECTRUM_PSA]);
    }
    const double mean = sum / n, factor = exp(mean);
    for (int i = 0; i < n; i++) {
        const int p = i % s->n_period;
        const double psa =
            spectra_at(q->spectra, first + i / s->n_period, 0, p)->value[SPECTRUM_PSA];
        const double left = log(q->goal[p] / psa) - mean;
        squares += left * left;
        ratios_of(s, motion)[p] += factor * psa / q->goal[p] / q->n_component;
    }
    for (int c = 0; c < q->n_component; c++) {
        m->factor[first + c] = factor;
        m->misfit[first + c] = sqrt(squares / n);
    }
    s->suitable[motion] = factor >= q->low && factor <= q->high;
    m->n_outside += !s->suitable[motion];
}

// Misfit of the mean of `n` motions if `in` is added to them and `out` taken away; -1: none.
static double misfit_with(const struct motions *s, int n, int out, int in) {
    double squares = 0.0;
    for (int p = 0; p < s->n_period; p++) {
        const double less = out < 0 ? 0.0 : ratios_of(s, out)[p];
        const double more = in < 0 ? 0.0 : ratios_of(s, in)[p];
        const double off = log((s->sum[p] - less + more) / n);
        squares += off * off;
    }
    return sqrt(squares / s->n_period);
}

// Adds a motion to the chosen ones (+1), or takes it away (-1).
static void choose(struct motions *s, int motion, int sign) {
    s->chosen[motion] = sign > 0;
    for (int p = 0; p < s->n_period; p++) {
        s->sum[p] += sign * ratios_of(s, motion)[p];
    }
}

// Chooses the suitable motions with the least misfits; of equal ones the first.
static void choose_best(struct motions *s, const struct match *m, int n) {
    for (int k = 0; k < n; k++) {
        int best = -1;
        for (int i = 0; i < s->n; i++) {
            if (s->suitable[i] && !s->chosen[i] &&
                (best < 0 || misfit_of(s, m, i) < misfit_of(s, m, best))) {
                best = i;
            }
        }
        choose(s, best, 1);
    }
}

// Exchanges `out` for the motion that lowers the misfit of the mean most. False: none does.
static bool exchange(struct motions *s, struct match *m, int n, int out) {
    // What is gained must be more than rounding, so that there is an end.
    double least = m->of_mean * (1.0 - 1e-9);
    int best = -1;
    for (int i = 0; i < s->n; i++) {
        if (s->suitable[i] && !s->chosen[i]) {
            const double misfit = misfit_with(s, n, out, i);
            if (misfit < least) {
                least = misfit;
                best = i;
            }
        }
    }
    if (best >= 0) {
        choose(s, out, -1);
        choose(s, best, 1);
        m->of_mean = misfit_with(s, n, -1, -1);
        m->n_exchange++;
    }
    return best >= 0;
}

static void exchange_all(struct motions *s, struct match *m, int n) {
    bool changed = true;
    while (changed) {
        changed = false;
        for (int i = 0; i < s->n; i++) {
            changed |= s->chosen[i] && exchange(s, m, n, i);
        }
    }
}

static void conclude(const struct motions *s, struct match *m, int n) {
    const int c = s->request->n_component;
    for (int r = 0; r < s->n * c; r++) {
        if (s->chosen[r / c]) {
            m->chosen[m->n_chosen++] = r;
        }
    }
    for (int p = 0; p < s->n_period; p++) {
        const struct match_ratio ratio = {s->request->spectra->period[p], s->sum[p] / n};
        m->least = ratio.value < m->least.value ? ratio : m->least;
        m->largest = ratio.value > m->largest.value ? ratio : m->largest;
    }
}

int target_match(struct match *m, const struct match_request *q, struct arena *a, struct error *e) {
    const size_t n_record = (size_t)q->spectra->n_record, n_period = (size_t)q->spectra->n_period;
    assert(n_record > 0 && n_period > 0 && q->goal && q->n_component > 0);
    assert(n_record % (size_t)q->n_component == 0);
    const size_t n_motion = n_record / (size_t)q->n_component;
    *m = (struct match){.factor = arena_alloc(a, n_record, sizeof *m->factor),
                        .misfit = arena_alloc(a, n_record, sizeof *m->misfit),
                        .chosen = arena_alloc(a, n_record, sizeof *m->chosen),
                        .least.value = INFINITY,
                        .largest.value = -INFINITY};
    struct motions s = {.request = q,
                        .n = (int)n_motion,
                        .n_period = (int)n_period,
                        .ratio = arena_alloc(a, n_motion * n_period, sizeof *s.ratio),
                        .sum = arena_alloc(a, n_period, sizeof *s.sum),
                        .suitable = arena_alloc(a, n_motion, sizeof *s.suitable),
                        .chosen = arena_alloc(a, n_motion, sizeof *s.chosen)};
    if (!m->factor || !m->misfit || !m->chosen || !s.ratio || !s.sum || !s.suitable || !s.chosen) {
        return error_no_memory(e);
    }
    for (int i = 0; i < s.n; i++) {
        fit(&s, i, m);
    }
    const int n = q->n_select > 0 ? q->n_select : s.n;
    if (n > s.n - m->n_outside) {
        return error_set(
            e, STATUS_INPUT, "%d of %d %s have a factor from %g to %g; %d are to be chosen",
            s.n - m->n_outside, s.n, q->n_component > 1 ? "pairs" : "records", q->low, q->high, n);
    }
    choose_best(&s, m, n);
    m->of_best = m->of_mean = misfit_with(&s, n, -1, -1);
    if (q->exchange) {
        exchange_all(&s, m, n);
    }
    conclude(&s, m, n);
    return STATUS_OK;
}
