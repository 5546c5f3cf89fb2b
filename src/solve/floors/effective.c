// SPDX-License-Identifier: GPL-3.0-or-later
// The tridiagonal case is L D L^T from the ground up (Golub & Van Loan, Matrix Computations,
// section 4.3.6), with the reciprocal pivots stored, so that a solve has no division. The full case
// stores the inverse, which costs n^2 per solve like a pair of triangular solves but has no chain
// of dependences. So do low buildings where the factorisation is used for long: there a product in
// lanes takes less time than the chain. An elastic building gets its inverse at once, so that the
// arithmetic of a step depends on its size alone; one that yields gets it row by row, with the
// first solves. One with smooth storeys is factorised in every step, which is too often for that.
#include "solve/floors/effective.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "core/lanes.h"
#include "model/parts.h"
#include "solve/floors/floor_terms.h"
#include "solve/floors/floor_vectors.h"

static const struct fields_row list[] = {
    FIELD_VALUES(struct effective, b, g),
    FIELD_ARRAY(struct effective, tangent, FIELD_BUILDING_TANGENTS),
    FIELD_ARRAY(struct effective, ready, FIELD_BUILDING_FLOORS),
};
const struct fields effective_fields = FIELDS(list);

// A square of `stride` for a matrix (n, n), with zeros behind; NULL: there is none.
static double *padded(const double *matrix, int n, int stride, struct arena *a) {
    double *x = matrix ? lanes_array(a, stride * stride) : NULL;
    for (int i = 0; x && i < n; i++) {
        memcpy(x + (size_t)i * (size_t)stride, matrix + (size_t)i * (size_t)n,
               (size_t)n * sizeof *x);
    }
    return x;
}

static void alloc_one(struct effective *e, const struct building *building, enum effective_use use,
                      struct arena *a) {
    size_t n = (size_t)building->n_dof;
    e->building = building;
    e->use = building->damping_full ? EFFECTIVE_LONG : building->smooth ? EFFECTIVE_BRIEFLY : use;
    e->b = e->g = NAN;
    e->tangent = arena_alloc(a, (size_t)building_n_tangent(building), sizeof *e->tangent);
    e->stride = lanes_whole(building->n_dof);
    e->inverse = lanes_array(a, e->stride * e->stride);
    e->damping = padded(building->damping_full, building->n_dof, e->stride, a);
    e->parts = e->damping ? padded(building->part_stiffness, building->n_dof, e->stride, a) : NULL;
    e->ready = arena_alloc(a, n, sizeof *e->ready);
    e->reach = arena_alloc(a, n, sizeof *e->reach);
    if (e->tangent) {
        memcpy(e->tangent, building->spring, n * sizeof *e->tangent);
        parts_initial(building, e->tangent + n);
    }
}

// Fewer buildings than this are faster one after the other, low ones by their inverse.
enum { ABREAST_LEAST = 3, ABREAST_LEAST_LOW = 6 };

// Are n buildings of one height solved together? Never those of models of few floors, which
// floor_steps.h solves by their inverses.
static bool are_together(const struct effective *e, int n) {
    const int floors = e->building->n_dof;
    const bool inverts = e->use == EFFECTIVE_LONG && floors <= INVERSE_FLOORS_MAX;
    bool together = n >= ABREAST_LEAST;
    if (inverts) {
        together = n >= ABREAST_LEAST_LOW && n * floors > INVERSE_FLOORS_MAX;
    }
    for (int k = 0; k < n; k++) {
        together = together && !e[k].building->damping_full;
    }
    return together;
}

// The factors of n buildings of one height, with zeros behind those of the last floor.
static void alloc_factors(struct effective *e, int n, struct arena *a) {
    const size_t floors = (size_t)lanes_whole(e->building->n_dof);
    const size_t line = EFFECTIVE_ABREAST * sizeof(double);
    const bool together = are_together(e, n);
    for (int k = 0; k < n && !arena_failed(a); k++) {
        const bool shares = k > 0 && together;
        e[k].pivot = shares ? e->pivot + k : lanes_lines(a, floors, line);
        e[k].factor = shares ? e->factor + k : lanes_lines(a, floors, line);
        e[k].between = shares ? e->between : together ? lanes_lines(a, floors, line) : NULL;
    }
    e->abreast = together ? n : 0;
}

int effective_alike(const struct building *building, int n) {
    int k = 1;
    while (k < n && k < EFFECTIVE_ABREAST && building[k].n_dof == building->n_dof) {
        k++;
    }
    return k;
}

bool effective_alloc(struct effective *e, const struct building *building, int n,
                     enum effective_use use, struct arena *a) {
    for (int k = 0; k < n; k++) {
        alloc_one(&e[k], &building[k], use, a);
    }
    for (int k = 0, alike; k < n; k += alike) {
        alike = effective_alike(&building[k], n - k);
        alloc_factors(&e[k], alike, a);
    }
    return !arena_failed(a);
}

// Diagonal entry i of M + b K; the entry to its right is -b tangent[i + 1].
static double diagonal(const struct effective *e, double b, int i) {
    double above = i + 1 < e->building->n_dof ? e->tangent[i + 1] : 0.0;
    return e->building->mass[i] + b * (e->tangent[i] + above);
}

static double right_of(const struct effective *e, double b, int i) {
    return i + 1 < e->building->n_dof ? -b * e->tangent[i + 1] : 0.0;
}

// b times the tangent of the parts by the drift of storey i, and g times that by its rate, where
// they couple no storeys.
static double of_diagonal_parts(const struct effective *e, double b, double g, int i) {
    const int n = e->building->n_dof;
    return i < n ? b * e->tangent[n + i] + g * e->tangent[2 * n + i] : 0.0;
}

// Most buildings have no parts: for these, the compiler makes a loop without them.
LANES_INLINE int factor_chain(struct effective *e, double b, double g, bool with_parts) {
    const struct building *building = e->building;
    double carried = 0.0, own = with_parts ? of_diagonal_parts(e, b, g, 0) : 0.0;
    for (int i = 0; i < building->n_dof; i++) {
        double d = diagonal(e, b, i) + g * building->damping_diagonal[i];
        double off = right_of(e, b, i) + g * building->damping_off[i];
        if (with_parts) {
            const double above = of_diagonal_parts(e, b, g, i + 1);
            d += own + above;
            off -= above;
            own = above;
        }
        d -= carried;
        if (!(d > 0.0)) {
            return STATUS_RETRY;
        }
        double pivot = 1.0 / d, factor = off * pivot;
        e->pivot[(ptrdiff_t)i * EFFECTIVE_ABREAST] = pivot;
        e->factor[(ptrdiff_t)i * EFFECTIVE_ABREAST] = factor;
        carried = off * factor;
    }
    memset(e->ready, 0, (size_t)building->n_dof * sizeof *e->ready);
    e->n_ready = 0;
    return STATUS_OK;
}

static int factor_tridiagonal(struct effective *e, double b, double g) {
    return e->building->n_part > 0 ? factor_chain(e, b, g, true) : factor_chain(e, b, g, false);
}

// b times the tangents of the parts by drifts and g times those by rates, on floors i and j.
static double of_parts(const struct effective *e, double b, double g, size_t i, size_t j) {
    const size_t n = (size_t)e->building->n_dof;
    const double *by_drift = e->tangent + n, *by_rate = by_drift + n * n;
    return b * parts_on_floors(by_drift, (int)n, (int)i, (int)j) +
           g * parts_on_floors(by_rate, (int)n, (int)i, (int)j);
}

static int factor_full(struct effective *e, double b, double g) {
    const struct building *building = e->building;
    size_t n = (size_t)building->n_dof;
    size_t stride = (size_t)e->stride;
    for (size_t i = 0; i < n; i++) {
        double *row = e->inverse + i * stride;
        for (size_t j = 0; j < n; j++) {
            row[j] = g * building->damping_full[i * n + j] +
                     (building->n_part > 0 ? of_parts(e, b, g, i, j) : 0.0);
        }
        row[i] += diagonal(e, b, (int)i);
        if (i > 0) {
            row[i - 1] += right_of(e, b, (int)i - 1);
        }
        if (i + 1 < n) {
            row[i + 1] += right_of(e, b, (int)i);
        }
    }
    gsl_matrix_view a = gsl_matrix_view_array_with_tda(e->inverse, n, n, stride);
    if (gsl_linalg_cholesky_decomp1(&a.matrix) != 0 || gsl_linalg_cholesky_invert(&a.matrix) != 0) {
        return STATUS_RETRY;
    }
    memset(e->ready, true, n * sizeof *e->ready);
    for (size_t i = 0; i < n; i++) {
        e->reach[i] = (struct reach){0, e->stride};
    }
    e->n_ready = building->n_dof;
    return STATUS_OK;
}

int effective_factor(struct effective *e, double b, double g) {
    int status = e->building->damping_full ? factor_full(e, b, g) : factor_tridiagonal(e, b, g);
    e->b = status == STATUS_OK ? b : NAN;
    e->g = g;
    bool at_once = status == STATUS_OK && e->building->elastic && effective_prefers_inverse(e);
    for (int i = 0; at_once && i < e->building->n_dof; i++) {
        effective_column(e, i);
    }
    return status;
}

static void solve_tridiagonal(const struct effective *e, double *r) {
    const int n = e->building->n_dof;
    const double *l = e->factor, *p = e->pivot + (ptrdiff_t)(n - 1) * EFFECTIVE_ABREAST;
    for (int i = 1; i < n; i++, l += EFFECTIVE_ABREAST) {
        r[i] = FORWARD(r[i], *l, r[i - 1]);
    }
    r[n - 1] *= *p;
    for (int i = n - 2; i >= 0; i--) {
        p -= EFFECTIVE_ABREAST;
        l -= EFFECTIVE_ABREAST;
        r[i] = BACKWARD(r[i], *p, *l, r[i + 1]);
    }
}

// Up to eight buildings of one height are solved in lanes. A solution is two chains, upwards and
// downwards, in which each value waits for the one before: one building cannot be spread over
// lanes, but eight can share them. Squares of four floors of four buildings are transposed on the
// way in and out; the factors are held that way. While four wait for one another, the other four go
// on. Floors beyond the top have factors of 0: what is computed there belongs to other buildings,
// and is written before they are.
enum { FOUR = LANES_VECTOR, FOURS = EFFECTIVE_ABREAST / FOUR };

// The vectors of floor i of all, as the factors are held.
#define ABREAST(x, i) ((lanes *)((x) + (ptrdiff_t)(i)*EFFECTIVE_ABREAST))

LANES_INLINE void abreast_forward(const struct effective *e, const double *r) {
    const int floors = e->building->n_dof, last = e->abreast - 1;
    lanes carried[FOURS] = {{0.0}};
    for (int i = 0; i < floors; i += FOUR) {
        lanes in[FOURS][FOUR];
        for (int k = 0; k < EFFECTIVE_ABREAST; k++) {  // those that there are not are the last one
            const ptrdiff_t own = k < last ? k : last;
            in[k / FOUR][k % FOUR] = *(const lanes *)(r + own * floors + i);
        }
        for (int j = 0; j < FOURS; j++) {
            lanes_transpose(in[j]);
        }
        for (int k = 0; k < FOUR * FOURS; k++) {
            const int j = k % FOURS, row = k / FOURS;
            const lanes x = in[j][row] - carried[j];
            ABREAST(e->between, i + row)[j] = x;
            carried[j] = ABREAST(e->factor, i + row)[j] * x;
        }
    }
}

LANES_INLINE void abreast_backward(const struct effective *e, double *q) {
    const int floors = e->building->n_dof;
    lanes above[FOURS] = {{0.0}};
    for (int i = (floors - 1) / FOUR * FOUR; i >= 0; i -= FOUR) {
        lanes out[FOURS][FOUR];
        for (int k = FOUR * FOURS - 1; k >= 0; k--) {
            const int j = k % FOURS, row = k / FOURS;
            above[j] = BACKWARD(ABREAST(e->between, i + row)[j], ABREAST(e->pivot, i + row)[j],
                                ABREAST(e->factor, i + row)[j], above[j]);
            out[j][row] = above[j];
        }
        for (int j = 0; j < FOURS; j++) {
            lanes_transpose(out[j]);
        }
        for (int k = 0; k < EFFECTIVE_ABREAST; k++) {
            if (k < e->abreast) {
                *(lanes *)(q + (ptrdiff_t)k * floors + i) = 0.0 + out[k / FOUR][k % FOUR];
            }
        }
    }
}

LANES void effective_solve(struct effective *e, int n, double *r, double *q) {
    for (struct effective *last = e + n; e < last;) {
        const int floors = e->building->n_dof;
        int solved = 1;
        if (effective_has_inverse(e)) {
            floors_multiply(e->inverse, floors, false, r, q);
        } else if (e->abreast > 0 && e->abreast <= last - e) {
            abreast_forward(e, r);
            abreast_backward(e, q);
            solved = e->abreast;
        } else {
            solve_tridiagonal(e, r);
            for (int i = 0; i < floors; i++) {
                q[i] = 0.0 + r[i];
            }
            if (effective_prefers_inverse(e)) {
                effective_column(e, e->n_ready);
            }
        }
        e += solved;
        r += (ptrdiff_t)solved * floors;
        q += (ptrdiff_t)solved * floors;
    }
}

// Entries of a row of the inverse that are this small against its diagonal are below rounding.
static const double NEGLIGIBLE = 1e-20;

// Entries of row i fall off fast on both sides of the diagonal where the step is short.
static struct reach reach_of(const struct effective *e, int i) {
    const double *row = e->inverse + (size_t)i * (size_t)e->stride;
    double least = NEGLIGIBLE * fabs(row[i]);
    int from = i;
    int to = i + 1;
    while (from > 0 && fabs(row[from - 1]) > least) {
        from--;
    }
    while (to < e->building->n_dof && fabs(row[to]) > least) {
        to++;
    }
    return (struct reach){from / LANES_WIDTH * LANES_WIDTH, lanes_whole(to)};
}

void effective_resume(struct effective *e) {
    const int n = e->building->n_dof;
    for (int i = 0; i < n; i++) {
        e->reach[i].from = e->ready[i];  // which effective_factor forgets
    }
    if (!isnan(e->b) && effective_factor(e, e->b, e->g) == STATUS_OK) {
        for (int i = 0; i < n; i++) {
            if (!e->ready[i] && e->reach[i].from) {
                effective_column(e, i);
            }
        }
    }
}

const double *effective_column(struct effective *e, int i) {
    double *column = e->inverse + (size_t)i * (size_t)e->stride;
    if (!e->ready[i]) {
        memset(column, 0, (size_t)e->stride * sizeof *column);
        column[i] = 1.0;
        solve_tridiagonal(e, column);
        e->ready[i] = true;
        e->reach[i] = reach_of(e, i);
        while (e->n_ready < e->building->n_dof && e->ready[e->n_ready]) {
            e->n_ready++;
        }
    }
    return column;
}
