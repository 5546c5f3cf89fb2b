// SPDX-License-Identifier: GPL-3.0-or-later
#include "result/tree.h"

#include "result/layout.h"
#include "result/study_sweep.h"

struct tree_group tree_group(const struct tree *t, hid_t root, const struct layout_group *g) {
    hid_t parent = h5_open_object(t->h, root, g->parent ? g->parent : ".");
    struct tree_group new = {h5_group(t->h, parent, g->name), -1, g->scale};
    h5_close(t->h, parent);
    if (g->scale) {
        new.scale = h5_put_scale(t->h, new.group, g->scale, g->scale, g->n);
    }
    if (t->time > 0) {
        h5_hard_link(t->h, t->time, new.group, "time");
    }
    study_sweep_link(t->h, new.group, t->sweep, t->scale, t->n_sweep);
    if (g->kind == LAYOUT_BUILDING) {
        const struct report_building *b = g->base;
        h5_put_long(t->h, new.group, "position", g->building);
        if (b->isolated > 0) {
            h5_put_long(t->h, new.group, layout_isolated_name, b->isolated);
        }
    }
    return new;
}

hid_t tree_envelope(const struct tree *t, const struct tree_group *g) {
    hid_t envelope = h5_group(t->h, g->group, "envelope");
    h5_hard_link(t->h, g->scale, envelope, g->name);
    study_sweep_link(t->h, envelope, t->sweep, t->scale, t->n_sweep);
    return envelope;
}

void tree_close(const struct tree *t, const struct tree_group *g) {
    h5_close(t->h, g->scale);
    h5_close(t->h, g->group);
}
