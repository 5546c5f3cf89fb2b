// SPDX-License-Identifier: GPL-3.0-or-later
// jostle plot, of a study.
#include "command/plot_study.h"

#include <assert.h>

#include "command/plot_names.h"
#include "core/safe.h"
#include "plot/study_figure.h"

struct job {
    const struct plot_study_request *request;
    const struct study_figure *figure;  // NULL: what shows the suite best
    struct study_picture picture;
    char output[PLOT_PATH_SIZE];
};

void plot_study_print_kinds(void) {
    printf("\nOf a study KIND is one of\n");
    for (int i = 0; i < n_study_figure; i++) {
        printf("  %-10s %s\n", study_figures[i]->name, study_figures[i]->doc);
    }
    printf(
        "\nWithout KIND it is ida, where an intensity and records are swept, else response.\n\n");
}

// EXIT_DONE with the figure asked for, or EXIT_INPUT.
static int find_figure(struct job *j) {
    const struct plot_study_request *q = j->request;
    if (!q->kind || (j->figure = study_figure_find(q->kind)) != NULL) {
        return EXIT_DONE;
    }
    if (figure_find(q->kind)) {
        return command_usage(q->command,
                             "%s is for single runs; %s is a study; name a run of it, such as "
                             "%s#1",
                             q->kind, q->path, q->path);
    }
    const char *known[8];
    int n = 0;
    for (; n < n_study_figure && n < 8; n++) {
        assert(study_figures[n]);
        known[n] = study_figures[n]->name;
    }
    return command_unknown(q->command, "figure of studies", q->kind, known, n);
}

static int write_figure(void *context, const struct figure_files *to, struct error *e) {
    const struct job *j = context;
    return study_figure_write(j->figure, &j->picture, to, e);
}

static int draw(struct job *j, const struct suite *s, struct error *e) {
    const struct plot_study_request *q = j->request;
    double *limit = NULL;
    j->picture.suite = s;
    j->figure = j->figure ? j->figure : study_figure_default(s);
    int status = suite_options_limits(q->options, s, &limit, &j->picture.n_limit, e);
    j->picture.limit = limit;
    if (status != STATUS_OK) {
        return status;
    }
    suite_options_warn(s);
    struct picture_request picture = {
        .options = q->picture, .name = j->figure->name, .write = write_figure, .context = j};
    if (!picture_is_wanted(&q->picture)) {
        picture.options.output = plot_name_output(q->path, j->figure->name, j->output);
    }
    status = picture_make(&picture, e);
    if (status == STATUS_OK && picture.options.output) {
        safe_line(stdout, "%s", picture.options.output);
    }
    return status;
}

int plot_study(const struct plot_study_request *q) {
    struct job j = {.request = q};
    struct study_file *f;
    struct suite *s;
    struct error e;
    int status = find_figure(&j);
    if (status != EXIT_DONE) {
        return status;
    }
    if (study_file_open(q->path, &f, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    struct suite_request request = *suite_options_request(q->options);
    request.guess = j.figure ? j.figure->guess : SUITE_ANY;
    status = suite_create(f, &request, &s, &e);
    if (status == STATUS_OK) {
        status = draw(&j, s, &e);
        suite_free(s);
    }
    study_file_close(f);
    return status == STATUS_OK ? EXIT_DONE : command_fail(&e);
}
