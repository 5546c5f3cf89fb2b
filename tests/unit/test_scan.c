// SPDX-License-Identifier: GPL-3.0-or-later
// Characters to words with positions.
#include "deck_cases.h"

static void words_stand_where_they_are_written(void **state) {
    (void)state;
    struct deck *d =
        case_open("\xEF\xBB\xBFone \"two ß\" #x\r\n\tab ${a + b}x \\\n-9.81 -q#c\n", NULL, 0);
    struct statement s;
    assert_true(deck_next(d, &s));
    assert_int_equal(s.n_word, 2);
    assert_string_equal(s.word[1].text, "two ß");
    assert_true(s.word[1].quoted);
    assert_int_equal(s.word[0].place.column, 1);
    assert_int_equal(s.word[1].place.column, 5);
    assert_int_equal(s.word[1].place.width, 7);
    assert_true(deck_next(d, &s));
    const struct {
        const char *text;
        int line, column, width;
    } words[] = {{"ab", 2, 2, 2}, {"${a + b}x", 2, 5, 9}, {"-9.81", 3, 1, 5}, {"-q", 3, 7, 2}};
    assert_int_equal(s.n_word, 4);
    assert_int_equal(s.n_plain, 3);
    for (int i = 0; i < 4; i++) {
        assert_string_equal(s.word[i].text, words[i].text);
        assert_int_equal(s.word[i].place.line, words[i].line);
        assert_int_equal(s.word[i].place.column, words[i].column);
        assert_int_equal(s.word[i].place.width, words[i].width);
    }
    assert_false(deck_next(d, &s));
    assert_int_equal(d->diagnostics.n_error, 0);
    deck_free(d);
}

static void wrong_characters_and_quotes_are_reported_where_they_stand(void **state) {
    (void)state;
    static const struct deck_case cases[] = {
        {"a \"b", "1:3: the quoted text does not end on its line"},
        {"a b\"c\"", "1:4: a quote inside a word; put the whole word in quotes"},
        {"a \"b\"c", "1:6: a space must follow the closing quote"},
        {"a \"b\"# c", ""},
        {"a ${b", "1:3: the '}' to this '${' is missing on its line"},
        {"a \\ \nb", "1:3: '\\' joins lines only as the very last character"},
        {"a \\ # c\nb", "1:3: '\\' joins lines only as the very last character"},
        {"a \\", "1:3: '\\' joins the next line, but there is none"},
        {"ß # \x01", "1:5: control character U+0001"},
        {"ß \xFF", "1:3: byte 0xFF is not UTF-8 text"},
        {"a\rb", "1:2: control character U+000D; lines end with LF or CR LF"},
        {"a it's 0\u20132 \"\u201Cb\u201D \u2013\u00A0'c'\"", ""},
        {"a 'b'", "1:3: an apostrophe does not quote; use \"...\""},
        {"a \u201Cb\u201D", "1:3: a typographic quotation mark; use \"...\""},
        {"a \u22125", "1:3: a typographic dash; options and negative numbers start with '-'"},
        {"a 5\u00A0t", "1:4: a typographic space; use an ordinary space"},
        {"-gap 3", "1:1: a statement must start with its name"},
        {"\"a\" 3", "1:1: a statement must start with its name"},
        {"a \"b\na \"c", "1:3: the quoted text does not end on its line | "
                         "2:3: the quoted text does not end on its line"},
        {"\n# only\n \t\r\n", ""},
    };
    case_check(cases, sizeof cases / sizeof cases[0]);
}

static void a_wrong_line_spoils_its_whole_statement_only(void **state) {
    (void)state;
    struct deck *d = case_open("a \"b \\\n -gap 3\nc 4\n", NULL, 0);
    struct statement s;
    assert_true(deck_next(d, &s));
    assert_string_equal(s.word[0].text, "c");
    assert_int_equal(s.word[0].place.line, 3);
    assert_false(deck_next(d, &s));
    assert_int_equal(d->diagnostics.n_error, 1);
    deck_free(d);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(words_stand_where_they_are_written),
        cmocka_unit_test(wrong_characters_and_quotes_are_reported_where_they_stand),
        cmocka_unit_test(a_wrong_line_spoils_its_whole_statement_only),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
