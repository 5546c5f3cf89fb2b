// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers, characters, near words, files, and messages.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/text.h"
#include "support/support.h"

static void numbers_are_read_up_to_their_last_character(void **state) {
    (void)state;
    const struct {
        const char *text;
        double value;
        const char *rest;
    } cases[] = {
        {"1", 1, ""},       {"-2.5e3x", -2500, "x"}, {".5", 0.5, ""},    {"5.", 5, ""},
        {"1e", 1, "e"},     {"1e+", 1, "e+"},        {"0x10", 0, "x10"}, {"+3,4", 3, ",4"},
        {"20mm", 20, "mm"}, {"1..2", 1, ".2"},       {"1e-400", 0, ""},  {"-0x1p3", 0, "x1p3"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const char *end;
        double value;
        assert_int_equal(text_number(cases[i].text, &end, &value), TEXT_NUMBER_OK);
        assert_true(value == cases[i].value);
        assert_string_equal(end, cases[i].rest);
    }
}

// Of 1 to 19 digits, with a point anywhere and exponents of -30 to 30, so that some take one
// operation and some the library. The tests run in the C locale, so that strtod is the truth.
static void numbers_are_the_doubles_nearest_to_their_texts(void **state) {
    (void)state;
    enum { TEXTS = 200000, DIGITS = 19 };
    unsigned long long seed = 1;
    for (int i = 0; i < TEXTS; i++) {
        char text[64] = "-";
        size_t n = i % 3 == 0;
        int digits = 1 + i % DIGITS, point = i / DIGITS % (digits + 1);
        for (int j = 0; j < digits; j++) {
            seed = 6364136223846793005ULL * seed + 1442695040888963407ULL;  // Knuth's MMIX
            text[n] = '.';
            n += j == point;
            text[n++] = (char)('0' + (seed >> 33) % 10 * (j > i % 5));
        }
        text[n] = '\0';
        int exponent = (int)((seed >> 40) % 61) - 30;
        if (i % 4 > 0) {
            snprintf(text + n, sizeof text - n, i % 4 == 1 ? "e%d" : "E%+d", exponent);
        }
        const char *end;
        double value;
        double truth = strtod(text, NULL);
        assert_int_equal(text_number(text, &end, &value), TEXT_NUMBER_OK);
        assert_int_equal(*end, '\0');
        assert_memory_equal(&value, &truth, sizeof value);
    }
}

static void what_is_no_finite_number_is_told_apart(void **state) {
    (void)state;
    const char *const none[] = {"", ".", "-", "e5", "nan", "inf", "-infinity", "+.e1", " 1"};
    const char *end;
    double value;
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++) {
        assert_int_equal(text_number(none[i], &end, &value), TEXT_NUMBER_NONE);
        assert_ptr_equal(end, none[i]);
    }
    assert_int_equal(text_number("1e999m", &end, &value), TEXT_NUMBER_RANGE);
    assert_string_equal(end, "m");
}

static void the_nearest_word_is_found_within_a_third_of_the_letters(void **state) {
    (void)state;
    const char *const known[] = {"hertz", "linear", "kelvin-voigt", "MPa", "k1"};
    assert_string_equal(text_nearest("herz", known, 5), "hertz");
    assert_string_equal(text_nearest("hretz", known, 5), "hertz");
    assert_string_equal(text_nearest("LINEAR", known, 5), "linear");
    assert_string_equal(text_nearest("kelvin_voight", known, 5), "kelvin-voigt");
    assert_string_equal(text_nearest("mpa", known, 5), "MPa");
    assert_null(text_nearest("h", known, 5));
    assert_null(text_nearest("", known, 5));
    assert_null(text_nearest("wang", known, 5));
}

static void a_word_is_near_the_only_one_that_goes_on_where_it_ends(void **state) {
    (void)state;
    const char *const known[] = {"kelvin-voigt", "ye-kelvin", "ye-hertz-damp", "-mass"};
    assert_string_equal(text_nearest("kelvin", known, 4), "kelvin-voigt");
    assert_string_equal(text_nearest("-mass=300t", known, 4), "-mass");
    assert_null(text_nearest("ye-", known, 4));
    assert_null(text_nearest("ke", known, 4));
    assert_null(text_nearest("-massive", known, 4));
}

static void columns_count_characters(void **state) {
    (void)state;
    assert_int_equal(text_columns("Stoß", strlen("Stoß")), 4);
    assert_int_equal(text_columns("\xFF\xFE"
                                  "a",
                                  3),
                     3);
    assert_int_equal(text_columns("abc", 0), 0);
}

static void only_well_formed_utf8_is_text(void **state) {
    (void)state;
    const struct {
        const char *text;
        int wrong;  // offset of the first wrong byte; -1: none
    } cases[] = {
        {"plain", -1},     {"\xC3\xA9", -1},    {"\xF0\x9F\x8F\xA0", -1},
        {"a\xC0\x80", 1},  {"\xED\xA0\x80", 0}, {"\xF4\x90\x80\x80", 0},
        {"ab\xE2\x82", 2}, {"\x80", 0},         {"\xE0\x80\x80", 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        size_t at = 99;
        bool ok = support_is_utf8(cases[i].text, strlen(cases[i].text), &at);
        assert_int_equal(ok, cases[i].wrong < 0);
        assert_int_equal(at, ok ? 99 : (size_t)cases[i].wrong);
    }
    size_t at;
    assert_false(support_is_utf8("a\0b", 3, &at));
    assert_int_equal(at, 1);
}

static void a_cut_never_splits_a_character(void **state) {
    (void)state;
    const char *text = "a\xE2\x82\xAC"
                       "b";
    const size_t expected[] = {0, 1, 1, 1, 4, 5};
    for (size_t n = 0; n <= 5; n++) {
        assert_int_equal(text_cut(text, n), expected[n]);
    }
}

static void shown_texts_are_clean_and_short(void **state) {
    (void)state;
    struct text_short t;
    assert_string_equal(text_short(&t, "a\tb\033[31m\xFF\xC2\x9B"), "a b?[31m??");
    char word[200];
    memset(word, 'x', sizeof word);
    word[199] = 0;
    text_short(&t, word);
    assert_int_equal(strlen(t.text), 63);
    assert_string_equal(t.text + 59, "x...");
}

static void a_number_is_shown_by_no_more_digits_than_tell_it_from_others(void **state) {
    (void)state;
    struct text_exact t;
    assert_string_equal(text_exact(&t, 0.1), "0.1");
    assert_string_equal(text_exact(&t, 9.80665), "9.80665");
    assert_string_equal(text_exact(&t, 0.1 + 0.2), "0.30000000000000004");  // is not 0.3
    assert_string_equal(text_exact(&t, 1e22), "1e+22");
    const double hard[] = {1.0 / 3, 5e-324, 1.7976931348623157e308, -2.0 / 7e9};
    for (size_t i = 0; i < sizeof hard / sizeof hard[0]; i++) {
        assert_true(strtod(text_exact(&t, hard[i]), NULL) == hard[i]);
    }
}

static void large_numbers_are_rounded_without_a_power_of_ten(void **state) {
    (void)state;
    static const struct {
        double value;
        int digits;
        const char *text;
    } row[] = {{1030.4, 3, "1030"},   {999.6, 3, "1000"},       {999.4, 3, "999"},
               {123456, 3, "123000"}, {1e6, 4, "1000000"},      {-1234.5, 2, "-1200"},
               {12.345, 3, "12.3"},   {0.0123456, 3, "0.0123"}, {0.0, 3, "0"}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        struct text_exact t;
        assert_string_equal(text_rounded(&t, row[i].value, row[i].digits), row[i].text);
    }
}

static void a_file_has_a_name_without_folder_and_ending(void **state) {
    (void)state;
    static const struct {
        const char *path, *name;
        size_t n;
    } row[] = {{"a/b.c/two.towers.h5", "two.towers.h5", 10},
               {"b.c/towers", "towers", 6},
               {".h5", ".h5", 3},
               {"a/.b.h5", ".b.h5", 2},
               {"a/", "", 0}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        size_t n;
        assert_string_equal(text_stem(row[i].path, &n), row[i].name);
        assert_int_equal(n, row[i].n);
    }
}

static void files_that_cannot_be_read_are_named(void **state) {
    (void)state;
    struct arena *a = arena_create();
    char *text;
    size_t size;
    struct error e;
    assert_int_equal(text_file(a, "no/such/file", 10, &text, &size, &e), STATUS_INPUT);
    assert_string_equal(e.message, "cannot open no/such/file: No such file or directory");
    assert_int_equal(text_file(a, "/", 10, &text, &size, &e), STATUS_INPUT);
    assert_string_equal(e.message, "/ is a directory");
    assert_int_equal(text_file(a, "/dev/null", 10, &text, &size, &e), STATUS_INPUT);
    assert_string_equal(e.message, "/dev/null is not a regular file");
    arena_free(a);
}

static char *printed(const struct diagnostics *d) {
    char *text;
    size_t size;
    FILE *to = open_memstream(&text, &size);
    assert_non_null(to);
    diagnostics_print(d, to, false);
    fclose(to);
    // A copy, because gcc 12 believes that the stream's text dies with this variable.
    char *copy = strdup(text);
    free(text);
    assert_non_null(copy);
    return copy;
}

static void messages_show_the_line_with_a_caret(void **state) {
    (void)state;
    struct arena *a = arena_create();
    struct diagnostics d;
    diagnostics_init(&d, a);
    struct diagnostic entry = {.file = "a.deck",
                               .line = 2,
                               .column = 8,
                               .width = 4,
                               .source_line = "gap\tß = 20mn\r\nnext"};
    diagnostics_add(&d, &entry, "unknown unit '%s'", "mn");
    struct diagnostic other = {.severity = SEVERITY_WARNING, .file = "-D x=1"};
    diagnostics_add(&d, &other, "odd");
    char *text = printed(&d);
    assert_string_equal(text, "a.deck:2:8: error: unknown unit 'mn'\n"
                              "    gap ß = 20mn\n"
                              "           ^~~~\n"
                              "-D x=1: warning: odd\n");
    free(text);
    assert_int_equal(d.n_error, 1);
    assert_int_equal(d.n_warning, 1);
    arena_free(a);
}

static void a_long_line_is_cut_around_the_caret(void **state) {
    (void)state;
    struct arena *a = arena_create();
    char line[1001];
    memset(line, '.', 1000);
    line[1000] = 0;
    line[499] = 'X';
    struct diagnostics d;
    diagnostics_init(&d, a);
    struct diagnostic entry = {
        .file = "f", .line = 1, .column = 500, .width = 1, .source_line = line};
    diagnostics_add(&d, &entry, "here");
    char *text = printed(&d);
    char *shown = strchr(text, '\n') + 1;
    char *caret = strchr(shown, '\n') + 1;
    assert_int_equal(caret - shown - 1, 4 + 160);
    assert_int_equal(shown[strchr(caret, '^') - caret], 'X');
    free(text);
    arena_free(a);
}

static void beyond_the_limit_messages_are_only_counted(void **state) {
    (void)state;
    struct arena *a = arena_create();
    struct diagnostics d;
    diagnostics_init(&d, a);
    for (int i = 0; i < DIAGNOSTICS_MAX + 5; i++) {
        diagnostics_add(&d, &(struct diagnostic){.file = "f", .line = 1, .column = 1}, "no");
    }
    assert_int_equal(d.n_item, DIAGNOSTICS_MAX);
    assert_int_equal(d.n_error, DIAGNOSTICS_MAX + 5);
    char *text = printed(&d);
    assert_non_null(strstr(text, "\n5 more messages are not shown\n"));
    free(text);
    arena_free(a);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_are_read_up_to_their_last_character),
        cmocka_unit_test(numbers_are_the_doubles_nearest_to_their_texts),
        cmocka_unit_test(what_is_no_finite_number_is_told_apart),
        cmocka_unit_test(the_nearest_word_is_found_within_a_third_of_the_letters),
        cmocka_unit_test(a_word_is_near_the_only_one_that_goes_on_where_it_ends),
        cmocka_unit_test(columns_count_characters),
        cmocka_unit_test(only_well_formed_utf8_is_text),
        cmocka_unit_test(a_cut_never_splits_a_character),
        cmocka_unit_test(shown_texts_are_clean_and_short),
        cmocka_unit_test(a_number_is_shown_by_no_more_digits_than_tell_it_from_others),
        cmocka_unit_test(large_numbers_are_rounded_without_a_power_of_ten),
        cmocka_unit_test(a_file_has_a_name_without_folder_and_ending),
        cmocka_unit_test(files_that_cannot_be_read_are_named),
        cmocka_unit_test(messages_show_the_line_with_a_caret),
        cmocka_unit_test(a_long_line_is_cut_around_the_caret),
        cmocka_unit_test(beyond_the_limit_messages_are_only_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
