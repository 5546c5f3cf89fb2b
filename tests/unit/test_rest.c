// SPDX-License-Identifier: GPL-3.0-or-later
// The motion of a rigid contact at rest, whose force always suffices, by Newmark's formulas.
#include <math.h>

#include "solve/event/event.h"
#include "support/random.h"
#include "support/support.h"

static const double DT = 0.01;

static const double beta_gamma[][2] = {{0.25, 0.5},      {0.0, 0.5}, {1.0 / 6.0, 0.5},
                                       {0.3025, 0.6},    {0.4, 0.7}, {0.402, 0.5194},
                                       {0.5384, 0.8189}, {1.0, 0.5}, {1.0, 1.0}};
enum { N_METHOD = sizeof beta_gamma / sizeof beta_gamma[0] };

// A body at a wall.
struct body {
    struct building building;
    struct link link;
    struct model model;
    struct link_state contact;
    struct state state;
    double v, a, d, ground;
};

static void make_up(struct body *b, const double *method) {
    *b = (struct body){.link = {.dof = {0, WALL}, .building = {0, WALL}},
                       .contact = {.closed = true}};
    b->model = (struct model){.building = &b->building,
                              .link = &b->link,
                              .n_dof = 1,
                              .n_contact = 1,
                              .dt = DT,
                              .beta = method[0],
                              .gamma = method[1]};
    b->state = (struct state){.v = &b->v,
                              .a = &b->a,
                              .delta = &b->d,
                              .link = &b->contact,
                              .ground_a = &b->ground,
                              .ground_v = &b->ground};
}

static void step(struct body *b, double h) {
    const struct model *m = &b->model;
    const double v = rest_velocity(&b->state, m, h, 0);
    const double q = (v - b->v - h * b->a) / (m->gamma * h);
    b->d += h * b->v + h * h * (b->a / 2.0 + m->beta * q);
    b->v = v;
    b->a += q;
    b->state.time += h;
}

// Displacements over dt^2, velocities over dt, and accelerations.
static double size(const struct body *b) {
    return fmax(fmax(fabs(b->d) / (DT * DT), fabs(b->v) / DT), fabs(b->a));
}

// One step of the deck in up to four parts, which may be as short as those between events.
static double split_step(struct body *b, struct random *r) {
    double rest = DT, largest = 0.0;
    for (int i = random_below(r, 4); i > 0; i--) {
        const double h = random_below(r, 2) ? rest * random_uniform(r, 0.01, 0.99)
                                            : DT * random_logarithmic(r, 1e-9, 1e-2);
        if (h < rest) {
            step(b, h);
            largest = fmax(largest, fabs(b->a));
            rest -= h;
        }
    }
    step(b, rest);
    return fmax(largest, fabs(b->a));
}

static void what_it_strays_decays_without_peaks_however_steps_are_split(void **state) {
    (void)state;
    struct random r = {1};
    for (int i = 0; i < 100 * N_METHOD; i++) {
        struct body b;
        make_up(&b, beta_gamma[i % N_METHOD]);
        b.contact.t_close = -1.0;
        b.d = DT * DT * random_uniform(&r, -1.0, 1.0);
        b.v = DT * random_uniform(&r, -1.0, 1.0);
        b.a = random_uniform(&r, -1.0, 1.0);
        const double start = size(&b);
        for (int j = 0; j < 200; j++) {
            assert_true(split_step(&b, &r) <= 3.0 * start);
        }
        assert_true(size(&b) < 1e-9 * start);  // (4/5)^200 = 4e-20
    }
}

static void that_of_a_contact_that_has_just_come_to_rest_is_no_motion(void **state) {
    (void)state;
    for (int i = 0; i < N_METHOD; i++) {
        struct body b;
        make_up(&b, beta_gamma[i]);
        b.d = 1e-12;  // where the impact was located
        step(&b, 1e-9 * DT);
        assert_true(b.v == 0.0 && b.a == 0.0 && b.d == 1e-12);
    }
}

// The step gives the velocity or the penetration of zero; on the way back nothing overshoots, but
// where 2 beta < gamma, that a velocity of zero leads inside from an acceleration together.
static void bodies_accelerated_apart_as_they_come_to_rest_are_never_inside(void **state) {
    (void)state;
    struct random r = {2};
    for (int i = 0; i < N_METHOD; i++) {
        for (double h = DT; h > 1e-9 * DT; h /= 10.0) {
            struct body b;
            make_up(&b, beta_gamma[i]);
            const struct model *m = &b.model;
            const double inside = fmax(0.5 - m->beta / m->gamma, 0.0) * 2.0 + 1e-14;
            b.a = -2.0;
            step(&b, h);
            assert_close(b.a, fmin((1.0 - m->gamma) / m->gamma, (0.5 - m->beta) / m->beta) * 2.0,
                         1e-12);
            for (int j = 0; j < 50; j++) {
                assert_true(b.d <= inside * DT * DT);
                assert_true(split_step(&b, &r) <= 3.0 * 2.0);
            }
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_it_strays_decays_without_peaks_however_steps_are_split),
        cmocka_unit_test(that_of_a_contact_that_has_just_come_to_rest_is_no_motion),
        cmocka_unit_test(bodies_accelerated_apart_as_they_come_to_rest_are_never_inside),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
