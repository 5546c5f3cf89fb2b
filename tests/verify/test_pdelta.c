// SPDX-License-Identifier: GPL-3.0-or-later
// P-delta against closed forms, converged solutions of another program, and its energy account.
#include <math.h>
#include <stdio.h>

#include "support/analysis.h"
#include "support/support.h"

#define STOREYS                                                                                    \
    "units kN m s\nbuilding A -floors 4 -mass 100 -stiffness 30000 27000 23000 17000 "             \
    "-height 3.5 3*3\n"
#define STEP "step fixed 0.01\nduration 1\n"

enum { FLOORS = 4 };

// Periods, stability coefficients and the buckling factor of four storeys (closed forms).
static void four_storeys_have_their_periods_and_buckling_factor(void **state) {
    (void)state;
    static const double theta[FLOORS] = {0.03735866667, 0.03632092593, 0.02842507246,
                                         0.01922872549};
    static const double period[FLOORS] = {1.132720269, 0.4287020339, 0.279685566, 0.2168801628};
    struct model *m = analysis_model(STOREYS "pdelta A\n" STEP);
    const struct building *g = &m->building[0];
    for (int i = 0; i < FLOORS; i++) {
        assert_close(g->theta[i], theta[i], 1e-9);
        assert_close(2 * acos(-1.0) / g->omega[i], period[i], 1e-9);
        assert_close(g->axial[i], 980.665 * (FLOORS - i), 1e-12);
        assert_close(g->stiffness[i] - g->spring[i], g->axial[i] / g->height[i], 1e-12);
    }
    assert_close(g->buckling, 26.76755059, 1e-9);
    model_free(m);
}

// Displacements at rest under loads, of storeys and of the same ones as a matrix or as both.
static void four_storeys_sway_further_at_rest(void **state) {
    (void)state;
    static const double u[FLOORS] = {0.01731347501, 0.03460830595, 0.05027090785, 0.06226626924};
    static const char *const matrix = "57000 -27000 0 0\n-27000 50000 -23000 0\n"
                                      "0 -23000 40000 -17000\n0 0 -17000 17000\n";
    static const char bare[] = "units kN m s\nbuilding A -floors 4 -mass 100 -height 3.5 3*3\n";
    static const char rest[] =
        "damping A rayleigh -alpha 8 -beta 0\n"
        "load A:1 constant 50\nload A:2 constant 100\nload A:3 constant 150\nload A:4 constant "
        "200\nstep fixed 0.02\nduration 12\n";
    const char *file = support_write("chain.txt", matrix);
    for (int i = 0; i < 3; i++) {
        // The weights of the third are halved, and what leans there has the other half.
        struct analysis a =
            i == 0   ? analysis_of(STOREYS "pdelta A\n%s", rest)
            : i == 1 ? analysis_of("%smatrix A %s\npdelta A\n%s", bare, file, rest)
                     : analysis_of(STOREYS "pdelta A -weight 500 -leaning 4*480.665\n%s", rest);
        for (int k = 0; k < FLOORS; k++) {
            assert_close(analysis_displacement(&a, k, 12.0), u[k], 1e-8);
        }
        assert_close(a.model->building[0].buckling, 26.76755059, 1e-9);
        // The shear is that of storeys and P-delta together, in equilibrium with the loads.
        assert_close(a.rows.shear[(a.rows.n - 1) * FLOORS], 500.0, 1e-8);
        analysis_free(&a);
    }
}

// One storey: T / sqrt(1 - theta) and 1 / (1 - theta), as steps of free vibration see them.
static void one_storey_follows_closed_forms(void **state) {
    (void)state;
    static const double theta[] = {0.04, 0.083, 0.1, 0.25, 0.5, 0.9};
    for (size_t i = 0; i < sizeof theta / sizeof theta[0]; i++) {
        struct analysis a =
            analysis_of("building A -floors 1 -mass 1 -stiffness ${4 * pi^2} -height 3\n"
                        "pdelta A -weight ${3 * %.17g * 4 * pi^2}\n"
                        "load A constant ${4 * pi^2 * 0.01}\n"
                        "integrator dormand-prince\nstep adaptive -tolerance 1e-12\nduration 10\n",
                        theta[i]);
        const double omega = 2 * acos(-1.0) * sqrt(1 - theta[i]);
        assert_close(a.model->building[0].omega[0], omega, 1e-12);
        assert_close(a.model->building[0].buckling, 1 / theta[i], 1e-12);
        const double still = 0.01 / (1 - theta[i]);
        assert_near(analysis_displacement(&a, 0, 10.0), still * (1 - cos(omega * 10)),
                    1e-8 * still);
        analysis_free(&a);
    }
}

// Converged to 5e-9 by explicit Runge-Kutta steps of 1e-5 s: T = 1 s without P-delta, c of 5 %, V_y
// a tenth of the weight, El Centro after a zero.
static const struct {
    double hardening, theta, scale, peak, end;
} yielding[] = {
    {1, 0, 1, 0.113027903, 0.005471576594},         {1, 0.04, 1, 0.1101099722, 0.006583799538},
    {1, 0.083, 2, 0.2166497055, 0.01256948402},     {1, 0.1, 1, 0.1068425518, 0.00549491741},
    {0, 0, 1, 0.1033461894, -0.00298944979},        {0, 0, 2, 0.2053306256, -0.1395167388},
    {0, 0.04, 1, 0.1307020484, -0.1049398619},      {0.05, 0, 2, 0.1844077256, -0.007267009159},
    {0.05, 0.04, 1, 0.1038106225, 0.004336419945},  {0.05, 0.04, 2, 0.1949621912, -0.06640599401},
    {0.05, 0.083, 1, 0.1092941399, -0.08314568307}, {0.05, 0.1, 1, 0.2342131038, -0.2219375861},
};

static struct analysis one_storey(double hardening, double theta, double scale, const char *step) {
    char pdelta[80] = "", law[80] = "";
    if (theta > 0) {
        snprintf(pdelta, sizeof pdelta, "pdelta A -weight ${%.17g * k * 3}\n", theta);
    }
    if (hardening < 1) {
        snprintf(law, sizeof law, "storey A bilinear -yield 0.980665 -hardening %g\n", hardening);
    }
    return analysis_of("param k 39.4784176\nbuilding A -floors 1 -mass 1 -stiffness $k -height 3\n"
                       "damping A rayleigh 5%%\n%s%s"
                       "ground record tests/verify/reference/elcentro_led_by_zero.txt "
                       "-format series -unit g -dt 0.02 -scale %g\nduration 31.18\n%s",
                       law, pdelta, scale, step);
}

static void compare(const char *step, double tolerance, double missed) {
    for (size_t i = 0; i < sizeof yielding / sizeof yielding[0]; i++) {
        struct analysis a =
            one_storey(yielding[i].hardening, yielding[i].theta, yielding[i].scale, step);
        const double peak = yielding[i].peak;
        assert_close(a.results->peak[PEAK_DRIFT][0], peak, tolerance);
        assert_near(a.rows.displacement[a.rows.n - 1], yielding[i].end, tolerance * peak);
        // What P-delta gives comes back: the account closes.
        assert_true(a.results->residual_peak <= missed * analysis_flow(&a));
        analysis_free(&a);
    }
}

static void yielding_storeys_agree_at_fixed_steps(void **state) {
    (void)state;
    compare("step fixed 0.001\n", 2e-4, 1e-12);
}

static void yielding_storeys_agree_in_adaptive_steps(void **state) {
    (void)state;
    compare("integrator newmark\nstep adaptive -tolerance 1e-7\n", 2e-4, 1e-12);
    compare("integrator dormand-prince\nstep adaptive -tolerance 1e-8\n", 1e-6, 1e-6);
}

// The fast steps of storeys on their lines give the bits of single steps; a matrix of zeros beside
// them gives the same to rounding.
static void parts_beside_yielding_storeys_agree(void **state) {
    (void)state;
    static const char deck[] =
        "building A -floors 2 -mass 1 -stiffness 100 80 -height 3\n%s"
        "storey A bilinear -yield 2 1.2 -hardening 0.02\npdelta A\ndamping A rayleigh -alpha 0.3 "
        "-beta 0.002\nground record input/records/ELCENTRO_1940_NS.AT2\nstep fixed 0.002\n";
    char matrix[200];
    snprintf(matrix, sizeof matrix, "matrix A %s\n",
             support_write("none.txt", "2e-9 -1e-9\n-1e-9 1e-9\n"));
    struct analysis a = analysis_of(deck, ""), b = analysis_of(deck, matrix);
    for (int i = 0; i < 2; i++) {
        assert_close(b.results->peak[PEAK_DRIFT][i], a.results->peak[PEAK_DRIFT][i], 1e-6);
        assert_close(b.results->peak[PEAK_SHEAR][i], a.results->peak[PEAK_SHEAR][i], 1e-6);
    }
    assert_close(b.results->energy[ENERGY_HYSTERETIC], a.results->energy[ENERGY_HYSTERETIC], 1e-6);
    assert_close(b.results->energy[ENERGY_STRAIN], a.results->energy[ENERGY_STRAIN], 1e-6);
    analysis_free(&a);
    analysis_free(&b);
}

// A rigid building on a slab that rocks is a pendulum upside down: J theta'' = -(K - W h) theta. It
// leans with its foundation, so that P-delta acts on that, too.
static void a_rigid_building_rocks_as_a_pendulum(void **state) {
    (void)state;
    static const char deck[] = "building A -floors 1 -mass 1000 -stiffness 1e9 -height 3\n%s%s"
                               "foundation A -mass 100 -inertia 1 -sway 1e9 -rocking %s\n" STEP;
    static const char pdelta[] = "pdelta A\n", yields[] = "storey A bilinear -yield 1e8 "
                                                          "-hardening 0.1\n";
    for (int i = 0; i < 2; i++) {
        struct model *m = analysis_model(deck, pdelta, i ? yields : "", "2e6");
        const double omega = sqrt((2e6 - 1000 * 9.80665 * 3) / (1000 * 9 + 1));
        assert_close(m->building[0].omega[0], omega, 3e-4);
        // Far nearer where it matters: the difference that P-delta makes.
        struct model *without = analysis_model(deck, "", i ? yields : "", "2e6");
        const double before = sqrt(2e6 / (1000 * 9 + 1));
        assert_close(without->building[0].omega[0] / m->building[0].omega[0], before / omega, 1e-5);
        model_free(m);
        model_free(without);
    }
}

// Damping is that of the building without P-delta.
static void damping_stays(void **state) {
    (void)state;
    static const char *const damping[] = {"rayleigh 5%", "rayleigh 3% 7% -modes 1 4", "modal 5%",
                                          "rayleigh -alpha 0.1 -beta 0.01"};
    for (size_t k = 0; k < sizeof damping / sizeof damping[0]; k++) {
        double force[2][FLOORS];
        for (int i = 0; i < 2; i++) {
            static const double v[FLOORS] = {1, -2, 0.5, 3};
            struct model *m = analysis_model(STOREYS "damping A %s\n%s" STEP, damping[k],
                                             i ? "pdelta A -leaning 2000\n" : "");
            building_damping_force(&m->building[0], v, force[i]);
            model_free(m);
        }
        for (int i = 0; i < FLOORS; i++) {
            assert_true(force[0][i] == force[1][i]);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(four_storeys_have_their_periods_and_buckling_factor),
        cmocka_unit_test(four_storeys_sway_further_at_rest),
        cmocka_unit_test(one_storey_follows_closed_forms),
        cmocka_unit_test(yielding_storeys_agree_at_fixed_steps),
        cmocka_unit_test(yielding_storeys_agree_in_adaptive_steps),
        cmocka_unit_test(parts_beside_yielding_storeys_agree),
        cmocka_unit_test(a_rigid_building_rocks_as_a_pendulum),
        cmocka_unit_test(damping_stays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
