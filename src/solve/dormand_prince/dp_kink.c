// SPDX-License-Identifier: GPL-3.0-or-later
// Kinks of contact forces at other places than d = 0 and v = 0: where tension is cut off, at the
// yield of a contact, the residual penetration, the points of a curve. A step across one has an
// error of second order that the estimate sees by chance, a hundred times the tolerance and more.
#include "solve/dormand_prince/dp_kink.h"

#include <math.h>

#include "solve/dormand_prince/dp_motion.h"

enum { HALVINGS = 60 };

// A rate is taken over this share of the step.
static const double PROBE = 1e-4;

// Of the larger force on both sides: a jump.
static const double JUMP = 1e-9;

static double before_kink(const struct dp *p, int k, double d, double v) {
    const struct link *l = &p->model->link[k];
    double start = p->now.delta[k];
    double passed = copysign(dp_motion_noise(p, k), d - start);  // the kink where the step starts
    const struct contact_way way = {start + passed, p->rate[0][k], d, v};
    return l->law->kink(l->constant, p->now.link_history + l->history, &way);
}

// The same at place x of the step.
static double before_kink_at(const struct dp *p, int k, const struct polynomial *path, double x) {
    return before_kink(p, k, hermite_value(path, x), hermite_slope(path, x) / p->h);
}

// The end of the first piece of the path on which d does not turn, but for noise.
static double first_turn(const struct motion *m, const struct polynomial *path, double noise) {
    double turn[TURNS_MAX + 1];
    int n = hermite_turns(m, turn);
    turn[n] = 1.0;
    int i = 0;
    while (i < n && fabs(hermite_value(path, turn[i]) - m->d[0]) <= noise) {
        i++;
    }
    return turn[i];
}

struct dp_event dp_kink_before(const struct dp *p, int k, struct dp_event other) {
    struct motion m = dp_motion_link(p, k);
    struct polynomial path = hermite_position(&m);
    double noise = dp_motion_noise(p, k);
    double low = 0.0;
    double high = first_turn(&m, &path, noise);
    if (before_kink_at(p, k, &path, high) > 0.0) {
        return other;
    }
    for (int i = 0; i < HALVINGS; i++) {
        double middle = 0.5 * (low + high);
        *(before_kink_at(p, k, &path, middle) > 0.0 ? &low : &high) = middle;
    }
    const struct dp_event kink = {.kind = DP_KINK, .index = k, .place = high, .direction = -1.0};
    bool moves = fabs(hermite_value(&path, high) - m.d[0]) > noise &&
                 p->now.time + high * p->h > p->now.time;
    return moves && high < other.place ? kink : other;
}

double dp_kink_at_end(const struct dp *p, int k, double *rate) {
    struct motion m = dp_motion_link(p, k);
    double time = PROBE * p->h;
    double value = before_kink(p, k, m.d[1], m.v[1]);
    *rate = (before_kink(p, k, m.d[1] + m.v[1] * time, m.v[1] + m.a[1] * time) - value) / time;
    return value;
}

bool dp_kink_sticks(struct dp *p, int k) {
    const struct model *m = p->model;
    enum phase *phase = &p->system.phase[k];
    const int sign = *phase;
    if (p->now.delta[k] <= dp_motion_noise(p, k)) {
        return false;  // where d = 0 there is no force
    }
    double change = dp_system_across(&m->link[k], m, p->now.a, p->now.ground_a);
    double after = dp_system_response(&p->system, &p->now, k, p->now.delta[k], 0.0).force;
    *phase = -*phase;
    double before = dp_system_response(&p->system, &p->now, k, p->now.delta[k], 0.0).force;
    *phase = -*phase;
    return sign * change < 0.0 && fabs(after - before) > JUMP * fmax(fabs(after), fabs(before));
}
