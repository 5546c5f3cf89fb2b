// SPDX-License-Identifier: GPL-3.0-or-later
// The picture of a demand of two studies, run against run.
#include "command/plot_pairs.h"

#include "command/compare.h"
#include "core/safe.h"
#include "core/text.h"
#include "plot/pictures.h"
#include "study/roles.h"

static int write_pairs(void *context, const struct figure_files *to, struct error *e) {
    return pairs_figure_write(context, to, e);
}

static int draw_pairs(void *context, const struct run_pairs *p, struct error *e) {
    const struct plot_pairs *q = context;
    const struct study_view *v = p->view[0];
    struct run_ratios r;
    const int status = run_pairs_read(p, q->edp, &r, e);
    if (status != STATUS_OK) {
        return status;
    }
    const int dimension = roles_intensity(v);
    const struct sweep *sweep = dimension < 0 ? NULL : v->sweep[dimension];
    size_t n;
    double *at = arena_alloc(p->arena, (size_t)p->n, sizeof *at);
    for (long i = 0; at && sweep && i < p->n; i++) {
        const long run = study_view_run(v, p->pair[i].row[0]);
        at[i] = sweep->number[study_view_choice(v, run, dimension)];
    }
    struct pairs_figure figure = {
        .title = v->title[0] ? v->title : v->path,
        .subtitle = arena_format(p->arena, "%ld pairs of runs; ratio: median %.4g, dispersion %.3g",
                                 p->n, r.median, r.dispersion),
        .version = JOSTLE_VERSION,
        .study = {text_stem(q->path[0], &n), text_stem(q->path[1], &n)},
        .units = &v->units,
        .edp = &r.edp[0],
        .n = p->n,
        .value = {r.value[0], r.value[1]},
        .at = sweep ? at : NULL,
        .at_name = sweep ? sweep->name : NULL,
        .at_dimension =
            sweep ? edp_units(sweep->units, v->units.gravity, &(double){0}) : dimension_none};
    if (!at || !figure.subtitle) {
        return error_no_memory(e);
    }
    const struct picture_request picture = {
        .options = q->picture, .name = "compare", .write = write_pairs, .context = &figure};
    const int made = picture_make(&picture, e);
    if (made == STATUS_OK && q->picture.output) {
        safe_line(stdout, "%s", q->picture.output);
    }
    return made;
}

int plot_pairs(struct plot_pairs *q, struct error *e) {
    return compare_pairs(q->path, draw_pairs, q, e);
}
