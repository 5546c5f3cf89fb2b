// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/analysis.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/support.h"

static struct model *build(const char *text) {
    struct deck *deck;
    struct error e = {0};
    struct model *m = NULL;
    gsl_set_error_handler_off();
    assert_int_equal(deck_open_text("test.deck", text, NULL, 0, &deck, &e), STATUS_OK);
    int status = model_build(deck, &m, &e);
    if (status != STATUS_OK) {
        diagnostics_print(&deck->diagnostics, stderr, false);
        fail_msg("%s", e.message);
    }
    return m;
}

static char *format_text(const char *format, va_list list) {
    va_list copy;
    va_copy(copy, list);
    int n = vsnprintf(NULL, 0, format, copy);
    va_end(copy);
    char *text = malloc((size_t)n + 1);
    assert_non_null(text);
    vsnprintf(text, (size_t)n + 1, format, list);
    return text;
}

static void grow(double **array, long capacity, int width) {
    *array = realloc(*array, (size_t)capacity * (size_t)(width > 0 ? width : 1) * sizeof **array);
    assert_non_null(*array);
}

static void reserve(struct kept_rows *r) {
    if (r->n < r->capacity) {
        return;
    }
    r->capacity = r->capacity ? 2 * r->capacity : 256;
    grow(&r->time, r->capacity, 1);
    double **const floors[] = {&r->displacement, &r->velocity, &r->acceleration, &r->drift,
                               &r->shear};
    for (size_t i = 0; i < sizeof floors / sizeof floors[0]; i++) {
        grow(floors[i], r->capacity, r->n_dof);
    }
    grow(&r->force, r->capacity, r->n_link);
    grow(&r->penetration, r->capacity, r->n_link);
    grow(&r->energy, r->capacity, ENERGY_COUNT);
}

static void copy(double *to, const double *from, long row, int width) {
    if (width > 0) {
        memcpy(to + row * width, from, (size_t)width * sizeof *to);
    }
}

static int keep_row(void *context, const struct row_view *row, struct error *e) {
    (void)e;
    struct kept_rows *r = context;
    reserve(r);
    r->time[r->n] = row->time;
    copy(r->displacement, row->displacement, r->n, r->n_dof);
    copy(r->velocity, row->velocity, r->n, r->n_dof);
    copy(r->acceleration, row->acceleration, r->n, r->n_dof);
    copy(r->drift, row->drift, r->n, r->n_dof);
    copy(r->shear, row->storey_shear, r->n, r->n_dof);
    copy(r->force, row->force, r->n, r->n_link);
    copy(r->penetration, row->penetration, r->n, r->n_link);
    copy(r->energy, row->energy, r->n, ENERGY_COUNT);
    r->n++;
    return STATUS_OK;
}

struct model *analysis_model(const char *format, ...) {
    va_list list;
    va_start(list, format);
    char *text = format_text(format, list);
    va_end(list);
    struct model *m = build(text);
    free(text);
    return m;
}

struct analysis analysis_try(const char *text, struct error *e) {
    struct analysis a = {.model = build(text)};
    a.rows.n_dof = a.model->n_dof;
    a.rows.n_link = a.model->n_link;
    struct observer observer = {.row = keep_row, .context = &a.rows};
    e->status = analysis_run(a.model, &observer, &a.results, e);
    return a;
}

struct analysis analysis_of(const char *format, ...) {
    va_list list;
    va_start(list, format);
    char *text = format_text(format, list);
    va_end(list);
    struct error e = {0};
    struct analysis a = analysis_try(text, &e);
    free(text);
    if (e.status != STATUS_OK) {
        fail_msg("%s", e.message);
    }
    return a;
}

void analysis_free(struct analysis *a) {
    struct kept_rows *r = &a->rows;
    double *const arrays[] = {r->time,  r->displacement, r->velocity,    r->acceleration, r->drift,
                              r->shear, r->force,        r->penetration, r->energy};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++) {
        free(arrays[i]);
    }
    results_free(a->results);
    model_free(a->model);
    *a = (struct analysis){0};
}

static struct analysis storeys(const char *law, const char *step) {
    return analysis_of("building A -floors 3 -mass 100t -stiffness 90MN/m\n"
                       "damping A rayleigh 5%%\n"
                       "storey A:all %s -yield 300kN -hardening 0.05\n"
                       "ground record input/records/ELCENTRO_1940_NS.AT2 -scale 2\n"
                       "duration 8\n%s\n",
                       law, step);
}

void analysis_storey_laws_agree(const char *step, const char *other, double rtol) {
    static const char *const law[] = {"bilinear", "bouc-wen", "clough", "takeda"};
    for (size_t k = 0; k < sizeof law / sizeof law[0]; k++) {
        struct analysis a = storeys(law[k], step), b = storeys(law[k], other);
        for (int i = 0; i < 3; i++) {
            assert_close(b.results->peak[PEAK_DRIFT][i], a.results->peak[PEAK_DRIFT][i], rtol);
        }
        analysis_free(&a);
        analysis_free(&b);
    }
}

long analysis_row(const struct analysis *a, double t) {
    for (long i = 0; i < a->rows.n; i++) {
        if (fabs(a->rows.time[i] - t) < 1e-9) {
            return i;
        }
    }
    fail_msg("no row at t = %g", t);
    return 0;
}

double analysis_displacement(const struct analysis *a, int dof, double t) {
    return a->rows.displacement[analysis_row(a, t) * a->rows.n_dof + dof];
}

double analysis_flow(const struct analysis *a) {
    double largest = a->results->initial_energy;
    for (long i = 0; i < a->rows.n * ENERGY_COUNT; i++) {
        assert_true(isfinite(a->rows.energy[i]));
        if (i % ENERGY_COUNT != ENERGY_RESIDUAL) {
            largest = fmax(largest, fabs(a->rows.energy[i]));
        }
    }
    return largest;
}

double analysis_deepest(const struct analysis *a) {
    double depth = -INFINITY;
    for (int k = 0; k < a->model->n_contact; k++) {
        depth = fmax(depth, a->results->link[k].penetration);
    }
    return depth;
}

// The bits of two arrays.
static void assert_same(const void *got, const void *want, size_t n, const char *what) {
    if (n > 0 && memcmp(got, want, n) != 0) {
        fail_msg("%s differ", what);
    }
}

void analysis_assert_same(const struct model *m, const struct results *got,
                          const struct results *want) {
    size_t floors = (size_t)m->n_dof * sizeof(double);
    for (int q = 0; q < PEAK_COUNT; q++) {
        assert_same(got->peak[q], want->peak[q], floors, peak_names[q]);
        assert_same(got->peak_time[q], want->peak_time[q], floors, "times of peaks");
    }
    const size_t forces = (size_t)m->n_force * sizeof(double);
    assert_same(got->force_max, want->force_max, forces, "forces");
    assert_same(got->force_min, want->force_min, forces, "forces");
    assert_same(got->force_max_time, want->force_max_time, forces, "times of forces");
    assert_same(got->force_min_time, want->force_min_time, forces, "times of forces");
    for (int k = 0; k < m->n_link; k++) {
        const struct link_peak *a = &got->link[k], *b = &want->link[k];
        assert_same(a, b, offsetof(struct link_peak, impacts), "totals of a link");
        assert_int_equal(a->impacts, b->impacts);
    }
    assert_same(got->residual_drift, want->residual_drift, floors, "residual drifts");
    assert_same(got->deepest, want->deepest, (size_t)m->n_contact * sizeof(double), "penetrations");
    assert_int_equal(got->n_impact, want->n_impact);
    for (long i = 0; i < want->n_impact; i++) {
        const struct impact *a = &got->impact[i], *b = &want->impact[i];
        assert_int_equal(a->contact, b->contact);
        assert_int_equal(a->complete, b->complete);
        assert_int_equal(a->steps, b->steps);
        assert_same(&a->t_start, &b->t_start, 4 * sizeof(double), "times of an impact");
        assert_same(&a->peak_force, &b->peak_force, 4 * sizeof(double), "forces of an impact");
    }
    assert_same(got->energy, want->energy, sizeof want->energy, "energies");
    assert_same(&got->initial_energy, &want->initial_energy, sizeof(double), "initial energies");
    assert_same(&got->residual_peak, &want->residual_peak, sizeof(double), "residuals");
    assert_same(&got->totals, &want->totals, offsetof(struct totals, seconds), "totals");
}

const char *analysis_el_centro(void) {
    enum { HEAD = 4 };
    const char *text = support_read("input/records/ELCENTRO_1940_NS.AT2", NULL);
    for (int i = 0; i < HEAD; i++) {
        text = strchr(text, '\n') + 1;
    }
    char *series = malloc(strlen(text) + 3);
    assert_non_null(series);
    sprintf(series, "0\n%s", text);
    const char *path = support_write("el_centro.txt", series);
    free(series);
    return path;
}
