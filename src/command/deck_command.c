// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/deck_command.h"

#include <stdlib.h>

const char deck_command_details[] =
    "  -D NAME=VALUE  overrides a param of the deck; may be repeated\n"
    "  --help         this text\n";

// Reads the options; false: *status is to be returned, as help was printed or something was wrong.
static bool parse(const struct deck_command *c, int argc, char **argv, struct load_request *load,
                  void *options, int *status) {
    *status = EXIT_DONE;
    opterr = 0;
    optind = 1;
    for (int letter; *status == EXIT_DONE &&
                     (letter = getopt_long(argc, argv, c->letters, c->option, NULL)) != -1;) {
        if (letter == 'h') {
            *status = command_help(c->command, c->details);
            return false;
        }
        if (letter == 'D') {
            load->define[load->n_define++] = optarg;
        } else if (letter == '?' || letter == ':') {
            *status = command_bad_option(c->command, letter, argv);
        } else {
            *status = c->take(options, letter);
        }
    }
    if (*status == EXIT_DONE && argc - optind != 1) {
        *status = command_usage(c->command, "one deck is expected, not %d", argc - optind);
    }
    load->path = argv[optind];
    return *status == EXIT_DONE;
}

static int load_and_use(const struct deck_command *c, const struct load_request *load,
                        void *options) {
    struct model *m;
    int status = c->settle ? c->settle(options) : EXIT_DONE;
    status = status == EXIT_DONE ? load_model(load, &m) : status;
    if (status == EXIT_DONE) {
        status = c->use(options, m);
        model_free(m);
    }
    return status;
}

int deck_command_run(const struct deck_command *c, int argc, char **argv, struct load_request *load,
                     void *options) {
    const char **define = calloc((size_t)argc, sizeof *define);
    if (!define) {
        return command_no_memory();
    }
    load->define = define;
    int status;
    if (parse(c, argc, argv, load, options, &status)) {
        status = load_and_use(c, load, options);
    }
    free(define);
    return status;
}
