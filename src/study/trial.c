// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/trial.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>

#include "jostle/ensemble.h"

void trial_fail(struct study_outcome *outcome, const char *message) {
    outcome->status = STUDY_FAILED;
    snprintf(outcome->message, sizeof outcome->message, "%s", message);
}

int trial_open(const struct plan *p, long run, int *choice, struct deck **out, struct error *e) {
    const struct deck *first = p->first->deck;
    int status = deck_open_text(first->path, first->text, p->define, p->n_define, out, e);
    if (status == STATUS_OK) {
        plan_choose(p, run, choice);
        deck_bind(*out, first, choice);
    }
    return status;
}

int trial_analyse(const struct model *m, const struct trial_watch *watch,
                  struct study_outcome *outcome, struct results **out, struct error *e) {
    const struct observer observer = {.poll = watch->poll, .context = watch->context};
    *out = NULL;
    int status = analysis_run(m, &observer, out, e);
    if (status == STATUS_FAILED) {
        trial_fail(outcome, e->message);
        *out = NULL;
        return STATUS_OK;
    }
    return status;
}

// The model of a run; NULL: its deck is wrong for its values, which is an outcome.
static int build(const struct plan *p, long run, const struct trial_watch *watch, struct deck *deck,
                 struct model **out, struct study_outcome *outcome, struct error *e) {
    struct model *m = NULL;
    int status = model_build_shared(deck, watch->records, &m, e);
    const bool built = status == STATUS_OK;
    *out = NULL;
    if (status == STATUS_INPUT) {
        // A deck that is wrong for these values is a failed run; a system that fails ends the
        // study.
        status =
            diagnostics_cause(&deck->diagnostics, e) == STATUS_SYSTEM ? STATUS_SYSTEM : STATUS_OK;
        if (status == STATUS_OK) {
            trial_fail(outcome, e->message);
        }
    }
    if (status == STATUS_OK && watch->files) {
        status = watch->files(watch->context, deck->files, e);
    }
    if (status == STATUS_OK && built) {
        *out = m;
        status = plan_check(p, run, m, e);
    }
    return status;
}

int trial_build(const struct plan *p, long run, const struct trial_watch *watch, trial_use *use,
                void *context, struct study_outcome *outcome, struct error *e) {
    int choice[STUDY_SWEEPS_MAX];
    struct deck *deck;
    struct model *m;
    *outcome = (struct study_outcome){.status = STUDY_DONE};
    int status = trial_open(p, run, choice, &deck, e);
    if (status != STATUS_OK) {
        return status;
    }
    status = build(p, run, watch, deck, &m, outcome, e);
    if (status == STATUS_OK && m) {
        status = use(context, m, outcome, e);
    }
    deck_free(deck);  // and the model with it
    return status;
}

int trial_values(const struct model *m, const struct results *r, double *value, struct error *e) {
    struct report *report;
    int status = report_create(m, r, NULL, "", &report, e);
    if (status == STATUS_OK) {
        study_table_read(report, value);
        report_free(report);
    }
    return status;
}

int trial_demand(const struct model *m, const struct results *r, const struct edp *edp, double *all,
                 double *value, struct error *e) {
    int at = 0, status = trial_values(m, r, all, e);
    if (status == STATUS_OK) {
        *value = edp_value(edp, all, &at);
    }
    // Beyond a collapse there are no demands; that of a building counts as above every limit.
    if (status == STATUS_OK && r->collapse.happened && edp->quantity->owner == EDP_OF_BUILDING) {
        *value = INFINITY;
    }
    return status == STATUS_OK && isnan(*value) ? edp_absent(edp, at, e) : status;
}

struct answer {
    const struct trial_question *question;
    double demand;
};

static int answer(void *context, const struct model *m, struct study_outcome *outcome,
                  struct error *e) {
    struct answer *to = context;
    const struct trial_question *q = to->question;
    const struct trial_watch watch = {.poll = workers_poll, .context = q->workers};
    struct results *results;
    int status = trial_analyse(m, &watch, outcome, &results, e);
    if (status == STATUS_OK && results) {
        status = trial_demand(m, results, q->edp, q->all, &to->demand, e);
        results_free(results);
    }
    return status;
}

int trial_ask(const struct trial_question *q, double *demand, struct study_outcome *outcome,
              struct error *e) {
    const struct trial_watch watch = {.records = q->records};
    struct answer to = {.question = q, .demand = NAN};
    const int status = trial_build(q->plan, q->run, &watch, answer, &to, outcome, e);
    *demand = to.demand;
    return status;
}

// What the run of a model came to.
static int conclude(struct trial *t, struct ensemble_member *member,
                    const struct trial_watch *watch) {
    if (member->status == STATUS_FAILED) {
        trial_fail(&t->outcome, member->error.message);
        return STATUS_OK;
    }
    if (member->status != STATUS_OK) {
        t->error = member->error;
        return member->status;
    }
    int status = trial_values(member->model, member->results, t->value, &t->error);
    if (status == STATUS_OK && watch->end) {
        status = watch->end(watch->context, member->results, &t->error);
    }
    results_free(member->results);
    return status;
}

int trial_most(const struct plan *p) {
    return ensemble_pays(p->first) && ensemble_suits(p->first) ? ENSEMBLE_MAX : 1;
}

void trial_run(const struct plan *p, struct trial *trial, int n, const struct trial_watch *watch) {
    const struct observer observer = {.row = watch->row,
                                      .poll = watch->poll,
                                      .context = watch->context,
                                      .steps_max = watch->steps_max};
    struct deck *deck[ENSEMBLE_MAX] = {NULL};
    struct ensemble_member member[ENSEMBLE_MAX];
    struct trial *built[ENSEMBLE_MAX];
    int choice[STUDY_SWEEPS_MAX];
    int n_built = 0;
    for (int i = 0; i < n; i++) {
        struct trial *t = &trial[i];
        struct model *m = NULL;
        t->outcome = (struct study_outcome){.status = STUDY_DONE};
        for (size_t k = 0; k < p->table->n_value; k++) {
            t->value[k] = NAN;
        }
        t->status = trial_open(p, t->run, choice, &deck[i], &t->error);
        if (t->status == STATUS_OK) {
            t->status = build(p, t->run, watch, deck[i], &m, &t->outcome, &t->error);
        }
        if (t->status == STATUS_OK && m) {
            member[n_built] = (struct ensemble_member){.model = m};
            built[n_built++] = t;
        }
    }
    if (watch->begin && n_built > 0) {
        assert(n == 1);
        watch->begin(watch->context, member[0].model);
    }
    ensemble_run(member, n_built, &observer);
    for (int i = 0; i < n_built; i++) {
        built[i]->status = conclude(built[i], &member[i], watch);
    }
    for (int i = 0; i < n; i++) {
        deck_free(deck[i]);  // and its model
    }
}
