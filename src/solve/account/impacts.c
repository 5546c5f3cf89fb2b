// SPDX-License-Identifier: GPL-3.0-or-later
// The account of every impact: from closure to opening, located within their steps.
#include "solve/account/account.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "solve/account/impact_step.h"
#include "solve/event/hermite.h"

bool impacts_alloc(struct impact_log *log, const struct model *m, struct results *r,
                   struct energy_account *energy, struct arena *a) {
    log->model = m;
    log->results = r;
    log->energy = energy;
    log->open = arena_alloc(a, (size_t)m->n_contact, sizeof *log->open);
    for (int k = 0; log->open && k < m->n_contact; k++) {
        log->open[k] = -1;
    }
    return log->open != NULL;
}

// Makes room for n impacts; false: no memory.
static bool impacts_reserve(struct results *r, long n) {
    long capacity = r->impact_capacity ? r->impact_capacity : 256;
    while (capacity < n) {
        capacity *= 2;
    }
    if (capacity > r->impact_capacity) {
        struct impact *larger = realloc(r->impact, (size_t)capacity * sizeof *larger);
        if (!larger) {
            return false;
        }
        r->impact = larger;
        r->impact_capacity = capacity;
    }
    return true;
}

bool impacts_copy(struct impact_log *to, const struct impact_log *from) {
    const struct results *r = from->results;
    if (!impacts_reserve(to->results, r->n_impact)) {
        return false;
    }
    if (r->n_impact > 0) {
        memcpy(to->results->impact, r->impact, (size_t)r->n_impact * sizeof *r->impact);
    }
    to->results->n_impact = r->n_impact;
    memcpy(to->open, from->open, (size_t)from->model->n_contact * sizeof *to->open);
    return true;
}

static int impacts_open(struct impact_log *log, const struct state *s, int k, struct error *e) {
    struct results *r = log->results;
    if (!impacts_reserve(r, r->n_impact + 1)) {
        return error_no_memory(e);
    }
    log->open[k] = r->n_impact;
    r->impact[r->n_impact++] = (struct impact){
        .contact = k,
        .t_start = s->link[k].t_close,
        .v_approach = s->link[k].v_close,
        .peak_force = fmax(s->link[k].force, 0.0),
        .max_penetration = fmax(s->delta[k], 0.0),
    };
    r->link[k].impacts++;
    return STATUS_OK;
}

int impacts_start(struct impact_log *log, const struct state *s, struct error *e) {
    const struct results *r = log->results;
    for (int k = 0; k < log->model->n_contact; k++) {
        if (!s->link[k].closed) {
            continue;
        }
        if (impacts_open(log, s, k, e) != STATUS_OK) {
            return e->status;
        }
        r->impact[log->open[k]].dissipated = r->link[k].dissipated;  // what it holds already
    }
    return STATUS_OK;
}

// Ends the impact under way of contact k, whose penetration grows at `rate` then.
static void impacts_end(struct impact_log *log, int k, double time, double rate) {
    struct impact *i = &log->results->impact[log->open[k]];
    i->t_end = time;
    i->v_rebound = -rate;
    i->complete = true;
    log->open[k] = -1;
}

double impacts_opening(const struct model *m, const struct state *now, const struct state *next,
                       double h, int k, double *rate) {
    const struct path path = {fmax(now->delta[k], 0.0), state_rate(now, m, k),
                              fmin(next->delta[k], 0.0), state_rate(next, m, k), h};
    return hermite_crossing(&path, rate);
}

void impacts_add(const struct impact_log *log, int k, const struct impact_share *share) {
    struct results *r = log->results;
    const bool hits = k < log->model->n_contact && log->open[k] >= 0;
    struct impact *impact = hits ? &r->impact[log->open[k]] : NULL;
    impact_add_share(&r->link[k], impact, share);
    if (impact) {
        impact->steps += share->steps;
    }
}

// Where the grounds of a link's ends move differently, its force works on them too.
static double impacts_ground_work(const struct model *m, int k, const struct state *now,
                                  const struct state *next) {
    const struct link *l = &m->link[k];
    double mean = (now->link[k].force + next->link[k].force) / 2.0;
    double relative =
        state_gap(l, m, next->u, next->ground_u) - state_gap(l, m, now->u, now->ground_u);
    double own = link_across(l, next->u) - link_across(l, now->u);
    return mean * (relative - own);
}

int impacts_step(struct impact_log *log, const struct state *now, const struct state *next,
                 struct error *e) {
    const struct model *m = log->model;
    double h = next->time - now->time;
    double contact = 0.0;
    for (int j = 0; j < next->n_live; j++) {
        int k = next->live[j];
        peaks_link(log->results, m, next, k);
        if (!now->link[k].closed && !next->link[k].closed) {
            continue;
        }
        if (!now->link[k].closed && impacts_open(log, next, k, e) != STATUS_OK) {
            return e->status;
        }
        struct impact_share share = {.steps = next->link[k].closed};
        impact_find_share(&now->link[k].force, &next->link[k].force, &now->delta[k],
                          &next->delta[k], h, &share);
        impacts_add(log, k, &share);
        contact += share.work;
        if (m->n_ground > 1 && m->link[k].moving_ground) {
            log->energy->input += impacts_ground_work(m, k, now, next);
        }
        if (!next->link[k].closed) {
            double rate;
            const double way = impacts_opening(m, now, next, h, k, &rate);
            impacts_end(log, k, now->time + way, rate);
        }
    }
    log->energy->contact += contact;
    return STATUS_OK;
}

void impacts_jump(struct impact_log *log, const struct state *s) {
    for (int i = 0; i < s->n_live; i++) {
        struct impact_share share = {.force = s->link[s->live[i]].force};
        impacts_add(log, s->live[i], &share);
    }
}

int impacts_toggle(struct impact_log *log, const struct state *s, int k, struct error *e) {
    if (s->link[k].closed) {
        return impacts_open(log, s, k, e);
    }
    impacts_end(log, k, s->time, state_rate(s, log->model, k));
    return STATUS_OK;
}

void impacts_part(struct impact_log *log, const struct state *s) {
    const struct model *m = log->model;
    for (int k = 0; k < m->n_contact; k++) {
        if (m->link[k].law->rebound && log->open[k] >= 0 && !s->link[k].closed) {
            impacts_end(log, k, s->time, state_rate(s, log->model, k));
        }
    }
}

int impacts_meet(struct impact_log *log, const struct state *s, const struct meeting *meeting,
                 struct error *e) {
    const struct model *m = log->model;
    for (int k = 0; k < m->n_contact; k++) {
        const struct meeting *met = &meeting[k];
        bool starts = log->open[k] < 0 && (met->struck || state_rests(s, m, k));
        if (starts && impacts_open(log, s, k, e) != STATUS_OK) {
            return e->status;
        }
        if (met->struck) {
            struct impact *i = &log->results->impact[log->open[k]];
            if (starts) {
                i->t_start = s->time;
                i->v_approach = met->approach;
            }
            struct impact_share share = {.impulse = met->impulse, .work = met->work};
            impacts_add(log, k, &share);
        }
    }
    impacts_part(log, s);
    return STATUS_OK;
}

// A rigid contact has no finite force at impact.
static void impacts_blank_rigid(struct results *r, const struct model *m) {
    for (long i = 0; i < r->n_impact; i++) {
        if (m->link[r->impact[i].contact].law->rebound) {
            r->impact[i].peak_force = NAN;
        }
    }
    for (int k = 0; k < m->n_contact; k++) {
        if (m->link[k].law->rebound) {
            r->link[k].force = NAN;
            r->link[k].force_time = NAN;
        }
    }
}

bool impacts_is_coarse(const struct model *m, const struct impact *i) {
    return !m->adaptive && i->complete && i->steps < IMPACT_STEPS_MIN &&
           !m->link[i->contact].law->rebound;
}

static void impacts_count_coarse(struct results *r, const struct model *m) {
    for (long i = 0; i < r->n_impact; i++) {
        r->totals.coarse += impacts_is_coarse(m, &r->impact[i]);
    }
}

static int impacts_compare(const void *a, const void *b) {
    const struct impact *x = a;
    const struct impact *y = b;
    if (x->t_start != y->t_start) {
        return x->t_start < y->t_start ? -1 : 1;
    }
    return x->contact - y->contact;
}

void impacts_finish(struct impact_log *log, const struct state *s) {
    const struct model *m = log->model;
    struct results *r = log->results;
    for (int k = 0; k < m->n_contact; k++) {
        if (log->open[k] >= 0) {
            struct impact *i = &r->impact[log->open[k]];
            i->t_end = s->time;
            i->v_rebound = -state_rate(s, m, k);
        }
    }
    impacts_blank_rigid(r, m);
    impacts_count_coarse(r, m);
    if (r->n_impact > 1) {
        qsort(r->impact, (size_t)r->n_impact, sizeof *r->impact, impacts_compare);
    }
}
