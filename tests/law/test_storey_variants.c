// SPDX-License-Identifier: GPL-3.0-or-later
// Every storey law of the list with each of its options, under random protocols. A law is tested by
// being listed: variants and values come from its rows.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "support/storey.h"
#include "support/support.h"

static const double STIFFNESS = 2e7, YIELD = 1.5e5, YIELD_DRIFT = 7.5e-3;
enum { LEGS = 60 };

// Options that mean something only together.
static double companion(const char *key) {
    static const struct {
        const char *key;
        double value;
    } known[] = {{"capping", 0.03},        {"post-capping", -0.1}, {"drift-2", 0.02},
                 {"shear-2", 2.2e5},       {"drift-3", 0.05},      {"shear-3", 2.4e5},
                 {"zeta-s", 0.8},          {"gamma-k", 80.0},      {"damage-drift", 0.1},
                 {"yield-negative", 1.1e5}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (strcmp(known[i].key, key) == 0) {
            return known[i].value;
        }
    }
    return NAN;
}

// A value that the row allows, other than its fallback.
static double other(const struct row *row) {
    const struct range *r = row->range;
    if (row->kind == ROW_FLAG) {
        return 1.0;
    }
    if (row->kind == ROW_CHOICE) {
        return row->fallback == 0.0 ? 1.0 : 0.0;
    }
    if (row->dimension.length == 1 && row->dimension.force == 0) {
        return 0.06;
    }
    if (row->dimension.force == 1) {
        return 0.8 * YIELD;
    }
    if (r && isfinite(r->min) && isfinite(r->max)) {
        return r->min + 0.4 * (r->max - r->min);
    }
    return row->fallback > 0.0 ? 1.5 * row->fallback : 0.05;
}

// Variant `k` of a law: with the required options, and with companions too; each with one more
// option. False: there is no such variant. *fits: the law allows it.
static bool variant(const struct storey_law *law, int k, struct test_storey *out, bool *fits,
                    char *name, size_t size) {
    const int n = law->n_row + 1, option = k / 2 - 1;
    if (k >= 2 * n) {
        return false;
    }
    double value[STOREY_ROWS_MAX];
    for (int i = 0; i < law->n_row; i++) {
        const struct row *row = &law->row[i];
        value[i] = row->flags & ROW_REQUIRED ? test_storey_value(row->key, 0.05) : row->fallback;
        const double together = companion(row->key);
        value[i] = k % 2 && !isnan(together) ? together : value[i];
    }
    if (option >= 0) {
        value[option] = other(&law->row[option]);
    }
    snprintf(name, size, "%s%s%s%s", law->name, k % 2 ? ", companions" : "",
             option >= 0 ? ", " : "", option >= 0 ? law->row[option].key : "");
    memset(out, 0, sizeof *out);
    out->law = law;
    struct error e;
    *fits = law->prepare(value, STIFFNESS, out->constant, &e) == STATUS_OK;
    return true;
}

typedef void test_property(const struct test_storey *virgin, const char *name);

// A property of all variants.
static void for_all(test_property *property) {
    for (int k = 0; k < n_storey_law; k++) {
        struct test_storey s;
        bool fits;
        char name[128];
        int n = 0;
        for (int i = 0; variant(storey_laws[k], i, &s, &fits, name, sizeof name); i++) {
            if (fits) {
                property(&s, name);
                n++;
            }
            assert_true(fits || i > 0);
        }
        assert_true(n > 0);
    }
}

// Random targets: small and large legs.
static double target(unsigned *seed, int i) {
    *seed = *seed * 1664525u + 1013904223u;
    const double u = (double)*seed / 2147483648.0 - 1.0;
    return u * YIELD_DRIFT * (i % 7 == 0 ? 12.0 : i % 3 == 0 ? 5.0 : 1.5);
}

static bool is_straight(const struct test_storey *s) {
    return s->law->n_history == 0 || (s->law->traits & STOREY_STRAIGHT);
}

#define EXPECT(holds, name, ...)                                                                   \
    do {                                                                                           \
        if (!(holds)) {                                                                            \
            fprintf(stderr, "%s: ", name);                                                         \
            fprintf(stderr, __VA_ARGS__);                                                          \
            fputc('\n', stderr);                                                                   \
            bad++;                                                                                 \
        }                                                                                          \
    } while (0)
static int bad;

// The tangent is the slope on one side at least: at a corner both differ.
static void tangent(const struct test_storey *virgin, const char *name) {
    struct test_storey s = *virgin;
    unsigned seed = 3;
    const double h = 1e-6 * YIELD_DRIFT, allowed = (is_straight(&s) ? 1e-7 : 1e-4) * STIFFNESS;
    for (int i = 1; i <= LEGS; i++) {
        const double d = target(&seed, i), end = target(&seed, i);
        const struct storey_response at = test_storey_at(&s, d);
        const double up = (test_storey_at(&s, d + h).shear - at.shear) / h;
        const double down = (at.shear - test_storey_at(&s, d - h).shear) / h;
        EXPECT(fabs(up - at.tangent) < allowed || fabs(down - at.tangent) < allowed, name,
               "tangent %g at leg %d, slopes %g %g", at.tangent, i, down, up);
        test_storey_go(&s, end, 3);
    }
}

static void tangents_agree_with_differences(void **state) {
    (void)state;
    bad = 0;
    for_all(tangent);
    assert_int_equal(bad, 0);
}

// A response changes nothing, and repeats to the last bit; so does a history that is stored
// elsewhere or in place.
static void pure(const struct test_storey *virgin, const char *name) {
    struct test_storey s = *virgin, other_place = s;
    unsigned seed = 5;
    for (int i = 1; i <= LEGS; i++) {
        const double d = target(&seed, i), away = target(&seed, i);
        struct test_storey before = s;
        const struct storey_response first = test_storey_at(&s, d);
        double tried[STOREY_HISTORY_MAX];
        memcpy(tried, s.history, sizeof tried);
        s.law->respond(s.constant, s.history, away, tried);
        assert_memory_equal(before.history, s.history, sizeof s.history);
        s.law->respond(s.constant, s.history, d, tried);
        memcpy(other_place.history, tried, sizeof tried);
        const double shear = test_storey_go(&s, d, 1);
        EXPECT(shear == first.shear, name, "shear %.17g and %.17g", shear, first.shear);
        const double at = target(&seed, i);
        EXPECT(test_storey_at(&s, at).shear == test_storey_at(&other_place, at).shear, name,
               "another shear where the history is stored elsewhere, leg %d", i);
        EXPECT(isfinite(shear) && isfinite(first.tangent), name, "not finite");
    }
}

static void laws_are_pure_functions(void **state) {
    (void)state;
    bad = 0;
    for_all(pure);
    assert_int_equal(bad, 0);
}

static void steps(const struct test_storey *virgin, const char *name) {
    struct test_storey one = *virgin, many = *virgin;
    unsigned seed = 7;
    for (int i = 1; i <= LEGS; i++) {
        const double d = target(&seed, i);
        const double a = test_storey_go(&one, d, 1), b = test_storey_go(&many, d, 1 + i % 61);
        EXPECT(fabs(a - b) < (is_straight(&one) ? 1e-9 : 2e-6) * YIELD, name,
               "leg %d: %.10g in one step, %.10g", i, a / YIELD, b / YIELD);
    }
}

static void the_number_of_steps_does_not_matter(void **state) {
    (void)state;
    bad = 0;
    for_all(steps);
    assert_int_equal(bad, 0);
}

// The work on a storey is at least what it has stored, and a cycle dissipates: what is not stored
// grows.
static void energy(const struct test_storey *virgin, const char *name) {
    struct test_storey s = *virgin;
    unsigned seed = 11;
    double work = 0.0, most = 0.0;
    const double unit = YIELD * YIELD_DRIFT;
    for (int i = 1; i <= LEGS; i++) {
        work += test_storey_work(&s, target(&seed, i), 2000);
        const double dissipated = work - s.law->stored(s.constant, s.history, s.drift);
        EXPECT(dissipated > -1e-3 * unit, name, "leg %d: work less than stored by %g", i,
               -dissipated / unit);
        EXPECT(dissipated > most - 2e-3 * unit, name, "leg %d: gives back %g", i,
               (most - dissipated) / unit);
        most = fmax(most, dissipated);
    }
}

static void cycles_make_no_energy(void **state) {
    (void)state;
    bad = 0;
    for_all(energy);
    assert_int_equal(bad, 0);
}

// Mirrored drifts give mirrored shears, if both directions have the same values.
static void mirrored(const struct test_storey *virgin, const char *name) {
    struct test_storey s = *virgin, mirror = *virgin;
    if (strstr(name, "companions") || strstr(name, "-negative")) {
        return;
    }
    unsigned seed = 13;
    for (int i = 1; i <= LEGS; i++) {
        const double d = target(&seed, i);
        const double a = test_storey_go(&s, d, 3), b = test_storey_go(&mirror, -d, 3);
        EXPECT(a == -b, name, "leg %d: %.17g and %.17g", i, a, b);
    }
}

static void mirrored_drifts_give_mirrored_shears(void **state) {
    (void)state;
    bad = 0;
    for_all(mirrored);
    assert_int_equal(bad, 0);
}

// A law whose yields are exchanged gives mirrored shears. Drifts other than -capping of imk have
// the size of the yield.
static void exchanged_yields_mirror_the_shears(void **state) {
    (void)state;
    static const char *const law[][3] = {
        {"bilinear", "yield 1.5e5 yield-negative 1e5 hardening 0.05",
         "yield 1e5 yield-negative 1.5e5 hardening 0.05"},
        {"clough", "yield 1.5e5 yield-negative 1e5 hardening 0.05",
         "yield 1e5 yield-negative 1.5e5 hardening 0.05"},
        {"takeda", "yield 1.5e5 yield-negative 1e5 hardening 0.05 beta 0.3",
         "yield 1e5 yield-negative 1.5e5 hardening 0.05 beta 0.3"},
        {"trilinear",
         "crack 7.5e4 yield 1.5e5 yield-negative 1e5 cracked 0.3 hardening 0.02 takeda "
         "pinch-drift 0.5 pinch-shear 0.4 damage-peak 0.02 damage-energy 0.03 damage-drift 0.1",
         "crack 5e4 yield 1e5 yield-negative 1.5e5 cracked 0.3 hardening 0.02 takeda "
         "pinch-drift 0.5 pinch-shear 0.4 damage-peak 0.02 damage-energy 0.03 damage-drift 0.1"},
        {"trilinear", "crack 7.5e4 yield 1.5e5 yield-negative 1e5 cracked 0.3 hardening -0.02",
         "crack 5e4 yield 1e5 yield-negative 1.5e5 cracked 0.3 hardening -0.02"},
        {"multilinear", "yield 1.5e5 yield-negative 1e5 drift-2 0.03 shear-2 2.1e5 hardening 0.02",
         "yield 1e5 yield-negative 1.5e5 drift-2 0.02 shear-2 1.4e5 hardening 0.02"},
        {"multilinear",
         "yield 1.5e5 yield-negative 1e5 drift-2 0.03 shear-2 2.1e5 hardening -0.02 cycle peak b "
         "0.3",
         "yield 1e5 yield-negative 1.5e5 drift-2 0.02 shear-2 1.4e5 hardening -0.02 cycle peak b "
         "0.3"},
    };
    for (size_t k = 0; k < sizeof law / sizeof law[0]; k++) {
        struct test_storey s = test_storey_of(law[k][0], STIFFNESS, law[k][1]);
        struct test_storey mirror = test_storey_of(law[k][0], STIFFNESS, law[k][2]);
        struct test_storey even = test_storey_of(law[k][0], STIFFNESS, law[k][1]);
        unsigned seed = 17;
        double apart = 0.0;
        for (int i = 1; i <= LEGS; i++) {
            const double d = target(&seed, i);
            const double shear = test_storey_go(&s, d, 1);
            assert_near(test_storey_go(&mirror, -d, 1), -shear, 1e-9 * YIELD);
            apart = fmax(apart, fabs(test_storey_go(&even, -d, 1) + shear));
        }
        assert_true(apart > 0.2 * YIELD);
    }
}

// Monotonic paths: the backbone of negative drifts is 2/3 of the other.
static void the_negative_backbone_is_the_other_in_another_size(void **state) {
    (void)state;
    static const char *const law[][2] = {
        {"trilinear", "crack 7.5e4 yield 1.5e5 yield-negative 1e5 cracked 0.3 hardening 0.02"},
        {"multilinear", "yield 1.5e5 yield-negative 1e5 drift-2 0.03 shear-2 2.1e5 cycle peak"},
        {"multilinear", "yield 1.5e5 yield-negative 1e5 drift-2 0.03 shear-2 2.1e5 hardening 0.02"},
    };
    for (size_t k = 0; k < sizeof law / sizeof law[0]; k++) {
        for (double d = 0.0; d < 0.1; d += 0.0031) {
            const struct test_storey s = test_storey_of(law[k][0], STIFFNESS, law[k][1]);
            const struct storey_response right = test_storey_at(&s, d);
            const struct storey_response left = test_storey_at(&s, -d / 1.5);
            assert_near(left.shear, -right.shear / 1.5, 1e-9 * YIELD);
            assert_close(left.tangent, right.tangent, 1e-12);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tangents_agree_with_differences),
        cmocka_unit_test(laws_are_pure_functions),
        cmocka_unit_test(the_number_of_steps_does_not_matter),
        cmocka_unit_test(cycles_make_no_energy),
        cmocka_unit_test(mirrored_drifts_give_mirrored_shears),
        cmocka_unit_test(exchanged_yields_mirror_the_shears),
        cmocka_unit_test(the_negative_backbone_is_the_other_in_another_size),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
