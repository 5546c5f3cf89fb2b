// SPDX-License-Identifier: GPL-3.0-or-later
// The words of `jostle law` as a deck: a statement `law NAME ...` for each law, so that they are
// read, and messages point at them, as in a deck.
#ifndef JOSTLE_LAW_WORDS_H
#define JOSTLE_LAW_WORDS_H

#include "jostle/deck.h"

struct law_words {
    const char *const *word;  // (n_word) LAW with its options
    int n_word;
    const char *const *compare;  // (n_compare) "LAW,LAW" or "LAW -option value ..."
    int n_compare;
    const char *fit;  // a measurement; NULL: nothing is fitted
    double peak;      // [N] a peak force, for which k is found; 0: none
};

// Opens the deck; *n_law, which is 0 before, counts its statements.
int law_words_open(const struct law_words *words, struct deck **deck, size_t *n_law,
                   struct error *e);

// Takes the first word from a statement, so that messages name the law. False after a report.
bool law_words_take_name(struct deck *d, struct statement *s);

// Has the law of `context` an option with this key?
typedef bool law_words_key(const void *context, const char *key);

// Gives a law without options those of the first that it has too. False: no memory.
bool law_words_lend(struct deck *d, const struct statement *first, law_words_key *has_key,
                    const void *context, struct statement *s);

// Prints what is wrong with the words. Errors: STATUS_INPUT, STATUS_SYSTEM: something is.
int law_words_check(const struct deck *d, struct error *e);

#endif
