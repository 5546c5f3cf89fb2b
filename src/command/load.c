// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/load.h"

static void print_diagnostics(const struct deck *deck, bool quiet) {
    const struct diagnostics *d = &deck->diagnostics;
    if (d->n_error > 0 || (d->n_warning > 0 && !quiet)) {
        diagnostics_print(d, stderr, command_colour());
    }
}

static int guide(const struct model *m, struct guidance *g, struct error *e) {
    int status = guidance_find(m, g, e);
    if (status == STATUS_OK) {
        guidance_warn(m, g);
    }
    return status;
}

int load_model(const struct load_request *request, struct model **out) {
    struct error e;
    struct deck *deck = NULL;
    int status = deck_open(request->path, request->define, request->n_define, &deck, &e);
    if (status == STATUS_OK) {
        status = model_build(deck, out, &e);
        if (status == STATUS_OK && request->guidance) {
            status = guide(*out, request->guidance, &e);
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
