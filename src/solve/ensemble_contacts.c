// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble_contacts.h"

#include <string.h>

#include "solve/ensemble_sweeps.h"
#include "solve/quick.h"

// Place for contact k, at or behind *place; NULL: there is none.
static struct joint *join(struct sweeps *s, int k, int *place) {
    int i = *place;
    while (i < s->n_joint && s->joint[i].contact < k) {
        i++;
    }
    *place = i + 1;
    struct joint *j = &s->joint[i];
    if (i < s->n_joint && j->contact == k) {
        return j;
    }
    if (s->n_joint == ENSEMBLE_JOINTS) {
        return NULL;
    }
    memmove(j + 1, j, (size_t)(s->n_joint - i) * sizeof *j);
    s->n_joint++;
    j->contact = k;
    j->grip = &s->e->grip[k];
    j->runs = 0;
    j->force = j->fits_to = (wide){0.0};
    return j;
}

// How the ends of a contact yield, unless that has stayed; false: it is not known.
static bool yields(struct ensemble_grip *g, int lane, const struct work *w, const struct quick *q) {
    if (g->factors[lane] != w->factors && q->factors == w->factors) {
        g->factors[lane] = w->factors;
        g->flexibility[lane] = q->flexibility;
        g->others[lane] = q->others;
        g->unmoved[lane] = q->unmoved;
    }
    return g->factors[lane] == w->factors;
}

// Takes the live contacts of a run; false: it cannot go with the others.
static bool take_run(struct sweeps *s, int lane, const struct run *r) {
    const struct work *w = &r->work;
    const struct state *next = r->next;
    bool suits = r->model->iterations >= ENSEMBLE_SWEEPS;
    for (int i = 0, place = 0; suits && i < next->n_live; i++) {
        const int k = next->live[i];
        const struct quick *q = &w->quick[k];
        struct ensemble_grip *g = &s->e->grip[k];
        struct joint *j =
            !g->apart && q->checked == w->h && yields(g, lane, w, q) ? join(s, k, &place) : NULL;
        suits = j != NULL;
        if (suits) {
            j->force[lane] = next->link[k].force;
            j->fits_to[lane] = q->fits_to;
            j->runs |= 1U << lane;
        }
    }
    s->tolerance[lane] = r->model->tolerance;
    s->alone[lane] = next->n_live == 1 ? -1 : 0;
    s->per_b = w->per_b;
    s->per_g = w->per_g;
    return suits;
}

static void touch(struct sweeps *s, int building) {
    int i = 0;
    while (i < s->n_touched && s->touched[i] != building) {
        i++;
    }
    if (building != WALL && i == s->n_touched) {
        s->touched[s->n_touched++] = building;
    }
}

// Gives a run its forces.
static void give_run(const struct sweeps *s, int lane, struct run *r) {
    for (int i = 0; i < s->n_joint; i++) {
        const struct joint *j = &s->joint[i];
        if (j->runs >> lane & 1U) {
            r->next->link[j->contact].force = j->force[lane];
        }
    }
    r->work.totals->iterations += s->count[lane];
    r->work.totals->fast++;
}

unsigned ensemble_contacts_solve(struct ensemble_lanes *e, struct run *const *run, unsigned runs) {
    struct sweeps s;
    s.e = e;
    s.n_joint = s.n_touched = 0;
    unsigned taken = 0, solved = 0;
    for (int lane = 0; lane < WIDE_RUNS; lane++) {
        if (runs >> lane & 1U && take_run(&s, lane, run[lane])) {
            taken |= 1U << lane;
        }
    }
    if (taken == 0) {
        return 0;
    }
    for (int i = 0; i < 2 * s.n_joint; i++) {
        touch(&s, s.joint[i / 2].grip->building[i % 2]);
    }
    ensemble_sweeps(&s, taken);
    for (int lane = 0; lane < WIDE_RUNS; lane++) {
        if (s.well[lane]) {
            give_run(&s, lane, run[lane]);
            solved |= 1U << lane;
        }
    }
    for (int i = 0; solved != 0 && i < s.n_touched; i++) {
        e->building[s.touched[i]].swept = true;
    }
    return solved;
}
