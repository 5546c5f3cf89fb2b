// SPDX-License-Identifier: GPL-3.0-or-later
// Buildings are joined by their live links (union-find: Tarjan (1975), J. ACM 22, 215-225), and
// links put in order of the building that stands for all that are joined with theirs, by counting.
#include "solve/cluster.h"

static int leader(int *parent, int i) {
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

static int building_of(const struct work *w, int k) {
    const struct link *l = &w->model->link[k];
    return l->building[0] == WALL ? l->building[1] : l->building[0];
}

static void join(struct work *w, const struct state *next) {
    for (int i = 0; i < w->model->n_building; i++) {
        w->parent[i] = i;
        w->start[i] = 0;
    }
    for (int i = 0; i < next->n_live; i++) {
        const struct link *l = &w->model->link[next->live[i]];
        if (l->building[0] != WALL && l->building[1] != WALL) {
            w->parent[leader(w->parent, l->building[0])] = leader(w->parent, l->building[1]);
        }
    }
}

int cluster_find(struct work *w, const struct state *next) {
    int n = 0;
    join(w, next);
    for (int i = 0; i < next->n_live; i++) {
        w->start[leader(w->parent, building_of(w, next->live[i]))]++;
    }
    for (int i = 0, sum = 0; i < w->model->n_building; i++) {
        int count = w->start[i];
        w->start[i] = sum;
        sum += count;
        if (count > 0) {
            w->cluster[n++] = i;
        }
    }
    for (int i = 0; i < next->n_live; i++) {
        int k = next->live[i];
        w->grouped[w->start[leader(w->parent, building_of(w, k))]++] = k;
    }
    return n;
}

struct cluster cluster_at(const struct work *w, int i) {
    int first = i > 0 ? w->start[w->cluster[i - 1]] : 0;
    return (struct cluster){w->start[w->cluster[i]] - first, w->grouped + first};
}
