// SPDX-License-Identifier: GPL-3.0-or-later
// Reads decks with sweeps for the tests of src/deck/.
#ifndef JOSTLE_SWEEP_CASES_H
#define JOSTLE_SWEEP_CASES_H

#include "jostle/deck.h"
#include "support/support.h"

// Reads a whole deck; what its statement `show` says is kept in *shown.
static inline struct deck *read_deck(const char *text, const char *define, const struct deck *bound,
                                     const int *choice, const char **shown) {
    struct deck *d;
    struct error e;
    const char *path = support_path("sweep.deck");
    assert_int_equal(deck_open_text(path, text, &define, define ? 1 : 0, &d, &e), STATUS_OK);
    if (bound) {
        deck_bind(d, bound, choice);
    }
    struct statement s;
    do {
        while (deck_next(d, &s)) {
            *shown = s.n_word > 1 ? deck_text(d, &s.word[1]) : NULL;
        }
    } while (deck_rewind(d));
    return d;
}

#endif
