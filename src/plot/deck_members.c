// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/frame.h"
#include "plot/deck_links.h"

static int count_walls(const struct building *g) {
    int n = 0;
    for (int p = 0; p < g->n_part; p++) {
        n += g->part[p].kind == &frame_wall;
    }
    return n;
}

void deck_members_write(const struct deck_view *v, int k, struct deck_shapes *s,
                        deck_drawing *draw) {
    const struct building *of = &v->m->building[k], *g = of->fixed ? of->fixed : of;
    for (int p = 0; p < g->n_part; p++) {
        const struct plane_frame *f = frame_of(&g->part[p]);
        const bool wall = g->part[p].kind == &frame_wall;
        for (int i = 0; f && i < f->n_member; i++) {
            const struct frame_member *m = &f->member[i];
            const struct elevation_ends at = elevation_member(
                &v->at, k, m->kind, m->level, m->number, wall ? count_walls(g) : f->n_line);
            draw(&(struct deck_member){f, m, wall, at}, s);
        }
    }
}

void deck_members_wall(const struct deck_member *d, struct deck_shapes *s) {
    if (d->wall) {
        deck_put_line(s, d->at.x[0], d->at.y[0], d->at.x[1], d->at.y[1]);
    }
}

void deck_members_frame(const struct deck_member *d, struct deck_shapes *s) {
    if (!d->wall) {
        deck_put_line(s, d->at.x[0], d->at.y[0], d->at.x[1], d->at.y[1]);
    }
}

enum base { BASE_FIXED, BASE_PINNED, BASE_SPRING };

// The base of a member that stands on the ground, if it is of this kind.
static void draw_base(const struct deck_member *d, struct deck_shapes *s, enum base kind) {
    const struct frame_joint *j = &d->frame->joint[d->member->joint[0]];
    const enum base is = !j->turns ? BASE_FIXED : j->spring > 0.0 ? BASE_SPRING : BASE_PINNED;
    if (d->member->kind != FRAME_BEAM && d->member->level == 1 && is == kind) {
        deck_put_point(s, d->at.x[0], 0);
    }
}

void deck_members_fixed(const struct deck_member *d, struct deck_shapes *s) {
    draw_base(d, s, BASE_FIXED);
}

void deck_members_pinned(const struct deck_member *d, struct deck_shapes *s) {
    draw_base(d, s, BASE_PINNED);
}

void deck_members_spring(const struct deck_member *d, struct deck_shapes *s) {
    draw_base(d, s, BASE_SPRING);
}

// The hinges, beside the ends of the member.
void deck_members_hinges(const struct deck_member *d, struct deck_shapes *s) {
    static const double beside = 0.12;  // of the length
    const double *x = d->at.x, *y = d->at.y;
    for (int end = 0; end < 2; end++) {
        if (d->member->hinge[end] >= 0) {
            deck_put_point(s, x[end] + beside * (x[1 - end] - x[end]),
                           y[end] + beside * (y[1 - end] - y[end]));
        }
    }
}
