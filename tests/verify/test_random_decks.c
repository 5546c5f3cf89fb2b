// SPDX-License-Identifier: GPL-3.0-or-later
// Any deck ends: with finite numbers, a closed account of energy and every contact solved, or with
// a truthful error. JOSTLE_LONG=1 runs ten thousand of them.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/analysis.h"
#include "support/random_deck.h"
#include "support/support.h"

static void check_rows(const struct analysis *a) {
    const struct kept_rows *r = &a->rows;
    for (long i = 0; i < r->n * r->n_dof; i++) {
        assert_true(isfinite(r->displacement[i]) && isfinite(r->velocity[i]));
        assert_true(isfinite(r->acceleration[i]) && isfinite(r->shear[i]));
    }
    for (long i = 0; i < r->n * r->n_link; i++) {
        assert_true(isfinite(r->force[i]) && isfinite(r->penetration[i]));
    }
    for (long i = 0; i < r->n * ENERGY_COUNT; i++) {
        assert_true(isfinite(r->energy[i]));
    }
}

static void check_impacts(const struct results *r, const struct model *m) {
    double duration = m->duration;
    double last = 0.0;
    for (long i = 0; i < r->n_impact; i++) {
        const struct impact *p = &r->impact[i];
        assert_true(p->t_start >= last && p->t_end >= p->t_start);
        assert_true(p->t_end <= duration * (1.0 + 1e-12));
        assert_true(p->v_approach >= 0.0 && isfinite(p->v_rebound));
        assert_true(isfinite(p->impulse) && isfinite(p->dissipated));
        assert_true(m->link[p->contact].law->rebound ? isnan(p->peak_force) : p->peak_force >= 0.0);
        last = p->t_start;
    }
}

// Bodies of a rigid contact enter each other by no more than the location of the closure allows,
// 1e-8 of a step's way, and rounding. Where their grounds move differently, the ground motion,
// which is exact, and its trapezoidal integral, which the contact at rest follows, stray from each
// other.
static void check_rigid(const struct results *r, const struct model *m) {
    double speed = 0.0;
    double way = 0.0;
    for (int i = 0; i < m->n_dof; i++) {
        speed = fmax(speed, r->peak[PEAK_VELOCITY][i]);
        way = fmax(way, r->peak[PEAK_DISPLACEMENT][i]);
    }
    for (int k = 0; k < m->n_contact; k++) {
        if (m->link[k].law->rebound && !m->link[k].moving_ground) {
            assert_true(r->link[k].penetration <= 4e-8 * speed * m->dt + 1e-12 * way);
        }
    }
}

// What the contacts have given back beyond what was put in, relative to the flow of energy.
static double created(const struct analysis *a) {
    return -a->results->energy[ENERGY_CONTACT] / analysis_flow(a);
}

static bool average_acceleration(const struct model *m) {
    return m->gamma == 0.5 && m->beta == 0.25;
}

static void check_deck(uint64_t seed, const char *text, const struct analysis *a) {
    check_rows(a);
    check_impacts(a->results, a->model);
    check_rigid(a->results, a->model);
    bool good = a->results->totals.unsolved == 0;
    if (average_acceleration(a->model)) {
        good = good && a->results->residual_peak <= 1e-9 * analysis_flow(a) && created(a) < 0.02;
    }
    if (!good) {
        print_error("deck %llu: %ld unsolved, residual %g of %g, created %g\n%s",
                    (unsigned long long)seed, a->results->totals.unsolved,
                    a->results->residual_peak, analysis_flow(a), created(a), text);
    }
    assert_true(good);
}

// Runs a deck; false: it was given up with an error that names a hard contact that rattles for
// ever.
static bool try_deck(uint64_t seed) {
    char text[4096];
    struct error e = {0};
    random_deck(seed, text, sizeof text);
    struct analysis a = analysis_try(text, &e);
    bool ends = e.status == STATUS_OK;
    if (ends) {
        check_deck(seed, text, &a);
    } else if (!strstr(e.message, "is still too long for contact")) {
        fail_msg("deck %llu: %s\n%s", (unsigned long long)seed, e.message, text);
    }
    analysis_free(&a);
    return ends;
}

// Decks that are given up are rare.
static void every_random_deck_ends_with_finite_numbers_and_a_closed_account(void **state) {
    (void)state;
    uint64_t n = getenv("JOSTLE_LONG") ? 10000 : 500;
    uint64_t given_up = 0;
    for (uint64_t seed = 1; seed <= n; seed++) {
        given_up += !try_deck(seed);
    }
    assert_true(given_up <= n / 200);
}

// Rigid contacts that once met without end, stood inside each other, or made energy of nothing.
static void random_decks_that_have_failed_end_well(void **state) {
    (void)state;
    const uint64_t seed[] = {617, 2762, 3001, 3539, 4462, 7546, 7990, 8181};
    for (size_t i = 0; i < sizeof seed / sizeof seed[0]; i++) {
        assert_true(try_deck(seed[i]));
    }
}

// Hinges yield, harden, soften and collapse: rows are finite and the account of energy closes, or
// an error says what no step can solve.
static void random_frames_end_well(void **state) {
    (void)state;
    const uint64_t n = getenv("JOSTLE_LONG") ? 5000 : 150;
    uint64_t given_up = 0, yielded = 0;
    for (uint64_t seed = 1; seed <= n; seed++) {
        char text[4096];
        struct error e = {0};
        random_deck_framed(seed, text, sizeof text);
        struct analysis a = analysis_try(text, &e);
        if (e.status == STATUS_OK || e.status == STATUS_COLLAPSE) {
            check_rows(&a);
            yielded += a.results->energy[ENERGY_HYSTERETIC] > 0.01 * analysis_flow(&a);
            if (!(a.results->residual_peak <= 1e-9 * analysis_flow(&a))) {
                fail_msg("deck %llu: residual %g of %g\n%s", (unsigned long long)seed,
                         a.results->residual_peak, analysis_flow(&a), text);
            }
        } else {
            given_up++;
            print_message("deck %llu: %s\n%s", (unsigned long long)seed, e.message, text);
        }
        analysis_free(&a);
    }
    print_message("%llu of %llu yielded, %llu given up\n", (unsigned long long)yielded,
                  (unsigned long long)n, (unsigned long long)given_up);
    assert_true(yielded > n / 2 && given_up <= n / 50);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_decks_that_have_failed_end_well),
        cmocka_unit_test(random_frames_end_well),
        cmocka_unit_test(every_random_deck_ends_with_finite_numbers_and_a_closed_account),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
