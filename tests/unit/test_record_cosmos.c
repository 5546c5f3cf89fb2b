// SPDX-License-Identifier: GPL-3.0-or-later
// COSMOS and SMC files: values, what headers say of them, and what is refused. Reads
// tests/records/ from the top of the project.
#include "support/reading.h"
#include "support/support.h"

#define COSMOS "tests/records/good/cosmos.V2c"
#define SMC "tests/records/good/smc.smc"

static void each_channel_of_a_cosmos_file_is_read(void **state) {
    struct reading *r = *state;
    for (int c = 0; c < 3; c++) {
        r->request.channel = c + 1;
        reading_of_file(r, COSMOS);
        assert_read(r, "cosmos", 50, 0.02);
        assert_silent(r);
        assert_close(r->record.unit, 0.01, 1e-15);
        assert_waves(r, c, 100, 0.51e-5);
    }
}

static void without_a_channel_those_of_a_cosmos_file_are_listed(void **state) {
    struct reading *r = *state;
    reading_of_file(r, COSMOS);
    assert_refused(r, COSMOS ": 3 channels: 1 '90 deg', 2 'Up', 3 '360 deg'; -channel chooses one");
}

static void cosmos_units_and_formats_are_written_in_several_ways(void **state) {
    static const struct {
        const char *to;
        double unit;
    } c[] = {
        {"cm/s^2,Format=(8F10.5)", 0.01},
        {"cm/s^2 (4),Format=(8F10.5E)", 0.01},
        {" cm/sec/sec (04), Format= (8f10.5)", 0.01},
        {"g(02),Format=(8F10.5)", 9.80665},
    };
    struct reading *r = *state;
    r->request.channel = 1;
    for (size_t i = 0; i < sizeof c / sizeof c[0]; i++) {
        reading_of_changed(r, COSMOS, "cm/sec2(04),Format=(8F10.5)", c[i].to);
        assert_read(r, "cosmos", 50, 0.02);
        assert_close(r->record.unit, c[i].unit, 1e-15);
    }
}

static void a_cosmos_step_that_is_not_known_must_be_given(void **state) {
    struct reading *r = *state;
    r->request.channel = 1;
    reading_of_changed(r, COSMOS, "    20.000000", "  -999.000000");
    assert_refused(r, "a.txt:36: the file gives no time step; give -dt DT");
    r->request.dt = 0.02;
    reading_of_changed(r, COSMOS, "    20.000000", "  -999.000000");
    assert_read(r, "cosmos", 50, 0.02);
}

static void another_peak_than_a_header_states_is_warned_of(void **state) {
    struct reading *r = *state;
    reading_of_changed(r, SMC, "  8.5900957E+01", "  9.5900957E+01");
    assert_warned(r, "a.txt:23: the header states a largest acceleration of 95.90096 cm/s/s; that "
                     "of the values is 85.901");
    r->request.channel = 1;
    reading_of_changed(r, COSMOS, "Max =    85.901 cm/sec2", "Max =   0.08759 g");
    assert_silent(r);
    reading_of_changed(r, COSMOS, "Max =    85.901", "Max =    95.901");
    assert_warned(r, "a.txt:11: the header states a largest acceleration of 95.901 cm/sec2; that "
                     "of the values is 85.90096");
}

static void wrong_cosmos_files_are_refused(void **state) {
    static const struct {
        const char *from, *to, *message;
    } c[] = {
        {"units=cm/sec2(04)", "units= counts(50)",
         "a.txt:45: the values are counts of a recorder (volume 0), which are not converted; "
         "volumes 1 and 2 hold accelerations"},
        {"units=cm/sec2(04)", "units=deg/s/s(23)",
         "a.txt:45: 'deg/s/s' is not a unit of acceleration; give -unit U (g, m/s2, cm/s2, gal, "
         "...)"},
        {"     50  acc", "    5.5  acc",
         "a.txt:45: number of values is 5.5; it must be a whole number from 2 to 1e9"},
        {"     50  acc", "     49  acc", "a.txt:52: '-7.30546' follows the last value of the line"},
        {"     50  acc", "     48  acc",
         "a.txt:52: more than the 48 values that the header states"},
        {"     50  acc", "     60  acc", "a.txt:52: value 51 is empty"},
        {"approx    1", "approx    3",
         "a.txt:45: 50 values in approx 3 s; the time step of 0.02 s (line 36) makes it 1"},
        {"Format=(8F10.5)", "Format=(8I10)", "a.txt:45: the line has no format such as (8F10.5)"},
        {"    20.000000", "     0.000000", "a.txt:36: a time step of 0 ms; it must be > 0"},
        {"    20.000000", "    2x.000000", "a.txt:36: real 62 '2x.000000' is not a number"},
        {"Real-header", "Reel-header",
         "a.txt:45: the header has no line 'Real-header values follow' with a format above it"},
        {"  24.25497", "-999.00000",
         "a.txt:45: value 2 of those below is -999, which marks a value that is not known "
         "(line 13)"},
    };
    struct reading *r = *state;
    r->request.channel = 1;
    for (size_t i = 0; i < sizeof c / sizeof c[0]; i++) {
        reading_of_changed(r, COSMOS, c[i].from, c[i].to);
        assert_refused(r, c[i].message);
    }
    reading_of_text(r, "Corrected acceleration (Format v01.20 with 13 text lines)\n"
                       "9 acceleration pts, approx 1 secs, units=g,Format=(8F10.5)\n");
    assert_refused(
        r, "a.txt:2: the header has no line 'Real-header values follow' with a format above it");
    reading_of_text(r, "Corrected velocity (Format v01.20 with 13 text lines)\n");
    assert_refused(r, "a.txt: the file has no line 'acceleration pts' with 'units=' and 'Format='");
}

static void an_smc_file_is_read(void **state) {
    struct reading *r = *state;
    reading_of_file(r, SMC);
    assert_read(r, "smc", 50, 0.02);
    assert_silent(r);
    assert_close(r->record.unit, 0.01, 1e-15);
    assert_waves(r, 0, 100, 0.51e-3);
}

static void wrong_smc_files_are_refused(void **state) {
    static const struct {
        const char *from, *to, *message;
    } c[] = {
        {"2 CORR", "1 UNCORR",
         "a.txt: looks like format SMC of uncorrected accelerations (times that are not even), "
         "which cannot be read yet"},
        {"2 CORRECTED ACCELEROGRAM", "3 VELOCITY",
         "a.txt: looks like format SMC of velocities, which cannot be read yet"},
        {"        50 ", "        51 ", "a.txt:36: value 51 is empty"},
        {"        50 ", "        48 ", "a.txt:36: more than the 48 values that the header states"},
        {"        50 ", "    -32768 ",
         "a.txt:14: number of values is -32768; it must be a whole number from 2 to 1e9"},
        {"         2\n", "         3\n",
         "a.txt:13: the header states 3 lines of comment; 2 lines begin with a |"},
        {"  5.0000000E+01", "  0.0000000E+00",
         "a.txt:18: samples a second is 0.0000000E+00; it must be > 0"},
        {"-5.1649E+1-5.9155E+1", "-5.1649E+1-5.9x55E+1",
         "a.txt:32: value 18 '-5.9x55E+1' is not a number"},
    };
    struct reading *r = *state;
    for (size_t i = 0; i < sizeof c / sizeof c[0]; i++) {
        reading_of_changed(r, SMC, c[i].from, c[i].to);
        assert_refused(r, c[i].message);
    }
    reading_of_text(r, "2 CORRECTED ACCELEROGRAM\n*\n");
    assert_refused(r, "a.txt:2: the file ends after 2 of the 27 lines of a header");
    r->request.format = "smc";
    reading_of_file(r, COSMOS);
    assert_refused(r, COSMOS ":1: the line has no \'2 CORRECTED ACCELEROGRAM'");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST_READING(each_channel_of_a_cosmos_file_is_read),
        TEST_READING(without_a_channel_those_of_a_cosmos_file_are_listed),
        TEST_READING(cosmos_units_and_formats_are_written_in_several_ways),
        TEST_READING(a_cosmos_step_that_is_not_known_must_be_given),
        TEST_READING(another_peak_than_a_header_states_is_warned_of),
        TEST_READING(wrong_cosmos_files_are_refused),
        TEST_READING(an_smc_file_is_read),
        TEST_READING(wrong_smc_files_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
