// SPDX-License-Identifier: GPL-3.0-or-later
// Records in the format peer, and the numbers in them.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "support/reading.h"
#include "support/support.h"

static void all_forms_of_the_peer_size_line_are_read(void **state) {
    static const char *const line[] = {
        "NPTS=  3, DT= .02000 SEC",
        "NPTS=   3, DT=   .0200 SEC,",
        "NPTS=   3, DT=   .0200 SEC,   4 POLE @    40.00000 HZ,  -5 POLE @      .20000",
        "NPTS =  3 , DT =   .020 SEC ,   ",
        "NPTS=   3, dt=  .0200",
        "npts=3,dt=.02",
        "3    0.0200    NPTS, DT",
    };
    struct reading *r = *state;
    for (size_t i = 0; i < sizeof line / sizeof line[0]; i++) {
        char text[256];
        snprintf(text, sizeof text, PEER_TITLE "%s\n .1 -.2\n .3\n", line[i]);
        reading_of_text(r, text);
        assert_read(r, "peer", 3, 0.02);
        assert_close(r->record.value[1], -0.2, 1e-15);
        assert_silent(r);
    }
}

static void units_of_a_peer_header_are_understood(void **state) {
    static const struct {
        const char *line;
        double unit;
    } c[] = {
        {"ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.1 Hz", 9.80665},
        {"ACCELERATION TIME HISTORY IN UNITS OF CM/S/S", 0.01},
        {"Units: cm/sec/sec", 0.01},
        {"The units are (g)", 9.80665},
        {"  Acceleration in g", 9.80665},
        {"UNITS OF M/SEC**2", 1},
        {"UNITS OF IN/SEC^2", 0.0254},
    };
    struct reading *r = *state;
    for (size_t i = 0; i < sizeof c / sizeof c[0]; i++) {
        char text[256];
        snprintf(text, sizeof text, "T\n%s\nNPTS= 2, DT= .01 SEC\n.1 -.1\n", c[i].line);
        reading_of_text(r, text);
        assert_read(r, "peer", 2, 0.01);
        assert_close(r->record.unit, c[i].unit, 1e-15);
    }
}

static void a_peer_file_without_a_unit_asks_for_one(void **state) {
    struct reading *r = *state;
    const char *text = "T\nNPTS= 2, DT= .01 SEC\n.1 -.1\n";
    reading_of_text(r, text);
    assert_refused(r, "a.txt: the file gives no unit; give -unit U (g, m/s2, cm/s2, gal, ...)");
    r->request.unit = "g";
    reading_of_text(r, text);
    assert_silent(r);
    assert_close(r->record.unit, 9.80665, 1e-15);
}

static void a_unit_that_is_no_acceleration_is_refused(void **state) {
    struct reading *r = *state;
    reading_of_text(r, "UNITS OF CM\nNPTS= 2, DT= .01 SEC\n.1 -.1\n");
    assert_refused(r, "a.txt:1: 'CM' is not a unit of acceleration; give -unit U (g, m/s2, cm/s2, "
                      "gal, ...)");
    r->request.unit = "kN";
    reading_of_text(r, PEER_TITLE "NPTS= 2, DT= .01 SEC\n.1 -.1\n");
    assert_refused(r, "a.txt: -unit 'kN' is not a unit of acceleration (g, m/s2, cm/s2, gal, ...)");
}

static void gravity_of_the_request_is_the_unit_g(void **state) {
    struct reading *r = *state;
    r->request.gravity = 9.81;
    reading_of_text(r, PEER_TITLE "NPTS= 2, DT= .01 SEC\n.1 -.1\n");
    assert_close(r->record.unit, 9.81, 1e-15);
}

static void the_user_s_unit_wins_with_a_warning(void **state) {
    struct reading *r = *state;
    r->request.unit = "cm/s2";
    reading_of_text(r, PEER_TITLE "NPTS= 2, DT= .01 SEC\n.1 -.1\n");
    assert_warned(r, "a.txt:3: -unit cm/s2 overrides the 'G' of the file");
    assert_close(r->record.unit, 0.01, 1e-15);
    r->request.unit = "g";
    reading_of_text(r, PEER_TITLE "NPTS= 2, DT= .01 SEC\n.1 -.1\n");
    assert_silent(r);
}

static void a_time_step_that_contradicts_the_file_is_refused(void **state) {
    struct reading *r = *state;
    r->request.dt = 0.02;
    reading_of_text(r, PEER_TITLE "NPTS= 2, DT= .01 SEC\n.1 -.1\n");
    assert_refused(r, "a.txt:4: -dt 0.02 contradicts the time step of 0.01 s in the file");
    reading_of_text(r, "time (s),a (g)\n0,.1\n.01,-.1\n");
    assert_refused(r, "a.txt:2: -dt 0.02 contradicts the time step of 0.01 s in the file");
    r->request.dt = 0.005;
    reading_of_text(r, PEER_TITLE "NPTS= 2, DT= .01 SEC\n.1 -.1\n");
    assert_refused(r, "a.txt:4: -dt 0.005 contradicts the time step of 0.01 s in the file");
    r->request.dt = 0.01;
    reading_of_text(r, PEER_TITLE "NPTS= 2, DT= .01 SEC\n.1 -.1\n");
    assert_read(r, "peer", 2, 0.01);
    r->request.dt = -1;
    reading_of_text(r, PEER_TITLE "NPTS= 2, DT= .01 SEC\n.1 -.1\n");
    assert_refused(r, "a.txt: -dt is -1 s; it must be > 0");
}

static void a_time_step_that_is_not_believable_can_be_confirmed(void **state) {
    struct reading *r = *state;
    const char *text = PEER_TITLE "NPTS= 2, DT= 10.0 SEC\n.001 -.001\n";
    reading_of_text(r, text);
    assert_refused(r, "a.txt:4: a time step of 10 s is not believable for an accelerogram (1e-05 "
                      "to 1 s); confirm it with -dt 10");
    r->request.dt = 10;
    reading_of_text(r, text);
    assert_read(r, "peer", 2, 10);
}

static void a_step_in_milliseconds_is_refused(void **state) {
    struct reading *r = *state;
    reading_of_text(r, PEER_TITLE "NPTS= 2, DT= .5 MSEC\n.1 -.1\n");
    assert_refused(r, "a.txt:4: DT is not in seconds");
}

static void wrong_counts_name_both_numbers(void **state) {
    struct reading *r = *state;
    reading_of_text(r, PEER_TITLE "NPTS= 1000000000000, DT= .01 SEC\n.1\n-.1\n");
    assert_refused(r, "a.txt:6: the file ends after 2 values; its header (line 4) says "
                      "1000000000000");
    reading_of_text(r, PEER_TITLE "NPTS= 2, DT= .01 SEC\n.1\n-.1 .3\n");
    assert_refused(r, "a.txt:4: the header says 2 values; the file holds 3");
    reading_of_text(r, PEER_TITLE "NPTS= 2, DT= .01 SEC\n");
    assert_refused(r, "a.txt:4: the file ends after 0 values; its header (line 4) says 2");
    reading_of_text(r, PEER_TITLE "NPTS= -2, DT= .01 SEC\n.1\n");
    assert_refused(r, "a.txt:4: NPTS is -2; it must be at least 2");
    reading_of_text(r, PEER_TITLE "NPTS= many\n.1\n");
    assert_refused(r, "a.txt:4: NPTS 'many' is not a number");
    reading_of_text(r, PEER_TITLE "NPTS\n.1\n");
    assert_refused(r, "a.txt:4: neither 'NPTS= n, DT= dt SEC' nor 'n dt NPTS, DT'");
    reading_of_text(r, PEER_TITLE "DT= .01 SEC\n.1\n");
    assert_refused(
        r, "a.txt: the file has no NPTS in the first 64 lines; a PEER header says 'NPTS= n, DT= dt "
           "SEC' or 'n dt NPTS, DT'");
}

static void numbers_in_the_ways_of_c_and_fortran_are_read(void **state) {
    static const struct {
        const char *text;
        double value;
    } c[] = {
        {".7098000E-02", 0.007098},
        {"-.5d-1", -0.05},
        {"+1.5D+0", 1.5},
        {"1.25e-003", 0.00125},
        {"2.", 2},
        {"1.234567-105", 1.234567e-105},
        {"-1.5+000", -1.5},
        {".4940656E-323", 5e-324},
        {"007", 7},
    };
    struct reading *r = *state;
    for (size_t i = 0; i < sizeof c / sizeof c[0]; i++) {
        char text[128];
        snprintf(text, sizeof text, PEER_TITLE "NPTS= 2, DT= .01 SEC\n%s\t0\n", c[i].text);
        reading_of_text(r, text);
        assert_read(r, "peer", 2, 0.01);
        assert_true(r->record.value[0] == c[i].value);
    }
}

static void a_negative_zero_keeps_its_sign(void **state) {
    struct reading *r = *state;
    reading_of_text(r, PEER_TITLE "NPTS= 2, DT= .01 SEC\n-0.0 1\n");
    assert_read(r, "peer", 2, 0.01);
    assert_true(signbit(r->record.value[0]));
}

static void what_is_not_a_number_is_named_with_line_and_index(void **state) {
    static const struct {
        const char *field, *reason;
    } c[] = {
        {"NaN", "'NaN' is not a number"},
        {"-inf", "'-inf' is not a number"},
        {".12A4567E-01", "'.12A4567E-01' is not a number"},
        {"0x10", "'0x10' is not a number"},
        {"-.", "'-.' is not a number"},
        {"1.5E", "'1.5E' is not a number"},
        {"1.5-2", "'1.5-2' is not a number: an exponent without a letter has three digits; "
                  "write an E before its sign"},
        {"1e999", "'1e999' is out of range: over 1.8e308"},
        {"1.0D+400", "'1.0D+400' is out of range: over 1.8e308"},
        {"0,5", "'0,5' has a comma; numbers need a decimal point"},
        {"2.3489E-2-16", "'2.3489E-2-16' is not a number"},
        {"2.3489-16", "'2.3489-16' is not a number: an exponent without a letter has three digits; "
                      "write an E before its sign"},
    };
    struct reading *r = *state;
    for (size_t i = 0; i < sizeof c / sizeof c[0]; i++) {
        char text[256];
        char message[256];
        snprintf(text, sizeof text, PEER_TITLE "NPTS= 4, DT= .01 SEC\n.1 .2\n\n.3 %s\n",
                 c[i].field);
        snprintf(message, sizeof message, "a.txt:7: value 4 %s", c[i].reason);
        reading_of_text(r, text);
        assert_refused(r, message);
    }
}

static void a_broken_word_is_named_before_a_wrong_count(void **state) {
    struct reading *r = *state;
    reading_of_text(r, PEER_TITLE "NPTS= 4, DT= .01 SEC\n.1 .2\nx.y .3 .4\n");
    assert_refused(r, "a.txt:6: value 3 'x.y' is not a number");
    reading_of_text(r, PEER_TITLE "NPTS= 4, DT= .01 SEC\n.1 .2\nx.y .3\n.4 .5\n");
    assert_refused(r, "a.txt:6: value 3 'x.y' is not a number");
    reading_of_text(r, PEER_TITLE "NPTS= 4, DT= .01 SEC\n.1 .2\n.3 .4\n*** End Data ***\n");
    assert_read(r, "peer", 4, 0.01);
}

static void messages_show_little_of_the_file_and_no_control_characters(void **state) {
    struct reading *r = *state;
    char text[1200] = PEER_TITLE "NPTS= 1, DT= .01 SEC\n";
    reading_of_text(r, PEER_TITLE "NPTS= x\xc2\x9b\xff, DT= .01 SEC\n");
    assert_refused(r, "a.txt:4: NPTS 'x?\?' is not a number");
    size_t n = strlen(text);
    memset(text + n, 'y', sizeof text - n - 1);
    memcpy(text + strlen(PEER_TITLE), "NPTS= 2", 7);
    memcpy(text + n, "1 ", 2);
    reading_of_text(r, text);
    assert_refused(r, "a.txt:5: value 2 'yyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyy...' is not a "
                      "number");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST_READING(all_forms_of_the_peer_size_line_are_read),
        TEST_READING(units_of_a_peer_header_are_understood),
        TEST_READING(a_peer_file_without_a_unit_asks_for_one),
        TEST_READING(a_unit_that_is_no_acceleration_is_refused),
        TEST_READING(gravity_of_the_request_is_the_unit_g),
        TEST_READING(the_user_s_unit_wins_with_a_warning),
        TEST_READING(a_time_step_that_contradicts_the_file_is_refused),
        TEST_READING(a_time_step_that_is_not_believable_can_be_confirmed),
        TEST_READING(a_step_in_milliseconds_is_refused),
        TEST_READING(wrong_counts_name_both_numbers),
        TEST_READING(numbers_in_the_ways_of_c_and_fortran_are_read),
        TEST_READING(a_negative_zero_keeps_its_sign),
        TEST_READING(what_is_not_a_number_is_named_with_line_and_index),
        TEST_READING(a_broken_word_is_named_before_a_wrong_count),
        TEST_READING(messages_show_little_of_the_file_and_no_control_characters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
