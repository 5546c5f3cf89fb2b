// SPDX-License-Identifier: GPL-3.0-or-later
// Which runs go together, and their time loop.
#include "jostle/ensemble.h"

#include <assert.h>
#include <limits.h>
#include <string.h>

#include "core/arena.h"
#include "core/number.h"
#include "solve/ensemble/ensemble_lockstep.h"

static_assert((int)ENSEMBLE_MAX == (int)WIDE_RUNS, "a run a lane");

// Lanes of more floors do not fit into the second cache.
enum { FLOORS_MOST = 256 };

// Fewer runs than this are faster alone: a step of the lanes takes as long as some single steps.
enum { RUNS_LEAST = 4 };

// Where a register holds half of the lanes, single runs of up to 16 floors are as fast, and so are
// those of 30 floors (make bench-half).
enum { HALF_FLOORS_ABOVE = 16, HALF_FLOORS_MOST = 26 };

enum { POLL_STEPS = 64 * ENSEMBLE_STRETCH };

bool ensemble_suits(const struct model *m) {
    bool suits = !m->adaptive && !m->chain.full_damping && !m->chain.parts && m->n_ground == 1 &&
                 m->n_load == 0 && m->n_link == m->n_contact && m->n_dof <= FLOORS_MOST;
    for (int i = 0; suits && i < m->n_dof; i++) {
        suits = m->storey[i].law->branch && m->storey[i].pdelta == 0.0 &&
                !yielding_differs(&m->storey[i]);
    }
    for (int k = 0; suits && k < m->n_link; k++) {
        suits = !m->link[k].law->rebound && link_is_plain(&m->link[k]);
    }
    return suits;
}

bool ensemble_pays_with(int in_register, int n_dof) {
    return in_register >= WIDE_RUNS ||
           (in_register >= WIDE_RUNS / 2 && n_dof > HALF_FLOORS_ABOVE && n_dof <= HALF_FLOORS_MOST);
}

bool ensemble_pays(const struct model *m) {
    int in_register = lanes_hold_wide() ? WIDE_RUNS : lanes_hold_half() ? WIDE_RUNS / 2 : 1;
    return ensemble_pays_with(in_register, m->n_dof);
}

bool ensemble_alike(const struct model *a, const struct model *b) {
    bool alike = ensemble_suits(b) && a->n_building == b->n_building && a->n_dof == b->n_dof &&
                 a->n_link == b->n_link && a->beta == b->beta && a->gamma == b->gamma &&
                 a->dt == b->dt && a->output.every == b->output.every;
    for (int k = 0; alike && k < a->n_building; k++) {
        alike = a->building[k].n_dof == b->building[k].n_dof;
    }
    for (int i = 0; alike && i < a->n_dof; i++) {
        alike = a->storey[i].law->n_history == b->storey[i].law->n_history;
    }
    for (int k = 0; alike && k < a->n_link; k++) {
        alike = memcmp(a->link[k].dof, b->link[k].dof, sizeof a->link[k].dof) == 0;
    }
    return alike;
}

static bool ensemble_same_ground(const struct ground *a, const struct ground *b) {
    bool same = a->n_signal == b->n_signal;
    for (int i = 0; same && i < a->n_signal; i++) {
        const struct signal *x = &a->signal[i], *y = &b->signal[i];
        same = x->start == y->start && x->end == y->end && x->n == y->n && x->dt == y->dt &&
               x->amplitude == y->amplitude && x->omega == y->omega && x->phase == y->phase &&
               (x->n == 0 || memcmp(x->value, y->value, x->n * sizeof *x->value) == 0);
    }
    return same;
}

// The ground accelerations of the steps from n on. Runs whose grounds move in the same way share
// them, but may end at different times. So steps have their full length even beyond the end of a
// run, unlike those of model_times.
static void ensemble_compute_grounds(struct lockstep *l, long n) {
    for (int k = 0; k < l->n; k++) {
        const struct model *m = l->slot[k].run.model;
        const struct ground *g = &m->ground[0];
        const int same = l->slot[k].ground;
        double time[ENSEMBLE_STRETCH], value[ENSEMBLE_STRETCH] = {0.0};
        for (int i = 0; i < ENSEMBLE_STRETCH; i++) {
            time[i] = (double)(n + i) * m->dt;
        }
        for (int i = 0; same == k && i < g->n_signal; i++) {
            signal_add_values(&g->signal[i], ENSEMBLE_STRETCH, time, value);
        }
        for (int i = 0; i < ENSEMBLE_STRETCH; i++) {
            l->lanes.base[i][k] = same == k ? value[i] : l->lanes.base[i][same];
        }
    }
    l->known = n + ENSEMBLE_STRETCH - 1;
}

// The energies of a row of runs in lanes.
static void ensemble_balance(struct lockstep *l) {
    struct energy_sums sums[WIDE_RUNS];
    l->lanes.steps->catch_up(&l->lanes);
    ensemble_lanes_sum(&l->lanes, sums);
    EACH_RUN(k, l->in_lanes) {
        struct run *r = &l->slot[k].run;
        if (ensemble_has(l->lanes.contacts->active, k)) {
            r->energy.contact = l->lanes.contacts->work[k];
        }
        energy_close(&r->energy, &sums[k], r->results->energy);
        int status = analysis_note_energies(r);
        if (status != STATUS_OK) {
            ensemble_lockstep_end(l, k, status);
        }
    }
}

static void ensemble_poll(struct lockstep *l, double time) {
    const struct observer *o = l->observer;
    EACH_RUN(k, o && o->poll ? l->in_lanes : 0U) {
        int status = o->poll(o->context, time, &l->slot[k].member->error);
        if (status != STATUS_OK) {
            ensemble_lockstep_end(l, k, status);
        }
    }
}

// Step n of runs that are alone, some of which enter their lanes then.
static void ensemble_step_alone(struct lockstep *l, long n) {
    EACH_RUN(k, l->alone) {
        int status = analysis_step(&l->slot[k].run, n);
        if (status == STATUS_OK) {
            ensemble_lockstep_enter(l, k, n);
        } else {
            ensemble_lockstep_end(l, k, status);
        }
    }
}

// Ends the runs that have but one step left after step n, and looks for the next that will. The
// last step may be shorter: a run takes it alone.
static void ensemble_end_due(struct lockstep *l, long n) {
    if (n < l->due) {
        return;
    }
    l->due = LONG_MAX;
    EACH_RUN(k, l->in_lanes | l->alone) {
        struct run *r = &l->slot[k].run;
        const long last = r->model->n_step;
        if (last - 1 > n) {
            l->due = number_least(l->due, last - 1);
            continue;
        }
        if (ensemble_has(l->in_lanes, k)) {
            ensemble_lockstep_leave(l, k, n);
        }
        ensemble_lanes_merge(&l->lanes, k, r->results);
        ensemble_lockstep_end(l, k, analysis_step(r, last));
    }
}

static void ensemble_lockstep(struct lockstep *l) {
    const double dt = l->slot[0].run.model->dt;
    ensemble_end_due(l, 0);
    for (long n = 1; l->in_lanes | l->alone; n++) {
        if (n > l->known) {
            ensemble_compute_grounds(l, n);
            if (n % POLL_STEPS == 1) {
                ensemble_poll(l, (double)(n - 1) * dt);
            }
        }
        n = ensemble_lockstep_advance(l, n);
        if (n % l->every == 0 && l->in_lanes) {
            ensemble_balance(l);
        }
        ensemble_step_alone(l, n);
        ensemble_end_due(l, n);
    }
}

// Starts a run, in a lane if it can go there.
static void ensemble_start(struct lockstep *l, struct ensemble_member *member) {
    const struct model *m = member->model;
    const int k = l->n++;
    struct slot *slot = &l->slot[k];
    slot->member = member;
    slot->run.model = m;
    while (!ensemble_same_ground(l->slot[slot->ground].run.model->ground, m->ground)) {
        slot->ground++;
    }
    l->alone |= 1U << k;
    int status = analysis_begin(&slot->run, m, l->observer, &member->error);
    if (status != STATUS_OK) {
        ensemble_lockstep_end(l, k, status);
    } else if (work_factor(&slot->run.work, m->dt) == STATUS_OK &&
               ensemble_lanes_fill(&l->lanes, k, &slot->run)) {
        l->fits |= 1U << k;
        ensemble_lockstep_enter(l, k, 0);
    }
}

// Runs the `n` members of models alike in lockstep.
static void ensemble_run_alike(const struct ensemble_steps *steps, struct ensemble_member **member,
                               int n, const struct observer *observer) {
    const struct model *m = member[0]->model;
    struct arena *a = arena_create();
    struct lockstep *l = a ? arena_alloc(a, 1, sizeof *l) : NULL;
    if (l && ensemble_lanes_alloc(&l->lanes, m, steps, a)) {
        l->observer = observer;
        l->every = observer ? m->output.every : INT_MAX;
        for (int k = 0; k < n; k++) {
            ensemble_start(l, member[k]);
        }
        ensemble_lanes_share(&l->lanes, n);
        ensemble_lockstep(l);
    } else {
        for (int k = 0; k < n; k++) {
            member[k]->status = error_no_memory(&member[k]->error);
        }
    }
    arena_free(a);
}

// Takes member k and those behind it that are alike out of `left`; returns how many.
static int ensemble_take_alike(struct ensemble_member *member, int n, int k, bool *left,
                               struct ensemble_member **alike) {
    int n_alike = 0;
    for (int i = k; i < n; i++) {
        if (left[i] && (i == k || ensemble_alike(member[k].model, member[i].model))) {
            alike[n_alike++] = &member[i];
            left[i] = false;
        }
    }
    return n_alike;
}

// Has a run passed a limit of drift? The lanes do not look for that. What came after it, such as a
// failure, counts no more.
static bool ensemble_collapses(const struct ensemble_member *member) {
    const struct model *m = member->model;
    bool passed = member->status == STATUS_COLLAPSE || member->status == STATUS_FAILED;
    for (int i = 0; m->collapse && member->status == STATUS_OK && i < m->n_dof; i++) {
        passed = passed || member->results->peak[PEAK_DRIFT][i] >= m->collapse[i];
    }
    return m->collapse && passed;
}

// Runs a member alone.
static void ensemble_run_alone(struct ensemble_member *m, const struct observer *observer) {
    m->status = analysis_run(m->model, observer, &m->results, &m->error);
}

void ensemble_run_by(const struct ensemble_steps *steps, struct ensemble_member *member, int n,
                     const struct observer *observer) {
    bool left[ENSEMBLE_MAX];
    memset(left, true, sizeof left);
    for (int k = 0; k < n; k++) {
        struct ensemble_member *alike[ENSEMBLE_MAX];
        const bool alone = (observer && observer->row) || !ensemble_suits(member[k].model);
        const int n_alike =
            left[k] ? ensemble_take_alike(member, alone ? k + 1 : n, k, left, alike) : 0;
        for (int i = 0; i < n_alike; i++) {
            alike[i]->results = NULL;
        }
        if (n_alike >= RUNS_LEAST) {
            ensemble_run_alike(steps, alike, n_alike, observer);
        }
        for (int i = 0; i < n_alike; i++) {
            const bool again = n_alike >= RUNS_LEAST && ensemble_collapses(alike[i]);
            if (again && alike[i]->status == STATUS_OK) {
                results_free(alike[i]->results);
            }
            if (again || n_alike < RUNS_LEAST) {
                alike[i]->results = NULL;
                ensemble_run_alone(alike[i], observer);
            }
        }
    }
}

void ensemble_run(struct ensemble_member *member, int n, const struct observer *observer) {
    ensemble_run_by(lanes_hold_wide() ? &ensemble_whole : &ensemble_half, member, n, observer);
}
