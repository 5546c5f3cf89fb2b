// SPDX-License-Identifier: GPL-3.0-or-later
// The lanes take many steps at a time as long as no link acts. In a step in which links act, the
// lanes first take the floors of all runs under the forces that are known at its start, and solve
// for the contacts that are in lanes too (ensemble_contacts.h). Then the links of each other run
// are solved for and change its lane, with contacts that close on the way. For anything beyond
// that, such as a force that jumps or a step that is rejected, the run leaves its lane for the
// step.
#include "solve/ensemble/ensemble_lockstep.h"

#include "core/number.h"
#include "solve/ensemble/ensemble_contacts.h"
#include "solve/ensemble/ensemble_links.h"

// Sets the bit of run k.
static void set_run(unsigned *runs, int k, bool value) {
    *runs = (*runs & ~(1U << k)) | (unsigned)value << k;
}

static void forget(struct lockstep *l, int k) {
    set_run(&l->live, k, false);
    set_run(&l->acting, k, false);
    set_run(&l->wanted, k, false);
}

void ensemble_lockstep_enter(struct lockstep *l, int k, long n) {
    struct slot *slot = &l->slot[k];
    struct run *r = &slot->run;
    if (slot->mode == SLOT_ALONE && work_factor(&r->work, r->model->dt) == STATUS_OK &&
        ensemble_lanes_enter(&l->lanes, k, r)) {
        run_forget_events(r);
        slot->mode = SLOT_IN_LANES;
        slot->entered = n;
        l->n_in_lanes++;
        l->n_alone--;
        set_run(&l->live, k, r->now->n_live > 0);
    }
}

void ensemble_lockstep_leave(struct lockstep *l, int k, long n) {
    struct slot *slot = &l->slot[k];
    ensemble_contacts_leave(&l->lanes, k, &slot->run);
    ensemble_lanes_leave(&l->lanes, k, &slot->run, model_time(slot->run.model, n),
                         n - slot->entered);
    slot->mode = SLOT_ALONE;
    l->n_in_lanes--;
    l->n_alone++;
    forget(l, k);
}

void ensemble_lockstep_end(struct lockstep *l, int k, int status) {
    struct slot *slot = &l->slot[k];
    ensemble_contacts_leave(&l->lanes, k, &slot->run);
    *(slot->mode == SLOT_IN_LANES ? &l->n_in_lanes : &l->n_alone) -= 1;
    slot->mode = SLOT_ENDED;
    ensemble_lanes_clear(&l->lanes, k);
    forget(l, k);
    slot->member->status = analysis_end(&slot->run, status, &slot->member->results);
}

// The links of run k act in step n.
static void begin_links_of(struct lockstep *l, int k, long n) {
    struct slot *slot = &l->slot[k];
    const struct model *m = slot->run.model;
    slot->before = slot->run.results->totals;
    ensemble_links_begin(&l->lanes, k, &slot->run, model_time(m, n - 1), model_time(m, n));
    set_run(&l->acting, k, true);
    set_run(&l->wanted, k, slot->run.next->n_live > 0);
}

// Run k cannot take step n in its lane, whatever its links have done in it so far.
static void give_up(struct lockstep *l, int k, long n) {
    struct slot *slot = &l->slot[k];
    if (ensemble_has(l->acting, k)) {
        slot->run.results->totals = slot->before;
        ensemble_links_release(&l->lanes, k, &slot->run);
    }
    ensemble_lockstep_leave(l, k, n - 1);
}

// The contacts of run k, which are in its lane, cannot take step n there.
static void take_contacts_out(struct lockstep *l, int k, long n) {
    struct run *r = &l->slot[k].run;
    ensemble_contacts_leave(&l->lanes, k, r);
    ensemble_links_recall(&l->lanes, k, r);
    begin_links_of(l, k, n);
    ensemble_contacts_give(&l->lanes, k, r);
}

// The step n of all floors in lanes, with the forces that live links begin it with.
static void begin_links(struct lockstep *l, long n, const wide *base) {
    if (l->lanes.contacts->active) {
        ensemble_contacts_begin(&l->lanes);
    }
    EACH_RUN(k, l->live & ~l->lanes.contacts->active) {
        begin_links_of(l, k, n);
        ensemble_links_push(&l->lanes, k, &l->slot[k].run);
    }
    l->lanes.steps->move(&l->lanes, base);
}

static unsigned find_pressed(struct ensemble_lanes *e) {
    unsigned runs = 0;
    ensemble_press(e);
    for (int i = 0; i < e->n_pressed; i++) {
        runs |= e->pressed[i].closed;
    }
    return runs;
}

// Closes the pressed contacts of run k, and solves for its links where that is to be done anew:
// returns whether it was.
static bool solve_links(struct lockstep *l, int k, long n, bool pressed) {
    struct run *r = &l->slot[k].run;
    if (pressed && !ensemble_has(l->acting, k)) {
        begin_links_of(l, k, n);
    }
    bool closed = pressed && ensemble_links_close(&l->lanes, k, r) > 0;
    if (!closed && !ensemble_has(l->wanted, k)) {
        return false;
    }
    set_run(&l->wanted, k, false);
    if (ensemble_links_solve(&l->lanes, k, r) != STATUS_OK) {
        give_up(l, k, n);
    }
    return true;
}

// Solves for the contacts in lanes, but for those of runs that are `pressed`, which leave.
// Returns whether there were any.
static bool solve_in_lanes(struct lockstep *l, long n, unsigned pressed) {
    const struct ensemble_contacts *s = l->lanes.contacts;
    const unsigned left = s->active & ~s->solved;
    EACH_RUN(k, s->active & pressed) {
        take_contacts_out(l, k, n);
    }
    if (!(s->active & left)) {
        return false;
    }
    ensemble_contacts_solve(&l->lanes);
    EACH_RUN(k, s->active & ~s->solved) {
        take_contacts_out(l, k, n);
    }
    return true;
}

// Solves for the links of all runs in lanes, which may close others.
static void solve_all_links(struct lockstep *l, long n, const wide *base) {
    for (bool again = true; again;) {
        const unsigned pressed = find_pressed(&l->lanes);
        again = solve_in_lanes(l, n, pressed);
        const unsigned asked = pressed | l->wanted;
        EACH_RUN(k, asked) {
            again |= solve_links(l, k, n, ensemble_has(pressed, k));
        }
        if (again) {
            l->lanes.steps->move_pushed(&l->lanes, base);
        }
    }
    EACH_RUN(k, l->acting) {
        if (ensemble_links_finish(&l->lanes, k, &l->slot[k].run) != STATUS_OK) {
            give_up(l, k, n);
        }
    }
}

static void commit_step(struct lockstep *l, long n, const wide *base) {
    const double start = (double)(n - 1) * l->lanes.h, end = (double)n * l->lanes.h;
    if (l->lanes.contacts->active) {
        ensemble_contacts_commit(&l->lanes, end, end - start);
    }
    EACH_RUN(k, l->acting) {
        struct run *r = &l->slot[k].run;
        int status = ensemble_links_commit(&l->lanes, k, r);
        set_run(&l->acting, k, false);
        set_run(&l->live, k, r->now->n_live > 0);
        if (status == STATUS_OK) {
            ensemble_contacts_enter(&l->lanes, k, r);
        } else {
            ensemble_lockstep_end(l, k, status);
        }
    }
    ensemble_commit(&l->lanes, base, end);
}

long ensemble_lockstep_advance(struct lockstep *l, long n) {
    struct ensemble_lanes *e = &l->lanes;
    const bool live = l->live != 0;
    const long row = (n + l->every - 1) / l->every * l->every;
    const long last =
        l->n_alone > 0 || live ? n : number_least(number_least(l->known, l->due), row);
    if (l->n_in_lanes == 0) {
        return last;
    }
    const wide *base = e->base + (n + ENSEMBLE_STRETCH - 1 - l->known);
    const int taken = live ? 0 : e->steps->march(e, base, (int)(last - n + 1), n);
    n += taken;
    base += taken;
    if (n > last) {
        return last;
    }
    e->contacts->solved = 0;
    begin_links(l, n, base);
    solve_all_links(l, n, base);
    const unsigned leaving = ensemble_overflows(e);
    EACH_RUN(k, leaving) {
        give_up(l, k, n);
    }
    ensemble_approach(e, (double)n * e->h);
    commit_step(l, n, base);
    return n;
}
