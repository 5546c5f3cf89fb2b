// SPDX-License-Identifier: GPL-3.0-or-later
// Adaptive steps of the method of Dormand & Prince where the force of a contact is not smooth
// between its closure and its opening, or where it opens: restitution against closed forms.
#include <gsl/gsl_math.h>
#include <math.h>

#include "support/analysis.h"
#include "support/support.h"

// One impact of 25 t on 40 t, with a tolerance of 1e-8.
static struct analysis impact(const char *law, double velocity) {
    return analysis_of("building A -floors 1 -mass 25t -stiffness 0\n"
                       "building B -floors 1 -mass 40t -stiffness 0\n"
                       "initial A:1 -velocity %.17g\ncontact A B -gap 1mm -law %s\n"
                       "step adaptive -tolerance 1e-8\nduration 0.3\n",
                       velocity, law);
}

// Its restitution.
static double restitution(const char *law, double velocity) {
    struct analysis a = impact(law, velocity);
    assert_int_equal(a.results->n_impact, 1);
    assert_true(a.results->impact[0].complete);
    double e = a.results->impact[0].v_rebound / a.results->impact[0].v_approach;
    analysis_free(&a);
    return e;
}

static const double reduced = 25e3 * 40e3 / 65e3;

// Energy before less (k1 - k2) dy (d_max - dy), and d_max = dy + x from the energy.
static double of_bilinear(double k1, double k2, double dy, double velocity) {
    double energy = reduced * velocity * velocity / 2.0;
    double beyond = energy - k1 * dy * dy / 2.0;
    double x = (sqrt(k1 * dy * k1 * dy + 2.0 * k2 * beyond) - k1 * dy) / k2;
    return sqrt(1.0 - (k1 - k2) * dy * x / energy);
}

static double of_komodromos(double e) {
    double zeta = -log(e) / hypot(M_PI, log(e));
    double s = sqrt(1.0 - zeta * zeta);
    return exp(-(zeta / s) * atan2(2.0 * zeta * s, 2.0 * zeta * zeta - 1.0));
}

// Of the curve of input/pad.txt up to its last point, with the velocity that leads there: L and
// s = U / L are linear between the points.
static double of_pad(double *velocity) {
    static const double L[] = {0, 14e3, 32e3, 56e3, 90e3, 140e3, 220e3, 360e3};
    static const double U[] = {0, 7e3, 17e3, 33e3, 58e3, 100e3, 180e3, 360e3};
    double in = 0.0;
    double out = 0.0;
    double s0 = U[1] / L[1];
    for (int i = 1; i < 8; i++) {
        double s1 = U[i] / L[i];
        in += 2e-3 * (L[i - 1] + L[i]) / 2.0;
        out += 2e-3 * (L[i - 1] * s0 + (L[i - 1] + L[i]) * (s0 + s1) + L[i] * s1) / 6.0;
        s0 = s1;
    }
    *velocity = sqrt(2.0 * in / reduced);
    return sqrt(out / in);
}

// Steps end at the kinks of forces between closure and opening, so those laws are followed as
// accurately as smooth ones: to less than 20 times the tolerance. Across a kink, errors would be 30
// to 800 times the tolerance. (Those of the estimate itself are up to 7 times the tolerance.)
static void impacts_with_kinks_are_as_accurate_as_others(void **state) {
    (void)state;
    static const double allowed = 20.0 * 1e-8;
    for (int i = 0; i < 8; i++) {
        double v = 0.1 + 0.11 * i;
        assert_close(restitution("komodromos -k 93.5MN/m -e 0.65", v), of_komodromos(0.65),
                     allowed);
        assert_close(restitution("bilinear -k1 560MN/m -k2 60MN/m -dy 0.2mm", v),
                     of_bilinear(560e6, 60e6, 0.2e-3, v), allowed);
        assert_close(restitution("wang -k 2.75e9N/m^1.5 -e 0.6 -residual 0.25", v), 0.6, allowed);
        assert_close(restitution("rubber -k 2e9N/m^2 -n 2 -e 0.5 -du 4mm", v), 0.5, allowed);
    }
    double v;
    double e = of_pad(&v);
    assert_close(restitution("table -file input/pad.txt", v), e, allowed);
}

// The end of this contact, where the force has an infinite second slope, must not be hidden by what
// the step did beyond: this velocity lost 93 times the tolerance there.
static void a_step_that_ends_at_an_event_meets_the_tolerance(void **state) {
    (void)state;
    for (int i = 0; i < 20; i++) {
        double v = 0.05 + 0.05 * i;
        assert_close(restitution("hertz -k 2.75e9N/m^1.5", v), 1.0, 4e-8);
    }
}

// Closure, turn and opening, and the kinks between them; a step that ended before a kink would come
// to it again, and one at d = 0 is none of them.
static void a_kink_is_one_event(void **state) {
    (void)state;
    static const struct {
        const char *law;
        long events;
    } of[] = {
        {"komodromos -k 93.5MN/m -e 0.65", 4},
        {"bilinear -k1 560MN/m -k2 60MN/m -dy 0.2mm", 5},
        {"bilinear -k1 560MN/m -k2 60MN/m -dy 20mm", 3},
        {"wang -k 2.75e9N/m^1.5 -e 0.6 -residual 0.25", 4},
        {"wang -k 2.75e9N/m^1.5 -e 0.6 -residual 0", 3},
    };
    for (size_t k = 0; k < sizeof of / sizeof of[0]; k++) {
        for (int i = 0; i < 8; i++) {
            struct analysis a = impact(of[k].law, 0.1 + 0.11 * i);
            assert_int_equal(a.results->totals.events, of[k].events);
            analysis_free(&a);
        }
    }
}

// The clock moves by 1e-13 s at a time at t = 1000 s, in which these bodies go further than what is
// rounding of their places: a kink so near the start of a step takes no time. The impacts are those
// of the same motion from t = 0.
static void kinks_are_passed_however_late_they_come(void **state) {
    (void)state;
    static const char *const law[] = {"table -file input/pad.txt", "komodromos -k 100MN/m -e 0.6",
                                      "rubber -k 1e8N/m^2 -n 2 -e 0.9 -du 10mm",
                                      "bilinear -k1 100MN/m -k2 10MN/m -dy 1mm"};
    static const double delay[] = {0.0, 100.0, 1000.0};
    for (int i = 0; i < 4; i++) {
        long impacts = 0;
        for (int j = 0; j < 3; j++) {
            struct analysis a = analysis_of("building A -floors 1 -mass 100t -stiffness 10MN/m\n"
                                            "contact A wall -gap 3mm -law %s\n"
                                            "ground sine -amplitude 5 -frequency 1.6 -delay %.17g\n"
                                            "step adaptive -tolerance 1e-6\nduration %.17g\n",
                                            law[i], delay[j], delay[j] + 6.0);
            impacts = j == 0 ? a.results->n_impact : impacts;
            assert_true(impacts > 5);
            assert_int_equal(a.results->n_impact, impacts);
            analysis_free(&a);
        }
    }
}

static struct analysis with_damper(double exponent, double tolerance) {
    return analysis_of(
        "building A -floors 3 -mass 2e5 -stiffness 2.7e8\n"
        "building B -floors 3 -mass 2e5 -stiffness 1.8e8\n"
        "link A:3 B:3 -dashpot 2e5 -exponent %g\n"
        "ground sine -amplitude 3 -frequency 1.3\ninitial A:3 -velocity 1\nduration 3\n"
        "integrator dormand-prince\nstep adaptive -tolerance %g\n",
        exponent, tolerance);
}

// The force of a damper with an exponent below 1 has an infinite slope at v = 0, where steps end.
// Across it, errors of velocities were 500 to 800 times the tolerance; with a linear damper they
// are 60 times.
static void dampers_of_any_exponent_are_as_accurate_as_linear_ones(void **state) {
    (void)state;
    static const double exponent[] = {0.4, 0.5, 0.6, 1.0};
    static const double tolerance = 1e-8;
    for (int i = 0; i < 4; i++) {
        struct analysis a = with_damper(exponent[i], tolerance);
        struct analysis b = with_damper(exponent[i], tolerance / 1e3);
        double error = 0.0;
        double largest = 0.0;
        for (long j = 0; j < 6 * b.rows.n; j++) {
            error = fmax(error, fabs(a.rows.velocity[j] - b.rows.velocity[j]));
            largest = fmax(largest, fabs(b.rows.velocity[j]));
        }
        assert_true(error < 100.0 * tolerance * largest);
        analysis_free(&a);
        analysis_free(&b);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(impacts_with_kinks_are_as_accurate_as_others),
        cmocka_unit_test(a_kink_is_one_event),
        cmocka_unit_test(a_step_that_ends_at_an_event_meets_the_tolerance),
        cmocka_unit_test(kinks_are_passed_however_late_they_come),
        cmocka_unit_test(dampers_of_any_exponent_are_as_accurate_as_linear_ones),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
