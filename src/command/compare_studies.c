// SPDX-License-Identifier: GPL-3.0-or-later
// jostle compare of two studies: ratios of demands run by run, and of fragilities.
#include <math.h>
#include <string.h>

#include "command/compare.h"
#include "command/crash.h"
#include "command/printer.h"
#include "core/safe.h"
#include "study/fragility_runs.h"
#include "study/run_pairs.h"

struct comparison_of_studies {
    const struct compare_studies *request;
    const struct run_pairs *pairs;
    struct printer table;
};

static void describe(const struct run_pairs *p, FILE *to) {
    safe_line(to, "%s over %s", p->view[0]->path, p->view[1]->path);
    safe_line(to, "%ld pairs of runs%s%s", p->n, p->matched[0] ? " of the same " : "", p->matched);
    for (int side = 0; side < 2; side++) {
        if (p->n_only[side] > 0) {
            safe_line(to, "%ld run%s only in %s", p->n_only[side],
                      p->n_only[side] == 1 ? " is" : "s are", p->view[side]->path);
        }
    }
}

static void print_ratios(struct comparison_of_studies *c, const struct run_ratios *r) {
    const struct run_pairs *p = c->pairs;
    struct printer *t = &c->table;
    const double ratio[] = {r->median, r->dispersion, r->smallest, r->largest};
    printer_text(t, r->text);
    printer_whole(t, r->n);
    printer_numbers(t, ratio, 4);
    for (int side = 0; side < 2; side++) {
        printer_whole(t, study_view_run(p->view[side], p->pair[r->at_largest].row[side]) + 1);
        printer_number(t, r->value[side][r->at_largest]);
    }
    printer_text(t, r->edp[0].units);
    printer_line(t);
}

// A demand, if both studies have positive values of it.
static int add_demand(struct comparison_of_studies *c, const char *text, struct error *e) {
    struct run_ratios r;
    struct edp edp;
    for (int side = 0; side < 2; side++) {
        const int status = edp_parse(c->pairs->view[side], text, c->pairs->arena, &edp, e);
        if (status != STATUS_OK) {
            return status == STATUS_INPUT ? STATUS_OK : status;
        }
    }
    const int status = run_pairs_read(c->pairs, text, &r, e);
    if (status == STATUS_OK && r.n > 0) {
        print_ratios(c, &r);
    }
    return status;
}

// All demands that both studies have, those of buildings for each building.
static int add_all(struct comparison_of_studies *c, struct error *e) {
    const struct study_view *v = c->pairs->view[0];
    int status = STATUS_OK;
    for (int i = 0; i < n_edp_quantity && status == STATUS_OK; i++) {
        const struct edp_quantity *q = &edp_quantities[i];
        const int n = q->owner == EDP_OF_BUILDING ? v->n_building : 1;
        for (int k = 0; k < n && status == STATUS_OK; k++) {
            const char *text =
                q->owner != EDP_OF_BUILDING
                    ? q->name
                    : arena_format(c->pairs->arena, "%s:%s", q->name, v->building[k].name);
            status = text ? add_demand(c, text, e) : error_no_memory(e);
        }
    }
    return status;
}

static int print_table(struct comparison_of_studies *c, struct error *e) {
    static const struct printer_column columns[] = {
        {"demand", "demand", NULL, NULL, -24, 0, LOOK_TAIL},
        {"pairs", "pairs", NULL, NULL, 7, 0, LOOK_WHOLE},
        {"median", "median", NULL, NULL, 9, 4, LOOK_G},
        {"dispersion", "dispersion", NULL, NULL, 12, 3, LOOK_G},
        {"smallest", "smallest", NULL, NULL, 10, 4, LOOK_G},
        {"largest", "largest", NULL, NULL, 10, 4, LOOK_G},
        {"of run", "run", NULL, NULL, 8, 0, LOOK_WHOLE},
        {NULL, "value", NULL, NULL, 0, 0, LOOK_G},
        {"and run", "other_run", NULL, NULL, 9, 0, LOOK_WHOLE},
        {NULL, "other_value", NULL, NULL, 0, 0, LOOK_G},
        {NULL, "unit", NULL, NULL, 0, 0, LOOK_WHOLE}};
    const char *edp = c->request->edp;
    struct run_ratios r = {.n = 0};
    int status = edp ? run_pairs_read(c->pairs, edp, &r, e) : STATUS_OK;
    if (status == STATUS_OK && edp && r.n == 0) {
        status = error_set(e, STATUS_INPUT, "no pair of runs has positive values of %s", edp);
    }
    if (status != STATUS_OK) {
        return status;
    }
    c->table = (struct printer){
        .to = stdout, .form = c->request->form, .units = &c->pairs->view[0]->units};
    PRINTER_ADD(&c->table, columns);
    printer_head(&c->table);
    if (edp) {
        print_ratios(c, &r);
    } else {
        status = add_all(c, e);
    }
    return printer_end(&c->table, status, e);
}

// The fragility of a group of a study; not fitted if there is no such group.
static int fit(const struct suite *s, int group, double limit, struct fragility *out,
               struct error *e) {
    struct fragility_runs runs;
    const int status = fragility_runs_create(s, &runs, e);
    struct fragility_level *level = arena_alloc(s->arena, (size_t)runs.n, sizeof *level);
    if (status != STATUS_OK || !level) {
        return status != STATUS_OK ? status : error_no_memory(e);
    }
    fragility_runs_take(&runs, s, group);
    return fragility_fit(level, fragility_runs_count(&runs, limit, NULL, level), out, e);
}

// The group of the other study with the same values, or its only one; -1: there is none.
static int find_group(const struct suite *s, const char *group) {
    int found = s->n_group == 1 ? 0 : -1;
    for (int i = 0; i < s->n_group; i++) {
        found = strcmp(s->group[i], group) == 0 ? i : found;
    }
    return found;
}

static int print_fits(struct comparison_of_studies *c, struct suite *const s[2], double limit,
                      struct error *e) {
    const bool swap = s[1]->n_group > s[0]->n_group;  // the groups of the study that has more
    int status = STATUS_OK;
    for (int g = 0; g < s[swap]->n_group && status == STATUS_OK; g++) {
        struct fragility f[2] = {{0}};
        int group[2];
        group[swap] = g;
        group[!swap] = find_group(s[!swap], s[swap]->group[g]);
        for (int side = 0; side < 2 && group[!swap] >= 0 && status == STATUS_OK; side++) {
            status = fit(s[side], group[side], limit, &f[side], e);
        }
        if (status != STATUS_OK || group[!swap] < 0) {
            continue;
        }
        const bool fitted = f[0].outcome == FRAGILITY_FITTED && f[1].outcome == FRAGILITY_FITTED;
        printer_text(&c->table, s[swap]->group[g][0] ? s[swap]->group[g] : "all");
        printer_number(&c->table, limit);
        for (int side = 0; side < 2; side++) {
            const bool known = f[side].outcome == FRAGILITY_FITTED;
            printer_number(&c->table, known ? f[side].median : NAN);
            printer_number(&c->table, known ? f[side].dispersion : NAN);
        }
        printer_number(&c->table, fitted ? f[0].median / f[1].median : NAN);
        const char *why = fragility_reason(&f[f[0].outcome == FRAGILITY_FITTED]);
        printer_text(&c->table, fitted ? "" : why);
        printer_line(&c->table);
    }
    return status;
}

static int print_fragilities(struct comparison_of_studies *c, struct error *e) {
    static const struct printer_column columns[] = {
        {"runs", "runs", NULL, NULL, -24, 0, LOOK_TAIL},
        {"limit", "limit", NULL, NULL, 9, 4, LOOK_G},
        {"median", "median", NULL, NULL, 10, 4, LOOK_G},
        {"beta", "dispersion", NULL, NULL, 8, 3, LOOK_G},
        {"other", "other_median", NULL, NULL, 10, 4, LOOK_G},
        {"beta", "other_dispersion", NULL, NULL, 8, 3, LOOK_G},
        {"ratio", "ratio", NULL, NULL, 9, 4, LOOK_G},
        {"  ", "result", NULL, NULL, 0, 0, LOOK_WHOLE}};
    const struct compare_studies *q = c->request;
    const struct suite_request request = {.edp = q->edp};
    struct suite *s[2] = {NULL, NULL};
    double limit = 0.0;
    int status = STATUS_OK;
    for (int side = 0; side < 2 && status == STATUS_OK; side++) {
        status = suite_create(c->pairs->file[side], &request, &s[side], e);
    }
    if (status == STATUS_OK) {
        status = edp_limit(&s[0]->edp, &s[0]->view->units, q->limit, &limit, e);
    }
    if (status == STATUS_OK && strcmp(s[0]->edp.units, s[1]->edp.units) != 0) {
        status = error_set(e, STATUS_INPUT, "the studies have different units of %s: %s and %s",
                           s[0]->edp.text, s[0]->edp.units, s[1]->edp.units);
    }
    if (status == STATUS_OK) {
        if (q->form == FORM_TEXT) {
            printf("\nmedian of the intensity %s", s[0]->abscissa->name);
            safe_line(stdout, "%s%s%s at which %s exceeds the limit",
                      s[0]->abscissa_units[0] ? " [" : "", s[0]->abscissa_units,
                      s[0]->abscissa_units[0] ? "]" : "", s[0]->edp.text);
        }
        c->table = (struct printer){.to = stdout, .form = q->form, .units = &s[0]->view->units};
        PRINTER_ADD(&c->table, columns);
        printer_head(&c->table);
        status = printer_end(&c->table, print_fits(c, s, limit, e), e);
    }
    suite_free(s[0]);
    suite_free(s[1]);
    return status;
}

static int compare(struct comparison_of_studies *c, struct error *e) {
    const bool text = c->request->form == FORM_TEXT;
    describe(c->pairs, text ? stdout : stderr);
    if (text) {
        puts("");
    }
    // A table for programs is one table.
    int status = text || !c->request->limit ? print_table(c, e) : STATUS_OK;
    return status == STATUS_OK && c->request->limit ? print_fragilities(c, e) : status;
}

static int use_pairs(void *context, const struct run_pairs *p, struct error *e) {
    struct comparison_of_studies c = {.request = context, .pairs = p};
    return compare(&c, e);
}

int compare_studies(struct compare_studies *q, struct error *e) {
    return compare_pairs(q->path, use_pairs, q, e);
}

int compare_pairs(const char *const path[2], compare_pairs_use *use, void *context,
                  struct error *e) {
    struct study_file *f[2] = {NULL, NULL};
    struct run_pairs pairs;
    int status = STATUS_OK;
    for (int side = 0; side < 2 && status == STATUS_OK; side++) {
        crash_reading(NULL, path[side]);
        status = study_file_open(path[side], &f[side], e);
    }
    if (status == STATUS_OK) {
        status = run_pairs_open(&pairs, f[0], f[1], e);
        status = status == STATUS_OK ? use(context, &pairs, e) : status;
        run_pairs_close(&pairs);
    }
    study_file_close(f[0]);
    study_file_close(f[1]);
    crash_reading(NULL, NULL);
    return status;
}
