// SPDX-License-Identifier: GPL-3.0-or-later
// Properties that every contact law must have, over the table of laws.
#include <float.h>
#include <math.h>
#include <string.h>

#include "support/impact.h"
#include "support/support.h"

enum { N_SAMPLE = 5 };
static const double penetrations[N_SAMPLE] = {1e-9, 1e-6, 1e-4, 3e-3, 0.1};
static const double velocities[N_SAMPLE] = {-2.0, -0.3, -1e-3, 0.02, 1.5};
static const double V0 = 0.5;
static const double MASS = 15384.615384615385;

// The laws without a force stand first in the table.
static int first_with_force;

static int find_first_with_force(void **state) {
    (void)state;
    while (contact_laws[first_with_force]->rebound) {
        first_with_force++;
    }
    return 0;
}

// What the tests give for each parameter of a law without a fallback; NAN: nothing.
static double parameter(const char *law, const char *key) {
    static const struct {
        const char *law, *key;  // law NULL: any other
        double value;
    } given[] = {
        {"wang", "e", NAN},     {"wang", "zeta", 1e8}, {"bilinear", "e", NAN},
        {"rubber", "du", 5e-3}, {"rubber", "ky", 9e9}, {NULL, "k", 1e8},
        {NULL, "e", 0.65},      {NULL, "k1", 4e8},     {NULL, "k2", 1e8},
        {NULL, "dy", 2e-5},     {NULL, "n", 1.3},      {NULL, "residual", 0.25},
    };
    for (size_t i = 0; i < sizeof given / sizeof given[0]; i++) {
        bool fits = !given[i].law || strcmp(given[i].law, law) == 0;
        if (fits && strcmp(given[i].key, key) == 0) {
            return given[i].value;
        }
    }
    return NAN;
}

// Those parameters and the defaults.
static void fill(const struct contact_law *law, double *value) {
    impact_law(law->name, "", value);
    for (int i = 0; i < law->n_row; i++) {
        value[i] = isnan(value[i]) ? parameter(law->name, law->row[i].key) : value[i];
    }
}

// The law with those parameters, closed at velocity v0.
static struct bound_law bind(const struct contact_law *law, double v0) {
    double value[IMPACT_VALUES_MAX];
    fill(law, value);
    return bound_law(law, value, MASS, v0);
}

// Central differences, one-sided trouble avoided: no sample lies on a branch change of any law.
static void tangents_agree_with_central_differences(void **state) {
    (void)state;
    for (int k = first_with_force; k < n_contact_law; k++) {
        struct bound_law b = bind(contact_laws[k], V0);
        for (int i = 0; i < N_SAMPLE; i++) {
            for (int j = 0; j < N_SAMPLE; j++) {
                double d = penetrations[i];
                double v = velocities[j];
                struct contact_response r = bound_at(&b, d, v);
                double hd = 1e-5 * d;
                double hv = 1e-5 * fabs(v);
                double dfdd =
                    (bound_at(&b, d + hd, v).force - bound_at(&b, d - hd, v).force) / (2.0 * hd);
                double dfdv =
                    (bound_at(&b, d, v + hv).force - bound_at(&b, d, v - hv).force) / (2.0 * hv);
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
    for (int k = first_with_force; k < n_contact_law; k++) {
        struct bound_law b = bind(contact_laws[k], V0);
        struct bound_law before;
        memcpy(&before, &b, sizeof b);
        double first = bound_at(&b, 1e-3, 0.2).force;
        bound_at(&b, 0.5, -3.0);
        bound_at(&b, 0.0, 7.0);
        assert_true(first == bound_at(&b, 1e-3, 0.2).force);
        assert_memory_equal(&before, &b, sizeof b);
    }
}

// At every penetration with all velocities, of which those left over stand still.
static void links_side_by_side_have_the_bits_of_one(void **state) {
    (void)state;
    for (int k = first_with_force; k < n_contact_law; k++) {
        struct bound_law b = bind(contact_laws[k], V0);
        double constant[CONTACT_CONSTANTS_MAX * CONTACT_LANES];
        for (int i = 0; i < CONTACT_CONSTANTS_MAX * CONTACT_LANES; i++) {
            constant[i] = b.constant[i / CONTACT_LANES];
        }
        for (int i = 0; b.law->force_lanes && i < N_SAMPLE; i++) {
            double d[CONTACT_LANES], v[CONTACT_LANES];
            for (int j = 0; j < CONTACT_LANES; j++) {
                d[j] = penetrations[i];
                v[j] = j < N_SAMPLE ? velocities[j] : 0.0;
            }
            struct contact_lanes lanes;
            b.law->force_lanes(constant, d, v, &lanes);
            for (int j = 0; j < CONTACT_LANES; j++) {
                const struct contact_response one = bound_at(&b, d[j], v[j]);
                assert_true(lanes.force[j] == one.force);
                assert_true(lanes.dfdd[j] == one.dfdd && lanes.dfdv[j] == one.dfdv);
            }
        }
    }
}

// Work of the force over d = D sin^2(t / 2), from closure and back, by the midpoint rule.
static double work_of_a_cycle(struct bound_law *b, double depth) {
    enum { N = 20000 };
    const double whole = 6.283185307179586;
    double work = 0.0;
    double rate = 20.0;
    for (int i = 0; i < N; i++) {
        double t = whole * (i + 0.5) / N;
        double v = depth * sin(t) / 2.0 * rate;
        double d = depth * pow(sin(t / 2.0), 2.0);
        work += bound_at(b, d, v).force * v * (whole / N / rate);
        bound_commit(b, d, v);
    }
    return work;
}

static void no_energy_comes_out_of_a_cycle(void **state) {
    (void)state;
    for (int k = first_with_force; k < n_contact_law; k++) {
        struct bound_law b = bind(contact_laws[k], V0);
        bool elastic = contact_laws[k]->n_history == 0 && !contact_laws[k]->exact;
        double stored = fabs(bound_at(&b, 0.01, 0.0).force) * 0.01;
        double work = work_of_a_cycle(&b, 0.01);
        if (elastic) {
            assert_near(work, 0.0, 1e-9 * stored);
        } else {
            assert_true(work > 5e-4 * stored);  // khatami as printed: 9e-4
        }
    }
}

// A walk over penetrations that turns at random within one contact: whenever it comes back to a
// penetration, the force has not done work since.
static void no_energy_comes_out_of_any_cycle_within_a_contact(void **state) {
    (void)state;
    enum { LEVELS = 40, STEPS = 20000 };
    const double step = 5e-4;
    uint64_t seed = 20130;
    for (int k = first_with_force; k < n_contact_law; k++) {
        struct bound_law b = bind(contact_laws[k], V0);
        double most[LEVELS + 1];  // work done on the contact at the last visits
        double work = 0.0;
        double scale = fabs(bound_at(&b, LEVELS * step, V0).force) * step;
        for (int i = 0; i <= LEVELS; i++) {
            most[i] = -INFINITY;
        }
        for (int i = 0, level = 0, up = 1; i < STEPS; i++) {
            seed = seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
            up = seed >> 62 ? up : !up;
            up = level == 0 || (level < LEVELS && up);
            double v = (up ? 1.0 : -1.0) * (0.01 + (double)(seed >> 40 & 0xff) / 256.0);
            double next = (level + (up ? 1 : -1)) * step;
            work += bound_at(&b, (level * step + next) / 2.0, v).force * (next - level * step);
            level += up ? 1 : -1;
            bound_commit(&b, next, v);
            assert_true(work >= most[level] - 1e-12 * scale * STEPS);
            most[level] = work;
        }
    }
}

// A history committed twice is the same, and the force at the committed point does not jump with it
// while the contact goes on in the same direction.
static void committing_is_idempotent_and_keeps_the_force(void **state) {
    (void)state;
    const double d[] = {1e-5, 4e-4, 2e-3, 1.9e-3, 1.5e-3, 3e-4, 5e-4, 3e-3, 1e-4};
    for (int k = first_with_force; k < n_contact_law; k++) {
        struct bound_law b = bind(contact_laws[k], V0);
        for (size_t i = 0; i < sizeof d / sizeof d[0]; i++) {
            double v = i == 0 || d[i] > d[i - 1] ? 0.1 : -0.1;
            double before = bound_at(&b, d[i], v).force;
            bound_commit(&b, d[i], v);
            assert_close(bound_at(&b, d[i], v).force, before, 1e-14);
            struct bound_law once = b;
            bound_commit(&b, d[i], v);
            assert_memory_equal(&once, &b, sizeof b);
        }
    }
}

static void the_force_starts_at_zero_unless_the_law_says_that_it_jumps(void **state) {
    (void)state;
    for (int k = first_with_force; k < n_contact_law; k++) {
        struct bound_law b = bind(contact_laws[k], V0);
        double force = bound_at(&b, 0.0, V0).force;
        if (contact_laws[k]->traits & CONTACT_JUMPS) {
            assert_true(force > 0.0);
        } else {
            assert_true(force == 0.0);
        }
    }
}

static void only_laws_that_say_so_pull(void **state) {
    (void)state;
    for (int k = first_with_force; k < n_contact_law; k++) {
        struct bound_law b = bind(contact_laws[k], V0);
        bool pulled = false;
        for (int i = 0; i < N_SAMPLE; i++) {
            for (int j = 0; j < N_SAMPLE; j++) {
                pulled |= bound_at(&b, penetrations[i], velocities[j]).force < 0.0;
            }
        }
        assert_int_equal(pulled, (contact_laws[k]->traits & CONTACT_MAY_PULL) != 0);
    }
}

// What the contact iteration relies on.
static void laws_that_do_not_pull_never_fall_with_penetration_or_velocity(void **state) {
    (void)state;
    for (int k = first_with_force; k < n_contact_law; k++) {
        if (contact_laws[k]->traits & CONTACT_MAY_PULL) {
            continue;
        }
        struct bound_law b = bind(contact_laws[k], V0);
        for (int i = 0; i < N_SAMPLE; i++) {
            for (int j = 0; j < N_SAMPLE; j++) {
                struct contact_response r = bound_at(&b, penetrations[i], velocities[j]);
                assert_true(r.force >= 0.0 && r.dfdd >= 0.0 && r.dfdv >= 0.0);
                if (j > 0) {
                    assert_true(r.force >= bound_at(&b, penetrations[i], velocities[j - 1]).force);
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
    for (int k = first_with_force; k < n_contact_law; k++) {
        for (size_t q = 0; q < sizeof v0 / sizeof v0[0]; q++) {
            struct bound_law b = bind(contact_laws[k], v0[q]);
            for (size_t i = 0; i < sizeof d / sizeof d[0]; i++) {
                for (size_t j = 0; j < sizeof v / sizeof v[0]; j++) {
                    assert_true(isfinite(bound_at(&b, d[i], v[j]).force));
                }
            }
        }
    }
}

// A touch at 1e-12 m/s must not make the dashpot grow without bound.
static void the_damping_of_a_touch_at_rest_is_bounded(void **state) {
    (void)state;
    int n = 0;
    for (int k = first_with_force; k < n_contact_law; k++) {
        if (contact_law_row(contact_laws[k], "vmin") >= 0) {
            struct bound_law gentle = bind(contact_laws[k], 1e-12);
            struct bound_law floor = bind(contact_laws[k], 1e-3);
            assert_true(bound_at(&gentle, 1e-3, 0.1).force == bound_at(&floor, 1e-3, 0.1).force);
            n++;
        }
    }
    assert_int_equal(n, 8);
    // At v = vmin the factor is 1 + q.
    struct bound_law gentle = bind(contact_law_find("hertz-damp"), 1e-12);
    double elastic = 1e8 * pow(1e-3, 1.5);
    double q = 0.75 * (1.0 - 0.65 * 0.65);
    assert_close(bound_at(&gentle, 1e-3, 1e-3).force, elastic * (1.0 + q), 1e-14);
}

static void an_approach_renewed_within_a_contact_is_damped_again(void **state) {
    (void)state;
    static const char *const name[] = {"jankowski", "mahmoud-jankowski", "khatami"};
    for (int k = 0; k < 3; k++) {
        struct bound_law b = bind(contact_law_find(name[k]), V0);
        double spring = bound_at(&b, 2e-3, -0.1).force;
        assert_true(bound_at(&b, 2e-3, 0.1).force > 1.001 * spring);
        assert_true(bound_at(&b, 2e-3, 0.0).force == spring);
    }
}

// -meff is refused where it would not matter. A bilinear law needs it with -kh only.
static void only_laws_that_say_so_depend_on_the_effective_mass(void **state) {
    (void)state;
    for (int k = 0; k < n_contact_law; k++) {
        const struct contact_law *law = contact_laws[k];
        const char *text = contact_law_row(law, "kh") >= 0 ? "kh 1e8 e 0.5 v0 1" : "";
        double value[IMPACT_VALUES_MAX], constant[2][IMPACT_CONSTANTS_MAX];
        impact_law(law->name, text, value);
        if (!*text) {
            fill(law, value);
        }
        struct error e;
        for (int i = 0; i < 2; i++) {
            assert_int_equal(law->prepare(value, MASS * (i + 1), constant[i], &e), STATUS_OK);
        }
        bool differs = false;
        for (int i = 0; i < contact_law_n_constant(law, value); i++) {
            differs |= constant[0][i] != constant[1][i];
        }
        assert_int_equal(differs, (law->traits & CONTACT_NEEDS_MASS) != 0);
    }
}

static void every_law_is_described(void **state) {
    (void)state;
    for (int k = first_with_force; k < n_contact_law; k++) {
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
        cmocka_unit_test(links_side_by_side_have_the_bits_of_one),
        cmocka_unit_test(no_energy_comes_out_of_a_cycle),
        cmocka_unit_test(no_energy_comes_out_of_any_cycle_within_a_contact),
        cmocka_unit_test(committing_is_idempotent_and_keeps_the_force),
        cmocka_unit_test(the_force_starts_at_zero_unless_the_law_says_that_it_jumps),
        cmocka_unit_test(only_laws_that_say_so_pull),
        cmocka_unit_test(laws_that_do_not_pull_never_fall_with_penetration_or_velocity),
        cmocka_unit_test(any_state_a_newton_iterate_may_visit_gives_a_finite_force),
        cmocka_unit_test(the_damping_of_a_touch_at_rest_is_bounded),
        cmocka_unit_test(an_approach_renewed_within_a_contact_is_damped_again),
        cmocka_unit_test(only_laws_that_say_so_depend_on_the_effective_mass),
        cmocka_unit_test(every_law_is_described),
    };
    return cmocka_run_group_tests(tests, find_first_with_force, NULL);
}
