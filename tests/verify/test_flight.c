// SPDX-License-Identifier: GPL-3.0-or-later
// Steps in free flight take a way of their own through the solver. It must not be seen: a rigid
// contact, which needs the plain way in every step, with a wall so far away that it is never
// reached, changes no bit of the results.
#include <stdio.h>
#include <string.h>

#include "support/analysis.h"
#include "support/support.h"

#define FAR "contact wall A:1 -gap 1000m -law stereomechanical -e 1 -name far\n"
#define PAIR                                                                                       \
    "building A -floors 8 -mass 300t -stiffness 345MN/m\n"                                         \
    "building B -floors 5 -mass 280t -stiffness 345MN/m\n"                                         \
    "damping A rayleigh 5%\ndamping B rayleigh 3%\n"                                               \
    "contact A B -gap 20mm -law jankowski -k 2.75e9 -e 0.65\nduration 12\n"
#define ROW(l, r) "contact " l " " r " -gap 12mm -law jankowski -k 2.75e9 -e 0.65\n"
#define SHAKEN "ground record input/records/ELCENTRO_1940_NS.AT2\n"

static void assert_same(const void *a, const void *b, size_t size) {
    assert_memory_equal(a, b, size);
}

static void assert_same_peaks(const struct analysis *a, const struct analysis *b) {
    const struct results *x = a->results, *y = b->results;
    size_t floors = (size_t)a->model->n_dof * sizeof(double);
    for (int q = 0; q < PEAK_COUNT; q++) {
        assert_same(x->peak[q], y->peak[q], floors);
        assert_same(x->peak_time[q], y->peak_time[q], floors);
    }
    for (int k = 0; k < a->model->n_link; k++) {
        const struct link_peak *p = &x->link[k], *q = &y->link[k];
        assert_true(p->force == q->force && p->force_time == q->force_time);
        assert_true(p->penetration == q->penetration);
        assert_true(p->penetration_time == q->penetration_time);
        assert_true(p->impulse == q->impulse && p->dissipated == q->dissipated);
        assert_true(p->impacts == q->impacts);
    }
}

static void assert_same_impacts(const struct results *x, const struct results *y) {
    assert_int_equal(x->n_impact, y->n_impact);
    for (long i = 0; i < x->n_impact; i++) {
        const struct impact *p = &x->impact[i], *q = &y->impact[i];
        assert_true(p->contact == q->contact && p->steps == q->steps);
        assert_true(p->t_start == q->t_start && p->t_end == q->t_end);
        assert_true(p->v_approach == q->v_approach && p->v_rebound == q->v_rebound);
        assert_true(p->peak_force == q->peak_force && p->impulse == q->impulse);
        assert_true(p->max_penetration == q->max_penetration && p->dissipated == q->dissipated);
    }
}

static void assert_same_rows(const struct kept_rows *x, const struct kept_rows *y) {
    assert_int_equal(x->n, y->n);
    size_t floors = (size_t)(x->n * x->n_dof) * sizeof(double);
    assert_same(x->time, y->time, (size_t)x->n * sizeof(double));
    assert_same(x->displacement, y->displacement, floors);
    assert_same(x->velocity, y->velocity, floors);
    assert_same(x->acceleration, y->acceleration, floors);
    assert_same(x->drift, y->drift, floors);
    assert_same(x->shear, y->shear, floors);
    for (long i = 0; i < x->n; i++) {
        for (int k = 0; k < x->n_link; k++) {
            assert_true(x->force[i * x->n_link + k] == y->force[i * y->n_link + k]);
            assert_true(x->penetration[i * x->n_link + k] == y->penetration[i * y->n_link + k]);
        }
    }
    assert_same(x->energy, y->energy, (size_t)x->n * ENERGY_COUNT * sizeof(double));
}

// The deck with and without the far wall gives the same; returns the number of impacts.
static long check(const char *deck) {
    struct analysis a = analysis_of("%s", deck);
    struct analysis b = analysis_of("%s" FAR, deck);
    assert_same_peaks(&a, &b);
    assert_same_impacts(a.results, b.results);
    assert_same_rows(&a.rows, &b.rows);
    assert_true(a.results->residual_peak == b.results->residual_peak);
    const struct totals *x = &a.results->totals, *y = &b.results->totals;
    assert_true(x->steps == y->steps && x->rejected == y->rejected && x->events == y->events);
    assert_true(x->iterations == y->iterations);
    long n = a.results->n_impact;
    analysis_free(&a);
    analysis_free(&b);
    return n;
}

static void a_pair_has_the_same_bits_with_every_law(void **state) {
    (void)state;
    assert_true(check(PAIR SHAKEN "step fixed 1ms\n") > 10);
    assert_true(check(PAIR SHAKEN "step fixed 1ms\noutput -every 1\n") > 10);
    assert_true(check(PAIR SHAKEN "step fixed 7ms\noutput -every 3\n") > 10);
    assert_true(check(PAIR SHAKEN
                      "step fixed 1ms\n"
                      "contact wall A:8 -gap 15mm -law kelvin-voigt -k 90MN/m -e 0.6\n"
                      "contact B:4:5 wall -gap 15mm -law hertz-damp -k 2e9 -e 0.6\n") > 10);
}

static void rows_of_all_heights_have_the_same_bits(void **state) {
    (void)state;
    char deck[2000];
    for (int floors = 1; floors <= 21; floors += 4) {
        snprintf(deck, sizeof deck,
                 "building A -floors %d -mass 300t -stiffness 345MN/m\n"
                 "building B -floors %d -mass 200t -stiffness 300MN/m\n"
                 "building C -floors 17 -mass 310t -stiffness 500MN/m\n"
                 "building D -floors 17 -mass 310t -stiffness 900MN/m\n"
                 "building E -floors 17 -mass 330t -stiffness 345MN/m\n"
                 "building F -floors 17 -mass 310t -stiffness 345MN/m\n"
                 "damping A rayleigh 5%%\ndamping C rayleigh 3%%\ndamping F rayleigh 5%%\n" ROW(
                     "A", "B") ROW("B", "C") ROW("C", "D") ROW("D", "E") ROW("E", "F") SHAKEN
                 "duration 5\nstep fixed 2ms\n",
                 floors, floors / 2 + 1);
        assert_true(check(deck) > 0);
    }
}

// Low ones that are alike share lanes.
static void low_rows_of_one_height_have_the_same_bits(void **state) {
    (void)state;
    char deck[4000];
    int n = 0;
    for (int k = 0; k < 8; k++) {
        n += snprintf(deck + n, sizeof deck - (size_t)n,
                      "building %c -floors 9 -mass 300t -stiffness %dMN/m\n"
                      "damping %c rayleigh 5%%\n",
                      'A' + k, 250 + 150 * (k % 3), 'A' + k);
    }
    for (int k = 1; k < 8; k++) {
        n += snprintf(deck + n, sizeof deck - (size_t)n,
                      "contact %c %c -gap 20mm -law kelvin-voigt -k 90MN/m -e 0.6\n", 'A' + k - 1,
                      'A' + k);
    }
    snprintf(deck + n, sizeof deck - (size_t)n, "%s", SHAKEN "duration 5\nstep fixed 2ms\n");
    assert_true(check(deck) > 10);
}

static void any_beta_and_gamma_have_the_same_bits(void **state) {
    (void)state;
    assert_true(check(PAIR SHAKEN "step fixed 1ms\n"
                                  "integrator newmark -beta 0.3025 -gamma 0.6\n") > 10);
    assert_true(check(PAIR SHAKEN "step fixed 1ms\n"
                                  "integrator newmark -beta 0 -gamma 0.5\n") > 10);
}

static void loads_and_grounds_have_the_same_bits(void **state) {
    (void)state;
    assert_true(check(PAIR "step fixed 2ms\nload A:8 sine -amplitude 3MN -frequency 1.7Hz\n") > 0);
    assert_true(check(PAIR SHAKEN "step fixed 2ms\nload B:2:4 constant 80kN\n") > 10);
    assert_true(check(PAIR SHAKEN "step fixed 2ms\nground sine -amplitude 1 -frequency 2Hz\n") > 0);
    assert_true(check(PAIR "step fixed 2ms\n"
                           "ground record input/records/ELCENTRO_1940_NS.AT2 -buildings A\n"
                           "ground record input/records/ELCENTRO_1940_NS.AT2 -delay 0.3 "
                           "-buildings B\n") > 10);
    assert_true(check(PAIR "step fixed 2ms\ninitial A:8 -displacement 0.2m\n") > 0);
}

static void storeys_that_yield_have_the_same_bits(void **state) {
    (void)state;
    assert_true(check(PAIR SHAKEN "step fixed 1ms\n"
                                  "storey A:all bilinear -yield 4MN -hardening 0.05\n"
                                  "storey B:all bilinear -yield 2.5MN -hardening 0\n") > 5);
    assert_true(check(PAIR SHAKEN "step fixed 1ms\n"
                                  "storey A:1:3 bilinear -yield 4MN -hardening 0.05\n") > 5);
    assert_true(
        check(PAIR SHAKEN "step fixed 2ms\nstorey A:all clough -yield 4MN -hardening 0.05\n") > 5);
}

static void full_matrices_have_the_same_bits(void **state) {
    (void)state;
    assert_true(check(PAIR SHAKEN "step fixed 1ms\ndamping A modal 3%\n") > 10);
    assert_true(check(PAIR SHAKEN "step fixed 1ms\ndamping A modal 3%\n"
                                  "building C -floors 21 -mass 300t -stiffness 345MN/m\n"
                                  "damping C modal 2%\n") > 10);
    assert_true(check(PAIR SHAKEN "step fixed 1ms\nbuilding C -floors 10 -mass 300t -stiffness "
                                  "345MN/m\ndamping C modal 2%\n" ROW("B", "C")) > 10);
    assert_true(check(PAIR SHAKEN "step fixed 1ms\nbuilding C -floors 7 -mass 86t\n"
                                  "matrix C input/frame7.txt -unit N/m\ndamping B modal 1%\n" ROW(
                                      "B", "C")) > 10);
    assert_true(check(PAIR "step fixed 2ms\nbuilding C -floors 7 -mass 86t -stiffness 20MN/m\n"
                           "matrix C input/frame7.txt -unit N/m\n" ROW("B", "C") SHAKEN
                      "load C:7 sine -amplitude 1MN -frequency 1.3Hz\n") > 10);
    assert_true(check(PAIR SHAKEN "step fixed 1ms\ndamping A modal 3%\n"
                                  "storey A:all bilinear -yield 4MN -hardening 0.05\n") > 5);
}

// Blocks of floors begin and end where lanes do, not where buildings do.
static void buildings_of_a_long_row_have_the_bits_of_one_alone(void **state) {
    (void)state;
    enum { BUILDINGS = 14, FLOORS = 37 };
    char deck[4000];
    int n = 0;
    for (int k = 0; k < BUILDINGS; k++) {
        n += snprintf(deck + n, sizeof deck - (size_t)n,
                      "building B%d -floors %d -mass 300t -stiffness 345MN/m\n"
                      "damping B%d rayleigh 5%%\n",
                      k, FLOORS, k);
    }
    for (int k = 1; k < BUILDINGS; k++) {
        n += snprintf(deck + n, sizeof deck - (size_t)n,
                      "contact B%d B%d -gap 9m -law linear -k 1MN/m\n", k - 1, k);
    }
    struct analysis row = analysis_of("%s" SHAKEN "duration 3\nstep fixed 5ms\n", deck);
    struct analysis alone =
        analysis_of("building B -floors %d -mass 300t -stiffness 345MN/m\n"
                    "damping B rayleigh 5%%\n" SHAKEN "duration 3\nstep fixed 5ms\n",
                    FLOORS);
    for (int q = 0; q < PEAK_COUNT; q++) {
        for (ptrdiff_t k = 0; k < BUILDINGS; k++) {
            const double *peak = row.results->peak[q] + k * FLOORS;
            const double *when = row.results->peak_time[q] + k * FLOORS;
            assert_same(peak, alone.results->peak[q], FLOORS * sizeof *peak);
            assert_same(when, alone.results->peak_time[q], FLOORS * sizeof *when);
        }
    }
    analysis_free(&row);
    analysis_free(&alone);
}

// The number of floors is a constant in steps of up to sixteen of them, in flight and where links
// act. A third building that nothing touches makes them more.
static void few_floors_have_the_bits_of_many(void **state) {
    (void)state;
    static const char deck[] = PAIR SHAKEN "step fixed 2ms\n";
    static const char *const law[] = {
        "", "contact wall A:8 -gap 15mm -law kelvin-voigt -k 90MN/m -e 0.6\n",
        "link A:3 B:3 -stiffness 20MN/m\n", "contact A:2:4 wall -gap 9mm -law linear -k 1GN/m\n"};
    for (size_t i = 0; i < sizeof law / sizeof law[0]; i++) {
        struct analysis few = analysis_of("%s%s", deck, law[i]);
        struct analysis many =
            analysis_of("%s%sbuilding C -floors 9 -mass 200t -stiffness 345MN/m\n", deck, law[i]);
        size_t floors = (size_t)few.model->n_dof * sizeof(double);
        for (int q = 0; q < PEAK_COUNT; q++) {
            assert_same(few.results->peak[q], many.results->peak[q], floors);
            assert_same(few.results->peak_time[q], many.results->peak_time[q], floors);
        }
        assert_true(few.results->n_impact > 10);
        assert_same_impacts(few.results, many.results);
        analysis_free(&few);
        analysis_free(&many);
    }
}

// Links whose force is k d + c v take part in flight, by a solution of their own: equal but for
// rounding. A damper without effect, but not linear, keeps all from it.
static long check_links(const char *links) {
    static const char deck[] = PAIR SHAKEN "step fixed 1ms\n";
    struct analysis a = analysis_of("%s%s", deck, links);
    struct analysis b = analysis_of("%s%slink A:1 B:1 -dashpot 1e-30 -exponent 0.9\n", deck, links);
    const double most = a.results->energy[ENERGY_INPUT];
    assert_int_equal(a.results->n_impact, b.results->n_impact);
    assert_true(2 * a.results->totals.fast < b.results->totals.fast);
    for (int q = 0; q < PEAK_COUNT; q++) {
        for (int i = 0; i < a.model->n_dof; i++) {
            assert_close(a.results->peak[q][i], b.results->peak[q][i], 1e-10);
        }
    }
    for (int k = 0; k < a.model->n_link; k++) {
        assert_close(a.results->link[k].force, b.results->link[k].force, 1e-9);
        assert_near(a.results->link[k].dissipated, b.results->link[k].dissipated, 1e-11 * most);
    }
    assert_true(a.results->residual_peak < 1e-12 * most);
    const long n = a.results->n_impact;
    analysis_free(&a);
    analysis_free(&b);
    return n;
}

static void linear_links_fly(void **state) {
    (void)state;
    static const char *const links[] = {
        "link A:5 B:5 -dashpot 2MN*s/m\n",
        "link A:5 B:5 -stiffness 50MN/m\n",
        "link A:5 B:5 -stiffness 1e12\n",
        ("link A B -stiffness 20MN/m -dashpot 1MN*s/m\nlink A:8 A:7 -dashpot 3MN*s/m\n"
         "link A:0 A:1 -stiffness 9MN/m\nlink A:6 B:4 -stiffness 0\nload B:2 sine -amplitude 90kN "
         "-frequency 2\n"),
        "link A:3 B:3 -dashpot 1MN*s/m\nground sine -amplitude 1 -frequency 2Hz -buildings B\n",
        "link A B -stiffness 5MN/m\nstorey A:1:3 bilinear -yield 3MN -hardening 0.05\n",
        "link A:3 B:3 -dashpot 1MN*s/m\ndamping A modal 2%\n",
    };
    long n = 0;
    for (size_t i = 0; i < sizeof links / sizeof links[0]; i++) {
        n += check_links(links[i]);
    }
    assert_true(n > 100);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(few_floors_have_the_bits_of_many),
        cmocka_unit_test(a_pair_has_the_same_bits_with_every_law),
        cmocka_unit_test(rows_of_all_heights_have_the_same_bits),
        cmocka_unit_test(low_rows_of_one_height_have_the_same_bits),
        cmocka_unit_test(buildings_of_a_long_row_have_the_bits_of_one_alone),
        cmocka_unit_test(any_beta_and_gamma_have_the_same_bits),
        cmocka_unit_test(loads_and_grounds_have_the_same_bits),
        cmocka_unit_test(storeys_that_yield_have_the_same_bits),
        cmocka_unit_test(full_matrices_have_the_same_bits),
        cmocka_unit_test(linear_links_fly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
