// SPDX-License-Identifier: GPL-3.0-or-later
// Frames and walls by their members. Joints move sideways with their floor. Members have the
// modulus 1, so that A and I are E A and E I, and G A is that of a wall which shears.
//
// A hinge has a node of its own between the joint and the end of the member. A constraint must not
// follow from another one, so this node moves sideways with the floor, and up with the joint by a
// stiff spring.
#include <math.h>

#include "core/arena.h"
#include "export/opensees.h"
#include "model/frame.h"
#include "model/hinges.h"

// Times E A / L of a member: a spring or a member that hardly changes its length.
static const double RIGID = 1e7;

// A shear deformation that is rounding, relative to that of bending.
static const double NO_SHEAR = 1e-9;

struct frame_places {
    double *x, *y;  // of lines and of levels
    int *node;      // (n_joint) 0: not there yet
};

static void opensees_places(const struct plane_frame *f, struct frame_places *p) {
    for (int i = 0; i < f->n_member; i++) {
        const struct frame_member *m = &f->member[i];
        if (m->kind == FRAME_BEAM) {
            p->x[m->number] = m->length;
        } else {
            p->y[m->level] = m->length;
        }
    }
    for (int i = 1; i < f->n_line; i++) {
        p->x[i] = p->x[i - 1] + (p->x[i] > 0.0 ? p->x[i] : 1.0);
    }
    for (int i = 1; i <= f->n_floor; i++) {
        p->y[i] += p->y[i - 1];
    }
}

// The stiffest column, for what must hardly stretch.
static double opensees_axial(const struct plane_frame *f) {
    double most = 0.0;
    for (int i = 0; i < f->n_member; i++) {
        most = fmax(most, f->member[i].axial);
    }
    return most;
}

static void opensees_sideways(struct opensees *x, const struct building *g, int level, int node) {
    if (level > 0) {
        emit_put(&x->to, "equalDOF", "iii", opensees_dof(x, g->first + level - 1), node, 1);
    }
}

static int opensees_joint(struct opensees *x, const struct building *g, const struct plane_frame *f,
                          const struct frame_places *p, int i) {
    const struct frame_joint *j = &f->joint[i];
    const int level = i / f->n_line;
    const double at_x = p->x[i % f->n_line], at_y = p->y[level];
    if (p->node[i] > 0) {
        return p->node[i];
    }
    const int node = p->node[i] =
        opensees_node(x, at_x, at_y, level == 0, j->rise < 0, j->turn < 0);
    opensees_sideways(x, g, level, node);
    if (j->spring > 0.0) {
        const int ground = opensees_node(x, at_x, at_y, 1, 1, 1);
        emit_put(&x->to, "uniaxialMaterial", "win", "Elastic", ++x->material, j->spring);
        opensees_spring(x, ground, node, x->material, OPENSEES_TURN, true);
    }
    return node;
}

// The node of an end of a member: of its joint, or behind its hinge.
static int opensees_member_end(struct opensees *x, const struct building *g,
                               const struct plane_frame *f, const struct frame_places *p,
                               const struct frame_member *m, int end) {
    const int i = m->joint[end], level = i / f->n_line;
    const int joint = opensees_joint(x, g, f, p, i);
    if (m->hinge[end] < 0) {
        return joint;
    }
    const struct hinge *h = hinges_at(f, m->hinge[end]);
    const bool held = f->joint[i].rise < 0;
    const int node = opensees_node(x, p->x[i % f->n_line], p->y[level], level == 0, held, 0);
    opensees_sideways(x, g, level, node);
    if (!held) {
        emit_put(&x->to, "uniaxialMaterial", "win", "Elastic", ++x->material,
                 RIGID * opensees_axial(f));
        opensees_spring(x, joint, node, x->material, OPENSEES_RISE, false);
    }
    opensees_spring(x, joint, node,
                    material_storey(x, h->storey.law, h->storey.constant, g->name, g),
                    OPENSEES_TURN, false);
    return node;
}

static void opensees_member(struct opensees *x, const struct plane_frame *f,
                            const struct frame_member *m, int i, int j) {
    const double ei = m->bend * m->length, bending = 1.0 / m->bend;
    const double shear = 3.0 / m->sway - bending;  // 12 / (G A L)
    const bool props = m->kind == FRAME_COLUMN && m->axial == 0.0;
    const double ea = props            ? fmax(RIGID * opensees_axial(f) * m->length, 1.0)
                      : m->axial > 0.0 ? m->axial * m->length
                                       : 1.0;
    if (shear > NO_SHEAR * bending) {
        emit_put(&x->to, "element", "wiiinnnnni", "ElasticTimoshenkoBeam", ++x->element, i, j, 1.0,
                 1.0, ea, ei, 12.0 / (shear * m->length), 1);
    } else {
        emit_put(&x->to, "element", "wiiinnni", "elasticBeamColumn", ++x->element, i, j, ea, 1.0,
                 ei, 1);
    }
}

void opensees_frame(struct opensees *x, const struct building *g, const struct plane_frame *f) {
    struct frame_places p = {
        .x = arena_alloc(x->arena, (size_t)f->n_line, sizeof *p.x),
        .y = arena_alloc(x->arena, (size_t)f->n_floor + 1, sizeof *p.y),
        .node = arena_alloc(x->arena, (size_t)f->n_joint, sizeof *p.node),
    };
    if (!p.x || !p.y || !p.node) {
        return;
    }
    opensees_places(f, &p);
    for (int i = 0; i < f->n_member; i++) {
        const struct frame_member *m = &f->member[i];
        const int lower = opensees_member_end(x, g, f, &p, m, 0);
        const int upper = opensees_member_end(x, g, f, &p, m, 1);
        opensees_member(x, f, m, lower, upper);
    }
}
