// SPDX-License-Identifier: GPL-3.0-or-later
// Let the demand D of a run that does not collapse have ln D = a + b ln x + s e, with e normal. It
// exceeds the limit d with the probability Phi((a + b ln x - ln d) / s): a lognormal curve with the
// median exp((ln d - a) / b) and the dispersion s / b. With the probability C(x) of collapse,
//     P(x) = C(x) + (1 - C(x)) Phi(ln(x / median) / dispersion),    logit C = c0 + c1 ln x.
// Its median is where P is 1/2, and its dispersion half the logarithm of the intensities at which P
// is Phi(1) and Phi(-1).
//
// c0 and c1 maximise the likelihood sum [k ln C + l ln(1 - C)], which is concave; Newton's method
// finds its only maximum, unless the collapses are separated from the rest.
#include "study/cloud.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_math.h>
#include <math.h>

#include "core/root.h"

enum { ITERATIONS_MAX = 200, WIDENINGS_MAX = 9, HALVINGS_MAX = 64 };

// The steps of Newton's method end at this size, relative to the numbers.
static const double STEP_MIN = 1e-12;

// Scatter of rounding size is none.
static const double SCATTER_MIN = 1e-9;

// Runs of one kind: number, mean and squares of ln intensity, the products with ln demand.
struct moments {
    double n, x, y, xx, xy, yy;
    double lowest, highest;  // intensity
};

static void add(struct moments *m, double intensity, double demand, double times) {
    const double x = log(intensity), y = log(demand);
    const double dx = x - m->x, dy = y - m->y;
    m->n += times;
    m->x += times * dx / m->n;
    m->y += times * dy / m->n;
    m->xx += times * dx * (x - m->x);
    m->xy += times * dx * (y - m->y);
    m->yy += times * dy * (y - m->y);
    m->lowest = fmin(m->lowest, intensity);
    m->highest = fmax(m->highest, intensity);
}

// The logit is c[0] + c[1] z, z the standardised logarithm (ln x - middle) / spread.
struct logit {
    const struct fragility_runs *runs;
    const int *weight;
    double middle, spread;
};

static double times_of(const struct fragility_runs *r, const int *weight, int i) {
    return isnan(r->run[i].demand) ? 0.0 : weight ? weight[r->run[i].unit] : 1.0;
}

static bool has_collapsed(const struct fragility_run *run) {
    return isinf(run->demand);
}

// ln L at c, its gradient g and its second derivatives -h: by c[0] twice, by both, by c[1] twice.
static double likelihood(const struct logit *l, const double *c, double *g, double *h) {
    double sum = 0.0;
    g[0] = g[1] = h[0] = h[1] = h[2] = 0.0;
    for (int i = 0; i < l->runs->n; i++) {
        const struct fragility_run *run = &l->runs->run[i];
        const double times = times_of(l->runs, l->weight, i);
        if (times == 0.0) {
            continue;
        }
        const double z = (log(run->intensity) - l->middle) / l->spread;
        const double eta = c[0] + c[1] * z, p = 1.0 / (1.0 + exp(-eta));
        const double bend = times * p * (1.0 - p);
        const double slope = times * (has_collapsed(run) ? 1.0 - p : -p);
        // -ln of the probability of what happened, where exp() does not overflow.
        const double against = has_collapsed(run) ? -eta : eta;
        sum -= times * (fmax(against, 0.0) + log1p(exp(-fabs(against))));
        g[0] += slope;
        g[1] += slope * z;
        h[0] += bend;
        h[1] += bend * z;
        h[2] += bend * z * z;
    }
    return sum;
}

// Newton's method with steps that are halved until ln L does not fall.
static int fit_logit(const struct logit *l, double *out, struct error *e) {
    double c[2] = {0.0, 1.0}, g[2], h[3], step = INFINITY;
    double now = likelihood(l, c, g, h);
    for (int i = 0; i < ITERATIONS_MAX && step > STEP_MIN; i++) {
        const double determinant = h[0] * h[2] - h[1] * h[1];
        double d[2] = {(h[2] * g[0] - h[1] * g[1]) / determinant,
                       (h[0] * g[1] - h[1] * g[0]) / determinant};
        step = fmax(fabs(d[0]), fabs(d[1])) / (1.0 + fmax(fabs(c[0]), fabs(c[1])));
        if (!isfinite(step)) {
            break;
        }
        double next = -INFINITY, at[2] = {c[0], c[1]};
        for (int k = 0; k < HALVINGS_MAX && !(next >= now - 1e-12 * fabs(now)); k++) {
            at[0] = c[0] + d[0];
            at[1] = c[1] + d[1];
            next = likelihood(l, at, g, h);
            d[0] /= 2.0;
            d[1] /= 2.0;
        }
        c[0] = at[0];
        c[1] = at[1];
        now = next;
    }
    if (!(step <= STEP_MIN)) {
        return error_set(e, STATUS_FAILED, "the logit of the collapses does not converge");
    }
    out[0] = c[0] - c[1] * l->middle / l->spread;
    out[1] = c[1] / l->spread;
    return STATUS_OK;
}

// The logarithm of the intensity at which the curve, which rises, reaches p.
static double quantile(const struct fragility *f, double p, double middle) {
    struct root r = {middle - 1.0, middle + 1.0, 1.0};
    for (int i = 0; i < WIDENINGS_MAX && fragility_probability(f, exp(r.low)) > p; i++) {
        r.low -= r.high - r.low;
    }
    for (int i = 0; i < WIDENINGS_MAX && fragility_probability(f, exp(r.high)) < p; i++) {
        r.high += r.high - r.low;
    }
    for (int i = 0; i < HALVINGS_MAX; i++) {
        root_halve(&r, fragility_probability(f, exp(root_middle(&r))) < p);
    }
    return root_middle(&r);
}

// Median and dispersion of the curve with collapses.
static void summarise(struct fragility *f, double middle) {
    f->outcome = f->logit[1] > 0.0 ? FRAGILITY_FITTED : FRAGILITY_FALLS;
    if (f->outcome == FRAGILITY_FITTED) {
        const double high = quantile(f, gsl_cdf_ugaussian_P(1.0), middle);
        const double low = quantile(f, gsl_cdf_ugaussian_P(-1.0), middle);
        f->median = exp(quantile(f, 0.5, middle));
        f->dispersion = (high - low) / 2.0;
    }
}

static enum fragility_outcome judge(const struct moments *standing, const struct moments *collapsed,
                                    bool collapses) {
    const double n = standing->n + collapsed->n;
    const bool one = standing->n < 3.0 || standing->lowest == standing->highest;
    return n == 0.0                                             ? FRAGILITY_NO_RUNS
           : !(fmin(standing->lowest, collapsed->lowest) > 0.0) ? FRAGILITY_NOT_POSITIVE
           : !collapses && !isfinite(standing->y)               ? FRAGILITY_NO_LOGARITHM
           : collapses && collapsed->n == 0.0                   ? FRAGILITY_NONE_EXCEEDS
           : standing->n == 0.0                                 ? FRAGILITY_ALL_EXCEED
           : !collapses && one                                  ? FRAGILITY_FEW_RUNS
           : collapsed->n == 0.0                                ? FRAGILITY_FITTED
           : standing->highest <= collapsed->lowest             ? FRAGILITY_NO_LOGIT
           : collapsed->highest <= standing->lowest             ? FRAGILITY_FALLS
                                                                : FRAGILITY_FITTED;
}

// The line and the lognormal curve of the runs that have not collapsed.
static void fit_line(struct cloud *c, const struct moments *m, double limit) {
    struct fragility *f = &c->fit;
    c->slope = m->xy / m->xx;
    c->intercept = m->y - c->slope * m->x;
    c->scatter = sqrt(fmax(m->yy - c->slope * m->xy, 0.0) / (m->n - 2.0));
    f->median = exp((log(limit) - c->intercept) / c->slope);
    f->dispersion = c->scatter / c->slope;
    f->outcome = !(c->slope > 0.0)             ? FRAGILITY_FALLS
                 : !(c->scatter > SCATTER_MIN) ? FRAGILITY_NO_SCATTER
                                               : FRAGILITY_FITTED;
}

int cloud_fit(const struct fragility_runs *r, const int *weight, double limit, bool collapses,
              struct cloud *out, struct error *e) {
    struct moments standing = {.lowest = INFINITY}, collapsed = {.lowest = INFINITY};
    for (int i = 0; i < r->n; i++) {
        const double times = times_of(r, weight, i);
        const bool down = has_collapsed(&r->run[i]);
        if (times > 0.0) {
            add(down ? &collapsed : &standing, r->run[i].intensity,
                down || collapses ? 1.0 : r->run[i].demand, times);
        }
    }
    *out = (struct cloud){.n = (int)standing.n,
                          .n_collapsed = (int)collapsed.n,
                          .intercept = NAN,
                          .slope = NAN,
                          .scatter = NAN};
    struct fragility *f = &out->fit;
    *f = (struct fragility){.outcome = judge(&standing, &collapsed, collapses),
                            .median = NAN,
                            .dispersion = NAN,
                            .log_median_error = NAN,
                            .dispersion_error = NAN,
                            .between = {NAN, NAN}};
    if (f->outcome == FRAGILITY_FITTED && !collapses) {
        fit_line(out, &standing, limit);
    }
    if (f->outcome != FRAGILITY_FITTED || collapsed.n == 0.0) {
        return STATUS_OK;
    }
    const double apart = collapsed.x - standing.x, n = standing.n + collapsed.n;
    const struct logit l = {.runs = r,
                            .weight = weight,
                            .middle = (standing.n * standing.x + collapsed.n * collapsed.x) / n,
                            .spread = sqrt((standing.xx + collapsed.xx) / n +
                                           standing.n * collapsed.n / (n * n) * apart * apart)};
    f->mixed = true;
    f->standing_median = collapses ? INFINITY : f->median;
    f->standing_dispersion = collapses ? 1.0 : f->dispersion;
    const int status = fit_logit(&l, f->logit, e);
    if (status == STATUS_OK) {
        summarise(f, l.middle);
    }
    return status;
}
