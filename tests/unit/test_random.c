// SPDX-License-Identifier: GPL-3.0-or-later
// Random values: first values against an independent program, moments, distributions, strata. The
// seeds are fixed, so that a test that passes always does; bounds say how often another seed would
// fail.
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics.h>
#include <math.h>
#include <string.h>

#include "deck/random.h"
#include "support/support.h"

enum { MANY = 20000 };
static double value[MANY], other[MANY];

static const struct distribution *find(const char *name) {
    for (int i = 0; i < n_random_distribution; i++) {
        if (strcmp(random_distributions[i]->name, name) == 0) {
            return random_distributions[i];
        }
    }
    fail_msg("no distribution %s", name);
    return NULL;
}

static struct random_values request(const char *distribution, double a, double b, int n) {
    return (struct random_values){.distribution = find(distribution),
                                  .a = a,
                                  .b = b,
                                  .min = -INFINITY,
                                  .max = INFINITY,
                                  .n = n,
                                  .seed = 1,
                                  .name = "k"};
}

static void draw(const struct random_values *r, double *to) {
    struct error e;
    assert_int_equal(random_draw(r, to, &e), STATUS_OK);
}

static void expect(const struct random_values *r, const double *want) {
    draw(r, value);
    for (int i = 0; i < r->n; i++) {
        // Two inversions of the normal distribution, each good to some 1e-15 of the score.
        assert_close(value[i], want[i], 1e-13);
    }
}

// By a program in Python: its own Mersenne twister (checked by the 3499211612 that seed 5489 must
// give), FNV-1a, shuffle, and the inverse normal distribution of its standard library.
static void first_values_are_those_of_an_independent_program(void **state) {
    (void)state;
    struct random_values r = request("normal", 10.0, 2.0, 5);
    expect(&r, (const double[]){13.326220338589501, 11.035348899280255, 12.889762895899311,
                                12.303191666263411, 8.7336886784247199});
    r.min = 8.0;
    r.max = 11.0;
    expect(&r, (const double[]){10.856746797958042, 10.152410435528008, 10.780931294773435,
                                10.637269094896368, 8.9451653977432368});
    r = request("uniform", 2.0, 5.0, 5);
    r.name = "e";
    expect(&r, (const double[]){3.7267658199416474, 4.7306048640748486, 3.885480162804015,
                                2.3655183397931978, 3.7689168757060543});
    r = request("uniform", 0.0, 1.0, 5);
    r.name = "e";
    r.plan = RANDOM_LATIN;
    expect(&r, (const double[]){0.91792779171373695, 0.16611294408794491, 0.32569268031511456,
                                0.73570809278171512, 0.59341958018485452});
    r = request("lognormal", 0.02, 0.4, 5);
    r.seed = 3;
    r.name = "gap";
    expect(&r, (const double[]){0.015079148272584018, 0.020535919934687615, 0.019877577709753,
                                0.012898365505621857, 0.02123701175168545});
}

// Mean and standard deviation within four standard errors, sd / sqrt(n) and, of a normal
// distribution, sd / sqrt(2 n): one seed in some 10^4 fails.
static void moments_are_those_of_the_distributions(void **state) {
    (void)state;
    const double root = sqrt(MANY);
    struct random_values r = request("normal", 10.0, 2.0, MANY);
    draw(&r, value);
    assert_near(gsl_stats_mean(value, 1, MANY), 10.0, 8.0 / root);
    assert_near(gsl_stats_sd(value, 1, MANY), 2.0, 8.0 / sqrt(2.0 * MANY));
    r = request("lognormal", 3.0, 0.5, MANY);
    draw(&r, value);
    // E x = m exp(b^2 / 2), Var x = (exp(b^2) - 1) (E x)^2
    const double mean = 3.0 * exp(0.125), sd = mean * sqrt(exp(0.25) - 1.0);
    assert_near(gsl_stats_mean(value, 1, MANY), mean, 4.0 * sd / root);
    r = request("uniform", 2.0, 5.0, MANY);
    draw(&r, value);
    const double spread = 3.0 / sqrt(12.0);
    assert_near(gsl_stats_mean(value, 1, MANY), 3.5, 4.0 * spread / root);
    // Of a uniform distribution the variance of x^2 is 4/5 of its square, so sd errs by
    // sd / sqrt(5 n).
    assert_near(gsl_stats_sd(value, 1, MANY), spread, 4.0 * spread / sqrt(5.0 * MANY));
}

// F(x) of what was asked for, from GSL's distributions and not from the program's scores.
static double distribution_of(const struct random_values *r, double x) {
    if (strcmp(r->distribution->name, "uniform") == 0) {
        return gsl_cdf_flat_P(x, r->a, r->b);
    }
    if (strcmp(r->distribution->name, "lognormal") == 0) {
        return gsl_cdf_lognormal_P(x, log(r->a), r->b);
    }
    return gsl_cdf_gaussian_P(x - r->a, r->b);
}

// Largest distance of the distribution of n values from the one asked for (Kolmogorov-Smirnov).
static double distance(const struct random_values *r) {
    const double from = isfinite(r->min) ? distribution_of(r, r->min) : 0.0,
                 to = isfinite(r->max) ? distribution_of(r, r->max) : 1.0;
    double most = 0.0;
    draw(r, value);
    gsl_sort(value, 1, (size_t)r->n);
    for (int i = 0; i < r->n; i++) {
        const double share = (distribution_of(r, value[i]) - from) / (to - from);
        most = fmax(most, fmax(share - (double)i / r->n, (i + 1.0) / r->n - share));
    }
    return most;
}

static void values_pass_the_test_of_kolmogorov_and_smirnov(void **state) {
    (void)state;
    // For large n, 1.95 / sqrt(n) is passed by one seed in a thousand: 2 exp(-2 1.95^2) = 1e-3.
    const double bound = 1.95 / sqrt(MANY);
    struct random_values r = request("normal", -3.0, 2.0, MANY);
    assert_true(distance(&r) < bound);
    r.min = -2.0;
    assert_true(distance(&r) < bound);
    r = request("lognormal", 0.02, 0.6, MANY);
    assert_true(distance(&r) < bound);
    r.min = 0.01;
    r.max = 0.03;
    assert_true(distance(&r) < bound);
    r = request("uniform", -1.0, 4.0, MANY);
    assert_true(distance(&r) < bound);
    // A Latin hypercube is never further than one stratum.
    r.plan = RANDOM_LATIN;
    assert_true(distance(&r) <= (1.0 + 1e-9) / MANY);
}

static void a_latin_hypercube_has_each_stratum_once(void **state) {
    (void)state;
    static const char *const name[] = {"normal", "lognormal", "uniform"};
    for (int k = 0; k < 3; k++) {
        enum { N = 997 };
        int count[N] = {0};
        struct random_values r = request(name[k], 1.0, 1.5, N);
        r.plan = RANDOM_LATIN;
        draw(&r, value);
        for (int i = 0; i < N; i++) {
            count[(int)(N * distribution_of(&r, value[i]))]++;
        }
        for (int i = 0; i < N; i++) {
            assert_int_equal(count[i], 1);
        }
    }
}

static void truncation_holds_far_from_the_middle_too(void **state) {
    (void)state;
    static const double ends[][2] = {{0, 0.1}, {5, 6}, {-6, -5}, {20, INFINITY}, {-INFINITY, -20}};
    for (size_t k = 0; k < sizeof ends / sizeof ends[0]; k++) {
        struct random_values r = request("normal", 0.0, 1.0, 1000);
        r.min = ends[k][0];
        r.max = ends[k][1];
        draw(&r, value);
        gsl_sort(value, 1, 1000);
        assert_true(value[0] >= r.min && value[999] <= r.max && value[0] < value[999]);
    }
    // The median beyond 20 standard deviations halves the tail: Q(x) = Q(20) / 2.
    struct random_values r = request("normal", 0.0, 1.0, MANY);
    r.min = 20.0;
    draw(&r, value);
    gsl_sort(value, 1, MANY);
    const double median = gsl_cdf_ugaussian_Qinv(gsl_cdf_ugaussian_Q(20.0) / 2.0);
    // Four standard errors of a median, 1 / (2 f sqrt(n)), f = 20 beyond 20 (nearly exponential).
    assert_near(value[MANY / 2], median, 4.0 / (40.0 * sqrt(MANY)));
    struct error e;
    r.min = 50.0;
    assert_int_equal(random_draw(&r, value, &e), STATUS_INPUT);
}

static void a_longer_sample_begins_like_a_shorter_one(void **state) {
    (void)state;
    struct random_values r = request("normal", 0.0, 1.0, 100);
    draw(&r, other);
    r.n = 1000;
    draw(&r, value);
    assert_memory_equal(value, other, 100 * sizeof *value);
}

// Parameters and seeds do not share numbers: a correlation of n independent pairs has the standard
// error 1 / sqrt(n).
static void other_names_and_seeds_give_independent_values(void **state) {
    (void)state;
    struct random_values r = request("normal", 0.0, 1.0, MANY);
    for (enum random_plan plan = RANDOM_INDEPENDENT; plan <= RANDOM_LATIN; plan++) {
        r.plan = plan;
        r.name = "k";
        r.seed = 1;
        draw(&r, value);
        r.name = "gap";
        draw(&r, other);
        assert_true(fabs(gsl_stats_correlation(value, 1, other, 1, MANY)) < 4.0 / sqrt(MANY));
        r.name = "k";
        r.seed = 2;
        draw(&r, other);
        assert_true(fabs(gsl_stats_correlation(value, 1, other, 1, MANY)) < 4.0 / sqrt(MANY));
    }
}

// The standard normal scores of a sample of "normal 0 1" are its values.
static struct random_values score_of(const char *name, enum random_plan plan,
                                     const struct random_values *before) {
    struct random_values r = request("normal", 0.0, 1.0, MANY);
    r.name = name;
    r.plan = plan;
    r.before = before;
    r.n_before = before ? before->n_before + 1 : 0;
    return r;
}

static void correlate(struct random_values *r, const double *correlation, double *weight) {
    assert_true(random_correlate(r, correlation, weight));
    r->correlation = correlation;
    r->weight = weight;
}

// z' = rho z_k + sqrt(1 - rho^2) z, both z as drawn without a correlation. A uniform parameter has
// the probabilities of z'.
static void a_correlated_score_mixes_two_independent_ones(void **state) {
    (void)state;
    static double mixed[MANY];
    const double rho[] = {-0.8};
    double weight[2];
    const struct random_values k = score_of("k", RANDOM_INDEPENDENT, NULL);
    struct random_values gap = score_of("gap", RANDOM_INDEPENDENT, &k);
    draw(&k, value);
    draw(&gap, other);
    correlate(&gap, rho, weight);
    draw(&gap, mixed);
    for (int i = 0; i < MANY; i++) {
        assert_near(mixed[i], -0.8 * value[i] + 0.6 * other[i], 1e-12);
    }
    gap.distribution = find("uniform");
    draw(&gap, value);
    for (int i = 0; i < MANY; i++) {
        assert_close(value[i], gsl_cdf_ugaussian_P(mixed[i]), 1e-14);
    }
}

// A sample correlation of normal values has the standard error (1 - rho^2) / sqrt(n). The strata
// of a Latin hypercube stay what they are.
static void three_parameters_have_their_correlations(void **state) {
    (void)state;
    static double third[MANY];
    for (enum random_plan plan = RANDOM_INDEPENDENT; plan <= RANDOM_LATIN; plan++) {
        const double rho_b[] = {0.6}, rho_c[] = {-0.3, 0.4};
        double weight_b[2], weight_c[3];
        const struct random_values a = score_of("a", plan, NULL);
        struct random_values b = score_of("b", plan, &a), c = score_of("c", plan, &b);
        correlate(&b, rho_b, weight_b);
        correlate(&c, rho_c, weight_c);
        draw(&a, value);
        draw(&b, other);
        draw(&c, third);
        assert_near(gsl_stats_correlation(value, 1, other, 1, MANY), 0.6, 4.0 * 0.64 / sqrt(MANY));
        assert_near(gsl_stats_correlation(value, 1, third, 1, MANY), -0.3, 4.0 * 0.91 / sqrt(MANY));
        assert_near(gsl_stats_correlation(other, 1, third, 1, MANY), 0.4, 4.0 * 0.84 / sqrt(MANY));
        assert_true(random_is_correlated(&c, &a) && random_is_correlated(&c, &b));
        assert_true(!random_is_correlated(&a, &c));
        if (plan == RANDOM_LATIN) {
            gsl_sort(third, 1, MANY);
            for (int i = 0; i < MANY; i++) {
                assert_int_equal((int)(MANY * gsl_cdf_ugaussian_P(third[i])), i);
            }
        }
    }
}

// The determinant of (1, r, r; r, 1, -r; r, -r, 1) is (1 + r)^2 (1 - 2 r).
static void correlations_must_be_possible_together(void **state) {
    (void)state;
    double weight_b[2], weight_c[3];
    for (int step = -1; step <= 1; step++) {
        const double r = 0.5 + 1e-9 * step, rho_b[] = {r}, rho_c[] = {r, -r};
        const struct random_values a = score_of("a", RANDOM_LATIN, NULL);
        struct random_values b = score_of("b", RANDOM_LATIN, &a);
        correlate(&b, rho_b, weight_b);
        const struct random_values c = score_of("c", RANDOM_LATIN, &b);
        assert_int_equal(random_correlate(&c, rho_c, weight_c), step < 0);
    }
}

static void quantiles_are_those_of_the_distribution(void **state) {
    (void)state;
    struct random_values r = request("lognormal", 3.0, 0.5, 1);
    assert_close(random_value(&r, 0.5), 3.0, 1e-15);
    assert_close(random_value(&r, 0.1), gsl_cdf_lognormal_Pinv(0.1, log(3.0), 0.5), 1e-13);
    assert_true(isinf(random_value(&r, 1.0)));
    r = request("uniform", 2.0, 5.0, 1);
    assert_true(random_value(&r, 0.0) == 2.0 && random_value(&r, 1.0) == 5.0);
    r = request("normal", 0.0, 1.0, 1);
    r.min = -1.0;
    r.max = 1.0;
    assert_true(random_value(&r, 0.0) == -1.0 && random_value(&r, 1.0) == 1.0);
    assert_near(random_value(&r, 0.5), 0.0, 1e-15);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(first_values_are_those_of_an_independent_program),
        cmocka_unit_test(moments_are_those_of_the_distributions),
        cmocka_unit_test(values_pass_the_test_of_kolmogorov_and_smirnov),
        cmocka_unit_test(a_latin_hypercube_has_each_stratum_once),
        cmocka_unit_test(truncation_holds_far_from_the_middle_too),
        cmocka_unit_test(a_longer_sample_begins_like_a_shorter_one),
        cmocka_unit_test(other_names_and_seeds_give_independent_values),
        cmocka_unit_test(a_correlated_score_mixes_two_independent_ones),
        cmocka_unit_test(three_parameters_have_their_correlations),
        cmocka_unit_test(correlations_must_be_possible_together),
        cmocka_unit_test(quantiles_are_those_of_the_distribution),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
