// SPDX-License-Identifier: GPL-3.0-or-later
// Which runs go together, and their time loop.
#include "jostle/ensemble.h"

#include <assert.h>
#include <limits.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "core/number.h"
#include "solve/ensemble_contacts.h"
#include "solve/ensemble_fleet.h"

static_assert((int)ENSEMBLE_MAX == (int)WIDE_RUNS, "a run a lane");

// Lanes of more floors do not fit into the second cache.
enum { FLOORS_MOST = 256 };

// Fewer runs than this are faster alone: a step of the lanes takes as long as some single steps.
enum { RUNS_LEAST = 4 };

enum { POLL_STEPS = 64 * ENSEMBLE_STRETCH };

bool ensemble_suits(const struct model *m) {
    bool suits = !m->adaptive && m->n_storey_history == 0 && !m->chain.full_damping &&
                 m->n_ground == 1 && m->n_load == 0 && m->n_link == m->n_contact &&
                 m->n_dof <= FLOORS_MOST;
    for (int k = 0; suits && k < m->n_link; k++) {
        suits = !m->link[k].law->rebound;
    }
    return suits;
}

bool ensemble_pays(void) {
    return lanes_hold_wide() || lanes_hold_half();
}

bool ensemble_alike(const struct model *a, const struct model *b) {
    bool alike = ensemble_suits(b) && a->n_building == b->n_building && a->n_dof == b->n_dof &&
                 a->n_link == b->n_link && a->beta == b->beta && a->gamma == b->gamma &&
                 a->dt == b->dt && a->output.every == b->output.every;
    for (int k = 0; alike && k < a->n_building; k++) {
        alike = a->building[k].n_floor == b->building[k].n_floor;
    }
    for (int k = 0; alike && k < a->n_link; k++) {
        alike = memcmp(a->link[k].dof, b->link[k].dof, sizeof a->link[k].dof) == 0;
    }
    return alike;
}

static bool same_signal(const struct signal *a, const struct signal *b) {
    if (a->start != b->start || a->end != b->end || !a->value != !b->value) {
        return false;
    }
    if (!a->value) {
        return a->amplitude == b->amplitude && a->omega == b->omega && a->phase == b->phase;
    }
    return a->n == b->n && a->dt == b->dt &&
           memcmp(a->value, b->value, a->n * sizeof *a->value) == 0;
}

static bool same_ground(const struct ground *a, const struct ground *b) {
    bool same = a->n_signal == b->n_signal;
    for (int i = 0; same && i < a->n_signal; i++) {
        same = same_signal(&a->signal[i], &b->signal[i]);
    }
    return same;
}

// The ground accelerations of a run from step n on, for its lane.
static void compute_ground(struct fleet *f, int k, long n) {
    const struct model *m = f->boat[k].run.model;
    const struct ground *g = &m->ground[0];
    double time[ENSEMBLE_STRETCH], value[ENSEMBLE_STRETCH] = {0.0};
    for (int i = 0; i < ENSEMBLE_STRETCH; i++) {
        time[i] = (double)(n + i) * m->dt;
    }
    for (int i = 0; i < g->n_signal; i++) {
        signal_add_values(&g->signal[i], ENSEMBLE_STRETCH, time, value);
    }
    for (int i = 0; i < ENSEMBLE_STRETCH; i++) {
        f->lanes.base[i][k] = value[i];
    }
}

// The ground accelerations of the steps from n on.
static void compute_grounds(struct fleet *f, long n) {
    for (int k = 0; k < f->n; k++) {
        const int same = f->boat[k].ground;
        if (same == k) {
            compute_ground(f, k, n);
        }
        for (int i = 0; i < ENSEMBLE_STRETCH && same < k; i++) {
            f->lanes.base[i][k] = f->lanes.base[i][same];
        }
    }
    f->known = n + ENSEMBLE_STRETCH - 1;
}

// The energies of a row of those aboard.
static void balance(struct fleet *f) {
    struct energy_sums sums[WIDE_RUNS];
    ensemble_sums(&f->lanes, sums);
    for (int k = 0; k < f->n; k++) {
        struct run *r = &f->boat[k].run;
        if (f->boat[k].berth == BERTH_ABOARD) {
            ensemble_contacts_work(&f->lanes, k, &r->energy);
            energy_close(&r->energy, &sums[k], r->results->energy);
            int status = analysis_note_energies(r);
            if (status != STATUS_OK) {
                ensemble_fleet_end(f, k, status);
            }
        }
    }
}

static void poll(struct fleet *f, double time) {
    const struct observer *o = f->observer;
    for (int k = 0; o && o->poll && k < f->n; k++) {
        struct boat *b = &f->boat[k];
        int status = b->berth == BERTH_ABOARD ? o->poll(o->context, time, &b->member->error) : 0;
        if (status != STATUS_OK) {
            ensemble_fleet_end(f, k, status);
        }
    }
}

// Step n of those ashore, some of which come aboard then.
static void step_ashore(struct fleet *f, long n) {
    for (int k = 0; f->n_ashore > 0 && k < f->n; k++) {
        struct boat *b = &f->boat[k];
        if (b->berth != BERTH_ASHORE && b->berth != BERTH_STAYS) {
            continue;
        }
        int status = analysis_step(&b->run, n);
        if (status == STATUS_OK) {
            ensemble_fleet_board(f, k, n);
        } else {
            ensemble_fleet_end(f, k, status);
        }
    }
}

// The last step of a run, which it takes ashore.
static void land(struct fleet *f, int k) {
    struct boat *b = &f->boat[k];
    const long last = b->run.model->n_step;
    if (b->berth == BERTH_ABOARD) {
        ensemble_fleet_leave(f, k, last - 1);
    }
    ensemble_lanes_merge(&f->lanes, k, b->run.results);
    ensemble_fleet_end(f, k, analysis_step(&b->run, last));
}

// Lands the runs that have but one step left after step n, and looks for the next that will.
static void land_due(struct fleet *f, long n) {
    if (n < f->due) {
        return;
    }
    f->due = LONG_MAX;
    for (int k = 0; k < f->n; k++) {
        const struct boat *b = &f->boat[k];
        const long due = b->run.model->n_step - 1;
        if (b->berth != BERTH_ENDED && due == n) {
            land(f, k);
        } else if (b->berth != BERTH_ENDED) {
            f->due = number_least(f->due, due);
        }
    }
}

static void lockstep(struct fleet *f) {
    const double dt = f->boat[0].run.model->dt;
    land_due(f, 0);
    for (long n = 1; f->n_aboard + f->n_ashore > 0; n++) {
        if (n > f->known) {
            compute_grounds(f, n);
            if (n % POLL_STEPS == 1) {
                poll(f, (double)(n - 1) * dt);
            }
        }
        n = ensemble_fleet_cruise(f, n);
        if (n % f->every == 0 && f->n_aboard > 0) {
            balance(f);
        }
        step_ashore(f, n);
        land_due(f, n);
    }
}

static int first_with_ground(const struct fleet *f, const struct model *m) {
    int k = 0;
    while (k < f->n && !same_ground(f->boat[k].run.model->ground, m->ground)) {
        k++;
    }
    return k;
}

// Starts a run, and takes it aboard if it can go in lanes.
static void start(struct fleet *f, struct ensemble_member *member) {
    const struct model *m = member->model;
    const int k = f->n;
    struct boat *b = &f->boat[k];
    b->member = member;
    member->results = NULL;
    b->ground = first_with_ground(f, m);
    b->berth = BERTH_STAYS;
    f->n++;
    f->n_ashore++;
    int status = analysis_begin(&b->run, m, f->observer, &member->error);
    if (status != STATUS_OK) {
        ensemble_fleet_end(f, k, status);
    } else if (work_factor(&b->run.work, m->dt) == STATUS_OK &&
               ensemble_lanes_fill(&f->lanes, k, &b->run)) {
        b->berth = BERTH_ASHORE;
        ensemble_fleet_board(f, k, 0);
    }
}

// Runs the `n` members of models alike in lockstep. STATUS_SYSTEM: no memory.
static int run_alike(const struct ensemble_steps *steps, struct ensemble_member **member, int n,
                     const struct observer *observer, struct arena *a, struct error *e) {
    const struct model *m = member[0]->model;
    struct fleet *f = a ? arena_alloc(a, 1, sizeof *f) : NULL;
    if (!f || !ensemble_lanes_alloc(&f->lanes, m, steps, a)) {
        return error_no_memory(e);
    }
    f->observer = observer;
    f->every = observer ? m->output.every : INT_MAX;
    for (int k = 0; k < n; k++) {
        start(f, member[k]);
    }
    ensemble_lanes_share(&f->lanes, n);
    lockstep(f);
    return STATUS_OK;
}

static void run_together(const struct ensemble_steps *steps, struct ensemble_member **member, int n,
                         const struct observer *observer) {
    struct error e;
    struct arena *a = arena_create();
    int status = run_alike(steps, member, n, observer, a, &e);
    for (int k = 0; status != STATUS_OK && k < n; k++) {
        member[k]->status = status;
        member[k]->error = e;
    }
    arena_free(a);
}

// Takes member k and those behind it that are alike out of `left`; returns how many.
static int take_alike(struct ensemble_member *member, int n, int k, bool *left,
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

void ensemble_run_by(const struct ensemble_steps *steps, struct ensemble_member *member, int n,
                     const struct observer *observer) {
    bool left[ENSEMBLE_MAX];
    memset(left, true, sizeof left);
    for (int k = 0; k < n; k++) {
        struct ensemble_member *alike[ENSEMBLE_MAX];
        const bool alone = (observer && observer->row) || !ensemble_suits(member[k].model);
        const int n_alike = left[k] ? take_alike(member, alone ? k + 1 : n, k, left, alike) : 0;
        if (n_alike >= RUNS_LEAST) {
            run_together(steps, alike, n_alike, observer);
            continue;
        }
        for (int i = 0; i < n_alike; i++) {
            struct ensemble_member *m = alike[i];
            m->results = NULL;
            m->status = analysis_run(m->model, observer, &m->results, &m->error);
        }
    }
}

void ensemble_run(struct ensemble_member *member, int n, const struct observer *observer) {
    ensemble_run_by(lanes_hold_wide() ? &ensemble_whole : &ensemble_half, member, n, observer);
}
