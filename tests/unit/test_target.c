// SPDX-License-Identifier: GPL-3.0-or-later
// Target spectra: what is read, what is refused, and the values between the points.
#include "motion/target.h"

#include <math.h>

#include "support/support.h"

static const double G = 9.80665;

static struct target read(const char *text) {
    struct target t = {0};
    struct error e = {0};
    if (target_read(support_arena, support_write("target.txt", text), &t, &e) != STATUS_OK) {
        fail_msg("%s", e.message);
    }
    return t;
}

// `cause` is what stands behind the path.
static void refused(const char *text, const char *cause) {
    struct target t;
    struct error e = {0};
    const char *path = support_write("target.txt", text);
    assert_int_equal(target_read(support_arena, path, &t, &e), STATUS_INPUT);
    char message[512];
    snprintf(message, sizeof message, "%s:%s", path, cause);
    assert_string_equal(e.message, message);
}

static void units_are_those_of_the_caption(void **state) {
    (void)state;
    const char *const texts[] = {
        "# a code\nperiod [s]  PSA [g]\n0.1 0.5\n2 0.25 # the last\n",
        "T (ms);Sa (gal)\n100;490.3325\n2000;245.16625\n",
        "T, Sa (m/s2), 5 % damping\r\n0.1, 4.903325\r\n2, 2.4516625\r\n",
    };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        const struct target t = read(texts[i]);
        assert_int_equal(t.n, 2);
        assert_close(t.period[0], 0.1, 1e-15);
        assert_close(t.period[1], 2.0, 1e-15);
        assert_close(t.psa[0], 0.5 * G, 1e-15);
        assert_close(t.psa[1], 0.25 * G, 1e-15);
    }
}

static void what_is_no_target_is_refused_where_it_stands(void **state) {
    (void)state;
    refused("", " the file is empty");
    refused("period [s]  PSA [g]\n", " the file has no line of numbers");
    refused("period [s]  PSA [g]\n1 0.5\n", " a target has at least two points");
    refused("period [s]  PSA\n1 0.5\n2 0.4\n",
            "2: the unit of PSA is not given; the line above the numbers must give it in brackets, "
            "as in 'PSA [m/s^2]'");
    refused("1 0.5\n2 0.4\n",
            "1: the unit of PSA is not given; the line above the numbers must give it in brackets, "
            "as in 'PSA [m/s^2]'");
    refused("period [s]  PSV [m/s]\n1 0.5\n2 0.4\n",
            "1: unit 'm/s' is that of neither a time nor an acceleration");
    refused("period [s]  PSA [g]\n1 0.5 7\n2 0.4 7\n",
            "2: 3 columns; two are read, period and PSA");
    refused("period [s]  PSA [g]\n1 0.5\n2\n", "3: 1 column; two are read, period and PSA");
    refused("period [s]  PSA [g]\n1 0.5\n2 0.4x\n", "3: PSA 2 '0.4x' is not a number");
    refused("period [s]  PSA [g]\n1 0.5\n2 0\n", "3:3: PSA is 0; it must be > 0");
    refused("period [s]  PSA [g]\n1 0.5\n2  -0.1\n", "3:4: PSA is -0.1; it must be > 0");
    refused("period [s]  PSA [g]\n-1 0.5\n2 0.4\n", "2:1: period is -1; it must be >= 0");
    refused("period [s]  PSA [g]\n1 0.5\n 1 0.4\n",
            "3:2: period 1 s after 1 s; each period must exceed the last");
}

static void a_power_of_the_period_is_kept_between_its_points(void **state) {
    (void)state;
    const struct target t = read("period [s] PSA [m/s2]\n0.1 8\n0.5 8\n2 2\n4 0.5\n");
    assert_close(target_at(&t, 0.1), 8.0, 1e-15);
    assert_close(target_at(&t, 0.3), 8.0, 1e-15);
    assert_close(target_at(&t, 0.8), 4.0 / 0.8, 1e-14);
    assert_close(target_at(&t, 2.0), 2.0, 1e-14);
    assert_close(target_at(&t, 3.0), 8.0 / 9.0, 1e-14);
    assert_close(target_at(&t, 4.0), 0.5, 1e-14);
}

static void a_point_at_0_is_joined_by_a_straight_line(void **state) {
    (void)state;
    const struct target t = read("period [s] PSA [m/s2]\n0 2\n0.1 5\n1 5\n");
    assert_true(target_at(&t, 0.0) == 2.0);
    assert_close(target_at(&t, 0.025), 2.75, 1e-15);
    assert_close(target_at(&t, 0.1), 5.0, 1e-15);
}

static void there_is_none_outside(void **state) {
    (void)state;
    const struct target t = read("period [s] PSA [m/s2]\n0.1 8\n0.5 8\n");
    assert_true(isnan(target_at(&t, 0.0)));
    assert_true(isnan(target_at(&t, 0.0999)));
    assert_true(isnan(target_at(&t, 0.5001)));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(units_are_those_of_the_caption),
        cmocka_unit_test(what_is_no_target_is_refused_where_it_stands),
        cmocka_unit_test(a_power_of_the_period_is_kept_between_its_points),
        cmocka_unit_test(a_point_at_0_is_joined_by_a_straight_line),
        cmocka_unit_test(there_is_none_outside),
    };
    return cmocka_run_group_tests(tests, support_arena_open, support_arena_close);
}
