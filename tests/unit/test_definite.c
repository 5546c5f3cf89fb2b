// SPDX-License-Identifier: GPL-3.0-or-later
// Symmetric matrices without negative eigenvalues.
#include <gsl/gsl_eigen.h>
#include <gsl/gsl_sort_vector.h>
#include <math.h>
#include <string.h>

#include "core/definite.h"
#include "support/support.h"

enum { N = 5, SQUARE = N * N };

static void eigenvalues(const double *k, double *value) {
    double copy[SQUARE];
    memcpy(copy, k, sizeof copy);
    gsl_matrix_view m = gsl_matrix_view_array(copy, N, N);
    gsl_vector_view v = gsl_vector_view_array(value, N);
    gsl_eigen_symm_workspace *w = gsl_eigen_symm_alloc(N);
    assert_non_null(w);
    gsl_eigen_symm(&m.matrix, &v.vector, w);
    gsl_eigen_symm_free(w);
    gsl_sort_vector(&v.vector);
}

// A symmetric matrix of numbers without a pattern, with this added to its diagonal.
static void fill(double *k, double diagonal) {
    for (int i = 0; i < N; i++) {
        for (int j = 0; j <= i; j++) {
            k[i * N + j] = k[j * N + i] = 1e6 * sin(1.0 + 7.0 * i + 13.0 * j * j);
        }
        k[i * N + i] += diagonal;
    }
}

// The others stay, with their vectors: so k and the clipped matrix have a product of which the
// trace is the sum of the squares of these.
static void negative_eigenvalues_become_zero(void **state) {
    double k[SQUARE], scratch[2 * SQUARE], before[N], after[N], was[SQUARE];
    (void)state;
    fill(k, 0);
    memcpy(was, k, sizeof was);
    eigenvalues(k, before);
    definite_clip(k, N, scratch);
    eigenvalues(k, after);
    assert_true(before[0] < -1e5 && before[N - 1] > 1e5);
    double squares = 0, trace = 0;
    for (int i = 0; i < N; i++) {
        assert_near(after[i], fmax(before[i], 0), 1e-8);
        squares += pow(fmax(before[i], 0), 2);
    }
    for (int i = 0; i < SQUARE; i++) {
        trace += k[i] * was[i];
        assert_true(k[i] == k[i % N * N + i / N]);
    }
    assert_close(trace, squares, 1e-13);
}

static void a_matrix_without_them_keeps_its_bits(void **state) {
    double k[SQUARE], scratch[2 * SQUARE], was[SQUARE];
    (void)state;
    for (int c = 0; c < 3; c++) {
        fill(k, 8e6);
        for (int i = 0; i < N && c > 0; i++) {
            k[i * N + 2] = k[2 * N + i] = 0;  // a singular matrix
            k[12] = c == 1 ? 0 : -1e-5;
        }
        memcpy(was, k, sizeof was);
        definite_clip(k, N, scratch);
        assert_memory_equal(k, was, sizeof was);
    }
}

static void a_diagonal_matrix_is_clipped_entry_by_entry(void **state) {
    double k[SQUARE] = {0}, scratch[2 * SQUARE];
    (void)state;
    for (int i = 0; i < N; i++) {
        k[i * N + i] = i - 1.5;
    }
    definite_clip(k, N, scratch);
    for (int i = 0; i < SQUARE; i++) {
        const int row = i / N;
        assert_true(k[i] == (i % N == row ? fmax(row - 1.5, 0) : 0));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(negative_eigenvalues_become_zero),
        cmocka_unit_test(a_matrix_without_them_keeps_its_bits),
        cmocka_unit_test(a_diagonal_matrix_is_clipped_entry_by_entry),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
