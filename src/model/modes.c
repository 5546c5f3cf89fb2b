// SPDX-License-Identifier: GPL-3.0-or-later
// With y = M^(1/2) phi the problem is the symmetric one A y = omega^2 y, A = M^(-1/2) K M^(-1/2),
// which GSL solves by tridiagonal reduction and QR (Golub & Van Loan, Matrix Computations,
// section 8.3).
#include "model/modes.h"

#include <gsl/gsl_eigen.h>
#include <math.h>

#include "model/parts.h"

// Rigid-body modes come out as zero up to rounding of the largest eigenvalue.
static double frequency(double square, double largest) {
    double rounding = 1e-13 * largest;
    return square > rounding ? sqrt(square) : 0.0;
}

static void add_parts(gsl_matrix *a, int n, const double *mass, const double *parts) {
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) {
            *gsl_matrix_ptr(a, (size_t)i, (size_t)j) +=
                parts_on_floors(parts, n, i, j) / sqrt(mass[i] * mass[j]);
        }
    }
}

static void extract(int n, const double *mass, const gsl_vector *value, const gsl_matrix *vector,
                    double *omega, double *shape) {
    size_t last = (size_t)n - 1;
    double largest = gsl_vector_get(value, last);
    for (size_t m = 0; m <= last; m++) {
        omega[m] = frequency(gsl_vector_get(value, m), largest);
        double sign = gsl_matrix_get(vector, last, m) < 0.0 ? -1.0 : 1.0;
        for (size_t i = 0; i <= last; i++) {
            shape[m * (size_t)n + i] = sign * gsl_matrix_get(vector, i, m) / sqrt(mass[i]);
        }
    }
}

int modes_solve(int n, const double *mass, const double *stiffness, const double *parts,
                double *omega, double *shape, struct error *e) {
    size_t size = (size_t)n;
    int status = STATUS_OK;
    gsl_matrix *a = gsl_matrix_alloc(size, size);
    gsl_matrix *vector = gsl_matrix_alloc(size, size);
    gsl_vector *value = gsl_vector_alloc(size);
    gsl_eigen_symmv_workspace *w = gsl_eigen_symmv_alloc(size);
    if (!a || !vector || !value || !w) {
        status = error_no_memory(e);
        goto end;
    }
    gsl_matrix_set_zero(a);
    for (int i = 0; i < n; i++) {
        size_t r = (size_t)i;
        double above = i + 1 < n ? stiffness[i + 1] : 0.0;
        gsl_matrix_set(a, r, r, (stiffness[i] + above) / mass[i]);
        if (i + 1 < n) {
            double off = -above / sqrt(mass[i] * mass[i + 1]);
            gsl_matrix_set(a, r, r + 1, off);
            gsl_matrix_set(a, r + 1, r, off);
        }
    }
    if (parts) {
        add_parts(a, n, mass, parts);
    }
    if (gsl_eigen_symmv(a, value, vector, w) != 0 ||
        gsl_eigen_symmv_sort(value, vector, GSL_EIGEN_SORT_VAL_ASC) != 0) {
        status = error_set(e, STATUS_FAILED, "the eigenvalues of the building did not converge");
        goto end;
    }
    extract(n, mass, value, vector, omega, shape);
end:
    gsl_eigen_symmv_free(w);
    gsl_vector_free(value);
    gsl_matrix_free(vector);
    gsl_matrix_free(a);
    return status;
}

void modes_scale_to_largest(int n, double *shape) {
    for (int m = 0; m < n; m++) {
        double *phi = shape + (size_t)m * (size_t)n;
        double largest = phi[0];
        for (int i = 1; i < n; i++) {
            largest = fabs(phi[i]) > fabs(largest) ? phi[i] : largest;
        }
        for (int i = 0; i < n; i++) {
            phi[i] /= largest;
        }
    }
}
