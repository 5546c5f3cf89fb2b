// SPDX-License-Identifier: GPL-3.0-or-later
// Records in the format esm. Reads tests/records/ from the top of the project.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>

#include "support/reading.h"
#include "support/support.h"

#define TOP "EVENT_NAME: a\nMAGNITUDE_W: \nSAMPLING_INTERVAL_S: 0.005\n"
#define COUNT "NDATA: 3\n"
#define UNIT "UNITS: cm/s^2\n"
#define TYPE "DATA_TYPE: ACCELERATION\n"

// The file holds 100 exp(-i / 40) sin(2 pi i / 25) with six decimals.
static void a_whole_file_is_read(void **state) {
    struct reading *r = *state;
    reading_of_file(r, "tests/records/good/esm.asc");
    assert_read(r, "esm", 60, 0.01);
    assert_silent(r);
    assert_close(r->record.unit, 0.01, 1e-15);
    for (int i = 0; i < 60; i++) {
        const double wave = exp(-i / 40.0) * sin(2.0 * acos(-1.0) * i / 25.0);
        assert_true(fabs(r->record.value[i] - 100.0 * wave) <= 5.1e-7);
    }
}

static void what_is_no_acceleration_is_refused_by_its_name(void **state) {
    static const char *const types[] = {"VELOCITY", "DISPLACEMENT",
                                        "ACCELERATION RESPONSE SPECTRUM",
                                        "PSEUDO-VELOCITY RESPONSE SPECTRUM"};
    struct reading *r = *state;
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++) {
        char text[256];
        char message[128];
        snprintf(text, sizeof text, TOP COUNT UNIT "DATA_TYPE: %s\n1\n2\n3\n", types[i]);
        snprintf(message, sizeof message, "a.txt:6: this is not an acceleration: DATA_TYPE is '%s'",
                 types[i]);
        reading_of_text(r, text);
        assert_refused(r, message);
    }
}

static void all_names_of_accelerations_are_read(void **state) {
    static const char *const types[] = {"Acceleration", "UNPROCESSED ACCELERATION",
                                        "PROCESSED ACCELERATION"};
    struct reading *r = *state;
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++) {
        char text[256];
        snprintf(text, sizeof text, TOP COUNT UNIT "DATA_TYPE: %s\n1\n-2\n1\n", types[i]);
        reading_of_text(r, text);
        assert_read(r, "esm", 3, 0.005);
        assert_silent(r);
    }
}

static void a_peak_that_the_header_does_not_state_is_warned_of(void **state) {
    struct reading *r = *state;
    reading_of_text(r, TOP COUNT UNIT "PGA_CM/S^2: -2.0\n" TYPE "1\n-2.04\n1\n");
    assert_silent(r);
    reading_of_text(r, TOP COUNT UNIT "PGA_CM/S^2: \n" TYPE "1\n-2.04\n1\n");
    assert_silent(r);
    reading_of_text(r, TOP COUNT "UNITS: m/s^2\nPGA_CM/S^2: 2.0\n" TYPE ".01\n-.0204\n.01\n");
    assert_silent(r);
    reading_of_text(r, TOP COUNT UNIT "PGA_CM/S^2: 2.5\n" TYPE "1\n-2.04\n1\n");
    assert_warned(r, "a.txt:6: the header states a largest acceleration of 2.5 cm/s^2; that of "
                     "the values is 2.04");
}

static void headers_that_do_not_say_enough_are_refused(void **state) {
    static const struct {
        const char *text, *message;
    } c[] = {
        {"EVENT_NAME: X\n1\n2\n", "a.txt: the header has no 'DATA_TYPE'"},
        {TOP UNIT TYPE "1\n2\n", "a.txt: the header has no 'NDATA'"},
        {TOP "NDATA: \n" UNIT TYPE "1\n2\n", "a.txt:4: NDATA is empty"},
        {TOP "NDATA: 2.5\n" UNIT TYPE "1\n2\n",
         "a.txt:4: NDATA is 2.5; it must be a whole number from 2 to 1e9"},
        {TOP COUNT TYPE "1\n2\n3\n", "a.txt: the header has no 'UNITS'"},
        {TOP COUNT "UNITS: cm\n" TYPE "1\n2\n3\n",
         "a.txt:5: 'cm' is not a unit of acceleration; give -unit U (g, m/s2, cm/s2, gal, ...)"},
        {"EVENT_NAME:\nSAMPLING_INTERVAL_S: -1\n" COUNT UNIT TYPE "1\n2\n3\n",
         "a.txt:2: SAMPLING_INTERVAL_S is -1; it must be > 0"},
        {TOP COUNT UNIT TYPE "1\n2\n",
         "a.txt:8: the file ends after 2 values; its header (line 4) says 3"},
        {TOP COUNT UNIT TYPE "1\n2\n3\n4\n", "a.txt:4: the header says 3 values; the file holds 4"},
        {TOP COUNT UNIT TYPE "1\n2\nUSER1\n", "a.txt:9: value 3 'USER1' is not a number"},
    };
    struct reading *r = *state;
    for (size_t i = 0; i < sizeof c / sizeof c[0]; i++) {
        reading_of_text(r, c[i].text);
        assert_refused(r, c[i].message);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST_READING(a_whole_file_is_read),
        TEST_READING(what_is_no_acceleration_is_refused_by_its_name),
        TEST_READING(all_names_of_accelerations_are_read),
        TEST_READING(a_peak_that_the_header_does_not_state_is_warned_of),
        TEST_READING(headers_that_do_not_say_enough_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
