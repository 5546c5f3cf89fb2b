// SPDX-License-Identifier: GPL-3.0-or-later
// Records in the formats columns and series.
#include <stdio.h>

#include "support/reading.h"
#include "support/support.h"

static void two_columns_are_read_with_any_separator(void **state) {
    static const char *const text[] = {
        "0 .1\n.01 .2\n.02 -.3\n",
        "0\t.1\r\n.01\t.2\r\n.02\t-.3\r\n",
        "0,.1\n.01,.2\n.02,-.3\n",
        "0, .1\n.01, .2\n.02, -.3",
        "0;.1;\n.01;.2;\n.02;-.3;\n\n",
        ("# comment\n% another\n! a third\n// a fourth\n\n# fifth\n0 .1\n.01 .2\n.02 -.3\n"
         "*** End Data ***\n"),
        "Recorded 2019 by the CI network\ntime acc\n0 .1\n.01 .2\n.02 -.3\n",
        "\xef\xbb\xbf\"time\",\"acc\"\n0,.1\n.01,.2\n.02,-.3\n",
        "0 .1\r.01 .2\r.02 -.3\r",
        "0 .1 # from here\n.01 .2# no blank\n.02 -.3 #\n",
    };
    struct reading *r = *state;
    r->request.unit = "g";
    for (size_t i = 0; i < sizeof text / sizeof text[0]; i++) {
        reading_of_text(r, text[i]);
        assert_read(r, "columns", 3, 0.01);
        assert_close(r->record.value[0], 0.1, 1e-15);
        assert_close(r->record.value[2], -0.3, 1e-15);
        assert_silent(r);
    }
}

static void the_caption_gives_the_unit(void **state) {
    static const struct {
        const char *caption;
        double unit;
    } c[] = {
        {"time (s),acceleration (g)", 9.80665},
        {"Time[s] Accel[g]", 9.80665},
        {"time,acc (cm/s2)", 0.01},
        {"# t (s), a (m/s^2)", 1},
        {"Time (s)\tAcceleration (cm/s/s)", 0.01},
        {"station (east), a (mm/s2)", 1e-3},
    };
    struct reading *r = *state;
    for (size_t i = 0; i < sizeof c / sizeof c[0]; i++) {
        char text[128];
        snprintf(text, sizeof text, "%s\n0 .1\n.01 .2\n", c[i].caption);
        reading_of_text(r, text);
        assert_read(r, "columns", 2, 0.01);
        assert_close(r->record.unit, c[i].unit, 1e-15);
    }
    reading_of_text(r, "time (s),velocity (cm/s)\n0 .1\n.01 .2\n");
    assert_refused(r,
                   "a.txt:1: 'cm/s' is not a unit of acceleration; give -unit U (g, m/s2, cm/s2, "
                   "gal, ...)");
    reading_of_text(r, "time (ms),acc (g)\n0 .1\n10 .2\n");
    assert_refused(r, "a.txt:1: times are in 'ms'; they must be in s");
}

static void one_column_needs_the_time_step_and_the_unit(void **state) {
    struct reading *r = *state;
    reading_of_text(r, ".1\n.2\n.3\n");
    assert_refused(r, "a.txt: the file gives no time step; give -dt DT");
    r->request.dt = 0.02;
    reading_of_text(r, ".1\n.2\n.3\n");
    assert_refused(r, "a.txt: the file gives no unit; give -unit U (g, m/s2, cm/s2, gal, ...)");
    r->request.unit = "m/s2";
    reading_of_text(r, ".1\n.2\n.3\n");
    assert_read(r, "columns", 3, 0.02);
    assert_close(r->record.unit, 1, 1e-15);
    assert_silent(r);
    r->request.dt = 20;
    reading_of_text(r, ".1\n-.2\n.1\n");
    assert_warned(r, "a.txt: -dt is 20 s; accelerograms have 1 s at most");
}

static void a_comment_takes_no_value_away(void **state) {
    struct reading *r = *state;
    r->request.unit = "g";
    r->request.dt = 0.02;
    reading_of_text(r, ".1 # the first\n.2\n\n.3\n # the end");
    assert_read(r, "columns", 3, 0.02);
    assert_close(r->record.value[0], 0.1, 1e-15);
}

static void times_must_grow_in_even_steps(void **state) {
    struct reading *r = *state;
    r->request.unit = "g";
    reading_of_text(r, "0 0\n.01 0\n.01 0\n");
    assert_refused(r, "a.txt:3: time 0.01 after 0.01; times must increase");
    reading_of_text(r, "0 0\n.01 0\n.02 0\n.04 0\n");
    assert_refused(r, "a.txt:4: step of 0.02 s to time 0.04; the first step is 0.01 s and steps "
                      "must be even");
    reading_of_text(r, "0 0\n.010 0\n.020 0\n.030 0\n.042 0\n.054 0\n.066 0\n");
    assert_refused(r, "a.txt:4: time 0.03 is 0.273 steps of 0.011 s off the even grid from first "
                      "to last time; steps must be even");
    reading_of_text(r, "0 0\n.01 0\nnan 0\n");
    assert_refused(r, "a.txt:3: time 3 'nan' is not a number");
}

static void times_of_few_digits_count_as_even_with_a_warning(void **state) {
    struct reading *r = *state;
    r->request.unit = "g";
    reading_of_text(r, "0 0\n.004 0\n.008 0\n.012 0\n.016 0\n.020 0\n.023 0\n.027 0\n.031 0\n");
    assert_int_equal(r->status, STATUS_OK);
    assert_close(r->record.dt, 0.003875, 1e-12);
    assert_warned(r, "a.txt:1: times are up to 0.16 steps off an even grid of 0.003875 s; taken as "
                     "rounded");
}

static void a_first_time_that_is_not_zero_is_said(void **state) {
    struct reading *r = *state;
    r->request.unit = "g";
    reading_of_text(r, "5 0\n5.01 .1\n5.02 0\n");
    assert_read(r, "columns", 3, 0.01);
    assert_warned(r, "a.txt:1: the first time is 5 s; it is taken as the start of the record");
}

static void rows_that_could_be_misread_are_refused(void **state) {
    struct reading *r = *state;
    r->request.unit = "g";
    reading_of_text(r, "0,000 -0,030\n0,010 -0,050\n");
    assert_refused(r, "a.txt:1: '0,000 -0,030' has commas beside other separators; numbers need a "
                      "decimal point");
    reading_of_text(r, "0,5;1.5\n1,5;2,5\n");
    assert_refused(r, "a.txt:1: '0,5;1.5' has commas beside other separators; numbers need a "
                      "decimal point");
    reading_of_text(r, "0,007\n0,009\n");
    assert_refused(r, "a.txt:2: time 0 after 0; times must increase (a comma ends a number)");
    reading_of_text(r, "0 1\n.01 2 3\n");
    assert_refused(r, "a.txt:2: row of 3 values; the first (line 1) has 2");
    reading_of_text(r, "0,1\n.01,,2\n");
    assert_refused(r, "a.txt:2: row of 3 values; the first (line 1) has 2");
    reading_of_text(r, "0,1\n,2\n");
    assert_refused(r, "a.txt:2: time 2 is empty");
    reading_of_text(r, "0 N/A\n.01 1\n.02 2\n");
    assert_refused(r, "a.txt:1: '0 N/A' is neither a row of numbers nor a caption");
    reading_of_text(r, "0 nan\n.01 1\n.02 2\n");
    assert_refused(r, "a.txt:1: value 1 'nan' is not a number");
    reading_of_text(r, "0 1\n.01 1\nthe end\n");
    assert_refused(r, "a.txt:3: time 3 'the' is not a number");
    reading_of_text(r, "0 1\n");
    assert_refused(r, "a.txt: the file holds 1 values; at least 2 are needed");
}

static void three_columns_are_not_guessed_at(void **state) {
    struct reading *r = *state;
    r->request.unit = "g";
    r->request.dt = 0.01;
    reading_of_text(r, "0 1 2\n.01 1 2\n");
    assert_refused(r, "a.txt:1: 3 columns; -channel chooses a column after the times; -format "
                      "series reads values that run on from line to line");
    r->request.plain = true;
    reading_of_text(r, "0 1 2\n.01 1 2\n");
    assert_refused(r, "a.txt:1: 3 columns; one or two (time and value) are read; -format series "
                      "reads values that run on from line to line");
    r->request.plain = false;
    r->request.format = "series";
    reading_of_text(r, "0 1 2\n.01 1 2\n");
    assert_read(r, "series", 6, 0.01);
}

static void a_channel_is_a_column_behind_the_times(void **state) {
    static const struct {
        const char *caption;
        double unit[3];  // of each channel; 0: none is told
    } c[] = {
        {"t (s), x (g), y (cm/s2), z (m/s2)", {9.80665, 0.01, 1.0}},
        {"t, x, y, z (g)", {9.80665, 9.80665, 9.80665}},
        {"t (s), x (g), y (g), z", {0.0, 0.0, 0.0}},
    };
    struct reading *r = *state;
    for (size_t i = 0; i < sizeof c / sizeof c[0]; i++) {
        for (int k = 0; k < 3; k++) {
            char text[128];
            snprintf(text, sizeof text, "%s\n0 .1 .2 .3\n.01 -.4 -.5 -.6\n", c[i].caption);
            r->request.channel = k + 1;
            reading_of_text(r, text);
            if (c[i].unit[k] == 0.0) {
                assert_refused(r, "a.txt: the file gives no unit; give -unit U (g, m/s2, cm/s2, "
                                  "gal, ...)");
                continue;
            }
            assert_read(r, "columns", 2, 0.01);
            assert_close(r->record.unit, c[i].unit[k], 1e-15);
            assert_close(r->record.value[0], 0.1 + 0.1 * k, 1e-15);
            assert_close(r->record.value[1], -0.4 - 0.1 * k, 1e-15);
        }
    }
    reading_of_text(r, "t (s), a (g), v (cm/s), u (cm)\n0 1 2 3\n.01 1 2 3\n");
    assert_refused(r, "a.txt:1: 'cm' is not a unit of acceleration; give -unit U (g, m/s2, cm/s2, "
                      "gal, ...)");
    r->request.channel = 2;
    reading_of_text(r, "a (g)\n.1\n.2\n");
    assert_refused(r, "a.txt:2: the file has no channel 2; it has 1, one per column");
    assert_int_equal(r->record.wrong, RECORD_CHANNEL);
    reading_of_text(r, "t (s) a (g)\n0 .1\n.01 .2\n");
    assert_refused(r, "a.txt:2: the file has no channel 2; it has 1, one per column after the "
                      "times");
}

static void a_short_last_row_shows_that_values_run_on(void **state) {
    struct reading *r = *state;
    r->request.unit = "g";
    r->request.dt = 0.01;
    reading_of_text(r, "1 2 3\n4 5\n*** End Data ***\n");
    assert_read(r, "series", 5, 0.01);
    assert_close(r->record.value[4], 5, 1e-15);
}

static void a_load_history_is_read_as_printed(void **state) {
    struct reading *r = *state;
    r->request.plain = true;
    reading_of_text(r, "time (s) force (kN)\n0 1e9\n5 -2e9\n");
    assert_read(r, "columns", 2, 5);
    assert_silent(r);
    assert_close(r->record.unit, 1, 1e-15);
    r->request.format = "peer";
    reading_of_text(r, "0 1\n5 2\n");
    assert_refused(r, "a.txt: format peer holds accelerations only");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST_READING(two_columns_are_read_with_any_separator),
        TEST_READING(the_caption_gives_the_unit),
        TEST_READING(one_column_needs_the_time_step_and_the_unit),
        TEST_READING(a_comment_takes_no_value_away),
        TEST_READING(times_must_grow_in_even_steps),
        TEST_READING(times_of_few_digits_count_as_even_with_a_warning),
        TEST_READING(a_first_time_that_is_not_zero_is_said),
        TEST_READING(rows_that_could_be_misread_are_refused),
        TEST_READING(three_columns_are_not_guessed_at),
        TEST_READING(a_channel_is_a_column_behind_the_times),
        TEST_READING(a_short_last_row_shows_that_values_run_on),
        TEST_READING(a_load_history_is_read_as_printed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
