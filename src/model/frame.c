// SPDX-License-Identifier: GPL-3.0-or-later
// The deformations of a member are three numbers, each a sum over unknowns plus shares of actions,
// which are one storey drift and the rotations of hinges at the ends: its bending, a - b; its
// swaying, a + b; and its stretching. The stiffness of all unknowns is the sum over deformations of
// k times the square of that row. It is a band, because joints are numbered level by level.
#include "model/frame.h"

#include <assert.h>
#include <float.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

#include "model/parts.h"

// A pivot this small, relative to the stiffness of its unknown, is rounding: nothing holds it.
static const double HELD = 64.0 * DBL_EPSILON;

const struct part_kind frame_part = {
    .name = "frame",
    .traits = PART_LINEAR,
    .respond = parts_linear_respond,
    .stored = parts_linear_stored,
};

const struct part_kind frame_wall = {
    .name = "wall",
    .traits = PART_LINEAR,
    .respond = parts_linear_respond,
    .stored = parts_linear_stored,
};

const struct plane_frame *frame_of(const struct part *p) {
    const bool hinged = p->kind == &hinges_part || p->kind == &hinges_straight_part;
    return hinged || p->kind == &frame_part || p->kind == &frame_wall ? p->data : NULL;
}

const char *frame_member_name(const struct frame_member *m, struct arena *a) {
    static const char *const kind[] = {
        [FRAME_COLUMN] = "column", [FRAME_BEAM] = "beam", [FRAME_WALL] = "wall"};
    return arena_format(a, "%s_%d_%d", kind[m->kind], m->level, m->number);
}

struct frame_member frame_member(enum frame_kind kind, int level, int number, double length,
                                 double ei, double ga, double ea) {
    assert(length > 0.0 && ei > 0.0 && ga > 0.0 && ea >= 0.0);
    return (struct frame_member){
        .kind = kind,
        .level = level,
        .number = number,
        .length = length,
        .bend = ei / length,
        .sway = 3.0 / (length / ei + 12.0 / (ga * length)),
        .axial = ea / length,
        .hinge = {-1, -1},
    };
}

bool frame_has(const struct frame_member *m, int force) {
    if (force >= FRAME_FORCES) {
        return m->hinge[(force - FRAME_FORCES) % 2] >= 0;
    }
    return force != FRAME_NORMAL || m->kind == FRAME_COLUMN;
}

// One of the three deformations of a member.
enum { FRAME_TERMS = 4, FRAME_DEFORMATIONS = 3 };
struct deformation {
    double stiffness;
    int n;
    int unknown[FRAME_TERMS];
    double weight[FRAME_TERMS];
};

static void frame_add_term(struct deformation *d, int unknown, double weight) {
    if (unknown >= 0) {
        d->unknown[d->n] = unknown;
        d->weight[d->n++] = weight;
    }
}

static void frame_deform(const struct plane_frame *f, const struct frame_member *m,
                         struct deformation d[FRAME_DEFORMATIONS]) {
    const struct frame_joint *i = &f->joint[m->joint[0]], *j = &f->joint[m->joint[1]];
    d[0] = (struct deformation){.stiffness = m->bend};
    frame_add_term(&d[0], i->turn, 1.0);
    frame_add_term(&d[0], j->turn, -1.0);
    d[1] = (struct deformation){.stiffness = m->sway};
    frame_add_term(&d[1], i->turn, 1.0);
    frame_add_term(&d[1], j->turn, 1.0);
    d[2] = (struct deformation){.stiffness = m->axial};
    if (m->kind == FRAME_BEAM) {
        // The chord turns by (rise_j - rise_i) / length.
        frame_add_term(&d[1], i->rise, 2.0 / m->length);
        frame_add_term(&d[1], j->rise, -2.0 / m->length);
    } else if (m->axial > 0.0) {
        frame_add_term(&d[2], i->rise, -1.0);
        frame_add_term(&d[2], j->rise, 1.0);
    }
}

// Moments at the ends of a clamped member with a unit force to the right at its point.
static void frame_clamped(const struct frame_point *p, double length, double moment[2]) {
    const double x = p->share;
    moment[0] = x * (1.0 - x) * (1.0 - x) * length;
    moment[1] = -x * x * (1.0 - x) * length;
}

// The share of an action in deformation k of a member. A drift turns the chord by -drift / length;
// a hinge turns its end of the member by its rotation more than the joint; a force at a point acts
// as the deformation with the same moments at clamped ends.
static double frame_share(const struct plane_frame *f, const struct frame_member *m, int k,
                          int action) {
    if (k == 2 || action < f->n_floor) {
        const bool sheared = m->kind != FRAME_BEAM && m->level - 1 == action;
        return k == 1 && sheared ? 2.0 / m->length : 0.0;
    }
    if (action < f->n_action) {
        const int hinge = action - f->n_floor;
        const double at_j = k == 0 ? -1.0 : 1.0;
        return m->hinge[0] == hinge ? 1.0 : m->hinge[1] == hinge ? at_j : 0.0;
    }
    const struct frame_point *p = &f->point[action - f->n_action];
    double moment[2];
    frame_clamped(p, m->length, moment);
    const double share = k == 0 ? (moment[0] - moment[1]) / (2.0 * m->bend)
                                : (moment[0] + moment[1]) / (2.0 * m->sway);
    return &f->member[p->member] == m ? share : 0.0;
}

// The force of deformation k of a member where the unknowns are x, by a unit action.
static double frame_force(const struct plane_frame *f, const struct frame_member *m, int k,
                          const double *x, int action) {
    struct deformation d[FRAME_DEFORMATIONS];
    frame_deform(f, m, d);
    double sum = frame_share(f, m, k, action);
    for (int i = 0; i < d[k].n; i++) {
        sum += d[k].weight[i] * x[d[k].unknown[i]];
    }
    return d[k].stiffness * sum;
}

// Joins the members to their joints. `propped` are joints on a column that does not stretch.
static void frame_join(struct plane_frame *f, bool *propped) {
    for (int i = 0; i < f->n_member; i++) {
        struct frame_member *m = &f->member[i];
        const int line = m->kind == FRAME_WALL ? 0 : m->number - 1;  // a wall has one line
        const int below = (m->level - 1) * f->n_line + line;
        const bool beam = m->kind == FRAME_BEAM;
        m->joint[0] = beam ? below + f->n_line : below;
        m->joint[1] = below + f->n_line + (beam ? 1 : 0);
        f->joint[m->joint[1]].turns = true;
        f->joint[m->joint[0]].turns |= m->joint[0] >= f->n_line;
        propped[m->joint[1]] |= !beam && m->axial == 0.0;
    }
}

// Numbers the unknowns. A joint above the ground rises by itself unless it is propped.
static void frame_number(struct plane_frame *f, const bool *propped) {
    for (int i = 0; i < f->n_joint; i++) {
        struct frame_joint *j = &f->joint[i];
        j->turn = j->turns ? f->n_unknown++ : -1;
        j->rise = -1;
        if (propped[i]) {
            j->rise = f->joint[i - f->n_line].rise;
        } else if (i >= f->n_line && j->turns) {
            j->rise = f->n_unknown++;
        }
    }
}

static size_t frame_band(const struct plane_frame *f) {
    int band = 0;
    for (int i = 0; i < f->n_member; i++) {
        struct deformation d[FRAME_DEFORMATIONS];
        frame_deform(f, &f->member[i], d);
        for (int k = 0; k < FRAME_DEFORMATIONS; k++) {
            for (int p = 0; p < d[k].n; p++) {
                for (int q = 0; q < d[k].n; q++) {
                    const int apart = d[k].unknown[p] - d[k].unknown[q];
                    band = apart > band ? apart : band;
                }
            }
        }
    }
    return (size_t)band;
}

// Adds the stiffness of all unknowns to a symmetric band as GSL stores it: entry (i, k) is that of
// unknowns i and i + k.
static void frame_assemble(const struct plane_frame *f, gsl_matrix *band) {
    for (int i = 0; i < f->n_joint; i++) {
        if (f->joint[i].turn >= 0) {
            *gsl_matrix_ptr(band, (size_t)f->joint[i].turn, 0) += f->joint[i].spring;
        }
    }
    for (int i = 0; i < f->n_member; i++) {
        struct deformation d[FRAME_DEFORMATIONS];
        frame_deform(f, &f->member[i], d);
        for (int k = 0; k < FRAME_DEFORMATIONS; k++) {
            for (int p = 0; p < d[k].n; p++) {
                for (int q = 0; q < d[k].n; q++) {
                    const int row = d[k].unknown[p], apart = d[k].unknown[q] - row;
                    if (apart >= 0) {
                        *gsl_matrix_ptr(band, (size_t)row, (size_t)apart) +=
                            d[k].stiffness * d[k].weight[p] * d[k].weight[q];
                    }
                }
            }
        }
    }
}

// Factorises the band of this diagonal. The first unknown that nothing holds; -1: all are held.
static int frame_factorise(gsl_matrix *band, const double *diagonal) {
    const int status = gsl_linalg_cholesky_band_decomp(band);
    for (size_t i = 0; i < band->size1; i++) {
        const double pivot = gsl_matrix_get(band, i, 0);
        if (!(pivot > 0.0 && pivot * pivot > HELD * diagonal[i])) {
            return (int)i;
        }
    }
    assert(status == 0);
    return -1;
}

// The loads of all unknowns that hold joints at 0 under a unit action, reversed.
static void frame_load(const struct plane_frame *f, int action, double *x) {
    memset(x, 0, (size_t)f->n_unknown * sizeof *x);
    for (int i = 0; i < f->n_member; i++) {
        struct deformation d[FRAME_DEFORMATIONS];
        frame_deform(f, &f->member[i], d);
        for (int k = 0; k < FRAME_DEFORMATIONS; k++) {
            const double share = frame_share(f, &f->member[i], k, action);
            for (int p = 0; share != 0.0 && p < d[k].n; p++) {
                x[d[k].unknown[p]] -= d[k].stiffness * share * d[k].weight[p];
            }
        }
    }
}

static double *frame_entry(const struct plane_frame *f, int member, enum frame_force force) {
    const size_t row = (size_t)member * FRAME_FORCES + force;
    return f->force + row * (size_t)frame_n_load(f);
}

// Does the member stand on a pinned base? Its moment there is 0, without rounding.
static bool frame_is_pinned(const struct plane_frame *f, const struct frame_member *m) {
    const struct frame_joint *j = &f->joint[m->joint[0]];
    return m->joint[0] < f->n_line && j->turns && j->spring == 0.0;
}

// The forces of all members where joints move by x under a unit action; and the storey shears,
// which those of columns add up to, and moments at hinges.
static void frame_recover(struct plane_frame *f, int action, const double *x) {
    const bool load = action >= f->n_action;
    double *column = f->stiffness + action;
    const ptrdiff_t stride = f->n_action;
    for (int i = 0; i < f->n_member; i++) {
        const struct frame_member *m = &f->member[i];
        const double bend = frame_force(f, m, 0, x, action), sway = frame_force(f, m, 1, x, action);
        const double shear = 2.0 * sway / m->length;
        const double moment[] = {frame_is_pinned(f, m) ? 0.0 : sway + bend, sway - bend};
        frame_entry(f, i, FRAME_MOMENT_I)[action] = moment[0];
        frame_entry(f, i, FRAME_MOMENT_J)[action] = moment[1];
        frame_entry(f, i, FRAME_SHEAR)[action] = shear;
        if (m->kind != FRAME_BEAM && !load) {
            column[(m->level - 1) * stride] += shear;
        }
        for (int end = 0; end < 2; end++) {
            if (m->hinge[end] >= 0 && !load) {
                column[(f->n_floor + m->hinge[end]) * stride] = moment[end];
            }
        }
    }
}

// The normal forces of columns under a unit action, from the equilibrium of joints: a column
// carries what the one above it does, and the shears of the beams beside its upper end. `carried`
// (n_line).
static void frame_find_normal(const struct plane_frame *f, int action, double *carried) {
    memset(carried, 0, (size_t)f->n_line * sizeof *carried);
    for (int i = f->n_member - 1; i >= 0; i--) {
        const struct frame_member *m = &f->member[i];
        const double shear = frame_entry(f, i, FRAME_SHEAR)[action];
        if (m->kind == FRAME_BEAM) {
            carried[m->number - 1] -= shear;
            carried[m->number] += shear;
        } else if (m->kind == FRAME_COLUMN) {
            frame_entry(f, i, FRAME_NORMAL)[action] = carried[m->number - 1];
        }
    }
}

static void frame_symmetrise(double *k, int n) {
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < i; j++) {
            k[i * n + j] = k[j * n + i] = (k[i * n + j] + k[j * n + i]) / 2.0;
        }
    }
}

// Reports the joint that nothing holds.
static int frame_report(const struct plane_frame *f, int unknown, struct error *e) {
    int i = 0;
    while (f->joint[i].turn != unknown && f->joint[i].rise != unknown) {
        i++;
    }
    return error_set(e, STATUS_INPUT, "nothing holds the joint of floor %d and line %d",
                     i / f->n_line, i % f->n_line + 1);
}

static bool frame_is_finite(const double *x, int n) {
    double sum = 0.0;
    for (int i = 0; i < n; i++) {
        sum += x[i];
    }
    return isfinite(sum);
}

// Condenses the frame to the actions, by its factorised band. `x` (n_unknown), `carried` (n_line).
static void frame_reduce(struct plane_frame *f, const gsl_matrix *factors, double *x,
                         double *carried) {
    gsl_vector_view joints = gsl_vector_view_array(x, (size_t)f->n_unknown);
    for (int action = 0; action < frame_n_load(f); action++) {
        frame_load(f, action, x);
        gsl_linalg_cholesky_band_svx(factors, &joints.vector);
        frame_recover(f, action, x);
        frame_find_normal(f, action, carried);
    }
    frame_symmetrise(f->stiffness, f->n_action);
}

// How far the rotations a and b of the ends of a member of the length h from its chord move the
// point from the chord: the cubic beam. `clamped` are moments that do not come from rotations.
static double frame_bent(const struct plane_frame *f, const struct frame_point *p, int action,
                         const double clamped[2]) {
    const struct frame_member *m = &f->member[p->member];
    const double x = p->share;
    const double at_i = frame_entry(f, p->member, FRAME_MOMENT_I)[action] - clamped[0];
    const double at_j = frame_entry(f, p->member, FRAME_MOMENT_J)[action] - clamped[1];
    const double bent = (at_i - at_j) / (4.0 * m->bend), swayed = (at_i + at_j) / (4.0 * m->sway);
    return -m->length * x * (1.0 - x) * ((1.0 - x) * (swayed + bent) - x * (swayed - bent));
}

double frame_point_by_drift(const struct plane_frame *f, int point, int storey) {
    const struct frame_point *p = &f->point[point];
    return (f->member[p->member].level - 1 == storey ? p->share : 0.0) +
           frame_bent(f, p, storey, (const double[2]){0.0, 0.0});
}

double frame_point_by_force(const struct plane_frame *f, int point) {
    const struct frame_point *p = &f->point[point];
    const struct frame_member *m = &f->member[p->member];
    double clamped[2], x = p->share, span = m->length;
    frame_clamped(p, span, clamped);
    return pow(x * (1.0 - x), 3.0) * span * span / (3.0 * m->bend) +
           frame_bent(f, p, f->n_action + point, clamped);
}

// Factorises the stiffness of the unknowns and condenses the frame. `x` (n_unknown).
static int frame_solve(struct plane_frame *f, gsl_matrix *band, double *x, double *carried,
                       struct error *e) {
    frame_assemble(f, band);
    for (size_t i = 0; i < band->size1; i++) {
        x[i] = gsl_matrix_get(band, i, 0);
    }
    bool finite = frame_is_finite(x, f->n_unknown);
    if (finite) {
        const int loose = frame_factorise(band, x);
        if (loose >= 0) {
            return frame_report(f, loose, e);
        }
        frame_reduce(f, band, x, carried);
        finite = frame_is_finite(f->stiffness, f->n_action * f->n_action);
    }
    return finite ? STATUS_OK
                  : error_set(e, STATUS_INPUT, "the stiffness of its members is not finite");
}

int frame_condense(struct plane_frame *f, struct arena *a, struct error *e) {
    f->n_action = f->n_floor + f->n_hinge;
    const size_t n = (size_t)f->n_action;
    bool *propped = arena_alloc(a, (size_t)f->n_joint, sizeof *propped);
    double *carried = arena_alloc(a, (size_t)f->n_line, sizeof *carried);
    f->stiffness = arena_alloc(a, n * n, sizeof *f->stiffness);
    f->force = arena_alloc(a, (size_t)f->n_member * FRAME_FORCES * (size_t)frame_n_load(f),
                           sizeof *f->force);
    if (!propped || !carried || !f->stiffness || !f->force) {
        return error_no_memory(e);
    }
    frame_join(f, propped);
    frame_number(f, propped);
    double *x = arena_alloc(a, (size_t)f->n_unknown, sizeof *x);
    gsl_matrix *band = x ? gsl_matrix_calloc((size_t)f->n_unknown, frame_band(f) + 1) : NULL;
    const int status = band ? frame_solve(f, band, x, carried, e) : error_no_memory(e);
    gsl_matrix_free(band);
    return status;
}
