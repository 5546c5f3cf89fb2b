// SPDX-License-Identifier: GPL-3.0-or-later
// Properties that every storey law must have, and closed forms of the bilinear one.
#include <math.h>
#include <string.h>

#include "jostle/storey_law.h"
#include "support/support.h"

static const double STIFFNESS = 2e7;
static const double YIELD = 1.5e5;

struct bound_law {
    const struct storey_law *law;
    double constant[STOREY_CONSTANTS_MAX];
    double history[STOREY_HISTORY_MAX];
};

static struct bound_law bind(const struct storey_law *law, double hardening) {
    struct bound_law b = {.law = law};
    double value[STOREY_ROWS_MAX];
    for (int i = 0; i < law->n_row; i++) {
        value[i] = strcmp(law->row[i].key, "yield") == 0       ? YIELD
                   : strcmp(law->row[i].key, "hardening") == 0 ? hardening
                                                               : law->row[i].fallback;
    }
    struct error e;
    assert_int_equal(law->prepare(value, STIFFNESS, b.constant, &e), STATUS_OK);
    return b;
}

static struct storey_response at(const struct bound_law *b, double drift) {
    return b->law->shear(b->constant, b->history, drift);
}

static void commit(struct bound_law *b, double drift) {
    if (b->law->commit) {
        b->law->commit(b->constant, b->history, drift);
    }
}

// Work from drift `from` to `to` in n steps by the mean of the shears.
static double work_along(struct bound_law *b, double from, double to, int n) {
    double work = 0.0;
    double before = at(b, from).shear;
    for (int i = 1; i <= n; i++) {
        double drift = from + (to - from) * i / n;
        double shear = at(b, drift).shear;
        work += (before + shear) / 2.0 * (to - from) / n;
        before = shear;
        commit(b, drift);
    }
    return work;
}

static void tangents_agree_with_central_differences(void **state) {
    (void)state;
    const double drift[] = {-0.05, -0.008, -1e-4, 1e-4, 0.007, 0.03};
    for (int k = 0; k < n_storey_law; k++) {
        struct bound_law b = bind(storey_laws[k], 0.05);
        for (size_t i = 0; i < sizeof drift / sizeof drift[0]; i++) {
            double h = 1e-4 * fabs(drift[i]);  // the laws are piecewise linear: no truncation
            double slope = (at(&b, drift[i] + h).shear - at(&b, drift[i] - h).shear) / (2.0 * h);
            assert_close(at(&b, drift[i]).tangent, slope, 1e-8);
            commit(&b, drift[i]);
        }
    }
}

static void a_law_is_a_pure_function(void **state) {
    (void)state;
    for (int k = 0; k < n_storey_law; k++) {
        struct bound_law b = bind(storey_laws[k], 0.1);
        struct bound_law before;
        memcpy(&before, &b, sizeof b);
        double first = at(&b, 0.02).shear;
        at(&b, -0.5);
        assert_true(first == at(&b, 0.02).shear);
        assert_memory_equal(&before, &b, sizeof b);
    }
}

static void work_is_what_is_stored_and_what_a_loop_dissipates(void **state) {
    (void)state;
    for (int k = 0; k < n_storey_law; k++) {
        struct bound_law b = bind(storey_laws[k], 0.05);
        const double turn[] = {0.0, 0.03, -0.02, 0.01, 0.0};
        double work = 0.0;
        for (int i = 0; i < 4; i++) {
            work += work_along(&b, turn[i], turn[i + 1], 4000);
        }
        double dissipated = work - b.law->stored(b.constant, b.history, 0.0);
        if (b.law->n_history == 0) {
            assert_near(dissipated, 0.0, 1e-9 * YIELD * 0.03);
        } else {
            assert_true(dissipated > 0.1 * YIELD * 0.03);
        }
    }
}

// A full elastoplastic loop between +-u encloses 4 V_y (u - u_y).
static void an_elastoplastic_loop_has_its_closed_form_area(void **state) {
    (void)state;
    struct bound_law b = bind(storey_law_find("bilinear"), 0.0);
    double u = 0.03;
    work_along(&b, 0.0, u, 30000);
    double area = work_along(&b, u, -u, 60000) + work_along(&b, -u, u, 60000);
    assert_close(area, 4.0 * YIELD * (u - YIELD / STIFFNESS), 1e-4);
    assert_close(at(&b, u).shear, YIELD, 1e-12);
    assert_true(at(&b, u + 0.001).tangent == 0.0);
}

// Kinematic hardening: after yielding to u1 the elastic range is still 2 V_y wide, about the back
// shear.
static void hardening_moves_the_elastic_range(void **state) {
    (void)state;
    double r = 0.05;
    struct bound_law b = bind(storey_law_find("bilinear"), r);
    double uy = YIELD / STIFFNESS;
    double u1 = 4.0 * uy;
    commit(&b, u1);
    double top = at(&b, u1).shear;
    assert_close(top, YIELD + r * STIFFNESS * (u1 - uy), 1e-14);
    assert_close(at(&b, u1 - 1.999 * uy).shear, top - 1.999 * YIELD, 1e-12);
    assert_close(at(&b, u1 - 1.999 * uy).tangent, STIFFNESS, 1e-14);
    assert_close(at(&b, u1 - 2.001 * uy).tangent, r * STIFFNESS, 1e-12);
}

static void a_storey_without_stiffness_cannot_yield(void **state) {
    (void)state;
    double value[STOREY_ROWS_MAX] = {YIELD, 0.0};
    double constant[STOREY_CONSTANTS_MAX];
    struct error e;
    assert_int_equal(storey_law_find("bilinear")->prepare(value, 0.0, constant, &e), STATUS_INPUT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tangents_agree_with_central_differences),
        cmocka_unit_test(a_law_is_a_pure_function),
        cmocka_unit_test(work_is_what_is_stored_and_what_a_loop_dissipates),
        cmocka_unit_test(an_elastoplastic_loop_has_its_closed_form_area),
        cmocka_unit_test(hardening_moves_the_elastic_range),
        cmocka_unit_test(a_storey_without_stiffness_cannot_yield),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
