// SPDX-License-Identifier: GPL-3.0-or-later
// Buildings with links that have laws: dampers, braces and cables. The numbers of the four models
// under El Centro are those of an independent program with Runge-Kutta steps of 10 us, which agree
// with a second program to 3e-5 or better.
#include <math.h>
#include <stdio.h>

#include "support/analysis.h"
#include "support/support.h"

#define BUILDING                                                                                   \
    "units N m s\nbuilding A -floors 4 -mass 120t -stiffness 160MN/m 150MN/m 130MN/m 100MN/m\n"    \
    "damping A rayleigh 2%%\n"

// Fixed steps, and both methods of adaptive steps.
static const char *const step[] = {"step fixed 0.5ms\n",
                                   "integrator newmark\nstep adaptive -tolerance 1e-8\n",
                                   "integrator dormand-prince\nstep adaptive -tolerance 1e-9\n"};
enum { N_STEP = 3, FLOORS = 4 };

struct reference {
    const char *deck;
    double scale;
    int n_link;
    double displacement[FLOORS], acceleration[FLOORS], drift[FLOORS];
    double force[4], deformation[4], work[4];
    double rtol[N_STEP];
};

static void assert_reference(const struct reference *want) {
    for (int s = 0; s < N_STEP; s++) {
        const double rtol = want->rtol[s];
        struct analysis a =
            analysis_of(BUILDING "%sground record %s -format series -dt 0.02 -unit g "
                                 "-scale %g\nduration 31.18\n%s",
                        want->deck, analysis_el_centro(), want->scale, step[s]);
        const struct results *r = a.results;
        for (int i = 0; i < FLOORS; i++) {
            assert_close(r->peak[PEAK_DISPLACEMENT][i], want->displacement[i], rtol);
            assert_close(r->peak[PEAK_ACCELERATION][i], want->acceleration[i], rtol);
            assert_close(r->peak[PEAK_DRIFT][i], want->drift[i], rtol);
        }
        for (int i = 0; i < want->n_link; i++) {
            assert_close(r->link[i].force, want->force[i], rtol);
            assert_close(r->link[i].penetration, want->deformation[i], rtol);
            assert_close(r->link[i].dissipated, want->work[i], rtol);
            assert_true(r->link[i].lost > 0.0 && r->link[i].lost <= r->link[i].dissipated);
        }
        assert_true(r->residual_peak < (s < 2 ? 1e-12 : 1e-8) * r->energy[ENERGY_INPUT]);
        analysis_free(&a);
    }
}

static void viscous_dampers_are_those_of_an_independent_program(void **state) {
    (void)state;
    static const struct reference want = {
        .deck = "link A:0 A:1 -dashpot 300e3 -exponent 0.5\n"
                "link A:1 A:2 -law viscous -dashpot 300e3 -exponent 0.5\n"
                "link A:2 A:3 -dashpot 250e3 -exponent 0.5\n"
                "link A:3 A:4 -dashpot 200e3 -exponent 0.5\n",
        .scale = 1.0,
        .n_link = 4,
        .displacement = {0.0217369812, 0.04334638818, 0.06320296906, 0.07803805264},
        .acceleration = {4.228832832, 6.482817032, 9.267146593, 12.60808182},
        .drift = {0.0217369812, 0.02161548683, 0.01986011043, 0.01484943722},
        .force = {158627.8108, 157274.3778, 124495.5857, 89430.47753},
        .deformation = {0.0217369812, 0.02161548683, 0.01986011043, 0.01484943722},
        .work = {71548.7831, 65592.94502, 45845.7942, 23814.24432},
        .rtol = {5e-5, 2e-5, 1e-7},
    };
    assert_reference(&want);
}

static void dampers_with_springs_in_series_are_those_of_an_independent_program(void **state) {
    (void)state;
    static const struct reference want = {
        .deck = "link A:0:1 A:1:2 -law maxwell -stiffness 80e6 -dashpot 500e3 -exponent 0.5\n",
        .scale = 1.5,
        .n_link = 2,
        .displacement = {0.03337476495, 0.06618179509, 0.09658699962, 0.119477092},
        .acceleration = {8.313418174, 10.9467435, 14.20540948, 19.10134385},
        .drift = {0.03337476495, 0.03281245387, 0.03040520835, 0.02293689935},
        .force = {321599.9517, 321179.5114},
        .deformation = {0.03337476495, 0.03281245387},
        .work = {225980.0235, 199514.9694},
        .rtol = {1e-4, 3e-5, 1e-7},
    };
    assert_reference(&want);
}

static void braces_that_yield_are_those_of_an_independent_program(void **state) {
    (void)state;
    static const struct reference want = {
        .deck = "link A:0:2 A:1:3 -law bilinear -stiffness 70MN/m 70MN/m 50MN/m "
                "-yield 250kN 220kN 180kN -hardening 0.03\n"
                "link A:1 A:4 -law bilinear -stiffness 30MN/m -yield 150kN -hardening 0.03\n",
        .scale = 2.0,
        .n_link = 4,
        .displacement = {0.03644438257, 0.07149281273, 0.103881223, 0.130848618},
        .acceleration = {12.21932093, 13.67594064, 16.91418311, 24.42387419},
        .drift = {0.03644438257, 0.0350638818, 0.03240774407, 0.02700980313},
        .force = {319033.2034, 287034.1518, 223211.6161, 230465.8219},
        .deformation = {0.03644438257, 0.0350638818, 0.03240774407, 0.09440646883},
        .work = {241962.0568, 172026.6264, 102040.0678, 357384.7125},
        .rtol = {2e-4, 1e-4, 1e-7},
    };
    assert_reference(&want);
}

static void cables_beside_contacts_are_those_of_an_independent_program(void **state) {
    (void)state;
    static const double displacement[] = {0.03661846062, 0.06531104149, 0.09637445108,
                                          0.1098502129,  0.02188491634, 0.04398749223,
                                          0.06515671817, 0.07601834572};
    static const double acceleration[] = {13.60823889, 20.15511797, 26.39946033, 31.23316774,
                                          18.7294751,  26.74016809, 31.66957759, 31.74752143};
    static const int impacts[] = {0, 31, 65, 81};
    static const double force[] = {0.0, 1174892.708, 1444471.46, 2476655.036};
    static const double impulse[] = {0.0, 220001.566, 1103069.682, 2300433.675};
    static const double cable[] = {1384206.055, 2422194.813};  // floors 2 and 4
    static const double length[] = {0.01730257569 + 0.008, 0.03027743517 + 0.015};
    static const double rtol[] = {1e-3, 2e-4, 2e-7};
    for (int s = 0; s < N_STEP; s++) {
        struct analysis a = analysis_of(
            BUILDING
            "building B -floors 4 -mass 80t -stiffness 240MN/m 220MN/m 180MN/m 140MN/m\n"
            "damping B rayleigh 2%%\ncontact A B -gap 15mm -law komodromos -k 250MN/m "
            "-zeta 0.1359\nlink A:2,4 B:2,4 -law cable -stiffness 80MN/m -slack 8mm 15mm\n"
            "ground record %s -format series -dt 0.02 -unit g -scale 1.5\nduration 31.18\n%s",
            analysis_el_centro(), s == 0 ? "step fixed 0.2ms\noutput -interval 10ms" : step[s]);
        const struct results *r = a.results;
        for (int i = 0; i < 2 * FLOORS; i++) {
            assert_close(r->peak[PEAK_DISPLACEMENT][i], displacement[i], rtol[s]);
            assert_close(r->peak[PEAK_ACCELERATION][i], acceleration[i], rtol[s]);
        }
        for (int i = 0; i < FLOORS; i++) {
            assert_close(r->link[i].force, force[i], rtol[s]);
            assert_close(r->link[i].impulse, impulse[i], rtol[s]);
            assert_int_equal(r->link[i].impacts, impacts[i]);
        }
        for (int i = 0; i < 2; i++) {
            const struct link_peak *link = &r->link[FLOORS + i];
            assert_close(link->force, cable[i], rtol[s]);
            assert_close(link->penetration, length[i], rtol[s]);
            // The account takes the force to be a straight line over a step, across the end of the
            // slack, too.
            assert_near(link->lost, 0.0, (s == 0 ? 1e-4 : 1e-6) * link->force * length[i]);
            assert_true(link->residual == 0.0);
        }
        for (long i = 0; i < a.rows.n * a.rows.n_link; i++) {
            assert_true(i % a.rows.n_link < FLOORS || a.rows.force[i] <= 0.0);
        }
        assert_true(r->residual_peak < (s < 2 ? 1e-12 : 1e-8) * r->energy[ENERGY_INPUT]);
        analysis_free(&a);
    }
}

// A storey of stiffness k that hardens by R k is a spring R k beside friction of (1 - R) k: the
// links take the place of the yielding storeys, with each method.
static void friction_beside_a_spring_is_a_bilinear_storey(void **state) {
    (void)state;
    static const double rtol[] = {1e-7, 1e-4, 1e-7};
    for (int s = 0; s < N_STEP; s++) {
        struct analysis a[2];
        for (int k = 0; k < 2; k++) {
            static const char *const deck[] = {
                "building A -floors 2 -mass 1t -stiffness 90kN/m\n"
                "storey A:1:2 bilinear -yield 900 700 -hardening 0.2\n",
                "building A -floors 2 -mass 1t -stiffness 18kN/m\n"
                "link A:0:1 A:1:2 -law friction -stiffness 72kN/m -slip 720 560\n"};
            a[k] = analysis_of("units N m s\n%sdamping A dashpot 60\n"
                               "ground sine -amplitude 2 -frequency 1 -cycles 4\nduration 6\n"
                               "output -interval 10ms\n%s",
                               deck[k], s == 0 ? "step fixed 1ms" : step[s]);
        }
        for (int i = 0; i < 2; i++) {
            const double scale = a[0].results->peak[PEAK_DISPLACEMENT][i];
            assert_close(a[1].results->peak[PEAK_DISPLACEMENT][i], scale, rtol[s]);
            for (long j = 0; j < a[0].rows.n; j++) {
                assert_near(a[1].rows.displacement[2 * j + i], a[0].rows.displacement[2 * j + i],
                            10.0 * rtol[s] * scale);
            }
        }
        // What links lose, storeys dissipate.
        const double lost = a[1].results->link[0].lost + a[1].results->link[1].lost;
        assert_close(lost, a[0].results->energy[ENERGY_HYSTERETIC], 10.0 * rtol[s]);
        assert_true(a[0].results->energy[ENERGY_HYSTERETIC] > 0.0);
        analysis_free(&a[0]);
        analysis_free(&a[1]);
    }
}

// A link that is all there is of a storey follows the same equations as a storey of its law, whose
// drift is the lengthening, also with long steps and where the law softens.
static void a_link_is_a_storey_of_its_law(void **state) {
    (void)state;
    static const char *const law[] = {
        "imk -yield 80kN -hardening 0.05 -capping 18mm -post-capping -0.6 -residual 0.1",
        "imk -yield 80kN -hardening 0.05 -capping 18mm -post-capping -0.6 -cycle bilinear",
        "flag -yield 80kN -hardening 0.05 -b 0.7", "bouc-wen -yield 80kN -hardening 0.05",
        "slip -yield 80kN -hardening 0.05 -slack 2mm"};
    for (size_t i = 0; i < sizeof law / sizeof law[0]; i++) {
        for (int s = 0; s < N_STEP; s++) {
            struct analysis a[2];
            for (int k = 0; k < 2; k++) {
                char deck[500];
                snprintf(deck, sizeof deck,
                         k == 0 ? "building A -floors 1 -mass 50t -stiffness 10MN/m\nstorey A %s"
                                : "building A -floors 1 -mass 50t -stiffness 0\n"
                                  "link A:0 A:1 -law %s -stiffness 10MN/m",
                         law[i]);
                a[k] = analysis_of("units N m s\n%s\ndamping A dashpot 50e3\n"
                                   "ground sine -amplitude 0.3g -frequency 1.4 -cycles 5\n"
                                   "duration 4\n%s",
                                   deck, s == 0 ? "step fixed 10ms" : step[s]);
            }
            const double most = a[0].results->peak[PEAK_DRIFT][0];
            assert_true(most > 0.025 && a[0].results->energy[ENERGY_HYSTERETIC] > 0.0);
            assert_close(a[1].results->peak[PEAK_DRIFT][0], most, s == 0 ? 1e-9 : 1e-4);
            assert_close(a[1].results->link[0].force, a[0].results->peak[PEAK_SHEAR][0],
                         s == 0 ? 1e-9 : 1e-4);
            assert_near(a[1].results->link[0].residual, a[0].results->residual_drift[0],
                        (s == 0 ? 1e-9 : 2e-4) * most);
            analysis_free(&a[0]);
            analysis_free(&a[1]);
        }
    }
}

// One mass with a Maxwell element alone, released with the velocity v. Linear: with z the state of
// the damper, m u'' = -k (u - z), z' = k (u - z) / c. The force f obeys f'' + (k/c) f' + (k/m) f =
// 0, f(0) = 0, f'(0) = k v.
static void a_linear_maxwell_link_has_its_closed_form(void **state) {
    (void)state;
    const double m = 2.0, k = 300.0, c = 20.0, v = 0.4;
    const double decay = k / (2.0 * c), omega = sqrt(k / m - decay * decay);
    static const double rtol[] = {3e-5, 3e-5, 1e-7};
    for (int s = 0; s < N_STEP; s++) {
        struct analysis a = analysis_of(
            "units N m s\nbuilding A -floors 1 -mass %g -stiffness 0\nduration 1\n"
            "link A:0 A:1 -law maxwell -stiffness %g -dashpot %g\ninitial A:1 -velocity %g\n"
            "output -interval 10ms\n%s",
            m, k, c, v, s == 0 ? "step fixed 1ms" : step[s]);
        for (long i = 0; i < a.rows.n; i++) {
            const double t = a.rows.time[i];
            const double force = k * v / omega * exp(-decay * t) * sin(omega * t);
            assert_near(a.rows.force[i], -force, rtol[s] * k * v / omega);
        }
        // What remains is the length of the damper, and its energy.
        const long end = a.rows.n - 1;
        const double tension = -a.rows.force[end];
        const struct link_peak *link = &a.results->link[0];
        assert_close(link->residual, fabs(a.rows.displacement[end] - tension / k), 1e-9);
        assert_close(link->lost, link->dissipated - tension * tension / (2.0 * k), 1e-9);
        analysis_free(&a);
    }
}

// The valve of a damper: one mass that coasts against it. Beyond the relief force the deceleration
// is constant.
static void a_relief_valve_limits_the_force(void **state) {
    (void)state;
    for (int s = 0; s < N_STEP; s++) {
        struct analysis a =
            analysis_of("units N m s\nbuilding A -floors 1 -mass 2 -stiffness 0\nduration 1\n"
                        "link A:0 A:1 -dashpot 10 -relief 6\ninitial A:1 -velocity 3\n"
                        "output -interval 10ms\n%s",
                        s == 0 ? "step fixed 1ms" : step[s]);
        // From 3 to 0.6 m/s at 3 m/s2 in 0.8 s, then v = 0.6 exp(-5 (t - 0.8)).
        for (long i = 0; i < a.rows.n; i++) {
            const double t = a.rows.time[i];
            const double v = t < 0.8 ? 3.0 - 3.0 * t : 0.6 * exp(-5.0 * (t - 0.8));
            assert_near(a.rows.velocity[i], v, s < 2 ? 3e-6 : 1e-9);
            assert_near(a.rows.force[i], t < 0.8 ? -6.0 : -10.0 * v, s < 2 ? 3e-5 : 1e-8);
        }
        analysis_free(&a);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(viscous_dampers_are_those_of_an_independent_program),
        cmocka_unit_test(dampers_with_springs_in_series_are_those_of_an_independent_program),
        cmocka_unit_test(braces_that_yield_are_those_of_an_independent_program),
        cmocka_unit_test(cables_beside_contacts_are_those_of_an_independent_program),
        cmocka_unit_test(friction_beside_a_spring_is_a_bilinear_storey),
        cmocka_unit_test(a_link_is_a_storey_of_its_law),
        cmocka_unit_test(a_linear_maxwell_link_has_its_closed_form),
        cmocka_unit_test(a_relief_valve_limits_the_force),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
