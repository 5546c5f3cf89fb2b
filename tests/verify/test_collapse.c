// SPDX-License-Identifier: GPL-3.0-or-later
// Runs that end in a collapse: against converged solutions of another program, the instant and the
// rows, and what stays the same where none collapses.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "jostle/ensemble.h"
#include "support/analysis.h"
#include "support/support.h"

#define RECORD "tests/verify/reference/elcentro_led_by_zero.txt"
#define ADAPTIVE "integrator newmark\nstep adaptive -tolerance 1e-7\n"
#define DORMAND_PRINCE "integrator dormand-prince\nstep adaptive -tolerance 1e-9\n"

// One storey as in test_pdelta.c: the drift passes 0.3 m at that time. Converged to 1e-6 s by
// explicit Runge-Kutta steps of 1e-5 s. `most` is the largest displacement to the other side.
static const struct {
    double hardening, theta, scale, time, most;
} collapses[] = {
    {0, 0.04, 2, 5.32063133, 0.08793134139},   {0, 0.083, 1, 8.66157749, 0.02297000377},
    {0, 0.083, 2, 4.76278434, 0.101222393},    {0, 0.1, 1, 5.5383716, 0.02324079383},
    {0, 0.1, 2, 4.81686043, 0.1075715583},     {0.05, 0.083, 2, 5.42806473, 0.0940651027},
    {0.05, 0.1, 2, 5.29684609, 0.09951916781},
};

static struct analysis one_storey(size_t i, const char *limit, const char *step) {
    return analysis_of("param k 39.4784176\nbuilding A -floors 1 -mass 1 -stiffness $k -height 3\n"
                       "damping A rayleigh 5%%\nstorey A bilinear -yield 0.980665 -hardening %g\n"
                       "pdelta A -weight ${%.17g * k * 3}\n%s"
                       "ground record " RECORD " -format series -unit g -dt 0.02 -scale %g\n"
                       "duration 31.18\n%s",
                       collapses[i].hardening, collapses[i].theta, limit, collapses[i].scale, step);
}

static void compare(const char *step, double tolerance, double missed) {
    for (size_t i = 0; i < sizeof collapses / sizeof collapses[0]; i++) {
        struct analysis a = one_storey(
            i, i % 2 ? "collapse drift 0.3\n" : "collapse drift-ratio 10% -storeys A:1\n", step);
        const struct collapse *c = &a.results->collapse;
        const long last = a.rows.n - 1;
        double most = 0;
        assert_true(c->happened && c->dof == 0);
        assert_close(c->time, collapses[i].time, tolerance);
        assert_true(c->drift <= -0.3 && c->drift >= -0.3 * (1 + 1e-8));
        // The rows end at that instant, and the peaks there.
        assert_true(a.rows.time[last] == c->time && a.rows.time[last - 1] < c->time);
        assert_true(a.rows.displacement[last] == c->drift);
        assert_true(a.results->peak[PEAK_DRIFT][0] == -c->drift);
        assert_true(a.results->peak_time[PEAK_DRIFT][0] == c->time);
        for (long n = 0; n <= last; n++) {
            most = fmax(most, a.rows.displacement[n]);
        }
        assert_near(most, collapses[i].most, fmax(1e-4, tolerance * 0.3));
        assert_true(a.results->residual_peak <= missed * analysis_flow(&a));
        assert_true(a.results->totals.unsolved == 0);
        analysis_free(&a);
    }
}

static void one_storey_collapses_when_others_say(void **state) {
    (void)state;
    compare("step fixed 0.001\noutput -every 1\n", 2e-5, 1e-12);
    compare(ADAPTIVE "output -interval 0.001\n", 2e-5, 1e-12);
    compare(DORMAND_PRINCE "output -interval 0.001\n", 1e-8, 1e-6);
}

// At steps ten times as long the instant is within the step, too.
static void the_instant_is_located_in_the_step(void **state) {
    (void)state;
    compare("step fixed 0.02\noutput -every 1\n", 1e-2, 1e-12);
}

// Without a limit a storey that loses its equilibrium collapses when its drift is its height.
static void lost_equilibrium_is_a_collapse(void **state) {
    (void)state;
    static const char *const step[] = {"step fixed 0.001\n", ADAPTIVE, DORMAND_PRINCE};
    for (size_t i = 0; i < sizeof step / sizeof step[0]; i++) {
        struct analysis a = one_storey(1, "", step[i]);
        assert_true(a.results->collapse.happened);
        assert_close(a.results->collapse.drift, -3.0, 1e-8);
        assert_true(isfinite(a.results->residual_peak));
        analysis_free(&a);
    }
}

#define TWO                                                                                        \
    "building A -floors 3 -mass 1 -stiffness 300 260 200 -height 3\n"                              \
    "building B -floors 2 -mass 1 -stiffness 500 -height 3\n"                                      \
    "storey A bilinear -yield 3 2.6 1.8 -hardening 0.03\npdelta A -leaning 10\n"                   \
    "damping A rayleigh -alpha 0.4 -beta 0\ndamping B rayleigh 5%%\n"                              \
    "ground record input/records/ELCENTRO_1940_NS.AT2 -scale %g\nduration 15\n%s\n"
#define CONTACT "contact A B -gap 0.02 -law %s\n"

// Several storeys, with contacts whose forces jump, rigid ones, and all methods: the same storey
// at nearly the same time.
static void methods_agree_on_the_storey_and_the_time(void **state) {
    (void)state;
    static const char *const law[] = {"kelvin-voigt -k 5e4 -e 0.6", "hertz-damp -k 2e5 -e 0.6",
                                      "stereomechanical -e 0.6"};
    for (size_t i = 0; i < sizeof law / sizeof law[0]; i++) {
        double time = 0;
        int dof = -1;
        static const char *const step[] = {"step fixed 0.0005", ADAPTIVE, DORMAND_PRINCE};
        // Dormand & Prince's method does not follow rigid contacts at rest.
        const size_t n = sizeof step / sizeof step[0] - (i == 2);
        for (size_t k = 0; k < n; k++) {
            struct analysis a =
                analysis_of(TWO CONTACT "collapse drift-ratio 4%%\n", 3.0, step[k], law[i]);
            const struct collapse *c = &a.results->collapse;
            assert_true(c->happened);
            assert_close(fabs(c->drift), 0.12, 1e-8);
            assert_true(a.results->n_impact > 0);
            assert_true(k == 0 || c->dof == dof);
            assert_close(c->time, k == 0 ? c->time : time, 2e-3);
            time = c->time;
            dof = c->dof;
            analysis_free(&a);
        }
    }
}

// A limit that no storey reaches changes no bit, in steps of storeys on their lines, of elastic
// ones, with parts and contacts.
static void a_limit_that_is_not_reached_changes_nothing(void **state) {
    (void)state;
    const char *file = support_write("two.txt", "90 -30\n-30 30\n");
    char with_matrix[400];
    snprintf(with_matrix, sizeof with_matrix,
             "building M -floors 2 -mass 1 -height 3\nmatrix M %s\nground record "
             "input/records/ELCENTRO_1940_NS.AT2\nduration 15\nstep fixed 0.002\n",
             file);
    char towers[1000];
    snprintf(towers, sizeof towers, TWO CONTACT, 0.5, "step fixed 0.001", "linear -k 5e4");
    static const char elastic[] = "building A -floors 4 -mass 1 -stiffness 300 -height 3\n"
                                  "ground record input/records/ELCENTRO_1940_NS.AT2\n"
                                  "duration 15\nstep fixed 0.002\n";
    const char *const deck[] = {with_matrix, towers, elastic};
    for (size_t i = 0; i < sizeof deck / sizeof deck[0]; i++) {
        struct analysis a = analysis_of("%s", deck[i]),
                        b = analysis_of("%scollapse drift 0.9\n", deck[i]);
        assert_true(!a.results->collapse.happened && !b.results->collapse.happened);
        analysis_assert_same(a.model, b.results, a.results);
        analysis_free(&a);
        analysis_free(&b);
    }
}

// The fast steps see the limit where it is just reached, and where it is just not.
static void a_limit_at_the_peak_is_seen(void **state) {
    (void)state;
    char deck[1000], limited[1100];
    snprintf(deck, sizeof deck, TWO, 0.5, "step fixed 0.001");
    struct analysis a = analysis_of("%s", deck);
    const double peak = a.results->peak[PEAK_DRIFT][1], when = a.results->peak_time[PEAK_DRIFT][1];
    for (int i = 0; i < 2; i++) {
        snprintf(limited, sizeof limited, "%scollapse drift %.17g -storeys A:2\n", deck,
                 peak * (i == 0 ? 1 - 1e-6 : 1 + 1e-6));
        struct analysis b = analysis_of("%s", limited);
        assert_true(b.results->collapse.happened == (i == 0));
        assert_true(i == 1 ||
                    (b.results->collapse.time <= when && b.results->collapse.time > when - 0.01));
        analysis_free(&b);
    }
    analysis_free(&a);
}

// Elastic storeys, in lockstep as alone: some of the runs collapse.
static void runs_in_lockstep_collapse_as_alone(void **state) {
    (void)state;
    struct ensemble_member member[ENSEMBLE_MAX];
    int n_collapsed = 0;
    for (int k = 0; k < ENSEMBLE_MAX; k++) {
        member[k] = (struct ensemble_member){
            .model = analysis_model(
                "building A -floors 4 -mass 1 -stiffness 400 -height 3\n"
                "building B -floors 3 -mass 1 -stiffness 900 -height 3\ndamping A rayleigh 5%%\n"
                "damping B rayleigh 5%%\npdelta A -leaning 3\ncollapse drift 0.05 -storeys A:1:3\n"
                "contact A B -gap 0.01 -law kelvin-voigt -k 1e5 -e 0.6\n"
                "ground record input/records/ELCENTRO_1940_NS.AT2 -scale %g\nduration 10\n"
                "step fixed 0.001\n",
                0.3 * (1 + k))};
        assert_true(ensemble_suits(member[k].model));
    }
    ensemble_run(member, ENSEMBLE_MAX, NULL);
    for (int k = 0; k < ENSEMBLE_MAX; k++) {
        struct results *alone;
        struct error e;
        assert_int_equal(member[k].status, STATUS_OK);
        assert_int_equal(analysis_run(member[k].model, NULL, &alone, &e), STATUS_OK);
        analysis_assert_same(member[k].model, member[k].results, alone);
        assert_memory_equal(&member[k].results->collapse, &alone->collapse, sizeof alone->collapse);
        n_collapsed += alone->collapse.happened;
        results_free(alone);
        results_free(member[k].results);
        model_free((struct model *)member[k].model);
    }
    assert_true(n_collapsed > 1 && n_collapsed < ENSEMBLE_MAX - 1);
}

// Steps that a negative tangent makes too long are cut: here M + beta h^2 K is not positive
// definite at the step of the deck.
static void long_steps_are_cut_where_tangents_are_negative(void **state) {
    (void)state;
    struct analysis a =
        analysis_of("building A -floors 1 -mass 1 -stiffness 100 -height 1\n"
                    "storey A bilinear -yield 20 -hardening 0\npdelta A -weight 50\n"
                    "initial A -velocity 3\nstep fixed 0.4\noutput -every 1\nduration 8\n");
    assert_true(a.results->totals.indefinite > 0 && a.results->totals.rejected > 0);
    assert_true(a.results->collapse.happened);
    assert_true(a.results->residual_peak <= 1e-12 * analysis_flow(&a));
    analysis_free(&a);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_storey_collapses_when_others_say),
        cmocka_unit_test(the_instant_is_located_in_the_step),
        cmocka_unit_test(lost_equilibrium_is_a_collapse),
        cmocka_unit_test(methods_agree_on_the_storey_and_the_time),
        cmocka_unit_test(a_limit_that_is_not_reached_changes_nothing),
        cmocka_unit_test(a_limit_at_the_peak_is_seen),
        cmocka_unit_test(runs_in_lockstep_collapse_as_alone),
        cmocka_unit_test(long_steps_are_cut_where_tangents_are_negative),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
