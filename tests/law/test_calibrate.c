// SPDX-License-Identifier: GPL-3.0-or-later
// The damping that delivers e exactly.
#include <gsl/gsl_errno.h>
#include <math.h>
#include <string.h>

#include "law/restitution.h"
#include "support/analysis.h"
#include "support/impact.h"
#include "support/support.h"

static void the_constants_agree_with_those_worked_out_independently(void **state) {
    (void)state;
    static const double e[] = {0.40, 0.65, 0.90};
    static const struct {
        const char *law;
        double exact[3];
    } table[] = {
        {"kelvin-voigt", {0.27999799333504155, 0.13585123264427953, 0.03351844910567637}},
        {"komodromos", {0.35450772, 0.14993876, 0.034265204}},
        {"mahmoud-jankowski", {0.87903863, 0.32929376, 0.070035004}},
        {"hertz-damp", {2.0824982, 0.79310091, 0.16648195}},
        {"hunt-crossley", {2.082498164147007, 0.7931009088580941, 0.1664819506853078}},
        {"jankowski", {0.98279506, 0.36816161, 0.078301515}},
    };
    for (size_t k = 0; k < sizeof table / sizeof table[0]; k++) {
        for (int i = 0; i < 3; i++) {
            double got = contact_law_find(table[k].law)->exact(e[i]);
            assert_close(got, table[k].exact[i], 1e-7);
        }
    }
}

// What a law needs apart from e; the impact is one of 0.7 m/s.
static const char *parameters(const struct contact_law *law) {
    static const struct {
        const char *law, *text;
    } own[] = {
        {"power", "k 3e8 n 1.3"},
        {"rubber", "k 3e8 n 2.2 du 1e-3 ky 3e7"},
        {"bilinear", "kh 3e8 v0 0.7"},
        {"wang", "k 3e8 residual 0.01 n 1.2"},
    };
    for (size_t i = 0; i < sizeof own / sizeof own[0]; i++) {
        if (strcmp(law->name, own[i].law) == 0) {
            return own[i].text;
        }
    }
    return "k 3e8";
}

static struct isolated_impact calibrated(const struct contact_law *law, double e) {
    double value[CONTACT_ROWS_MAX];
    struct error error;
    impact_law(law->name, parameters(law), value);
    if (law->exact) {
        value[contact_law_row(law, "zeta")] = law->exact(e);
    } else {
        value[contact_law_row(law, "e")] = e;
        if (law->calibrate) {
            assert_int_equal(law->calibrate(value, 2e4, &error), STATUS_OK);
        }
    }
    return impact_of(law, value, 2e4, 0.7);
}

static void a_calibrated_law_delivers_e(void **state) {
    (void)state;
    int n = 0;
    for (int k = 0; k < n_contact_law; k++) {
        const struct contact_law *law = contact_laws[k];
        bool takes_e = contact_law_row(law, "e") >= 0;
        bool exact = law->traits & CONTACT_EXACT;
        assert_int_equal(exact + (law->exact != NULL) + (law->calibrate != NULL), takes_e);
        takes_e = takes_e && !law->rebound;  // rigid bodies have no impact to be integrated
        for (int i = 2; takes_e && i < 20; i++) {
            double e = 0.05 * i;
            assert_close(calibrated(law, e).restitution, e, 1e-9);
            n++;
        }
        if (takes_e) {
            assert_close(calibrated(law, 0.05).restitution, 0.05, 1e-6);
        }
        if (law->exact) {
            assert_near(law->exact(1.0), 0.0, 0.0);
        }
    }
    assert_true(n >= 14 * 18);
}

// The word -calibrate of a deck gives the constants of the exact zeta, whatever the masses.
static void a_deck_calibrates_its_contacts(void **state) {
    (void)state;
    const char *text = "building A -floors 1 -mass 3000 -stiffness 1\n"
                       "building B -floors 1 -mass 5000 -stiffness 1\n"
                       "contact A B -gap 1 -name c -law jankowski -k 2e9 %s\n"
                       "contact A B -gap 1 -name p -law power -k 2e9 -n 1.2 -e 0.4 -calibrate\n"
                       "initial A:1 -velocity 1\nstep fixed 0.01\nduration 1\n";
    struct model *m = analysis_model(text, "-e 0.65 -calibrate");
    struct model *published = analysis_model(text, "-e 0.65");
    struct model *given = analysis_model(text, "-zeta 0.36816161");
    assert_close(m->link[0].constant[1], given->link[0].constant[1], 1e-7);
    assert_true(published->link[0].constant[1] > 1.01 * m->link[0].constant[1]);
    assert_true(m->link[1].constant[2] == restitution_exact_q(0.4));
    model_free(m);
    model_free(published);
    model_free(given);
}

// Where both members of the equations are alike, few digits must be lost.
static void nearly_elastic_impacts_keep_their_digits(void **state) {
    (void)state;
    double loss = 1e-6;
    double e = 1.0 - loss;
    // First order in 1 - e: ln e = -2 q / 3, -pi zeta / 2, -pi zeta.
    assert_close(restitution_exact_q(e), 1.5 * loss, 1e-5);
    assert_close(restitution_approach(e), 2.0 * loss / 3.141592653589793, 1e-5);
    assert_close(restitution_no_tension(e), loss / 3.141592653589793, 1e-5);
}

// zeta = 1 is critical: e = exp(-1) with the dashpot on approach, exp(-2) without tension.
static void the_critical_ratio_is_no_gap_between_the_formulas(void **state) {
    (void)state;
    assert_close(restitution_approach(exp(-1.0)), 1.0, 1e-12);
    assert_close(restitution_no_tension(exp(-2.0)), 1.0, 1e-12);
    for (int i = -3; i <= 3; i++) {
        double e = exp(-1.0 + 1e-5 * i);
        // d(a / tan a) / d zeta = 2/3 at zeta = 1.
        assert_near(restitution_approach(e), 1.0 - 1.5e-5 * i, 1e-8);
    }
}

// Both relations lose no digits near e = 1: s = 1 - 2 q / 3, 1 - e = q / 3 to first order.
static void approach_and_release_alone_can_be_calibrated_too(void **state) {
    (void)state;
    assert_close(restitution_stored_q(1.0 - 1e-6), 1.5e-6, 1e-5);
    assert_close(restitution_release_q(1.0 - 1e-6), 3e-6, 1e-5);
    assert_near(restitution_stored_q(1.0), 0.0, 0.0);
    const double share[] = {0.9, 0.3, 1e-3};
    for (int i = 0; i < 3; i++) {
        double q = restitution_stored_q(share[i]);
        assert_close(2.0 * (q - log1p(q)) / (q * q), share[i], 1e-12);
    }
}

static void small_restitutions_give_finite_damping(void **state) {
    (void)state;
    const double e[] = {0.05, 1e-3, 1e-8};
    for (int i = 0; i < 3; i++) {
        double q = restitution_exact_q(e[i]);
        assert_true(q < 1.0 / e[i] && q > 0.95 / e[i]);
        assert_true(isfinite(restitution_approach(e[i])));
        assert_true(isfinite(restitution_no_tension(e[i])));
    }
}

int main(void) {
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_constants_agree_with_those_worked_out_independently),
        cmocka_unit_test(a_calibrated_law_delivers_e),
        cmocka_unit_test(a_deck_calibrates_its_contacts),
        cmocka_unit_test(nearly_elastic_impacts_keep_their_digits),
        cmocka_unit_test(the_critical_ratio_is_no_gap_between_the_formulas),
        cmocka_unit_test(approach_and_release_alone_can_be_calibrated_too),
        cmocka_unit_test(small_restitutions_give_finite_damping),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
