// SPDX-License-Identifier: GPL-3.0-or-later
// Parts that claim to be of one study, but are not: each is an error and leaves no file.
#include <hdf5.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "jostle/study.h"
#include "jostle/study_merge.h"
#include "support/support.h"

static const char text[] = "sweep k values 100 400 900 1600\n"
                           "sweep v range 1 3 3\n"
                           "building A -floors 1 -mass 1 -stiffness $k\n"
                           "initial A:1 -velocity $v\n"
                           "step fixed 0.01\n"
                           "duration 1\n";

enum { N_PART = 2, PATH_SIZE = 256 };

struct parts {
    char path[N_PART + 1][PATH_SIZE];  // the last one: the second part again
    const char *list[N_PART + 1];
};

static void run_part(const char *path, struct study_shard shard) {
    struct deck *d;
    struct model *m;
    struct error e;
    struct study_progress p;
    const char *deck = support_write("merge.deck", text);
    assert_int_equal(deck_open(deck, NULL, 0, &d, &e), STATUS_OK);
    assert_int_equal(model_build(d, &m, &e), STATUS_OK);
    const struct study_request q = {
        .first = m,
        .n_thread = 1,
        .shard = shard,
        .result = {.path = path, .existing = RESULT_REPLACE, .version = "1"}};
    assert_int_equal(study_run(&q, &p, &e), STATUS_OK);
    assert_int_equal(p.n_run, 6);
    model_free(m);
}

static void make_parts(struct parts *p) {
    static const char *const names[] = {"one.h5", "two.h5", "again.h5"};
    for (int i = 0; i <= N_PART; i++) {
        snprintf(p->path[i], PATH_SIZE, "%s", support_path(names[i]));
        p->list[i] = p->path[i];
        run_part(p->path[i], (struct study_shard){i == 0 ? 1 : 2, N_PART});
    }
}

static int merge(const struct parts *p, struct study_merged *merged, struct error *e) {
    const char *path = support_path("merged.h5");
    const struct study_merge_request q = {
        .path = p->list, .n_path = N_PART + 1, .result = {.path = path, .version = "1"}};
    unlink(path);
    return study_merge(&q, merged, e);
}

// Gives a changed file the checksum of what it says now, as somebody would who knows how.
static void seal_again(const char *path) {
    struct result_sums sums;
    struct error e;
    assert_int_equal(result_verify(path, &sums, &e), STATUS_FAILED);
    assert_non_null(strstr(e.message, "its data have changed since it was written"));
    hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    hid_t attribute = H5Aopen(file, "data_sha256", H5P_DEFAULT), type = H5Aget_type(attribute);
    const char *digits = sums.data.digits;
    assert_true(H5Awrite(attribute, type, &digits) >= 0);
    H5Tclose(type);
    H5Aclose(attribute);
    H5Fclose(file);
    assert_int_equal(result_verify(path, &sums, &e), STATUS_OK);
}

// Opens a dataset of the last part for `change`, which has its number of values.
static void change_last(const struct parts *p, const char *dataset, hid_t type, const void *value) {
    hid_t file = H5Fopen(p->path[N_PART], H5F_ACC_RDWR, H5P_DEFAULT);
    hid_t set = H5Dopen2(file, dataset, H5P_DEFAULT);
    assert_true(set >= 0);
    assert_true(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0);
    H5Dclose(set);
    H5Fclose(file);
    seal_again(p->path[N_PART]);
}

static void refused(const struct parts *p, const char *why) {
    struct study_merged merged;
    struct error e;
    assert_int_equal(merge(p, &merged, &e), STATUS_INPUT);
    if (!strstr(e.message, why)) {
        fail_msg("'%s' does not say '%s'", e.message, why);
    }
    assert_int_not_equal(access(support_path("merged.h5"), F_OK), 0);
    assert_int_not_equal(access(support_path("merged.h5.part"), F_OK), 0);
}

static void the_same_part_twice_does_no_harm(void **state) {
    (void)state;
    struct parts p;
    struct study_merged merged;
    struct error e;
    make_parts(&p);
    assert_int_equal(merge(&p, &merged, &e), STATUS_OK);
    assert_true(merged.n_run == 12 && merged.n_missing == 0 && merged.n_failed == 0);
}

static void parts_that_disagree_on_a_run_are_refused(void **state) {
    (void)state;
    const double energy[6] = {1, 2, 3, 4, 5, 6};
    struct parts p;
    make_parts(&p);
    change_last(&p, "/energy/kinetic", H5T_NATIVE_DOUBLE, energy);
    refused(&p, "run 2 has other results in");
}

static void outcomes_that_disagree_are_refused(void **state) {
    (void)state;
    const int status[6] = {0, 0, 1, 0, 0, 0};
    struct parts p;
    make_parts(&p);
    change_last(&p, "/status", H5T_NATIVE_INT, status);
    refused(&p, "has other results in");
}

static void numbers_of_runs_that_cannot_be_are_damage(void **state) {
    (void)state;
    static const double bad[][6] = {{2, 4, 5, 8, 10, 13},
                                    {0, 4, 5, 8, 10, 11},
                                    {2, 2, 5, 8, 10, 11},
                                    {2, 4, 5, 8.5, 10, 11},
                                    {2, 4, 5, 8, 10, 1e300}};
    struct parts p;
    make_parts(&p);
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        change_last(&p, "/run", H5T_NATIVE_DOUBLE, bad[i]);
        refused(&p, "it has a run of number");
    }
}

// Puts an empty dataset of these dimensions in the place of another one of the last part.
static void replace_last(const struct parts *p, const char *dataset, int n_dim,
                         const hsize_t *dim) {
    const hsize_t chunk[] = {1, 1, 1};
    hid_t file = H5Fopen(p->path[N_PART], H5F_ACC_RDWR, H5P_DEFAULT);
    hid_t space = H5Screate_simple(n_dim, dim, NULL);
    hid_t list = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(list, n_dim, chunk);
    assert_true(H5Ldelete(file, dataset, H5P_DEFAULT) >= 0);
    hid_t set = H5Dcreate2(file, dataset, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, list, H5P_DEFAULT);
    assert_true(set >= 0);
    H5Dclose(set);
    H5Pclose(list);
    H5Sclose(space);
    H5Fclose(file);
}

static void results_of_dimensions_that_the_study_does_not_have_are_damage(void **state) {
    (void)state;
    static const struct {
        int n_dim;
        hsize_t dim[3];
        const char *why;
    } bad[] = {
        {1, {5}, "dataset 'drift' does not have the dimensions of the study"},
        {1, {7}, "dataset 'drift' does not have the dimensions of the study"},
        {2, {5, 1}, "dataset 'drift' does not have the dimensions of the study"},
        {3, {6, 1, 1}, "dataset 'drift' does not have the dimensions of the study"},
        {2, {6, 1 << 25}, "dataset 'drift' does not have the dimensions of the study"},
        {2, {6, 1 << 27}, "dataset 'drift' does not have the dimensions of the study"},
        {2, {6, 1}, "dataset 'drift' is not all there"},
    };
    struct parts p;
    make_parts(&p);
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        replace_last(&p, "/buildings/A/envelope/drift", bad[i].n_dim, bad[i].dim);
        refused(&p, bad[i].why);
    }
}

static void a_status_that_there_is_not_is_damage(void **state) {
    (void)state;
    const int status[6] = {0, 0, 0, 0, 77, 0};
    struct parts p;
    make_parts(&p);
    change_last(&p, "/status", H5T_NATIVE_INT, status);
    refused(&p, "a run has the status 77");
}

static int enough(void *context, struct error *e) {
    (void)context;
    return error_set(e, STATUS_SYSTEM, "enough");
}

static void merging_that_is_stopped_leaves_nothing(void **state) {
    (void)state;
    struct parts p;
    struct study_merged merged;
    struct error e;
    make_parts(&p);
    const char *path = support_path("stopped.h5");
    const struct study_merge_request q = {
        .path = p.list, .n_path = N_PART, .result = {.path = path, .version = "1"}, .poll = enough};
    assert_int_equal(study_merge(&q, &merged, &e), STATUS_SYSTEM);
    assert_string_equal(e.message, "enough");
    assert_int_not_equal(access(path, F_OK), 0);
    assert_int_not_equal(access(support_path("stopped.h5.part"), F_OK), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_same_part_twice_does_no_harm),
        cmocka_unit_test(parts_that_disagree_on_a_run_are_refused),
        cmocka_unit_test(outcomes_that_disagree_are_refused),
        cmocka_unit_test(numbers_of_runs_that_cannot_be_are_damage),
        cmocka_unit_test(results_of_dimensions_that_the_study_does_not_have_are_damage),
        cmocka_unit_test(a_status_that_there_is_not_is_damage),
        cmocka_unit_test(merging_that_is_stopped_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
