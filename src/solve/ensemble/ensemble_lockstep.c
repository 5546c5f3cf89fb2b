// SPDX-License-Identifier: GPL-3.0-or-later
// The lanes take many steps at a time as long as no link acts. In a step in which links act, the
// lanes first take the floors of all runs under the forces that are known at its start, and solve
// for the contacts that are in lanes too. Then the links of each other run are solved for and
// change its lane, with contacts that close on the way. For anything beyond that, such as a force
// that jumps or a step that is rejected, the run leaves its lane for the step.
#include "solve/ensemble/ensemble_lockstep.h"

#include <math.h>

#include "core/number.h"
#include "solve/contact/contact.h"

// Sets the bit of run k.
static void lockstep_set(unsigned *runs, int k, bool value) {
    *runs = (*runs & ~(1U << k)) | (unsigned)value << k;
}

// Takes run k out of its lane.
static void lockstep_free_lane(struct lockstep *l, int k) {
    unsigned *const of[] = {&l->in_lanes, &l->live, &l->acting, &l->wanted};
    for (int i = 0; i < 4; i++) {
        lockstep_set(of[i], k, false);
    }
    l->lanes.active[k] = 0;
}

void ensemble_lockstep_enter(struct lockstep *l, int k, long n) {
    struct slot *slot = &l->slot[k];
    struct run *r = &slot->run;
    if (ensemble_has(l->fits, k) && work_factor(&r->work, r->model->dt) == STATUS_OK &&
        flight_is_on_lines(&r->flight, r->next, r->now) && ensemble_lanes_enter(&l->lanes, k, r)) {
        run_forget_events(r);
        slot->entered = n;
        lockstep_set(&l->in_lanes, k, true);
        lockstep_set(&l->alone, k, false);
        lockstep_set(&l->live, k, r->now->n_live > 0);
    }
}

void ensemble_lockstep_leave(struct lockstep *l, int k, long n) {
    struct slot *slot = &l->slot[k];
    ensemble_contacts_leave(&l->lanes, k, &slot->run);
    ensemble_lanes_leave(&l->lanes, k, &slot->run, model_time(slot->run.model, n),
                         n - slot->entered);
    lockstep_free_lane(l, k);
    lockstep_set(&l->alone, k, true);
}

void ensemble_lockstep_end(struct lockstep *l, int k, int status) {
    struct slot *slot = &l->slot[k];
    ensemble_contacts_leave(&l->lanes, k, &slot->run);
    lockstep_free_lane(l, k);
    lockstep_set(&l->alone, k, false);
    slot->member->status = analysis_end(&slot->run, status, &slot->member->results);
}

// Gives a run the penetration of contact k, and the velocities of its ends, in a state of its lane.
static void lockstep_gather(const struct ensemble_lanes *e, int lane, int k,
                            const struct ensemble_state *s, struct state *to) {
    to->delta[k] = ensemble_depth(e, k, s, lane);
    for (int i = 0; i < 2; i++) {
        to->v[e->end[k][i]] = s[e->end[k][i]].v[lane];
    }
}

static void lockstep_gather_live(const struct ensemble_lanes *e, int lane,
                                 const struct ensemble_state *s, struct state *to) {
    for (int i = 0; i < to->n_live; i++) {
        lockstep_gather(e, lane, to->live[i], s, to);
    }
}

// Gives it the trial and the corrections of building k.
static void lockstep_show(const struct ensemble_lanes *e, int lane, const struct run *r, int k) {
    const struct building *g = e->building[k].shape;
    for (int i = g->first; i < g->first + g->n_dof; i++) {
        r->work.u_trial[i] = e->trial[i].u[lane];
        r->work.v_trial[i] = e->trial[i].v[lane];
        r->work.correction[i] = e->correction[i][lane];
    }
}

// The links of run k act in step n: links that were closed, or a contact that is pressed.
static void lockstep_begin_run(struct lockstep *l, int k, long n) {
    struct slot *slot = &l->slot[k];
    struct run *r = &slot->run;
    slot->before = r->results->totals;
    r->work.strictness = STEP_STRICT;
    r->now->time = model_time(r->model, n - 1);
    r->next->time = model_time(r->model, n);
    contact_begin(&r->work, r->now, r->next);
    for (int i = 0; i < r->next->n_live; i++) {
        l->lanes.gap[r->next->live[i]].limit[k] = INFINITY;
    }
    lockstep_set(&l->acting, k, true);
    lockstep_set(&l->wanted, k, r->next->n_live > 0);
}

// Contacts that acted in the lane of a run no longer do.
static void lockstep_release(const struct ensemble_lanes *e, int lane, const struct run *r) {
    const struct gaps *g = &r->work.gaps;
    for (int i = 0; i < g->n_acting; i++) {
        e->gap[g->acting[i]].limit[lane] = e->nearest[g->acting[i]].depth[lane];
    }
}

// Run k cannot take step n in its lane, whatever its links have done in it so far.
static void lockstep_give_up(struct lockstep *l, int k, long n) {
    struct slot *slot = &l->slot[k];
    if (ensemble_has(l->acting, k)) {
        slot->run.results->totals = slot->before;
    }
    ensemble_lockstep_leave(l, k, n - 1);
}

// The contacts of some runs, which are in their lanes, cannot take step n there.
static void lockstep_take_out(struct lockstep *l, unsigned runs, long n) {
    EACH_RUN(k, runs) {
        struct run *r = &l->slot[k].run;
        ensemble_contacts_leave(&l->lanes, k, r);
        lockstep_gather_live(&l->lanes, k, l->lanes.now, r->now);
        lockstep_begin_run(l, k, n);
        ensemble_contacts_give(&l->lanes, k, r);
    }
}

// The step n of all floors in lanes, with the forces that live links begin it with.
static void lockstep_move(struct lockstep *l, long n, const wide *base) {
    struct ensemble_lanes *e = &l->lanes;
    e->contacts->solved = 0;
    if (e->contacts->active) {
        ensemble_contacts_begin(e);
    }
    EACH_RUN(k, l->live & ~e->contacts->active) {
        const struct run *r = &l->slot[k].run;
        lockstep_begin_run(l, k, n);
        for (int i = 0; i < r->next->n_live; i++) {
            const int j = r->next->live[i];
            e->acts[j] = true;
            e->force[j][k] = r->next->link[j].force;
        }
    }
    e->steps->move(e, base);
}

// Closes the pressed contacts of a run where they do close; returns how many.
static int lockstep_close(const struct ensemble_lanes *e, int lane, struct run *r) {
    int n = 0;
    for (int i = 0; i < e->n_pressed; i++) {
        const int k = e->pressed[i].contact;
        if (!ensemble_has(e->pressed[i].closed, lane)) {
            continue;
        }
        for (int side = 0; side < 2; side++) {
            const int b = r->model->link[k].building[side];
            if (b != WALL) {
                lockstep_show(e, lane, r, b);
            }
        }
        lockstep_gather(e, lane, k, e->now, r->now);
        lockstep_gather(e, lane, k, e->next, r->next);
        if (contact_close(&r->work, r->now, r->next, k)) {
            e->gap[k].limit[lane] = INFINITY;
            n++;
        }
    }
    return n;
}

// Solves for the forces of the links of a run, which push its buildings in the lane. STATUS_RETRY:
// it has to take this step alone.
static int lockstep_solve_run(const struct ensemble_lanes *e, int lane, struct run *r) {
    const struct gaps *g = &r->work.gaps;
    for (int i = 0; i < g->n_touched; i++) {
        lockstep_show(e, lane, r, g->touched[i]);
    }
    const int status = contact_solve(&r->work, r->now, r->next);
    for (int i = 0; status == STATUS_OK && i < g->n_touched; i++) {
        struct ensemble_building *b = &e->building[g->touched[i]];
        for (int j = b->shape->first; j < b->shape->first + b->shape->n_dof; j++) {
            e->correction[j][lane] = r->work.correction[j];
        }
        b->pushed = true;
    }
    return status;
}

// Solves for the contacts in lanes, but for those of runs that are `pressed`, which leave. Returns
// whether there were any.
static bool lockstep_solve_lanes(struct lockstep *l, long n, unsigned pressed) {
    const struct ensemble_contacts *s = l->lanes.contacts;
    const unsigned left = s->active & ~s->solved & ~pressed;
    lockstep_take_out(l, s->active & pressed, n);
    if (left) {
        ensemble_contacts_solve(&l->lanes);
        lockstep_take_out(l, s->active & ~s->solved, n);
    }
    return left;
}

// Solves for the links of all runs in lanes, which may close others.
static void lockstep_solve(struct lockstep *l, long n, const wide *base) {
    struct ensemble_lanes *e = &l->lanes;
    for (bool again = true; again;) {
        unsigned pressed = 0;
        e->steps->press(e);
        for (int i = 0; i < e->n_pressed; i++) {
            pressed |= e->pressed[i].closed;
        }
        again = lockstep_solve_lanes(l, n, pressed);
        const unsigned asked = pressed | l->wanted;
        EACH_RUN(k, asked) {
            struct run *r = &l->slot[k].run;
            if (!ensemble_has(l->acting, k)) {
                lockstep_begin_run(l, k, n);
            }
            bool closed = ensemble_has(pressed, k) && lockstep_close(e, k, r) > 0;
            if (closed || ensemble_has(l->wanted, k)) {
                again = true;
                lockstep_set(&l->wanted, k, false);
                if (lockstep_solve_run(e, k, r) != STATUS_OK) {
                    lockstep_give_up(l, k, n);
                }
            }
        }
        if (again) {
            e->steps->move_pushed(e, base);
        }
    }
}

// Ends step n of the links outside of the lanes. A run in which a force has jumped gives up.
static void lockstep_finish(struct lockstep *l, long n) {
    EACH_RUN(k, l->acting) {
        struct run *r = &l->slot[k].run;
        lockstep_gather_live(&l->lanes, k, l->lanes.next, r->next);
        contact_finish(&r->work, r->next);
        if (run_step_first_event(&r->work, r->now, r->next, r->work.h, r->events, -1).link >= 0) {
            lockstep_give_up(l, k, n);
        }
    }
    EACH_RUN(k, l->in_lanes) {
        const struct ensemble_works *w = l->lanes.works;
        if ((w->beyond[k] | w->left[k]) < 0) {
            lockstep_give_up(l, k, n);
        }
    }
}

// Takes the links of run k through the step and commits it. Errors: STATUS_SYSTEM.
static int lockstep_commit_run(struct lockstep *l, int k) {
    const struct ensemble_lanes *e = &l->lanes;
    struct run *r = &l->slot[k].run;
    struct state *next = r->next;
    for (int i = 0; i < e->n_pressed; i++) {
        const int j = e->pressed[i].contact;
        if (ensemble_has(e->pressed[i].closed, k)) {
            peaks_penetration(r->results, j, next->delta[j], next->time);
        }
    }
    int status = impacts_step(&r->impacts, r->now, next, r->error);
    r->next = r->now;
    r->now = next;
    lockstep_release(e, k, r);
    lockstep_set(&l->acting, k, false);
    lockstep_set(&l->live, k, next->n_live > 0);
    return status;
}

static void lockstep_commit(struct lockstep *l, long n, const wide *base) {
    struct ensemble_lanes *e = &l->lanes;
    const double start = (double)(n - 1) * e->scheme.h, end = (double)n * e->scheme.h;
    ensemble_approach(e, end);
    if (e->contacts->active) {
        ensemble_contacts_commit(e, end, end - start);
    }
    EACH_RUN(k, l->acting) {
        int status = lockstep_commit_run(l, k);
        if (status == STATUS_OK) {
            ensemble_contacts_enter(e, k, &l->slot[k].run);
        } else {
            ensemble_lockstep_end(l, k, status);
        }
    }
    ensemble_commit(e, base, end);
}

long ensemble_lockstep_advance(struct lockstep *l, long n) {
    struct ensemble_lanes *e = &l->lanes;
    const bool live = l->live != 0;
    const long row = (n + l->every - 1) / l->every * l->every;
    const long last = l->alone || live ? n : number_least(number_least(l->known, l->due), row);
    if (!l->in_lanes) {
        return last;
    }
    const wide *base = e->base + (n + ENSEMBLE_STRETCH - 1 - l->known);
    const int taken = live ? 0 : e->steps->march(e, base, (int)(last - n + 1), n);
    n += taken;
    base += taken;
    if (n > last) {
        return last;
    }
    lockstep_move(l, n, base);
    lockstep_solve(l, n, base);
    lockstep_finish(l, n);
    lockstep_commit(l, n, base);
    return n;
}
