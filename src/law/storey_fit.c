// SPDX-License-Identifier: GPL-3.0-or-later
// The unknowns are the logarithms of positive parameters, those of (p - min) / (max - p) where a
// parameter has two limits, and others over the size of their start value. The sum of squares has
// several minima, as a storey changes its lines: the search starts from the best of many random
// points, and from the next best ones. The random numbers are always the same.
#include "law/storey_fit.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "law/least_squares.h"

enum { TRIALS = 6000, SMOOTH_TRIALS = 600, TRIAL_SAMPLES = 30000000, SEARCHES = 8 };
enum { LINEAR, LOGARITHM, LOGISTIC };

struct unknown {
    int row;
    int scale;  // LINEAR and so on
    double min, max;
    double start;
};

struct fit {
    const struct storey_fit_request *q;
    struct unknown unknown[LEAST_SQUARES_UNKNOWNS];
    double value[LOOP_ROWS_MAX];
    double stiffness;
    double largest_drift, largest_shear;
    struct least_squares squares;
    unsigned seed;
};

// The parameter of an unknown, and its derivative with respect to it.
static double parameter(const struct unknown *u, double x, double *slope) {
    const double away = x - least_squares_origin;
    if (u->scale == LOGARITHM) {
        return *slope = u->start * exp(away);
    }
    if (u->scale == LOGISTIC) {
        const double odds = (u->start - u->min) / (u->max - u->start) * exp(away);
        const double width = u->max - u->min;
        *slope = width * odds / ((1.0 + odds) * (1.0 + odds));
        return u->min + width * (odds / (1.0 + odds));
    }
    *slope = fmax(fabs(u->start), 1e-3);
    return u->start + away * *slope;
}

static void put(struct fit *f, int u, double value) {
    const int row = f->unknown[u].row;
    *(row == STOREY_FIT_STIFFNESS ? &f->stiffness : &f->value[row]) = value;
}

// The shears with the present parameters; 0 where these contradict each other.
static void shears(struct fit *f, double *shear) {
    const struct storey_fit_request *q = f->q;
    double constant[LOOP_CONSTANTS_MAX];
    struct error e;
    const struct storey_path path = {
        .law = q->law, .constant = constant, .target = q->drift, .n_target = q->n};
    if (storey_loop_prepare(q->law, f->value, f->stiffness, constant, &e) == STATUS_OK) {
        storey_loop_shears(&path, shear);
    } else {
        memset(shear, 0, q->n * sizeof *shear);
    }
}

static void predict(void *context, const double *x, double *shear) {
    struct fit *f = context;
    for (int u = 0; u < f->squares.n_unknown; u++) {
        double slope;
        put(f, u, parameter(&f->unknown[u], x[u], &slope));
    }
    shears(f, shear);
}

// A random number from 0 to 1.
static double draw(struct fit *f) {
    f->seed = f->seed * 1664525u + 1013904223u;
    return (double)f->seed / 4294967296.0;
}

// The slope of the first loading, up to a fifth of the largest drift; NAN: the law is slack there.
static double first_slope(const struct storey_fit_request *q, double largest) {
    double product = 0.0, square = 0.0;
    for (size_t i = 0; i < q->n && fabs(q->drift[i]) <= 0.2 * largest; i++) {
        product += q->drift[i] * q->shear[i];
        square += q->drift[i] * q->drift[i];
    }
    return product > 0.0 ? product / square : NAN;
}

static struct unknown unknown_of(int row, const struct loop_law *law) {
    static const struct row stiffness = {.range = &range_positive};
    const struct row *r = row == STOREY_FIT_STIFFNESS ? &stiffness : &law->row[row];
    const double min = r->range ? r->range->min : -INFINITY;
    const double max = r->range ? r->range->max : INFINITY;
    const bool both = isfinite(min) && isfinite(max);
    return (struct unknown){row, both ? LOGISTIC : min == 0.0 ? LOGARITHM : LINEAR, min, max, NAN};
}

// A random start of one unknown. Shears and drifts lie below the largest ones, other numbers around
// their usual values.
static double draw_start(struct fit *f, const struct unknown *u) {
    const double r = draw(f);
    if (u->row == STOREY_FIT_STIFFNESS) {
        return fmax(first_slope(f->q, f->largest_drift), f->largest_shear / f->largest_drift) *
               exp(2.0 * r - 0.7);
    }
    const struct row *row = &f->q->law->row[u->row];
    if (dimension_equal(row->dimension, dimension_force)) {
        return f->largest_shear * (0.1 + r);
    }
    if (dimension_equal(row->dimension, dimension_length)) {
        return f->largest_drift * (0.02 + r);
    }
    const double given = f->q->value[u->row];
    const double known = given != 0.0 && !isnan(given) ? given : row->fallback;
    const bool is_known = known != 0.0 && !isnan(known);
    if (u->scale == LOGARITHM && !is_known) {
        return exp(12.0 * (r - 0.4));  // 0.01 to 1300
    }
    const double usual = is_known ? known : u->max <= 0.0 ? -0.1 : 0.05;
    const double at = usual * exp(3.0 * (r - 0.5));
    if (u->scale != LOGISTIC) {
        return at;
    }
    const bool within = at > u->min && at < u->max;
    return within ? at : u->min + (u->max - u->min) * (0.02 + 0.96 * r);
}

static double squares(struct fit *f, double *shear) {
    double sum = 0.0;
    shears(f, shear);
    for (size_t i = 0; i < f->q->n; i++) {
        const double residual = shear[i] - f->q->shear[i];
        sum += residual * residual;
    }
    return sum;
}

struct start {
    double sum;
    double value[LEAST_SQUARES_UNKNOWNS];
};

// The best of random starts, the very best first.
static void find_starts(struct fit *f, double *shear, struct start best[SEARCHES]) {
    for (int k = 0; k < SEARCHES; k++) {
        best[k].sum = INFINITY;
    }
    const size_t usual = f->q->law->straight ? TRIALS : SMOOTH_TRIALS;
    const size_t most = TRIAL_SAMPLES / f->q->n + SEARCHES;
    for (size_t t = 0; t < (most < usual ? most : usual); t++) {
        struct start s;
        for (int u = 0; u < f->squares.n_unknown; u++) {
            s.value[u] = draw_start(f, &f->unknown[u]);
            put(f, u, s.value[u]);
        }
        s.sum = squares(f, shear);
        for (int k = 0; k < SEARCHES; k++) {
            if (s.sum < best[k].sum) {
                const struct start worse = best[k];
                best[k] = s;
                s = worse;
            }
        }
    }
}

static int search_all(struct fit *f, const struct start best[SEARCHES],
                      struct storey_fit_result *out, struct error *e) {
    int status = STATUS_FAILED;
    out->normalised_error = INFINITY;
    for (int k = 0; k < SEARCHES && isfinite(best[k].sum); k++) {
        for (int u = 0; u < f->squares.n_unknown; u++) {
            f->unknown[u].start = best[k].value[u];
        }
        struct least_squares_result r;
        const int one = least_squares_search(&f->squares, &r, e);
        status = status == STATUS_OK ? status : one;
        if (one != STATUS_OK || !(r.normalised_error < out->normalised_error)) {
            continue;
        }
        out->normalised_error = r.normalised_error;
        for (int u = 0; u < f->squares.n_unknown; u++) {
            double slope;
            put(f, u, parameter(&f->unknown[u], r.x[u], &slope));
            out->error[u] = r.error[u] * slope;
        }
        memcpy(out->value, f->value, sizeof out->value);
        out->stiffness = f->stiffness;
    }
    return status;
}

static int check(struct fit *f, struct error *e) {
    const struct storey_fit_request *q = f->q;
    const size_t least = 3 * (size_t)q->n_row;
    if (q->n < least) {
        return error_set(e, STATUS_INPUT, "the loop has %zu samples; %d parameters need %zu", q->n,
                         q->n_row, least);
    }
    for (size_t i = 0; i < q->n; i++) {
        f->largest_drift = fmax(f->largest_drift, fabs(q->drift[i]));
        f->largest_shear = fmax(f->largest_shear, fabs(q->shear[i]));
    }
    if (f->largest_drift == 0.0 || f->largest_shear == 0.0 ||
        (!q->law->link.name && isnan(first_slope(q, f->largest_drift)))) {
        return error_set(e, STATUS_INPUT,
                         "the loop does not begin at rest with a shear in the direction of the "
                         "drift");
    }
    return STATUS_OK;
}

int storey_fit_run(const struct storey_fit_request *request, struct storey_fit_result *out,
                   struct error *e) {
    assert(request->n_row > 0 && request->n_row <= LEAST_SQUARES_UNKNOWNS);
    struct fit f = {.q = request, .stiffness = request->stiffness, .seed = 1};
    memcpy(f.value, request->value, (size_t)request->law->n_row * sizeof *f.value);
    for (int u = 0; u < request->n_row; u++) {
        f.unknown[u] = unknown_of(request->row[u], request->law);
    }
    int status = check(&f, e);
    if (status != STATUS_OK) {
        return status;
    }
    f.squares = (struct least_squares){.name = request->law->name,
                                       .n = request->n,
                                       .n_unknown = request->n_row,
                                       .measured = request->shear,
                                       .scale = f.largest_shear,
                                       .predict = predict,
                                       .context = &f};
    double *shear = calloc(request->n, sizeof *shear);
    status = shear ? least_squares_open(&f.squares, e) : error_no_memory(e);
    if (status == STATUS_OK) {
        struct start best[SEARCHES];
        find_starts(&f, shear, best);
        status = search_all(&f, best, out, e);
    }
    least_squares_close(&f.squares);
    free(shear);
    return status;
}
