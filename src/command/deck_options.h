// SPDX-License-Identifier: GPL-3.0-or-later
// The command line `DECK [-D NAME=VALUE]...` that `check` and `modes` share.
#ifndef JOSTLE_DECK_OPTIONS_H
#define JOSTLE_DECK_OPTIONS_H

#include "command/load.h"

// Parses the command line and loads the model. Returns true with *model to be given to model_free;
// false with *status to be returned (help was printed, or something was wrong).
// `guidance` is that of struct load_request.
bool deck_options_load(const struct command *c, int argc, char **argv, struct guidance *guidance,
                       struct model **model, int *status);

#endif
