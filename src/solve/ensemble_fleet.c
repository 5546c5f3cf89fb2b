// SPDX-License-Identifier: GPL-3.0-or-later
// A step in which no link acts is one of many that the lanes take at a time. In one in which links
// act, the lanes take the floors of all runs as far as the forces are known that these begin with,
// and then the contacts of runs that are stowed (ensemble_contacts.h). The links of each other run
// then change its lane; contacts that close on the way join them. What goes beyond that, such as a
// force that jumps or a step that has to be cut, takes the run ashore for the step.
#include "solve/ensemble_fleet.h"

#include "core/number.h"
#include "solve/ensemble_contacts.h"
#include "solve/ensemble_links.h"

// Sets the bit of run k.
static void set_run(unsigned *runs, int k, bool value) {
    *runs = (*runs & ~(1U << k)) | (unsigned)value << k;
}

static void forget(struct fleet *f, int k) {
    set_run(&f->live, k, false);
    set_run(&f->acting, k, false);
    set_run(&f->wanted, k, false);
}

void ensemble_fleet_board(struct fleet *f, int k, long n) {
    struct boat *b = &f->boat[k];
    struct run *r = &b->run;
    if (b->berth == BERTH_ASHORE && work_factor(&r->work, r->model->dt) == STATUS_OK &&
        ensemble_board(&f->lanes, k, r)) {
        run_forget_events(r);
        b->berth = BERTH_ABOARD;
        b->boarded = n;
        f->n_aboard++;
        f->n_ashore--;
        set_run(&f->live, k, r->now->n_live > 0);
    }
}

void ensemble_fleet_leave(struct fleet *f, int k, long n) {
    struct boat *b = &f->boat[k];
    ensemble_contacts_take_out(&f->lanes, k, &b->run);
    ensemble_leave(&f->lanes, k, &b->run, model_time(b->run.model, n), n - b->boarded);
    b->berth = BERTH_ASHORE;
    f->n_aboard--;
    f->n_ashore++;
    forget(f, k);
}

void ensemble_fleet_end(struct fleet *f, int k, int status) {
    struct boat *b = &f->boat[k];
    ensemble_contacts_take_out(&f->lanes, k, &b->run);
    *(b->berth == BERTH_ABOARD ? &f->n_aboard : &f->n_ashore) -= 1;
    b->berth = BERTH_ENDED;
    ensemble_clear(&f->lanes, k);
    forget(f, k);
    b->member->status = analysis_end(&b->run, status, &b->member->results);
}

// The links of run k act in step n.
static void begin_links_of(struct fleet *f, int k, long n) {
    struct boat *b = &f->boat[k];
    const struct model *m = b->run.model;
    b->before = b->run.results->totals;
    ensemble_links_begin(&f->lanes, k, &b->run, model_time(m, n - 1), model_time(m, n));
    set_run(&f->acting, k, true);
    set_run(&f->wanted, k, b->run.next->n_live > 0);
}

// Run k cannot take step n aboard, whatever its links have done in it so far.
static void give_up(struct fleet *f, int k, long n) {
    struct boat *b = &f->boat[k];
    if (ensemble_has(f->acting, k)) {
        b->run.results->totals = b->before;
        ensemble_links_release(&f->lanes, k, &b->run);
    }
    ensemble_fleet_leave(f, k, n - 1);
}

static bool is_stowed(const struct fleet *f, int k) {
    return ensemble_has(f->lanes.contacts->stowed, k);
}

// The links of run k, which is stowed, cannot take step n with those of others.
static void take_out(struct fleet *f, int k, long n) {
    struct run *r = &f->boat[k].run;
    ensemble_contacts_take_out(&f->lanes, k, r);
    ensemble_links_recall(&f->lanes, k, r);
    begin_links_of(f, k, n);
    ensemble_contacts_give(&f->lanes, k, r);
}

// The step n of all floors aboard, with the forces that live links begin it with.
static void begin_links(struct fleet *f, long n, const wide *base) {
    if (f->lanes.contacts->stowed) {
        ensemble_contacts_begin(&f->lanes);
    }
    for (int k = 0; k < f->n; k++) {
        if (ensemble_has(f->live, k) && !is_stowed(f, k)) {
            begin_links_of(f, k, n);
            ensemble_links_push(&f->lanes, k, &f->boat[k].run);
        }
    }
    f->lanes.steps->move(&f->lanes, base);
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
static bool solve_links(struct fleet *f, int k, long n, bool pressed) {
    struct run *r = &f->boat[k].run;
    if (pressed && !ensemble_has(f->acting, k)) {
        begin_links_of(f, k, n);
    }
    bool closed = pressed && ensemble_links_close(&f->lanes, k, r) > 0;
    if (!closed && !ensemble_has(f->wanted, k)) {
        return false;
    }
    set_run(&f->wanted, k, false);
    if (ensemble_links_solve(&f->lanes, r) != STATUS_OK) {
        give_up(f, k, n);
    }
    return true;
}

// Solves for the links of runs that are stowed, but for those `pressed`; the others are taken out.
// Returns whether there were any.
static bool solve_stowed(struct fleet *f, long n, unsigned pressed) {
    const struct ensemble_contacts *s = f->lanes.contacts;
    const unsigned left = s->stowed & ~s->solved;
    for (int k = 0; s->stowed & pressed && k < f->n; k++) {
        if (ensemble_has(s->stowed & pressed, k)) {
            take_out(f, k, n);
        }
    }
    if (!(s->stowed & left)) {
        return false;
    }
    ensemble_contacts_solve(&f->lanes);
    const unsigned given_up = s->stowed & ~s->solved;
    for (int k = 0; given_up && k < f->n; k++) {
        if (ensemble_has(given_up, k)) {
            take_out(f, k, n);
        }
    }
    return true;
}

// Solves for the links of all runs aboard, which may close others.
static void solve_all_links(struct fleet *f, long n, const wide *base) {
    for (bool again = true; again;) {
        const unsigned pressed = find_pressed(&f->lanes);
        again = solve_stowed(f, n, pressed);
        const unsigned asked = pressed | f->wanted;
        for (int k = 0; asked && k < f->n; k++) {
            again |= ensemble_has(asked, k) && solve_links(f, k, n, ensemble_has(pressed, k));
        }
        if (again) {
            f->lanes.steps->move_pushed(&f->lanes, base);
        }
    }
    for (int k = 0; f->acting && k < f->n; k++) {
        if (ensemble_has(f->acting, k) &&
            ensemble_links_finish(&f->lanes, k, &f->boat[k].run) != STATUS_OK) {
            give_up(f, k, n);
        }
    }
}

// Takes a closer look at the step n that has been computed, in which a peak is exceeded.
static void raise_peaks(struct fleet *f, long n, const wide *base) {
    const unsigned leaving = ensemble_overflows(&f->lanes, base);
    for (int k = 0; leaving && k < f->n; k++) {
        if (ensemble_has(leaving, k)) {
            give_up(f, k, n);
        }
    }
    ensemble_raise(&f->lanes, base, (double)n * f->lanes.h);
}

static void commit_step(struct fleet *f, long n, const wide *base) {
    const double start = (double)(n - 1) * f->lanes.h, end = (double)n * f->lanes.h;
    if (f->lanes.contacts->stowed) {
        ensemble_contacts_commit(&f->lanes, end, end - start);
    }
    for (int k = 0; f->acting && k < f->n; k++) {
        if (!ensemble_has(f->acting, k)) {
            continue;
        }
        struct run *r = &f->boat[k].run;
        int status = ensemble_links_commit(&f->lanes, k, r);
        set_run(&f->acting, k, false);
        set_run(&f->live, k, r->now->n_live > 0);
        if (status == STATUS_OK) {
            ensemble_contacts_stow(&f->lanes, k, r);
        } else {
            ensemble_fleet_end(f, k, status);
        }
    }
    f->lanes.steps->commit(&f->lanes, base);
}

long ensemble_fleet_cruise(struct fleet *f, long n) {
    struct ensemble_lanes *e = &f->lanes;
    const bool live = f->live != 0;
    const long row = (n + f->every - 1) / f->every * f->every;
    const long last =
        f->n_ashore > 0 || live ? n : number_least(number_least(f->known, f->due), row);
    if (f->n_aboard == 0) {
        return last;
    }
    const wide *base = e->base + (n + ENSEMBLE_STRETCH - 1 - f->known);
    bool presses = live;
    const int taken = live ? 0 : e->steps->march(e, base, (int)(last - n + 1), &presses);
    n += taken;
    base += taken;
    if (n > last) {
        return last;
    }
    e->contacts->solved = 0;
    if (live) {
        begin_links(f, n, base);
    }
    e->n_pressed = 0;
    if (presses) {
        solve_all_links(f, n, base);
    }
    if (ensemble_exceeds(e)) {
        raise_peaks(f, n, base);
    }
    commit_step(f, n, base);
    return n;
}
