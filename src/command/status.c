// SPDX-License-Identifier: GPL-3.0-or-later
// jostle status: how far studies are.
#include "study/status.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "command/printer.h"
#include "core/arena.h"

static int status_command(int argc, char **argv);

const struct command command_status = {
    .name = "status",
    .usage = "FILE.h5|FOLDER...",
    .summary = "tells how far studies are: running, stopped and complete ones",
    .run = status_command,
};

struct options {
    enum printer_form form;
};
#define AT(member) offsetof(struct options, member)

static const char journal_ending[] = ".runs";

// The list of studies, a line each.
struct table {
    struct printer printer;
    struct arena *arena;
    struct journal_state sum;  // of all studies
    int n;                     // studies
};

static void print(struct table *t, const char *path, const char *stage,
                  const struct journal_state *s) {
    struct printer *p = &t->printer;
    printer_text(p, path);
    printer_text(p, stage);
    printer_whole(p, (long)s->n_run);
    printer_whole(p, (long)s->n_done);
    printer_whole(p, (long)s->n_failed);
    printer_whole(p, (long)s->n_collapsed);
    printer_whole(p, (long)(s->n_run - s->n_done));
    printer_number(p, s->seconds_left);
    printer_line(p);
}

static bool is_there(const char *path) {
    struct stat s;
    return stat(path, &s) == 0;
}

// A study by the name of its result file; its journal, where there is one, is newer.
static int add_study(struct table *t, const char *path, struct error *e) {
    static const char *const stages[] = {"complete", "running", "stopped"};
    const char *journal = arena_format(t->arena, "%s%s", path, journal_ending);
    struct status_found status;
    if (!journal) {
        return error_no_memory(e);
    }
    int result = is_there(journal) ? status_of_journal(journal, &status, e)
                                   : status_of_file(path, &status, e);
    if (result != STATUS_OK) {
        return result;
    }
    const struct journal_state *s = &status.state;
    print(t, path, stages[status.stage], s);
    t->n++;
    t->sum.n_run += s->n_run;
    t->sum.n_done += s->n_done;
    t->sum.n_failed += s->n_failed;
    t->sum.n_collapsed += s->n_collapsed;
    t->sum.seconds_left += s->seconds_left;  // NaN if one is not known
    return STATUS_OK;
}

// The length of `name` without the ending; 0: it has another one.
static size_t without(const char *name, const char *ending) {
    const size_t n = strlen(name), m = strlen(ending);
    return n > m && strcmp(name + n - m, ending) == 0 ? n - m : 0;
}

static int by_name(const void *a, const void *b) {
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

// The names of result files in the folder: those that are there, and those of journals.
static int list_folder(struct table *t, const char *path, struct words *out, struct error *e) {
    DIR *folder = opendir(path);
    int capacity = 0;
    const struct dirent *entry;
    *out = (struct words){.n = 0};
    if (!folder) {
        return error_set(e, STATUS_INPUT, "cannot read the folder %s: %s", path, strerror(errno));
    }
    while ((entry = readdir(folder))) {
        const size_t journal = without(entry->d_name, journal_ending);
        const size_t n = journal ? journal : strlen(entry->d_name);
        const char *file = arena_format(t->arena, "%s/%.*s", path, (int)n, entry->d_name);
        if (out->n == capacity) {
            capacity = 2 * capacity + 64;
            const char **more = realloc(out->word, (size_t)capacity * sizeof *more);
            out->word = more ? more : out->word;
            file = more ? file : NULL;
        }
        if (!file) {
            closedir(folder);
            return error_no_memory(e);
        }
        if (journal || (without(file, ".h5") && study_file_is_study(file))) {
            out->word[out->n++] = file;
        }
    }
    closedir(folder);
    if (out->n > 0) {
        qsort(out->word, (size_t)out->n, sizeof *out->word, by_name);
    }
    return STATUS_OK;
}

static int add_folder(struct table *t, const char *path, struct error *e) {
    struct words list;
    int status = list_folder(t, path, &list, e);
    if (status == STATUS_OK && list.n == 0) {
        status = error_set(e, STATUS_INPUT,
                           "the folder %s has no study: no NAME.h5 of a study and no "
                           "NAME.h5.runs",
                           path);
    }
    for (int i = 0; i < list.n && status == STATUS_OK; i++) {
        if (i == 0 || strcmp(list.word[i], list.word[i - 1]) != 0) {
            status = add_study(t, list.word[i], e);
        }
    }
    free(list.word);
    return status;
}

static int add_operand(struct table *t, const char *path, struct error *e) {
    struct stat s;
    if (stat(path, &s) == 0 && S_ISDIR(s.st_mode)) {
        return add_folder(t, path, e);
    }
    const size_t n = without(path, journal_ending);
    const char *file = n ? arena_format(t->arena, "%.*s", (int)n, path) : path;
    return file ? add_study(t, file, e) : error_no_memory(e);
}

static int use(void *options, struct arena *a, const struct words *operand) {
    static const struct printer_column columns[] = {
        {"", "file", .width = -24, .look = LOOK_TAIL},
        {"", "state", .width = -9},
        {"runs", "runs", .width = 9},
        {"done", "done", .width = 9},
        {"failed", "failed", .width = 8},
        {"collapsed", "collapsed", .width = 10},
        {"left", "left", .width = 9},
        {"time left", "time_left", "s", .width = 12, .digits = 3},
    };
    const struct options *o = options;
    struct table t = {.printer = {.to = stdout, .form = o->form}, .arena = a};
    struct error e;
    int status = STATUS_OK;
    if (operand->n < 1) {
        return command_usage(&command_status, "result files or folders are expected");
    }
    PRINTER_ADD(&t.printer, columns);
    printer_head(&t.printer);
    for (int i = 0; i < operand->n && status == STATUS_OK; i++) {
        status = add_operand(&t, operand->word[i], &e);
    }
    if (status == STATUS_OK && t.n > 1 && o->form == FORM_TEXT) {
        print(&t, "all", "", &t.sum);
    }
    status = printer_end(&t.printer, status, &e);
    return status == STATUS_OK ? EXIT_DONE : command_fail(&e);
}

static int status_command(int argc, char **argv) {
    static const struct option_row rows[] = {{"tsv", .kind = OPTION_SET, .at = AT(form),
                                              .set = FORM_TSV, .doc = "a table separated by tabs"},
                                             {0}};
    static const struct option_part parts[] = {
        {.text = "Of a study that runs or has been stopped, jostle reads the journal FILE.h5.runs, "
                 "of a complete one\nthe file; of a FOLDER all studies in it. A study counts as "
                 "stopped if it has written nothing\nfor 15 s. The time that is left is estimated "
                 "by the steps of the runs.\n\n"},
        {.row = rows},
        {.row = printer_rows, .at = AT(form)},
        {.row = option_help},
        {0}};
    static const struct option_list list = {&command_status, parts, .use = use};
    struct options o = {.form = FORM_TEXT};
    return option_run(&list, argc, argv, &o);
}
