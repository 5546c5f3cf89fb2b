// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/progress.h"

#include <stdio.h>
#include <unistd.h>

#include "command/command.h"
#include "core/text.h"
#include "core/wall.h"

static const double TERMINAL_INTERVAL = 0.5, INTERVAL = 10.0;  // [s]

void study_display_start(struct study_display *d, enum display display) {
    *d = (struct study_display){
        .display = display, .terminal = isatty(STDERR_FILENO) != 0, .start = wall_seconds()};
    d->last = d->start;
}

void study_display_show(struct study_display *d, const struct study_progress *p) {
    const double wall = wall_seconds();
    if (d->display == DISPLAY_NOTHING ||
        wall - d->last < (d->terminal ? TERMINAL_INTERVAL : INTERVAL)) {
        return;
    }
    const long mine = p->n_done - p->n_kept;
    const double rate = (double)mine / (wall - d->start);
    fprintf(stderr, "%s%ld of %ld runs, %ld failed", d->terminal ? "\r" : "", p->n_done, p->n_run,
            p->n_failed);
    if (mine > 0) {
        struct text_exact t;
        fprintf(stderr, ", %s runs/s, ", text_rounded(&t, rate, 3));
        const double left = (double)(p->n_run - p->n_done) / rate;  // for runs of one length
        // A time as an engineer says it: 42 s, 5 min 10 s, 3 h 20 min.
        const long s = (long)((p->seconds_left > 0.0 ? p->seconds_left : left) + 0.5);
        if (s < 60) {
            fprintf(stderr, "%ld s", s);
        } else if (s < 3600) {
            fprintf(stderr, "%ld min %ld s", s / 60, s % 60);
        } else {
            fprintf(stderr, "%ld h %ld min", s / 3600, s / 60 % 60);
        }
        fprintf(stderr, " left");
    }
    fprintf(stderr, d->terminal ? " \033[K" : "\n");
    fflush(stderr);
    d->last = wall;
    d->shown = d->terminal;
}

void study_display_end(struct study_display *d) {
    if (d->shown) {
        fprintf(stderr, "\r\033[K");
        d->shown = false;
    }
}

int study_display_status(long n_failed, long n_run, const char *path, const char *first) {
    if (n_failed == 0) {
        return EXIT_DONE;
    }
    struct error e;
    error_set(&e, STATUS_FAILED, "%ld of %ld runs failed; /message in %s says why%s%s", n_failed,
              n_run, path, first[0] ? ", the first: " : "", first);
    return command_fail(&e);
}
