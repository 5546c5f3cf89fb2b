// SPDX-License-Identifier: GPL-3.0-or-later
// An analysis into its file: what a run alone, a run of a study and a measurement do alike.
#include "jostle/result.h"
#include "result/writer.h"

// The rows go to the writer, the question whether to go on to who asked for the analysis.
struct relay {
    struct observer writer;
    const struct observer *watch;
};

static int relay_row(void *context, const struct row_view *row, struct error *e) {
    const struct relay *r = context;
    return r->writer.row(r->writer.context, row, e);
}

static int relay_poll(void *context, double time, struct error *e) {
    const struct relay *r = context;
    return r->watch->poll(r->watch->context, time, e);
}

int result_analyse(struct result_writer *w, const struct observer *watch, struct results **out,
                   struct error *e) {
    struct relay relay = {.writer = result_observer(w), .watch = watch};
    const struct observer observer = {
        .row = relay_row, .poll = watch && watch->poll ? relay_poll : NULL, .context = &relay};
    int status = analysis_run(w->model, &observer, out, e);
    if (status != STATUS_OK) {
        result_abort(w);
        return status;
    }
    status = result_finish(w, *out, e);
    if (status != STATUS_OK) {
        results_free(*out);
    }
    return status;
}
