// SPDX-License-Identifier: GPL-3.0-or-later
// Let f* be the exact answer of each link with the others held (line.c), and t the slope
// beta h^2 dF/dd + gamma h dF/dv of its law there. Then f* changes with the forces of the others as
// df* = -t (S df)_others / (1 + S_ll t), and Newton's method for f* = f asks for
//     df_l + share_l sum over m != l of (S_lm / S_ll) df_m = f*_l - f_l,
//     share_l = S_ll t / (1 + S_ll t).
// It works on stiff links, whose own force at the trial penetration means nothing, because it
// linearises at the answers instead of at F(d, v): all shares are between 0 and 1, but for laws
// whose force falls with d. A link held within a jump of its law, at d = 0 or v = 0, has the share
// 1; it is kept just below, or two such links between the same floors would make the matrix
// singular.
//
// At a kink or a jump of a law a step may go astray, and only the next one puts it right. So some
// steps are taken whole, each followed by a sweep, which measures how far off it was. If they do
// not get nearer, one step is taken as far as it leads downhill: for laws that do not pull, sweeps
// are coordinate descent on the convex function
//     f' S f / 2 - f' x_free + sum over l of the integral of X_l,
// X_l(f) being where the law of link l gives f; line_excess gives its derivative.
#include "solve/contact/block.h"

#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "core/lanes.h"
#include "core/root.h"
#include "solve/contact/answer.h"
#include "solve/contact/band.h"

// Links of a cluster.
enum { BLOCK_MAX = 400 };

enum { WHOLE_STEPS = 12, PARTS = 20 };
static const double HELD = 1.0 - 1e-10;

bool block_alloc(struct block *b, const struct model *m, struct arena *a) {
    b->most = m->n_link < BLOCK_MAX ? m->n_link : BLOCK_MAX;
    size_t n = (size_t)b->most;
    b->matrix = arena_alloc(a, n * n, sizeof *b->matrix);
    b->vector = arena_alloc(a, n, sizeof *b->vector);
    b->kept_q = lanes_array(a, m->n_dof);
    return !arena_failed(a);
}

// b A^-1 b' of end `i` of link l and end `j` of link k; 0 if they are on different buildings.
static double between(struct work *w, const struct link *l, int i, const struct link *k, int j) {
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

static double flexibility(struct work *w, const struct link *l, const struct link *k) {
    return between(w, l, 0, k, 0) - between(w, l, 0, k, 1) - between(w, l, 1, k, 0) +
           between(w, l, 1, k, 1);
}

static double share_at(const struct line *line, enum branch branch, double force) {
    if (branch == BRANCH_OPEN) {
        return 0.0;
    }
    if (branch != BRANCH_CLOSED || force == line->v_free / line->v_force) {
        return HELD;
    }
    struct contact_response law = line_law(line, force);
    double slope = line->d_force * law.dfdd + line->v_force * law.dfdv;
    double share = slope / (1.0 + slope);
    return slope > -0.5 && share < HELD ? share : HELD;
}

static bool share_a_building(const struct link *l, const struct link *k) {
    bool share = false;
    for (int i = 0; i < 4; i++) {
        int building = l->building[i / 2];
        share |= building != WALL && building == k->building[i % 2];
    }
    return share;
}

// How far from the diagonal the matrix of the cluster has entries: in a row of buildings whose
// contacts are in order, as far as those of a building are from each other.
static int width_of(const struct work *w, const struct cluster *c) {
    int width = 0;
    for (int i = 0; i < c->n; i++) {
        const struct link *l = &w->model->link[c->link[i]];
        int j = 0;
        while (j < i - width && !share_a_building(l, &w->model->link[c->link[j]])) {
            j++;
        }
        width = i - j;
    }
    return width;
}

// The matrix of the cluster, whose band is `width`, and f* - f into `r`.
static void linearise(struct work *w, const struct state *now, const struct state *next,
                      const struct cluster *c, int width, double *r) {
    memset(w->block.matrix, 0, (size_t)c->n * (size_t)c->n * sizeof *w->block.matrix);
    for (int i = 0; i < c->n; i++) {
        int k = c->link[i];
        struct line line = answer_line(w, now, next, k);
        double force;
        enum branch branch = line_answer(&line, w->link[k].force, &force);
        double share = share_at(&line, branch, force) / w->link[k].flexibility;
        double *row = w->block.matrix + (size_t)i * (size_t)c->n;
        int end = i + width < c->n ? i + width + 1 : c->n;
        for (int j = i > width ? i - width : 0; j < end; j++) {
            row[j] = i == j
                         ? 1.0
                         : share * flexibility(w, &w->model->link[k], &w->model->link[c->link[j]]);
        }
        r[i] = force - w->link[k].force;
    }
}

// The Newton step into `df`; false: not finite.
static bool newton_step(struct work *w, const struct state *now, const struct state *next,
                        const struct cluster *c, double *df) {
    int width = width_of(w, c);
    linearise(w, now, next, c, width, df);
    return band_solve(w->block.matrix, df, c->n, width);
}

static void apply(struct work *w, const struct cluster *c, double part, const double *df) {
    for (int i = 0; i < c->n; i++) {
        struct link_scratch *p = &w->link[c->link[i]];
        const double change = part * df[i];
        p->force += change;
        sweep_push(w, p, &change);
    }
}

// Copies the corrections of the buildings of the cluster.
static void copy_buildings(const struct work *w, const struct cluster *c, double *to,
                           const double *from) {
    for (int i = 0; i < 2 * c->n; i++) {
        int k = w->model->link[c->link[i / 2]].building[i % 2];
        if (k != WALL) {
            const struct building *g = &w->model->building[k];
            memcpy(to + g->first, from + g->first, (size_t)g->n_floor * sizeof *to);
        }
    }
}

static void keep(struct work *w, const struct cluster *c) {
    copy_buildings(w, c, w->block.kept_q, w->correction);
    for (int i = 0; i < c->n; i++) {
        w->link[c->link[i]].kept = w->link[c->link[i]].force;
    }
}

static void restore(struct work *w, const struct cluster *c) {
    copy_buildings(w, c, w->correction, w->block.kept_q);
    for (int i = 0; i < c->n; i++) {
        w->link[c->link[i]].force = w->link[c->link[i]].kept;
    }
}

// A sweep over the cluster; returns how far it moved the links.
static double sweep(struct work *w, const struct state *now, struct state *next,
                    const struct cluster *c) {
    double moved = 0.0;
    for (int i = 0; i < c->n; i++) {
        moved += fabs(answer_link(w, now, next, c->link[i])) * w->link[c->link[i]].flexibility;
    }
    w->totals->iterations++;
    return moved;
}

// Whole steps, until the sweep after one moves the links by at most half of *nearest, which then
// becomes the way of that sweep. False: not found.
static bool whole_steps(struct work *w, const struct state *now, struct state *next,
                        const struct cluster *c, double *nearest) {
    for (int i = 0; i < WHOLE_STEPS; i++) {
        if (!newton_step(w, now, next, c, w->block.vector)) {
            return false;
        }
        apply(w, c, 1.0, w->block.vector);
        double moved = sweep(w, now, next, c);
        if (moved <= 0.5 * *nearest) {
            *nearest = moved;
            return true;
        }
    }
    return false;
}

// The derivative along df of the function that sweeps minimise.
static double descent(struct work *w, const struct state *now, struct state *next,
                      const struct cluster *c, const double *df) {
    double sum = 0.0;
    for (int i = 0; i < c->n; i++) {
        int k = c->link[i];
        struct line line = answer_line(w, now, next, k);
        sum += df[i] * w->link[k].flexibility * line_excess(&line, w->link[k].force);
    }
    return sum;
}

// No force of a law that does not pull may become negative.
static void limit(const struct work *w, const struct cluster *c, double *df) {
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
static bool part_step(struct work *w, const struct state *now, struct state *next,
                      const struct cluster *c) {
    double *df = w->block.vector;
    if (!newton_step(w, now, next, c, df)) {
        return false;
    }
    limit(w, c, df);
    struct root part = {.high = 2.0};
    for (int i = 0; i < PARTS && part.low != 1.0; i++) {
        apply(w, c, root_middle(&part), df);
        root_halve(&part, descent(w, now, next, c, df) <= 0.0);
        restore(w, c);
    }
    apply(w, c, part.low, df);
    return part.low > 0.0;
}

bool block_step(struct work *w, const struct state *now, struct state *next,
                const struct cluster *c, double *nearest) {
    if (c->n > w->block.most) {
        return false;
    }
    *nearest = fmin(*nearest, sweep(w, now, next, c));
    keep(w, c);
    if (whole_steps(w, now, next, c, nearest)) {
        return true;
    }
    restore(w, c);
    return part_step(w, now, next, c);
}
