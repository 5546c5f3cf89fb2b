// SPDX-License-Identifier: GPL-3.0-or-later
// jostle tasks: a study as commands, one a line, for programs that run commands on many machines.
#include <assert.h>

#include "command/deck_command.h"
#include "command/output_name.h"
#include "command/threads.h"
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

static const char details[] =
    "  -n PARTS           parts, a line each; default: 16, or the runs if there are fewer\n"
    "  -o, --output FILE  the result file of the study; parts are FILE.K-of-N.h5 beside it\n"
    "  -D NAME=VALUE      overrides a param of the deck; may be repeated\n"
    "  -j THREADS         threads of each command; default: 1\n"
    "  --merge            prints instead the command that joins the parts in the end\n"
    "  --help             this text\n\n"
    "Each line is for sh. Lines may run in any order and anywhere where the deck and its records\n"
    "are; one that is run again goes on where it was, and does nothing when its part is done.\n";

enum { PARTS = 16 };
enum tasks_lines { TASKS_RUN, TASKS_MERGE };

struct tasks_options {
    struct load_request load;
    const char *output;
    long n_part;  // 0: not given
    int n_thread;
    enum tasks_lines lines;
};

// A word for sh, with a blank in front.
static void print_word(const char *text) {
    fputc(' ', stdout);
    safe_put(stdout, SAFE_SHELL, text);
}

static void print_run(const struct tasks_options *o, const struct study_shard *s,
                      const char *part) {
    fputs("jostle run", stdout);
    for (int i = 0; i < o->load.n_define; i++) {
        fputs(" -D", stdout);
        print_word(o->load.define[i]);
    }
    printf(" --shard %ld/%ld -j %d -q -o", s->number, s->n, o->n_thread);
    print_word(part);
    fputs(o->load.path[0] == '-' ? " --" : "", stdout);
    print_word(o->load.path);
    fputc('\n', stdout);
}

static int print_lines(const struct tasks_options *o, struct arena *a, const char *path, long n) {
    fputs(o->lines == TASKS_MERGE ? "jostle merge -o" : "", stdout);
    if (o->lines == TASKS_MERGE) {
        print_word(path);
        fputs(path[0] == '-' ? " --" : "", stdout);
    }
    for (long k = 1; k <= n; k++) {
        const struct study_shard s = {k, n};
        const char *part = output_part_name(a, path, &s);
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

// The first word that a command of one line cannot hold; NULL: there is none.
static const char *unprintable_word(const struct tasks_options *o, const char *path) {
    const char *wrong = text_not_plain(path) ? path : NULL;
    wrong = text_not_plain(o->load.path) ? o->load.path : wrong;
    for (int i = 0; i < o->load.n_define; i++) {
        wrong = text_not_plain(o->load.define[i]) ? o->load.define[i] : wrong;
    }
    return wrong;
}

static int print_tasks(void *options, const struct model *m) {
    const struct tasks_options *o = options;
    struct error e;
    assert(o->load.path);
    if (load_check_study(m, &e) != STATUS_OK) {
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
    return print_lines(o, m->deck->arena, path, n);
}

static int take(void *options, int letter) {
    struct tasks_options *o = options;
    switch (letter) {
        case 'o':
            o->output = optarg;
            return EXIT_DONE;
        case 'n':
            return command_count(&command_tasks, "-n takes a number of parts", optarg,
                                 STUDY_RUNS_MAX, &o->n_part);
        case 'j':
            return threads_parse(&command_tasks, optarg, &o->n_thread);
        default:
            o->lines = TASKS_MERGE;
            return EXIT_DONE;
    }
}

static int tasks_command(int argc, char **argv) {
    static const struct option option[] = {{"output", required_argument, NULL, 'o'},
                                           {"parts", required_argument, NULL, 'n'},
                                           {"threads", required_argument, NULL, 'j'},
                                           {"merge", no_argument, NULL, 'm'},
                                           DECK_COMMAND_OPTIONS};
    static const struct deck_command c = {&command_tasks, details, ":o:D:n:j:h", option,
                                          take,           NULL,    print_tasks};
    struct tasks_options o = {.n_thread = 1, .lines = TASKS_RUN};
    return deck_command_run(&c, argc, argv, &o.load, &o);
}
