// SPDX-License-Identifier: GPL-3.0-or-later
// Isolated impacts of two free bodies against closed forms: 25 t at 0.5 m/s meet 40 t at rest after
// 10 mm, at t = 0.02 s. The closed forms are derived in docs/theory.md.
#include <math.h>
#include <string.h>

#include "support/analysis.h"
#include "support/support.h"

static const double PI = 3.141592653589793;
static const double V0 = 0.5;
static const double M1 = 25e3, M2 = 40e3;
static const double MASS = 15384.615384615385;  // m1 m2 / (m1 + m2)

static struct analysis impact(const char *law, double dt) {
    return analysis_of("building A -floors 1 -mass 25t -stiffness 0\n"
                       "building B -floors 1 -mass 40t -stiffness 0\n"
                       "initial A:1 -velocity 0.5\n"
                       "contact A B -gap 10mm -law %s\n"
                       "duration 0.08\nstep fixed %.17g\noutput -every 1\n",
                       law, dt);
}

static double restitution(const struct analysis *a) {
    assert_int_equal(a->results->n_impact, 1);
    return a->results->impact[0].v_rebound / a->results->impact[0].v_approach;
}

// k d: half a period of an oscillator.
static void a_linear_spring_gives_half_a_period(void **state) {
    (void)state;
    double k = 93.5e6;
    struct analysis a = impact("linear -k 93.5e6", 1e-5);
    const struct impact *i = &a.results->impact[0];
    assert_near(i->t_start, 0.02, 1e-12);
    assert_close(i->v_approach, V0, 1e-12);
    assert_close(i->t_end - i->t_start, PI * sqrt(MASS / k), 1e-6);
    assert_close(i->max_penetration, V0 * sqrt(MASS / k), 1e-6);
    assert_close(i->peak_force, V0 * sqrt(k * MASS), 1e-6);
    assert_close(i->impulse, 2.0 * MASS * V0, 1e-6);
    assert_near(i->dissipated, 0.0, 1e-6 * MASS * V0 * V0);
    assert_close(restitution(&a), 1.0, 1e-6);
    assert_true(i->complete);
    assert_near((double)i->steps, (i->t_end - i->t_start) / 1e-5, 1.0);
    analysis_free(&a);
}

// k d^1.5: d_max = (5 m v0^2 / 4k)^(2/5), duration 2.943275 d_max / v0.
static void hertz_gives_its_closed_form(void **state) {
    (void)state;
    double k = 2.75e9;
    struct analysis a = impact("hertz -k 2.75e9", 1e-5);
    const struct impact *i = &a.results->impact[0];
    double depth = pow(1.25 * MASS * V0 * V0 / k, 0.4);
    assert_close(i->max_penetration, depth, 1e-6);
    assert_close(i->peak_force, pow(k, 0.4) * pow(1.25 * MASS * V0 * V0, 0.6), 1e-6);
    assert_close(i->t_end - i->t_start, 2.943275 * depth / V0, 1e-5);
    assert_close(restitution(&a), 1.0, 1e-5);
    analysis_free(&a);
}

// The dashpot delivers e exactly where its tension is kept; 20 steps of 2 ms resolve this contact.
static void kelvin_voigt_delivers_the_restitution_asked_for(void **state) {
    (void)state;
    const double e[] = {0.1, 0.4, 0.65, 0.9, 1.0};
    for (size_t q = 0; q < sizeof e / sizeof e[0]; q++) {
        char law[64];
        snprintf(law, sizeof law, "kelvin-voigt -k 93.5e6 -e %g", e[q]);
        struct analysis a = impact(law, 4e-4);  // 100 steps in contact
        assert_near(restitution(&a), e[q], 1e-3);
        double loss = MASS * V0 * V0 * (1.0 - e[q] * e[q]) / 2.0;
        assert_near(a.results->impact[0].dissipated, loss, 2e-3 * MASS * V0 * V0 / 2.0);
        analysis_free(&a);
    }
}

// Restitutions that the published relations deliver: solutions of each law's equation of motion to
// ten digits by an independent program.
static void published_relations_deliver_what_they_deliver(void **state) {
    (void)state;
    const struct {
        const char *law;
        double delivered;
    } known[] = {
        {"komodromos -k 93.5e6 -e 0.4", 0.4720}, {"komodromos -k 93.5e6 -e 0.65", 0.6748},
        {"hertz-damp -k 2.75e9 -e 0.4", 0.7016}, {"hertz-damp -k 2.75e9 -e 0.65", 0.7748},
        {"hertz-damp -k 2.75e9 -e 0.9", 0.9132}, {"jankowski -k 2.75e9 -e 0.4", 0.3930},
        {"jankowski -k 2.75e9 -e 0.65", 0.6470}, {"jankowski -k 2.75e9 -e 0.9", 0.8997},
    };
    for (size_t q = 0; q < sizeof known / sizeof known[0]; q++) {
        struct analysis a = impact(known[q].law, 1e-5);
        assert_near(restitution(&a), known[q].delivered, 1e-4);
        analysis_free(&a);
    }
}

static void momentum_is_kept_to_rounding(void **state) {
    (void)state;
    const char *const law[] = {
        "linear -k 93.5e6", "kelvin-voigt -k 93.5e6 -e 0.3", "komodromos -k 93.5e6 -e 0.3",
        "hertz -k 2.75e9",  "hertz-damp -k 2.75e9 -e 0.3",   "jankowski -k 2.75e9 -e 0.3"};
    for (size_t q = 0; q < sizeof law / sizeof law[0]; q++) {
        struct analysis a = impact(law[q], 1e-4);
        for (long i = 0; i < a.rows.n; i++) {
            const double *v = a.rows.velocity + 2 * i;
            assert_close(M1 * v[0] + M2 * v[1], M1 * V0, 1e-13);
        }
        analysis_free(&a);
    }
}

// The account of energy closes to rounding at any step, also one that does not resolve the contact.
static void energy_closes_at_every_step_size(void **state) {
    (void)state;
    const char *const law[] = {
        "linear -k 93.5e6", "kelvin-voigt -k 93.5e6 -e 0.3", "komodromos -k 93.5e6 -e 0.3",
        "hertz -k 2.75e9",  "hertz-damp -k 2.75e9 -e 0.3",   "jankowski -k 2.75e9 -e 0.3"};
    const double step[] = {1e-5, 1e-3, 1e-2, 4e-2};
    for (size_t q = 0; q < sizeof law / sizeof law[0]; q++) {
        for (size_t s = 0; s < sizeof step / sizeof step[0]; s++) {
            struct analysis a = impact(law[q], step[s]);
            assert_true(a.results->residual_peak < 1e-11 * M1 * V0 * V0 / 2.0);
            analysis_free(&a);
        }
    }
}

// Two bodies pressed together at rest by equal forces, gap 0: no impact velocity, no blow-up.
static void bodies_pressed_together_from_rest_come_to_rest(void **state) {
    (void)state;
    struct analysis a = analysis_of("building A -floors 1 -mass 25t -stiffness 0\n"
                                    "building B -floors 1 -mass 25t -stiffness 0\n"
                                    "load A:1 constant 10kN\nload B:1 constant -10kN\n"
                                    "contact A B -gap 0 -law hertz-damp -k 2.75e9 -e 0.5\n"
                                    "duration 2\nstep fixed 1e-4\n");
    long last = a.rows.n - 1;
    // After 2 s the damping of the law has left nothing but rounding of their swing.
    assert_close(a.rows.force[last], 10e3, 1e-9);
    assert_close(a.rows.penetration[last], pow(10e3 / 2.75e9, 2.0 / 3.0), 1e-9);
    analysis_free(&a);
}

// In a row of equal elastic bodies the first one's velocity is handed through to the last.
static void a_row_of_equal_bodies_hands_an_impact_through(void **state) {
    (void)state;
    struct analysis a = analysis_of(
        "building A -floors 1 -mass 1 -stiffness 0\nbuilding B -floors 1 -mass 1 -stiffness 0\n"
        "building C -floors 1 -mass 1 -stiffness 0\ninitial A:1 -velocity 1\n"
        "contact A B -gap 0.1 -law linear -k 1e6\ncontact B C -gap 0.1 -law linear -k 1e6\n"
        "duration 0.5\nstep fixed 1e-5\n");
    const double *v = a.rows.velocity + 3 * (a.rows.n - 1);
    assert_near(v[0], 0.0, 1e-4);
    assert_near(v[1], 0.0, 1e-4);
    assert_near(v[2], 1.0, 1e-4);
    analysis_free(&a);
}

static void a_wall_stands_on_either_side(void **state) {
    (void)state;
    struct analysis a = analysis_of(
        "building A -floors 1 -mass 2 -stiffness 0\ninitial A:1 -velocity 1\n"
        "contact A wall -gap 0.1 -law linear -k 1e5\ncontact wall A -gap 0.2 -law linear -k 1e5\n"
        "duration 1\nstep fixed 1e-5\n");
    const struct results *r = a.results;
    double contact = PI * sqrt(2.0 / 1e5);
    assert_int_equal(r->n_impact, 3);
    assert_near(r->impact[0].t_start, 0.1, 1e-9);
    assert_near(r->impact[1].t_start, 0.1 + contact + 0.3, 1e-6);
    assert_near(r->impact[2].t_start, 0.1 + 2.0 * contact + 0.6, 2e-6);
    assert_int_equal(r->impact[1].contact, 1);
    assert_close(r->link[0].force, sqrt(2e5), 1e-5);
    analysis_free(&a);
}

static struct analysis roof_at_a_wall(double gap, int every) {
    return analysis_of("building A -floors 20 -mass 1 -stiffness 1e4\n"
                       "contact A:20 wall -gap %.17g -law stereomechanical -e 0\n"
                       "ground sine -amplitude -3 -frequency 0.5\n"
                       "duration 0.21\nstep fixed 1ms\noutput -every %d\n",
                       gap, every);
}

// A roof meets a wall just where it is at the end of step 200, at the velocity that it has there,
// the largest so far, as it still gets faster. The next step finds that, at its beginning, and the
// roof stops: the account of the step before must not be lost over that.
static void the_velocity_just_before_an_impact_at_the_end_of_a_step_is_a_peak(void **state) {
    (void)state;
    struct analysis apart = roof_at_a_wall(1.0, 1);
    const long at = 20 * analysis_row(&apart, 0.2) + 19;
    const double gap = apart.rows.displacement[at];
    const double velocity = apart.rows.velocity[at];
    analysis_free(&apart);
    struct analysis a = roof_at_a_wall(gap, 1000);  // rows settle accounts too
    assert_int_equal(a.results->totals.events, 1);
    assert_near(a.results->impact[0].t_start, 0.2, 1e-15);
    assert_near(a.rows.velocity[20 * (a.rows.n - 1) + 19], 0.0, 1e-15);
    assert_true(a.results->peak[PEAK_VELOCITY][19] == velocity);
    assert_near(a.results->peak_time[PEAK_VELOCITY][19], 0.2, 1e-15);
    analysis_free(&a);
}

// A is slow at a dashpot when C strikes it: its velocity, and with that the force, jumps to the
// largest value within the contact.
static void the_peak_of_an_impact_is_that_of_a_force_which_jumps_within_it(void **state) {
    (void)state;
    static const char *const step[] = {"step fixed 0.1ms", "integrator newmark\nstep adaptive",
                                       "step adaptive"};
    const double dashpot = 2.0 * sqrt(1e6 * 1000.0);
    for (size_t i = 0; i < sizeof step / sizeof step[0]; i++) {
        struct analysis a = analysis_of(
            "building C -floors 1 -mass 1000 -stiffness 0\ninitial C -velocity 2\n"
            "building A -floors 1 -mass 1000 -stiffness 0\ninitial A -velocity 0.1\n"
            "contact C A -gap 30mm -law stereomechanical -e 1\n"
            "contact A wall -gap 1mm -law kelvin-voigt -k 1e6 -zeta 1\nduration 0.05\n%s\n",
            step[i]);
        const struct results *r = a.results;
        assert_int_equal(r->n_impact, 2);
        assert_int_equal(r->impact[0].contact, 1);
        assert_close(r->impact[0].peak_force, 2.0 * dashpot, 0.01);  // and some of the spring
        assert_true(r->impact[0].peak_force == r->link[1].force);
        assert_close(r->link[1].force_time, r->impact[1].t_start, 1e-12);
        analysis_free(&a);
    }
}

// The force at closure is the largest. The instant is located to 1e-5 of a step, where the spring
// may have some force or none.
static void a_peak_at_closure_is_the_same_in_the_impact_and_in_the_envelope(void **state) {
    (void)state;
    for (int i = 0; i < 8; i++) {
        struct analysis a =
            analysis_of("building A -floors 1 -mass 1000 -stiffness 1e6\n"
                        "damping A rayleigh 5%%\nduration 2\nstep adaptive\n"
                        "ground sine -amplitude 3 -frequency 4 -phase %d\n"
                        "contact A wall -gap 1mm -law kelvin-voigt -k 1e8 -zeta 1\n",
                        i);
        const struct results *r = a.results;
        double largest = 0.0;
        assert_true(r->n_impact > 0);
        for (long n = 0; n < r->n_impact; n++) {
            largest = fmax(largest, r->impact[n].peak_force);
        }
        assert_true(largest == r->link[0].force);
        analysis_free(&a);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_linear_spring_gives_half_a_period),
        cmocka_unit_test(hertz_gives_its_closed_form),
        cmocka_unit_test(kelvin_voigt_delivers_the_restitution_asked_for),
        cmocka_unit_test(published_relations_deliver_what_they_deliver),
        cmocka_unit_test(momentum_is_kept_to_rounding),
        cmocka_unit_test(energy_closes_at_every_step_size),
        cmocka_unit_test(bodies_pressed_together_from_rest_come_to_rest),
        cmocka_unit_test(a_row_of_equal_bodies_hands_an_impact_through),
        cmocka_unit_test(a_wall_stands_on_either_side),
        cmocka_unit_test(the_velocity_just_before_an_impact_at_the_end_of_a_step_is_a_peak),
        cmocka_unit_test(the_peak_of_an_impact_is_that_of_a_force_which_jumps_within_it),
        cmocka_unit_test(a_peak_at_closure_is_the_same_in_the_impact_and_in_the_envelope),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
