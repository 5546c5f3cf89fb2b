// SPDX-License-Identifier: GPL-3.0-or-later
// Properties that every storey law must have, and closed forms of the bilinear one.
#include <gsl/gsl_integration.h>
#include <math.h>
#include <string.h>

#include "jostle/storey_law.h"
#include "law/yield.h"
#include "support/storey.h"
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
        const double fallback = law->row[i].fallback;
        value[i] = isnan(fallback) ? test_storey_value(law->row[i].key, hardening) : fallback;
    }
    struct error e;
    assert_int_equal(law->prepare(value, STIFFNESS, b.constant, &e), STATUS_OK);
    return b;
}

static struct storey_response at(const struct bound_law *b, double drift) {
    return b->law->respond(b->constant, b->history, drift, NULL);
}

static void commit(struct bound_law *b, double drift) {
    b->law->respond(b->constant, b->history, drift, b->history);
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
            double h = 1e-4 * fabs(drift[i]);
            double slope = (at(&b, drift[i] + h).shear - at(&b, drift[i] - h).shear) / (2.0 * h);
            // Piecewise linear laws have no truncation.
            const bool curved = b.law->n_history > 0 && !(b.law->traits & STOREY_STRAIGHT);
            assert_near(at(&b, drift[i]).tangent, slope, (curved ? 1e-6 : 1e-8) * STIFFNESS);
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

// Follows a path out and back; wherever the branch of a law holds, it is the law bit for bit.
static void a_branch_is_the_law_to_the_last_bit(void **state) {
    (void)state;
    for (int k = 0; k < n_storey_law; k++) {
        struct bound_law b = bind(storey_laws[k], 0.05);
        int followed = 0;
        for (int i = 0; b.law->branch && i <= 400; i++) {
            double drift = 0.03 * sin(0.1 * i) * (1.0 + 1e-3 * i);
            struct storey_branch line = b.law->branch(b.constant, b.history);
            double spring = line.spring * (drift - line.rest);
            struct bound_law before = b;
            commit(&b, drift);
            if (fabs(spring) <= line.limit) {
                followed++;
                assert_true(at(&b, drift).shear == line.back * drift + spring);
                assert_true(at(&b, drift).tangent == line.back + line.spring);
                assert_memory_equal(b.history, before.history, sizeof b.history);
            }
        }
        assert_true(!b.law->branch || followed > 100);
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

// However finely a path that does not turn is stepped, its end is the same.
static void the_end_of_a_path_does_not_depend_on_its_steps(void **state) {
    (void)state;
    const double turn[] = {0.0, 0.021, -0.013, 0.004, -0.03, 0.025};
    for (int k = 0; k < n_storey_law; k++) {
        struct bound_law coarse = bind(storey_laws[k], 0.05);
        struct bound_law fine = bind(storey_laws[k], 0.05);
        for (int i = 0; i < 5; i++) {
            work_along(&coarse, turn[i], turn[i + 1], 1);
            work_along(&fine, turn[i], turn[i + 1], 777);
            assert_near(at(&coarse, turn[i + 1]).shear, at(&fine, turn[i + 1]).shear, 1e-6 * YIELD);
        }
    }
}

// dz/ds = 1 - (gamma + beta) z^n from rest: 1 - exp(-s) for n = 1, tanh(s) for n = 2, where the sum
// of beta and gamma is 1.
static void bouc_wen_has_its_closed_forms(void **state) {
    (void)state;
    const struct storey_law *law = storey_law_find("bouc-wen");
    const double uy = YIELD / STIFFNESS;
    for (int n = 1; n <= 2; n++) {
        double value[STOREY_ROWS_MAX] = {YIELD, 0.1, n, 0.7, 0.3};
        struct bound_law b = {.law = law};
        struct error e;
        assert_int_equal(law->prepare(value, STIFFNESS, b.constant, &e), STATUS_OK);
        for (int i = 1; i < 40; i++) {
            double s = 0.13 * i;
            double z = n == 1 ? 1.0 - exp(-s) : tanh(s);
            assert_close(at(&b, s * uy).shear, 0.1 * YIELD * s + 0.9 * YIELD * z, 1e-14);
            assert_close(at(&b, -s * uy).shear, -(0.1 * YIELD * s + 0.9 * YIELD * z), 1e-14);
        }
        // Unloading from z1: dz/ds = -(1 + 0.4 z^n), for n = 1 an exponential.
        commit(&b, 3.0 * uy);
        double z1 = 1.0 - exp(-3.0);
        double z = (z1 + 2.5) * exp(-0.4 * 0.5) - 2.5;
        if (n == 1) {
            assert_close(at(&b, 2.5 * uy).shear, 0.25 * YIELD + 0.9 * YIELD * z, 1e-14);
        }
        // On to the other side: at z = 0 the curve has a kink of its slope (n = 1) or of that of
        // its slope, wherever it falls into the steps of the integration.
        double back = n == 1 ? log(1.0 + 0.4 * z1) / 0.4 : atan(sqrt(0.4) * tanh(3.0)) / sqrt(0.4);
        for (int i = 1; i < 20; i++) {
            double s = 0.037 * i;
            double drift = 3.0 - back - s;
            z = n == 1 ? exp(-s) - 1.0 : -tanh(s);
            assert_near(at(&b, drift * uy).shear, 0.1 * YIELD * drift + 0.9 * YIELD * z,
                        1e-14 * YIELD);
        }
    }
}

// Short steps take a series for tanh and tan, which must not be seen where it ends.
static void short_steps_of_bouc_wen_follow_tanh_and_tan(void **state) {
    (void)state;
    const double uy = YIELD / STIFFNESS, root = sqrt(0.4), turn = tanh(2.0);
    double value[STOREY_ROWS_MAX] = {YIELD, 0.0, 2.0, 0.7, 0.3};
    struct bound_law b = {.law = storey_law_find("bouc-wen")};
    struct error e;
    assert_int_equal(b.law->prepare(value, STIFFNESS, b.constant, &e), STATUS_OK);
    struct bound_law turned = b;
    commit(&turned, 2.0 * uy);
    for (int i = 1; i <= 200; i++) {
        const double s = 0.0005 * i, shear = YIELD * tanh(s);
        const double unloaded = YIELD * tan(atan(root * turn) - root * s) / root;
        assert_true(fabs(at(&b, s * uy).shear - shear) <= 2e-15 * shear);
        assert_near(at(&turned, (2.0 - s) * uy).shear, unloaded, 2e-15 * YIELD);
    }
}

// Nothing needs to be remembered before a storey yields, or while it unloads and loads again.
static void peak_oriented_storeys_remember_only_where_they_turned(void **state) {
    (void)state;
    const double yield = YIELD / STIFFNESS;
    const double unloading[] = {2.9, 2.2, 2.6, 2.1, 3.0}, zero[STOREY_HISTORY_MAX] = {0};
    const char *const name[] = {"clough", "takeda"};
    for (int i = 0; i < 2; i++) {
        struct bound_law b = bind(storey_law_find(name[i]), 0.05);
        commit(&b, 0.7 * yield);
        commit(&b, -0.9 * yield);
        assert_memory_equal(b.history, zero, sizeof zero);
        assert_true(at(&b, 0.5 * yield).shear == STIFFNESS * (0.5 * yield));
        commit(&b, 3.0 * yield);
        struct bound_law turned = b;
        for (int j = 0; j < 5; j++) {
            commit(&b, unloading[j] * yield);
            assert_memory_equal(b.history, turned.history, sizeof zero);
        }
        commit(&b, -1.5 * yield);
        assert_memory_not_equal(b.history, turned.history, sizeof zero);
    }
}

// 1 / (1 - z^n).
static double per_slope(double z, void *exponent) {
    return 1.0 / (1.0 - pow(z, *(const double *)exponent));
}

// Without a closed form: the drift that leads from rest to z is the integral of dz / (1 - z^n),
// which has nothing to do with the Runge-Kutta method of the law.
static void bouc_wen_of_any_exponent_agrees_with_an_integral(void **state) {
    (void)state;
    const struct storey_law *law = storey_law_find("bouc-wen");
    gsl_integration_workspace *space = gsl_integration_workspace_alloc(1000);
    assert_non_null(space);
    double exponent[] = {1.5, 3.0, 7.0};
    // Of the Runge-Kutta method with steps of 0.02 d_y. For n < 2 the slope is rough at z = 0, for
    // large n it bends sharply near z = 1.
    const double allowed[] = {3e-7, 1e-8, 1e-7};
    for (int k = 0; k < 3; k++) {
        double value[STOREY_ROWS_MAX] = {YIELD, 0.1, exponent[k], 0.7, 0.3};
        struct bound_law b = {.law = law};
        struct error e;
        assert_int_equal(law->prepare(value, STIFFNESS, b.constant, &e), STATUS_OK);
        for (int i = 1; i < 20; i++) {
            const double z = 0.05 * i;
            double s, error;
            gsl_function f = {per_slope, &exponent[k]};
            gsl_integration_qag(&f, 0.0, z, 0.0, 1e-12, 1000, GSL_INTEG_GAUSS61, space, &s, &error);
            assert_near(at(&b, s * YIELD / STIFFNESS).shear, 0.1 * YIELD * s + 0.9 * YIELD * z,
                        allowed[k] * YIELD);
        }
    }
    gsl_integration_workspace_free(space);
}

static void bouc_wen_that_would_create_energy_is_refused(void **state) {
    (void)state;
    double value[STOREY_ROWS_MAX] = {YIELD, 0.1, 1.0, 0.3, -0.31};
    double constant[STOREY_CONSTANTS_MAX];
    struct error e;
    assert_int_equal(storey_law_find("bouc-wen")->prepare(value, STIFFNESS, constant, &e),
                     STATUS_INPUT);
}

// By hand, R = 0, in units of V_y and d_y: to 4, down to -1 by way of (3, 0), where the line aims
// at the yield point (-1, -1); up from there with k to (0, 0), and towards (4, 1).
static void clough_aims_at_the_largest_drift(void **state) {
    (void)state;
    const double uy = YIELD / STIFFNESS;
    struct bound_law b = bind(storey_law_find("clough"), 0.0);
    commit(&b, 4.0 * uy);
    assert_close(at(&b, 3.5 * uy).shear, 0.5 * YIELD, 1e-12);
    assert_close(at(&b, 1.0 * uy).shear, -0.5 * YIELD, 1e-12);
    commit(&b, 1.0 * uy);
    // Partly unloaded and loaded again: back to where it was, and on.
    commit(&b, 1.2 * uy);
    assert_close(at(&b, 1.2 * uy).shear, -0.3 * YIELD, 1e-12);
    assert_close(at(&b, 0.0).shear, -0.75 * YIELD, 1e-12);
    commit(&b, -1.0 * uy);
    assert_close(at(&b, -1.0 * uy).shear, -YIELD, 1e-12);
    assert_close(at(&b, -2.0 * uy).shear, -YIELD, 1e-12);
    assert_near(at(&b, 0.0).shear, 0.0, 1e-12 * YIELD);
    assert_close(at(&b, 2.0 * uy).shear, 0.5 * YIELD, 1e-12);
    assert_close(at(&b, 2.0 * uy).tangent, STIFFNESS / 4.0, 1e-12);
    assert_close(at(&b, 5.0 * uy).shear, YIELD, 1e-12);
}

// A step may end where the shear is 0, to the last bit: from there the line aims at the yield point
// (-1, -1) of the other side; it aimed from where it had left the backbone, (4, 1), with V = 0
// at 3.
static void clough_reloads_from_a_step_that_ends_at_zero_shear(void **state) {
    (void)state;
    const double uy = YIELD / STIFFNESS;
    struct bound_law b = bind(storey_law_find("clough"), 0.0);
    commit(&b, 4.0 * uy);
    commit(&b, 3.0 * uy);
    assert_true(at(&b, 3.0 * uy).shear == 0.0);
    assert_close(at(&b, 1.0 * uy).shear, -0.5 * YIELD, 1e-12);
}

// To 4 d_y, R = 0.1, alpha 0.5, beta 0.3: V = 1.3 V_y, unloading with k / 2, zero shear at 1.4 d_y;
// after the yield point of the other side, (-1, -1), it unloads with k and aims at 4 - 0.9 = 3.1,
// where the backbone has 1.21.
static void takeda_softens_with_the_drift_reached(void **state) {
    (void)state;
    const double uy = YIELD / STIFFNESS;
    const struct storey_law *law = storey_law_find("takeda");
    struct bound_law b = {.law = law};
    double value[] = {YIELD, 0.1, 0.5, 0.3, NAN};
    struct error e;
    assert_int_equal(law->prepare(value, STIFFNESS, b.constant, &e), STATUS_OK);
    commit(&b, 4.0 * uy);
    assert_close(at(&b, 4.0 * uy).shear, 1.3 * YIELD, 1e-12);
    assert_close(at(&b, 3.0 * uy).shear, 0.8 * YIELD, 1e-12);
    assert_close(at(&b, 3.0 * uy).tangent, STIFFNESS / 2.0, 1e-12);
    assert_close(at(&b, 0.2 * uy).shear, -0.5 * YIELD, 1e-12);
    commit(&b, -1.0 * uy);
    assert_close(at(&b, -0.5 * uy).shear, -0.5 * YIELD, 1e-12);
    assert_close(at(&b, 1.0 * uy).shear, 1.21 / 3.1 * YIELD, 1e-12);
    assert_close(at(&b, 3.55 * uy).shear, 1.255 * YIELD, 1e-12);
}

// From 40 d_y, R = 0.1, alpha = 0.9, k (d_y / D)^alpha leads to zero shear at -95 d_y, where the
// other side has not even yielded: then what follows hung on the steps, and so did the line up, on
// which it had come below the backbone, V = 4.9 V_y. Towards the origin it is 4.9 / 40 k.
static void takeda_unloads_to_the_origin_at_most(void **state) {
    (void)state;
    const double uy = YIELD / STIFFNESS;
    const struct storey_law *law = storey_law_find("takeda");
    struct bound_law b = {.law = law};
    double value[] = {YIELD, 0.1, 0.9, 0.0, NAN};
    struct error e;
    assert_int_equal(law->prepare(value, STIFFNESS, b.constant, &e), STATUS_OK);
    for (int i = 1; i <= 40; i++) {
        commit(&b, i * uy);
    }
    assert_close(at(&b, 40.0 * uy).shear, 4.9 * YIELD, 1e-12);
    assert_close(at(&b, 30.0 * uy).shear, 0.75 * 4.9 * YIELD, 1e-12);
    assert_near(at(&b, 0.0).shear, 0.0, 1e-12 * YIELD);
    assert_close(at(&b, -0.5 * uy).shear, -0.5 * YIELD, 1e-12);
}

static void a_storey_without_stiffness_cannot_yield(void **state) {
    (void)state;
    for (int k = 0; k < n_storey_law; k++) {
        double value[STOREY_ROWS_MAX] = {YIELD, 0.0};
        double constant[STOREY_CONSTANTS_MAX];
        struct error e;
        assert_int_equal(storey_law_prepare(storey_laws[k], value, 0.0, constant, &e),
                         storey_laws[k]->n_history > 0 ? STATUS_INPUT : STATUS_OK);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tangents_agree_with_central_differences),
        cmocka_unit_test(a_law_is_a_pure_function),
        cmocka_unit_test(work_is_what_is_stored_and_what_a_loop_dissipates),
        cmocka_unit_test(a_branch_is_the_law_to_the_last_bit),
        cmocka_unit_test(an_elastoplastic_loop_has_its_closed_form_area),
        cmocka_unit_test(hardening_moves_the_elastic_range),
        cmocka_unit_test(the_end_of_a_path_does_not_depend_on_its_steps),
        cmocka_unit_test(bouc_wen_has_its_closed_forms),
        cmocka_unit_test(short_steps_of_bouc_wen_follow_tanh_and_tan),
        cmocka_unit_test(peak_oriented_storeys_remember_only_where_they_turned),
        cmocka_unit_test(bouc_wen_of_any_exponent_agrees_with_an_integral),
        cmocka_unit_test(bouc_wen_that_would_create_energy_is_refused),
        cmocka_unit_test(clough_aims_at_the_largest_drift),
        cmocka_unit_test(clough_reloads_from_a_step_that_ends_at_zero_shear),
        cmocka_unit_test(takeda_softens_with_the_drift_reached),
        cmocka_unit_test(takeda_unloads_to_the_origin_at_most),
        cmocka_unit_test(a_storey_without_stiffness_cannot_yield),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
