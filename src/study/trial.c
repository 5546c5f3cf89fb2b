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

static int run_model(const struct plan *p, const struct model *m, const struct trial_watch *watch,
                     struct study_outcome *outcome, double *value, struct error *e) {
    const struct observer observer = {
        .row = ignore_row, .poll = watch->poll, .context = watch->context};
    struct results *results;
    int status = analysis_run(m, &observer, &results, e);
    if (status == STATUS_FAILED) {
        fail(outcome, e->message);
        return STATUS_OK;
    }
    if (status != STATUS_OK) {
        return status;
    }
    struct report *report;
    status = report_create(m, results, NULL, p->report->version, &report, e);
    if (status == STATUS_OK) {
        study_table_read(report, value);
        report_free(report);
    }
    results_free(results);
    return status;
}

static int build_and_run(const struct plan *p, long run, struct deck *deck,
                         const struct trial_watch *watch, struct study_outcome *outcome,
                         double *value, struct error *e) {
    struct model *m;
    int status = model_build_shared(deck, watch->records, &m, e);
    const bool built = status == STATUS_OK;
    if (status == STATUS_INPUT) {
        status = fail_deck(outcome, deck, e);
    }
    if (status != STATUS_OK) {
        return status;
    }
    status = watch->files(watch->context, deck->files, e);
    if (status == STATUS_OK && built) {
        status = plan_check(p, run, m, e);
    }
    return status == STATUS_OK && built ? run_model(p, m, watch, outcome, value, e) : status;
}

int trial_run(const struct plan *p, long run, const struct trial_watch *watch,
              struct study_outcome *outcome, double *value, struct error *e) {
    int choice[STUDY_SWEEPS_MAX];
    struct deck *deck;
    *outcome = (struct study_outcome){.status = STUDY_DONE};
    for (size_t i = 0; i < p->table->n_value; i++) {
        value[i] = NAN;
    }
    int status = open_deck(p, run, choice, &deck, e);
    if (status == STATUS_OK) {
        status = build_and_run(p, run, deck, watch, outcome, value, e);
        deck_free(deck);  // and the model with it
    }
    return status;
}
