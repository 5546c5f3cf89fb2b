// SPDX-License-Identifier: GPL-3.0-or-later
// From drafts to the const model: what the deck as a whole must have, and the order of the stages.
#include "model/finish.h"

static void check_deck(struct builder *b) {
    struct deck *d = b->deck;
    if (d->torn) {
        return;
    }
    if (!b->any_building) {
        deck_error(d, NULL, "the deck has no building");
    }
    if (!b->step.text) {
        deck_error(d, NULL, "the deck has no time step; write: step fixed DT or step adaptive");
    }
    if (!b->duration.text && b->longest == 0.0 && !b->any_history) {
        deck_error(d, NULL, "nothing says how long the analysis is; write: duration T");
    }
}

int builder_finish(struct builder *b, struct model *m, struct error *e) {
    struct diagnostics *found = &b->deck->diagnostics;
    check_deck(b);
    if (found->n_error > 0) {
        return error_set(e, STATUS_INPUT, "%d error%s in %s", found->n_error,
                         found->n_error == 1 ? "" : "s", b->deck->path);
    }
    int status = finish_buildings(b, m, e);
    if (status != STATUS_OK) {
        return status;
    }
    if (!b->no_memory && found->n_error == 0) {
        finish_chain(b, m);
        finish_links(b, m);
        finish_loads(b, m);
        finish_time(b, m);
    }
    if (b->no_memory || found->out_of_memory) {
        return error_no_memory(e);
    }
    if (found->n_error > 0) {
        return error_set(e, STATUS_INPUT, "%d error%s in %s", found->n_error,
                         found->n_error == 1 ? "" : "s", b->deck->path);
    }
    finish_warnings(b, m);
    return STATUS_OK;
}
