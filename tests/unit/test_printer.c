// SPDX-License-Identifier: GPL-3.0-or-later
// One table in all forms: alignment and units of text, cells and quotes of data.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "command/printer.h"
#include "support/support.h"

static const struct printer_column columns[] = {
    {.head = "name", .key = "name", .width = -6},
    {.head = "force", .key = "force", .unit = "kN", .width = 8, .digits = 3},
    COLUMN_DATA("run"),
    {.head = "note", .key = "note"}};

// The table, printed in this form, is the text.
static void assert_prints(struct printer t, const char *text) {
    char *got;
    size_t size;
    t.to = open_memstream(&got, &size);
    assert_non_null(t.to);
    PRINTER_ADD(&t, columns);
    printer_head(&t);
    printer_text(&t, "A");
    printer_number(&t, 1234.5678);
    printer_whole(&t, 7);
    printer_text(&t, "a\t\"b\",\033");
    printer_line(&t);
    printer_text(&t, "Süd 12");
    printer_number(&t, NAN);
    printer_sign(&t, -1);
    printer_line(&t);
    assert_int_equal(printer_close(&t), EXIT_DONE);
    fclose(t.to);
    assert_string_equal(got, text);
    free(got);
}

static void text_is_aligned_and_no_line_ends_in_a_blank(void **state) {
    (void)state;
    assert_prints((struct printer){.form = FORM_TEXT}, "name   force [kN]  note\n"
                                                       "A      1.23e+03  a \"b\",?\n"
                                                       "Süd 12        -\n");
}

static void units_stand_below_where_the_table_says_so(void **state) {
    (void)state;
    assert_prints((struct printer){.form = FORM_TEXT, .at_head = UNITS_BELOW, .indent = 2},
                  "  name      force  note\n"
                  "             [kN]\n"
                  "  A      1.23e+03  a \"b\",?\n"
                  "  Süd 12        -\n");
}

static void tsv_has_all_digits_and_no_control_characters(void **state) {
    (void)state;
    assert_prints((struct printer){.form = FORM_TSV}, "name\tforce [kN]\trun\tnote\n"
                                                      "A\t1234.5678\t7\ta \"b\", \n"
                                                      "Süd 12\tnan\t\t\n");
}

static void csv_quotes_where_rfc_4180_asks_for_it(void **state) {
    (void)state;
    assert_prints((struct printer){.form = FORM_CSV}, "name,force [kN],run,note\n"
                                                      "A,1234.5678,7,\"a\t\"\"b\"\", \"\n"
                                                      "Süd 12,nan,,\n");
}

static void json_has_null_for_what_is_missing(void **state) {
    (void)state;
    assert_prints((struct printer){.form = FORM_JSON},
                  "{\"columns\": [\"name\", \"force [kN]\", \"run\", \"note\"],\n"
                  "\"data\": [\n"
                  "[\"A\", 1234.5678, 7, \"a\\u0009\\\"b\\\",\\u001b\"],\n"
                  "[\"Süd 12\", null, null, null]\n"
                  "]}\n");
}

static void a_number_to_be_read_has_no_power_of_ten_below_a_million(void **state) {
    static const struct {
        double value;
        const char *text;
    } cases[] = {
        {0.00123456, "0.001235"}, {9999.4, "9999"}, {36625.4, "36625"}, {-123456.7, "-123457"},
        {999999, "999999"},       {1e6, "1e+06"},   {NAN, "-"}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[32];
        printer_read(cases[i].value, 4, text, sizeof text);
        assert_string_equal(text, cases[i].text);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text_is_aligned_and_no_line_ends_in_a_blank),
        cmocka_unit_test(units_stand_below_where_the_table_says_so),
        cmocka_unit_test(tsv_has_all_digits_and_no_control_characters),
        cmocka_unit_test(csv_quotes_where_rfc_4180_asks_for_it),
        cmocka_unit_test(a_number_to_be_read_has_no_power_of_ten_below_a_million),
        cmocka_unit_test(json_has_null_for_what_is_missing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
