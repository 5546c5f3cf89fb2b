// SPDX-License-Identifier: GPL-3.0-or-later
// Frames and walls: their condensation and the forces of their members, against independent
// solutions, published numbers and closed forms. Their motions are in test_reference.c.
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "model/forces.h"
#include "support/analysis.h"
#include "support/support.h"

#define STILL "step fixed 1ms\nduration 1\ninitial A:1 -velocity 1\n"

// SAP2000's verification example 1 (ETABS example 7), kip and in.
#define SAP2000                                                                                    \
    "building A -floors 7 -mass 0.49kip*s^2/in -height 2*162in 5*156in\n"                          \
    "frame A -bays 2*360in -modulus 29500ksi\n"                                                    \
    "columns A:1:3 -I 3230in^4 -A 72.3in^2 -lines 1 3\n"                                           \
    "columns A:4:5 -I 2670in^4 -A 62.1in^2 -lines 1 3\n"                                           \
    "columns A:6:7 -I 2150in^4 -A 51.7in^2 -lines 1 3\n"                                           \
    "columns A:1:3 -I 3910in^4 -A 84.4in^2 -lines 2\n"                                             \
    "columns A:4:5 -I 3230in^4 -A 72.3in^2 -lines 2\n"                                             \
    "columns A:6:7 -I 2670in^4 -A 62.1in^2 -lines 2\n"                                             \
    "beams A:1:7 -I 2*5120in^4 2*4020in^4 3*3330in^4\n"

// A frame or wall under loads on its floors.
struct statics {
    struct model *model;
    const struct building *building;
    double u[16], drift[16], force[2048];
};
// Drifts and forces of the first building under these loads (n_floor).
static struct statics statics_of(struct model *m, const double *load) {
    struct statics s = {.model = m, .building = &m->building[0]};
    const struct building *g = s.building;
    const size_t n = (size_t)g->n_dof;
    double stiffness[256], shear[16];
    assert_true(n <= 16 && g->n_force <= 2048);
    for (size_t i = n; i-- > 0;) {
        shear[i] = load[i] + (i + 1 < n ? shear[i + 1] : 0.0);
    }
    for (size_t i = 0; i < n * n; i++) {
        stiffness[i] = g->part_stiffness[i] + (i % (n + 1) == 0 ? g->spring[i / (n + 1)] : 0.0);
    }
    gsl_matrix_view k = gsl_matrix_view_array(stiffness, n, n);
    gsl_vector_view x = gsl_vector_view_array(s.drift, n);
    gsl_vector_const_view v = gsl_vector_const_view_array(shear, n);
    assert_int_equal(gsl_linalg_cholesky_decomp1(&k.matrix), 0);
    assert_int_equal(gsl_linalg_cholesky_solve(&k.matrix, &v.vector, &x.vector), 0);
    for (size_t i = 0; i < n; i++) {
        s.u[i] = s.drift[i] + (i > 0 ? s.u[i - 1] : 0.0);
    }
    forces_at(g, s.drift, NULL, NULL, s.force);
    return s;
}

// A force of a member of the first part.
static double force_of(const struct statics *s, const char *name, int which) {
    const struct building *g = s->building;
    const struct plane_frame *f = frame_of(&g->part[0]);
    for (int i = 0; i < f->n_member; i++) {
        if (strcmp(frame_member_name(&f->member[i], s->model->deck->arena), name) == 0) {
            return s->force[forces_of_members(g, 0, which) + i];
        }
    }
    fail_msg("there is no %s", name);
    return NAN;
}

struct member_forces {
    const char *name;
    double force[FRAME_FORCES];  // NAN: none
};

static void assert_statics(struct statics *s, const double *u, const struct member_forces *want,
                           size_t n, double size) {
    for (int i = 0; i < s->building->n_dof; i++) {
        assert_close(s->u[i], u[i], 1e-9);
    }
    for (size_t i = 0; i < n; i++) {
        for (int q = 0; q < FRAME_FORCES; q++) {
            if (!isnan(want[i].force[q])) {
                assert_near(force_of(s, want[i].name, q), want[i].force[q], 1e-9 * size);
            }
        }
    }
    model_free(s->model);
}

static void assert_periods(const char *deck, const double *period, int n, double rtol) {
    struct model *m = analysis_model("%s" STILL, deck);
    assert_int_equal(m->building[0].n_dof, n);
    for (int i = 0; i < n; i++) {
        assert_close(2.0 * acos(-1.0) / m->building[0].omega[i], period[i], rtol);
    }
    model_free(m);
}

#define UNIFORM                                                                                    \
    "building A -floors 5 -mass 120e3 -height 3\n"                                                 \
    "frame A -bays 3*6 -modulus 30e9 -columns-inextensible\n"                                      \
    "columns A:1:5 -I 0.002133333333\nbeams A:1:5 -I 0.003125\n"
#define SMALL                                                                                      \
    "building A -floors 4 -mass 52538.05057 -height 2*162in 2*156in\n"                             \
    "frame A -bays 360in -modulus 203395340100\n"                                                  \
    "columns A:1:4 -I 3910in^4 -A 84.4in^2\nbeams A:1:4 -I 5120in^4\n"
#define WALL8                                                                                      \
    "building A -floors 8 -mass 250e3 -height 3.2\n"                                               \
    "wall A -EI 4*93.75e9 4*75e9 -GA 4*15.625e9 4*12.5e9\n"

// Independent solutions, which agree with OpenSees to 1e-12.
static void periods_are_those_of_independent_solutions(void **state) {
    (void)state;
    assert_periods(SAP2000,
                   (double[]){1.273211127, 0.4312784709, 0.2420431888, 0.1601788402, 0.1189895088,
                              0.09506379772, 0.07951474027},
                   7, 1e-9);
    assert_periods(UNIFORM,
                   (double[]){1.120273566, 0.3586518871, 0.2027200291, 0.1388249259, 0.1102634281},
                   5, 1e-9);
    assert_periods(SMALL, (double[]){0.6959018716, 0.2074169637, 0.1096742565, 0.07462890309}, 4,
                   1e-9);
    assert_periods(WALL8,
                   (double[]){1.236906893, 0.2261020478, 0.09258003093, 0.05552716841,
                              0.04010642206, 0.03222987642, 0.02857614826, 0.02546593944},
                   8, 1e-9);
}

// The same solutions.
static void forces_of_members_are_those_of_independent_solutions(void **state) {
    (void)state;
    struct statics s = statics_of(analysis_model(SAP2000 STILL),
                                  (double[]){11120.55404, 22241.10808, 33361.66211, 44482.21615,
                                             55602.77019, 66723.32423, 88964.43231});
    assert_statics(&s,
                   (double[]){0.004226827219, 0.01068335875, 0.01702482613, 0.02346023553,
                              0.02916452503, 0.03393697028, 0.03684922794},
                   (struct member_forces[]){
                       {"column_1_1", {262653.2665, 115719.0546, 91954.00046, 311316.5033}},
                       {"column_1_2", {355359.532, 214902.6428, 138588.0662, 0}},
                       {"column_1_3", {262653.2665, 115719.0546, 91954.00046, -311316.5033}},
                       {"column_4_2", {233874.9596, 250047.6067, 122128.6509, 0}},
                       {"column_7_1", {27571.79681, 59626.83392, 22006.51896, 12418.86132}},
                       {"beam_1_1", {-288185.6646, -266141.0156, -60621.9029, NAN}},
                       {"beam_4_1", {-239632.9269, -224698.0806, -50779.85647, NAN}},
                       {"beam_7_2", {-53931.23401, -59626.83392, -12418.86132, NAN}},
                   },
                   8, 4e5);
    s = statics_of(analysis_model(UNIFORM STILL), (double[]){20e3, 40e3, 60e3, 80e3, 100e3});
    assert_statics(
        &s, (double[]){0.004752316324, 0.01144879357, 0.01741285012, 0.02189308127, 0.02446835453},
        (struct member_forces[]){
            {"column_1_1", {132699.8615, 62634.22646, 65111.36264, 159721.7946}},
            {"column_1_2", {152477.1362, 102188.7759, 84888.63736, -24224.38302}},
            {"column_2_3", {133290.3035, 131729.3254, 88339.8763, 16981.7287}},
            {"column_3_2", {108503.9572, 118089.517, 75531.15808, -10791.85644}},
            {"column_5_4", {16401.58753, 35634.72593, 17345.43782, -11102.2187}},
            {"beam_1_1", {-139467.5027, -124982.194, -44074.94945, NAN}},
            {"beam_3_2", {-92864.74801, -92864.74801, -30954.916, NAN}},
            {"beam_5_3", {-30978.58629, -35634.72593, -11102.2187, NAN}},
        },
        8, 2e5);
    s = statics_of(analysis_model(WALL8 STILL),
                   (double[]){100e3, 200e3, 300e3, 400e3, 500e3, 600e3, 700e3, 800e3});
    assert_statics(&s,
                   (double[]){0.0040927232, 0.01404281742, 0.02861228942, 0.04663305102,
                              0.06744296107, 0.09008366933, 0.1136193536, 0.1373763356},
                   (struct member_forces[]){
                       {"wall_1_1", {65.28e6, 3.6e6 * 3.2 - 65.28e6, 3.6e6, NAN}},
                       {"wall_8_1", {0.8e6 * 3.2, 0, 0.8e6, NAN}},
                   },
                   2, 6e7);
}

// As SAP2000's verification manual has them, to their digits.
static void the_frame_of_sap2000_has_its_published_answers(void **state) {
    (void)state;
    struct statics s = statics_of(analysis_model("units kip in s\n" SAP2000 STILL),
                                  (double[]){2.5, 5, 7.5, 10, 12.5, 15, 20});
    assert_near(s.u[6], 1.45076, 5e-6);
    assert_near(force_of(&s, "column_1_1", FRAME_NORMAL), 69.99, 5e-3);
    assert_near(force_of(&s, "column_1_1", FRAME_MOMENT_I), 2324.68, 5e-3);
    model_free(s.model);
    assert_periods("units kip in s\n" SAP2000,
                   (double[]){1.2732, 0.4313, 0.2420, 0.1602, 0.1190, 0.0951, 0.0795}, 7, 7e-4);
}

// Compares the stiffness on drifts of the first building with a diagonal one.
static void assert_shear_building(struct model *m, const double *spring, double rtol) {
    const struct building *g = &m->building[0];
    const int n = g->n_dof;
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) {
            assert_near(g->part_stiffness[i * n + j], i == j ? spring[i] : 0.0, rtol * spring[i]);
        }
    }
    model_free(m);
}

static void a_frame_with_rigid_beams_is_the_shear_building(void **state) {
    (void)state;
    const double k1 = 12 * 30e9 * 3 * 2e-3 / 64, k2 = 12 * 30e9 * 3 * 1e-3 / 27;
    assert_shear_building(
        analysis_model("building A -floors 3 -mass 1e5 -height 4 2*3\n"
                       "frame A -bays 6 5 -modulus 30e9 -columns-inextensible\n"
                       "columns A:1:3 -I 2e-3 2*1e-3\nbeams A:1:3 -I 1e10\n" STILL),
        (double[]){k1, k2, k2}, 1e-9);
}

static void a_wall_that_does_not_bend_is_the_shear_building(void **state) {
    (void)state;
    assert_shear_building(analysis_model("building A -floors 3 -mass 1e5 -height 4 2*3\n"
                                         "wall A -EI 1e24 -GA 4e9 2*3e9\n" STILL),
                          (double[]){1e9, 1e9, 1e9}, 1e-9);
    assert_shear_building(analysis_model("building A -floors 2 -mass 1e5 -height 4 3\n"
                                         "wall A -EI 1e20 -GA 1e8\nwall A:1 -EI 1e20 -GA 2e8\n"
                                         "base A fixed\n" STILL),
                          (double[]){75e6, 1e8 / 3}, 1e-9);
}

static void assert_stiffness(const char *deck, double want) {
    struct model *m = analysis_model("building A -floors 1 -mass 1e5 -height 4\n%s" STILL, deck);
    assert_close(m->building[0].stiffness[0], want, 1e-9);
    model_free(m);
}

#define PORTAL                                                                                     \
    "frame A -bays 6 -modulus 30e9 -columns-inextensible\ncolumns A:1 -I 2e-3\nbeams A:1 -I "      \
    "1e10\n"

static void bases_have_their_closed_forms(void **state) {
    (void)state;
    const double ei = 30e9 * 2e-3, h = 4, spring = 50e6;
    const double fixed = 12 * ei / (h * h * h), pinned = 3 * ei / (h * h * h);
    const double sprung = fixed - 36 * ei * ei / (h * h * h * h) / (4 * ei / h + spring);
    assert_stiffness(PORTAL, 2 * fixed);
    assert_stiffness(PORTAL "base A fixed\n", 2 * fixed);
    assert_stiffness(PORTAL "base A pinned\n", 2 * pinned);
    assert_stiffness(PORTAL "base A -rotation 50e6\n", 2 * sprung);
    assert_stiffness(PORTAL "base A pinned\nbase A -rotation 50e6 -lines 2\n", pinned + sprung);
    const double bends = h * h * h / (3 * ei), shears = h / 1e8, turns = h * h / spring;
    assert_stiffness("wall A -EI 60e6\n", 1 / bends);
    assert_stiffness("wall A -EI 60e6 -GA 1e8\n", 1 / (bends + shears));
    assert_stiffness("wall A -EI 60e6 -GA 1e8\nbase A -rotation 50e6\n",
                     1 / (bends + shears + turns));
    assert_stiffness(PORTAL "wall A -EI 60e6\nbase A pinned -lines 1 2\n", 2 * pinned + 1 / bends);
}

static void long_columns_of_large_area_keep_their_lengths(void **state) {
    (void)state;
    struct model *a = analysis_model(UNIFORM STILL);
    struct model *b = analysis_model("building A -floors 5 -mass 120e3 -height 3\n"
                                     "frame A -bays 3*6 -modulus 30e9\n"
                                     "columns A:1:5 -I 0.002133333333 -A 1e9\n"
                                     "beams A:1:5 -I 0.003125\n" STILL);
    for (int i = 0; i < 25; i++) {
        assert_close(a->building[0].part_stiffness[i], b->building[0].part_stiffness[i], 1e-9);
    }
    model_free(a);
    model_free(b);
}

// A uniform wall that bends, tied at its floors to a building that shears, of many storeys: ratios
// of periods of the continuous beam with alpha = H sqrt(GA/EI), from its characteristic equation.
static void a_wall_beside_shear_storeys_is_the_shear_flexure_beam(void **state) {
    (void)state;
    enum { N = 400 };
    static const struct {
        double alpha, second, third;
    } beam[] = {{1, 5.5366, 15.1622}, {2, 4.5705, 11.8345}, {5, 3.5353, 7.5910},
                {10, 3.2083, 5.9908}, {20, 3.0649, 5.3164}, {50, 3.0114, 5.0566}};
    for (size_t i = 0; i < sizeof beam / sizeof beam[0]; i++) {
        struct model *m =
            analysis_model("building A -floors %d -mass %d*1 0.5 -height %.17g -stiffness %.17g\n"
                           "wall A -EI 1e6\n" STILL,
                           N, N - 1, 1.0 / N, 1e6 * beam[i].alpha * beam[i].alpha * N);
        const double *omega = m->building[0].omega;
        assert_close(omega[1] / omega[0], beam[i].second, 1e-4);
        assert_close(omega[2] / omega[0], beam[i].third, 1e-4);
        model_free(m);
    }
}

// Global equilibrium of a frame with a setback and a column that stands on a beam.
static void normal_forces_are_in_equilibrium_in_irregular_frames(void **state) {
    (void)state;
    static const char *const kind[] = {" -columns-inextensible", ""};
    for (int k = 0; k < 2; k++) {
        const char *area = k == 0 ? "" : " -A 0.1";
        struct model *m =
            analysis_model("building A -floors 4 -mass 1e5 -height 4 3 3.5 3\n"
                           "frame A -bays 6 5 7 -modulus 30e9%s\n"
                           "columns A:1:4 -I 2e-3%s -lines 1\ncolumns A:2:4 -I 1e-3%s -lines 2\n"
                           "columns A:1:2 -I 3e-3%s -lines 3\ncolumns A:1 -I 2e-3%s -lines 4\n"
                           "beams A:1:4 -I 4 3 2 1 -bays 1\nbeams A:1:2 -I 3e-3 -bays 2\n"
                           "beams A:1 -I 2e-3 -bays 3\n" STILL,
                           kind[k], area, area, area, area);
        const double load[] = {1e5, 2e5, 1e5, 3e5}, x[] = {0, 6, 11, 18};
        const struct statics s = statics_of(m, load);
        static const char *const base[] = {"column_1_1", "column_1_3", "column_1_4"};
        double shear = 0, normal = 0, moment = 0;
        for (int i = 0; i < 3; i++) {
            const double n = force_of(&s, base[i], FRAME_NORMAL);
            shear += force_of(&s, base[i], FRAME_SHEAR);
            normal += n;
            moment += force_of(&s, base[i], FRAME_MOMENT_I) - n * x[i == 0 ? 0 : i + 1];
        }
        assert_close(shear, 7e5, 1e-9);
        assert_near(normal, 0, 1e-4);
        assert_close(moment, 1e5 * 4 + 2e5 * 7 + 1e5 * 10.5 + 3e5 * 13.5, 1e-9);
        model_free(m);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(periods_are_those_of_independent_solutions),
        cmocka_unit_test(forces_of_members_are_those_of_independent_solutions),
        cmocka_unit_test(the_frame_of_sap2000_has_its_published_answers),
        cmocka_unit_test(a_frame_with_rigid_beams_is_the_shear_building),
        cmocka_unit_test(a_wall_that_does_not_bend_is_the_shear_building),
        cmocka_unit_test(bases_have_their_closed_forms),
        cmocka_unit_test(long_columns_of_large_area_keep_their_lengths),
        cmocka_unit_test(a_wall_beside_shear_storeys_is_the_shear_flexure_beam),
        cmocka_unit_test(normal_forces_are_in_equilibrium_in_irregular_frames),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
