// SPDX-License-Identifier: GPL-3.0-or-later
// Records in formats with channels side by side, afad, cwa and unam. Reads tests/records/ from the
// top of the project.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "support/reading.h"
#include "support/support.h"

#define UNAM "tests/records/good/unam.txt"

static void each_channel_of_a_file_is_read(void **state) {
    struct reading *r = *state;
    for (int c = 0; c < 3; c++) {
        r->request.channel = c + 1;
        reading_of_file(r, "tests/records/good/afad.txt");
        assert_read(r, "afad", 50, 0.01);
        assert_silent(r);
        assert_close(r->record.unit, 0.01, 1e-15);
        assert_waves(r, c, 100, 5.1e-7);
        reading_of_file(r, "tests/records/good/cwa.dat");
        assert_read(r, "cwa", 50, 0.02);
        assert_silent(r);
        assert_close(r->record.unit, 0.01, 1e-15);
        assert_waves(r, c, 100, 5.1e-4);
        reading_of_file(r, UNAM);
        assert_read(r, "unam", 50, 0.004);
        assert_silent(r);
        assert_close(r->record.unit, 0.01, 1e-15);
        assert_waves(r, c, 100, 5.1e-4);
    }
}

static void without_a_channel_there_is_a_list(void **state) {
    struct reading *r = *state;
    reading_of_file(r, "tests/records/good/afad.txt");
    assert_refused(r, "tests/records/good/afad.txt: 3 channels: 1 'N-S', 2 'E-W', 3 'U-D'; "
                      "-channel chooses one");
    assert_int_equal(r->record.wrong, RECORD_PATH);
    r->request.channel = 4;
    reading_of_file(r, "tests/records/good/cwa.dat");
    assert_refused(
        r, "tests/records/good/cwa.dat: the file has no channel 4; available: 1 'U', 2 'N', "
           "3 'E'");
    assert_int_equal(r->record.wrong, RECORD_CHANNEL);
}

static void formats_of_one_channel_refuse_to_be_asked(void **state) {
    struct reading *r = *state;
    r->request.channel = 1;
    reading_of_text(r, PEER_TITLE "NPTS= 2, DT= .01 SEC\n.1 -.1\n");
    assert_refused(r, "a.txt: a file of format peer has one channel; remove -channel");
    assert_int_equal(r->record.wrong, RECORD_CHANNEL);
}

#define AFAD "STRONG GROUND MOTION RECORDS OF TURKIYE\n"
#define COUNT "NUMBER OF DATA          : 2\n"
#define STEP "SAMPLING INTERVAL (sec) : 0.01\n"
#define PEAKS "RAW PGA VALUES (gal)    : (N-S) 3.0 (E-W) 4.0 (U-D) 5.0\n"
#define NAMES "   N-S  E-W  U-D\n"

static void wrong_afad_files_are_refused(void **state) {
    static const struct {
        const char *text, *message;
    } c[] = {
        {AFAD COUNT STEP PEAKS "1 2 3\n",
         "a.txt: the file has no line 'N-S E-W U-D' in the first 32 lines; it "
         "ends the header of an AFAD file"},
        {AFAD STEP PEAKS NAMES "1 2 3\n4 5 6\n", "a.txt: the header has no 'NUMBER OF DATA'"},
        {AFAD COUNT PEAKS NAMES "1 2 3\n4 5 6\n",
         "a.txt: the header has no 'SAMPLING INTERVAL (sec)'"},
        {AFAD COUNT STEP NAMES "1 2 3\n4 5 6\n", "a.txt: the header has no 'RAW PGA VALUES (gal)'"},
        {AFAD COUNT STEP PEAKS NAMES "1 2 3\n",
         "a.txt:6: the file ends after 1 rows; its header (line 2) says 2"},
        {AFAD COUNT STEP PEAKS NAMES "1 2 3\n4 5 6\n7 8 9\n",
         "a.txt:2: the header says 2 rows; the file holds 3"},
        {AFAD COUNT STEP PEAKS NAMES "1 2 3\n4 5\n", "a.txt:7: row of 2 values; the header says 3"},
        {AFAD COUNT STEP PEAKS NAMES "1 2 3\n4 5 6x\n", "a.txt:7: value 2 '6x' is not a number"},
    };
    struct reading *r = *state;
    r->request.channel = 1;
    for (size_t i = 0; i < sizeof c / sizeof c[0]; i++) {
        reading_of_text(r, c[i].text);
        assert_refused(r, c[i].message);
    }
}

static void the_peak_of_the_channel_is_compared(void **state) {
    struct reading *r = *state;
    const char *text = AFAD COUNT STEP PEAKS NAMES "1 2 -5\n-3 6 4\n";
    r->request.channel = 1;
    reading_of_text(r, text);
    assert_silent(r);
    r->request.channel = 3;
    reading_of_text(r, text);
    assert_silent(r);
    r->request.channel = 2;
    reading_of_text(r, text);
    assert_warned(r, "a.txt:4: the header states a largest acceleration of 4 gal; that of the "
                     "values is 6");
}

#define CWA "#Earthquake Information\n"
#define LENGTH "#RecordLength(sec): 0.04\n"
#define RATE "#SampleRate(Hz): 50\n"
#define UNIT "#AmplitudeUnit:  gal. DCoffset(corr)\n"
#define SEQUENCE "#DataSequence: Time U(+); N(+)\n"
#define DATA "#Data: 3F10.3\n"

static void wrong_cwa_files_are_refused(void **state) {
    static const struct {
        const char *text, *message;
    } c[] = {
        {CWA LENGTH RATE UNIT SEQUENCE "0 1 2\n",
         "a.txt: the file has no '#Data:' in the first 64 lines; it ends the header of a CWA file"},
        {CWA RATE UNIT SEQUENCE DATA "0 1 2\n", "a.txt: the header has no '#RecordLength(sec)'"},
        {CWA LENGTH UNIT SEQUENCE DATA "0 1 2\n", "a.txt: the header has no '#SampleRate(Hz)'"},
        {CWA LENGTH RATE SEQUENCE DATA "0 1 2\n", "a.txt: the header has "
                                                  "no '#AmplitudeUnit'"},
        {CWA LENGTH RATE UNIT DATA "0 1 2\n", "a.txt: the header has no '#DataSequence'"},
        {CWA LENGTH RATE UNIT "#DataSequence: U(+); N(+)\n" DATA "0 1 2\n",
         "a.txt:5: #DataSequence 'U(+); N(+)' is not of the form Time U(+); N(+); E(+)"},
        {CWA LENGTH RATE "#AmplitudeUnit:  count.\n" SEQUENCE DATA "0 1 2\n.02 3 4\n",
         "a.txt:4: 'count' is not a unit of acceleration; give -unit U (g, m/s2, cm/s2, gal, ...)"},
        {CWA LENGTH RATE UNIT SEQUENCE DATA "0 1 2\n.03 3 4\n",
         "a.txt:8: time 0.03; the header's step of 0.02 s makes it 0.02"},
        {CWA LENGTH RATE UNIT SEQUENCE DATA "0 1 2\n.02 3 4 5\n",
         "a.txt:8: row of 4 values; the header says 3"},
        {CWA LENGTH RATE UNIT "#AmplitudeMAX. U:  x~ 1\n" SEQUENCE DATA "0 1 2\n.02 3 4\n",
         "a.txt:5: #AmplitudeMAX. U 'x' is not a number"},
    };
    struct reading *r = *state;
    r->request.channel = 1;
    for (size_t i = 0; i < sizeof c / sizeof c[0]; i++) {
        reading_of_text(r, c[i].text);
        assert_refused(r, c[i].message);
    }
}

static void wrong_unam_files_are_refused(void **state) {
    static const struct {
        const char *from, *to, *message;
    } c[] = {
        {": 2.0", ": 1.0", "a.txt:5: VERSION DEL FORMATO is 1.0; only 2 can be read"},
        {": 2.0", ":", "a.txt:5: VERSION DEL FORMATO is empty"},
        {": 1\r", ": 2\r", "a.txt:25: FACTOR DE DECIMACION is 2; only 1 can be read"},
        {": 3\r", ": 4\r",
         "a.txt:10: NUMERO DE CANALES is 4; it must be at most 6, and 3 are named above the "
         "values"},
        {"/250/250", "/250",
         "a.txt:13: VEL. DE MUESTREO, C1-C6 (muestras/s) '/250/250' has no "
         "value of channel 3"},
        {"/250/250/250", "250/250/250",
         "a.txt:13: VEL. DE MUESTREO, C1-C6 (muestras/s) '250/250/250' has no value of channel 3"},
        {"/250/250/250", "/250/250/200",
         "a.txt:15: a time step of 0.004 s; 200 samples a second make it 0.005 s"},
        {"0.004/0.004\r", "0.004/0\r",
         "a.txt:15: INTERVALO DE MUESTREO, C1-C6 (s) is 0; it must be > 0"},
        {"/50/50/50", "/50/50/48", "a.txt:20: the header says 48 rows; the file holds 50"},
        {"/50/50/50", "/50/50/52",
         "a.txt:87: the file ends after 50 rows; its header (line 20) says 52"},
        {"/50/50/50", "/50/50/1",
         "a.txt:20: NUM. TOTAL DE MUESTRAS, C1-C6 is 1; it must be a "
         "whole number from 2 to 1e9"},
        {": Gal (", ": m/s (",
         "a.txt:24: 'm/s' is not a unit of acceleration; give -unit U (g, m/s2, cm/s2, gal, ...)"},
        {"N00E\r\n---", "N00E\r\n1 2",
         "a.txt: the file has no 'DATOS DE ACELERACION:' with four lines, the last a rule, in the "
         "first 200 "
         "lines; it ends the header of a UNAM file"},
    };
    struct reading *r = *state;
    r->request.channel = 3;
    for (size_t i = 0; i < sizeof c / sizeof c[0]; i++) {
        reading_of_changed(r, UNAM, c[i].from, c[i].to);
        assert_refused(r, c[i].message);
    }
}

static void rows_that_fill_up_are_read_with_a_warning(void **state) {
    struct reading *r = *state;
    r->request.channel = 1;
    reading_of_text(r, AFAD COUNT STEP PEAKS NAMES "1 2 3\n3 4 5\n3 4 5\n3 4 5\n");
    assert_read(r, "afad", 4, 0.01);
    assert_warned(r,
                  "a.txt:2: the header says 2 rows; the file holds 2 more, which repeat the last "
                  "of them and are read too");
    reading_of_text(r, AFAD COUNT STEP PEAKS NAMES "1 2 3\n3 4 5\n3 4 5\n3 4 6\n");
    assert_refused(r, "a.txt:2: the header says 2 rows; the file holds 4");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST_READING(each_channel_of_a_file_is_read),
        TEST_READING(without_a_channel_there_is_a_list),
        TEST_READING(formats_of_one_channel_refuse_to_be_asked),
        TEST_READING(wrong_afad_files_are_refused),
        TEST_READING(the_peak_of_the_channel_is_compared),
        TEST_READING(wrong_cwa_files_are_refused),
        TEST_READING(wrong_unam_files_are_refused),
        TEST_READING(rows_that_fill_up_are_read_with_a_warning),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
