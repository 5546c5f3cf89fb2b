// SPDX-License-Identifier: GPL-3.0-or-later
// Properties that every contact law must have, over the table of laws.
#include <float.h>
#include <math.h>
#include <string.h>

#include "jostle/contact_law.h"
#include "support/support.h"

enum { N_SAMPLE = 5 };
static const double penetrations[N_SAMPLE] = {1e-9, 1e-6, 1e-4, 3e-3, 0.1};
static const double velocities[N_SAMPLE] = {-2.0, -0.3, -1e-3, 0.02, 1.5};
static const double V0 = 0.5;
static const double MASS = 15384.615384615385;

struct bound_law {
    const struct contact_law *law;
    double constant[CONTACT_CONSTANTS_MAX];
    double history[CONTACT_HISTORY_MAX];
};

// The law with k = 1e8, e = 0.65 and its defaults, closed at velocity v0.
static struct bound_law bind(const struct contact_law *law, double v0) {
    struct bound_law b = {.law = law};
    double value[CONTACT_ROWS_MAX];
    for (int i = 0; i < law->n_row; i++) {
        const struct row *row = &law->row[i];
        value[i] = row->fallback;
        if (strcmp(row->key, "k") == 0) {
            value[i] = 1e8;
        } else if (strcmp(row->key, "e") == 0) {
            value[i] = 0.65;
        }
    }
    struct error e;
    assert_int_equal(law->prepare(value, MASS, b.constant, &e), STATUS_OK);
    if (law->close) {
        law->close(b.constant, v0, b.history);
    }
    return b;
}

static struct contact_response at(const struct bound_law *b, double d, double v) {
    return b->law->force(b->constant, b->history, d, v);
}

// Central differences, one-sided trouble avoided: no sample lies on a branch change of any law.
static void tangents_agree_with_central_differences(void **state) {
    (void)state;
    for (int k = 0; k < n_contact_law; k++) {
        struct bound_law b = bind(contact_laws[k], V0);
        for (int i = 0; i < N_SAMPLE; i++) {
            for (int j = 0; j < N_SAMPLE; j++) {
                double d = penetrations[i];
                double v = velocities[j];
                struct contact_response r = at(&b, d, v);
                double hd = 1e-5 * d;
                double hv = 1e-5 * fabs(v);
                double dfdd = (at(&b, d + hd, v).force - at(&b, d - hd, v).force) / (2.0 * hd);
                double dfdv = (at(&b, d, v + hv).force - at(&b, d, v - hv).force) / (2.0 * hv);
                // Truncation 1e-10, cancellation eps |F| / h.
                double size = fabs(r.force) + fabs(r.dfdd) * d + fabs(r.dfdv * v);
                assert_near(r.dfdd, dfdd, 1e-9 * fabs(dfdd) + 1e-9 * size / d);
                assert_near(r.dfdv, dfdv, 1e-9 * fabs(dfdv) + 1e-9 * size / fabs(v));
            }
        }
    }
}

static void a_law_is_a_pure_function(void **state) {
    (void)state;
    for (int k = 0; k < n_contact_law; k++) {
        struct bound_law b = bind(contact_laws[k], V0);
        struct bound_law before;
        memcpy(&before, &b, sizeof b);
        double first = at(&b, 1e-3, 0.2).force;
        at(&b, 0.5, -3.0);
        at(&b, 0.0, 7.0);
        assert_true(first == at(&b, 1e-3, 0.2).force);
        assert_memory_equal(&before, &b, sizeof b);
    }
}

// Work of the force over d = D sin^2(t / 2), from closure and back, by the midpoint rule.
static double work_of_a_cycle(const struct bound_law *b, double depth) {
    enum { N = 20000 };
    const double whole = 6.283185307179586;
    double work = 0.0;
    double rate = 20.0;
    for (int i = 0; i < N; i++) {
        double t = whole * (i + 0.5) / N;
        double v = depth * sin(t) / 2.0 * rate;
        work += at(b, depth * pow(sin(t / 2.0), 2.0), v).force * v * (whole / N / rate);
    }
    return work;
}

static void no_energy_comes_out_of_a_cycle(void **state) {
    (void)state;
    for (int k = 0; k < n_contact_law; k++) {
        struct bound_law b = bind(contact_laws[k], V0);
        bool elastic = contact_law_row(contact_laws[k], "e") < 0;
        double work = work_of_a_cycle(&b, 0.01);
        double stored = fabs(at(&b, 0.01, 0.0).force) * 0.01;
        if (elastic) {
            assert_near(work, 0.0, 1e-9 * stored);
        } else {
            assert_true(work > 1e-3 * stored);
        }
    }
}

static void the_force_starts_at_zero_unless_the_law_says_that_it_jumps(void **state) {
    (void)state;
    for (int k = 0; k < n_contact_law; k++) {
        struct bound_law b = bind(contact_laws[k], V0);
        double force = at(&b, 0.0, V0).force;
        if (contact_laws[k]->traits & CONTACT_JUMPS) {
            assert_true(force > 0.0);
        } else {
            assert_true(force == 0.0);
        }
    }
}

static void only_laws_that_say_so_pull(void **state) {
    (void)state;
    for (int k = 0; k < n_contact_law; k++) {
        struct bound_law b = bind(contact_laws[k], V0);
        bool pulled = false;
        for (int i = 0; i < N_SAMPLE; i++) {
            for (int j = 0; j < N_SAMPLE; j++) {
                pulled |= at(&b, penetrations[i], velocities[j]).force < 0.0;
            }
        }
        assert_int_equal(pulled, (contact_laws[k]->traits & CONTACT_MAY_PULL) != 0);
    }
}

// What the contact iteration relies on.
static void laws_that_do_not_pull_never_fall_with_penetration_or_velocity(void **state) {
    (void)state;
    for (int k = 0; k < n_contact_law; k++) {
        if (contact_laws[k]->traits & CONTACT_MAY_PULL) {
            continue;
        }
        struct bound_law b = bind(contact_laws[k], V0);
        for (int i = 0; i < N_SAMPLE; i++) {
            for (int j = 0; j < N_SAMPLE; j++) {
                struct contact_response r = at(&b, penetrations[i], velocities[j]);
                assert_true(r.force >= 0.0 && r.dfdd >= 0.0 && r.dfdv >= 0.0);
                if (j > 0) {
                    assert_true(r.force >= at(&b, penetrations[i], velocities[j - 1]).force);
                }
            }
        }
    }
}

static void any_state_a_newton_iterate_may_visit_gives_a_finite_force(void **state) {
    (void)state;
    const double d[] = {0.0, DBL_TRUE_MIN, 1e-300, 1e-17, 1.0, 1e6};
    const double v[] = {-1e6, -1e-300, 0.0, 1e-300, 1e6};
    const double v0[] = {0.0, 1e-300, 1e-9, 1e3};
    for (int k = 0; k < n_contact_law; k++) {
        for (size_t q = 0; q < sizeof v0 / sizeof v0[0]; q++) {
            struct bound_law b = bind(contact_laws[k], v0[q]);
            for (size_t i = 0; i < sizeof d / sizeof d[0]; i++) {
                for (size_t j = 0; j < sizeof v / sizeof v[0]; j++) {
                    assert_true(isfinite(at(&b, d[i], v[j]).force));
                }
            }
        }
    }
}

// A touch at 1e-12 m/s must not make the dashpot grow without bound: at v = vmin the factor is 1 +
// q.
static void the_damping_of_a_touch_at_rest_is_bounded(void **state) {
    (void)state;
    struct bound_law gentle = bind(contact_law_find("hertz-damp"), 1e-12);
    struct bound_law floor = bind(contact_law_find("hertz-damp"), 1e-3);
    assert_true(at(&gentle, 1e-3, 0.1).force == at(&floor, 1e-3, 0.1).force);
    double elastic = 1e8 * pow(1e-3, 1.5);
    double q = 0.75 * (1.0 - 0.65 * 0.65);
    assert_close(at(&gentle, 1e-3, 1e-3).force, elastic * (1.0 + q), 1e-14);
}

static void an_approach_renewed_within_a_contact_is_damped_again(void **state) {
    (void)state;
    struct bound_law b = bind(contact_law_find("jankowski"), V0);
    double spring = at(&b, 2e-3, -0.1).force;
    assert_true(at(&b, 2e-3, 0.1).force > 1.01 * spring);
    assert_true(at(&b, 2e-3, 0.0).force == spring);
}

// Values worked out by hand from the formulas: k = 1e8 (1e8 N/m^1.5), m* and e as in bind().
static void forces_agree_with_the_formulas(void **state) {
    (void)state;
    double d = 2e-3;
    double v = 0.3;
    double l = log(0.65);
    double c = 2.0 * (-l / sqrt(9.869604401089358 + l * l)) * sqrt(1e8 * MASS);
    struct bound_law b = bind(contact_law_find("kelvin-voigt"), V0);
    assert_close(at(&b, d, v).force, 1e8 * d + c * v, 1e-14);
    assert_close(at(&b, d, -1.9).force, 1e8 * d - 1.9 * c, 1e-13);
    b = bind(contact_law_find("komodromos"), V0);
    assert_close(at(&b, d, v).force, 1e8 * d + c * v, 1e-14);
    assert_true(at(&b, d, -1.9).force == 0.0);
    b = bind(contact_law_find("hertz"), V0);
    assert_close(at(&b, d, v).force, 1e8 * 8.94427190999916e-5, 1e-14);
    b = bind(contact_law_find("hertz-damp"), V0);
    assert_close(at(&b, d, v).force, 8944.27190999916 * (1.0 + 0.433125 * v / V0), 1e-14);
    // zeta of 0.65: 4.5 sqrt5 0.5775 / (0.65 (0.65 (9 pi - 16) + 16)) = 0.37283566526 (reference
    // rows)
    b = bind(contact_law_find("jankowski"), V0);
    double damper = 2.0 * 0.3728356652600535 * sqrt(1e8 * sqrt(d) * MASS);
    assert_close(at(&b, d, v).force, 8944.27190999916 + damper * v, 1e-14);
}

static void every_law_is_described(void **state) {
    (void)state;
    for (int k = 0; k < n_contact_law; k++) {
        const struct contact_law *law = contact_laws[k];
        assert_true(contact_law_find(law->name) == law);
        assert_true(strlen(law->summary) > 5 && strlen(law->formula) > 5);
        assert_true(strlen(law->source) > 10 && strlen(law->remarks) > 10);
        assert_true(law->n_row <= CONTACT_ROWS_MAX && law->n_constant <= CONTACT_CONSTANTS_MAX);
        assert_true(law->n_history <= CONTACT_HISTORY_MAX);
        assert_int_equal(law->close == NULL, law->n_history == 0);
    }
    assert_null(contact_law_find("no-such-law"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tangents_agree_with_central_differences),
        cmocka_unit_test(a_law_is_a_pure_function),
        cmocka_unit_test(no_energy_comes_out_of_a_cycle),
        cmocka_unit_test(the_force_starts_at_zero_unless_the_law_says_that_it_jumps),
        cmocka_unit_test(only_laws_that_say_so_pull),
        cmocka_unit_test(laws_that_do_not_pull_never_fall_with_penetration_or_velocity),
        cmocka_unit_test(any_state_a_newton_iterate_may_visit_gives_a_finite_force),
        cmocka_unit_test(the_damping_of_a_touch_at_rest_is_bounded),
        cmocka_unit_test(an_approach_renewed_within_a_contact_is_damped_again),
        cmocka_unit_test(forces_agree_with_the_formulas),
        cmocka_unit_test(every_law_is_described),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
