// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/deck_command.h"

#include <unistd.h>

static int use(void *options, struct arena *a, const struct words *operand) {
    (void)a;
    struct load_request *load = options;
    const struct deck_command *c = load->command;
    struct model *m;
    load->path = operand->word[0];
    int status = c->settle ? c->settle(options) : EXIT_DONE;
    status = status == EXIT_DONE ? load_model(load, &m) : status;
    if (status == EXIT_DONE) {
        status = c->use(options, m);
        model_free(m);
    }
    return status;
}

int deck_command_run(const struct deck_command *c, int argc, char **argv,
                     struct load_request *load) {
    const struct option_list list = {c->command, c->part, .operand = "deck", .use = use};
    load->command = c;
    return option_run(&list, argc, argv, load);
}

int deck_command_threads(void) {
    const long n = sysconf(_SC_NPROCESSORS_ONLN);
    return n < 1 ? 1 : n > THREADS_MAX ? THREADS_MAX : (int)n;
}
