// SPDX-License-Identifier: GPL-3.0-or-later
// What a study does with the journal that it finds.
#include <string.h>

#include "study/journal.h"

int journal_resume(struct journal *j, const char *head, enum study_journal what, const char *noun,
                   struct error *e) {
    if (what == STUDY_RESTART || journal_is_new(j, head)) {
        return journal_reset(j, head, e);
    }
    if (!j->head) {
        return error_set(e, STATUS_INPUT,
                         "%s is damaged and may hold finished runs; --restart discards them",
                         j->path);
    }
    if (!j->head[0]) {
        return error_set(e, STATUS_INPUT,
                         "%s was written by another version of jostle, or on another kind of "
                         "machine; --restart begins anew",
                         j->path);
    }
    if (strcmp(j->head, head) != 0) {
        return error_set(e, STATUS_INPUT,
                         "%s holds runs of a study with other buildings, contacts or links; "
                         "--restart discards them",
                         j->path);
    }
    const int status = journal_load(j, e);
    if (status == STATUS_OK && j->n_foreign > 0) {
        return error_set(e, STATUS_INPUT,
                         "%s holds %ld finished runs that this %s does not have, as the deck or a "
                         "file has changed; --restart discards them",
                         j->path, j->n_foreign, noun);
    }
    return status == STATUS_OK ? journal_go_on(j, e) : status;
}
