// SPDX-License-Identifier: GPL-3.0-or-later
// CPU time of the thread is what an analysis costs whatever else the machine does; only for the
// whole program is it wall time, as that is what a user waits for.
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/bench.h"
#include "jostle/ensemble.h"
#include "jostle/result.h"

enum { PATH_SIZE = 4096 };

int bench_analysis(const struct bench_case *c, const struct model *m,
                   const struct bench_place *place, double *seconds, struct error *e) {
    (void)c, (void)place;
    struct results *results;
    double start = bench_seconds(CLOCK_THREAD_CPUTIME_ID);
    int status = analysis_run(m, NULL, &results, e);
    *seconds = bench_seconds(CLOCK_THREAD_CPUTIME_ID) - start;
    if (status == STATUS_OK) {
        results_free(results);
    }
    return status;
}

// The links of `m` with gaps `more` wider; NULL: no memory.
static struct link *widen(const struct model *m, double more) {
    struct link *link = calloc((size_t)m->n_link + 1, sizeof *link);
    for (int k = 0; link && k < m->n_link; k++) {
        link[k] = m->link[k];
        link[k].gap += more;
    }
    return link;
}

int bench_ensemble(const struct bench_case *c, const struct model *m,
                   const struct bench_place *place, double *seconds, struct error *e) {
    (void)c, (void)place;
    struct ensemble_member member[ENSEMBLE_MAX] = {{0}};
    struct model model[ENSEMBLE_MAX];
    struct link *link[ENSEMBLE_MAX];
    for (int k = 0; k < ENSEMBLE_MAX; k++) {
        link[k] = widen(m, 1e-3 * (k - (ENSEMBLE_MAX - 1) / 2.0));
        model[k] = *m;
        model[k].link = link[k] ? link[k] : m->link;
        member[k].model = &model[k];
    }
    double start = bench_seconds(CLOCK_THREAD_CPUTIME_ID);
    ensemble_run(member, ENSEMBLE_MAX, NULL);
    *seconds = (bench_seconds(CLOCK_THREAD_CPUTIME_ID) - start) / ENSEMBLE_MAX;
    int status = STATUS_OK;
    for (int k = 0; k < ENSEMBLE_MAX; k++) {
        if (member[k].status != STATUS_OK) {
            *e = member[k].error;
            status = member[k].status;
        }
        results_free(member[k].results);
        free(link[k]);
    }
    return status;
}

int bench_build(const struct bench_case *c, const struct model *m, const struct bench_place *place,
                double *seconds, struct error *e) {
    (void)m, (void)place;
    struct model *built;
    double start = bench_seconds(CLOCK_THREAD_CPUTIME_ID);
    int status = bench_model(c, &built, e);
    *seconds = bench_seconds(CLOCK_THREAD_CPUTIME_ID) - start;
    if (status == STATUS_OK) {
        model_free(built);
    }
    return status;
}

int bench_histories(const struct bench_case *c, const struct model *m,
                    const struct bench_place *place, double *seconds, struct error *e) {
    (void)c;
    char path[PATH_SIZE];
    snprintf(path, sizeof path, "%s/bench.h5", place->folder);
    struct result_options options = {
        .path = path, .existing = RESULT_REPLACE, .command_line = "", .version = ""};
    struct result_writer *writer;
    double start = bench_seconds(CLOCK_THREAD_CPUTIME_ID);
    int status = result_create(m, &options, &writer, e);
    if (status != STATUS_OK) {
        return status;
    }
    struct results *results;
    status = result_analyse(writer, NULL, &results, e);
    *seconds = bench_seconds(CLOCK_THREAD_CPUTIME_ID) - start;
    if (status == STATUS_OK) {
        results_free(results);
        remove(path);
    }
    return status;
}

// The child's part: never returns.
static void run_program(const char *program, const char *deck, const char *record,
                        const char *result) {
    int null = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (null >= 0 && dup2(null, STDOUT_FILENO) >= 0) {
        execl(program, program, "run", deck, "-D", record, "-o", result, "--force", (char *)NULL);
    }
    _exit(EXIT_FAILURE);
}

static int write_text(const char *path, const char *text, struct error *e) {
    FILE *f = fopen(path, "w");
    bool written = f && fputs(text, f) >= 0;
    if (!f || fclose(f) != 0 || !written) {
        return error_set(e, STATUS_SYSTEM, "cannot write %s: %s", path, strerror(errno));
    }
    return STATUS_OK;
}

// Waits for a program that is expected to succeed.
static int wait_for(pid_t child, const char *program, struct error *e) {
    int status;
    if (waitpid(child, &status, 0) != child || status != 0) {
        return error_set(e, STATUS_FAILED, "%s did not succeed", program);
    }
    return STATUS_OK;
}

// The definition of the deck's record, which is not beside the deck.
static int define_record(char *text, struct error *e) {
    char folder[PATH_SIZE];
    if (!getcwd(folder, sizeof folder)) {
        return error_set(e, STATUS_SYSTEM, "the current folder is not known: %s", strerror(errno));
    }
    int n = snprintf(text, PATH_SIZE, "record=%s/input/%s", folder, BENCH_RECORD);
    return n < PATH_SIZE ? STATUS_OK : error_set(e, STATUS_SYSTEM, "%s is too long", folder);
}

static int time_program(const char *program, const char *deck, const char *result, double *seconds,
                        struct error *e) {
    char record[PATH_SIZE];
    if (define_record(record, e) != STATUS_OK) {
        return e->status;
    }
    double start = bench_seconds(CLOCK_MONOTONIC);
    pid_t child = fork();
    if (child == 0) {
        run_program(program, deck, record, result);
    }
    int status = child < 0 ? error_set(e, STATUS_SYSTEM, "cannot fork: %s", strerror(errno))
                           : wait_for(child, program, e);
    *seconds = bench_seconds(CLOCK_MONOTONIC) - start;
    return status;
}

int bench_program(const struct bench_case *c, const struct model *m,
                  const struct bench_place *place, double *seconds, struct error *e) {
    (void)m;
    char deck[PATH_SIZE];
    char result[PATH_SIZE];
    snprintf(deck, sizeof deck, "%s/bench.deck", place->folder);
    snprintf(result, sizeof result, "%s/bench.h5", place->folder);
    char *text = bench_deck(c);
    if (!text) {
        return error_no_memory(e);
    }
    int status = write_text(deck, text, e);
    free(text);
    if (status == STATUS_OK) {
        status = time_program(place->program, deck, result, seconds, e);
    }
    remove(deck);
    remove(result);
    return status;
}
