// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of bodies at rest against the conditions that define how they move on: nobody approaches,
// pushes only push, and only where bodies stay together; momentum and energy are accounted for.
#include <math.h>

#include "solve/event/event.h"
#include "support/random.h"
#include "support/support.h"

enum { BODIES_MAX = 12 };

static const double ROUNDING = 1e-14;  // of sums of so many numbers of the size of 1

struct line {
    struct model model;
    struct building building[BODIES_MAX];
    struct link link[BODIES_MAX + 1];
    double mass[BODIES_MAX], ground[2];
};

// Bodies from left to right, the contacts between them in another order, walls at the ends or not,
// the right half on another ground if there is no wall there.
static void make_up(struct random *r, struct line *line, struct rest_contacts *t) {
    const int n = 1 + random_below(r, BODIES_MAX);
    const bool left = random_below(r, 3) == 0, right = random_below(r, 3) == 0;
    *line = (struct line){.ground = {0.0, right ? 0.0 : random_uniform(r, -1.0, 1.0)}};
    t->n = 0;
    for (int i = 0; i < n; i++) {
        line->mass[i] = random_logarithmic(r, 1e-5, 1.0);
        line->building[i].ground = 2 * i < n ? 0 : 1;
    }
    for (int i = n; i >= 0; i--) {  // from the right
        if ((i > 0 || left) && (i < n || right)) {
            const int a = i > 0 ? i - 1 : WALL, b = i < n ? i : WALL;
            line->link[t->n] = (struct link){.dof = {a, b},
                                             .building = {a, b},
                                             .moving_ground = a >= 0 && b >= 0 &&
                                                              line->building[a].ground !=
                                                                  line->building[b].ground};
            t->contact[t->n] = t->n;
            t->n++;
        }
    }
    line->model = (struct model){.n_dof = n,
                                 .n_contact = t->n,
                                 .building = line->building,
                                 .link = line->link,
                                 .mass = line->mass};
}

// What must hold of the motions before and after, masses and motions of the size of 1.
static void check(const struct line *line, const struct rest_contacts *t, const double *before,
                  const double *after) {
    const struct model *m = &line->model;
    double change[BODIES_MAX], lost = 0.0, booked = 0.0;
    for (int i = 0; i < m->n_dof; i++) {
        change[i] = m->mass[i] * (after[i] - before[i]);
        lost += m->mass[i] * (before[i] - after[i]) * (before[i] + after[i]) / 2.0;
    }
    for (int k = 0; k < m->n_contact; k++) {
        const struct passage *p = &t->passage[k];
        const int *dof = m->link[k].dof;
        const double rate = state_gap(&m->link[k], m, after, line->ground);
        assert_true(p->push >= 0.0 && p->lost >= 0.0);
        assert_true(rate < ROUNDING);
        assert_true(p->push == 0.0 || fabs(rate) < ROUNDING);
        booked += p->lost;
        lost += p->push * state_ground_gap(&m->link[k], m, line->ground);  // work of the grounds
        if (dof[0] != WALL) {
            change[dof[0]] += p->push;
        }
        if (dof[1] != WALL) {
            change[dof[1]] -= p->push;
        }
    }
    for (int i = 0; i < m->n_dof; i++) {
        assert_near(change[i], 0.0, ROUNDING);
    }
    assert_near(booked, lost, ROUNDING);
}

static void nobody_approaches_and_pushes_only_push(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 2000; seed++) {
        struct random r = {seed};
        struct rest_contacts t;
        struct line line;
        double before[BODIES_MAX] = {0.0}, after[BODIES_MAX] = {0.0};
        make_up(&r, &line, &t);
        for (int i = 0; i < line.model.n_dof; i++) {
            before[i] = after[i] = random_uniform(&r, -1.0, 1.0);
        }
        rest_pool(&t, &line.model, after, line.ground);
        check(&line, &t, before, after);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nobody_approaches_and_pushes_only_push),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
