// SPDX-License-Identifier: GPL-3.0-or-later
// Runs in lockstep against the same runs alone: every result has the same bits.
#include <gsl/gsl_errno.h>
#include <stdlib.h>
#include <string.h>

#include "jostle/ensemble.h"
#include "solve/ensemble/ensemble_lockstep.h"
#include "support/analysis.h"
#include "support/random_deck.h"
#include "support/support.h"

// Runs the members together by some steps, compares each with its run alone, and frees both.
// Returns the number of impacts.
static long compare_by(const struct ensemble_steps *steps, struct ensemble_member *member, int n) {
    long n_impact = 0;
    const struct observer observer = {0};  // the energies of rows are taken, nobody sees them
    ensemble_run_by(steps, member, n, &observer);
    for (int k = 0; k < n; k++) {
        struct results *alone = NULL;
        struct error e = {0};
        int status = analysis_run(member[k].model, &observer, &alone, &e);
        assert_int_equal(member[k].status, status);
        if (status == STATUS_OK) {
            analysis_assert_same(member[k].model, member[k].results, alone);
            n_impact += alone->n_impact;
        } else {
            assert_string_equal(member[k].error.message, e.message);
            assert_null(member[k].results);
        }
        results_free(member[k].results);
        results_free(alone);
    }
    return n_impact;
}

// By all steps that the processor has.
static long compare(struct ensemble_member *member, int n) {
    if (lanes_hold_wide()) {
        compare_by(&ensemble_whole, member, n);
    }
    return compare_by(&ensemble_half, member, n);
}

static void free_models(struct ensemble_member *member, int n) {
    for (int k = 0; k < n; k++) {
        model_free((struct model *)member[k].model);
    }
}

#define PAIR                                                                                       \
    "building A -floors 8 -mass %gt -stiffness 345MN/m\n"                                          \
    "building B -floors 5 -mass 300t -stiffness 345MN/m\n"                                         \
    "damping A rayleigh 5%%\ndamping B rayleigh 5%%\n"                                             \
    "ground %s\nduration %gs\nstep fixed %g\n"                                                     \
    "contact A B -gap %gmm -law %s\n"

static const char sine[] = "sine -amplitude 2 -frequency 1.3 -cycles 8";
static const char record[] = "record input/records/ELCENTRO_1940_NS.AT2";
static const char other[] = "record input/records/NAPA_2014_68150_HNE.AT2 -scale 3";
static const char jankowski[] = "jankowski -k 2.75e9N/m^1.5 -zeta 0.35";

static struct ensemble_member pair(double mass, const char *ground, double gap, const char *law) {
    return (struct ensemble_member){.model =
                                        analysis_model(PAIR, mass, ground, 8.0, 1e-3, gap, law)};
}

static void eight_gaps_give_the_bits_of_eight_runs(void **state) {
    (void)state;
    struct ensemble_member member[ENSEMBLE_MAX];
    for (int k = 0; k < ENSEMBLE_MAX; k++) {
        member[k] = pair(300, record, 5.0 * k, jankowski);
    }
    assert_true(compare(member, ENSEMBLE_MAX) > 50);
    free_models(member, ENSEMBLE_MAX);
}

static void laws_masses_and_grounds_may_differ(void **state) {
    (void)state;
    struct ensemble_member member[] = {
        pair(300, record, 5, "linear -k 100MN/m"),
        pair(280, other, 10, "kelvin-voigt -k 100MN/m -e 0.65"),
        pair(310, sine, 15, "hertz -k 2.75e9N/m^1.5"),
        pair(290, record, 8, jankowski),
        pair(305, "record input/records/ELCENTRO_1940_NS.AT2 -scale 2", 20,
             "hertz-damp -k 2.75e9N/m^1.5 -e 0.65"),
    };
    assert_true(compare(member, 5) > 50);
    free_models(member, 5);
}

// Eight runs of one model with other gaps, and up to a few per cent of mass more.
static long compare_gaps(const struct model *m) {
    struct ensemble_member member[ENSEMBLE_MAX];
    struct model model[ENSEMBLE_MAX];
    struct link *link = calloc((size_t)m->n_link * ENSEMBLE_MAX + 1, sizeof *link);
    for (int k = 0; k < ENSEMBLE_MAX; k++) {
        model[k] = *m;
        struct link *own = link + (size_t)k * (size_t)m->n_link;
        for (int i = 0; i < m->n_link; i++) {
            own[i] = m->link[i];
            own[i].gap *= 0.5 + 0.25 * k;
        }
        model[k].link = own;
        member[k] = (struct ensemble_member){.model = &model[k]};
    }
    long n_impact = compare(member, ENSEMBLE_MAX);
    free(link);
    return n_impact;
}

// Every law and size of step, walls, buildings that start in contact.
static void decks_made_at_random_have_the_same_bits(void **state) {
    (void)state;
    const uint64_t n_deck = getenv("JOSTLE_LONG") ? 4000 : 300;
    long n_impact = 0;
    int n_suited = 0;
    for (uint64_t seed = 0; seed < n_deck; seed++) {
        char text[8192];
        random_deck(seed, text, sizeof text);
        struct model *m = analysis_model("%s", text);
        if (ensemble_suits(m)) {
            n_suited++;
            n_impact += compare_gaps(m);
        }
        model_free(m);
    }
    assert_true(n_suited > 10 && n_impact > 500);
}

// Above 16 floors a building is solved by its factors. Any beta and gamma.
static void tall_buildings_and_other_integrators_have_the_same_bits(void **state) {
    (void)state;
    static const char *const integrator[] = {"newmark", "newmark -beta 0.3025 -gamma 0.6",
                                             "newmark -beta 0.16666666666666666"};
    for (int i = 0; i < 3; i++) {
        struct model *m = analysis_model(
            "building A -floors 20 -mass 300t -stiffness 600MN/m\n"
            "building B -floors 17 -mass 300t -stiffness 400MN/m\n"
            "building C -floors 3 -mass 300t -stiffness 400MN/m\n"
            "damping A rayleigh 5%%\ndamping C rayleigh 2%%\n"
            "contact A B -gap 20mm -law hertz-damp -k 2.75e9N/m^1.5 -e 0.65\n"
            "contact B C -gap 30mm -law linear -k 100MN/m\n"
            "contact C wall -gap 15mm -law linear -k 100MN/m\n"
            "ground %s\nduration 5.0004s\nintegrator %s\nstep fixed 1ms\noutput -every 7\n",
            record, integrator[i]);
        assert_true(compare_gaps(m) > 50);
        model_free(m);
    }
}

// Some storeys yield, some never do, others are elastic. Low buildings are solved by their
// inverses, which those that yield must have had alone too; some stand beyond yield at the start.
static void yielding_storeys_have_the_same_bits(void **state) {
    (void)state;
    static const char *const start[] = {"", "initial A:8 -displacement 0.1\n"};
    static const char jump[] = "sine -amplitude 150 -frequency 0.5 -phase 1.57 -delay 1.2";
    for (int i = 0; i < 5; i++) {
        struct model *m = analysis_model(
            "building A -floors %d -mass 300t -stiffness 345MN/m\n"
            "building B -floors 5 -mass 300t -stiffness 345MN/m\n"
            "damping A rayleigh 5%%\ndamping B rayleigh 2%%\n"
            "storey A:1:3 bilinear -yield 3MN -hardening 0.07\n"
            "storey A:4:8 bilinear -yield 3MN -hardening 0\n"
            "storey B:2 bilinear -yield 1.5MN -hardening 0.6\n"
            "storey B:3 bilinear -yield 150MN -hardening 0.1\n"
            "contact A B -gap 20mm -law jankowski -k 2.75e9N/m^1.5 -zeta 0.35\n"
            "ground %s\n%sduration 6.0003s\nstep fixed %s\noutput -every 7\n",
            i < 2 ? 8 : 18, i < 4 ? record : jump, start[i % 2], i < 4 ? "1ms" : "20ms");
        assert_true(ensemble_suits(m) && compare_gaps(m) > 20);
        model_free(m);
    }
}

// Contacts of buildings of nine to sixteen floors, of which some do not feel a force where steps
// are short. Masses differ.
static void contacts_of_higher_buildings_have_the_same_bits(void **state) {
    (void)state;
    struct ensemble_member member[ENSEMBLE_MAX];
    for (int k = 0; k < ENSEMBLE_MAX; k++) {
        member[k].model = analysis_model("building A -floors 16 -mass 300t -stiffness 400MN/m\n"
                                         "building B -floors 16 -mass %dt -stiffness 300MN/m\n"
                                         "damping A rayleigh 5%%\n"
                                         "initial A:16 -velocity 1m/s\n"
                                         "contact A:16 B:16 -gap %dmm -law %s\n"
                                         "contact A:15 B:15 -gap %dmm -law linear -k 100MN/m\n"
                                         "ground sine -amplitude 0 -frequency 1\n"
                                         "duration 0.5s\nstep fixed 0.1ms\n",
                                         300 + k / 2, 2 + k, jankowski, 2 + k);
    }
    assert_true(compare(member, ENSEMBLE_MAX) >= ENSEMBLE_MAX);
    free_models(member, ENSEMBLE_MAX);
}

// Four buildings that lean on each other and on a wall: up to 32 contacts are closed at a time,
// which a run alone takes some at a time.
static void many_contacts_that_stay_closed_have_the_same_bits(void **state) {
    (void)state;
    struct ensemble_member member[ENSEMBLE_MAX];
    for (int k = 0; k < ENSEMBLE_MAX; k++) {
        member[k].model = analysis_model("building A -floors 8 -mass 300t -stiffness 400MN/m\n"
                                         "building B -floors 8 -mass %dt -stiffness 300MN/m\n"
                                         "building C -floors 8 -mass 200t -stiffness 500MN/m\n"
                                         "building D -floors 8 -mass 250t -stiffness 300MN/m\n"
                                         "initial A -velocity 1m/s\ninitial B -velocity 0.9m/s\n"
                                         "initial C -velocity 0.8m/s\ninitial D -velocity 0.7m/s\n"
                                         "contact A B -gap 0mm -law jankowski -k 1e8 -e 0.9\n"
                                         "contact B C -gap 0mm -law jankowski -k 1e8 -e 0.9\n"
                                         "contact C D -gap 0mm -law linear -k 50MN/m\n"
                                         "contact D wall -gap 0mm -law jankowski -k 1e8 -e 0.9\n"
                                         "ground sine -amplitude 0 -frequency 1\n"
                                         "duration 0.3s\nstep fixed 0.5ms\n",
                                         300 + k);
    }
    assert_true(compare(member, ENSEMBLE_MAX) >= ENSEMBLE_MAX);
    free_models(member, ENSEMBLE_MAX);
}

// Low buildings that are alike are solved by their factors, not by their inverses.
#define LOW(name) "building " name " -floors 5 -mass 300t -stiffness 345MN/m\n"
static void a_row_of_one_height_has_the_same_bits(void **state) {
    (void)state;
    struct ensemble_member member[ENSEMBLE_MAX];
    for (int k = 0; k < ENSEMBLE_MAX; k++) {
        member[k].model = analysis_model(
            "building A -floors 5 -mass %dt -stiffness 500MN/m\n" LOW("B") LOW("C") LOW("D")
                LOW("E") LOW("F") "contact A B -gap 5mm -law %s\n"
                                  "ground %s\nduration 4s\nstep fixed 1ms\n",
            200 + 20 * k, jankowski, record);
    }
    assert_true(compare(member, ENSEMBLE_MAX) > 0);
    free_models(member, ENSEMBLE_MAX);
}

// Links act in most steps; forces that jump and a stiff contact whose steps are rejected take runs
// alone in between. Only building C differs from run to run.
static void a_row_in_heavy_contact_has_the_same_bits(void **state) {
    (void)state;
    struct ensemble_member member[ENSEMBLE_MAX];
    for (int k = 0; k < ENSEMBLE_MAX; k++) {
        member[k].model =
            analysis_model("building A -floors 6 -mass 300t -stiffness 400MN/m\n"
                           "building B -floors 6 -mass 300t -stiffness 250MN/m\n"
                           "building C -floors 5 -mass %dt -stiffness 345MN/m\n"
                           "building D -floors 6 -mass 300t -stiffness 300MN/m\n"
                           "damping A rayleigh 5%%\ndamping C rayleigh 5%%\n"
                           "contact A B -gap 1mm -law %s\n"
                           "contact B C -gap 3mm -law kelvin-voigt -k 100MN/m -e 0.65\n"
                           "contact C D -gap 2mm -law hertz -k 2e14N/m^1.5\n"
                           "contact D wall -gap 5mm -law linear -k 200MN/m\n"
                           "ground %s\nduration 4s\nstep fixed 1ms\n",
                           200 + 20 * k, jankowski, record);
    }
    assert_true(compare(member, ENSEMBLE_MAX) > 1000);
    free_models(member, ENSEMBLE_MAX);
}

// Damping that drives: two lanes grow without bound, beyond what lanes may hold and then beyond all
// numbers, and end with errors; the others go on.
static void a_run_that_fails_leaves_the_others_alone(void **state) {
    (void)state;
    struct ensemble_member member[6];
    struct model model[6];
    double driving[16] = {0};
    for (int i = 0; i < 13; i++) {
        driving[i] = -300e3 / 1e-3;
    }
    for (int k = 0; k < 6; k++) {
        const bool driven = k == 1 || k == 4;
        member[k] = driven ? pair(300, record, 1e42, "linear -k 1kN/m")
                           : pair(300, record, 5 + k, jankowski);
        model[k] = *member[k].model;
        model[k].chain.damping = driven ? driving : model[k].chain.damping;
        member[k].model = &model[k];
    }
    assert_true(compare(member, 6) > 50);
    for (int k = 0; k < 6; k++) {
        assert_int_equal(member[k].status, k == 1 || k == 4 ? STATUS_FAILED : STATUS_OK);
        deck_free(model[k].deck);
    }
}

// Damping so negative that the step's matrix is not positive definite, but that of half a step is.
static void runs_that_never_enter_a_lane_have_the_same_bits(void **state) {
    (void)state;
    struct ensemble_member member[5];
    for (int k = 0; k < 5; k++) {
        member[k].model = analysis_model("building A -floors 2 -mass 300t -stiffness 1MN/m\n"
                                         "building B -floors 1 -mass 300t -stiffness 1MN/m\n"
                                         "damping A rayleigh -alpha -1500 -beta 0\n"
                                         "contact A B -gap %dmm -law linear -k 1MN/m\n"
                                         "ground sine -amplitude 1 -frequency 1.5Hz\n"
                                         "step fixed 2ms\nduration 6ms\n",
                                         1 + k);
    }
    compare(member, 5);
    for (int k = 0; k < 5; k++) {
        deck_free(member[k].model->deck);
    }
}

// Others than the first by their step, storeys or integrator; durations may differ.
static void runs_of_another_kind_go_alone(void **state) {
    (void)state;
    static const char *const line[] = {
        "duration 8s\nstep fixed 1ms\n",
        "duration 8s\nstep fixed 1ms\n",
        "duration 8.5s\nstep fixed 1ms\n",
        "duration 8s\nstep fixed 2ms\n",
        "duration 8s\nstep fixed 1ms\nstorey A:2 bilinear -yield 4MN -hardening 0.05\n",
        "duration 8s\nstep adaptive\n",
        "duration 8s\nstep fixed 1ms\n",
        "duration 8s\nstep fixed 1ms\n",
    };
    struct ensemble_member member[ENSEMBLE_MAX];
    for (int k = 0; k < ENSEMBLE_MAX; k++) {
        member[k].model = analysis_model("building A -floors 8 -mass 300t -stiffness 345MN/m\n"
                                         "building B -floors 5 -mass 300t -stiffness 345MN/m\n"
                                         "contact A B -gap %dmm -law linear -k 100MN/m\n"
                                         "ground %s\n%s",
                                         5 + k, record, line[k]);
    }
    for (int k = 0; k < ENSEMBLE_MAX; k++) {
        const bool other_kind = k >= 3 && k <= 5;
        assert_int_equal(ensemble_alike(member[0].model, member[k].model), !other_kind);
    }
    assert_true(compare(member, ENSEMBLE_MAX) > 50);
    free_models(member, ENSEMBLE_MAX);
}

static int count_polls(void *context, double time, struct error *e) {
    int *left = context;
    (void)time;
    return (*left)-- > 0 ? STATUS_OK : error_set(e, STATUS_SYSTEM, "enough");
}

// Two kinds that take turns, and durations down to a single step.
static void runs_of_two_kinds_and_many_durations_have_the_same_bits(void **state) {
    (void)state;
    static const double duration[ENSEMBLE_MAX] = {3, 2, 7.0005, 4, 0.001, 0.0005, 6.4, 9};
    struct ensemble_member member[ENSEMBLE_MAX];
    for (int k = 0; k < ENSEMBLE_MAX; k++) {
        member[k].model = analysis_model("building A -floors 8 -mass 300t -stiffness 345MN/m\n"
                                         "building B -floors 5 -mass 300t -stiffness 345MN/m\n"
                                         "contact A%s B%s -gap 10mm -law linear -k 100MN/m\n"
                                         "ground %s\nduration %gs\nstep fixed 1ms\n",
                                         k % 2 ? ":5" : "", k % 2 ? ":5" : "", record, duration[k]);
    }
    assert_true(compare(member, ENSEMBLE_MAX) > 50);
    free_models(member, ENSEMBLE_MAX);
}

static void a_poll_ends_all_runs(void **state) {
    (void)state;
    struct ensemble_member member[5];
    int left = 5;  // the first question to each, at the start
    const struct observer observer = {.poll = count_polls, .context = &left};
    for (int k = 0; k < 5; k++) {
        member[k] = pair(300, record, 1000, jankowski);
    }
    ensemble_run(member, 5, &observer);
    for (int k = 0; k < 5; k++) {
        assert_int_equal(member[k].status, STATUS_SYSTEM);
        assert_string_equal(member[k].error.message, "enough");
        assert_null(member[k].results);
    }
    free_models(member, 5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eight_gaps_give_the_bits_of_eight_runs),
        cmocka_unit_test(laws_masses_and_grounds_may_differ),
        cmocka_unit_test(decks_made_at_random_have_the_same_bits),
        cmocka_unit_test(tall_buildings_and_other_integrators_have_the_same_bits),
        cmocka_unit_test(yielding_storeys_have_the_same_bits),
        cmocka_unit_test(contacts_of_higher_buildings_have_the_same_bits),
        cmocka_unit_test(many_contacts_that_stay_closed_have_the_same_bits),
        cmocka_unit_test(a_row_of_one_height_has_the_same_bits),
        cmocka_unit_test(a_row_in_heavy_contact_has_the_same_bits),
        cmocka_unit_test(a_run_that_fails_leaves_the_others_alone),
        cmocka_unit_test(runs_that_never_enter_a_lane_have_the_same_bits),
        cmocka_unit_test(runs_of_another_kind_go_alone),
        cmocka_unit_test(runs_of_two_kinds_and_many_durations_have_the_same_bits),
        cmocka_unit_test(a_poll_ends_all_runs),
    };
    gsl_set_error_handler_off();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
