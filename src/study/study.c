// SPDX-License-Identifier: GPL-3.0-or-later
// A study from its deck to its file: plan, journal, pool, result.
#include "jostle/study.h"

#include <string.h>

#include "core/wall.h"
#include "jostle/study_merge.h"
#include "motion/record_cache.h"
#include "study/history.h"
#include "study/journal.h"
#include "study/manifest.h"
#include "study/origin.h"
#include "study/plan.h"
#include "study/pool.h"
#include "study/survey.h"
#include "study/trial.h"

struct study {
    const struct study_request *request;
    struct plan plan;
    struct manifest manifest;
    struct journal journal;
    struct study_origin origin;      // of the runs
    struct study_part part;          // if that is what is run
    struct study_progress progress;  // when all runs are done
    struct record_cache *records;    // for the models of runs with histories
    double start;                    // wall time [s]
};

static int expect_file(void *context, const char *name, const struct checksum *sum,
                       struct error *e) {
    struct study *s = context;
    return manifest_expect(&s->manifest, name, sum, e);
}

// Goes on as the user wants it although something has changed, and notes what.
static int accept_changes(struct study *s, const char *head, struct error *e) {
    struct arena *a = s->manifest.arena;
    const char *accepted = s->origin.accepted;
    int status = origin_accept(a, s->journal.head, head, &accepted, e);
    if (status == STATUS_INPUT) {
        const struct error cause = *e;
        return error_set(e, STATUS_INPUT,
                         "%s holds runs of a study of another shape: %s has changed; --restart "
                         "begins anew",
                         s->journal.path, cause.message);
    }
    for (const struct manifest_file *f = s->manifest.file; f && accepted; f = f->next) {
        accepted = f->changed ? arena_format(a, "%s%s\n", accepted, f->name) : accepted;
    }
    if (status != STATUS_OK || !accepted) {
        return status != STATUS_OK ? status : error_no_memory(e);
    }
    if (strcmp(accepted, s->origin.accepted) != 0) {
        s->origin.accepted = accepted;
        status = journal_accept(&s->journal, head, accepted, e);
    }
    // After the note, so that no kill between leaves the changed files without it.
    for (struct manifest_file *f = s->manifest.file; f && status == STATUS_OK; f = f->next) {
        if (f->changed) {
            f->changed = false;
            status = journal_add_file(&s->journal, f->name, &f->sum, e);
        }
    }
    return status;
}

#define ACCEPT_OR_RESTART "--accept keeps its finished runs, --restart begins anew"

static int check_changes(struct study *s, const char *head, struct error *e) {
    if (strcmp(s->journal.head, head) != 0) {
        int length;
        const char *cause = origin_difference(s->journal.head, head, &length);
        const char *accepted = "";
        const int status = origin_accept(s->manifest.arena, s->journal.head, head, &accepted, e);
        if (status == STATUS_SYSTEM) {
            return status;
        }
        return error_set(e, STATUS_INPUT,
                         "%s holds runs of this study, but %.*s has changed since; %s",
                         s->journal.path, length, cause,
                         status == STATUS_OK ? ACCEPT_OR_RESTART : "--restart begins anew");
    }
    int status = manifest_unchanged(&s->manifest, e);
    if (status == STATUS_INPUT) {
        const struct error cause = *e;
        return error_set(e, STATUS_INPUT, "%s; " ACCEPT_OR_RESTART, cause.message);
    }
    return status;
}

// A run whose histories are read.
struct recording {
    struct study *study;
    long run;                          // of the journal
    const struct result_place *place;  // in the result file; NULL: it is not written
};

static int fits(void *context, const struct model *m, struct study_outcome *outcome,
                struct error *e) {
    const struct recording *r = context;
    bool same = true;
    (void)outcome;
    const int status = history_fits(&r->study->journal, r->run, m, &same, e);
    if (status == STATUS_OK && !same) {
        journal_forget(&r->study->journal, r->run);
    }
    return status;
}

// Changes that were accepted may give other rows, as a longer record does: such a run is run again,
// as its histories would not fit the file. So is one whose deck is wrong now.
static int forget_misfits(struct study *s, struct error *e) {
    const struct trial_watch watch = {.records = s->records};
    int status = STATUS_OK;
    for (long i = 0; i < s->plan.n_mine && status == STATUS_OK; i++) {
        struct recording recording = {s, i, NULL};
        struct study_outcome outcome = {.status = STUDY_DONE};
        if (s->journal.offset[i] != 0 && s->journal.chain[i].n > 0) {
            status = trial_build(&s->plan, study_shard_run(&s->plan.shard, i), &watch, fits,
                                 &recording, &outcome, e);
        }
        if (status == STATUS_OK && outcome.status == STUDY_FAILED) {
            journal_forget(&s->journal, i);
        }
    }
    return status;
}

// Goes on with the runs of the open journal, or begins it anew.
static int resume(struct study *s, struct error *e) {
    const enum study_journal wanted = s->request->journal;
    const char *head = origin_journal(s->manifest.arena, s->request, s->origin.study);
    if (!head) {
        return error_no_memory(e);
    }
    if (wanted == STUDY_RESTART || journal_is_new(&s->journal, head)) {
        return journal_reset(&s->journal, head, e);
    }
    if (!s->journal.head) {
        return error_set(e, STATUS_INPUT,
                         "%s is damaged and may hold finished runs; --restart discards them",
                         s->journal.path);
    }
    if (!s->journal.head[0]) {
        return error_set(e, STATUS_INPUT,
                         "%s was written by another version of jostle, or on another kind of "
                         "machine; --restart begins anew",
                         s->journal.path);
    }
    int status = journal_load(&s->journal, expect_file, s, e);
    if (status != STATUS_OK) {
        return status;
    }
    s->origin.accepted = s->journal.accepted;
    if (wanted != STUDY_ACCEPT) {
        status = check_changes(s, head, e);
        status = status == STATUS_OK ? journal_go_on(&s->journal, e) : status;
    } else {
        status = journal_go_on(&s->journal, e);
        status = status == STATUS_OK ? accept_changes(s, head, e) : status;
    }
    const bool may_misfit = s->journal.chain && s->origin.accepted[0];
    return status == STATUS_OK && may_misfit ? forget_misfits(s, e) : status;
}

static int open_journal(struct study *s, struct error *e) {
    const char *path = arena_format(s->manifest.arena, "%s.runs", s->request->result.path);
    if (!path) {
        return error_no_memory(e);
    }
    int status = journal_open(&s->journal, path, s->plan.n_mine, s->plan.table->n_value, e);
    if (status != STATUS_OK) {
        return status;
    }
    if (s->plan.first->output.of_runs) {
        status = journal_want_histories(&s->journal, history_shape(s->plan.first), e);
    }
    status = status == STATUS_OK ? resume(s, e) : status;
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

// From the journal into the file.
static int record(void *context, const struct model *m, struct study_outcome *outcome,
                  struct error *e) {
    const struct recording *r = context;
    struct result_writer *writer;
    struct results *results = NULL;
    int status = result_create_in(r->place, m, r->study->request->result.version, &writer, e);
    if (status != STATUS_OK) {
        return status;
    }
    (void)outcome;
    const struct observer observer = result_observer(writer);
    status = history_replay(&r->study->journal, r->run, m, &observer, &results, e);
    if (status != STATUS_OK) {
        result_abort(writer);
        return status;
    }
    status = result_finish(writer, results, e);
    results_free(results);
    return status;
}

// The model says what the rows in the journal are of.
static int write_run(void *context, long run, const struct result_place *place, struct error *e) {
    struct study *s = context;
    const struct trial_watch watch = {.records = s->records};
    struct recording recording = {s, run, place};
    struct study_outcome outcome;
    const struct study_request *q = s->request;
    int status = q->poll ? q->poll(q->context, &s->progress, e) : STATUS_OK;
    if (status != STATUS_OK) {
        return status;
    }
    return trial_build(&s->plan, study_shard_run(&s->plan.shard, run), &watch, record, &recording,
                       &outcome, e);
}

static int run_and_write(struct study *s, struct study_content *content, struct study_progress *p,
                         struct error *e) {
    p->n_kept = s->journal.n_done;
    p->n_done = s->journal.n_done;
    p->n_failed = s->journal.n_failed;
    p->n_damaged = s->journal.n_damaged;
    int status = pool_run(s->request, &s->plan, &s->journal, &s->manifest, p, e);
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
    status = origin_describe(s->request, &s->manifest, &s->origin, e);
    if (status == STATUS_OK && s->request->shard.n > 0) {
        status = origin_part(&s->plan, &s->manifest, &s->part, e);
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
                                    .origin = &s->origin,
                                    .n_run = s->plan.n_mine,
                                    .read = read_runs,
                                    .context = s};
    if (s->plan.first->output.of_runs) {
        content.write_run = write_run;
        s->records = record_cache_create(RECORD_CACHE_BYTES);
        if (!s->records) {
            return error_no_memory(e);
        }
    }
    int status = study_file_check(&content, &s->request->result, e);
    if (status == STATUS_OK) {
        status = survey_shapes(&s->plan, e);
    }
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
        // A journal without runs is not left behind.
        if (s->journal.n_done == 0) {
            journal_remove(&s->journal);
        } else {
            journal_close(&s->journal);
        }
    }
    return status;
}

// Runs it, unless it is a part that is done.
static int find_or_run(struct study *s, struct study_progress *p, struct error *e) {
    bool found = false;
    int status =
        origin_study(s->manifest.arena, s->request, s->plan.table->n_value, &s->origin.study, e);
    if (status == STATUS_OK) {
        status =
            origin_find_part(s->request, &s->manifest, s->origin.study, &found, &p->n_failed, e);
    }
    if (status == STATUS_OK && found) {
        p->n_kept = p->n_done = p->n_run;
        return STATUS_OK;
    }
    return status == STATUS_OK ? run_study(s, p, e) : status;
}

int study_run(const struct study_request *q, struct study_progress *p, struct error *e) {
    struct study s = {.request = q, .origin = {.accepted = ""}, .start = wall_seconds()};
    *p = (struct study_progress){.n_run = study_shard_size(&q->shard, q->first->deck->n_run)};
    int status = plan_init(&s.plan, q, e);
    if (status != STATUS_OK) {
        return status;
    }
    status = manifest_init(&s.manifest, q->first->deck->path, e);
    if (status == STATUS_OK) {
        status = find_or_run(&s, p, e);
    }
    manifest_close(&s.manifest);
    record_cache_free(s.records);
    plan_close(&s.plan);
    return status;
}
