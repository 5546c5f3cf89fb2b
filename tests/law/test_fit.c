// SPDX-License-Identifier: GPL-3.0-or-later
// Fits to records made by the laws themselves, exact and with noise.
#include <gsl/gsl_errno.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "law/fit.h"
#include "support/impact.h"
#include "support/support.h"

static const double MASS = 15384.615384615385;
static const double V0 = 0.5;

enum { SAMPLES = 240, AHEAD = 40 };

// A record: the bodies meet `phase` sampling intervals after sample AHEAD - 1, at START on its
// clock.
static const double START = 3.21;
struct made {
    double time[SAMPLES], force[SAMPLES];
    double since_closure[SAMPLES];
};

static void ignore(void *context, const struct isolated_point *p) {
    (void)context, (void)p;
}

static void take(void *context, int i, const struct isolated_point *p) {
    struct made *m = context;
    m->force[AHEAD + i] = p->force;
}

static void make(const struct contact_law *law, const double *value, double phase, struct made *m) {
    double constant[CONTACT_CONSTANTS_MAX];
    struct isolated_impact i = impact_of(law, value, MASS, V0);
    struct error e;
    const double interval = 1.2 * i.duration / (SAMPLES - AHEAD);
    *m = (struct made){.force = {0}};
    for (int k = 0; k < SAMPLES; k++) {
        m->since_closure[k] = (k - AHEAD + 1 - phase) * interval;
        m->time[k] = START + m->since_closure[k];
    }
    struct isolated_observer observer = {ignore, m, take, m->since_closure + AHEAD,
                                         SAMPLES - AHEAD};
    assert_int_equal(law->prepare(value, MASS, constant, &e), STATUS_OK);
    assert_int_equal(isolated_run(law, constant, MASS, V0, &observer, &i, &e), STATUS_OK);
}

static void add_noise(struct made *m, double deviation, unsigned seed) {
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    assert_non_null(rng);
    gsl_rng_set(rng, seed);
    for (int k = 0; k < SAMPLES; k++) {
        m->force[k] += gsl_ran_gaussian(rng, deviation);
    }
    gsl_rng_free(rng);
}

static int fit(const struct contact_law *law, const double *value, const struct made *m,
               struct fit_result *r, struct error *e) {
    const struct fit_request q = {law, value, MASS, V0, SAMPLES, m->time, m->force};
    return fit_run(&q, r, e);
}

// Fits the law that has made the record.
static struct fit_result refit(const struct contact_law *law, const double *value,
                               const struct made *m) {
    struct fit_result r = {.normalised_error = NAN};
    struct error e = {0};
    if (fit(law, value, m, &r, &e) != STATUS_OK) {
        fail_msg("%s: %s", law->name, e.message);
    }
    return r;
}

static const struct made_by {
    const char *law, *parameters;
} smooth[] =
    {
        {"hertz", "k 2.75e9"},
        {"linear", "k 93.5e6"},
        {"jankowski", "k 2.75e9 zeta 0.35"},
        {"jankowski", "k 2.75e9 zeta 0.02"},
        {"hertz-damp", "k 2.75e9 zeta 0.8"},
        {"hunt-crossley", "n 1 k 93.5e6 zeta 0.3"},
        {"power", "n 2.2 k 4e10 zeta 2"},
        {"ye-kelvin", "k 93.5e6 zeta 0.5"},
        {"wang", "residual 0.25 k 2.75e9 zeta 5.5e9"},
        {"wang", "residual 0.24 k 2.75e9 zeta 3.6e10"},
        {"rubber", "n 2 du 5e-3 ky 3e9 k 4e11 zeta 0.3"},
        {"khatami", "zeta 0.3 k 2.75e9"},
},
  jumping[] = {
      {"kelvin-voigt", "k 93.5e6 zeta 0.14"},     {"kelvin-voigt", "k 93.5e6 zeta 0.02"},
      {"komodromos", "k 93.5e6 zeta 0.3"},        {"mahmoud-jankowski", "k 93.5e6 zeta 0.33"},
      {"mahmoud-jankowski", "k 93.5e6 zeta 0.9"},
};

static const double PHASES[] = {0.0, 0.3, 0.5, 0.85};
enum { N_PHASE = sizeof PHASES / sizeof PHASES[0] };

static double given(const struct contact_law *law, const double *value, const char *key) {
    int row = contact_law_row(law, key);
    return row >= 0 ? value[row] : NAN;
}

// Measured at most 4e-10, where damping is small.
static void fits_exactly(const struct made_by *c) {
    double value[CONTACT_ROWS_MAX];
    const struct contact_law *law = impact_law(c->law, c->parameters, value);
    for (int i = 0; i < N_PHASE; i++) {
        struct made m;
        make(law, value, PHASES[i], &m);
        struct fit_result r = refit(law, value, &m);
        assert_close(r.k.value, given(law, value, "k"), 1e-8);
        assert_near(r.start.value, START, 1e-10);
        assert_near(r.normalised_error, 0.0, 1e-9);
        if (contact_law_row(law, "zeta") >= 0) {
            assert_close(r.zeta.value, given(law, value, "zeta"), 1e-8);
        } else {
            assert_true(isnan(r.zeta.value) && isnan(r.zeta.error));
        }
    }
}

static void an_exact_record_gives_its_parameters_back(void **state) {
    (void)state;
    for (size_t c = 0; c < sizeof smooth / sizeof smooth[0]; c++) {
        fits_exactly(&smooth[c]);
    }
}

static void so_does_one_of_a_force_that_jumps(void **state) {
    (void)state;
    for (size_t c = 0; c < sizeof jumping / sizeof jumping[0]; c++) {
        fits_exactly(&jumping[c]);
    }
}

static double norm(const double *x, const double *less) {
    double sum = 0.0;
    for (int i = 0; i < SAMPLES; i++) {
        sum += (x[i] - less[i]) * (x[i] - less[i]);
    }
    return sqrt(sum);
}

// Of the 44 numbers compared some two are expected beyond two standard errors, and none beyond
// four.
static void noise_moves_them_by_their_standard_errors(void **state) {
    (void)state;
    static const struct made_by by[] = {
        {"hertz", "k 2.75e9"},
        {"jankowski", "k 2.75e9 zeta 0.35"},
        {"hunt-crossley", "k 2.75e9 zeta 0.8"},
        {"wang", "residual 0.25 k 2.75e9 zeta 5.5e9"},
        {"wang", "residual 0.24 k 2.75e9 zeta 3.6e10"},
        {"rubber", "n 2 du 5e-3 ky 3e9 k 4e11 zeta 0.3"},
        {"kelvin-voigt", "k 93.5e6 zeta 0.14"},
        {"mahmoud-jankowski", "k 93.5e6 zeta 0.33"},
    };
    int beyond = 0;
    for (size_t c = 0; c < sizeof by / sizeof by[0]; c++) {
        double value[CONTACT_ROWS_MAX];
        static const double zero[SAMPLES];
        const struct contact_law *law = impact_law(by[c].law, by[c].parameters, value);
        for (int i = 0; i < N_PHASE; i++) {
            struct made m;
            make(law, value, PHASES[i], &m);
            const struct made exact = m;
            add_noise(&m, 0.02 * impact_of(law, value, MASS, V0).peak_force, 7 + (unsigned)i);
            struct fit_result r = refit(law, value, &m);
            const double k = given(law, value, "k");
            const double zeta = given(law, value, "zeta");
            assert_near(r.k.value, k, 4.0 * r.k.error);
            assert_near(r.start.value, START, 4.0 * r.start.error);
            assert_true(r.k.error < 0.02 * k && r.k.error > 0.002 * k);
            beyond += fabs(r.k.value - k) > 2.0 * r.k.error;
            if (!isnan(zeta)) {
                assert_near(r.zeta.value, zeta, 4.0 * r.zeta.error);
                assert_true(r.zeta.error < 0.06 * zeta && r.zeta.error > 0.005 * zeta);
                beyond += fabs(r.zeta.value - zeta) > 2.0 * r.zeta.error;
            }
            // What is left is the noise, less what three unknowns and the samples at jumps take.
            assert_close(r.normalised_error, norm(m.force, exact.force) / norm(m.force, zero),
                         0.03);
        }
    }
    assert_true(beyond <= 4);
}

// The logarithm of zeta runs away, until it makes no difference.
static void a_record_without_damping_has_next_to_none(void **state) {
    (void)state;
    double value[CONTACT_ROWS_MAX];
    struct made m;
    make(impact_law("hertz", "k 2.75e9", value), value, 0.4, &m);
    const struct contact_law *law = impact_law("jankowski", "", value);
    struct fit_result r = refit(law, value, &m);
    assert_close(r.k.value, 2.75e9, 1e-6);
    assert_true(r.zeta.value > 0.0 && r.zeta.value < 1e-6);
}

// With the same masses and velocity, no other law has this force.
static void the_law_that_made_the_record_fits_best(void **state) {
    (void)state;
    static const char *const other[] = {"hertz", "hunt-crossley", "linear", "kelvin-voigt"};
    double value[CONTACT_ROWS_MAX];
    struct made m;
    make(impact_law("jankowski", "k 2.75e9 zeta 0.35", value), value, 0.2, &m);
    for (size_t i = 0; i < sizeof other / sizeof other[0]; i++) {
        const struct contact_law *law = impact_law(other[i], "", value);
        double error = refit(law, value, &m).normalised_error;
        assert_true(error > 0.05 && error < 0.5);
    }
}

static void refused(const char *name, const struct made *m, size_t n, int status,
                    const char *message) {
    double value[CONTACT_ROWS_MAX];
    struct fit_result r;
    struct error e = {0};
    const struct contact_law *law = impact_law(name, "", value);
    const struct fit_request q = {law, value, MASS, V0, n, m->time, m->force};
    assert_int_equal(fit_run(&q, &r, &e), status);
    if (!strstr(e.message, message)) {
        fail_msg("'%s' is not in '%s'", message, e.message);
    }
}

static void what_cannot_be_fitted_is_refused(void **state) {
    (void)state;
    double value[CONTACT_ROWS_MAX];
    struct made m;
    make(impact_law("hertz", "k 2.75e9", value), value, 0.4, &m);
    refused("hertz", &m, 5, STATUS_INPUT, "the record has 5 samples; it must have 6 to");
    refused("bilinear", &m, SAMPLES, STATUS_INPUT, "bilinear has no k that could be fitted");
    for (int i = 0; i < SAMPLES; i++) {
        m.force[i] = -m.force[i];
    }
    refused("hertz", &m, SAMPLES, STATUS_INPUT, "compression must be positive");
}

// A force that is too large or too small for masses and velocity, by this factor.
static void refused_times(double factor) {
    static const char before[] = "e = J/(m* v) - 1 is ";
    double value[CONTACT_ROWS_MAX];
    struct made m;
    struct fit_result r;
    struct error e = {0};
    const struct contact_law *law = impact_law("jankowski", "k 2.75e9 zeta 0.35", value);
    make(law, value, 0.4, &m);
    for (int i = 0; i < SAMPLES; i++) {
        m.force[i] *= factor;
    }
    assert_int_equal(fit(law, value, &m, &r, &e), STATUS_INPUT);
    const char *at = strstr(e.message, before);
    assert_non_null(at);
    // Trapezia over 200 samples.
    const double want = factor * (1.0 + impact_of(law, value, MASS, V0).restitution) - 1.0;
    assert_near(strtod(at + sizeof before - 1, NULL), want, 2e-3);
    assert_non_null(
        strstr(e.message, "it must be >= 0 and <= 1: check masses, velocity and units"));
}

static void a_record_that_contradicts_mass_and_velocity_is_refused(void **state) {
    (void)state;
    refused_times(1.3);
    refused_times(0.5);
    refused_times(1e-3);
    double value[CONTACT_ROWS_MAX];
    struct made m;
    make(impact_law("hertz", "k 2.75e9", value), value, 0.4, &m);
    for (int i = 0; i < SAMPLES; i++) {
        m.force[i] = i % 2 ? -1.0 : 0.5 + (i == 100);
    }
    refused("hertz", &m, SAMPLES, STATUS_INPUT, "e = J/(m* v) - 1 is -1 with");
}

static void the_impulse_of_a_whole_record_implies_the_restitution(void **state) {
    (void)state;
    for (size_t c = 0; c < sizeof smooth / sizeof smooth[0]; c++) {
        double value[CONTACT_ROWS_MAX];
        struct made m;
        const struct contact_law *law = impact_law(smooth[c].law, smooth[c].parameters, value);
        make(law, value, 0.4, &m);
        const struct fit_result r = refit(law, value, &m);
        // Trapezia over 200 samples.
        assert_near(r.restitution, impact_of(law, value, MASS, V0).restitution, 2e-3);
        assert_true(r.cut == 0.0 && !fit_is_undetermined(&r.k) && !fit_is_undetermined(&r.zeta));
    }
}

static void a_record_that_is_cut_off_is_fitted_and_says_so(void **state) {
    (void)state;
    double value[CONTACT_ROWS_MAX];
    struct made m;
    struct fit_result r;
    struct error e = {0};
    const struct contact_law *law = impact_law("jankowski", "k 2.75e9 zeta 0.35", value);
    make(law, value, 0.4, &m);
    size_t n = SAMPLES, top = 0;
    for (size_t i = 0; i < SAMPLES; i++) {
        top = m.force[i] > m.force[top] ? i : top;
    }
    while (m.force[n - 1] < 0.4 * m.force[top]) {
        n--;
    }
    const struct fit_request q = {law, value, MASS, V0, n, m.time, m.force};
    assert_int_equal(fit_run(&q, &r, &e), STATUS_OK);
    assert_close(r.cut, m.force[n - 1] / m.force[top], 1e-12);
    assert_true(r.restitution < impact_of(law, value, MASS, V0).restitution);
    assert_close(r.k.value, 2.75e9, 1e-6);
    refused("jankowski", &m, top + 1, STATUS_INPUT, "the force is largest at an end of the record");
}

// The logarithm of a damping that is not there has a standard error above any value.
static void a_parameter_whose_error_exceeds_it_is_undetermined(void **state) {
    (void)state;
    double value[CONTACT_ROWS_MAX];
    struct made m;
    make(impact_law("hertz", "k 2.75e9", value), value, 0.4, &m);
    add_noise(&m, 0.02 * m.force[AHEAD + 80], 11);
    const struct contact_law *law = impact_law("jankowski", "", value);
    const struct fit_result r = refit(law, value, &m);
    assert_true(!fit_is_undetermined(&r.k) && fit_is_undetermined(&r.zeta));
}

// A dashpot whose force at closure is next to none does not jump there, which is no reason to take
// the samples at closure and opening into the sum again.
static void so_is_one_of_a_force_that_hardly_jumps(void **state) {
    (void)state;
    double value[CONTACT_ROWS_MAX];
    struct made m;
    make(impact_law("linear", "k 93.5e6", value), value, 0.4, &m);
    add_noise(&m, 0.02 * m.force[AHEAD + 80], 11);
    const struct contact_law *law = impact_law("kelvin-voigt", "", value);
    for (int i = 0; i < 3; i++) {
        const struct fit_request q = {law,     value,  MASS,   (1.0 - 0.001 * i) * V0,
                                      SAMPLES, m.time, m.force};
        struct fit_result r;
        struct error e;
        assert_int_equal(fit_run(&q, &r, &e), STATUS_OK);
        if (!fit_is_undetermined(&r.zeta) && r.zeta.value < 1e-3) {
            fail_msg("-v %g: zeta %g +- %g", q.velocity, r.zeta.value, r.zeta.error);
        }
    }
}

int main(void) {
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_exact_record_gives_its_parameters_back),
        cmocka_unit_test(so_does_one_of_a_force_that_jumps),
        cmocka_unit_test(noise_moves_them_by_their_standard_errors),
        cmocka_unit_test(a_record_without_damping_has_next_to_none),
        cmocka_unit_test(the_law_that_made_the_record_fits_best),
        cmocka_unit_test(what_cannot_be_fitted_is_refused),
        cmocka_unit_test(a_record_that_contradicts_mass_and_velocity_is_refused),
        cmocka_unit_test(the_impulse_of_a_whole_record_implies_the_restitution),
        cmocka_unit_test(a_record_that_is_cut_off_is_fitted_and_says_so),
        cmocka_unit_test(a_parameter_whose_error_exceeds_it_is_undetermined),
        cmocka_unit_test(so_is_one_of_a_force_that_hardly_jumps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
