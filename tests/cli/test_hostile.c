// SPDX-License-Identifier: GPL-3.0-or-later
// Texts and numbers that somebody else has written: whatever they are, no command is executed, no
// control character reaches a terminal, and no number leads astray. Each text of a table is tried
// in the fields of result files, in names of files, in what files hold and on the command line.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/text.h"
#include "support/foreign.h"
#include "support/support.h"

static char very_long[3001];
static const char *const hostile[] = {
    "it's",
    "''a''b'",
    "\"; system(\"touch marker\"); \"",
    "'; system(\"touch marker\"); '",
    "back\\slash\\",
    "`touch marker`",
    "$(touch marker)",
    "a\nsystem(\"touch marker\")\n#",
    "a\r\nsystem(\"touch marker\")\r\n#",
    "a\n!touch marker\n",
    "EOD\nsystem(\"touch marker\")\n",
    "a\nEOD\nsystem(\"touch marker\")\n",
    "\033[31mred\033]0;title\a\b\b",
    "\177\302\23331m",
    "stray \xff\xc0\x80 \x9b bytes",
    "EOD",
    "5%s%n%d 50% %%",
    "{/=50 x} a_b^c @d &{e} ~f{g}",
    "</text><script>x</script>",
    "=cmd|' /c calc'!A0",
    "Zürich – 東京",
    very_long,
    "",
};
enum { N_HOSTILE = sizeof hostile / sizeof hostile[0] };

static const char run_deck[] = "title \"two\"\n"
                               "units kN m s\n"
                               "building A -floors 2 -mass 100t -stiffness 50MN/m -height 3m\n"
                               "building B -floors 2 -mass 80t -stiffness 20MN/m -height 3m\n"
                               "contact A:2 B:2 -gap 1mm -law kelvin-voigt -k 1e5 -e 0.6\n"
                               "contact A:1 B:1 -gap 1mm -law jankowski -k 1e6 -e 0.6\n"
                               "link A:1 B:1 -stiffness 1000\n"
                               "ground sine -amplitude 0.3g -frequency 1.5 -cycles 2\n"
                               "step fixed 1ms\n";
static const char study_deck[] = "sweep record files \"*.AT2\"\n"
                                 "sweep scale values 1 2 3\n"
                                 "sweep word values jankowski hunt-crossley\n"
                                 "building A -floors 1 -mass 1 -stiffness 100 -height 3\n"
                                 "building B -floors 1 -mass 1 -stiffness 50 -height 3\n"
                                 "contact A B -gap 1mm -law $word -k 1e5 -e 0.6\n"
                                 "ground record $record -scale $scale\n"
                                 "step fixed 0.01\n";
static const char record_text[] = "PEER NGA STRONG MOTION DATABASE RECORD\nNowhere\n"
                                  "ACCELERATION TIME SERIES IN UNITS OF G\n"
                                  "NPTS= 6, DT= .01 SEC\n0 1 -1 0.5 0 0\n";

static const char run_commands[] =
    "\"$JOSTLE\" show x.h5; \"$JOSTLE\" show --tsv x.h5; \"$JOSTLE\" show --csv x.h5; "
    "\"$JOSTLE\" show --json x.h5; \"$JOSTLE\" verify x.h5; "
    "for kind in loops spectrum modes overview; do "
    "\"$JOSTLE\" plot x.h5 $kind --force --script scripts; done; "
    "\"$JOSTLE\" plot x.h5 modes --compare run.h5 --force --script scripts";
static const char study_commands[] =
    "\"$JOSTLE\" show x.h5; \"$JOSTLE\" show --tsv x.h5; \"$JOSTLE\" show --csv x.h5; "
    "\"$JOSTLE\" show --json x.h5; \"$JOSTLE\" show --long x.h5; \"$JOSTLE\" verify x.h5 --run 1; "
    "\"$JOSTLE\" fragility x.h5 --edp drift --limit 1mm; "
    "\"$JOSTLE\" fragility x.h5 --edp drift --limit 1mm --method ida --at word=jankowski; "
    "for kind in ida response; do "
    "\"$JOSTLE\" plot x.h5 $kind --edp drift --force --script scripts; done; "
    "\"$JOSTLE\" plot x.h5 response --edp drift --against record --over scale --force "
    "--script scripts; "
    "\"$JOSTLE\" plot x.h5 fragility --edp drift --limit 1mm --force --script scripts";
static const char part_commands[] = "\"$JOSTLE\" show x.h5; \"$JOSTLE\" show --csv x.h5; "
                                    "\"$JOSTLE\" merge x.h5 two.h5 -o merged.h5; rm -f merged.h5";
static const char draw_scripts[] = "mkdir -p scripts; cd scripts; set -- *.gp; [ ! -e $1 ] || "
                                   "LC_ALL=C.UTF-8 gnuplot *.gp; s=$?; rm -f *; "
                                   "exit $s";

// Commands for all that a file has, and for one field.
static const struct kind {
    const char *file, *commands, *some;
} kinds[] = {{"run.h5", run_commands,
              "\"$JOSTLE\" show x.h5; \"$JOSTLE\" show --csv x.h5; \"$JOSTLE\" show --json x.h5; "
              "\"$JOSTLE\" plot x.h5 --force --script scripts; "
              "\"$JOSTLE\" plot x.h5 contact --compare run.h5 --force --script scripts"},
             {"study.h5", study_commands,
              "\"$JOSTLE\" show x.h5; \"$JOSTLE\" show --csv x.h5; \"$JOSTLE\" show --long x.h5; "
              "\"$JOSTLE\" fragility x.h5 --edp drift --limit 1mm; "
              "\"$JOSTLE\" plot x.h5 response --edp drift --force --script scripts"},
             {"one.h5", part_commands, part_commands}};
enum { N_KIND = sizeof kinds / sizeof kinds[0] };

// What a terminal shows: UTF-8 without control characters but line feeds and tabs.
static bool is_shown(const char *text) {
    for (; *text && (*text == '\n' || *text == '\t' || text_not_plain(text) != text);) {
        text += *text == '\n' || *text == '\t' ? 1 : text_character(text, strlen(text));
    }
    return *text == '\0';
}

// Runs the line in the folder of the test, where it must neither execute nor print `text`.
static struct support_result tried(const char *line, const char *where, const char *text) {
    const struct support_result r = support_run("cd '%s'; %s", support_temporary(), line);
    const bool executed =
        unlink(support_path("marker")) == 0 || unlink(support_path("scripts/marker")) == 0;
    if (executed || !is_shown(r.out) || !is_shown(r.err) || r.status >= 128) {
        char shown[128];
        text_clean(shown, sizeof shown, text, strlen(text));
        fail_msg("'%s' in %s, %s: %sstatus %d\n%.2000s\n%.2000s", shown, where, line,
                 executed ? "executed; " : "", r.status, r.out, r.err);
    }
    return r;
}

// Draws the scripts that the commands have left, of which gnuplot must have nothing to say.
static void drawn(const char *where, const char *text) {
    const struct support_result r = tried(draw_scripts, where, text);
    if (r.status != 0 || r.err[0]) {
        fail_msg("'%s' in %s: %s", text, where, r.err);
    }
}

static int make_files(void **state) {
    (void)state;
    memset(very_long, 'x', sizeof very_long - 1);
    support_write("run.deck", run_deck);
    support_write("study.deck", study_deck);
    support_write("r.AT2", record_text);
    support_write("s.AT2", record_text);
    const struct support_result r =
        support_run("cd '%s' && \"$JOSTLE\" run -q run.deck && \"$JOSTLE\" run -q study.deck && "
                    "\"$JOSTLE\" run -q study.deck --shard 1/2 -o one.h5 && "
                    "\"$JOSTLE\" run -q study.deck --shard 2/2 -o two.h5",
                    support_temporary());
    if (r.status != 0) {
        print_error("%s", r.err);
    }
    return r.status;
}

static void texts_of_result_files_are_shown_escaped_and_never_executed(void **state) {
    (void)state;
    for (int k = 0; k < N_KIND; k++) {
        for (int i = 0; i < N_HOSTILE; i++) {
            foreign_text(support_path(kinds[k].file), support_path("x.h5"), -1, hostile[i]);
            tried(kinds[k].commands, kinds[k].file, hostile[i]);
            drawn(kinds[k].file, hostile[i]);
        }
    }
}

// Fields that all together hide each other, and those that the reader checks.
static void each_text_field_alone_is_shown_escaped_or_refused(void **state) {
    static const char all[] = "'\"\\`touch marker`$(touch marker)%s{\033[31m\x7f\xc2\x9b\xff\n"
                              "EOD\nsystem(\"touch marker\")\n!touch marker\n\\";
    static struct foreign_field field[FOREIGN_FIELDS_MAX];
    (void)state;
    for (int k = 0; k < N_KIND; k++) {
        const int n = foreign_fields(support_path(kinds[k].file), field);
        assert_in_range(n, 20, FOREIGN_FIELDS_MAX);
        for (int i = 0; i < n; i++) {
            const char *last = strrchr(field[i].path, '@');
            if (last && i % 16 != 0 &&
                (strcmp(last, "@long_name") == 0 || strcmp(last, "@units") == 0)) {
                continue;  // there is one of each for every dataset
            }
            foreign_text(support_path(kinds[k].file), support_path("x.h5"), i, all);
            tried(kinds[k].some, field[i].path, all);
        }
        drawn(kinds[k].file, all);
    }
}

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
        if (!text_is_utf8(hostile[i], strlen(hostile[i]), &at)) {
            continue;
        }
        foreign_text(support_path("run.h5"), support_path("x.h5"), -1, hostile[i]);
        const char *json = tried("\"$JOSTLE\" show --json x.h5", "x.h5", hostile[i]).out;
        assert_string_equal(json_text(json, "\n\"title\": \""), hostile[i]);
        if (text_not_plain(hostile[i])) {
            continue;
        }
        char cell[8192] = "\ncontacts,";
        char *to = cell + strlen(cell);
        const bool quoted = strpbrk(hostile[i], ",\"\n");
        const char *from = hostile[i];
        for (*to++ = '"', to -= !quoted; *from; from++) {
            *to++ = *from;
            *to = '"';
            to += *from == '"';
        }
        memcpy(to, quoted ? "\"," : ",", quoted ? 3 : 2);
        assert_non_null(strstr(tried("\"$JOSTLE\" show --csv x.h5", "x.h5", hostile[i]).out, cell));
    }
}

static void names_of_files_are_drawn_or_refused(void **state) {
    (void)state;
    for (int i = 0; i < N_HOSTILE; i++) {
        char name[300];
        snprintf(name, sizeof name, "%.200s.AT2", hostile[i]);
        for (char *c = name; *c; c++) {
            *c = *c == '/' ? '_' : *c;
        }
        support_write(name, record_text);
        setenv("NAME", name, 1);
        const struct support_result r =
            tried("\"$JOSTLE\" run -q study.deck --force -o x.h5", "a name", name);
        assert_int_equal(r.status, text_not_plain(name) ? 2 : 0);
        if (r.status == 0) {
            tried(kinds[1].some, "a name", name);
        }
        tried(draw_scripts, "a name", name);
        tried("\"$JOSTLE\" spectrum \"./$NAME\"; \"$JOSTLE\" spectrum \"./$NAME\" --tsv; "
              "\"$JOSTLE\" spectrum \"./$NAME\" r.AT2 --script scripts --force",
              "a name", name);
        tried(draw_scripts, "a name", name);
        tried("\"$JOSTLE\" check study.deck; \"$JOSTLE\" tasks study.deck; "
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
        "sed \"s/Nowhere/$(sed 's/[\\\\/&]/_/g' foreign | tr '\\n' ' ')/\" r.AT2 >foreign.AT2; "
        "\"$JOSTLE\" spectrum foreign.AT2; "
        "{ cat r.AT2; cat foreign; } >foreign.AT2; \"$JOSTLE\" spectrum foreign.AT2; "
        "cp foreign study.h5.runs; \"$JOSTLE\" run study.deck --force; rm -f study.h5.runs "
        "foreign*";
    (void)state;
    for (int i = 0; i < N_HOSTILE; i++) {
        setenv("TEXT", hostile[i], 1);
        tried(line, "the command line", hostile[i]);
        tried(files, "a file", hostile[i]);
    }
}

// A shell reads what `tasks` prints as the words that were meant, and executes nothing else.
static void commands_of_tasks_have_the_words_given(void **state) {
    (void)state;
    for (int i = 0; i < N_HOSTILE; i++) {
        if (strchr(hostile[i], '/') || strlen(hostile[i]) > 200) {
            continue;
        }
        setenv("TEXT", hostile[i], 1);
        const struct support_result r = tried(
            "\"$JOSTLE\" tasks study.deck -n 1 -o \"x$TEXT.h5\" -D \"word=jankowski\" >tasks && "
            "jostle() { for w; do :; [ \"$w\" != \"x$TEXT.1-of-1.h5\" ] || echo found; done; "
            "} && . ./tasks",
            "tasks", hostile[i]);
        assert_int_equal(r.status, text_not_plain(hostile[i]) ? 2 : 0);
        if (r.status == 0) {
            assert_string_equal(r.out, "found\n");
        }
    }
}

static void study_files_of_another_format_or_that_are_not_complete_are_refused(void **state) {
    static struct foreign_field field[FOREIGN_FIELDS_MAX];
    static const char *const refused[][2] = {{"/@format", "is not a result file of jostle"},
                                             {"/@status", "is not complete"}};
    (void)state;
    const int n = foreign_fields(support_path("study.h5"), field);
    for (int r = 0, found = 0; r < 2; r++, found = 0) {
        for (int i = 0; i < n; i++) {
            if (strcmp(field[i].path, refused[r][0]) == 0) {
                foreign_text(support_path("study.h5"), support_path("x.h5"), i, "other");
                const struct support_result said = tried("\"$JOSTLE\" show x.h5", "", "other");
                assert_int_equal(said.status, 2);
                assert_non_null(strstr(said.err, refused[r][1]));
                found = 1;
            }
        }
        assert_true(found);
    }
}

static void any_numbers_of_result_files_are_drawn_or_refused(void **state) {
    static const double value[] = {1e300, -1e300, 1e308, 1e-310, 5e-324, 0, -1, 1e18, 3e9};
    (void)state;
    for (int k = 0; k < N_KIND; k++) {
        for (size_t i = 0; i < sizeof value / sizeof value[0] + 3; i++) {
            const double x = i < 9     ? value[i]
                             : i == 9  ? (double)NAN
                             : i == 10 ? INFINITY
                                       : -INFINITY;
            char shown[32];
            snprintf(shown, sizeof shown, "%g", x);
            foreign_numbers(support_path(kinds[k].file), support_path("x.h5"), x);
            tried(kinds[k].commands, kinds[k].file, shown);
        }
        tried(draw_scripts, kinds[k].file, "numbers");
    }
}

// 40 million rows of 8 histories take 2.6 GB.
static void a_small_file_takes_no_large_memory(void **state) {
    (void)state;
    foreign_histories(support_path("run.h5"), support_path("x.h5"), 40);
    size_t size;
    support_read(support_path("x.h5"), &size);
    assert_in_range(size, 1 << 20, 4 << 20);
    const char *limit = getenv("JOSTLE_SANITIZED") ? "" : "ulimit -v 700000; ";
    char line[256];
    snprintf(line, sizeof line, "%s\"$JOSTLE\" plot x.h5 energy -o x.svg", limit);
    const struct support_result r = tried(line, "x.h5", "40 million rows");
    assert_int_equal(r.status, 2);
    assert_non_null(strstr(r.err, "2.56e+03 MB of memory"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texts_of_result_files_are_shown_escaped_and_never_executed),
        cmocka_unit_test(each_text_field_alone_is_shown_escaped_or_refused),
        cmocka_unit_test(json_and_csv_read_back_to_the_same_texts),
        cmocka_unit_test(names_of_files_are_drawn_or_refused),
        cmocka_unit_test(command_lines_and_files_are_shown_escaped),
        cmocka_unit_test(commands_of_tasks_have_the_words_given),
        cmocka_unit_test(study_files_of_another_format_or_that_are_not_complete_are_refused),
        cmocka_unit_test(any_numbers_of_result_files_are_drawn_or_refused),
        cmocka_unit_test(a_small_file_takes_no_large_memory),
    };
    // Commands run in the folder of the test.
    const char *program = getenv("JOSTLE");
    program = program ? program : "build/jostle";
    char folder[2048], path[4096];
    if (!getcwd(folder, sizeof folder)) {
        return 1;
    }
    snprintf(path, sizeof path, "%s%s%s", program[0] == '/' ? "" : folder,
             program[0] == '/' ? "" : "/", program);
    setenv("JOSTLE", path, 1);
    return cmocka_run_group_tests(tests, make_files, NULL);
}
