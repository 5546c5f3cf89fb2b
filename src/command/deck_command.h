// SPDX-License-Identifier: GPL-3.0-or-later
// What commands on one deck have in common: their command line, `DECK [-D NAME=VALUE]...` and
// options of their own, and the model that they do something with.
#ifndef JOSTLE_DECK_COMMAND_H
#define JOSTLE_DECK_COMMAND_H

#include "command/option.h"
#include "model/guidance.h"
#include "study/plan.h"

// What commands that read a deck share: the options for it, and the model with its messages
// printed.

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
int deck_command_load(const struct load_request *request, struct model **out);

// STATUS_INPUT if the deck of the model is not a study.
int deck_command_check_study(const struct model *m, struct error *e);

// The plan of the runs of the deck, for commands that write no result; to be given to plan_close.
// Errors as of plan_init.
int deck_command_plan(const struct load_request *request, const struct model *m, struct plan *out,
                      struct error *e);

// Rows of -D, of a request that begins with a struct load_request, and of -j.
#define DECK_DEFINE_ROW                                                                            \
    {                                                                                              \
        "define", 'D', "NAME=VALUE", OPTION_WORDS, OPTION_LETTER_ONLY,                             \
            offsetof(struct load_request, define),                                                 \
            .doc = "replaces the value of a param or sweep; may be repeated"                       \
    }
#define DECK_THREADS_ROW(place, text)                                                              \
    {                                                                                              \
        "threads", 'j', "THREADS", OPTION_WHOLE, OPTION_LETTER_ONLY, place,                        \
            .least = 1, .most = THREADS_MAX, .what = "a number of threads", .doc = text            \
    }
enum { THREADS_MAX = 4096 };

// Functions get the options, and return EXIT_DONE or, after a message, the exit status.
struct deck_command {
    const struct command *command;
    const struct option_part *part;                    // of its help
    int (*settle)(void *options);                      // when all options are known; or NULL
    int (*use)(void *options, const struct model *m);  // NULL: use_plan
    // For commands that make the runs of the deck; signals are caught meanwhile.
    int (*use_plan)(void *options, const struct plan *p);
};

// Runs the command. Its options begin with `load`. Returns the exit status.
int deck_command_run(const struct deck_command *c, int argc, char **argv,
                     struct load_request *load);

// As many threads as the system has cores.
int deck_command_threads(void);

#endif
