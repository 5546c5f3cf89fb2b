// SPDX-License-Identifier: GPL-3.0-or-later
// CSMIP/CGS volume 1 and 2: channels, fields of a fixed width, and what is refused.
#include <string.h>

#include "support/reading.h"
#include "support/support.h"

#define VOLUME_1(name, peak, title, values)                                                        \
    "Uncorrected Accelerogram Data\r\nMade up\r\n" name "\r\nMax  =  " peak " g, at .03 sec.\r\n"  \
    "    1  100\r\n  .0050000-999.00000\r\n" title "\r\n" values                                   \
    "/&  ----------  End of Data for Channel  1  ----------\r\n"

#define TITLE " 5 Accelerogram points at 100 pts/sec in units of g.   Format: (3f9.6)"
#define VALUES " -.125000 -.250000-1.500000\r\n  .000001  .000002\r\n"

#define VOLUME_2                                                                                   \
    "CORRECTED ACCELEROGRAM  CHAN  1: UP   FROM\nUNCORRECTED ACCELEROGRAM DATA\nCHAN  1: UP\n"     \
    "UNCOR MAX  =  -.275 G, AT  10.947 SEC.\nPEAK ACCELERATION =  -267.957    CM/SEC/SEC\n"        \
    " 3 POINTS OF ACCEL DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: CM/SEC/SEC)\n"                  \
    "    -3.038     -.787  -267.957\n"                                                             \
    " 3 POINTS OF VELOC DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: CM/SEC)\n"                      \
    "     1.000     1.000   900.000\n"

static void volume_1_is_read_by_the_width_of_its_fields(void **state) {
    struct reading *r = *state;
    reading_of_text(r, VOLUME_1("Chan  1:  90 Deg", "1.500", TITLE, VALUES));
    assert_read(r, "csmip", 5, 0.01);
    assert_close(r->record.unit, 9.80665, 1e-15);
    assert_close(r->record.value[1], -0.25, 1e-15);
    assert_close(r->record.value[2], -1.5, 1e-15);
    assert_close(r->record.value[4], 2e-6, 1e-15);
    assert_close(r->record.peak, 1.5, 1e-15);
}

static void fields_touch_where_none_has_a_sign(void **state) {
    struct reading *r = *state;
    reading_of_text(r, VOLUME_1("Chan 1: Up", "3.500",
                                " 3 Accelerogram points at 100 pts/sec in units of g. (3f9.7)",
                                "1.12500002.25000003.5000000\r\n"));
    assert_read(r, "csmip", 3, 0.01);
    assert_close(r->record.value[0], 1.125, 1e-15);
    assert_close(r->record.value[1], 2.25, 1e-15);
    assert_close(r->record.value[2], 3.5, 1e-15);
}

static void a_format_may_lack_its_decimals_and_its_brackets(void **state) {
    static const char *const format[] = {"(3F9)", "3F9.6", "(3f9.6)", "[3E9.2]"};
    struct reading *r = *state;
    for (size_t i = 0; i < sizeof format / sizeof format[0]; i++) {
        char text[512];
        snprintf(text, sizeof text,
                 VOLUME_1("Chan 1: Up", "3.500",
                          " 3 Accelerogram points at 100 pts/sec in units of g. Format: %s",
                          "1.12500002.25000003.5000000\r\n"),
                 format[i]);
        reading_of_text(r, text);
        assert_read(r, "csmip", 3, 0.01);
        assert_silent(r);
        assert_close(r->record.value[1], 2.25, 1e-15);
    }
}

static void volume_2_is_read_without_its_velocities(void **state) {
    struct reading *r = *state;
    reading_of_text(r, VOLUME_2);
    assert_read(r, "csmip", 3, 0.02);
    assert_close(r->record.unit, 0.01, 1e-15);
    assert_close(r->record.value[2], -267.957, 1e-15);
}

static void volume_2_of_usc_is_read(void **state) {
    static const char text[] =
        "CORRECTED ACCELEROGRAM  A1 COMP N08W   FILE   0  CORRESPONDING T\nFILE     0 OF "
        "UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:\n\nUNITS ARE SEC AND G/10\n"
        "PEAK ACCELERATION =  -242.39450  CMS/SEC/SEC AT    4.580   SEC.\nA1   COMP N08\nW\n"
        "     3 POINTS OF ACC DATA EQUALLY SPACED AT   .020 SEC.  IN UNITS CM/SEC/SEC\n"
        "    -1.133     -.596   242.395\n"
        "     3 POINTS OF VEL DATA EQUALLY SPACED AT   .020 SEC.  IN UNITS CM/SEC\n"
        "     1.000     1.000   900.000\n";
    struct reading *r = *state;
    reading_of_text(r, text);
    assert_read(r, "csmip", 3, 0.02);
    assert_silent(r);
    assert_close(r->record.unit, 0.01, 1e-15);
    assert_close(r->record.value[2], 242.395, 1e-15);
    r->request.channel = 2;
    reading_of_text(r, text);
    assert_refused(r, "a.txt: the file has no channel 2; available: 1 'N08W'");
}

static void later_volume_2_parts_the_unit_by_a_comma(void **state) {
    struct reading *r = *state;
    reading_of_text(r,
                    "Corrected accelerogram\n 2 points of accel data equally spaced at  .005 sec, "
                    "in cm/sec2.\n     1.000    -2.000\n");
    assert_read(r, "csmip", 2, 0.005);
    assert_close(r->record.unit, 0.01, 1e-15);
}

static void a_channel_is_chosen_by_its_place(void **state) {
    static const char two[] = VOLUME_1("Chan  7:  90 Deg", "1.500", TITLE, VALUES)
        VOLUME_1("Chan  8:  Up", ".500",
                 " 2 Accelerogram points at 50 pts/sec in units of g.   Format: (8f9.6)",
                 "  .500000  .100000\r\n");
    struct reading *r = *state;
    reading_of_text(r, two);
    assert_refused(r, "a.txt: 2 channels: 1 'Chan  7:  90 Deg', 2 'Chan  8:  Up'; -channel chooses "
                      "one");
    r->request.channel = 2;
    reading_of_text(r, two);
    assert_read(r, "csmip", 2, 0.02);
    assert_close(r->record.value[0], 0.5, 1e-15);
    r->request.channel = 3;
    reading_of_text(r, two);
    assert_refused(
        r, "a.txt: the file has no channel 3; available: 1 'Chan  7:  90 Deg', 2 'Chan  8:  "
           "Up'");
}

static void another_peak_than_the_one_stated_is_warned_of(void **state) {
    struct reading *r = *state;
    reading_of_text(r, VOLUME_1("Chan 1: Up", ".900", TITLE, VALUES));
    assert_warned(r,
                  "a.txt:4: the header states a largest acceleration of 0.9 g; that of the values "
                  "is 1.5");
}

static void what_a_file_says_wrongly_is_refused(void **state) {
    static const struct {
        const char *text, *message;
    } c[] = {
        {VOLUME_1("Chan 1: Up", "high", TITLE, VALUES), "a.txt:4: peak 'high' is not a number"},
        {VOLUME_1("Chan 1: Up", "1.500", TITLE, " -.125000 -.250000-1.500000\r\n  .000001\r\n"),
         "a.txt:9: value 5 is empty"},
        {VOLUME_1("Chan 1: Up", "1.500", TITLE, " -.125000 -.250000-1.500000\r\n"),
         "a.txt:9: value 4 '/&  -----' is not a number"},
        {VOLUME_1("Chan 1: Up", "1.500", TITLE, VALUES "  .000003\r\n"),
         "a.txt:10: more than the 5 values that the header states"},
        {VOLUME_1("Chan 1: Up", "1.500", TITLE, " -.125000 -.250000-1.500000 9\r\n  .000001\r\n"),
         "a.txt:8: '9' follows the last value of the line"},
        {VOLUME_1("Chan 1: Up", "1.500", TITLE, " -.125000 -.2 0000-1.500000\r\n  .000001\r\n"),
         "a.txt:8: value 2 ' -.2 0000' is not a number"},
        {VOLUME_1("Chan 1: Up", "1.500",
                  " 5000 Accelerogram points at 100 pts/sec in units of g. Format: (3f9.6)",
                  VALUES),
         "a.txt:7: the line says 5000 values; the file ends before"},
        {VOLUME_1("Chan 1: Up", "1.500",
                  " 5 Accelerogram points at 0 pts/sec in units of g. Format: (3f9.6)", VALUES),
         "a.txt:7: the number after AT is 0; it must be > 0"},
        {VOLUME_1("Chan 1: Up", "1.500", " 5 Accelerogram points at 100 pts/sec in units of g.",
                  VALUES),
         "a.txt:7: the line has no format such as (8F9.6)"},
        {VOLUME_1("Chan 1: Up", "1.500",
                  " 5.5 Accelerogram points at 100 pts/sec in units of g. (3f9.6)", VALUES),
         "a.txt:7: number of values is 5.5; it must be a whole number from 2 to 1e9"},
    };
    struct reading *r = *state;
    for (size_t i = 0; i < sizeof c / sizeof c[0]; i++) {
        reading_of_text(r, c[i].text);
        assert_refused(r, c[i].message);
    }
}

static void a_file_that_breaks_off_is_refused(void **state) {
    struct reading *r = *state;
    reading_of_text(r,
                    "CORRECTED ACCELEROGRAM\n 9 POINTS OF ACCEL DATA EQUALLY SPACED AT .02 SEC. "
                    "(UNITS: CM/SEC/SEC)\n     1.000     2.000     3.000     4.000     5.000     "
                    "6.000     7.000     8.000\n");
    assert_refused(r, "a.txt:3: the file ends after 8 values; line 2 says 9");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST_READING(volume_1_is_read_by_the_width_of_its_fields),
        TEST_READING(fields_touch_where_none_has_a_sign),
        TEST_READING(a_format_may_lack_its_decimals_and_its_brackets),
        TEST_READING(volume_2_is_read_without_its_velocities),
        TEST_READING(volume_2_of_usc_is_read),
        TEST_READING(later_volume_2_parts_the_unit_by_a_comma),
        TEST_READING(a_channel_is_chosen_by_its_place),
        TEST_READING(another_peak_than_the_one_stated_is_warned_of),
        TEST_READING(what_a_file_says_wrongly_is_refused),
        TEST_READING(a_file_that_breaks_off_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
