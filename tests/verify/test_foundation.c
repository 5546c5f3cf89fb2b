// SPDX-License-Identifier: GPL-3.0-or-later
// Buildings whose foundations sway and rock.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "model/forces.h"
#include "model/foundation.h"
#include "support/analysis.h"
#include "support/support.h"

static const char left[] =
    "building A -floors 4 -mass 120t -stiffness 240MN/m 220MN/m 180MN/m 140MN/m -height 3.2m\n"
    "damping A rayleigh 5%\n"
    "foundation A -mass 150t -inertia 4000t*m^2 -sway 600MN/m -sway-dashpot 6MN*s/m "
    "-rocking 12000MN*m -rocking-dashpot 60MN*m*s\n";
static const char right[] =
    "building B -floors 4 -mass 90t -stiffness 360MN/m 320MN/m 260MN/m 200MN/m -height 3.2m\n"
    "damping B rayleigh 5%\n"
    "foundation B -mass 120t -inertia 3000t*m^2 -sway 800MN/m -sway-dashpot 7MN*s/m "
    "-rocking 16000MN*m -rocking-dashpot 70MN*m*s\n";

// Numbers of an independent program: Runge-Kutta steps of 10 us, and matrix exponentials.
static void one_building_is_that_of_an_independent_program(void **state) {
    static const double displacement[] = {0.03047507301, 0.053365776, 0.0761401184, 0.09568538842};
    static const double acceleration[] = {6.561943224, 8.034185186, 8.895166653, 12.25611063};
    static const double drift[] = {0.0153333614, 0.01425776519, 0.01380708987, 0.01040076111};
    static const double stiffness[] = {240e6, 220e6, 180e6, 140e6};
    static const char *const step[] = {"step fixed 0.5ms",
                                       "integrator newmark\nstep adaptive -tolerance 1e-9",
                                       "integrator dormand-prince\nstep adaptive -tolerance 1e-10"};
    static const double rtol[] = {6e-5, 6e-6, 3e-6};
    (void)state;
    for (int s = 0; s < 3; s++) {
        struct analysis a =
            analysis_of("units N m s\n%sground record %s -format series -dt 0.02 -unit g\n"
                        "duration 31.18\n%s",
                        left, analysis_el_centro(), step[s]);
        const struct results *r = a.results;
        for (int i = 0; i < 4; i++) {
            assert_close(r->peak[PEAK_DISPLACEMENT][i], displacement[i], rtol[s]);
            assert_close(r->peak[PEAK_ACCELERATION][i], acceleration[i], rtol[s]);
            assert_close(r->peak[PEAK_DRIFT][i], drift[i], rtol[s]);
            assert_close(r->peak[PEAK_SHEAR][i], stiffness[i] * r->peak[PEAK_DRIFT][i], 1e-9);
            assert_close(r->peak_time[PEAK_SHEAR][i], r->peak_time[PEAK_DRIFT][i], 0.0);
        }
        assert_close(r->peak[PEAK_DISPLACEMENT][4], 0.00644877103, rtol[s]);          // sway
        assert_close(r->peak[PEAK_DISPLACEMENT][5], 12.8 * 0.002925406585, rtol[s]);  // of the roof
        const int first = forces_of_foundation(&a.model->building[0]);
        const double sway = 0.00644877103, rocking = 0.002925406585;
        assert_close(-r->force_min[first + FOUNDATION_SWAY], sway, rtol[s]);
        assert_close(r->force_max[first + FOUNDATION_SWAY], 0.005802250802, rtol[s]);
        assert_close(r->force_max[first + FOUNDATION_ROCKING], rocking, rtol[s]);
        assert_close(-r->force_min[first + FOUNDATION_ROCKING], 0.002825242346, rtol[s]);
        assert_close(-r->force_min[first + FOUNDATION_FORCE], 600e6 * sway, rtol[s]);
        assert_close(r->force_max[first + FOUNDATION_MOMENT], 12e9 * rocking, rtol[s]);
        assert_near(r->force_min_time[first + FOUNDATION_SWAY], 2.47309, 5e-4);
        assert_near(r->force_max_time[first + FOUNDATION_MOMENT], 2.17259, 5e-4);
        assert_true(r->residual_peak < (s < 2 ? 1e-12 : 1e-7) * r->energy[ENERGY_INPUT]);
        analysis_free(&a);
    }
}

static void two_buildings_hit_each_other(void **state) {
    static const double roof[] = {0.1284858526, 0.1016721779};
    static const double drift[2][4] = {
        {0.02061264865, 0.01992552172, 0.01788252347, 0.01474933531},
        {0.01521583152, 0.01472054464, 0.01388119287, 0.01045773923}};
    static const double force[] = {384127.4807, 2702722.09, 4339971.143, 5759603.202};
    static const double impulse[] = {3403.645882, 200672.8755, 767929.2179, 1539645.735};
    static const int impacts[] = {1, 9, 32, 43};
    (void)state;
    struct analysis a = analysis_of(
        "units N m s\n%s%scontact A B -gap 20mm -law komodromos -k 300MN/m -zeta 0.1359\n"
        "ground record %s -format series -dt 0.02 -unit g -scale 1.5\nduration 31.18\n"
        "step fixed 50us",
        left, right, analysis_el_centro());
    const struct results *r = a.results;
    for (int i = 0; i < 4; i++) {
        assert_close(r->link[i].force, force[i], 2e-3);
        assert_close(r->link[i].impulse, impulse[i], 1e-3);
        assert_int_equal(r->link[i].impacts, impacts[i]);
        assert_close(r->peak[PEAK_DRIFT][i], drift[0][i], 1e-4);
        assert_close(r->peak[PEAK_DRIFT][6 + i], drift[1][i], 1e-4);
    }
    assert_close(r->peak[PEAK_DISPLACEMENT][3], roof[0], 1e-4);
    assert_close(r->peak[PEAK_DISPLACEMENT][9], roof[1], 1e-4);
    assert_true(r->residual_peak < 1e-12 * r->energy[ENERGY_INPUT]);
    analysis_free(&a);
}

// One storey, Veletsos & Meek (1974), Earthquake Eng. Struct. Dyn. 3, 121-138:
// T = T_fixed sqrt(1 + k / k_x (1 + k_x h^2 / k_theta)) without a mass of the foundation.
static void the_period_is_that_of_veletsos_and_meek(void **state) {
    static const struct {
        double k, h, sway, rocking, with_mass[3];
    } rows[] = {
        {40e6, 3.5, 200e6, 3e9, {0.3682377555, 0.07107948361, 0.03178654223}},
        {40e6, 8.0, 200e6, 3e9, {0.4513748152, 0.07343541759, 0.02509995679}},
        {40e6, 3.5, 50e6, 0.8e9, {0.4975565515, 0.1267211837, 0.05110575701}},
        {90e6, 12.0, 400e6, 20e9, {0.28737997, 0.05101888907, 0.01036019062}},
    };
    (void)state;
    for (int i = 0; i < 4; i++) {
        const double k = rows[i].k, h = rows[i].h, x = rows[i].sway, t = rows[i].rocking;
        struct model *m =
            analysis_model("units N m s\nbuilding A -floors 1 -mass 100t -stiffness %g -height %g\n"
                           "foundation A -mass 30t -inertia 90t*m^2 -sway %g -rocking %g\n"
                           "step fixed 1ms\nduration 1",
                           k, h, x, t);
        for (int j = 0; j < 3; j++) {
            assert_close(2.0 * acos(-1.0) / m->building->omega[j], rows[i].with_mass[j], 1e-9);
        }
        model_free(m);
        m = analysis_model("units N m s\nbuilding A -floors 1 -mass 100t -stiffness %g -height %g\n"
                           "foundation A -mass 0.1kg -inertia 0.3kg*m^2 -sway %g -rocking %g\n"
                           "step fixed 1ms\nduration 1",
                           k, h, x, t);
        const double fixed = 2.0 * acos(-1.0) * sqrt(1e5 / k);
        assert_close(2.0 * acos(-1.0) / m->building->omega[0],
                     fixed * sqrt(1.0 + k / x * (1.0 + x * h * h / t)), 1e-6);
        model_free(m);
    }
}

// Storeys that yield, with a foundation that hardly moves, are those of the fixed base.
static void a_stiff_foundation_is_the_fixed_base(void **state) {
    static const char deck[] =
        "units N m s\nbuilding A -floors 3 -mass 100t -stiffness 100MN/m -height 3m 3.5m 4m\n"
        "storey A:1:2 bilinear -yield 900kN -hardening 5%%\nstorey A:3 bouc-wen -yield 700kN "
        "-hardening 5%%\n"
        "damping A rayleigh 3%%\nground record %s -format series -dt 0.02 -unit g\nduration 8\n"
        "step fixed 1ms\n%s";
    (void)state;
    struct analysis a[2] = {
        analysis_of(deck, analysis_el_centro(), ""),
        analysis_of(deck, analysis_el_centro(),
                    "foundation A -mass 100t -inertia 1000t*m^2 -sway 1e15 -rocking 1e17"),
    };
    for (int i = 0; i < 3; i++) {
        const double drift = a[0].results->peak[PEAK_DRIFT][i];
        assert_true(i > 0 || drift > 0.02);  // far beyond yield
        assert_close(a[1].results->peak[PEAK_DRIFT][i], drift, 1e-6);
        assert_close(a[1].results->peak[PEAK_SHEAR][i], a[0].results->peak[PEAK_SHEAR][i], 1e-5);
        assert_near(a[1].results->residual_drift[i], a[0].results->residual_drift[i], 1e-5 * drift);
    }
    assert_close(a[1].results->energy[ENERGY_HYSTERETIC], a[0].results->energy[ENERGY_HYSTERETIC],
                 1e-6);
    for (int k = 0; k < 2; k++) {
        assert_true(a[k].results->residual_peak < 1e-10 * a[k].results->energy[ENERGY_INPUT]);
        analysis_free(&a[k]);
    }
}

// A frame, a wall and storeys on a foundation: on one that hardly moves members have the forces of
// the fixed base. On one that moves, the columns of a storey carry its shear.
static void members_on_a_foundation_have_forces(void **state) {
    static const char deck[] =
        "units N m s\nbuilding A -floors 2 -mass 100t -height 3m -stiffness 9MN/m\n"
        "frame A -bays 6 5 -modulus 30e9\ncolumns A:1:2 -I 2e-3 -A 0.16\nbeams A:1:2 -I 3e-3\n"
        "wall A:1:2 -EI 3e8\ndamping A rayleigh 3%%\n"
        "ground record %s -format series -dt 0.02 -unit g\nduration 6\nstep fixed 1ms\n%s";
    (void)state;
    struct analysis a[3] = {
        analysis_of(deck, analysis_el_centro(), ""),
        analysis_of(deck, analysis_el_centro(),
                    "foundation A -mass 100t -inertia 1000t*m^2 -sway 1e15 -rocking 1e17"),
        analysis_of(deck, analysis_el_centro(),
                    "foundation A -mass 100t -inertia 1000t*m^2 -sway 3e8 -rocking 9e9"),
    };
    const struct building *g = &a[0].model->building[0];
    assert_int_equal(g->n_force, forces_of_foundation(&a[1].model->building[0]));
    for (int i = 0; i < g->n_force; i++) {
        if (a[0].results->force_max[i] != 0.0) {
            assert_close(a[1].results->force_max[i], a[0].results->force_max[i], 1e-6);
            assert_close(a[1].results->force_min[i], a[0].results->force_min[i], 1e-6);
        }
    }
    for (int k = 0; k < 3; k++) {
        const struct building *b = &a[k].model->building[0];
        double drift[4] = {1e-3, -2e-3, 5e-4, 3e-4}, force[64], columns = 0.0;
        forces_at(b, drift, NULL, NULL, force);
        for (int i = 0; i < 3; i++) {
            columns += force[forces_of_members(b, 0, FRAME_SHEAR) + i];
        }
        assert_close(columns, force[forces_of_share(b, 1)], 1e-12);
        analysis_free(&a[k]);
    }
}

// A disk on a half-space: Wolf (1994), Foundation Vibration Analysis Using Simple Physical Models.
static void soil_gives_springs_and_dashpots(void **state) {
    (void)state;
    struct model *m = analysis_model(
        "units N m s\nbuilding A -floors 1 -mass 100t -stiffness 100MN/m -height 3m\n"
        "building B -floors 1 -mass 100t -stiffness 100MN/m -height 3m\n"
        "foundation A -mass 80t -inertia 900t*m^2 -radius 5m -vs 200 -density 1800 -poisson 0.25\n"
        "foundation B -mass 80t -inertia 900t*m^2 -radius 5m -vs 200 -density 1800 -poisson 0.45 "
        "-rocking-dashpot 0\nstep fixed 1ms\nduration 1");
    const struct foundation *f = m->building[0].foundation;
    const double pi = acos(-1.0), shear = 1800.0 * 200.0 * 200.0;
    assert_close(f->sway, 8.0 * shear * 5.0 / 1.75, 1e-14);
    assert_close(f->rocking, 8.0 * shear * 125.0 / (3.0 * 0.75), 1e-14);
    assert_close(f->sway_dashpot, 1800.0 * 200.0 * pi * 25.0, 1e-14);
    assert_close(f->rocking_dashpot, 1800.0 * 200.0 * sqrt(3.0) * pi * 625.0 / 4.0, 1e-14);
    assert_close(f->inertia, 900e3, 0.0);
    f = m->building[1].foundation;
    assert_close(f->sway, 8.0 * shear * 5.0 / 1.55, 1e-14);
    assert_true(f->rocking_dashpot == 0.0);
    assert_close(f->inertia, 900e3 + 1.2 * (0.45 - 1.0 / 3.0) * 1800.0 * (pi * 625.0 / 4.0) * 5.0,
                 1e-14);
    model_free(m);
}

// Levels and columns of a building behind one with a foundation.
static void levels_of_other_buildings_stay_where_they_are(void **state) {
    static const char deck[] =
        "units N m s\nbuilding A -floors 2 -mass 100t -stiffness 90MN/m -height 3m\n"
        "building B -floors 3 -mass 120t -stiffness 60MN/m -height 2.5m\n"
        "column B@3m -name c -EI 50MN*m^2 -mass 1t\n%s"
        "contact A B -by-level -gap 5mm -law hertz -k 3e9N/m^1.5\ndamping A rayleigh 3%%\n"
        "damping B rayleigh 3%%\nground record %s -format series -dt 0.02 -unit g\n"
        "duration 6\nstep fixed 0.5ms\n";
    (void)state;
    struct analysis a[2] = {
        analysis_of(deck, "", analysis_el_centro()),
        analysis_of(deck, "foundation A -mass 100t -inertia 1000t*m^2 -sway 1e15 -rocking 1e17\n",
                    analysis_el_centro()),
    };
    assert_int_equal(a[0].model->n_contact, 4);  // A@2.5m, B@3m, A@5m, B@6m
    for (int i = 0; i < 4; i++) {
        assert_true(a[0].results->link[i].impacts > 0);
        assert_int_equal(a[1].results->link[i].impacts, a[0].results->link[i].impacts);
        assert_close(a[1].results->link[i].force, a[0].results->link[i].force, 1e-5);
    }
    assert_close(a[1].results->column[0][COLUMN_SHEAR_BELOW].max,
                 a[0].results->column[0][COLUMN_SHEAR_BELOW].max, 1e-5);
    analysis_free(&a[0]);
    analysis_free(&a[1]);
}

// A frame of rigid beams whose columns have equal hinges at all ends is a chain of shear storeys
// with the law of the hinges: the column, 6 E I/h, is in series with them.
static void a_frame_with_hinges_is_the_shear_building_on_its_foundation(void **state) {
    (void)state;
    const double h = 3, bend = 6 * 2e7 / h, k = 1e8, hardened = 0.05 * k;
    const double initial = 4 / (h * h) * (k * bend / (k + bend));
    const double later = 4 / (h * h) * (hardened * bend / (hardened + bend));
    static const char *const step[] = {"step fixed 1ms",
                                       "integrator newmark\nstep adaptive -tolerance 1e-7"};
    static const char *const pdelta[] = {"", "pdelta A -leaning 300e3\n"};
    for (int i = 0; i < 4; i++) {
        char text[2][512];
        snprintf(text[0], sizeof text[0],
                 "frame A -bays 5 -modulus 2e11 -columns-inextensible\ncolumns A:1:2 -I 1e-4\n"
                 "beams A:1:2 -I 1e4\n"
                 "hinges A:1:2 columns bilinear -yield 6e4 -hardening 0.05 -stiffness 1e8\n");
        snprintf(text[1], sizeof text[1], "storey A:1:2 bilinear -yield %.17g -hardening %.17g\n",
                 4 * 6e4 / h, later / initial);
        struct analysis a[2];
        for (int j = 0; j < 2; j++) {
            a[j] = analysis_of(
                "units N m s\nbuilding A -floors 2 -mass 3e4 2e4 -height 3 -stiffness %.17g\n%s"
                "damping A rayleigh 5%%\n"
                "foundation A -mass 2e4 -inertia 3e5 -sway 1e8 -rocking 1e9 -sway-dashpot 1e5\n%s"
                "contact A:2 wall -gap 20mm -law hertz -k 1e9\n"
                "ground record input/records/ELCENTRO_1940_NS.AT2 -scale 2\nduration 6\n%s\n",
                j == 0 ? 0.0 : initial, text[j], pdelta[i / 2], step[i % 2]);
        }
        const struct results *frame = a[0].results, *chain = a[1].results;
        assert_true(chain->link[0].impacts > 0 && chain->peak[PEAK_DRIFT][0] > 3e-2);
        assert_int_equal(frame->link[0].impacts, chain->link[0].impacts);
        for (int q = 0; q < PEAK_COUNT; q++) {
            for (int dof = 0; dof < (q == PEAK_DISPLACEMENT ? 4 : 2); dof++) {
                assert_close(frame->peak[q][dof], chain->peak[q][dof], 1e-6);
            }
        }
        for (int q = 0; q < ENERGY_RESIDUAL; q++) {
            assert_near(frame->energy[q], chain->energy[q], 1e-6 * analysis_flow(&a[1]));
        }
        assert_true(frame->residual_peak < 1e-11 * analysis_flow(&a[0]));
        const struct building *g = &a[0].model->building[0];
        const int at = g->force + forces_of_members(g, 0, FRAME_MOMENT_I);
        const double moment = fmax(frame->force_max[at], -frame->force_min[at]);
        assert_true(i / 2 == 1 || fabs(moment * 4 / h / chain->peak[PEAK_SHEAR][0] - 1) < 1e-6);
        // Moments stay on the law of the hinges: m = hardened r + (1 - 0.05) My.
        const int turn = g->force + forces_of_members(g, 0, FRAME_ROTATION_I);
        const double most = fmax(frame->force_max[turn], -frame->force_min[turn]);
        assert_close(moment, hardened * most + 0.95 * 6e4, 1e-6);
        analysis_free(&a[0]);
        analysis_free(&a[1]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_building_is_that_of_an_independent_program),
        cmocka_unit_test(two_buildings_hit_each_other),
        cmocka_unit_test(the_period_is_that_of_veletsos_and_meek),
        cmocka_unit_test(a_stiff_foundation_is_the_fixed_base),
        cmocka_unit_test(members_on_a_foundation_have_forces),
        cmocka_unit_test(a_frame_with_hinges_is_the_shear_building_on_its_foundation),
        cmocka_unit_test(soil_gives_springs_and_dashpots),
        cmocka_unit_test(levels_of_other_buildings_stay_where_they_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
