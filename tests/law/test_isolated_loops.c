// SPDX-License-Identifier: GPL-3.0-or-later
// Isolated impacts of laws that dissipate by their loop of force against penetration.
#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "support/impact.h"
#include "support/support.h"

static const double MASS = 15384.615384615385;  // 25 t against 40 t
static const double V0 = 0.5;

// The recipe from Hertz k, e and v0, published and exact, agrees with constants that
// were worked out independently.
static void bilinear_from_hertz_is_the_published_recipe_or_the_exact_one(void **state) {
    (void)state;
    static const struct {
        double e, delivered, k1, k2;  // delivered as published; exact constants
    } known[] = {
        {0.40, 0.660030334988637, 741944417.8305178, 17591429.711462796},
        {0.65, 0.757686779762259, 558592567.712882, 60599888.38103167},
        {0.90, 0.917197404126201, 287930312.7773244, 124088565.46468101},
    };
    for (int k = 0; k < 3; k++) {
        char text[64];
        double value[CONTACT_ROWS_MAX];
        struct error e;
        snprintf(text, sizeof text, "kh 2.75e9 v0 0.5 e %.17g", known[k].e);
        assert_close(impact_under("bilinear", text, MASS, V0).restitution, known[k].delivered,
                     1e-10);
        const struct contact_law *law = impact_law("bilinear", text, value);
        assert_int_equal(law->calibrate(value, MASS, &e), STATUS_OK);
        assert_close(value[contact_law_row(law, "k1")], known[k].k1, 1e-13);
        assert_close(value[contact_law_row(law, "k2")], known[k].k2, 1e-13);
        assert_close(value[contact_law_row(law, "dy")], 0.0004977847510723812, 1e-13);
        struct isolated_impact i = impact_of(law, value, MASS, V0);
        assert_close(i.restitution, known[k].e, 1e-10);
        assert_close(i.max_penetration, 0.004977847510723812, 1e-10);
    }
}

// Facts from quadrature of both branches: depth from the energy, e^2 from what comes back.
static void a_table_gives_back_what_lies_below_its_unloading_branch(void **state) {
    (void)state;
    static const struct {
        double energy, depth, restitution;
    } known[] = {
        {100.0, 0.00142067359797, 0.741069165632},
        {2000.0, 0.00675881498625, 0.729396212036},
        {40000.0, 0.0226659569431, 0.792843560678},
        {120000.0, 0.0345186278334, 0.780550579294},
    };
    double value[IMPACT_VALUES_MAX], constant[IMPACT_CONSTANTS_MAX];
    const struct contact_law *law = impact_law("table", "", value);
    assert_int_equal(contact_law_n_value(law, value), law->n_row + PAD_NUMBERS);
    struct error e;
    assert_int_equal(law->prepare(value, MASS, constant, &e), STATUS_OK);
    for (int k = 0; k < 4; k++) {
        struct isolated_impact i;
        double v = sqrt(2.0 * known[k].energy / MASS);
        assert_int_equal(isolated_run(law, constant, MASS, v, NULL, &i, &e), STATUS_OK);
        assert_close(i.max_penetration, known[k].depth, 1e-9);
        assert_close(i.restitution, known[k].restitution, 1e-9);
    }
}

// The approach is elastic; the release obeys ln(1 - e q) + e q + q^2 / 2 = 0 with q = c v0.
static void rubber_loses_energy_on_release_only(void **state) {
    (void)state;
    const double energy = 0.5 * MASS * V0 * V0;
    struct isolated_impact i = impact_under("rubber", "k 1e9 n 2 c 0.8", MASS, V0);
    double q = 0.8 * V0;
    assert_close(i.max_penetration, cbrt(3.0 * energy / 1e9), 1e-11);
    assert_close(i.peak_force, 1e9 * pow(i.max_penetration, 2.0), 1e-10);
    assert_near(log(1.0 - i.restitution * q) + i.restitution * q + q * q / 2.0, 0.0, 1e-10);
    i = impact_under("rubber", "k 1e9 n 2 c 0.8 du 1e-2 ky 1e8", MASS, V0);
    double beyond = i.max_penetration - 1e-2;
    assert_close(1e9 * 1e-6 / 3.0 + 1e5 * beyond + 5e7 * beyond * beyond, energy, 1e-10);
    assert_near(log(1.0 - i.restitution * q) + i.restitution * q + q * q / 2.0, 0.0, 1e-10);
    // Without ky the slope at du goes on.
    i = impact_under("rubber", "k 1e9 n 2 e 1 du 1e-2", MASS, V0);
    beyond = i.max_penetration - 1e-2;
    assert_close(1e9 * 1e-6 / 3.0 + 1e5 * beyond + 1e7 * beyond * beyond, energy, 1e-10);
    assert_close(i.restitution, 1.0, 1e-10);
}

// e^2 = 1 - R without a dashpot; what bilinear loses is (k1 - k2) dy (d_max - dy).
static void laws_with_history_lose_what_their_loops_enclose(void **state) {
    (void)state;
    struct isolated_impact i = impact_under("wang", "k 1e9 zeta 0 residual 0.3 n 1.8", MASS, V0);
    assert_close(i.restitution * i.restitution, 0.7, 1e-10);
    i = impact_under("wang", "k 1e9 zeta 2e9 residual 0.3 n 1.8", MASS, V0);
    double stored = 1e9 * pow(i.max_penetration, 2.8) / 2.8;
    assert_close(i.restitution * i.restitution, 0.7 * stored / (0.5 * MASS * V0 * V0), 1e-10);
    i = impact_under("bilinear", "k1 4e8 k2 1e8 dy 1e-3", MASS, V0);
    assert_close(i.dissipated, 3e8 * 1e-3 * (i.max_penetration - 1e-3), 1e-9);
    i = impact_under("bilinear", "k1 4e8 k2 1e8 dy 1e-2", MASS, V0);
    assert_close(i.restitution, 1.0, 1e-11);
}

int main(void) {
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bilinear_from_hertz_is_the_published_recipe_or_the_exact_one),
        cmocka_unit_test(a_table_gives_back_what_lies_below_its_unloading_branch),
        cmocka_unit_test(rubber_loses_energy_on_release_only),
        cmocka_unit_test(laws_with_history_lose_what_their_loops_enclose),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
