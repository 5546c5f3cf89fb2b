// SPDX-License-Identifier: GPL-3.0-or-later
// Streets: every allocation of the reader is made to fail in its turn, and the building types have
// the capacity curves that HAZUS prints.
#include <gsl/gsl_math.h>
#include <math.h>

#include "core/arena.h"
#include "export/street.h"
#include "support/fail_alloc.h"
#include "support/support.h"

static int read_street(void *path, struct error *e) {
    struct arena *a = arena_create();
    struct street s;
    struct diagnostics d;
    if (!a) {
        return error_no_memory(e);
    }
    diagnostics_init(&d, a);
    const int status = street_read(a, path, ZONE_4, &s, &d, e);
    arena_free(a);
    return status;
}

static void every_allocation_that_fails_ends_in_an_error(void **state) {
    (void)state;
    fail_alloc_each(read_street,
                    (void *)support_write("street.csv", "name,storeys,type,gap [mm],where\n"
                                                        "A,2,C1,20,x\nB,3,W2,none,y\n"
                                                        "C,3,W2,5,z\n"),
                    8);
}

// From the manual, in inches and g, rounded to 0.01 in and a few percent where they are small.
static void capacity_curves_are_those_of_hazus(void **state) {
    (void)state;
    static const struct {
        const char *name;
        int storeys;
        enum street_code code;
        double dy, ay, du, au;
    } printed[] = {
        {"W1", 1, STREET_HIGH, 0.48, 0.400, 11.51, 1.200},
        {"S1", 5, STREET_HIGH, 1.78, 0.156, 28.40, 0.468},
        {"S1", 2, STREET_MODERATE, 0.31, 0.125, 5.50, 0.375},
        {"S1", 4, STREET_LOW, 0.44, 0.039, 4.44, 0.117},
        {"W2", 3, STREET_PRE, 0.16, 0.100, 2.35, 0.250},
    };
    for (size_t k = 0; k < sizeof printed / sizeof printed[0]; k++) {
        const struct street_type *t = street_type_find(printed[k].name, printed[k].storeys);
        const enum street_code code = printed[k].code;
        assert_non_null(t);
        const double dy =
            t->strength[code] * 9.80665 * gsl_pow_2(t->period / (2.0 * M_PI)) / 0.0254;
        assert_close(t->strength[code], printed[k].ay, 1e-12);
        assert_close(t->overstrength * t->strength[code], printed[k].au, 1e-3);
        assert_near(dy, printed[k].dy, 0.006);
        assert_close(t->overstrength * t->ductility[code] * dy, printed[k].du, 0.025);
        assert_close(street_type_hardening(t, code),
                     (printed[k].au - printed[k].ay) / (printed[k].du - printed[k].dy) /
                         (printed[k].ay / printed[k].dy),
                     0.03);
    }
    assert_null(street_type_find("W", 1));
    assert_null(street_type_find("", 1));
    assert_null(street_type_find("RM", 2));
    assert_string_equal(street_type_find("URM", 7)->name, "URMM");
    assert_string_equal(street_type_find("C2L", 9)->name, "C2L");
}

static void years_give_design_levels(void **state) {
    (void)state;
    assert_int_equal(street_code_of(ZONE_4, 1940, false), STREET_PRE);
    assert_int_equal(street_code_of(ZONE_4, 1941, false), STREET_MODERATE);
    assert_int_equal(street_code_of(ZONE_4, 1975, false), STREET_MODERATE);
    assert_int_equal(street_code_of(ZONE_4, 1976, false), STREET_HIGH);
    assert_int_equal(street_code_of(ZONE_4, 1900, true), STREET_MODERATE);
    assert_int_equal(street_code_of(ZONE_2B, 1990, false), STREET_MODERATE);
    assert_int_equal(street_code_of(ZONE_2A, 1990, false), STREET_LOW);
    assert_int_equal(street_code_of(ZONE_1, 1960, true), STREET_LOW);
    assert_int_equal(street_code_of(ZONE_0, 1990, false), STREET_PRE);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_allocation_that_fails_ends_in_an_error),
        cmocka_unit_test(capacity_curves_are_those_of_hazus),
        cmocka_unit_test(years_give_design_levels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
