// SPDX-License-Identifier: GPL-3.0-or-later
// Buildings are joined by their live links (union-find: Tarjan (1975), J. ACM 22, 215-225); one of
// them stands for all that are joined. The links are then sorted by that building, by counting.
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
#include "solve/contact/cluster.h"

#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "core/lanes.h"
#include "core/root.h"
#include "solve/contact/band.h"
#include "solve/contact/exact.h"

// Links of a cluster.
enum { CLUSTER_MAX = 400 };

enum { WHOLE_STEPS = 12, PARTS = 20 };
static const double HELD = 1.0 - 1e-10;

bool cluster_alloc(struct clusters *c, const struct model *m, struct arena *a) {
    size_t n = (size_t)m->n_building;
    c->parent = arena_alloc(a, n, sizeof *c->parent);
    c->end = arena_alloc(a, n, sizeof *c->end);
    c->leader = arena_alloc(a, n, sizeof *c->leader);
    c->nearest = arena_alloc(a, n, sizeof *c->nearest);
    c->link = arena_alloc(a, (size_t)m->n_link, sizeof *c->link);
    c->most = m->n_link < CLUSTER_MAX ? m->n_link : CLUSTER_MAX;
    size_t most = (size_t)c->most;
    c->matrix = arena_alloc(a, most * most, sizeof *c->matrix);
    c->vector = arena_alloc(a, most, sizeof *c->vector);
    c->kept_q = lanes_array(a, m->n_dof);
    return !arena_failed(a);
}

static int cluster_leader(int *parent, int i) {
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

// The building that stands for the cluster of link l.
static int cluster_leader_of(const struct clusters *c, const struct link *l) {
    return cluster_leader(c->parent, l->building[0] == WALL ? l->building[1] : l->building[0]);
}

static void cluster_join(struct clusters *c, const struct model *m, const struct state *s) {
    for (int i = 0; i < m->n_building; i++) {
        c->parent[i] = i;
    }
    for (int i = 0; i < s->n_live; i++) {
        const struct link *l = &m->link[s->live[i]];
        if (l->building[0] != WALL && l->building[1] != WALL) {
            c->parent[cluster_leader(c->parent, l->building[0])] =
                cluster_leader(c->parent, l->building[1]);
        }
    }
}

int cluster_find(struct clusters *c, const struct model *m, const struct state *s) {
    int n = 0;
    cluster_join(c, m, s);
    memset(c->end, 0, (size_t)m->n_building * sizeof *c->end);
    for (int i = 0; i < s->n_live; i++) {
        c->end[cluster_leader_of(c, &m->link[s->live[i]])]++;
    }
    for (int i = 0, sum = 0; i < m->n_building; i++) {
        int count = c->end[i];
        c->end[i] = sum;  // where they start, until they have been put there
        sum += count;
        if (count > 0) {
            c->leader[n++] = i;
        }
    }
    for (int i = 0; i < s->n_live; i++) {
        int k = s->live[i];
        c->link[c->end[cluster_leader_of(c, &m->link[k])]++] = k;
    }
    return n;
}

struct cluster cluster_at(const struct clusters *c, int i) {
    int first = i > 0 ? c->end[c->leader[i - 1]] : 0;
    return (struct cluster){c->end[c->leader[i]] - first, c->link + first};
}

// b A^-1 b' of end `i` of link l and end `j` of link k; 0 if they are on different buildings.
static double cluster_between(struct work *w, const struct link *l, int i, const struct link *k,
                              int j) {
    if (l->building[i] == WALL || l->building[i] != k->building[j]) {
        return 0.0;
    }
    struct effective *a = &w->effective[l->building[i]];
    const int first = a->building->first;
    double sum = 0.0;
    for (int x = 0, n = link_entries(l, i); x < n; x++) {
        const struct link_entry own = link_entry(l, i, x);
        const double *column = effective_column(a, own.dof - first);
        for (int y = 0, other = link_entries(k, j); y < other; y++) {
            const struct link_entry e = link_entry(k, j, y);
            sum += own.weight * e.weight * column[e.dof - first];
        }
    }
    return sum;
}

static double cluster_flexibility(struct work *w, const struct link *l, const struct link *k) {
    return cluster_between(w, l, 0, k, 0) - cluster_between(w, l, 0, k, 1) -
           cluster_between(w, l, 1, k, 0) + cluster_between(w, l, 1, k, 1);
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

static bool cluster_share_a_building(const struct link *l, const struct link *k) {
    bool share = false;
    for (int i = 0; i < 4; i++) {
        int building = l->building[i / 2];
        share |= building != WALL && building == k->building[i % 2];
    }
    return share;
}

// How far from the diagonal the matrix of the cluster has entries: in a row of buildings whose
// contacts are in order, as far as those of a building are from each other.
static int cluster_width(const struct work *w, const struct cluster *c) {
    int width = 0;
    for (int i = 0; i < c->n; i++) {
        const struct link *l = &w->model->link[c->link[i]];
        int j = 0;
        while (j < i - width && !cluster_share_a_building(l, &w->model->link[c->link[j]])) {
            j++;
        }
        width = i - j;
    }
    return width;
}

// The matrix of the cluster, whose band is `width`, and f* - f into `r`.
static void cluster_linearise(struct work *w, const struct state *now, const struct state *next,
                              const struct cluster *c, int width, double *r) {
    memset(w->clusters.matrix, 0, (size_t)c->n * (size_t)c->n * sizeof *w->clusters.matrix);
    for (int i = 0; i < c->n; i++) {
        int k = c->link[i];
        struct equation e = exact_equation(w, now, next, k);
        double force;
        enum branch branch = exact_force(&e, w->link[k].force, &force);
        double share = cluster_share(&e, branch, force) / w->link[k].flexibility;
        double *row = w->clusters.matrix + (size_t)i * (size_t)c->n;
        int end = i + width < c->n ? i + width + 1 : c->n;
        for (int j = i > width ? i - width : 0; j < end; j++) {
            row[j] = i == j ? 1.0
                            : share * cluster_flexibility(w, &w->model->link[k],
                                                          &w->model->link[c->link[j]]);
        }
        r[i] = force - w->link[k].force;
    }
}

// The Newton step into `df`; false: not finite.
static bool cluster_newton(struct work *w, const struct state *now, const struct state *next,
                           const struct cluster *c, double *df) {
    int width = cluster_width(w, c);
    cluster_linearise(w, now, next, c, width, df);
    return band_solve(w->clusters.matrix, df, c->n, width);
}

static void cluster_apply(struct work *w, const struct cluster *c, double part, const double *df) {
    for (int i = 0; i < c->n; i++) {
        struct link_scratch *p = &w->link[c->link[i]];
        const double change = part * df[i];
        p->force += change;
        sweep_push(w, p, &change);
    }
}

// Copies the corrections of the buildings of the cluster.
static void cluster_copy(const struct work *w, const struct cluster *c, double *to,
                         const double *from) {
    for (int i = 0; i < 2 * c->n; i++) {
        int k = w->model->link[c->link[i / 2]].building[i % 2];
        if (k != WALL) {
            const struct building *g = &w->model->building[k];
            memcpy(to + g->first, from + g->first, (size_t)g->n_floor * sizeof *to);
        }
    }
}

static void cluster_keep(struct work *w, const struct cluster *c) {
    cluster_copy(w, c, w->clusters.kept_q, w->correction);
    for (int i = 0; i < c->n; i++) {
        w->link[c->link[i]].kept = w->link[c->link[i]].force;
    }
}

static void cluster_restore(struct work *w, const struct cluster *c) {
    cluster_copy(w, c, w->correction, w->clusters.kept_q);
    for (int i = 0; i < c->n; i++) {
        w->link[c->link[i]].force = w->link[c->link[i]].kept;
    }
}

// A sweep over the cluster; returns how far it moved the links.
static double cluster_sweep(struct work *w, const struct state *now, struct state *next,
                            const struct cluster *c) {
    double moved = 0.0;
    for (int i = 0; i < c->n; i++) {
        moved += fabs(exact_solve(w, now, next, c->link[i])) * w->link[c->link[i]].flexibility;
    }
    w->totals->iterations++;
    return moved;
}

// Whole steps, until the sweep after one moves the links by at most half of *nearest, which then
// becomes the way of that sweep. False: not found.
static bool cluster_whole_steps(struct work *w, const struct state *now, struct state *next,
                                const struct cluster *c, double *nearest) {
    for (int i = 0; i < WHOLE_STEPS; i++) {
        if (!cluster_newton(w, now, next, c, w->clusters.vector)) {
            return false;
        }
        cluster_apply(w, c, 1.0, w->clusters.vector);
        double moved = cluster_sweep(w, now, next, c);
        if (moved <= 0.5 * *nearest) {
            *nearest = moved;
            return true;
        }
    }
    return false;
}

// The derivative along df of the function that sweeps minimise.
static double cluster_descent(struct work *w, const struct state *now, struct state *next,
                              const struct cluster *c, const double *df) {
    double sum = 0.0;
    for (int i = 0; i < c->n; i++) {
        int k = c->link[i];
        struct equation e = exact_equation(w, now, next, k);
        sum += df[i] * w->link[k].flexibility * exact_excess(&e, w->link[k].force);
    }
    return sum;
}

// No force of a law that does not pull may become negative.
static void cluster_limit(const struct work *w, const struct cluster *c, double *df) {
    for (int i = 0; i < c->n; i++) {
        int k = c->link[i];
        const struct link *l = &w->model->link[k];
        if (w->link[k].clamped || !(l->bilateral || (l->law->traits & CONTACT_MAY_PULL))) {
            df[i] = fmax(df[i], -w->link[k].force);
        }
    }
}

// The part of a Newton step that leads lowest on the function that sweeps minimise: it is convex,
// so its derivative is bisected.
static bool cluster_part_step(struct work *w, const struct state *now, struct state *next,
                              const struct cluster *c) {
    double *df = w->clusters.vector;
    if (!cluster_newton(w, now, next, c, df)) {
        return false;
    }
    cluster_limit(w, c, df);
    struct root part = {.high = 2.0};
    for (int i = 0; i < PARTS && part.low != 1.0; i++) {
        cluster_apply(w, c, root_middle(&part), df);
        root_halve(&part, cluster_descent(w, now, next, c, df) <= 0.0);
        cluster_restore(w, c);
    }
    cluster_apply(w, c, part.low, df);
    return part.low > 0.0;
}

bool cluster_step(struct work *w, const struct state *now, struct state *next,
                  const struct cluster *c, double *nearest) {
    if (c->n > w->clusters.most) {
        return false;
    }
    *nearest = fmin(*nearest, cluster_sweep(w, now, next, c));
    cluster_keep(w, c);
    if (cluster_whole_steps(w, now, next, c, nearest)) {
        return true;
    }
    cluster_restore(w, c);
    return cluster_part_step(w, now, next, c);
}
