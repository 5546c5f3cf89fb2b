// SPDX-License-Identifier: GPL-3.0-or-later
// Fields of records: nothing between two numbers is skipped; values that touch or are repeated;
// decimal commas; sizes that a file gives twice.
#include <string.h>

#include "support/reading.h"
#include "support/support.h"

#define PEER_4 PEER_TITLE "NPTS= 4, DT= .01 SEC\n"
#define OVERFLOW(where, what)                                                                      \
    "a.txt:" where ": " what " is an overflow of Fortran: the value did not fit its field"

struct refusal {
    const char *text, *message;
};

static void assert_all_refused(struct reading *r, const struct refusal *c, size_t n) {
    for (size_t i = 0; i < n; i++) {
        reading_of_text(r, c[i].text);
        assert_refused(r, c[i].message);
    }
}

static void stars_of_an_overflow_are_a_value_that_is_lost(void **state) {
    static const struct refusal c[] = {
        {".1\n*******\n.3\n", OVERFLOW("2:1", "value 2 '*******'")},
        {".1\n.2\n *******\n", OVERFLOW("3:2", "value 3 '*******'")},
        {"0 .1\n.01 *****\n.02 .3\n", OVERFLOW("2:5", "value 2 '*****'")},
        {"0 .1\n***** .2\n.02 .3\n", OVERFLOW("2:1", "time 2 '*****'")},
        {"1 2 3\n****** 5 6\n7\n", OVERFLOW("2:1", "value 4 '******'")},
        {"1 2 3\n4 ****** 6\n7\n", OVERFLOW("2:3", "value 5 '******'")},
        {"1 2 3\n4 5 6\n******\n", OVERFLOW("3:1", "value 7 '******'")},
        {"1 2 3\n4 5-.6****** 6\n7\n", OVERFLOW("2:3", "value 5 '5-.6******'")},
        {PEER_4 ".1 .2\n**** .4\n", OVERFLOW("6:1", "value 3 '****'")},
        {PEER_4 "****\n.2 .3 .4\n", OVERFLOW("5:1", "value 1 '****'")},
        {PEER_4 ".1 .2 .3 .4\n****\n", OVERFLOW("6:1", "value 5 '****'")},
    };
    struct reading *r = *state;
    r->request.unit = "g";
    r->request.dt = 0.01;
    assert_all_refused(r, c, sizeof c / sizeof c[0]);
}

static void stars_before_the_first_number_are_an_overflow_unless_they_frame_a_text(void **state) {
    static const struct refusal c[] = {
        {"*******\n.2\n.3\n", OVERFLOW("1:1", "'*******' before the first number")},
        {"a (g)\n*******\n.2\n.3\n", OVERFLOW("2:1", "'*******' before the first number")},
        {"***** .1\n.01 .2\n.02 .3\n", OVERFLOW("1:1", "'***** .1' before the first number")},
        {"0 *****\n.01 .2\n.02 .3\n", OVERFLOW("1:1", "'0 *****' before the first number")},
    };
    struct reading *r = *state;
    r->request.unit = "g";
    r->request.dt = 0.01;
    assert_all_refused(r, c, sizeof c / sizeof c[0]);
    reading_of_text(r, "**********\n* a (g) *\n**********\n\n.1\n.2\n*** End Data ***\n");
    assert_read(r, "columns", 2, 0.01);
}

static void no_comment_stands_among_the_numbers(void **state) {
#define AMONG(where, what)                                                                         \
    "a.txt:" where ": the comment " what " is between numbers, where it may hide one; remove "     \
    "the line"
    static const struct refusal c[] = {
        {".1\n# none\n.3\n", AMONG("2:1", "'# none'")},
        {".1\n#####\n.3\n", AMONG("2:1", "'#####'")},
        {".1\n  % x\n.3\n", AMONG("2:3", "'% x'")},
        {".1\n! x\n\n.3\n", AMONG("2:1", "'! x'")},
        {"0 .1\n// x\n.01 .3\n", AMONG("2:1", "'// x'")},
        {"0 .1\n* x\n* y\n.01 .3\n* end\n", AMONG("2:1", "'* x'")},
        {PEER_4 ".1 .2\n* x\n.3 .4\n", AMONG("6:1", "'* x'")},
    };
    struct reading *r = *state;
    r->request.unit = "g";
    r->request.dt = 0.01;
    assert_all_refused(r, c, sizeof c / sizeof c[0]);
    reading_of_text(r, PEER_4 "* x\n\n.1 .2 .3 .4\n* end\n\n# end\n");
    assert_read(r, "peer", 4, 0.01);
}

static void a_mark_of_a_comment_behind_numbers_needs_a_blank(void **state) {
    static const struct refusal c[] = {
        {".1\n.2\n.3 #N/A\n", "a.txt:3: row of 2 values; the first (line 1) has 1"},
        {"1 2 3\n4 #### 6\n7\n", "a.txt:2: value 5 '####' is not a number"},
        {"1 2 3\n4 #N/A 6\n7\n", "a.txt:2: value 5 '#N/A' is not a number"},
        {"0 .1 #start\n.01 .2\n", "a.txt:1: '0 .1 #start' is neither a row of numbers nor a "
                                  "caption"},
        {PEER_4 ".1 .2 #3 .4\n", "a.txt:5: value 3 '#3' is not a number"},
    };
    struct reading *r = *state;
    r->request.unit = "g";
    r->request.dt = 0.01;
    assert_all_refused(r, c, sizeof c / sizeof c[0]);
    reading_of_text(r, ".1 # the first\n.2 #\n.3\n");
    assert_read(r, "columns", 3, 0.01);
}

static void assert_values(const struct reading *r, const char *format, size_t n,
                          const double *value) {
    assert_read(r, format, n, 0.01);
    for (size_t i = 0; i < n; i++) {
        assert_true(r->record.value[i] == value[i]);
    }
}

static void numbers_that_touch_and_repeat_counts_are_read_where_values_run_on(void **state) {
    static const struct {
        const char *text;
        double value[4];
    } c[] = {
        {"1.2345E-01-2.3456E-02 .5+.25\n", {.12345, -.023456, .5, .25}},
        {"-.5D-1-1.5D+0\n1.234-103+1.234-103\n", {-.05, -1.5, 1.234e-103, 1.234e-103}},
        {"1.-2.5-0001.25-.5\n", {1, -2.5, -1.25, -.5}},
        {"3*-0.5 2.\n", {-.5, -.5, -.5, 2}},
        {"1*.5 2*1.5E-01\n0\n", {.5, .15, .15, 0}},
    };
    struct reading *r = *state;
    for (size_t i = 0; i < sizeof c / sizeof c[0]; i++) {
        char text[256];
        snprintf(text, sizeof text, PEER_4 "%s", c[i].text);
        reading_of_text(r, text);
        assert_values(r, "peer", 4, c[i].value);
    }
    r->request.unit = "g";
    r->request.dt = 0.01;
    r->request.format = "series";
    reading_of_text(r, "2*.5\n1.5-2.5\n");
    assert_values(r, "series", 4, (const double[]){.5, .5, 1.5, -2.5});
}

static void numbers_that_can_be_parted_in_two_ways_are_refused(void **state) {
#define NO_LETTER                                                                                  \
    " is not a number: an exponent without a letter has three digits; write an E before its sign"
#define TWO_WAYS " are numbers that touch and can be separated in two ways; put spaces between them"
    static const struct refusal c[] = {
        {PEER_4 ".1 .2 .3 1.234-103.500\n", "a.txt:5: value 4 '1.234-103.500'" TWO_WAYS},
        {PEER_4 ".1 .2 1.2E-012.3\n.4\n", "a.txt:5: value 3 '1.2E-012.3'" TWO_WAYS},
        {PEER_4 ".1 .2 .3 1.5-2\n", "a.txt:5: value 4 '1.5-2'" NO_LETTER},
        {PEER_4 ".1 .2 .3 2.3489E-2-16\n", "a.txt:5: value 4 '2.3489E-2-16' is not a number"},
        {PEER_4 ".1234-01 .2 .3 .4\n", "a.txt:5: value 1 '.1234-01'" NO_LETTER},
        {PEER_4 ".1 .2 .3 .4+0100\n", "a.txt:5: value 4 '.4+0100'" NO_LETTER},
        {PEER_4 ".1 .2 .3 1.5-\n", "a.txt:5: value 4 '1.5-' is not a number"},
        {PEER_4 ".1 .2 .3 1.5.2\n", "a.txt:5: value 4 '1.5.2' is not a number"},
        {PEER_4 ".1 .2 .3 0*1.5\n", "a.txt:5: value 4 '0*1.5' is not a number"},
        {PEER_4 ".1 .2 4*.5\n", "a.txt:4: the header says 4 values; the file holds 6"},
        {PEER_4 ".1 1.5-2.5\n",
         "a.txt:5: the file ends after 3 values; its header (line 4) says 4"},
        {"0 .1-.2\n.01 .3-.4\n", "a.txt:1: value 1 '.1-.2' are numbers that touch; put spaces "
                                 "between them, or read values that run on with -format series"},
        {".1\n60*.2\n", "a.txt:2: value 2 '60*.2' is a repeat count; only values that run on "
                        "(-format series) have one"},
    };
    struct reading *r = *state;
    r->request.unit = "g";
    r->request.dt = 0.01;
    assert_all_refused(r, c, sizeof c / sizeof c[0]);
}

static void repeat_counts_do_not_ask_for_the_memory_of_many_records(void **state) {
    struct reading *r = *state;
    enum { ROWS = 100, ROW = 11 };
    char text[ROWS * ROW + 1];
    r->request.unit = "g";
    r->request.dt = 0.01;
    r->request.format = "series";
    for (size_t i = 0; i < ROWS; i++) {
        snprintf(text + i * ROW, ROW + 1, "999999*0.0\n");
    }
    reading_of_text(r, text);
    assert_refused(r, "a.txt: 99999900 values, most of them repeated; at most 17280000 are read");
}

static void commas_between_semicolons_are_decimal_where_they_can_be_nothing_else(void **state) {
    struct reading *r = *state;
    r->request.unit = "g";
    reading_of_text(r, "time;a\n0,00;1,234\n0,01;-,5\n0,02;3\n");
    assert_values(r, "columns", 3, (const double[]){1.234, -.5, 3});
    reading_of_text(r, "0;1,25E-01\r\n0,01;0,5\r\n");
    assert_values(r, "columns", 2, (const double[]){.125, .5});
    reading_of_text(r, "0;1,234\n1;5,678\n");
    assert_refused(r,
                   "a.txt:1: '0;1,234' has commas beside other separators; numbers need a decimal "
                   "point");
    reading_of_text(r, "0;1,25\n1;5.5\n");
    assert_refused(r,
                   "a.txt:1: '0;1,25' has commas beside other separators; numbers need a decimal "
                   "point");
    reading_of_text(r, "0,0;1,x5\n0,1;2,5\n0,2;3,5\n");
    assert_refused(r, "a.txt:1: '0,0;1,x5' is neither a row of numbers nor a caption");
    r->request.format = "series";
    reading_of_text(r, "0,5;1,5\n");
    assert_refused(r, "a.txt:1: decimal commas; only -format columns reads them");
}

static void of_two_numbers_of_values_that_of_the_file_is_used_with_a_warning(void **state) {
    static const struct refusal c[] = {
        {"NPTS= 3, DT= .01 SEC\nUNITS OF G\nNPTS= 4, DT= .01 SEC\n.1 .2 -.3 .4\n",
         "a.txt:1: NPTS is given twice, as 3 here and as 4 in line 3; the file holds 4 values"},
        {"NPTS= 4, DT= .01 SEC\nUNITS OF G\nNPTS= 3, DT= .01 SEC\n.1 .2 -.3 .4\n",
         "a.txt:1: NPTS is given twice, as 4 here and as 3 in line 3; the file holds 4 values"},
        {"UNITS OF G\nNPTS= 3, DT= .01 SEC, NPTS= 4\n.1 .2 -.3 .4\n",
         "a.txt:2: NPTS is given twice, as 4 here and as 3 in line 2; the file holds 4 values"},
    };
    struct reading *r = *state;
    for (size_t i = 0; i < sizeof c / sizeof c[0]; i++) {
        reading_of_text(r, c[i].text);
        assert_values(r, "peer", 4, (const double[]){.1, .2, -.3, .4});
        assert_warned(r, c[i].message);
    }
    reading_of_text(r, "NPTS= 4, DT= .01 SEC\nUNITS OF G\nNPTS= 3, DT= .01 SEC\n1 2 3 4 5\n");
    assert_refused(r, "a.txt:3: the header says 3 values; the file holds 5");
}

static void a_comment_with_another_time_step_is_warned_about(void **state) {
#define STEP(where, noted)                                                                         \
    "a.txt:" where ": the comment gives a time step of " noted " s; that of the times is 0.01 s "  \
    "and is used"
    static const struct {
        const char *text, *warning;
    } c[] = {
        {"# dt = 0.02\n0 1\n.01 2\n", STEP("1", "0.02")},
        {"a\nTime step: 5 ms\n0 1\n.01 2\n", STEP("2", "0.005")},
        {"% sampling interval 20 msec\n0 1\n.01 2\n", STEP("1", "0.02")},
        {"* DT=.02s\n0 1\n.01 2\n", STEP("1", "0.02")},
        {"# dt = 0.01 s, n = 2\n0 1\n.01 2\n", NULL},
        {"# dt = 10ms\n0 1\n.01 2\n", NULL},
        {"time step, value\n0 1\n.01 2\n", NULL},
        {"width 0.02\n0 1\n.01 2\n", NULL},
    };
    struct reading *r = *state;
    r->request.unit = "g";
    for (size_t i = 0; i < sizeof c / sizeof c[0]; i++) {
        reading_of_text(r, c[i].text);
        assert_read(r, "columns", 2, 0.01);
        if (c[i].warning) {
            assert_warned(r, c[i].warning);
        } else {
            assert_silent(r);
        }
    }
    r->request.dt = 0.01;
    reading_of_text(r, "# dt = 0.02\n1\n2\n");
    assert_warned(r, "a.txt:1: the comment gives a time step of 0.02 s; that of the option -dt is "
                     "0.01 s and is used");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST_READING(stars_of_an_overflow_are_a_value_that_is_lost),
        TEST_READING(stars_before_the_first_number_are_an_overflow_unless_they_frame_a_text),
        TEST_READING(no_comment_stands_among_the_numbers),
        TEST_READING(a_mark_of_a_comment_behind_numbers_needs_a_blank),
        TEST_READING(numbers_that_touch_and_repeat_counts_are_read_where_values_run_on),
        TEST_READING(numbers_that_can_be_parted_in_two_ways_are_refused),
        TEST_READING(repeat_counts_do_not_ask_for_the_memory_of_many_records),
        TEST_READING(commas_between_semicolons_are_decimal_where_they_can_be_nothing_else),
        TEST_READING(of_two_numbers_of_values_that_of_the_file_is_used_with_a_warning),
        TEST_READING(a_comment_with_another_time_step_is_warned_about),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
