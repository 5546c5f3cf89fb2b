// SPDX-License-Identifier: GPL-3.0-or-later
// Modal damping of buildings with parts: each mode decays by its ratio, and a building that strikes
// a wall moves as by a damping matrix that is made here.
#include <gsl/gsl_eigen.h>
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "model/parts.h"
#include "support/analysis.h"
#include "support/support.h"

enum { FLOORS = 3, DOFS_MAX = FLOORS + 2 };

static const double ratio[FLOORS] = {0.02, 0.04, 0.07};

#define HOUSE "units N m s\nbuilding A -floors 3 -mass 60t 50t 40t -height 3.5m 3m 3m"
#define FRAME                                                                                      \
    "frame A -bays 6 5 -modulus 30e9\ncolumns A:1:3 -I 2e-3 -A 0.16\nbeams A:1:3 -I 3e-3\n"
static const struct {
    const char *name, *deck;
} houses[] = {
    {"frame", HOUSE "\n" FRAME},
    {"wall", HOUSE " -stiffness 30e6\nwall A:1:3 -EI 3e9 -GA 1e9\n"},
    {"isolators", HOUSE " -stiffness 0 60e6 60e6\nisolator A:1 lrb -q 300e3 -kd 2e6\n" FRAME},
    {"hinges",
     HOUSE "\n" FRAME "hinges A:1:3 beams bilinear -yield 9e5 -hardening 0.02 -stiffness 2e8\n"},
};
enum { N_HOUSE = sizeof houses / sizeof houses[0] };

// In modes that start from 0.1 mm nothing yields.
static void each_mode_decays_by_its_ratio(void **state) {
    (void)state;
    for (int h = 0; h < N_HOUSE; h++) {
        for (int mode = 0; mode < FLOORS; mode++) {
            struct model *m =
                analysis_model("%sdamping A modal 2%% 4%% 7%%\ninitial A:1 -displacement 1e-4\n"
                               "duration 1\nstep fixed 1ms\n",
                               houses[h].deck);
            const struct building *g = &m->building[0];
            const double *phi = g->shape + (ptrdiff_t)mode * FLOORS, omega = g->omega[mode];
            struct analysis a =
                analysis_of("%sdamping A modal 2%% 4%% 7%%\ninitial A:1 -displacement %.17g\n"
                            "initial A:2 -displacement %.17g\ninitial A:3 -displacement %.17g\n"
                            "step fixed %.17g\nduration %.17g\n",
                            houses[h].deck, 1e-4 * phi[0], 1e-4 * phi[1], 1e-4 * phi[2],
                            M_PI / omega / 2000, 6 * M_PI / omega);
            const double z = ratio[mode], wd = omega * sqrt(1 - z * z);
            for (long r = 0; r < a.rows.n; r++) {
                const double t = a.rows.time[r];
                const double q =
                    exp(-z * omega * t) * (cos(wd * t) + z / sqrt(1 - z * z) * sin(wd * t));
                for (int i = 0; i < FLOORS; i++) {
                    assert_near(a.rows.displacement[r * FLOORS + i], 1e-4 * phi[i] * q, 2e-9);
                }
            }
            analysis_free(&a);
            model_free(m);
        }
    }
}

// M Phi diag(2 ratio omega) Phi' M of the building on a fixed base, whose stiffness on floors is k.
static void make_damping(const double *mass, const double *k, double *c) {
    double scaled[FLOORS * FLOORS] = {0}, root[FLOORS] = {0};
    for (int i = 0; i < FLOORS; i++) {
        root[i] = sqrt(mass[i]);
    }
    for (int i = 0; i < FLOORS * FLOORS; i++) {
        scaled[i] = k[i] / (root[i / FLOORS] * root[i % FLOORS]);
    }
    gsl_matrix_view matrix = gsl_matrix_view_array(scaled, FLOORS, FLOORS);
    gsl_vector *value = gsl_vector_alloc(FLOORS);
    gsl_matrix *vector = gsl_matrix_alloc(FLOORS, FLOORS);
    gsl_eigen_symmv_workspace *w = gsl_eigen_symmv_alloc(FLOORS);
    assert_true(value && vector && w);
    gsl_eigen_symmv(&matrix.matrix, value, vector, w);
    gsl_eigen_symmv_sort(value, vector, GSL_EIGEN_SORT_VAL_ASC);
    for (size_t i = 0; i < FLOORS; i++) {
        for (size_t j = 0; j < FLOORS; j++) {
            double sum = 0;
            for (size_t m = 0; m < FLOORS; m++) {
                sum += 2 * ratio[m] * sqrt(gsl_vector_get(value, m)) *
                       gsl_matrix_get(vector, i, m) * gsl_matrix_get(vector, j, m);
            }
            c[i * FLOORS + j] = root[i] * root[j] * sum;
        }
    }
    gsl_eigen_symmv_free(w);
    gsl_vector_free(value);
    gsl_matrix_free(vector);
}

// A linear system whose degree of freedom `struck` meets a spring at a gap.
struct reference {
    int n, struck;
    double mass[DOFS_MAX], c[DOFS_MAX * DOFS_MAX], k[DOFS_MAX * DOFS_MAX];
    double gap, spring;
};

static void stiffness_on_floors(const struct building *g, double *k) {
    const int n = g->n_dof;
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) {
            const double above = i + 1 < n ? g->spring[i + 1] : 0;
            const double chain = i == j       ? g->spring[i] + above
                                 : j == i + 1 ? -above
                                 : j == i - 1 ? -g->spring[i]
                                              : 0;
            k[i * n + j] =
                chain + (g->part_stiffness ? parts_on_floors(g->part_stiffness, n, i, j) : 0);
        }
    }
}

// T' C T + the dashpots of the slab, with T = [1, -1, -level / height] from displacements to those
// of the building itself.
static void put_damping(struct reference *r, const struct building *g) {
    const struct building *own = g->fixed ? g->fixed : g;
    double k[FLOORS * FLOORS] = {0}, c[FLOORS * FLOORS] = {0}, t[FLOORS][DOFS_MAX] = {{0}};
    double level = 0;
    stiffness_on_floors(own, k);
    make_damping(own->mass, k, c);
    for (int i = 0; i < FLOORS; i++) {
        level += own->height[i];
        t[i][i] = 1;
        t[i][FLOORS] = -1;
        t[i][FLOORS + 1] = -level / 9.5;
    }
    for (int p = 0; p < r->n * r->n; p++) {
        for (int q = 0; q < FLOORS * FLOORS; q++) {
            r->c[p] += t[q / FLOORS][p / r->n] * c[q] * t[q % FLOORS][p % r->n];
        }
    }
    if (g->fixed) {
        r->c[FLOORS * r->n + FLOORS] += g->foundation->sway_dashpot;
        r->c[r->n * r->n - 1] += g->foundation->rocking_dashpot / (9.5 * 9.5);
    }
}

static void rates(const struct reference *r, const double *x, double *out) {
    const double delta = x[r->struck] - r->gap;
    for (int i = 0; i < r->n; i++) {
        double force = i == r->struck && delta > 0 ? -r->spring * delta : 0;
        for (int j = 0; j < r->n; j++) {
            force -= r->k[i * r->n + j] * x[j] + r->c[i * r->n + j] * x[r->n + j];
        }
        out[i] = x[r->n + i];
        out[r->n + i] = force / r->mass[i];
    }
}

static void step_reference(const struct reference *r, double h, double *x) {
    const int n = 2 * r->n;
    double k[4][2 * DOFS_MAX] = {{0}}, at[2 * DOFS_MAX] = {0};
    static const double to[] = {0, 0.5, 0.5, 1}, weight[] = {1, 2, 2, 1};
    for (int s = 0; s < 4; s++) {
        for (int i = 0; i < n; i++) {
            at[i] = x[i] + (s > 0 ? h * to[s] * k[s - 1][i] : 0);
        }
        rates(r, at, k[s]);
    }
    for (int s = 0; s < 4; s++) {
        for (int i = 0; i < n; i++) {
            x[i] += h / 6 * weight[s] * k[s][i];
        }
    }
}

static const char *const founded[] = {
    "", "foundation A -mass 50t -inertia 1e6 -sway 4e8 -rocking 2e10 -sway-dashpot 3e6 "
        "-rocking-dashpot 4e7\n"};

static void a_building_that_strikes_is_that_of_the_matrix(void **state) {
    (void)state;
    for (int h = 0; h < 2 * N_HOUSE; h++) {
        if (strcmp(houses[h / 2].name, "hinges") == 0 && h % 2 == 1) {
            continue;  // hinges do not stand on a foundation
        }
        struct analysis a =
            analysis_of("%s%sdamping A modal 2%% 4%% 7%%\ninitial A:1 -velocity 0.01\n"
                        "initial A:2 -velocity 0.02\ninitial A:3 -velocity 0.03\n"
                        "contact A:3 wall -gap 0.2mm -law linear -k 4e7\n"
                        "integrator newmark\nstep fixed 0.02ms\noutput -every 500\nduration 0.5\n",
                        houses[h / 2].deck, founded[h % 2]);
        const struct building *g = &a.model->building[0];
        struct reference r = {.n = g->n_dof, .struck = 2, .gap = 2e-4, .spring = 4e7};
        double x[2 * DOFS_MAX] = {0};
        memcpy(r.mass, g->mass, (size_t)r.n * sizeof *r.mass);
        stiffness_on_floors(g, r.k);
        put_damping(&r, g);
        for (int i = 0; i < FLOORS; i++) {
            x[r.n + i] = 0.01 * (i + 1);
        }
        assert_true(a.results->link[0].impacts > 0 && a.results->link[0].force > 1e4);
        for (long row = 1; row < a.rows.n; row++) {
            for (int i = 0; i < 1000; i++) {
                step_reference(&r, 1e-5, x);
            }
            for (int i = 0; i < r.n; i++) {
                assert_near(a.rows.displacement[row * r.n + i], x[i], 1e-9);
                assert_near(a.rows.velocity[row * r.n + i], x[r.n + i], 5e-7);
            }
        }
        analysis_free(&a);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_mode_decays_by_its_ratio),
        cmocka_unit_test(a_building_that_strikes_is_that_of_the_matrix),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
