// SPDX-License-Identifier: GPL-3.0-or-later
// In a row of buildings links k, k + 1, ... join floors i, i + 1, ... of one building to floors j,
// j + 1, ... of the next, so that their penetrations are differences of stretches of one array.
#include "solve/gaps.h"

#include <math.h>

#include "core/arena.h"
#include "core/lanes.h"

// Where the end of a link stands among the displacements; a wall is the zero behind them.
static int end_of(const struct model *m, int k, int side) {
    int dof = m->link[k].dof[side];
    return dof == WALL ? m->n_dof : dof;
}

// Does link k carry on the run?
static bool continues(const struct model *m, const struct gap_run *r, int k) {
    const struct link *l = &m->link[k];
    return l->dof[0] == r->left + r->n && l->dof[1] == r->right + r->n &&
           l->building[0] == r->building[0] && l->building[1] == r->building[1];
}

static double open_limit(const struct link *l) {
    return l->law->rebound ? INFINITY : 0.0;
}

static void find_runs(struct gaps *g) {
    const struct model *m = g->model;
    for (int k = 0; k < m->n_link; k++) {
        const struct link *l = &m->link[k];
        g->gap[k] = l->gap;
        g->limit[k] = open_limit(l);
        if (g->n_run > 0 && continues(m, &g->run[g->n_run - 1], k)) {
            g->run[g->n_run - 1].n++;
            continue;
        }
        g->run[g->n_run++] = (struct gap_run){
            k, 1, end_of(m, k, 0), end_of(m, k, 1), {l->building[0], l->building[1]}};
    }
}

// The building at one side of a run; a run within one building is at its left side only.
static int building_at(const struct gap_run *r, int side) {
    return side == 1 && r->building[0] == r->building[1] ? WALL : r->building[side];
}

// Lists the runs at each building, by counting.
static void sort_runs(struct gaps *g) {
    for (int i = 0; i < 2 * g->n_run; i++) {
        int k = building_at(&g->run[i / 2], i % 2);
        if (k != WALL) {
            g->start[k]++;
        }
    }
    for (int k = 1; k <= g->model->n_building; k++) {
        g->start[k] += g->start[k - 1];
    }
    for (int i = 2 * g->n_run - 1; i >= 0; i--) {
        int k = building_at(&g->run[i / 2], i % 2);
        if (k != WALL) {
            g->of_building[--g->start[k]] = i / 2;
        }
    }
}

bool gaps_alloc(struct gaps *g, const struct model *m, struct arena *a) {
    size_t n_link = (size_t)m->n_link;
    size_t n_building = (size_t)m->n_building;
    *g = (struct gaps){
        .model = m,
        .gap = arena_alloc(a, n_link + LANES_WIDTH, sizeof *g->gap),
        .limit = arena_alloc(a, n_link, sizeof *g->limit),
        .acting = arena_alloc(a, n_link, sizeof *g->acting),
        .run = arena_alloc(a, n_link, sizeof *g->run),
        .start = arena_alloc(a, n_building + 1, sizeof *g->start),
        .of_building = arena_alloc(a, 2 * n_link, sizeof *g->of_building),
        .visited = arena_alloc(a, n_link, sizeof *g->visited),
        .pressed = arena_alloc(a, n_link, sizeof *g->pressed),
        .touched = arena_alloc(a, n_building, sizeof *g->touched),
        .is_touched = arena_alloc(a, n_building, sizeof *g->is_touched),
    };
    if (!g->gap || !g->limit || !g->acting || !g->run || !g->start || !g->of_building ||
        !g->visited || !g->pressed || !g->touched || !g->is_touched) {
        return false;
    }
    find_runs(g);
    sort_runs(g);
    return true;
}

// The penetrations of the runs visited, on grounds that move together.
LANES static int update(const struct gaps *g, const double *restrict u, double *restrict all,
                        int *restrict pressed) {
    int n_pressed = 0;
    for (int i = 0; i < g->n_visited; i++) {
        const struct gap_run *r = &g->run[g->visited[i]];
        const double *restrict left = u + r->left;
        const double *restrict right = u + r->right;
        const double *restrict gap = g->gap + r->first;
        const double *restrict limit = g->limit + r->first;
        double *restrict delta = all + r->first;
        long any = 0;
        for (int j = 0, n = r->n; j < n; j++) {
            double d = left[j] - right[j] - gap[j];
            delta[j] = d;
            any |= d > limit[j];
        }
        pressed[n_pressed] = g->visited[i];
        n_pressed += any != 0;
    }
    return n_pressed;
}

// Adds the grounds' shares; whatever was visited may be pressed then.
static void add_grounds(struct gaps *g, struct state *s) {
    const struct model *m = g->model;
    for (int i = 0; i < g->n_visited; i++) {
        const struct gap_run *r = &g->run[g->visited[i]];
        for (int k = r->first; k < r->first + r->n; k++) {
            s->delta[k] += state_ground_gap(&m->link[k], m, s->ground_u);
        }
        g->pressed[i] = g->visited[i];
    }
    g->n_pressed = g->n_visited;
}

static void visit(struct gaps *g, struct state *s) {
    g->n_pressed = update(g, s->u, s->delta, g->pressed);
    if (g->model->n_ground > 1) {
        add_grounds(g, s);
    }
}

void gaps_update(struct gaps *g, struct state *s) {
    for (int i = 0; i < g->n_run; i++) {
        g->visited[i] = i;
    }
    g->n_visited = g->n_run;
    visit(g, s);
}

// A run between two touched buildings is visited from the first of them.
static bool seen_from(const struct gaps *g, const struct gap_run *r, int building) {
    int other = r->building[0] == building ? r->building[1] : r->building[0];
    return other != WALL && other < building && g->is_touched[other];
}

void gaps_update_touched(struct gaps *g, struct state *s) {
    g->n_visited = 0;
    for (int i = 0; i < g->n_touched; i++) {
        int k = g->touched[i];
        for (int j = g->start[k]; j < g->start[k + 1]; j++) {
            if (!seen_from(g, &g->run[g->of_building[j]], k)) {
                g->visited[g->n_visited++] = g->of_building[j];
            }
        }
    }
    visit(g, s);
}

void gaps_forget(struct gaps *g) {
    for (int i = 0; i < g->n_acting; i++) {
        g->limit[g->acting[i]] = open_limit(&g->model->link[g->acting[i]]);
    }
    for (int i = 0; i < g->n_touched; i++) {
        g->is_touched[g->touched[i]] = false;
    }
    g->n_acting = g->n_touched = 0;
}
