// SPDX-License-Identifier: GPL-3.0-or-later
// On drifts the stiffness is D = diag(k) + that of parts, and P-delta takes G = diag(P/h) off it.
// With all P times lambda, the building buckles where D - lambda G becomes singular: 1/lambda is
// the largest root mu of G x = mu D x. Without parts the storeys buckle one by one, at the smallest
// k h / P.
#include "model/pdelta.h"

#include <gsl/gsl_eigen.h>
#include <math.h>

#include "deck/reader.h"
#include "model/modes.h"

// The factor at which shear storeys buckle, and which storey (from 0) does.
static double pdelta_buckling_of_chain(const struct building *g, int *storey) {
    double least = INFINITY;
    for (int i = 0; i < g->n_dof; i++) {
        const double factor = g->pdelta[i] > 0.0 ? g->spring[i] / g->pdelta[i] : INFINITY;
        if (factor < least) {
            least = factor;
            *storey = i;
        }
    }
    return least;
}

// The factor at which a building with parts buckles; 0 if it does not stand without P-delta. False:
// no memory.
static bool pdelta_buckling_with_parts(const struct building *g, double *factor) {
    const size_t n = (size_t)g->n_dof;
    gsl_matrix *d = gsl_matrix_alloc(n, n), *p = gsl_matrix_calloc(n, n);
    gsl_vector *mu = gsl_vector_alloc(n);
    gsl_eigen_gensymm_workspace *w = gsl_eigen_gensymm_alloc(n);
    const bool has_memory = d && p && mu && w;
    for (size_t i = 0; has_memory && i < n; i++) {
        for (size_t j = 0; j < n; j++) {
            gsl_matrix_set(d, i, j, g->part_stiffness[i * n + j] + (i == j ? g->spring[i] : 0.0));
        }
        gsl_matrix_set(p, i, i, g->pdelta[i]);
    }
    *factor = 0.0;
    if (has_memory && gsl_eigen_gensymm(p, d, mu, w) == 0) {
        *factor = 1.0 / gsl_vector_max(mu);
    }
    gsl_eigen_gensymm_free(w);
    gsl_vector_free(mu);
    gsl_matrix_free(p);
    gsl_matrix_free(d);
    return has_memory;
}

// The stability coefficients theta = P drift / (V h) as the building sways in its first mode, where
// V is the shear of its resistance, in equilibrium with the inertia above. In a shear storey it is
// P / (k h) in any motion.
static void pdelta_coefficients(const struct building *g, double omega, const double *shape,
                                double *theta) {
    double inertia = 0.0;
    for (int i = g->n_dof - 1; i >= 0; i--) {
        const double drift = shape[i] - (i > 0 ? shape[i - 1] : 0.0);
        inertia += omega * omega * g->mass[i] * shape[i];
        const double stiffness = g->n_part == 0 ? g->spring[i] : inertia / drift;
        theta[i] = g->pdelta[i] / stiffness;
    }
}

// Reports a building that its P-delta loads buckle; true if they do.
static bool pdelta_buckles(struct builder *b, const struct building_draft *d,
                           const struct building *g, int storey) {
    char where[48] = "";
    if (g->buckling > 1.0) {
        return false;
    }
    if (g->n_part == 0 && g->n_dof > 1) {
        snprintf(where, sizeof where, " in storey %d", storey + 1);
    }
    deck_error(b->deck, &d->pdelta,
               "building %s buckles%s under its gravity loads: its buckling factor on initial "
               "stiffness is %.4g, and must be above 1",
               g->name, where, g->buckling);
    return true;
}

int pdelta_apply(struct builder *b, const struct building_draft *d, struct building *g,
                 double *omega, double *shape, struct error *e) {
    const size_t n = (size_t)g->n_dof;
    double *axial = arena_alloc(b->arena, n, sizeof *axial);
    double *pdelta = arena_alloc(b->arena, n, sizeof *pdelta);
    double *theta = arena_alloc(b->arena, n, sizeof *theta);
    double *spring = arena_alloc(b->arena, n, sizeof *spring);
    int storey = 0;
    if (arena_failed(b->arena)) {
        return error_no_memory(e);
    }
    double above = 0.0;
    for (size_t i = n; i-- > 0;) {
        axial[i] = above += d->load[i];
        pdelta[i] = above / d->height[i];
        spring[i] = g->spring[i] - pdelta[i];
    }
    g->axial = axial;
    g->pdelta = pdelta;
    g->theta = theta;
    if (g->n_part == 0) {
        g->buckling = pdelta_buckling_of_chain(g, &storey);
    } else if (!pdelta_buckling_with_parts(g, &g->buckling)) {
        return error_no_memory(e);
    }
    if (pdelta_buckles(b, d, g, storey)) {
        return STATUS_OK;
    }
    pdelta_coefficients(g, omega[0], shape, theta);
    g->spring = spring;
    return modes_solve(g->n_dof, g->mass, spring, g->part_stiffness, omega, shape, e);
}

void pdelta_check_founded(struct builder *b, const struct building_draft *d,
                          const struct building *g) {
    if (g->axial && g->omega[0] == 0.0) {
        deck_error(b->deck, &d->pdelta,
                   "building %s buckles on its foundation under its gravity loads", g->name);
    }
}
