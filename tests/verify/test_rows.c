// SPDX-License-Identifier: GPL-3.0-or-later
// What is done for many buildings or links together gives what each of them alone gives.
#include <float.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "solve/four.h"
#include "solve/gaps.h"
#include "support/analysis.h"
#include "support/random.h"
#include "support/support.h"

enum { BUILDINGS = 4, FLOORS = 23 };

static void fill(struct random *r, double *x, int n) {
    for (int i = 0; i < n; i++) {
        x[i] = random_logarithmic(r, 1e-3, 1.0) * (random_below(r, 2) ? 1.0 : -1.0);
    }
}

static struct model *row_of(int floors) {
    return analysis_model("building A -floors %d -mass 300t -stiffness 345MN/m\n"
                          "building B -floors %d -mass 250t -stiffness 500MN/m\n"
                          "building C -floors %d -mass 100t -stiffness 90MN/m\n"
                          "building D -floors %d -mass 320t -stiffness 210MN/m\n"
                          "damping A rayleigh 5%%\n"
                          "damping C rayleigh 2%%\n"
                          "duration 1s\nstep fixed 0.01s\n",
                          floors, floors, floors, floors);
}

// For every remainder of the floors by four, and one floor.
static void four_buildings_in_lanes_are_solved_to_the_bits_of_one(void **state) {
    (void)state;
    struct random random = {7};
    for (int n = 1; n <= FLOORS; n++) {
        struct model *m = row_of(n);
        struct arena *a = arena_create();
        struct effective e[BUILDINGS];
        double r[BUILDINGS][FLOORS], q[BUILDINGS][FLOORS], alone[BUILDINGS][FLOORS];
        double *rs[BUILDINGS], *qs[BUILDINGS];
        for (int k = 0; k < BUILDINGS; k++) {
            assert_true(effective_alloc(&e[k], &m->building[k], EFFECTIVE_BRIEFLY, a));
            assert_int_equal(effective_factor(&e[k], 2.5e-5, 5e-3), STATUS_OK);
            fill(&random, r[k], n);
            fill(&random, q[k], n);
            memcpy(alone[k], q[k], sizeof alone[k]);
            rs[k] = r[k];
            qs[k] = q[k];
        }
        four_solve(e, rs, qs);
        for (int k = 0; k < BUILDINGS; k++) {
            effective_solve(&e[k], r[k], alone[k]);
            assert_memory_equal(q[k], alone[k], (size_t)n * sizeof(double));
        }
        arena_free(a);
        model_free(m);
    }
}

static void assert_penetrations(const struct model *m, const struct state *s) {
    for (int k = 0; k < m->n_link; k++) {
        double gap = state_gap(&m->link[k], m, s->u, s->ground_u) - m->link[k].gap;
        assert_near(s->delta[k], gap, 8.0 * DBL_EPSILON);  // a few roundings of u < 1
    }
}

// Unequal heights, a wall, a contact of one floor and a damper within and between buildings.
static void penetrations_of_runs_of_links_are_those_of_each(void **state) {
    (void)state;
    struct model *m = analysis_model("building A -floors 9 -mass 300t -stiffness 345MN/m\n"
                                     "building B -floors 4 -mass 300t -stiffness 345MN/m\n"
                                     "building C -floors 7 -mass 300t -stiffness 345MN/m\n"
                                     "contact A B -gap 20mm -law linear -k 100MN/m\n"
                                     "contact B C -gap 10mm -law linear -k 100MN/m\n"
                                     "contact C:3 wall -gap 5mm -law linear -k 100MN/m\n"
                                     "link A:6 C:5 -stiffness 1MN/m\n"
                                     "duration 1s\nstep fixed 0.01s\n");
    struct random random = {11};
    struct arena *a = arena_create();
    struct state s = {0};
    struct gaps gaps;
    assert_true(state_alloc(&s, m, a) && gaps_alloc(&gaps, m, a));
    for (int i = 0; i < 20; i++) {
        fill(&random, s.u, m->n_dof);
        gaps_update(&gaps, &s);
        assert_penetrations(m, &s);
        gaps_forget(&gaps, &s);
        int k = random_below(&random, m->n_link);
        gaps_touch(&gaps, k);
        for (int j = 0; j < gaps.n_touched; j++) {
            const struct building *g = &m->building[gaps.touched[j]];
            fill(&random, s.u + g->first, g->n_floor);
        }
        gaps_update_touched(&gaps, &s);
        assert_penetrations(m, &s);
    }
    arena_free(a);
    model_free(m);
}

// Every contact that stands inside is in a run that is searched, unless it acts already.
static void contacts_inside_are_in_a_pressed_run(void **state) {
    (void)state;
    struct model *m = analysis_model("building A -floors 6 -mass 300t -stiffness 345MN/m\n"
                                     "building B -floors 6 -mass 300t -stiffness 345MN/m\n"
                                     "contact A B -gap 20mm -law linear -k 100MN/m\n"
                                     "duration 1s\nstep fixed 0.01s\n");
    struct arena *a = arena_create();
    struct state s = {0};
    struct gaps gaps;
    assert_true(state_alloc(&s, m, a) && gaps_alloc(&gaps, m, a));
    gaps_update(&gaps, &s);
    assert_int_equal(gaps.n_pressed, 0);
    s.u[2] = 0.021;
    gaps_update(&gaps, &s);
    assert_int_equal(gaps.n_pressed, 1);
    gaps_touch(&gaps, 2);
    gaps_update(&gaps, &s);
    assert_int_equal(gaps.n_pressed, 0);
    s.u[3] = 0.021;
    gaps_update_touched(&gaps, &s);
    assert_int_equal(gaps.n_pressed, 1);
    gaps_forget(&gaps, &s);
    s.u[3] = 0.0;
    gaps_update(&gaps, &s);
    assert_int_equal(gaps.n_pressed, 1);
    arena_free(a);
    model_free(m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(four_buildings_in_lanes_are_solved_to_the_bits_of_one),
        cmocka_unit_test(penetrations_of_runs_of_links_are_those_of_each),
        cmocka_unit_test(contacts_inside_are_in_a_pressed_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
