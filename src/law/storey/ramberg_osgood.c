// SPDX-License-Identifier: GPL-3.0-or-later
// Ramberg & Osgood's storey: a smooth backbone, and Masing's rule for loops. With x = drift / d_y,
// f = V / V_y and d_y = V_y / k,
//
//     backbone        x = f (1 + eta |f|^(r - 1)),   f = F(x);
//     after a turn    f = f0 + 2 F((x - x0) / 2) from the turning point (x0, f0).
//
// A branch that meets the branch it left closes a loop, and both turning points are forgotten; a
// branch that comes to the mirrored first turn is on the backbone again. Steps are exact, so their
// number does not matter. The history has the last TURNS turning points that are not forgotten. A
// storey that turns once more goes back along its branch, which is elastic.
//
// Masing's rule is that of elastoplastic springs in parallel (Iwan 1966), whose yield drifts y have
// the stiffness -F''(y) dy. The stored energy is the sum of theirs: a spring that last yielded at
// the turn j has the deformation +-y + x - x_j.
#include <math.h>
#include <string.h>

#include "law/lists.h"
#include "law/yield.h"

enum { YIELD, ETA, R, N_ROW };
// PER_DRIFT: 1 / d_y; WHOLE: r - 1 if it is a whole number, else 0.
enum { STIFFNESS, STRENGTH, PER_DRIFT, SHARE, EXPONENT, WHOLE, N_CONSTANT };
enum { TURNS = 20 };
enum {
    X,          // where the storey is
    F,          // shear there
    SLOPE,      // df/dx there
    DIRECTION,  // of the branch: 1 or -1; 0: at the origin, not moved yet
    N_TURN,
    TURN,  // x and f of each turn
    N_HISTORY = TURN + 2 * TURNS
};

static const struct range exponent_range = {
    .min = 1.0, .min_open = true, .max = 50.0, .text = "> 1 and <= 50"};

static const struct row rows[N_ROW] = {
    [YIELD] = {"yield", ROW_LIST, ROW_REQUIRED, OF_FORCE, &range_positive, NAN,
               "storey shear V_y at the drift (1 + eta) V_y / k"},
    [ETA] = {"eta", ROW_NUMBER, ROW_REQUIRED, OF_NONE, &range_positive, NAN,
             "drift beyond the elastic one at V_y, over V_y / k"},
    [R] = {"r", ROW_NUMBER, ROW_REQUIRED, OF_NONE, &exponent_range, NAN,
           "sharpness of the yielding"},
};

static int ramberg_osgood_prepare(const double *value, double stiffness, double *constant,
                                  struct error *e) {
    (void)e;
    constant[STIFFNESS] = stiffness;
    constant[STRENGTH] = value[YIELD];
    constant[PER_DRIFT] = stiffness / value[YIELD];
    constant[SHARE] = value[ETA];
    constant[EXPONENT] = value[R];
    constant[WHOLE] = value[R] == floor(value[R]) ? value[R] - 1.0 : 0.0;
    return STATUS_OK;
}

// eta f^(r - 1) for f >= 0. Whole exponents, which most are, are products.
static inline double ramberg_osgood_power(const double *c, double f) {
    if (c[WHOLE] == 0.0) {
        return c[SHARE] * pow(f, c[EXPONENT] - 1.0);
    }
    double power = c[SHARE];
    for (unsigned n = (unsigned)c[WHOLE]; n > 0; n >>= 1) {
        power = n & 1 ? power * f : power;
        f *= f;
    }
    return power;
}

static inline double ramberg_osgood_slope(const double *c, double power) {
    return 1.0 / (1.0 + c[EXPONENT] * power);
}

static inline const double *ramberg_osgood_turn(const double *h, int i) {
    return h + TURN + (ptrdiff_t)2 * i;
}

// A point of the backbone to the right of the origin.
struct point {
    double x, f, slope;
};

// The point at x by Newton's iteration, which comes down to the root from the first step on, as
// x(f) is convex. It starts from the cubic parabola of f(x) at a point nearby: with v = df / f on
// the tangent and a = (r - 1) (1 - slope),
//     f = f0 (1 + v (1 - v a / 2 (1 - v (3 a - r + 2) / 3))).
static struct point ramberg_osgood_backbone(const double *c, const struct point *near, double x) {
    static const double ROUNDING = 1e-16;
    const double r = c[EXPONENT], a = (r - 1.0) * (1.0 - near->slope);
    const double v = (x - near->x) * near->slope / near->f;
    double f = near->f * (1.0 + v * (1.0 - v * (a / 2.0) * (1.0 - v * (3.0 * a - r + 2.0) / 3.0)));
    if (x == 0.0) {
        return (struct point){0.0, 0.0, 1.0};
    }
    if (!(fabs(v) * (1.0 + a) < 0.2)) {
        f = fmin(x, pow(x / c[SHARE], 1.0 / r));
    }
    for (int i = 0; i < 60; i++) {
        const double power = ramberg_osgood_power(c, f), steep = ramberg_osgood_slope(c, power);
        double step = (x - f - f * power) * steep, share = step / f;
        // With the curvature of x(f) the step is of third order.
        const double curved = (r - 1.0) * (1.0 - steep) / 2.0 * share;
        if (fabs(curved) < 0.1) {
            step *= 1.0 - curved;
        }
        f += step;
        if (r * r * fabs(share) * share * share <= ROUNDING) {
            return (struct point){x, f, ramberg_osgood_slope(c, power * (1.0 + (r - 1.0) * share))};
        }
    }
    return (struct point){x, f, ramberg_osgood_slope(c, ramberg_osgood_power(c, f))};
}

// The branch of a storey that comes to x: its direction, and the number of turns before it. The
// last of them is `turn`.
struct branch {
    double direction;
    int n;
    double turn[2];
    bool left;  // it is not the branch of the history
};

static struct branch ramberg_osgood_branch(const double *h, double x) {
    struct branch b = {.direction = h[DIRECTION], .n = (int)h[N_TURN]};
    const double go = x > h[X] ? 1.0 : x < h[X] ? -1.0 : b.direction;
    double last[2] = {h[X], h[F]};
    bool turns = false;
    if (b.direction == 0.0) {
        b.direction = go;
    } else if (go != b.direction && b.n < TURNS) {
        b.direction = go;
        b.n++;
        b.left = turns = true;
    } else if (b.n == TURNS && b.direction * (x - ramberg_osgood_turn(h, b.n - 1)[0]) < 0.0) {
        b.direction = -b.direction;
        b.n--;
        b.left = true;
    }
    while (b.n >= 2 && b.direction * (x - ramberg_osgood_turn(h, b.n - 2)[0]) >= 0.0) {
        b.n -= 2;
        b.left = true;
        turns = false;
    }
    if (b.n == 1) {
        const double first = turns ? h[X] : h[TURN];
        if (b.direction * x >= fabs(first)) {
            b.n = 0;
            b.left = true;
        }
    }
    if (b.n > 0) {
        memcpy(b.turn, turns ? last : ramberg_osgood_turn(h, b.n - 1), sizeof b.turn);
    }
    return b;
}

// The point of the branch at x, as one of the backbone: half of it after a turn.
static struct point ramberg_osgood_point(const double *c, const double *h, const struct branch *b,
                                         double x) {
    const double scale = b->n > 0 ? 0.5 : 1.0;
    struct point near = {0.0, 0.0, 1.0};
    if (!b->left) {
        near = (struct point){scale * fabs(h[X] - b->turn[0]), scale * fabs(h[F] - b->turn[1]),
                              h[N_TURN] == 0.0 && h[DIRECTION] == 0.0 ? 1.0 : h[SLOPE]};
    }
    return ramberg_osgood_backbone(c, &near, scale * fabs(x - b->turn[0]));
}

static struct storey_response ramberg_osgood_respond(const double *c, const double *h, double drift,
                                                     double *after) {
    const double x = drift * c[PER_DRIFT];
    const struct branch b = ramberg_osgood_branch(h, x);
    const struct point p = ramberg_osgood_point(c, h, &b, x);
    const double f = b.n > 0 ? b.turn[1] + b.direction * 2.0 * p.f : b.direction * p.f;
    if (after) {
        if (after != h) {
            memcpy(after, h, (size_t)(TURN + 2 * (int)h[N_TURN]) * sizeof *after);
        }
        after[X] = x;
        after[F] = f;
        after[SLOPE] = p.slope;
        after[DIRECTION] = b.direction;
        after[N_TURN] = b.n;
        if (b.n > 0) {
            memcpy(after + TURN + (ptrdiff_t)2 * (b.n - 1), b.turn, sizeof b.turn);
        }
    }
    return (struct storey_response){.shear = c[STRENGTH] * f, .tangent = c[STIFFNESS] * p.slope};
}

// Integrals of y^j times the stiffness of the springs that yield below y, of j = 0, 1, 2.
struct moments {
    double of[3];
};

static struct moments ramberg_osgood_moments(const double *c, double y, double f) {
    const double power = ramberg_osgood_power(c, f), slope = ramberg_osgood_slope(c, power);
    const double area = f * f * (0.5 + power / (c[EXPONENT] + 1.0));  // left of the backbone
    return (struct moments){{1.0 - slope, f - y * slope, 2.0 * area - y * y * slope}};
}

static double ramberg_osgood_stored(const double *c, const double *h, double drift) {
    double after[N_HISTORY];
    ramberg_osgood_respond(c, h, drift, after);
    const double x = after[X], *turn = after + TURN;
    const double *end = turn + (ptrdiff_t)2 * (int)after[N_TURN];
    const int n = (int)after[N_TURN];
    double side = n % 2 ? -after[DIRECTION] : after[DIRECTION], twice = 0.0;
    // The springs that have not yielded yet, then those that yielded last before each turn.
    double y = fabs(n > 0 ? turn[0] : x), f = fabs(n > 0 ? turn[1] : after[F]);
    struct moments upper = ramberg_osgood_moments(c, y, f);
    twice += x * x * (1.0 - upper.of[0]);
    for (; turn < end; turn += 2) {
        const bool last = turn + 2 == end;
        const double way = x - turn[0];
        y = fabs((last ? x : turn[2]) - turn[0]) / 2.0;
        f = fabs((last ? after[F] : turn[3]) - turn[1]) / 2.0;
        const struct moments lower = ramberg_osgood_moments(c, y, f);
        twice += upper.of[2] - lower.of[2] + 2.0 * side * way * (upper.of[1] - lower.of[1]) +
                 way * way * (upper.of[0] - lower.of[0]);
        upper = lower;
        side = -side;
    }
    return c[STRENGTH] / c[PER_DRIFT] * (twice + upper.of[2]) / 2.0;
}

static void ramberg_osgood_describe(const double *c, struct storey_figures *out) {
    yield_describe(1.0 / c[PER_DRIFT], c[STRENGTH], out);
}

const struct storey_law storey_ramberg_osgood = {
    .name = "ramberg-osgood",
    .summary = "smooth yielding without a limit of the strength; Masing's loops",
    .formula = "drift = V / k (1 + eta |V / V_y|^(r - 1)); after a turn at (drift0, V0) the same "
               "curve twice as large, from there",
    .source = "Ramberg & Osgood (1943), NACA TN 902; Jennings (1964), J. Eng. Mech. Div. ASCE 90, "
              "131-166; energy of the springs of Iwan (1966), J. Appl. Mech. 33, 893-900",
    .remarks =
        "For steel and soil. Typical: eta 0.02 to 0.5, r 3 to 25. The strength has no limit, "
        "and loops do not deteriorate. Of more than 20 nested loops the smallest are elastic",
    .example = "-yield 600kN -eta 0.2 -r 7",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = N_CONSTANT,
    .n_history = N_HISTORY,
    .prepare = ramberg_osgood_prepare,
    .respond = ramberg_osgood_respond,
    .stored = ramberg_osgood_stored,
    .describe = ramberg_osgood_describe,
};
