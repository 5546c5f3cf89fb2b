// SPDX-License-Identifier: GPL-3.0-or-later
#include <string.h>

#include "law/storey_list.h"
#include "model/damping.h"
#include "model/finish.h"
#include "model/modes.h"

// A building met before with the same masses and stiffnesses, whose modes can be used again.
static const struct building *twin(const struct building *first, int n, const struct building *of) {
    size_t bytes = (size_t)of->n_floor * sizeof *of->mass;
    for (int i = 0; i < n; i++) {
        if (first[i].n_floor == of->n_floor && memcmp(first[i].mass, of->mass, bytes) == 0 &&
            memcmp(first[i].stiffness, of->stiffness, bytes) == 0) {
            return &first[i];
        }
    }
    return NULL;
}

// Frequencies, shapes and damping matrix of building i.
static int finish_modes(struct builder *b, struct building *all, int i, struct error *e) {
    struct building *g = &all[i];
    const struct building *same = twin(all, i, g);
    const struct building_draft *d = builder_draft(b, i);
    if (same && d->damping.kind != DAMPING_MODAL) {
        g->omega = same->omega;
        g->shape = same->shape;
        damping_matrix(b, d, g->omega, NULL, g);
        return STATUS_OK;
    }
    size_t n = (size_t)g->n_floor;
    double *omega = arena_alloc(b->arena, n, sizeof *omega);
    double *shape = arena_alloc(b->arena, n * n, sizeof *shape);
    if (!omega || !shape) {
        return error_no_memory(e);
    }
    int status = modes_solve(g->n_floor, g->mass, g->stiffness, omega, shape, e);
    if (status != STATUS_OK) {
        return status;
    }
    damping_matrix(b, d, omega, shape, g);
    modes_scale_to_largest(g->n_floor, shape);
    g->omega = omega;
    g->shape = shape;
    return STATUS_OK;
}

static void finish_storeys(struct builder *b, struct model *m, struct building *g,
                           const struct building_draft *d, struct storey *storey) {
    g->elastic = true;
    for (int i = 0; i < g->n_floor; i++) {
        struct storey *s = &storey[g->first + i];
        *s = d->storey[i];
        if (!s->law) {
            double *constant =
                arena_alloc(b->arena, (size_t)storey_elastic.n_constant, sizeof *constant);
            if (!constant) {
                return;
            }
            storey_elastic.prepare(NULL, g->stiffness[i], constant, NULL);
            *s = (struct storey){.law = &storey_elastic, .constant = constant};
        }
        s->history = m->n_storey_history;
        m->n_storey_history += s->law->n_history;
        g->elastic &= s->law->n_history == 0;
    }
}

static int count_floors(struct builder *b) {
    int n = 0;
    for (int i = 0; i < b->buildings.n; i++) {
        n += builder_draft(b, i)->n_floor;
    }
    return n;
}

static void copy_floors(const struct building *g, const struct building_draft *d, double *mass,
                        double *displacement, double *velocity) {
    size_t bytes = (size_t)g->n_floor * sizeof *mass;
    memcpy(mass + g->first, d->mass, bytes);
    memcpy(displacement + g->first, d->displacement, bytes);
    memcpy(velocity + g->first, d->velocity, bytes);
}

int finish_buildings(struct builder *b, struct model *m, struct error *e) {
    size_t n = (size_t)(m->n_dof = count_floors(b));
    m->n_building = b->buildings.n;
    struct building *building = arena_alloc(b->arena, (size_t)m->n_building, sizeof *building);
    struct storey *storey = arena_alloc(b->arena, n, sizeof *storey);
    double *mass = arena_alloc(b->arena, n, sizeof *mass);
    double *displacement = arena_alloc(b->arena, n, sizeof *displacement);
    double *velocity = arena_alloc(b->arena, n, sizeof *velocity);
    if (arena_failed(b->arena)) {
        return error_no_memory(e);
    }
    for (int i = 0, first = 0; i < m->n_building; i++) {
        const struct building_draft *d = builder_draft(b, i);
        building[i] = (struct building){.name = d->name,
                                        .n_floor = d->n_floor,
                                        .first = first,
                                        .mass = d->mass,
                                        .stiffness = d->stiffness,
                                        .height = d->height};
        int status = finish_modes(b, building, i, e);
        if (status != STATUS_OK) {
            return status;
        }
        finish_storeys(b, m, &building[i], d, storey);
        copy_floors(&building[i], d, mass, displacement, velocity);
        first += d->n_floor;
    }
    finish_grounds(b, m, building);
    m->building = building;
    m->storey = storey;
    m->mass = mass;
    m->displacement = displacement;
    m->velocity = velocity;
    return arena_failed(b->arena) ? error_no_memory(e) : STATUS_OK;
}
