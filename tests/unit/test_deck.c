// SPDX-License-Identifier: GPL-3.0-or-later
// The statements of the language, parameters, options and values.
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "deck_cases.h"

static void a_bare_number_is_in_the_deck_s_units(void **state) {
    (void)state;
    struct deck *d =
        case_open("units kN mm s\nx -gap 3 4cm 2*1m -k 2.75e9N/m^1.5 -file \"a b\"\n", NULL, 0);
    struct argument argument[CASE_ROWS];
    case_read(d, argument);
    assert_int_equal(d->diagnostics.n_error, 0);
    const double gap[] = {3, 40, 1000, 1000};
    assert_int_equal(argument[CASE_GAP].n, 4);
    for (int i = 0; i < 4; i++) {
        assert_true(argument[CASE_GAP].number[i] == gap[i]);
    }
    assert_int_equal(argument[CASE_GAP].word[3].place.column, 14);
    // 2.75e9 N/m^1.5 = 2.75e6 kN / (1000 mm)^1.5
    assert_true(fabs(argument[CASE_K].number[0] / (2.75e6 / pow(1000, 1.5)) - 1) < 1e-14);
    assert_string_equal(argument[CASE_FILE].text[0], "a b");
    assert_false(argument[CASE_N].given);
    assert_true(argument[CASE_N].number[0] == 1.5);
    assert_int_equal(argument[CASE_FLOORS].n, 0);
    deck_free(d);
}

static void a_fallback_is_converted_into_the_deck_s_units(void **state) {
    (void)state;
    struct deck *d = case_open("units kN mm s\nx\n", NULL, 0);
    struct argument argument[CASE_ROWS];
    case_read(d, argument);
    assert_false(argument[CASE_GAP].given);
    assert_int_equal(argument[CASE_GAP].n, 1);
    assert_true(argument[CASE_GAP].number[0] == 10);
    deck_free(d);
}

static void wrong_statements_are_reported(void **state) {
    (void)state;
    static const struct deck_case cases[] = {
        {"title \"a\"\ntitle \"b\"", "2:1: title is already given in line 1"},
        {"title a b", "1:9: 'b' is one word too many; the statement is title \"TEXT\""},
        {"title", "1:1: a word is missing; the statement is title \"TEXT\""},
        {"param a 3 -log", "1:11: '-log' is not expected here; the statement is param NAME VALUE"},
        {"units kg m s", "1:7: kg is a unit of a mass; a force unit is needed"},
        {"units kn m sec", "1:7: unknown force unit 'kn'; did you mean 'kN'? | "
                           "1:12: unknown time unit 'sec'; available: s, ms, us, min"},
        {"param a 3\nunits N m s", "2:1: units must be above all other statements except title and "
                                   "include; the first is in line 1"},
        {"gravity 1s", "1:9: gravity has the dimension of a time (s); an acceleration is needed"},
        {"gravity -9.81", "1:9: gravity is -9.81 m/s^2; it must be > 0"},
        {"param a 1g\ngravity 9.81", "2:1: gravity must be above the first use of the unit g"},
        {"gravity 9.81\ngravity 9.81", "2:1: gravity is already given in line 1"},
        {"param a 3\nparam a 4", "2:7: parameter 'a' is already defined in line 1"},
        {"param pi 3", "1:7: 'pi' has a meaning in expressions and cannot name a parameter"},
        {"param 2a 3", "1:7: '2a' cannot name a parameter; letters, digits and _ can"},
        {"param a $a", "1:10: unknown parameter 'a'"},
        {"param a ${1/0}\nx -gap $a", "1:13: division by zero"},
        {"include no.deck", "1:9: cannot open no.deck: No such file or directory"},
    };
    case_check(cases, sizeof cases / sizeof cases[0]);
}

static void wrong_options_are_reported(void **state) {
    (void)state;
    static const struct deck_case cases[] = {
        {"x -gpa 3", "1:3: unknown option '-gpa'; did you mean '-gap'?"},
        {"x -gap 3 -gap 4", "1:10: -gap is given twice"},
        {"x -gap", "1:3: -gap needs a value: gaps"},
        {"x -k 3 4", "1:8: '4' is not expected: k takes one value"},
        {"x -log 4", "1:8: '4' is not expected: log takes no value"},
        {"x -floors 2.5", "1:11: floors is 2.5; it must be a whole number up to 2147483647"},
        {"x -k 2*3", "1:6: k takes one value, not a repeat; write a product in ${...}"},
        {"x -gap 2.5*3 0*1 2*",
         "1:8: the count of a repeat is 2.5; it must be a whole number from 1 to 1000000 | "
         "1:14: the count of a repeat is 0; it must be a whole number from 1 to 1000000 | "
         "1:20: gap needs a number, not ''"},
        {"x -gap 600000*1 600000*2", "1:17: gap has more than 1000000 values"},
        {"x -k 3N/m^1.5 -n 2", "1:6: k has the dimension of a quantity in N/m^1.5; "
                               "a quantity in N/m^2 is needed"},
        {"x -k 3 -n y", "1:11: n needs a number, not 'y'"},
        {"x -file \"\"", "1:9: file is an empty text"},
        {"x -file ${f}", "1:11: unknown parameter 'f'"},
    };
    case_check(cases, sizeof cases / sizeof cases[0]);
}

static void texts_take_parameters(void **state) {
    (void)state;
    struct deck *d =
        case_open("param f \"a b\"\nparam n 3\nparam g ${f}\ntitle \"$f: ${n/2} $$5 $ ${g}\"\n"
                  "x -file r/${f}$n.AT2\n",
                  NULL, 0);
    struct argument argument[CASE_ROWS];
    case_read(d, argument);
    assert_int_equal(d->diagnostics.n_error, 0);
    assert_string_equal(d->title, "a b: 1.5 $5 $ a b");
    assert_string_equal(argument[CASE_FILE].text[0], "r/a b3.AT2");
    assert_string_equal(deck_parameters(d), "f = a b\nn = 3\ng = a b\n");
    deck_free(d);
}

static void doubling_texts_end_in_an_error(void **state) {
    (void)state;
    char text[4096] = "param a0 xxxxxxxxxx\n";
    for (int i = 1; i < 40; i++) {
        size_t used = strlen(text);
        snprintf(text + used, sizeof text - used, "param a%d \"$a%d$a%d\"\n", i, i - 1, i - 1);
    }
    struct deck *d = case_open(text, NULL, 0);
    struct argument argument[CASE_ROWS];
    case_read(d, argument);
    assert_int_equal(d->diagnostics.n_error, 1);
    assert_string_equal(d->diagnostics.item[0].message,
                        "the text is longer than 4096 bytes with its parameters replaced");
    deck_free(d);
}

static void a_define_overrides_a_param(void **state) {
    (void)state;
    const char *const define[] = {"gap=30mm", "f=0001", "b=${gap/2}"};
    struct deck *d =
        case_open("param gap 20mm\nparam f \"x\"\nparam b 1\ntitle \"$f $b\"\n", define, 3);
    struct statement s;
    assert_false(deck_next(d, &s));
    assert_int_equal(d->diagnostics.n_error, 0);
    assert_string_equal(deck_parameters(d), "gap = 0.03\nf = 0001\nb = 0.015\n");
    deck_free(d);
}

static void parameters_that_nothing_uses_are_reported(void **state) {
    (void)state;
    const char *const define[] = {"gap=30mm"};
    struct deck *d = case_open("param gap 20mm\nparam e 1\n", define, 1);
    struct statement s;
    assert_false(deck_next(d, &s));
    assert_int_equal(d->diagnostics.n_error, 1);
    assert_string_equal(d->diagnostics.item[0].message, "nothing in the deck uses parameter 'gap'");
    assert_string_equal(d->diagnostics.item[0].file, "-D gap=30mm");
    assert_int_equal(d->diagnostics.n_warning, 1);
    assert_string_equal(d->diagnostics.item[1].message, "the deck does not use parameter 'e'");
    deck_free(d);
}

static void wrong_defines_are_reported_under_their_own_name(void **state) {
    (void)state;
    static const struct {
        const char *define, *message;
    } cases[] = {
        {"gpa=3", "unknown parameter 'gpa'; did you mean 'gap'?"},
        {"gap", "it must be -D NAME=VALUE"},
        {"gap=", "it must be -D NAME=VALUE"},
        {"gap=3mx", "unknown unit 'mx'; did you mean 'm'?"},
        {"gap=wide", "'gap' is a number in the deck; this is a text"},
        {"gap=3s", "'gap' is a length (m) in the deck; this is a time (s)"},
        {"3=4", "'3' cannot name a parameter; letters, digits and _ can"},
        {"gap=\x01", "this is not UTF-8 text without control characters"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct deck *d = case_open("param gap 20mm\n", &cases[i].define, 1);
        struct statement s;
        assert_false(deck_next(d, &s));
        assert_false(deck_next(d, &s));
        assert_int_equal(d->diagnostics.n_error, 1);
        assert_int_equal(d->diagnostics.item[0].line, 0);
        assert_string_equal(d->diagnostics.item[0].message, cases[i].message);
        assert_int_equal(strncmp(d->diagnostics.item[0].file, "-D ", 3), 0);
        deck_free(d);
    }
}

static void gravity_sets_the_unit_g(void **state) {
    (void)state;
    struct deck *d = case_open("units kN cm s\ngravity 981\nparam a 0.5g\n", NULL, 0);
    struct statement s;
    assert_false(deck_next(d, &s));
    assert_int_equal(d->diagnostics.n_error, 0);
    assert_true(fabs(deck_gravity(d) - 9.81) < 1e-15);
    assert_string_equal(deck_parameters(d), "a = 490.5\n");
    deck_free(d);
}

static void write_file(const char *path, const char *text) {
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    assert_true(fputs(text, f) >= 0);
    assert_int_equal(fclose(f), 0);
}

static void includes_are_found_beside_the_deck_and_cycles_are_reported(void **state) {
    (void)state;
    char directory[] = "/tmp/jostle-deck-XXXXXX";
    assert_non_null(mkdtemp(directory));
    char top[64], other[64];
    snprintf(top, sizeof top, "%s/top.deck", directory);
    snprintf(other, sizeof other, "%s/other.deck", directory);
    write_file(top, "include other.deck\nx -gap $a\n");
    write_file(other, "param a 3\ny -file f\ninclude \"./top.deck\"\n");
    struct deck *d;
    struct error e;
    assert_int_equal(deck_open(top, NULL, 0, &d, &e), STATUS_OK);
    struct statement s;
    assert_true(deck_next(d, &s));
    assert_string_equal(s.word[0].text, "y");
    const char *file = deck_file(d, &s.word[2], "f");
    assert_int_equal(strncmp(file, directory, strlen(directory)), 0);
    assert_string_equal(file + strlen(directory), "/f");
    struct argument argument[CASE_ROWS] = {0};
    case_read(d, argument);
    assert_true(argument[CASE_GAP].number && argument[CASE_GAP].number[0] == 3);
    assert_int_equal(d->diagnostics.n_error, 1);
    assert_string_equal(d->diagnostics.item[0].file, other);
    assert_int_equal(d->diagnostics.item[0].line, 3);
    assert_int_equal(d->diagnostics.item[0].column, 9);
    assert_non_null(strstr(d->diagnostics.item[0].message, "includes itself through other decks"));
    deck_free(d);
    assert_int_equal(unlink(top) + unlink(other) + rmdir(directory), 0);
}

// Reads on to the next statement and expects its words, as names of files, in these places.
static void expect_files(struct deck *d, const char *directory, const char *const *file, int n) {
    struct statement s;
    assert_true(deck_next(d, &s));
    assert_int_equal(s.n_word, n + 1);
    for (int i = 0; i < n; i++) {
        const struct word *w = &s.word[i + 1];
        const char *path = deck_file(d, w, deck_text(d, w));
        assert_int_equal(strncmp(path, directory, strlen(directory)), 0);
        assert_string_equal(path + strlen(directory), file[i]);
    }
}

static void files_are_looked_for_beside_the_deck_that_names_them(void **state) {
    (void)state;
    char directory[] = "/tmp/jostle-deck-XXXXXX";
    assert_non_null(mkdtemp(directory));
    char top[64], part[64], folder[64];
    snprintf(top, sizeof top, "%s/top.deck", directory);
    snprintf(folder, sizeof folder, "%s/sub", directory);
    snprintf(part, sizeof part, "%s/sub/part.deck", directory);
    assert_int_equal(mkdir(folder, 0700), 0);
    write_file(top, "param t a\nparam s $t\nsweep v values a b\ninclude sub/part.deck\n"
                    "x $i ${i}b \"$i\" $i/b\n");
    write_file(part, "param i a\nparam d b\ny a $t ${s} $v $d\n");
    struct deck *d;
    struct error e;
    const char *const define = "d=a";
    assert_int_equal(deck_open(top, &define, 1, &d, &e), STATUS_OK);
    static const char *const in_part[] = {"/sub/a", "/a", "/a", "/a", "/a"};
    static const char *const in_top[] = {"/sub/a", "/ab", "/sub/a", "/a/b"};
    expect_files(d, directory, in_part, 5);
    expect_files(d, directory, in_top, 4);
    assert_int_equal(d->diagnostics.n_error, 0);
    deck_free(d);
    assert_int_equal(unlink(top) + unlink(part) + rmdir(folder) + rmdir(directory), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_bare_number_is_in_the_deck_s_units),
        cmocka_unit_test(a_fallback_is_converted_into_the_deck_s_units),
        cmocka_unit_test(wrong_statements_are_reported),
        cmocka_unit_test(wrong_options_are_reported),
        cmocka_unit_test(texts_take_parameters),
        cmocka_unit_test(doubling_texts_end_in_an_error),
        cmocka_unit_test(a_define_overrides_a_param),
        cmocka_unit_test(parameters_that_nothing_uses_are_reported),
        cmocka_unit_test(wrong_defines_are_reported_under_their_own_name),
        cmocka_unit_test(gravity_sets_the_unit_g),
        cmocka_unit_test(includes_are_found_beside_the_deck_and_cycles_are_reported),
        cmocka_unit_test(files_are_looked_for_beside_the_deck_that_names_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
