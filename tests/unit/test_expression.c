// SPDX-License-Identifier: GPL-3.0-or-later
// Expressions, literals with units, and the dimensions they carry.
#include "deck_cases.h"
#include "support/support.h"

// The size of a unit with three of these factors is 0 in double precision.
#define MM_54 "mm^9*mm^9*mm^9*mm^9*mm^9*mm^9"
#define DEFINITIONS "units kN m s\nparam a 20mm\nparam m 3t\nparam two 2\nparam f x.txt\n"

static void expressions_have_their_values(void **state) {
    (void)state;
    static const struct {
        const char *text;
        double value;
    } cases[] = {
        {"20mm", 0.02},
        {"1.5", 1.5},
        {"$a", 0.02},
        {"${1+2*3}", 7},
        {"${(1+2)*3}", 9},
        {"${2^3^2}", 512},
        {"${10-4-3}", 3},
        {"${5 + -2^2}", 1},
        {"${2^-1}", 0.5},
        {"${8/4/2}", 1},
        {"${max(1,3,2)}", 3},
        {"${min(a, 1cm)}", 0.01},
        {"${sqrt(a*a)}", 0.02},
        {"${a + 0.01}", 0.03},
        {"${abs(-3)}", 3},
        {"${log10(1e3)}", 3},
        {"${floor(2.7)}", 2},
        {"${ceil(2.1)}", 3},
        {"${a/m*3t}", 0.02},
        {"${$a*$two}", 0.04},
        {"${20mm/2}", 0.01},
        {"${a*sin(30deg)}", 0.01},
        {"${exp(0)+cos(0)+tan(0)+log(1)}", 2},
        {"${2*pi}", 6.283185307179586},
        {"+5", 5},
        {"${(a*1m)^0.5}", 0.1414213562373095},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[256];
        snprintf(text, sizeof text, DEFINITIONS "x -gap %s\n", cases[i].text);
        struct deck *d = case_open(text, NULL, 0);
        struct argument argument[CASE_ROWS];
        case_read(d, argument);
        assert_int_equal(d->diagnostics.n_error, 0);
        assert_int_equal(argument[CASE_GAP].n, 1);
        assert_close(argument[CASE_GAP].number[0], cases[i].value, 1e-14);  // a few roundings
        deck_free(d);
    }
}

static void wrong_expressions_are_reported_where_they_are_wrong(void **state) {
    (void)state;
#define CASE(word, message)                                                                        \
    { DEFINITIONS "x -gap " word, "6:" message }
    static const struct deck_case cases[] = {
        CASE("${1/0}", "12: division by zero"),
        CASE("${2/(a-20mm)}", "12: division by zero"),
        CASE("${sqrt(-4)}", "15: sqrt of -4; it must be >= 0"),
        CASE("${log(0)}", "14: log of 0; it must be > 0"),
        CASE("${10^400}", "12: the result is too large for a number"),
        CASE("${(-8)^0.5}", "14: the negative number -8 cannot be raised to the power 0.5"),
        CASE("${a + m}", "12: a length (m) and a mass (t) cannot be added"),
        CASE("${max(a,m)}", "16: a length (m) and a mass (t) cannot be compared"),
        CASE("${sin(a)}", "14: the argument of sin is a length (m); a pure number is needed"),
        CASE("${2^a}", "11: the exponent is a length (m); a pure number is needed"),
        CASE("${(1}", "10: the ')' to this '(' is missing"),
        CASE("${1+}", "12: the expression is not complete"),
        CASE("${}", "10: the expression is not complete"),
        CASE("${1 2}", "12: unexpected '2'"),
        CASE("${ß}", "10: unexpected 'ß'"),
        CASE("${tow}", "10: unknown parameter 'tow'; did you mean 'two'?"),
        CASE("${sqr(2)}", "10: unknown function 'sqr'; did you mean 'sqrt'?"),
        CASE("${sin}", "10: a '(' must follow a function"),
        CASE("${sin(1,2)}", "15: this function takes one value"),
        CASE("${min(1)}", "10: at least two values are needed here"),
        CASE("${2mm^x}", "13: this is not a power of a unit, as in m^1.5; put the quantity in "
                         "brackets to raise it"),
        CASE("$f", "9: parameter 'f' is the text 'x.txt'; a number is needed"),
        CASE("$m", "8: gap has the dimension of a mass (t); a length is needed"),
        CASE("5mn", "9: unknown unit 'mn'; did you mean 'MN'?"),
        CASE("5m/x", "11: unknown unit 'x'"),
        CASE("1e999", "8: the number is too large; at most 1.8e308 is possible"),
        CASE("1e308km", "13: the value is too large in this unit"),
        CASE("1" MM_54 "*" MM_54 "*" MM_54, "9: the value is too large in this unit"),
        CASE("2,5", "9: unexpected ',5' after the number; write decimals with a point, and "
                    "separate the values of a list by spaces"),
        CASE("2m.s", "10: unexpected '.s' after the number; units are written as in kN*s/m or "
                     "N/m^1.5"),
        CASE("${2**3}", "12: unexpected '*'; a power is written ^"),
        CASE(
            "2+3",
            "9: unexpected '+3' after the number; write expressions as ${...} and texts in quotes"),
        CASE("2*N/m",
             "9: unexpected '*N/m' after the number; write a unit directly after its number"),
        CASE("2\u00b5m",
             "9: unexpected '\u00b5m' after the number; units are written as in kN*s/m or "
             "N/m^1.5"),
        CASE("${2 mm}", "12: unexpected 'm'; write a unit directly after its number"),
        CASE("two", "8: gap needs a number, not 'two'; did you mean '$two'?"),
        CASE("nan", "8: gap needs a number, not 'nan'"),
        CASE("$", "8: a name or '{' must follow '$'"),
        CASE("-1mm", "8: gap is -0.001 m; it must be >= 0"),
    };
    case_check(cases, sizeof cases / sizeof cases[0]);
}

static void deep_expressions_end_in_an_error(void **state) {
    (void)state;
    static const char *const pieces[] = {"(", "-", "2^", "sqrt(", "min(1,"};
    for (size_t i = 0; i < sizeof pieces / sizeof pieces[0]; i++) {
        static char text[100100];
        snprintf(text, sizeof text, "x -gap ${");
        for (size_t used = strlen(text); used < 100000; used += strlen(pieces[i])) {
            memcpy(text + used, pieces[i], strlen(pieces[i]) + 1);
        }
        memcpy(text + strlen(text), "1}", sizeof "1}");
        struct deck *d = case_open(text, NULL, 0);
        struct argument argument[CASE_ROWS];
        case_read(d, argument);
        assert_int_equal(d->diagnostics.n_error, 1);
        assert_string_equal(d->diagnostics.item[0].message,
                            "more than 100 levels of brackets, signs and powers");
        deck_free(d);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(expressions_have_their_values),
        cmocka_unit_test(wrong_expressions_are_reported_where_they_are_wrong),
        cmocka_unit_test(deep_expressions_end_in_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
