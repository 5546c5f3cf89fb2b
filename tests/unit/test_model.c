// SPDX-License-Identifier: GPL-3.0-or-later
// Buildings, storeys and damping as the statements of a deck make them. Tolerances of 1e-14 leave
// room for a few roundings; those of frequencies for the eigenvalue solver's.
#include <gsl/gsl_math.h>

#include "support/analysis.h"
#include "support/support.h"

#define REST "\nstep fixed 0.01s\nduration 1s\n"

static void floors_are_counted_through_all_buildings(void **state) {
    (void)state;
    struct model *m = analysis_model("building A -floors 3 -mass 1 2 3 -stiffness 10\n"
                                     "building B -floors 1 -mass 4 -stiffness 20\n"
                                     "building C -floors 2 -mass 5 -stiffness 30 40" REST);
    assert_int_equal(m->n_building, 3);
    assert_int_equal(m->n_dof, 6);
    const int first[] = {0, 3, 4};
    for (int i = 0; i < 3; i++) {
        assert_int_equal(m->building[i].first, first[i]);
    }
    const double mass[] = {1, 2, 3, 4, 5, 5};
    for (int i = 0; i < 6; i++) {
        assert_true(m->mass[i] == mass[i]);
    }
    assert_true(m->building[2].stiffness[0] == 30 && m->building[2].stiffness[1] == 40);
    assert_null(m->building[0].height);
    model_free(m);
}

static void lists_repeat_from_the_ground_storey_up(void **state) {
    (void)state;
    struct model *m = analysis_model(
        "units kN m s\n"
        "building A -floors 5 -mass 4*300t 250t -stiffness 345MN/m 2*300e3 2*250e3 -height 4 "
        "4*3.2m" REST);
    const struct building *g = m->building;
    const double stiffness[] = {345e3, 300e3, 300e3, 250e3, 250e3};
    for (int i = 0; i < 5; i++) {
        assert_close(g->mass[i], i < 4 ? 300 : 250, 1e-14);
        assert_close(g->stiffness[i], stiffness[i], 1e-14);
        assert_close(g->height[i], i == 0 ? 4 : 3.2, 1e-14);
    }
    model_free(m);
}

static void the_mass_unit_follows_from_force_length_and_time(void **state) {
    (void)state;
    struct model *m = analysis_model("units kip in s\n"
                                     "building A -floors 1 -mass 1t -stiffness 1kN/m\n"
                                     "building B -floors 1 -mass 0.5 -stiffness 1" REST);
    // A pound-force is 4.4482216152605 N and an inch 0.0254 m, both exact.
    double kip = 4448.2216152605;
    assert_close(m->mass[0], 1000.0 * 0.0254 / kip, 1e-13);
    assert_close(m->building[0].stiffness[0], 1000.0 * 0.0254 / kip, 1e-13);
    assert_true(m->mass[1] == 0.5);
    model_free(m);
}

static void units_do_not_change_a_period(void **state) {
    (void)state;
    static const char *const units[] = {"N m s", "kN mm s", "MN cm s", "kip in s", "N m ms"};
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++) {
        struct model *m = analysis_model(
            "units %s\nbuilding A -floors 1 -mass 300t -stiffness 345MN/m" REST, units[i]);
        double omega = m->building[0].omega[0] / m->deck->units.time;
        assert_close(omega, sqrt(345e6 / 300e3), 1e-13);
        model_free(m);
    }
}

static void a_uniform_building_has_the_frequencies_of_the_closed_form(void **state) {
    (void)state;
    static const int floors[] = {1, 2, 5, 40, 200};
    for (size_t k = 0; k < sizeof floors / sizeof floors[0]; k++) {
        int n = floors[k];
        struct model *m = analysis_model("building A -floors %d -mass 2 -stiffness 800" REST, n);
        for (int i = 1; i <= n; i++) {
            double want = 2.0 * sqrt(800.0 / 2.0) * sin((2 * i - 1) * M_PI / (2.0 * (2 * n + 1)));
            assert_close(m->building[0].omega[i - 1], want, 1e-9);
        }
        model_free(m);
    }
}

static void mode_shapes_are_orthogonal_and_scaled_to_1(void **state) {
    (void)state;
    struct model *m =
        analysis_model("building A -floors 4 -mass 1 2 3 4 -stiffness 500 400 300 200" REST);
    const struct building *g = m->building;
    for (int i = 0; i < 4; i++) {
        double largest = 0.0;
        for (int j = 0; j < i; j++) {
            double product = 0.0;
            for (int f = 0; f < 4; f++) {
                product += g->shape[4 * i + f] * g->mass[f] * g->shape[4 * j + f];
            }
            assert_near(product, 0.0, 1e-13);
        }
        for (int f = 0; f < 4; f++) {
            largest = fmax(largest, g->shape[4 * i + f]);
            assert_true(fabs(g->shape[4 * i + f]) <= 1.0);
        }
        assert_true(largest == 1.0);
    }
    model_free(m);
}

static void stiffness_0_makes_a_free_body(void **state) {
    (void)state;
    struct model *m = analysis_model("building A -floors 1 -mass 2 -stiffness 0\n"
                                     "building B -floors 2 -mass 2 -stiffness 0 400" REST);
    assert_true(m->building[0].omega[0] == 0.0);
    assert_true(m->building[1].omega[0] == 0.0);
    assert_close(m->building[1].omega[1], 20.0, 1e-13);  // sqrt(k / (m / 2))
    assert_true(isnan(building_damping_ratio(&m->building[1], 1)));
    model_free(m);
}

// 345 MN/m without its prefix and unit: T = 2 pi / (2 sin(pi / 34) sqrt(345 / 300)) = 31.75 s.
static void a_period_of_no_building_is_warned_of(void **state) {
    (void)state;
    static const struct {
        const char *stiffness;
        int n_warning;
    } of[] = {{"345MN/m", 0}, {"345", 1}, {"0", 0}, {"0 345 345 345 345 345 345 345", 0}};
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        struct model *m = analysis_model("units kN m s\nbuilding A -floors 8 -mass 300t -stiffness "
                                         "%s\ninitial A:1 -velocity 1" REST,
                                         of[i].stiffness);
        assert_int_equal(m->deck->diagnostics.n_warning, of[i].n_warning);
        if (of[i].n_warning > 0) {
            assert_string_equal(
                m->deck->diagnostics.item[0].message,
                "the first period of building A is 31.75 s, outside 0.08 to 15 s; are its mass and "
                "stiffness in the units of the deck?");
            assert_int_equal(m->deck->diagnostics.item[0].line, 2);
        }
        model_free(m);
    }
}

static void rayleigh_coefficients_are_those_of_the_closed_form(void **state) {
    (void)state;
    struct model *m = analysis_model("building A -floors 3 -mass 2 -stiffness 800\n"
                                     "damping A rayleigh 5%% 2%% -modes 1 3" REST);
    const struct building *g = m->building;
    double wi = 40.0 * sin(M_PI / 14.0);
    double wj = 40.0 * sin(5.0 * M_PI / 14.0);
    double a0 = 2.0 * wi * wj * (0.05 * wj - 0.02 * wi) / (wj * wj - wi * wi);
    double a1 = 2.0 * (0.02 * wj - 0.05 * wi) / (wj * wj - wi * wi);
    assert_null(g->damping_full);
    assert_close(g->damping_diagonal[0], a0 * 2.0 + a1 * 1600.0, 1e-12);
    assert_close(g->damping_diagonal[2], a0 * 2.0 + a1 * 800.0, 1e-12);
    assert_close(g->damping_off[1], -a1 * 800.0, 1e-12);
    assert_true(g->damping_off[2] == 0.0);
    assert_close(building_damping_ratio(g, 1), 0.05, 1e-12);
    assert_close(building_damping_ratio(g, 3), 0.02, 1e-12);
    model_free(m);
}

static void one_rayleigh_ratio_holds_for_modes_1_and_2(void **state) {
    (void)state;
    struct model *m = analysis_model("building A -floors 3 -mass 2 -stiffness 800\n"
                                     "damping A rayleigh 5%%" REST);
    assert_close(building_damping_ratio(m->building, 1), 0.05, 1e-12);
    assert_close(building_damping_ratio(m->building, 2), 0.05, 1e-12);
    assert_true(building_damping_ratio(m->building, 3) > 0.05);
    model_free(m);
}

static void given_rayleigh_coefficients_are_taken_as_they_are(void **state) {
    (void)state;
    struct model *m = analysis_model("building A -floors 2 -mass 2 -stiffness 800\n"
                                     "building B -floors 2 -mass 2 -stiffness 800\n"
                                     "damping A rayleigh -alpha 0.3 -beta 2ms\n"
                                     "damping B rayleigh -beta 0.001" REST);
    assert_close(m->building[0].damping_diagonal[0], 0.3 * 2.0 + 0.002 * 1600.0, 1e-14);
    assert_close(m->building[0].damping_off[0], -0.002 * 800.0, 1e-14);
    assert_close(m->building[1].damping_diagonal[1], 0.8, 1e-14);
    model_free(m);
}

static void one_storey_is_damped_in_proportion_to_its_stiffness(void **state) {
    (void)state;
    struct model *m = analysis_model("building A -floors 1 -mass 2 -stiffness 800\n"
                                     "damping A rayleigh 5%%" REST);
    assert_close(m->building[0].damping_diagonal[0], 2.0 * 0.05 * 20.0 * 2.0, 1e-13);
    assert_close(building_damping_ratio(m->building, 1), 0.05, 1e-13);
    model_free(m);
}

static void modal_damping_gives_every_mode_its_ratio(void **state) {
    (void)state;
    struct model *m =
        analysis_model("building A -floors 4 -mass 1 2 3 4 -stiffness 500 400 300 200\n"
                       "building B -floors 4 -mass 1 2 3 4 -stiffness 500 400 300 200\n"
                       "damping A modal 5%% 2%% 0 10%%\n"
                       "damping B modal 3%%" REST);
    const double want[] = {0.05, 0.02, 0.0, 0.1};
    for (int i = 0; i < 4; i++) {
        assert_near(building_damping_ratio(&m->building[0], i + 1), want[i], 1e-13);
        assert_near(building_damping_ratio(&m->building[1], i + 1), 0.03, 1e-13);
    }
    const double *full = m->building[0].damping_full;
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < i; j++) {
            assert_near(full[4 * i + j], full[4 * j + i], 1e-13);
        }
    }
    model_free(m);
}

static void dashpots_stand_in_the_storeys(void **state) {
    (void)state;
    struct model *m = analysis_model("building A -floors 3 -mass 2 -stiffness 800\n"
                                     "damping A dashpot 3 2kN*s/m 5" REST);
    const struct building *g = m->building;
    const double diagonal[] = {2003, 2005, 5}, off[] = {-2000, -5, 0};
    for (int i = 0; i < 3; i++) {
        assert_close(g->damping_diagonal[i], diagonal[i], 1e-14);
        assert_near(g->damping_off[i], off[i], 1e-11);
    }
    const double v[] = {1, 2, 4};
    double force[3];
    building_damping_force(g, v, force);
    assert_close(force[0], 3.0 * 1.0 - 2000.0 * 1.0, 1e-14);
    assert_close(force[1], 2000.0 * 1.0 - 5.0 * 2.0, 1e-14);
    assert_close(force[2], 5.0 * 2.0, 1e-14);
    model_free(m);
}

static void twins_share_frequencies_but_not_damping(void **state) {
    (void)state;
    struct model *m = analysis_model("building A -floors 3 -mass 2 -stiffness 800\n"
                                     "building B -floors 3 -mass 2 -stiffness 800\n"
                                     "building C -floors 3 -mass 2 -stiffness 3200\n"
                                     "building D -floors 3 -mass 8 -stiffness 800\n"
                                     "damping B rayleigh 5%%" REST);
    assert_true(m->building[0].omega[2] == m->building[1].omega[2]);
    assert_close(m->building[2].omega[2], 2.0 * m->building[0].omega[2], 1e-12);
    assert_close(m->building[3].omega[2], 0.5 * m->building[0].omega[2], 1e-12);
    assert_true(building_damping_ratio(&m->building[0], 1) == 0.0);
    assert_close(building_damping_ratio(&m->building[1], 1), 0.05, 1e-12);
    model_free(m);
}

static void storeys_have_the_law_and_the_stiffness_given(void **state) {
    (void)state;
    struct model *m = analysis_model("units kN m s\n"
                                     "building A -floors 4 -mass 2 -stiffness 800\n"
                                     "building B -floors 2 -mass 2 -stiffness 800\n"
                                     "storey A:1,3 bilinear -yield 4kN 6 -hardening 0.1 "
                                     "-stiffness 700 900\n"
                                     "damping A rayleigh -beta 1" REST);
    const char *const law[] = {"bilinear", "elastic", "bilinear", "elastic", "elastic", "elastic"};
    const double stiffness[] = {700, 800, 900, 800, 800, 800};
    for (int i = 0; i < 6; i++) {
        const struct storey *s = &m->storey[i];
        assert_string_equal(s->law->name, law[i]);
        const double history[STOREY_HISTORY_MAX] = {0};
        assert_close(s->law->respond(s->constant, history, 0.001, NULL).tangent, stiffness[i],
                     1e-14);
    }
    const double history[STOREY_HISTORY_MAX] = {0};
    // V = V_y + R k (drift - V_y / k)
    assert_close(m->storey[2].law->respond(m->storey[2].constant, history, 1.0, NULL).shear,
                 6.0 + 0.1 * (900.0 - 6.0), 1e-13);
    assert_int_not_equal(m->storey[0].history, m->storey[2].history);
    assert_int_equal(m->n_storey_history, 2 * m->storey[0].law->n_history);
    assert_false(m->building[0].elastic);
    assert_true(m->building[1].elastic);
    assert_close(m->building[0].damping_diagonal[0], 1500.0, 1e-14);
    model_free(m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(floors_are_counted_through_all_buildings),
        cmocka_unit_test(lists_repeat_from_the_ground_storey_up),
        cmocka_unit_test(the_mass_unit_follows_from_force_length_and_time),
        cmocka_unit_test(units_do_not_change_a_period),
        cmocka_unit_test(a_uniform_building_has_the_frequencies_of_the_closed_form),
        cmocka_unit_test(mode_shapes_are_orthogonal_and_scaled_to_1),
        cmocka_unit_test(stiffness_0_makes_a_free_body),
        cmocka_unit_test(a_period_of_no_building_is_warned_of),
        cmocka_unit_test(rayleigh_coefficients_are_those_of_the_closed_form),
        cmocka_unit_test(one_rayleigh_ratio_holds_for_modes_1_and_2),
        cmocka_unit_test(given_rayleigh_coefficients_are_taken_as_they_are),
        cmocka_unit_test(one_storey_is_damped_in_proportion_to_its_stiffness),
        cmocka_unit_test(modal_damping_gives_every_mode_its_ratio),
        cmocka_unit_test(dashpots_stand_in_the_storeys),
        cmocka_unit_test(twins_share_frequencies_but_not_damping),
        cmocka_unit_test(storeys_have_the_law_and_the_stiffness_given),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
