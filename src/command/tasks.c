// SPDX-License-Identifier: GPL-3.0-or-later
// jostle tasks: a study as commands, one a line, for programs that run commands on many machines.
#include <assert.h>

#include "command/deck_command.h"
#include "command/output_name.h"
#include "core/safe.h"
#include "core/text.h"
#include "jostle/result.h"
#include "jostle/study.h"

static int tasks_command(int argc, char **argv);

const struct command command_tasks = {
    .name = "tasks",
    .usage = "DECK [-n PARTS] [-o FILE.h5] [-D NAME=VALUE]... [-j THREADS] [--merge]",
    .summary = "prints the commands that run a study in parts",
    .run = tasks_command,
};

enum { PARTS = 16 };
enum tasks_lines { TASKS_RUN, TASKS_MERGE };

struct tasks_options {
    struct load_request load;
    const char *output;
    int n_part;  // 0: not given
    int n_thread;
    enum tasks_lines lines;
};
#define AT(member) offsetof(struct tasks_options, member)

// A word for sh, with a blank in front.
static void print_word(const char *text) {
    fputc(' ', stdout);
    safe_put(stdout, SAFE_SHELL, text);
}

static void print_run(const struct tasks_options *o, const struct study_shard *s,
                      const char *part) {
    fputs("jostle run", stdout);
    for (int i = 0; i < o->load.define.n; i++) {
        fputs(" -D", stdout);
        print_word(o->load.define.word[i]);
    }
    printf(" --shard %ld/%ld -j %d -q -o", s->number, s->n, o->n_thread);
    print_word(part);
    fputs(o->load.path[0] == '-' ? " --" : "", stdout);
    print_word(o->load.path);
    fputc('\n', stdout);
}

// The first word that a command of one line cannot hold; NULL: there is none.
static const char *unprintable_word(const struct tasks_options *o, const char *path) {
    const char *wrong = text_not_plain(path) ? path : NULL;
    wrong = text_not_plain(o->load.path) ? o->load.path : wrong;
    for (int i = 0; i < o->load.define.n; i++) {
        wrong = text_not_plain(o->load.define.word[i]) ? o->load.define.word[i] : wrong;
    }
    return wrong;
}

static int print_tasks(void *options, const struct model *m) {
    const struct tasks_options *o = options;
    struct error e;
    assert(o->load.path);
    if (deck_command_check_study(m, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    const char *path = output_choose(m, o->output, &(struct study_shard){0, 0});
    if (!path) {
        return command_no_memory();
    }
    if (result_check_path(path, RESULT_REPLACE, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    const char *wrong = unprintable_word(o, path);
    if (wrong) {
        struct text_short t;
        error_set(&e, STATUS_INPUT,
                  "'%s' has a line break, another control character or is not UTF-8; it cannot "
                  "stand in a command of one line",
                  text_short(&t, wrong));
        return command_fail(&e);
    }
    const long n_run = m->deck->n_run;
    const long n = o->n_part ? o->n_part : n_run < PARTS ? n_run : PARTS;
    if (o->lines == TASKS_MERGE) {
        fputs("jostle merge -o", stdout);
        print_word(path);
        fputs(path[0] == '-' ? " --" : "", stdout);
    }
    for (long k = 1; k <= n; k++) {
        const struct study_shard s = {k, n};
        const char *part = output_part_name(m->deck->arena, path, &s);
        if (!part) {
            return command_no_memory();
        }
        if (o->lines == TASKS_MERGE) {
            print_word(part);
        } else {
            print_run(o, &s, part);
        }
    }
    fputs(o->lines == TASKS_MERGE ? "\n" : "", stdout);
    return EXIT_DONE;
}

static int tasks_command(int argc, char **argv) {
    static const struct option_row rows[] = {
        {"parts", 'n', "PARTS", OPTION_WHOLE, OPTION_LETTER_ONLY, AT(n_part), 1, STUDY_RUNS_MAX,
         .what = "a number of parts",
         .doc = "number of parts; default: 16, or the number of runs if this is smaller"},
        {"output", 'o', "FILE", OPTION_TEXT, 0, AT(output),
         .doc = "the result file of the study; the parts are FILE.K-of-N.h5 beside it"},
        DECK_DEFINE_ROW,
        DECK_THREADS_ROW(AT(n_thread), "threads of each command; default: 1"),
        {"merge", .kind = OPTION_SET, .at = AT(lines), .set = TASKS_MERGE,
         .doc = "prints only the command that joins the parts at the end"},
        {0}};
    static const struct option_part parts[] = {
        {.row = rows},
        {.row = option_help},
        {.text = "\nEach line is a command for sh. The lines may run in any order, on any machine "
                 "that has the deck\nand its records. A line that runs again continues where it "
                 "stopped; a finished part is left as\nit is.\n"},
        {0}};
    static const struct deck_command c = {&command_tasks, parts, .use = print_tasks};
    struct tasks_options o = {.n_thread = 1, .lines = TASKS_RUN};
    return deck_command_run(&c, argc, argv, &o.load);
}
