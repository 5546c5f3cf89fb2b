// SPDX-License-Identifier: GPL-3.0-or-later
// jostle spectrum --pounding: the pounding force spectrum of a deck, as a table or a map.
#include "command/spectrum.h"

#include <assert.h>
#include <string.h>

#include "command/deck_command.h"
#include "command/interrupt.h"
#include "command/progress.h"
#include "core/arena.h"
#include "core/safe.h"
#include "core/text.h"
#include "plot/pictures.h"
#include "study/force_map.h"

struct pounding {
    const struct spectrum_request *request;
    double *force;             // (n_period, n_period) [F] the left structure's period first
    const char *title;         // of the deck
    struct unit_system units;  // of the deck
};

// What keeps a model from having a pounding force spectrum; NULL: nothing.
static const char *find_obstacle(const struct model *m) {
    for (int i = 0; i < m->n_contact; i++) {
        if (m->link[i].law->rebound) {
            return "rigid contacts have no force, but an impulse";
        }
    }
    return m->n_contact == 0 ? "the deck has no contact" : NULL;
}

// The deck with the first pair of periods: its title and units, and what it warns of, which is told
// once.
static int read_deck(struct pounding *p, const char **define, struct arena *a) {
    const struct spectrum_request *q = p->request;
    const int n = q->load.define.n;
    struct force_map_pair pair;
    force_map_pair(&pair, q->periods.value[0], q->periods.value[0]);
    if (n > 0) {
        memcpy(define, q->load.define.word, (size_t)n * sizeof *define);
    }
    define[n] = pair.define[0];
    define[n + 1] = pair.define[1];
    const struct load_request request = {.path = q->load.path, .define = {define, n + 2}};
    struct model *m;
    const int status = deck_command_load(&request, &m);
    if (status != EXIT_DONE) {
        fprintf(stderr, "--pounding sets the params T1 and T2 of the deck, the periods of its two "
                        "structures\n");
        return status;
    }
    p->units = m->deck->units;
    p->title = arena_text(a, m->deck->title, strlen(m->deck->title));
    const char *obstacle = find_obstacle(m);
    model_free(m);
    if (obstacle) {
        struct error e;
        error_set(&e, STATUS_INPUT, "%s", obstacle);
        return command_fail(&e);
    }
    return p->title ? EXIT_DONE : command_no_memory();
}

static int run_all(struct pounding *p, struct arena *a) {
    const struct spectrum_request *q = p->request;
    const size_t n = (size_t)q->periods.n;
    const char **define = arena_alloc(a, (size_t)q->load.define.n + 2, sizeof *define);
    p->force = arena_alloc(a, n * n, sizeof *p->force);
    struct error e;
    if (!define || !p->force) {
        return command_no_memory();
    }
    const int status = read_deck(p, define, a);
    if (status != EXIT_DONE) {
        return status;
    }
    struct progress progress;
    const struct force_map_request request = {.path = q->load.path,
                                              .define = q->load.define.word,
                                              .n_define = q->load.define.n,
                                              .period = q->periods.value,
                                              .n_period = q->periods.n,
                                              .n_thread = q->n_thread,
                                              .poll = progress_poll,
                                              .context = &progress};
    interrupt_catch();
    progress_start(&progress, (double)n * (double)n, "runs");
    const int done = force_map_run(&request, p->force, &e);
    progress_end(&progress);
    return done == STATUS_OK ? EXIT_DONE : command_fail(&e);
}

static int print_data(const struct pounding *p) {
    static const struct printer_column columns[] = {{.key = "T1", .unit = "s"},
                                                    {.key = "T2", .unit = "s"},
                                                    COLUMN_OF("force", dimension_force)};
    const struct spectrum_request *q = p->request;
    const int n = q->periods.n;
    struct printer t = {.to = stdout, .form = (enum printer_form)q->form, .units = &p->units};
    PRINTER_ADD(&t, columns);
    printer_head(&t);
    for (int pair = 0; pair < n * n; pair++) {
        printer_number(&t, q->periods.value[pair / n]);
        printer_number(&t, q->periods.value[pair % n]);
        printer_number(&t, p->force[pair]);
        printer_line(&t);
    }
    return printer_close(&t);
}

// "largest 1234 kN at T1 = 0.2 s, T2 = 1.1 s; no contact for 20 of 400 pairs"
static void summarise(const struct pounding *p, char *text, size_t size) {
    const struct spectrum_request *q = p->request;
    const int n = q->periods.n;
    int at = 0, apart = 0;
    for (int pair = 0; pair < n * n; pair++) {
        at = p->force[pair] > p->force[at] ? pair : at;
        apart += p->force[pair] == 0.0;
    }
    struct text_exact force;
    const int used = snprintf(text, size, "largest %s %s at T1 = %.4g s, T2 = %.4g s",
                              text_rounded(&force, p->force[at], 4), p->units.force_name,
                              q->periods.value[at / n], q->periods.value[at % n]);
    snprintf(text + used, size - (size_t)used, "; no contact for %d of %d pairs", apart, n * n);
}

static int write_map(void *context, const struct figure_files *to, struct error *e) {
    const struct pounding *p = context;
    char text[256];
    summarise(p, text, sizeof text);
    const struct pounding_map map = {.title = p->title[0] ? p->title : p->request->load.path,
                                     .subtitle = text,
                                     .version = JOSTLE_VERSION,
                                     .units = &p->units,
                                     .n = p->request->periods.n,
                                     .period = p->request->periods.value,
                                     .force = p->force};
    return pounding_map_write(&map, to, e);
}

int pounding_run(const struct spectrum_request *q, struct arena *a) {
    struct pounding p = {.request = q};
    int status = run_all(&p, a);
    if (status != EXIT_DONE) {
        return status;
    }
    assert(p.title && p.force);
    if (picture_is_wanted(&q->picture)) {
        const struct picture_request picture = {
            .options = q->picture, .name = "pounding", .write = write_map, .context = &p};
        struct error e;
        status = picture_make(&picture, &e) == STATUS_OK ? EXIT_DONE : command_fail(&e);
    }
    if (status == EXIT_DONE && q->form != FORM_TEXT) {
        status = print_data(&p);
    } else if (status == EXIT_DONE) {
        char text[256];
        summarise(&p, text, sizeof text);
        if (p.title[0]) {
            safe_line(stdout, "%s", p.title);
        }
        safe_line(stdout, "%s", text);
    }
    return status;
}
