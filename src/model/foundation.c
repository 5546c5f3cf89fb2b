// SPDX-License-Identifier: GPL-3.0-or-later
// A building on a rigid slab, which moves by u_b and rotates by theta. With the height H of the
// roof, phi = H theta is the displacement of the roof that comes from the rotation. Degrees of
// freedom are v_1 ... v_n of the floors, u_b and phi. All are relative to the ground.
//
// The building itself has the displacements u_i = v_i - u_b - (H_i / H) phi, and its storeys deform
// by e_i = u_i - u_(i-1). A storey is h_i high, r_i = h_i / H. On the drifts d of the degrees of
// freedom as one chain (d_1 = v_1, ..., d_(n+1) = u_b - v_n, d_(n+2) = phi - u_b)
//     u_b = d_1 + ... + d_(n+1),   phi = d_1 + ... + d_(n+2),
//     e_1 = d_1 - u_b - r_1 phi,   e_i = d_i - r_i phi.
// So e = B d, and storey shears V give the shears S = B' V + (spring forces) of the chain. The
// column of B of d_(n+1) tells that V_i = S_i - S_(n+1) for each storey.
//
// The mass of phi is J / H^2. The ground does not rotate. But the solver moves the ground below all
// degrees of freedom, so a load J / H^2 times the ground acceleration takes that away again.
#include "model/foundation.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "law/lists.h"
#include "model/founded.h"
#include "model/modes.h"
#include "model/pairs.h"
#include "model/parts.h"
#include "model/pdelta.h"
#include "model/rate_storeys.h"
#include "model/storey_force.h"
#include "model/tangent_damping.h"

// P-delta acts on how far a storey leans, e_i + r_i phi = d_i (less u_b in the first storey): the
// share of phi is not in it. Takes P/h off the matrix (all, all).
static void founded_take_pdelta(const struct founded *f, const struct building *fixed, double *k) {
    const int all = f->n + 2;
    for (int i = 0; fixed->pdelta && i < f->n; i++) {
        for (int j = 0; j < all; j++) {
            for (int l = 0; l < all; l++) {
                const double lean_j = founded_entry(f, i, j) + f->share[i];
                const double lean_l = founded_entry(f, i, l) + f->share[i];
                k[j * all + l] -= fixed->pdelta[i] * (lean_j * lean_l);
            }
        }
    }
}

// The matrix of all that is linear: the parts of the building and its elastic storeys, B' D B, the
// springs below the slab, and P-delta.
static const double *founded_matrix(struct arena *a, const struct founded *f,
                                    const struct building *fixed, const struct foundation *draft,
                                    double height) {
    const int n = f->n, all = n + 2;
    double *k = arena_alloc(a, (size_t)all * (size_t)all, sizeof *k);
    double *product = arena_alloc(a, (size_t)n * (size_t)all, sizeof *product);  // D B
    double *linear = arena_alloc(a, (size_t)n * (size_t)n, sizeof *linear);
    if (!k || !product || !linear) {
        return NULL;
    }
    for (int i = 0; i < fixed->n_part; i++) {
        if (fixed->part[i].kind->traits & PART_LINEAR) {
            parts_linear_respond(&fixed->part[i], NULL, NULL, NULL,
                                 &(struct part_sums){.by_drift = linear}, NULL);
        }
    }
    for (int i = 0; i < n; i++) {
        for (int l = 0; l < n; l++) {
            const bool spring = i == l && f->storey[i].law->n_history == 0;
            const double d = linear[i * n + l] + (spring ? fixed->spring[i] : 0.0) +
                             (spring && fixed->pdelta ? fixed->pdelta[i] : 0.0);
            for (int j = 0; d != 0.0 && j < all; j++) {
                product[i * all + j] += d * founded_entry(f, l, j);
            }
        }
    }
    const double rocking = draft->rocking / (height * height);
    for (int j = 0; j < all; j++) {
        for (int l = 0; l <= j; l++) {
            double sum = rocking + (j <= n && l <= n ? draft->sway : 0.0);
            for (int i = 0; i < n; i++) {
                sum += founded_entry(f, i, j) * product[i * all + l];
            }
            k[j * all + l] = k[l * all + j] = sum;
        }
    }
    founded_take_pdelta(f, fixed, k);
    return k;
}

// The damping of the building acts on its own displacements u = T v, so its matrix is T' C T. The
// dashpots below the slab add to it.
static const double *founded_damping(struct arena *a, const struct building *fixed,
                                     const struct foundation *draft, double height) {
    const int n = fixed->n_dof, all = n + 2;
    double *c = arena_alloc(a, (size_t)all * (size_t)all, sizeof *c);
    double *unit = arena_alloc(a, (size_t)n, sizeof *unit);
    double *force = arena_alloc(a, (size_t)n, sizeof *force);
    double level = 0.0;
    if (!c || !unit || !force) {
        return NULL;
    }
    for (int j = 0; j < all; j++) {
        level = 0.0;
        for (int i = 0; i < n; i++) {
            level += fixed->height[i];
            unit[i] = j < n ? i == j : j == n ? -1.0 : -level / height;
        }
        building_damping_force(fixed, unit, force);
        level = 0.0;
        for (int i = 0; i < n; i++) {
            level += fixed->height[i];
            c[i * all + j] += force[i];
            c[n * all + j] -= force[i];
            c[(n + 1) * all + j] -= force[i] * level / height;
        }
    }
    c[n * all + n] += draft->sway_dashpot;
    c[(n + 1) * all + n + 1] += draft->rocking_dashpot / (height * height);
    for (int i = 0; i < all; i++) {
        for (int j = 0; j < i; j++) {
            c[i * all + j] = c[j * all + i];
        }
    }
    return c;
}

// Storeys of the building for its part; false: no memory.
static bool founded_take_storeys(struct arena *a, struct founded *f, const struct building *fixed,
                                 const struct storey *storey, double height, int *n_history) {
    struct storey *own = arena_alloc(a, (size_t)f->n, sizeof *own);
    double *share = arena_alloc(a, (size_t)f->n, sizeof *share);
    *n_history = 0;
    for (int i = 0; own && share && i < f->n; i++) {
        own[i] = storey[i];
        own[i].law = own[i].law ? own[i].law : &storey_elastic;
        own[i].pdelta = fixed->pdelta ? fixed->pdelta[i] : 0.0;  // as a storey alone unloads
        own[i].history = *n_history;
        *n_history += own[i].law->n_history;
        share[i] = fixed->height[i] / height;
    }
    f->storey = own;
    f->share = share;
    return own && share;
}

// Copies the parts of the building, whose histories are behind n_history values, and takes those
// that are not linear. Returns the scratch that they need; -1: no memory.
static int founded_take_parts(struct arena *a, struct founded *f, struct building *fixed,
                              int *n_history) {
    struct part *all = arena_alloc(a, (size_t)fixed->n_part, sizeof *all);
    struct part *own = arena_alloc(a, (size_t)fixed->n_part, sizeof *own);
    int inner = 0;
    for (int i = 0; all && own && i < fixed->n_part; i++) {
        all[i] = fixed->part[i];
        if (!(all[i].kind->traits & PART_LINEAR)) {
            all[i].history = *n_history;
            *n_history += all[i].n_history;
            inner = all[i].n_scratch > inner ? all[i].n_scratch : inner;
            own[f->n_part++] = all[i];
        }
    }
    fixed->part = all;
    f->part = own;
    return all && own ? inner : -1;
}

// The part of the building and its matrices; NULL: no memory.
static struct part *founded_part(struct arena *a, const struct building_draft *d,
                                 struct building *fixed, double height, int first_history) {
    struct founded *f = arena_alloc(a, 1, sizeof *f);
    struct part *part = arena_alloc(a, 1, sizeof *part);
    int n_history = 0;
    if (!f || !part) {
        return NULL;
    }
    *f = (struct founded){.n = fixed->n_dof};
    if (!founded_take_storeys(a, f, fixed, d->storey, height, &n_history)) {
        return NULL;
    }
    const int inner = founded_take_parts(a, f, fixed, &n_history);
    if (inner < 0) {
        return NULL;
    }
    *part = (struct part){
        .kind = n_history > 0 ? &founded_yields : &founded_linear,
        .name = "foundation",
        .n = f->n + 2,
        .stiffness = founded_matrix(a, f, fixed, d->foundation, height),
        .data = f,
        .n_history = n_history,
        .history = first_history,
        .n_scratch = f->n_part > 0 ? founded_n_scratch(f->n, inner) : 0,
    };
    return part->stiffness ? part : NULL;
}

// Masses, and the stiffness at rest, of the building with its part; false: no memory.
static bool founded_properties(struct arena *a, const struct building *fixed, double height,
                               struct building *out) {
    const size_t n = (size_t)fixed->n_dof, all = n + 2;
    const size_t n_history = (size_t)out->part->n_history;
    double *mass = arena_alloc(a, all, sizeof *mass);
    double *spring = arena_alloc(a, all, sizeof *spring);
    double *band = arena_alloc(a, all, sizeof *band);
    double *stiffness = arena_alloc(a, all, sizeof *stiffness);
    double *initial = arena_alloc(a, all * all, sizeof *initial);
    double *still = arena_alloc(a, all * all, sizeof *still);
    double *history = arena_alloc(a, n_history, sizeof *history);
    double *scratch = arena_alloc(a, (size_t)out->part->n_scratch, sizeof *scratch);
    if (arena_failed(a)) {
        return false;
    }
    memcpy(mass, fixed->mass, n * sizeof *mass);
    mass[n] = out->foundation->mass;
    mass[n + 1] = out->foundation->inertia / (height * height);
    out->part->kind->respond(out->part, history, still, still,
                             &(struct part_sums){.by_drift = initial, .scratch = scratch}, NULL);
    for (size_t i = 0; i < all; i++) {
        stiffness[i] = initial[i * all + i];
    }
    out->mass = mass;
    out->spring = spring;
    out->stiffness = stiffness;
    out->part_stiffness = initial;
    out->part_dashpot = still;
    out->damping_diagonal = out->damping_off = band;
    out->damping_full = founded_damping(a, fixed, out->foundation, height);
    return out->damping_full != NULL;
}

int foundation_put(struct builder *b, const struct building_draft *d, const struct building *fixed,
                   int *n_history, struct building *out, struct error *e) {
    struct arena *a = b->arena;
    const size_t all = (size_t)fixed->n_dof + 2;
    assert(fixed->height);
    const double height = level_of_floor(fixed->height, fixed->n_dof);
    struct building *kept = arena_alloc(a, 1, sizeof *kept);
    if (!kept) {
        return error_no_memory(e);
    }
    *kept = *fixed;
    struct part *part = founded_part(a, d, kept, height, *n_history);
    double *omega = arena_alloc(a, all, sizeof *omega);
    double *shape = arena_alloc(a, all * all, sizeof *shape);
    if (!part || !omega || !shape) {
        return error_no_memory(e);
    }
    *n_history += part->n_history;
    *out = *fixed;
    out->fixed = kept;
    out->foundation = d->foundation;
    out->n_dof = (int)all;
    out->n_part = 1;
    out->part = part;
    out->omega = omega;
    out->shape = shape;
    if (!founded_properties(a, fixed, height, out)) {
        return error_no_memory(e);
    }
    const int status =
        modes_solve((int)all, out->mass, out->spring, out->part_stiffness, omega, shape, e);
    if (status == STATUS_OK) {
        modes_scale_to_largest((int)all, shape);
        pdelta_check_founded(b, d, out);
    }
    return status;
}

int foundation_n_load(const struct model *m) {
    int n = 0;
    for (int i = 0; i < m->n_building; i++) {
        const struct building *g = &m->building[i];
        n += g->fixed ? m->ground[g->ground].n_signal : 0;
    }
    return n;
}

int foundation_loads(struct builder *b, const struct model *m, struct load *out) {
    int n = 0;
    for (int i = 0; i < m->n_building; i++) {
        const struct building *g = &m->building[i];
        const struct ground *ground = &m->ground[g->ground];
        for (int k = 0; g->fixed && k < ground->n_signal; k++) {
            const struct signal *s = &ground->signal[k];
            struct load *load = &out[n++];
            const double inertia = g->mass[g->n_dof - 1];
            struct error e;
            *load = (struct load){.dof = g->first + g->n_dof - 1, .signal = *s};
            load->signal.amplitude *= inertia;
            load->signal.peak *= inertia;
            if (s->value && signal_init_samples(&load->signal, b->arena, s->value, s->n, s->dt,
                                                inertia, s->start, &e) != STATUS_OK) {
                deck_error_of(b->deck, NULL, &e);
            }
            load->signal.name = s->name;
        }
    }
    return n;
}

bool foundation_differs(const struct building *g) {
    return g->fixed || g->tangent;
}

void foundation_storeys(const struct building *g, const double *history, const double *drift,
                        const double *shear, double *own_drift, double *own_shear) {
    const struct founded *f = g->fixed ? g->part->data : NULL;
    const struct founded_motion slab = f ? founded_motion(f, drift) : (struct founded_motion){0};
    for (int i = 0; i < g->n_floor; i++) {
        own_drift[i] = f ? founded_deformation(f, i, drift, slab) : drift[i];
        own_shear[i] = shear[i] - (f ? shear[f->n] : tangent_damping_shear(g, history, i));
    }
}

const struct storey *foundation_storey(const struct model *m, const struct building *g, int i) {
    assert(i >= 0 && i < g->n_floor);
    const struct founded *f = g->fixed ? g->part->data : NULL;
    const struct storey *in_part = f ? &f->storey[i] : rate_storeys_of(g, i);
    return in_part ? in_part : &m->storey[g->first + i];
}

struct foundation_row foundation_row(const struct building *g, int i) {
    assert(g->fixed && i >= 0 && i < g->n_floor);
    const struct founded *f = g->part->data;
    const int slab = g->first + f->n;
    return (struct foundation_row){.dof = {g->first + i, i > 0 ? g->first + i - 1 : slab, slab + 1},
                                   .weight = {1.0, -1.0, -f->share[i]}};
}

double foundation_deformation(const struct building *g, int i, int j) {
    assert(g->fixed && i >= 0 && i < g->n_floor && j >= 0 && j < g->n_dof);
    return founded_entry(g->part->data, i, j);
}

double foundation_lean(const struct building *g, int i) {
    assert(g->fixed && i >= 0 && i < g->n_floor);
    return ((const struct founded *)g->part->data)->share[i];
}

double foundation_by_drift(const struct building *g, int q, int j) {
    const double height = level_of_floor(g->height, g->n_floor);
    const double sway = j <= g->n_floor ? 1.0 : 0.0, rocking = 1.0 / height;
    const struct foundation *f = g->foundation;
    return (double[]){sway, rocking, f->sway * sway, f->rocking * rocking}[q];
}

double foundation_drift(const struct model *m, const struct building *g, int dof, const double *x) {
    if (g->fixed && dof < g->first + g->n_floor) {
        const struct foundation_row r = foundation_row(g, dof - g->first);
        return x[r.dof[0]] - x[r.dof[1]] + r.weight[2] * x[r.dof[2]];
    }
    return x[dof] - m->chain.joint[dof] * x[dof - 1];
}

double foundation_across(const struct model *m, int dof, const double *x) {
    const struct building *g = m->building;  // of which none has a foundation, or that of the floor
    while (m->storeys_differ && dof >= g->first + g->n_dof) {
        g++;
    }
    return foundation_drift(m, g, dof, x);
}
