// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/deck_command.h"

#include <stdlib.h>

const char deck_command_details[] =
    "  -D NAME=VALUE  overrides a param of the deck; may be repeated\n"
    "  --help         this text\n";

// What the options go to.
struct target {
    const struct deck_command *command;
    struct load_request *load;
    void *options;
};

static int take(void *request, int letter) {
    const struct target *to = request;
    if (letter == 'D') {
        to->load->define[to->load->n_define++] = optarg;
        return EXIT_DONE;
    }
    return to->command->take(to->options, letter);
}

static int parse(const struct deck_command *c, int argc, char **argv, struct load_request *load,
                 void *options) {
    const struct command_options reading = {c->command, c->details, NULL, getopt_long,
                                            c->letters, c->option,  take, "define"};
    const int status = command_parse(&reading, argc, argv, &(struct target){c, load, options});
    if (status == GO_ON && argc - optind != 1) {
        return command_usage(c->command, "one deck is expected, not %d", argc - optind);
    }
    load->path = argv[optind];
    return status;
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
    int status = parse(c, argc, argv, load, options);
    if (status == GO_ON) {
        status = load_and_use(c, load, options);
    }
    free(define);
    return status;
}
