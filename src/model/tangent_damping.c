// SPDX-License-Identifier: GPL-3.0-or-later
// S_i = sum over j of beta_ij K_ij r_j, with the drift rates r and the tangent stiffness K on
// drifts at the end of the last step. Where the tangent of a shear storey, or an eigenvalue of the
// tangent with parts, is negative, 0 takes its place. The history has K less the initial stiffness,
// which is 0 at first, and what the account needs: the work of the S over a step is the mean of
// their values at both ends times the drifts.
#include "model/tangent_damping.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "core/definite.h"
#include "model/parts.h"

// History: BEGUN is 1 once a state is committed; then the shears (n), the drifts (n), and the
// change of K: (n) where it is diagonal, else (n, n).
enum { BEGUN, WORK, N_VALUE };

static int tangent_damping_width(const struct tangent_damping *t) {
    return t->diagonal ? 1 : t->n;
}

static int tangent_damping_change(const struct tangent_damping *t) {
    return N_VALUE + 2 * t->n;
}

// Entry (i, j) of C, from the change of K.
static double tangent_damping_entry(const struct tangent_damping *t, const double *change, int i,
                                    int j) {
    const int at = i * t->n + j;
    return t->beta[at] * (t->initial[at] + change[t->diagonal ? i : at]);
}

// Commits shears, drifts and work.
static void tangent_damping_work(const struct tangent_damping *t, const double *history, int i,
                                 double shear, double drift, double *after) {
    const double before = history[N_VALUE + i], from = history[N_VALUE + t->n + i];
    after[WORK] += history[BEGUN] != 0.0 ? (before + shear) / 2.0 * (drift - from) : 0.0;
    after[N_VALUE + i] = shear;
    after[N_VALUE + t->n + i] = drift;
}

static double tangent_damping_storey(const struct tangent_damping *t, int i, const double *all,
                                     double drift) {
    const struct storey *s = &t->storey[i];
    return s->law->n_history == 0
               ? t->spring[i]
               : fmax(s->law->respond(s->constant, all + s->history, drift, NULL).tangent, 0.0);
}

// Commits the change of K, from the histories `all` of the storeys and parts.
static void tangent_damping_stiffness(const struct tangent_damping *t, const double *all,
                                      const double *drift, const double *rate, double *change,
                                      double *scratch) {
    const int n = t->n, width = tangent_damping_width(t);
    const struct part_sums sums = {.diagonal = t->diagonal, .by_drift = change, .scratch = scratch};
    memset(change, 0, (size_t)n * (size_t)width * sizeof *change);
    for (int k = 0; k < t->n_part; k++) {
        const struct part *p = &t->part[k];
        p->kind->respond(p, all + p->history, drift, rate, &sums, NULL);
    }
    for (int i = 0; i < n; i++) {
        change[parts_diagonal(&sums, n, i)] += tangent_damping_storey(t, i, all, drift[i]);
    }
    if (!t->diagonal) {
        definite_clip(change, n, scratch);
    }
    for (int i = 0; i < n; i++) {
        const int first = t->diagonal ? i : 0;
        for (int j = first; j < first + width; j++) {
            change[t->diagonal ? i : i * n + j] -= t->initial[i * n + j];
        }
    }
}

static void tangent_damping_respond(const struct part *p, const double *history,
                                    const double *drift, const double *rate,
                                    const struct part_sums *to, double *after) {
    const struct tangent_damping *t = p->data;
    const double *change = history + tangent_damping_change(t);
    if (after) {
        after[WORK] = history[WORK];
    }
    for (int i = 0; i < t->n; i++) {
        const int first = t->diagonal ? i : 0;
        double shear = 0.0;
        for (int j = first; j < first + tangent_damping_width(t); j++) {
            const double entry = tangent_damping_entry(t, change, i, j);
            shear += entry * rate[j];
            if (to->by_rate) {
                to->by_rate[to->diagonal ? i : i * t->n + j] += entry;
            }
        }
        if (to->shear) {
            to->shear[i] += shear;
        }
        if (after) {
            tangent_damping_work(t, history, i, shear, drift[i], after);
        }
    }
    if (after) {
        after[BEGUN] = 1.0;
        tangent_damping_stiffness(t, history - p->history, drift, rate,
                                  after + tangent_damping_change(t), to->scratch);
    }
}

static double tangent_damping_stored(const struct part *p, const double *history,
                                     const double *drift) {
    (void)p, (void)history, (void)drift;
    return 0.0;
}

static double tangent_damping_damped(const struct part *p, const double *history) {
    (void)p;
    return history[WORK];
}

static const struct part_kind tangent_damping = {
    .name = "tangent-damping",
    .traits = PART_SHARELESS | PART_DIAGONAL,
    .respond = tangent_damping_respond,
    .stored = tangent_damping_stored,
    .damped = tangent_damping_damped,
};

bool tangent_damping_matters(const struct building_draft *d, const struct building *g) {
    bool changes = false;
    for (int i = 0; i < d->n_floor; i++) {
        changes |= d->storey[i].law && d->storey[i].law->n_history > 0;
    }
    for (int i = 0; i < g->n_part; i++) {
        changes |= !(g->part[i].kind->traits & PART_LINEAR);
    }
    return changes;
}

struct tangent_damping *tangent_damping_create(struct arena *a, const struct building *g) {
    const size_t n = (size_t)g->n_dof;
    struct tangent_damping *t = arena_alloc(a, 1, sizeof *t);
    double *beta = arena_alloc(a, n * n, sizeof *beta);
    double *initial = arena_alloc(a, n * n, sizeof *initial);
    if (!t || !beta || !initial) {
        return NULL;
    }
    for (size_t i = 0; i < n; i++) {
        initial[i * n + i] = g->spring[i];
        for (size_t j = 0; g->n_part > 0 && j < n; j++) {
            initial[i * n + j] += g->part_stiffness[i * n + j];
        }
    }
    *t = (struct tangent_damping){
        .n = g->n_dof, .beta = beta, .initial = initial, .spring = g->spring};
    return t;
}

// Adds beta_ij K_ij to the dashpots of the parts, and zeros for their stiffness if there are none.
static bool tangent_damping_sum(struct arena *a, struct building *g) {
    const size_t n = (size_t)g->n_dof, square = n * n;
    double *dashpot = arena_alloc(a, square, sizeof *dashpot);
    for (size_t i = 0; dashpot && i < square; i++) {
        dashpot[i] = g->tangent->beta[i] * g->tangent->initial[i] +
                     (g->part_dashpot ? g->part_dashpot[i] : 0.0);
    }
    g->part_dashpot = dashpot;
    g->part_stiffness =
        g->part_stiffness ? g->part_stiffness : arena_alloc(a, square, sizeof *dashpot);
    return dashpot && g->part_stiffness;
}

void tangent_damping_put(struct builder *b, struct building_draft *d, struct building *g,
                         const struct storey *storey, int *n_history) {
    struct tangent_damping *t = g->tangent;
    t->storey = storey;
    t->n_part = g->n_part;
    t->diagonal = parts_are_diagonal(g);
    const size_t width = (size_t)tangent_damping_width(t);
    builder_add_part(b, d,
                     &(struct part){.kind = &tangent_damping,
                                    .n = t->n,
                                    .data = t,
                                    .n_history = tangent_damping_change(t) + t->n * (int)width,
                                    .n_scratch = t->n_part > 0 ? 2 * t->n * t->n : 0});
    struct part *part = d->parts.item;
    if (!tangent_damping_sum(b->arena, g) || d->parts.n == g->n_part) {
        return;
    }
    part[g->n_part].history = *n_history;
    *n_history += part[g->n_part].n_history;
    t->part = part;
    g->part = part;
    g->n_part = d->parts.n;
}

double tangent_damping_shear(const struct building *g, const double *history, int i) {
    assert(g->tangent && i >= 0 && i < g->tangent->n);
    return history[g->part[g->tangent->n_part].history + N_VALUE + i];
}
