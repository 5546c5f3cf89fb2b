// SPDX-License-Identifier: GPL-3.0-or-later
// The correlation coefficient against its definition, limits and values by hand; the rules.
#include <complex.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_math.h>
#include <math.h>

#include "study/contact_free.h"
#include "support/support.h"

static double rho(double ta, double tb, double za, double zb) {
    return contact_free_correlation((const double[]){ta, tb}, (const double[]){za, zb});
}

static void buildings_that_are_alike_move_alike(void **state) {
    (void)state;
    assert_close(rho(0.7, 0.7, 0.05, 0.05), 1.0, 1e-15);
    // The printed formula at T and almost T: 1 - rho is of the order of (1 - r)^2 / (4 z^2).
    assert_near(rho(0.7, 0.7 * (1.0 + 1e-9), 0.05, 0.05), 1.0, 1e-12);
    assert_close(rho(1.0, 1.0, 0.0, 0.0), 1.0, 1e-15);
    assert_true(rho(1.0, 2.0, 0.0, 0.0) == 0.0);
    assert_true(isnan(rho(INFINITY, 1.0, 0.05, 0.05)));
}

static void correlations_are_those_computed_by_hand(void **state) {
    (void)state;
    // r = 1/2, z = 5 %: 8 0.05 (0.05 1.5) 0.353553391 / (0.5625 + 0.00625 + 0.005)
    assert_close(rho(0.5, 1.0, 0.05, 0.05), 0.010606601717798213 / 0.57375, 1e-13);
    // r = 0.9 and equal z: 8 z^2 (1 + r) r^1.5 / ((1 - r^2)^2 + 4 z^2 r (1 + r)^2)
    assert_close(rho(0.9, 1.0, 0.05, 0.05),
                 0.02 * 1.9 * 0.85381496824546242 / (0.19 * 0.19 + 0.01 * 0.9 * 1.9 * 1.9), 1e-13);
    // Equal periods, 2 % and 5 %: 8 sqrt(0.001) 0.07 / (8 0.001 + 4 0.0029)
    assert_close(rho(1.0, 1.0, 0.02, 0.05), 8.0 * sqrt(0.001) * 0.07 / 0.0196, 1e-13);
}

static void the_order_of_the_buildings_does_not_matter(void **state) {
    (void)state;
    assert_close(rho(0.6, 1.1, 0.02, 0.07), rho(1.1, 0.6, 0.07, 0.02), 1e-14);
}

struct pair {
    double w[2], z[2];
    int i, k;
};

// Re(H_i H_k*), H the displacement per ground acceleration.
static double cross_spectrum(double w, void *context) {
    const struct pair *p = context;
    const double complex a = p->w[p->i] * p->w[p->i] - w * w +
                             2.0 * I * p->z[p->i] * p->w[p->i] * w,
                         b = p->w[p->k] * p->w[p->k] - w * w +
                             2.0 * I * p->z[p->k] * p->w[p->k] * w;
    return creal(1.0 / (a * conj(b)));
}

static double covariance(struct pair p, int i, int k, gsl_integration_workspace *work) {
    double value, bound;
    p.i = i;
    p.k = k;
    gsl_function f = {cross_spectrum, &p};
    assert_int_equal(gsl_integration_qagiu(&f, 0.0, 0.0, 1e-10, 10000, work, &value, &bound), 0);
    return value;
}

// It is defined by white noise: covariance over the root of variances, here integrated numerically.
static void it_is_that_of_responses_to_white_noise(void **state) {
    (void)state;
    static const double cases[][4] = {
        {1, 0.5, 0.05, 0.05}, {1, 0.9, 0.02, 0.08}, {0.3, 2, 0.1, 0.03}, {1, 1, 0.02, 0.2}};
    gsl_integration_workspace *work = gsl_integration_workspace_alloc(10000);
    assert_non_null(work);
    for (size_t n = 0; n < sizeof cases / sizeof cases[0]; n++) {
        const double *c = cases[n];
        const struct pair p = {.w = {2.0 * M_PI / c[0], 2.0 * M_PI / c[1]}, .z = {c[2], c[3]}};
        const double want =
            covariance(p, 0, 1, work) / sqrt(covariance(p, 0, 0, work) * covariance(p, 1, 1, work));
        assert_close(rho(c[0], c[1], c[2], c[3]), want, 1e-7);  // of integrals to 1e-10
    }
    gsl_integration_workspace_free(work);
}

static const struct separation_site no_site = {.metre = 1.0, .ntc_slope = NAN};

static double separation(int rule, const struct separation_ends *ends) {
    return contact_free_separation(&contact_free_rules[rule], ends, &no_site);
}

static void the_rules_combine_displacements(void **state) {
    (void)state;
    struct separation_ends ends = {
        .displacement = {0.3, 0.4}, .period = {1.0, 0.5}, .damping = {0.05, 0.05}};
    assert_close(separation(0, &ends), 0.7, 1e-15);
    assert_close(separation(1, &ends), 0.5, 1e-15);
    assert_close(separation(2, &ends), 0.35, 1e-15);
    assert_close(separation(3, &ends), sqrt(0.25 - 0.24 * rho(1.0, 0.5, 0.05, 0.05)), 1e-14);
    ends.period[1] = 1.0;  // alike: the difference of the displacements
    assert_close(separation(3, &ends), 0.1, 1e-14);
    ends.displacement[1] = 0.0;  // a wall, which has no period
    ends.period[1] = ends.damping[1] = NAN;
    for (int k = 0; k < SEPARATION_GENERAL; k++) {
        assert_close(separation(k, &ends), k == 2 ? 0.21 : 0.3, 1e-15);
    }
}

static void a_rule_without_its_correlation_has_no_value(void **state) {
    (void)state;
    struct separation_ends ends = {
        .displacement = {0.3, 0.4}, .period = {1.0, INFINITY}, .damping = {0.05, NAN}};
    assert_true(isnan(separation(3, &ends)));
    assert_close(separation(1, &ends), 0.5, 1e-15);
    ends.period[1] = 0.5;
    ends.damping[1] = -0.01;  // it swings ever wider
    assert_true(isnan(separation(3, &ends)));
    ends.damping[0] = -0.02;
    assert_true(isnan(separation(3, &ends)));
}

// By hand from the texts: 100 mm up to 15 m, 20 mm more for each 5, 4, 3 or 2 m of intensity 6 to
// 9; frames with walls 70 %, walls 50 %, never below 100 mm; the lower building counts.
static void gb_50011_is_computed_by_hand(void **state) {
    (void)state;
    const struct separation_rule *rule = &contact_free_rules[SEPARATION_GB];
    struct separation_site site = {.metre = 1000.0, .gb_step = 3.0, .gb_share = 1.0};  // in mm
    struct separation_ends ends = {.height = {60e3, 30e3}};
    assert_close(contact_free_separation(rule, &ends, &site), 200.0, 1e-14);
    site.gb_step = 2.0;
    assert_close(contact_free_separation(rule, &ends, &site), 250.0, 1e-14);
    site.gb_share = 0.7;
    assert_close(contact_free_separation(rule, &ends, &site), 175.0, 1e-14);
    ends.height[0] = 14e3;
    assert_close(contact_free_separation(rule, &ends, &site), 100.0, 1e-14);
    site.gb_share = 1.0;
    assert_close(contact_free_separation(rule, &ends, &site), 100.0, 1e-14);
    ends.height[0] = INFINITY;  // a wall
    assert_close(contact_free_separation(rule, &ends, &site), 250.0, 1e-14);
    ends.height[1] = NAN;
    assert_true(isnan(contact_free_separation(rule, &ends, &site)));
    ends.height[1] = 30e3;
    site.gb_step = 0.0;
    assert_true(isnan(contact_free_separation(rule, &ends, &site)));
}

// Of each building its displacement and a share of the level, at least 50 mm.
static void ntc_is_computed_by_hand(void **state) {
    (void)state;
    const struct separation_rule *rule = &contact_free_rules[SEPARATION_NTC];
    struct separation_site site = {.metre = 100.0, .ntc_slope = 0.006};  // in cm
    struct separation_ends ends = {
        .displacement = {20.0, 1.0}, .level = {1200.0, 400.0}, .height = {3000.0, 800.0}};
    assert_close(contact_free_separation(rule, &ends, &site), 20.0 + 7.2 + 5.0, 1e-14);
    site.ntc_slope = 0.001;
    assert_close(contact_free_separation(rule, &ends, &site), 21.2 + 5.0, 1e-14);
    ends = (struct separation_ends){
        .displacement = {20.0, 0.0}, .level = {1200.0, NAN}, .height = {3000.0, INFINITY}};
    assert_close(contact_free_separation(rule, &ends, &site), 21.2, 1e-14);
    ends.level[0] = NAN;
    assert_true(isnan(contact_free_separation(rule, &ends, &site)));
    assert_true(isnan(contact_free_separation(rule, &ends, &no_site)));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(buildings_that_are_alike_move_alike),
        cmocka_unit_test(correlations_are_those_computed_by_hand),
        cmocka_unit_test(the_order_of_the_buildings_does_not_matter),
        cmocka_unit_test(it_is_that_of_responses_to_white_noise),
        cmocka_unit_test(the_rules_combine_displacements),
        cmocka_unit_test(a_rule_without_its_correlation_has_no_value),
        cmocka_unit_test(gb_50011_is_computed_by_hand),
        cmocka_unit_test(ntc_is_computed_by_hand),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
