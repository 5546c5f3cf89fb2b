// SPDX-License-Identifier: GPL-3.0-or-later
// Hinges of frames against closed forms and against the equilibrium of the frame itself. Their
// motions against an independent program are in test_reference.c.
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/lanes.h"
#include "model/forces.h"
#include "model/hinges.h"
#include "model/parts.h"
#include "support/analysis.h"
#include "support/random.h"
#include "support/support.h"

#define STILL "step fixed 1ms\nduration 10ms\n"

// A portal: E I of the columns 40 MN m^2, of the beam 50 MN m^2.
#define PORTAL                                                                                     \
    "building A -floors 1 -mass 50e3 -height 3.5\nframe A -bays 6 -modulus 200e9 "                 \
    "-columns-inextensible\ncolumns A:1 -I 2e-4\nbeams A:1 -I 2.5e-4\n"

#define FRAME                                                                                      \
    "building A -floors 3 -mass 60e3 -height 3.5\nframe A -bays 2*6 -modulus 200e9\n"              \
    "columns A:1:3 -I 3e-4 -A 0.012\nbeams A:1:3 -I 2.5e-4\n"

// The part of the first building with its history, as a step sees it.
struct hinged {
    struct model *model;
    const struct building *building;
    const struct part *part;
    double *history, *scratch;
};

static struct hinged hinged_of(const char *deck) {
    struct hinged h = {.model = analysis_model("%s", deck)};
    h.building = &h.model->building[0];
    h.part = &h.building->part[0];
    h.history = calloc((size_t)h.model->n_storey_history + 1, sizeof *h.history);
    h.scratch = calloc((size_t)h.model->n_part_scratch + 1, sizeof *h.scratch);
    assert_true(h.history && h.scratch && frame_of(h.part));
    return h;
}

static void hinged_free(struct hinged *h) {
    free(h->history);
    free(h->scratch);
    model_free(h->model);
}

// Adds the shears and the tangent at these drifts to zeros, without a commitment.
static void hinged_at(const struct hinged *h, const double *drift, double *shear, double *tangent,
                      double *after) {
    const size_t n = (size_t)h->part->n;
    memset(shear, 0, n * sizeof *shear);
    memset(tangent, 0, n * n * sizeof *tangent);
    const struct part_sums sums = {.shear = shear, .by_drift = tangent, .scratch = h->scratch};
    h->part->kind->respond(h->part, h->history, drift, drift, &sums, after);
}

// The storey shear of a portal that is pushed to a drift in steps.
static double push(const struct hinged *h, double drift, int steps) {
    double shear = 0.0, tangent = 0.0;
    for (int i = 1; i <= steps; i++) {
        const double to = drift * i / steps;
        hinged_at(h, &to, &shear, &tangent, h->history);
    }
    return shear;
}

// A mechanism with hinges of constant moments at the bases and beam ends: V h = 2 M_c + 2 M_b.
static void a_portal_of_plastic_hinges_carries_its_mechanism_load(void **state) {
    (void)state;
    struct hinged h = hinged_of(
        PORTAL "hinges A bases bilinear -yield 260e3 -hardening 0 -stiffness 6.9e8\n"
               "hinges A:1 beams bilinear -yield 220e3 -hardening 0 -stiffness 5e8\n" STILL);
    assert_close(push(&h, 0.3, 40), 2 * (260e3 + 220e3) / 3.5, 1e-9);
    assert_close(push(&h, -0.3, 40), -2 * (260e3 + 220e3) / 3.5, 1e-9);
    hinged_free(&h);
}

// At the upper corners the hinges of column and beam both yield at one moment: the joint between
// them can turn freely, and the load is that of the weaker side.
static void a_joint_between_equal_plastic_hinges_is_found(void **state) {
    (void)state;
    struct hinged h = hinged_of(
        PORTAL "hinges A:1 columns bilinear -yield 220e3 -hardening 0 -stiffness 6.9e8\n"
               "hinges A:1 beams bilinear -yield 220e3 -hardening 0 -stiffness 5e8\n" STILL);
    assert_close(push(&h, 0.3, 40), 4 * 220e3 / 3.5, 1e-9);
    hinged_free(&h);
}

// The pushover of the reference K_hinges, by events.
static void pushover_agrees_with_an_independent_program(void **state) {
    (void)state;
    static const double point[][2] = {{0.005, 66881.68037}, {0.01, 133763.3607},
                                      {0.02, 259333.1199},  {0.03, 313263.5352},
                                      {0.04, 354611.2621},  {0.1, 602697.6234}};
    for (size_t i = 0; i < sizeof point / sizeof point[0]; i++) {
        struct hinged h = hinged_of(
            PORTAL "hinges A bases bilinear -yield 260e3 -hardening 0.03 -stiffness 685714285.7\n"
                   "hinges A:1 beams bilinear -yield 220e3 -hardening 0.03 -stiffness 5e8\n" STILL);
        assert_close(push(&h, point[i][0], 1), point[i][1], 1e-9);
        hinged_free(&h);
    }
}

static double first_omega(const char *deck) {
    struct model *m = analysis_model("%s", deck);
    const double omega = m->building[0].omega[0];
    model_free(m);
    return omega;
}

static void stiff_hinges_leave_the_elastic_frame(void **state) {
    (void)state;
    const double want = first_omega(FRAME STILL);
    assert_close(first_omega(FRAME
                             "hinges A:1:3 columns bilinear -yield 1e5 -hardening 0.1 -stiffness "
                             "1e20\nhinges A:1:3 beams takeda -yield 1e5 -hardening 0.1 "
                             "-stiffness 1e20\n" STILL),
                 want, 1e-9);
}

// At a fixed base a hinge is the rotation spring of the base; at both ends of the beam of a portal
// that sways, L / (6 E I) grows by 1 / k.
static void hinges_that_do_not_yield_are_springs_in_series(void **state) {
    (void)state;
    const double want = first_omega(PORTAL "base A -rotation 3e7\n" STILL);
    assert_close(first_omega(PORTAL "hinges A bases bilinear -yield 1 -hardening 0.5 -stiffness "
                                    "3e7\n" STILL),
                 want, 1e-12);
    char deck[512];
    const double inertia = 1.0 / (1.0 / 2.5e-4 + 6.0 * 200e9 / 6.0 / 8e7);
    snprintf(deck, sizeof deck,
             "building A -floors 1 -mass 50e3 -height 3.5\nframe A -bays 6 -modulus 200e9 "
             "-columns-inextensible\ncolumns A:1 -I 2e-4\nbeams A:1 -I %.17g\n" STILL,
             inertia);
    assert_close(first_omega(PORTAL "hinges A:1 beams bilinear -yield 1 -hardening 0.5 -stiffness "
                                    "8e7\n" STILL),
                 first_omega(deck), 1e-12);
}

#define UNEVEN                                                                                     \
    "building A -floors 3 -mass 60e3 -height 3 4 3.5\n"                                            \
    "frame A -bays 5 7 -modulus 200e9 -columns-inextensible\ncolumns A:1:3 -I 4e-4 3e-4 2e-4\n"    \
    "beams A:1:3 -I 3e-4 2.5e-4 2e-4\nbase A -rotation 5e7 -lines 2\nbase A pinned -lines 3\n"

static const char *const laws[] = {
    UNEVEN "hinges A:1:3 columns bilinear -yield 260e3 -hardening 0.03 -stiffness 7e8\n"
           "hinges A:1:3 beams bilinear -yield 220e3 -hardening 0 -stiffness 5e8\n" STILL,
    UNEVEN "hinges A:1:2 columns clough -yield 2*260e3 -hardening 0.05 -stiffness 7e8\n"
           "hinges A:1:3 beams bouc-wen -yield 220e3 -hardening 0.02 -n 2 -stiffness 5e8\n" STILL,
    UNEVEN
    "hinges A bases takeda -yield 260e3 -hardening 0.05 "
    "-stiffness 7e8 -lines 1 2\n"
    "hinges A:2:3 beams flag -yield 220e3 -hardening 0.02 -b 0.6 -stiffness 5e8 -bays 1\n" STILL,
};
enum { N_LAWS = sizeof laws / sizeof laws[0], STOREYS = 3 };

static double force_at(const struct hinged *h, const double *force, int member, int which) {
    return force[forces_of_members(h->building, 0, which) + member];
}

// The turn of each joint, as each member there has it: from its end moments, drift and hinge.
static void check_continuity(const struct hinged *h, const double *drift, const double *force) {
    const struct plane_frame *f = frame_of(h->part);
    double turn[32] = {0}, balance[32] = {0};
    bool known[32] = {false};
    assert_true(f->n_joint <= 32);
    for (int i = 0; i < f->n_member; i++) {
        const struct frame_member *m = &f->member[i];
        const double moment[] = {force_at(h, force, i, FRAME_MOMENT_I),
                                 force_at(h, force, i, FRAME_MOMENT_J)};
        const double sway = (moment[0] + moment[1]) / 2.0 / m->sway;
        const double bend = (moment[0] - moment[1]) / 2.0 / m->bend;
        const double chord = m->kind == FRAME_BEAM ? 0.0 : -drift[m->level - 1] / m->length;
        for (int end = 0; end < 2; end++) {
            const double rotation = (sway + (end ? -bend : bend)) / 2.0;
            const double hinge =
                m->hinge[end] < 0 ? 0.0 : force_at(h, force, i, FRAME_ROTATION_I + end);
            const int joint = m->joint[end];
            const double own = chord + rotation - hinge;
            if (known[joint]) {
                assert_near(own, turn[joint], 1e-12);
            }
            turn[joint] = own;
            known[joint] = true;
            balance[joint] += moment[end];
        }
    }
    for (int i = 0; i < f->n_joint; i++) {
        if (f->joint[i].turns) {
            assert_near(balance[i] + f->joint[i].spring * turn[i], 0.0, 1e-6);
        } else {
            assert_near(turn[i], 0.0, 1e-12);
        }
    }
}

// The moments of the laws at the rotations found, and the storey shears as sums over columns.
static void check_moments(const struct hinged *h, const double *before, const double *shear,
                          const double *force) {
    const struct plane_frame *f = frame_of(h->part);
    double sum[STOREYS] = {0};
    for (int i = 0; i < f->n_hinge; i++) {
        const struct hinge *hinge = hinges_at(f, i);
        const double turn = force_at(h, force, hinge->member, FRAME_ROTATION_I + hinge->end);
        const struct storey *s = &hinge->storey;
        const double moment =
            s->law
                ->respond(s->constant, before + hinges_of_laws(f->n_hinge) + s->history, turn, NULL)
                .shear;
        assert_near(force_at(h, force, hinge->member, hinge->end), -moment, 1e-5);
    }
    for (int i = 0; i < f->n_member; i++) {
        if (f->member[i].kind == FRAME_COLUMN) {
            sum[f->member[i].level - 1] += force_at(h, force, i, FRAME_SHEAR);
        }
    }
    for (int i = 0; i < STOREYS; i++) {
        assert_near(sum[i], shear[i], 1e-5);
    }
}

// The tangent is symmetric to the bit and that of the shears, unless a hinge is at a corner.
static void check_tangent(const struct hinged *h, const double *drift, const double *tangent) {
    const double step = 1e-9;
    double shear[2][STOREYS], other[STOREYS * STOREYS], x[STOREYS];
    for (int j = 0; j < STOREYS; j++) {
        for (int k = 0; k < 2; k++) {
            memcpy(x, drift, sizeof x);
            x[j] += k ? step : -step;
            hinged_at(h, x, shear[k], other, NULL);
        }
        for (int i = 0; i < STOREYS; i++) {
            const double slope = (shear[1][i] - shear[0][i]) / (2 * step);
            assert_near(tangent[i * STOREYS + j], slope, 2e-4 * fabs(tangent[j * STOREYS + j]));
            assert_true(tangent[i * STOREYS + j] == tangent[j * STOREYS + i]);
        }
    }
}

static void any_path_is_in_equilibrium(void **state) {
    (void)state;
    for (int n = 0; n < N_LAWS; n++) {
        struct hinged h = hinged_of(laws[n]);
        const size_t size = (size_t)h.model->n_storey_history * sizeof(double);
        struct random random = {.state = 7 + (uint64_t)n};
        double drift[STOREYS] = {0}, shear[STOREYS], tangent[STOREYS * STOREYS];
        double *force = calloc((size_t)lanes_whole(h.building->n_force), sizeof *force);
        double *before = malloc(size);
        assert_true(force && before);
        for (int i = 0; i < 300; i++) {
            memcpy(before, h.history, size);
            for (int k = 0; k < STOREYS; k++) {
                drift[k] += random_uniform(&random, -0.03, 0.03) - 0.1 * drift[k];
            }
            hinged_at(&h, drift, shear, tangent, h.history);
            forces_at(h.building, drift, h.history, NULL, force);
            check_continuity(&h, drift, force);
            check_moments(&h, before, shear, force);
            memcpy(h.history, before, size);
            check_tangent(&h, drift, tangent);
            hinged_at(&h, drift, shear, tangent, h.history);
        }
        free(before);
        free(force);
        hinged_free(&h);
    }
}

// On a closed path, the work that is not stored never comes back.
static void closed_cycles_make_no_energy(void **state) {
    (void)state;
    struct hinged h = hinged_of(laws[0]);
    double last[STOREYS] = {0}, shear_0[STOREYS] = {0}, worst = 0.0, work = 0.0, lost = 0.0;
    const double stored_0 = h.part->kind->stored(h.part, h.history, last);
    assert_true(stored_0 == 0.0);
    for (int i = 1; i <= 8000; i++) {
        const double angle = 2 * acos(-1.0) * i / 2000;
        const double drift[] = {0.05 * sin(angle), 0.04 * sin(angle - 0.3) + 0.04 * sin(0.3),
                                -0.03 * sin(2 * angle)};
        double shear[STOREYS], tangent[STOREYS * STOREYS];
        hinged_at(&h, drift, shear, tangent, h.history);
        for (int k = 0; k < STOREYS; k++) {
            work += (shear[k] + shear_0[k]) / 2 * (drift[k] - last[k]);
        }
        memcpy(last, drift, sizeof last);
        memcpy(shear_0, shear, sizeof shear_0);
        const double now = work - h.part->kind->stored(h.part, h.history, drift);
        worst = fmax(worst, lost - now);
        lost = now;
    }
    assert_true(lost > 1e5 && worst <= 1e-12 * lost);
    hinged_free(&h);
}

// The account closes to rounding, with P-delta, hinges that yield at constant moments and a
// contact.
static void the_account_of_energy_closes(void **state) {
    (void)state;
    struct analysis a = analysis_of(
        UNEVEN "pdelta A\ndamping A rayleigh 3%%\n"
               "hinges A:1:3 columns bilinear -yield 160e3 -hardening 0.03 -stiffness 7e8\n"
               "hinges A:1:3 beams bilinear -yield 120e3 -hardening 0 -stiffness 5e8\n"
               "building B -floors 3 -mass 40e3 -stiffness 30e6\ndamping B rayleigh 5%%\n"
               "contact A:3 B:3 -gap 20mm -law jankowski -k 3e9 -e 0.65\n"
               "ground sine -amplitude 4 -frequency 1.1 -cycles 8\nstep fixed 2ms\nduration 10\n");
    assert_true(a.results->energy[ENERGY_HYSTERETIC] > 0.2 * a.results->energy[ENERGY_INPUT]);
    assert_true(a.results->link[0].impacts > 3);
    assert_true(a.results->residual_peak <= 1e-12 * analysis_flow(&a));
    analysis_free(&a);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_portal_of_plastic_hinges_carries_its_mechanism_load),
        cmocka_unit_test(a_joint_between_equal_plastic_hinges_is_found),
        cmocka_unit_test(pushover_agrees_with_an_independent_program),
        cmocka_unit_test(stiff_hinges_leave_the_elastic_frame),
        cmocka_unit_test(hinges_that_do_not_yield_are_springs_in_series),
        cmocka_unit_test(any_path_is_in_equilibrium),
        cmocka_unit_test(closed_cycles_make_no_energy),
        cmocka_unit_test(the_account_of_energy_closes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
