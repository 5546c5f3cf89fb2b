// SPDX-License-Identifier: GPL-3.0-or-later
// Curves of force against penetration: layouts, units and what is refused. The messages of whole
// decks are in tests/deck/bad/contact_table.err.
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "motion/curve_file.h"
#include "motion/record_format.h"
#include "support/support.h"

// A curve read from a text in a deck of kN and m; n = 0 where it is refused, with the message.
struct reading {
    struct arena *arena;
    struct curve curve;
    struct error e;
};

static struct reading read_in(const char *text, double length, double force) {
    struct reading r = {.arena = arena_create()};
    struct unit_system units;
    unit_system_init(&units);
    units.force = 1000.0;
    struct curve_request request = {
        .path = "pad.txt", .length = length, .force = force, .units = &units};
    struct record_text t = {"pad.txt", text, strlen(text)};
    assert_non_null(r.arena);
    if (curve_read_text(r.arena, &request, &t, &r.curve, &r.e) != STATUS_OK) {
        assert_int_equal(r.curve.n, 0);
    }
    return r;
}

// Point 1 of the curve, and the number of points.
static void assert_point(const char *text, double length, double force, const double *want, int n) {
    struct reading r = read_in(text, length, force);
    if (r.curve.n == 0) {
        fail_msg("%s", r.e.message);
    }
    assert_int_equal(r.curve.n, n);
    for (int i = 0; i < CURVE_COLUMNS; i++) {
        assert_true(r.curve.point[i] == 0.0);
        assert_close(r.curve.point[CURVE_COLUMNS + i], want[i], 1e-15);
    }
    arena_free(r.arena);
}

static void assert_refused(const char *text, const char *message) {
    struct reading r = read_in(text, 0.0, 0.0);
    assert_int_equal(r.curve.n, 0);
    assert_string_equal(r.e.message, message);
    arena_free(r.arena);
}

static void columns_may_be_separated_and_headed_as_in_records(void **state) {
    (void)state;
    const double elastic[] = {1.0, 5.0, 5.0};
    assert_point("0 0\n1 5\n", 0.0, 0.0, elastic, 2);
    assert_point("\xef\xbb\xbf# pad\r\nd;f\r\n0;0\r\n\r\n1;5\r\n2;9\r\n", 0.0, 0.0, elastic, 3);
    const double branches[] = {0.5, 5.0, 2.0};
    assert_point("! pad\n0, 0, 0\n.5, 5, 2\n1.5\t9\t9\n% end", 0.0, 0.0, branches, 3);
}

static void units_come_from_the_request_the_caption_or_the_deck(void **state) {
    (void)state;
    const double deck[] = {2.0, 5.0, 1.0};
    const double small[] = {2e-3, 5e-3, 1e-3};
    assert_point("0 0 0\n2 5 1\n9 9 9\n", 0.0, 0.0, deck, 3);
    assert_point("0 0 0\n2 5 1\n9 9 9\n", 1e-3, 1.0, small, 3);
    assert_point("d (mm), up (N), down (N)\n0 0 0\n2 5 1\n9 9 9\n", 0.0, 0.0, small, 3);
    assert_point("d [MM] f [N] (pad 7)\n0 0 0\n2 5 1\n9 9 9\n", 1e-3, 0.0, small, 3);
}

static void a_column_is_counted_in_characters_of_the_line(void **state) {
    (void)state;
    assert_refused("0 0\n  1   2\n\t3   1\n",
                   "pad.txt:3:6: loading force 1 after 2; loading forces must not fall");
    assert_refused("0 0\r1 2\r1 3",
                   "pad.txt:3:1: penetration 1 after 1; penetrations must increase");
}

static void what_is_no_curve_is_refused(void **state) {
    (void)state;
    assert_refused("", "pad.txt: the file is empty");
    assert_refused("a pad\n", "pad.txt: the file has no line of numbers");
    assert_refused("0 0\n1,5 2,5\n", "pad.txt:2: '1,5 2,5' has commas beside other separators; "
                                     "numbers need a decimal point");
    assert_refused("0 0 0 0\n1 1 1 1\n", "pad.txt:1: row of 4 values; a curve has 2 or 3 columns: "
                                         "penetration, loading force and unloading force");
    assert_refused("0 0\n1 nan\n", "pad.txt:2: loading force 2 'nan' is not a number");
    assert_refused("(m) (MN)\n0 0\n1 1e308\n",
                   "pad.txt: point 2 of 2 is out of range, or too close to the one before it, in "
                   "the deck's units");
    assert_refused("0 0\n1 1\n2 2\n2.0000000000000004 1e300\n",
                   "pad.txt: point 4 of 4 is out of range, or too close to the one before it, in "
                   "the deck's units");
    assert_refused("0 0 0\n1 5 -1\n2 6 6\n",
                   "pad.txt:2:5: unloading force is -1; it must be >= 0 and <= the loading force, "
                   "which is 5");
}

// Without force there is no share to compare with; rounding of the decimals is no fall.
static void a_toe_without_force_and_an_even_share_are_allowed(void **state) {
    (void)state;
    const double toe[] = {1.0, 0.0, 0.0};
    assert_point("0 0 0\n1 0 0\n2 3 1\n3 9 9\n", 0.0, 0.0, toe, 4);
    const double even[] = {1.0, 0.1, 0.07};
    assert_point("0 0 0\n1 .1 .07\n2 .3 .21\n3 .7 .49\n4 1 1\n", 0.0, 0.0, even, 5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(columns_may_be_separated_and_headed_as_in_records),
        cmocka_unit_test(units_come_from_the_request_the_caption_or_the_deck),
        cmocka_unit_test(a_column_is_counted_in_characters_of_the_line),
        cmocka_unit_test(what_is_no_curve_is_refused),
        cmocka_unit_test(a_toe_without_force_and_an_even_share_are_allowed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
