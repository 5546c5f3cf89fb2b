// SPDX-License-Identifier: GPL-3.0-or-later
// Unit texts and the units of a deck.
#include "jostle/units.h"
#include "support/support.h"

static void unit_texts_have_a_size_and_a_dimension(void **state) {
    (void)state;
    const struct {
        const char *text, *rest;
        double si;
        struct dimension dimension;
    } cases[] = {
        {"mm", "", 1e-3, {0, 1, 0}},
        {"MN/m", "", 1e6, {1, -1, 0}},
        {"m/s2", "", 1, {0, 1, -2}},
        {"cm/s^2", "", 0.01, {0, 1, -2}},
        {"g", "", 9.80665, {0, 1, -2}},
        {"N/m^1.5", "", 1, {1, -1.5, 0}},
        {"us", "", 1e-6, {0, 0, 1}},
        {"kN*s/m", "", 1e3, {1, -1, 1}},
        {"t", "", 1e3, {1, -1, 2}},
        {"%", "", 0.01, {0, 0, 0}},
        {"kip/in", "", 175126.835246, {1, -1, 0}},
        {"psi", "", 6894.757293, {1, -2, 0}},
        {"s^-1", "", 1, {0, 0, -1}},
        {"m/x", "/x", 1, {0, 1, 0}},
        {"m/2", "/2", 1, {0, 1, 0}},
        {"mm*", "*", 1e-3, {0, 1, 0}},
        {"m^x", "^x", 1, {0, 1, 0}},
        {"m^10", "^10", 1, {0, 1, 0}},
        {"rad/s", "/s", 1, {0, 0, 0}},
        {"lbf", "", 4.4482216152605, {1, 0, 0}},
        {"kg)", ")", 1, {1, -1, 2}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const char *end;
        struct dimension dimension;
        double si;
        assert_true(unit_parse(cases[i].text, 9.80665, &end, &dimension, &si));
        assert_string_equal(end, cases[i].rest);
        assert_true(dimension_equal(dimension, cases[i].dimension));
        assert_close(si, cases[i].si, 1e-9);  // digits of the table above
    }
}

static void what_is_no_unit_is_left_unread(void **state) {
    (void)state;
    const char *const texts[] = {"", "x", "mmm", "/s", "2m", "KN", "kNm", "^2"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        const char *end;
        struct dimension dimension;
        double si;
        assert_false(unit_parse(texts[i], 9.81, &end, &dimension, &si));
        assert_ptr_equal(end, texts[i]);
    }
}

static const struct unit_system kilonewton = {
    .force = 1e3,
    .length = 1e-3,
    .time = 1,
    .gravity = 9.81,
    .force_name = "kN",
    .length_name = "mm",
    .time_name = "s",
};

static void sizes_follow_from_force_length_and_time(void **state) {
    (void)state;
    assert_close(unit_size(&kilonewton, dimension_mass), 1e6, 1e-15);
    assert_close(unit_size(&kilonewton, dimension_stiffness), 1e6, 1e-15);
    assert_close(unit_size(&kilonewton, dimension_none), 1, 0);
}

static void conversion_adds_no_rounding_of_its_own(void **state) {
    (void)state;
    assert_true(unit_convert(35, 1e-3, 1) == 0.035);
    assert_true(unit_convert(0.35, 1, 1e-3) == 350);
    assert_true(unit_convert(7, 1, 1) == 7);
}

static void units_are_written_as_they_are_read(void **state) {
    (void)state;
    struct unit_system si;
    unit_system_init(&si);
    const struct {
        const struct unit_system *system;
        struct dimension dimension;
        const char *text;
    } cases[] = {
        {&si, {1, -1, 2}, "kg"},
        {&si, {0, 0, 0}, "1"},
        {&si, {0, 1, -2}, "m/s^2"},
        {&si, {1, -1, 1}, "N*s/m"},
        {&si, {0, 0, -1}, "1/s"},
        {&si, {1, -1.5, 0}, "N/m^1.5"},
        {&kilonewton, {1, -1, 0}, "kN/mm"},
        {&kilonewton, {1, -1, 2}, "kN*s^2/mm"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[64];
        unit_text(cases[i].system, cases[i].dimension, text, sizeof text);
        assert_string_equal(text, cases[i].text);
    }
}

static void dimensions_have_names(void **state) {
    (void)state;
    assert_string_equal(dimension_noun(dimension_mass), "a mass");
    assert_string_equal(dimension_noun(dimension_none), "a pure number");
    assert_null(dimension_noun((struct dimension){1, -1.5, 0}));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unit_texts_have_a_size_and_a_dimension),
        cmocka_unit_test(what_is_no_unit_is_left_unread),
        cmocka_unit_test(sizes_follow_from_force_length_and_time),
        cmocka_unit_test(conversion_adds_no_rounding_of_its_own),
        cmocka_unit_test(units_are_written_as_they_are_read),
        cmocka_unit_test(dimensions_have_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
