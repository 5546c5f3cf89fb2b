// SPDX-License-Identifier: GPL-3.0-or-later
// Runs in lockstep against the same runs alone: every result has the same bits.
#include <gsl/gsl_errno.h>
#include <math.h>
#include <string.h>

#include "jostle/ensemble.h"
#include "support/analysis.h"
#include "support/support.h"

// The bits of two arrays.
static void assert_same(const void *got, const void *want, size_t n, const char *what) {
    if (memcmp(got, want, n) != 0) {
        fail_msg("%s differ", what);
    }
}

static void assert_same_results(const struct model *m, const struct results *got,
                                const struct results *want) {
    size_t floors = (size_t)m->n_dof * sizeof(double);
    for (int q = 0; q < PEAK_COUNT; q++) {
        assert_same(got->peak[q], want->peak[q], floors, peak_names[q]);
        assert_same(got->peak_time[q], want->peak_time[q], floors, "times of peaks");
    }
    for (int k = 0; k < m->n_link; k++) {
        const struct link_peak *a = &got->link[k], *b = &want->link[k];
        assert_same(a, b, offsetof(struct link_peak, impacts), "totals of a link");
        assert_int_equal(a->impacts, b->impacts);
    }
    assert_same(got->deepest, want->deepest, (size_t)m->n_contact * sizeof(double), "penetrations");
    assert_int_equal(got->n_impact, want->n_impact);
    for (long i = 0; i < want->n_impact; i++) {
        const struct impact *a = &got->impact[i], *b = &want->impact[i];
        assert_int_equal(a->contact, b->contact);
        assert_int_equal(a->complete, b->complete);
        assert_int_equal(a->steps, b->steps);
        assert_same(&a->t_start, &b->t_start, 4 * sizeof(double), "times of an impact");
        assert_same(&a->peak_force, &b->peak_force, 4 * sizeof(double), "forces of an impact");
    }
    assert_same(got->energy, want->energy, sizeof want->energy, "energies");
    assert_same(&got->initial_energy, &want->initial_energy, sizeof(double), "initial energies");
    assert_same(&got->residual_peak, &want->residual_peak, sizeof(double), "residuals");
    assert_same(&got->totals, &want->totals, offsetof(struct totals, seconds), "totals");
}

// Runs the members together, compares each with its run alone, and frees both. Returns the number
// of impacts.
static long compare(struct ensemble_member *member, int n) {
    long n_impact = 0;
    ensemble_run(member, n, NULL);
    for (int k = 0; k < n; k++) {
        struct results *alone = NULL;
        struct error e = {0};
        int status = analysis_run(member[k].model, NULL, &alone, &e);
        assert_int_equal(member[k].status, status);
        if (status == STATUS_OK) {
            assert_same_results(member[k].model, member[k].results, alone);
            n_impact += alone->n_impact;
        } else {
            assert_string_equal(member[k].error.message, e.message);
            assert_null(member[k].results);
        }
        results_free(member[k].results);
        results_free(alone);
    }
    return n_impact;
}

static void free_models(struct ensemble_member *member, int n) {
    for (int k = 0; k < n; k++) {
        model_free((struct model *)member[k].model);
    }
}

#define PAIR                                                                                       \
    "building A -floors 8 -mass %gt -stiffness 345MN/m\n"                                          \
    "building B -floors 5 -mass 300t -stiffness 345MN/m\n"                                         \
    "damping A rayleigh 5%%\ndamping B rayleigh 5%%\n"                                             \
    "ground %s\nduration %gs\nstep fixed %g\n"                                                     \
    "contact A B -gap %gmm -law %s\n"

static const char sine[] = "sine -amplitude 2 -frequency 1.3 -cycles 8";
static const char record[] = "record input/records/ELCENTRO_1940_NS.AT2";
static const char other[] = "record input/records/NAPA_2014_68150_HNE.AT2 -scale 3";
static const char jankowski[] = "jankowski -k 2.75e9N/m^1.5 -zeta 0.35";

static struct ensemble_member pair(double mass, const char *ground, double gap, const char *law) {
    return (struct ensemble_member){.model =
                                        analysis_model(PAIR, mass, ground, 8.0, 1e-3, gap, law)};
}

static void eight_gaps_give_the_bits_of_eight_runs(void **state) {
    (void)state;
    struct ensemble_member member[ENSEMBLE_MAX];
    for (int k = 0; k < ENSEMBLE_MAX; k++) {
        member[k] = pair(300, record, 5.0 * k, jankowski);
    }
    assert_true(compare(member, ENSEMBLE_MAX) > 50);
    free_models(member, ENSEMBLE_MAX);
}

static void laws_masses_and_grounds_may_differ(void **state) {
    (void)state;
    struct ensemble_member member[] = {
        pair(300, record, 5, "linear -k 100MN/m"),
        pair(280, other, 10, "kelvin-voigt -k 100MN/m -e 0.65"),
        pair(310, sine, 15, "hertz -k 2.75e9N/m^1.5"),
        pair(290, record, 8, jankowski),
        pair(305, "record input/records/ELCENTRO_1940_NS.AT2 -scale 2", 20,
             "hertz-damp -k 2.75e9N/m^1.5 -e 0.65"),
    };
    assert_true(compare(member, 5) > 50);
    free_models(member, 5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eight_gaps_give_the_bits_of_eight_runs),
        cmocka_unit_test(laws_masses_and_grounds_may_differ),
    };
    gsl_set_error_handler_off();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
