// SPDX-License-Identifier: GPL-3.0-or-later
// A study from its deck to its file: plan, journal, pool, result.
#include "jostle/study.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "core/checksum.h"
#include "study/journal.h"
#include "study/ledger.h"
#include "study/plan.h"
#include "study/pool.h"

struct study {
    const struct study_request *request;
    struct plan plan;
    struct ledger ledger;
    struct journal journal;
    double start;  // wall time [s]
};

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static uint64_t sum_text(uint64_t sum, const char *text) {
    return checksum_add(sum, text, strlen(text) + 1);
}

static uint64_t sum_sweep(const struct sweep *s) {
    uint64_t sum = checksum_start;
    for (; s; s = s->along) {
        sum = sum_text(sum, s->name);
        for (int i = 0; i < s->n; i++) {
            sum = s->number ? checksum_add(sum, &s->number[i], sizeof s->number[i])
                            : sum_text(sum, s->text[i]);
        }
    }
    return sum;
}

// Which study this is: a line for each thing that must not change, opened by what a message calls
// it.
static const char *describe(const struct study *s) {
    const struct study_request *q = s->request;
    const struct deck *deck = q->first->deck;
    struct arena *a = s->ledger.arena;
    uint64_t define = checksum_start;
    for (int i = 0; i < q->n_define; i++) {
        define = sum_text(define, q->define[i]);
    }
    const char *text = arena_format(a,
                                    "the program\t%s %016" PRIx64 "\nthe deck\t%016" PRIx64
                                    "\n-D\t%016" PRIx64 "\nthe folder of the deck\t%s\n",
                                    q->result.version, q->program,
                                    sum_text(checksum_start, deck->text), define, deck->path);
    for (const struct sweep *w = deck->sweeps; w && text; w = w->next) {
        text = arena_format(a, "%sthe list of values of '%s'\t%d %016" PRIx64 "\n", text, w->name,
                            w->n, sum_sweep(w));
    }
    return text ? arena_format(a, "%sthe number of results\t%zu\n", text, s->plan.table->n_value)
                : NULL;
}

// What has changed between two descriptions, to end at *end.
static const char *difference(const char *old, const char *new, int *length) {
    size_t line = 0;
    for (size_t i = 0; old[i] == new[i] && old[i]; i++) {
        line = old[i] == '\n' ? i + 1 : line;
    }
    const char *from = new[line] ? new + line : old + line;
    *length = (int)strcspn(from, "\t\n");
    return from;
}

static int expect_file(void *context, const char *path, uint64_t sum, struct error *e) {
    struct study *s = context;
    return ledger_expect(&s->ledger, path, sum, e);
}

static int refuse(const struct study *s, const char *cause, int length, struct error *e) {
    return error_set(e, STATUS_INPUT,
                     "%s holds runs of this study, but %.*s has changed since; --restart begins "
                     "anew",
                     s->journal.path, length, cause);
}

// Takes up the journal, or begins it.
static int open_journal(struct study *s, struct error *e) {
    const char *head = describe(s);
    if (!head) {
        return error_no_memory(e);
    }
    if (!s->journal.head || s->request->journal == STUDY_RESTART) {
        return journal_reset(&s->journal, head, e);
    }
    if (strcmp(s->journal.head, head) != 0) {
        int length;
        const char *cause = difference(s->journal.head, head, &length);
        return refuse(s, cause, length, e);
    }
    struct error cause;
    int status = journal_load(&s->journal, expect_file, s, &cause);
    if (status == STATUS_INPUT) {
        return error_set(e, STATUS_INPUT, "%s; --restart begins the study anew", cause.message);
    }
    *e = cause;
    return status;
}

static int read_runs(void *context, long first, long n, struct study_outcome *outcome,
                     double *value, struct error *e) {
    struct study *s = context;
    int status = STATUS_OK;
    for (long i = 0; i < n && status == STATUS_OK; i++) {
        status = journal_read(&s->journal, first + i, &outcome[i],
                              value + (size_t)i * s->plan.table->n_value, e);
    }
    return status;
}

// A journal without runs is not left behind.
static void close_journal(struct study *s) {
    if (s->journal.n_done == 0) {
        journal_remove(&s->journal);
    } else {
        journal_close(&s->journal);
    }
}

static int run_and_write(struct study *s, struct study_content *content, struct study_progress *p,
                         struct error *e) {
    p->n_kept = s->journal.n_done;
    p->n_done = s->journal.n_done;
    p->n_failed = s->journal.n_failed;
    int status = pool_run(s->request, &s->plan, &s->journal, &s->ledger, p, e);
    struct error sync;
    int synced = journal_sync(&s->journal, &sync);
    if (status == STATUS_OK && synced != STATUS_OK) {
        *e = sync;
        status = synced;
    }
    if (status != STATUS_OK) {
        return status;
    }
    content->n_kept = p->n_kept;
    content->n_thread = p->n_thread;
    content->seconds = now() - s->start;
    return study_file_write(content, &s->request->result, e);
}

static int run_study(struct study *s, struct study_progress *p, struct error *e) {
    const struct result_options *result = &s->request->result;
    struct study_content content = {.first = s->plan.report,
                                    .table = s->plan.table,
                                    .sweeps = s->plan.first->deck->sweeps,
                                    .n_run = s->plan.n_run,
                                    .read = read_runs,
                                    .context = s};
    int status = study_file_check(&content, result, e);
    const char *path = arena_format(s->ledger.arena, "%s.runs", result->path);
    if (status == STATUS_OK && !path) {
        status = error_no_memory(e);
    }
    if (status == STATUS_OK) {
        status = journal_open(&s->journal, path, s->plan.n_run, s->plan.table->n_value, e);
    }
    if (status != STATUS_OK) {
        return status;
    }
    status = open_journal(s, e);
    if (status != STATUS_OK) {
        journal_close(&s->journal);
        return status;
    }
    status = run_and_write(s, &content, p, e);
    if (status == STATUS_OK) {
        journal_remove(&s->journal);
    } else {
        close_journal(s);
    }
    return status;
}

int study_run(const struct study_request *q, struct study_progress *p, struct error *e) {
    struct study s = {.request = q, .start = now()};
    *p = (struct study_progress){.n_run = q->first->deck->n_run};
    int status =
        plan_init(&s.plan, q->first, q->define, q->n_define, q->result.path, q->result.version, e);
    if (status != STATUS_OK) {
        return status;
    }
    status = ledger_init(&s.ledger, e);
    if (status == STATUS_OK) {
        status = run_study(&s, p, e);
    }
    ledger_close(&s.ledger);
    plan_close(&s.plan);
    return status;
}
