// SPDX-License-Identifier: GPL-3.0-or-later
#include <string.h>

#include "model/finish.h"

static bool acts_under(const struct ground_draft *g, int building) {
    for (int i = 0; i < g->n_building; i++) {
        if (g->building[i] == building) {
            return true;
        }
    }
    return g->n_building == 0;
}

// The drafts under `building`, as a set of marks (n drafts); returns how many.
static int mark_drafts(const struct builder *b, int building, bool *mark) {
    const struct ground_draft *draft = b->grounds.item;
    int n = 0;
    for (int k = 0; k < b->grounds.n; k++) {
        mark[k] = acts_under(&draft[k], building);
        n += mark[k];
    }
    return n;
}

static void add_ground(struct builder *b, struct ground *g, const bool *mark, int n) {
    const struct ground_draft *draft = b->grounds.item;
    struct signal *signal = builder_array(b, (size_t)n, sizeof *signal);
    if (!signal) {
        return;
    }
    *g = (struct ground){.n_signal = n, .signal = signal};
    for (int k = 0, j = 0; k < b->grounds.n; k++) {
        if (mark[k]) {
            signal[j++] = draft[k].signal;
        }
    }
}

void finish_grounds(struct builder *b, struct model *m, struct building *building) {
    size_t n_draft = (size_t)b->grounds.n;
    bool *set = builder_array(b, (size_t)m->n_building * n_draft, sizeof *set);
    struct ground *ground = builder_array(b, (size_t)m->n_building, sizeof *ground);
    if (!set || !ground) {
        return;
    }
    for (int i = 0; i < m->n_building; i++) {
        bool *mark = set + (size_t)m->n_ground * n_draft;
        int n = mark_drafts(b, i, mark);
        int same = 0;
        while (same < m->n_ground && memcmp(set + (size_t)same * n_draft, mark, n_draft) != 0) {
            same++;
        }
        building[i].ground = same;
        if (same == m->n_ground) {
            add_ground(b, &ground[m->n_ground++], mark, n);
        }
    }
    m->ground = ground;
}
