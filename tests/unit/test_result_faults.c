// SPDX-License-Identifier: GPL-3.0-or-later
// The result file where something is in the way: existing files, full disks, broken files.
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/made_up.h"
#include "support/support.h"

static void an_existing_file_is_kept_unless_forced(void **state) {
    struct made_up *f = *state;
    struct error e;
    FILE *old = fopen(f->path, "w");
    fputs("precious", old);
    fclose(old);
    assert_int_equal(made_up_write(f, RESULT_KEEP, &e), STATUS_INPUT);
    assert_non_null(strstr(e.message, "--force"));
    struct stat s;
    assert_int_equal(stat(f->path, &s), 0);
    assert_int_equal(s.st_size, 8);
    assert_int_equal(made_up_write(f, RESULT_REPLACE, &e), STATUS_OK);
    assert_int_equal(stat(f->path, &s), 0);
    assert_true(s.st_size > 8);
}

static void a_file_that_comes_into_being_during_the_run_survives(void **state) {
    struct made_up *f = *state;
    struct error e;
    const struct result_options options = {.path = f->path, .version = "1"};
    struct result_writer *w = NULL;
    assert_int_equal(result_create(&f->model, &options, &w, &e), STATUS_OK);
    assert_int_equal(made_up_rows(w, ROWS, &e), STATUS_OK);
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
    struct made_up *f = *state;
    struct error e;
    const struct result_options options = {.path = f->path, .version = "1"};
    struct result_writer *w = NULL;
    assert_int_equal(result_create(&f->model, &options, &w, &e), STATUS_OK);
    assert_int_equal(access(f->part, F_OK), 0);
    assert_int_equal(made_up_rows(w, 3, &e), STATUS_OK);
    result_abort(w);
    assert_int_not_equal(access(f->part, F_OK), 0);
    assert_int_not_equal(access(f->path, F_OK), 0);
}

static void two_runs_do_not_write_the_same_file(void **state) {
    struct made_up *f = *state;
    struct error e;
    const struct result_options options = {.path = f->path, .version = "1"};
    struct result_writer *first = NULL, *second = NULL;
    assert_int_equal(result_create(&f->model, &options, &first, &e), STATUS_OK);
    assert_int_equal(result_create(&f->model, &options, &second, &e), STATUS_SYSTEM);
    assert_non_null(strstr(e.message, "another run"));
    assert_int_equal(made_up_rows(first, ROWS, &e), STATUS_OK);
    assert_int_equal(result_finish(first, &f->results, &e), STATUS_OK);
}

static void what_a_killed_run_left_is_replaced(void **state) {
    struct made_up *f = *state;
    FILE *left = fopen(f->part, "w");
    fputs("half a file", left);
    fclose(left);
    result_close(made_up_written(f));
    assert_int_not_equal(access(f->part, F_OK), 0);
}

static void a_folder_that_is_not_there_is_a_system_error(void **state) {
    struct made_up *f = *state;
    struct error e;
    snprintf(f->path, sizeof f->path, "%s/none/r.h5", f->folder);
    assert_int_equal(made_up_write(f, RESULT_KEEP, &e), STATUS_SYSTEM);
    assert_non_null(strstr(e.message, "No such file"));
    assert_non_null(strstr(e.message, f->path));
}

// In a child process, since the library leaks what it could not write: 0 if writing under the limit
// failed as it must and left nothing behind.
static int write_under_limit(struct made_up *f, rlim_t limit) {
    pid_t child = fork();
    if (child == 0) {
        struct error e = {.message = ""};
        const struct rlimit tight = {limit, limit};
        signal(SIGXFSZ, SIG_IGN);
        const bool good = setrlimit(RLIMIT_FSIZE, &tight) == 0 &&
                          made_up_write(f, RESULT_KEEP, &e) == STATUS_SYSTEM &&
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
    struct made_up *f = *state;
    struct stat s;
    result_close(made_up_written(f));
    assert_int_equal(stat(f->path, &s), 0);
    unlink(f->path);
    for (off_t limit = 1; limit < s.st_size; limit += 9973) {
        assert_int_equal(write_under_limit(f, (rlim_t)limit), 0);
    }
}

static void a_name_with_a_slash_cannot_stand_in_the_file(void **state) {
    struct made_up *f = *state;
    struct error e;
    struct building bad[2] = {f->model.building[0], f->model.building[1]};
    assert_int_equal(f->model.n_body, 2);
    bad[0].name = "a/b";
    f->model.building = bad;
    assert_int_equal(made_up_write(f, RESULT_KEEP, &e), STATUS_INPUT);
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

// Takes the checksum of the data out of the bytes of the file, as it depends on all others.
static void blank_checksum(const char *path, char *bytes, size_t n) {
    struct result_sums sums;
    struct error e;
    int found = 0;
    assert_int_equal(result_verify(path, &sums, &e), STATUS_OK);
    for (size_t i = 0; i + CHECKSUM_DIGITS <= n; i++) {
        if (memcmp(bytes + i, sums.data.digits, CHECKSUM_DIGITS) == 0) {
            memset(bytes + i, 0, CHECKSUM_DIGITS);
            found++;
        }
    }
    assert_int_equal(found, 1);
}

// Only the attribute `created` (seconds), and with it the checksum, may differ between two files of
// the same results.
static void the_same_results_give_the_same_bytes(void **state) {
    struct made_up *f = *state;
    struct error e;
    size_t n[2];
    char *bytes[2];
    for (int i = 0; i < 2; i++) {
        assert_int_equal(made_up_write(f, RESULT_REPLACE, &e), STATUS_OK);
        bytes[i] = slurp(f->path, &n[i]);
        blank_checksum(f->path, bytes[i], n[i]);
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

static void expect_refused(struct made_up *f, const char *bytes, size_t n) {
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
    struct made_up *f = *state;
    result_close(made_up_written(f));
    size_t n;
    char *bytes = slurp(f->path, &n);
    for (size_t cut = 0; cut < n; cut += 1 + n / 37) {
        expect_refused(f, bytes, cut);
    }
    expect_refused(f, "not HDF5", 8);
    free(bytes);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(an_existing_file_is_kept_unless_forced, made_up_setup,
                                        made_up_teardown),
        cmocka_unit_test_setup_teardown(a_file_that_comes_into_being_during_the_run_survives,
                                        made_up_setup, made_up_teardown),
        cmocka_unit_test_setup_teardown(an_aborted_run_leaves_nothing, made_up_setup,
                                        made_up_teardown),
        cmocka_unit_test_setup_teardown(two_runs_do_not_write_the_same_file, made_up_setup,
                                        made_up_teardown),
        cmocka_unit_test_setup_teardown(what_a_killed_run_left_is_replaced, made_up_setup,
                                        made_up_teardown),
        cmocka_unit_test_setup_teardown(a_folder_that_is_not_there_is_a_system_error, made_up_setup,
                                        made_up_teardown),
        cmocka_unit_test_setup_teardown(a_full_disk_is_a_system_error_and_leaves_nothing,
                                        made_up_setup, made_up_teardown),
        cmocka_unit_test_setup_teardown(a_name_with_a_slash_cannot_stand_in_the_file, made_up_setup,
                                        made_up_teardown),
        cmocka_unit_test_setup_teardown(the_same_results_give_the_same_bytes, made_up_setup,
                                        made_up_teardown),
        cmocka_unit_test_setup_teardown(broken_files_are_refused, made_up_setup, made_up_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
