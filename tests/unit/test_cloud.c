// SPDX-License-Identifier: GPL-3.0-or-later
// Cloud analysis against closed forms; the bootstrap against the known scatter of a mean; stripes
// whose runs have records of their own.
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_math.h>
#include <string.h>

#include "study/bootstrap.h"
#include "study/cloud.h"
#include "study/hazard.h"
#include "support/random.h"
#include "support/support.h"

enum { MOST = 200 };

static struct fragility_runs runs_of(struct fragility_run *run, int n) {
    for (int i = 0; i < n; i++) {
        run[i].unit = i;
    }
    return (struct fragility_runs){.n = n, .run = run, .n_unit = n, .each = true};
}

static struct cloud fitted(const struct fragility_runs *r, const int *weight, double limit) {
    struct cloud c;
    struct error e;
    assert_int_equal(cloud_fit(r, weight, limit, false, &c, &e), STATUS_OK);
    return c;
}

// Logarithms x = 0, 1, 2, 3 and y = 1, 3, 3, 5: by hand a slope of 1.2, an intercept of 1.2, and
// residuals -0.2, 0.6, -0.6, 0.2.
static void the_line_is_that_of_least_squares(void **state) {
    (void)state;
    struct fragility_run run[] = {
        {1, exp(1), 0}, {M_E, exp(3), 0}, {exp(2), exp(3), 0}, {exp(3), exp(5), 0}};
    const struct fragility_runs r = runs_of(run, 4);
    const struct cloud c = fitted(&r, NULL, exp(2.4));
    assert_close(c.slope, 1.2, 1e-14);
    assert_close(c.intercept, 1.2, 1e-14);
    assert_close(c.scatter, sqrt(0.8 / 2.0), 1e-14);
    assert_int_equal(c.fit.outcome, FRAGILITY_FITTED);
    assert_close(c.fit.median, exp(1.0), 1e-14);
    assert_close(c.fit.dispersion, sqrt(0.4) / 1.2, 1e-14);
    assert_close(fragility_probability(&c.fit, exp(2.0)), gsl_cdf_ugaussian_P(1.2 / sqrt(0.4)),
                 1e-14);
    // A weight is a run that occurs so often; a run without a value is none.
    struct fragility_run more[] = {{1, exp(1), 0},      {M_E, exp(3), 0}, {2, NAN, 0},
                                   {exp(2), exp(3), 0}, {9, exp(9), 0},   {exp(3), exp(5), 0}};
    const struct fragility_runs m = runs_of(more, 6);
    const struct cloud w = fitted(&m, (const int[]){1, 1, 5, 1, 0, 1}, exp(2.4));
    assert_int_equal(w.n, 4);
    assert_close(w.slope, 1.2, 1e-14);
    assert_close(w.scatter, c.scatter, 1e-14);
}

// Collapses are INFINITY. The parameters of the logit zero the score.
static void collapses_have_a_logit(void **state) {
    (void)state;
    struct fragility_run run[] = {{0.5, 0.010, 0}, {0.8, 0.013, 0},    {1.0, INFINITY, 0},
                                  {1.2, 0.022, 0}, {1.5, 0.026, 0},    {1.8, INFINITY, 0},
                                  {2.0, 0.045, 0}, {2.5, INFINITY, 0}, {3.0, INFINITY, 0},
                                  {3.5, 0.062, 0}};
    const struct fragility_runs r = runs_of(run, 10);
    const struct cloud c = fitted(&r, NULL, 0.03);
    assert_int_equal(c.n, 6);
    assert_int_equal(c.n_collapsed, 4);
    assert_true(c.fit.mixed && c.fit.outcome == FRAGILITY_FITTED);
    double score[2] = {0.0, 0.0};
    for (int i = 0; i < 10; i++) {
        const double z = log(run[i].intensity);
        const double p = 1.0 / (1.0 + exp(-c.fit.logit[0] - c.fit.logit[1] * z));
        score[0] += isinf(run[i].demand) - p;
        score[1] += (isinf(run[i].demand) - p) * z;
    }
    assert_true(fabs(score[0]) < 1e-12 && fabs(score[1]) < 1e-12);
    // The curve is that of both together, and so are its quantiles.
    const double eta = log(1.7 / c.fit.standing_median) / c.fit.standing_dispersion;
    const double down = 1.0 / (1.0 + exp(-c.fit.logit[0] - c.fit.logit[1] * log(1.7)));
    assert_close(fragility_probability(&c.fit, 1.7), 1.0 - (1.0 - down) * gsl_cdf_ugaussian_Q(eta),
                 1e-14);
    assert_close(fragility_probability(&c.fit, c.fit.median), 0.5, 1e-12);
    // Collapse alone: a logit reaches Phi(1) at ln x = (logit(Phi(1)) - c0) / c1.
    struct cloud only;
    struct error e;
    assert_int_equal(cloud_fit(&r, NULL, 0.0, true, &only, &e), STATUS_OK);
    const double p = gsl_cdf_ugaussian_P(1.0);
    assert_close(only.fit.logit[0], c.fit.logit[0], 1e-12);
    assert_close(only.fit.median, exp(-c.fit.logit[0] / c.fit.logit[1]), 1e-12);
    assert_close(only.fit.dispersion, log(p / (1.0 - p)) / c.fit.logit[1], 1e-12);
}

static void clouds_without_a_curve_say_so(void **state) {
    (void)state;
    static const struct {
        struct fragility_run run[5];
        enum fragility_outcome outcome;
    } cases[] = {
        {{{1, 1, 0}, {2, 3, 0}, {3, 2, 0}, {4, 0, 0}, {5, 4, 0}}, FRAGILITY_NO_LOGARITHM},
        {{{1, 5, 0}, {2, 4, 0}, {3, 3, 0}, {4, 1, 0}, {5, 1, 0}}, FRAGILITY_FALLS},
        {{{1, 1, 0}, {2, 2, 0}, {4, 4, 0}, {8, 8, 0}, {5, 5, 0}}, FRAGILITY_NO_SCATTER},
        {{{1, 1, 0}, {1, 2, 0}, {1, 4, 0}, {1, 8, 0}, {1, 5, 0}}, FRAGILITY_FEW_RUNS},
        {{{0, 1, 0}, {1, 2, 0}, {1, 4, 0}, {1, 8, 0}, {1, 5, 0}}, FRAGILITY_NOT_POSITIVE},
        {{{1, 1, 0}, {2, 3, 0}, {3, 2, 0}, {4, INFINITY, 0}, {5, INFINITY, 0}}, FRAGILITY_NO_LOGIT},
        {{{9, 1, 0}, {8, 3, 0}, {7, 2, 0}, {4, INFINITY, 0}, {5, INFINITY, 0}}, FRAGILITY_FALLS},
        {{{6, 2, 0}, {8, 3, 0}, {2, 1, 0}, {7, INFINITY, 0}, {1, INFINITY, 0}}, FRAGILITY_FALLS},
        {{{1, INFINITY, 0}, {2, INFINITY, 0}, {3, NAN, 0}, {4, NAN, 0}, {5, NAN, 0}},
         FRAGILITY_ALL_EXCEED},
        {{{1, NAN, 0}, {2, NAN, 0}, {3, NAN, 0}, {4, NAN, 0}, {5, NAN, 0}}, FRAGILITY_NO_RUNS},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct fragility_run run[5];
        memcpy(run, cases[i].run, sizeof run);
        const struct fragility_runs r = runs_of(run, 5);
        const struct cloud c = fitted(&r, NULL, 2.5);
        assert_int_equal(c.fit.outcome, cases[i].outcome);
        assert_true(fragility_reason(&c.fit)[0] != '\0');
        assert_true(isnan(fragility_probability(&c.fit, 2.0)));
    }
}

// With a logit the rate is an integral without a closed form. Where collapses are next to
// impossible it is that of the lognormal curve, and where they are all, that of the logit: with a
// hazard k0 x^-k it is k0 exp(k c0 / c1) (pi k / c1) / sin(pi k / c1), the moment of a logistic
// distribution.
static void the_hazard_takes_a_curve_with_collapses(void **state) {
    (void)state;
    const double x[] = {1e-9, 1e-3, 1.0, 1e9}, k = 1.5;
    double rate[4];
    for (int i = 0; i < 4; i++) {
        rate[i] = 1e-4 * pow(x[i], -k);
    }
    const struct hazard h = {4, x, rate};
    struct fragility f = {.outcome = FRAGILITY_FITTED, .median = 2.0, .dispersion = 0.4};
    struct fragility g = {.outcome = FRAGILITY_FITTED,
                          .mixed = true,
                          .logit = {-500.0, 4.0},
                          .standing_median = 2.0,
                          .standing_dispersion = 0.4};
    assert_close(hazard_exceedances(&h, &g, INFINITY), hazard_exceedances(&h, &f, INFINITY), 1e-9);
    g.logit[0] = -3.0;
    g.standing_median = INFINITY;
    g.standing_dispersion = 1.0;
    const double angle = M_PI * k / 4.0;
    assert_close(hazard_exceedances(&h, &g, INFINITY),
                 1e-4 * exp(-k * 3.0 / 4.0) * angle / sin(angle), 1e-8);
}

// The bootstrap of a mean of n logarithms is nearly normal, with the deviation of the sample over
// sqrt(n), so that 95 % lie within 1.96 of these.
static void the_bootstrap_of_a_median_is_known(void **state) {
    (void)state;
    struct fragility_record record[MOST], drawn[MOST];
    struct random random = {.state = 5};
    for (int i = 0; i < MOST; i++) {
        const double z = gsl_cdf_ugaussian_Pinv(random_uniform(&random, 0.0, 1.0));
        record[i] = (struct fragility_record){CROSSING_AT, 3.0 * exp(0.4 * z)};
    }
    struct bootstrap_records sample = {record, MOST, drawn};
    struct bootstrap_request q = {.n_unit = MOST,
                                  .n_draw = 4000,
                                  .seed = 1,
                                  .fit = bootstrap_fit_records,
                                  .context = &sample};
    struct bootstrap b, again;
    struct fragility f;
    struct error e;
    assert_int_equal(fragility_fit_records(record, MOST, &f, &e), STATUS_OK);
    assert_int_equal(bootstrap_run(&q, &b, &e), STATUS_OK);
    assert_int_equal(b.n_fitted, 4000);
    assert_close(log(b.median[1] / f.median), 1.96 * f.log_median_error, 0.06);
    assert_close(log(f.median / b.median[0]), 1.96 * f.log_median_error, 0.06);
    assert_close(b.dispersion[1] - b.dispersion[0], 2.0 * 1.96 * f.dispersion_error, 0.15);
    assert_int_equal(bootstrap_run(&q, &again, &e), STATUS_OK);
    assert_memory_equal(&b, &again, sizeof b);
    q.seed = 2;
    assert_int_equal(bootstrap_run(&q, &again, &e), STATUS_OK);
    assert_true(again.seed == 2 && b.median[0] != again.median[0]);
    // Where each unit is a stratum of its own, there is only one draw.
    int stratum[MOST];
    for (int i = 0; i < MOST; i++) {
        stratum[i] = i;
    }
    q.stratum = stratum;
    assert_int_equal(bootstrap_run(&q, &b, &e), STATUS_OK);
    assert_close(b.median[0], f.median, 1e-12);
    assert_close(b.median[1], f.median, 1e-12);
}

// Runs of one intensity are one level, in whatever order they come.
static void runs_of_one_intensity_are_counted_together(void **state) {
    (void)state;
    struct fragility_run run[] = {{1, 2, 0}, {1, 4, 0}, {1, NAN, 0}, {2, 4, 0}, {2, INFINITY, 0}};
    const struct fragility_runs r = runs_of(run, 5);
    struct fragility_level level[5];
    assert_int_equal(fragility_runs_count(&r, 3.0, NULL, level), 2);
    assert_true(level[0].n == 2 && level[0].exceeded == 1 && level[0].intensity == 1.0);
    assert_true(level[1].n == 2 && level[1].exceeded == 2 && level[1].intensity == 2.0);
    fragility_runs_count(&r, 3.0, (const int[]){0, 3, 7, 1, 1}, level);
    assert_true(level[0].n == 3 && level[0].exceeded == 3 && level[1].n == 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_line_is_that_of_least_squares),
        cmocka_unit_test(collapses_have_a_logit),
        cmocka_unit_test(clouds_without_a_curve_say_so),
        cmocka_unit_test(the_hazard_takes_a_curve_with_collapses),
        cmocka_unit_test(the_bootstrap_of_a_median_is_known),
        cmocka_unit_test(runs_of_one_intensity_are_counted_together),
    };
    gsl_set_error_handler_off();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
