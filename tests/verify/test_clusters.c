// SPDX-License-Identifier: GPL-3.0-or-later
// One step of random clusters of contacts: masses from 1e2 to 1e8 kg, k from 1e6 to 1e13, steps
// from 1e-6 to 0.05 s, penetrations from 1e-12 to 0.3 m, velocities from 1e-6 to 5 m/s. The step
// may not be cut: the discrete problem has to be solved, and each force has to lie on the graph of
// its law, jumps included. JOSTLE_LONG=1 takes a million of them.
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "solve/contact/contact.h"
#include "solve/event/event.h"
#include "support/analysis.h"
#include "support/random.h"
#include "support/random_deck.h"
#include "support/single_step.h"
#include "support/support.h"

enum { STEPS_EACH = 10, TEXT_SIZE = 8192 };

// Forces are found to the tolerance of the model, 1e-12, relative to the largest, by sweeps whose
// error may be some times their last change.
static const double FORCE_TOLERANCE = 1e-9;
static const double LARGEST_TOLERANCE = 1e-11;

// Displacements and velocities are sums over all corrections: some roundings.
static const double ROUNDINGS = 64.0;

enum kind { MONOTONE, PULLING, N_KIND };

// What came of the clusters of a class.
struct tally {
    long n, unsolved, wrong, undecided, links, worst, iterations;
};

static double signed_logarithmic(struct random *r, double from, double to) {
    double sign = random_below(r, 2) ? 1.0 : -1.0;
    return sign * random_logarithmic(r, from, to);
}

// Displaces the right end of each contact from its left end, from left to right.
static void displace(struct single_step *b, struct random *random) {
    for (int i = 0; i < b->model->n_dof; i++) {
        b->now.u[i] = signed_logarithmic(random, 1e-12, 0.3);
        b->now.v[i] = signed_logarithmic(random, 1e-6, 5.0);
    }
    for (int k = 0; k < b->model->n_contact; k++) {
        const struct link *l = &b->model->link[k];
        if (l->dof[0] == WALL || l->dof[1] == WALL) {
            continue;
        }
        double most = l->law->rebound ? 1e-11 : 0.3;
        b->now.u[l->dof[1]] = b->now.u[l->dof[0]] - signed_logarithmic(random, 1e-12, most);
        b->now.v[l->dof[1]] = b->now.v[l->dof[0]] - signed_logarithmic(random, 1e-6, 5.0);
    }
}

// Gives a pressed contact a past of its own.
static void remember(struct single_step *b, struct random *random, int k) {
    struct state *s = &b->now;
    const struct link *l = &b->model->link[k];
    double *history = s->link_history + l->history;
    if (l->law->close) {
        s->link[k].v_close = random_logarithmic(random, 1e-6, 5.0);
        l->law->close(l->constant, s->link[k].v_close, history);
    }
    if (l->law->commit && random_below(random, 2)) {
        double deepest = s->delta[k] * random_logarithmic(random, 1.0, 10.0);
        l->law->commit(l->constant, history, deepest, 1.0);
        l->law->commit(l->constant, history, s->delta[k], -1.0);
    }
    s->link[k].force = random_below(random, 2) ? state_link_force(s, b->model, k) : 0.0;
}

static void close_pressed(struct single_step *b, struct random *random) {
    struct state *s = &b->now;
    for (int k = 0; k < b->model->n_contact; k++) {
        const struct link *l = &b->model->link[k];
        s->delta[k] = state_penetration(s, b->model, k);
        if (l->law->rebound && random_below(random, 2)) {
            state_enliven(s, k);
            s->link[k].closed = true;
            s->link[k].t_close = k % 2 ? s->time : -1.0;  // just now, or earlier
        } else if (!l->law->rebound && s->delta[k] > 0.0) {
            state_close_link(s, b->model, k);
            remember(b, random, k);
        }
    }
}

// A state before a step, under accelerations from the storeys alone: those of contacts that were
// pressed at random could be beyond all bounds.
static void begin(struct single_step *b, struct random *random) {
    const struct model *m = b->model;
    struct state *s = &b->now;
    state_open_links(s);
    memset(s->link, 0, (size_t)m->n_link * sizeof *s->link);
    rest_start(s, m);
    displace(b, random);
    state_forces(s, m, s->storey_history, NULL);
    rest_equilibrium(s, m);
    close_pressed(b, random);
    b->next.time = 0.0;
    state_open_links(&b->next);
}

struct span {
    double low, high;
};

static void widen(struct span *s, double x) {
    s->low = fmin(s->low, x);
    s->high = fmax(s->high, x);
}

// Forces act on all floors, and round there what links feel.
static double rounding(const struct single_step *b, const double *trial, const double *x) {
    double largest = 0.0;
    for (int i = 0; i < b->model->n_dof; i++) {
        largest = fmax(largest, fabs(trial[i]) + fabs(x[i]));
    }
    return ROUNDINGS * DBL_EPSILON * largest;
}

// The forces of the law of contact k within rounding of its d and v, and within what the change
// `moved` of its acceleration does to them.
static struct span graph(const struct single_step *b, int k, double moved) {
    const struct link *l = &b->model->link[k];
    double history[CONTACT_HISTORY_MAX];
    memcpy(history, b->now.link_history + l->history, (size_t)l->law->n_history * sizeof *history);
    if (!b->now.link[k].closed && l->law->close) {
        l->law->close(l->constant, b->next.link[k].v_close, history);
    }
    double around_d = rounding(b, b->work.u_trial, b->next.u) + b->work.b * moved;
    double around_v = rounding(b, b->work.v_trial, b->next.v) + b->work.g * moved;
    struct span span = {INFINITY, -INFINITY};
    for (int i = -1; i <= 1; i++) {
        for (int j = -1; j <= 1; j++) {
            double d = b->next.delta[k] + i * around_d;
            double v = state_rate(&b->next, b->model, k) + j * around_v;
            widen(&span, l->law->force(l->constant, history, fmax(d, 0.0), v).force);
            if (d <= 0.0 || b->work.link[k].branch == BRANCH_NONE) {
                widen(&span, 0.0);
            }
        }
    }
    return span;
}

static double largest_force(const struct single_step *b) {
    double largest = 0.0;
    for (int i = 0; i < b->next.n_live; i++) {
        largest = fmax(largest, fabs(b->next.link[b->next.live[i]].force));
    }
    return largest;
}

// The force of a rigid contact at rest keeps a velocity, unless it would have to pull. Which one is
// the business of tests/unit/test_rest.c.
static bool rests(const struct single_step *b, int k) {
    double v = state_rate(&b->next, b->model, k) - rest_velocity(&b->now, b->model, b->work.h, k);
    double around = rounding(b, b->work.v_trial, b->next.v) +
                    b->work.g * b->work.link[k].flexibility * LARGEST_TOLERANCE * largest_force(b);
    double f = b->next.link[k].force;
    return f > 0.0 ? fabs(v) <= around : f == 0.0 && v <= around;
}

static bool obeys(const struct single_step *b, int k) {
    const struct link *l = &b->model->link[k];
    double f = b->next.link[k].force;
    if (!b->next.link[k].is_live) {
        return f == 0.0 && (l->law->rebound || b->next.delta[k] <= 0.0);
    }
    if (l->law->rebound) {
        return rests(b, k);
    }
    double allowed = LARGEST_TOLERANCE * largest_force(b);
    struct span span = graph(b, k, b->work.link[k].flexibility * allowed);
    allowed += FORCE_TOLERANCE * fabs(f);
    return f >= span.low - allowed && f <= span.high + allowed;
}

static enum kind kind_of(const struct model *m) {
    for (int k = 0; k < m->n_contact; k++) {
        if (m->link[k].law->traits & CONTACT_MAY_PULL) {
            return PULLING;
        }
    }
    return MONOTONE;
}

static bool undecided(const struct single_step *b) {
    for (int i = 0; i < b->next.n_live; i++) {
        if (b->work.link[b->next.live[i]].branch == BRANCH_NONE) {
            return true;
        }
    }
    return false;
}

static bool all_obey(const struct single_step *b) {
    for (int k = 0; k < b->model->n_contact; k++) {
        if (!obeys(b, k)) {
            return false;
        }
    }
    return true;
}

static void report(const struct single_step *b, uint64_t seed, int step, const char *what) {
    print_error("cluster %llu, step %d of %g s, %d live: %s\n", (unsigned long long)seed, step,
                b->work.h, b->next.n_live, what);
    for (int k = 0; getenv("JOSTLE_VERBOSE") && k < b->model->n_contact; k++) {
        print_error("%s %s closed %d branch %d f %.17g d %.17g v %.17g %s\n",
                    b->model->link[k].name, b->model->link[k].law->name, b->now.link[k].closed,
                    b->next.link[k].is_live ? (int)b->work.link[k].branch : -1,
                    b->next.link[k].force, b->next.delta[k], state_rate(&b->next, b->model, k),
                    obeys(b, k) ? "" : "WRONG");
    }
}

static void take(struct single_step *b, struct random *random, struct tally *t, uint64_t seed,
                 int step) {
    begin(b, random);
    double h = random_logarithmic(random, 1e-6, 0.05);
    b->results.totals = (struct totals){0};
    single_step_take(b, h);
    t->n++;
    t->links += b->next.n_live;
    t->iterations += b->results.totals.iterations;
    t->worst = b->results.totals.iterations > t->worst ? b->results.totals.iterations : t->worst;
    if (b->results.totals.unsolved > 0) {
        t->unsolved++;
        report(b, seed, step, "unsolved");
    } else if (!all_obey(b)) {
        t->wrong++;
        report(b, seed, step, "not on the graph of the law");
    }
    t->undecided += undecided(b);
}

static void take_cluster(uint64_t seed, struct tally *tally) {
    char text[TEXT_SIZE];
    random_deck_cluster(seed, text, sizeof text);
    struct random random = {~seed};
    struct single_step b;
    single_step_init(&b, analysis_model("%s", text));
    for (int i = 0; i < STEPS_EACH; i++) {
        take(&b, &random, &tally[kind_of(b.model)], seed, i);
    }
    single_step_free(&b);
}

// Clusters that have told on laws that were followed along their tangents past v = 0, or too far.
static const uint64_t hard[] = {5000, 7838, 16965, 25771, 29864, 77429, 81545, 87187, 91337, 98540};

static void every_step_of_a_random_cluster_is_solved_and_obeys_the_laws(void **state) {
    (void)state;
    static const char *const name[N_KIND] = {"monotone", "pulling"};
    struct tally tally[N_KIND] = {0};
    uint64_t n = getenv("JOSTLE_LONG") ? 100000 : 1000;
    for (uint64_t seed = 1; seed <= n; seed++) {
        take_cluster(seed, tally);
    }
    for (size_t i = 0; i < sizeof hard / sizeof hard[0]; i++) {
        take_cluster(hard[i], tally);
    }
    for (int i = 0; i < N_KIND; i++) {
        const struct tally *t = &tally[i];
        print_message("%s: %ld steps, %ld links, %ld sweeps, at most %ld; %ld unsolved, %ld wrong, "
                      "%ld without a solution\n",
                      name[i], t->n, t->links, t->iterations, t->worst, t->unsolved, t->wrong,
                      t->undecided);
    }
    for (int i = 0; i < N_KIND; i++) {
        assert_int_equal(tally[i].unsolved + tally[i].wrong, 0);
    }
    assert_int_equal(tally[MONOTONE].undecided, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_step_of_a_random_cluster_is_solved_and_obeys_the_laws),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
