// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/forces.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "core/lanes.h"

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
                                    : g->part[number - 1].kind->traits & PART_LINEAR;
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

// Sets row `force` of the transposed matrix.
static void forces_set(const struct building *g, double *by_drift, int force, const double *row) {
    const size_t stride = (size_t)lanes_whole(g->n_force);
    for (int j = 0; j < g->n_floor; j++) {
        by_drift[(size_t)j * stride + (size_t)force] = row[j];
    }
}

static void forces_fill(const struct building *g, double *by_drift) {
    const size_t n = (size_t)g->n_floor;
    const size_t stride = (size_t)lanes_whole(g->n_force);
    const int storeys = forces_of_share(g, 0);
    for (size_t i = 0; storeys >= 0 && i < n; i++) {
        by_drift[i * stride + (size_t)storeys + i] = g->spring[i];
    }
    for (int p = 0; p < g->n_part; p++) {
        const int share = forces_of_share(g, p + 1);
        for (int i = 0; share >= 0 && i < g->n_floor; i++) {
            forces_set(g, by_drift, share + i, g->part[p].stiffness + (size_t)i * n);
        }
        const struct plane_frame *f = frame_of(&g->part[p]);
        for (int i = 0; f && i < f->n_member * FRAME_FORCES; i++) {
            const int at = forces_of_members(g, p, i % FRAME_FORCES) + i / FRAME_FORCES;
            forces_set(g, by_drift, at, f->force + (size_t)i * n);
        }
    }
}

bool forces_create(struct building *g, bool linear, int *first, struct arena *a) {
    g->storeys_linear = linear;
    g->force = *first;
    g->n_force = g->n_part > 0 ? forces_of_members(g, 0, FRAME_FORCES) : 0;
    if (g->n_force == 0) {
        return true;
    }
    const size_t stride = (size_t)lanes_whole(g->n_force);
    double *by_drift = arena_alloc(a, (size_t)g->n_floor * stride, sizeof *by_drift);
    if (by_drift) {
        forces_fill(g, by_drift);
    }
    g->force_by_drift = by_drift;
    *first += (int)stride;
    return by_drift != NULL;
}

void forces_at(const struct building *g, const double *drift, double *force) {
    const size_t n = (size_t)lanes_whole(g->n_force);
    memset(force, 0, n * sizeof *force);
    for (int j = 0; j < g->n_floor; j++) {
        const double *row = g->force_by_drift + (size_t)j * n;
        LANES_LOOP
        for (size_t i = 0; i < n; i++) {
            force[i] += row[i] * drift[j];
        }
    }
}

void forces_hide(const struct building *g, double *force) {
    for (int p = 0; p < g->n_part; p++) {
        const struct plane_frame *f = frame_of(&g->part[p]);
        for (int i = 0; f && i < f->n_member; i++) {
            if (!frame_has(&f->member[i], FRAME_NORMAL)) {
                force[forces_of_members(g, p, FRAME_NORMAL) + i] = (double)NAN;
            }
        }
    }
}
