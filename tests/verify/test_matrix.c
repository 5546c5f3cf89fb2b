// SPDX-License-Identifier: GPL-3.0-or-later
// Buildings of a full stiffness matrix. A chain that is written as a matrix gives the results of
// the chain, whatever acts on it.
#include <gsl/gsl_eigen.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "support/analysis.h"
#include "support/support.h"

enum { FLOORS_OF_A = 5, FLOORS_OF_B = 4 };

// Writes the matrix of a chain, each number with all its digits.
static const char *chain_file(const char *name, const double *stiffness, int n) {
    char text[16384] = "# a chain\n";
    size_t used = strlen(text);
    for (int i = 0; i < n; i++) {
        const double above = i + 1 < n ? stiffness[i + 1] : 0;
        for (int j = 0; j < n; j++) {
            const double entry = j == i       ? stiffness[i] + above
                                 : j == i - 1 ? -stiffness[i]
                                 : j == i + 1 ? -above
                                              : 0;
            used += (size_t)snprintf(text + used, sizeof text - used, "%s%.17g", j > 0 ? ", " : "",
                                     entry);
        }
        used += (size_t)snprintf(text + used, sizeof text - used, "\n");
    }
    return support_write(name, text);
}

static const double stiffness_a[FLOORS_OF_A] = {150e6, 140e6, 130e6, 110e6, 90e6};
static const double stiffness_b[FLOORS_OF_B] = {250e6, 250e6, 200e6, 170e6};

#define CHAIN_A "building A -floors 5 -mass 200t -stiffness 150e6 140e6 130e6 110e6 90e6\n"
#define CHAIN_B "building B -floors 4 -mass 150t -stiffness 250e6 250e6 200e6 170e6\n"
#define FULL_A "building A -floors 5 -mass 200t\nmatrix A %s\n"
#define FULL_B "building B -floors 4 -mass 150t\nmatrix B %s\n"
#define RECORD "ground record input/records/ELCENTRO_1940_NS.AT2\n"

// The largest difference of two histories, relative to the largest value.
static double difference(const double *x, const double *y, long n) {
    double size = 0, most = 0;
    for (long i = 0; i < n; i++) {
        size = fmax(size, fabs(y[i]));
        most = fmax(most, fabs(x[i] - y[i]));
    }
    return size > 0 ? most / size : most;
}

static void assert_alike(const struct analysis *got, const struct analysis *want, double rtol) {
    const struct kept_rows *g = &got->rows, *w = &want->rows;
    assert_int_equal(g->n, w->n);
    const long n = w->n * w->n_dof, n_link = w->n * w->n_link;
    const double most[] = {
        difference(g->displacement, w->displacement, n),
        difference(g->velocity, w->velocity, n),
        difference(g->acceleration, w->acceleration, n),
        difference(g->drift, w->drift, n),
        difference(g->shear, w->shear, n),
        difference(g->force, w->force, n_link),
        difference(g->energy, w->energy, w->n * ENERGY_COUNT),
    };
    for (size_t i = 0; i < sizeof most / sizeof most[0]; i++) {
        assert_near(most[i], 0, rtol);
    }
    assert_int_equal(got->results->n_impact, want->results->n_impact);
    for (int q = 0; q < PEAK_COUNT; q++) {
        for (int i = 0; i < w->n_dof; i++) {
            assert_close(got->results->peak[q][i], want->results->peak[q][i], rtol);
        }
    }
    for (int i = 0; i < want->model->n_building; i++) {
        const struct building *a = &got->model->building[i], *b = &want->model->building[i];
        assert_near(difference(a->omega, b->omega, a->n_dof), 0, 1e-12);
    }
}

// The account of energy closes to rounding, or as far as the method lets that of the chain close.
static void assert_closed(const struct analysis *full, const struct analysis *chain) {
    const double rounding = 1e-12 * analysis_flow(full);
    assert_true(full->results->residual_peak <= 1.001 * chain->results->residual_peak + rounding);
}

// Runs `rest` on the pair as chains, as matrices, and with one of each.
static void compare_at(const char *rest, double rtol) {
    const char *a = chain_file("a.txt", stiffness_a, FLOORS_OF_A);
    const char *b = chain_file("b.txt", stiffness_b, FLOORS_OF_B);
    struct analysis chain = analysis_of(CHAIN_A CHAIN_B "%s", rest);
    struct analysis full[] = {
        analysis_of(FULL_A CHAIN_B "%s", a, rest),
        analysis_of(CHAIN_A FULL_B "%s", b, rest),
        analysis_of(FULL_A FULL_B "%s", a, b, rest),
    };
    for (size_t i = 0; i < sizeof full / sizeof full[0]; i++) {
        assert_alike(&full[i], &chain, rtol);
        assert_closed(&full[i], &chain);
        analysis_free(&full[i]);
    }
    analysis_free(&chain);
}

static void compare(const char *rest) {
    compare_at(rest, 1e-12);
}

// The same where A alone is a matrix.
static void compare_a(const char *rest) {
    struct analysis chain = analysis_of(CHAIN_A CHAIN_B "%s", rest);
    struct analysis full =
        analysis_of(FULL_A CHAIN_B "%s", chain_file("a.txt", stiffness_a, FLOORS_OF_A), rest);
    assert_alike(&full, &chain, 1e-12);
    assert_closed(&full, &chain);
    analysis_free(&full);
    analysis_free(&chain);
}

static void a_matrix_of_a_chain_moves_as_the_chain(void **state) {
    (void)state;
    compare(RECORD "duration 8\nstep fixed 2ms\n");
    compare("damping A rayleigh 5%\ndamping B rayleigh 2% 5% -modes 1 3\n" RECORD
            "duration 8\nstep fixed 2ms\n");
    compare("damping A modal 3%\ndamping B modal 1% 2% 3% 4%\n" RECORD
            "duration 8\nstep fixed 2ms\n");
    compare("damping A rayleigh -alpha 0.1 -beta 1ms\ndamping B dashpot 1e6\n" RECORD
            "duration 8\nstep fixed 2ms\n");
}

#define DAMPED "damping A rayleigh 5%\ndamping B rayleigh 5%\n"

// Against GSL's solution of K phi = omega^2 M phi.
static void periods_and_shapes_are_those_of_the_matrix(void **state) {
    (void)state;
    enum { N = 3 };
    const double k[N * N] = {9e6, -5e6, 1e6, -5e6, 7e6, -3e6, 1e6, -3e6, 2.5e6};
    const double mass[N] = {2000, 1000, 3000};
    double stiffness[N * N], masses[N * N] = {0};
    for (int i = 0; i < N * N; i++) {
        stiffness[i] = k[i];
        masses[i] = i % (N + 1) == 0 ? mass[i / (N + 1)] : 0;
    }
    gsl_matrix_view a = gsl_matrix_view_array(stiffness, N, N);
    gsl_matrix_view b = gsl_matrix_view_array(masses, N, N);
    gsl_matrix *shape = gsl_matrix_alloc(N, N);
    gsl_vector *square = gsl_vector_alloc(N);
    gsl_eigen_gensymmv_workspace *w = gsl_eigen_gensymmv_alloc(N);
    assert_int_equal(gsl_eigen_gensymmv(&a.matrix, &b.matrix, square, shape, w), 0);
    gsl_eigen_gensymmv_sort(square, shape, GSL_EIGEN_SORT_VAL_ASC);
    const char *file =
        support_write("three.txt", "9e6 -5e6 1e6\n-5e6, 7e6, -3e6\n1e6 -3e6 2.5e6\n");
    struct model *m = analysis_model("building A -floors 3 -mass 2000 1000 3000\nmatrix A %s\n"
                                     "duration 1\nstep fixed 1ms\ninitial A -velocity 1\n",
                                     file);
    const struct building *g = &m->building[0];
    for (int i = 0; i < N; i++) {
        assert_close(g->omega[i], sqrt(gsl_vector_get(square, (size_t)i)), 1e-12);
        for (int j = 0; j < N; j++) {
            const double ratio = gsl_matrix_get(shape, (size_t)j, (size_t)i) /
                                 gsl_matrix_get(shape, N - 1, (size_t)i);
            assert_close(g->shape[i * N + j] / g->shape[i * N + N - 1], ratio, 1e-10);
        }
    }
    assert_close(g->stiffness[2], 2.5e6, 1e-12);
    assert_close(g->stiffness[1], 7e6 + 2.5e6 - 2 * 3e6, 1e-12);
    gsl_eigen_gensymmv_free(w);
    gsl_vector_free(square);
    gsl_matrix_free(shape);
    model_free(m);
}

static void it_does_so_with_contacts(void **state) {
    (void)state;
    compare(DAMPED RECORD "contact A B -gap 5mm -law kelvin-voigt -k 93.5MN/m -e 0.65\n"
                          "duration 8\nstep fixed 1ms\n");
    compare(DAMPED RECORD "contact A B -gap 5mm -law jankowski -k 2.75e9 -e 0.65\n"
                          "duration 8\nstep fixed 1ms\n");
    compare(DAMPED RECORD "contact A B -gap 5mm -law stereomechanical -e 0.65\n"
                          "duration 4\nstep fixed 1ms\n");
}

static void it_does_so_with_links_loads_grounds_and_initial_states(void **state) {
    (void)state;
    compare(DAMPED RECORD "link A:4 B:4 -stiffness 20MN/m -dashpot 1MN*s/m\n"
                          "link A:2 B:2 -dashpot 300kN*s^0.5/m^0.5 -exponent 0.5\n"
                          "duration 8\nstep fixed 2ms\n");
    compare(DAMPED RECORD "ground sine -amplitude 0.1g -frequency 2 -buildings B\n"
                          "load A:3 sine -amplitude 300kN -frequency 1\n"
                          "initial A:1:5 -displacement 5mm\ninitial B:4 -velocity 0.1\n"
                          "contact A B -gap 20mm -law linear -k 100MN/m\n"
                          "duration 4\nstep fixed 1ms\n");
}

static void it_does_so_beside_storeys_that_yield(void **state) {
    (void)state;
    compare_a(DAMPED RECORD "storey B:1:2 bilinear -yield 1.2MN -hardening 0.05\n"
                            "storey B:3 bouc-wen -yield 1MN -hardening 0.05\n"
                            "contact A B -gap 5mm -law kelvin-voigt -k 93.5MN/m -e 0.65\n"
                            "duration 8\nstep fixed 1ms\n");
}

static void it_does_so_in_adaptive_steps(void **state) {
    (void)state;
    static const char adaptive[] = DAMPED RECORD "integrator newmark\nduration 4\n"
                                                 "step adaptive -tolerance 1e-6\n";
    char text[1024];
    compare(adaptive);
    snprintf(text, sizeof text, "%scontact A B -gap 5mm -law kelvin-voigt -k 93.5MN/m -e 0.65\n",
             adaptive);
    compare_at(text, 1e-11);
}

static void it_does_so_by_dormand_and_prince(void **state) {
    (void)state;
    static const char method[] = "integrator dormand-prince\nstep adaptive -tolerance 1e-8\n";
    char text[1024];
    static const char *const rest[] = {
        DAMPED RECORD "duration 8\n",
        DAMPED RECORD "contact A B -gap 5mm -law kelvin-voigt -k 93.5MN/m -e 0.65\nduration 4\n",
        DAMPED RECORD "contact A B -gap 5mm -law stereomechanical -e 0.65\nduration 1\n",
        DAMPED RECORD "link A:4 B:4 -stiffness 20MN/m -dashpot 1MN*s/m\n"
                      "ground sine -amplitude 0.1g -frequency 2 -buildings B\n"
                      "load A:3 sine -amplitude 300kN -frequency 1\n"
                      "initial A:1:5 -displacement 5mm\nduration 4\n",
    };
    for (size_t i = 0; i < sizeof rest / sizeof rest[0]; i++) {
        snprintf(text, sizeof text, "%s%s", rest[i], method);
        compare_at(text, 1e-10);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_matrix_of_a_chain_moves_as_the_chain),
        cmocka_unit_test(periods_and_shapes_are_those_of_the_matrix),
        cmocka_unit_test(it_does_so_with_contacts),
        cmocka_unit_test(it_does_so_with_links_loads_grounds_and_initial_states),
        cmocka_unit_test(it_does_so_beside_storeys_that_yield),
        cmocka_unit_test(it_does_so_in_adaptive_steps),
        cmocka_unit_test(it_does_so_by_dormand_and_prince),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
