// SPDX-License-Identifier: GPL-3.0-or-later
// Records in the format knet. Reads tests/records/ from the top of the project.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>

#include "support/reading.h"
#include "support/support.h"

#define RATE "Sampling Freq(Hz) 100Hz\n"
#define DURATION "Duration Time(s)  0.04\n"
#define SCALE "Scale Factor      2000(gal)/1000\n"

static void counts_are_scaled_to_the_unit_of_the_file(void **state) {
    struct reading *r = *state;
    reading_of_text(r, RATE DURATION SCALE "Memo.\n  10  -20 \n  30   0 \n");
    assert_read(r, "knet", 4, 0.01);
    assert_silent(r);
    assert_close(r->record.unit, 0.01, 1e-15);
    assert_close(r->record.value[1], -40.0, 1e-15);
    assert_close(r->record.peak, 60.0, 1e-15);
}

// The file holds -12000 + 5000 exp(-i / 40) sin(2 pi i / 25) counts of 3920 gal / 6182761.
static void a_whole_file_is_read_with_its_offset(void **state) {
    struct reading *r = *state;
    const double scale = 3920.0 / 6182761.0;
    reading_of_file(r, "tests/records/good/knet.EW");
    assert_read(r, "knet", 100, 0.01);
    assert_int_equal(r->record.n_warning, 0);
    for (int i = 0; i < 100; i++) {
        const double wave = exp(-i / 40.0) * sin(2.0 * acos(-1.0) * i / 25.0);
        assert_close(r->record.value[i], scale * (round(5000.0 * wave) - 12000.0), 1e-14);
    }
    r->request.demean = true;
    reading_of_file(r, "tests/records/good/knet.EW");
    assert_silent(r);
    assert_true(fabs(r->record.peak - 2.609) <= 0.0005);  // as its header says
}

static void a_peak_that_the_header_does_not_state_is_warned_of(void **state) {
    struct reading *r = *state;
    reading_of_text(r, RATE DURATION SCALE "Max. Acc. (gal)   60.0\nMemo.\n110 80 130 80\n");
    assert_silent(r);
    reading_of_text(r, RATE DURATION SCALE "Max. Acc. (gal)   60.2\nMemo.\n110 80 130 80\n");
    assert_warned(r, "a.txt:4: the header states a largest acceleration of 60.2 gal; that of the "
                     "values, less their mean, is 60");
}

static void headers_that_do_not_say_enough_are_refused(void **state) {
    static const struct {
        const char *text, *message;
    } c[] = {
        {RATE "1 2\n", "a.txt: the file has no 'Memo.' in the first 32 lines; it ends the header "
                       "of a K-NET file"},
        {RATE SCALE "Memo.\n1 2\n", "a.txt: the header has no 'Duration Time(s)'"},
        {RATE DURATION "Memo.\n1 2\n", "a.txt: the header has no 'Scale Factor'"},
        {"Sampling Freq(Hz)\n" DURATION SCALE "Memo.\n1 2\n",
         "a.txt:1: Sampling Freq(Hz) is empty"},
        {"Sampling Freq(Hz) 1OOHz\n" DURATION SCALE "Memo.\n1 2\n",
         "a.txt:1: Sampling Freq(Hz) '1OO' is not a number"},
        {"Sampling Freq(Hz) 100Hzx\n" DURATION SCALE "Memo.\n1 2\n",
         "a.txt:1: Sampling Freq(Hz) '100Hzx' is not a number"},
        {"Sampling Freq(Hz) 0Hz\n" DURATION SCALE "Memo.\n1 2\n",
         "a.txt:1: Sampling Freq(Hz) is 0; it must be > 0"},
        {RATE "Duration Time(s)  0.015\n" SCALE "Memo.\n1 2\n",
         "a.txt:2: 0.015 s at 100 Hz are 1.5 values; they must be a whole number of at least 2"},
        {RATE DURATION "Scale Factor      2000\nMemo.\n1 2\n",
         "a.txt:3: Scale Factor '2000' is not of the form 3920(gal)/6182761"},
        {RATE DURATION "Scale Factor      2000(gal)/0\nMemo.\n1 2\n",
         "a.txt:3: Scale Factor is 0; it must be > 0"},
        {RATE DURATION "Scale Factor      1e300(gal)/1e-300\nMemo.\n1 2\n",
         "a.txt:3: Scale Factor '1e300(gal)/1e-300' is out of range"},
        {RATE DURATION "Scale Factor      2000(kine)/1000\nMemo.\n1 2 3 4\n",
         "a.txt:3: 'kine' is not a unit of acceleration; give -unit U (g, m/s2, cm/s2, gal, ...)"},
        {RATE DURATION SCALE "Max. Acc. (gal)   ---\nMemo.\n1 2 3 4\n",
         "a.txt:4: Max. Acc. (gal) '---' is not a number"},
    };
    struct reading *r = *state;
    for (size_t i = 0; i < sizeof c / sizeof c[0]; i++) {
        reading_of_text(r, c[i].text);
        assert_refused(r, c[i].message);
    }
}

static void a_file_of_another_length_than_its_header_says_is_refused(void **state) {
    struct reading *r = *state;
    reading_of_text(r, RATE DURATION SCALE "Memo.\n1 2\n3\n");
    assert_refused(r, "a.txt:6: the file ends after 3 values; its header (line 2) says 4");
    reading_of_text(r, RATE DURATION SCALE "Memo.\n1 2\n3 4 5\n");
    assert_refused(r, "a.txt:2: the header says 4 values; the file holds 5");
    reading_of_text(r, RATE DURATION SCALE "Memo.\n1 2\n3 x\n");
    assert_refused(r, "a.txt:6: value 4 'x' is not a number");
}

static void a_step_that_contradicts_the_rate_is_refused(void **state) {
    struct reading *r = *state;
    r->request.dt = 0.02;
    reading_of_text(r, RATE DURATION SCALE "Memo.\n1 2 3 4\n");
    assert_refused(r, "a.txt:1: -dt 0.02 contradicts the time step of 0.01 s in the file");
}

static void loads_are_not_read_from_it(void **state) {
    struct reading *r = *state;
    r->request.plain = true;
    r->request.format = "knet";
    reading_of_text(r, RATE DURATION SCALE "Memo.\n1 2 3 4\n");
    assert_refused(r, "a.txt: format knet holds accelerations only");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST_READING(counts_are_scaled_to_the_unit_of_the_file),
        TEST_READING(a_whole_file_is_read_with_its_offset),
        TEST_READING(a_peak_that_the_header_does_not_state_is_warned_of),
        TEST_READING(headers_that_do_not_say_enough_are_refused),
        TEST_READING(a_file_of_another_length_than_its_header_says_is_refused),
        TEST_READING(a_step_that_contradicts_the_rate_is_refused),
        TEST_READING(loads_are_not_read_from_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
