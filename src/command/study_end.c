// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/study_end.h"

int study_end(long n_failed, long n_run, const char *path, const char *first) {
    if (n_failed == 0) {
        return EXIT_DONE;
    }
    struct error e;
    error_set(&e, STATUS_FAILED, "%ld of %ld runs failed; /message in %s says why%s%s", n_failed,
              n_run, path, first[0] ? ", the first: " : "", first);
    return command_fail(&e);
}
