// SPDX-License-Identifier: GPL-3.0-or-later
// Whole analyses against converged solutions of an independent program
// (tests/verify/reference/README.md says which): the four experiments of Jankowski (2005) and rows
// of multistorey buildings, elastic and yielding. Steps resolve the contacts; every peak, impulse
// and energy has to agree within 0.1 %, closures within 0.1 ms, and the number of impacts
// exactly.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "model/forces.h"
#include "support/analysis.h"
#include "support/support.h"

// Relative, of the first closure [s], and the share of the largest energy by which small ones are
// judged. Adaptive steps run to a tolerance of 1e-8: each of them is right to that share of the
// largest velocity, and so the sum of their works to some hundred times that share of the energy.
struct accuracy {
    double relative, time, small_energy;
};
static const struct accuracy fixed = {1e-3, 1e-4, 1e-2}, adaptive = {1e-6, 1e-6, 0.1};
// The references of frames with hinges agree with each other to 4e-6.
static const struct accuracy hinged = {1e-5, 1e-6, 0.1};

// A number much smaller than others of its kind is judged by this share of the largest.
static const double SMALL = 1e-3;

enum { ROWS_MAX = 200 };
struct reference {
    char quantity[128], owner[128];
    int floor;
    double value;
};

// The next word of a line, which ends at the tab or line end put to 0.
static const char *field(char **at) {
    char *word = *at;
    *at = word + strcspn(word, "\t\n");
    assert_true(**at != '\0');
    *(*at)++ = '\0';
    return word;
}

static int read_reference(const char *name, struct reference *row) {
    char path[256];
    char line[128];
    snprintf(path, sizeof path, "tests/verify/reference/%s.tsv", name);
    FILE *f = fopen(path, "r");
    assert_non_null(f);
    int n = 0;
    while (fgets(line, sizeof line, f)) {
        assert_true(n < ROWS_MAX);
        char *at = line;
        snprintf(row[n].quantity, sizeof row[n].quantity, "%s", field(&at));
        snprintf(row[n].owner, sizeof row[n].owner, "%s", field(&at));
        row[n].floor = (int)strtol(field(&at), NULL, 10);
        row[n].value = strtod(field(&at), NULL);
        n++;
    }
    assert_true(n > 5);
    fclose(f);
    return n;
}

static struct analysis run_fixed(const char *name) {
    char path[256];
    snprintf(path, sizeof path, "tests/verify/reference/%s.deck", name);
    struct analysis a = {0};
    struct deck *deck;
    struct error e = {0};
    assert_int_equal(deck_open(path, NULL, 0, &deck, &e), STATUS_OK);
    assert_int_equal(model_build(deck, &a.model, &e), STATUS_OK);
    assert_int_equal(analysis_run(a.model, NULL, &a.results, &e), STATUS_OK);
    return a;
}

// The deck with its last line, the step, replaced.
static struct analysis run_adaptive(const char *name, const char *steps) {
    char path[256];
    char text[4096];
    size_t size;
    snprintf(path, sizeof path, "tests/verify/reference/%s.deck", name);
    const char *deck_text = support_read(path, &size);
    const char *step = strstr(deck_text, "\nstep fixed");
    assert_non_null(step);
    snprintf(text, sizeof text, "%.*s\n%s\n", (int)(step - deck_text), deck_text, steps);
    struct analysis a = {0};
    struct deck *deck;
    struct error e = {0};
    assert_int_equal(deck_open_text(path, text, NULL, 0, &deck, &e), STATUS_OK);
    assert_int_equal(model_build(deck, &a.model, &e), STATUS_OK);
    assert_int_equal(analysis_run(a.model, NULL, &a.results, &e), STATUS_OK);
    return a;
}

static double floor_value(const struct analysis *a, const struct reference *r) {
    for (int q = 0; q < PEAK_COUNT; q++) {
        for (int k = 0; strcmp(r->quantity, peak_names[q]) == 0 && k < a->model->n_building; k++) {
            const struct building *g = &a->model->building[k];
            if (strcmp(g->name, r->owner) == 0) {
                return a->results->peak[q][g->first + r->floor - 1];
            }
        }
    }
    return NAN;
}

// Impact `number` (from 1) of a contact.
static const struct impact *impact_number(const struct analysis *a, int contact, long number) {
    const struct results *s = a->results;
    for (long i = 0; i < s->n_impact; i++) {
        if (s->impact[i].contact == contact && --number == 0) {
            return &s->impact[i];
        }
    }
    fail_msg("contact %d has too few impacts", contact);
    return NULL;
}

static bool is_closure(const struct reference *r) {
    return strncmp(r->quantity, "closure ", 8) == 0;
}

static double contact_value(const struct analysis *a, const struct reference *r) {
    for (int k = 0; k < a->model->n_contact; k++) {
        const struct link_peak *c = &a->results->link[k];
        const char *q = r->quantity;
        if (strcmp(a->model->link[k].name, r->owner) != 0) {
            continue;
        }
        return strcmp(q, "impacts") == 0          ? (double)c->impacts
               : strcmp(q, "force") == 0          ? c->force
               : strcmp(q, "penetration") == 0    ? c->penetration
               : strcmp(q, "impulse") == 0        ? c->impulse
               : strcmp(q, "dissipated") == 0     ? c->dissipated
               : strcmp(q, "first_approach") == 0 ? impact_number(a, k, 1)->v_approach
               : is_closure(r) ? impact_number(a, k, strtol(q + 8, NULL, 10))->t_start
                               : (double)NAN;
    }
    return NAN;
}

// A member of a building's frame or wall, such as A/column_1_1, and its force, such as M_i_max.
static double member_value(const struct analysis *a, const struct reference *r) {
    static const char *const force[FRAME_QUANTITIES] = {"M_i",
                                                        "M_j",
                                                        "V",
                                                        "N",
                                                        "rotation_i",
                                                        "rotation_j",
                                                        "plastic_rotation_i",
                                                        "plastic_rotation_j"};
    const struct model *m = a->model;
    const char *name = strchr(r->owner, '/') + 1, *extreme = strrchr(r->quantity, '_');
    for (int k = 0; k < m->n_building; k++) {
        const struct building *g = &m->building[k];
        const struct plane_frame *f = g->n_part > 0 ? frame_of(&g->part[0]) : NULL;
        if (strncmp(g->name, r->owner, (size_t)(name - 1 - r->owner)) != 0 || !f) {
            continue;
        }
        for (int i = 0; i < f->n_member; i++) {
            for (int q = 0; strcmp(frame_member_name(&f->member[i], m->deck->arena), name) == 0 &&
                            q < forces_quantities(g);
                 q++) {
                const int at = g->force + forces_of_members(g, 0, q) + i;
                if (strncmp(r->quantity, force[q], (size_t)(extreme - r->quantity)) == 0) {
                    return strcmp(extreme, "_max") == 0 ? a->results->force_max[at]
                                                        : a->results->force_min[at];
                }
            }
        }
    }
    return NAN;
}

static double value_of(const struct analysis *a, const struct reference *r) {
    if (r->floor > 0) {
        return floor_value(a, r);
    }
    if (strchr(r->owner, '/')) {
        return member_value(a, r);
    }
    for (int i = 0; strcmp(r->owner, "energy") == 0 && i < ENERGY_COUNT; i++) {
        if (strcmp(r->quantity, energy_names[i]) == 0) {
            return a->results->energy[i];
        }
    }
    return contact_value(a, r);
}

static bool is_energy(const struct reference *r) {
    return strcmp(r->owner, "energy") == 0 || strcmp(r->quantity, "dissipated") == 0;
}

// Absolute tolerance of row i: relative to the number, or to a share of the largest of its kind.
static double allowance(const struct analysis *a, const struct accuracy *accuracy,
                        const struct reference *row, int n, int i) {
    if (strcmp(row[i].quantity, "impacts") == 0) {
        return 0.0;
    }
    if (is_closure(&row[i])) {
        return accuracy->time;
    }
    double largest = is_energy(&row[i]) ? a->results->initial_energy : 0.0;
    for (int k = 0; k < n; k++) {
        bool same =
            is_energy(&row[i]) ? is_energy(&row[k]) : strcmp(row[i].quantity, row[k].quantity) == 0;
        largest = same ? fmax(largest, fabs(row[k].value)) : largest;
    }
    double share = is_energy(&row[i]) ? accuracy->small_energy : SMALL;
    return accuracy->relative * fmax(fabs(row[i].value), share * largest);
}

static void compare(const char *name, struct analysis *a, const struct accuracy *accuracy) {
    struct reference row[ROWS_MAX];
    int n = read_reference(name, row);
    for (int i = 0; i < n; i++) {
        double got = value_of(a, &row[i]);
        double allowed = allowance(a, accuracy, row, n, i);
        if (!(fabs(got - row[i].value) <= allowed)) {
            print_error("%s: %s of %s floor %d\n", name, row[i].quantity, row[i].owner,
                        row[i].floor);
        }
        assert_near(got, row[i].value, allowed);
    }
    assert_int_equal(a->results->totals.unsolved, 0);
    analysis_free(a);
}

static void fixed_steps_agree(void **state) {
    struct analysis a = run_fixed(*state);
    compare(*state, &a, &fixed);
}

static void adaptive_steps_agree(void **state) {
    struct analysis a = run_adaptive(*state, "step adaptive -tolerance 1e-8");
    compare(*state, &a, a.model->n_hinge > 0 ? &hinged : &adaptive);
}

static void adaptive_steps_of_newmark_agree(void **state) {
    struct analysis a = run_adaptive(*state, "integrator newmark\nstep adaptive -tolerance 1e-8");
    compare(*state, &a, &fixed);
}

#define CASE(text)                                                                                 \
    {.name = text, .test_func = fixed_steps_agree, .initial_state = (char[]){text}},               \
        {.name = text " with adaptive steps",                                                      \
         .test_func = adaptive_steps_agree,                                                        \
         .initial_state = (char[]){text}},                                                         \
    {                                                                                              \
        .name = text " with adaptive steps of newmark",                                            \
        .test_func = adaptive_steps_of_newmark_agree, .initial_state = (char[]) {                  \
            text                                                                                   \
        }                                                                                          \
    }

int main(void) {
    const struct CMUnitTest tests[] = {
        CASE("B1_ball_hertz"),
        CASE("B1_ball_jankowski"),
        CASE("B1_ball_kelvin_voigt"),
        CASE("B2_pendulum_hertz_single"),
        CASE("B2_pendulum_jankowski_single"),
        CASE("B2_pendulum_kelvin_voigt_single"),
        CASE("B3_girder_f2_hertz"),
        CASE("B3_girder_f2_jankowski"),
        CASE("B3_girder_f2_kelvin_voigt"),
        CASE("B4_towers_hertz"),
        CASE("B4_towers_jankowski"),
        CASE("B4_towers_kelvin_voigt"),
        CASE("D_8v5_jankowski"),
        CASE("D_8v5_kelvin_voigt"),
        CASE("E1_row3_jankowski"),
        CASE("E2_elastoplastic_kelvin_voigt"),
        CASE("E2_elastoplastic_sdof_free"),
        CASE("E8_free_mdof"),
        CASE("F_towers_linear_approach"),
        CASE("F_towers_stereo"),
        CASE("F_towers_wang"),
        CASE("H_frame7"),
        CASE("H_frames"),
        CASE("K_frame5x3"),
        CASE("K_frame7"),
        CASE("K_frames"),
        CASE("K_hinges"),
        CASE("K_hinges_twice"),
        CASE("K_wall8"),
        CASE("K_wall_pounding"),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
