// SPDX-License-Identifier: GPL-3.0-or-later
// GeoNet files: components, what their headers say of the values, and what is refused. Reads
// tests/records/ from the top of the project.
#include "support/reading.h"
#include "support/support.h"

#define FILE_V2A "tests/records/good/geonet.V2A"

#define V1A_HEADER                                                                                 \
    "Uncorrected accelerogram X GNS Science\nSite\n\n\n\nAccelerogram\n\n\n\n"                     \
    "Number of points  12    Duration 0.06 s\n"                                                    \
    "Raw readings in units of 1.00 mm/s/s  at intervals of 0.005 s\n\nComponent Up\n"              \
    "Acceleration:  Peak -12000.5 mm/s/s at   0.01 s     RMS   1.00 mm/s/s\n"                      \
    "Velocity record unevaluated\nDisplacement record unevaluated\n\n\n\n"                         \
    "      12       0       0      12       0       0\n"                                           \
    "   200.0    0.70    0.00   0.000  0.0000   0.000   0.000   1.000\n\n"                         \
    "    0.06    0.00    0.00    0.06  0.0050  0.0050\n\n\n\n"

#define V1A                                                                                        \
    V1A_HEADER                                                                                     \
    " 12000.0-12000.5     2.0     3.0     4.0     5.0     6.0     7.0     8.0     9.0\n"           \
    "    10.0     0.1\n"

static void each_component_of_a_file_is_read(void **state) {
    struct reading *r = *state;
    for (int c = 0; c < 3; c++) {
        r->request.channel = c + 1;
        reading_of_file(r, FILE_V2A);
        assert_read(r, "geonet", 50, 0.02);
        assert_silent(r);
        assert_close(r->record.unit, 0.001, 1e-15);
        assert_waves(r, c, 100, 0.051);
    }
}

static void without_a_channel_the_components_are_listed(void **state) {
    struct reading *r = *state;
    reading_of_file(r, FILE_V2A);
    assert_refused(r, FILE_V2A ": 3 channels: 1 'N00E', 2 'N90E', 3 'Up'; -channel chooses one");
}

static void an_uncorrected_file_has_accelerations_alone(void **state) {
    struct reading *r = *state;
    reading_of_text(r, V1A);
    assert_read(r, "geonet", 12, 0.005);
    assert_close(r->record.value[0], 12000, 1e-15);
    assert_close(r->record.value[1], -12000.5, 1e-15);
    assert_close(r->record.value[11], 0.1, 1e-15);
    assert_close(r->record.peak, 12000.5, 1e-15);
}

static void another_peak_than_the_one_stated_is_warned_of(void **state) {
    struct reading *r = *state;
    r->request.channel = 1;
    reading_of_changed(r, FILE_V2A, "peak     85.9", "peak     95.9");
    assert_warned(r, "a.txt:14: the header states a largest acceleration of 95.9 mm/s/s; that of "
                     "the values is 85.9");
}

static void what_a_header_says_wrongly_is_refused(void **state) {
    static const struct {
        const char *from, *to, *message;
    } c[] = {
        {"points    50", "points    51", "a.txt:10: Number of points '51'; line 20 says 50"},
        {"points    50", "points", "a.txt:10: Number of points 'Duration'; line 20 says 50"},
        {"Duration   0.98", "Duration   1.96",
         "a.txt:10: Duration 1.96 s; the time step of 0.02 s (line 23) makes it 0.98"},
        {"Duration   0.98", "Duration   none", "a.txt:10: Duration 'none' is not a number"},
        {"0.0200  0.0200", "0.0200  0.0000", "a.txt:23: time step is 0.0000; it must be > 0"},
        {"0.0200  0.0200", "0.0200  0.02x0", "a.txt:23: time step '0.02x0' is not a number"},
        {"   1.000    0.00", "   2.000    0.00",
         "a.txt:21: a factor of 2 makes mm/s/s of the values; only files in mm/s/s are read"},
        {"Acceleration:", "Velocity:",
         "a.txt:14: the line has no 'Acceleration:  Peak' with its unit"},
        {"peak     85.9 mm/s/s", "peak     85.9 mm/s",
         "a.txt:14: 'mm/s' is not a unit of acceleration; give -unit U (g, m/s2, cm/s2, gal, ...)"},
        {"      50      50      50", "     5.5      50      50",
         "a.txt:20: number of accelerations is 5.5; it must be a whole number from 2 to 1e9"},
        {"      50      50      50", "      50      -1      50",
         "a.txt:20: number of velocities is -1; it must be a whole number >= 0"},
        {"      50      50      50", "      50      50       0",
         "a.txt:20: 10 lines follow the accelerations; 50 velocities and 0 displacements fill 5"},
    };
    struct reading *r = *state;
    r->request.channel = 1;
    for (size_t i = 0; i < sizeof c / sizeof c[0]; i++) {
        reading_of_changed(r, FILE_V2A, c[i].from, c[i].to);
        assert_refused(r, c[i].message);
    }
}

static void a_file_that_breaks_off_is_refused(void **state) {
    struct reading *r = *state;
    reading_of_text(r, "Corrected accelerogram X GNS Science\nSite\nNowhere\n");
    assert_refused(r, "a.txt:3: the file ends after 3 of the 26 lines of a header");
    reading_of_text(r, V1A_HEADER "     1.0\n");
    assert_refused(r, "a.txt:20: the line says 12 values; the file ends before");
    reading_of_text(r, V1A_HEADER "     1.0     2.0     3.0     4.0     5.0     6.0     7.0     8.0"
                                  "     9.0     0.0\n");
    assert_refused(r, "a.txt:27: the file ends after 10 values; line 20 says 12");
}

static void a_format_that_is_named_must_be_that_of_the_file(void **state) {
    struct reading *r = *state;
    r->request.format = "geonet";
    reading_of_text(r, "Corrected accelerogram\n");
    assert_refused(
        r, "a.txt: the file has no line 'Corrected accelerogram' or 'Uncorrected accelerogram' of "
           "'GNS Science'");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST_READING(each_component_of_a_file_is_read),
        TEST_READING(without_a_channel_the_components_are_listed),
        TEST_READING(an_uncorrected_file_has_accelerations_alone),
        TEST_READING(another_peak_than_the_one_stated_is_warned_of),
        TEST_READING(what_a_header_says_wrongly_is_refused),
        TEST_READING(a_file_that_breaks_off_is_refused),
        TEST_READING(a_format_that_is_named_must_be_that_of_the_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
