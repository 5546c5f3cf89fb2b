// SPDX-License-Identifier: GPL-3.0-or-later
// The result file: what is written comes back.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/made_up.h"
#include "support/support.h"

static void a_report_comes_back_as_it_was_written(void **state) {
    struct made_up *f = *state;
    struct result_file *file = made_up_written(f);
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
    assert_true(r->building[1].height[2] == 0.0);
    for (int p = 0; p < PEAK_COUNT; p++) {
        for (int i = 0; i < FLOORS; i++) {
            assert_close(r->building[1].peak[p][i], 100 * p + FLOORS + i + 0.125, 0);
            assert_close(r->building[1].peak_time[p][i], 0.01 * (FLOORS + i), 0);
        }
    }
    assert_close(r->building[0].residual_drift[2], 0.5, 0);
    assert_null(r->building[1].residual_drift);
    assert_close(r->building[0].period[1], acos(-1.0) / 2, 1e-15);
    assert_close(r->energy[ENERGY_CONTACT], 1000.5 + ENERGY_CONTACT, 0);
    assert_close(r->residual_peak, 1e-7, 0);
    assert_int_equal(r->totals.iterations, 250);
    assert_int_equal(r->totals.rejected, 1);
    result_close(file);
}

static void contacts_links_and_impacts_come_back(void **state) {
    struct result_file *file = made_up_written(*state);
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

static int read(const struct result_file *file, enum history_kind kind, int field, int index,
                int floor, double *out, struct error *e) {
    return result_history(file, &(struct history){kind, field, index, floor}, out, e);
}

static void histories_come_back_row_by_row(void **state) {
    struct result_file *file = made_up_written(*state);
    struct error e;
    double v[ROWS];
    assert_int_equal(result_report(file)->n_row, ROWS);
    assert_int_equal(read(file, HISTORY_TIME, 0, 0, 0, v, &e), STATUS_OK);
    assert_close(v[ROWS - 1], 1.0, 1e-15);
    assert_int_equal(read(file, HISTORY_FLOOR, FIELD_DRIFT, 1, 2, v, &e), STATUS_OK);
    assert_close(v[7], 3000 + 50 + 7 / 16.0, 0);
    assert_int_equal(read(file, HISTORY_CONTACT, FIELD_PENETRATION, 1, 0, v, &e), STATUS_OK);
    assert_close(v[3], 6000 + 10 + 3 / 16.0, 0);
    assert_int_equal(read(file, HISTORY_GROUND, 0, 1, 0, v, &e), STATUS_OK);
    assert_close(v[10], 7000 + 10 / 16.0, 0);
    result_close(file);
}

static void more_rows_than_the_buffer_holds_are_written_in_blocks(void **state) {
    struct made_up *f = *state;
    f->model.n_step = 10001;
    f->model.output.every = 2;
    struct result_file *file = made_up_written(f);
    const long n = result_report(file)->n_row;
    struct error e;
    double *v = calloc((size_t)n, sizeof *v);
    assert_int_equal(n, 5002);
    assert_int_equal(read(file, HISTORY_FLOOR, FIELD_VELOCITY, 0, 1, v, &e), STATUS_OK);
    for (long k = 0; k < n; k++) {
        assert_close(v[k], 1010 + (double)k / 16, 0);
    }
    free(v);
    result_close(file);
}

static void fields_not_asked_for_are_not_written(void **state) {
    struct made_up *f = *state;
    f->model.output.fields = FIELD_DISPLACEMENT | FIELD_FORCE;
    f->model.output.single = true;
    struct result_file *file = made_up_written(f);
    struct error e;
    double v[ROWS];
    assert_int_equal(result_report(file)->fields, FIELD_DISPLACEMENT | FIELD_FORCE);
    assert_int_equal(read(file, HISTORY_FLOOR, FIELD_DRIFT, 0, 0, v, &e), STATUS_INPUT);
    assert_non_null(strstr(e.message, "drift"));
    assert_int_equal(read(file, HISTORY_FLOOR, FIELD_DISPLACEMENT, 0, 0, v, &e), STATUS_OK);
    assert_close(v[5], 5 / 16.0, 0);
    result_close(file);
}

static void a_model_without_contacts_is_written(void **state) {
    struct made_up *f = *state;
    f->model.n_contact = 0;
    f->model.n_link = 0;
    f->results.n_impact = 0;
    struct result_file *file = made_up_written(f);
    assert_int_equal(result_report(file)->n_contact, 0);
    assert_int_equal(result_report(file)->n_impact, 0);
    result_close(file);
}

static void the_summary_names_peaks_and_contacts(void **state) {
    struct made_up *f = *state;
    struct result_file *file = made_up_written(f);
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    struct error e;
    assert_int_equal(report_print(result_report(file), to, &e), STATUS_OK);
    fclose(to);
    assert_non_null(strstr(text, "A title"));
    assert_non_null(strstr(text, "East"));
    assert_non_null(strstr(text, "2 contacts, 1 hit, 2 impacts"));
    assert_non_null(strstr(text, " 700000 "));
    assert_non_null(strstr(text, f->path));
    for (const char *line = text; *line; line += strcspn(line, "\n") + 1) {
        assert_in_range(strcspn(line, "\n"), 0, 100);
    }
    free(text);
    result_close(file);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_report_comes_back_as_it_was_written, made_up_setup,
                                        made_up_teardown),
        cmocka_unit_test_setup_teardown(contacts_links_and_impacts_come_back, made_up_setup,
                                        made_up_teardown),
        cmocka_unit_test_setup_teardown(histories_come_back_row_by_row, made_up_setup,
                                        made_up_teardown),
        cmocka_unit_test_setup_teardown(more_rows_than_the_buffer_holds_are_written_in_blocks,
                                        made_up_setup, made_up_teardown),
        cmocka_unit_test_setup_teardown(fields_not_asked_for_are_not_written, made_up_setup,
                                        made_up_teardown),
        cmocka_unit_test_setup_teardown(a_model_without_contacts_is_written, made_up_setup,
                                        made_up_teardown),
        cmocka_unit_test_setup_teardown(the_summary_names_peaks_and_contacts, made_up_setup,
                                        made_up_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
