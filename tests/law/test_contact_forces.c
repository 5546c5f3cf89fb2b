// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of single laws against their formulas, and parameters that they refuse.
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "support/impact.h"
#include "support/support.h"

static const double V0 = 0.5;
static const double MASS = 15384.615384615385;

// The law with parameters like "k 1e8 e 0.65", closed at V0.
static struct bound_law bind(const char *name, const char *parameters) {
    double value[IMPACT_VALUES_MAX];
    const struct contact_law *law = impact_law(name, parameters, value);
    return bound_law(law, value, MASS, V0);
}

// Up to 2 mm, back to the line k2 d, up again: k1 4e8, k2 1e8, dy 0.02 mm.
static void bilinear_unloads_to_the_lower_line_and_reloads_from_it(void **state) {
    (void)state;
    struct bound_law b = bind("bilinear", "k1 4e8 k2 1e8 dy 2e-5");
    const double height = 3e8 * 2e-5;
    assert_close(bound_at(&b, 1e-5, 0.1).force, 4e8 * 1e-5, 1e-14);
    assert_close(bound_at(&b, 2e-3, 0.1).force, 1e8 * 2e-3 + height, 1e-14);
    bound_commit(&b, 2e-3, 0.1);
    assert_close(bound_at(&b, 1.99e-3, -0.1).force, 1e8 * 2e-3 + height - 4e8 * 1e-5, 1e-12);
    assert_close(bound_at(&b, 1.9e-3, -0.1).force, 1e8 * 1.9e-3, 1e-14);
    assert_true(bound_at(&b, 1.99e-3, -0.1).force == bound_at(&b, 1.99e-3, 0.1).force);
    bound_commit(&b, 1.9e-3, -0.1);
    assert_close(bound_at(&b, 1.91e-3, 0.1).force, 1e8 * 1.9e-3 + 4e8 * 1e-5, 1e-12);
    assert_close(bound_at(&b, 1.95e-3, 0.1).force, 1e8 * 1.95e-3 + height, 1e-14);
    assert_close(bound_at(&b, 3e-3, 0.1).force, 1e8 * 3e-3 + height, 1e-14);
}

// f_e ((d - d_e) / (d_max - d_e))^n with d_max 2 mm, d_e 0.5 mm, n = 3/2.
static void wang_releases_to_its_residual_penetration(void **state) {
    (void)state;
    struct bound_law b = bind("wang", "k 1e8 zeta 1e8 residual 0.25");
    double f_e = 1e8 * pow(2e-3, 1.5);
    assert_close(bound_at(&b, 2e-3, 0.1).force, f_e * 1.1, 1e-14);
    bound_commit(&b, 2e-3, 0.1);
    assert_close(bound_at(&b, 2e-3, -0.1).force, f_e, 1e-14);
    assert_close(bound_at(&b, 1.25e-3, -0.1).force, f_e * pow(0.5, 1.5), 1e-12);
    assert_true(bound_at(&b, 5e-4, -0.1).force == 0.0 && bound_at(&b, 1e-4, -0.1).force == 0.0);
    assert_close(bound_at(&b, 1e-3, 0.0).force, 1e8 * pow(1e-3, 1.5), 1e-14);
}

// The points of the file, half-way between them, and the last slope beyond.
static void a_table_goes_through_its_points_and_beyond(void **state) {
    (void)state;
    struct bound_law b = bind("table", "");
    const double *last = pad + (ptrdiff_t)(PAD_POINTS - 1) * CURVE_COLUMNS;
    for (int i = 0; i < PAD_POINTS; i++) {
        const double *p = pad + (ptrdiff_t)i * CURVE_COLUMNS;
        assert_close(bound_at(&b, p[0], 0.1).force, p[1], 1e-14);
    }
    assert_close(bound_at(&b, 6e-3, 0.1).force, 5e5, 1e-14);
    assert_close(bound_at(&b, 3e-2, 0.1).force, 4e6 + 3.2e6, 1e-14);
    bound_commit(&b, last[0], 0.1);
    for (int i = 0; i < PAD_POINTS; i++) {
        const double *p = pad + (ptrdiff_t)i * CURVE_COLUMNS;
        assert_close(bound_at(&b, p[0], -0.1).force, p[2], 1e-14);
    }
}

// Down from half the last penetration: the share at 1e-3 is that of the curve at 2e-3. Up again the
// same way, then on along the loading branch.
static void a_table_unloads_similarly_and_reloads_the_same_way(void **state) {
    (void)state;
    struct bound_law b = bind("table", "");
    bound_commit(&b, 1e-2, 0.1);
    double loading = 2e5 * (1e-3 - 1e-5) / (2e-3 - 1e-5);
    assert_close(bound_at(&b, 1e-3, -0.1).force, 0.1 * loading, 1e-13);
    assert_close(bound_at(&b, 5e-3, -0.1).force, 0.25 * 4.25e5, 1e-13);
    bound_commit(&b, 1e-3, -0.1);
    assert_close(bound_at(&b, 5e-3, 0.1).force, 0.25 * 4.25e5, 1e-13);
    assert_close(bound_at(&b, 1e-2, 0.1).force, 8e5, 1e-14);
    assert_close(bound_at(&b, 1.5e-2, 0.1).force, 2.4e6, 1e-14);
}

// k 1e8, n 1.3, du 5 mm, ky 9e9, and q of e = 0.65 from ln(1 - e q) + e q + q^2 / 2 = 0.
static void rubber_hardens_beyond_its_ultimate_compression(void **state) {
    (void)state;
    struct bound_law b = bind("rubber", "k 1e8 n 1.3 e 0.65 du 5e-3 ky 9e9");
    double ultimate = 1e8 * pow(5e-3, 1.3);
    double q = contact_law_find("rubber")->exact(0.65);
    assert_near(log(1.0 - 0.65 * q) + 0.65 * q + q * q / 2.0, 0.0, 1e-14);
    assert_close(bound_at(&b, 3e-3, 1.0).force, 1e8 * pow(3e-3, 1.3), 1e-14);
    assert_close(bound_at(&b, 7e-3, 1.0).force, ultimate + 9e9 * 2e-3, 1e-14);
    assert_close(bound_at(&b, 7e-3, -0.1).force, (ultimate + 9e9 * 2e-3) * (1.0 - 0.1 * q / V0),
                 1e-14);
    assert_true(bound_at(&b, 7e-3, -2.0).force == 0.0);
}

static void assert_refused(const char *name, const char *parameters, const char *message) {
    double value[CONTACT_ROWS_MAX], constant[CONTACT_CONSTANTS_MAX];
    struct error e;
    const struct contact_law *law = impact_law(name, parameters, value);
    assert_int_equal(law->prepare(value, MASS, constant, &e), STATUS_INPUT);
    assert_string_equal(e.message, message);
}

static void parameters_that_no_law_can_meet_are_refused(void **state) {
    (void)state;
    assert_refused("wang", "k 1e8 e 0.9 residual 0.3",
                   "e is 0.9; with a residual of 0.3 it must be <= 0.83666, sqrt(1 - R)");
    assert_refused("bilinear", "k1 1e8 k2 1e7 dy 1e-3 e 0.5",
                   "bilinear needs -k1, -k2 and -dy, or -kh, -e and -v0, and no mixture");
    assert_refused("bilinear", "kh 1e8 e 0.2 v0 1 a 0.62",
                   "a is 0.62; with e = 0.2 it must be < (3 + 2 e^2) / 5, which is 0.616");
    assert_refused("rubber", "k 1e8 e 0.5 n 2 ky 1e6", "-ky needs -du");
    (void)bind("bilinear", "kh 1e8 e 0.2 v0 1 a 0.61");
    double value[CONTACT_ROWS_MAX];
    struct error e;
    const struct contact_law *law = impact_law("bilinear", "kh 1e8 e 0.2 v0 1 a 0.1", value);
    assert_int_equal(law->calibrate(value, MASS, &e), STATUS_INPUT);
    assert_string_equal(
        e.message, "a is 0.1; with e = 0.2 it must be < 2 e^2 / (1 + e^2), which is 0.0769231");
}

// Values worked out by hand from the formulas: k = 1e8 (1e8 N/m^1.5), m* and e with the parameters
// given.
static void forces_agree_with_the_formulas(void **state) {
    (void)state;
    double d = 2e-3;
    double v = 0.3;
    double l = log(0.65);
    double c = 2.0 * (-l / sqrt(9.869604401089358 + l * l)) * sqrt(1e8 * MASS);
    struct bound_law b = bind("kelvin-voigt", "k 1e8 e 0.65");
    assert_close(bound_at(&b, d, v).force, 1e8 * d + c * v, 1e-14);
    assert_close(bound_at(&b, d, -1.9).force, 1e8 * d - 1.9 * c, 1e-13);
    b = bind("komodromos", "k 1e8 e 0.65");
    assert_close(bound_at(&b, d, v).force, 1e8 * d + c * v, 1e-14);
    assert_true(bound_at(&b, d, -1.9).force == 0.0);
    b = bind("hertz", "k 1e8");
    assert_close(bound_at(&b, d, v).force, 1e8 * 8.94427190999916e-5, 1e-14);
    b = bind("hertz-damp", "k 1e8 e 0.65");
    assert_close(bound_at(&b, d, v).force, 8944.27190999916 * (1.0 + 0.433125 * v / V0), 1e-14);
    // zeta of 0.65: 4.5 sqrt5 0.5775 / (0.65 (0.65 (9 pi - 16) + 16)) = 0.37283566526 (reference
    // rows)
    b = bind("jankowski", "k 1e8 e 0.65");
    double damper = 2.0 * 0.3728356652600535 * sqrt(1e8 * sqrt(d) * MASS);
    assert_close(bound_at(&b, d, v).force, 8944.27190999916 + damper * v, 1e-14);
    // (1 - e^2) / (e (e (pi - 2) + 2)), also a reference row.
    b = bind("mahmoud-jankowski", "k 1e8 e 0.65");
    damper = 2.0 * 0.3240153629009381 * sqrt(1e8 * MASS);
    assert_close(bound_at(&b, d, v).force, 1e8 * d + damper * v, 1e-14);
    b = bind("ye-kelvin", "k 1e8 e 0.65");
    assert_close(bound_at(&b, d, v).force, 1e8 * d * (1.0 + 1.5 * 0.35 / 0.65 * v / V0), 1e-14);
    b = bind("ye-hertz-damp", "k 1e8 e 0.65");
    assert_close(bound_at(&b, d, v).force, 8944.27190999916 * (1.0 + 1.6 * 0.35 / 0.65 * v / V0),
                 1e-14);
    b = bind("power", "k 1e8 n 1.3 e 0.65");
    assert_close(bound_at(&b, d, v).force, 1e8 * pow(d, 1.3) * (1.0 + 0.7931009088580941 * v / V0),
                 1e-12);
    b = bind("khatami", "k 1e8 e 0.65");
    double factor = 0.01557 * pow(0.65, 0.2706) * V0 * 0.35;
    assert_close(bound_at(&b, d, v).force, 8944.27190999916 * (1.0 + factor), 1e-14);
}

// A path whose penetration does not turn, in GRID steps; v goes evenly with d.
enum { GRID = 4000, BESIDE = 3 };

static struct contact_way place(const struct contact_way *leg, double i) {
    const double x = i / GRID;
    return (struct contact_way){leg->d0, leg->v0, leg->d0 + x * (leg->d - leg->d0),
                                leg->v0 + x * (leg->v - leg->v0)};
}

static double force_on(const struct bound_law *b, const struct contact_way *leg, int i) {
    const struct contact_way w = place(leg, i);
    return bound_at(b, w.d, w.v).force;
}

static double bend(const struct bound_law *b, const struct contact_way *leg, int i) {
    return fabs(force_on(b, leg, i - 1) - 2.0 * force_on(b, leg, i) + force_on(b, leg, i + 1));
}

// The first place of the grid where the force has a kink: its second difference is of the first
// order in the step there, of the second order on both sides. GRID if there is none.
static int first_kink(const struct bound_law *b, const struct contact_way *leg) {
    for (int i = BESIDE + 1; i < GRID - BESIDE; i++) {
        const struct contact_way w = place(leg, i);
        const struct contact_response r = bound_at(b, w.d, w.v);
        const double rounding = 1e-14 * (fabs(r.force) + r.dfdd * w.d);
        const double both = bend(b, leg, i - BESIDE) + bend(b, leg, i + BESIDE);
        if (bend(b, leg, i) > 10.0 * (both + rounding)) {
            return i;
        }
    }
    return GRID;
}

// Where the law says that the first kink is, as it is sought by steps.
static double declared_kink(const struct bound_law *b, const struct contact_way *leg) {
    if (!b->law->kink) {
        return GRID;
    }
    for (int i = 1; i <= GRID; i++) {
        const struct contact_way w = place(leg, i);
        if (b->law->kink(b->constant, b->history, &w) <= 0.0) {
            return i;
        }
    }
    return GRID;
}

// Takes the contact along the leg, to one kink after the other; returns their number.
static int walk(struct bound_law *b, struct contact_way leg) {
    int n = 0;
    leg.d0 = place(&leg, 1e-6).d;  // on its way by more than rounding, as in steps
    for (int found = 0; found < GRID && n < 10; n++) {
        found = first_kink(b, &leg);
        assert_near(declared_kink(b, &leg), found, 1.0);
        const struct contact_way end = place(&leg, fmin(found + 1, GRID));
        if (b->law->commit) {
            bound_commit(b, end.d, end.v);
        }
        leg.d0 = end.d;
        leg.v0 = end.v;
    }
    return n - 1;
}

// Dormand & Prince's steps end at kinks, and quick Newton steps rely on a force without; both take
// the law's word for it.
static void every_law_declares_its_kinks(void **state) {
    (void)state;
    static const struct {
        const char *law, *parameters;
        int n;
    } cases[] = {
        {"linear", "k 1e8", 0},
        {"bilinear", "k1 4e8 k2 1e8 dy 2e-4", 6},
        {"kelvin-voigt", "k 1e8 e 0.65", 0},
        {"komodromos", "k 1e8 e 0.65", 3},
        {"ye-kelvin", "k 1e8 e 0.65", 0},
        {"mahmoud-jankowski", "k 1e8 e 0.65", 0},
        {"hertz", "k 1e8", 0},
        {"power", "k 1e8 n 3 e 0.65", 0},
        {"hertz-damp", "k 1e8 e 0.65", 0},
        {"lankarani-nikravesh", "k 1e8 e 0.65", 0},
        {"ye-hertz-damp", "k 1e8 e 0.65", 0},
        {"hunt-crossley", "k 1e8 e 0.65 n 1.5", 0},
        {"jankowski", "k 1e8 e 0.65", 0},
        {"khatami", "k 1e8 e 0.65", 0},
        {"wang", "k 1e8 zeta 1e8 residual 0.25 n 1", 3},
        {"rubber", "k 1e8 n 1.5 e 0.65 du 5e-3 ky 9e9", 9},
        {"table", "", 18},
    };
    // Up, part of the way back, deeper, nearly open, up to less than the deepest, and back.
    static const struct contact_way legs[] = {
        {1e-7, 0.5, 7e-3, 0.1},       {7e-3, -0.1, 1.5e-3, -0.6}, {1.5e-3, 0.9, 1.5e-2, 0.05},
        {1.5e-2, -0.05, 9e-4, -0.55}, {9e-4, 0.4, 8e-3, 0.1},     {8e-3, -0.1, 1e-4, -0.9},
    };
    size_t n_law = 0;
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        struct bound_law b = bind(cases[k].law, cases[k].parameters);
        int n = 0;
        for (size_t i = 0; i < sizeof legs / sizeof legs[0]; i++) {
            n += walk(&b, legs[i]);
        }
        assert_int_equal(n, cases[k].n);
        assert_true(n == 0 || !(b.law->traits & CONTACT_SMOOTH));
        n_law++;
    }
    assert_int_equal(n_law, n_contact_law - 1);  // all that have a force
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_law_declares_its_kinks),
        cmocka_unit_test(bilinear_unloads_to_the_lower_line_and_reloads_from_it),
        cmocka_unit_test(wang_releases_to_its_residual_penetration),
        cmocka_unit_test(a_table_goes_through_its_points_and_beyond),
        cmocka_unit_test(a_table_unloads_similarly_and_reloads_the_same_way),
        cmocka_unit_test(rubber_hardens_beyond_its_ultimate_compression),
        cmocka_unit_test(parameters_that_no_law_can_meet_are_refused),
        cmocka_unit_test(forces_agree_with_the_formulas),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
