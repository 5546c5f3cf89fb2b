// SPDX-License-Identifier: GPL-3.0-or-later
// Generalised Richardson extrapolation: f(h) = f + c h^p at the steps h, h / r, h / r^2, with the
// values f1, f2, f3 and their differences d1 = f2 - f1, d2 = f3 - f2, gives
//     p = ln(d1 / d2) / ln r,    f = f3 + D,    D = d2 / (r^p - 1),
// where d1 and d2 have the same sign and |d2| < |d1|.
//
// Error bar U of f3: the grid convergence index of Roache (1998), Verification and Validation in
// Computational Science and Engineering, chapter 5, with the factor of safety F = 1.25 for an order
// that has been observed, 3 for one that has not. For other sequences Eca & Hoekstra (2009),
// Computers & Fluids 38, 1580-1591, put a multiple of the range R = max f - min f of the three
// values in its place:
//     orderly     p up to 0.05 above the method's order     U = F |D|
//     fast        p larger: chance has a hand in it         U = 1.25 R
//     irregular   d1 d2 < 0 or |d2| >= |d1|                 U = 3 R
// They limit F |D| by 1.25 R where p < 0.95; we do not, as a low order is not to look good.
#include "study/refinement.h"

#include <math.h>

#include "core/arena.h"

static const double ORDER_SLACK = 0.05;

// Factors of safety (see above). Adaptive levels are halvings of the step in the mean only, and
// errors that are 32 times smaller at order 5 may be 5 or 1000 times smaller: their order is not
// taken for observed.
static const double SAFETY = 1.25, SAFETY_ADAPTIVE = 3.0;
static const double SAFETY_FAST = 1.25, SAFETY_IRREGULAR = 3.0;

// Differences below this share of the value come from rounding, which grows with the number of
// steps.
static const double ROUNDING = 1e-11;

struct convergence refinement_convergence(const double *value, int n, double ratio, double order,
                                          double safety) {
    const double f1 = value[n - 3], f2 = value[n - 2], f3 = value[n - 1];
    const double d1 = f2 - f1, d2 = f3 - f2;
    const double range = fmax(fmax(f1, f2), f3) - fmin(fmin(f1, f2), f3);
    struct convergence c = {.order = NAN, .estimate = f3, .error = range};
    if (range <= ROUNDING * fabs(f3)) {
        c.kind = CONVERGENCE_NONE;
        return c;
    }
    if (!(d1 * d2 > 0.0) || fabs(d2) >= fabs(d1)) {
        c.kind = CONVERGENCE_IRREGULAR;
        c.error = SAFETY_IRREGULAR * range;
        return c;
    }
    c.order = log(d1 / d2) / log(ratio);
    c.kind = c.order <= order + ORDER_SLACK ? CONVERGENCE_ORDERLY : CONVERGENCE_FAST;
    double step = d2 / (pow(ratio, fmin(c.order, order)) - 1.0);
    c.estimate = f3 + step;
    c.error = c.kind == CONVERGENCE_ORDERLY ? safety * fabs(step) : SAFETY_FAST * range;
    return c;
}

struct convergence refinement_convergence_of_count(const double *value, int n) {
    double change = fabs(value[n - 1] - value[n - 2]);
    return (struct convergence){
        .kind = change == 0.0 ? CONVERGENCE_COUNT : CONVERGENCE_MISCOUNT,
        .order = NAN,
        .estimate = value[n - 1],
        .error = change,
    };
}

bool refinement_is_within(const struct convergence *c, double value, double rtol) {
    return c->error <= rtol * fabs(value) && c->kind != CONVERGENCE_MISCOUNT;
}

// The largest value of the floors or storeys of a building in summaries.
static double largest(const struct building *g, const double *value) {
    double most = 0.0;
    for (int i = 0; i < g->n_floor; i++) {
        most = floor_is_summarised(g->isolated, g->n_floor, i) ? fmax(most, value[g->first + i])
                                                               : most;
    }
    return most;
}

static double all_impacts(const struct model *m, const struct results *r, int i) {
    (void)m, (void)i;
    return (double)r->n_impact;
}

static double roof_displacement(const struct model *m, const struct results *r, int i) {
    const struct building *g = &m->building[i];
    return r->peak[PEAK_DISPLACEMENT][g->first + g->n_floor - 1];
}

static double drift(const struct model *m, const struct results *r, int i) {
    return largest(&m->building[i], r->peak[PEAK_DRIFT]);
}

static double acceleration(const struct model *m, const struct results *r, int i) {
    return largest(&m->building[i], r->peak[PEAK_ACCELERATION]);
}

static double base_shear(const struct model *m, const struct results *r, int i) {
    return r->peak[PEAK_SHEAR][m->building[i].first];
}

static double impacts(const struct model *m, const struct results *r, int i) {
    (void)m;
    return (double)r->link[i].impacts;
}

static double force(const struct model *m, const struct results *r, int i) {
    (void)m;
    return r->link[i].force;
}

static double impulse(const struct model *m, const struct results *r, int i) {
    (void)m;
    return r->link[i].impulse;
}

// Which links a measure is of.
enum links { LINKS_ALL, LINKS_UNILATERAL, LINKS_WITH_FORCE };

struct measure {
    enum refined_owner owner;
    const char *quantity;
    const struct dimension *dimension;  // NULL: a count
    double (*value)(const struct model *m, const struct results *r, int i);
    enum links links;
};

static const struct measure measures[] = {
    {OF_MODEL, "impacts", NULL, all_impacts, LINKS_ALL},
    {OF_BUILDING, "roof displacement", &dimension_length, roof_displacement, LINKS_ALL},
    {OF_BUILDING, "storey drift", &dimension_length, drift, LINKS_ALL},
    {OF_BUILDING, "acceleration", &dimension_acceleration, acceleration, LINKS_ALL},
    {OF_BUILDING, "base shear", &dimension_force, base_shear, LINKS_ALL},
    {OF_LINK, "impacts", NULL, impacts, LINKS_UNILATERAL},
    {OF_LINK, "force", &dimension_force, force, LINKS_WITH_FORCE},
    {OF_LINK, "impulse", &dimension_impulse, impulse, LINKS_UNILATERAL},
};
enum { N_MEASURE = sizeof measures / sizeof measures[0] };

// Lists the results of the model, owner by owner. `result` NULL: only counts them.
static int list_results(const struct model *m, struct refined *result,
                        const struct measure **measure) {
    const int n_owner[] = {[OF_MODEL] = 1, [OF_BUILDING] = m->n_building, [OF_LINK] = m->n_link};
    int n = 0;
    for (enum refined_owner owner = OF_MODEL; owner <= OF_LINK; owner++) {
        for (int i = 0; i < n_owner[owner]; i++) {
            for (int k = 0; k < N_MEASURE; k++) {
                const enum links links = measures[k].links;
                if (measures[k].owner != owner ||
                    (links == LINKS_UNILATERAL && m->link[i].bilateral) ||
                    (links == LINKS_WITH_FORCE && m->link[i].law->rebound)) {
                    continue;
                }
                if (result) {
                    measure[n] = &measures[k];
                    result[n] = (struct refined){.owner = owner,
                                                 .index = i,
                                                 .quantity = measures[k].quantity,
                                                 .dimension = measures[k].dimension};
                }
                n++;
            }
        }
    }
    return n;
}

static bool allocate(struct refinement *r, const struct model *m, const struct measure ***measure) {
    const size_t n = (size_t)list_results(m, NULL, NULL), levels = (size_t)r->n_level;
    r->result = arena_alloc(r->arena, n, sizeof *r->result);
    r->step = arena_alloc(r->arena, levels, sizeof *r->step);
    r->steps = arena_alloc(r->arena, levels, sizeof *r->steps);
    *measure = arena_alloc(r->arena, n, sizeof(struct measure *));
    double *value = arena_alloc(r->arena, n * levels, sizeof *value);
    if (!r->result || !r->step || !r->steps || !*measure || !value) {
        return false;
    }
    r->n_result = list_results(m, r->result, *measure);
    for (size_t i = 0; i < n; i++) {
        r->result[i].value = value + i * levels;
    }
    return true;
}

static int run_level(struct refinement *r, const struct model *m, int level,
                     const struct measure *const *measure, const struct observer *observer,
                     struct error *e) {
    const struct model finer = model_refined(m, level);
    struct results *results;
    int status = analysis_run(&finer, observer, &results, e);
    if (status != STATUS_OK) {
        return status;
    }
    r->step[level] = finer.adaptive ? finer.control.tolerance : finer.dt;
    r->steps[level] = results->totals.steps;
    for (int i = 0; i < r->n_result; i++) {
        r->result[i].value[level] = measure[i]->value(&finer, results, r->result[i].index);
    }
    results_free(results);
    return STATUS_OK;
}

// Marks the results that a contact with a changing number of impacts acts on.
static void blame_impacts(struct refinement *r, const struct model *m) {
    for (int i = 0; i < r->n_result; i++) {
        const struct refined *count = &r->result[i];
        if (count->owner != OF_LINK || count->convergence.kind != CONVERGENCE_MISCOUNT) {
            continue;
        }
        const struct link *l = &m->link[count->index];
        for (int j = 0; j < r->n_result; j++) {
            struct refined *f = &r->result[j];
            bool of_building = f->owner == OF_BUILDING &&
                               (f->index == l->building[0] || f->index == l->building[1]);
            f->impacts_change |= of_building || (f->owner == OF_LINK && f->index == count->index);
        }
    }
}

int refinement_run(const struct model *m, int n_level, double rtol, const struct observer *observer,
                   struct refinement **out, struct error *e) {
    struct arena *a = arena_create();
    struct refinement *r = a ? arena_alloc(a, 1, sizeof *r) : NULL;
    if (!r) {
        arena_free(a);
        return error_no_memory(e);
    }
    *r = (struct refinement){.arena = a, .n_level = n_level};
    const struct measure **measure;
    int status = allocate(r, m, &measure) ? STATUS_OK : error_no_memory(e);
    for (int level = 0; level < n_level && status == STATUS_OK; level++) {
        status = run_level(r, m, level, measure, observer, e);
    }
    if (status != STATUS_OK) {
        arena_free(a);
        return status;
    }
    const double order = model_order(m), safety = m->adaptive ? SAFETY_ADAPTIVE : SAFETY;
    for (int i = 0; i < r->n_result; i++) {
        struct refined *f = &r->result[i];
        f->convergence = f->dimension
                             ? refinement_convergence(f->value, n_level, 2.0, order, safety)
                             : refinement_convergence_of_count(f->value, n_level);
        f->within = refinement_is_within(&f->convergence, f->value[n_level - 1], rtol);
        r->n_within += f->within;
    }
    blame_impacts(r, m);
    *out = r;
    return STATUS_OK;
}

void refinement_free(struct refinement *r) {
    if (r) {
        arena_free(r->arena);
    }
}
