// SPDX-License-Identifier: GPL-3.0-or-later
#include "result/tree.h"

#include "result/layout.h"
#include "result/study_sweep.h"

struct tree_group tree_group(const struct tree *t, hid_t parent, const char *name,
                             const char *scale, size_t n) {
    struct tree_group g = {.group = h5_group(t->h, parent, name), .scale = -1, .name = scale};
    if (scale) {
        g.scale = h5_put_scale(t->h, g.group, scale, scale, n);
    }
    if (t->time > 0) {
        h5_hard_link(t->h, t->time, g.group, "time");
    }
    study_sweep_link(t->h, g.group, t->sweep, t->scale, t->n_sweep);
    return g;
}

struct tree_group tree_building(const struct tree *t, hid_t parent, const struct report_building *b,
                                int position) {
    const struct tree_group g = tree_group(t, parent, b->name, "floor", (size_t)b->n_floor);
    h5_put_long(t->h, g.group, "position", position);
    if (b->isolated > 0) {
        h5_put_long(t->h, g.group, layout_isolated_name, b->isolated);
    }
    return g;
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
