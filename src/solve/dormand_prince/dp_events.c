// SPDX-License-Identifier: GPL-3.0-or-later
// Where a step has to end: a contact closes or opens (d passes through zero), the velocity of a
// closed contact changes its sign, or that of a damper whose force has an infinite slope there, the
// force of a closed contact has a kink, a storey comes to the end of its line, or the drift of a
// yielding storey turns round.
//
// Between the turning points of a motion it is monotone, so that each piece can pass a value once,
// and a touch that begins and ends within the step is seen by the turning point inside it.
//
// The instant found on the interpolation is only the first guess: the step is taken again to it,
// and mended by Newton's method on the state that the step itself gives, until the next correction
// would be below rounding.
//
// What is smaller than rounding is no event: links within some units of the last place of zero, and
// drifts within that of the end of their line, stay as they are.
#include <math.h>

#include "core/root.h"
#include "solve/dormand_prince/dp.h"

enum { ITERATIONS_MAX = 60 };

// A drift or a damper that moves by less than this share of the allowed error stands still.
static const double STILL = 1.0;

// Tangents belong to one line if they differ by less than this share of the storey's stiffness.
static const double SAME = 1e-9;

// The rate at which a kink comes nearer is a difference quotient over this share of the step.
static const double PROBE = 1e-4;

// A collapse is where the drift has passed its limit by this share.
static const double COLLAPSED = 5e-10;

// The kinds of events. What passes through zero is the velocity of the link or storey (`turns`), or
// else its penetration or drift. After a correction of the instant below `located`, a share of the
// step, the step is taken a last time: the next correction would be about its square. The instant
// may be wrong by the tolerance where only a law is changed. It must be more accurate at a turn,
// which would come again if the step ended before it, and most accurate where a history is
// committed or velocities jump.
static const struct dp_kind {
    double located;
    bool of_storey, turns;
} kinds[] = {
    [DP_CLOSE] = {.located = 3e-3},
    [DP_OPEN] = {.located = 3e-3},
    [DP_KINK] = {.located = 3e-3},
    [DP_TURN] = {.located = 1e-4, .turns = true},
    [DP_MEET] = {.located = 1e-7},
    [DP_BRANCH] = {.located = 1e-7, .of_storey = true},
    [DP_UNLOAD] = {.located = 1e-7, .of_storey = true, .turns = true},
    [DP_COLLAPSE] = {.located = 1e-7, .of_storey = true},
};

static const struct dp_event nothing = {.kind = DP_NONE, .place = INFINITY};

// Where piece i of the path reaches `target`, which lies between its ends or before it.
static double dp_where(const struct motion_pieces *s, int i, double target) {
    double rise = s->d[i + 1] - s->d[i];
    if ((s->d[i] - target) * rise >= 0.0) {
        return s->x[i];
    }
    struct polynomial path = s->path;
    path.c[0] -= target;
    return hermite_root(path, s->x[i], s->x[i + 1]);
}

double dp_events_noise(const struct dp *p, int k) {
    const struct link *l = &p->model->link[k];
    double size = fabs(l->gap) + p->scales.most_u;  // bodies at rest move by rounding
    for (int i = 0; i < 2; i++) {
        size += fmax(link_size_at(l, i, p->now.u), link_size_at(l, i, p->next.u));
        if (l->moving_ground) {
            size += fabs(p->now.ground_u[p->model->building[l->building[i]].ground]);
        }
    }
    return SCALE_ROUNDING * size;
}

// Upper bounds of the penetrations of contacts, into p->reach, and what follows from them. A motion
// that goes beyond both its ends does so by a fraction of its way at the larger rate.
LANES static void dp_find_reach(struct dp *p) {
    const double *restrict d0 = p->now.delta, *restrict d1 = p->next.delta;
    const double *restrict v0 = p->rate[0], *restrict v1 = p->rate[1];
    const double *restrict deepest = p->results->deepest;
    double *restrict reach = p->reach;
    double h = p->h;
    int64_t closes = 0;
    int64_t deepens = 0;
    for (int i = 0, n = p->model->n_contact; i < n; i++) {
        double d = d0[i] > d1[i] ? d0[i] : d1[i];
        double v = fabs(v0[i]) > fabs(v1[i]) ? fabs(v0[i]) : fabs(v1[i]);
        double most = d + h * v;
        reach[i] = most;
        closes |= most > 0.0;
        deepens |= most > deepest[i];
    }
    p->closes = closes != 0;
    p->deepens = deepens != 0;
}

// A motion that counts, of a storey or a damper.
static double dp_still(const struct dp *p) {
    return STILL * p->model->control.tolerance * p->scales.most_u;
}

// Does a closed contact or a damper go on in its phase through the whole step, for certain? In the
// cubic of its velocity, between those at the ends, the accelerations have no larger share than
// 4/27 of the step each.
static bool dp_stays(const struct dp *p, int k, const struct motion *m) {
    int phase = p->system.phase[k];
    double slowest = fmin(phase * m->v[0], phase * m->v[1]);
    bool goes_on = slowest > 4.0 / 27.0 * m->h * (fabs(m->a[0]) + fabs(m->a[1]));
    return goes_on && (phase == PHASE_APPROACH || m->d[1] > 0.0);
}

// Where link k passes d = 0 to the other side, or a closed one leaves its phase.
static struct dp_event dp_passing(const struct dp *p, int k, const struct motion *m) {
    const struct link *l = &p->model->link[k];
    const struct motion_pieces s = hermite_cut(m);
    const bool closed = p->now.link[k].closed;
    const double least = l->bilateral ? dp_still(p) : dp_events_noise(p, k);
    const int phase = closed ? p->system.phase[k] : PHASE_ANY, after = closed ? -1 : 1;
    for (int i = 0; i < s.n; i++) {
        const double rise = s.d[i + 1] - s.d[i];
        if (phase * rise < -least) {
            return (struct dp_event){DP_TURN, k, s.x[i], -phase, 0.0};
        }
        if (!l->bilateral && after * s.d[i + 1] > least && after * rise > 0.0) {
            const enum dp_event_kind kind = closed ? DP_OPEN : l->law->rebound ? DP_MEET : DP_CLOSE;
            return (struct dp_event){kind, k, dp_where(&s, i, 0.0), after, 0.0};
        }
    }
    return nothing;
}

// How far (d, v) is before the next kink of the force of link k. Kinks are at other places than d =
// 0 and v = 0: where tension is cut off, at the yield of a contact, the residual penetration, the
// points of a curve. A step across one has an error of second order that the estimate sees by
// chance, a hundred times the tolerance and more.
static double dp_before_kink(const struct dp *p, int k, double d, double v) {
    const struct link *l = &p->model->link[k];
    double start = p->now.delta[k];
    double passed = copysign(dp_events_noise(p, k), d - start);  // the kink where the step starts
    const struct contact_way way = {start + passed, p->rate[0][k], d, v};
    return l->law->kink(l->constant, p->now.link_history + l->history, &way);
}

// Is place x of the path before it?
static bool dp_is_before_kink(const struct dp *p, int k, const struct polynomial *path, double x) {
    return dp_before_kink(p, k, hermite_value(path, x), hermite_slope(path, x) / p->h) > 0.0;
}

// The first kink in the step of the force of closed contact k, or `other` if that is earlier. The
// search is on the first piece of the path that is longer than noise: there d does not turn.
static struct dp_event dp_kink(const struct dp *p, int k, const struct motion *m,
                               struct dp_event other) {
    struct motion_pieces s = hermite_cut(m);
    double noise = dp_events_noise(p, k);
    int i = 1;
    while (i < s.n && fabs(s.d[i] - s.d[0]) <= noise) {
        i++;
    }
    struct root at = {.high = s.x[i]};
    if (dp_is_before_kink(p, k, &s.path, at.high)) {
        return other;
    }
    for (int n = 0; n < ITERATIONS_MAX; n++) {
        root_halve(&at, dp_is_before_kink(p, k, &s.path, root_middle(&at)));
    }
    double way = fabs(hermite_value(&s.path, at.high) - s.d[0]);
    bool moves = way > noise && p->now.time + at.high * p->h > p->now.time;
    const struct dp_event kink = {DP_KINK, k, at.high, -1.0, 0.0};
    return moves && at.high < other.place ? kink : other;
}

static struct dp_event dp_link_event(const struct dp *p, int k) {
    const struct motion m = dp_motion_link(p, k);
    const bool closed = p->now.link[k].closed;
    const struct dp_event event = closed && dp_stays(p, k, &m) ? nothing : dp_passing(p, k, &m);
    return closed && p->model->link[k].law->kink ? dp_kink(p, k, &m, event) : event;
}

// A line that is told from the last committed point on has a slope as wrong as that by rounding.
static bool dp_is_on_branch(const struct dp *p, int i, double drift) {
    double change = dp_rates_storey(p, i, drift).tangent - p->system.tangent[i];
    return fabs(change) <= SAME * dp_rates_stiffness(p, i);
}

// The drift between low and high at which the law leaves the tangent of its branch.
static double dp_branch_end(const struct dp *p, int i, double low, double high) {
    struct root end = {low, high, 1.0};
    for (int n = 0; n < ITERATIONS_MAX && end.low != end.high; n++) {
        root_halve(&end, dp_is_on_branch(p, i, root_middle(&end)));
    }
    return end.low;
}

// Would committing `drift` change the storey's history?
static bool dp_flows(const struct dp *p, int i, double drift) {
    const struct storey *law = &p->model->storey[i];
    const double *kept = p->now.storey_history + law->history;
    double history[STOREY_HISTORY_MAX];
    law->law->respond(law->constant, kept, drift, history);
    bool changed = false;
    for (int j = 0; j < law->law->n_history; j++) {
        changed |= history[j] != kept[j];
    }
    return changed;
}

// Does the drift leave its branch on the way from `start` to *beyond, by more than `least`? Then
// *beyond is where it has. After a turn that did not count it may have gone through the next branch
// to one with the same tangent.
static bool dp_leaves(const struct dp *p, int i, double start, double least, double *beyond) {
    double way = *beyond - start;
    double soon = start + copysign(fmin(2.0 * least, fabs(way)), way);
    *beyond = dp_is_on_branch(p, i, soon) ? *beyond : soon;
    return !dp_is_on_branch(p, i, *beyond);
}

// The rise of a drift that counts. Smaller ones add up, over steps however short, until they do:
// `lag` is how far the branch of the storey has led from its law at `now`, as a drift.
static double dp_least_rise(const struct dp *p, int i) {
    const double drift = p->now.drift[i];
    const double missed = dp_rates_shear(p, i, drift) - dp_rates_storey(p, i, drift).shear;
    const double lag = fabs(missed) / dp_rates_stiffness(p, i);
    return fmax(dp_rates_noise(p, i), dp_still(p) - lag);
}

static struct dp_event dp_storey_event(const struct dp *p, int i) {
    struct motion m = dp_motion(p, dp_drift, 0, i);
    struct motion_pieces s = hermite_cut(&m);
    double least = dp_least_rise(p, i);
    bool straight = p->model->storey[i].law->traits & STOREY_STRAIGHT;
    bool moved = false;
    for (int n = 0; n < s.n; n++) {
        double rise = s.d[n + 1] - s.d[n];
        if (fabs(rise) <= least) {
            continue;
        }
        if (moved && dp_flows(p, i, s.d[n])) {
            return (struct dp_event){DP_UNLOAD, i, s.x[n], rise, 0.0};
        }
        moved = true;
        double beyond = s.d[n + 1];
        if (straight && dp_leaves(p, i, s.d[n], least, &beyond)) {
            const double end = dp_branch_end(p, i, s.d[n], beyond);
            return (struct dp_event){DP_BRANCH, i, dp_where(&s, n, end), rise, end};
        }
    }
    return nothing;
}

// Where the drift of storey i reaches its limit, and passes it by less than rounding counts.
static struct dp_event dp_collapse(const struct dp *p, int i) {
    if (isinf(p->model->collapse[i])) {
        return nothing;
    }
    const struct motion m = dp_motion(p, dp_deformation, 0, i);
    const double limit = p->model->collapse[i] * (1.0 + COLLAPSED);
    const double speed = fmax(fabs(m.v[0]), fabs(m.v[1]));
    if (fmax(fabs(m.d[0]), fabs(m.d[1])) + m.h * speed < limit) {
        return nothing;
    }
    const struct motion_pieces s = hermite_cut(&m);
    int n = 1;
    while (n < s.n && fabs(s.d[n]) < limit) {
        n++;
    }
    if (fabs(s.d[n]) < limit) {
        return nothing;
    }
    const double sign = copysign(1.0, s.d[n]), target = sign * limit;
    return (struct dp_event){DP_COLLAPSE, i, dp_where(&s, n - 1, target), sign, target};
}

static void dp_take_earlier(struct dp *p, struct dp_event event) {
    if (event.place < p->event.place) {
        p->event = event;
    }
}

void dp_events_first(struct dp *p) {
    p->event.kind = DP_NONE;
    p->event.place = INFINITY;
    dp_find_reach(p);
    for (int k = 0, n = p->closes ? p->model->n_contact : 0; k < n; k++) {
        if (p->reach[k] > 0.0 || p->now.link[k].closed) {
            dp_take_earlier(p, dp_link_event(p, k));
        }
    }
    for (int k = p->model->n_contact; k < p->model->n_link; k++) {
        if (p->system.phase[k] != PHASE_ANY || p->model->link[k].law->kink) {
            dp_take_earlier(p, dp_link_event(p, k));
        }
    }
    for (int n = 0; n < p->system.n_inelastic; n++) {
        dp_take_earlier(p, dp_storey_event(p, p->system.inelastic[n]));
    }
    for (int i = 0; p->model->collapse && i < p->model->n_dof; i++) {
        dp_take_earlier(p, dp_collapse(p, i));
    }
}

bool dp_events_is_of_storey(const struct dp_event *e) {
    return kinds[e->kind].of_storey;
}

// What passes through zero at the event, at the end of the step, and its rate.
static double dp_value_at_end(const struct dp *p, double *rate) {
    const struct dp_event *e = &p->event;
    int i = e->index;
    struct motion m = e->kind == DP_COLLAPSE      ? dp_motion(p, dp_deformation, 0, i)
                      : dp_events_is_of_storey(e) ? dp_motion(p, dp_drift, 0, i)
                                                  : dp_motion_link(p, i);
    if (e->kind == DP_KINK) {
        double time = PROBE * p->h;
        double value = dp_before_kink(p, i, m.d[1], m.v[1]);
        double later = dp_before_kink(p, i, m.d[1] + m.v[1] * time, m.v[1] + m.a[1] * time);
        *rate = (later - value) / time;
        return value;
    }
    const bool turns = kinds[e->kind].turns;
    *rate = turns ? m.a[1] : m.v[1];
    return turns ? m.v[1] : m.d[1] - e->target;
}

// Takes the step again, of length h.
static void dp_retake(struct dp *p, double h) {
    dp_step_take(p, h, p->now.time + h);
    dp_step_gaps(p, &p->next, p->rate[1]);
}

void dp_events_locate(struct dp *p) {
    const double whole = p->h;
    struct root r = {0.0, whole, p->event.direction > 0.0 ? 1.0 : -1.0};
    double h = p->event.place * whole;
    double near = fmin(kinds[p->event.kind].located, sqrt(p->model->control.tolerance));
    bool is_kink = p->event.kind == DP_KINK;  // which has to be passed, or it would come again
    for (int i = 0; i < ITERATIONS_MAX; i++) {
        dp_retake(p, h);
        double rate;
        double value = dp_value_at_end(p, &rate);
        if (value == 0.0) {
            break;
        }
        root_narrow(&r, h, value);
        double next = root_step(&r, h, value, rate);
        double correction = fabs(next - h) / whole;
        bool passed = value <= 0.0 || !is_kink;
        if (correction <= near * near && passed) {
            break;
        }
        h = passed ? next : fmin(next + near * near * whole, whole);
        if (correction <= near && !is_kink) {
            dp_retake(p, h);
            break;
        }
    }
    p->event.place = 1.0;
    dp_find_reach(p);
}
