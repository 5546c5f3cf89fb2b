// SPDX-License-Identifier: GPL-3.0-or-later
// What commands that read a deck share: the options for it, and the model with its messages
// printed.
#ifndef JOSTLE_LOAD_H
#define JOSTLE_LOAD_H

#include "command/option.h"
#include "model/guidance.h"

struct load_request {
    const struct deck_command *command;  // that it is for; NULL: another one
    const char *path;                    // of the deck
    struct words define;                 // NAME=VALUE
    bool quiet;                          // no warnings
    struct guidance *guidance;           // filled, and its warnings given, if not NULL
    bool checks;                         // warns of what only `check` does
};

// Reads the deck and builds its model; prints errors and warnings to stderr. Returns EXIT_DONE with
// *out to be given to model_free, or another exit status.
int load_model(const struct load_request *request, struct model **out);

// STATUS_INPUT if the deck of the model is not a study.
int load_check_study(const struct model *m, struct error *e);

#endif
