// SPDX-License-Identifier: GPL-3.0-or-later
// Stiffness-proportional damping on the tangent stiffness: by hand, in the two forms of a building,
// and the account of its energy.
#include <math.h>
#include <stdio.h>

#include "support/analysis.h"
#include "support/support.h"

#define RECORD                                                                                     \
    "ground record tests/verify/reference/elcentro_led_by_zero.txt -format series -unit g -dt "    \
    "0.02\nduration 10\n"

// One elastic-plastic storey, unloaded at rest but for its velocity, by Newmark's method and the
// tangent of the step before. Whether it yields is tried.
struct oscillator {
    double m, k, yield, hardening, alpha, beta, h;
    double u, v, a, plastic, tangent, shear, damper;
    double damped, most_shear;
};

static double shear_at(const struct oscillator *s, double u, double *tangent) {
    const double back = s->hardening * s->k, spring = s->k - back;
    const double trial = spring * (u - s->plastic), most = (1 - s->hardening) * s->yield;
    *tangent = fabs(trial) > most ? back : s->k;
    return back * u + (fabs(trial) > most ? copysign(most, trial) : trial);
}

static void step(struct oscillator *s) {
    const double c = s->alpha * s->m + s->beta * s->tangent, h = s->h;
    double u = s->u, v = 0.0, a = 0.0, tangent = s->k, shear = 0.0;
    for (int i = 0; i < 50; i++) {
        a = 4 / (h * h) * (u - s->u - h * s->v) - s->a;
        v = s->v + h * (s->a + a) / 2;
        shear = shear_at(s, u, &tangent);
        u -= (s->m * a + c * v + shear) / (4 * s->m / (h * h) + 2 * c / h + tangent);
    }
    const double damper = s->beta * s->tangent * v;
    s->damped += (s->damper + damper + s->alpha * s->m * (s->v + v)) / 2 * (u - s->u);
    const double back = s->hardening * s->k, spring = s->k - back;
    const double elastic = (shear - back * u) / spring;
    s->plastic = u - elastic;
    s->u = u;
    s->v = v;
    s->a = a;
    s->tangent = tangent;
    s->damper = damper;
    s->most_shear = fmax(s->most_shear, fabs(shear));
}

static void one_storey_follows_a_hand_made_integration(void **state) {
    (void)state;
    struct oscillator s = {.m = 1e5,
                           .k = 1e7,
                           .yield = 2e5,
                           .hardening = 0.1,
                           .alpha = 0.2,
                           .beta = 0.02,
                           .h = 0.005,
                           .v = 1.0,
                           .tangent = 1e7};
    s.damper = s.beta * s.k * s.v;
    s.a = -(s.alpha * s.m * s.v + s.damper) / s.m;
    struct analysis a = analysis_of(
        "units N m s\nbuilding A -floors 1 -mass 1e5 -stiffness 1e7\nstorey A:1 bilinear -yield "
        "2e5 "
        "-hardening 0.1\ndamping A rayleigh -alpha 0.2 -beta 0.02 -tangent\ninitial A:1 -velocity "
        "1\nnewton -tolerance 1e-13\noutput -every 1\nstep fixed 0.005\nduration 2\n");
    for (long i = 1; i < a.rows.n; i++) {
        step(&s);
        assert_near(a.rows.displacement[i], s.u, 1e-10);
        assert_near(a.rows.velocity[i], s.v, 1e-9);
        assert_near(a.rows.energy[i * ENERGY_COUNT + ENERGY_DAMPING], s.damped, 1e-8 * 5e4);
        double tangent;
        assert_near(a.rows.shear[i], shear_at(&s, s.u, &tangent), 1e-8 * s.yield);
    }
    assert_int_equal(a.rows.n, 401);
    // The damping force is not in the peak of the storey shear.
    assert_close(a.results->peak[PEAK_SHEAR][0], s.most_shear, 1e-9);
    assert_true(s.most_shear > 1.2 * s.yield);
    analysis_free(&a);
}

#define DAMPING "damping A rayleigh 5%% -tangent\n"

// Storeys of k with hardening beside a matrix of storeys of 0.3 k are storeys of 1.3 k.
static void storeys_beside_a_matrix_are_stiffer_storeys(void **state) {
    (void)state;
    const char *file = support_write("chain.txt", "54e6 -24e6 0\n-24e6 42e6 -18e6\n0 -18e6 18e6\n");
    struct analysis chain = analysis_of(
        "units N m s\nbuilding A -floors 3 -mass 1e5 -stiffness 130e6 104e6 78e6\nstorey A:1:3 "
        "bilinear -yield 0.39e6 0.325e6 0.26e6 -hardening ${0.35 / 1.3}\n" DAMPING RECORD
        "step fixed 2ms\n");
    struct analysis full = analysis_of(
        "units N m s\nbuilding A -floors 3 -mass 1e5 -stiffness 100e6 80e6 60e6\nmatrix A %s\n"
        "storey A:1:3 bilinear -yield 0.3e6 0.25e6 0.2e6 -hardening 0.05\n" DAMPING RECORD
        "step fixed 2ms\n",
        file);
    for (int q = 0; q < PEAK_COUNT; q++) {
        for (int i = 0; i < 3; i++) {
            assert_close(full.results->peak[q][i], chain.results->peak[q][i], 1e-8);
        }
    }
    for (int k = 0; k < ENERGY_RESIDUAL; k++) {
        assert_near(full.results->energy[k], chain.results->energy[k],
                    1e-8 * analysis_flow(&chain));
    }
    analysis_free(&chain);
    analysis_free(&full);
}

#define HOUSE "building A -floors 3 -mass 100t -stiffness 100MN/m 80MN/m 60MN/m -height 3\n"

static const char slider[] = "isolator A:1 fps -radius 1 -mu 6% -mu-slow 3% -rate 30\n"
                             "storey A:2:3 bilinear -yield 300kN -hardening 0\n";

static void assert_dampers_take(const struct analysis *a, double least) {
    for (long r = 1; r < a->rows.n; r++) {
        const double *e = a->rows.energy + (r - 1) * ENERGY_COUNT;
        assert_true(e[ENERGY_COUNT + ENERGY_DAMPING] >= e[ENERGY_DAMPING] - least);
    }
}

// The hinges of all members soften so fast that the tangent of the frame is indefinite.
static void a_frame_that_softens_takes_energy_only(void **state) {
    (void)state;
    struct analysis a = analysis_of(
        "units kN m s\nbuilding A -floors 2 -mass 60t -height 3.5m\n"
        "frame A -bays 6m -modulus 200GPa -columns-inextensible\n"
        "columns A:1:2 -I 2e-4\nbeams A:1:2 -I 2.5e-4\n"
        "hinges A:1:2 columns imk -yield 150kN*m -hardening 0.02 -capping 0.01 -post-capping -0.3 "
        "-stiffness 100MN*m\n" DAMPING RECORD "step fixed 1ms\noutput -every 1\n");
    const double flow = analysis_flow(&a);
    assert_true(a.results->residual_peak < 1e-9 * flow);
    assert_dampers_take(&a, 1e-7 * flow);
    analysis_free(&a);
}

// Laws that soften, slide and strike; rows are so many that the account is seen in all steps.
static void the_account_is_closed(void **state) {
    (void)state;
    static const char *const storeys[] = {
        "storey A bilinear -yield 300kN -hardening 0.02\n",
        "storey A takeda -yield 300kN -hardening 0.02\npdelta A -leaning 2MN\n",
        "storey A imk -yield 300kN -hardening 0.05 -capping 12mm -post-capping -0.1\n",
        "storey A bouc-wen -yield 300kN -hardening 0.05\n",
        slider,
    };
    static const char *const step[] = {"step fixed 1ms",
                                       "integrator newmark\nstep adaptive -tolerance 1e-6"};
    static const char *const law[] = {"hunt-crossley -n 1 -k 300MN/m -e 0.6",
                                      "stereomechanical -e 0.6"};
    for (int i = 0; i < 5; i++) {
        for (int k = 0; k < 4; k++) {
            struct analysis a =
                analysis_of(HOUSE "%s" DAMPING "contact A:3 wall -gap 10mm -law %s\n" RECORD "%s\n",
                            storeys[i], law[k / 2], step[k % 2]);
            const double flow = analysis_flow(&a);
            assert_true(a.results->n_impact > 0);
            assert_true(a.results->residual_peak < 1e-9 * flow);
            // Dashpots on tangents that are not negative take energy only.
            assert_dampers_take(&a, 1e-5 * flow);
            analysis_free(&a);
        }
    }
}

// The tangent is that of the last step, so the result changes with the step, in the first order.
static void adaptive_steps_agree_with_fixed_ones(void **state) {
    (void)state;
    static const char deck[] =
        HOUSE "storey A bilinear -yield 300kN -hardening 0.02\n" DAMPING RECORD "%s\n";
    struct analysis fixed = analysis_of(deck, "step fixed 0.2ms");
    struct analysis adaptive = analysis_of(deck, "step adaptive -tolerance 1e-8");
    assert_int_equal(adaptive.model->integrator, INTEGRATOR_NEWMARK);
    for (int i = 0; i < 3; i++) {
        assert_close(adaptive.results->peak[PEAK_DRIFT][i], fixed.results->peak[PEAK_DRIFT][i],
                     5e-4);
        assert_close(adaptive.results->peak[PEAK_SHEAR][i], fixed.results->peak[PEAK_SHEAR][i],
                     5e-4);
    }
    analysis_free(&fixed);
    analysis_free(&adaptive);
}

static void elastic_buildings_have_one_stiffness(void **state) {
    (void)state;
    struct analysis a = analysis_of(HOUSE DAMPING RECORD "step fixed 2ms\n");
    struct analysis b = analysis_of(HOUSE "damping A rayleigh 5%%\n" RECORD "step fixed 2ms\n");
    assert_int_equal(a.model->building->n_part, 0);
    analysis_assert_same(a.model, a.results, b.results);
    analysis_free(&a);
    analysis_free(&b);
}

// Modes without damping add nothing, but they have a full matrix: so the solver goes another way.
static void chains_have_the_motion_of_full_matrices(void **state) {
    (void)state;
    static const char *const yields[] = {
        "isolator A:1 fps -radius 2m -mu 6% -mu-slow 3% -rate 30s/m\ndamping A rayleigh 5%\n",
        "storey A:all bilinear -yield 0.4MN -hardening 0.05\ndamping A rayleigh 5% -tangent\n",
        "storey A:2:3 clough -yield 0.4MN -hardening 0.05\n"
        "isolator A:1 fps -radius 2m -mu 6% -mu-slow 3% -rate 30s/m\ndamping A rayleigh 5% "
        "-tangent\n",
    };
    for (int k = 0; k < 3; k++) {
        struct analysis chain, full, *of[] = {&chain, &full};
        for (int i = 0; i < 2; i++) {
            *of[i] = analysis_of(
                "building A -floors 3 -mass 100t -stiffness 80MN/m\n"
                "building B -floors 2 -mass 100t -stiffness 60MN/m\n"
                "contact A B -gap 10mm -law kelvin-voigt -k 100MN/m -e 0.65\n%s%s" RECORD
                "step fixed 2ms\nnewton -tolerance 1e-13\n",
                yields[k], i > 0 ? "damping A modal 0%\n" : "");
        }
        assert_null(chain.model->building->damping_full);
        assert_non_null(full.model->building->damping_full);
        assert_true(chain.results->n_impact > 0);
        assert_int_equal(chain.results->n_impact, full.results->n_impact);
        for (int i = 0; i < chain.model->n_dof; i++) {
            for (int q = 0; q < PEAK_COUNT; q++) {
                assert_close(chain.results->peak[q][i], full.results->peak[q][i], 1e-9);
            }
        }
        for (int q = 0; q < ENERGY_RESIDUAL; q++) {
            assert_close(chain.results->energy[q], full.results->energy[q], 1e-9);
        }
        analysis_free(&chain);
        analysis_free(&full);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_storey_follows_a_hand_made_integration),
        cmocka_unit_test(storeys_beside_a_matrix_are_stiffer_storeys),
        cmocka_unit_test(a_frame_that_softens_takes_energy_only),
        cmocka_unit_test(the_account_is_closed),
        cmocka_unit_test(adaptive_steps_agree_with_fixed_ones),
        cmocka_unit_test(elastic_buildings_have_one_stiffness),
        cmocka_unit_test(chains_have_the_motion_of_full_matrices),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
