// SPDX-License-Identifier: GPL-3.0-or-later
// Ends of contacts and links that are not one floor: levels between two floors, and the difference
// of two floors of one building.
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "jostle/ensemble.h"
#include "support/analysis.h"
#include "support/support.h"

// Two buildings of 3 and 2 floors, floors of B at 4 and 8.5 m.
#define PAIR                                                                                       \
    "building A -floors 3 -mass 100 90 80 -stiffness 8e4 7e4 6e4 -height 3\n"                      \
    "building B -floors 2 -mass 300 250 -stiffness 2e5 1.5e5 -height 4 4.5\n"
#define DAMPED PAIR "damping A rayleigh 3%%\ndamping B rayleigh 5%%\n"
#define MOVES                                                                                      \
    "ground sine -amplitude 3 -frequency 1.9 -cycles 3\ninitial A:1:3 -velocity 0.8\nduration 3\n"

enum { FLOORS = 5 };
static const double SHARE = 2.8 / 4.5;  // of level 6.8 m in the second storey of B

static const char *const steps[] = {"step fixed 1ms\n", "integrator newmark\nstep adaptive\n",
                                    "integrator dormand-prince\nstep adaptive\n"};
enum { N_STEP = sizeof steps / sizeof steps[0] };

static struct results *run(const struct model *m) {
    struct results *r = NULL;
    struct error e = {0};
    const struct observer observer = {0};
    if (analysis_run(m, &observer, &r, &e) != STATUS_OK) {
        fail_msg("%s", e.message);
    }
    return r;
}

static void assert_same_bits(const struct model *m, const struct results *a,
                             const struct results *b) {
    for (int q = 0; q < PEAK_COUNT; q++) {
        assert_memory_equal(a->peak[q], b->peak[q], (size_t)m->n_dof * sizeof(double));
        assert_memory_equal(a->peak_time[q], b->peak_time[q], (size_t)m->n_dof * sizeof(double));
    }
    for (int k = 0; k < m->n_link; k++) {
        const struct link_peak *x = &a->link[k], *y = &b->link[k];
        assert_memory_equal(x, y, offsetof(struct link_peak, impacts));
        assert_int_equal(x->impacts, y->impacts);
    }
    assert_int_equal(a->n_impact, b->n_impact);
    assert_memory_equal(a->energy, b->energy, sizeof a->energy);
}

// Contacts and links of every kind that solvers tell apart.
static const char *const joints[] = {
    "link A:1 B:2 -stiffness 1e5 -dashpot 1e3\ncontact A:2 wall -gap 8mm -law linear -k 1e7\n",
    "contact A:1 B:1 -gap 4mm -law linear -k 5e6\ncontact A:2 B:2 -gap 3mm -law jankowski -k 2e8 "
    "-e 0.6\n",
    "contact A:1 B:1 -gap 4mm -law kelvin-voigt -k 5e6 -e 0.6\ncontact A:1 B:2 -gap 4mm -law "
    "linear -k 5e7\n",
    "contact A:1 B:1 -gap 4mm -law stereomechanical -e 0.95\ncontact A:3 B:2 -gap 4mm -law "
    "stereomechanical -e 0.9\n",
    "link A:1 B:2 -stiffness 1e5 -dashpot 1e3\ncontact A:2 wall -gap 8mm -law stereomechanical -e "
    "0.95\n",
};
enum { N_JOINT = sizeof joints / sizeof joints[0] };

// A row with one entry of weight 1 is a floor, though it goes another way through the solver. The
// contact of joint 0 stays as it is, so that free flight, which finds the force of its link in
// another way, is possible in both runs.
static void a_row_of_one_floor_has_the_bits_of_the_floor(void **state) {
    (void)state;
    for (int i = 0; i < N_JOINT * N_STEP; i++) {
        struct model *m =
            analysis_model(DAMPED MOVES "%s%s", joints[i / N_STEP], steps[i % N_STEP]);
        struct results *floors = run(m);
        assert_true(floors->n_impact > 0);
        struct link link[2];
        struct link_entry entry[2][2];
        assert_int_equal(m->n_link, 2);
        memcpy(link, m->link, sizeof link);
        for (int k = i / N_STEP == 0 ? 2 : 0; k < 4; k++) {
            struct link *l = &link[k / 2];
            entry[k / 2][k % 2] = (struct link_entry){l->dof[k % 2], 1.0};
            if (l->dof[k % 2] != WALL) {
                l->row[k % 2] = (struct link_row){1, &entry[k / 2][k % 2]};
            }
        }
        m->link = link;
        struct results *rows = run(m);
        assert_same_bits(m, floors, rows);
        results_free(floors);
        results_free(rows);
        model_free(m);
    }
}

static void a_level_at_a_floor_is_that_floor(void **state) {
    (void)state;
    struct model *m =
        analysis_model(PAIR MOVES "step fixed 1ms\n"
                                  "contact A@3m B@4m -gap 4mm -law linear -k 5e6\n"
                                  "contact A@9.0000000001m B@8.5m -gap 4mm -law linear -k 5e6\n");
    const char *const name[] = {"A:1-B:1", "A:3-B:2"};
    for (int k = 0; k < 2; k++) {
        const struct link *l = &m->link[k];
        assert_string_equal(l->name, name[k]);
        assert_true(isnan(l->level[0]) && isnan(l->level[1]));
        assert_int_equal(l->row[0].n + l->row[1].n, 0);
        assert_int_equal(l->dof[0], 2 * k);
        assert_int_equal(l->dof[1], 3 + k);
    }
    model_free(m);
}

static void a_level_is_a_weighted_pair_of_floors(void **state) {
    (void)state;
    struct model *m =
        analysis_model("units kN cm s\nparam z 8.5m\nparam end B@680cm\n"
                       "building A -floors 3 -mass 1 -stiffness 8e2 -height 3m\n"
                       "building B -floors 3 -mass 2 3 4 -stiffness 2e3 -height 4m 4.5m 3m\n"
                       "contact A:2 $end -gap 4mm -law linear -k 5e2\n"
                       "contact A@1m B@${z/2 - 1.25m} -gap 4mm -law linear -k 5e2\n"
                       "link wall B@$z -stiffness 1 -name w\n" MOVES "step fixed 1ms\n");
    const struct link *l = &m->link[0];
    assert_string_equal(l->name, "A:2-B@680cm");
    assert_int_equal(l->floor[1], 2);
    assert_close(l->level[1], 680.0, 1e-15);
    assert_int_equal(l->row[1].n, 2);
    assert_int_equal(l->row[1].entry[0].dof, 4);
    assert_close(l->row[1].entry[0].weight, SHARE, 1e-14);
    assert_int_equal(l->row[1].entry[1].dof, 3);
    assert_close(l->row[1].entry[1].weight, 1.0 - SHARE, 1e-14);
    assert_close(1.0 / l->mass, 1.0 + SHARE * SHARE / 3.0 + pow(1.0 - SHARE, 2.0) / 2.0, 1e-14);
    l = &m->link[1];  // below the first floors of both
    assert_string_equal(l->name, "A@100cm-B@300cm");
    for (int side = 0; side < 2; side++) {
        assert_int_equal(l->row[side].n, 1);
        assert_close(l->row[side].entry[0].weight, side == 0 ? 1.0 / 3.0 : 0.75, 1e-14);
    }
    assert_int_equal(m->link[2].dof[1], 4);
    model_free(m);
}

// Free bodies: the impulse J = (1 + e) m* v changes velocities by M^-1 b' J, and 1/m* = b M^-1 b'.
static void a_rigid_impact_at_a_level_keeps_momentum_and_restitution(void **state) {
    (void)state;
    for (int i = 0; i < N_STEP; i++) {
        struct analysis a =
            analysis_of("building A -floors 1 -mass 2 -stiffness 0 -height 6.8\n"
                        "building B -floors 2 -mass 300 250 -stiffness 0 -height 4 4.5\n"
                        "initial A:1 -velocity 0.5\ninitial B:1 -velocity -0.25\n"
                        "contact A:1 B@6.8m -gap 0.1 -law stereomechanical -e 0.6\n"
                        "duration 1\noutput -interval 0.1\n%s",
                        steps[i]);
        const double share[] = {1.0 - SHARE, SHARE}, mass[] = {300.0, 250.0};
        const double approach = 0.5 + 0.25 * share[0];
        double inverse = 0.5;
        for (int k = 0; k < 2; k++) {
            inverse += share[k] * share[k] / mass[k];
        }
        const double impulse = 1.6 * approach / inverse;
        const double *v = a.rows.velocity + 3 * (a.rows.n - 1);
        assert_int_equal(a.results->n_impact, 1);
        assert_close(a.results->impact[0].impulse, impulse, 1e-12);
        assert_close(a.results->impact[0].v_approach, approach, 1e-12);
        assert_close(a.results->impact[0].v_rebound, 0.6 * approach, 1e-12);
        assert_close(v[0], 0.5 - impulse / 2.0, 1e-12);
        assert_close(v[1], -0.25 + share[0] * impulse / mass[0], 1e-12);
        assert_close(v[2], share[1] * impulse / mass[1], 1e-12);
        assert_close(a.results->impact[0].dissipated, 0.32 * approach * approach / inverse, 1e-12);
        analysis_free(&a);
    }
}

// M u'' = -K u - b' (k b u + c b u') of the pair, undamped, by the classical method of Runge and
// Kutta. `b` (n, FLOORS) are the rows of the links.
struct dense {
    int n;
    const double (*b)[FLOORS];
    double k, c;
};

static void dense_rates(const struct dense *s, const double *x, double *rate) {
    static const double mass[FLOORS] = {100, 90, 80, 300, 250};
    static const double stiffness[FLOORS] = {8e4, 7e4, 6e4, 2e5, 1.5e5};
    double force[FLOORS] = {0};
    for (int i = 0; i < FLOORS; i++) {
        const bool first = i == 0 || i == 3;
        const double shear = stiffness[i] * (x[i] - (first ? 0.0 : x[i - 1]));
        force[i] -= shear;
        force[first ? i : i - 1] += first ? 0.0 : shear;
    }
    for (int l = 0; l < s->n; l++) {
        double d = 0.0, v = 0.0;
        for (int i = 0; i < FLOORS; i++) {
            d += s->b[l][i] * x[i];
            v += s->b[l][i] * x[FLOORS + i];
        }
        for (int i = 0; i < FLOORS; i++) {
            force[i] -= s->b[l][i] * (s->k * d + s->c * v);
        }
    }
    for (int i = 0; i < FLOORS; i++) {
        rate[i] = x[FLOORS + i];
        rate[FLOORS + i] = force[i] / mass[i];
    }
}

static void dense_step(const struct dense *s, double h, double *x) {
    enum { N = 2 * FLOORS };
    static const double at[] = {0.0, 0.5, 0.5, 1.0},
                        weight[] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    double rate[N] = {0}, sum[N] = {0};
    for (int q = 0; q < 4; q++) {
        double y[N];
        for (int i = 0; i < N; i++) {
            y[i] = x[i] + at[q] * h * rate[i];
        }
        dense_rates(s, y, rate);
        for (int i = 0; i < N; i++) {
            sum[i] += weight[q] * rate[i];
        }
    }
    for (int i = 0; i < N; i++) {
        x[i] += h * sum[i];
    }
}

// Springs and dampers between levels, among them some that share floors, over 1 s. The reference
// has an error of some 1e-10 of the largest displacement.
static void links_at_levels_agree_with_a_dense_integration(void **state) {
    (void)state;
    const double b[][FLOORS] = {{0, 1, 0, -(1.0 - SHARE), -SHARE},
                                {0, 0.5, 0.5, 0, -1},
                                {1, 0, 0, -0.75, 0},
                                {1.0 / 3.0, 0, 0, 0, 0}};
    const struct dense s = {4, b, 4e5, 300.0};
    double x[2 * FLOORS] = {[FLOORS] = 0.8, [FLOORS + 1] = 0.8, [FLOORS + 2] = 0.8};
    for (int n = 0; n < 20000; n++) {
        dense_step(&s, 5e-5, x);
    }
    const char *const step[] = {"step fixed 0.2ms\n",
                                "integrator newmark\nstep adaptive -tolerance 1e-9\n",
                                "integrator dormand-prince\nstep adaptive -tolerance 1e-11\n"};
    const double tolerance[] = {2e-6, 2e-5, 1e-9};  // 0.2 ms in a period of 30 ms: 4e-6 a radian
    for (int i = 0; i < N_STEP; i++) {
        struct analysis a = analysis_of(PAIR "initial A:1:3 -velocity 0.8\nduration 1\n%s"
                                             "link A:2 B@6.8m -stiffness 4e5 -dashpot 300\n"
                                             "link A@7.5m B:2 -stiffness 4e5 -dashpot 300\n"
                                             "link A:1 B@3m -stiffness 4e5 -dashpot 300\n"
                                             "link A@1m wall -stiffness 4e5 -dashpot 300\n"
                                             "output -interval 0.1\n",
                                        step[i]);
        const double *u = a.rows.displacement + FLOORS * (a.rows.n - 1);
        for (int k = 0; k < FLOORS; k++) {
            assert_near(u[k], x[k], tolerance[i]);
        }
        assert_true(a.results->residual_peak <= 1e-12 * analysis_flow(&a) || i == 2);
        analysis_free(&a);
    }
}

// Contacts on levels and floors of one column, most of them stiff: energy is kept to rounding.
static void contacts_at_levels_keep_the_account_of_energy(void **state) {
    (void)state;
    const char *const law[] = {"linear -k 5e7", "jankowski -k 2e9 -e 0.6",
                               "komodromos -k 5e7 -e 0.5", "stereomechanical -e 0.5",
                               "hunt-crossley -k 2e9 -e 0.4"};
    for (size_t i = 0; i < sizeof law / sizeof law[0]; i++) {
        for (int yields = 0; yields < 2; yields++) {
            struct analysis a =
                analysis_of(DAMPED MOVES "step fixed 0.5ms\n%s"
                                         "contact A:1 B@3m -gap 2mm -law %s\n"
                                         "contact A:2 B@6.8m -gap 3mm -law %s\n"
                                         "contact A:3 B@8m -gap 3mm -law %s\n"
                                         "contact A@7m B:2 -gap 5mm -law %s\n"
                                         "output -every 1\n",
                            yields ? "storey A:all bilinear -yield 900 -hardening 0.05\n" : "",
                            law[i], law[i], law[i], law[i]);
            assert_true(a.results->n_impact > 3);
            assert_true(a.results->residual_peak <= 1e-12 * analysis_flow(&a));
            assert_int_equal(a.results->totals.unsolved, 0);
            analysis_free(&a);
        }
    }
}

// Newmark's method with short steps tends to what Dormand and Prince's gives.
static void both_integrators_agree_on_impacts_at_levels(void **state) {
    (void)state;
    double force[3][2];
    const char *const step[] = {"step fixed 0.2ms\n", "step fixed 0.1ms\n",
                                "integrator dormand-prince\nstep adaptive -tolerance 1e-9\n"};
    for (int i = 0; i < 3; i++) {
        struct analysis a = analysis_of(
            DAMPED "initial A:1:3 -velocity 0.8\nduration 0.4\n%s"
                   "contact A:2 B@6.8m -gap 3mm -law linear -k 5e6\n"
                   "contact A@7.5m B:2 -gap 6mm -law hunt-crossley -n 1 -k 3e6 -e 0.7\n",
            step[i]);
        for (int k = 0; k < 2; k++) {
            force[i][k] = a.results->link[k].force;
            assert_true(a.results->link[k].impacts > 0);
        }
        analysis_free(&a);
    }
    for (int k = 0; k < 2; k++) {
        const double error[] = {fabs(force[0][k] / force[2][k] - 1.0),
                                fabs(force[1][k] / force[2][k] - 1.0)};
        assert_true(error[0] < 1e-3);
        assert_true(error[1] < 0.6 * error[0] || error[1] < 1e-6);
    }
}

// A body at rest on a level is held by the force that balances the load: R = F / 1 at the level,
// which loads the floors by the weights.
static void a_body_rests_on_a_level(void **state) {
    (void)state;
    struct analysis a = analysis_of(
        PAIR "load A:2 constant 500\nload A:1 constant 300\nduration 20\nstep fixed 5ms\n"
             "damping A rayleigh 20%%\ndamping B rayleigh 20%%\n"
             "contact A:2 B@6.8m -gap 0 -law stereomechanical -e 0.2\n"
             "contact A:1 B@3m -gap 0 -law stereomechanical -e 0.2\n");
    const long last = a.rows.n - 1;
    const double *f = a.rows.force + 2 * last, *u = a.rows.displacement + FLOORS * last;
    assert_true(f[0] > 1.0 && f[1] > 1.0);
    assert_near(u[1], (1.0 - SHARE) * u[3] + SHARE * u[4], 1e-9);
    assert_near(u[0], 0.75 * u[3], 1e-9);
    // Statics of B: the storeys bear the forces at the levels.
    assert_near(1.5e5 * (u[4] - u[3]), SHARE * f[0], 1e-5 * f[0]);
    assert_near(2e5 * u[3], f[0] + 0.75 * f[1], 1e-5 * f[0]);
    analysis_free(&a);
}

// A brace from floor 1 to floor 3 and one to a level share floors with each other.
static void links_within_a_building_agree_with_a_dense_integration(void **state) {
    (void)state;
    const double b[][FLOORS] = {
        {1, 0, -1, 0, 0}, {0, 1, 0, 0, 0}, {-0.5, -0.5, 1, 0, 0}, {0, 0, 0, 0.25, 0}};
    const struct dense s = {4, b, 4e5, 300.0};
    double x[2 * FLOORS] = {
        [FLOORS] = 0.8, [FLOORS + 1] = 0.8, [FLOORS + 2] = 0.8, [FLOORS + 3] = 1.0};
    for (int n = 0; n < 20000; n++) {
        dense_step(&s, 5e-5, x);
    }
    struct analysis a =
        analysis_of(PAIR "initial A:1:3 -velocity 0.8\ninitial B:1 -velocity 1\nduration 1\n"
                         "link A:1 A:3 -stiffness 4e5 -dashpot 300\n"
                         "link A:0 A:2 -stiffness 4e5 -dashpot 300\n"
                         "link A:3 A@4.5m -stiffness 4e5 -dashpot 300\n"
                         "link B@3m B@2m -stiffness 4e5 -dashpot 300\n"
                         "integrator dormand-prince\nstep adaptive -tolerance 1e-11\n");
    for (int k = 0; k < FLOORS; k++) {
        assert_near(a.rows.displacement[FLOORS * (a.rows.n - 1) + k], x[k], 1e-9);
    }
    analysis_free(&a);
}

static void runs_with_levels_have_the_same_bits_in_ensembles(void **state) {
    (void)state;
    enum { N = 4 };
    struct ensemble_member member[N];
    memset(member, 0, sizeof member);
    for (int k = 0; k < N; k++) {
        member[k].model =
            analysis_model(DAMPED MOVES "contact A:2 B@6.8m -gap %d -law linear -k 5e6\n"
                                        "step fixed 1ms\n",
                           k);
    }
    const struct observer observer = {0};
    assert_false(ensemble_suits(member[0].model));
    ensemble_run(member, N, &observer);
    for (int k = 0; k < N; k++) {
        struct results *alone = run(member[k].model);
        assert_int_equal(member[k].status, STATUS_OK);
        assert_same_bits(member[k].model, member[k].results, alone);
        results_free(alone);
        results_free(member[k].results);
        model_free((struct model *)member[k].model);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_row_of_one_floor_has_the_bits_of_the_floor),
        cmocka_unit_test(a_level_at_a_floor_is_that_floor),
        cmocka_unit_test(a_level_is_a_weighted_pair_of_floors),
        cmocka_unit_test(a_rigid_impact_at_a_level_keeps_momentum_and_restitution),
        cmocka_unit_test(links_at_levels_agree_with_a_dense_integration),
        cmocka_unit_test(contacts_at_levels_keep_the_account_of_energy),
        cmocka_unit_test(both_integrators_agree_on_impacts_at_levels),
        cmocka_unit_test(a_body_rests_on_a_level),
        cmocka_unit_test(links_within_a_building_agree_with_a_dense_integration),
        cmocka_unit_test(runs_with_levels_have_the_same_bits_in_ensembles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
