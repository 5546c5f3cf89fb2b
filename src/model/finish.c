// SPDX-License-Identifier: GPL-3.0-or-later
// From drafts to the const model: what the deck as a whole must have, and the order of the stages.
#include "model/finish.h"
#include "model/frame_draft.h"
#include "model/isolator.h"

#include "model/struck_column.h"

static int has_errors(const struct builder *b, struct error *e) {
    const struct diagnostics *found = &b->deck->diagnostics;
    if (arena_failed(b->arena) || found->out_of_memory) {
        return error_no_memory(e);
    }
    return found->n_error > 0 ? error_set(e, STATUS_INPUT, "%d error%s in %s", found->n_error,
                                          found->n_error == 1 ? "" : "s", b->deck->path)
                              : STATUS_OK;
}

int builder_finish(struct builder *b, struct model *m, struct error *e) {
    for (int i = 0; !b->deck->torn && i < b->buildings.n; i++) {
        const struct building_draft *d = builder_draft(b, i);
        if (!d->any_stiffness && !d->any_part) {
            deck_error(b->deck, &d->word,
                       "building %s has no stiffness; give -stiffness (0: a free body), or a "
                       "statement frame, wall or matrix",
                       d->name);
        }
    }
    frame_draft_finish(b);
    isolator_finish(b);
    struct deck *d = b->deck;
    if (!d->torn) {
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
    int status = has_errors(b, e);
    if (status == STATUS_OK) {
        struck_column_finish(b);
        status = has_errors(b, e);
    }
    if (status == STATUS_OK) {
        status = finish_buildings(b, m, e);
    }
    if (status != STATUS_OK) {
        return status;
    }
    if (has_errors(b, e) == STATUS_OK) {
        finish_chain(b, m);
        finish_links(b, m);
        finish_loads(b, m);
        finish_collapse(b, m);
        finish_time(b, m);
    }
    status = has_errors(b, e);
    if (status == STATUS_OK) {
        finish_warnings(b, m);
    }
    return status;
}
