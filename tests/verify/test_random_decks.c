// SPDX-License-Identifier: GPL-3.0-or-later
// Any deck ends: with finite numbers, a closed account of energy and every contact solved, or with
// a truthful error. JOSTLE_LONG=1 runs ten thousand of them.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

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

static void check_impacts(const struct results *r, double duration) {
    double last = 0.0;
    for (long i = 0; i < r->n_impact; i++) {
        const struct impact *p = &r->impact[i];
        assert_true(p->t_start >= last && p->t_end >= p->t_start);
        assert_true(p->t_end <= duration * (1.0 + 1e-12));
        assert_true(p->v_approach >= 0.0 && isfinite(p->v_rebound));
        assert_true(isfinite(p->impulse) && isfinite(p->dissipated) && p->peak_force >= 0.0);
        last = p->t_start;
    }
}

// Largest of the energies that flow: rounding of the account scales with it.
static double flow(const struct analysis *a) {
    double largest = a->results->initial_energy;
    for (long i = 0; i < a->rows.n * ENERGY_COUNT; i++) {
        if (i % ENERGY_COUNT != ENERGY_RESIDUAL) {
            largest = fmax(largest, fabs(a->rows.energy[i]));
        }
    }
    return largest;
}

static void run_deck(uint64_t seed) {
    char text[4096];
    random_deck(seed, text, sizeof text);
    struct analysis a = analysis_of("%s", text);
    check_rows(&a);
    check_impacts(a.results, a.model->duration);
    bool closes = a.model->gamma == 0.5;
    bool good =
        a.results->totals.unsolved == 0 && (!closes || a.results->residual_peak <= 1e-9 * flow(&a));
    if (!good) {
        print_error("deck %llu: %ld unsolved, residual %g of %g\n%s", (unsigned long long)seed,
                    a.results->totals.unsolved, a.results->residual_peak, flow(&a), text);
    }
    assert_true(good);
    analysis_free(&a);
}

static void every_random_deck_ends_with_finite_numbers_and_a_closed_account(void **state) {
    (void)state;
    uint64_t n = getenv("JOSTLE_LONG") ? 10000 : 150;
    for (uint64_t seed = 1; seed <= n; seed++) {
        run_deck(seed);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_random_deck_ends_with_finite_numbers_and_a_closed_account),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
