// SPDX-License-Identifier: GPL-3.0-or-later
// Fragility curves against closed forms and against the same likelihood solved elsewhere, and
// percentiles against their definition.
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_math.h>

#include "study/fragility.h"
#include "study/percentile.h"
#include "support/random.h"
#include "support/support.h"

// The iteration ends where a run adds 1e-13 to the gradient; the parameters of a few dozen runs
// follow from it to about the same.
static const double SOLVED = 1e-11;

static struct fragility fitted(const struct fragility_level *level, int n) {
    struct fragility f;
    struct error e;
    assert_int_equal(fragility_fit(level, n, &f, &e), STATUS_OK);
    return f;
}

// With two levels the curve passes through both fractions: Phi^-1 of them is linear in ln x.
static void two_levels_are_met_exactly(void **state) {
    (void)state;
    const struct fragility_level level[] = {{0.5, 10, 2}, {1.5, 20, 17}};
    const struct fragility f = fitted(level, 2);
    const double low = gsl_cdf_ugaussian_Pinv(0.2), high = gsl_cdf_ugaussian_Pinv(0.85);
    const double beta = log(3.0) / (high - low);
    assert_int_equal(f.outcome, FRAGILITY_FITTED);
    assert_close(f.dispersion, beta, SOLVED);
    assert_close(f.median, 0.5 * exp(-beta * low), SOLVED);
    assert_close(fragility_probability(&f, 0.5), 0.2, SOLVED);
    assert_close(fragility_probability(&f, 1.5), 0.85, SOLVED);
    assert_string_equal(fragility_reason(&f), "");
}

// Counts that are symmetric about x = 2 have the median 2, whatever else.
static void symmetric_counts_have_their_median_in_the_middle(void **state) {
    (void)state;
    const struct fragility_level level[] = {{8, 6, 6}, {0.5, 6, 0}, {1, 9, 2},
                                            {4, 9, 7}, {2, 5, 2},   {2, 5, 3}};
    const struct fragility f = fitted(level, 6);
    assert_close(f.median, 2.0, SOLVED);
    // The covariance of the two vanishes by symmetry, so the error of the median is that of a
    // binomial probit with a known slope: beta / sqrt(sum n phi^2 / (Phi (1 - Phi))).
    double information = 0.0;
    for (int j = 0; j < 6; j++) {
        const double eta = log(level[j].intensity / 2.0) / f.dispersion;
        const double p = gsl_cdf_ugaussian_P(eta), phi = exp(-eta * eta / 2) / sqrt(2 * M_PI);
        information += level[j].n * phi * phi / (p * (1 - p));
    }
    assert_close(f.log_median_error, f.dispersion / sqrt(information), 1e-9);
}

// Parameters are a solution of the score equations by mpmath with 40 digits, the errors those of
// Fisher's information there.
static void forty_records_at_eight_intensities_give_known_parameters(void **state) {
    (void)state;
    const struct fragility_level level[] = {{0.2, 40, 0},  {0.3, 40, 0}, {0.4, 40, 0},
                                            {0.6, 40, 4},  {0.7, 40, 6}, {0.8, 40, 13},
                                            {0.9, 40, 12}, {1.0, 40, 16}};
    const struct fragility f = fitted(level, 8);
    assert_close(f.median, 1.0761157942926833, SOLVED);
    assert_close(f.dispersion, 0.42923720383231837, SOLVED);
    assert_close(f.log_median_error, 0.07097381867945866, SOLVED);
    assert_close(f.dispersion_error, 0.082103654105443693, SOLVED);
}

// Solved by mpmath as above.
static void numbers_of_runs_may_differ(void **state) {
    (void)state;
    const struct fragility_level level[] = {{0.1, 5, 0}, {0.2, 7, 2}, {0.3, 5, 1},
                                            {0.4, 3, 3}, {0.5, 5, 4}, {0.6, 0, 0}};
    const struct fragility f = fitted(level, 6);
    assert_close(f.median, 0.30900884146597835, SOLVED);
    assert_close(f.dispersion, 0.50122693099247812, SOLVED);
    assert_close(f.log_median_error, 0.15235216324473744, SOLVED);
    assert_close(f.dispersion_error, 0.18792392231459209, SOLVED);
}

// The unit of the intensity scales the median and nothing else.
static void units_of_the_intensity_scale_the_median(void **state) {
    (void)state;
    struct fragility_level level[] = {{0.1, 5, 0}, {0.2, 7, 2}, {0.3, 5, 1}, {0.4, 3, 2}};
    const struct fragility f = fitted(level, 4);
    for (int j = 0; j < 4; j++) {
        level[j].intensity *= 981.0;
    }
    const struct fragility g = fitted(level, 4);
    assert_close(g.median, 981.0 * f.median, SOLVED);
    assert_close(g.dispersion, f.dispersion, SOLVED);
}

static void counts_without_a_curve_say_so(void **state) {
    (void)state;
    static const struct {
        struct fragility_level level[3];
        enum fragility_outcome outcome;
    } cases[] = {
        {{{1, 4, 0}, {2, 4, 0}, {3, 4, 0}}, FRAGILITY_NONE_EXCEEDS},
        {{{1, 4, 4}, {2, 4, 4}, {3, 4, 4}}, FRAGILITY_ALL_EXCEED},
        {{{1, 4, 0}, {2, 4, 0}, {3, 4, 4}}, FRAGILITY_SEPARATED},
        // Within the second level, a slope without bound makes the first and third certain.
        {{{1, 4, 0}, {2, 4, 2}, {3, 4, 4}}, FRAGILITY_SEPARATED},
        {{{1, 4, 3}, {1, 4, 2}, {3, 0, 0}}, FRAGILITY_ONE_LEVEL},
        {{{1, 4, 4}, {2, 4, 2}, {3, 4, 0}}, FRAGILITY_FALLS},
        {{{1, 4, 3}, {2, 4, 2}, {3, 4, 1}}, FRAGILITY_FALLS},
        {{{1, 4, 2}, {2, 4, 2}, {3, 4, 2}}, FRAGILITY_FALLS},
        // The slope is above 0 by so little that the median is beyond the numbers there are.
        {{{1, 717, 339}, {1.2456, 1230, 592}, {1.5516, 266, 124}}, FRAGILITY_FALLS},
        {{{1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, FRAGILITY_NO_RUNS},
        {{{0, 4, 0}, {2, 4, 2}, {3, 4, 1}}, FRAGILITY_NOT_POSITIVE},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const struct fragility f = fitted(cases[i].level, 3);
        assert_int_equal(f.outcome, cases[i].outcome);
        assert_true(isnan(f.median) && isnan(f.dispersion) && isnan(f.log_median_error));
        assert_true(fragility_reason(&f)[0] != '\0');
    }
    assert_close(fitted(cases[2].level, 3).between[0], 2.0, 0);
    assert_close(fitted(cases[2].level, 3).between[1], 3.0, 0);
}

// At the solution the gradient of the likelihood, by differences, vanishes; and no neighbour is
// likelier. Counts are random, steep and flat.
static double likelihood(const struct fragility_level *level, int n, double median, double beta) {
    double sum = 0.0;
    for (int j = 0; j < n; j++) {
        const double eta = log(level[j].intensity / median) / beta;
        const int k = level[j].exceeded;
        sum += k > 0 ? k * log(gsl_cdf_ugaussian_P(eta)) : 0.0;
        sum += k < level[j].n ? (level[j].n - k) * log(gsl_cdf_ugaussian_Q(eta)) : 0.0;
    }
    return sum;
}

static void no_other_parameters_are_likelier(void **state) {
    (void)state;
    struct random r = {.state = 20261121};
    int n_fitted = 0;
    for (int trial = 0; trial < 500; trial++) {
        struct fragility_level level[12];
        const double beta = exp(random_uniform(&r, -3, 1)), median = random_uniform(&r, 0.3, 3);
        for (int j = 0; j < 12; j++) {
            level[j] = (struct fragility_level){.intensity = 0.2 * (j + 1), .n = 1 + trial % 60};
            for (int k = 0; k < level[j].n; k++) {
                level[j].exceeded += random_uniform(&r, 0, 1) <
                                     gsl_cdf_ugaussian_P(log(level[j].intensity / median) / beta);
            }
        }
        const struct fragility f = fitted(level, 12);
        if (f.outcome != FRAGILITY_FITTED) {
            continue;
        }
        n_fitted++;
        const double best = likelihood(level, 12, f.median, f.dispersion);
        for (int k = 0; k < 8; k++) {
            const double step = 1e-3 * f.dispersion;
            const double x = f.median * exp(step * cos(k * M_PI / 4));
            assert_true(likelihood(level, 12, x, f.dispersion * (1 + 1e-3 * sin(k * M_PI / 4))) <
                        best);
        }
    }
    assert_true(n_fitted > 250);
}

static void percentiles_are_those_of_the_definition(void **state) {
    (void)state;
    // numpy.percentile([1, 2, 4, 8, 16], [16, 50, 84]): 1.64, 4.0, 10.88.
    const double five[] = {1, 2, 4, 8, 16};
    assert_close(percentile_sorted(five, 5, 0.16), 1.64, 1e-15);
    assert_close(percentile_sorted(five, 5, 0.50), 4.0, 0);
    assert_close(percentile_sorted(five, 5, 0.84), 10.88, 1e-15);
    const double one = 7;
    assert_close(percentile_sorted(&one, 1, 0.84), 7.0, 0);
}

static void failed_runs_count_above_all_others(void **state) {
    (void)state;
    const double value[] = {1, 2, 4, INFINITY, INFINITY};
    // The place of a quantile among five is 4 times the fraction: 0.64, 2 and 3.36.
    assert_close(percentile_sorted(value, 5, 0.16), 1.64, 1e-15);
    assert_close(percentile_sorted(value, 5, 0.50), 4.0, 0);
    assert_true(isinf(percentile_sorted(value, 5, 0.84)));
    assert_true(isinf(percentile_sorted(value, 5, 0.51)));
    const double none[] = {INFINITY, INFINITY}, half[] = {3, INFINITY};
    assert_true(isinf(percentile_sorted(none, 2, 0.0)));
    assert_close(percentile_sorted(half, 2, 0.0), 3.0, 0);
    assert_true(isinf(percentile_sorted(half, 2, 0.16)));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_levels_are_met_exactly),
        cmocka_unit_test(symmetric_counts_have_their_median_in_the_middle),
        cmocka_unit_test(forty_records_at_eight_intensities_give_known_parameters),
        cmocka_unit_test(numbers_of_runs_may_differ),
        cmocka_unit_test(units_of_the_intensity_scale_the_median),
        cmocka_unit_test(counts_without_a_curve_say_so),
        cmocka_unit_test(no_other_parameters_are_likelier),
        cmocka_unit_test(percentiles_are_those_of_the_definition),
        cmocka_unit_test(failed_runs_count_above_all_others),
    };
    gsl_set_error_handler_off();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
