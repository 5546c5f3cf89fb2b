// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a study: a deck with sweeps, on several threads, into one file, and so that nothing finished
// is lost: finished runs are kept in a journal beside the result file, from which the same command
// goes on after whatever ended the program.
#ifndef JOSTLE_STUDY_H
#define JOSTLE_STUDY_H

#include "jostle/model.h"
#include "jostle/names.h"
#include "jostle/result.h"
#include "jostle/study_file.h"

JOSTLE_C_BEGIN

struct study_progress {
    long n_run;           // of the study, or of the part of it
    long n_kept;          // runs that were found done: in the journal, in a file
    long n_done;          // runs done so far, kept and failed ones included
    long n_failed;        // of them, those that failed
    long n_left;          // after an error: runs that the same command finds done
    long n_damaged;       // places of that journal where runs may be lost
    double seconds_left;  // estimated by the lengths of the runs; 0: not known
    int n_thread;
    bool left_histories;  // the file that was replaced had histories, which the new one lacks
    char histories[256];  // the runs that were chosen for histories, from 1, as text
    char failure[768];    // of this start, the failed run of the lowest number, and why; "": none
};

// What to do with the journal of an earlier start.
enum study_journal { STUDY_RESUME, STUDY_RESTART };

struct study_request {
    const struct model *first;  // the model of the deck, that of its first run
    const char *const *define;  // (n_define) NAME=VALUE it was read with
    int n_define;
    int n_thread;
    struct study_shard shard;  // the part to run; all zero: the whole
    enum study_journal journal;
    const char *const *take;  // (n_take) study files whose finished runs are taken
    int n_take;
    bool retry;               // runs that failed are not taken
    const char *histories;    // runs whose histories are wanted (study/selection.h); NULL: none
    long steps_max;           // a run with more steps has failed; 0: no limit
    double seconds_max;       // a run that takes longer [s of its thread] has failed; 0: no limit
    int numerics;             // NUMERICS_VERSION: results of another one are not mixed in
    struct checksum program;  // of the program, for the record in the result file
    struct result_options result;

    // Called every 0.1 s by the thread that called study_run. A result other than 0
    // ends the study with that status; what is finished stays in the journal.
    int (*poll)(void *context, const struct study_progress *p, struct error *e);
    void *context;
};

// Runs what is not done and writes the result file; the journal is then removed. A run is done if a
// run of its key (study/keys.h) is in the journal, in a file to be taken, or in the result file of
// an earlier study that has no other runs, which is then replaced. If that file is just this study,
// nothing is written. Results do not depend on the number of threads, nor on where they come from,
// to the last bit. Runs that fail are results. *p tells how far it came, whatever happens. Errors:
// STATUS_INPUT (the result or the journal has other runs; runs differ in their buildings or
// contacts; a file changed), STATUS_SYSTEM, or what `poll` returned.
//
// If the request has `histories`, the chosen runs are then run again, and the file is written once
// more, with their histories. If that ends early, the file stays as it was.
int study_run(const struct study_request *q, struct study_progress *p, struct error *e);

JOSTLE_C_END

#endif
