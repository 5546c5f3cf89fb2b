// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/forces.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "core/lanes.h"
#include "model/foundation.h"
#include "model/hinges.h"

// The building whose storeys and parts have the forces: with a foundation, that without it.
static const struct building *forces_own(const struct building *g) {
    return g->fixed ? g->fixed : g;
}

static bool forces_storeys_resist(const struct building *g) {
    bool resist = false;
    for (int i = 0; i < g->n_dof; i++) {
        resist |= g->spring[i] > 0.0;
    }
    return resist;
}

// Does more than one resist?
static bool forces_shared(const struct building *g) {
    g = forces_own(g);
    int n = forces_storeys_resist(g);
    for (int i = 0; i < g->n_part; i++) {
        n += !(g->part[i].kind->traits & PART_SHARELESS);
    }
    return n > 1;
}

// The storey shears of a share.
static int forces_count_shares(const struct building *g, int number) {
    const struct building *own = forces_own(g);
    const struct part *part = number > 0 ? &own->part[number - 1] : NULL;
    const bool linear = part ? part->kind->traits & PART_LINEAR || frame_of(part)
                             : g->storeys_linear && forces_storeys_resist(own);
    return forces_shared(g) && linear ? own->n_dof : 0;
}

// The storey shears of the shares below `number`, and the members of the parts below `part`.
static int forces_shares_below(const struct building *g, int number) {
    int n = 0;
    for (int i = 0; i < number; i++) {
        n += forces_count_shares(g, i);
    }
    return n;
}

static int forces_members_below(const struct building *g, int part) {
    int n = 0;
    for (int i = 0; i < part; i++) {
        const struct plane_frame *f = frame_of(&forces_own(g)->part[i]);
        n += f ? f->n_member : 0;
    }
    return n;
}

int forces_of_share(const struct building *g, int number) {
    assert(number >= 0 && number <= forces_own(g)->n_part);
    return forces_count_shares(g, number) > 0 ? forces_shares_below(g, number) : -1;
}

const char *forces_share_name(const struct building *g, int number) {
    return number == 0 ? "storeys" : forces_own(g)->part[number - 1].name;
}

int forces_n_member(const struct building *g) {
    return forces_members_below(g, forces_own(g)->n_part);
}

int forces_of_members(const struct building *g, int part, int which) {
    const int n_part = forces_own(g)->n_part;
    assert(part >= 0 && part <= n_part);
    return forces_shares_below(g, n_part + 1) + (int)which * forces_n_member(g) +
           forces_members_below(g, part);
}

int forces_quantities(const struct building *g) {
    return g->n_hinge > 0 ? FRAME_QUANTITIES : FRAME_FORCES;
}

int forces_of_foundation(const struct building *g) {
    return forces_of_members(g, 0, forces_quantities(g));
}

// Sets the first n entries of row `force` of the transposed matrix.
static void forces_set(const struct building *g, double *by_action, int force, int n,
                       const double *row) {
    const size_t stride = (size_t)lanes_whole(g->n_force);
    for (int j = 0; j < n; j++) {
        by_action[(size_t)j * stride + (size_t)force] = row[j];
    }
}

// A row of a frame on its actions; `room` (n_action) of one with hinges is scratch.
static void forces_set_frame(const struct building *g, const struct plane_frame *f,
                             double *by_action, int force, const double *row, double *room) {
    if (f->n_hinge > 0) {
        hinges_on_departures(f, row, room);
    }
    forces_set(g, by_action, force, f->n_action, f->n_hinge > 0 ? room : row);
}

// The rotation of a hinge, and its plastic rotation r - m / k = -s / k.
static void forces_fill_hinge(const struct building *g, double *by_action, int part, int hinge,
                              double *room) {
    const struct plane_frame *f = forces_own(g)->part[part].data;
    const struct hinge *h = hinges_at(f, hinge);
    const ptrdiff_t stride = lanes_whole(g->n_force);
    const int own = f->n_floor + hinge;
    double *row = room + f->n_action;
    memset(row, 0, (size_t)f->n_action * sizeof *row);
    row[own] = 1.0;
    const int plastic = forces_of_members(g, part, FRAME_PLASTIC_I + h->end) + h->member;
    forces_set_frame(g, f, by_action,
                     forces_of_members(g, part, FRAME_ROTATION_I + h->end) + h->member, row, room);
    by_action[own * stride + plastic] = -1.0 / h->stiffness;
}

static void forces_fill_part(const struct building *g, double *by_action, int p, double *room) {
    const struct part *part = &forces_own(g)->part[p];
    const int n = part->n, share = forces_of_share(g, p + 1);
    const struct plane_frame *f = frame_of(part);
    for (int i = 0; share >= 0 && i < n; i++) {
        if (f) {
            forces_set_frame(g, f, by_action, share + i, f->stiffness + (ptrdiff_t)i * f->n_action,
                             room);
        } else {
            forces_set(g, by_action, share + i, n, part->stiffness + (ptrdiff_t)i * n);
        }
    }
    for (int i = 0; f && i < f->n_member * FRAME_FORCES; i++) {
        const int at = forces_of_members(g, p, i % FRAME_FORCES) + i / FRAME_FORCES;
        forces_set_frame(g, f, by_action, at, f->force + (ptrdiff_t)i * frame_n_load(f), room);
    }
    for (int i = 0; f && i < f->n_hinge; i++) {
        forces_fill_hinge(g, by_action, p, i, room);
    }
}

// By the drifts of the storeys themselves. `room` (2 (n_floor + n_hinge)) is scratch.
static void forces_fill(const struct building *g, double *by_action, double *room) {
    const struct building *own = forces_own(g);
    const size_t n = (size_t)own->n_dof;
    const size_t stride = (size_t)lanes_whole(g->n_force);
    const int storeys = forces_of_share(g, 0);
    for (size_t i = 0; storeys >= 0 && i < n; i++) {
        by_action[i * stride + (size_t)storeys + i] = own->spring[i];
    }
    for (int p = 0; p < own->n_part; p++) {
        forces_fill_part(g, by_action, p, room);
    }
}

// From the drifts of the storeys themselves to those of a building with a foundation, of which
// P-delta acts on the lean of the storeys; and the forces of the foundation.
static void forces_found(const struct building *g, const double *by_own, double *by_action) {
    const size_t stride = (size_t)lanes_whole(g->n_force);
    const int storeys = forces_of_share(g, 0), foundation = forces_of_foundation(g);
    memcpy(by_action + (size_t)g->n_dof * stride, by_own + (size_t)g->n_floor * stride,
           (size_t)g->n_hinge * stride * sizeof *by_own);
    for (int j = 0; j < g->n_dof; j++) {
        double *to = by_action + (size_t)j * stride;
        for (int i = 0; i < g->n_floor; i++) {
            const double entry = foundation_deformation(g, i, j);
            for (size_t q = 0; q < stride; q++) {
                to[q] += by_own[(size_t)i * stride + q] * entry;
            }
            if (storeys >= 0 && g->pdelta) {
                to[storeys + i] -= g->pdelta[i] * foundation_lean(g, i);
            }
        }
        for (int q = 0; q < FOUNDATION_QUANTITIES; q++) {
            to[foundation + q] = foundation_by_drift(g, q, j);
        }
    }
}

static bool forces_find_points(struct building *g, int building, const struct model *m,
                               struct arena *a) {
    int *struck = arena_alloc(a, (size_t)m->n_column, sizeof *struck);
    for (int i = 0; struck && i < m->n_column; i++) {
        if (m->column[i].building == building && m->column[i].line > 0) {
            assert(m->column[i].point == g->n_struck);
            struck[g->n_struck++] = m->column[i].dof[0];
        }
    }
    g->struck = struck;
    return struck != NULL;
}

// The force on a struck point of the frame is f = k (w - sum(rest u)), and adds to the forces of
// members. A unit drift moves all degrees of freedom from there on.
static void forces_fill_point(const struct building *g, double *by_action,
                              const struct struck_column *c) {
    const size_t stride = (size_t)lanes_whole(g->n_force);
    double *own = by_action + (size_t)(g->n_dof + g->n_hinge + c->point) * stride;
    const struct plane_frame *f = NULL;
    int p = 0;
    while (!f || f->n_point == 0) {
        f = frame_of(&forces_own(g)->part[p++]);
    }
    for (int i = 0; i < f->n_member * FRAME_FORCES; i++) {
        const int at = forces_of_members(g, p - 1, i % FRAME_FORCES) + i / FRAME_FORCES;
        own[at] = c->stiffness * f->force[(ptrdiff_t)i * frame_n_load(f) + f->n_action + c->point];
    }
    double sum = 0.0;
    for (int j = g->n_dof - 1; j >= 0; j--) {
        sum += c->rest[j];
        for (size_t q = 0; q < stride; q++) {
            by_action[(size_t)j * stride + q] -= own[q] * sum;
        }
    }
}

bool forces_create(struct building *g, int building, struct model *m, struct arena *a) {
    g->force = m->n_force;
    g->first_hinge = m->n_hinge;
    const struct building *own = forces_own(g);
    for (int i = 0; i < own->n_part; i++) {
        const struct plane_frame *f = frame_of(&own->part[i]);
        if (f && f->n_hinge > 0) {
            g->n_hinge = f->n_hinge;
            g->departure = own->part[i].history + f->n_hinge;  // behind their rotations
            g->departure += g->fixed ? g->part->history : 0;
        }
    }
    m->n_hinge += g->n_hinge;
    g->n_force = g->n_part > 0 ? forces_of_foundation(g) : 0;
    g->n_force += g->fixed ? FOUNDATION_QUANTITIES : 0;
    if (g->n_force == 0) {
        return true;
    }
    if (!forces_find_points(g, building, m, a)) {
        return false;
    }
    const size_t stride = (size_t)lanes_whole(g->n_force);
    const size_t n_action = (size_t)building_n_action(g);
    double *by_action = arena_alloc(a, n_action * stride, sizeof *by_action);
    double *room = arena_alloc(a, 2 * n_action, sizeof *room);
    const size_t n_own = (size_t)own->n_dof + (size_t)g->n_hinge;
    double *by_own = g->fixed ? arena_alloc(a, n_own * stride, sizeof *by_own) : by_action;
    if (!by_action || !room || !by_own) {
        return false;
    }
    forces_fill(g, by_own, room);
    if (g->fixed) {
        forces_found(g, by_own, by_action);
    }
    for (int i = 0; i < m->n_column; i++) {
        if (m->column[i].building == building && m->column[i].line > 0) {
            forces_fill_point(g, by_action, &m->column[i]);
        }
    }
    g->force_by_action = by_action;
    m->n_force += (int)stride;
    return true;
}

void forces_at(const struct building *g, const double *drift, const double *history,
               const double *struck, double *force) {
    const size_t n = (size_t)lanes_whole(g->n_force);
    const int n_own = g->n_dof + g->n_hinge;
    memset(force, 0, n * sizeof *force);
    for (int j = 0; j < building_n_action(g); j++) {
        const double *row = g->force_by_action + (size_t)j * n;
        const double action = j < g->n_dof ? drift[j]
                              : j < n_own  ? history[g->departure + j - g->n_dof]
                                           : struck[g->struck[j - n_own]];
        LANES_LOOP
        for (size_t i = 0; i < n; i++) {
            force[i] += row[i] * action;
        }
    }
}

void forces_hide(const struct building *g, double *force) {
    for (int p = 0; p < forces_own(g)->n_part; p++) {
        const struct plane_frame *f = frame_of(&forces_own(g)->part[p]);
        for (int i = 0; f && i < f->n_member; i++) {
            for (int q = FRAME_NORMAL; q < forces_quantities(g); q++) {
                if (!frame_has(&f->member[i], q)) {
                    force[forces_of_members(g, p, q) + i] = (double)NAN;
                }
            }
        }
    }
}
