// SPDX-License-Identifier: GPL-3.0-or-later
// The documented constants of the solver: what each one promises, just inside and just outside.
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdio.h>

#include "solve/contact/contact.h"
#include "support/analysis.h"
#include "support/single_step.h"
#include "support/support.h"

// A body of 1 t hits a wall.
static long cuts_of_a_hit(const char *law, double step) {
    struct analysis a = analysis_of("building A -floors 1 -mass 1000 -stiffness 0\n"
                                    "initial A:1 -velocity 1\ncontact A wall -gap 1mm -law %s\n"
                                    "step fixed %.17g\nduration 0.2\n",
                                    law, step);
    long rejected = a.results->totals.rejected;
    assert_int_equal(a.results->n_impact, 1);
    assert_true(a.results->impact[0].steps >= 10);
    analysis_free(&a);
    return rejected;
}

// k S h^2 <= (pi / 10)^2 with S = 1 / m: ten steps in the duration pi sqrt(m / k) of the contact.
static void steps_are_cut_where_fewer_than_ten_make_a_contact(void **state) {
    (void)state;
    const double duration = M_PI * sqrt(1000.0 / 1e6);
    assert_int_equal(cuts_of_a_hit("linear -k 1e6", duration / 10.1), 0);
    assert_true(cuts_of_a_hit("linear -k 1e6", duration / 9.9) > 0);
}

// A spring that stiffens, F = k d^3, is looked at again as it gets deeper: whatever the velocity of
// the body, a step too long for the largest penetration, by a third, is cut there. With 4 as 0.4 or
// with 2 as 20 some are not: they fit a smaller penetration, and that is taken to say enough.
static void steps_are_cut_where_a_spring_has_stiffened(void **state) {
    (void)state;
    for (int i = 0; i < 40; i++) {
        const double speed = 0.5 + 0.02 * i, k = 1e9, mass = 1000.0;
        const double deepest = pow(2.0 * mass * speed * speed / k, 0.25);
        const double step = 1.33 * M_PI / 10.0 * sqrt(mass / (3.0 * k * deepest * deepest));
        struct analysis a = analysis_of("building A -floors 1 -mass 1000 -stiffness 0\n"
                                        "initial A:1 -velocity %.17g\n"
                                        "contact A wall -gap 1mm -law power -k 1e9 -n 3\n"
                                        "step fixed %.17g\nduration 0.5\n",
                                        speed, step);
        assert_true(a.results->totals.rejected > 0);
        analysis_free(&a);
    }
}

// gamma h S c <= 1/2, with gamma = 1/2 and c = 2 zeta sqrt(k m) = 1e5 N s/m: h <= m / c = 10 ms.
static void steps_are_cut_where_a_dashpot_would_stop_a_body(void **state) {
    (void)state;
    assert_int_equal(cuts_of_a_hit("kelvin-voigt -k 1e3 -zeta 50", 9.9e-3), 0);
    assert_true(cuts_of_a_hit("kelvin-voigt -k 1e3 -zeta 50", 10.1e-3) > 0);
}

// A tangent is used as far as it is accurate: at every step the forces are those of the law, to a
// tenth of the tolerance of the iteration, 1e-10 of the largest force of the step. They differ by
// 2e-12; ten times the reach would make that 3e-11.
static void tangents_replace_a_law_only_where_they_are_accurate(void **state) {
    (void)state;
    struct analysis a = analysis_of("building A -floors 8 -mass 300t -stiffness 345MN/m\n"
                                    "building B -floors 5 -mass 300t -stiffness 345MN/m\n"
                                    "damping A rayleigh 5%%\ndamping B rayleigh 5%%\n"
                                    "contact A B -gap 20mm -law hertz -k 2.75e9N/m^1.5\n"
                                    "ground record input/records/ELCENTRO_1940_NS.AT2\n"
                                    "newton -tolerance 1e-10\nstep fixed 2ms\noutput -every 1\n"
                                    "duration 10\n");
    double largest = 0.0, error = 0.0;
    for (long i = 0; i < a.rows.n * a.rows.n_link; i++) {
        double d = fmax(a.rows.penetration[i], 0.0);
        largest = fmax(largest, a.rows.force[i]);
        error = fmax(error, fabs(a.rows.force[i] - 2.75e9 * d * sqrt(d)));
    }
    assert_true(largest > 1e6);
    assert_true(error < 1e-11 * largest);
    analysis_free(&a);
}

enum { BODIES = 6 };

// Six bodies in a row are pressed against a wall by 0.1 MN, and shaken. Each has a second floor
// that nothing holds, `far` away.
static struct analysis pressed(double far) {
    char text[4096];
    int n = snprintf(text, sizeof text,
                     "newton -tolerance 1e-9\nstep fixed 1ms\nduration 0.05\n"
                     "output -every 1\n");
    for (int i = 0; i < BODIES; i++) {
        n += snprintf(text + n, sizeof text - (size_t)n,
                      "building B%d -floors 2 -mass 1000 -stiffness 0\n"
                      "initial B%d:1 -displacement %.17g\ninitial B%d:2 -displacement %g\n",
                      i, i, -1e-6 * (i + 1), i, far);
    }
    for (int i = 0; i < BODIES; i++) {
        char left[32] = "wall";
        if (i > 0) {
            snprintf(left, sizeof left, "B%d:1", i - 1);
        }
        n += snprintf(text + n, sizeof text - (size_t)n,
                      "contact %s B%d:1 -gap 0 -allow-overlap -law mahmoud-jankowski -k 1e11 "
                      "-e 0.5\n",
                      left, i);
    }
    snprintf(text + n, sizeof text - (size_t)n,
             "load B%d:1 constant -1e5\nload B%d:1 sine -amplitude 1e4 -frequency 10\n", BODIES - 1,
             BODIES - 1);
    struct error e = {0};
    struct analysis a = analysis_try(text, &e);
    assert_int_equal(e.status, STATUS_OK);
    return a;
}

// What rounding of the far floors' displacements could do to the contacts counts only below 1e-8 of
// their forces: it is no excuse for larger changes, as it does nothing here.
static void rounding_elsewhere_excuses_no_error_of_a_force(void **state) {
    (void)state;
    struct analysis near = pressed(0.0), far = pressed(1e6);
    double largest = 0.0, error = 0.0;
    for (long i = 0; i < near.rows.n * near.rows.n_link; i++) {
        largest = fmax(largest, near.rows.force[i]);
        error = fmax(error, fabs(far.rows.force[i] - near.rows.force[i]));
    }
    assert_true(largest > 1e5);
    assert_true(error < 1e-8 * largest);
    analysis_free(&near);
    analysis_free(&far);
}

// Two bodies of 1 kg, each pressed into a wall of its own by `deep`, in one step of 1 s. Solves for
// the forces of Hertz's law from these first guesses.
static void press(struct single_step *s, double k, double deep, const double *guess) {
    single_step_init(s, analysis_model("building A -floors 1 -mass 1 -stiffness 0\n"
                                       "building B -floors 1 -mass 1 -stiffness 0\n"
                                       "contact A wall -gap 1 -law hertz -k %.17g\n"
                                       "contact B wall -gap 1 -law hertz -k %.17g\n"
                                       "newton -tolerance 1e-9\nstep fixed 1\nduration 1\n",
                                       k, k));
    for (int i = 0; i < 2; i++) {
        s->now.u[i] = 1.0 + deep;
        s->now.delta[i] = deep;
        state_enliven(&s->now, i);
        s->now.link[i].closed = true;
        s->now.link[i].t_close = -1.0;
        s->now.link[i].force = guess[i];
    }
    single_step_take(s, 1.0);
    assert_int_equal(s->results.totals.unsolved, 0);
}

// Newton steps follow the tangent of a law where S_ll t <= 0.1. Here t = 3/2 k sqrt(d) / 4, S = 1,
// and d = 1 at the end of the step.
static void stiff_links_are_solved_for_exactly(void **state) {
    (void)state;
    const double share[] = {0.098, 0.102};
    for (int i = 0; i < 2; i++) {
        const double k = share[i] * 4.0 / 1.5, guess[] = {k, k};
        struct single_step s;
        press(&s, k, 1.0 + k / 4.0, guess);
        for (int j = 0; j < 2; j++) {
            assert_close(s.next.delta[j], 1.0, 1e-9);
            assert_true(s.work.link[j].stale == (i == 1));  // it has no tangent
        }
        single_step_free(&s);
    }
}

// Changes are measured against the largest force of the sweep before, which the first guess of A
// makes a hundred times too large. B's tangent is accurate enough for that, but not for the forces
// that are found: it leaves an error of 4e-10, and a tenth of the tolerance is allowed.
static void laws_are_evaluated_again_for_a_tighter_tolerance(void **state) {
    (void)state;
    const double k = 0.09 * 4.0 / 1.5, guess[] = {100.0 * k, k * (1.0 + 5e-4)};
    struct single_step s;
    press(&s, k, 1.0 + k / 4.0, guess);
    const double d = s.next.delta[1];
    assert_close(d, 1.0, 1e-3);
    assert_close(s.next.link[1].force, k * d * sqrt(d), 1e-10);
    single_step_free(&s);
}

// The force of one link with d = d_free - f / 4 and v = v_free - f / 2 (m = 1, h = 1).
static enum branch answer(const char *law, double d_free, double v_free, double *force) {
    struct model *m = analysis_model("building A -floors 1 -mass 1 -stiffness 0\n"
                                     "contact A wall -gap 1 -law %s\nstep fixed 1\nduration 1\n",
                                     law);
    double history[CONTACT_HISTORY_MAX] = {0.0};
    if (m->link[0].law->close) {
        m->link[0].law->close(m->link[0].constant, 1.0, history);
    }
    struct equation e = {.link = &m->link[0],
                         .history = history,
                         .d_free = d_free,
                         .v_free = v_free,
                         .d_force = 0.25,
                         .v_force = 0.5,
                         .closed = true};
    enum branch branch = exact_force(&e, 0.0, force);
    model_free(m);
    return branch;
}

// F = k d + c v with k = 1 and c = 2 zeta sqrt(k m) = 4.
static void
a_tension_at_no_penetration_holds_a_contact_and_one_that_grows_with_it_does_not(void **state) {
    (void)state;
    double force;
    const char *viscous = "kelvin-voigt -k 1 -zeta 2";
    assert_int_equal(answer(viscous, -0.01, -4.0, &force), BRANCH_CLOSED);
    assert_close(force, (-0.01 - 16.0) / (1.0 + 0.25 + 2.0), 1e-14);
    assert_int_equal(answer(viscous, -1.5, -0.1, &force), BRANCH_OPEN);
    assert_true(force == 0.0);
    assert_int_equal(answer("hertz-damp -k 1 -n 1 -zeta 10", -0.01, -4.0, &force), BRANCH_OPEN);
    assert_true(force == 0.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steps_are_cut_where_fewer_than_ten_make_a_contact),
        cmocka_unit_test(steps_are_cut_where_a_spring_has_stiffened),
        cmocka_unit_test(steps_are_cut_where_a_dashpot_would_stop_a_body),
        cmocka_unit_test(stiff_links_are_solved_for_exactly),
        cmocka_unit_test(laws_are_evaluated_again_for_a_tighter_tolerance),
        cmocka_unit_test(tangents_replace_a_law_only_where_they_are_accurate),
        cmocka_unit_test(rounding_elsewhere_excuses_no_error_of_a_force),
        cmocka_unit_test(
            a_tension_at_no_penetration_holds_a_contact_and_one_that_grows_with_it_does_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
