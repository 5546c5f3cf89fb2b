// SPDX-License-Identifier: GPL-3.0-or-later
// A struck column whose spring has a law.
#include <math.h>

#include "support/analysis.h"
#include "support/support.h"

// A roof hits the columns of a taller building. The arguments: the law of the column with its other
// options, and the steps.
static const char deck[] =
    "units kN m s\n"
    "building low -floors 2 -mass 180t 120t -stiffness 160MN/m 120MN/m -height 3.4m 2.4m\n"
    "building tall -floors 3 -mass 300t -stiffness 200MN/m -height 3.4m\n"
    "damping low rayleigh 5%%\ndamping tall rayleigh 5%%\n"
    "column tall@5.8m %s -name c\n"
    "contact low:2 tall@5.8m -gap 10mm -law hunt-crossley -n 1 -k 1.5GN/m -e 0.5\n"
    "ground record input/records/ELCENTRO_1940_NS.AT2\nduration 6\n%s\n";
static const char fixed[] = "step fixed 0.05ms";

static const char elastic[] = "-EI 64MN*m^2 -mass 0.5t -n 4";
static const char strong[] = "bilinear -yield 1GN -hardening 2% -EI 64MN*m^2 -mass 0.5t -n 4";
static const char four[] = "bilinear -yield 250kN -hardening 2% -EI 64MN*m^2 -mass 0.5t -n 4";
static const char one[] = "bilinear -yield 1MN -hardening 2% -EI 256MN*m^2 -mass 2t";

static void assert_same_forces(const struct results *a, const struct results *b, double factor,
                               double rtol) {
    assert_int_equal(a->link[0].impacts, b->link[0].impacts);
    assert_close(a->link[0].force, b->link[0].force, rtol);
    assert_close(a->link[1].force, b->link[1].force, rtol);
    for (int q = 0; q < COLUMN_FORCE_COUNT; q++) {
        assert_close(a->column[0][q].max, factor * b->column[0][q].max, rtol);
        assert_close(a->column[0][q].min, factor * b->column[0][q].min, rtol);
    }
}

static void a_column_that_never_yields_is_the_elastic_one(void **state) {
    (void)state;
    struct analysis a = analysis_of(deck, strong, fixed), b = analysis_of(deck, elastic, fixed);
    assert_true(a.results->link[0].impacts > 2);
    assert_same_forces(a.results, b.results, 1.0, 1e-6);
    assert_close(a.results->link[1].dissipated, b.results->link[1].dissipated, 1e-5);
    analysis_free(&a);
    analysis_free(&b);
}

static void columns_together_are_as_strong_as_their_sum(void **state) {
    (void)state;
    struct analysis a = analysis_of(deck, four, fixed), b = analysis_of(deck, one, fixed);
    assert_same_forces(a.results, b.results, 0.25, 1e-12);
    analysis_free(&a);
    analysis_free(&b);
}

// The force follows the backbone, the floors take its shares, and the energy is accounted for.
static void a_column_yields_by_its_law(void **state) {
    (void)state;
    struct analysis a = analysis_of(deck, four, fixed);
    const struct results *r = a.results;
    const struct struck_column *c = &a.model->column[0];
    const double yield = 1000.0, k = c->stiffness, most = r->link[1].penetration;
    assert_true(c->yields && most > 3.0 * yield / k);
    // The centre of the range has moved, so the force is below the backbone, but beyond yield.
    assert_true(r->link[1].force > yield);
    assert_true(r->link[1].force <= yield + 0.02 * k * (most - yield / k) + 1e-6 * yield);
    assert_true(r->residual_peak < 1e-11 * r->energy[ENERGY_INPUT]);
    const struct column_peak *below = &r->column[0][COLUMN_SHEAR_BELOW];
    const struct column_peak *above = &r->column[0][COLUMN_SHEAR_ABOVE];
    // The shears of both parts differ by the force on one column, at most.
    assert_true(fmax(below->max - above->max, below->min - above->min) <
                r->link[1].force / 4.0 * (1.0 + 1e-9));
    analysis_free(&a);
}

static void both_methods_agree_on_it(void **state) {
    (void)state;
    struct analysis a = analysis_of(deck, four, fixed);
    struct analysis b =
        analysis_of(deck, four, "integrator dormand-prince\nstep adaptive -tolerance 1e-9");
    assert_same_forces(a.results, b.results, 1.0, 2e-3);
    assert_close(a.results->link[1].dissipated, b.results->link[1].dissipated, 1e-3);
    analysis_free(&a);
    analysis_free(&b);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_column_that_never_yields_is_the_elastic_one),
        cmocka_unit_test(columns_together_are_as_strong_as_their_sum),
        cmocka_unit_test(a_column_yields_by_its_law),
        cmocka_unit_test(both_methods_agree_on_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
