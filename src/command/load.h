// SPDX-License-Identifier: GPL-3.0-or-later
// What commands that read a deck share: the options for it, and the model with its messages
// printed.
#ifndef JOSTLE_LOAD_H
#define JOSTLE_LOAD_H

#include "command/command.h"
#include "model/guidance.h"

struct load_request {
    const char *path;           // of the deck
    const char *const *define;  // (n_define) NAME=VALUE
    int n_define;
    bool quiet;                 // no warnings
    struct guidance *guidance;  // filled, and its warnings given, if not NULL
};

// Reads the deck and builds its model; prints errors and warnings to stderr. Returns EXIT_DONE with
// *out to be given to model_free, or another exit status.
int load_model(const struct load_request *request, struct model **out);

// Loads a model, hands it to `use`, which returns an exit status, and frees it.
int load_and_use(const struct load_request *request,
                 int (*use)(const struct model *m, void *context), void *context);

// Room for what -D may give in a command line of `argc` words, to be freed; EXIT_DONE, or the exit
// status after having told that there is no memory.
int load_defines(int argc, const char ***out);

// STATUS_INPUT if the deck of the model is not a study.
int load_check_study(const struct model *m, struct error *e);

#endif
