// SPDX-License-Identifier: GPL-3.0-or-later
// The deck of a study, for commands that build models of its runs again.
#ifndef JOSTLE_STUDY_DECK_H
#define JOSTLE_STUDY_DECK_H

#include "command/deck_command.h"
#include "study/measure.h"

struct study_deck {
    struct report *report;
    struct load_request load;  // with the -D of the study
    struct model *model;
};

// Reads the deck at `path`; NULL: that which the file names. Returns EXIT_DONE or, after a message,
// the exit status. *out is to be given to study_deck_close, whatever happens.
int study_deck_open(struct study_file *f, const char *path, struct study_deck *out);
void study_deck_close(struct study_deck *d);

// Measures (n) of the runs of a study, as measure_runs finds them, from a deck as above, on all
// cores. EXIT_DONE or, after a message, the exit status.
int study_deck_measure(struct study_file *f, const char *path, const struct measure *measure, int n,
                       double *value);

// The row of --deck.
#define STUDY_DECK_ROW(place)                                                                      \
    {                                                                                              \
        "deck", 0, "DECK", OPTION_TEXT, 0, place,                                                  \
            .doc = "the deck of the study, if it is not where it was"                              \
    }

#endif
