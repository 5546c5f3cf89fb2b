// SPDX-License-Identifier: GPL-3.0-or-later
// A step in which no link acts is one of many that the lanes take at a time. In one in which links
// act, the lanes take the floors of all runs as far as the forces are known that these begin with,
// and the links of each run then change its lane; contacts that close on the way join them. What
// goes beyond that, such as a force that jumps or a step that has to be cut, takes the run ashore
// for the step.
#include "solve/ensemble_fleet.h"

#include "solve/ensemble_links.h"

void fleet_board(struct fleet *f, int k, long n) {
    struct boat *b = &f->boat[k];
    struct run *r = &b->run;
    if (b->berth == BERTH_ASHORE && work_factor(&r->work, r->model->dt) == STATUS_OK &&
        ensemble_board(&f->lanes, k, r)) {
        run_forget_events(r);
        b->berth = BERTH_ABOARD;
        b->boarded = n;
        f->n_aboard++;
        f->n_ashore--;
    }
}

void fleet_leave(struct fleet *f, int k, long n) {
    struct boat *b = &f->boat[k];
    ensemble_leave(&f->lanes, k, &b->run, model_time(b->run.model, n), n - b->boarded);
    b->berth = BERTH_ASHORE;
    f->n_aboard--;
    f->n_ashore++;
}

void fleet_end(struct fleet *f, int k, int status) {
    struct boat *b = &f->boat[k];
    *(b->berth == BERTH_ABOARD ? &f->n_aboard : &f->n_ashore) -= 1;
    b->berth = BERTH_ENDED;
    f->lanes.aboard[k] = 0;
    b->member->status = analysis_end(&b->run, status, &b->member->results);
}

static bool is_aboard(const struct fleet *f, int k) {
    return f->boat[k].berth == BERTH_ABOARD;
}

static bool any_live(const struct fleet *f) {
    bool any = false;
    for (int k = 0; k < f->n; k++) {
        any |= is_aboard(f, k) && f->boat[k].run.now->n_live > 0;
    }
    return any;
}

// The links of run k act in step n.
static void act(struct fleet *f, int k, long n) {
    struct boat *b = &f->boat[k];
    const struct model *m = b->run.model;
    b->acts = true;
    b->before = b->run.results->totals;
    ensemble_links_begin(&f->lanes, k, &b->run, model_time(m, n - 1), model_time(m, n));
    b->wanted = b->run.next->n_live > 0;
}

// Run k cannot take step n aboard, whose links have acted in it so far.
static void give_up(struct fleet *f, int k, long n) {
    struct boat *b = &f->boat[k];
    if (b->acts) {
        b->run.results->totals = b->before;
        ensemble_links_release(&f->lanes, k, &b->run);
        b->acts = false;
    }
    fleet_leave(f, k, n - 1);
}

// The step n of all floors aboard, with the forces that live links begin it with.
static void begin_links(struct fleet *f, long n, const wide *base) {
    ensemble_unbalance(&f->lanes, base);
    for (int k = 0; k < f->n; k++) {
        if (is_aboard(f, k) && f->boat[k].run.now->n_live > 0) {
            act(f, k, n);
        }
    }
    ensemble_move(&f->lanes, base);
    for (int k = 0; k < f->n; k++) {
        if (is_aboard(f, k) && f->boat[k].acts) {
            ensemble_links_gather(&f->lanes, k, &f->boat[k].run);
        }
    }
}

static unsigned pressed_lanes(const struct ensemble_lanes *e) {
    unsigned lanes_set = 0;
    for (int i = 0; i < e->n_pressed; i++) {
        lanes_set |= e->pressed[i].lanes;
    }
    return lanes_set;
}

// Closes the pressed contacts of run k, and solves for its links where that is to be done anew:
// returns whether it was.
static bool solve_links(struct fleet *f, int k, long n, bool pressed) {
    struct boat *b = &f->boat[k];
    if (pressed && !b->acts) {
        act(f, k, n);
    }
    b->wanted |= pressed && ensemble_links_close(&f->lanes, k, &b->run) > 0;
    if (!b->wanted) {
        return false;
    }
    b->wanted = false;
    if (ensemble_links_solve(&f->lanes, k, &b->run) != STATUS_OK) {
        give_up(f, k, n);
    }
    return true;
}

// Solves for the links of all runs aboard, which may close others.
static void meet(struct fleet *f, long n) {
    for (bool again = true; again;) {
        again = false;
        ensemble_press(&f->lanes);
        const unsigned pressed = pressed_lanes(&f->lanes);
        for (int k = 0; k < f->n; k++) {
            bool asked = is_aboard(f, k) && (f->boat[k].wanted || (pressed >> k & 1U));
            again |= asked && solve_links(f, k, n, pressed >> k & 1U);
        }
    }
    for (int k = 0; k < f->n; k++) {
        bool acts = is_aboard(f, k) && f->boat[k].acts;
        if (acts && ensemble_links_finish(&f->boat[k].run) != STATUS_OK) {
            give_up(f, k, n);
        }
    }
}

// Takes a closer look at the step n that has been computed, in which a peak is exceeded.
static void look(struct fleet *f, long n, const wide *base) {
    const unsigned leaving = ensemble_overflows(&f->lanes, base);
    for (int k = 0; k < f->n; k++) {
        if (leaving >> k & 1U) {
            give_up(f, k, n);
        }
    }
    ensemble_raise(&f->lanes, base, (double)n * f->lanes.h);
}

static void commit(struct fleet *f, const wide *base) {
    for (int k = 0; k < f->n; k++) {
        struct boat *b = &f->boat[k];
        if (is_aboard(f, k) && b->acts) {
            b->acts = false;
            int status = ensemble_links_commit(&f->lanes, k, &b->run);
            if (status != STATUS_OK) {
                fleet_end(f, k, status);
            }
        }
    }
    ensemble_commit(&f->lanes, base);
}

static long least(long a, long b) {
    return a < b ? a : b;
}

long fleet_cruise(struct fleet *f, long n) {
    struct ensemble_lanes *e = &f->lanes;
    const bool live = any_live(f);
    const long row = (n + f->every - 1) / f->every * f->every;
    const long last = f->n_ashore > 0 || live ? n : least(least(f->known, f->due), row);
    if (f->n_aboard == 0) {
        return last;
    }
    const wide *base = e->base + (n + ENSEMBLE_STRETCH - 1 - f->known);
    const int taken = live ? 0 : ensemble_march(e, base, (int)(last - n + 1));
    n += taken;
    base += taken;
    if (n > last) {
        return last;
    }
    if (live) {
        begin_links(f, n, base);
    }
    meet(f, n);
    if (ensemble_exceeds(e, base)) {
        look(f, n, base);
    }
    commit(f, base);
    return n;
}
