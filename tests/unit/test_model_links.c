// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts and bilateral links as the statements of a deck make them: who faces whom, names, gaps,
// effective masses.
#include <math.h>
#include <string.h>

#include "support/analysis.h"
#include "support/support.h"

#define REST "\nstep fixed 0.01s\nduration 1s\n"

static const struct link *link_called(const struct model *m, const char *name) {
    for (int i = 0; i < m->n_link; i++) {
        if (strcmp(m->link[i].name, name) == 0) {
            return &m->link[i];
        }
    }
    fail_msg("no link is called %s", name);
    return NULL;
}

static void assert_names(const struct model *m, const char *const *name, int n) {
    assert_int_equal(m->n_link, n);
    for (int i = 0; i < n; i++) {
        assert_string_equal(m->link[i].name, name[i]);
    }
}

static void contacts_join_all_levels_that_both_buildings_have(void **state) {
    (void)state;
    struct model *m = analysis_model("building A -floors 3 -mass 2 -stiffness 800\n"
                                     "building B -floors 2 -mass 6 -stiffness 800\n"
                                     "contact A B -gap 10mm 20mm -law linear -k 1e6" REST);
    static const char *const names[] = {"A:1-B:1", "A:2-B:2"};
    assert_names(m, names, 2);
    for (int i = 0; i < 2; i++) {
        const struct link *l = &m->link[i];
        assert_int_equal(l->dof[0], i);
        assert_int_equal(l->dof[1], 3 + i);
        assert_close(l->gap, 0.01 * (i + 1), 1e-14);
        assert_close(l->mass, 1.5, 1e-14);
        assert_false(l->bilateral || l->moving_ground);
    }
    assert_int_equal(m->n_contact, 2);
    model_free(m);
}

static void floors_of_different_levels_can_face_each_other(void **state) {
    (void)state;
    struct model *m =
        analysis_model("building A -floors 3 -mass 2 -stiffness 800\n"
                       "building B -floors 4 -mass 6 -stiffness 800\n"
                       "contact A:1:3 B:2:4 -gap 0.1 -law linear -k 1\n"
                       "contact A:3 B -gap 0.1 -law linear -k 1 -name same\n"
                       "contact A B:1 -gap 0.1 -law komodromos -k 1 -e 1 -meff 7" REST);
    static const char *const names[] = {"A:1-B:2", "A:2-B:3", "A:3-B:4", "same", "A:1-B:1"};
    assert_names(m, names, 5);
    assert_int_equal(m->link[2].dof[1], 6);
    assert_int_equal(link_called(m, "same")->floor[1], 3);
    assert_close(link_called(m, "A:1-B:1")->mass, 7.0, 1e-14);
    model_free(m);
}

static void a_wall_stands_on_either_side(void **state) {
    (void)state;
    struct model *m = analysis_model("building A -floors 2 -mass 2 3 -stiffness 800\n"
                                     "contact wall A -gap 0.1 0.2 -law linear -k 1 -name left\n"
                                     "contact A:2 wall -gap 0.1 -law linear -k 1" REST);
    static const char *const names[] = {"left:1", "left:2", "A:2-wall"};
    assert_names(m, names, 3);
    const struct link *left = &m->link[1], *right = &m->link[2];
    assert_int_equal(left->building[0], WALL);
    assert_int_equal(left->dof[0], WALL);
    assert_int_equal(left->floor[0], 0);
    assert_int_equal(left->dof[1], 1);
    assert_close(left->mass, 3.0, 1e-14);
    assert_int_equal(right->dof[0], 1);
    assert_int_equal(right->dof[1], WALL);
    model_free(m);
}

static void several_contacts_of_a_name_are_numbered_by_floor(void **state) {
    (void)state;
    struct model *m = analysis_model("building A -floors 4 -mass 2 -stiffness 800\n"
                                     "building B -floors 4 -mass 6 -stiffness 800\n"
                                     "contact A:2,4 B:1,3 -gap 1 -law linear -k 1 -name joint\n"
                                     "contact A:2 B:2 -gap 1 -law linear -k 1\n"
                                     "contact A:2 B:2 -gap 2 -law linear -k 1" REST);
    static const char *const names[] = {"joint:2", "joint:4", "A:2-B:2", "A:2-B:2#2"};
    assert_names(m, names, 4);
    model_free(m);
}

static void bilateral_links_follow_the_contacts(void **state) {
    (void)state;
    struct model *m = analysis_model("units kN m s\n"
                                     "building A -floors 2 -mass 2 -stiffness 800\n"
                                     "building B -floors 2 -mass 2 -stiffness 800\n"
                                     "link A:2 B:2 -stiffness 3MN/m -dashpot 2 -exponent 0.5\n"
                                     "contact A:1 B:1 -gap 1 -law hertz -k 1N/m^1.5" REST);
    static const char *const names[] = {"A:1-B:1", "A:2-B:2"};
    assert_names(m, names, 2);
    assert_int_equal(m->n_contact, 1);
    const struct link *l = &m->link[1];
    assert_true(l->bilateral && l->gap == 0.0);
    struct contact_response r = l->law->force(l->constant, NULL, -0.01, 4.0);
    assert_close(r.force, -30.0 + 2.0 * sqrt(4.0), 1e-13);
    r = m->link[0].law->force(m->link[0].constant, NULL, 0.25, 0.0);
    assert_close(r.force, 0.001 * 0.125, 1e-13);
    model_free(m);
}

static void the_effective_mass_goes_into_the_damping_of_a_law(void **state) {
    (void)state;
    struct model *m = analysis_model(
        "building A -floors 1 -mass 2 -stiffness 800\n"
        "building B -floors 1 -mass 6 -stiffness 800\n"
        "contact A B -gap 1 -law kelvin-voigt -k 100 -zeta 0.2\n"
        "contact A B -gap 1 -law kelvin-voigt -k 100 -zeta 0.2 -meff 6 -name heavy" REST);
    // c = 2 zeta sqrt(k m*)
    assert_close(m->link[0].law->force(m->link[0].constant, NULL, 0.0, 1.0).force,
                 0.4 * sqrt(150.0), 1e-14);
    const struct link *heavy = link_called(m, "heavy");
    assert_close(heavy->law->force(heavy->constant, NULL, 0.0, 1.0).force, 0.4 * sqrt(600.0),
                 1e-14);
    model_free(m);
}

// 1/R = 1/R1 + 1/R2, 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2, k = (4/3) sqrt(R) E*; E A / L.
static void the_stiffness_of_a_contact_follows_from_its_bodies(void **state) {
    (void)state;
    struct model *m = analysis_model(
        "units kN mm s\nbuilding A -floors 1 -mass 2 -stiffness 800\n"
        "contact A wall -gap 1 -law hertz -name flat -k-from hertz -radius1 4m -modulus1 30GPa "
        "-poisson1 0.2\n"
        "contact A wall -gap 1 -law power -n 1.5 -name two -k-from hertz -radius1 3m -radius2 6m "
        "-modulus1 30GPa -modulus2 200GPa -poisson1 0.2 -poisson2 0.3\n"
        "contact A wall -gap 1 -law bilinear -e 0.65 -v0 1m/s -name recipe -k-from hertz "
        "-radius1 4m -modulus1 30GPa -poisson1 0.2\n"
        "contact A wall -gap 1 -law komodromos -e 0.5 -name slab -k-from slab -modulus 30GPa "
        "-area 6m2 -length 12m" REST);
    // In N and m; one kN/mm^1.5 is 1000 * 1000^1.5 N/m^1.5.
    const double kilo = 1000.0 * sqrt(1e9);
    double flat = 4.0 / 3.0 * 2.0 * 30e9 / (2.0 * 0.96);
    double two = 4.0 / 3.0 * sqrt(2.0) / (0.96 / 30e9 + 0.91 / 200e9);
    assert_close(link_called(m, "flat")->value[0], flat / kilo, 1e-13);
    assert_close(link_called(m, "two")->value[0], two / kilo, 1e-13);
    assert_close(link_called(m, "slab")->value[0], 15e9 / 1e6, 1e-13);
    const struct link *recipe = link_called(m, "recipe");
    assert_close(recipe->value[contact_law_row(recipe->law, "kh")], flat / kilo, 1e-13);
    model_free(m);
}

static void a_link_knows_the_restitution_asked_for_and_whether_it_is_exact(void **state) {
    (void)state;
    struct model *m = analysis_model(
        "building A -floors 1 -mass 2 -stiffness 800\n"
        "contact A wall -gap 1 -law jankowski -k 1e6 -e 0.6 -name published\n"
        "contact A wall -gap 1 -law jankowski -k 1e6 -e 0.6 -calibrate -name exact\n"
        "contact A wall -gap 1 -law jankowski -k 1e6 -zeta 0.3 -name ratio\n"
        "contact A wall -gap 1 -law bilinear -kh 1e6 -e 0.7 -v0 1 -calibrate -name later\n"
        "link A wall -stiffness 5 -name both" REST);
    static const struct {
        const char *name;
        double restitution;
        bool calibrated;
    } want[] = {{"published", 0.6, false},
                {"exact", 0.6, true},
                {"ratio", NAN, false},
                {"later", 0.7, true},
                {"both", NAN, false}};
    for (size_t i = 0; i < sizeof want / sizeof want[0]; i++) {
        const struct link *l = link_called(m, want[i].name);
        assert_true(l->restitution == want[i].restitution || isnan(want[i].restitution));
        assert_int_equal(isnan(l->restitution), isnan(want[i].restitution));
        assert_int_equal(l->calibrated, want[i].calibrated);
    }
    model_free(m);
}

// The curve in the file's units, and the file among those that results must not overwrite.
static void a_curve_is_read_from_a_file_of_its_own_units(void **state) {
    (void)state;
    struct model *m = analysis_model(
        "units kN m s\nbuilding A -floors 2 -mass 2 -stiffness 800\n"
        "contact A wall -gap 1 -law table -file tests/deck/pad.txt -units mm N" REST);
    for (int k = 0; k < 2; k++) {
        const struct link *l = &m->link[k];
        double h[CONTACT_HISTORY_MAX];
        l->law->close(l->constant, 1.0, h);
        assert_close(l->law->force(l->constant, h, 2e-3, 1.0).force, 25e-3, 1e-13);
        assert_close(l->law->force(l->constant, h, 7e-3, 1.0).force, 310e-3, 1e-13);
    }
    assert_non_null(strstr(m->deck->files->path, "pad.txt"));
    model_free(m);
}

static void floors_are_taken_in_the_order_written(void **state) {
    (void)state;
    struct model *m = analysis_model(
        "building A -floors 3 -mass 1 -stiffness 1\nbuilding B -floors 3 -mass 1 -stiffness 1\n"
        "contact A:3,2 B:1,2 -gap 2 3 -law linear -k 1\nstorey A:3,1 bilinear -yield 7 9 "
        "-hardening 0\ninitial A:1 -velocity 1\nstep fixed 0.1\nduration 1\n");
    assert_string_equal(m->link[0].name, "A:3-B:1");
    assert_true(m->link[0].gap == 2.0);
    assert_string_equal(m->link[1].name, "A:2-B:2");
    assert_true(m->link[1].gap == 3.0);
    const struct storey *first = &m->storey[0];
    const struct storey *third = &m->storey[2];
    assert_close(first->law->respond(first->constant, (double[]){0.0}, 100.0, NULL).shear, 9.0,
                 1e-14);
    assert_close(third->law->respond(third->constant, (double[]){0.0}, 100.0, NULL).shear, 7.0,
                 1e-14);
    model_free(m);
}

static void floors_that_do_not_face_each_other_are_warned_about(void **state) {
    (void)state;
    struct model *m =
        analysis_model("building A -floors 2 -mass 1 -stiffness 1 -height 3\n"
                       "building B -floors 2 -mass 1 -stiffness 1 -height 4.5\n"
                       "building C -floors 2 -mass 1 -stiffness 1 -height 3\n"
                       "contact A B -gap 1 -law linear -k 1\ncontact A C -gap 1 -law linear -k 1\n"
                       "initial A:1 -velocity 1\nstep fixed 0.1\nduration 1\n");
    const struct diagnostics *d = &m->deck->diagnostics;
    assert_int_equal(d->n_warning, 2);
    assert_string_equal(
        d->item[0].message,
        "the floors of contact A:1-B:1 (and 1 more) are at 3 and 4.5 m; name the floors that meet, "
        "or write BUILDING@LEVEL where a floor hits columns between two floors");
    assert_string_equal(d->item[1].message, "building B is between the floors of contact A:1-C:1");
    model_free(m);
}

static void floors_that_both_sides_name_are_meant_to_face_each_other(void **state) {
    (void)state;
    static const struct {
        const char *sides;
        int n_warning;
    } known[] = {
        {"A:1 B:1", 0}, {"A:1:2 B:1,2", 0}, {"A:1 B", 1}, {"A B:1", 1}, {"A:all B:all", 1}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        struct model *m = analysis_model("building A -floors 2 -mass 1 -stiffness 1 -height 3\n"
                                         "building B -floors 2 -mass 1 -stiffness 1 -height 4.5\n"
                                         "contact %s -gap 1 -law linear -k 1\n"
                                         "initial A:1 -velocity 1\nstep fixed 0.1\nduration 1\n",
                                         known[i].sides);
        assert_int_equal(m->deck->diagnostics.n_warning, known[i].n_warning);
        model_free(m);
    }
}

static void a_contact_that_begins_closed_has_no_velocity_of_closure(void **state) {
    (void)state;
    struct model *m =
        analysis_model("building A -floors 1 -mass 1 -stiffness 1\n"
                       "building B -floors 1 -mass 1 -stiffness 1\n"
                       "contact A B -gap -1 -law power -n 2 -k 1 -e 0.5 -allow-overlap -name "
                       "still\n"
                       "contact A B -gap -1 -law hertz -k 1 -allow-overlap -name elastic\n"
                       "contact wall A -gap -1 -law power -n 2 -k 1 -e 0.5 -allow-overlap\n"
                       "contact B wall -gap 1 -law power -n 2 -k 1 -e 0.5 -name open\n"
                       "contact A B -gap -1 -law power -n 2 -k 1 -e 1 -allow-overlap -name full\n"
                       "contact A B -gap -1 -law wang -k 1 -e 0.5 -residual 0.1 -allow-overlap\n"
                       "contact A B -gap -1 -law rubber -n 2 -k 1 -c 1 -allow-overlap -name free\n"
                       "contact A B -gap -1 -law rubber -n 2 -k 1 -e 0.5 -allow-overlap -name "
                       "soft\n"
                       "initial A -velocity -0.1\nstep fixed 0.1\nduration 1\n");
    const struct diagnostics *d = &m->deck->diagnostics;
    assert_int_equal(d->n_warning, 2);
    assert_string_equal(d->item[0].message,
                        "contact still is closed at t = 0 and does not approach: power takes -vmin "
                        "for v0 and may hold the bodies together");
    assert_string_equal(d->item[1].message,
                        "contact soft is closed at t = 0 and does not approach: rubber takes -vmin "
                        "for v0 and hardly pushes the bodies apart");
    model_free(m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_stiffness_of_a_contact_follows_from_its_bodies),
        cmocka_unit_test(a_link_knows_the_restitution_asked_for_and_whether_it_is_exact),
        cmocka_unit_test(a_curve_is_read_from_a_file_of_its_own_units),
        cmocka_unit_test(floors_are_taken_in_the_order_written),
        cmocka_unit_test(floors_that_do_not_face_each_other_are_warned_about),
        cmocka_unit_test(floors_that_both_sides_name_are_meant_to_face_each_other),
        cmocka_unit_test(a_contact_that_begins_closed_has_no_velocity_of_closure),
        cmocka_unit_test(contacts_join_all_levels_that_both_buildings_have),
        cmocka_unit_test(floors_of_different_levels_can_face_each_other),
        cmocka_unit_test(a_wall_stands_on_either_side),
        cmocka_unit_test(several_contacts_of_a_name_are_numbered_by_floor),
        cmocka_unit_test(bilateral_links_follow_the_contacts),
        cmocka_unit_test(the_effective_mass_goes_into_the_damping_of_a_law),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
