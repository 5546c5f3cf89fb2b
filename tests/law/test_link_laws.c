// SPDX-License-Identifier: GPL-3.0-or-later
// Properties of all laws of links, and loops by hand. Lengthening and tension are positive here;
// the law of a link counts shortening and compression.
#include <math.h>
#include <string.h>

#include "law/bilateral.h"
#include "law/link_law.h"
#include "law/maxwell.h"
#include "support/random.h"
#include "support/storey.h"
#include "support/support.h"

// The link of the tests: 20 MN/m, 150 kN, so that it yields at 7.5 mm.
static const double STIFFNESS = 2e7, YIELD = 1.5e5, AT_YIELD = 7.5e-3;
static const double HARDENING = 0.05;

struct test_link {
    struct contact_law law;
    double constant[LINK_ROWS + STOREY_CONSTANTS_MAX + 8];
    double history[STOREY_HISTORY_MAX + 8];
    double x;  // committed lengthening
};

static struct link_law find(const char *name) {
    int i = 0;
    while (strcmp(link_law_at(i).name, name) != 0) {
        i++;
        assert_true(i < n_link_law);
    }
    return link_law_at(i);
}

static double value_of(const struct row *row, double hardening) {
    const bool slips = strcmp(row->key, "slip") == 0;
    return !isnan(row->fallback) ? row->fallback
           : slips               ? YIELD
                                 : test_storey_value(row->key, hardening);
}

#define BOTH LINK_ROW_STIFFNESS  // the link pulls and pushes

// A link with a storey law.
static struct test_link tie(const struct link_law *law, double slack, enum link_law_row only,
                            double hardening) {
    struct test_link l = {.law = link_law_make(law)};
    double value[LINK_ROWS + STOREY_ROWS_MAX] = {
        [LINK_ROW_STIFFNESS] = STIFFNESS,
        [LINK_ROW_SLACK] = slack,
        [LINK_ROW_TENSION_ONLY] = only == LINK_ROW_TENSION_ONLY ? 1.0 : NAN,
        [LINK_ROW_COMPRESSION_ONLY] = only == LINK_ROW_COMPRESSION_ONLY ? 1.0 : NAN,
    };
    for (int r = 0; r < law->n_row; r++) {
        value[LINK_ROWS + r] = value_of(&law->row[r], hardening);
    }
    struct error e;
    assert_int_equal(link_law_prepare(law, value, l.constant, &e), STATUS_OK);
    return l;
}

static struct test_link tie_named(const char *name, double slack) {
    const struct link_law law = find(name);
    return tie(&law, slack, BOTH, 0.0);
}

static struct contact_response respond(const struct test_link *l, double x, double rate) {
    return l->law.force(l->constant, l->history, -x, -rate);
}

// Tension at the lengthening x.
static double tension(const struct test_link *l, double x) {
    return 0.0 - respond(l, x, 0.0).force;
}

// Goes to x in n equal steps and commits each. Returns the work done on the link.
static double go(struct test_link *l, double x, int n) {
    double work = 0.0, before = tension(l, l->x);
    const double from = l->x;
    for (int i = 1; i <= n; i++) {
        const double to = from + (x - from) * i / n, force = tension(l, to);
        work += (before + force) / 2.0 * (to - l->x);
        l->law.commit(l->constant, l->history, -to, 0.0);
        l->x = to;
        before = force;
    }
    return work;
}

static double stored(const struct test_link *l) {
    return l->law.stored(l->constant, l->history, -l->x);
}

static void a_bilinear_loop_is_that_by_hand(void **state) {
    (void)state;
    enum { STEPS = 3000 };
    const struct link_law bilinear = find("bilinear");
    struct test_link l = tie(&bilinear, 0.0, BOTH, HARDENING);
    const double a = 0.03;
    go(&l, a, STEPS);
    assert_close(tension(&l, a), YIELD + HARDENING * STIFFNESS * (a - AT_YIELD), 1e-12);
    const double loop = go(&l, -a, STEPS) + go(&l, a, STEPS);
    assert_close(loop, 4.0 * (1.0 - HARDENING) * YIELD * (a - AT_YIELD), 1e-6);
    assert_close(tension(&l, a), YIELD + HARDENING * STIFFNESS * (a - AT_YIELD), 1e-12);
}

static void a_friction_loop_is_that_by_hand_with_and_without_slack(void **state) {
    (void)state;
    enum { STEPS = 3000 };
    for (double slack = 0.0; slack < 0.012; slack += 0.005) {
        struct test_link l = tie_named("friction", slack);
        const double a = 0.03;
        go(&l, a, STEPS);
        assert_true(tension(&l, a) == YIELD);
        const double loop = go(&l, -a, STEPS) + go(&l, a, STEPS);
        assert_close(loop, 4.0 * YIELD * (a - slack - AT_YIELD), 1e-6);
    }
}

static void a_hook_catches_at_its_slack_and_gives_back_all_work(void **state) {
    (void)state;
    enum { STEPS = 600 };
    static const char *const name[] = {"hook", "cable"};
    for (int i = 0; i < 2; i++) {
        struct test_link l = tie_named(name[i], 0.01);
        assert_true(tension(&l, 0.01) == 0.0 && tension(&l, -5.0) == 0.0);
        assert_close(tension(&l, 0.012), STIFFNESS * 0.002, 1e-12);
        const double work = go(&l, 0.03, STEPS);
        assert_close(work, STIFFNESS * 0.02 * 0.02 / 2.0, 1e-12);
        assert_close(stored(&l), work, 1e-12);
        assert_near(work + go(&l, -0.03, STEPS), 0.0, 1e-12 * work);
        assert_near(stored(&l), 0.0, 1e-12 * work);
    }
}

// Yielded in tension to a, the brace hangs loose below a - AT_YIELD, and yields again beyond a.
static void a_brace_in_tension_only_hangs_loose_after_it_has_yielded(void **state) {
    (void)state;
    const struct link_law bilinear = find("bilinear");
    const double slack = 2e-3;
    struct test_link l = tie(&bilinear, slack, LINK_ROW_TENSION_ONLY, 0.0);
    const double a = 0.03;
    assert_close(go(&l, a, 1), 0.5 * YIELD * a, 1e-12);  // in one step
    assert_true(tension(&l, a) == YIELD);
    go(&l, -0.05, 7);
    assert_true(tension(&l, -0.05) == 0.0 && stored(&l) < 1e-9 * YIELD * a);
    assert_near(tension(&l, a - AT_YIELD), 0.0, 1e-9 * YIELD);
    assert_close(tension(&l, a - AT_YIELD / 2.0), YIELD / 2.0, 1e-9);
    assert_near(go(&l, a, 3000) + go(&l, -0.01, 3000), 0.0, 1e-3 * YIELD * a);
    assert_close(go(&l, a + 0.02, 60000), YIELD * (AT_YIELD / 2.0 + 0.02), 1e-4);
}

// A gap of 10 mm. Each impact crushes the spring, by which the gap grows.
static void a_gap_spring_remembers_the_impacts_before(void **state) {
    (void)state;
    enum { STEPS = 4000 };
    const double gap = 0.01;
    struct test_link l = tie_named("gap", gap);
    assert_true(tension(&l, 5.0) == 0.0 && tension(&l, -gap) == 0.0);
    assert_close(tension(&l, -gap - AT_YIELD / 2.0), -YIELD / 2.0, 1e-12);
    const double crushed[] = {0.02, 0.015, 0.03}, most[] = {0.02, 0.02, 0.03};
    double before = 0.0;
    for (int i = 0; i < 3; i++) {
        double work = go(&l, -gap - crushed[i], STEPS);
        const double rest = most[i] - AT_YIELD;  // the crushing that stays
        assert_close(tension(&l, -gap - crushed[i]),
                     fmax(-YIELD, -STIFFNESS * fmax(crushed[i] - rest, 0.0)), 1e-9);
        work += go(&l, 0.02, STEPS);
        assert_near(work, YIELD * (rest - before), 1e-3 * YIELD * AT_YIELD);
        before = rest;
        assert_near(tension(&l, -gap - rest), 0.0, 1e-9 * YIELD);
    }
}

// The damper that carries d -> d + a goes round a rectangle of the height of its relief force.
static void a_viscous_loop_is_that_by_hand(void **state) {
    (void)state;
    const double value[BILATERAL_ROWS] = {0.0, 2e5, 0.5, 1e5, 3e4};
    double constant[8], rates[] = {0.01, 0.16, 0.25, 1.0, 4.0};
    struct error e;
    assert_int_equal(bilateral_law.prepare(value, 1.0, constant, &e), STATUS_OK);
    for (size_t i = 0; i < sizeof rates / sizeof rates[0]; i++) {
        const double v = rates[i];
        const double want = v <= 0.25 ? 2e5 * sqrt(v) : 1e5 + 3e4 * (v - 0.25);
        assert_close(bilateral_law.force(constant, NULL, 0.3, v).force, want, 1e-14);
        assert_close(bilateral_law.force(constant, NULL, 0.3, -v).force, -want, 1e-14);
        const struct contact_way way = {0.0, 0.0, 0.1, v};
        assert_near(bilateral_law.kink(constant, NULL, &way), 0.25 - v, 1e-14);
    }
}

static struct test_link maxwell(double dashpot, double exponent) {
    struct test_link l = {.law = maxwell_law};
    const double value[MAXWELL_ROWS] = {STIFFNESS, dashpot, exponent};
    struct error e;
    assert_int_equal(maxwell_law.prepare(value, 1.0, l.constant, &e), STATUS_OK);
    return l;
}

// Steady motion a sin(w t): the loop of the loss modulus, pi a^2 k w T / (1 + (w T)^2), T = c / k.
static void a_maxwell_loop_is_that_by_hand(void **state) {
    (void)state;
    enum { STEPS = 2000, CYCLES = 12 };
    const double a = 0.02, w = 9.0, relaxation = 0.15;
    const double step = 2.0 * acos(-1.0) / w / STEPS;
    struct test_link l = maxwell(relaxation * STIFFNESS, 1.0);
    double loop = 0.0, before = 0.0;
    for (int i = 1; i <= CYCLES * STEPS; i++) {
        const double x = a * sin(w * step * i);
        l.history[MAXWELL_STEP] = step;
        const double force = tension(&l, x);
        l.law.commit(l.constant, l.history, -x, 0.0);
        assert_close(tension(&l, x), force, 1e-9);  // the committed force is that of the step
        loop = i % STEPS == 1 ? 0.0 : loop;
        loop += (before + force) / 2.0 * (x - l.x);
        before = force;
        l.x = x;
    }
    const double wt = w * relaxation;
    assert_close(loop, acos(-1.0) * a * a * STIFFNESS * wt / (1.0 + wt * wt), 1e-5);
}

// Drawn out at a constant rate, any damper comes to c v^a.
static void a_maxwell_link_comes_to_the_force_of_its_damper(void **state) {
    (void)state;
    static const double exponent[] = {0.15, 0.5, 1.0, 1.7, 3.0};
    for (size_t i = 0; i < sizeof exponent / sizeof exponent[0]; i++) {
        struct test_link l = maxwell(2e5, exponent[i]);
        for (int n = 1; n <= 4000; n++) {
            const double x = 0.3 * 1e-3 * n;
            l.history[MAXWELL_STEP] = 1e-3;
            assert_true(tension(&l, x) >= 0.0);
            l.law.commit(l.constant, l.history, -x, 0.0);
            l.x = x;
        }
        assert_close(tension(&l, l.x), 2e5 * pow(0.3, exponent[i]), 1e-9);
    }
}

// A link that hangs loose has not come to the other side of V = 0, and goes back along the line on
// which it unloaded. Rounding let it forget that line, in about one of two hundred unloadings: its
// stiffness was then that of a line to the largest drift of the other side.
static void a_loose_link_comes_back_on_the_line_of_its_unloading(void **state) {
    (void)state;
    static const char *const name[] = {"clough", "takeda"};
    struct random r = {1};
    for (int trial = 0; trial < 4000; trial++) {
        const double slack = random_uniform(&r, 1e-3, 5e-3), sign = trial % 2 == 0 ? 1.0 : -1.0;
        struct test_link l = tie_named(name[trial / 2 % 2], slack);
        go(&l, sign * random_uniform(&r, 2.0, 6.0) * AT_YIELD, 5);
        go(&l, -sign * random_uniform(&r, 2.0, 6.0) * AT_YIELD, 5);
        go(&l, sign * random_uniform(&r, 2.0, 6.0) * AT_YIELD, 5);
        const struct contact_response at = respond(&l, l.x, 0.0),
                                      back = respond(&l, l.x - sign * 1e-6, 0.0);
        const double loose = l.x - fabs(at.force) / back.dfdd * sign;
        go(&l, loose - sign * slack, 7);
        assert_true(tension(&l, l.x) == 0.0);
        assert_close(respond(&l, loose + sign * 1e-6, 0.0).dfdd, back.dfdd, 1e-12);
    }
}

// The link number `i` of a sequence over all storey laws, slacks and both kinds: see N_KINDS.
static const enum link_law_row direction[] = {BOTH, LINK_ROW_TENSION_ONLY,
                                              LINK_ROW_COMPRESSION_ONLY};
enum { N_SLACK = 2, N_KINDS = 3 * N_SLACK };
static struct test_link link_number(const struct link_law *law, int kind) {
    const enum link_law_row only = law->only != 0 ? law->only : direction[kind / N_SLACK];
    return tie(law, kind % N_SLACK == 0 ? 0.0 : 4e-3, only, HARDENING);
}

static void a_link_in_one_direction_never_acts_in_the_other(void **state) {
    (void)state;
    struct random random = {7};
    for (int i = 0; i < n_link_law; i++) {
        const struct link_law law = link_law_at(i);
        for (int kind = 0; law.storey && kind < N_KINDS; kind++) {
            struct test_link l = link_number(&law, kind);
            const enum link_law_row only = law.only != 0 ? law.only : direction[kind / N_SLACK];
            int pulls = 0, pushes = 0;
            for (int n = 0; n < 3000; n++) {
                const double x = l.x + random_uniform(&random, -0.01, 0.01) - 0.1 * l.x;
                const double force = tension(&l, x);
                pulls += force > 0.0;
                pushes += force < 0.0;
                go(&l, x, 1);
                assert_true(tension(&l, x) == force || fabs(tension(&l, x) - force) < 1e-6 * YIELD);
            }
            assert_true(only == LINK_ROW_COMPRESSION_ONLY ? pulls == 0 : pulls > 10);
            assert_true(only == LINK_ROW_TENSION_ONLY ? pushes == 0 : pushes > 10);
        }
    }
}

static void tangents_agree_with_differences(void **state) {
    (void)state;
    struct random random = {3};
    const double h = 1e-8;
    for (int i = 0; i < n_link_law; i++) {
        const struct link_law law = link_law_at(i);
        for (int kind = 0; law.storey && kind < N_KINDS; kind++) {
            struct test_link l = link_number(&law, kind);
            int smooth = 0;
            for (int n = 0; n < 400; n++) {
                go(&l, random_uniform(&random, -0.03, 0.03), 3);
                const double x = l.x + random_uniform(&random, -0.01, 0.01);
                const double right = (tension(&l, x + h) - tension(&l, x)) / h;
                const double left = (tension(&l, x) - tension(&l, x - h)) / h;
                if (fabs(right - left) < 1e-4 * STIFFNESS) {  // else there is a kink
                    smooth++;
                    assert_near(respond(&l, x, 0.0).dfdd, (left + right) / 2.0, 1e-4 * STIFFNESS);
                }
            }
            assert_true(smooth > 380);
        }
    }
    static const double exponent[] = {0.3, 1.0, 2.0};
    for (size_t i = 0; i < sizeof exponent / sizeof exponent[0]; i++) {
        struct test_link l = maxwell(3e5, exponent[i]);
        l.history[MAXWELL_STEP] = 0.01;
        for (double x = -0.0193; x < 0.02; x += 1e-3) {
            const double slope = (tension(&l, x + 1e-6) - tension(&l, x - 1e-6)) / 2e-6;
            assert_close(respond(&l, x, 0.0).dfdd, slope, 1e-4);
        }
    }
}

static void a_law_of_links_is_a_pure_function(void **state) {
    (void)state;
    for (int i = 0; i < n_link_law; i++) {
        const struct link_law law = link_law_at(i);
        for (int kind = 0; law.storey && kind < N_KINDS; kind++) {
            struct test_link l = link_number(&law, kind), before;
            go(&l, 0.02, 5);
            memcpy(&before, &l, sizeof l);
            const double first = tension(&l, 0.01);
            (void)tension(&l, -0.5);
            assert_true(first == tension(&l, 0.01));
            assert_memory_equal(&before, &l, sizeof l);
        }
    }
}

// Random closed paths: what is not stored at the end is not less than nothing.
static void no_closed_path_makes_energy(void **state) {
    (void)state;
    struct random random = {11};
    for (int i = 0; i < n_link_law; i++) {
        const struct link_law law = link_law_at(i);
        for (int path = 0; law.storey && path < 3 * N_KINDS; path++) {
            struct test_link l = link_number(&law, path % N_KINDS);
            double work = 0.0;
            for (int n = 0; n < 30; n++) {
                work += go(&l, random_uniform(&random, -0.03, 0.03), 300);
            }
            work += go(&l, 0.0, 300);
            assert_true(work - stored(&l) > -2e-3 * YIELD * AT_YIELD);
        }
    }
}

// The distance to a kink changes its sign at the yield, and at the end of the slack.
static void a_kink_is_where_the_line_ends(void **state) {
    (void)state;
    const struct link_law bilinear = find("bilinear");
    const double slack = 4e-3;
    const struct test_link l = tie(&bilinear, slack, BOTH, HARDENING);
    for (double x = 6e-4; x < slack + AT_YIELD; x += 1e-3) {
        const struct contact_way loose = {0.0, -1.0, -x, -1.0};
        const double to = l.law.kink(l.constant, l.history, &loose);
        assert_true((to > 0.0) == (x < slack));
        if (2.0 * x > slack) {
            assert_near(to, slack - x, 1e-15);
        }
        const struct contact_way tight = {-slack - 1e-6, -1.0, -slack - x, -1.0};
        const double on = l.law.kink(l.constant, l.history, &tight);
        assert_true((on > 0.0) == (x < AT_YIELD));
        if (2.0 * x > AT_YIELD + 1e-6) {
            assert_near(on, AT_YIELD - x, 1e-15);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_bilinear_loop_is_that_by_hand),
        cmocka_unit_test(a_friction_loop_is_that_by_hand_with_and_without_slack),
        cmocka_unit_test(a_hook_catches_at_its_slack_and_gives_back_all_work),
        cmocka_unit_test(a_brace_in_tension_only_hangs_loose_after_it_has_yielded),
        cmocka_unit_test(a_loose_link_comes_back_on_the_line_of_its_unloading),
        cmocka_unit_test(a_gap_spring_remembers_the_impacts_before),
        cmocka_unit_test(a_viscous_loop_is_that_by_hand),
        cmocka_unit_test(a_maxwell_loop_is_that_by_hand),
        cmocka_unit_test(a_maxwell_link_comes_to_the_force_of_its_damper),
        cmocka_unit_test(a_link_in_one_direction_never_acts_in_the_other),
        cmocka_unit_test(tangents_agree_with_differences),
        cmocka_unit_test(a_law_of_links_is_a_pure_function),
        cmocka_unit_test(no_closed_path_makes_energy),
        cmocka_unit_test(a_kink_is_where_the_line_ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
