// SPDX-License-Identifier: GPL-3.0-or-later
// Texts that somebody else has written, in names of files, in what files hold and on the command
// line: no command is executed and no control character reaches a terminal.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/text.h"
#include "support/foreign.h"
#include "support/hostile.h"

// The JSON string behind the first `key`, decoded.
static const char *json_text(const char *json, const char *key) {
    static char text[8192];
    const char *at = strstr(json, key);
    assert_non_null(at);
    size_t n = 0;
    for (at += strlen(key); *at && *at != '"'; at++) {
        unsigned code;
        if (*at != '\\') {
            text[n++] = *at;
            continue;
        }
        at++;
        if (*at != 'u') {
            text[n++] = *at == 'n' ? '\n' : *at;
            continue;
        }
        const char digits[] = {at[1], at[2], at[3], at[4], '\0'};
        code = (unsigned)strtoul(digits, NULL, 16);
        at += 4;
        if (code < 0x80) {
            text[n++] = (char)code;
        } else {
            assert_in_range(code, 0x80, 0x9f);
            text[n++] = (char)0xc2;
            text[n++] = (char)code;
        }
    }
    text[n] = '\0';
    return text;
}

static void json_and_csv_read_back_to_the_same_texts(void **state) {
    (void)state;
    for (int i = 0; i < N_HOSTILE; i++) {
        size_t at;
        if (!support_is_utf8(hostile_text[i], strlen(hostile_text[i]), &at)) {
            continue;
        }
        foreign_text(support_path("run.h5"), support_path("x.h5"), -1, hostile_text[i]);
        const char *json =
            hostile_tried("\"$JOSTLE\" show --json x.h5", "x.h5", hostile_text[i]).out;
        assert_string_equal(json_text(json, "\n\"title\": \""), hostile_text[i]);
        if (text_not_plain(hostile_text[i])) {
            continue;
        }
        char cell[8192] = "\ncontacts,";
        char *to = cell + strlen(cell);
        const bool quoted = strpbrk(hostile_text[i], ",\"\n");
        const char *from = hostile_text[i];
        for (*to++ = '"', to -= !quoted; *from; from++) {
            *to++ = *from;
            *to = '"';
            to += *from == '"';
        }
        memcpy(to, quoted ? "\"," : ",", quoted ? 3 : 2);
        assert_non_null(strstr(
            hostile_tried("\"$JOSTLE\" show --csv x.h5", "x.h5", hostile_text[i]).out, cell));
    }
}

static void names_of_files_are_drawn_or_refused(void **state) {
    (void)state;
    for (int i = 0; i < N_HOSTILE; i++) {
        char name[300];
        snprintf(name, sizeof name, "%.200s.AT2", hostile_text[i]);
        for (char *c = name; *c; c++) {
            *c = *c == '/' ? '_' : *c;
        }
        support_write(name, hostile_record);
        setenv("NAME", name, 1);
        const struct support_result r =
            hostile_tried("\"$JOSTLE\" run -q study.deck --force -o x.h5", "a name", name);
        assert_int_equal(r.status, text_not_plain(name) ? 2 : 0);
        if (r.status == 0) {
            hostile_tried(hostile_file[1].some, "a name", name);
        }
        hostile_draw("a name", name);
        hostile_tried("\"$JOSTLE\" spectrum \"./$NAME\"; \"$JOSTLE\" spectrum \"./$NAME\" --tsv; "
                      "\"$JOSTLE\" spectrum \"./$NAME\" r.AT2 --script scripts --force",
                      "a name", name);
        hostile_draw("a name", name);
        hostile_tried("\"$JOSTLE\" check study.deck; \"$JOSTLE\" tasks study.deck; "
                      "\"$JOSTLE\" run study.deck -D record=\"$NAME\" --force -o x.h5",
                      "a name", name);
        unlink(support_path(name));
    }
}

// As a word, as a value, and as what a file holds.
static void command_lines_and_files_are_shown_escaped(void **state) {
    static const char line[] =
        "\"$JOSTLE\" \"$TEXT\"; \"$JOSTLE\" show \"$TEXT\"; \"$JOSTLE\" show \"--$TEXT\"; "
        "\"$JOSTLE\" check \"$TEXT\"; \"$JOSTLE\" check run.deck -D \"$TEXT=1\"; "
        "\"$JOSTLE\" check study.deck -D \"word=$TEXT\"; \"$JOSTLE\" plot run.h5 \"$TEXT\"; "
        "\"$JOSTLE\" plot run.h5 -o \"x$TEXT.svg\"; \"$JOSTLE\" deck \"$TEXT\"; "
        "\"$JOSTLE\" run run.deck -o \"x$TEXT.h5\"; \"$JOSTLE\" run study.deck -o \"x$TEXT.h5\"; "
        "\"$JOSTLE\" show \"x$TEXT.h5\"; \"$JOSTLE\" show --json \"x$TEXT.h5\"; "
        "\"$JOSTLE\" plot \"x$TEXT.h5\"; rm -f x*; \"$JOSTLE\" laws \"$TEXT\"; "
        "\"$JOSTLE\" law \"$TEXT\" -m1 1t -v 1; \"$JOSTLE\" law linear -k \"$TEXT\" -m1 1 -v 1; "
        "\"$JOSTLE\" fragility study.h5 --edp \"$TEXT\" --limit \"$TEXT\"; "
        "\"$JOSTLE\" fragility study.h5 --edp drift --limit 1mm --at \"word=$TEXT\"; "
        "\"$JOSTLE\" merge \"$TEXT\" one.h5 -o x.h5; \"$JOSTLE\" gap run.deck --limit \"$TEXT\"";
    static const char files[] =
        "printf '%s' \"$TEXT\" >foreign; cp foreign foreign.AT2; "
        "\"$JOSTLE\" check foreign; \"$JOSTLE\" show foreign; \"$JOSTLE\" plot foreign; "
        "\"$JOSTLE\" spectrum foreign; \"$JOSTLE\" spectrum r.AT2 --target foreign; "
        "\"$JOSTLE\" law linear -k 1 -m1 1 -v 1 --fit foreign; "
        "{ printf 'title \"'; cat foreign; printf '\"\\n'; cat run.deck; } >foreign.deck; "
        "\"$JOSTLE\" check foreign.deck; "
        "\"$JOSTLE\" plot deck foreign.deck --force --script scripts; "
        "sed \"s/Nowhere/$(sed 's/[\\\\/&]/_/g' foreign | tr '\\n' ' ')/\" r.AT2 >foreign.AT2; "
        "\"$JOSTLE\" spectrum foreign.AT2; "
        "{ cat r.AT2; cat foreign; } >foreign.AT2; \"$JOSTLE\" spectrum foreign.AT2; "
        "cp foreign study.h5.runs; \"$JOSTLE\" run study.deck --force; rm -f study.h5.runs "
        "foreign*";
    (void)state;
    for (int i = 0; i < N_HOSTILE; i++) {
        setenv("TEXT", hostile_text[i], 1);
        hostile_tried(line, "the command line", hostile_text[i]);
        hostile_tried(files, "a file", hostile_text[i]);
        hostile_drawn("a file", hostile_text[i]);
    }
}

// A shell reads what `tasks` prints as the words that were meant, and executes nothing else.
static void commands_of_tasks_have_the_words_given(void **state) {
    (void)state;
    for (int i = 0; i < N_HOSTILE; i++) {
        if (strchr(hostile_text[i], '/') || strlen(hostile_text[i]) > 200) {
            continue;
        }
        setenv("TEXT", hostile_text[i], 1);
        const struct support_result r = hostile_tried(
            "\"$JOSTLE\" tasks study.deck -n 1 -o \"x$TEXT.h5\" -D \"word=jankowski\" >tasks && "
            "jostle() { for w; do :; [ \"$w\" != \"x$TEXT.1-of-1.h5\" ] || echo found; done; "
            "} && . ./tasks",
            "tasks", hostile_text[i]);
        assert_int_equal(r.status, text_not_plain(hostile_text[i]) ? 2 : 0);
        if (r.status == 0) {
            assert_string_equal(r.out, "found\n");
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(json_and_csv_read_back_to_the_same_texts),
        cmocka_unit_test(names_of_files_are_drawn_or_refused),
        cmocka_unit_test(command_lines_and_files_are_shown_escaped),
        cmocka_unit_test(commands_of_tasks_have_the_words_given),
    };
    return cmocka_run_group_tests(tests, hostile_make_files, NULL);
}
