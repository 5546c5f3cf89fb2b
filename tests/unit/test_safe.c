// SPDX-License-Identifier: GPL-3.0-or-later
// What src/core/safe.c makes of texts, by hand after the standards it names.
#include <stdio.h>
#include <string.h>

#include "core/safe.h"
#include "jostle/error.h"
#include "support/support.h"

static const char *put(enum safe where, const char *text) {
    static char out[256];
    FILE *to = fmemopen(out, sizeof out, "w");
    safe_put(to, where, text);
    fclose(to);
    return out;
}

static void a_plain_text_is_what_it_was(void **state) {
    static const struct {
        enum safe where;
        const char *shown;
    } cases[] = {
        {SAFE_TERMINAL, "Zürich 2/3 \\ 50% `a` {b} @c"},
        {SAFE_TSV, "Zürich 2/3 \\ 50% `a` {b} @c"},
        {SAFE_CSV, "Zürich 2/3 \\ 50% `a` {b} @c"},
        {SAFE_JSON, "\"Zürich 2/3 \\\\ 50% `a` {b} @c\""},
        {SAFE_GNUPLOT, "'Zürich 2/3 \\ 50% `a` {b} @c'"},
        {SAFE_TIC, "'Zürich 2/3 \\ 50%% `a` {b} @c'"},
        {SAFE_COMMENT, "Zürich 2/3 \\ 50% `a` {b} @c"},
        {SAFE_SHELL, "'Zürich 2/3 \\ 50% `a` {b} @c'"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_string_equal(put(cases[i].where, "Zürich 2/3 \\ 50% `a` {b} @c"), cases[i].shown);
    }
    assert_string_equal(put(SAFE_SHELL, "a/b_1.2-3.h5"), "a/b_1.2-3.h5");
    assert_string_equal(put(SAFE_SHELL, ""), "''");
}

static void what_ends_or_leaves_a_text_is_escaped(void **state) {
    static const char text[] = "'\",;\\\n\t\r\033\x7f\xc2\x9b\xff$x\\";
    (void)state;
    assert_string_equal(put(SAFE_TERMINAL, text), "'\",;\\? ?????$x\\");
    assert_string_equal(put(SAFE_TSV, text), "'\",;\\      ?$x\\");
    assert_string_equal(put(SAFE_CSV, text), "\"'\"\",;\\\n\t    ?$x\\\"");
    assert_string_equal(put(SAFE_JSON, text),
                        "\"'\\\",;\\\\\\n\\u0009\\u000d\\u001b\\u007f\\u009b\\ufffd$x\\\\\"");
    assert_string_equal(put(SAFE_GNUPLOT, text), "\"\\047\\042,;\\134      ?$x\\134\"");
    assert_string_equal(put(SAFE_GNUPLOT, text + 1), "'\",;\\      ?$x\\'");
    assert_string_equal(put(SAFE_TIC, "'5%`@"), "\"\\0475%%\\140\\100\"");
    assert_string_equal(put(SAFE_COMMENT, text), "'\",;\\      ?$x\\ ");  // joins no next line
    assert_string_equal(put(SAFE_SHELL, text), "''\\''\",;\\???????$x\\'");
}

static void a_line_is_cleaned_as_a_whole_and_cut(void **state) {
    char out[5000] = "", text[4501];
    (void)state;
    memset(text, 'x', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    FILE *to = fmemopen(out, sizeof out, "w");
    safe_line(to, "a %s %d", "b\nc\033[31m", 3);
    safe_line(to, "%s", text);
    fclose(to);
    assert_memory_equal(out, "a b?c?[31m 3\nxxx", 16);
    assert_string_equal(out + 13 + 4000, "...\n");
}

static void an_error_is_one_clean_line(void **state) {
    struct error e;
    (void)state;
    error_set(&e, STATUS_INPUT, "cannot read %s", "a\nb\033]0;c\a\x80\xc2\x85");
    assert_string_equal(e.message, "cannot read a?b?]0;c???");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_plain_text_is_what_it_was),
        cmocka_unit_test(what_ends_or_leaves_a_text_is_escaped),
        cmocka_unit_test(a_line_is_cleaned_as_a_whole_and_cut),
        cmocka_unit_test(an_error_is_one_clean_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
