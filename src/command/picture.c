// SPDX-License-Identifier: GPL-3.0-or-later
// Script, data and picture are made in a private folder; the picture gets its name when it is
// complete.
#include "command/picture.h"

#include <assert.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "command/interrupt.h"
#include "result/partial_file.h"

enum { PATH_SIZE = 4096, NOT_FOUND = 127 };

bool picture_is_wanted(const struct picture_options *o) {
    return o->output || o->script_folder;
}

int picture_check(const struct command *c, const struct picture_options *o) {
    return !o->output || figure_ending(o->output)
               ? EXIT_DONE
               : command_usage(c, "'%s' must end in .png, .svg or .pdf", o->output);
}

static int cannot_write(const char *path, struct error *e) {
    return error_set(e, STATUS_SYSTEM, "cannot write %s: %s", path, strerror(errno));
}

// Paths of a script and its data.
struct pair {
    char script[PATH_SIZE], data[PATH_SIZE];
};

// FOLDER/NAME.gp and .dat; STATUS_INPUT if that is too long.
static int name_pair(const char *folder, const char *name, struct pair *p, struct error *e) {
    const int n = snprintf(p->script, sizeof p->script, "%s/%s.gp", folder, name);
    const int m = snprintf(p->data, sizeof p->data, "%s/%s.dat", folder, name);
    if (n < 0 || m < 0 || (size_t)m >= sizeof p->data) {
        return error_set(e, STATUS_INPUT, "the name of folder %.40s... is too long", folder);
    }
    return STATUS_OK;
}

// Publishes both files or none: removes the data if the script cannot be published.
static int publish_pair(struct partial_file *data, struct partial_file *script, struct error *e) {
    int status = partial_file_publish(data, e);
    if (status != STATUS_OK) {
        return status;
    }
    status = partial_file_publish(script, e);
    if (status != STATUS_OK) {
        unlink(data->path);
    }
    return status;
}

// Writes script and data; the script makes the file `picture`.
static int write_pair(const struct picture_request *q, const char *picture, const struct pair *p,
                      enum result_existing existing, struct error *e) {
    struct partial_file data = {0}, script = {0};
    int status = partial_file_open(&data, p->data, existing, e);
    if (status == STATUS_OK) {
        status = partial_file_open(&script, p->script, existing, e);
    }
    if (status == STATUS_OK) {
        const struct figure_files to = {script.to, data.to, picture};
        status = q->write(q->context, &to, e);
    }
    if (status == STATUS_OK) {
        status = publish_pair(&data, &script, e);
    }
    partial_file_drop(&script);
    partial_file_drop(&data);
    return status;
}

static int keep_script(const struct picture_request *q, struct error *e) {
    struct pair pair;
    char picture[64];
    assert(q->name);
    snprintf(picture, sizeof picture, "%s.%s", q->name,
             q->options.output ? figure_ending(q->options.output) : "png");
    if (strcmp(q->options.script_folder, "-") == 0) {
        return error_set(e, STATUS_INPUT, "--script takes a folder; ./- is one called -");
    }
    if (mkdir(q->options.script_folder, 0777) != 0 && errno != EEXIST) {
        return cannot_write(q->options.script_folder, e);
    }
    const int status = name_pair(q->options.script_folder, q->name, &pair, e);
    return status == STATUS_OK ? write_pair(q, picture, &pair, q->options.existing, e) : status;
}

// In the child: gnuplot in `folder`, its messages in the file `messages`.
static void become_gnuplot(const char *folder) {
    signal(SIGPIPE, SIG_DFL);
    signal(SIGXFSZ, SIG_DFL);
    if (chdir(folder) != 0) {
        _exit(NOT_FOUND - 1);
    }
    int messages = open("messages", O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (messages >= 0) {
        dup2(messages, STDOUT_FILENO);
        dup2(messages, STDERR_FILENO);
    }
    execlp("gnuplot", "gnuplot", "figure.gp", (char *)NULL);
    if (errno != ENOENT) {
        dprintf(STDERR_FILENO, "error: it cannot be started: %s\n", strerror(errno));
    }
    _exit(errno == ENOENT ? NOT_FOUND : NOT_FOUND - 1);
}

// Waits for the end of gnuplot. After that, no signal is sent to its number, which another process
// may have.
static int wait_for(pid_t child, int *state) {
    siginfo_t ended;
    int status;
    interrupt_also(child);
    do {
        status = waitid(P_PID, (id_t)child, &ended, WEXITED | WNOWAIT);
    } while (status != 0 && errno == EINTR);
    interrupt_also(0);
    return status == 0 && waitpid(child, state, 0) == child ? 0 : errno;
}

// Starts gnuplot and waits; a signal that is caught ends it, so that the folder can be removed.
static int spawn(const char *folder, int *state, struct error *e) {
    fflush(NULL);
    pid_t child = fork();
    if (child == 0) {
        become_gnuplot(folder);
    }
    const int cause = child < 0 ? errno : wait_for(child, state);
    return cause == 0 ? interrupt_check(e)
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
    char line[256];
    // The first line with text that gnuplot printed.
    char path[PATH_SIZE];
    snprintf(path, sizeof path, "%s/messages", folder);
    line[0] = '\0';
    FILE *from = fopen(path, "r");
    while (from && fgets(line, sizeof line, from)) {
        line[strcspn(line, "\n")] = '\0';
        if (strstr(line, "line ") || strstr(line, "rror")) {
            break;
        }
    }
    if (from) {
        fclose(from);
    }
    if (WIFEXITED(state) && WEXITSTATUS(state) == NOT_FOUND && !line[0]) {
        return error_set(e, STATUS_SYSTEM,
                         "cannot run gnuplot: it is not installed; --script DIR "
                         "writes the picture as a script");
    }
    if (WIFSIGNALED(state)) {
        return error_set(e, STATUS_SYSTEM, "gnuplot was ended by signal %d", WTERMSIG(state));
    }
    return error_set(e, STATUS_SYSTEM, "gnuplot failed: %s", line[0] ? line : "no message");
}

// gnuplot reports no error when the disk is full.
static bool is_whole(FILE *picture, const char *last_mark) {
    char tail[FIGURE_TAIL];
    const size_t n_mark = strlen(last_mark);
    const size_t n =
        fseek(picture, -FIGURE_TAIL, SEEK_END) == 0 ? fread(tail, 1, FIGURE_TAIL, picture) : 0;
    for (size_t i = 0; i + n_mark <= n; i++) {
        if (memcmp(tail + i, last_mark, n_mark) == 0) {
            return true;
        }
    }
    return false;
}

static int copy_into(FILE *to, FILE *from, const char *last_mark, struct error *e) {
    char block[BUFSIZ];
    for (size_t n; (n = fread(block, 1, sizeof block, from)) > 0;) {
        if (fwrite(block, 1, n, to) < n) {
            return STATUS_OK;  // reported when the file is published
        }
    }
    if (ferror(from)) {
        return error_set(e, STATUS_SYSTEM, "cannot read the picture: %s", strerror(errno));
    }
    return is_whole(from, last_mark)
               ? STATUS_OK
               : error_set(e, STATUS_SYSTEM,
                           "gnuplot could not write the whole picture; is the disk full?");
}

// Copies the picture next to its name, so that it can be given the name in one step.
static int copy(const char *from_path, const struct picture_request *q, struct error *e) {
    FILE *from = fopen(from_path, "rb");
    if (!from) {
        return error_set(e, STATUS_SYSTEM, "gnuplot made no picture");
    }
    struct partial_file partial;
    int status = partial_file_open(&partial, q->options.output, q->options.existing, e);
    if (status == STATUS_OK) {
        status = copy_into(partial.to, from, figure_last_mark(q->options.output), e);
    }
    if (status == STATUS_OK) {
        status = partial_file_publish(&partial, e);
    }
    partial_file_drop(&partial);
    fclose(from);
    return status;
}

static void remove_folder(const char *folder, const char *picture) {
    const char *const name[] = {"figure.gp", "figure.dat", "messages", picture};
    for (size_t i = 0; i < sizeof name / sizeof name[0]; i++) {
        char path[PATH_SIZE];
        snprintf(path, sizeof path, "%s/%s", folder, name[i]);
        unlink(path);
    }
    rmdir(folder);
}

static int draw_in(const struct picture_request *q, const char *folder, const char *picture,
                   struct error *e) {
    struct pair pair;
    char drawn[PATH_SIZE];
    snprintf(drawn, sizeof drawn, "%s/%s", folder, picture);
    int status = name_pair(folder, "figure", &pair, e);
    if (status == STATUS_OK) {
        status = write_pair(q, picture, &pair, RESULT_KEEP, e);
    }
    if (status == STATUS_OK) {
        status = interrupt_check(e);
    }
    if (status == STATUS_OK) {
        status = run_gnuplot(folder, e);
    }
    return status == STATUS_OK ? copy(drawn, q, e) : status;
}

static int draw(const struct picture_request *q, struct error *e) {
    int status = result_check_path(q->options.output, q->options.existing, e);
    if (status != STATUS_OK) {
        return status;
    }
    const char *root = getenv("TMPDIR");
    char folder[1024], picture[32];
    const int n =
        snprintf(folder, sizeof folder, "%s/jostle-plot-XXXXXX", root && root[0] ? root : "/tmp");
    if (n < 0 || (size_t)n >= sizeof folder || !mkdtemp(folder)) {
        return error_set(e, STATUS_SYSTEM, "cannot make a temporary folder in %s: %s",
                         root && root[0] ? root : "/tmp", strerror(errno));
    }
    snprintf(picture, sizeof picture, "figure.%s", figure_ending(q->options.output));
    status = draw_in(q, folder, picture, e);
    remove_folder(folder, picture);
    return status;
}

int picture_make(const struct picture_request *q, struct error *e) {
    interrupt_catch();
    int status = q->options.script_folder ? keep_script(q, e) : STATUS_OK;
    return status == STATUS_OK && q->options.output ? draw(q, e) : status;
}
