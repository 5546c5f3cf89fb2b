// SPDX-License-Identifier: GPL-3.0-or-later
// A stiffness matrix: n rows of n numbers. The layout of the text is that of records: spaces, tabs,
// commas or semicolons between numbers, comments after #, lines of text above the numbers.
//
// The matrix must be symmetric. Entries (i, j) and (j, i) may differ by 1e-6 of sqrt(K_ii K_jj),
// the rounding of seven printed digits. Their mean is used. The matrix must be positive definite:
// the pivots of its Cholesky factorisation must be above rounding, 1e-12 of the diagonal.
#include "motion/matrix_file.h"

#include <assert.h>
#include <gsl/gsl_eigen.h>
#include <math.h>

#include "core/arena.h"
#include "jostle/units.h"
#include "motion/table.h"

enum { FILE_SIZE_MAX = 32 << 20 };

static const double ASYMMETRY_MAX = 1e-6;
static const double PIVOT_MIN = 1e-12;

static int check_size(const struct record_text *t, const struct table *table,
                      const struct matrix_request *q, struct error *e) {
    const size_t n = (size_t)q->n;
    if (table->n_ragged == 0 && table->n_column != table->n_row &&
        table->n_last == table->n_column) {
        return lines_error(e, t->path, 0,
                           "%zu rows of %zu values; a stiffness matrix has as many rows as columns",
                           table->n_row, table->n_column);
    }
    if (table->n_column != n) {
        return lines_error(e, t->path, table->first_line,
                           "row of %zu values; the stiffness matrix of %s has %d rows of %d",
                           table->n_column, q->of, q->n, q->n);
    }
    return table->n_row == n
               ? STATUS_OK
               : lines_error(e, t->path, 0, "%zu rows; the stiffness matrix of %s has %d",
                             table->n_row, q->of, q->n);
}

static int read_row(const struct record_text *t, const struct table *table, const struct lines *l,
                    double *row, struct error *e) {
    struct piece rest = l->line;
    const size_t n = lines_count(rest, table->separators);
    if (n != table->n_column) {
        return lines_error(e, t->path, l->number, "row of %zu values; the first has %zu", n,
                           table->n_column);
    }
    for (size_t j = 0; j < n; j++) {
        struct number_field f = {.text = t, .line = l->number, .what = "stiffness", .index = j + 1};
        lines_field(&rest, table->separators, &f.field);
        const int status = table_number(table, &f, &row[j], e);
        if (status != STATUS_OK) {
            return status;
        }
    }
    return STATUS_OK;
}

// Makes the matrix symmetric. An error if it is not symmetric to rounding.
static int check_symmetry(const struct record_text *t, size_t n, double *k, struct error *e) {
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < i; j++) {
            double *below = &k[i * n + j], *above = &k[j * n + i];
            const double size = sqrt(fabs(k[i * n + i])) * sqrt(fabs(k[j * n + j]));
            if (!(fabs(*below - *above) <= ASYMMETRY_MAX * size)) {
                return lines_error(e, t->path, 0,
                                   "the matrix is not symmetric: row %zu has %.9g in column %zu, "
                                   "row %zu has %.9g in column %zu",
                                   j + 1, *above, i + 1, i + 1, *below, j + 1);
            }
            *below = *above = *below / 2.0 + *above / 2.0;
        }
    }
    return STATUS_OK;
}

// Checks that the matrix is positive definite. Its Cholesky factor L replaces `k` (n, n).
static bool is_definite(size_t n, double *k) {
    bool definite = true;
    for (size_t j = 0; definite && j < n; j++) {
        const double own = k[j * n + j];
        for (size_t i = j; i < n; i++) {
            double sum = k[i * n + j];
            for (size_t m = 0; m < j; m++) {
                sum -= k[i * n + m] * k[j * n + m];
            }
            k[i * n + j] = sum;
        }
        const double pivot = k[j * n + j];
        definite = pivot > PIVOT_MIN * own;
        for (size_t i = j; definite && i < n; i++) {
            k[i * n + j] /= sqrt(pivot);
        }
    }
    return definite;
}

static int not_definite(const struct record_text *t, const struct matrix_request *q, double *k,
                        struct error *e) {
    const size_t n = (size_t)q->n;
    gsl_matrix_view matrix = gsl_matrix_view_array(k, n, n);
    gsl_vector *value = gsl_vector_alloc(n);
    gsl_eigen_symm_workspace *w = gsl_eigen_symm_alloc(n);
    int status;
    if (!value || !w) {
        status = error_no_memory(e);
    } else if (gsl_eigen_symm(&matrix.matrix, value, w) != 0) {
        status = lines_error(e, t->path, 0, "the matrix is not positive definite");
    } else {
        status =
            lines_error(e, t->path, 0,
                        "the matrix is not positive definite: its smallest eigenvalue is %.6g, "
                        "its largest one is %.6g %s",
                        gsl_vector_min(value), gsl_vector_max(value), q->unit);
    }
    gsl_eigen_symm_free(w);
    gsl_vector_free(value);
    return status;
}

static int check_definite(const struct record_text *t, const struct matrix_request *q,
                          const double *k, struct error *e) {
    const size_t n = (size_t)q->n;
    struct arena *scratch = arena_create();
    double *copy = scratch ? arena_alloc(scratch, n * n, sizeof *copy) : NULL;
    int status = copy ? STATUS_OK : error_no_memory(e);
    for (size_t i = 0; copy && i < n * n; i++) {
        copy[i] = k[i];
    }
    if (copy && !is_definite(n, copy)) {
        for (size_t i = 0; i < n * n; i++) {
            copy[i] = k[i];
        }
        status = not_definite(t, q, copy, e);
    }
    arena_free(scratch);
    return status;
}

// Converts the matrix to the unit of the result.
static int convert(const struct record_text *t, const struct matrix_request *q, double *k,
                   struct error *e) {
    const size_t n = (size_t)q->n;
    for (size_t i = 0; i < n * n; i++) {
        k[i] = unit_convert(k[i], q->from, q->to);
        if (!isfinite(k[i])) {
            return lines_error(e, t->path, 0,
                               "row %zu, column %zu is out of range in the deck's units", i / n + 1,
                               i % n + 1);
        }
    }
    return STATUS_OK;
}

static int read_rows(const struct record_text *t, const struct table *table, double *k,
                     struct error *e) {
    struct lines l = table->rows;
    for (size_t i = 0; i < table->n_row && table_next(&l); i++) {
        const int status = read_row(t, table, &l, k + i * table->n_row, e);
        if (status != STATUS_OK) {
            return status;
        }
    }
    return STATUS_OK;
}

static int read_text(struct arena *a, const struct matrix_request *q, const struct record_text *t,
                     double **value, struct error *e) {
    const size_t n = (size_t)q->n;
    struct record_text text;
    struct table table;
    if (record_clean(t, &text, e) != STATUS_OK || table_read(&text, &table, e) != STATUS_OK ||
        check_size(&text, &table, q, e) != STATUS_OK) {
        return e->status;
    }
    double *k = *value = arena_alloc(a, n * n, sizeof *k);
    if (!k) {
        return error_no_memory(e);
    }
    return read_rows(&text, &table, k, e) != STATUS_OK ||
                   check_symmetry(&text, n, k, e) != STATUS_OK ||
                   check_definite(&text, q, k, e) != STATUS_OK
               ? e->status
               : convert(&text, q, k, e);
}

int matrix_read(struct arena *a, const struct matrix_request *request, double **value,
                struct error *e) {
    assert(request->n > 0 && request->from > 0.0 && request->to > 0.0);
    struct record_text t;
    struct arena *scratch;
    int status = record_text_open(request->path, FILE_SIZE_MAX, &t, &scratch, e);
    if (status == STATUS_OK) {
        status = read_text(a, request, &t, value, e);
        arena_free(scratch);
    }
    return status;
}
