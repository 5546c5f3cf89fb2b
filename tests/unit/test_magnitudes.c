// SPDX-License-Identifier: GPL-3.0-or-later
// Values in wrong units are warned of where nothing that is built or recorded has them, and only
// there.
#include <string.h>

#include "support/analysis.h"
#include "support/support.h"

// A deck is right but for the one statement that a case replaces.
struct deck_words {
    const char *units, *building, *height, *gap, *ground;
};
static const struct deck_words right = {"kN m s", "-mass 300t -stiffness 345MN/m", "3m", "20mm",
                                        "sine -amplitude 0.35g -frequency 1"};

static struct model *model_of(const struct deck_words *w) {
    return analysis_model("units %s\nbuilding A -floors 4 %s -height %s\n"
                          "building B -floors 3 %s -height %s\n"
                          "contact A B -gap %s -law linear -k 1000MN/m\n"
                          "ground %s\nstep fixed 0.05ms\nduration 5s\n",
                          w->units, w->building, w->height, w->building, w->height, w->gap,
                          w->ground);
}

static const char *or_right(const char *word, const char *other) {
    return word ? word : other;
}

static struct deck_words filled(const struct deck_words *w) {
    return (struct deck_words){
        or_right(w->units, right.units),   or_right(w->building, right.building),
        or_right(w->height, right.height), or_right(w->gap, right.gap),
        or_right(w->ground, right.ground),
    };
}

static void wrong_units_are_warned_of_at_the_first_statement(void **state) {
    (void)state;
    static const struct {
        struct deck_words words;
        int line;
        const char *message;
    } of[] = {
        {{.building = "-mass 300000 -stiffness 345MN/m"},
         2,
         "the first period of building A is 16.87 s, outside 0.04 to 15 s; are its "
         "mass and stiffness in the "
         "units of the deck?"},
        {{.building = "-mass 1kg -stiffness 345MN/m"},
         2,
         "the first period of building A (and 1 more) is 0.000974 s, outside 0.04 to 15 s; are its "
         "mass "
         "and stiffness in the units of the deck?"},
        {{.height = "3000"},
         2,
         "the mean storey height of building A (and 1 more) is 3000 m, outside 0.01 to 200 m; are "
         "its heights in the "
         "units "
         "of the deck?"},
        {{.units = "kN mm s", .height = "3"},
         2,
         "the mean storey height of building A (and 1 more) is 0.003 m, outside 0.01 to 200 m; are "
         "its heights in the "
         "units of the deck?"},
        // 345e6 N/m in a deck of kN: 2 pi / (2 sqrt(345e6 / 300) sin(pi / 18)) and 4 storeys
        {{.building = "-mass 300 -stiffness 345e6"},
         2,
         "the first period of building A (and 1 more) is 0.01687 s, outside 0.04 to 15 s; are its "
         "mass and stiffness in the units of the deck?"},
        {{.gap = "20"},
         4,
         "the gap of contact A:1-B:1 (and 2 more) is 20 m, outside 0 to 5 m; is it in the units of "
         "the deck?"},
        {{.ground = "sine -amplitude 35 -frequency 1"},
         5,
         "the peak of the ground motion sine is 3.569 g, outside 0.0005 to 3 g; are its unit and "
         "its scale right?"},
        {{.units = "kN mm s", .ground = "sine -amplitude 3.5 -frequency 1"},
         5,
         "the peak of the ground motion sine is 0.0003569 g, outside 0.0005 to 3 g; are its unit "
         "and its scale right?"},
    };
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        const struct deck_words words = filled(&of[i].words);
        struct model *m = model_of(&words);
        const struct diagnostics *d = &m->deck->diagnostics;
        assert_int_equal(d->n_warning, 1);
        assert_string_equal(d->item[0].message, of[i].message);
        assert_int_equal(d->item[0].line, of[i].line);
        model_free(m);
    }
}

static void values_at_the_edge_of_what_there_is_are_not_warned_of(void **state) {
    (void)state;
    static const struct deck_words of[] = {
        {0},
        {.building = "-mass 300t -stiffness 1MN/m", .ground = "sine -amplitude 2.75g -frequency 1"},
        {.height = "200m", .gap = "2m"},
        {.building = "-mass 1kg -stiffness 100kN/m", .height = "5cm", .gap = "0.1mm"},
        {.gap = "0", .ground = "sine -amplitude 1gal -frequency 1"},
    };
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        const struct deck_words words = filled(&of[i]);
        struct model *m = model_of(&words);
        assert_int_equal(m->deck->diagnostics.n_warning, 0);
        model_free(m);
    }
}

static void a_yield_in_other_units_than_the_stiffness_is_warned_of(void **state) {
    (void)state;
    static const struct {
        const char *yield, *message;
    } of[] = {
        {"1500kN", NULL},
        {"7kN", NULL},
        {"1500 2*2000 2500", NULL},
        {"1500000", NULL},
        {"1500 1.5 2*1500",
         "storey 2 of building A yields at a drift of 4.35e-06 m; are its yield and stiffness in "
         "the units of the deck?"},
    };
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        struct model *m =
            analysis_model("units kN m s\nbuilding A -floors 4 -mass 300t -stiffness 345MN/m\n"
                           "storey A:all bilinear -yield %s -hardening 0.05\n"
                           "initial A:1 -velocity 1\nstep fixed 1ms\nduration 1s\n",
                           of[i].yield);
        const struct diagnostics *d = &m->deck->diagnostics;
        assert_int_equal(d->n_warning, of[i].message ? 1 : 0);
        if (of[i].message) {
            assert_string_equal(d->item[0].message, of[i].message);
            assert_int_equal(d->item[0].line, 3);
        }
        model_free(m);
    }
}

// One building with the units of a deck, its gravity and an initial state.
static void a_start_or_a_gravity_in_other_units_is_warned_of(void **state) {
    (void)state;
    static const struct {
        const char *units, *gravity, *start, *message;
        int line;
    } of[] = {
        {"kN m s", "9.81", "-displacement 5 -velocity 20", NULL, 0},
        {"kN mm s", "9810", "-displacement -5000 -velocity 20000", NULL, 0},
        {"kN m s", "9.81", "-displacement -20",
         "the initial displacement of building A (and 3 more) is 20 m, outside 0 to 5 m; is it in "
         "the units of the "
         "deck?",
         4},
        {"kN m s", "9.81", "-velocity 500",
         "the initial velocity of building A (and 3 more) is 500 m/s, outside 0 to 20 m/s; is it "
         "in the units of the "
         "deck?",
         4},
        {"kN mm s", "9.81", "-velocity 500",
         "gravity is 0.00981 m/s^2; is it in the units of the deck?", 2},
        {"kN m s", "9810", "-velocity 0.5",
         "gravity is 9810 m/s^2; is it in the units of the deck?", 2},
    };
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        struct model *m = analysis_model("units %s\ngravity %s\n"
                                         "building A -floors 4 -mass 300t -stiffness 345MN/m\n"
                                         "initial A:all %s\nstep fixed 1ms\nduration 1s\n",
                                         of[i].units, of[i].gravity, of[i].start);
        const struct diagnostics *d = &m->deck->diagnostics;
        assert_int_equal(d->n_warning, of[i].message ? 1 : 0);
        if (of[i].message) {
            assert_string_equal(d->item[0].message, of[i].message);
            assert_int_equal(d->item[0].line, of[i].line);
        }
        model_free(m);
    }
}

// 0.35 in kN m s is 0.036 g, as no record is scaled; a unit says that it is meant.
static void a_record_scaled_to_a_bare_number_is_warned_of_below_0_05_g(void **state) {
    (void)state;
    static const struct {
        const char *scaling;
        bool warned;
    } of[] = {{"-pga 0.35", true}, {"-pga 0.35m/s^2", false},    {"-pga 0.35g", false},
              {"-pga 0.5", false}, {"-pga ${0.3 + 0.05}", true}, {"-pga 0.01g", false},
              {"-sa 0.3", true},   {"-sa 0.3g", false},          {"-scale 0.05", false}};
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        char ground[256];
        snprintf(ground, sizeof ground, "record input/records/ELCENTRO_1940_NS.AT2 %s",
                 of[i].scaling);
        const struct deck_words words = filled(&(struct deck_words){.ground = ground});
        struct model *m = model_of(&words);
        const struct diagnostics *d = &m->deck->diagnostics;
        assert_int_equal(d->n_warning, of[i].warned);
        model_free(m);
    }
}

// Where a value replaces the size of the file, that value is looked at besides.
static void a_record_that_is_too_large_is_warned_of_once(void **state) {
    (void)state;
    static const struct {
        const char *scaling;
        int n_warning;
    } of[] = {{"", 1}, {"-scale 0.5", 1}, {"-pga 0.35g", 1}, {"-pga 35", 2}, {"-sa 200", 2}};
    const char *path = support_write("gal.txt", "0\n120\n-340\n90\n50\n-20\n0\n");
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        char ground[512];
        snprintf(ground, sizeof ground, "record %s -unit m/s2 -dt 0.02 %s", path, of[i].scaling);
        const struct deck_words words = filled(&(struct deck_words){.ground = ground});
        struct model *m = model_of(&words);
        const struct diagnostics *d = &m->deck->diagnostics;
        assert_int_equal(d->n_warning, of[i].n_warning);
        assert_non_null(strstr(d->item[0].message, "the largest acceleration is 34.7 g"));
        model_free(m);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_units_are_warned_of_at_the_first_statement),
        cmocka_unit_test(values_at_the_edge_of_what_there_is_are_not_warned_of),
        cmocka_unit_test(a_start_or_a_gravity_in_other_units_is_warned_of),
        cmocka_unit_test(a_yield_in_other_units_than_the_stiffness_is_warned_of),
        cmocka_unit_test(a_record_scaled_to_a_bare_number_is_warned_of_below_0_05_g),
        cmocka_unit_test(a_record_that_is_too_large_is_warned_of_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
