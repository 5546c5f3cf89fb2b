// SPDX-License-Identifier: GPL-3.0-or-later
// Dormand & Prince's method where something is stiff: accelerations and forces are right to ten
// times the tolerance, in their peaks and at every row, or the run ends with advice. Displacements
// alone say nothing about that: a link of 1e12 N/m makes 1e5 N of a tenth of a micrometre. The
// reference is the same method with steps of 0.15 over the largest frequency, whose phase is wrong
// by 1e-8 of a radian (limits_of_stability_are_roots); Newmark's method agrees with it.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "model/stability.h"
#include "support/analysis.h"
#include "support/support.h"

#define ROCK "ground record input/records/ELCENTRO_1940_NS.AT2 "
#define B "building B -floors 2 -mass 2e5 -stiffness 4e8\ndamping B rayleigh 5%\n"

enum kind { LINK, STOREY, CONTACT };
static const double mass = 2e5 * 3e5 / 5e5;  // of the link and the contact, and less of the storey

// A deck with something of stiffness k. The contact is pressed by 6 MN, which come in half a
// second.
static void write_deck(char *text, size_t size, enum kind kind, double k, const char *step) {
    if (kind == LINK) {
        snprintf(text, size,
                 "building A -floors 3 -mass 3e5 -stiffness 3e8\ndamping A rayleigh 5%%\n%s"
                 "link A:2 B:2 -stiffness %g\n" ROCK "\nduration 6\n%s",
                 B, k, step);
    } else if (kind == STOREY) {
        snprintf(
            text, size,
            "building A -floors 3 -mass 3e5 -stiffness 3e8 %g 3e8\ndamping A rayleigh 5%%\n" ROCK
            "\nduration 6\n%s",
            k, step);
    } else {
        const char *load = support_write("press.txt", "0\n-6e6\n-6e6\n-6e6\n-6e6\n-6e6\n-6e6\n"
                                                      "-6e6\n-6e6\n-6e6\n-6e6\n-6e6\n-6e6\n-6e6\n"
                                                      "-6e6\n");
        snprintf(text, size,
                 "building A -floors 3 -mass 3e5 -stiffness 3e8\ndamping A rayleigh 5%%\n%s"
                 "contact A:2 B:2 -gap 0 -law linear -k %g\nload B:2 history %s -dt 0.5\n" ROCK
                 "-delay 1\nduration 7\n%s",
                 B, k, load, step);
    }
}

static struct analysis run(enum kind kind, double k, const char *step, struct error *e) {
    char text[2048];
    write_deck(text, sizeof text, kind, k, step);
    *e = (struct error){0};
    return analysis_try(text, e);
}

static struct analysis reference(enum kind kind, double k) {
    char step[200];
    struct error e;
    snprintf(step, sizeof step,
             "integrator dormand-prince\nstep adaptive -tolerance %g -max %.3g\n",
             k > 1e12 ? 1e-7 : 1e-10, 0.15 / sqrt(k / mass));
    struct analysis a = run(kind, k, step, &e);
    if (e.status != STATUS_OK) {
        fail_msg("%s", e.message);
    }
    return a;
}

// The largest difference of a history from that of the reference, over the largest value of its
// floor or link.
static double worst_row(const double *x, const double *want, long n, int width) {
    double worst = 0.0;
    for (int i = 0; i < width; i++) {
        double size = 0.0, error = 0.0;
        for (long j = i; j < n * width; j += width) {
            size = fmax(size, fabs(want[j]));
            error = fmax(error, fabs(x[j] - want[j]));
        }
        worst = fmax(worst, error / size);
    }
    return worst;
}

// The largest error of an acceleration, a shear or a force.
static double worst_error(const struct analysis *a, const struct analysis *r) {
    int n_dof = a->model->n_dof;
    int n_link = a->model->n_link;
    assert_int_equal(a->rows.n, r->rows.n);
    double worst = worst_row(a->rows.acceleration, r->rows.acceleration, a->rows.n, n_dof);
    worst = fmax(worst, worst_row(a->rows.shear, r->rows.shear, a->rows.n, n_dof));
    worst = fmax(worst, worst_row(a->rows.force, r->rows.force, a->rows.n, n_link));
    static const enum peak peaks[] = {PEAK_ACCELERATION, PEAK_SHEAR};
    for (int q = 0; q < 2; q++) {
        const double *x = a->results->peak[peaks[q]], *want = r->results->peak[peaks[q]];
        for (int i = 0; i < n_dof; i++) {
            worst = fmax(worst, fabs(x[i] / want[i] - 1.0));
        }
    }
    for (int i = 0; i < n_link; i++) {
        worst = fmax(worst, fabs(a->results->link[i].force / r->results->link[i].force - 1.0));
    }
    return worst;
}

static void is_accurate(enum kind kind, double k) {
    struct analysis r = reference(kind, k);
    for (int digits = 3; digits <= 8; digits++) {
        char step[100];
        struct error e;
        double tolerance = pow(10.0, -digits);
        snprintf(step, sizeof step, "integrator dormand-prince\nstep adaptive -tolerance %g\n",
                 tolerance);
        struct analysis a = run(kind, k, step, &e);
        if (e.status != STATUS_OK) {
            assert_true(k > 1e12 && digits == 8);  // where rounding is larger
            assert_non_null(strstr(e.message, "use a larger -tolerance, integrator newmark"));
        } else {
            assert_int_equal(a.results->n_impact, kind == CONTACT);
            double error = worst_error(&a, &r);
            if (!(error <= 10.0 * tolerance)) {
                fail_msg("kind %d, %g N/m, tolerance %g: error %g", kind, k, tolerance, error);
            }
        }
        analysis_free(&a);
    }
    analysis_free(&r);
}

static void a_stiff_link_has_the_right_forces(void **state) {
    (void)state;
    for (double k = 1e9; k < 2e13; k *= 100.0) {
        is_accurate(LINK, k);
    }
}

static void a_stiff_storey_has_the_right_forces(void **state) {
    (void)state;
    for (double k = 1e9; k < 2e13; k *= 100.0) {
        is_accurate(STOREY, k);
    }
}

static void a_pressed_contact_stays_closed_and_has_the_right_force(void **state) {
    (void)state;
    for (double k = 1e9; k < 2e13; k *= 100.0) {
        is_accurate(CONTACT, k);
    }
}

// Fixed steps of 0.02 ms; what they miss themselves is 1e-4.
static void newmark_agrees(void **state) {
    (void)state;
    struct error e;
    struct analysis r = reference(LINK, 1e11);
    struct analysis a = run(LINK, 1e11, "step fixed 0.02ms\noutput -interval 0.01s\n", &e);
    assert_int_equal(e.status, STATUS_OK);
    assert_true(worst_error(&a, &r) < 1e-3);
    analysis_free(&a);
    analysis_free(&r);
}

// A dashpot of 1e9 N s/m between floors decays at 8333 1/s: steps are as short as that wants.
static void a_strong_dashpot_has_the_right_force(void **state) {
    (void)state;
    struct analysis a[2];
    static const char *const more[] = {"", "-max 0.05ms"};
    for (int i = 0; i < 2; i++) {
        a[i] = analysis_of("building A -floors 3 -mass 3e5 -stiffness 3e8\n"
                           "building B -floors 2 -mass 2e5 -stiffness 4e8\n"
                           "link A:2 B:2 -dashpot 1e9\n" ROCK "\nduration 6\n"
                           "integrator dormand-prince\nstep adaptive -tolerance 1e-3 %s\n",
                           more[i]);
    }
    assert_true(worst_row(a[0].rows.force, a[1].rows.force, a[0].rows.n, 1) < 1e-2);
    assert_close(a[0].results->link[0].force, a[1].results->link[0].force, 1e-2);
    analysis_free(&a[0]);
    analysis_free(&a[1]);
}

// The roots of |R| = 1 by another way: on the imaginary axis the polynomial of stability.c, on the
// real one the largest root of R = 1, which is z^4/600 + z^3/120 + z^2/24 + z/6 + 1/2 + 1/z = 0.
static void limits_of_stability_are_roots(void **state) {
    (void)state;
    double y2 = pow(stability_limit(0.0), 2.0);
    assert_near(y2 * y2 * y2 * (1.0 / 1800 - y2 / 1600 + y2 * y2 / 14400 - y2 * y2 * y2 / 360000),
                0.0, 1e-6);
    double z = -stability_limit(1.0);
    assert_near(z * z * z * z * z / 600 + z * z * z * z / 120 + z * z * z / 24 + z * z / 6 + z / 2 +
                    1.0,
                0.0, 1e-3);
    assert_close(stability_limit(2.0) * (2.0 + sqrt(3.0)), -z, 1e-3);
    for (int i = 0; i < 100; i++) {
        assert_true(stability_limit(i / 100.0) >= 0.99);
    }
}

// A link adds the square of its own frequency, a dashpot its rate.
static void links_shorten_the_longest_step(void **state) {
    (void)state;
    struct stability s = {.alone = 2.4 / 100.0, .square = 1e4};
    assert_close(stability_step(&s, 0.0, 0.0), 2.4e-2, 1e-12);
    assert_close(stability_step(&s, 1e8, 0.0), 0.99e-4, 1e-12);
    assert_close(stability_step(&s, 0.0, 33000.0), 1e-4, 1e-12);
    assert_close(stability_step(&s, 3e2, 0.0), 2.4e-2 / sqrt(1.03), 1e-12);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_stiff_link_has_the_right_forces),
        cmocka_unit_test(a_stiff_storey_has_the_right_forces),
        cmocka_unit_test(a_pressed_contact_stays_closed_and_has_the_right_force),
        cmocka_unit_test(newmark_agrees),
        cmocka_unit_test(a_strong_dashpot_has_the_right_force),
        cmocka_unit_test(limits_of_stability_are_roots),
        cmocka_unit_test(links_shorten_the_longest_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
