// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/trial.h"

#include <math.h>
#include <stdio.h>

static int ignore_row(void *context, const struct row_view *row, struct error *e) {
    (void)context, (void)row, (void)e;
    return STATUS_OK;
}

static void fail(struct study_outcome *outcome, const char *message) {
    outcome->status = STUDY_FAILED;
    snprintf(outcome->message, sizeof outcome->message, "%s", message);
}

// A deck that is wrong for these values is a failed run; a system that fails ends the study.
static int fail_deck(struct study_outcome *outcome, const struct deck *deck, struct error *e) {
    if (diagnostics_cause(&deck->diagnostics, e) == STATUS_SYSTEM) {
        return STATUS_SYSTEM;
    }
    fail(outcome, e->message);
    return STATUS_OK;
}

static int open_deck(const struct plan *p, long run, int *choice, struct deck **out,
                     struct error *e) {
    const struct deck *first = p->first->deck;
    int status = deck_open_text(first->path, first->text, p->define, p->n_define, out, e);
    if (status == STATUS_OK) {
        plan_choose(p, run, choice);
        deck_bind(*out, first->sweeps, choice);
    }
    return status;
}

int trial_analyse(const struct model *m, const struct trial_watch *watch,
                  struct study_outcome *outcome, struct results **out, struct error *e) {
    const struct observer observer = {
        .row = ignore_row, .poll = watch->poll, .context = watch->context};
    *out = NULL;
    int status = analysis_run(m, &observer, out, e);
    if (status == STATUS_FAILED) {
        fail(outcome, e->message);
        *out = NULL;
        return STATUS_OK;
    }
    return status;
}

// What the runs of a study give.
struct table_use {
    const struct plan *plan;
    const struct trial_watch *watch;
    double *value;
};

static int fill_table(void *context, const struct model *m, struct study_outcome *outcome,
                      struct error *e) {
    const struct table_use *u = context;
    struct results *results;
    int status = trial_analyse(m, u->watch, outcome, &results, e);
    if (status != STATUS_OK || !results) {
        return status;
    }
    struct report *report;
    status = report_create(m, results, NULL, u->plan->report->version, &report, e);
    if (status == STATUS_OK) {
        study_table_read(report, u->value);
        report_free(report);
    }
    results_free(results);
    return status;
}

static int build(const struct plan *p, long run, struct deck *deck, const struct trial_watch *watch,
                 trial_use *use, void *context, struct study_outcome *outcome, struct error *e) {
    struct model *m;
    int status = model_build_shared(deck, watch->records, &m, e);
    const bool built = status == STATUS_OK;
    if (status == STATUS_INPUT) {
        status = fail_deck(outcome, deck, e);
    }
    if (status != STATUS_OK) {
        return status;
    }
    status = watch->files ? watch->files(watch->context, deck->files, e) : STATUS_OK;
    if (status == STATUS_OK && built) {
        status = plan_check(p, run, m, e);
    }
    return status == STATUS_OK && built ? use(context, m, outcome, e) : status;
}

int trial_build(const struct plan *p, long run, const struct trial_watch *watch, trial_use *use,
                void *context, struct study_outcome *outcome, struct error *e) {
    int choice[STUDY_SWEEPS_MAX];
    struct deck *deck;
    *outcome = (struct study_outcome){.status = STUDY_DONE};
    int status = open_deck(p, run, choice, &deck, e);
    if (status == STATUS_OK) {
        status = build(p, run, deck, watch, use, context, outcome, e);
        deck_free(deck);  // and the model with it
    }
    return status;
}

int trial_run(const struct plan *p, long run, const struct trial_watch *watch,
              struct study_outcome *outcome, double *value, struct error *e) {
    struct table_use use = {.plan = p, .watch = watch, .value = value};
    for (size_t i = 0; i < p->table->n_value; i++) {
        value[i] = NAN;
    }
    return trial_build(p, run, watch, fill_table, &use, outcome, e);
}
