// SPDX-License-Identifier: GPL-3.0-or-later
// Volume 1 of RENADIC and BHRC: channels, pairs of time and value, and what is refused. Reads
// tests/records/ from the top of the project.
#include "support/reading.h"
#include "support/support.h"

#define RENADIC "tests/records/good/renadic.v1"
#define BHRC "tests/records/good/bhrc.V1"

static void each_channel_of_a_file_is_read(void **state) {
    struct reading *r = *state;
    for (int c = 0; c < 3; c++) {
        r->request.channel = c + 1;
        reading_of_file(r, RENADIC);
        assert_read(r, "renadic", 50, 0.005);
        assert_silent(r);
        assert_close(r->record.unit, 0.980665, 1e-15);
        assert_waves(r, c, 1, 5.1e-4);
        reading_of_file(r, BHRC);
        assert_read(r, "bhrc", 50, 0.005);
        assert_silent(r);
        assert_close(r->record.unit, 0.980665, 1e-15);
        assert_waves(r, c, 1, 5.1e-7);
    }
}

static void without_a_channel_there_is_a_list(void **state) {
    struct reading *r = *state;
    reading_of_file(r, RENADIC);
    assert_refused(r, RENADIC ": 3 channels: 1 'CHAN  1: EW       (STA CHN:  1)', 2 'CHAN  2: NS   "
                              "    (STA CHN:  2)', 3 'CHAN  3: V        (STA CHN:  3)'; -channel "
                              "chooses one");
    reading_of_file(r, BHRC);
    assert_refused(r, BHRC ": 3 channels: 1 'COMP L1', 2 'COMP V2', 3 'COMP T3'; -channel chooses "
                           "one");
}

static void times_may_touch_the_value_before(void **state) {
    struct reading *r = *state;
    reading_of_text(r, "UNCORRECTED ACCELEROGRAM DATA\n\n\n\n\n\nCHAN  1: UP\n\n\n\n"
                       "NO. OF POINTS =   3  RECORD LENGTH =  0.015 SEC\n"
                       "UNITS OF UNCOR ACCEL ARE SEC AND G/10.\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n"
                       "100.000  0.003100.005 -0.004100.010  0.005\n");
    assert_read(r, "renadic", 3, 0.005);
    assert_close(r->record.value[0], 0.003, 1e-15);
    assert_close(r->record.value[2], 0.005, 1e-15);
    assert_warned(r, "a.txt:11: the first time is 100 s; it is taken as the start of the record");
}

static void the_peak_has_a_unit_of_its_own(void **state) {
    struct reading *r = *state;
    r->request.channel = 1;
    reading_of_changed(r, RENADIC, "MAX  =  0.086 G", "MAX  =  0.096 G");
    assert_warned(r, "a.txt:12: the header states a largest acceleration of 0.96 G/10; that of the "
                     "values is 0.859");
    reading_of_changed(r, RENADIC, "MAX  =  0.086 G", "MAX  = 0.842 M/S2");
    assert_silent(r);
    reading_of_changed(r, RENADIC, "MAX  =  0.086 G", "MAX  =  0.086 X");
    assert_refused(r, "a.txt:12: unit 'X' of MAX is not a unit of acceleration");
}

static void what_a_file_says_wrongly_is_refused(void **state) {
    static const struct {
        const char *path, *from, *to, *message;
    } c[] = {
        {BHRC, "DURATION =   0.250", "DURATION =   5.003",
         "a.txt:11: 50 values in 5.003 s are 9.994 a second; that must be a whole number"},
        {BHRC, "     50      DURATION =   0.250", "     49      DURATION =   0.245",
         "a.txt:32: '-.730546E-01' follows the last value of the line"},
        {BHRC, "     50      DURATION =   0.250", "     40      DURATION =   0.200",
         "a.txt:32: '-.216234E+00 -.276457E+00 -.316633E+00 -...' is where '/&' should end the "
         "channel of 40 values"},
        {BHRC, "     50      DURATION =   0.250", "     60      DURATION =   0.300",
         "a.txt:33: value 51 '/&' is not a number"},
        {BHRC, "     50      DUR", "1000000      DUR",
         "a.txt:11: 1000000 values; the file ends before"},
        {BHRC, "     50      DUR", "    0.5      DUR",
         "a.txt:11: NO. OF POINTS is 0.5; it must be a whole number from 2 to 1e9"},
        {BHRC, "DURATION =   0.250", "DURATION =   0.000",
         "a.txt:11: DURATION is 0.000; it must be > 0"},
        {BHRC, "DURATION =   0.250", "", "a.txt:11: no 'NO. OF POINTS =' and 'DURATION ='"},
        {BHRC, "G/10", "G/20",
         "a.txt:12: 'G/20' is not a unit of acceleration; give -unit U (g, m/s2, cm/s2, gal, ...)"},
        {RENADIC, "  0.005", "  0.007",
         "a.txt:28: time 0.007; the header's step of 0.005 s makes it 0.005"},
        {RENADIC, "  0.005", "  x.005", "a.txt:28: time 2 'x.005' is not a number"},
    };
    struct reading *r = *state;
    r->request.channel = 1;
    for (size_t i = 0; i < sizeof c / sizeof c[0]; i++) {
        reading_of_changed(r, c[i].path, c[i].from, c[i].to);
        assert_refused(r, c[i].message);
    }
}

static void a_file_that_breaks_off_is_refused(void **state) {
    struct reading *r = *state;
    r->request.format = "bhrc";
    reading_of_text(r, "* VOL2DS FILE\n");
    assert_refused(r, "a.txt: the file has no line 'VOL1DS FILE'");
    reading_of_text(r, "* VOL1DS FILE\n\n");
    assert_refused(r, "a.txt:2: no 'NO. OF POINTS =' and 'DURATION ='");
}

static void films_have_times_that_are_not_even(void **state) {
    struct reading *r = *state;
    reading_of_text(r, "FILE     0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:\n1 2\n");
    assert_refused(r, "a.txt: looks like format USC volume 1 (times that are not even), which "
                      "cannot be read yet");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST_READING(each_channel_of_a_file_is_read),
        TEST_READING(without_a_channel_there_is_a_list),
        TEST_READING(times_may_touch_the_value_before),
        TEST_READING(the_peak_has_a_unit_of_its_own),
        TEST_READING(what_a_file_says_wrongly_is_refused),
        TEST_READING(a_file_that_breaks_off_is_refused),
        TEST_READING(films_have_times_that_are_not_even),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
