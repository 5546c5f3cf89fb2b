// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/lengths.h"

#include <stdlib.h>

#include "core/wall.h"
#include "study/trial.h"

enum { MODELS_MAX = 2000 };  // a second or so of building small models

static double length_of(const struct model *m) {
    return m->adaptive ? m->duration : m->duration / m->dt;
}

int lengths_init(struct lengths *l, const struct plan *p, struct error *e) {
    *l = (struct lengths){.plan = p, .first = length_of(p->first)};
    long n = 0, later = p->n_run;
    int i = 0;
    for (const struct sweep *s = p->first->deck->sweeps; s; s = s->next, i++) {
        n += s->n;
        later /= s->n;
        l->apart[i] = later;
        l->share[i] = malloc((size_t)s->n * sizeof *l->share[i]);
        if (!l->share[i]) {
            return error_no_memory(e);
        }
        for (int k = 0; k < s->n; k++) {
            l->share[i][k] = 1.0;
        }
    }
    l->measured = n > MODELS_MAX;
    return STATUS_OK;
}

void lengths_close(struct lengths *l) {
    for (int i = 0; i < STUDY_SWEEPS_MAX; i++) {
        free(l->share[i]);
    }
}

static int read_length(void *context, const struct model *m, struct study_outcome *outcome,
                       struct error *e) {
    (void)outcome, (void)e;
    struct lengths *l = context;
    l->share[l->sweep][l->value] = length_of(m) / l->first;
    return STATUS_OK;
}

void lengths_measure(struct lengths *l, double seconds) {
    // Not from the records of the runs: a file may change until its first run reads it.
    const struct trial_watch watch = {.records = NULL};
    const double start = wall_seconds();
    while (!l->measured && wall_seconds() - start < seconds) {
        const struct sweep *s = l->plan->first->deck->sweeps;
        for (int i = 0; s && i < l->sweep; i++) {
            s = s->next;
        }
        struct study_outcome outcome;
        struct error e;
        if (!s) {
            l->measured = true;
        } else if (++l->value >= s->n) {
            l->sweep++;
            l->value = 0;
        } else {
            trial_build(l->plan, l->value * l->apart[l->sweep], &watch, read_length, l, &outcome,
                        &e);
        }
    }
}

double lengths_of(const struct lengths *l, long run) {
    int choice[STUDY_SWEEPS_MAX], i = 0;
    double share = 1.0;
    plan_choose(l->plan, run, choice);
    for (const struct sweep *s = l->plan->first->deck->sweeps; s; s = s->next, i++) {
        share *= l->share[i][choice[i]];
    }
    return share;
}
