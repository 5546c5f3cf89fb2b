// SPDX-License-Identifier: GPL-3.0-or-later
// The account of energy: with average acceleration it closes to rounding whatever acts; what it
// says is dissipated agrees with what the impacts say.
#include <math.h>

#include "support/analysis.h"
#include "support/support.h"

#define PAIR                                                                                       \
    "building A -floors 4 -mass 200t -stiffness 150MN/m\n"                                         \
    "building B -floors 3 -mass 150t -stiffness 250MN/m\n"                                         \
    "damping A rayleigh 5%%\ndamping B modal 3%%\n"                                                \
    "ground record input/records/ELCENTRO_1940_NS.AT2\nduration 8\n"

// Residual relative to the input.
static double residual(const struct analysis *a) {
    return a->results->residual_peak / a->results->energy[ENERGY_INPUT];
}

static void the_account_closes_without_contact(void **state) {
    (void)state;
    struct analysis a = analysis_of(PAIR "step fixed 5ms\n");
    assert_true(residual(&a) < 1e-12);
    assert_true(a.results->energy[ENERGY_DAMPING] > 0.5 * a.results->energy[ENERGY_INPUT]);
    analysis_free(&a);
}

static void the_account_closes_with_contact_and_yielding_at_any_step(void **state) {
    (void)state;
    const double step[] = {2e-4, 2e-3, 1e-2, 2e-2};
    for (size_t i = 0; i < sizeof step / sizeof step[0]; i++) {
        struct analysis a =
            analysis_of(PAIR "storey A:all bilinear -yield 900kN -hardening 0\n"
                             "storey B:1 bilinear -yield 1.2MN -hardening 0.05\n"
                             "contact A B -gap 5mm -law kelvin-voigt -k 93.5MN/m -e 0.65\n"
                             "link A:3 B:3 -dashpot 300kN*s^0.5/m^0.5 -exponent 0.5\n"
                             "step fixed %g\n",
                        step[i]);
        assert_true(residual(&a) < 1e-11);
        assert_true(a.results->energy[ENERGY_HYSTERETIC] > 0.0);
        assert_int_equal(a.results->totals.unsolved, 0);
        analysis_free(&a);
    }
}

// With finite forces, and where velocities jump: then the work on the grounds is that of an
// impulse.
static void the_account_closes_on_grounds_that_move_differently(void **state) {
    (void)state;
    static const char *const law[] = {"jankowski -k 2.75e9 -e 0.65", "stereomechanical -e 0.65"};
    for (size_t i = 0; i < sizeof law / sizeof law[0]; i++) {
        struct analysis a =
            analysis_of("building A -floors 4 -mass 200t -stiffness 150MN/m\n"
                        "building B -floors 3 -mass 150t -stiffness 250MN/m\n"
                        "damping A rayleigh 5%%\ndamping B rayleigh 5%%\n"
                        "ground record input/records/ELCENTRO_1940_NS.AT2 -buildings A\n"
                        "ground record input/records/ELCENTRO_1940_NS.AT2 -delay 0.3 -buildings B\n"
                        "contact A B -gap 5mm -law %s\nduration 8\nstep fixed 1ms\n",
                        law[i]);
        assert_true(a.results->n_impact > 0);
        assert_true(residual(&a) < 1e-11);
        analysis_free(&a);
    }
}

// The contact energy is the sum over impacts, and no impact of a dissipative law gives energy back.
static void impacts_add_up_to_the_contact_energy(void **state) {
    (void)state;
    struct analysis a = analysis_of(
        PAIR "contact A B -gap 5mm -law jankowski -k 2.75e9 -e 0.65\nstep fixed 0.2ms\n");
    double sum = 0.0;
    double impulse = 0.0;
    for (long i = 0; i < a.results->n_impact; i++) {
        assert_true(a.results->impact[i].dissipated > 0.0);
        sum += a.results->impact[i].dissipated;
        impulse += a.results->impact[i].impulse;
    }
    assert_true(a.results->n_impact > 10);
    assert_close(sum, a.results->energy[ENERGY_CONTACT], 1e-12);
    double total = 0.0;
    for (int k = 0; k < a.model->n_contact; k++) {
        total += a.results->link[k].impulse;
    }
    assert_close(impulse, total, 1e-12);
    analysis_free(&a);
}

static void an_initial_state_is_not_part_of_the_input(void **state) {
    (void)state;
    struct analysis a = analysis_of(
        "building A -floors 1 -mass 2 -stiffness 50\ninitial A:1 -displacement 0.1 -velocity 0.5\n"
        "duration 1\nstep fixed 1ms\n");
    assert_true(a.results->energy[ENERGY_INPUT] == 0.0);
    assert_close(a.results->initial_energy, 0.25 + 0.25, 1e-14);
    assert_close(a.results->energy[ENERGY_KINETIC] + a.results->energy[ENERGY_STRAIN], 0.5, 1e-12);
    analysis_free(&a);
}

// A body of 1000 kg that stands 10 mm inside a wall, which throws it off: what the contact holds at
// t = 0 becomes kinetic energy.
static void an_overlap_at_the_start_is_initial_energy(void **state) {
    (void)state;
    static const struct {
        const char *law;
        double force;   // at 10 mm
        double energy;  // integral of the force from 0 to 10 mm
    } overlap[] = {
        {"linear -k 1e6", 1e4, 1e6 * 1e-4 / 2.0},
        {"hertz -k 1e7", 1e4, 1e7 * 1e-5 / 2.5},
        {"bilinear -k1 2e6 -k2 1e6 -dy 4mm", 14e3,
         2e6 * 16e-6 / 2.0 + 8e3 * 6e-3 + 1e6 * 36e-6 / 2.0},
    };
    for (size_t i = 0; i < sizeof overlap / sizeof overlap[0]; i++) {
        struct analysis a = analysis_of(
            "building A -floors 1 -mass 1000 -stiffness 0\ncontact A wall -gap -10mm -law %s "
            "-allow-overlap\nduration 0.2\nstep fixed 1e-5\noutput -every 100\n",
            overlap[i].law);
        const struct results *r = a.results;
        assert_close(r->initial_energy, overlap[i].energy, 1e-10);
        assert_close(a.rows.energy[ENERGY_CONTACT], overlap[i].energy, 1e-10);
        assert_true(r->residual_peak < 1e-10 * overlap[i].energy);
        assert_int_equal(r->n_impact, 1);
        assert_close(r->impact[0].max_penetration, 0.01, 1e-15);
        assert_close(r->impact[0].peak_force, overlap[i].force, 1e-14);
        assert_near(r->impact[0].dissipated, r->energy[ENERGY_CONTACT], 1e-10 * overlap[i].energy);
        assert_close(r->energy[ENERGY_KINETIC] + r->energy[ENERGY_CONTACT], overlap[i].energy,
                     1e-10);
        analysis_free(&a);
    }
}

// What an elastic contact holds comes back.
static void an_elastic_overlap_gives_all_of_its_energy_back(void **state) {
    (void)state;
    struct analysis a = analysis_of(
        "building A -floors 1 -mass 1000 -stiffness 0\ncontact A wall -gap -10mm -law linear "
        "-k 1e6 -allow-overlap\nduration 0.2\nstep fixed 1e-5\noutput -every 100\n");
    assert_close(a.results->energy[ENERGY_KINETIC], 50.0, 1e-6);
    assert_near(a.results->impact[0].dissipated, 0.0, 50.0 * 1e-6);
    analysis_free(&a);
}

// From inside, a bilinear contact unloads at once: lost is (k1 - k2) dy (10 mm - dy), to rounding,
// as the steps end at the corners of the force.
static void a_bilinear_overlap_gives_all_but_its_loop_back(void **state) {
    (void)state;
    struct analysis a = analysis_of(
        "building A -floors 1 -mass 1000 -stiffness 0\ncontact A wall -gap -10mm -law bilinear "
        "-k1 2e6 -k2 1e6 -dy 4mm -allow-overlap\nduration 0.2\nstep adaptive\n");
    assert_close(a.results->energy[ENERGY_CONTACT], 1e6 * 4e-3 * 6e-3, 1e-11);
    analysis_free(&a);
}

// A storey of yield drift 0.1 that is let go from within it, and from beyond it: it gives back the
// elastic energy it has left, and dissipates nothing while it unloads, to half its shear within
// 0.1. Takeda's unloads with k (d_y / D)^0.4.
static void a_strained_storey_at_the_start_unloads_elastically(void **state) {
    (void)state;
    static const struct {
        const char *law;
        double drift, energy, stiffness;
    } start[] = {
        {"bilinear", 0.08, 0.32, 100.0},
        {"bilinear", 0.25, 90.0 * 0.01 / 2.0 + 10.0 * 0.0625 / 2.0, 100.0},
        {"clough", 0.25, 11.5 * 11.5 / 200.0, 100.0},
        {"takeda", 0.25, 11.5 * 11.5 / 2.0 / 69.31448431551465, 69.31448431551465},
    };
    for (size_t i = 0; i < sizeof start / sizeof start[0]; i++) {
        struct analysis a =
            analysis_of("building A -floors 1 -mass 1 -stiffness 100\n"
                        "storey A:1 %s -yield 10 -hardening 0.1\n"
                        "initial A:1 -displacement %g\nduration 0.1\nstep fixed 1e-3\n",
                        start[i].law, start[i].drift);
        const double shear = start[i].drift > 0.1 ? 11.5 : 8.0, k = start[i].stiffness;
        assert_close(a.results->initial_energy, start[i].energy, 1e-12);
        assert_near(a.results->energy[ENERGY_HYSTERETIC], 0.0, 1e-12);
        assert_true(a.results->residual_peak < 1e-12);
        // Newmark's period is too long by (omega h)^2 / 12 < 1e-5.
        const double way = shear / k * (1.0 - cos(sqrt(k) * 0.1));
        assert_near(analysis_displacement(&a, 0, 0.1), start[i].drift - way, 1e-5 * shear / k);
        analysis_free(&a);
    }
}

static void a_strained_link_at_the_start_is_initial_energy(void **state) {
    (void)state;
    struct analysis a = analysis_of("building A -floors 1 -mass 1 -stiffness 100\n"
                                    "building B -floors 1 -mass 1 -stiffness 100\n"
                                    "link A B -stiffness 50\ninitial A -displacement -0.2\n"
                                    "duration 1\nstep fixed 1e-3\n");
    assert_close(a.results->initial_energy, 100.0 * 0.04 / 2.0 + 50.0 * 0.04 / 2.0, 1e-12);
    assert_close(a.results->link[0].dissipated, a.results->energy[ENERGY_CONTACT], 1e-12);
    assert_true(a.results->residual_peak < 1e-12);
    analysis_free(&a);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_account_closes_without_contact),
        cmocka_unit_test(the_account_closes_with_contact_and_yielding_at_any_step),
        cmocka_unit_test(the_account_closes_on_grounds_that_move_differently),
        cmocka_unit_test(impacts_add_up_to_the_contact_energy),
        cmocka_unit_test(an_initial_state_is_not_part_of_the_input),
        cmocka_unit_test(an_overlap_at_the_start_is_initial_energy),
        cmocka_unit_test(an_elastic_overlap_gives_all_of_its_energy_back),
        cmocka_unit_test(a_bilinear_overlap_gives_all_but_its_loop_back),
        cmocka_unit_test(a_strained_storey_at_the_start_unloads_elastically),
        cmocka_unit_test(a_strained_link_at_the_start_is_initial_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
