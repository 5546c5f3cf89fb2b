// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/study_deck.h"

#include <string.h>

#include "command/interrupt.h"
#include "core/arena.h"

// The -D of the study as an array; NULL: no memory.
static const char **split_lines(struct arena *a, const char *lines, int *n) {
    char *text = arena_text(a, lines, strlen(lines));
    const char **line = arena_alloc(a, strlen(lines) + 1, sizeof *line);
    *n = 0;
    for (char *at = text; line && at && *at;) {
        char *end = at + strcspn(at, "\n");
        line[(*n)++] = at;
        at = end + (*end == '\n');
        *end = '\0';
    }
    return text ? line : NULL;
}

int study_deck_open(struct study_file *f, const char *path, struct study_deck *out) {
    struct error e;
    *out = (struct study_deck){.report = NULL};
    if (study_file_report(f, &out->report, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    const char *define = study_file_view(f)->origin.define;
    out->load.quiet = true;
    out->load.path = path ? path : out->report->deck_file;
    out->load.define.word =
        split_lines(out->report->arena, define ? define : "", &out->load.define.n);
    return out->load.define.word ? deck_command_load(&out->load, &out->model) : command_no_memory();
}

void study_deck_close(struct study_deck *d) {
    model_free(d->model);
    report_free(d->report);
}

static int poll_signal(void *context, long n_done, struct error *e) {
    (void)context, (void)n_done;
    return interrupt_check(e);
}

int study_deck_measure(struct study_file *f, const char *path, const struct measure *measure, int n,
                       double *value) {
    struct study_deck d;
    struct error e;
    int status = study_deck_open(f, path, &d);
    if (status == EXIT_DONE) {
        const struct measure_request q = {.first = d.model,
                                          .define = d.load.define.word,
                                          .n_define = d.load.define.n,
                                          .n_thread = deck_command_threads(),
                                          .poll = poll_signal};
        interrupt_catch();
        if (measure_runs(study_file_view(f), &q, measure, n, value, &e) != STATUS_OK) {
            status = command_fail(&e);
        }
    }
    study_deck_close(&d);
    return status;
}
