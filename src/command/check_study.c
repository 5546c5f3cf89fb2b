// SPDX-License-Identifier: GPL-3.0-or-later

#include <math.h>
#include <string.h>

#include "command/check.h"
#include "core/safe.h"
#include "study/survey.h"

static bool has_message(const struct diagnostics *d, const char *message) {
    for (int i = 0; i < d->n_item; i++) {
        if (strcmp(d->item[i].message, message) == 0) {
            return true;
        }
    }
    return false;
}

static void print_strongest(void *context, const struct model *m, const struct guidance *g) {
    const struct survey *s = context;
    struct plan_text t;
    safe_line(stdout, "%s is the strongest run checked:", plan_describe(s->plan, s->strongest, &t));
    guidance_print(m, g);
    guidance_warn(m, g);
    // The warnings about a run that the first run does not have.
    const struct diagnostics *run = &m->deck->diagnostics;
    for (int i = 0; i < run->n_item; i++) {
        if (!has_message(&s->plan->first->deck->diagnostics, run->item[i].message)) {
            const struct diagnostics one = {.item = &run->item[i], .n_item = 1, .n_warning = 1};
            diagnostics_print(&one, stderr, command_colour());
        }
    }
}

struct soft_text {
    const struct survey *survey;
    char text[sizeof(struct plan_text) + 8];
};

static const char *softest_where(void *context, int k) {
    struct soft_text *t = context;
    struct plan_text run;
    snprintf(t->text, sizeof t->text, " in %s",
             plan_describe(t->survey->plan, t->survey->softest_run[k], &run));
    return t->text;
}

// The diagnostics beyond the first `known`.
static void print_from(const struct diagnostics *d, int known) {
    const int n = d->n_item - known;
    diagnostics_print(&(struct diagnostics){.item = d->item + known, .n_item = n, .n_warning = n},
                      stderr, command_colour());
}

// The warnings about the damping of the first run have been given.
static void print_damped(const struct survey *s) {
    const struct model *first = s->plan->first;
    const struct diagnostics *d = &first->deck->diagnostics;
    struct plan_text run;
    const int known = d->n_item;
    if (s->damped_run == 0) {
        return;
    }
    deck_warning(first->deck, first->building[s->damped.building].damping, "in %s, %s",
                 plan_describe(s->plan, s->damped_run, &run), s->damped.text);
    print_from(d, known);
}

static int report(struct survey *s, struct error *e) {
    printf("\nchecked the models of %ld of %ld runs, which read %ld file%s\n", s->n_run,
           s->plan->n_run, s->n_file, s->n_file == 1 ? "" : "s");
    for (const struct survey_error *f = s->error; f; f = f->next) {
        struct plan_text t;
        const char *run = plan_describe(s->plan, f->run, &t);
        // The message of a run of another shape begins with the run.
        const bool says_run = strncmp(f->message, run, strlen(run)) == 0;
        char more[64] = "";
        if (f->n_more > 0) {
            snprintf(more, sizeof more, " (and %ld more of the runs checked)", f->n_more);
        }
        safe_line(stderr, "jostle: error: %s%s%s%s", says_run ? "" : run, says_run ? "" : ": ",
                  f->message, more);
    }
    const struct model *first = s->plan->first;
    const struct diagnostics *d = &first->deck->diagnostics;
    const int known = d->n_item;
    guidance_warn_storeys(first, s->n_contact, s->softest, softest_where,
                          &(struct soft_text){.survey = s});
    print_from(d, known);
    print_damped(s);
    return first->adaptive || isinf(s->bound) ? STATUS_OK
                                              : survey_strongest(s, print_strongest, s, e);
}

int check_study(const struct load_request *load, const struct model *first) {
    struct plan plan;
    struct survey survey;
    struct error e;
    if (deck_command_plan(load, first, &plan, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    int status = survey_run(&survey, &plan, &e);
    if (status == STATUS_OK) {
        status = report(&survey, &e);
    }
    if (status == STATUS_OK && survey.n_failed == 0) {
        status = survey_shapes(&plan, &e);
    }
    const bool wrong = survey.n_failed > 0;
    survey_close(&survey);
    plan_close(&plan);
    return status != STATUS_OK ? command_fail(&e) : wrong ? EXIT_INPUT : EXIT_DONE;
}
