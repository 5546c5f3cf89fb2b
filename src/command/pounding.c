// SPDX-License-Identifier: GPL-3.0-or-later
// The pounding force spectrum after Jankowski (2006), Engineering Structures 28, 1149-1161: the
// largest contact force of two structures over the period of each. The deck is read anew for every
// pair, with its params T1 and T2 overridden, so law, gap, record and all else are the deck's.
#include "command/pounding.h"

#include <math.h>
#include <string.h>

#include "command/load.h"
#include "command/picture.h"
#include "command/progress.h"
#include "core/arena.h"
#include "jostle/analysis.h"
#include "plot/pounding_map.h"

struct pounding {
    const struct spectrum_request *request;
    double *force;             // (n_period, n_period) [F] the left structure's period first
    const char *title;         // of the deck
    struct unit_system units;  // of the deck
};

static double largest_force(const struct model *m, const struct results *r) {
    double force = 0.0;
    for (int i = 0; i < m->n_contact; i++) {
        force = fmax(force, r->link[i].force);
    }
    return force;
}

// Runs one model; EXIT_DONE with *force, or the exit status.
static int analyse(const struct model *m, double t1, double t2, double *force) {
    struct results *r;
    struct error cause, e;
    if (m->n_contact == 0) {
        error_set(&e, STATUS_INPUT, "the deck has no contact");
        return command_fail(&e);
    }
    const int status = analysis_run(m, NULL, &r, &cause);
    if (status != STATUS_OK) {
        error_set(&e, status, "at T1 = %.6g s, T2 = %.6g s: %s", t1, t2, cause.message);
        return command_fail(&e);
    }
    *force = largest_force(m, r);
    results_free(r);
    return EXIT_DONE;
}

// The deck with these periods. What it warns of is told once.
static int run_pair(struct pounding *p, int i, int k, const char **define, struct arena *a) {
    const struct spectrum_request *q = p->request;
    const double t1 = q->period[i], t2 = q->period[k];
    char first[64], second[64];
    snprintf(first, sizeof first, "T1=%.17gs", t1);
    snprintf(second, sizeof second, "T2=%.17gs", t2);
    memcpy(define, q->define, (size_t)q->n_define * sizeof *define);
    define[q->n_define] = first;
    define[q->n_define + 1] = second;
    const struct load_request request = {.path = q->pounding,
                                         .define = define,
                                         .n_define = q->n_define + 2,
                                         .quiet = i > 0 || k > 0};
    struct model *m;
    int status = load_model(&request, &m);
    if (status != EXIT_DONE) {
        return status;
    }
    status = analyse(m, t1, t2, &p->force[(size_t)i * (size_t)q->n_period + (size_t)k]);
    if (i == 0 && k == 0) {
        p->units = m->deck->units;
        p->title = arena_text(a, m->deck->title, strlen(m->deck->title));
    }
    model_free(m);
    return status;
}

static int run_all(struct pounding *p, struct arena *a) {
    const struct spectrum_request *q = p->request;
    const int n = q->n_period;
    const char **define = arena_alloc(a, (size_t)q->n_define + 2, sizeof *define);
    p->force = arena_alloc(a, (size_t)n * (size_t)n, sizeof *p->force);
    if (!define || !p->force) {
        struct error e;
        error_no_memory(&e);
        return command_fail(&e);
    }
    struct progress progress;
    int status = EXIT_DONE;
    progress_start(&progress, (double)n * n, "runs");
    for (int pair = 0; pair < n * n && status == EXIT_DONE; pair++) {
        status = run_pair(p, pair / n, pair % n, define, a);
        progress_show(&progress, pair + 1.0);
    }
    progress_end(&progress);
    return status;
}

static void print_tsv(const struct pounding *p) {
    const struct spectrum_request *q = p->request;
    printf("T1 [s]\tT2 [s]\tforce [%s]\n", p->units.force_name);
    for (int pair = 0; pair < q->n_period * q->n_period; pair++) {
        printf("%.17g\t%.17g\t%.17g\n", q->period[pair / q->n_period],
               q->period[pair % q->n_period], p->force[pair]);
    }
}

// "largest 1234 kN at T1 = 0.2 s, T2 = 1.1 s; no contact for 20 of 400 pairs"
static void summarise(const struct pounding *p, char *text, size_t size) {
    const struct spectrum_request *q = p->request;
    const int n = q->n_period;
    int at = 0, apart = 0;
    for (int pair = 0; pair < n * n; pair++) {
        at = p->force[pair] > p->force[at] ? pair : at;
        apart += p->force[pair] == 0.0;
    }
    const int used =
        snprintf(text, size, "largest %.4g %s at T1 = %.4g s, T2 = %.4g s", p->force[at],
                 p->units.force_name, q->period[at / n], q->period[at % n]);
    snprintf(text + used, size - (size_t)used, "; no contact for %d of %d pairs", apart, n * n);
}

static int write_map(void *context, const struct figure_files *to, struct error *e) {
    const struct pounding *p = context;
    char text[256];
    summarise(p, text, sizeof text);
    const struct pounding_map map = {.title = p->title[0] ? p->title : p->request->pounding,
                                     .subtitle = text,
                                     .version = JOSTLE_VERSION,
                                     .units = &p->units,
                                     .n = p->request->n_period,
                                     .period = p->request->period,
                                     .force = p->force};
    return pounding_map_write(&map, to, e);
}

static int draw(struct pounding *p) {
    const struct spectrum_request *q = p->request;
    const struct picture_request picture = {.name = "pounding",
                                            .output = q->output,
                                            .script_folder = q->script_folder,
                                            .existing = q->existing,
                                            .write = write_map,
                                            .context = p};
    struct error e;
    return picture_make(&picture, &e) == STATUS_OK ? EXIT_DONE : command_fail(&e);
}

int pounding_run(const struct spectrum_request *q, struct arena *a) {
    struct pounding p = {.request = q};
    int status = run_all(&p, a);
    if (status != EXIT_DONE) {
        return status;
    }
    if (!p.title) {
        struct error e;
        error_no_memory(&e);
        return command_fail(&e);
    }
    if (q->output || q->script_folder) {
        status = draw(&p);
    }
    if (status == EXIT_DONE && q->form == FORM_TSV) {
        print_tsv(&p);
    } else if (status == EXIT_DONE) {
        char text[256];
        summarise(&p, text, sizeof text);
        printf("%s%s%s\n", p.title, p.title[0] ? "\n" : "", text);
    }
    return status;
}
