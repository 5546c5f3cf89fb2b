// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/forces.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "core/lanes.h"
#include "model/hinges.h"

static bool forces_storeys_resist(const struct building *g) {
    bool resist = false;
    for (int i = 0; i < g->n_floor; i++) {
        resist |= g->spring[i] > 0.0;
    }
    return resist;
}

// Does more than one resist?
static bool forces_shared(const struct building *g) {
    int n = forces_storeys_resist(g);
    for (int i = 0; i < g->n_part; i++) {
        n += !(g->part[i].kind->traits & PART_SHARELESS);
    }
    return n > 1;
}

// The storey shears of a share.
static int forces_count_shares(const struct building *g, int number) {
    const bool linear = number == 0 ? g->storeys_linear && forces_storeys_resist(g)
                                    : g->part[number - 1].kind->traits & PART_LINEAR ||
                                          frame_of(&g->part[number - 1]);
    return forces_shared(g) && linear ? g->n_floor : 0;
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
        const struct plane_frame *f = frame_of(&g->part[i]);
        n += f ? f->n_member : 0;
    }
    return n;
}

int forces_of_share(const struct building *g, int number) {
    assert(number >= 0 && number <= g->n_part);
    return forces_count_shares(g, number) > 0 ? forces_shares_below(g, number) : -1;
}

const char *forces_share_name(const struct building *g, int number) {
    return number == 0 ? "storeys" : g->part[number - 1].name;
}

int forces_n_member(const struct building *g) {
    return forces_members_below(g, g->n_part);
}

int forces_of_members(const struct building *g, int part, int which) {
    assert(part >= 0 && part <= g->n_part);
    return forces_shares_below(g, g->n_part + 1) + (int)which * forces_n_member(g) +
           forces_members_below(g, part);
}

int forces_quantities(const struct building *g) {
    return g->n_hinge > 0 ? FRAME_QUANTITIES : FRAME_FORCES;
}

// Sets the first n entries of row `force` of the transposed matrix.
static void forces_set(const struct building *g, double *by_action, int force, int n,
                       const double *row) {
    const size_t stride = (size_t)lanes_whole(g->n_force);
    for (int j = 0; j < n; j++) {
        by_action[(size_t)j * stride + (size_t)force] = row[j];
    }
}

// The rotation of a hinge, and its plastic rotation r - m / k; the moment m acts on the joint, its
// opposite on the end of the member.
static void forces_fill_hinge(const struct building *g, double *by_action, int part, int hinge) {
    const struct plane_frame *f = g->part[part].data;
    const struct hinge *h = hinges_at(f, hinge);
    const ptrdiff_t stride = lanes_whole(g->n_force), n = f->n_action;
    const double *moment = f->stiffness + (f->n_floor + hinge) * n;
    const int turn = forces_of_members(g, part, FRAME_ROTATION_I + h->end) + h->member;
    const int plastic = forces_of_members(g, part, FRAME_PLASTIC_I + h->end) + h->member;
    for (ptrdiff_t j = 0; j < n; j++) {
        const double own = j == f->n_floor + hinge ? 1.0 : 0.0;
        by_action[j * stride + turn] = own;
        by_action[j * stride + plastic] = own + moment[j] / h->stiffness;
    }
}

static void forces_fill(const struct building *g, double *by_action) {
    const size_t n = (size_t)g->n_floor;
    const size_t stride = (size_t)lanes_whole(g->n_force);
    const int storeys = forces_of_share(g, 0);
    for (size_t i = 0; storeys >= 0 && i < n; i++) {
        by_action[i * stride + (size_t)storeys + i] = g->spring[i];
    }
    for (int p = 0; p < g->n_part; p++) {
        const int share = forces_of_share(g, p + 1);
        const struct plane_frame *f = frame_of(&g->part[p]);
        const double *stiffness = f ? f->stiffness : g->part[p].stiffness;
        const int n_action = f ? f->n_action : g->n_floor;
        for (int i = 0; share >= 0 && i < g->n_floor; i++) {
            forces_set(g, by_action, share + i, n_action, stiffness + (ptrdiff_t)i * n_action);
        }
        for (int i = 0; f && i < f->n_member * FRAME_FORCES; i++) {
            const int at = forces_of_members(g, p, i % FRAME_FORCES) + i / FRAME_FORCES;
            forces_set(g, by_action, at, n_action, f->force + (ptrdiff_t)i * n_action);
        }
        for (int i = 0; f && i < f->n_hinge; i++) {
            forces_fill_hinge(g, by_action, p, i);
        }
    }
}

bool forces_create(struct building *g, bool linear, struct model *m, struct arena *a) {
    g->storeys_linear = linear;
    g->force = m->n_force;
    g->first_hinge = m->n_hinge;
    for (int i = 0; i < g->n_part; i++) {
        const struct plane_frame *f = frame_of(&g->part[i]);
        if (f && f->n_hinge > 0) {
            g->n_hinge = f->n_hinge;
            g->turn = g->part[i].history;  // which begins with them
        }
    }
    m->n_hinge += g->n_hinge;
    g->n_force = g->n_part > 0 ? forces_of_members(g, 0, forces_quantities(g)) : 0;
    if (g->n_force == 0) {
        return true;
    }
    const size_t stride = (size_t)lanes_whole(g->n_force);
    const int n_action = g->n_floor + g->n_hinge;
    double *by_action = arena_alloc(a, (size_t)n_action * stride, sizeof *by_action);
    if (by_action) {
        forces_fill(g, by_action);
    }
    g->force_by_action = by_action;
    m->n_force += (int)stride;
    return by_action != NULL;
}

void forces_at(const struct building *g, const double *drift, const double *history,
               double *force) {
    const size_t n = (size_t)lanes_whole(g->n_force);
    memset(force, 0, n * sizeof *force);
    for (int j = 0; j < g->n_floor + g->n_hinge; j++) {
        const double *row = g->force_by_action + (size_t)j * n;
        const double action = j < g->n_floor ? drift[j] : history[g->turn + j - g->n_floor];
        LANES_LOOP
        for (size_t i = 0; i < n; i++) {
            force[i] += row[i] * action;
        }
    }
}

void forces_hide(const struct building *g, double *force) {
    for (int p = 0; p < g->n_part; p++) {
        const struct plane_frame *f = frame_of(&g->part[p]);
        for (int i = 0; f && i < f->n_member; i++) {
            for (int q = FRAME_NORMAL; q < forces_quantities(g); q++) {
                if (!frame_has(&f->member[i], q)) {
                    force[forces_of_members(g, p, q) + i] = (double)NAN;
                }
            }
        }
    }
}
