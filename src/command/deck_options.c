// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/deck_options.h"

#include <getopt.h>
#include <stdlib.h>

static const char details[] = "  -D NAME=VALUE  overrides a param of the deck; may be repeated\n"
                              "  --help         this text\n";

// True if the deck is to be loaded; else *status says why not.
static bool parse(const struct command *c, int argc, char **argv, const char **define,
                  struct load_request *request, int *status) {
    static const struct option option[] = {
        {"define", required_argument, NULL, 'D'},
        {"help", no_argument, NULL, 'h'},
        {NULL, 0, NULL, 0},
    };
    opterr = 0;
    optind = 1;
    for (int letter; (letter = getopt_long(argc, argv, ":D:h", option, NULL)) != -1;) {
        if (letter == 'h') {
            *status = command_help(c, details);
            return false;
        }
        if (letter != 'D') {
            *status = command_bad_option(c, letter, argv);
            return false;
        }
        define[request->n_define++] = optarg;
    }
    if (argc - optind != 1) {
        *status = command_usage(c, "one deck is expected, not %d", argc - optind);
        return false;
    }
    request->path = argv[optind];
    return true;
}

bool deck_options_load(const struct command *c, int argc, char **argv, struct guidance *guidance,
                       struct model **model, int *status) {
    const char **define;
    *status = load_defines(argc, &define);
    if (*status != EXIT_DONE) {
        return false;
    }
    struct load_request request = {.define = define, .guidance = guidance};
    bool good = parse(c, argc, argv, define, &request, status);
    if (good) {
        *status = load_model(&request, model);
    }
    free(define);
    return good && *status == EXIT_DONE;
}
