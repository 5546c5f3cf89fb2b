// SPDX-License-Identifier: GPL-3.0-or-later
// What storeys and hinges have gone through: against sums over the rows of the histories, closed
// forms, and the account of energy.
#include <math.h>
#include <string.h>

#include "support/analysis.h"
#include "support/support.h"

#define UNITS "units N m s\n"
#define SHAKEN "ground record input/records/ELCENTRO_1940_NS.AT2 -pga 0.35g\nduration 12\n"
#define NEWMARK "step fixed 2ms\n"
#define ADAPTIVE "integrator newmark\nstep adaptive -tolerance 1e-6\n"
#define DORMAND_PRINCE "integrator dormand-prince\nstep adaptive -tolerance 1e-8\n"

static const char *const laws[] = {
    "bilinear -yield 150kN -hardening 5%",
    "bilinear -yield 150kN -hardening 5% -yield-negative 90kN",
    "bouc-wen -yield 150kN -hardening 5%",
    "ramberg-osgood -yield 150kN -eta 0.1 -r 5",
    "multilinear -yield 150kN -drift-2 12mm -shear-2 200kN -hardening 5% -yield-negative 120kN",
    "clough -yield 150kN -hardening 5% -yield-negative 200kN",
    "takeda -yield 150kN -hardening 5%",
    "imk -yield 150kN -hardening 3% -capping 40mm -post-capping -0.05 -gamma-s 60 -gamma-k 90",
    "trilinear -crack 80kN -yield 150kN -cracked 0.4 -hardening 5% -takeda -yield-negative 110kN",
    "flag -yield 150kN -hardening 5% -b 0.8",
    "slip -yield 150kN -hardening 10% -slack 1mm",
};
#define TOWER                                                                                      \
    "building A -floors 3 -mass 25t -stiffness 40MN/m -height 3m\ndamping A rayleigh 3%%\n"

static double sum_of(const struct analysis *a) {
    double sum = 0.0;
    for (int i = 0; i < a->model->n_dof; i++) {
        sum += a->results->storey_demand[i].value[YIELD_HYSTERETIC];
    }
    for (int i = 0; i < a->model->n_hinge; i++) {
        sum += a->results->hinge_demand[i].value[YIELD_HYSTERETIC];
    }
    return sum;
}

// All that is dissipated is dissipated by some storey or hinge.
static void assert_all_dissipated(const struct analysis *a, double rtol) {
    const double input = a->results->energy[ENERGY_INPUT];
    assert_true(sum_of(a) > 0.05 * input);
    assert_near(sum_of(a), a->results->energy[ENERGY_HYSTERETIC], rtol * input);
}

static void the_energies_of_storeys_are_those_of_the_account(void **state) {
    (void)state;
    static const char *const step[] = {NEWMARK, ADAPTIVE, DORMAND_PRINCE};
    for (size_t i = 0; i < sizeof laws / sizeof laws[0]; i++) {
        for (size_t s = 0; s < sizeof step / sizeof step[0]; s++) {
            struct analysis a = analysis_of(UNITS TOWER "storey A %s\n%s" SHAKEN, laws[i], step[s]);
            assert_all_dissipated(&a, 1e-9);
            analysis_free(&a);
        }
    }
}

// With a part beside them, storeys are noted step by step. One that takes no share changes nothing.
static void a_part_without_a_share_changes_no_demand(void **state) {
    (void)state;
    static const char *const step[] = {NEWMARK, ADAPTIVE, DORMAND_PRINCE};
    static const double rtol[] = {1e-6, 1e-3, 2e-3};
    const char *file = support_write("matrix.csv", "1e-3, 0, 0\n0, 1e-3, 0\n0, 0, 1e-3\n");
    for (size_t i = 0; i < sizeof laws / sizeof laws[0]; i++) {
        for (size_t s = 0; s < sizeof step / sizeof step[0]; s++) {
            struct analysis a = analysis_of(UNITS TOWER "storey A %s\n%s" SHAKEN, laws[i], step[s]);
            struct analysis b =
                analysis_of(UNITS TOWER "storey A %s\nmatrix A %s -unit N/m\n%s" SHAKEN, laws[i],
                            file, step[s]);
            for (int k = 0; k < 3; k++) {
                for (int q = 0; q < YIELD_QUANTITIES; q++) {
                    const double want = a.results->storey_demand[k].value[q];
                    const double scale = q == YIELD_HYSTERETIC ? sum_of(&a) : 1.0;
                    assert_near(b.results->storey_demand[k].value[q], want,
                                rtol[s] * (scale + want));
                }
            }
            analysis_free(&a);
            analysis_free(&b);
        }
    }
}

// By the trapezoidal rule over the rows, which are all steps, with the storey at rest in the end.
static void the_energy_of_a_storey_is_the_area_of_its_loops(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof laws / sizeof laws[0]; i++) {
        struct analysis a =
            analysis_of(UNITS TOWER "storey A:1 %s\noutput -every 1\n" NEWMARK SHAKEN, laws[i]);
        const struct kept_rows *r = &a.rows;
        double area = 0.0, most = 0.0, least = 0.0;
        for (long n = 1; n < r->n; n++) {
            const double *x = r->drift + 3 * n, *shear = r->shear + 3 * n;
            area += (shear[0] + shear[-3]) * (x[0] - x[-3]) / 2.0;
            most = fmax(most, x[0]);
            least = fmin(least, x[0]);
        }
        const struct storey *s = &a.model->storey[0];
        const double stored = a.results->energy[ENERGY_STRAIN];
        const double *demand = a.results->storey_demand[0].value;
        // Elastic storeys store their share of the strain energy.
        const double *drift = r->drift + 3 * (r->n - 1);
        const double elastic = 40e6 * (drift[1] * drift[1] + drift[2] * drift[2]) / 2.0;
        assert_near(demand[YIELD_HYSTERETIC], area - (stored - elastic), 1e-9 * area);
        assert_true(demand[YIELD_HYSTERETIC] > 0.1 * area);
        const struct storey_figures f = storey_law_figures(s->law, s->constant);
        assert_close(demand[YIELD_DUCTILITY], fmax(most / f.yield[0], -least / f.yield[1]), 1e-12);
        assert_true(a.results->storey_demand[1].value[YIELD_DUCTILITY] == 0.0);
        analysis_free(&a);
    }
}

// The drifts and shears at yield, which the options say.
static void laws_know_their_yields(void **state) {
    (void)state;
    static const double yield[][2] = {{150, 150}, {150, 90},  {150, 150}, {150, 150},
                                      {150, 120}, {150, 200}, {150, 150}, {150, 150},
                                      {150, 110}, {150, 150}, {150, 150}};
    for (size_t i = 0; i < sizeof laws / sizeof laws[0]; i++) {
        struct model *m =
            analysis_model(UNITS TOWER "storey A %s\n" NEWMARK "duration 1\n", laws[i]);
        const struct storey *s = &m->storey[0];
        const struct storey_figures f = storey_law_figures(s->law, s->constant);
        const double slack = strcmp(s->law->name, "slip") == 0 ? 1e-3 : 0.0;
        for (int k = 0; k < 2; k++) {
            const double strength = 1e3 * yield[i][k];
            assert_close(f.strength[k], strength, 1e-12);
            // The second line of trilinear is 0.4 k, and with a slack 0.05 k comes first.
            const double drift = strcmp(s->law->name, "trilinear") == 0
                                     ? (80.0 + 70.0 / 0.4) / 150.0 * strength / 40e6
                                 : slack > 0.0 ? slack + (strength - 2e6 * slack) / 40e6
                                               : strength / 40e6;
            assert_close(f.yield[k], drift, 1e-12);
        }
        model_free(m);
    }
}

#define PORTAL                                                                                     \
    "building A -floors 2 -mass 30e3 -height 3.5\nframe A -bays 6 -modulus 30e9 "                  \
    "-columns-inextensible\ncolumns A:1:2 -I 2.1e-3\nbeams A:1:2 -I 3e-3\ndamping A rayleigh 3%\n"

#define HINGE " -yield 90kN*m -hardening 2%% -stiffness 200MN*m\n"
static void the_energies_of_hinges_are_those_of_the_account(void **state) {
    (void)state;
    static const char *const law[] = {
        "bilinear",
        "bilinear -yield-negative 60kN*m",
        "imk -capping 0.03 -post-capping -0.002 -gamma-s 400 -ultimate 0.1",
    };
    for (size_t i = 0; i < sizeof law / sizeof law[0]; i++) {
        struct analysis a =
            analysis_of(UNITS "%shinges A beams %s" HINGE "hinges A bases %s" HINGE NEWMARK SHAKEN,
                        PORTAL, law[i], law[i]);
        assert_all_dissipated(&a, 1e-9);
        analysis_free(&a);
    }
}

// On a foundation, and with friction bearings, whose shear depends on the drift rate.
static void storeys_inside_parts_are_noted(void **state) {
    (void)state;
    static const char *const beside[] = {
        "foundation A -mass 30t -inertia 900t*m^2 -sway 600MN/m -rocking 9000MN*m\n",
        "isolator A:1 fps -radius 2m -mu 6% -mu-slow 3% -rate 50s/m -yield-drift 0.5mm\n",
        "pdelta A\n",
    };
    for (size_t i = 0; i < sizeof beside / sizeof beside[0]; i++) {
        struct analysis a = analysis_of(
            UNITS TOWER "storey A:2:3 bilinear -yield 120kN -hardening 5%%\n%s" NEWMARK SHAKEN,
            beside[i]);
        assert_all_dissipated(&a, 1e-9);
        analysis_free(&a);
    }
}

// One excursion of a storey with imk: it has consumed its plastic work, and the index of Park & Ang
// follows from drift and energy.
static struct analysis excursion(const char *more) {
    return analysis_of(
        UNITS "building A -floors 1 -mass 1t -stiffness 1MN/m\n"
              "storey A imk -yield 5kN -hardening 0 -gamma-s 40 -gamma-c 30 -ultimate 80mm "
              "-capping 70mm -post-capping -0.1 %s\n"
              "initial A:1 -velocity 0.5\nstep adaptive -tolerance 1e-11\nduration 0.13\n",
        more);
}

static void deterioration_and_damage_are_those_of_the_formulas(void **state) {
    (void)state;
    struct analysis a = excursion("");
    const double *demand = a.results->storey_demand[0].value;
    const double energy = 1e3 * 0.25 / 2.0, at_yield = 5e-3, force = 5e3;
    const double peak = at_yield + (energy - force * at_yield / 2.0) / force;
    const double dissipated = energy - force * at_yield / 2.0;
    assert_close(demand[YIELD_DUCTILITY], peak / at_yield, 1e-8);
    assert_close(demand[YIELD_HYSTERETIC], dissipated, 1e-8);
    assert_close(demand[YIELD_DETERIORATION], dissipated / (30.0 * force * at_yield), 1e-8);
    assert_close(demand[YIELD_DAMAGE], peak / 0.08 + 0.05 * dissipated / (force * 0.08), 1e-8);
    analysis_free(&a);
    // The deck may give either constant.
    static const struct {
        const char *more;
        double ultimate, beta;
    } of[] = {{"-damage-beta 0.15", 0.08, 0.15},
              {"-damage-ultimate 60mm", 0.06, 0.05},
              {"-damage-ultimate 60mm -damage-beta 0", 0.06, 0.0}};
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        a = excursion(of[i].more);
        assert_close(a.results->storey_demand[0].value[YIELD_DAMAGE],
                     (peak + of[i].beta * dissipated / force) / of[i].ultimate, 1e-8);
        analysis_free(&a);
    }
}

// The index of a hinge follows from its ductility and its energy.
static void damage_of_hinges_is_that_of_the_formula(void **state) {
    (void)state;
    struct analysis a = analysis_of(
        UNITS "building A -floors 1 -mass 20t -height 3m\nframe A -bays 6m -modulus 30GPa\n"
              "columns A -I 2e-3m^4 -A 0.1m^2\nbeams A -I 2e-3m^4\n"
              "hinges A:1 columns bilinear -yield 40kN*m -hardening 3%% -stiffness 500MN*m "
              "-damage-ultimate 0.02 -damage-beta 0.1\n"
              "initial A:1 -velocity 0.8\nstep fixed 0.2ms\nduration 0.5\n");
    for (int i = 0; i < 4; i++) {
        const double *demand = a.results->hinge_demand[i].value, yield = 40e3 / 500e6;
        assert_true(demand[YIELD_DUCTILITY] > 2.0);
        const double most = demand[YIELD_DUCTILITY] * yield;
        assert_close(demand[YIELD_DAMAGE], (most + 0.1 * demand[YIELD_HYSTERETIC] / 40e3) / 0.02,
                     1e-12);
    }
    analysis_free(&a);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_energies_of_storeys_are_those_of_the_account),
        cmocka_unit_test(a_part_without_a_share_changes_no_demand),
        cmocka_unit_test(the_energy_of_a_storey_is_the_area_of_its_loops),
        cmocka_unit_test(laws_know_their_yields),
        cmocka_unit_test(the_energies_of_hinges_are_those_of_the_account),
        cmocka_unit_test(storeys_inside_parts_are_noted),
        cmocka_unit_test(deterioration_and_damage_are_those_of_the_formulas),
        cmocka_unit_test(damage_of_hinges_is_that_of_the_formula),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
