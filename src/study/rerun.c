// SPDX-License-Identifier: GPL-3.0-or-later
#include "jostle/study_rerun.h"

#include <gsl/gsl_rng.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/number.h"
#include "jostle/ensemble.h"
#include "jostle/numerics.h"
#include "motion/record_cache.h"
#include "study/keys.h"
#include "study/number_list.h"
#include "study/plan.h"
#include "study/roles.h"
#include "study/selection.h"
#include "study/trial.h"

struct rerun {
    const struct study_rerun_request *request;
    const struct study_view *view;
    struct study_file *file;
    struct plan plan;
    struct manifest manifest;
    struct keys keys;
    struct study_key *key;  // (n_run of the file)
    struct trial_watch watch;
    unsigned char *chosen;   // (n_run of the file)
    double *stored, *value;  // (n_value) of the file; (ENSEMBLE_MAX, n_value)
    int *item;               // (n_item) the item of the file; -1: a sweep has its name
    struct trial trial[ENSEMBLE_MAX];
    struct number_list numbers;
    struct study_rerun *out;
};

// Chooses each of the runs that are left with the same probability until there are enough: Knuth,
// The Art of Computer Programming 2, 3.4.2, algorithm S.
static int draw(struct rerun *r, struct error *e) {
    gsl_rng *twister = gsl_rng_alloc(gsl_rng_mt19937);
    const long n = r->view->n_run;
    long left = r->request->n_draw < n ? r->request->n_draw : n;
    if (!twister) {
        return error_no_memory(e);
    }
    gsl_rng_set(twister, (unsigned long)r->request->seed);
    for (long i = 0; i < n; i++) {
        if (gsl_rng_uniform(twister) * (double)(n - i) < (double)left) {
            r->chosen[i] = 1;
            left--;
        }
    }
    gsl_rng_free(twister);
    return STATUS_OK;
}

// Chooses the runs that the request names.
static int choose(struct rerun *r, struct error *e) {
    const struct study_rerun_request *q = r->request;
    int status = STATUS_OK;
    for (int k = 0; k < q->n_run && status == STATUS_OK; k++) {
        status = selection_read(r->file, q->run[k], r->chosen, e);
    }
    return status == STATUS_OK && q->n_draw > 0 ? draw(r, e) : status;
}

// The keys of the runs of the deck, and those of the file.
static int make_keys(struct rerun *r, struct error *e) {
    const struct study_rerun_request *q = r->request;
    const struct study_request study = {.first = q->first,
                                        .define = q->define,
                                        .n_define = q->n_define,
                                        .n_thread = q->n_thread,
                                        .numerics = NUMERICS_VERSION};
    int status = keys_make(&r->keys, &study, &r->plan, &r->manifest, e);
    status = status == STATUS_OK ? study_file_keys(r->file, &r->key, e) : status;
    return status == STATUS_OK && !r->key
               ? error_set(e, STATUS_INPUT,
                           "%s does not have the keys of its runs: an earlier version wrote it",
                           r->view->path)
               : status;
}

// The run of row `i` of the file among those of the deck, perhaps at another number; -1: there is
// none. A run whose statements cannot be read has no key, in the file nor in the deck.
static long find(const struct rerun *r, long i) {
    const long same = study_view_run(r->view, i);
    return keys_is_known(&r->key[i]) ? keys_find(&r->keys, &r->key[i])
           : same < r->keys.n && !keys_is_known(&r->keys.key[same]) ? same
                                                                    : -1;
}

// Row `i` of the file is the next run.
static int take(struct rerun *r, long i, struct trial *next, struct error *e) {
    const long run = find(r, i);
    if (run < 0) {
        return error_set(e, STATUS_INPUT,
                         "%s: run %ld cannot be computed again: its statements, a file that they "
                         "name or the version of the numerics has changed since",
                         r->view->path, study_view_run(r->view, i) + 1);
    }
    *next = (struct trial){.run = run, .entry = i, .value = next->value};
    return STATUS_OK;
}

static int map_items(struct rerun *r, struct error *e) {
    const struct study_table *t = r->plan.table;
    for (int i = 0; i < t->n_item; i++) {
        const struct study_item *item = &t->item[i];
        r->item[i] = item->n > 0 ? study_table_find(&r->view->table, item) : -1;
        if (r->item[i] < 0 && item->n > 0 &&
            !roles_find_name(r->view, item->name, strlen(item->name), &(int){0})) {
            return error_set(e, STATUS_INPUT, "%s is damaged: it has no %s/%s", r->view->path,
                             item->parent, item->name);
        }
    }
    return STATUS_OK;
}

static int differs(const struct rerun *r, const struct trial *t, const struct study_item *item,
                   size_t k, double stored, struct error *e) {
    struct plan_text text;
    char place[64] = "";
    if (item->scale) {
        snprintf(place, sizeof place, " of %s %zu", item->scale, k + 1);
    }
    return error_set(e, STATUS_FAILED, "%s: %s has another %s%s: %.17g in the file, %.17g now",
                     r->view->path, plan_describe(&r->plan, t->run, &text), item->name, place,
                     stored, t->value[item->first + k]);
}

static int compare_values(const struct rerun *r, const struct trial *t, struct error *e) {
    const struct study_table *table = r->plan.table;
    for (int i = 0; i < table->n_item; i++) {
        const struct study_item *item = &table->item[i];
        if (r->item[i] < 0) {
            continue;
        }
        const double *stored = r->stored + r->view->table.item[r->item[i]].first;
        for (size_t k = 0; k < item->n; k++) {
            // NAN is NAN, and -0 is not 0.
            if (number_bits(stored[k]) != number_bits(t->value[item->first + k])) {
                return differs(r, t, item, k, stored[k], e);
            }
        }
    }
    return STATUS_OK;
}

// Row `t->entry` of the file against the run.
static int compare(struct rerun *r, const struct trial *t, struct error *e) {
    struct study_outcome stored;
    if (t->status != STATUS_OK) {
        *e = t->error;
        return t->status;
    }
    int status = study_file_read(r->file, t->entry, 1, &stored, r->stored, e);
    if (status != STATUS_OK) {
        return status;
    }
    if (stored.status != t->outcome.status || strcmp(stored.message, t->outcome.message) != 0) {
        struct plan_text text;
        return error_set(e, STATUS_FAILED, "%s: %s ended otherwise in the file: '%s', now '%s'",
                         r->view->path, plan_describe(&r->plan, t->run, &text), stored.message,
                         t->outcome.message);
    }
    status = compare_values(r, t, e);
    r->out->n_same += status == STATUS_OK;
    return status;
}

static int run_batch(struct rerun *r, int n, struct error *e) {
    int status = STATUS_OK;
    trial_run(&r->plan, r->trial, n, &r->watch);
    for (int i = 0; i < n && status == STATUS_OK; i++) {
        number_list_add(&r->numbers, study_view_run(r->view, r->trial[i].entry) + 1);
        status = compare(r, &r->trial[i], e);
    }
    return status;
}

static int run_chosen(struct rerun *r, struct error *e) {
    const int most = trial_most(&r->plan);
    int n = 0, status = STATUS_OK;
    for (long i = 0; i < r->view->n_run && status == STATUS_OK; i++) {
        struct study_outcome outcome;
        if (!r->chosen[i]) {
            continue;
        }
        // A run that `merge --partial` left out is counted and not computed.
        status = study_file_read(r->file, i, 1, &outcome, r->stored, e);
        const bool missing = status == STATUS_OK && outcome.status == STUDY_MISSING;
        r->out->n_missing += missing;
        if (status == STATUS_OK && !missing) {
            r->trial[n].value = r->value + (size_t)n * r->plan.table->n_value;
            status = take(r, i, &r->trial[n], e);
            n += status == STATUS_OK;
        }
        if (status == STATUS_OK && n == most) {
            status = run_batch(r, n, e);
            n = 0;
        }
    }
    return status == STATUS_OK && n > 0 ? run_batch(r, n, e) : status;
}

static int allocate(struct rerun *r, struct error *e) {
    const size_t n_stored = r->view->table.n_value, n_value = r->plan.table->n_value;
    r->chosen = calloc((size_t)r->view->n_run + 1, 1);
    r->stored = malloc((n_stored + 1) * sizeof *r->stored);
    r->value = malloc((ENSEMBLE_MAX * n_value + 1) * sizeof *r->value);
    r->item = malloc(((size_t)r->plan.table->n_item + 1) * sizeof *r->item);
    r->watch.records = record_cache_create(RECORD_CACHE_BYTES);
    return r->chosen && r->stored && r->value && r->item && r->watch.records ? STATUS_OK
                                                                             : error_no_memory(e);
}

int study_rerun(struct study_file *f, const struct study_rerun_request *q, struct study_rerun *out,
                struct error *e) {
    struct rerun r = {.request = q,
                      .view = study_file_view(f),
                      .file = f,
                      .watch = {.poll = q->poll, .context = q->context},
                      .numbers = {.text = out->numbers, .size = sizeof out->numbers},
                      .out = out};
    const struct study_request study = {
        .first = q->first, .define = q->define, .n_define = q->n_define, .result = {.version = ""}};
    *out = (struct study_rerun){.n_same = 0};
    int status = plan_init(&r.plan, &study, e);
    if (status != STATUS_OK) {
        return status;
    }
    status = manifest_init(&r.manifest, q->first->deck->path, e);
    status = status == STATUS_OK ? allocate(&r, e) : status;
    status = status == STATUS_OK ? make_keys(&r, e) : status;
    status = status == STATUS_OK ? map_items(&r, e) : status;
    status = status == STATUS_OK ? choose(&r, e) : status;
    status = status == STATUS_OK ? run_chosen(&r, e) : status;
    number_list_end(&r.numbers);
    free(r.chosen);
    free(r.key);
    keys_close(&r.keys);
    free(r.stored);
    free(r.value);
    free(r.item);
    record_cache_free(r.watch.records);
    manifest_close(&r.manifest);
    plan_close(&r.plan);
    return status;
}
