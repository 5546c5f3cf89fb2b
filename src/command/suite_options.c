// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/suite_options.h"

#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/safe.h"

const char suite_options_help[] =
    "  --over NAME    sweeps whose values are samples, as NAME or NAME,NAME (default: record, or\n"
    "                 the only sweep of texts, alone or with what goes together with it, and the\n"
    "                 samples of random sweeps)\n"
    "  --at NAME=VALUE\n"
    "                 looks at the runs with this value of a sweep only; may be repeated\n"
    "  --failed above|left-out\n"
    "                 runs that failed count as above every value (the default), or not at all\n";

void suite_options_print_edps(void) {
    printf("\nEDP is one of these; the largest one of a run, of counts and energies the sum:\n");
    for (int i = 0; i < n_edp_quantity; i++) {
        printf("  %-16s %s\n", edp_quantities[i].name, edp_quantities[i].doc);
    }
    printf("\nof all buildings, contacts or links, or of those named: drift:A, drift:A:3 (of "
           "floor 3),\n"
           "force:NAME.\n");
}

int suite_options_init(struct suite_options *o, int argc, struct error *e) {
    *o = (struct suite_options){.at = calloc((size_t)argc, sizeof *o->at)};
    o->request.at = o->at;
    return o->at ? STATUS_OK : error_no_memory(e);
}

void suite_options_close(struct suite_options *o) {
    free(o->at);
}

bool suite_options_has(int letter) {
    return letter >= SUITE_EDP && letter <= SUITE_FAILED;
}

static int take_failed(const struct command *c, struct suite_options *o) {
    const bool above = strcmp(optarg, "above") == 0;
    if (!above && strcmp(optarg, "left-out") != 0) {
        return command_usage(c, "--failed is above or left-out, not '%s'", optarg);
    }
    o->request.failed = above ? SUITE_FAILED_ABOVE : SUITE_FAILED_LEFT_OUT;
    return EXIT_DONE;
}

int suite_options_take(const struct command *c, int letter, struct suite_options *o) {
    static const char *const name[] = {"--edp", "--im or --against", "--over",
                                       "--at",  "--limit",           "--failed"};
    o->first = o->first ? o->first : name[letter - SUITE_EDP];
    struct suite_request *q = &o->request;
    switch (letter) {
        case SUITE_EDP:
            q->edp = optarg;
            return EXIT_DONE;
        case SUITE_IM:
            q->abscissa = optarg;
            return EXIT_DONE;
        case SUITE_OVER:
            q->over = optarg;
            return EXIT_DONE;
        case SUITE_AT:
            o->at[q->n_at++] = optarg;
            return EXIT_DONE;
        case SUITE_LIMIT:
            o->limits = optarg;
            return EXIT_DONE;
        default:
            return take_failed(c, o);
    }
}

// Frames have collapsed at drift ratios of 10 %.
static const double DRIFT_RATIO_MAX = 0.2;

void suite_options_warn_limit(const struct edp *p, const char *text, double limit) {
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
        suite_options_warn_limit(&s->edp, text, (*limit)[*n]);
        ++*n;
        if (at[part] == '\0') {
            return STATUS_OK;
        }
        at += part + 1;
    }
}

void suite_options_warn(const struct suite *s) {
    if (s->n_missing > 0) {
        safe_line(stderr, "jostle: warning: %ld of %ld runs are not in %s; they are left out",
                  s->n_missing, s->n_run, s->view->path);
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
