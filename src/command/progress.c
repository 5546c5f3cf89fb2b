// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/progress.h"

#include <stdio.h>
#include <unistd.h>

#include "command/interrupt.h"
#include "core/text.h"
#include "core/wall.h"

static const double FIRST = 1.0, INTERVAL = 0.2;  // [s]

void progress_start(struct progress *p, double duration, const char *unit) {
    *p = (struct progress){.duration = duration,
                           .unit = unit,
                           .enabled = isatty(STDERR_FILENO) != 0,
                           .start = wall_seconds()};
    p->last = p->start;
}

void progress_show(struct progress *p, double time) {
    double wall = wall_seconds();
    if (!p->enabled || wall - p->start < FIRST || wall - p->last < INTERVAL || time <= 0.0) {
        return;
    }
    struct text_exact done, all;
    double share = time / p->duration;
    fprintf(stderr, "\r%s of %s %s, %3.0f %%, %.0f s left \033[K", text_rounded(&done, time, 4),
            text_rounded(&all, p->duration, 4), p->unit, 100.0 * share,
            (wall - p->start) * (1.0 - share) / share);
    fflush(stderr);
    p->last = wall;
    p->shown = true;
}

void progress_tell(void *context, long n_done, long n) {
    struct progress *p = context;
    p->duration = (double)n;
    progress_show(p, (double)n_done);
}

int progress_poll(void *context, long n_done, struct error *e) {
    progress_show(context, (double)n_done);
    return interrupt_check(e);
}

void progress_end(struct progress *p) {
    if (p->shown) {
        fprintf(stderr, "\r\033[K");
        p->shown = false;
    }
}
