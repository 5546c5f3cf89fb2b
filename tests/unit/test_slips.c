// SPDX-License-Identifier: GPL-3.0-or-later
// What is legal but was rather pasted twice, forgotten or meant otherwise draws one warning.
#include "support/analysis.h"
#include "support/support.h"

#define BUILDINGS                                                                                  \
    "building A -floors 3 -mass 300t -stiffness 345MN/m\n"                                         \
    "building B -floors 3 -mass 200t -stiffness 345MN/m\n"
#define DAMPING "damping A rayleigh 5%\ndamping B rayleigh 5%\n"
#define CONTACT "contact A B -gap 20mm -law linear -k 1000MN/m"
#define RECORD "ground record input/records/ELCENTRO_1940_NS.AT2"
#define STEP "step fixed 1ms\n"

static void one_warning(const char *deck, const char *message, int line) {
    struct model *m = analysis_model("%s", deck);
    const struct diagnostics *d = &m->deck->diagnostics;
    assert_int_equal(d->n_warning, message ? 1 : 0);
    if (message) {
        assert_string_equal(d->item[0].message, message);
        assert_int_equal(d->item[0].line, line);
    }
    model_free(m);
}

static void a_contact_pasted_twice_is_warned_of(void **state) {
    (void)state;
    one_warning(BUILDINGS DAMPING CONTACT "\n" RECORD "\n" STEP CONTACT "\n",
                "contact A:1-B:1#2 (and 2 more) repeats one of the same floors, gap and law, and "
                "adds to its force; give it a -name if that is meant",
                8);
    one_warning(BUILDINGS DAMPING CONTACT "\n" CONTACT " -name two\n" RECORD "\n" STEP, NULL, 0);
    one_warning(BUILDINGS DAMPING CONTACT "\ncontact A B -gap 25mm -law linear -k 1000MN/m\n" RECORD
                                          "\n" STEP,
                NULL, 0);
    one_warning(BUILDINGS DAMPING CONTACT "\ncontact A B -gap 20mm -law linear -k 100MN/m\n" RECORD
                                          "\n" STEP,
                NULL, 0);
    one_warning(BUILDINGS DAMPING "link A B -stiffness 1MN/m\nlink A B -stiffness 1MN/m\n" RECORD
                                  "\n" STEP,
                NULL, 0);
}

static void a_record_that_acts_twice_under_a_building_is_warned_of(void **state) {
    (void)state;
    static const char message[] = "input/records/ELCENTRO_1940_NS.AT2 acts twice at the same time "
                                  "under a building, where it adds up";
    one_warning(BUILDINGS DAMPING RECORD " -pga 0.3g\n" RECORD " -pga 0.2g -buildings B\n" STEP,
                message, 6);
    one_warning(BUILDINGS DAMPING RECORD "\n" RECORD " -scale -0.5 -buildings B\n" STEP, message,
                6);
    one_warning(BUILDINGS DAMPING RECORD "\n" RECORD " -delay 10\n" STEP, NULL, 0);
    one_warning(BUILDINGS DAMPING RECORD
                "\nground record input/records/NAPA_2014_68150_HNE.AT2\n" STEP,
                NULL, 0);
    one_warning(BUILDINGS DAMPING RECORD " -buildings A\n" RECORD " -buildings B\n" STEP, NULL, 0);
}

static void a_building_that_no_ground_motion_acts_under_is_warned_of(void **state) {
    (void)state;
    one_warning(BUILDINGS DAMPING RECORD " -buildings A\n" STEP,
                "no ground motion acts under building B; -buildings does not name it", 5);
    one_warning(BUILDINGS DAMPING "building C -floors 1 -mass 200t -stiffness 345MN/m\n"
                                  "damping C rayleigh 5%\n" RECORD " -buildings B\n" STEP,
                "no ground motion acts under building A (and 1 more); -buildings does not name it",
                7);
    one_warning(BUILDINGS DAMPING "building free -floors 1 -mass 200t -stiffness 0\n" RECORD
                                  " -buildings A B\n" STEP,
                NULL, 0);
    one_warning(BUILDINGS DAMPING "load A:1 sine -amplitude 1MN -frequency 1\nduration 1\n" STEP,
                NULL, 0);
}

static void an_analysis_that_ends_before_the_peak_is_warned_of(void **state) {
    (void)state;
    one_warning(BUILDINGS DAMPING RECORD "\n" STEP "duration 2\n",
                "the analysis ends at 2 s, before the peak of "
                "input/records/ELCENTRO_1940_NS.AT2 at 2.02 s",
                7);
    one_warning(BUILDINGS DAMPING RECORD "\n" STEP "duration 2.02\n", NULL, 0);
}

static void a_building_without_damping_beside_others_is_warned_of(void **state) {
    (void)state;
    one_warning(
        BUILDINGS "damping A rayleigh 5%\n" RECORD "\n" STEP,
        "building B has no damping, although others have; write damping B rayleigh 0 if that is "
        "meant",
        2);
    one_warning(BUILDINGS RECORD "\n" STEP, NULL, 0);
    one_warning(BUILDINGS "damping A rayleigh 5%\ndamping B rayleigh 0\n" RECORD "\n" STEP, NULL,
                0);
    one_warning(BUILDINGS "damping A rayleigh 5%\nlink A B -dashpot 1MN*s/m\n" RECORD "\n" STEP,
                NULL, 0);
    one_warning(BUILDINGS DAMPING "building C -floors 1 -mass 1t -stiffness 0\n" RECORD "\n" STEP,
                NULL, 0);
}

static void a_phase_in_degrees_is_warned_of(void **state) {
    (void)state;
#define SINE "ground sine -amplitude 0.1g -frequency 1 -phase "
#define END "\n" STEP "duration 1\n"
    one_warning(BUILDINGS DAMPING SINE "-90" END, "the phase is -90 rad; write -90deg for degrees",
                5);
    one_warning(BUILDINGS DAMPING SINE "90deg" END, NULL, 0);
    one_warning(BUILDINGS DAMPING SINE "6.28" END, NULL, 0);
    one_warning(BUILDINGS DAMPING SINE "${10 * pi}" END, NULL, 0);
}

static void damping_given_twice_alike_is_warned_of(void **state) {
    (void)state;
    static const char message[] = "the same damping of building A is in line 3 already, and both "
                                  "add up; give the sum in one statement if that is meant";
    one_warning(BUILDINGS DAMPING RECORD "\n" STEP "damping A rayleigh 0.05 -modes 1 2\n", message,
                7);
    one_warning(BUILDINGS DAMPING RECORD "\n" STEP "damping A rayleigh 5% -modes 1 3\n", NULL, 0);
    one_warning(BUILDINGS DAMPING RECORD "\n" STEP "damping A modal 5%\ndamping A dashpot 5\n",
                NULL, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_contact_pasted_twice_is_warned_of),
        cmocka_unit_test(a_record_that_acts_twice_under_a_building_is_warned_of),
        cmocka_unit_test(a_building_that_no_ground_motion_acts_under_is_warned_of),
        cmocka_unit_test(an_analysis_that_ends_before_the_peak_is_warned_of),
        cmocka_unit_test(damping_given_twice_alike_is_warned_of),
        cmocka_unit_test(a_building_without_damping_beside_others_is_warned_of),
        cmocka_unit_test(a_phase_in_degrees_is_warned_of),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
