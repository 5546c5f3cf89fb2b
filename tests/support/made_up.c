// SPDX-License-Identifier: GPL-3.0-or-later
// See made_up.h.
#include "support/made_up.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/arena.h"
#include "support/support.h"

static const double mass[DOF] = {1, 2, 3, 4, 5, 6};
static const double stiffness[DOF] = {10, 20, 30, 40, 50, 60};
static const double height[FLOORS] = {3.5, 3, 3};
static const double omega[FLOORS] = {2, 4, 8};
static const double constant[2] = {1.5e6, 0.25};
static const struct contact_law law = {.name = "hertz", .n_constant = 2};
static const struct building building[2] = {
    {.name = "West \"tower\"",
     .n_dof = FLOORS,
     .n_floor = FLOORS,
     .first = 0,
     .mass = mass,
     .stiffness = stiffness,
     .height = height,
     .omega = omega,
     .ground = 0},
    {.name = "East",
     .n_dof = FLOORS,
     .n_floor = FLOORS,
     .first = FLOORS,
     .mass = mass + FLOORS,
     .stiffness = stiffness + FLOORS,
     .omega = omega,
     .elastic = true,
     .ground = 0},
};
static const struct link contacts[3] = {
    {.name = "roof",
     .building = {0, 1},
     .floor = {3, 3},
     .level = {NAN, NAN},
     .gap = 0.02,
     .mass = 2,
     .law = &law,
     .constant = constant},
    {.name = "side",
     .building = {1, WALL},
     .floor = {2, 0},
     .level = {NAN, NAN},
     .gap = 0.5,
     .mass = 5,
     .law = &law,
     .constant = constant},
    {.name = "bridge",
     .building = {0, 1},
     .floor = {1, 1},
     .level = {NAN, NAN},
     .mass = 1,
     .law = &law,
     .constant = constant,
     .bilateral = true},
};

static void put_results(struct results *r, struct arena *a, int n_contact) {
    for (int p = 0; p < PEAK_COUNT; p++) {
        r->peak[p] = arena_alloc(a, DOF, sizeof(double));
        r->peak_time[p] = arena_alloc(a, DOF, sizeof(double));
        for (int i = 0; i < DOF; i++) {
            r->peak[p][i] = 100 * p + i + 0.125;
            r->peak_time[p][i] = 0.01 * i;
        }
    }
    r->residual_drift = arena_alloc(a, DOF, sizeof(double));
    for (int i = 0; i < DOF; i++) {
        r->residual_drift[i] = 0.25 * i;
    }
    r->storey_demand = arena_alloc(a, DOF, sizeof *r->storey_demand);
    for (int i = 0; i < DOF * YIELD_QUANTITIES; i++) {
        r->storey_demand[i / YIELD_QUANTITIES].value[i % YIELD_QUANTITIES] = i + 0.5;
    }
    r->link = arena_alloc(a, 3, sizeof *r->link);
    r->impact = arena_alloc(a, 2, sizeof *r->impact);
    r->link[0] = (struct link_peak){7e5, 0.4, 0.003, 0.41, 900, 55, 2, 0, 0};
    r->link[1] = (struct link_peak){0, NAN, -0.3, 0.2, 0, 0, 0, 0, 0};
    r->impact[0] = (struct impact){.t_start = 0.3,
                                   .t_end = 0.31,
                                   .v_approach = 0.2,
                                   .v_rebound = 0.1,
                                   .complete = true,
                                   .peak_force = 7e5,
                                   .max_penetration = 0.003,
                                   .impulse = 600,
                                   .dissipated = 40,
                                   .steps = 12};
    r->impact[1] = (struct impact){.t_start = 0.9,
                                   .t_end = 1,
                                   .v_approach = 0.1,
                                   .v_rebound = -0.05,
                                   .peak_force = 1e5,
                                   .max_penetration = 0.001,
                                   .impulse = 300,
                                   .dissipated = 15,
                                   .steps = 3};
    r->n_impact = n_contact > 0 ? 2 : 0;
    for (int i = 0; i < ENERGY_COUNT; i++) {
        r->energy[i] = 1000.5 + i;
    }
    r->residual_peak = 1e-7;
    r->totals = (struct totals){.steps = 100, .rejected = 1, .iterations = 250, .seconds = 0.5};
}

int made_up_setup(void **state) {
    struct made_up *f = calloc(1, sizeof *f);
    struct error e;
    strcpy(f->folder, "/tmp/jostle-test-XXXXXX");
    if (!mkdtemp(f->folder)) {
        return -1;
    }
    snprintf(f->path, sizeof f->path, "%s/r.h5", f->folder);
    snprintf(f->part, sizeof f->part, "%s.part", f->path);
    static const char text[] = "title \"A title\"\nparam gap 0.02\n";
    struct statement s;
    if (deck_open_text("made-up.deck", text, NULL, 0, &f->model.deck, &e) != STATUS_OK ||
        deck_next(f->model.deck, &s)) {
        return -1;
    }
    f->model.n_building = f->model.n_body = 2;
    f->model.n_dof = DOF;
    f->model.n_contact = 2;
    f->model.n_link = 3;
    f->model.n_ground = 1;
    f->model.building = building;
    f->model.link = contacts;
    f->model.dt = 0.01;
    f->model.duration = 1;
    f->model.n_step = 100;
    f->model.output = (struct output){.every = 10, .fields = FIELD_ALL};
    put_results(&f->results, f->model.deck->arena, 2);
    *state = f;
    return 0;
}

int made_up_teardown(void **state) {
    struct made_up *f = *state;
    unlink(f->path);
    unlink(f->part);
    rmdir(f->folder);
    deck_free(f->model.deck);
    free(f);
    return 0;
}

int made_up_rows(struct result_writer *w, int n, struct error *e) {
    const struct observer o = result_observer(w);
    double v[9][ENERGY_COUNT + DOF];
    for (int k = 0; k < n; k++) {
        for (int s = 0; s < 9; s++) {
            for (int i = 0; i < ENERGY_COUNT + DOF; i++) {
                v[s][i] = 1000 * s + 10 * i + k / 16.0;
            }
        }
        const struct row_view row = {0.1 * k, v[0], v[1], v[2], v[3], v[4],
                                     v[5],    v[6], v[7], v[8], NULL};
        int status = o.row(o.context, &row, e);
        if (status != STATUS_OK) {
            return status;
        }
    }
    return STATUS_OK;
}

int made_up_write(struct made_up *f, enum result_existing existing, struct error *e) {
    const struct result_options options = {
        .path = f->path, .existing = existing, .command_line = "jostle run x", .version = "9.9"};
    struct result_writer *w = NULL;
    int status = result_create(&f->model, &options, &w, e);
    if (status != STATUS_OK) {
        return status;
    }
    const int rows = (int)(1 + f->model.n_step / f->model.output.every +
                           (f->model.n_step % f->model.output.every != 0));
    status = made_up_rows(w, rows, e);
    if (status != STATUS_OK) {
        result_abort(w);
        return status;
    }
    return result_finish(w, &f->results, e);
}

struct result_file *made_up_written(struct made_up *f) {
    struct error e = {.message = ""};
    struct result_file *file = NULL;
    assert_int_equal(made_up_write(f, RESULT_KEEP, &e), STATUS_OK);
    assert_int_equal(result_open(f->path, &file, &e), STATUS_OK);
    return file;
}
