// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/suite_options.h"

#include <string.h>

#include "core/arena.h"
#include "core/safe.h"

const struct option_row suite_options_rows[] = {
    {"collapse", .kind = OPTION_SET, .at = offsetof(struct suite_options, collapse), .set = 1,
     .doc = "shares of runs that collapse (statement collapse), in place of a demand and a limit"},
    {"over", 0, "NAME", OPTION_TEXT, 0, offsetof(struct suite_options, request.over),
     .doc = "sweeps whose values are samples, as NAME or NAME,NAME (default: record, or the only "
            "sweep of texts, with the sweeps paired with it, and the samples of random sweeps)"},
    {"at", 0, "NAME=VALUE", OPTION_WORDS, 0, offsetof(struct suite_options, at),
     .doc = "uses the runs with this value of a sweep only; may be repeated"},
    {"failed", 0, "above|left-out", OPTION_CHOICE, 0,
     offsetof(struct suite_options, request.failed),
     .doc = "failed runs count as above every value (the default), or are left out"},
    {0}};

void suite_options_print_edps(void) {
    printf("\nEDP is one of these demands: the largest value of a run; of counts and energies the "
           "sum.\n");
    for (int i = 0; i < n_edp_quantity; i++) {
        printf("  %-20s %s\n", edp_quantities[i].name, edp_quantities[i].doc);
    }
    printf("\nIt covers all buildings, contacts or links, or those named: drift:A, drift:A:3 "
           "(storey 3),\n"
           "force:NAME.\n");
}

const char *suite_options_collapse(struct suite_options *o) {
    if (!o->collapse) {
        return NULL;
    }
    if (o->request.edp || o->limits) {
        return "--collapse has a demand and a limit; leave out --edp and --limit";
    }
    o->request.edp = EDP_COLLAPSE;
    o->limits = "0";
    return NULL;
}

const struct suite_request *suite_options_request(struct suite_options *o) {
    o->request.at = o->at.word;
    o->request.n_at = o->at.n;
    return &o->request;
}

// Frames have collapsed at drift ratios of 10 %.
static const double DRIFT_RATIO_MAX = 0.2;

// Warns about a limit on a drift ratio, read from `text`, that seems to be a percentage without its
// sign.
static void warn_limit(const struct edp *p, const char *text, double limit) {
    if (p->quantity->divisor && limit > DRIFT_RATIO_MAX && !strchr(text, '%')) {
        safe_line(stderr, "jostle: warning: limit %s of %s is %g %%; %s %% is %s%% or %g", text,
                  p->text, 100.0 * limit, text, text, 0.01 * limit);
    }
}

int suite_options_limits(const struct suite_options *o, const struct suite *s, double **limit,
                         int *n, struct error *e) {
    *n = 0;
    if (!o->limits) {
        return STATUS_OK;
    }
    const size_t length = strlen(o->limits);
    *limit = arena_alloc(s->arena, length + 1, sizeof **limit);
    if (!*limit) {
        return error_no_memory(e);
    }
    const char *at = o->limits;
    for (;;) {
        const size_t part = strcspn(at, ",");
        const char *text = arena_text(s->arena, at, part);
        if (!text) {
            return error_no_memory(e);
        }
        int status = edp_limit(&s->edp, &s->view->units, text, &(*limit)[*n], e);
        if (status != STATUS_OK) {
            return status;
        }
        warn_limit(&s->edp, text, (*limit)[*n]);
        ++*n;
        if (at[part] == '\0') {
            return STATUS_OK;
        }
        at += part + 1;
    }
}

int suite_options_edp_limit(const struct command *c, const struct plan *p, const char *text,
                            struct edp *edp, double *limit) {
    const char *equal = strrchr(text, '=');
    if (!equal) {
        return command_usage(c, "--limit takes EDP=VALUE, not '%s'", text);
    }
    struct arena *a = p->table->arena;
    const char *name = arena_text(a, text, (size_t)(equal - text));
    const struct study_view view = plan_view(p);
    struct error e;
    int status = name ? edp_parse(&view, name, a, edp, &e) : error_no_memory(&e);
    if (status == STATUS_OK) {
        status = edp_limit(edp, &view.units, equal + 1, limit, &e);
    }
    if (status == STATUS_OK) {
        warn_limit(edp, equal + 1, *limit);
    }
    return status == STATUS_OK ? EXIT_DONE : command_fail(&e);
}

void suite_options_warn(const struct suite *s) {
    if (s->n_missing > 0) {
        safe_line(stderr, "jostle: warning: %ld of %ld runs are not in %s; they are left out",
                  s->n_missing, s->n_run, s->view->path);
    }
    if (s->n_unplaced > 0) {
        fprintf(stderr,
                "jostle: warning: %ld of %ld runs have no ground motion; they are left out\n",
                s->n_unplaced, s->n_run);
    }
    if (s->n_failed == 0) {
        return;
    }
    fprintf(stderr, "jostle: warning: %ld of %ld runs failed; they %s:\n", s->n_failed, s->n_run,
            s->rule == SUITE_FAILED_ABOVE ? "count as above every value (--failed)"
                                          : "are left out");
    for (long i = 0; i < s->n_failed && i < SUITE_NAMED_MAX; i++) {
        safe_line(stderr, "  %s", s->failed[i]);
    }
    if (s->n_failed > SUITE_NAMED_MAX) {
        fprintf(stderr, "  and %ld more\n", s->n_failed - SUITE_NAMED_MAX);
    }
}
