// SPDX-License-Identifier: GPL-3.0-or-later
// Where a step has to end: a contact closes or opens (d passes through zero), the velocity of a
// closed contact changes its sign, or that of a damper whose force has an infinite slope there, a
// storey comes to the end of its line, or the drift of a yielding storey turns round.
//
// Between the turning points of a motion it is monotone, so that each piece can pass a value once,
// and a touch that begins and ends within the step is seen by the turning point inside it. The
// instant found on the interpolation is only the first guess of dp_locate.c.
//
// What is smaller than rounding is no event: links within some units of the last place of zero, and
// drifts within that of the end of their line, stay as they are.
#include "solve/dormand_prince/dp_event.h"

#include <math.h>

#include "solve/dormand_prince/dp_kink.h"
#include "solve/dormand_prince/dp_motion.h"

enum { ITERATIONS_MAX = 60 };

static const double STILL = 1.0;  // of the error allowed: drifts and dampers that have not moved
static const double SAME = 1e-9;  // of the stiffness of a storey: tangents of one line
static const struct dp_event nothing = {.kind = DP_NONE, .place = INFINITY};

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

// A motion that counts, of a storey or a damper.
static double still(const struct dp *p) {
    return STILL * p->model->control.tolerance * p->scales.most_u;
}

static struct dp_event closing(const struct dp *p, int k, const struct motion *m) {
    struct pieces s = cut(m);
    double least = dp_motion_noise(p, k);
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

// Does a closed contact or a damper go on in its phase through the whole step, for certain? In the
// cubic of its velocity, between those at the ends, the accelerations have no larger share than
// 4/27 of the step each.
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
    bool opens = !p->model->link[k].bilateral;
    double least = opens ? dp_motion_noise(p, k) : still(p);
    int phase = p->system.phase[k];
    for (int i = 0; i < s.n; i++) {
        double rise = s.d[i + 1] - s.d[i];
        if (phase * rise < -least) {
            return (struct dp_event){
                .kind = DP_TURN, .index = k, .place = s.x[i], .direction = -phase};
        }
        if (opens && s.d[i + 1] < -least && rise < 0.0) {
            return (struct dp_event){
                .kind = DP_OPEN, .index = k, .place = reach(&s, i, 0.0), .direction = -1.0};
        }
    }
    return nothing;
}

static struct dp_event link_event(const struct dp *p, int k) {
    struct motion m = dp_motion_link(p, k);
    if (!p->now.link[k].closed) {
        return closing(p, k, &m);
    }
    struct dp_event event = leaving(p, k, &m);
    return p->model->link[k].law->kink ? dp_kink_before(p, k, event) : event;
}

// A line that is told from the last committed point on has a slope as wrong as that by rounding.
static bool is_on_branch(const struct dp *p, int i, double drift) {
    double change = dp_system_tangent(&p->system, &p->now, i, drift) - p->system.tangent[i];
    return fabs(change) <= SAME * p->model->chain.stiffness[i];
}

// The drift between low and high at which the law leaves the tangent of its branch.
static double branch_end(const struct dp *p, int i, double low, double high) {
    for (int n = 0; n < ITERATIONS_MAX && low != high; n++) {
        double middle = 0.5 * (low + high);
        *(is_on_branch(p, i, middle) ? &low : &high) = middle;
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

// Does the drift leave its branch on the way from `start` to *beyond, by more than `least`? Then
// *beyond is where it has. After a turn that did not count it may have gone through the next branch
// to one with the same tangent.
static bool leaves(const struct dp *p, int i, double start, double least, double *beyond) {
    double way = *beyond - start;
    double soon = start + copysign(fmin(2.0 * least, fabs(way)), way);
    *beyond = is_on_branch(p, i, soon) ? *beyond : soon;
    return !is_on_branch(p, i, *beyond);
}

// The rise of a drift that counts. Smaller ones add up, over steps however short, until they do.
static double least_rise(const struct dp *p, int i) {
    double left = still(p) - dp_system_storey_lag(&p->system, &p->now, i);
    return fmax(dp_system_storey_noise(&p->system, &p->now, i), left);
}

static struct dp_event storey_event(const struct dp *p, int i) {
    struct motion m = dp_motion_storey(p, i);
    struct pieces s = cut(&m);
    double least = least_rise(p, i);
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
        double beyond = s.d[n + 1];
        if (is_straight(p, i) && leaves(p, i, s.d[n], least, &beyond)) {
            double end = branch_end(p, i, s.d[n], beyond);
            return (struct dp_event){.kind = DP_BRANCH,
                                     .index = i,
                                     .place = reach(&s, n, end),
                                     .direction = rise,
                                     .target = end};
        }
    }
    return nothing;
}

static void take_earlier(struct dp *p, struct dp_event event) {
    if (event.place < p->event.place) {
        p->event = event;
    }
}

void dp_event_first(struct dp *p) {
    p->event.kind = DP_NONE;
    p->event.place = INFINITY;
    dp_motion_reach(p);
    for (int k = 0, n = p->closes ? p->model->n_contact : 0; k < n; k++) {
        if (p->reach[k] > 0.0 || p->now.link[k].closed) {
            take_earlier(p, link_event(p, k));
        }
    }
    for (int k = p->model->n_contact; k < p->model->n_link; k++) {
        if (p->system.phase[k] != PHASE_ANY) {
            take_earlier(p, link_event(p, k));
        }
    }
    for (int n = 0; n < p->system.n_inelastic; n++) {
        take_earlier(p, storey_event(p, p->system.inelastic[n]));
    }
}

bool dp_event_is_of_storey(const struct dp_event *e) {
    return e->kind == DP_BRANCH || e->kind == DP_UNLOAD;
}
