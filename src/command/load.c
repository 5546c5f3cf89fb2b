// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/load.h"

#include "model/guidance.h"

static void print_diagnostics(const struct deck *deck, bool quiet) {
    const struct diagnostics *d = &deck->diagnostics;
    if (d->n_error > 0 || (d->n_warning > 0 && !quiet)) {
        diagnostics_print(d, stderr, command_colour());
    }
}

// A single run says of its damping what it has computed.
static int guide(const struct model *m, const struct load_request *request, struct error *e) {
    int status = guidance_find(m, request->guidance, e);
    if (status == STATUS_OK) {
        guidance_warn(m, request->guidance);
    }
    // check_study.c looks at the contacts of all runs of a study.
    const bool study = deck_is_study(m->deck);
    if (status == STATUS_OK && request->checks && !study) {
        const struct guidance *g = request->guidance;
        guidance_warn_storeys(m, g->n_contact, g->contact, NULL, NULL);
    }
    const bool estimates = request->checks || study;
    struct damping_finding most;
    return status == STATUS_OK && estimates ? damping_find(m, true, &most, e) : status;
}

int load_model(const struct load_request *request, struct model **out) {
    struct error e;
    struct deck *deck = NULL;
    int status = deck_open(request->path, request->define.word, request->define.n, &deck, &e);
    if (status == STATUS_OK) {
        status = model_build(deck, out, &e);
        if (status == STATUS_OK && request->guidance) {
            status = guide(*out, request, &e);
        }
        print_diagnostics(deck, request->quiet);
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

int load_check_study(const struct model *m, struct error *e) {
    return deck_is_study(m->deck)
               ? STATUS_OK
               : error_set(e, STATUS_INPUT,
                           "%s is not a study: it has no sweep that -D leaves open", m->deck->path);
}
