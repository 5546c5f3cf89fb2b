// SPDX-License-Identifier: GPL-3.0-or-later
// A study from its deck to its file: plan, journal, pool, result.
#include "jostle/study.h"

#include <string.h>

#include "core/wall.h"
#include "jostle/study_merge.h"
#include "motion/shelf.h"
#include "study/identity.h"
#include "study/journal.h"
#include "study/ledger.h"
#include "study/plan.h"
#include "study/pool.h"
#include "study/portion.h"
#include "study/trial.h"

struct study {
    const struct study_request *request;
    struct plan plan;
    struct ledger ledger;
    struct journal journal;
    const char *identity;            // of the study
    struct study_part part;          // if that is what is run
    struct study_progress progress;  // when all runs are done
    struct shelf *records;           // for those that are run again
    double start;                    // wall time [s]
};

static int expect_file(void *context, const char *path, uint64_t sum, struct error *e) {
    struct study *s = context;
    return ledger_expect(&s->ledger, path, sum, e);
}

// Goes on with the runs of the open journal, or begins it anew.
static int resume(struct study *s, struct error *e) {
    const char *head = identity_journal(s->ledger.arena, s->request, s->identity);
    if (!head) {
        return error_no_memory(e);
    }
    if (s->request->journal == STUDY_RESTART || journal_is_new(&s->journal, head)) {
        return journal_reset(&s->journal, head, e);
    }
    if (!s->journal.head) {
        return error_set(e, STATUS_INPUT,
                         "%s may hold runs of this study, but its head is damaged; --restart "
                         "begins anew",
                         s->journal.path);
    }
    if (strcmp(s->journal.head, head) != 0) {
        int length;
        const char *cause = identity_difference(s->journal.head, head, &length);
        return error_set(e, STATUS_INPUT,
                         "%s holds runs of this study, but %.*s has changed since; --restart "
                         "begins anew",
                         s->journal.path, length, cause);
    }
    int status = journal_load(&s->journal, expect_file, s, e);
    if (status == STATUS_INPUT) {
        const struct error cause = *e;
        return error_set(e, STATUS_INPUT, "%s; --restart begins the study anew", cause.message);
    }
    return status;
}

static int open_journal(struct study *s, struct error *e) {
    const char *path = arena_format(s->ledger.arena, "%s.runs", s->request->result.path);
    if (!path) {
        return error_no_memory(e);
    }
    int status = journal_open(&s->journal, path, s->plan.n_mine, s->plan.table->n_value, e);
    if (status != STATUS_OK) {
        return status;
    }
    status = resume(s, e);
    if (status != STATUS_OK) {
        journal_close(&s->journal);
    }
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

// A run on its way into the result file.
struct recording {
    const struct study *study;
    const struct result_place *place;
};

// The analysis was done before without an error, and gives the same again.
static int record(void *context, const struct model *m, struct study_outcome *outcome,
                  struct error *e) {
    const struct recording *r = context;
    struct result_writer *writer;
    struct results *results;
    int status = result_create_in(r->place, m, r->study->request->result.version, &writer, e);
    if (status != STATUS_OK) {
        return status;
    }
    (void)outcome;
    status = result_analyse(writer, NULL, &results, e);
    if (status == STATUS_OK) {
        results_free(results);
    }
    return status;
}

// The histories of a run are not kept in the journal: it is run again.
static int write_run(void *context, long run, const struct result_place *place, struct error *e) {
    struct study *s = context;
    const struct trial_watch watch = {.records = s->records};
    struct recording recording = {s, place};
    struct study_outcome outcome;
    const struct study_request *q = s->request;
    int status = q->poll ? q->poll(q->context, &s->progress, e) : STATUS_OK;
    if (status != STATUS_OK) {
        return status;
    }
    return trial_build(&s->plan, study_shard_run(&s->plan.shard, run), &watch, record, &recording,
                       &outcome, e);
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
    p->n_damaged = s->journal.n_damaged;
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
    content->seconds = wall_seconds() - s->start;
    if (s->request->shard.n > 0) {
        status = portion_describe(&s->plan, &s->ledger, s->identity, &s->part, e);
        s->part.n_failed = p->n_failed;
        content->part = &s->part;
    }
    s->progress = *p;
    return status == STATUS_OK ? study_file_write(content, &s->request->result, e) : status;
}

static int run_study(struct study *s, struct study_progress *p, struct error *e) {
    struct study_content content = {.first = s->plan.report,
                                    .table = s->plan.table,
                                    .sweeps = s->plan.first->deck->sweeps,
                                    .n_run = s->plan.n_mine,
                                    .read = read_runs,
                                    .context = s};
    if (s->plan.first->output.of_runs) {
        content.write_run = write_run;
        s->records = shelf_create(SHELF_BYTES);
        if (!s->records) {
            return error_no_memory(e);
        }
    }
    int status = study_file_check(&content, &s->request->result, e);
    if (status == STATUS_OK) {
        status = open_journal(s, e);
    }
    if (status != STATUS_OK) {
        return status;
    }
    status = run_and_write(s, &content, p, e);
    if (status == STATUS_OK) {
        journal_remove(&s->journal);
    } else {
        p->n_left = journal_is_there(&s->journal) ? s->journal.n_done : 0;
        close_journal(s);
    }
    return status;
}

// Runs it, unless it is a part that is done.
static int find_or_run(struct study *s, struct study_progress *p, struct error *e) {
    bool found = false;
    s->identity = identity_study(s->ledger.arena, s->request, s->plan.table->n_value);
    int status = s->identity
                     ? portion_find(s->request, &s->ledger, s->identity, &found, &p->n_failed, e)
                     : error_no_memory(e);
    if (status == STATUS_OK && found) {
        p->n_kept = p->n_done = p->n_run;
        return STATUS_OK;
    }
    return status == STATUS_OK ? run_study(s, p, e) : status;
}

int study_run(const struct study_request *q, struct study_progress *p, struct error *e) {
    struct study s = {.request = q, .start = wall_seconds()};
    *p = (struct study_progress){.n_run = study_shard_size(&q->shard, q->first->deck->n_run)};
    int status = plan_init(&s.plan, q, e);
    if (status != STATUS_OK) {
        return status;
    }
    status = ledger_init(&s.ledger, e);
    if (status == STATUS_OK) {
        status = find_or_run(&s, p, e);
    }
    ledger_close(&s.ledger);
    shelf_free(s.records);
    plan_close(&s.plan);
    return status;
}
