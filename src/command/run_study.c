// SPDX-License-Identifier: GPL-3.0-or-later
// jostle run on a deck with sweeps.
#include "command/deck_command.h"
#include "command/interrupt.h"
#include "command/run.h"
#include "command/show_study.h"
#include "command/study_end.h"
#include "command/study_progress.h"
#include "core/checksum.h"
#include "core/safe.h"
#include "jostle/numerics.h"

static int watch(void *context, const struct study_progress *p, struct error *e) {
    struct study_display *display = context;
    study_display_show(display, p);
    return interrupt_check(e);
}

// Tells builds apart in the result file; "" where the system does not show the program.
static struct checksum program_sum(void) {
    struct checksum sum;
    struct error e;
    return checksum_file("/proc/self/exe", &sum, &e) == STATUS_OK ? sum
                                                                  : (struct checksum){.digits = ""};
}

static void report_damage(const struct study_progress *p, const char *path) {
    if (p->n_damaged > 0) {
        safe_line(stderr,
                  "jostle: warning: %s.runs is damaged in %ld %s; of %ld runs %ld were found in "
                  "it, the others are run again",
                  path, p->n_damaged, p->n_damaged == 1 ? "place" : "places", p->n_run, p->n_kept);
    }
}

// What ended the study, and what is left of it.
static int report_error(const struct study_progress *p, const char *path, struct error *e) {
    int status = command_fail(e);
    if (p->n_left > 0) {
        const bool goes_on = e->status == STATUS_SYSTEM;  // else something must change first
        safe_line(stderr, "jostle: %ld of %ld runs are kept in %s.runs%s", p->n_left, p->n_run,
                  path, goes_on ? "; the same command goes on with them" : "");
    } else if (p->n_done > 0) {
        safe_line(stderr, "jostle: %s.runs is gone, and with it %ld of %ld runs", path, p->n_done,
                  p->n_run);
    }
    return status;
}

int run_study(const struct model *first, const struct run_options *o,
              const struct result_options *result) {
    struct study_display display;
    const struct study_request request = {
        .first = first,
        .define = o->load.define.word,
        .n_define = o->load.define.n,
        .n_thread = o->n_thread ? o->n_thread : deck_command_threads(),
        .shard = o->shard,
        .journal = o->journal,
        .numerics = NUMERICS_VERSION,
        .program = program_sum(),
        .result = *result,
        .poll = watch,
        .context = &display,
    };
    struct study_progress p;
    struct error e;
    study_display_start(&display, o->load.quiet ? DISPLAY_NOTHING : DISPLAY_PROGRESS);
    int status = study_run(&request, &p, &e);
    study_display_end(&display);
    if (!o->load.quiet) {
        report_damage(&p, result->path);
    }
    if (status != STATUS_OK) {
        return report_error(&p, result->path, &e);
    }
    if (!o->load.quiet && show_study_summary(result->path, stdout, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    return study_end(p.n_failed, p.n_run, result->path, p.failure);
}
