// SPDX-License-Identifier: GPL-3.0-or-later
// Let f* be the exact answer of each link with the others held (line.c), and t the slope
// beta h^2 dF/dd + gamma h dF/dv of its law there. Then f* changes with the forces of the others as
// df* = -t (S df)_others / (1 + S_ll t), and Newton's method for f* = f asks for
//     (I + T S) df = r,   r = (1 + S_ll t)(f* - f).
// Linearising at the answers instead of at F(d, v) is what makes it work on stiff links, whose own
// force at the trial penetration means nothing.
//
// S is symmetric and positive semi-definite, so with D = T^(1/2) the step is
//     df = r - D (I + D S D)^-1 D S r,
// whose matrix has no eigenvalue below 1: Cholesky cannot break down. A link held within a jump
// behaves like a very stiff spring, S_ll t = JUMP.
#include "solve/block.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

#include "solve/contact.h"

static const double JUMP = 1e7;

// Entry of A^-1 between end `i` of link l and end `j` of link k; 0 if they are on different
// buildings.
static double between(struct work *w, const struct link *l, int i, const struct link *k, int j) {
    if (l->building[i] == WALL || l->building[i] != k->building[j]) {
        return 0.0;
    }
    return effective_column(&w->effective[l->building[i]], l->floor[i] - 1)[k->floor[j] - 1];
}

static double flexibility(struct work *w, const struct link *l, const struct link *k) {
    return between(w, l, 0, k, 0) - between(w, l, 0, k, 1) - between(w, l, 1, k, 0) +
           between(w, l, 1, k, 1);
}

static void fill_flexibility(struct work *w, const struct state *next) {
    int n = next->n_live;
    for (int i = 0; i < n; i++) {
        const struct link *l = &w->model->link[next->live[i]];
        for (int j = i; j < n; j++) {
            double s = flexibility(w, l, &w->model->link[next->live[j]]);
            w->matrix[(size_t)i * (size_t)n + (size_t)j] = s;
            w->matrix[(size_t)j * (size_t)n + (size_t)i] = s;
        }
    }
}

// S_ll t of the law at its answer.
static double slope_at(const struct line *line, enum branch branch, double force) {
    if (branch == BRANCH_OPEN) {
        return 0.0;
    }
    if (branch != BRANCH_CLOSED) {
        return JUMP;
    }
    struct contact_response law = line_law(line, force);
    double slope = line->d_force * law.dfdd + line->v_force * law.dfdv;
    return isfinite(slope) ? fmax(slope, 0.0) : JUMP;
}

// Residual into `r` and the root of t into `weight`.
static void linearise(struct work *w, const struct state *now, const struct state *next,
                      double *r) {
    for (int i = 0; i < next->n_live; i++) {
        int k = next->live[i];
        struct line line = contact_line(w, now, next, k);
        double force;
        enum branch branch = line_answer(&line, next->force[k], &force);
        double slope = slope_at(&line, branch, force);
        r[i] = (1.0 + slope) * (force - next->force[k]);
        w->weight[i] = sqrt(slope * w->g / line.v_force);
    }
}

// y = S x for the symmetric matrix in `matrix`.
static void multiply(const struct work *w, int n, const double *x, double *y) {
    for (int i = 0; i < n; i++) {
        double sum = 0.0;
        for (int j = 0; j < n; j++) {
            sum += w->matrix[(size_t)i * (size_t)n + (size_t)j] * x[j];
        }
        y[i] = sum;
    }
}

// The Newton step into `df`; false: not finite.
static bool newton_step(struct work *w, const struct state *now, const struct state *next,
                        double *df) {
    size_t n = (size_t)next->n_live;
    double *y = df + n;
    fill_flexibility(w, next);
    linearise(w, now, next, df);
    multiply(w, next->n_live, df, y);
    for (size_t i = 0; i < n; i++) {
        y[i] *= w->weight[i];
        for (size_t j = 0; j < n; j++) {
            w->matrix[i * n + j] *= w->weight[i] * w->weight[j];
        }
        w->matrix[i * n + i] += 1.0;
    }
    gsl_matrix_view a = gsl_matrix_view_array(w->matrix, n, n);
    gsl_vector_view x = gsl_vector_view_array(y, n);
    if (gsl_linalg_cholesky_decomp1(&a.matrix) != 0 ||
        gsl_linalg_cholesky_svx(&a.matrix, &x.vector) != 0) {
        return false;
    }
    bool finite = true;
    for (size_t i = 0; i < n; i++) {
        df[i] -= w->weight[i] * y[i];
        finite &= isfinite(df[i]) != 0;
    }
    return finite;
}

// How far the forces move the links from where their exact single answers would.
static double distance(struct work *w, const struct state *now, const struct state *next) {
    double sum = 0.0;
    for (int i = 0; i < next->n_live; i++) {
        int k = next->live[i];
        struct line line = contact_line(w, now, next, k);
        double force;
        line_answer(&line, next->force[k], &force);
        sum += line.v_force * fabs(force - next->force[k]);
    }
    return sum;
}

static void restore(const struct work *w, struct state *next) {
    memcpy(w->correction, w->kept_q, (size_t)w->model->n_dof * sizeof *w->correction);
    for (int i = 0; i < next->n_live; i++) {
        next->force[next->live[i]] = w->kept_f[next->live[i]];
    }
}

bool block_step(struct work *w, const struct state *now, struct state *next) {
    if (next->n_live > w->block_max) {
        return false;
    }
    double *df = w->vector;
    double before = distance(w, now, next);
    if (!newton_step(w, now, next, df)) {
        return false;
    }
    memcpy(w->kept_q, w->correction, (size_t)w->model->n_dof * sizeof *w->correction);
    memcpy(w->kept_f, next->force, (size_t)w->model->n_link * sizeof *next->force);
    for (double part = 1.0; part > 0.1; part *= 0.5) {
        for (int i = 0; i < next->n_live; i++) {
            contact_apply(w, next, next->live[i], part * df[i]);
        }
        if (distance(w, now, next) <= 0.5 * before) {
            return true;
        }
        restore(w, next);
    }
    return false;
}
