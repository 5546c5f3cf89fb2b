// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/storey_draft.h"

#include "deck/reader.h"

bool storey_draft_take(struct builder *b, struct building_draft *d, int i,
                       const struct statement *s) {
    struct word *mark = &d->storey_word[i];
    if (mark->text) {
        return deck_error(b->deck, &s->word[1], "storey %d of building %s has a law already, in %s",
                          i + 1, d->name, source_mention(b->deck, &mark->place, &s->word[0].place));
    }
    *mark = s->word[0];
    return true;
}

bool storey_draft_isolate(struct builder *b, struct building_draft *d, int i,
                          const struct word *w) {
    if (d->isolated > 0 && d->isolated != i + 1) {
        return deck_error(b->deck, w,
                          "storey %d of building %s is its isolator already; it can have one",
                          d->isolated, d->name);
    }
    d->isolated = i + 1;
    return true;
}
