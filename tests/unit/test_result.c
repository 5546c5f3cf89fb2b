// SPDX-License-Identifier: GPL-3.0-or-later
// The result file: made-up histories and envelopes are written and read back.
#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "core/arena.h"
#include "jostle/result.h"
#include "support/support.h"

enum { FLOORS = 3, DOF = 6, ROWS = 11 };

static const double mass[DOF] = {1, 2, 3, 4, 5, 6};
static const double stiffness[DOF] = {10, 20, 30, 40, 50, 60};
static const double height[FLOORS] = {3.5, 3, 3};
static const double omega[FLOORS] = {2, 4, 8};
static const double constant[2] = {1.5e6, 0.25};
static const struct contact_law law = {.name = "hertz", .n_constant = 2};
static const struct building building[2] = {
    {.name = "West \"tower\"", .n_floor = FLOORS, .first = 0, .mass = mass,
     .stiffness = stiffness, .height = height, .omega = omega, .ground = 0},
    {.name = "East", .n_floor = FLOORS, .first = FLOORS, .mass = mass + FLOORS,
     .stiffness = stiffness + FLOORS, .omega = omega, .ground = 0},
};
static const struct link contacts[3] = {
    {.name = "roof", .building = {0, 1}, .floor = {3, 3}, .gap = 0.02, .mass = 2, .law = &law,
     .constant = constant},
    {.name = "side", .building = {1, WALL}, .floor = {2, 0}, .gap = 0.5, .mass = 5, .law = &law,
     .constant = constant},
    {.name = "bridge", .building = {0, 1}, .floor = {1, 1}, .mass = 1, .law = &law,
     .constant = constant, .bilateral = true},
};

struct fixture {
    char folder[64], path[128], part[160];
    struct model model;
    struct results results;
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
    r->contact = arena_alloc(a, 2, sizeof *r->contact);
    r->impact = arena_alloc(a, 2, sizeof *r->impact);
    r->contact[0] = (struct contact_peak){7e5, 0.4, 0.003, 0.41, 900, 55, 2};
    r->contact[1] = (struct contact_peak){0, NAN, -0.3, 0.2, 0, 0, 0};
    r->impact[0] = (struct impact){.t_start = 0.3, .t_end = 0.31, .v_approach = 0.2,
                                   .v_rebound = 0.1, .complete = true, .peak_force = 7e5,
                                   .max_penetration = 0.003, .impulse = 600, .dissipated = 40,
                                   .steps = 12};
    r->impact[1] = (struct impact){.t_start = 0.9, .t_end = 1, .v_approach = 0.1,
                                   .v_rebound = -0.05, .peak_force = 1e5,
                                   .max_penetration = 0.001, .impulse = 300, .dissipated = 15,
                                   .steps = 3};
    r->n_impact = n_contact > 0 ? 2 : 0;
    for (int i = 0; i < ENERGY_COUNT; i++) {
        r->energy[i] = 1000.5 + i;
    }
    r->residual_peak = 1e-7;
    r->totals = (struct totals){.steps = 100, .cuts = 1, .iterations = 250, .seconds = 0.5};
}

static int setup(void **state) {
    struct fixture *f = calloc(1, sizeof *f);
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
    f->model.n_building = 2;
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
    result_init();
    *state = f;
    return 0;
}

static int teardown(void **state) {
    struct fixture *f = *state;
    unlink(f->path);
    unlink(f->part);
    rmdir(f->folder);
    deck_free(f->model.deck);
    free(f);
    return 0;
}

// Row k holds 1000 s + 10 i + k / 16 for value i of source s: exact in single precision.
static int write_rows(struct result_writer *w, int n, struct error *e) {
    const struct observer o = result_observer(w);
    double v[9][ENERGY_COUNT + DOF];
    for (int k = 0; k < n; k++) {
        for (int s = 0; s < 9; s++) {
            for (int i = 0; i < ENERGY_COUNT + DOF; i++) {
                v[s][i] = 1000 * s + 10 * i + k / 16.0;
            }
        }
        const struct row_view row = {0.1 * k, v[0], v[1], v[2], v[3], v[4],
                                     v[5],    v[6], v[7], v[8]};
        int status = o.row(o.context, &row, e);
        if (status != STATUS_OK) {
            return status;
        }
    }
    return STATUS_OK;
}

static int write_file(struct fixture *f, enum result_existing existing, struct error *e) {
    const struct result_options options = {
        .path = f->path, .existing = existing, .command_line = "jostle run x", .version = "9.9"};
    struct result_writer *w = NULL;
    int status = result_create(&f->model, &options, &w, e);
    if (status != STATUS_OK) {
        return status;
    }
    const int rows =
        (int)(1 + f->model.n_step / f->model.output.every + (f->model.n_step % f->model.output.every != 0));
    status = write_rows(w, rows, e);
    if (status != STATUS_OK) {
        result_abort(w);
        return status;
    }
    return result_finish(w, &f->results, e);
}

static struct result_file *written(struct fixture *f) {
    struct error e = {.message = ""};
    struct result_file *file = NULL;
    assert_int_equal(write_file(f, RESULT_KEEP, &e), STATUS_OK);
    assert_int_equal(result_open(f->path, &file, &e), STATUS_OK);
    return file;
}

static void a_report_comes_back_as_it_was_written(void **state) {
    struct fixture *f = *state;
    struct result_file *file = written(f);
    const struct report *r = result_report(file);
    assert_string_equal(r->title, "A title");
    assert_string_equal(r->version, "9.9");
    assert_string_equal(r->command_line, "jostle run x");
    assert_string_equal(r->deck_file, "made-up.deck");
    assert_non_null(strstr(r->parameters, "gap"));
    assert_string_equal(r->units.force_name, "N");
    assert_int_equal(r->n_building, 2);
    assert_string_equal(r->building[0].name, "West \"tower\"");
    assert_string_equal(r->building[1].name, "East");
    assert_true(isnan(r->building[1].height[2]));
    for (int p = 0; p < PEAK_COUNT; p++) {
        for (int i = 0; i < FLOORS; i++) {
            assert_close(r->building[1].peak[p][i], 100 * p + FLOORS + i + 0.125, 0);
            assert_close(r->building[1].peak_time[p][i], 0.01 * (FLOORS + i), 0);
        }
    }
    assert_close(r->building[0].period[1], acos(-1.0) / 2, 1e-15);
    assert_close(r->energy[ENERGY_CONTACT], 1000.5 + ENERGY_CONTACT, 0);
    assert_close(r->residual_peak, 1e-7, 0);
    assert_int_equal(r->totals.iterations, 250);
    assert_int_equal(r->totals.cuts, 1);
    result_close(file);
}

static void contacts_links_and_impacts_come_back(void **state) {
    struct result_file *file = written(*state);
    const struct report *r = result_report(file);
    assert_int_equal(r->n_contact, 2);
    assert_string_equal(r->contact[1].right, "wall");
    assert_int_equal(r->contact[1].right_floor, 0);
    assert_string_equal(r->contact[0].constants, "1500000 0.25");
    assert_close(r->contact[0].peak.force, 7e5, 0);
    assert_true(isnan(r->contact[1].peak.force_time));
    assert_int_equal(r->contact[0].peak.impacts, 2);
    assert_int_equal(r->n_link, 1);
    assert_string_equal(r->link[0].name, "bridge");
    assert_int_equal(r->n_impact, 2);
    assert_int_equal(r->impact[1].contact, 0);
    assert_int_equal(r->impact[0].steps, 12);
    assert_true(r->impact[0].complete);
    assert_false(r->impact[1].complete);
    assert_close(r->impact[1].v_rebound, -0.05, 0);
    result_close(file);
}

static void histories_come_back_row_by_row(void **state) {
    struct result_file *file = written(*state);
    struct error e;
    double v[ROWS];
    assert_int_equal(result_report(file)->n_row, ROWS);
    assert_int_equal(result_time(file, v, &e), STATUS_OK);
    assert_close(v[ROWS - 1], 1.0, 1e-15);
    assert_int_equal(result_floor_history(file, FIELD_DRIFT, 1, 2, v, &e), STATUS_OK);
    assert_close(v[7], 3000 + 50 + 7 / 16.0, 0);
    assert_int_equal(result_contact_history(file, FIELD_PENETRATION, 1, v, &e), STATUS_OK);
    assert_close(v[3], 6000 + 10 + 3 / 16.0, 0);
    assert_int_equal(result_ground(file, 1, v, &e), STATUS_OK);
    assert_close(v[10], 7000 + 10 / 16.0, 0);
    result_close(file);
}

static void more_rows_than_the_buffer_holds_are_written_in_blocks(void **state) {
    struct fixture *f = *state;
    f->model.n_step = 10001;
    f->model.output.every = 2;
    struct result_file *file = written(f);
    const long n = result_report(file)->n_row;
    struct error e;
    double *v = calloc((size_t)n, sizeof *v);
    assert_int_equal(n, 5002);
    assert_int_equal(result_floor_history(file, FIELD_VELOCITY, 0, 1, v, &e), STATUS_OK);
    for (long k = 0; k < n; k++) {
        assert_close(v[k], 1010 + (double)k / 16, 0);
    }
    free(v);
    result_close(file);
}

static void fields_not_asked_for_are_not_written(void **state) {
    struct fixture *f = *state;
    f->model.output.fields = FIELD_DISPLACEMENT | FIELD_FORCE;
    f->model.output.single = true;
    struct result_file *file = written(f);
    struct error e;
    double v[ROWS];
    assert_int_equal(result_report(file)->fields, FIELD_DISPLACEMENT | FIELD_FORCE);
    assert_int_equal(result_floor_history(file, FIELD_DRIFT, 0, 0, v, &e), STATUS_INPUT);
    assert_non_null(strstr(e.message, "drift"));
    assert_int_equal(result_floor_history(file, FIELD_DISPLACEMENT, 0, 0, v, &e), STATUS_OK);
    assert_close(v[5], 5 / 16.0, 0);
    result_close(file);
}

static void a_model_without_contacts_is_written(void **state) {
    struct fixture *f = *state;
    f->model.n_contact = 0;
    f->model.n_link = 0;
    f->results.n_impact = 0;
    struct result_file *file = written(f);
    assert_int_equal(result_report(file)->n_contact, 0);
    assert_int_equal(result_report(file)->n_impact, 0);
    result_close(file);
}

static void an_existing_file_is_kept_unless_forced(void **state) {
    struct fixture *f = *state;
    struct error e;
    FILE *old = fopen(f->path, "w");
    fputs("precious", old);
    fclose(old);
    assert_int_equal(write_file(f, RESULT_KEEP, &e), STATUS_INPUT);
    assert_non_null(strstr(e.message, "--force"));
    struct stat s;
    assert_int_equal(stat(f->path, &s), 0);
    assert_int_equal(s.st_size, 8);
    assert_int_equal(write_file(f, RESULT_REPLACE, &e), STATUS_OK);
    assert_int_equal(stat(f->path, &s), 0);
    assert_true(s.st_size > 8);
}

static void a_file_that_comes_into_being_during_the_run_survives(void **state) {
    struct fixture *f = *state;
    struct error e;
    const struct result_options options = {.path = f->path, .version = "1"};
    struct result_writer *w = NULL;
    assert_int_equal(result_create(&f->model, &options, &w, &e), STATUS_OK);
    assert_int_equal(write_rows(w, ROWS, &e), STATUS_OK);
    FILE *other = fopen(f->path, "w");
    fputs("precious", other);
    fclose(other);
    assert_int_equal(result_finish(w, &f->results, &e), STATUS_INPUT);
    struct stat s;
    assert_int_equal(stat(f->path, &s), 0);
    assert_int_equal(s.st_size, 8);
    assert_int_not_equal(access(f->part, F_OK), 0);
}

static void an_aborted_run_leaves_nothing(void **state) {
    struct fixture *f = *state;
    struct error e;
    const struct result_options options = {.path = f->path, .version = "1"};
    struct result_writer *w = NULL;
    assert_int_equal(result_create(&f->model, &options, &w, &e), STATUS_OK);
    assert_int_equal(access(f->part, F_OK), 0);
    assert_int_equal(write_rows(w, 3, &e), STATUS_OK);
    result_abort(w);
    assert_int_not_equal(access(f->part, F_OK), 0);
    assert_int_not_equal(access(f->path, F_OK), 0);
}

static void two_runs_do_not_write_the_same_file(void **state) {
    struct fixture *f = *state;
    struct error e;
    const struct result_options options = {.path = f->path, .version = "1"};
    struct result_writer *first = NULL, *second = NULL;
    assert_int_equal(result_create(&f->model, &options, &first, &e), STATUS_OK);
    assert_int_equal(result_create(&f->model, &options, &second, &e), STATUS_SYSTEM);
    assert_non_null(strstr(e.message, "another run"));
    assert_int_equal(write_rows(first, ROWS, &e), STATUS_OK);
    assert_int_equal(result_finish(first, &f->results, &e), STATUS_OK);
}

static void what_a_killed_run_left_is_replaced(void **state) {
    struct fixture *f = *state;
    FILE *left = fopen(f->part, "w");
    fputs("half a file", left);
    fclose(left);
    result_close(written(f));
    assert_int_not_equal(access(f->part, F_OK), 0);
}

static void a_folder_that_is_not_there_is_a_system_error(void **state) {
    struct fixture *f = *state;
    struct error e;
    snprintf(f->path, sizeof f->path, "%s/none/r.h5", f->folder);
    assert_int_equal(write_file(f, RESULT_KEEP, &e), STATUS_SYSTEM);
    assert_non_null(strstr(e.message, "No such file"));
    assert_non_null(strstr(e.message, f->path));
}

// In a child process, since the library leaks what it could not write: 0 if writing under the limit
// failed as it must and left nothing behind.
static int write_under_limit(struct fixture *f, rlim_t limit) {
    pid_t child = fork();
    if (child == 0) {
        struct error e = {.message = ""};
        const struct rlimit tight = {limit, limit};
        signal(SIGXFSZ, SIG_IGN);
        const bool good = setrlimit(RLIMIT_FSIZE, &tight) == 0 &&
                          write_file(f, RESULT_KEEP, &e) == STATUS_SYSTEM &&
                          strstr(e.message, "File too large") && access(f->path, F_OK) != 0 &&
                          access(f->part, F_OK) != 0;
        _exit(good ? 0 : 1);
    }
    int state = -1;
    assert_true(child > 0 && waitpid(child, &state, 0) == child);
    return state;
}

// A limit on the size of files stands for a full disk.
static void a_full_disk_is_a_system_error_and_leaves_nothing(void **state) {
    struct fixture *f = *state;
    struct stat s;
    result_close(written(f));
    assert_int_equal(stat(f->path, &s), 0);
    unlink(f->path);
    for (off_t limit = 1; limit < s.st_size; limit += 9973) {
        assert_int_equal(write_under_limit(f, (rlim_t)limit), 0);
    }
}

static void a_name_with_a_slash_cannot_stand_in_the_file(void **state) {
    struct fixture *f = *state;
    struct error e;
    const struct building bad = {.name = "a/b", .n_floor = FLOORS, .mass = mass,
                                 .stiffness = stiffness, .omega = omega};
    f->model.building = &bad;
    f->model.n_building = 1;
    assert_int_equal(write_file(f, RESULT_KEEP, &e), STATUS_INPUT);
    assert_non_null(strstr(e.message, "a/b"));
}

static char *slurp(const char *path, size_t *size) {
    struct stat s;
    assert_int_equal(stat(path, &s), 0);
    *size = (size_t)s.st_size;
    char *bytes = malloc(*size);
    FILE *from = fopen(path, "rb");
    assert_int_equal(fread(bytes, 1, *size, from), *size);
    fclose(from);
    return bytes;
}

// Only the attribute `created` (seconds) may differ between two files of the same results.
static void the_same_results_give_the_same_bytes(void **state) {
    struct fixture *f = *state;
    struct error e;
    size_t n[2];
    char *bytes[2];
    for (int i = 0; i < 2; i++) {
        assert_int_equal(write_file(f, RESULT_REPLACE, &e), STATUS_OK);
        bytes[i] = slurp(f->path, &n[i]);
        sleep(1);
    }
    assert_int_equal(n[0], n[1]);
    size_t different = 0;
    for (size_t i = 0; i < n[0]; i++) {
        different += bytes[0][i] != bytes[1][i];
    }
    assert_in_range(different, 1, 14);  // the digits of 2026-01-01T00:00:00Z
    free(bytes[0]);
    free(bytes[1]);
}

static void expect_refused(struct fixture *f, const char *bytes, size_t n) {
    struct error e;
    struct result_file *file = NULL;
    FILE *to = fopen(f->path, "wb");
    fwrite(bytes, 1, n, to);
    fclose(to);
    if (result_open(f->path, &file, &e) == STATUS_OK) {
        result_close(file);
        fail_msg("a broken file of %zu bytes was read", n);
    }
    assert_true(e.status == STATUS_INPUT || e.status == STATUS_SYSTEM);
    assert_non_null(strstr(e.message, f->path));
}

static void broken_files_are_refused(void **state) {
    struct fixture *f = *state;
    result_close(written(f));
    size_t n;
    char *bytes = slurp(f->path, &n);
    for (size_t cut = 0; cut < n; cut += 1 + n / 37) {
        expect_refused(f, bytes, cut);
    }
    expect_refused(f, "not HDF5", 8);
    free(bytes);
}

static void the_summary_names_peaks_and_contacts(void **state) {
    struct fixture *f = *state;
    struct result_file *file = written(f);
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    report_print(result_report(file), to);
    fclose(to);
    assert_non_null(strstr(text, "A title"));
    assert_non_null(strstr(text, "East"));
    assert_non_null(strstr(text, "2 contacts, 1 hit, 2 impacts"));
    assert_non_null(strstr(text, "7e+05"));
    assert_non_null(strstr(text, f->path));
    for (const char *line = text; *line; line += strcspn(line, "\n") + 1) {
        assert_in_range(strcspn(line, "\n"), 0, 100);
    }
    free(text);
    result_close(file);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_report_comes_back_as_it_was_written, setup, teardown),
        cmocka_unit_test_setup_teardown(contacts_links_and_impacts_come_back, setup, teardown),
        cmocka_unit_test_setup_teardown(histories_come_back_row_by_row, setup, teardown),
        cmocka_unit_test_setup_teardown(more_rows_than_the_buffer_holds_are_written_in_blocks,
                                        setup, teardown),
        cmocka_unit_test_setup_teardown(fields_not_asked_for_are_not_written, setup, teardown),
        cmocka_unit_test_setup_teardown(a_model_without_contacts_is_written, setup, teardown),
        cmocka_unit_test_setup_teardown(an_existing_file_is_kept_unless_forced, setup, teardown),
        cmocka_unit_test_setup_teardown(a_file_that_comes_into_being_during_the_run_survives, setup,
                                        teardown),
        cmocka_unit_test_setup_teardown(an_aborted_run_leaves_nothing, setup, teardown),
        cmocka_unit_test_setup_teardown(two_runs_do_not_write_the_same_file, setup, teardown),
        cmocka_unit_test_setup_teardown(what_a_killed_run_left_is_replaced, setup, teardown),
        cmocka_unit_test_setup_teardown(a_folder_that_is_not_there_is_a_system_error, setup,
                                        teardown),
        cmocka_unit_test_setup_teardown(a_full_disk_is_a_system_error_and_leaves_nothing, setup,
                                        teardown),
        cmocka_unit_test_setup_teardown(a_name_with_a_slash_cannot_stand_in_the_file, setup,
                                        teardown),
        cmocka_unit_test_setup_teardown(the_same_results_give_the_same_bytes, setup, teardown),
        cmocka_unit_test_setup_teardown(broken_files_are_refused, setup, teardown),
        cmocka_unit_test_setup_teardown(the_summary_names_peaks_and_contacts, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
