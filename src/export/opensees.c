// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes are at one place, so that materials of no length join any two of them; only joints of
// frames have their places. P-delta is a spring of the stiffness -P/h, beside the storey.
#include "export/opensees.h"

#include <assert.h>
#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "core/arena.h"
#include "core/safe.h"
#include "core/text.h"
#include "model/foundation.h"
#include "model/frame.h"
#include "model/parts.h"
#include "model/tangent_damping.h"

// Entries of a matrix this small, relative to its largest one, are rounding.
static const double ROUNDING = 1e-12;

void opensees_note(struct opensees *x, const char *format, ...) {
    char line[500];
    va_list list;
    va_start(list, format);
    (void)text_compose(line, sizeof line, format, list);
    va_end(list);
    emit_note(&x->to, "note: %s", line);
    if (x->notes) {
        safe_line(x->notes, "note: %s", line);
    }
}

int opensees_node(struct opensees *x, double at_x, double at_y, int hold_1, int hold_2,
                  int hold_3) {
    emit_put(&x->to, "node", "inn", ++x->node, at_x, at_y);
    if (hold_1 || hold_2 || hold_3) {
        emit_put(&x->to, "fix", "iiii", x->node, hold_1, hold_2, hold_3);
    }
    return x->node;
}

int opensees_dof(const struct opensees *x, int dof) {
    return dof == WALL ? x->m->n_dof + 1 : dof + 1;
}

void opensees_spring(struct opensees *x, int left, int right, int material, int direction,
                     bool damped) {
    const char *form = damped ? "wiiiwiwiwi" : "wiiiwiwi";
    emit_put(&x->to, "element", form, "zeroLength", ++x->element, left, right, "-mat", material,
             "-dir", direction, "-doRayleigh", 1);
}

void opensees_elastic(struct opensees *x, int left, int right, double k, double c, bool damped) {
    if (k != 0.0 || c != 0.0) {
        emit_put(&x->to, "uniaxialMaterial", "winn", "Elastic", ++x->material, k, c);
        opensees_spring(x, left, right, x->material, OPENSEES_SWAY, damped);
    }
}

static double opensees_entry(const double *a, int n, int i, int j) {
    return a ? a[(size_t)i * (size_t)n + (size_t)j] : 0.0;
}

// The sum of a row, which a spring to the ground has; 0 where it is rounding.
static double opensees_rest(const double *a, int n, int i) {
    double sum = 0.0, size = 0.0;
    for (int j = 0; j < n; j++) {
        sum += opensees_entry(a, n, i, j);
        size += fabs(opensees_entry(a, n, i, j));
    }
    return fabs(sum) > ROUNDING * size ? sum : 0.0;
}

void opensees_matrix(struct opensees *x, int n, const int *node, const double *k, const double *c,
                     bool damped) {
    const int ground = opensees_dof(x, WALL);
    for (int i = 0; i < n; i++) {
        opensees_elastic(x, ground, node[i], opensees_rest(k, n, i), opensees_rest(c, n, i),
                         damped);
        for (int j = i + 1; j < n; j++) {
            opensees_elastic(x, node[i], node[j], 0.0 - opensees_entry(k, n, i, j),
                             0.0 - opensees_entry(c, n, i, j), damped);
        }
    }
}

void opensees_row(struct opensees *x, int n, const int *node, const double *b, double k, double c) {
    double stiffness[OPENSEES_ROW_MAX * OPENSEES_ROW_MAX];
    double dashpot[OPENSEES_ROW_MAX * OPENSEES_ROW_MAX];
    assert(n <= OPENSEES_ROW_MAX);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) {
            stiffness[i * n + j] = k * b[i] * b[j];
            dashpot[i * n + j] = c * b[i] * b[j];
        }
    }
    opensees_matrix(x, n, node, stiffness, dashpot, false);
}

// The nodes of a building's degrees of freedom; NULL: no memory.
static int *opensees_nodes(struct opensees *x, const struct building *g) {
    int *node = arena_alloc(x->arena, (size_t)g->n_dof, sizeof *node);
    for (int i = 0; node && i < g->n_dof; i++) {
        node[i] = opensees_dof(x, g->first + i);
    }
    return node;
}

// The node that storey i (from 0) of a building without a foundation stands on.
static int opensees_below(const struct opensees *x, const struct building *g, int i) {
    return opensees_dof(x, i > 0 ? g->first + i - 1 : WALL);
}

// A storey without a foundation: its law, and what P-delta takes off it.
static void opensees_storey(struct opensees *x, const struct building *g, int i) {
    const struct storey *s = foundation_storey(x->m, g, i);
    const int below = opensees_below(x, g, i), floor = opensees_dof(x, g->first + i);
    const double pdelta = g->pdelta ? g->pdelta[i] : 0.0;
    if (s->law->n_history > 0) {
        const int material = material_storey(x, s->law, s->constant, g->name, g);
        opensees_spring(x, below, floor, material, OPENSEES_SWAY, true);
    } else {
        opensees_elastic(x, below, floor, g->spring[i] + pdelta, 0.0, true);
    }
    opensees_elastic(x, below, floor, -pdelta, 0.0, false);
}

// A storey with a law on a foundation deforms by v_i - (v_below + r_i phi). A node without a mass
// follows what is in the brackets.
static void opensees_founded_storey(struct opensees *x, const struct building *g, int i) {
    const struct storey *s = foundation_storey(x->m, g, i);
    if (s->law->n_history == 0) {
        return;  // in the matrix
    }
    const struct foundation_row r = foundation_row(g, i);
    const int foot = opensees_node(x, 0.0, 0.0, 0, 1, 1);
    const int node[] = {foot, opensees_dof(x, r.dof[1]), opensees_dof(x, r.dof[2])};
    const double b[] = {1.0, r.weight[1], r.weight[2]};
    opensees_row(x, 3, node, b, OPENSEES_STIFF * g->fixed->stiffness[i], 0.0);
    opensees_spring(x, foot, opensees_dof(x, r.dof[0]),
                    material_storey(x, s->law, s->constant, g->name, g), OPENSEES_SWAY, false);
}

// A linear part as a matrix on floor displacements.
static void opensees_part(struct opensees *x, const struct building *g, const struct part *p) {
    const struct plane_frame *f = frame_of(p);
    const size_t n = (size_t)g->n_dof;
    if (f) {
        opensees_frame(x, g, f);
        return;
    }
    double *k = p->stiffness ? arena_alloc(x->arena, n * n, sizeof *k) : NULL;
    int *node = opensees_nodes(x, g);
    for (int i = 0; k && i < g->n_dof * g->n_dof; i++) {
        k[i] = parts_on_floors(p->stiffness, g->n_dof, i / g->n_dof, i % g->n_dof);
    }
    if (k && node) {
        opensees_matrix(x, g->n_dof, node, k, NULL, true);
    }
}

// The initial stiffness and the damping matrix of a building on its floors, without P-delta and
// without alpha M. False: no memory.
static bool opensees_matrices(struct opensees *x, const struct building *g, double **k,
                              double **c) {
    const size_t n = (size_t)g->n_dof;
    *k = arena_alloc(x->arena, n * n, sizeof **k);
    *c = arena_alloc(x->arena, n * n, sizeof **c);
    double *unit = arena_alloc(x->arena, n, sizeof *unit);
    double *force = arena_alloc(x->arena, n, sizeof *force);
    double *drift = arena_alloc(x->arena, n * n, sizeof *drift);
    if (!*k || !*c || !unit || !force || !drift) {
        return false;
    }
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < n; j++) {
            drift[i * n + j] = g->part_stiffness ? g->part_stiffness[i * n + j] : 0.0;
        }
        drift[i * n + i] += g->spring[i] + (g->pdelta && !g->fixed ? g->pdelta[i] : 0.0);
    }
    for (size_t j = 0; j < n; j++) {
        unit[j] = 1.0;
        building_damping_force(g, unit, force);
        unit[j] = 0.0;
        for (size_t i = 0; i < n; i++) {
            (*k)[i * n + j] = parts_on_floors(drift, g->n_dof, (int)i, (int)j);
            (*c)[i * n + j] = force[i];
        }
        (*c)[j * n + j] -= g->fixed ? 0.0 : g->damping_alpha * g->mass[j];
    }
    return true;
}

// The beta by which c = beta k; NAN: there is none.
static double opensees_beta(int n, const double *k, const double *c) {
    double size_k = 0.0, size_c = 0.0, beta = 0.0;
    for (int i = 0; i < n * n; i++) {
        beta = fabs(k[i]) > size_k ? c[i] / k[i] : beta;
        size_k = fmax(size_k, fabs(k[i]));
        size_c = fmax(size_c, fabs(c[i]));
    }
    for (int i = 0; i < n * n; i++) {
        if (!(fabs(c[i] - beta * k[i]) <= ROUNDING * size_c)) {
            return (double)NAN;
        }
    }
    return beta;
}

// Is the matrix of the building another one than the sum of its elements at the first step? Then
// beta on the elements is not beta on the matrix.
static bool opensees_is_condensed(const struct building *g) {
    return g->fixed || g->n_hinge > 0;
}

// The beta of damping on the tangent stiffness; 0: none.
static double opensees_tangent_beta(struct opensees *x, const struct building *g) {
    const struct tangent_damping *t = g->tangent;
    const int n = t ? t->n : 0;
    for (int i = 0; i < n * n; i++) {
        if (t->beta[i] != t->beta[0]) {
            opensees_note(x,
                          "building %s: its damping on the tangent stiffness is that of its "
                          "first storey in all storeys",
                          g->name);
            break;
        }
    }
    return t ? t->beta[0] : 0.0;
}

static void opensees_damping(struct opensees *x, const struct building *g) {
    double *k, *c;
    const int *node = opensees_nodes(x, g);
    if (!opensees_matrices(x, g, &k, &c) || !node) {
        return;
    }
    const double alpha = g->fixed ? 0.0 : g->damping_alpha;
    double beta = opensees_beta(g->n_dof, k, c);
    beta = beta != 0.0 && opensees_is_condensed(g) ? (double)NAN : beta;
    if (isnan(beta)) {
        beta = 0.0;
        emit_note(&x->to, "damping matrix of %s%s", g->name,
                  alpha != 0.0 ? ", without the part of its masses" : "");
        opensees_matrix(x, g->n_dof, node, NULL, c, false);
    }
    const double tangent = opensees_tangent_beta(x, g);
    if (alpha == 0.0 && beta == 0.0 && tangent == 0.0) {
        return;
    }
    int place = 0;
    emit_note(&x->to, "Rayleigh damping of %s", g->name);
    emit_begin(&x->to, "region");
    emit_whole(&x->to, place++, ++x->region);
    emit_word(&x->to, place++, "-node");
    emit_whole(&x->to, place++, opensees_dof(x, WALL));
    for (int i = 0; i < g->n_dof; i++) {
        emit_whole(&x->to, place++, opensees_dof(x, g->first + i));
    }
    for (int made = x->first_node; made <= x->node; made++) {
        emit_whole(&x->to, place++, made);
    }
    emit_word(&x->to, place++, "-rayleigh");
    const double value[] = {alpha, 0.0, beta, tangent};
    for (int i = 0; i < 4; i++) {
        emit_number(&x->to, place++, value[i]);
    }
    emit_end(&x->to);
}

void opensees_building(struct opensees *x, const struct building *g) {
    x->first_node = x->node + 1;
    emit_note(&x->to, "%s: %d floor%s, nodes %d to %d%s", g->name, g->n_floor,
              g->n_floor == 1 ? "" : "s", opensees_dof(x, g->first),
              opensees_dof(x, g->first + g->n_dof - 1),
              g->fixed ? "; the last two are the sway of the foundation, and the displacement of "
                         "the roof by rocking"
                       : "");
    for (int i = 0; i < g->n_dof; i++) {
        emit_put(&x->to, "node", "inn", opensees_dof(x, g->first + i), 0.0, 0.0);
        emit_put(&x->to, "fix", "iiii", opensees_dof(x, g->first + i), 0, 1, 1);
        emit_put(&x->to, "mass", "innn", opensees_dof(x, g->first + i), g->mass[i], 0.0, 0.0);
    }
    for (int i = 0; i < g->n_floor; i++) {
        (g->fixed ? opensees_founded_storey : opensees_storey)(x, g, i);
    }
    for (int i = 0; i < g->n_part; i++) {
        opensees_part(x, g, &g->part[i]);
    }
    opensees_damping(x, g);
}
