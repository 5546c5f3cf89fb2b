// SPDX-License-Identifier: GPL-3.0-or-later
// Buildings on bearings: converged solutions of other programs, the law that a bearing becomes, its
// weight, and what does without it.
#include <math.h>
#include <stdio.h>

#include "model/foundation.h"
#include "support/analysis.h"
#include "support/support.h"

#define RECORD                                                                                     \
    "ground record tests/verify/reference/elcentro_led_by_zero.txt -format series -unit g -dt "    \
    "0.02 -scale %g\nduration 31.18\n"
#define MASS "building A -floors 1 -mass 100t\n"

static double peak_of(const struct analysis *a, enum peak p, int dof) {
    return a->results->peak[p][dof];
}

// OpenSees: friction 0.05, R 2 m, sliding from 0.5 mm on, El Centro x 2; six digits are known.
static void a_friction_pendulum_has_its_known_peak(void **state) {
    (void)state;
    struct analysis a =
        analysis_of(MASS "isolator A:1 fps -radius 2m -mu 5%%\n" RECORD "step fixed 0.1ms\n", 2.0);
    assert_near(peak_of(&a, PEAK_DISPLACEMENT, 0), 0.248632, 0.6e-6);
    analysis_free(&a);
}

// Runge-Kutta of order 4 with steps of 2e-6 s: friction 0.04 at rest and 0.1 when fast, and
// constant friction 0.06. Its own error is 5.5e-6 of the peak, that of a second method 2.3e-5.
static void a_pendulum_agrees_with_a_converged_solution(void **state) {
    (void)state;
    static const struct {
        const char *bearing;
        double scale, displacement, force;
    } of[] = {
        {"-mu 0.1 -mu-slow 0.04 -rate 30s/m", 1.0, 0.02921720526, 109323.6876},
        {"-mu 0.1 -mu-slow 0.04 -rate 30s/m", 2.0, 0.1174417941, 152428.7816},
        {"-mu 0.06", 1.0, 0.05182096143, 84249.40157},
        {"-mu 0.06", 2.0, 0.1968827641, 155377.9179},
    };
    static const char *const step[] = {"step fixed 0.05ms", "step adaptive -tolerance 1e-9",
                                       "integrator newmark\nstep adaptive -tolerance 1e-9"};
    // Fixed steps are off by 1.2e-4 of the first peak, which falls with their length. The adaptive
    // ones of Newmark's method miss corners by their tolerance. Forces are those at ends of steps.
    static const double rtol[] = {1.3e-4, 2e-5, 5e-5}, of_force[] = {1.3e-4, 5e-5, 5e-5};
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 3; k++) {
            struct analysis a = analysis_of(MASS "isolator A:1 fps -radius 2m %s\n" RECORD "%s\n",
                                            of[i].bearing, of[i].scale, step[k]);
            assert_close(peak_of(&a, PEAK_DISPLACEMENT, 0), of[i].displacement, rtol[k]);
            assert_close(peak_of(&a, PEAK_SHEAR, 0), of[i].force, of_force[k]);
            assert_true(fabs(a.results->residual_peak) < 1e-8 * analysis_flow(&a));
            analysis_free(&a);
        }
    }
}

// The same bearing by hand: of lead and rubber, flat, and a pendulum of constant friction.
static void bearings_of_constant_strength_are_bilinear_storeys(void **state) {
    (void)state;
    static const struct {
        const char *bearing, *storey;
    } same[] = {
        {"lrb -q 60kN -kd 1MN/m -ki 12MN/m",
         "bilinear -stiffness 12MN/m -yield ${60kN / (1 - 1 / 12)} -hardening ${1 / 12}"},
        {"lrb -q 60kN -kd 1MN/m",
         "bilinear -stiffness 10MN/m -yield ${60kN / (1 - 1 / 10)} -hardening 0.1"},
        {"sliding -mu 5% -yield-drift 1mm", "bilinear -stiffness ${0.05 * 400t * 1g / 1mm} -yield "
                                            "${0.05 * 400t * 1g} -hardening 0"},
        {"fps -mu 5% -radius 2m -weight 3MN",
         "bilinear -stiffness ${3MN * (0.05 / 0.5mm + 1 / 2m)} -yield ${3MN * (0.05 + 0.5mm / 2m)} "
         "-hardening ${1 / 2m / (0.05 / 0.5mm + 1 / 2m)}"},
    };
    for (size_t i = 0; i < sizeof same / sizeof same[0]; i++) {
        const char *deck =
            "building A -floors 3 -mass 200t 100t 100t -stiffness 1 2*80MN/m "
            "-isolated 1\ndamping A rayleigh -beta 2ms\n%s A:1 %s\n" RECORD "step fixed 1ms\n";
        struct analysis a = analysis_of(deck, "isolator", same[i].bearing, 1.0);
        struct analysis b = analysis_of(deck, "storey", same[i].storey, 1.0);
        assert_close(a.model->building->stiffness[0], b.model->building->stiffness[0], 1e-14);
        for (enum peak q = 0; q < PEAK_COUNT; q++) {
            for (int dof = 0; dof < 3; dof++) {
                assert_close(peak_of(&a, q, dof), peak_of(&b, q, dof), 1e-12);
            }
        }
        analysis_free(&a);
        analysis_free(&b);
    }
}

// A loop of a bearing of lead and rubber: the force is q at drift 0, and the area 4 q (u - d_y).
static void a_loop_of_lead_and_rubber_has_its_corners(void **state) {
    (void)state;
    const double q = 60e3, kd = 1e6, ki = 12e6, dy = q / (ki - kd);
    struct model *m = analysis_model(MASS "isolator A:1 lrb -q 60kN -kd 1MN/m -ki 12MN/m\n"
                                          "initial A:1 -velocity 1\nstep fixed 1ms\nduration 1\n");
    const struct storey *s = foundation_storey(m, m->building, 0);
    double history[STOREY_HISTORY_MAX] = {0};
    const double drift[] = {dy, 0.1, 0.1 - 2 * dy, 0.0, -0.1, -0.1 + 2 * dy, 0.0};
    const double shear[] = {q + kd * dy,
                            q + kd * 0.1,
                            -q + kd * (0.1 - 2 * dy),
                            -q,
                            -q - kd * 0.1,
                            q + kd * (-0.1 + 2 * dy),
                            q};
    for (int i = 0; i < 7; i++) {
        assert_near(s->law->respond(s->constant, history, drift[i], history).shear, shear[i],
                    1e-12 * q);
    }
    assert_close(s->yield, q + kd * dy, 1e-14);
    model_free(m);
}

static double weight_in(const char *deck) {
    struct model *m =
        analysis_model("%sinitial A:1 -velocity 1\nstep fixed 1ms\nduration 1\n", deck);
    const struct building *g = &m->building[0];
    const int i = g->isolated - 1;
    // k = W / R + mu W / d.
    const double weight = g->stiffness[i] / (1 / 2.0 + 0.05 / 0.5e-3);
    assert_true(g->isolated > 0 && foundation_storey(m, g, i)->law->respond_at_rate);
    model_free(m);
    return weight;
}

static void the_weight_is_that_of_the_floors_above(void **state) {
    (void)state;
#define FLOORS "building A -floors 3 -mass 200t 100t 50t -stiffness 3*80MN/m -height 3\n"
    const double g = 9.80665;
    assert_close(weight_in(FLOORS "isolator A:1 fps -radius 2 -mu 5% -mu-slow 2% -rate 20\n"),
                 350e3 * g, 1e-12);
    assert_close(weight_in(FLOORS "isolator A:2 fps -radius 2 -mu 5% -mu-slow 2% -rate 20\n"),
                 150e3 * g, 1e-12);
    assert_close(weight_in(FLOORS "isolator A:1 fps -radius 2 -mu 5% -mu-slow 2% -rate 20 -weight "
                                  "5MN\n"),
                 5e6, 1e-12);
    assert_close(weight_in(FLOORS "isolator A:1 fps -radius 2 -mu 5% -mu-slow 2% -rate 20\n"
                                  "pdelta A -weight 1MN -leaning 0.5MN\n"),
                 4.5e6, 1e-12);
}

#define SLIDER "isolator A:1 fps -radius 1.5 -mu 8%% -mu-slow 4%% -rate 40\n"
#define HOUSE                                                                                      \
    "building A -floors 3 -mass 200t 2*100t -stiffness 1 2*80MN/m -height 1 2*3\n"                 \
    "damping A rayleigh -beta 2ms\n" SLIDER

// A foundation that hardly moves: its springs add 1e-6 of the flexibility of the storeys. Rounding
// of such springs is 1e6 times that of storeys, so the account is closed on a soft foundation.
static void a_bearing_on_a_stiff_foundation_is_one_on_the_ground(void **state) {
    (void)state;
    struct analysis fixed = analysis_of(HOUSE RECORD "step fixed 1ms\n", 1.0);
    struct analysis soil = analysis_of(
        HOUSE "foundation A -mass 100t -inertia 1000t*m2 -sway 1e14 -rocking 1e16\n" RECORD
              "step fixed 1ms\n",
        1.0);
    for (int dof = 0; dof < 3; dof++) {
        assert_close(peak_of(&soil, PEAK_DRIFT, dof), peak_of(&fixed, PEAK_DRIFT, dof), 1e-4);
        assert_close(peak_of(&soil, PEAK_SHEAR, dof), peak_of(&fixed, PEAK_SHEAR, dof), 1e-4);
    }
    struct analysis soft = analysis_of(
        HOUSE "foundation A -mass 100t -inertia 1000t*m2 -sway 300MN/m -sway-dashpot 2MN*s/m "
              "-rocking 9GN*m\n" RECORD "step fixed 1ms\n",
        1.0);
    assert_true(soft.results->residual_peak < 1e-10 * analysis_flow(&soft));
    assert_true(soft.results->energy[ENERGY_HYSTERETIC] > 0.3 * soft.results->energy[ENERGY_INPUT]);
    analysis_free(&fixed);
    analysis_free(&soil);
    analysis_free(&soft);
}

// The house hits the walls of its moat, by all methods; P-delta pushes it. Fixed steps and adaptive
// ones agree to the error of the fixed ones, and the account is closed.
static void a_moat_stops_an_isolated_building(void **state) {
    (void)state;
    static const char *const step[] = {"step fixed 0.1ms", "step adaptive -tolerance 1e-7",
                                       "integrator newmark\nstep adaptive -tolerance 1e-7"};
    double force[3], drift[3];
    for (int k = 0; k < 3; k++) {
        struct analysis a = analysis_of(
            HOUSE "pdelta A\ncontact wall A:1 -gap 60mm -law hunt-crossley -n 1 -k 500MN/m -e 0.5\n"
                  "contact A:1 wall -gap 60mm -law hunt-crossley -n 1 -k 500MN/m -e 0.5\n" RECORD
                  "%s\n",
            2.0, step[k]);
        assert_true(a.results->n_impact > 0);
        assert_true(a.results->residual_peak < (k == 0 ? 1e-10 : 1e-6) * analysis_flow(&a));
        assert_true(a.results->energy[ENERGY_HYSTERETIC] > 0.3 * a.results->energy[ENERGY_INPUT]);
        force[k] = fmax(a.results->link[0].force, a.results->link[1].force);
        drift[k] = peak_of(&a, PEAK_DRIFT, 0);
        analysis_free(&a);
    }
    for (int k = 1; k < 3; k++) {
        assert_close(force[k], force[0], 1e-3);
        assert_close(drift[k], drift[0], 1e-3);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_friction_pendulum_has_its_known_peak),
        cmocka_unit_test(a_pendulum_agrees_with_a_converged_solution),
        cmocka_unit_test(bearings_of_constant_strength_are_bilinear_storeys),
        cmocka_unit_test(a_loop_of_lead_and_rubber_has_its_corners),
        cmocka_unit_test(the_weight_is_that_of_the_floors_above),
        cmocka_unit_test(a_bearing_on_a_stiff_foundation_is_one_on_the_ground),
        cmocka_unit_test(a_moat_stops_an_isolated_building),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
