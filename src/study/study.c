// SPDX-License-Identifier: GPL-3.0-or-later
// A study from its deck to its file: plan, keys, finished runs, pool, result.
#include "jostle/study.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/wall.h"
#include "jostle/study_merge.h"
#include "motion/record_cache.h"
#include "study/history.h"
#include "study/journal.h"
#include "study/keys.h"
#include "study/manifest.h"
#include "study/number_list.h"
#include "study/origin.h"
#include "study/plan.h"
#include "study/pool.h"
#include "study/recording.h"
#include "study/selection.h"
#include "study/survey.h"
#include "study/take.h"
#include "study/trial.h"

struct study {
    const struct study_request *request;
    const char *again;             // which finished runs are run again with histories; NULL: none
    struct study_progress *told;   // of the caller
    struct result_options result;  // of the request; a file that grows is replaced
    struct plan plan;
    struct manifest manifest;
    struct keys keys;
    struct journal journal;
    struct take_file *file;  // (n_file) finished runs: run i is row -offset[i] - 1 of all of them
    int n_file;
    int64_t n_row;                 // rows of the files
    long n_taken;                  // runs that are taken from them
    unsigned char *chosen;         // (n_mine) runs that are run again for their histories
    struct study_content content;  // of the result file
    struct study_origin origin;    // of the runs
    struct study_part part;        // if that is what is run
    struct record_cache *records;  // for models that are built besides the runs
    double start;                  // wall time [s]
};

static const char *noun(const struct study *s) {
    return s->request->shard.n > 0 ? "part of the study" : "study";
}

// Does the deck want the histories of all runs?
static bool wants_all(const struct study *s) {
    return s->plan.first->output.of_runs;
}

static int open_journal(struct study *s, struct error *e) {
    const char *path = arena_format(s->manifest.arena, "%s.runs", s->result.path);
    const char *head = origin_journal(s->manifest.arena, s->plan.table);
    if (!path || !head) {
        return error_no_memory(e);
    }
    int status = journal_open(&s->journal, path, &s->keys, s->plan.table->n_value, e);
    if (status == STATUS_OK && (wants_all(s) || s->again)) {
        status = journal_want_histories(&s->journal, history_shape(s->plan.first), e);
    }
    s->journal.retry = s->request->retry;
    return status == STATUS_OK ? journal_resume(&s->journal, head, s->request->journal, noun(s), e)
                               : status;
}

// Reads run `run` from row number `row`, from 1, of all files together.
static int read_taken(struct study *s, long run, int64_t row, struct study_outcome *outcome,
                      double *value, struct error *e) {
    int k = 0;
    long i = (long)row - 1;
    for (; i >= s->file[k].view->n_run; k++) {
        i -= s->file[k].view->n_run;
    }
    const int status = take_row(&s->file[k], i, outcome, value, e);
    return status == STATUS_OK && s->file[k].lacks && outcome->status == STUDY_DONE
               ? take_fill(&s->file[k], &s->plan, run, s->records, value, e)
               : status;
}

static int read_runs(void *context, long first, long n, struct study_outcome *outcome,
                     double *value, struct error *e) {
    struct study *s = context;
    int status = STATUS_OK;
    for (long i = 0; i < n && status == STATUS_OK; i++) {
        const int64_t at = s->journal.offset[first + i];
        double *to = value + (size_t)i * s->plan.table->n_value;
        status = at > 0 ? journal_read(&s->journal, first + i, &outcome[i], to, e)
                        : read_taken(s, first + i, -at, &outcome[i], to, e);
    }
    return status;
}

static int write_run(void *context, long run, const struct result_place *place, struct error *e) {
    struct study *s = context;
    const struct recording recording = {s->request, &s->plan, &s->journal, s->records, s->told};
    return recording_write(&recording, run, place, e);
}

static int run_and_write(struct study *s, struct study_progress *p, struct error *e) {
    struct study_content *content = &s->content;
    int status = study_file_check(content, &s->result, e);
    if (status == STATUS_OK && s->journal.n_done < s->plan.n_mine) {
        status = survey_shapes(&s->plan, e);
    }
    if (status != STATUS_OK) {
        return status;
    }
    p->n_kept = s->journal.n_done;
    p->n_done = s->journal.n_done;
    p->n_failed = s->journal.n_failed;
    p->n_damaged = s->journal.n_damaged;
    status = pool_run(s->request, &s->plan, &s->journal, &s->keys, &s->manifest, p, e);
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
    s->origin.key = s->keys.key;
    status = origin_describe(s->request, &s->manifest, &s->origin, e);
    if (status == STATUS_OK && s->request->shard.n > 0) {
        status = origin_part(&s->plan, &s->manifest, &s->part, e);
        s->part.n_failed = p->n_failed;
        content->part = &s->part;
    }
    return status == STATUS_OK ? study_file_write(content, &s->result, e) : status;
}

// Is the file just this study? Then there is nothing to be done, unless runs may read other files
// than before.
static bool is_same(const struct study *s, const struct study_view *v,
                    const struct study_key *key) {
    const struct study_shard *a = &v->part.shard, *b = &s->request->shard;
    const size_t n = (size_t)s->keys.n;
    for (long i = 0; i < s->keys.n; i++) {
        if (!s->again && !keys_is_known(&s->keys.key[i])) {
            return false;
        }
    }
    return (size_t)v->n_run == n && a->number == b->number && a->n == b->n &&
           memcmp(key, s->keys.key, n * sizeof *key) == 0 && v->origin.study &&
           strcmp(v->origin.study, s->origin.study) == 0 &&
           strcmp(v->title, s->plan.first->deck->title) == 0 && (v->has_histories || !wants_all(s));
}

// What a file of finished runs has.
struct stock {
    bool same;               // it is the file of just this study
    long n_other, n_failed;  // runs that this study does not have; that failed
};

// Chooses the runs of the file of just this study that get histories, and with each run the first
// one of the same key. If there are any, the file is not the same any more.
static int choose(struct study *s, const struct take_file *t, struct stock *old, struct error *e) {
    struct number_list numbers = {.text = s->told->histories, .size = sizeof s->told->histories};
    if (!old->same) {
        return error_set(e, STATUS_INPUT, "%s does not have all runs of this %s", t->view->path,
                         noun(s));
    }
    s->chosen = calloc((size_t)s->keys.n + 1, 1);
    if (!s->chosen) {
        return error_no_memory(e);
    }
    const int status = selection_read(t->file, s->again, s->chosen, e);
    for (long i = 0; i < s->keys.n && status == STATUS_OK; i++) {
        if (s->chosen[i]) {
            const long first = keys_find(&s->keys, &s->keys.key[i]);
            s->chosen[first < 0 ? i : first] = 1;
            number_list_add(&numbers, study_shard_run(&s->plan.shard, i) + 1);
        }
    }
    number_list_end(&numbers);
    s->content.chosen = s->chosen;
    old->same = numbers.n == 0;
    return status;
}

// Takes the runs of the last file that this study has too.
static int take_runs(struct study *s, struct stock *out, struct error *e) {
    struct take_file *t = &s->file[s->n_file - 1];
    struct study_key *key = NULL;
    int *ending = NULL;
    int status = study_file_keys(t->file, &key, e);
    if (status == STATUS_OK && !key) {
        status = error_set(e, STATUS_INPUT,
                           "%s does not have the keys of its runs: an earlier version wrote it",
                           t->view->path);
    }
    status = status == STATUS_OK ? study_file_endings(t->file, &ending, e) : status;
    *out = (struct stock){.same = key && status == STATUS_OK && is_same(s, t->view, key)};
    if (status == STATUS_OK && s->again) {
        status = choose(s, t, out, e);
    }
    for (long i = 0; i < t->view->n_run && status == STATUS_OK; i++) {
        const int how = ending[i] & STUDY_STATUS;
        out->n_failed += how == STUDY_FAILED;
        if (how == STUDY_MISSING || (how == STUDY_FAILED && s->request->retry)) {
            out->same = false;
            continue;
        }
        const long first = keys_find(&s->keys, &key[i]);
        if (s->chosen && first >= 0 && s->chosen[first]) {
            continue;
        }
        const bool found = t->item ? journal_take(&s->journal, &key[i], s->n_row + i + 1, how,
                                                  (ending[i] & STUDY_COLLAPSED) != 0)
                                   : first >= 0;
        out->n_other += !found && keys_is_known(&key[i]);
    }
    s->n_row += t->view->n_run;
    free(key);
    free(ending);
    return status;
}

// Opens a file of finished runs as the last one. Those with histories come from the journal only.
static int open_file(struct study *s, const char *path, struct error *e) {
    struct take_file *t = &s->file[s->n_file++];
    const int status = take_open(t, path, e);
    return status == STATUS_OK && !wants_all(s)
               ? take_map(t, s->plan.table, s->plan.first->deck->sweeps, e)
               : status;
}

// The result file that is there may be replaced if this study has all of its runs.
static int take_old(struct study *s, struct stock *out, struct error *e) {
    const char *path = s->result.path;
    int status = open_file(s, path, e);
    status = status == STATUS_OK ? take_runs(s, out, e) : status;
    const struct error cause = *e;
    if (status == STATUS_INPUT) {
        return error_set(e, status, "%s; --force overwrites it", cause.message);
    }
    if (status == STATUS_OK && out->n_other > 0) {
        return error_set(e, STATUS_INPUT,
                         "%s holds %ld finished runs that this %s does not have, as the deck or a "
                         "file has changed; --force overwrites it, -o NAME.h5 --take %s keeps it",
                         path, out->n_other, noun(s), path);
    }
    if (status == STATUS_OK && !wants_all(s)) {
        s->result.existing = RESULT_REPLACE;
        s->told->left_histories = s->file->view->has_histories && !s->chosen && !out->same;
    }
    return status;
}

static int take_all(struct study *s, bool has_old, struct stock *old, struct error *e) {
    const struct study_request *q = s->request;
    s->file = calloc((size_t)q->n_take + 1, sizeof *s->file);
    if (!s->file) {
        return error_no_memory(e);
    }
    int status = has_old ? take_old(s, old, e) : STATUS_OK;
    for (int k = 0; k < q->n_take && status == STATUS_OK && !old->same; k++) {
        struct stock stock;
        if (wants_all(s)) {
            return error_set(e, STATUS_INPUT,
                             "%s: runs with output -histories cannot be taken from a file",
                             q->take[k]);
        }
        status = open_file(s, q->take[k], e);
        status = status == STATUS_OK ? take_runs(s, &stock, e) : status;
    }
    return status;
}

static int take_and_run(struct study *s, bool has_old, struct study_progress *p, struct error *e) {
    const long n_kept = s->journal.n_done;
    struct stock old = {.same = false};
    int status = take_all(s, has_old, &old, e);
    s->n_taken = s->journal.n_done - n_kept;
    if (status == STATUS_OK && old.same) {
        p->n_kept = p->n_done = p->n_run;
        p->n_failed = old.n_failed;
    } else if (status == STATUS_OK) {
        status = run_and_write(s, p, e);
    }
    if (status != STATUS_OK && !s->again && s->journal.n_done > s->n_taken) {
        p->n_left = journal_is_there(&s->journal) ? s->journal.n_done - s->n_taken : 0;
        journal_close(&s->journal);
    } else {  // a journal without runs is not left behind
        journal_remove(&s->journal);
    }
    return status;
}

static int prepare_and_run(struct study *s, struct study_progress *p, struct error *e) {
    const struct study_request *q = s->request;
    const bool has_old =
        s->again || (q->journal == STUDY_RESUME && q->result.existing == RESULT_KEEP &&
                     study_file_is_study(q->result.path));
    int status = has_old ? STATUS_OK : study_file_check(&s->content, &s->result, e);
    s->records = record_cache_create(RECORD_CACHE_BYTES);
    status = status == STATUS_OK && !s->records ? error_no_memory(e) : status;
    if (status == STATUS_OK) {
        status = origin_study(s->manifest.arena, q, s->plan.table->n_value, &s->origin.study, e);
    }
    status = status == STATUS_OK ? keys_make(&s->keys, q, &s->plan, &s->manifest, e) : status;
    status = status == STATUS_OK ? open_journal(s, e) : status;
    return status == STATUS_OK ? take_and_run(s, has_old, p, e) : status;
}

// The choice of runs is read before they are run.
static int check_choice(const struct study *s, struct error *e) {
    const char *text = s->request->histories;
    const struct study_view view = plan_view(&s->plan);
    if (text && wants_all(s)) {
        return error_set(e, STATUS_INPUT,
                         "with output -histories in the deck all runs have histories; "
                         "--histories is for decks without");
    }
    return text ? selection_check(&view, text, e) : STATUS_OK;
}

// All runs that are missing, or, after that, those that are run again for their histories.
static int run_pass(const struct study_request *q, const char *again, struct study_progress *p,
                    struct error *e) {
    struct study s = {.request = q,
                      .again = again,
                      .told = p,
                      .result = q->result,
                      .journal = {.file = -1},
                      .origin = {.programs = ""},
                      .start = wall_seconds()};
    *p = (struct study_progress){.n_run = study_shard_size(&q->shard, q->first->deck->n_run)};
    int status = plan_init(&s.plan, q, e);
    if (status != STATUS_OK) {
        return status;
    }
    s.content = (struct study_content){.first = s.plan.report,
                                       .table = s.plan.table,
                                       .sweeps = q->first->deck->sweeps,
                                       .origin = &s.origin,
                                       .n_run = s.plan.n_mine,
                                       .read = read_runs,
                                       .write_run = wants_all(&s) || again ? write_run : NULL,
                                       .context = &s};
    status = check_choice(&s, e);
    status = status == STATUS_OK ? manifest_init(&s.manifest, q->first->deck->path, e) : status;
    status = status == STATUS_OK ? prepare_and_run(&s, p, e) : status;
    journal_close(&s.journal);
    for (int k = 0; k < s.n_file; k++) {
        take_close(&s.file[k]);
    }
    free(s.file);
    free(s.chosen);
    keys_close(&s.keys);
    manifest_close(&s.manifest);
    record_cache_free(s.records);
    plan_close(&s.plan);
    return status;
}

int study_run(const struct study_request *q, struct study_progress *p, struct error *e) {
    int status = run_pass(q, NULL, p, e);
    if (status == STATUS_OK && q->histories) {
        struct study_progress pass;
        struct study_request again = *q;
        again.journal = STUDY_RESUME;
        again.result.existing = RESULT_KEEP;
        again.n_take = 0;
        again.retry = false;
        status = run_pass(&again, q->histories, &pass, e);
        snprintf(p->histories, sizeof p->histories, "%s", pass.histories);
        p->n_done = status == STATUS_OK ? p->n_done : 0;  // nothing is left of this pass
    }
    return status;
}
