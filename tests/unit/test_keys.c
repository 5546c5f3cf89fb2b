// SPDX-License-Identifier: GPL-3.0-or-later
// What a deck adds to the key of a run: all that its model depends on and nothing else.
#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/checksum.h"
#include "jostle/deck.h"
#include "support/support.h"

// The key of a text that stands for a deck of the folder input; "": it has none.
static struct checksum key_with(const char *text, const char *define) {
    struct checksum key = {.digits = ""};
    struct checksum_sum sum;
    struct deck *d;
    struct error e;
    checksum_start(&sum);
    assert_int_equal(deck_open_text("input/test.deck", text, &define, define ? 1 : 0, &d, &e),
                     STATUS_OK);
    if (deck_key(d, &sum)) {
        checksum_end(&sum, &key);
    }
    deck_free(d);
    return key;
}

static struct checksum key_of(const char *text) {
    return key_with(text, NULL);
}

#define HEAD "units kN m s\nbuilding A -floors 2 -mass 300t -stiffness "

static void assert_same(const char *a, const char *b) {
    const struct checksum x = key_of(a), y = key_of(b);
    assert_true(x.digits[0] != '\0');
    assert_string_equal(x.digits, y.digits);
}

static void assert_other(const char *a, const char *b) {
    const struct checksum x = key_of(a), y = key_of(b);
    assert_true(x.digits[0] != '\0' && y.digits[0] != '\0');
    assert_string_not_equal(x.digits, y.digits);
}

static void what_changes_no_result_changes_no_key(void **state) {
    (void)state;
    const char *plain = HEAD "345MN/m\nstep fixed 1ms\n";
    assert_same(plain, HEAD "345MN/m # stiff\n\n  step   fixed \\\n 1ms");
    assert_same(plain, "title \"A title\"\n" HEAD "345MN/m\nstep fixed 1ms\n");
    assert_same(plain, HEAD "345MN/m\nparam unused 3\nstep fixed 1ms\n");
    assert_same(plain, HEAD "345e3kN/m\nstep fixed 1ms\n");
    assert_same(plain, "units kN m s\nparam k 345MN/m\nbuilding A -floors 2 -mass 300t "
                       "-stiffness $k\nstep fixed 1ms\n");
    assert_same(plain, "units kN m s\nsweep k values 345MN/m 1MN/m\nbuilding A -floors 2 -mass "
                       "300t -stiffness ${k}\nstep fixed 1ms\n");
    assert_same(HEAD "2*345MN/m\n", "units kN m s\nparam k 345MN/m\nbuilding A -floors 2 -mass "
                                    "300t -stiffness 2*$k\n");
    assert_same(plain, "units kN m s\nparam n 2\nparam k 345MN/m\nbuilding A -floors $n -mass 300t "
                       "-stiffness $k\nstep fixed 1ms\n");
    const char *swept = "units kN m s\nparam k 1MN/m\nbuilding A -floors 2 -mass 300t -stiffness "
                        "$k\nstep fixed 1ms\n";
    assert_string_equal(key_with(swept, "k=345MN/m").digits, key_of(plain).digits);
}

static void what_may_change_a_result_changes_the_key(void **state) {
    (void)state;
    // The number counts, not the 15 digits that a text would have of it.
    assert_other(HEAD "${0.1 + 0.2}\n", HEAD "${0.3}\n");
    assert_other("param x ${0.1 + 0.2}\n"
                 "building A -floors 1 -mass $x -stiffness 1\n",
                 "param x 0.3\n"
                 "building A -floors 1 -mass $x -stiffness 1\n");
    assert_other(HEAD "345\n", HEAD "345kN/m\n");
    assert_other(HEAD "2*345MN/m\n", HEAD "3*345MN/m\n");
    assert_other(HEAD "345MN/m\n",
                 "units kN mm s\nbuilding A -floors 2 -mass 300t -stiffness 345MN/m\n");
    assert_other(HEAD "345MN/m\n",
                 "gravity 9.81m/s^2\nbuilding A -floors 2 -mass 300t -stiffness 345MN/m\n");
    // Names of digits, also in the place of one another.
    assert_other("contact 1 01 -gap 1\n", "contact 01 1 -gap 1\n");
    assert_other("contact 1m 100cm -gap 1\n", "contact 100cm 1m -gap 1\n");
    // What is an option, and where words and statements end.
    assert_other("base A -x 1\n", "base A \"-x\" 1\n");
    assert_other("base A B\nbase C\n", "base A\nbase B C\n");
    assert_other("base AB C\n", "base A BC\n");
    assert_other("base A -x 1 2\nbase C\n", "base A -x 12\nbase C\n");
    assert_other("base A\nbase B\n", "base B\nbase A\n");
    assert_other("base $$A\n", "base A\n");
}

static void a_deck_with_an_error_has_no_key(void **state) {
    (void)state;
    assert_string_equal(key_of("base $none\n").digits, "");
    assert_string_equal(key_of("base ${1/0}\n").digits, "");
    assert_string_equal(key_of("gravity -1\nbase A\n").digits, "");
    assert_string_equal(key_of("include no_such_file.deck\n").digits, "");
    assert_string_equal(key_of("base \"A\n").digits, "");
}

// Another word in the place of this one: another digit, or another text.
static void change(char *word, size_t n) {
    for (size_t i = 0; i < n; i++) {
        if (word[i] >= '0' && word[i] <= '9') {
            word[i] = word[i] == '9' ? '1' : (char)(word[i] + 1);
            return;
        }
    }
    word[n - 1] = word[n - 1] == 'q' ? 'z' : 'q';
}

// Changes one word after the other of a statement, of those that count for the first run.
static int change_words(const char *text, char *changed, size_t from, const char *key) {
    const size_t end = from + strcspn(text + from, "#\n");
    int n = 0;
    for (size_t at = from; at < end;) {
        at += strspn(text + at, " \t\\\"");
        const size_t size = strcspn(text + at, " \t\n\"#");
        if (at < end && size > 0) {
            change(changed + at, size);
            const struct checksum other = key_of(changed);
            if (strcmp(other.digits, key) == 0) {
                fail_msg("'%.*s' may be '%.*s'", (int)size, text + at, (int)size, changed + at);
            }
            memcpy(changed + at, text + at, size);
            n++;
        }
        at += size + 1;
    }
    return n;
}

static void every_word_of_every_example_counts(void **state) {
    (void)state;
    glob_t found;
    int n = 0, n_deck = 0;
    assert_int_equal(glob("input/*.deck", 0, NULL, &found), 0);
    for (size_t i = 0; i < found.gl_pathc; i++) {
        size_t size;
        const char *text = support_read(found.gl_pathv[i], &size);
        const struct checksum key = key_of(text);
        char *changed = strdup(text);
        bool counts = true;
        assert_true(key.digits[0] != '\0');
        for (size_t at = 0; at < size; at += strcspn(text + at, "\n") + 1) {
            const bool goes_on = at > 1 && text[at - 2] == '\\';
            const bool sweep = strncmp(text + at, "sweep ", 6) == 0;
            const bool title = strncmp(text + at, "title ", 6) == 0;
            counts = goes_on ? counts : !sweep && !title;
            n += counts ? change_words(text, changed, at, key.digits) : 0;
        }
        free(changed);
        n_deck++;
    }
    globfree(&found);
    assert_true(n_deck > 15 && n > 800);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_changes_no_result_changes_no_key),
        cmocka_unit_test(what_may_change_a_result_changes_the_key),
        cmocka_unit_test(a_deck_with_an_error_has_no_key),
        cmocka_unit_test(every_word_of_every_example_counts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
