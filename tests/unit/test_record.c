// SPDX-License-Identifier: GPL-3.0-or-later
// What holds for records of any format: units, time steps, believable values, files by name. Reads
// tests/records/ and input/records/ from the top of the project.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "support/reading.h"
#include "support/support.h"

static void large_accelerations_raise_doubts_about_the_unit(void **state) {
    struct reading *r = *state;
    reading_of_text(r, PEER_TITLE "NPTS= 3, DT= .01 SEC\n1 500\n-400\n");
    assert_warned(r, "a.txt:5: the largest acceleration is 500 g; if the values are in another "
                     "unit, say so with -unit (cm/s2, m/s2, ...)");
    reading_of_text(r, PEER_TITLE "NPTS= 3, DT= .01 SEC\n1 2\n-500\n");
    assert_refused(r, "a.txt:6: value 3 is -500, that is 500 g; no ground acceleration is so "
                      "large");
    reading_of_text(r, PEER_TITLE "NPTS= 3, DT= .01 SEC\n1 2e5\n-2e5\n");
    assert_refused(r, "a.txt:5: value 2 is 200000, that is 2e+05 g; no ground acceleration is so "
                      "large");
    reading_of_text(r, PEER_TITLE "NPTS= 3, DT= .01 SEC\n1 4\n-4\n");
    assert_silent(r);
}

static void an_offset_that_leaves_a_velocity_is_said(void **state) {
    struct reading *r = *state;
    reading_of_text(r, PEER_TITLE "NPTS= 3, DT= .5 SEC\n.1 .1 .1\n");
    assert_warned(r,
                  "a.txt: the mean is 0.1 g, so that the ground is left with a velocity of "
                  "0.981 m/s; -demean subtracts the mean, or correct the baseline of the record");
}

static void demean_subtracts_the_mean_before_any_scaling(void **state) {
    struct reading *r = *state;
    r->request.demean = true;
    reading_of_text(r, PEER_TITLE "NPTS= 4, DT= .5 SEC\n.5 .75 .25 .5\n");
    assert_silent(r);
    assert_true(r->record.mean == 0.5 && r->record.peak == 0.25);
    assert_true(r->record.value[0] == 0 && r->record.value[1] == 0.25);
    assert_true(r->record.value[2] == -0.25 && r->record.value[3] == 0);
    reading_of_text(r, PEER_TITLE "NPTS= 3, DT= .5 SEC\n.1 .1 .1\n");
    assert_silent(r);
    assert_true(r->record.mean == 0.1 && r->record.peak == 0);
}

static void values_are_weighed_as_they_are_printed_before_demean(void **state) {
    struct reading *r = *state;
    r->request.demean = true;
    reading_of_text(r, PEER_TITLE "NPTS= 3, DT= .01 SEC\n500 501\n499\n");
    assert_warned(r, "a.txt:5: the largest acceleration is 501 g; if the values are in another "
                     "unit, say so with -unit (cm/s2, m/s2, ...)");
}

static void files_that_are_no_records_are_called_by_their_name(void **state) {
    static const struct {
        const char *text, *message;
    } c[] = {
        {"", "a.txt: the file is empty"},
        {"\n\n", "a.txt: unknown record format: no header with NPTS and DT, no line of numbers"},
        {"\n <!DOCTYPE html>\n1 2\n", "a.txt: this is an HTML or XML page, not a record"},
        {"version https://git-lfs.github.com/spec/v1\n1\n",
         "a.txt: this is a Git LFS pointer, not a record"},
        {"PK\x03\x04", "a.txt: this is a zip archive, not a record"},
        {"0 1\n\x1b 2\n", "a.txt: this is not text: byte 0x1b at offset 4"},
        {"4 DISPLACEMENT\n*\n1 2\n",
         "a.txt: looks like format SMC of displacements, which cannot be read yet"},
    };
    struct reading *r = *state;
    for (size_t i = 0; i < sizeof c / sizeof c[0]; i++) {
        reading_of_text(r, c[i].text);
        assert_refused(r, c[i].message);
    }
}

static void an_unknown_format_gets_the_nearest_name(void **state) {
    struct reading *r = *state;
    r->request.format = "colums";
    reading_of_text(r, "1\n2\n");
    assert_refused(
        r, "a.txt: unknown record format 'colums'; did you mean 'columns'?; available: "
           "knet, esm, afad, cwa, unam, csmip, cosmos, smc, geonet, renadic, bhrc, peer, series, "
           "columns");
}

static void a_zero_byte_in_the_text_is_refused(void **state) {
    struct reading *r = *state;
    struct record_text t = {"a.txt", "0 1\n\0 2\n", 8};
    r->status = record_read_text(r->arena, &r->request, &t, &r->record, &r->error);
    assert_refused(r, "a.txt: this is not text: byte 0x00 at offset 4");
}

static void files_with_oddities_are_read(void **state) {
    static const struct {
        const char *name, *format, *given_unit;
        double given_dt;
        size_t n, peak;
        double unit, value_at_peak, first, last;
        int n_warning;
    } c[] = {
        {"nga_npts_dt.AT2", "peer", NULL, 0, 1500, 600, 9.80665, .510799, .007098, .076254, 0},
        {"dos_eof.AT2", "peer", NULL, 0, 1500, 600, 9.80665, .510799, .007098, .076254, 0},
        {"7line_header.at2", "peer", NULL, 0, 1500, 600, 9.80665, .510799, .007098, .076254, 0},
        {"three_digit_exponent.AT2", "peer", NULL, 0, 1560, 660, 9.80665, .510799, 1.234567e-105,
         .076254, 0},
        {"8col_end_trailer.dat", "series", "g", 0.01, 1500, 600, 9.80665, .510799, .007098, .076254,
         0},
        {"twocol_comma_header.csv", "columns", NULL, 0, 1500, 600, 9.80665, .510799, .007098,
         .076254, 0},
        {"twocol_tab_cms2.txt", "columns", NULL, 0, 1500, 600, .01, 500.9227, 6.9608, 74.7796, 0},
        {"semicolon_rows.csv", "columns", "g", 0, 200, 100, 9.80665, .510799, -.030157, .031147, 0},
        {"negative_zero_and_denormal.AT2", "peer", NULL, 0, 205, 105, 9.80665, .510799, 0, .031147,
         0},
        {"touching.AT2", "peer", NULL, 0, 18, 12, 9.80665, -.05678, 0, 0, 0},
        {"semicolon_decimal_comma.csv", "columns", NULL, 0, 40, 3, 9.80665, .29925, 0, .18166, 0},
        {"csmip_8f9.V1", "csmip", NULL, 0, 20, 9, 9.80665, -2.5, 0, .012532, 0},
        {"all_zero.AT2", "peer", NULL, 0, 200, 0, 9.80665, 0, 0, 0, 0},
        {"big_offset.AT2", "peer", NULL, 0, 200, 100, 9.80665, .610799, .069843, .131147, 1},
        {"says_g_holds_cms2.AT2", "peer", NULL, 0, 200, 100, 9.80665, 500.9227, -29.57391, 30.54477,
         1},
    };
    struct reading *r = *state;
    for (size_t i = 0; i < sizeof c / sizeof c[0]; i++) {
        char path[128];
        snprintf(path, sizeof path, "tests/records/good/%s", c[i].name);
        r->request.unit = c[i].given_unit;
        r->request.dt = c[i].given_dt;
        reading_of_file(r, path);
        assert_read(r, c[i].format, c[i].n, 0.01);
        assert_close(r->record.unit, c[i].unit, 1e-15);
        assert_true(r->record.value[c[i].peak] == c[i].value_at_peak);
        assert_true(r->record.value[0] == c[i].first);
        assert_true(r->record.value[c[i].n - 1] == c[i].last);
        assert_int_equal(r->record.n_warning, c[i].n_warning);
    }
}

static void broken_files_are_refused_with_file_and_line(void **state) {
    static const struct {
        const char *name, *cause;
    } c[] = {
        {"truncated_mid_number.AT2",
         ":44: the file ends after 198 values; its header (line 4) says 200"},
        {"word_and_short.AT2", ":6: value 7 'abc' is not a number"},
        {"npts_too_small.AT2", ":4: the header says 150 values; the file holds 200"},
        {"npts_zero.AT2", ":4: NPTS is 0; it must be at least 2"},
        {"npts_fraction.AT2", ":4: NPTS is 200.5; it must be a whole number"},
        {"dt_missing.AT2", ":4: the file gives no time step; give -dt DT"},
        {"dt_garbled.AT2", ":4: DT '.O1OOO' is not a number"},
        {"dt_ten_seconds.AT2", ":4: a time step of 10 s is not believable for an accelerogram "
                               "(1e-05 to 1 s); confirm it with -dt 10"},
        {"nan_value.AT2", ":15: value 51 'NaN' is not a number"},
        {"value_too_big.AT2",
         ":15: value 51 is 1e+30, that is 1e+30 g; no ground acceleration is so large"},
        {"value_overflow.AT2", ":15: value 51 '.1000000E+999' is out of range: over 1.8e308"},
        {"velocity_file.VT2",
         ":3: this is not an acceleration: 'VELOCITY TIME HISTORY IN UNITS OF CM/S'"},
        {"time_goes_back.txt", ":101: time 0.5 after 0.99; times must increase"},
        {"time_gap.txt", ":91: step of 0.21 s to time 1.1; the first step is 0.01 s and steps must "
                         "be even"},
        {"three_columns.txt", ":1: 3 columns; -channel chooses a column after the times; "
                              "-format series reads values that run on from line to line"},
        {"overflow_stars.txt", ":9:6: value 6 '********' is an overflow of Fortran: the value did "
                               "not fit its field"},
        {"decimal_comma.txt", ":1: '0,000 -0,030157' has commas beside other separators; numbers "
                              "need a decimal point"},
    };
    struct reading *r = *state;
    for (size_t i = 0; i < sizeof c / sizeof c[0]; i++) {
        char path[128];
        char message[256];
        snprintf(path, sizeof path, "tests/records/bad/%s", c[i].name);
        snprintf(message, sizeof message, "%s%s", path, c[i].cause);
        reading_of_file(r, path);
        assert_refused(r, message);
    }
}

static void the_records_of_the_examples_are_read(void **state) {
    static const struct {
        const char *name;
        size_t n;
        double dt, pga;
    } c[] = {
        {"ELCENTRO_1940_NS.AT2", 1559, 0.02, 0.3188},
        {"RIDGECREST_2019_CLC_360.AT2", 6000, 0.01, 0.511},
        {"RIDGECREST_2019_CLC_090.AT2", 6000, 0.01, 0.344},
        {"NAPA_2014_68150_HNE.AT2", 6997, 0.005, 0.373},
        {"NAPA_2014_68150_HNN.AT2", 6997, 0.005, 0.339},
    };
    struct reading *r = *state;
    for (size_t i = 0; i < sizeof c / sizeof c[0]; i++) {
        char path[128];
        snprintf(path, sizeof path, "input/records/%s", c[i].name);
        reading_of_file(r, path);
        assert_read(r, "peer", c[i].n, c[i].dt);
        assert_silent(r);
        double peak = 0;
        for (size_t k = 0; k < r->record.n; k++) {
            peak = fmax(peak, fabs(r->record.value[k]));
        }
        assert_close(peak, c[i].pga, 2e-3);  // printed with three digits in NOTICE.md
    }
}

static char directory[] = "/tmp/jostle record XXXXXX";

static int make_directory(void **state) {
    (void)state;
    return mkdtemp(directory) ? 0 : -1;
}

static int remove_directory(void **state) {
    (void)state;
    return rmdir(directory);
}

static void what_is_no_regular_file_is_refused_without_waiting(void **state) {
    struct reading *r = *state;
    char path[128];
    alarm(20);
    reading_of_file(r, directory);
    assert_int_equal(r->status, STATUS_INPUT);
    assert_non_null(strstr(r->error.message, "is a directory"));
    snprintf(path, sizeof path, "%s/pipe", directory);
    assert_int_equal(mkfifo(path, 0600), 0);
    reading_of_file(r, path);
    unlink(path);
    assert_int_equal(r->status, STATUS_INPUT);
    assert_non_null(strstr(r->error.message, "pipe"));
    reading_of_file(r, "/dev/zero");
    assert_int_equal(r->status, STATUS_INPUT);
    assert_non_null(strstr(r->error.message, "/dev/zero"));
    snprintf(path, sizeof path, "%s/absent.AT2", directory);
    reading_of_file(r, path);
    assert_int_not_equal(r->status, STATUS_OK);
    assert_non_null(strstr(r->error.message, "absent.AT2"));
    reading_of_file(r, "");
    assert_int_not_equal(r->status, STATUS_OK);
    alarm(0);
}

static void file_names_may_be_long_and_hold_blanks_and_letters(void **state) {
    static const char *const names[] = {"with blank.txt", "-dash.txt",
                                        "Erdbeben-\xc3\xa4\xe2\x82\xac"};
    char longest[256];
    memset(longest, 'n', 255);
    longest[255] = '\0';
    struct reading *r = *state;
    r->request.unit = "g";
    for (size_t i = 0; i < 4; i++) {
        char path[512];
        snprintf(path, sizeof path, "%s/%s", directory, i < 3 ? names[i] : longest);
        FILE *f = fopen(path, "w");
        assert_non_null(f);
        fputs("0 0\n.01 .5\n.03 0\n", f);
        assert_int_equal(fclose(f), 0);
        reading_of_file(r, path);
        unlink(path);
        assert_int_equal(r->status, STATUS_INPUT);
        assert_non_null(strstr(r->error.message, i < 3 ? path : "nnnn:3: step of 0.02 s"));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST_READING(large_accelerations_raise_doubts_about_the_unit),
        TEST_READING(an_offset_that_leaves_a_velocity_is_said),
        TEST_READING(demean_subtracts_the_mean_before_any_scaling),
        TEST_READING(values_are_weighed_as_they_are_printed_before_demean),
        TEST_READING(files_that_are_no_records_are_called_by_their_name),
        TEST_READING(an_unknown_format_gets_the_nearest_name),
        TEST_READING(a_zero_byte_in_the_text_is_refused),
        TEST_READING(files_with_oddities_are_read),
        TEST_READING(broken_files_are_refused_with_file_and_line),
        TEST_READING(the_records_of_the_examples_are_read),
        TEST_READING(what_is_no_regular_file_is_refused_without_waiting),
        TEST_READING(file_names_may_be_long_and_hold_blanks_and_letters),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
