// SPDX-License-Identifier: GPL-3.0-or-later
// Buildings are joined by their live links (union-find: Tarjan (1975), J. ACM 22, 215-225); one of
// them leads all that are joined.
//
// Let f* be the exact force of each link with the others held (exact.c), and t the slope
// beta h^2 dF/dd + gamma h dF/dv of its law there. Then f* changes with the forces of the others as
// df* = -t (S df)_others / (1 + S_ll t), and Newton's method for f* = f asks for
//     df_l + share_l sum over m != l of (S_lm / S_ll) df_m = f*_l - f_l,
//     share_l = S_ll t / (1 + S_ll t).
// It works on stiff links, whose own force at the trial penetration means nothing, because it
// linearises at these instead of at F(d, v): all shares are between 0 and 1, but for laws
// whose force falls with d. A link held within a jump of its law, at d = 0 or v = 0, has the share
// 1; it is kept just below, or two such links between the same floors would make the matrix
// singular.
//
// At a kink or a jump of a law a step may go astray, and only the next one puts it right. So some
// steps are taken whole, each followed by a sweep, which measures how far off it was. If they do
// not get nearer, one step is taken as far as it leads downhill: for laws that do not pull, sweeps
// are coordinate descent on the convex function
//     f' S f / 2 - f' x_free + sum over l of the integral of X_l,
// X_l(f) being where the law of link l gives f; exact_excess gives its derivative.
#include "solve/contact/contact.h"

#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "core/lanes.h"
#include "core/root.h"

// Links of a cluster.
enum { CLUSTER_MAX = 400 };

enum { WHOLE_STEPS = 12, PARTS = 20 };
static const double HELD = 1.0 - 1e-10;

bool cluster_alloc(struct clusters *c, const struct model *m, struct arena *a) {
    const size_t n = (size_t)m->n_body, n_link = (size_t)m->n_link;
    const size_t most = n_link < CLUSTER_MAX ? n_link : CLUSTER_MAX;
    *c = (struct clusters){
        .leader = arena_alloc(a, n, sizeof *c->leader),
        .first = arena_alloc(a, n, sizeof *c->first),
        .after = arena_alloc(a, n_link, sizeof *c->after),
        .position = arena_alloc(a, n, sizeof *c->position),
        .nearest = arena_alloc(a, n, sizeof *c->nearest),
        .most = (int)most,
        .link = arena_alloc(a, most, sizeof *c->link),
        .matrix = arena_alloc(a, most * most, sizeof *c->matrix),
        .change = arena_alloc(a, most, sizeof *c->change),
        .kept_q = lanes_array(a, m->n_dof),
    };
    return !arena_failed(a);
}

static int cluster_leader(int *leader, int i) {
    while (leader[i] != i) {
        leader[i] = leader[leader[i]];
        i = leader[i];
    }
    return i;
}

void cluster_find(struct clusters *c, const struct model *m, const struct state *s) {
    for (int i = 0; i < m->n_body; i++) {
        c->leader[i] = i;
        c->first[i] = c->position[i] = -1;
        c->nearest[i] = INFINITY;
    }
    for (int i = 0; i < s->n_live; i++) {
        const int *building = m->link[s->live[i]].building;
        if (building[0] != WALL && building[1] != WALL) {
            c->leader[cluster_leader(c->leader, building[0])] =
                cluster_leader(c->leader, building[1]);
        }
    }
    for (int i = s->n_live - 1; i >= 0; i--) {
        const int k = s->live[i], *building = m->link[k].building;
        const int to = cluster_leader(c->leader, building[building[0] == WALL ? 1 : 0]);
        c->after[k] = c->first[to];
        c->first[to] = k;
    }
}

// Gaussian elimination with partial pivoting (Golub & Van Loan, Matrix Computations, section
// 4.3.3): exchanges of rows let the band above the diagonal become twice as wide.
LANES bool cluster_eliminate(double *a, double *b, ptrdiff_t n, ptrdiff_t width) {
    bool finite = true;
    for (ptrdiff_t k = 0; k < n; k++) {
        const ptrdiff_t below = k + width < n ? k + width + 1 : n;
        const ptrdiff_t right = k + 2 * width < n ? k + 2 * width + 1 : n;
        double *restrict pivot = a + k * n;
        ptrdiff_t largest = k;
        for (ptrdiff_t i = k + 1; i < below; i++) {
            largest = fabs(a[i * n + k]) > fabs(a[largest * n + k]) ? i : largest;
        }
        for (ptrdiff_t j = k; j < right && largest != k; j++) {
            const double kept = pivot[j];
            pivot[j] = a[largest * n + j];
            a[largest * n + j] = kept;
        }
        const double kept = b[k];
        b[k] = b[largest];
        b[largest] = kept;
        if (pivot[k] == 0.0) {
            return false;
        }
        for (ptrdiff_t i = k + 1; i < below; i++) {
            double *restrict row = a + i * n;
            const double share = row[k] / pivot[k];
            LANES_LOOP
            for (ptrdiff_t j = k + 1; j < right; j++) {
                row[j] -= share * pivot[j];
            }
            b[i] -= share * b[k];
        }
    }
    for (ptrdiff_t k = n - 1; k >= 0; k--) {
        for (ptrdiff_t j = k + 1; j < n && j <= k + 2 * width; j++) {
            b[k] -= a[k * n + j] * b[j];
        }
        b[k] /= a[k * n + k];
        finite = finite && isfinite(b[k]);
    }
    return finite;
}

// The flexibility S_lk between link l, by its columns of A^-1, and link k.
static double cluster_flexibility(const struct link_scratch *l, const struct link *k) {
    double sum = 0.0;
    for (int i = 0; i < 4; i++) {
        const int side = i / 2, other = i % 2;
        if (l->link->building[side] == WALL || l->link->building[side] != k->building[other]) {
            continue;
        }
        for (int j = 0, n = link_entries(k, other); j < n; j++) {
            const struct link_entry e = link_entry(k, other, j);
            const double term = e.weight * l->column[side][e.dof - l->first[side]];
            sum += side == other ? term : -term;
        }
    }
    return sum;
}

static double cluster_share(const struct equation *e, enum branch branch, double force) {
    if (branch == BRANCH_OPEN) {
        return 0.0;
    }
    if (branch != BRANCH_CLOSED || force == e->v_free / e->v_force) {
        return HELD;
    }
    struct contact_response law = exact_law(e, force);
    double slope = exact_slope(e, &law);
    double share = slope / (1.0 + slope);
    return slope > -0.5 && share < HELD ? share : HELD;
}

// The Newton step into c->change; false: not finite.
static bool cluster_newton(struct work *w, const struct state *now, const struct state *next) {
    const struct clusters *c = &w->clusters;
    double *row = c->matrix;
    for (int i = 0; i < c->n; i++, row += c->n) {
        const struct link_scratch *p = &w->link[c->link[i]];
        struct equation e = exact_equation(w, now, next, p->index);
        double force;
        enum branch branch = exact_force(&e, p->force, &force);
        double share = cluster_share(&e, branch, force) / p->flexibility;
        memset(row, 0, (size_t)c->n * sizeof *row);
        for (int j = i > c->width ? i - c->width : 0; j < c->n && j <= i + c->width; j++) {
            row[j] = j == i ? 1.0 : share * cluster_flexibility(p, &w->model->link[c->link[j]]);
        }
        c->change[i] = force - p->force;
    }
    return cluster_eliminate(c->matrix, c->change, c->n, c->width);
}

static void cluster_apply(struct work *w, double part) {
    const struct clusters *c = &w->clusters;
    for (int i = 0; i < c->n; i++) {
        struct link_scratch *p = &w->link[c->link[i]];
        const double change = part * c->change[i];
        p->force += change;
        sweep_push(w, p, &change);
    }
}

// Steps back to what cluster_step has kept.
static void cluster_restore(struct work *w) {
    const struct clusters *c = &w->clusters;
    memcpy(w->correction, c->kept_q, (size_t)w->model->n_dof * sizeof *c->kept_q);
    for (int i = 0; i < c->n; i++) {
        w->link[c->link[i]].force = w->link[c->link[i]].kept;
    }
}

// A sweep over the cluster; returns how far it moved the links.
static double cluster_sweep(struct work *w, const struct state *now, struct state *next) {
    const struct clusters *c = &w->clusters;
    double moved = 0.0;
    for (int i = 0; i < c->n; i++) {
        moved += fabs(exact_solve(w, now, next, c->link[i])) * w->link[c->link[i]].flexibility;
    }
    w->totals->iterations++;
    return moved;
}

// The part of a Newton step that leads lowest on the function that sweeps minimise: it is convex,
// so its derivative along the step is bisected. No force of a law that does not pull may become
// negative.
static bool cluster_part_step(struct work *w, const struct state *now, struct state *next) {
    const struct clusters *c = &w->clusters;
    if (!cluster_newton(w, now, next)) {
        return false;
    }
    for (int i = 0; i < c->n; i++) {
        const struct link_scratch *p = &w->link[c->link[i]];
        if (p->clamped || !(p->bilateral || (p->law->traits & CONTACT_MAY_PULL))) {
            c->change[i] = fmax(c->change[i], -p->force);
        }
    }
    struct root part = {.high = 2.0};
    for (int i = 0; i < PARTS && part.low != 1.0; i++) {
        double rise = 0.0;
        cluster_apply(w, root_middle(&part));
        for (int j = 0; j < c->n; j++) {
            const struct link_scratch *p = &w->link[c->link[j]];
            struct equation e = exact_equation(w, now, next, p->index);
            rise += c->change[j] * p->flexibility * exact_excess(&e, p->force);
        }
        root_halve(&part, rise <= 0.0);
        cluster_restore(w);
    }
    cluster_apply(w, part.low);
    return part.low > 0.0;
}

// Whole steps, until the sweep after one moves the links by at most half of *nearest, which then
// becomes the way of that sweep; else a part of one.
static bool cluster_step(struct work *w, const struct state *now, struct state *next,
                         double *nearest) {
    const struct clusters *c = &w->clusters;
    *nearest = fmin(*nearest, cluster_sweep(w, now, next));
    memcpy(c->kept_q, w->correction, (size_t)w->model->n_dof * sizeof *c->kept_q);
    for (int i = 0; i < c->n; i++) {
        w->link[c->link[i]].kept = w->link[c->link[i]].force;
    }
    for (int i = 0; i < WHOLE_STEPS && cluster_newton(w, now, next); i++) {
        cluster_apply(w, 1.0);
        double moved = cluster_sweep(w, now, next);
        if (moved <= 0.5 * *nearest) {
            *nearest = moved;
            return true;
        }
    }
    cluster_restore(w);
    return cluster_part_step(w, now, next);
}

// Takes link k into the cluster in hand. In a row of buildings whose links are in order, those of a
// building are near each other.
static void cluster_append(struct clusters *c, const struct model *m, int k) {
    for (int side = 0; side < 2; side++) {
        const int b = m->link[k].building[side];
        if (b != WALL) {
            c->position[b] = c->position[b] < 0 ? c->n : c->position[b];
            c->width = c->n - c->position[b] > c->width ? c->n - c->position[b] : c->width;
        }
    }
    c->link[c->n++] = k;
}

bool cluster_steps(struct work *w, const struct state *now, struct state *next) {
    struct clusters *c = &w->clusters;
    bool any = false;
    for (int i = 0; i < w->model->n_body; i++) {
        int k = c->first[i];
        c->width = 0;
        for (c->n = 0; k >= 0 && c->n < c->most; k = c->after[k]) {
            cluster_append(c, w->model, k);
        }
        any |= k < 0 && c->n > 1 && cluster_step(w, now, next, &c->nearest[i]);
    }
    return any;
}
