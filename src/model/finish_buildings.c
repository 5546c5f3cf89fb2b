// SPDX-License-Identifier: GPL-3.0-or-later
// Buildings of the model: modes, damping, parts and storeys; and all floors as one chain.
#include <assert.h>
#include <math.h>
#include <string.h>

#include "core/lanes.h"
#include "law/lists.h"
#include "model/finish.h"
#include "model/forces.h"
#include "model/foundation.h"
#include "model/modes.h"
#include "model/parts.h"
#include "model/pdelta.h"
#include "model/rate_storeys.h"
#include "model/struck_column.h"
#include "model/tangent_damping.h"

// An earlier building with the same masses and stiffnesses, which has the same modes; NULL: none.
static const struct building *twin(const struct building *first, int n, const struct building *of) {
    size_t bytes = (size_t)of->n_dof * sizeof *of->mass;
    for (int i = 0; i < n; i++) {
        if (first[i].n_dof == of->n_dof && first[i].n_part == 0 && of->n_part == 0 &&
            !first[i].pdelta && memcmp(first[i].mass, of->mass, bytes) == 0 &&
            memcmp(first[i].spring, of->spring, bytes) == 0) {
            return &first[i];
        }
    }
    return NULL;
}

// Computes the frequencies, the mode shapes and the damping matrix of building i.
static int finish_modes(struct builder *b, struct building *all, int i, struct error *e) {
    struct building *g = &all[i];
    const struct building *same = twin(all, i, g);
    const struct building_draft *d = builder_draft(b, i);
    if (same && !damping_is_modal(d) && !d->load) {
        g->omega = same->omega;
        g->shape = same->shape;
        damping_matrix(b, d, g->omega, NULL, g);
        return STATUS_OK;
    }
    size_t n = (size_t)g->n_dof;
    double *omega = arena_alloc(b->arena, n, sizeof *omega);
    double *shape = arena_alloc(b->arena, n * n, sizeof *shape);
    if (!omega || !shape) {
        return error_no_memory(e);
    }
    int status = modes_solve(g->n_dof, g->mass, g->spring, g->part_stiffness, omega, shape, e);
    if (status != STATUS_OK) {
        return status;
    }
    damping_matrix(b, d, omega, shape, g);
    status = d->load ? pdelta_apply(b, d, g, omega, shape, e) : STATUS_OK;
    if (status != STATUS_OK) {
        return status;
    }
    modes_scale_to_largest(g->n_dof, shape);
    g->omega = omega;
    g->shape = shape;
    return STATUS_OK;
}

// Computes the initial stiffness and damping of all parts, and of the storeys with them.
static void sum_parts(struct builder *b, struct building *g, const struct part *part, int n_part) {
    const size_t n = (size_t)g->n_dof;
    size_t n_history = 0, n_scratch = 0;
    for (int i = 0; i < n_part; i++) {
        n_history += (size_t)part[i].n_history;
        n_scratch += (size_t)part[i].n_scratch;
    }
    double *at_rest = arena_alloc(b->arena, n, sizeof *at_rest);
    double *history = arena_alloc(b->arena, n_history, sizeof *history);
    double *stiffness = arena_alloc(b->arena, n, sizeof *stiffness);
    const struct part_sums sums = {.by_drift = arena_alloc(b->arena, n * n, sizeof *stiffness),
                                   .by_rate = arena_alloc(b->arena, n * n, sizeof *stiffness),
                                   .scratch = arena_alloc(b->arena, n_scratch, sizeof *history)};
    if (arena_failed(b->arena)) {
        return;
    }
    for (int i = 0; i < n_part; i++) {
        part[i].kind->respond(&part[i], history, at_rest, at_rest, &sums, NULL);
    }
    for (size_t i = 0; i < n; i++) {
        stiffness[i] = g->spring[i] + sums.by_drift[i * n + i];
    }
    g->stiffness = stiffness;
    g->part_stiffness = sums.by_drift;
    g->part_dashpot = sums.by_rate;
}

static void count_scratch(struct model *m, const struct part *p) {
    m->n_part_scratch = p->n_scratch > m->n_part_scratch ? p->n_scratch : m->n_part_scratch;
}

static void finish_parts(struct builder *b, struct model *m, struct building *g,
                         struct building_draft *d) {
    rate_storeys_put(b, d, g);
    struct part *part = d->parts.item;
    for (int i = 0; i < d->parts.n; i++) {
        part[i].history = m->n_storey_history;
        m->n_storey_history += part[i].n_history;
        count_scratch(m, &part[i]);
    }
    g->part = part;
    g->n_part = d->parts.n;
    if (g->n_part > 0) {
        sum_parts(b, g, part, g->n_part);
    }
}

static void finish_storeys(struct builder *b, struct model *m, struct building *g,
                           const struct building_draft *d, struct storey *storey) {
    g->elastic = true;
    for (int i = 0; i < g->n_dof; i++) {
        struct storey *s = &storey[g->first + i];
        const bool in_part = g->fixed || rate_storeys_of(g, i);
        *s = in_part ? (struct storey){0} : d->storey[i];
        s->pdelta = g->pdelta && !g->fixed ? g->pdelta[i] : 0.0;
        if (!s->law || (s->law == &storey_elastic && s->pdelta != 0.0)) {
            double *constant =
                arena_alloc(b->arena, (size_t)storey_elastic.n_constant, sizeof *constant);
            if (!constant) {
                return;
            }
            storey_elastic.prepare(NULL, g->spring[i], constant, NULL);
            *s = (struct storey){.law = &storey_elastic, .constant = constant, .yield = INFINITY};
        }
        s->history = m->n_storey_history;
        m->n_storey_history += s->law->n_history;
        g->elastic &= s->law->n_history == 0;
        g->smooth |= s->law->n_history > 0 && !(s->law->traits & STOREY_STRAIGHT);
    }
    g->storeys_linear = g->elastic;
    const bool yields = !g->elastic;
    for (int i = 0; i < g->n_part; i++) {
        const unsigned traits = g->part[i].kind->traits;
        g->elastic &= (traits & PART_LINEAR) != 0;
        g->smooth |= !(traits & PART_LINEAR) && (yields || !(traits & PART_STRAIGHT));
    }
    // The tangent predicts the shear if each storey is elastic or has a law of straight lines that
    // does not identify its line (`branch`); and with parts, if all storeys are elastic and all
    // parts are of straight lines.
    g->predictable = !g->elastic && (g->n_part == 0 || (!yields && !g->smooth));
    for (int i = 0; i < g->n_dof; i++) {
        const struct storey_law *law = storey[g->first + i].law;
        g->predictable &= law->n_history == 0 || ((law->traits & STOREY_STRAIGHT) && !law->branch);
    }
    m->elastic &= g->elastic;
    if (g->predictable && g->n_part > 0) {
        g->part_tangent = m->n_part_tangent;
        m->n_part_tangent += building_n_tangent(g) - g->n_dof;
    }
}

static void finish_damping(struct builder *b, struct model *m, struct building *g,
                           struct building_draft *d, const struct storey *storey) {
    if (g->tangent && !d->foundation) {
        m->storeys_differ = true;
        tangent_damping_put(b, d, g, storey + g->first, &m->n_storey_history);
        for (int i = 0; i < g->n_part; i++) {
            count_scratch(m, &g->part[i]);
        }
    }
}

static int count_floors(struct builder *b) {
    int n = 0;
    for (int i = 0; i < b->buildings.n; i++) {
        n += builder_draft(b, i)->n_floor + (builder_draft(b, i)->foundation ? 2 : 0);
    }
    return n;
}

static void finish_columns(struct builder *b, struct model *m, struct building *building) {
    struct struck_column *column = arena_alloc(b->arena, (size_t)m->n_column, sizeof *column);
    for (int i = 0; column && i < m->n_column; i++) {
        struct building *point = &building[m->n_building + i];
        const struct building *host = &building[struck_column_draft(b, i)->column.building];
        point->ground = host->ground;
        column[i] = struck_column_place(b, i, point->first, host->first);
    }
    m->column = column;
    for (int i = 0; column && i < m->n_building && !arena_failed(b->arena); i++) {
        forces_create(&building[i], i, m, b->arena);
    }
}

int finish_buildings(struct builder *b, struct model *m, struct error *e) {
    assert(b->buildings.n > 0);
    size_t n = (size_t)(m->n_dof = count_floors(b));
    m->n_body = b->buildings.n;
    m->n_column = b->columns.n;
    m->n_building = m->n_body - m->n_column;
    m->elastic = true;
    struct building *building = arena_alloc(b->arena, (size_t)m->n_body, sizeof *building);
    struct storey *storey = arena_alloc(b->arena, n, sizeof *storey);
    double *mass = arena_alloc(b->arena, n, sizeof *mass);
    double *displacement = arena_alloc(b->arena, n, sizeof *displacement);
    double *velocity = arena_alloc(b->arena, n, sizeof *velocity);
    if (arena_failed(b->arena)) {
        return error_no_memory(e);
    }
    for (int i = 0, first = 0; i < m->n_body; i++) {
        struct building_draft *d = builder_draft(b, i);
        building[i] = (struct building){.name = d->name,
                                        .n_dof = d->n_floor,
                                        .n_floor = d->n_floor,
                                        .isolated = d->isolated,
                                        .first = first,
                                        .mass = d->mass,
                                        .stiffness = d->stiffness,
                                        .spring = d->stiffness,
                                        .height = d->height};
        finish_parts(b, m, &building[i], d);
        int status = arena_failed(b->arena) ? error_no_memory(e) : finish_modes(b, building, i, e);
        if (status == STATUS_OK && d->foundation) {
            const struct building fixed = building[i];
            m->storeys_differ = true;
            status = foundation_put(b, d, &fixed, &m->n_storey_history, &building[i], e);
        }
        if (status != STATUS_OK) {
            return status;
        }
        finish_damping(b, m, &building[i], d, storey);
        finish_storeys(b, m, &building[i], d, storey);
        const struct building *g = &building[i];
        size_t bytes = (size_t)d->n_floor * sizeof *mass;
        memcpy(mass + g->first, g->mass, (size_t)g->n_dof * sizeof *mass);
        memcpy(displacement + g->first, d->displacement, bytes);
        memcpy(velocity + g->first, d->velocity, bytes);
        first += g->n_dof;
    }
    assert(building[m->n_body - 1].first + building[m->n_body - 1].n_dof == m->n_dof);
    finish_grounds(b, m, building);
    finish_columns(b, m, building);
    m->building = building;
    m->storey = storey;
    m->mass = mass;
    m->displacement = displacement;
    m->velocity = velocity;
    return arena_failed(b->arena) ? error_no_memory(e) : STATUS_OK;
}

enum { MASS, STIFFNESS, JOINT, BELOW, OWN, ABOVE, N_ARRAY };

void finish_chain(struct builder *b, struct model *m) {
    double *x[N_ARRAY];
    for (int i = 0; i < N_ARRAY; i++) {
        x[i] = lanes_array(b->arena, m->n_dof);
    }
    if (arena_failed(b->arena)) {
        return;
    }
    m->chain = (struct chain){
        .n = lanes_whole(m->n_dof),
        .mass = x[MASS],
        .stiffness = x[STIFFNESS],
        .joint = x[JOINT],
        .damping_below = x[BELOW],
        .damping = x[OWN],
        .damping_above = x[ABOVE],
    };
    for (int k = 0; k < m->n_body; k++) {
        const struct building *g = &m->building[k];
        for (int i = 0; i < g->n_dof; i++) {
            int j = g->first + i;
            x[MASS][j] = g->mass[i];
            x[STIFFNESS][j] = g->spring[i];
            x[JOINT][j] = i > 0 ? 1.0 : 0.0;
            if (!g->damping_full) {
                x[OWN][j] = g->damping_diagonal[i];
                x[BELOW][j] = i > 0 ? g->damping_off[i - 1] : 0.0;
                x[ABOVE][j] = i + 1 < g->n_dof ? g->damping_off[i] : 0.0;
            }
        }
        m->chain.full_damping |= g->damping_full != NULL;
        m->chain.parts |= g->n_part > 0;
    }
    // Loops over whole vectors read the element before the first floor and those behind the last.
    for (int i = 0; i < N_ARRAY; i++) {
        assert(x[i][-1] == 0.0);
        for (int j = m->n_dof; j < m->chain.n; j++) {
            assert(x[i][j] == 0.0);
        }
    }
}
