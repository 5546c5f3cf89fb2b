// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/keys.h"

#include <stdlib.h>
#include <string.h>

#include "core/checksum.h"
#include "jostle/study_merge.h"
#include "study/trial.h"
#include "study/workers.h"

enum { JOB_RUNS = 64 };  // runs that a thread takes at once

struct making {
    struct keys *keys;
    const struct study_request *request;
    const struct plan *plan;
    struct manifest *manifest;  // guarded by the lock of the workers
};

// The contents of the files of a reading.
static int add_files(const struct making *k, struct workers *w, const struct deck *d,
                     struct checksum_sum *sum, struct error *e) {
    int status = STATUS_OK;
    workers_lock(w);
    for (const struct deck_path *f = d->files; f && status == STATUS_OK; f = f->next) {
        const struct manifest_file *file;
        status = manifest_check(k->manifest, f, &file, e);
        if (status == STATUS_OK && !f->included) {  // the statements of an included deck count
            checksum_add_text(sum, file->sum.digits);
        }
    }
    workers_unlock(w);
    return status;
}

static int make_key(const struct making *k, struct workers *w, long i, struct error *e) {
    struct deck *d;
    struct checksum_sum sum;
    int choice[STUDY_SWEEPS_MAX];
    int status = trial_open(k->plan, study_shard_run(&k->plan->shard, i), choice, &d, e);
    if (status != STATUS_OK) {
        return status;
    }
    checksum_start(&sum);
    checksum_add_number(&sum, (uint64_t)k->request->numerics);
    const bool sound = deck_key(d, &sum);
    status = d->diagnostics.out_of_memory ? error_no_memory(e) : add_files(k, w, d, &sum, e);
    if (sound && status == STATUS_OK) {
        checksum_end_bytes(&sum, k->keys->key[i].byte);
    }
    deck_free(d);
    return status;
}

static int work(void *context, struct workers *w, long job, void *scratch, struct error *e) {
    const struct making *k = context;
    const long end = (job + 1) * JOB_RUNS < k->keys->n ? (job + 1) * JOB_RUNS : k->keys->n;
    int status = STATUS_OK;
    (void)scratch;
    for (long i = job * JOB_RUNS; i < end && status == STATUS_OK; i++) {
        status = make_key(k, w, i, e);
    }
    return status;
}

static int poll(void *context, struct workers *w, long n_done, struct error *e) {
    const struct making *k = context;
    const struct study_progress p = {.n_run = k->keys->n};
    (void)w, (void)n_done;
    return k->request->poll ? k->request->poll(k->request->context, &p, e) : STATUS_OK;
}

bool keys_is_known(const struct study_key *key) {
    static const struct study_key none;
    return memcmp(key, &none, sizeof none) != 0;
}

// Where the key is in the table, or belongs.
static int *slot_of(const struct keys *k, const struct study_key *key) {
    size_t i;
    memcpy(&i, key->byte, sizeof i);
    for (i &= k->n_slot - 1; k->slot[i] != 0; i = (i + 1) & (k->n_slot - 1)) {
        if (memcmp(&k->key[k->slot[i] - 1], key, sizeof *key) == 0) {
            break;
        }
    }
    return &k->slot[i];
}

// From the last run on, so that the first of a key is found.
void keys_index(struct keys *k) {
    for (long i = k->n - 1; i >= 0; i--) {
        k->twin[i] = -1;
        if (keys_is_known(&k->key[i])) {
            int *slot = slot_of(k, &k->key[i]);
            k->twin[i] = *slot - 1;
            *slot = (int)i + 1;
        }
    }
}

int keys_open(struct keys *k, long n, struct error *e) {
    *k = (struct keys){.n = n, .n_slot = 2};
    while (k->n_slot < 2 * (size_t)n) {
        k->n_slot *= 2;
    }
    k->key = calloc((size_t)n + 1, sizeof *k->key);
    k->slot = calloc(k->n_slot, sizeof *k->slot);
    k->twin = malloc(((size_t)n + 1) * sizeof *k->twin);
    return k->key && k->slot && k->twin ? STATUS_OK : error_no_memory(e);
}

int keys_make(struct keys *k, const struct study_request *q, const struct plan *p,
              struct manifest *m, struct error *e) {
    int status = keys_open(k, p->n_mine, e);
    struct making making = {k, q, p, m};
    const struct workers_request request = {.n_thread = q->n_thread,
                                            .scratch = 1,
                                            .n_job = (k->n + JOB_RUNS - 1) / JOB_RUNS,
                                            .work = work,
                                            .poll = poll,
                                            .context = &making};
    status = status == STATUS_OK ? workers_run(&request, e) : status;
    if (status == STATUS_OK) {
        keys_index(k);
    }
    return status;
}

void keys_close(struct keys *k) {
    free(k->key);
    free(k->slot);
    free(k->twin);
    *k = (struct keys){.n = 0};
}

long keys_find(const struct keys *k, const struct study_key *key) {
    return keys_is_known(key) ? *slot_of(k, key) - 1 : -1;
}

// The table keeps its place, so that it still leads to the keys behind it.
void keys_forget(struct keys *k, long run) {
    k->key[run] = (struct study_key){{0}};
}
