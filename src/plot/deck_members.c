// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot/deck_members.h"

#include "model/frame.h"

// A member of a frame or of a wall, and where it is drawn.
struct drawn {
    const struct plane_frame *frame;
    const struct frame_member *member;
    bool wall;
    struct elevation_ends at;
};

// Draws what belongs to a member in a layer; returns how much that is.
typedef int draw_member(const struct drawn *d, FILE *to);

static int count_walls(const struct building *g) {
    int n = 0;
    for (int p = 0; p < g->n_part; p++) {
        n += g->part[p].kind == &frame_wall;
    }
    return n;
}

static int write_members(const struct deck_view *v, FILE *to, draw_member *draw) {
    int n = 0;
    for (int k = 0; k < v->at.n; k++) {
        const struct building *of = &v->m->building[k], *g = of->fixed ? of->fixed : of;
        for (int p = 0; p < g->n_part; p++) {
            const struct plane_frame *f = frame_of(&g->part[p]);
            const bool wall = g->part[p].kind == &frame_wall;
            for (int i = 0; f && i < f->n_member; i++) {
                const struct frame_member *m = &f->member[i];
                const struct elevation_ends at = elevation_member(
                    &v->at, k, m->kind, m->level, m->number, wall ? count_walls(g) : f->n_line);
                n += draw(&(struct drawn){f, m, wall, at}, to);
            }
        }
    }
    return n;
}

static int draw_axis(const struct drawn *d, FILE *to) {
    deck_put_line(to, d->at.x[0], d->at.y[0], d->at.x[1], d->at.y[1]);
    return 1;
}

static int draw_wall(const struct drawn *d, FILE *to) {
    return d->wall ? draw_axis(d, to) : 0;
}

static int draw_frame(const struct drawn *d, FILE *to) {
    return d->wall ? 0 : draw_axis(d, to);
}

enum base { BASE_FIXED, BASE_PINNED, BASE_SPRING };

// The base of a member that stands on the ground, if it is of this kind.
static int draw_base(const struct drawn *d, FILE *to, enum base kind) {
    const struct frame_joint *j = &d->frame->joint[d->member->joint[0]];
    const enum base is = !j->turns ? BASE_FIXED : j->spring > 0.0 ? BASE_SPRING : BASE_PINNED;
    if (d->member->kind == FRAME_BEAM || d->member->level != 1 || is != kind) {
        return 0;
    }
    deck_put_point(to, d->at.x[0], 0);
    return 1;
}

static int draw_fixed(const struct drawn *d, FILE *to) {
    return draw_base(d, to, BASE_FIXED);
}

static int draw_pinned(const struct drawn *d, FILE *to) {
    return draw_base(d, to, BASE_PINNED);
}

static int draw_spring(const struct drawn *d, FILE *to) {
    return draw_base(d, to, BASE_SPRING);
}

// The hinges, beside the ends of the member.
static int draw_hinges(const struct drawn *d, FILE *to) {
    static const double beside = 0.12;  // of the length
    const double *x = d->at.x, *y = d->at.y;
    int n = 0;
    for (int end = 0; end < 2; end++) {
        if (d->member->hinge[end] >= 0) {
            deck_put_point(to, x[end] + beside * (x[1 - end] - x[end]),
                           y[end] + beside * (y[1 - end] - y[end]));
            n++;
        }
    }
    return n;
}

int deck_members_write_walls(const struct deck_view *v, FILE *to) {
    return write_members(v, to, draw_wall);
}

int deck_members_write_frames(const struct deck_view *v, FILE *to) {
    return write_members(v, to, draw_frame);
}

int deck_members_write_fixed(const struct deck_view *v, FILE *to) {
    return write_members(v, to, draw_fixed);
}

int deck_members_write_pinned(const struct deck_view *v, FILE *to) {
    return write_members(v, to, draw_pinned);
}

int deck_members_write_springs(const struct deck_view *v, FILE *to) {
    return write_members(v, to, draw_spring);
}

int deck_members_write_hinges(const struct deck_view *v, FILE *to) {
    return write_members(v, to, draw_hinges);
}
