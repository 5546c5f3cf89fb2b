// SPDX-License-Identifier: GPL-3.0-or-later
// Buildings are joined by their live links (union-find: Tarjan (1975), J. ACM 22, 215-225); one of
// them stands for all that are joined. The links are then sorted by that building, by counting.
#include "solve/contact/cluster.h"

#include <string.h>

#include "core/arena.h"

bool cluster_alloc(struct clusters *c, const struct model *m, struct arena *a) {
    size_t n = (size_t)m->n_building;
    c->parent = arena_alloc(a, n, sizeof *c->parent);
    c->end = arena_alloc(a, n, sizeof *c->end);
    c->leader = arena_alloc(a, n, sizeof *c->leader);
    c->nearest = arena_alloc(a, n, sizeof *c->nearest);
    c->link = arena_alloc(a, (size_t)m->n_link, sizeof *c->link);
    return !arena_failed(a);
}

static int leader(int *parent, int i) {
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

// The building that stands for the cluster of link l.
static int leader_of(const struct clusters *c, const struct link *l) {
    return leader(c->parent, l->building[0] == WALL ? l->building[1] : l->building[0]);
}

static void join(struct clusters *c, const struct model *m, const struct state *s) {
    for (int i = 0; i < m->n_building; i++) {
        c->parent[i] = i;
    }
    for (int i = 0; i < s->n_live; i++) {
        const struct link *l = &m->link[s->live[i]];
        if (l->building[0] != WALL && l->building[1] != WALL) {
            c->parent[leader(c->parent, l->building[0])] = leader(c->parent, l->building[1]);
        }
    }
}

int cluster_find(struct clusters *c, const struct model *m, const struct state *s) {
    int n = 0;
    join(c, m, s);
    memset(c->end, 0, (size_t)m->n_building * sizeof *c->end);
    for (int i = 0; i < s->n_live; i++) {
        c->end[leader_of(c, &m->link[s->live[i]])]++;
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
        c->link[c->end[leader_of(c, &m->link[k])]++] = k;
    }
    return n;
}

struct cluster cluster_at(const struct clusters *c, int i) {
    int first = i > 0 ? c->end[c->leader[i - 1]] : 0;
    return (struct cluster){c->end[c->leader[i]] - first, c->link + first};
}
