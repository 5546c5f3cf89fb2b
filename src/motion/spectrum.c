// SPDX-License-Identifier: GPL-3.0-or-later
// Response spectra by the exact recurrence for a piecewise linear ground acceleration (Nigam and
// Jennings 1969, Bulletin of the Seismological Society of America 59, 909; Chopra, Dynamics of
// Structures, section 5.2), with exact peaks inside the steps.
//
// The solution at tau after a sample, with the ground acceleration a + s tau. h is the response to
// a unit velocity at tau = 0; h1 and h2 are its first and second integral:
//     u = (1 - omega^2 h1) u0 + h v0 - a h1 - s h2,    v = -omega^2 h u0 + h' v0 - a h - s h1.
// The closed forms of h1 and h2 lose digits if omega tau is small. Taylor's series replaces them
// there.
//
// Peaks: u, v and the total acceleration -(omega^2 u + 2 zeta omega v) have the form y = p u + q v.
// In a step y is a straight line plus a damped sine, so y'' is a damped sine. Its zeros are known
// and half a damped period apart. Between two zeros y' is monotone and has at most one zero, which
// Newton's method finds in a bracket. So no peak is missed, even in a step longer than the period.
// After the end of the record the largest peak is within one damped period.
//
// In a step of length T, y is within T^2 / 8 max |y''| of the line through its ends, and |y''| does
// not exceed the amplitude of its sine. This bound shows that most steps contain no peak.
#include "jostle/spectrum.h"

#include <assert.h>
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdbool.h>

#include "core/root.h"

struct oscillator {
    double omega, omega_d;  // [1/T] undamped and damped
    double decay;           // [1/T] zeta omega
};

// The values of h, h' and the integrals of h at one tau.
struct kernel {
    double h, dh, h1, h2;
};

// One step: the state at its start, and the ground acceleration a + slope tau in it.
struct step {
    double u, v, a, slope, length;
};

// y = p u + q v, and the largest |y| so far.
struct quantity {
    double p, q, peak;
};

// The motion at one instant of a step.
struct course {
    double tau, u, v, acceleration, jerk, snap;
};

// y and its derivatives there.
struct value {
    double tau, y, dy, ddy, dddy;
};

// For omega tau <= 1, the omitted terms are below 1e-18 of the first term.
enum { SERIES_TERMS = 22 };
static const double SERIES_REACH = 1.0;

// h = sum of t_k with t_1 = tau; h'' + 2 zeta omega h' + omega^2 h = 0 gives t_(k+2) from the two
// before.
static struct kernel kernel_by_series(const struct oscillator *o, double tau) {
    const double x = o->omega * tau, damping = 2.0 * o->decay * tau;
    struct kernel k = {0.0, 0.0, 0.0, 0.0};
    double before = 0.0, term = tau;
    for (int i = 1; i <= SERIES_TERMS; i++) {
        k.h += term;
        k.dh += i * term / tau;
        k.h1 += term * tau / (i + 1);
        k.h2 += term * tau * tau / ((i + 1) * (i + 2));
        const double next = -(damping * i * term + x * x * before) / (i * (i + 1));
        before = term;
        term = next;
    }
    return k;
}

static struct kernel kernel_at(const struct oscillator *o, double tau) {
    if (o->omega * tau <= SERIES_REACH) {
        return kernel_by_series(o, tau);
    }
    const double square = o->omega * o->omega;
    const double fade = exp(-o->decay * tau);
    struct kernel k;
    k.h = fade * sin(o->omega_d * tau) / o->omega_d;
    k.dh = fade * cos(o->omega_d * tau) - o->decay * k.h;
    k.h1 = (1.0 - k.dh - 2.0 * o->decay * k.h) / square;
    k.h2 = (tau - k.h - 2.0 * o->decay * k.h1) / square;
    return k;
}

static void advance(const struct oscillator *o, const struct step *s, const struct kernel *k,
                    double *u, double *v) {
    const double square = o->omega * o->omega;
    *u = (1.0 - square * k->h1) * s->u + k->h * s->v - s->a * k->h1 - s->slope * k->h2;
    *v = -square * k->h * s->u + k->dh * s->v - s->a * k->h - s->slope * k->h1;
}

// u and its derivatives at tau of a step.
static struct course course_of(const struct oscillator *o, const struct step *s, double tau,
                               double u, double v) {
    const double square = o->omega * o->omega, damping = 2.0 * o->decay;
    const double acceleration = -damping * v - square * u - (s->a + s->slope * tau);
    const double jerk = -damping * acceleration - square * v - s->slope;
    const double snap = -damping * jerk - square * acceleration;
    return (struct course){tau, u, v, acceleration, jerk, snap};
}

static struct value value_of(const struct quantity *q, const struct course *c) {
    return (struct value){
        .tau = c->tau,
        .y = q->p * c->u + q->q * c->v,
        .dy = q->p * c->v + q->q * c->acceleration,
        .ddy = q->p * c->acceleration + q->q * c->jerk,
        .dddy = q->p * c->jerk + q->q * c->snap,
    };
}

static struct value value_at(const struct oscillator *o, const struct step *s,
                             const struct quantity *q, double tau) {
    double u, v;
    const struct kernel k = kernel_at(o, tau);
    advance(o, s, &k, &u, &v);
    const struct course c = course_of(o, s, tau, u, v);
    return value_of(q, &c);
}

// The value of y at the zero of y' between two instants at which y' has different signs. An error
// `tolerance` of the time changes a peak only by its square.
static struct value turning_point(const struct oscillator *o, const struct step *s,
                                  const struct quantity *q, const struct value *from,
                                  const struct value *to) {
    enum { ITERATIONS_MAX = 100 };
    const double tolerance = 1e-9 * (to->tau - from->tau);
    struct root r = {from->tau, to->tau, from->dy < 0.0 ? 1.0 : -1.0};
    struct value at = *from;
    double next = r.low + (r.high - r.low) * from->dy / (from->dy - to->dy);
    for (int i = 0; i < ITERATIONS_MAX && fabs(next - at.tau) > tolerance; i++) {
        at = value_at(o, s, q, next);
        root_narrow(&r, next, at.dy);
        next -= at.dy / at.ddy;
        if (!(next >= r.low && next <= r.high)) {
            next = root_middle(&r);
        }
    }
    return at;
}

// Records the peak of a piece in which y' is monotone.
static void note_piece(const struct oscillator *o, const struct step *s, struct quantity *q,
                       const struct value *from, const struct value *to) {
    const double span = to->tau - from->tau;
    const double rise = span * fmax(fabs(from->dy), fabs(to->dy));
    if (from->dy * to->dy < 0.0 && fmax(fabs(from->y), fabs(to->y)) + rise > q->peak) {
        q->peak = fmax(q->peak, fabs(turning_point(o, s, q, from, to).y));
    }
    q->peak = fmax(q->peak, fabs(to->y));
}

// Records the peak of a step that may contain one. The size of the damped sine in y is y'' /
// omega^2. The rest of y is a straight line, which has its largest value at an end.
static void search_step(const struct oscillator *o, const struct step *s, struct quantity *q,
                        const struct value *start, const struct value *end, double amplitude) {
    struct value at = *start;
    const double wave = 2.0 * amplitude / (o->omega * o->omega);
    const double half_period = M_PI / o->omega_d;
    double zero = s->length;
    if (s->length >= half_period || at.ddy * end->ddy <= 0.0) {
        const double angle = atan2(at.ddy, -(at.dddy + o->decay * at.ddy) / o->omega_d);
        zero = (angle > 0.0 ? angle : angle + M_PI) / o->omega_d;
    }
    for (; zero < s->length; zero += half_period) {
        const double bound = fmax(fabs(at.y), fabs(end->y)) + wave * exp(-o->decay * at.tau);
        if (bound <= q->peak) {
            return;
        }
        const struct value next = value_at(o, s, q, zero);
        note_piece(o, s, q, &at, &next);
        at = next;
    }
    note_piece(o, s, q, &at, end);
}

// Records the peak of a step from one instant to another.
static void note_step(const struct oscillator *o, const struct step *s, struct quantity *q,
                      const struct course *from, const struct course *to) {
    const struct value start = value_of(q, from);
    const double y = fmax(fabs(start.y), fabs(q->p * to->u + q->q * to->v));
    const double rest = (start.dddy + o->decay * start.ddy) / o->omega_d;
    const double amplitude = sqrt(start.ddy * start.ddy + rest * rest);
    if (y + s->length * s->length / 8.0 * amplitude > q->peak) {
        const struct value end = value_of(q, to);
        search_step(o, s, q, &start, &end, amplitude);
    }
}

static void take_step(const struct oscillator *o, struct step *s, const struct kernel *k, int n,
                      struct quantity *q) {
    double u, v;
    advance(o, s, k, &u, &v);
    const struct course from = course_of(o, s, 0.0, s->u, s->v);
    const struct course to = course_of(o, s, s->length, u, v);
    for (int i = 0; i < n; i++) {
        note_step(o, s, &q[i], &from, &to);
    }
    s->u = u;
    s->v = v;
}

// The peaks of n quantities over all time.
static void respond(const struct signal *ground, double omega, double zeta, int n,
                    struct quantity *q) {
    const struct oscillator o = {
        .omega = omega,
        .omega_d = omega * sqrt((1.0 - zeta) * (1.0 + zeta)),
        .decay = zeta * omega,
    };
    struct step s = {.length = ground->dt};
    const struct kernel k = kernel_at(&o, s.length);
    for (size_t j = 0; j + 1 < ground->n; j++) {
        s.a = ground->value[j];
        s.slope = (ground->value[j + 1] - s.a) / s.length;
        take_step(&o, &s, &k, n, q);
    }
    struct step after = {.u = s.u, .v = s.v, .length = 2.0 * M_PI / o.omega_d};
    const struct kernel free_vibration = kernel_at(&o, after.length);
    take_step(&o, &after, &free_vibration, n, q);
}

// The responses that are computed. The others follow from them.
enum { DISPLACEMENT, VELOCITY, ACCELERATION, N_QUANTITY };

static struct quantity quantity_of(int which, double omega, double zeta) {
    const struct quantity all[N_QUANTITY] = {
        [DISPLACEMENT] = {.p = 1.0},
        [VELOCITY] = {.q = 1.0},
        [ACCELERATION] = {.p = omega * omega, .q = 2.0 * zeta * omega},
    };
    return all[which];
}

struct spectrum_point spectrum_at(const struct signal *ground, double period, double zeta) {
    assert(ground && period >= 0.0 && zeta >= 0.0 && zeta < 1.0);
    if (period == 0.0) {
        const double peak = signal_peak(ground);
        return (struct spectrum_point){.value = {[SPECTRUM_PSA] = peak, [SPECTRUM_SA] = peak}};
    }
    const double omega = 2.0 * M_PI / period;
    struct quantity q[N_QUANTITY];
    for (int i = 0; i < N_QUANTITY; i++) {
        q[i] = quantity_of(i, omega, zeta);
    }
    respond(ground, omega, zeta, N_QUANTITY, q);
    return (struct spectrum_point){.value = {
                                       [SPECTRUM_PSA] = omega * omega * q[DISPLACEMENT].peak,
                                       [SPECTRUM_PSV] = omega * q[DISPLACEMENT].peak,
                                       [SPECTRUM_SD] = q[DISPLACEMENT].peak,
                                       [SPECTRUM_SV] = q[VELOCITY].peak,
                                       [SPECTRUM_SA] = q[ACCELERATION].peak,
                                   }};
}

double spectrum_velocity(const struct signal *ground, double omega, double zeta) {
    assert(ground && omega > 0.0);
    struct quantity velocity = quantity_of(VELOCITY, omega, zeta);
    respond(ground, omega, zeta, 1, &velocity);
    return velocity.peak;
}
