// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/deck_command.h"

#include <unistd.h>

#include "command/interrupt.h"
#include "model/guidance.h"

// A single run says of its damping what it has computed.
static int guide(const struct model *m, const struct load_request *request, struct error *e) {
    int status = guidance_find(m, request->guidance, e);
    if (status == STATUS_OK) {
        guidance_warn(m, request->guidance);
    }
    // check_study.c checks the contacts of all runs of a study.
    const bool study = deck_is_study(m->deck);
    if (status == STATUS_OK && request->checks && !study) {
        const struct guidance *g = request->guidance;
        guidance_warn_storeys(m, g->n_contact, g->contact, NULL, NULL);
    }
    const bool estimates = request->checks || study;
    struct damping_finding most;
    return status == STATUS_OK && estimates ? damping_find(m, true, &most, e) : status;
}

int deck_command_plan(const struct load_request *request, const struct model *m, struct plan *out,
                      struct error *e) {
    const struct study_request q = {.first = m,
                                    .define = request->define.word,
                                    .n_define = request->define.n,
                                    .result = {.version = JOSTLE_VERSION}};
    return plan_init(out, &q, e);
}

int deck_command_load(const struct load_request *request, struct model **out) {
    struct error e;
    struct deck *deck = NULL;
    int status = deck_open(request->path, request->define.word, request->define.n, &deck, &e);
    if (status == STATUS_OK) {
        status = model_build(deck, out, &e);
        if (status == STATUS_OK && request->guidance) {
            status = guide(*out, request, &e);
        }
        const struct diagnostics *d = &deck->diagnostics;
        if (d->n_error > 0 || (d->n_warning > 0 && !request->quiet)) {
            diagnostics_print(d, stderr, command_colour());
        }
        if (status == STATUS_INPUT && deck->diagnostics.system) {
            e.status = STATUS_SYSTEM;  // a file could not be read
        }
    }
    if (status == STATUS_OK) {
        return EXIT_DONE;
    }
    deck_free(deck);
    return command_fail(&e);
}

int deck_command_check_study(const struct model *m, struct error *e) {
    return deck_is_study(m->deck)
               ? STATUS_OK
               : error_set(e, STATUS_INPUT,
                           "%s is not a study: it has no sweep that -D leaves open", m->deck->path);
}

static int plan_and_use(const struct load_request *load, const struct model *m) {
    struct plan plan;
    struct error e;
    if (deck_command_plan(load, m, &plan, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    interrupt_catch();
    const int status = load->command->use_plan((void *)load, &plan);
    plan_close(&plan);
    return status;
}

static int use(void *options, struct arena *a, const struct words *operand) {
    (void)a;
    struct load_request *load = options;
    const struct deck_command *c = load->command;
    struct model *m = NULL;
    load->path = operand->word[0];
    int status = c->settle ? c->settle(options) : EXIT_DONE;
    status = status == EXIT_DONE ? deck_command_load(load, &m) : status;
    if (status == EXIT_DONE) {
        status = c->use ? c->use(options, m) : plan_and_use(load, m);
        model_free(m);
    }
    return status;
}

int deck_command_run(const struct deck_command *c, int argc, char **argv,
                     struct load_request *load) {
    const struct option_list list = {c->command, c->part, .operand = "deck", .use = use};
    load->command = c;
    return option_run(&list, argc, argv, load);
}

int deck_command_threads(void) {
    const long n = sysconf(_SC_NPROCESSORS_ONLN);
    return n < 1 ? 1 : n > THREADS_MAX ? THREADS_MAX : (int)n;
}
