// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/demands.h"

#include <math.h>

#include "core/arena.h"

// The next run of a file.
struct reading {
    const struct demands *demands;
    double *to;  // its values
};

static int take(void *context, const struct study_run *r, struct error *e) {
    struct reading *x = context;
    const struct demands *d = x->demands;
    const struct study_view *v = study_file_view(d->file);
    const bool done = r->outcome->status == STUDY_DONE;
    const bool collapsed = done && edp_collapsed(v, r->value);
    for (int i = 0; i < d->n; i++) {
        const struct edp *edp = &d->edp[i];
        int at = 0;
        x->to[i] = !done ? NAN : edp_value(edp, r->value, &at);
        if (done && d->absent == DEMANDS_ERROR && isnan(x->to[i])) {
            return edp_absent(edp, at, e);
        }
        // Beyond a collapse there are no demands; that of a building counts as above all others.
        if (collapsed && edp->quantity->owner == EDP_OF_BUILDING) {
            x->to[i] = INFINITY;
        }
    }
    x->to += d->n;
    return STATUS_OK;
}

int demands_read(const struct demands *d, struct error *e) {
    struct reading x = {d, d->value};
    return study_file_each(d->file, take, &x, e);
}

// Storey heights are 0 where the deck gives none; the first run that was done says so.
static int find_usual(struct study_file *f, struct arena *a, struct edp *out, struct error *e) {
    const struct study_view *v = study_file_view(f);
    struct study_outcome *outcome = arena_alloc(a, 1, sizeof *outcome);
    double *value = arena_alloc(a, v->table.n_value + 1, sizeof *value);
    if (!outcome || !value) {
        return error_no_memory(e);
    }
    int at, status = STATUS_OK;
    outcome->status = STUDY_FAILED;
    for (long i = 0; i < v->n_run && outcome->status != STUDY_DONE && status == STATUS_OK; i++) {
        status = study_file_read(f, i, 1, outcome, value, e);
    }
    if (status != STATUS_OK) {
        return status;
    }
    status = edp_parse(v, "drift-ratio", a, out, e);
    if (status == STATUS_INPUT || (status == STATUS_OK && !isfinite(edp_value(out, value, &at)))) {
        status = edp_parse(v, "drift", a, out, e);
    }
    return status;
}

int demands_find(struct study_file *f, const char *text, struct arena *a, struct edp *out,
                 struct error *e) {
    return text ? edp_parse(study_file_view(f), text, a, out, e) : find_usual(f, a, out, e);
}
