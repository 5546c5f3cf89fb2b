// SPDX-License-Identifier: GPL-3.0-or-later
// What is done for many buildings or links together gives what each of them alone gives.
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/arena.h"
#include "solve/account/account.h"
#include "solve/contact/gaps.h"
#include "solve/floors/effective.h"
#include "support/analysis.h"
#include "support/random.h"
#include "support/support.h"

enum { BUILDINGS = EFFECTIVE_ABREAST, FLOORS = 23 };

static void fill(struct random *r, double *x, int n) {
    for (int i = 0; i < n; i++) {
        x[i] = random_logarithmic(r, 1e-3, 1.0) * (random_below(r, 2) ? 1.0 : -1.0);
    }
}

// Buildings of one height that differ in mass, stiffness and damping.
static struct model *row_of(int buildings, int floors) {
    char text[4000] = "";
    for (int k = 0; k < buildings; k++) {
        size_t used = strlen(text);
        snprintf(text + used, sizeof text - used,
                 "building B%d -floors %d -mass %dt -stiffness %dMN/m\ndamping B%d rayleigh %d%%\n",
                 k, floors, 300 - 20 * k, 90 + 60 * k, k, 1 + k % 3);
    }
    return analysis_model("%sduration 1s\nstep fixed 0.01s\n", text);
}

static void check_row(int buildings, int floors, struct random *random) {
    struct model *m = row_of(buildings, floors);
    struct arena *a = arena_create();
    struct effective e[BUILDINGS];
    double r[BUILDINGS * FLOORS + LANES_WIDTH] = {0.0}, q[BUILDINGS * FLOORS + LANES_WIDTH];
    double alone[FLOORS];
    assert_true(effective_alloc(e, m->building, buildings, EFFECTIVE_BRIEFLY, a));
    for (int k = 0; k < buildings; k++) {
        assert_int_equal(effective_factor(&e[k], 2.5e-5, 5e-3), STATUS_OK);
    }
    fill(random, r, buildings * floors);
    assert_int_equal(e[0].abreast, buildings);
    effective_solve(e, buildings, r, q);
    for (int k = 0; k < buildings; k++) {
        const ptrdiff_t first = (ptrdiff_t)k * floors;
        effective_solve(&e[k], 1, r + first, alone);
        assert_memory_equal(q + first, alone, (size_t)floors * sizeof(double));
    }
    arena_free(a);
    model_free(m);
}

// For every remainder of the floors by four, one floor, and lanes without a building.
static void buildings_in_lanes_are_solved_to_the_bits_of_one(void **state) {
    (void)state;
    struct random random = {7};
    for (int n = 1; n <= FLOORS; n++) {
        check_row(BUILDINGS, n, &random);
        check_row(3 + n % (BUILDINGS - 3), n, &random);
    }
}

// What is behind a solution in memory belongs to another building.
static void a_row_of_all_heights_is_solved_to_the_bits_of_each(void **state) {
    (void)state;
    struct model *m = analysis_model("building A -floors 19 -mass 300t -stiffness 345MN/m\n"
                                     "building B -floors 18 -mass 250t -stiffness 500MN/m\n"
                                     "building C -floors 18 -mass 100t -stiffness 90MN/m\n"
                                     "building D -floors 18 -mass 320t -stiffness 210MN/m\n"
                                     "building E -floors 3 -mass 320t -stiffness 210MN/m\n"
                                     "building F -floors 30 -mass 320t -stiffness 210MN/m\n"
                                     "building G -floors 30 -mass 300t -stiffness 210MN/m\n"
                                     "damping C rayleigh 2%%\nduration 1s\nstep fixed 0.01s\n");
    enum { ROOM = 160 };
    struct random random = {3};
    struct arena *a = arena_create();
    struct effective *e = arena_alloc(a, (size_t)m->n_building, sizeof *e);
    double *r = lanes_array(a, ROOM), *q = lanes_array(a, ROOM), *kept = lanes_array(a, ROOM);
    assert_true(m->n_dof <= ROOM);
    assert_true(effective_alloc(e, m->building, m->n_building, EFFECTIVE_LONG, a));
    for (int k = 0; k < m->n_building; k++) {
        assert_int_equal(effective_factor(&e[k], 2.5e-5, 5e-3), STATUS_OK);
    }
    for (int from = 0; from < m->n_building; from++) {  // also from within those solved together
        const int first = m->building[from].first;
        fill(&random, r, m->n_dof);
        memcpy(kept, r, (size_t)m->n_dof * sizeof *r);
        effective_solve(&e[from], m->n_building - from, r + first, q + first);
        for (int k = from; k < m->n_building; k++) {
            double alone[FLOORS_MAX];
            const struct building *g = &m->building[k];
            effective_solve(&e[k], 1, kept + g->first, alone);
            assert_memory_equal(q + g->first, alone, (size_t)g->n_dof * sizeof *q);
        }
    }
    arena_free(a);
    model_free(m);
}

static const char *const late_row = "building A -floors 21 -mass 300t -stiffness 345MN/m\n"
                                    "building B -floors 21 -mass 250t -stiffness 500MN/m\n"
                                    "building C -floors 21 -mass 280t -stiffness 390MN/m\n"
                                    "building D -floors 9 -mass 320t -stiffness 210MN/m\n"
                                    "damping A rayleigh 5%\ndamping C rayleigh 2%\n"
                                    "contact A B -gap 15mm -law jankowski -k 2.75e9 -e 0.65\n"
                                    "contact B C -gap 15mm -law jankowski -k 2.75e9 -e 0.65\n"
                                    "contact C D -gap 15mm -law jankowski -k 2.75e9 -e 0.65\n"
                                    "ground record input/records/ELCENTRO_1940_NS.AT2\n"
                                    "duration 6\nstep fixed 2ms\n";

// The largest |x| of all rows and when it came first are the peak of floor i.
static void assert_peak_of_rows(const struct kept_rows *rows, const double *x, int i, double peak,
                                double peak_time) {
    double most = 0.0, when = 0.0;
    for (long n = 0; n < rows->n; n++) {
        const double size = fabs(x[n * rows->n_dof + i]);
        when = size > most ? rows->time[n] : when;
        most = size > most ? size : most;
    }
    assert_true(peak == most && peak_time == when);
}

// Peaks and works of a step are taken by the next one, unless they are asked for. Where each step
// is shown they are asked for after each; the other run puts all of them off to its end.
static void what_is_put_off_to_the_next_step_is_what_each_step_shows(void **state) {
    (void)state;
    struct analysis each = analysis_of("%soutput -every 1\n", late_row);
    struct analysis late = analysis_of("%soutput -every 1000000\n", late_row);
    const struct kept_rows *rows = &each.rows;
    const double *const shown[PEAK_COUNT] = {
        [PEAK_DISPLACEMENT] = rows->displacement,
        [PEAK_VELOCITY] = rows->velocity,
        [PEAK_ACCELERATION] = rows->acceleration,
        [PEAK_DRIFT] = rows->drift,
        [PEAK_SHEAR] = rows->shear,
    };
    assert_true(late.results->n_impact > 10);
    assert_true(rows->n > 3000 && late.rows.n == 2);
    for (int q = 0; q < PEAK_COUNT; q++) {
        for (int i = 0; i < rows->n_dof; i++) {
            assert_peak_of_rows(rows, shown[q], i, late.results->peak[q][i],
                                late.results->peak_time[q][i]);
        }
    }
    assert_memory_equal(late.results->energy, each.results->energy, ENERGY_COUNT * sizeof(double));
    analysis_free(&each);
    analysis_free(&late);
}

static void assert_penetrations(const struct model *m, const struct state *s) {
    for (int k = 0; k < m->n_link; k++) {
        double gap = state_gap(&m->link[k], m, s->u, s->ground_u) - m->link[k].gap;
        assert_near(s->delta[k], gap, 8.0 * DBL_EPSILON);  // a few roundings of u < 1
    }
}

// Unequal heights, a wall, a contact of one floor and a link that stands askew.
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
    struct results r = {0};
    assert_true(state_alloc(&s, m, a) && peaks_alloc(&r, m, a) && gaps_alloc(&gaps, m, &r, a));
    for (int i = 0; i < 20; i++) {
        fill(&random, s.u, m->n_dof);
        gaps_update(&gaps, &s, NULL);
        assert_penetrations(m, &s);
        gaps_forget(&gaps);
        int k = random_below(&random, m->n_link);
        gaps_touch(&gaps, k);
        for (int j = 0; j < gaps.n_touched; j++) {
            const struct building *g = &m->building[gaps.touched[j]];
            fill(&random, s.u + g->first, g->n_dof);
        }
        gaps_update(&gaps, &s, gaps.is_touched);
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
    struct results r = {0};
    assert_true(state_alloc(&s, m, a) && peaks_alloc(&r, m, a) && gaps_alloc(&gaps, m, &r, a));
    gaps_update(&gaps, &s, NULL);
    assert_int_equal(gaps.n_pressed, 0);
    s.u[2] = 0.021;
    gaps_update(&gaps, &s, NULL);
    assert_int_equal(gaps.n_pressed, 1);
    gaps_touch(&gaps, 2);
    gaps_update(&gaps, &s, NULL);
    assert_int_equal(gaps.n_pressed, 0);
    s.u[3] = 0.021;
    gaps_update(&gaps, &s, gaps.is_touched);
    assert_int_equal(gaps.n_pressed, 1);
    gaps_forget(&gaps);
    s.u[3] = 0.0;
    gaps_update(&gaps, &s, NULL);
    assert_int_equal(gaps.n_pressed, 1);
    arena_free(a);
    model_free(m);
}

// A run knows that one of its links acts, whatever the order in which links begin to act. Nothing
// is left of it after.
static void runs_know_that_their_links_act(void **state) {
    (void)state;
    struct model *m = analysis_model("building A -floors 6 -mass 300t -stiffness 345MN/m\n"
                                     "building B -floors 6 -mass 300t -stiffness 345MN/m\n"
                                     "building C -floors 6 -mass 300t -stiffness 345MN/m\n"
                                     "contact A B -gap 20mm -law linear -k 100MN/m\n"
                                     "contact B C -gap 20mm -law linear -k 100MN/m\n"
                                     "duration 1s\nstep fixed 0.01s\n");
    const int acting[] = {1, 11, 4, 7, 5};
    const int n = sizeof acting / sizeof *acting;
    struct arena *a = arena_create();
    struct gaps gaps;
    struct results r = {0};
    if (!peaks_alloc(&r, m, a) || !gaps_alloc(&gaps, m, &r, a)) {
        fail_msg("no memory");
        return;
    }
    for (int round = 0; round < 2; round++) {
        for (int i = 0; i < n; i++) {
            gaps_touch(&gaps, acting[i]);
        }
        assert_int_equal(gaps.n_touched, 3);
        assert_int_equal(gaps.n_acting, n);
        assert_memory_equal(gaps.acting, acting, sizeof acting);
        assert_int_equal(gaps.n_run, 2);
        assert_true(gaps.acts[0] && gaps.acts[1]);
        gaps_forget(&gaps);
        assert_int_equal(gaps.n_acting + gaps.n_touched, 0);
        gaps_touch(&gaps, 7);
        assert_true(!gaps.acts[0] && gaps.acts[1]);
        gaps_forget(&gaps);
        assert_true(!gaps.acts[0] && !gaps.acts[1]);
    }
    arena_free(a);
    model_free(m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(buildings_in_lanes_are_solved_to_the_bits_of_one),
        cmocka_unit_test(a_row_of_all_heights_is_solved_to_the_bits_of_each),
        cmocka_unit_test(what_is_put_off_to_the_next_step_is_what_each_step_shows),
        cmocka_unit_test(penetrations_of_runs_of_links_are_those_of_each),
        cmocka_unit_test(contacts_inside_are_in_a_pressed_run),
        cmocka_unit_test(runs_know_that_their_links_act),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
