// SPDX-License-Identifier: GPL-3.0-or-later
// Response spectra against the shock spectra of A. K. Chopra, Dynamics of Structures, chapter 4,
// the printed values of chapter 6 for El Centro, and an integration of the equation of motion by
// another method.
#include <gsl/gsl_errno.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_odeiv2.h>
#include <gsl/gsl_poly.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "jostle/record.h"
#include "jostle/spectrum.h"
#include "support/random.h"
#include "support/support.h"

static const double G = 9.80665;

// Recurrences of thousands of steps.
static const double EXACT = 1e-11;

struct ground {
    struct arena *arena;
    struct signal signal;
};

static struct ground ground_of(const double *value, size_t n, double dt, double scale) {
    struct ground g = {.arena = arena_create()};
    struct error e;
    assert_non_null(g.arena);
    assert_int_equal(signal_init_samples(&g.signal, g.arena, value, n, dt, scale, 0.0, &e),
                     STATUS_OK);
    return g;
}

static struct spectrum_point point_of(const double *value, size_t n, double dt, double period,
                                      double zeta) {
    struct ground g = ground_of(value, n, dt, 1.0);
    struct spectrum_point p = spectrum_at(&g.signal, period, zeta);
    arena_free(g.arena);
    return p;
}

static struct ground el_centro(void) {
    struct ground g = {.arena = arena_create()};
    assert_non_null(g.arena);
    struct record r;
    struct error e;
    const struct record_request request = {.path = "input/records/ELCENTRO_1940_NS.AT2",
                                           .gravity = G};
    assert_int_equal(record_read(g.arena, &request, &r, &e), STATUS_OK);
    // The first value of the file is at 0.02 s in the book, after a zero.
    double *value = arena_alloc(g.arena, r.n + 1, sizeof *value);
    assert_non_null(value);
    memcpy(value + 1, r.value, r.n * sizeof *value);
    assert_int_equal(signal_init_samples(&g.signal, g.arena, value, r.n + 1, r.dt, r.unit, 0.0, &e),
                     STATUS_OK);
    return g;
}

// 10 s of constant acceleration, a whole number of periods, so that an undamped oscillator is at
// rest at the end. Section 4.3.
static void a_step_doubles_the_static_response(void **state) {
    (void)state;
    enum { N = 501 };
    double value[N];
    for (int j = 0; j < N; j++) {
        value[j] = 3.0;
    }
    static const double zetas[] = {0.0, 0.05, 0.3, 0.9};
    for (int k = 0; k < 4; k++) {
        for (double period = 0.005; period < 6.0; period *= 10.0) {
            const double zeta = zetas[k], omega = 2.0 * M_PI / period;
            const struct spectrum_point p = point_of(value, N, 0.02, period, zeta);
            const double factor = 1.0 + exp(-zeta * M_PI / sqrt(1.0 - zeta * zeta));
            assert_close(p.value[SPECTRUM_SD], 3.0 / (omega * omega) * factor, EXACT);
            assert_close(p.value[SPECTRUM_PSV], 3.0 / omega * factor, EXACT);
            assert_close(p.value[SPECTRUM_PSA], 3.0 * factor, EXACT);
        }
    }
    const struct spectrum_point p = point_of(value, N, 0.02, 0.5, 0.0);
    assert_close(p.value[SPECTRUM_SV], 3.0 / (2.0 * M_PI / 0.5), EXACT);
    assert_close(p.value[SPECTRUM_SA], 6.0, EXACT);
}

// Two samples only: the peak comes behind the record. Section 4.7.
static void a_short_rectangular_pulse_peaks_in_free_vibration(void **state) {
    (void)state;
    for (double ratio = 0.001; ratio < 0.5; ratio *= 3.0) {
        const struct spectrum_point p =
            point_of((const double[]){1.0, 1.0}, 2, ratio * 0.8, 0.8, 0.0);
        assert_close(p.value[SPECTRUM_PSA], 2.0 * sin(M_PI * ratio), EXACT);
        assert_close(p.value[SPECTRUM_SA], 2.0 * sin(M_PI * ratio), EXACT);
    }
}

// One straight line up, then constant. Section 4.5.
static void a_ramp_overshoots_by_the_rise_time(void **state) {
    (void)state;
    double value[40];
    for (int j = 0; j < 40; j++) {
        value[j] = j > 0 ? 1.0 : 0.0;
    }
    static const double ratios[] = {0.1, 0.37, 0.9, 1.0, 2.6, 17.3};
    for (int k = 0; k < 6; k++) {
        const double x = M_PI * ratios[k];
        const struct spectrum_point p = point_of(value, 40, ratios[k] * 0.7, 0.7, 0.0);
        assert_close(p.value[SPECTRUM_PSA], 1.0 + fabs(sin(x)) / x, EXACT);
    }
}

// The pulse lasts t_d <= T / 2. Section 4.9.
static void a_short_triangular_pulse_peaks_in_free_vibration(void **state) {
    (void)state;
    static const double ratios[] = {0.001, 0.1, 0.4, 0.5};
    for (int k = 0; k < 4; k++) {
        const double x = M_PI * ratios[k] / 2.0;
        const struct spectrum_point p =
            point_of((const double[]){0.0, 1.0, 0.0}, 3, ratios[k] / 2.0, 1.0, 0.0);
        assert_close(p.value[SPECTRUM_PSA], 2.0 * sin(x) * sin(x) / x, EXACT);
    }
}

// Section 4.8: the peak is behind the pulse for t_d < T / 2, within it otherwise. 4000 straight
// lines are off the sine by (pi / 4000)^2 / 8 = 8e-8.
static void a_half_sine_pulse_has_its_shock_spectrum(void **state) {
    (void)state;
    enum { N = 4001 };
    double value[N];
    for (int j = 0; j < N; j++) {
        value[j] = sin(M_PI * j / (N - 1));
    }
    static const double ratios[] = {0.1, 0.25, 0.45, 0.8, 1.0, 1.4};
    for (int k = 0; k < 6; k++) {
        const double r = ratios[k], q = 1.0 / (2.0 * r);
        const double free_vibration = 2.0 * q * cos(M_PI * r) / (q * q - 1.0);
        const double angle = 2.0 * M_PI / (1.0 + 2.0 * r);
        const double forced = (sin(angle) - q * sin(angle / q)) / (1.0 - q * q);
        const struct spectrum_point p = point_of(value, N, r / (N - 1), 1.0, 0.0);
        assert_close(p.value[SPECTRUM_PSA], r < 0.5 ? free_vibration : forced, 2e-7);
    }
}

// Velocity and displacement of the ground end at zero; a soft oscillator stays where it is, so that
// what it sees is the ground's motion, up to (omega t)^2 = 2.5e-7.
static void a_soft_oscillator_sees_the_motion_of_the_ground(void **state) {
    (void)state;
    const double value[] = {0.0, 1.0, 0.0, -1.0, 0.0, -1.0, 0.0, 1.0, 0.0};
    struct ground g = ground_of(value, sizeof value / sizeof value[0], 0.01, 1.0);
    const struct spectrum_point p = spectrum_at(&g.signal, 1000.0, 0.0);
    assert_close(p.value[SPECTRUM_SD], g.signal.displacement[4], 3e-7);
    assert_close(p.value[SPECTRUM_SV], g.signal.velocity[2], 3e-7);
    arena_free(g.arena);
}

static void a_rigid_oscillator_sees_the_acceleration_of_the_ground(void **state) {
    (void)state;
    struct ground g = el_centro();
    const struct spectrum_point rigid = spectrum_at(&g.signal, 0.0, 0.05);
    assert_close(rigid.value[SPECTRUM_PSA], signal_peak(&g.signal), 1e-15);
    assert_close(rigid.value[SPECTRUM_SA], signal_peak(&g.signal), 1e-15);
    assert_true(rigid.value[SPECTRUM_SD] == 0.0 && rigid.value[SPECTRUM_SV] == 0.0);
    const struct spectrum_point stiff = spectrum_at(&g.signal, 1e-3, 0.5);
    assert_close(stiff.value[SPECTRUM_PSA], signal_peak(&g.signal), 1e-3);
    arena_free(g.arena);
}

// Figures 6.4.1 and 6.6.2: three digits of the largest value at the samples, which may miss the
// peak between them by a factor of cos(omega dt / 2).
static void el_centro_has_the_values_printed_by_chopra(void **state) {
    (void)state;
    static const struct {
        double period, displacement, acceleration;  // [s], [in], [g]
        double half_digit;                          // of the acceleration
    } printed[] = {
        {0.5, 2.67, 1.09, 0.005},
        {1.0, 5.97, 0.610, 0.0005},
        {2.0, 7.47, 0.191, 0.0005},
    };
    struct ground g = el_centro();
    for (int k = 0; k < 3; k++) {
        const struct spectrum_point p = spectrum_at(&g.signal, printed[k].period, 0.02);
        const double missed = cos(M_PI / printed[k].period * g.signal.dt);
        const double inches = p.value[SPECTRUM_SD] / 0.0254;
        const double accelerations = p.value[SPECTRUM_PSA] / G;
        assert_true(inches >= printed[k].displacement - 0.005);
        assert_true(inches * missed <= printed[k].displacement + 0.005);
        assert_true(accelerations >= printed[k].acceleration - printed[k].half_digit);
        assert_true(accelerations * missed <= printed[k].acceleration + printed[k].half_digit);
    }
    arena_free(g.arena);
}

// The equation of motion by a Runge-Kutta method.
struct equation {
    double omega, zeta, a, slope;  // ground acceleration a + slope t
};

static int rates(double t, const double y[], double rate[], void *context) {
    const struct equation *q = context;
    rate[0] = y[1];
    rate[1] = -2.0 * q->zeta * q->omega * y[1] - q->omega * q->omega * y[0] - q->a - q->slope * t;
    return GSL_SUCCESS;
}

// The largest |cubic| between two instants h apart with these values and slopes.
static double hermite_peak(double y0, double d0, double y1, double d1, double h) {
    const double b = h * d0, c = 3.0 * (y1 - y0) - h * (2.0 * d0 + d1);
    const double d = 2.0 * (y0 - y1) + h * (d0 + d1);
    double x[2] = {0.0, 0.0};
    double peak = fmax(fabs(y0), fabs(y1));
    const int n = gsl_poly_solve_quadratic(3.0 * d, 2.0 * c, b, &x[0], &x[1]);
    for (int i = 0; i < n; i++) {
        if (x[i] > 0.0 && x[i] < 1.0) {
            peak = fmax(peak, fabs(y0 + x[i] * (b + x[i] * (c + x[i] * d))));
        }
    }
    return peak;
}

// u, v and the total acceleration with their rates.
static void observe(const struct equation *q, double t, const double y[2], double value[3],
                    double rate[3]) {
    double f[2];
    rates(t, y, f, (void *)q);
    const double square = q->omega * q->omega, damping = 2.0 * q->zeta * q->omega;
    value[0] = y[0];
    value[1] = y[1];
    value[2] = square * y[0] + damping * y[1];
    rate[0] = f[0];
    rate[1] = f[1];
    rate[2] = square * f[0] + damping * f[1];
}

// Steps end at samples and are at most 1/150 of the period: the cubics between them are off by
// (omega h)^4 / 384 < 1e-8 in u and v.
static void integrate(const struct signal *s, double period, double zeta, double peak[3]) {
    struct equation q = {.omega = 2.0 * M_PI / period, .zeta = zeta};
    gsl_odeiv2_system system = {.function = rates, .dimension = 2, .params = &q};
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, 2);
    assert_non_null(step);
    const int n_inner = (int)ceil(150.0 * s->dt / period);
    const double h = s->dt / n_inner;
    const size_t n_after = (size_t)ceil(period / s->dt) + 1;
    double y[2] = {0.0, 0.0}, error[2];
    peak[0] = peak[1] = peak[2] = 0.0;
    for (size_t j = 0; j + 1 < s->n + n_after; j++) {
        q.a = j + 1 < s->n ? s->value[j] : 0.0;
        q.slope = j + 1 < s->n ? (s->value[j + 1] - s->value[j]) / s->dt : 0.0;
        for (int i = 0; i < n_inner; i++) {
            double value0[3], rate0[3], value1[3], rate1[3];
            observe(&q, i * h, y, value0, rate0);
            assert_int_equal(gsl_odeiv2_step_apply(step, i * h, h, y, error, NULL, NULL, &system),
                             GSL_SUCCESS);
            observe(&q, (i + 1) * h, y, value1, rate1);
            for (int k = 0; k < 3; k++) {
                peak[k] = fmax(peak[k], hermite_peak(value0[k], rate0[k], value1[k], rate1[k], h));
            }
        }
    }
    gsl_odeiv2_step_free(step);
}

static void spectra_agree_with_another_integration_to_1e_6(void **state) {
    (void)state;
    static const double periods[] = {0.03, 0.1, 0.333, 1.0, 3.0, 10.0};
    static const double zetas[] = {0.0, 0.05, 0.6};
    struct ground g = el_centro();
    for (int i = 0; i < 6; i++) {
        for (int k = 0; k < 3; k++) {
            const struct spectrum_point p = spectrum_at(&g.signal, periods[i], zetas[k]);
            double want[3];
            integrate(&g.signal, periods[i], zetas[k], want);
            assert_close(p.value[SPECTRUM_SD], want[0], 1e-6);
            assert_close(p.value[SPECTRUM_SV], want[1], 1e-6);
            assert_close(p.value[SPECTRUM_SA], want[2], 1e-6);
        }
    }
    arena_free(g.arena);
}

// The same straight lines in pieces of 1/16, in which little is left to find, and with rest behind
// them: so no peak is missed within long steps, nor behind the record.
static void samples_that_change_nothing_do_not_matter(void **state) {
    (void)state;
    enum { LINES = 6, PIECES = 16, REST = 4, N = (LINES + REST) * PIECES + 1 };
    static const double zetas[] = {0.1, 0.7};
    struct random random = {1940};
    for (int record = 0; record < 200; record++) {
        double coarse[LINES + 1] = {0.0}, fine[N] = {0.0};
        for (int i = 1; i < LINES; i++) {
            coarse[i] = random_uniform(&random, -1.0, 1.0);
        }
        for (int j = 0; j < LINES * PIECES; j++) {
            const double *line = &coarse[j / PIECES];
            fine[j] = line[0] + (double)(j % PIECES) / PIECES * (line[1] - line[0]);
        }
        for (double period = 0.3; period < 8.0; period *= 1.15) {
            for (int k = 0; k < 2; k++) {
                const struct spectrum_point p = point_of(coarse, LINES + 1, 1.0, period, zetas[k]);
                const struct spectrum_point q = point_of(fine, N, 1.0 / PIECES, period, zetas[k]);
                for (int i = 0; i < SPECTRUM_COUNT; i++) {
                    assert_close(p.value[i], q.value[i], EXACT);
                }
            }
        }
    }
}

// Records that are 3, 1, 5, 2 and 4 times the same.
static void statistics_are_those_of_the_values_in_order(void **state) {
    (void)state;
    static const double factor[] = {3.0, 1.0, 5.0, 2.0, 4.0};
    static const double want[SPECTRA_STATISTICS] = {3.0, 1.64, 3.0, 4.36};
    const double value[] = {0.0, 1.0, -1.0, 0.5};
    const double period[] = {0.0, 0.2}, damping[] = {0.02, 0.05, 0.2};
    struct ground g[5];
    struct signal signal[5];
    struct error e;
    for (int r = 0; r < 5; r++) {
        g[r] = ground_of(value, 4, 0.1, factor[r]);
        signal[r] = g[r].signal;
    }
    struct spectra s = {
        .n_record = 5, .n_damping = 3, .n_period = 2, .damping = damping, .period = period};
    assert_int_equal(spectra_compute(&s, signal, g[0].arena, &e), STATUS_OK);
    for (int d = 0; d < 3; d++) {
        const struct spectrum_point one = spectrum_at(&signal[1], 0.2, damping[d]);
        for (int q = 0; q < SPECTRUM_COUNT; q++) {
            for (int r = 0; r < 5; r++) {
                assert_close(spectra_at(&s, r, d, 1)->value[q], factor[r] * one.value[q], EXACT);
            }
            for (int k = 0; k < SPECTRA_STATISTICS; k++) {
                assert_close(spectra_at(&s, 5 + k, d, 1)->value[q], want[k] * one.value[q], EXACT);
            }
        }
        assert_close(spectra_at(&s, 5 + SPECTRA_P84, d, 0)->value[SPECTRUM_PSA], 4.36, EXACT);
    }
    for (int r = 0; r < 5; r++) {
        arena_free(g[r].arena);
    }
}

// Nothing else is done for one quantity than for all; the frequency may differ by rounding.
static void the_velocity_alone_is_that_of_the_whole_point(void **state) {
    (void)state;
    struct ground g = el_centro();
    static const double periods[] = {0.01, 0.05, 0.4, 3.0, 20.0};
    for (int i = 0; i < 5; i++) {
        double omega = 2.0 * M_PI / periods[i];
        assert_close(spectrum_velocity(&g.signal, omega, 0.05),
                     spectrum_at(&g.signal, 2.0 * M_PI / omega, 0.05).value[SPECTRUM_SV], 1e-14);
    }
    arena_free(g.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_step_doubles_the_static_response),
        cmocka_unit_test(a_short_rectangular_pulse_peaks_in_free_vibration),
        cmocka_unit_test(a_ramp_overshoots_by_the_rise_time),
        cmocka_unit_test(a_short_triangular_pulse_peaks_in_free_vibration),
        cmocka_unit_test(a_half_sine_pulse_has_its_shock_spectrum),
        cmocka_unit_test(a_soft_oscillator_sees_the_motion_of_the_ground),
        cmocka_unit_test(a_rigid_oscillator_sees_the_acceleration_of_the_ground),
        cmocka_unit_test(el_centro_has_the_values_printed_by_chopra),
        cmocka_unit_test(spectra_agree_with_another_integration_to_1e_6),
        cmocka_unit_test(the_velocity_alone_is_that_of_the_whole_point),
        cmocka_unit_test(samples_that_change_nothing_do_not_matter),
        cmocka_unit_test(statistics_are_those_of_the_values_in_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
