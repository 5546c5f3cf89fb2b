// SPDX-License-Identifier: GPL-3.0-or-later
// Where a step has to end: a contact closes or opens (d passes through zero), the velocity of a
// closed contact changes its sign, a storey comes to the end of its line, or the drift of a
// yielding storey turns round.
//
// Between the turning points of a motion it is monotone, so that each piece can pass a value once,
// and a touch that begins and ends within the step is seen by the turning point inside it. The
// instant found on the interpolation is only the first guess: the step is taken again to it, and
// mended by Newton's method on the state that the step itself gives, until the next correction
// would be below rounding.
//
// What is smaller than rounding is no event: links within some units of the last place of zero, and
// drifts within that of the end of their line, stay as they are.
#include <float.h>
#include <math.h>

#include "core/lanes.h"
#include "solve/dp.h"
#include "solve/excitation.h"

enum { ITERATIONS_MAX = 60 };

// A correction of the instant of an event, as a share of the step, after which the step is taken a
// last time; one of its square would be too small to matter. Where a law is only changed the
// instant may be wrong by the tolerance, but not where that would be before a turn, which would
// come again; where a history is committed, or velocities jump, it may not.
static const double located[] = {
    [DP_CLOSE] = 3e-3, [DP_OPEN] = 3e-3,   [DP_KINK] = 3e-3,   [DP_TURN] = 1e-4,
    [DP_MEET] = 1e-7,  [DP_BRANCH] = 1e-7, [DP_UNLOAD] = 1e-7,
};

static const double ROUNDING = 64.0;  // units in the last place that mean nothing
static const double STILL = 1.0;      // of the error allowed: a drift that has not moved
static const struct dp_event nothing = {.kind = DP_NONE, .place = INFINITY};

static void motion_accelerations(const struct dp *p, const struct link *l, struct motion *m) {
    m->a[0] = dp_system_across(l, p->model, p->now.a, p->now.ground_a);
    m->a[1] = dp_system_across(l, p->model, p->next.a, p->next.ground_a);
}

struct motion dp_event_link(const struct dp *p, int k) {
    struct motion m = {
        .d = {p->now.delta[k], p->next.delta[k]},
        .v = {p->rate[0][k], p->rate[1][k]},
        .h = p->h,
    };
    motion_accelerations(p, &p->model->link[k], &m);
    return m;
}

struct motion dp_event_floor(const struct dp *p, int i) {
    return (struct motion){
        .d = {p->now.u[i], p->next.u[i]},
        .v = {p->now.v[i], p->next.v[i]},
        .a = {p->now.a[i], p->next.a[i]},
        .h = p->h,
    };
}

// The difference of x at floor i and at the one below.
static double across(const struct dp *p, const double *x, int i) {
    int below = p->system.below[i];
    return below < 0 ? x[i] : x[i] - x[below];
}

struct motion dp_event_storey(const struct dp *p, int i) {
    return (struct motion){
        .d = {across(p, p->now.u, i), across(p, p->next.u, i)},
        .v = {across(p, p->now.v, i), across(p, p->next.v, i)},
        .a = {across(p, p->now.a, i), across(p, p->next.a, i)},
        .h = p->h,
    };
}

// A motion cut at its turning points.
struct pieces {
    struct polynomial path;
    int n;
    double x[TURNS_MAX + 2], d[TURNS_MAX + 2];  // (n + 1) ends of the pieces
};

static struct pieces cut(const struct motion *m) {
    struct pieces s = {.path = hermite_position(m), .n = 1};
    s.n += hermite_turns(m, s.x + 1);
    s.x[0] = 0.0;
    s.x[s.n] = 1.0;
    s.d[0] = m->d[0];
    s.d[s.n] = m->d[1];
    for (int i = 1; i < s.n; i++) {
        s.d[i] = hermite_value(&s.path, s.x[i]);
    }
    return s;
}

// Where piece i of the path reaches `target`, which lies between its ends or before it.
static double reach(const struct pieces *s, int i, double target) {
    double rise = s->d[i + 1] - s->d[i];
    if ((s->d[i] - target) * rise >= 0.0) {
        return s->x[i];
    }
    struct polynomial path = s->path;
    path.c[0] -= target;
    return hermite_root(&path, s->x[i], s->x[i + 1]);
}

double dp_event_noise(const struct dp *p, int k) {
    const struct link *l = &p->model->link[k];
    double size = fabs(l->gap);
    for (int i = 0; i < 2; i++) {
        size +=
            l->dof[i] == WALL ? 0.0 : fmax(fabs(p->now.u[l->dof[i]]), fabs(p->next.u[l->dof[i]]));
        if (l->moving_ground) {
            size += fabs(p->now.ground_u[p->model->building[l->building[i]].ground]);
        }
    }
    return ROUNDING * DBL_EPSILON * size;
}

static struct dp_event closing(const struct dp *p, int k, const struct motion *m) {
    struct pieces s = cut(m);
    double least = dp_event_noise(p, k);
    for (int i = 0; i < s.n; i++) {
        if (s.d[i + 1] > least && s.d[i + 1] > s.d[i]) {
            return (struct dp_event){.kind = p->model->link[k].law->rebound ? DP_MEET : DP_CLOSE,
                                     .index = k,
                                     .place = reach(&s, i, 0.0),
                                     .direction = 1.0};
        }
    }
    return nothing;
}

// Does a closed link go on in its phase through the whole step, for certain? In the cubic of its
// velocity, between those at the ends, the accelerations have no larger share than 4/27 of the step
// each.
static bool stays(const struct dp *p, int k, const struct motion *m) {
    int phase = p->system.phase[k];
    double slowest = fmin(phase * m->v[0], phase * m->v[1]);
    bool goes_on = slowest > 4.0 / 27.0 * m->h * (fabs(m->a[0]) + fabs(m->a[1]));
    return goes_on && (phase == PHASE_APPROACH || m->d[1] > 0.0);
}

static struct dp_event leaving(const struct dp *p, int k, const struct motion *m) {
    if (stays(p, k, m)) {
        return nothing;
    }
    struct pieces s = cut(m);
    double least = dp_event_noise(p, k);
    int phase = p->system.phase[k];
    for (int i = 0; i < s.n; i++) {
        double rise = s.d[i + 1] - s.d[i];
        if (phase * rise < -least) {
            return (struct dp_event){
                .kind = DP_TURN, .index = k, .place = s.x[i], .direction = -phase};
        }
        if (s.d[i + 1] < -least && rise < 0.0) {
            return (struct dp_event){
                .kind = DP_OPEN, .index = k, .place = reach(&s, i, 0.0), .direction = -1.0};
        }
    }
    return nothing;
}

static struct dp_event link_event(const struct dp *p, int k) {
    struct motion m = dp_event_link(p, k);
    if (!p->now.link[k].closed) {
        return closing(p, k, &m);
    }
    struct dp_event event = leaving(p, k, &m);
    return p->model->link[k].law->kink ? dp_kink_before(p, k, event) : event;
}

// The drift between low and high at which the law leaves the tangent of its branch.
static double branch_end(const struct dp *p, int i, double low, double high) {
    for (int n = 0; n < ITERATIONS_MAX && low != high; n++) {
        double middle = 0.5 * (low + high);
        bool on = dp_system_tangent(&p->system, &p->now, i, middle) == p->system.tangent[i];
        *(on ? &low : &high) = middle;
    }
    return low;
}

// Would committing `drift` change the storey's history?
static bool flows(const struct dp *p, int i, double drift) {
    const struct storey *law = &p->model->storey[i];
    const double *kept = p->now.storey_history + law->history;
    double history[STOREY_HISTORY_MAX];
    for (int j = 0; j < law->law->n_history; j++) {
        history[j] = kept[j];
    }
    law->law->commit(law->constant, history, drift);
    bool changed = false;
    for (int j = 0; j < law->law->n_history; j++) {
        changed |= history[j] != kept[j];
    }
    return changed;
}

static bool is_straight(const struct dp *p, int i) {
    return p->model->storey[i].law->traits & STOREY_STRAIGHT;
}

static struct dp_event storey_event(const struct dp *p, int i) {
    struct motion m = dp_event_storey(p, i);
    struct pieces s = cut(&m);
    double still = STILL * p->model->control.tolerance * p->scales.most_u;
    double least = fmax(dp_system_storey_noise(&p->system, &p->now, i), still);
    double tangent = p->system.tangent[i];
    bool moved = false;
    for (int n = 0; n < s.n; n++) {
        double rise = s.d[n + 1] - s.d[n];
        if (fabs(rise) <= least) {
            continue;
        }
        if (moved && flows(p, i, s.d[n])) {
            return (struct dp_event){
                .kind = DP_UNLOAD, .index = i, .place = s.x[n], .direction = rise};
        }
        moved = true;
        if (is_straight(p, i) && dp_system_tangent(&p->system, &p->now, i, s.d[n + 1]) != tangent) {
            double end = branch_end(p, i, s.d[n], s.d[n + 1]);
            return (struct dp_event){.kind = DP_BRANCH,
                                     .index = i,
                                     .place = reach(&s, n, end),
                                     .direction = rise,
                                     .target = end};
        }
    }
    return nothing;
}

// Upper bounds of the penetrations of n contacts. A motion that goes beyond both its ends does so
// by a fraction of its way at the larger rate.
LANES static void find_reach(struct dp *p, int n) {
    const double *restrict d0 = p->now.delta, *restrict d1 = p->next.delta;
    const double *restrict v0 = p->rate[0], *restrict v1 = p->rate[1];
    const double *restrict deepest = p->results->deepest;
    double *restrict reach = p->reach;
    double h = p->h;
    int64_t closes = 0;
    int64_t deepens = 0;
    for (int i = 0; i < n; i++) {
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

static void take_earlier(struct dp *p, struct dp_event event) {
    if (event.place < p->event.place) {
        p->event = event;
    }
}

void dp_event_first(struct dp *p) {
    p->event.kind = DP_NONE;
    p->event.place = INFINITY;
    find_reach(p, p->model->n_contact);
    for (int k = 0, n = p->closes ? p->model->n_contact : 0; k < n; k++) {
        if (p->reach[k] > 0.0 || p->now.link[k].closed) {
            take_earlier(p, link_event(p, k));
        }
    }
    for (int n = 0; n < p->system.n_inelastic; n++) {
        take_earlier(p, storey_event(p, p->system.inelastic[n]));
    }
}

static bool is_of_storey(const struct dp_event *e) {
    return e->kind == DP_BRANCH || e->kind == DP_UNLOAD;
}

// What passes through zero at the event, at the end of the step, and its rate.
static double value_at_end(const struct dp *p, double *rate) {
    const struct dp_event *e = &p->event;
    if (e->kind == DP_KINK) {
        return dp_kink_at_end(p, e->index, rate);
    }
    struct motion m = is_of_storey(e) ? dp_event_storey(p, e->index) : dp_event_link(p, e->index);
    if (e->kind == DP_TURN || e->kind == DP_UNLOAD) {
        *rate = m.a[1];
        return m.v[1];
    }
    *rate = m.v[1];
    return m.d[1] - e->target;
}

void dp_event_locate(struct dp *p) {
    double sign = p->event.direction > 0.0 ? 1.0 : -1.0;
    double whole = p->h;
    double low = 0.0;
    double high = whole;
    double h = p->event.place * whole;
    double near = fmin(located[p->event.kind], sqrt(p->model->control.tolerance));
    bool is_kink = p->event.kind == DP_KINK;  // which has to be passed, or it would come again
    for (int i = 0; i < ITERATIONS_MAX; i++) {
        dp_stages_take(p, h, p->now.time + h);
        dp_stages_gaps(p, &p->next, p->rate[1]);
        double rate;
        double value = value_at_end(p, &rate);
        if (value == 0.0) {
            break;
        }
        *(sign * value > 0.0 ? &high : &low) = h;
        double next = h - value / rate;
        if (!(next > low && next < high)) {
            next = 0.5 * (low + high);
        }
        double correction = fabs(next - h) / whole;
        bool passed = value <= 0.0 || !is_kink;
        if (correction <= near * near && passed) {
            break;
        }
        h = passed ? next : fmin(next + near * near * whole, whole);
        if (correction <= near && !is_kink) {
            dp_stages_take(p, h, p->now.time + h);
            dp_stages_gaps(p, &p->next, p->rate[1]);
            break;
        }
    }
    p->event.place = 1.0;
    find_reach(p, p->model->n_contact);
}

static int toggle(struct dp *p, int k, struct error *e) {
    struct state *now = &p->now;
    if (now->link[k].closed) {
        state_open_link(now, k);
    } else {
        p->system.phase[k] = PHASE_APPROACH;
        state_close_link(now, p->model, k);
    }
    return impacts_toggle(p->impacts, p->results, p->model, now, k, e);
}

// After rigid contacts have met: one that rests is an error, one that has rested and parted at this
// instant is no longer live.
static int part(struct dp *p, struct error *e) {
    const struct model *m = p->model;
    struct state *now = &p->now;
    for (int i = now->n_live - 1; i >= 0; i--) {
        int k = now->live[i];
        if (m->link[k].law->rebound && now->link[k].closed) {
            return error_set(e, STATUS_FAILED,
                             "at t = %.9g %s contact %s comes to rest, which dormand-prince does "
                             "not follow; use integrator newmark or step fixed DT",
                             now->time, m->deck->units.time_name, m->link[k].name);
        }
        if (m->link[k].law->rebound) {
            state_open_link(now, k);
        }
    }
    return STATUS_OK;
}

// Lets the bodies of rigid contact k meet.
static int meet(struct dp *p, int k, struct error *e) {
    const struct model *m = p->model;
    struct state *now = &p->now;
    const struct least_bounce least = {.velocity = m->control.tolerance * p->scales.most_v};
    excitation_at(now, m, now->time);
    impulse_meet(now, m, k, REBOUND_BY_LAW, &least, p->meeting);
    energy_meet(&p->energy, m, now, p->meeting);
    if (part(p, e) != STATUS_OK) {
        return e->status;
    }
    return impacts_meet(p->impacts, p->results, m, now, p->meeting, e);
}

int dp_event_apply(struct dp *p, const struct dp_event *event, struct error *e) {
    int k = event->index;
    switch (event->kind) {
        case DP_MEET:
            p->last_link = k;
            return meet(p, k, e);
        case DP_CLOSE:
        case DP_OPEN:
            p->last_link = k;
            return toggle(p, k, e);
        case DP_KINK:
            p->last_link = k;
            return STATUS_OK;
        case DP_TURN:
            p->last_link = k;
            p->system.phase[k] = event->direction > 0.0 ? PHASE_APPROACH : PHASE_RELEASE;
            return STATUS_OK;
        case DP_BRANCH:
        case DP_UNLOAD:
            dp_system_branch(&p->system, &p->now, k, event->direction);
            return STATUS_OK;
        default:
            return STATUS_OK;
    }
}
