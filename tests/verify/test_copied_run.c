// SPDX-License-Identifier: GPL-3.0-or-later
// A run whose state is copied in its middle goes on as the run it was copied from, to the last bit:
// what must be carried from step to step is in the lists of fields, and nothing else matters.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "solve/ensemble/ensemble_lockstep.h"
#include "solve/run.h"
#include "support/analysis.h"
#include "support/random_deck.h"
#include "support/support.h"

// What the states were at which runs were copied.
struct met {
    int copies;
    int closed;    // with a closed contact
    int resting;   // with a rigid contact at rest
    int yielding;  // with a storey that has yielded
    int grounds;   // on several grounds
    int failed;    // runs that cannot be finished
};

static bool has_yielded(const struct model *m, const struct state *s) {
    bool yielded = false;
    for (int i = 0; i < m->n_storey_history; i++) {
        yielded |= s->storey_history[i] != 0.0;
    }
    return yielded;
}

static void note(struct met *met, const struct run *r) {
    bool closed = false, resting = false;
    for (int k = 0; k < r->model->n_contact; k++) {
        closed |= r->now->link[k].closed;
        resting |= state_rests(r->now, r->model, k);
    }
    met->copies++;
    met->closed += closed;
    met->resting += resting;
    met->yielding += has_yielded(r->model, r->now);
    met->grounds += r->model->n_ground > 1;
}

static void assert_same_doubles(const double *got, const double *want, int n, const char *what) {
    if (n > 0 && memcmp(got, want, (size_t)n * sizeof *got) != 0) {
        fail_msg("%s differ", what);
    }
}

static void assert_same_state(const struct model *m, const struct state *got,
                              const struct state *want) {
    assert_true(got->time == want->time);
    assert_same_doubles(got->u, want->u, m->n_dof, "displacements");
    assert_same_doubles(got->v, want->v, m->n_dof, "velocities");
    assert_same_doubles(got->a, want->a, m->n_dof, "accelerations");
    assert_same_doubles(got->drift, want->drift, m->n_dof, "drifts");
    assert_same_doubles(got->shear, want->shear, m->n_dof, "shears");
    assert_same_doubles(got->storey_history, want->storey_history, m->n_storey_history, "storeys");
    assert_same_doubles(got->link_history, want->link_history, m->n_link_history, "links");
    for (int k = 0; k < m->n_link; k++) {
        assert_true(got->link[k].closed == want->link[k].closed);
        assert_same_doubles(&got->link[k].force, &want->link[k].force, 1, "forces");
    }
}

// A run, on the heap, that has come to a step.
static struct run *run_to(const struct model *m, long step, struct error *e) {
    struct run *r = malloc(sizeof *r);
    assert_non_null(r);
    *e = (struct error){0};
    assert_int_equal(analysis_begin(r, m, NULL, e), STATUS_OK);
    e->status = analysis_go(r, step);
    return r;
}

static void end(struct run *r, const struct error *e, struct results **out) {
    *out = NULL;
    assert_int_equal(analysis_end(r, e->status, out), e->status);
}

// Goes on in `r` and in `copy` from where `r` is.
static void go_on(struct run *r, struct error *e, struct run *copy, struct error *of_copy) {
    const struct model *m = r->model;
    struct results *got, *want;
    assert_int_equal(analysis_copy(copy, r), STATUS_OK);
    e->status = analysis_go(r, m->n_step);
    of_copy->status = analysis_go(copy, m->n_step);
    assert_int_equal(of_copy->status, e->status);
    if (e->status == STATUS_OK) {
        assert_same_state(m, copy->now, r->now);
    } else {
        assert_string_equal(of_copy->message, e->message);
    }
    end(r, e, &want);
    end(copy, of_copy, &got);
    if (want) {
        analysis_assert_same(m, got, want);
    }
    results_free(got);
    results_free(want);
}

// Copies a run at a step, to a run that has taken `taken` steps.
static void copy_at(const struct model *m, long step, long taken, struct met *met) {
    struct error e, of_copy;
    struct run *r = run_to(m, step, &e);
    struct run *copy = run_to(m, taken, &of_copy);
    struct results *none;
    if (e.status == STATUS_OK && of_copy.status == STATUS_OK) {
        note(met, r);
        go_on(r, &e, copy, &of_copy);
    } else {
        met->failed++;
        end(r, &e, &none);
        results_free(none);
        end(copy, &of_copy, &none);
        results_free(none);
    }
    free(r);
    free(copy);
}

// At several steps from the first to the one before the last: by turns to a run that has come
// elsewhere and to one that has taken no step.
static void copy_often(const struct model *m, int n, struct met *met) {
    for (int i = 0; i < n; i++) {
        long step = (m->n_step - 1) * (2L * i + 1) / (2L * n);
        copy_at(m, step > 1 ? step : 1, i % 2 == 0 ? (step + m->n_step) / 2 : 0, met);
    }
}

#define TWO                                                                                        \
    "building A -floors 4 -mass 100t -stiffness 90MN/m\n"                                          \
    "building B -floors 6 -mass 80t -stiffness 60MN/m\n"                                           \
    "damping B rayleigh 3% 7%\n"                                                                   \
    "ground record input/records/ELCENTRO_1940_NS.AT2 -pga 0.6g\n"
#define TALL                                                                                       \
    "building A -floors 12 -mass 100t -stiffness 190MN/m\n"                                        \
    "building B -floors 20 -mass 80t -stiffness 160MN/m\n"                                         \
    "building C -floors 12 -mass 90t -stiffness 130MN/m\n"                                         \
    "building D -floors 12 -mass 90t -stiffness 150MN/m\n"                                         \
    "building E -floors 12 -mass 80t -stiffness 170MN/m\n"                                         \
    "damping A rayleigh 5%\ndamping B rayleigh 3% 7%\n"                                            \
    "contact A B -gap 5mm -law jankowski -k 1e9N/m^1.5 -e 0.65\n"                                  \
    "contact B C -gap 0 -law linear -k 100MN/m\n"                                                  \
    "ground record input/records/ELCENTRO_1940_NS.AT2 -pga 0.6g\n"
#define FRAME                                                                                      \
    "building A -floors 7 -mass 86t\nmatrix A input/frame7.txt -unit N/m\n"                        \
    "building B -floors 5 -mass 80t -stiffness 160MN/m\n"                                          \
    "damping A rayleigh 5%\ndamping B rayleigh 3% 7%\n"                                            \
    "ground record input/records/ELCENTRO_1940_NS.AT2 -pga 0.6g\n"
#define HINGED                                                                                     \
    "building A -floors 3 -mass 60t -height 3.5m\nframe A -bays 2*6m -modulus 200GPa "             \
    "-columns-inextensible\ncolumns A:1:3 -I 3e-4\nbeams A:1:3 -I 2.5e-4\n"                        \
    "damping A rayleigh 3%\nbuilding B -floors 3 -mass 80t -stiffness 60MN/m\n"                    \
    "ground record input/records/ELCENTRO_1940_NS.AT2 -pga 0.6g\n"
#define YIELDING                                                                                   \
    "storey A bilinear -yield 1MN -hardening 5%\n"                                                 \
    "storey B:1:3 bouc-wen -yield 1MN -hardening 2%\n"                                             \
    "storey B:4:6 takeda -yield 1MN -hardening 3%\n"

// Decks of each kind, without steps.
static const char *const kind[] = {
    TWO "contact A B -gap 5mm -law jankowski -k 1e9N/m^1.5 -e 0.65\n",
    TWO "contact A B -gap 5mm -law kelvin-voigt -k 1e8 -e 0.65\nlink A:4 B:4 -dashpot 50kN*s/m\n"
        "damping A modal 5%\n",
    TWO "contact A B -gap 5mm -law linear -k 1e8\nlink A:3 A:4 -law imk -stiffness 50MN/m "
        "-yield 200kN -hardening 5% -capping 9mm -post-capping -0.1 -tension-only\n"
        "link A:2 B:2 -law maxwell -stiffness 50MN/m -dashpot 900kN*s^0.5/m^0.5 -exponent 0.5\n"
        "link A:1 B:1 -law friction -stiffness 50MN/m -slip 50kN -slack 2mm\n",
    TWO "contact A B -gap 5mm -law wang -k 1e8 -zeta 1e8 -residual 0.4\n",
    TWO "contact A B -gap 5mm -law stereomechanical -e 0.4\n"
        "contact wall A -gap 0 -law stereomechanical -e 0\n",
    TWO YIELDING "contact A B -gap 5mm -law bilinear -k1 1e8 -k2 5e7 -dy 0.5mm\n",
    TWO YIELDING "contact A B -gap 0 -law stereomechanical -e 0.4\ndamping A modal 5%\n",
    TWO "storey A bilinear -yield 1MN -hardening 5%\nstorey B clough -yield 1MN -hardening 5%\n"
        "contact A B -gap 20mm -law linear -k 1e8\n",
    TWO "ground sine -amplitude 2 -frequency 0.7 -buildings B\n"
        "load A:2 sine -amplitude 100kN -frequency 1.1\ncontact A B -gap 5mm -law hertz -k 1e9\n",
    FRAME "contact A B -gap 5mm -law jankowski -k 1e9N/m^1.5 -e 0.65\n",
    FRAME "contact A B -gap 5mm -law kelvin-voigt -k 1e8 -e 0.65\n"
          "storey A:1:3 bilinear -yield 200kN -hardening 0 -stiffness 50MN/m\n"
          "storey B bilinear -yield 500kN -hardening 5%\n",
    TALL,
    TALL "storey A bilinear -yield 1MN -hardening 5%\n",
    TWO "storey A takeda -yield 300kN -hardening 2% -alpha 0.3 -beta 0.2\n"
        "storey B clough -yield 200kN -hardening 2%\ncontact A B -gap 5mm -law linear -k 1e8\n",
    TWO "storey A clough -yield 300kN -hardening 2%\ndamping A modal 5%\n"
        "storey B:2:4 takeda -yield 200kN -hardening 2%\n"
        "contact A B -gap 5mm -law hertz -k 1e9\n",
    TALL "storey A clough -yield 500kN -hardening 5%\n",
    TALL "storey C:all takeda -yield 500kN -hardening 2%\n",
    FRAME "storey B takeda -yield 300kN -hardening 2%\ncontact A B -gap 9mm -law linear -k 1e8\n",
    HINGED "hinges A:1:3 beams bilinear -yield 80kN*m -hardening 2% -stiffness 200MN*m\n"
           "hinges A bases clough -yield 90kN*m -hardening 2% -stiffness 200MN*m\n"
           "contact A B -gap 5mm -law kelvin-voigt -k 1e8 -e 0.65\n",
    HINGED "hinges A:1:3 columns bouc-wen -yield 80kN*m -hardening 2% -stiffness 200MN*m\n"
           "storey A takeda -yield 200kN -hardening 0 -stiffness 20MN/m\npdelta A\n"
           "contact A B -gap 9mm -law linear -k 1e8\n",
    TWO "storey A:1:2 ramberg-osgood -yield 300kN -eta 0.2 -r 7\n"
        "storey A:3:4 multilinear -yield 200kN -drift-2 9mm -shear-2 300kN -cycle peak\n"
        "storey B bouc-wen -yield 300kN -hardening 2% -n 1 -delta-eta 0.05 -zeta-s 0.8\n"
        "contact A B -gap 5mm -law hertz -k 1e9\n",
    TWO
    "storey A bilinear -yield 300kN -yield-negative 200kN -hardening -1%\n"
    "storey B:1:2 imk -yield 300kN -hardening 2% -capping 20mm -post-capping -0.05 -gamma-s 50\n"
    "storey B:3:4 trilinear -crack 100kN -yield 300kN -cracked 0.3 -hardening 2% -takeda\n"
    "contact A B -gap 5mm -law linear -k 1e8\n",
};

// A building of a full matrix beside a chain that yields, with a contact between two floors.
static void copy_full_building(const char *steps, struct met *met) {
    const char *file = support_write("matrix.csv", "345e6, -150e6, 10e6\n-150e6, 300e6, -140e6\n"
                                                   "10e6, -140e6, 130e6\n");
    struct model *m = analysis_model(
        "building A -floors 3 -mass 100t -height 3m\nmatrix A %s\n"
        "wall A:1:2 -EI 1GN*m^2 -GA 500MN\ndamping A rayleigh 5%%\n"
        "building B -floors 6 -mass 80t -stiffness 60MN/m -height 3m\n"
        "storey B bouc-wen -yield 1MN -hardening 2%%\n"
        "contact A B -gap 5mm -law jankowski -k 1e9N/m^1.5 -e 0.65\n"
        "contact A:2 B@7m -gap 3mm -law linear -k 100MN/m\n"
        "ground record input/records/ELCENTRO_1940_NS.AT2 -pga 0.6g\nduration 4\n%s\n",
        file, steps);
    copy_often(m, 3, met);
    model_free(m);
}

// Decks of each kind and some at random, those with the steps of theirs where `steps` is empty.
static struct met check(const char *steps, uint64_t n_deck) {
    struct met met = {0};
    for (size_t i = 0; i < sizeof kind / sizeof kind[0]; i++) {
        struct model *m =
            analysis_model("%s%s\nduration 4\n", kind[i], *steps ? steps : "step fixed 2ms");
        copy_often(m, 3, &met);
        model_free(m);
    }
    copy_full_building(*steps ? steps : "step fixed 2ms", &met);
    for (uint64_t seed = 0; seed < n_deck; seed++) {
        char text[8192];
        if (*steps) {
            random_deck_stepped(seed, steps, text, sizeof text);
        } else {
            random_deck(seed, text, sizeof text);
        }
        struct model *m = analysis_model("%s", text);
        copy_often(m, 2, &met);
        model_free(m);
    }
    print_message(
        "%d copies, %d closed, %d at rest, %d yielding, %d on several grounds, %d failed\n",
        met.copies, met.closed, met.resting, met.yielding, met.grounds, met.failed);
    assert_true(met.closed > 0.25 * met.copies && met.yielding > 0.35 * met.copies);
    assert_true(met.copies > 100 && met.grounds > 2);
    return met;
}

static void runs_with_fixed_steps_are_all_in_their_fields(void **state) {
    (void)state;
    assert_true(check("", getenv("JOSTLE_LONG") ? 4000 : 60).resting > 2);
}

static void runs_with_adaptive_steps_of_newmark_are_all_in_their_fields(void **state) {
    (void)state;
    const uint64_t n = getenv("JOSTLE_LONG") ? 2000 : 24;
    assert_true(check("integrator newmark\nstep adaptive", n).resting > 2);
}

static void runs_of_dormand_and_prince_are_all_in_their_fields(void **state) {
    (void)state;
    check("step adaptive", getenv("JOSTLE_LONG") ? 2000 : 24);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(runs_with_fixed_steps_are_all_in_their_fields),
        cmocka_unit_test(runs_with_adaptive_steps_of_newmark_are_all_in_their_fields),
        cmocka_unit_test(runs_of_dormand_and_prince_are_all_in_their_fields),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
