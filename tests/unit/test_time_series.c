// SPDX-License-Identifier: GPL-3.0-or-later
// Files of time and value.
#include <string.h>

#include "motion/time_series.h"
#include "support/support.h"

// A force whose unit is N, or must be given; its times are not negative.
static int read_force(const char *text, double unit, struct time_series *s, struct error *e) {
    const struct time_series_column column[TIME_SERIES_COLUMNS] = {
        {"time", dimension_time, 1.0, &range_non_negative},
        {"value", dimension_force, unit, NULL},
    };
    return time_series_read(support_arena, support_write("force.txt", text), column, s, e);
}

static struct time_series read(const char *text) {
    struct time_series s = {0};
    struct error e = {0};
    if (read_force(text, 1.0, &s, &e) != STATUS_OK) {
        fail_msg("%s", e.message);
    }
    return s;
}

static void refused_with_unit(const char *text, double unit, const char *message) {
    struct time_series s;
    struct error e = {0};
    assert_int_equal(read_force(text, unit, &s, &e), STATUS_INPUT);
    if (!strstr(e.message, message)) {
        fail_msg("'%s' is not in '%s'", message, e.message);
    }
}

static void refused(const char *text, const char *message) {
    refused_with_unit(text, 1.0, message);
}

static void numbers_are_in_si_without_a_caption(void **state) {
    (void)state;
    static const char *const texts[] = {"0 1\n0.5 2\n2 -3e1\n", "0,1\n0.5,2\n2,-30\n",
                                        "# drop 7\n\n0;1\r\n0.5;2\r\n2;-30\r\n",
                                        "time\tforce\n0\t1\n0.5\t2\n2\t-30"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        struct time_series s = read(texts[i]);
        assert_int_equal(s.n, 3);
        assert_true(s.time[0] == 0.0 && s.time[1] == 0.5 && s.time[2] == 2.0);
        assert_true(s.value[0] == 1.0 && s.value[1] == 2.0 && s.value[2] == -30.0);
    }
}

static void units_of_a_caption_count(void **state) {
    (void)state;
    struct time_series s = read("force [kN] over time [ms], sensor [3]\n1 2\n2 4\n");
    assert_close(s.time[1], 2e-3, 1e-15);
    assert_close(s.value[1], 4e3, 1e-15);
    s = read("t (s);F (N)\n1;2\n2;4\n");
    assert_true(s.time[1] == 2.0 && s.value[1] == 4.0);
}

static void what_is_wrong_is_named_with_its_line(void **state) {
    (void)state;
    refused("", "force.txt: the file is empty");
    refused("no numbers\n", "the file has no line of numbers");
    refused("0 1 2\n", "force.txt:1: 3 columns; two are read, time and value");
    refused("0 1\n1 2\n2\n", "force.txt:3: 1 column; two are read");
    refused("0 1\n1 2\n1 3\n", "force.txt:3:1: time 1 s after 1 s; each time must exceed the last");
    refused("0 1\n1 2x\n", "force.txt:2: value 2 '2x' is not a number");
    refused("0 1\n1 nan\n", "force.txt:2: value 2 'nan' is not a number");
    refused("time [s] force [mm]\n0 1\n1 2\n",
            "force.txt:1: unit 'mm' is that of neither a time nor a force");
}

static void numbers_are_within_their_range(void **state) {
    (void)state;
    refused("time [ms]\n  -2 1\n1 2\n", "force.txt:2:3: time is -2; it must be >= 0");
    refused("F [kN]\n0 1\n1\t1e306\n", "force.txt:3:3: value is 1e+306; it must be below 1.8e308");
}

static void a_unit_may_have_to_be_given(void **state) {
    (void)state;
    refused_with_unit("drop 7\n0 1\n1 2\n", 0.0,
                      "force.txt:2: the unit of value is not given; the line above the numbers "
                      "must give it in brackets, as in 'value [N]'");
    struct time_series s;
    struct error e;
    assert_int_equal(read_force("t, F [kN]\n0 1\n1 2\n", 0.0, &s, &e), STATUS_OK);
    assert_close(s.value[1], 2e3, 1e-15);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_are_in_si_without_a_caption),
        cmocka_unit_test(units_of_a_caption_count),
        cmocka_unit_test(what_is_wrong_is_named_with_its_line),
        cmocka_unit_test(numbers_are_within_their_range),
        cmocka_unit_test(a_unit_may_have_to_be_given),
    };
    return cmocka_run_group_tests(tests, support_arena_open, support_arena_close);
}
