// SPDX-License-Identifier: GPL-3.0-or-later
// Annual rates of exceedance against Cornell's closed form, against quadrature, and in their
// limits.
#include <gsl/gsl_integration.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "study/hazard.h"
#include "support/support.h"

static struct fragility lognormal(double median, double dispersion) {
    return (struct fragility){
        .outcome = FRAGILITY_FITTED, .median = median, .dispersion = dispersion};
}

// A straight line in logarithms gives rate(median) exp(k^2 beta^2 / 2) (Cornell 1996), if the curve
// is long enough. Points on the line change nothing.
static void a_power_law_gives_the_closed_form(void **state) {
    (void)state;
    const double k[] = {0.7, 2.0, 3.5, 12.0}, beta[] = {0.05, 0.4, 0.8};
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 3; j++) {
            const double x[] = {1e-9, 1e-2, 0.31, 5.0, 1e9};
            double rate[5];
            for (int p = 0; p < 5; p++) {
                rate[p] = 1e-3 * pow(x[p], -k[i]);
            }
            const struct hazard two = {2, (const double[]){x[0], x[4]},
                                       (const double[]){rate[0], rate[4]}};
            const struct hazard five = {5, x, rate};
            const struct fragility f = lognormal(0.3, beta[j]);
            const double want = 1e-3 * pow(0.3, -k[i]) * exp(0.5 * pow(k[i] * beta[j], 2.0));
            assert_close(hazard_exceedances(&two, &f, INFINITY), want, 1e-12);
            assert_close(hazard_exceedances(&five, &f, INFINITY), want, 1e-12);
        }
    }
}

struct integrand {
    const struct fragility *f;
    double x, rate, k;
};

static double of_log(double y, void *context) {
    const struct integrand *g = context;
    return fragility_probability(g->f, g->x * exp(y)) * g->k * g->rate * exp(-g->k * y);
}

// A curve that bends, up to several intensities on and between its points.
static void a_curve_gives_what_quadrature_gives(void **state) {
    (void)state;
    const double x[] = {0.05, 0.1, 0.3, 0.9, 2.0}, rate[] = {5e-2, 1.5e-2, 1.1e-3, 4e-5, 1e-6};
    const struct hazard h = {5, x, rate};
    gsl_integration_workspace *w = gsl_integration_workspace_alloc(1000);
    const double median[] = {0.02, 0.4, 3.0}, dispersion[] = {0.02, 0.3, 0.7};
    for (int c = 0; c < 9; c++) {
        const struct fragility f = lognormal(median[c / 3], dispersion[c % 3]);
        const double up_to[] = {0.05, 0.07, 0.1, 0.5, 2.0};
        for (int t = 0; t < 5; t++) {
            double want = 0.0;
            for (int i = 0; i < 4 && x[i] < up_to[t]; i++) {
                struct integrand g = {&f, x[i], rate[i],
                                      log(rate[i] / rate[i + 1]) / log(x[i + 1] / x[i])};
                const gsl_function of = {of_log, &g};
                double part, error;
                gsl_integration_qag(&of, 0.0, log(fmin(up_to[t], x[i + 1]) / x[i]), 1e-18, 1e-12,
                                    1000, GSL_INTEG_GAUSS31, w, &part, &error);
                want += part;
            }
            assert_near(hazard_exceedances(&h, &f, up_to[t]), want, 1e-10 * want + 1e-17);
        }
        const double last = fragility_probability(&f, 2.0);
        assert_near(hazard_exceedances(&h, &f, INFINITY) - hazard_exceedances(&h, &f, 2.0),
                    1e-6 * last, 1e-16);
        assert_near(hazard_beyond(&h, &f), 1e-6 * (1.0 - last), 1e-20);
    }
    gsl_integration_workspace_free(w);
}

// A certain limit is exceeded as often as its intensity; steep curves and wide fragilities, whose
// factors overflow, give finite rates.
static void limits_are_met(void **state) {
    (void)state;
    const struct hazard h = {2, (const double[]){0.1, 10}, (const double[]){1e-1, 1e-5}};
    const struct fragility sharp = lognormal(1.0, 1e-12);
    assert_close(hazard_exceedances(&h, &sharp, INFINITY), 1e-3, 1e-9);
    const struct fragility none = {.outcome = FRAGILITY_NONE_EXCEEDS};
    assert_true(isnan(hazard_exceedances(&h, &none, INFINITY)));
    const struct hazard steep = {2, (const double[]){1, 1.01}, (const double[]){1e-1, 1e-5}};
    const struct fragility wide = lognormal(1.0, 2.0);
    const double rate = hazard_exceedances(&steep, &wide, INFINITY);
    assert_true(rate > 0.5 * 1e-1 * 0.99 && rate < 0.501 * 1e-1);
}

static void a_file_is_read_in_the_unit_of_the_study(void **state) {
    (void)state;
    struct arena *a = arena_create();
    struct hazard h;
    struct error e;
    const struct dimension acceleration = dimension_acceleration;
    const char *path = support_write("hazard.txt", "PGA [g], rate\n0.1, 1e-2\n0.4, 1e-3\n");
    assert_int_equal(hazard_read(a, path, acceleration, 1.0, &h, &e), STATUS_OK);
    assert_close(h.intensity[1], 0.4 * 9.80665, 1e-15);
    assert_int_equal(hazard_read(a, path, acceleration, 9.80665, &h, &e), STATUS_OK);
    assert_int_equal(h.n, 2);
    assert_close(h.intensity[1], 0.4, 1e-15);
    assert_true(h.rate[0] == 1e-2 && h.rate[1] == 1e-3);
    static const struct {
        const char *text, *message;
    } wrong[] = {
        {"0.1 1e-2\n", "hazard.txt: a hazard curve has at least two points"},
        {"0.1 1e-2\n0.2 1e-2\n", "hazard.txt: the rate does not fall from intensity 0.1 to 0.2"},
        {"0.1 1e-2\n0.1 1e-3\n", "must exceed the last"},
        {"0 1e-2\n0.1 1e-3\n", "hazard.txt:1:1: intensity is 0; it must be > 0"},
        {"0.1 1e-2\n0.2 -1e-3\n", "hazard.txt:2:5: rate is -0.001; it must be > 0"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        path = support_write("hazard.txt", wrong[i].text);
        assert_int_equal(hazard_read(a, path, acceleration, 1.0, &h, &e), STATUS_INPUT);
        assert_non_null(strstr(e.message, wrong[i].message));
    }
    arena_free(a);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_power_law_gives_the_closed_form),
        cmocka_unit_test(a_curve_gives_what_quadrature_gives),
        cmocka_unit_test(limits_are_met),
        cmocka_unit_test(a_file_is_read_in_the_unit_of_the_study),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
