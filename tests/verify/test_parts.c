// SPDX-License-Identifier: GPL-3.0-or-later
// The interface of parts (jostle/part.h), with made-up ones: a spring that softens until its
// tangent is negative, a dashpot of the squared velocity, and a slider. And buildings of a matrix
// whose storeys yield.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "jostle/part.h"
#include "model/parts.h"
#include "support/analysis.h"
#include "support/support.h"

enum { STOREYS = 2 };

// All of them act on x = d_1 + 0.6 d_2.
static const double share[STOREYS] = {1.0, 0.6};

static double along(const double *x) {
    return share[0] * x[0] + share[1] * x[1];
}

static void add(const struct part_sums *to, double force, double by_x, double by_rate) {
    for (int i = 0; i < STOREYS; i++) {
        if (to->shear) {
            to->shear[i] += share[i] * force;
        }
        for (int j = 0; j < STOREYS; j++) {
            if (to->by_drift) {
                to->by_drift[i * STOREYS + j] += share[i] * by_x * share[j];
            }
            if (to->by_rate) {
                to->by_rate[i * STOREYS + j] += share[i] * by_rate * share[j];
            }
        }
    }
}

// F = k x / (1 + x^2 / D^2)^2, whose tangent is negative beyond D / sqrt(3), down to -k / 4.
static const double K = 60e6, D = 0.02;

static void soften(const struct part *p, const double *history, const double *drift,
                   const double *rate, const struct part_sums *to, double *after) {
    const double x = along(drift), square = x * x / (D * D);
    (void)p, (void)history, (void)rate, (void)after;
    add(to, K * x / pow(1 + square, 2), K * (1 - 3 * square) / pow(1 + square, 3), 0);
}

static double stored_soft(const struct part *p, const double *history, const double *drift) {
    const double x = along(drift);
    (void)p, (void)history;
    return K * x * x / 2 / (1 + x * x / (D * D));
}

static const struct part_kind softening = {
    .name = "softening", .respond = soften, .stored = stored_soft};

// F = c |x'| x'.
static const double C = 2e6;

static void damp(const struct part *p, const double *history, const double *drift,
                 const double *rate, const struct part_sums *to, double *after) {
    const double v = along(rate);
    (void)p, (void)history, (void)drift, (void)after;
    add(to, C * fabs(v) * v, 0, 2 * C * fabs(v));
}

static double stored_none(const struct part *p, const double *history, const double *drift) {
    (void)p, (void)history, (void)drift;
    return 0;
}

static const struct part_kind dashpot = {.name = "dashpot", .respond = damp, .stored = stored_none};

// A slider of the storey that `data` names: elastic with K_SLIDE up to the force LIMIT. Its history
// is how far it has slid.
static const double K_SLIDE = 40e6, LIMIT = 120e3;

static double slid(const double *history, double x) {
    const double most = LIMIT / K_SLIDE;
    return fmin(fmax(*history, x - most), x + most);
}

static void slide(const struct part *p, const double *history, const double *drift,
                  const double *rate, const struct part_sums *to, double *after) {
    const int i = *(const int *)p->data;
    const double to_x = drift[i], rest = slid(history, to_x);
    (void)rate;
    if (to->shear) {
        to->shear[i] += K_SLIDE * (to_x - rest);
    }
    if (to->by_drift) {
        to->by_drift[i * STOREYS + i] += rest == *history ? K_SLIDE : 0;
    }
    if (after) {
        *after = rest;
    }
}

static double stored_slider(const struct part *p, const double *history, const double *drift) {
    const double x = drift[*(const int *)p->data];
    return K_SLIDE * pow(x - slid(history, x), 2) / 2;
}

static const struct part_kind slider = {
    .name = "slider", .respond = slide, .stored = stored_slider};

// Puts the parts in place of the matrix of the first building of the model.
static void put(struct model *m, struct part *part, int n, double *tangents) {
    struct building *g = (struct building *)&m->building[0];
    static const double zero[8] = {0};
    const struct part_sums sums = {.by_drift = tangents,
                                   .by_rate = tangents + (size_t)STOREYS * STOREYS};
    assert_int_equal(g->n_dof, STOREYS);
    memset(tangents, 0, (size_t)2 * STOREYS * STOREYS * sizeof *tangents);
    for (int i = 0; i < n; i++) {
        part[i].n = STOREYS;
        part[i].history = m->n_storey_history;
        m->n_storey_history += part[i].n_history;
        part[i].kind->respond(&part[i], zero, zero, zero, &sums, NULL);
    }
    g->part = part;
    g->n_part = n;
    g->part_stiffness = sums.by_drift;
    g->part_dashpot = sums.by_rate;
    g->elastic = m->elastic = false;
}

#define SIDES "-mass 50t -stiffness 20e6 15e6\n"
#define BUILDING "building A -floors 2 " SIDES "matrix A %s\n"

static struct model *model_with(struct part *part, int n, double *tangents, const char *rest) {
    const char *file = support_write("one.txt", "1 0\n0 1\n");
    struct model *m = analysis_model(BUILDING "%s", file, rest);
    put(m, part, n, tangents);
    return m;
}

static struct results *run(const struct model *m) {
    struct error e = {0};
    struct results *out = NULL;
    if (analysis_run(m, NULL, &out, &e) != STATUS_OK) {
        fail_msg("%s", e.message);
    }
    return out;
}

// Accelerations of the two floors with the softening spring and the dashpot.
static void accelerate(const double *u, const double *v, double *a) {
    const double drift[] = {u[0], u[1] - u[0]}, rate[] = {v[0], v[1] - v[0]};
    double shear[] = {20e6 * drift[0], 15e6 * drift[1]};
    const struct part_sums sums = {.shear = shear};
    soften(NULL, NULL, drift, rate, &sums, NULL);
    damp(NULL, NULL, drift, rate, &sums, NULL);
    a[0] = (shear[1] - shear[0]) / 50e3;
    a[1] = -shear[1] / 50e3;
}

// Peaks of the free vibration from velocities `v` by the classical method of Runge and Kutta.
static void integrate(double v1, double v2, double duration, double peak[STOREYS]) {
    enum { STEPS = 200000 };
    const double h = duration / STEPS;
    double x[2 * STOREYS] = {0, 0, v1, v2};
    peak[0] = peak[1] = 0;
    for (int n = 0; n < STEPS; n++) {
        double k[4][2 * STOREYS], y[2 * STOREYS];
        static const double at[] = {0, 0.5, 0.5, 1};
        for (int s = 0; s < 4; s++) {
            for (int i = 0; i < 2 * STOREYS; i++) {
                y[i] = x[i] + (s > 0 ? h * at[s] * k[s - 1][i] : 0);
            }
            k[s][0] = y[2];
            k[s][1] = y[3];
            accelerate(y, y + 2, k[s] + 2);
        }
        for (int i = 0; i < 2 * STOREYS; i++) {
            x[i] += h / 6 * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]);
        }
        peak[0] = fmax(peak[0], fabs(x[0]));
        peak[1] = fmax(peak[1], fabs(x[1] - x[0]));
    }
}

#define PUSHED "initial A:1 -velocity 1\ninitial A:2 -velocity 1.6\nduration 3\n"

static void parts_of_any_shape_are_followed_by_all_methods(void **state) {
    (void)state;
    static const struct {
        const char *method;
        double rtol;
    } by[] = {
        {"step fixed 0.1ms\n", 2e-5},
        {"integrator newmark\nstep adaptive -tolerance 1e-9\n", 2e-5},
        {"integrator dormand-prince\nstep adaptive -tolerance 1e-10\n", 1e-8},
    };
    double want[STOREYS], tangents[2 * STOREYS * STOREYS];
    integrate(1, 1.6, 3, want);
    assert_true(want[0] + 0.6 * want[1] > 0.8 * D);  // the tangent was negative
    for (size_t i = 0; i < sizeof by / sizeof by[0]; i++) {
        struct part part[] = {{.kind = &softening}, {.kind = &dashpot}};
        char rest[256];
        snprintf(rest, sizeof rest, PUSHED "%s", by[i].method);
        struct model *m = model_with(part, 2, tangents, rest);
        struct results *r = run(m);
        for (int k = 0; k < STOREYS; k++) {
            assert_close(r->peak[PEAK_DRIFT][k], want[k], by[i].rtol);
        }
        if (i == 0) {
            assert_true(r->residual_peak < 1e-12 * r->initial_energy);
        }
        assert_int_equal(r->totals.unsolved, 0);
        results_free(r);
        model_free(m);
    }
}

// In a step of 0.2 s the mass does not hold the softened spring any more.
static void a_negative_tangent_rejects_steps_that_are_too_long(void **state) {
    (void)state;
    double tangents[2 * STOREYS * STOREYS];
    struct part part[] = {{.kind = &softening}, {.kind = &softening}, {.kind = &softening}};
    struct model *m = model_with(part, 3, tangents, PUSHED "step fixed 0.2\n");
    struct results *r = run(m);
    assert_true(r->totals.rejected > 0);
    assert_int_equal(r->totals.unsolved, 0);
    assert_true(r->residual_peak < 1e-11 * r->initial_energy);
    results_free(r);
    model_free(m);
}

// A slider beside an elastic storey is a bilinear storey, to the last digits; and the same by
// both methods.
static void a_slider_is_a_bilinear_storey(void **state) {
    (void)state;
    static const char rest[] = "ground record input/records/ELCENTRO_1940_NS.AT2 -scale 2\n"
                               "damping A dashpot 100e3\nduration 8\n";
    static const char *const step[] = {"step fixed 1ms\n", "step adaptive -tolerance 1e-7\n"};
    double tangents[2 * STOREYS * STOREYS];
    int storey[] = {0, 1};
    for (int k = 0; k < 2; k++) {
        struct part part[] = {{.kind = &slider, .data = &storey[0], .n_history = 1},
                              {.kind = &slider, .data = &storey[1], .n_history = 1}};
        char text[512];
        snprintf(text, sizeof text, "%s%s", rest, step[k]);
        struct model *m = model_with(part, 2, tangents, text);
        struct results *got = run(m);
        struct analysis want =
            analysis_of("building A -floors 2 -mass 50t -stiffness 60e6 55e6\n"
                        "storey A:1 bilinear -yield %.17g -hardening %.17g\n"
                        "storey A:2 bilinear -yield %.17g -hardening %.17g\n%s",
                        LIMIT * 1.5, 20.0 / 60, LIMIT * 55 / 40, 15.0 / 55, text);
        for (int q = 0; q < PEAK_COUNT; q++) {
            for (int i = 0; i < STOREYS; i++) {
                assert_close(got->peak[q][i], want.results->peak[q][i], k == 0 ? 1e-10 : 1e-4);
            }
        }
        for (int i = 0; i < STOREYS && k == 0; i++) {
            assert_close(got->residual_drift[i], want.results->residual_drift[i], 1e-8);
        }
        assert_close(got->energy[ENERGY_HYSTERETIC], want.results->energy[ENERGY_HYSTERETIC],
                     k == 0 ? 1e-10 : 1e-4);
        assert_true(k > 0 || got->residual_peak < 1e-12 * got->energy[ENERGY_INPUT]);
        results_free(got);
        model_free(m);
        analysis_free(&want);
    }
}

// A bilinear storey is an elastoplastic one beside an elastic one, which is a matrix here.
static void storeys_yield_beside_a_matrix(void **state) {
    (void)state;
    static const char rest[] = "ground record input/records/ELCENTRO_1940_NS.AT2 -scale 2\n"
                               "building B -floors 2 -mass 50t -stiffness 30e6\n"
                               "contact A B -gap 10mm -law kelvin-voigt -k 93.5MN/m -e 0.65\n"
                               "damping A dashpot 100e3\ndamping B rayleigh 5%%\nduration 8\n";
    static const char *const step[] = {"step fixed 1ms\n",
                                       "integrator newmark\nstep adaptive -tolerance 1e-6\n",
                                       "step adaptive -tolerance 1e-7\n"};
    const char *file = support_write("elastic.txt", "11e6 -5e6\n-5e6 5e6\n");
    for (size_t k = 0; k < sizeof step / sizeof step[0]; k++) {
        char text[512];
        snprintf(text, sizeof text, rest);
        struct analysis want =
            analysis_of("building A -floors 2 -mass 50t -stiffness 60e6 50e6\n"
                        "storey A:all bilinear -yield 180e3 -hardening 0.1\n%s%s",
                        text, step[k]);
        struct analysis got =
            analysis_of("building A -floors 2 -mass 50t -stiffness 54e6 45e6\nmatrix A %s\n"
                        "storey A:all bilinear -yield 162e3 -hardening 0\n%s%s",
                        file, text, step[k]);
        const double rtol = k < 2 ? 1e-9 : 1e-5;
        for (int i = 0; i < got.model->n_dof; i++) {
            assert_close(got.results->peak[PEAK_DRIFT][i], want.results->peak[PEAK_DRIFT][i], rtol);
            assert_close(got.results->peak[PEAK_SHEAR][i], want.results->peak[PEAK_SHEAR][i], rtol);
        }
        for (int i = 0; i < 2; i++) {
            const double drift = want.results->residual_drift[i];
            assert_near(got.results->residual_drift[i], drift, 100 * rtol * (1e-4 + drift));
        }
        assert_true(got.results->n_impact > 0);
        assert_int_equal(got.results->n_impact, want.results->n_impact);
        assert_true(k == 2 || got.results->residual_peak <= 1e-12 * analysis_flow(&got));
        analysis_free(&got);
        analysis_free(&want);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_of_any_shape_are_followed_by_all_methods),
        cmocka_unit_test(a_negative_tangent_rejects_steps_that_are_too_long),
        cmocka_unit_test(a_slider_is_a_bilinear_storey),
        cmocka_unit_test(storeys_yield_beside_a_matrix),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
