// SPDX-License-Identifier: GPL-3.0-or-later
// A floor strikes a column between two floors of its neighbour.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "model/link_end.h"
#include "model/struck_column.h"
#include "support/analysis.h"
#include "support/support.h"

// One mass on a spring strikes one of the four clamped columns of the second of three storeys. The
// numbers are of an independent program: Runge-Kutta steps of 2 us, with the instants of closure
// located, and OpenSees beam elements within 5e-5.
static const struct {
    double level;  // [m] above the ground; the storey is from 3 to 6 m
    const char *law;
    int impacts;
    double force, impulse;      // [N] [N s]
    double striking, floor[3];  // [m] largest displacements
} struck[] = {
    {4.5,
     "linear -k 3e8",
     2,
     918281.5693,
     40664.30862,
     0.009266982614,
     {0.00591785063, 0.007496764553, 0.01135742058}},
    {4.5,
     "hertz -k 5e9",
     2,
     953442.7421,
     38364.56565,
     0.009445944676,
     {0.005875014746, 0.007417349369, 0.01123922378}},
    {3.75,
     "linear -k 3e8",
     3,
     964933.3774,
     29493.17403,
     0.008133673414,
     {0.006323849687, 0.005979596561, 0.009805028803}},
    {3.75,
     "hertz -k 5e9",
     2,
     1027597.55,
     29057.54285,
     0.008365912264,
     {0.006255731524, 0.005912938785, 0.009683528401}},
    {3.3,
     "linear -k 3e8",
     3,
     997071.0833,
     40109.53712,
     0.01153850992,
     {0.00601529348, 0.006205248443, 0.009068448535}},
    {3.3,
     "hertz -k 5e9",
     3,
     1106317.799,
     36749.48713,
     0.01150403079,
     {0.005973175047, 0.006177357906, 0.008905322964}},
};
enum { N_STRUCK = sizeof struck / sizeof struck[0] };

// Largest and smallest shears below and above [N], moments below, at the point and above [N m].
static const double forces[N_STRUCK][COLUMN_FORCE_COUNT][2] = {
    {{472858.6502, -93005.31847},
     {189579.5454, -472715.6504},
     {354697.6238, -146684.4188},
     {354590.3627, -34159.99316},
     {251045.06, -354483.1163}},
    {{480016.8081, -75522.66201},
     {151741.2863, -479917.6646},
     {360049.7953, -127494.4079},
     {359975.4176, -7005.374385},
     {221524.4029, -359901.0793}},
    {{808878.1096, -233259.2215},
     {150092.7351, -194729.4733},
     {381499.9659, -300141.6045},
     {235556.8575, -118653.871},
     {219091.1149, -284345.2359}},
    {{839284.8154, -196636.153},
     {138553.9112, -195728.9517},
     {398800.9483, -281342.4152},
     {241776.1018, -103422.8708},
     {209145.3429, -278481.8199}},
    {{952597.5477, -188997.9391},
     {109574.006, -177955.2918},
     {289287.2507, -268698.7425},
     {213938.5404, -127984.6612},
     {168731.8793, -266541.2113}},
    {{1042897.026, -177342.1504},
     {111246.2765, -179338.815},
     {287275.3612, -267954.0825},
     {215398.9012, -129454.9635},
     {171697.823, -268816.6426}},
};

static const char buildings[] =
    "units N m s\n"
    "building A -floors 1 -mass 100000 -stiffness 30e6 -height 4.5m\n"
    "building B -floors 3 -mass 60000 -stiffness 113777777.8 -height 3m\n"
    "duration 0.3\n";

static void assert_struck(int i, const char *step, double rtol, double force_rtol) {
    struct analysis a =
        analysis_of("%scolumn B@%gm -name c1 -E 30e9 -I 0.002133333333 -mass 600\n"
                    "contact A:1 B@%gm -gap 1mm -law %s\ninitial A:1 -velocity 0.3\n%s",
                    buildings, struck[i].level, struck[i].level, struck[i].law, step);
    const struct results *r = a.results;
    assert_int_equal(r->link[0].impacts, struck[i].impacts);
    assert_close(r->link[0].force, struck[i].force, rtol);
    assert_close(r->link[0].impulse, struck[i].impulse, rtol);
    assert_close(r->peak[PEAK_DISPLACEMENT][0], struck[i].striking, rtol);
    for (int k = 0; k < 3; k++) {
        assert_close(r->peak[PEAK_DISPLACEMENT][1 + k], struck[i].floor[k], rtol);
    }
    for (enum column_force q = 0; q < COLUMN_FORCE_COUNT; q++) {
        const struct column_peak *p = &r->column[0][q];
        const double most = fmax(forces[i][q][0], -forces[i][q][1]);
        assert_near(p->max, forces[i][q][0], force_rtol * most);
        assert_near(p->min, forces[i][q][1], force_rtol * most);
        assert_true(p->max_time > 0.0 && p->min_time > 0.0 && p->max_time != p->min_time);
    }
    analysis_free(&a);
}

static void forces_and_motions_are_those_of_an_independent_program(void **state) {
    (void)state;
    for (int i = 0; i < N_STRUCK; i++) {
        // The column rings without damping, by up to 200 periods: fixed steps shift them.
        assert_struck(i, "step fixed 5us", 5e-5, 1e-3);
        assert_struck(i, "step adaptive -tolerance 1e-10", 1e-6, 2e-6);
    }
}

// The same from the other side: the column is on the left of its contact.
static void the_column_may_be_on_the_left(void **state) {
    (void)state;
    struct analysis a[2] = {
        analysis_of("%scolumn B@4.5m -name c1 -EI 64e6 -mass 600\n"
                    "contact A:1 B@4.5m -gap 1mm -law hertz -k 5e9\n"
                    "initial A:1 -velocity 0.3\nstep fixed 50us",
                    buildings),
        analysis_of("units N m s\nduration 0.3\n"
                    "building B -floors 3 -mass 60000 -stiffness 113777777.8 -height 3m\n"
                    "building A -floors 1 -mass 100000 -stiffness 30e6 -height 4.5m\n"
                    "column B@4.5m -name c1 -EI 64e6 -mass 600\n"
                    "contact B@4.5m A:1 -gap 1mm -law hertz -k 5e9\n"
                    "initial A:1 -velocity -0.3\nstep fixed 50us"),
    };
    assert_true(a[0].results->link[0].force > 9e5);
    assert_close(a[1].results->link[0].force, a[0].results->link[0].force, 1e-11);
    for (int k = 0; k < 3; k++) {
        assert_close(a[1].results->peak[PEAK_DISPLACEMENT][k],
                     a[0].results->peak[PEAK_DISPLACEMENT][1 + k], 1e-11);
    }
    analysis_free(&a[0]);
    analysis_free(&a[1]);
}

// Two columns at one level are a column of twice the values; at rest, w is where no force is.
static void columns_that_are_struck_together_add_up(void **state) {
    (void)state;
    struct model *two =
        analysis_model("%scolumn B@3.75m -name c -EI 32e6 -mass 300 -n 2 -damping 5%%\n"
                       "initial B:2 -displacement 1mm\nstep fixed 1ms",
                       buildings);
    assert_int_equal(two->n_building, 2);
    assert_int_equal(two->n_body, 3);
    assert_int_equal(two->n_column, 1);
    const struct struck_column *c = two->column;
    const double k = 3.0 * 64e6 * 27.0 / (pow(0.75, 3.0) * pow(2.25, 3.0));
    assert_close(c->stiffness, k, 1e-14);
    assert_close(c->dashpot, 0.1 * sqrt(k * 600.0), 1e-14);
    const struct link *spring = &two->link[two->n_link - 1];
    const struct contact_response r = spring->law->force(spring->constant, NULL, 1e-3, 2.0);
    assert_close(r.force, 1e-3 * k + 2.0 * c->dashpot, 1e-14);
    assert_close(c->weight, 0.15625, 1e-14);
    assert_close(two->displacement[4], 0.15625e-3, 1e-14);
    assert_close(two->mass[4], 600.0, 0.0);
    model_free(two);
}

// Stiffness of the point and end forces of a unit load at it, the floors at rest, of an independent
// program with beam elements: E I = 64 MN m2, h = 3 m.
static void a_load_at_the_point_is_shared_by_both_ends(void **state) {
    static const struct {
        double share, stiffness, force[COLUMN_FORCE_COUNT];
    } rows[] = {
        {0.5, 455111111.1, {0.5, -0.5, 0.375, 0.375, -0.375}},
        {0.25, 1078781893.0, {0.84375, -0.15625, 0.421875, 0.2109375, -0.140625}},
        {0.1, 9754610578.0, {0.972, -0.028, 0.243, 0.0486, -0.027}},
        {0.75, 1078781893.0, {0.15625, -0.84375, 0.140625, 0.2109375, -0.421875}},
    };
    (void)state;
    for (int i = 0; i < 4; i++) {
        struct model *m =
            analysis_model("%scolumn B@%gm -name c -EI 63999999.99 -mass 600\nstep fixed 1ms",
                           buildings, 3.0 + 3.0 * rows[i].share);
        const struct struck_column *c = m->column;
        assert_close(c->stiffness, rows[i].stiffness, 1e-9);
        for (enum column_force q = 0; q < COLUMN_FORCE_COUNT; q++) {
            assert_close(c->force[(ptrdiff_t)q * c->n_dof] / c->stiffness, rows[i].force[q], 1e-12);
        }
        model_free(m);
    }
}

// A foundation carries the column along, without a force in it.
static void on_a_foundation_it_moves_with_the_slab(void **state) {
    (void)state;
    // Without a column, the level itself.
    static const char *const column[] = {"column B@%gm -name c -EI 6e7 -mass 600\n",
                                         "column B@%gm -name c -line 1 -mass 600\n", ""};
    for (int k = 0; k < 6; k++) {
        const double level = k % 2 == 0 ? 1.0 : 4.5;
        char text[128];
        snprintf(text, sizeof text, column[k / 2], level);
        struct model *m = analysis_model(
            "units N m s\nbuilding B -floors 2 -mass 60t -height 3.4m 3.1m\n"
            "frame B -bays 6 -modulus 30e9\ncolumns B:1:2 -I 2e-3 -A 0.1\nbeams B:1:2 -I 3e-3\n%s"
            "foundation B -mass 100t -inertia 1e6 -sway 4e8 -rocking 2e10\n"
            "contact wall B@%gm -gap 1m -law linear -k 1e6\nduration 1\nstep fixed 1ms\n",
            text, level);
        const double sway = 2e-3, roof = 5e-3;  // displacements of the slab and by rocking
        const double u[] = {sway + roof * 3.4 / 6.5, sway + roof, sway, roof,
                            sway + roof * level / 6.5};
        for (int i = 0; i < m->n_link; i++) {
            assert_near(link_at(&m->link[i], i == 0, u), u[4], 1e-15);
        }
        for (enum column_force q = 0; m->n_column > 0 && q < COLUMN_FORCE_COUNT; q++) {
            assert_near(struck_column_force(m->column, q, u, 0), 0.0, 1e-9 * 6e7 * 1e-3);
        }
        assert_int_equal(m->n_column, k < 4);
        model_free(m);
    }
}

static const char two_buildings[] =
    "units kN m s\nbuilding A -floors 3 -mass 90t -stiffness 60MN/m -height 4.25m\n"
    "building B -floors 4 -mass 120t -stiffness 110MN/m -height 3.25m\n"
    "damping A rayleigh 5%\ndamping B rayleigh 5%\n";
static const char shaken[] = "ground record input/records/ELCENTRO_1940_NS.AT2 -scale 2\n"
                             "duration 6\nstep fixed 0.5ms\n";

static void columns_by_level_are_those_written_out_by_hand(void **state) {
    (void)state;
    static const char section[] = "-E 30GPa -I 0.002m^4 -mass 600kg -n 3 -damping 2%";
    static const char law[] = "-gap 8mm -law jankowski -k 1e9N/m^1.5 -e 0.6";
    struct analysis a[2] = {
        analysis_of("%scolumn B -name b %s\ncolumn A:1:2 -name a %s\n"
                    "contact A B -by-level -name c %s\n%s",
                    two_buildings, section, section, law, shaken),
        analysis_of("%scolumn A@3.25m -name a@3.25m %s\ncolumn B@4.25m -name b@4.25m %s\n"
                    "column A@6.5m -name a@6.5m %s\ncolumn B@8.5m -name b@8.5m %s\n"
                    "contact A@3.25m B:1 -name c:1 %s\ncontact A:1 B@4.25m -name c:2 %s\n"
                    "contact A@6.5m B:2 -name c:3 %s\ncontact A:2 B@8.5m -name c:4 %s\n"
                    "contact A@9.75m B:3 -name c:5 %s\ncontact A:3 B:4 -name c:6 %s\n%s",
                    two_buildings, section, section, section, section, law, law, law, law, law, law,
                    shaken),
    };
    assert_int_equal(a[0].model->n_column, 4);
    assert_int_equal(a[0].model->n_contact, 6);
    assert_true(a[0].results->link[1].impacts > 0);
    assert_string_equal(a[0].model->column[3].name, a[1].model->column[3].name);
    analysis_assert_same(a[0].model, a[0].results, a[1].results);
    analysis_free(&a[0]);
    analysis_free(&a[1]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forces_and_motions_are_those_of_an_independent_program),
        cmocka_unit_test(the_column_may_be_on_the_left),
        cmocka_unit_test(columns_that_are_struck_together_add_up),
        cmocka_unit_test(a_load_at_the_point_is_shared_by_both_ends),
        cmocka_unit_test(on_a_foundation_it_moves_with_the_slab),
        cmocka_unit_test(columns_by_level_are_those_written_out_by_hand),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
