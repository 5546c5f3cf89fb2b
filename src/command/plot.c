// SPDX-License-Identifier: GPL-3.0-or-later
// jostle plot: draws a figure by gnuplot, or writes its script. Script and picture are made in a
// private folder; the picture gets its name when it is complete.
#include <assert.h>
#include <errno.h>
#include <fcntl.h>
#include <getopt.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "command/command.h"
#include "core/text.h"
#include "plot/figure.h"

static int plot_command(int argc, char **argv);

const struct command command_plot = {
    .name = "plot",
    .usage = "FILE.h5 [KIND] [-o FILE.png|.svg|.pdf] [--script DIR] [--force]",
    .summary = "draws the results by gnuplot",
    .run = plot_command,
};

enum { PATH_SIZE = 4096, NOT_FOUND = 127 };

struct request {
    const char *result, *output, *script_folder;
    const struct figure *figure;
    enum result_existing existing;
    char default_output[PATH_SIZE];
};

static int help(void) {
    printf("usage: jostle %s %s\n\n%s\n\nKIND is one of\n", command_plot.name, command_plot.usage,
           command_plot.summary);
    for (int i = 0; i < n_figure; i++) {
        printf("  %-11s %s%s\n", figures[i]->name, figures[i]->doc, i == 0 ? " (default)" : "");
    }
    printf(
        "\n"
        "  -o FILE        the picture; the ending says its kind (default: FILE-KIND.png in the\n"
        "                 current directory)\n"
        "  --script DIR   writes DIR/KIND.gp with its data for gnuplot; without -o, nothing else\n"
        "  --force        overwrites what exists\n"
        "  --help         this text\n");
    return EXIT_DONE;
}

static int parse_options(int argc, char **argv, struct request *q) {
    static const struct option option[] = {
        {"output", required_argument, NULL, 'o'},
        {"script", required_argument, NULL, 's'},
        {"force", no_argument, NULL, 'f'},
        {"help", no_argument, NULL, 'h'},
        {NULL, 0, NULL, 0},
    };
    opterr = 0;
    optind = 1;
    for (int c; (c = getopt_long(argc, argv, ":ho:", option, NULL)) != -1;) {
        switch (c) {
            case 'o':
                q->output = optarg;
                break;
            case 's':
                q->script_folder = optarg;
                break;
            case 'f':
                q->existing = RESULT_REPLACE;
                break;
            case 'h':
                return help();
            default:
                return command_bad_option(&command_plot, c, argv);
        }
    }
    return -1;
}

static int unknown_figure(const char *word) {
    const char *known[32];
    int n = 0;
    for (; n < n_figure && n < 32; n++) {
        assert(figures[n]);
        known[n] = figures[n]->name;
    }
    const char *near = text_nearest(word, known, n);
    return near
               ? command_usage(&command_plot, "unknown figure '%s'; did you mean '%s'?", word, near)
               : command_usage(&command_plot, "unknown figure '%s'", word);
}

// FILE.h5 -> FILE-KIND.png without its folder.
static void name_output(struct request *q) {
    const char *slash = strrchr(q->result, '/');
    const char *base = slash ? slash + 1 : q->result;
    const char *dot = strrchr(base, '.');
    const int n = dot && dot != base ? (int)(dot - base) : (int)strlen(base);
    snprintf(q->default_output, sizeof q->default_output, "%.*s-%s.png", n, base, q->figure->name);
    q->output = q->default_output;
}

// Returns -1 when there is something to do, else the exit status.
static int parse(int argc, char **argv, struct request *q) {
    const int done = parse_options(argc, argv, q);
    if (done >= 0) {
        return done;
    }
    const int n = argc - optind;
    if (n < 1 || n > 2) {
        return command_usage(&command_plot, "a result file and at most one figure are expected");
    }
    q->result = argv[optind];
    q->figure = n == 2 ? figure_find(argv[optind + 1]) : figures[0];
    if (!q->figure) {
        return unknown_figure(argv[optind + 1]);
    }
    if (!q->output && !q->script_folder) {
        name_output(q);
    }
    if (q->output && !figure_ending(q->output)) {
        return command_usage(&command_plot, "'%s' must end in .png, .svg or .pdf", q->output);
    }
    return -1;
}

static int cannot_write(const char *path, struct error *e) {
    return error_set(e, STATUS_SYSTEM, "cannot write %s: %s", path, strerror(errno));
}

// Writes the script to `path`, which must not exist.
static int write_script(const struct request *q, const struct result_file *file,
                        const char *picture, const char *path, struct error *e) {
    FILE *to = fopen(path, "wx");
    if (!to) {
        return cannot_write(path, e);
    }
    int status = figure_write(q->figure, file, picture, to, e);
    const int failed = ferror(to);
    if ((fclose(to) != 0 || failed) && status == STATUS_OK) {
        status = cannot_write(path, e);
    }
    if (status != STATUS_OK) {
        unlink(path);
    }
    return status;
}

static int keep_script(const struct request *q, const struct result_file *file, struct error *e) {
    char path[PATH_SIZE], part[PATH_SIZE], picture[64];
    assert(q->figure);
    if (mkdir(q->script_folder, 0777) != 0 && errno != EEXIST) {
        return cannot_write(q->script_folder, e);
    }
    const int n = snprintf(part, sizeof part, "%s/%s.gp.part", q->script_folder, q->figure->name);
    if (n < 0 || (size_t)n >= sizeof part) {
        return error_set(e, STATUS_INPUT, "the name of folder %.40s... is too long",
                         q->script_folder);
    }
    snprintf(path, sizeof path, "%.*s", n - (int)strlen(".part"), part);
    snprintf(picture, sizeof picture, "%s.%s", q->figure->name,
             q->output ? figure_ending(q->output) : "png");
    unlink(part);
    int status = write_script(q, file, picture, part, e);
    return status == STATUS_OK ? result_publish(part, path, q->existing, e) : status;
}

// In the child: gnuplot in `folder`, its messages in the file `messages`.
static void become_gnuplot(const char *folder) {
    signal(SIGPIPE, SIG_DFL);
    signal(SIGXFSZ, SIG_DFL);
    signal(SIGINT, SIG_DFL);
    if (chdir(folder) != 0) {
        _exit(NOT_FOUND - 1);
    }
    int messages = open("messages", O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (messages >= 0) {
        dup2(messages, STDOUT_FILENO);
        dup2(messages, STDERR_FILENO);
    }
    execlp("gnuplot", "gnuplot", "figure.gp", (char *)NULL);
    _exit(errno == ENOENT ? NOT_FOUND : NOT_FOUND - 1);
}

// The first line with text that gnuplot printed.
static void first_message(const char *folder, char *line, int size) {
    char path[PATH_SIZE];
    snprintf(path, sizeof path, "%s/messages", folder);
    line[0] = '\0';
    FILE *from = fopen(path, "r");
    while (from && fgets(line, size, from)) {
        line[strcspn(line, "\n")] = '\0';
        if (strstr(line, "line ") || strstr(line, "rror")) {
            break;
        }
    }
    if (from) {
        fclose(from);
    }
}

// Starts gnuplot and waits. An interrupt ends the child only, so that the folder can be removed.
static int spawn(const char *folder, int *state, struct error *e) {
    fflush(NULL);
    void (*const before)(int) = signal(SIGINT, SIG_IGN);
    pid_t child = fork();
    if (child == 0) {
        become_gnuplot(folder);
    }
    int cause = child < 0 ? errno : 0;
    while (cause == 0 && waitpid(child, state, 0) < 0) {
        cause = errno == EINTR ? 0 : errno;
    }
    signal(SIGINT, before);
    return cause == 0 ? STATUS_OK
                      : error_set(e, STATUS_SYSTEM, "cannot run gnuplot: %s", strerror(cause));
}

static int run_gnuplot(const char *folder, struct error *e) {
    int state = 0;
    int status = spawn(folder, &state, e);
    if (status != STATUS_OK) {
        return status;
    }
    if (WIFEXITED(state) && WEXITSTATUS(state) == 0) {
        return STATUS_OK;
    }
    if (WIFEXITED(state) && WEXITSTATUS(state) == NOT_FOUND) {
        return error_set(e, STATUS_SYSTEM, "cannot run gnuplot: it is not installed");
    }
    if (WIFSIGNALED(state)) {
        return error_set(e, STATUS_SYSTEM, "gnuplot was ended by signal %d", WTERMSIG(state));
    }
    char line[256];
    first_message(folder, line, sizeof line);
    return error_set(e, STATUS_SYSTEM, "gnuplot failed: %s", line[0] ? line : "no message");
}

// Copies the picture next to its name, so that it can be given the name in one step.
static int copy(const char *from_path, const char *to_path, struct error *e) {
    FILE *from = fopen(from_path, "rb");
    if (!from) {
        return error_set(e, STATUS_SYSTEM, "gnuplot made no picture");
    }
    unlink(to_path);
    FILE *to = fopen(to_path, "wbx");
    if (!to) {
        int status = cannot_write(to_path, e);
        fclose(from);
        return status;
    }
    char block[1 << 14];
    size_t total = 0;
    for (size_t n; (n = fread(block, 1, sizeof block, from)) > 0; total += n) {
        if (fwrite(block, 1, n, to) < n) {
            break;
        }
    }
    const bool failed = ferror(from) || ferror(to);
    fclose(from);
    int status = STATUS_OK;
    if (fclose(to) != 0 || failed) {
        status = cannot_write(to_path, e);
    } else if (total == 0) {
        status = error_set(e, STATUS_SYSTEM, "gnuplot made an empty picture");
    }
    if (status != STATUS_OK) {
        unlink(to_path);
    }
    return status;
}

static void remove_folder(const char *folder, const char *picture) {
    const char *const name[] = {"figure.gp", "messages", picture};
    for (size_t i = 0; i < sizeof name / sizeof name[0]; i++) {
        char path[PATH_SIZE];
        snprintf(path, sizeof path, "%s/%s", folder, name[i]);
        unlink(path);
    }
    rmdir(folder);
}

static int draw_in(const struct request *q, const struct result_file *file, const char *folder,
                   const char *picture, struct error *e) {
    char script[PATH_SIZE], drawn[PATH_SIZE], part[PATH_SIZE];
    snprintf(script, sizeof script, "%s/figure.gp", folder);
    snprintf(drawn, sizeof drawn, "%s/%s", folder, picture);
    const int n = snprintf(part, sizeof part, "%s.part", q->output);
    if (n < 0 || (size_t)n >= sizeof part) {
        return error_set(e, STATUS_INPUT, "the name %.40s... is too long", q->output);
    }
    int status = write_script(q, file, picture, script, e);
    if (status == STATUS_OK) {
        status = run_gnuplot(folder, e);
    }
    if (status == STATUS_OK) {
        status = copy(drawn, part, e);
    }
    return status == STATUS_OK ? result_publish(part, q->output, q->existing, e) : status;
}

static int draw(const struct request *q, const struct result_file *file, struct error *e) {
    if (q->existing == RESULT_KEEP && access(q->output, F_OK) == 0) {
        return error_set(e, STATUS_INPUT, "%s exists; --force overwrites it", q->output);
    }
    const char *root = getenv("TMPDIR");
    char folder[1024], picture[32];
    const int n =
        snprintf(folder, sizeof folder, "%s/jostle-plot-XXXXXX", root && root[0] ? root : "/tmp");
    if (n < 0 || (size_t)n >= sizeof folder || !mkdtemp(folder)) {
        return error_set(e, STATUS_SYSTEM, "cannot make a temporary folder in %s: %s",
                         root && root[0] ? root : "/tmp", strerror(errno));
    }
    snprintf(picture, sizeof picture, "figure.%s", figure_ending(q->output));
    int status = draw_in(q, file, folder, picture, e);
    remove_folder(folder, picture);
    return status;
}

static int plot_command(int argc, char **argv) {
    struct request q = {.existing = RESULT_KEEP};
    const int done = parse(argc, argv, &q);
    if (done >= 0) {
        return done;
    }
    struct result_file *file;
    struct error e;
    int status = result_open(q.result, &file, &e);
    if (status != STATUS_OK) {
        return command_fail(&e);
    }
    if (q.script_folder) {
        status = keep_script(&q, file, &e);
    }
    if (status == STATUS_OK && q.output) {
        status = draw(&q, file, &e);
    }
    result_close(file);
    if (status != STATUS_OK) {
        return command_fail(&e);
    }
    if (q.output) {
        printf("%s\n", q.output);
    }
    return EXIT_DONE;
}
