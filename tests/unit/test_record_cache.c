// SPDX-License-Identifier: GPL-3.0-or-later
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "core/arena.h"
#include "motion/record_cache.h"
#include "support/support.h"

enum { N_SAMPLE = 1000 };

static void write_record(const char *path, double first) {
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    for (int i = 0; i < N_SAMPLE; i++) {
        fprintf(f, "%.17g\n", i == 0 ? first : 0.01 * (i % 3 - 1));
    }
    assert_int_equal(fclose(f), 0);
}

static struct record_request request_of(const char *path) {
    return (struct record_request){.path = path, .dt = 0.01, .unit = "g", .gravity = 9.81};
}

static double first_value(struct record_cache *s, struct arena *a, const char *path) {
    struct record_request request = request_of(path);
    struct record r;
    struct error e;
    assert_int_equal(record_cache_read(s, a, &request, &r, &e), STATUS_OK);
    assert_int_equal(r.n, N_SAMPLE);
    return r.value[0];
}

static void a_record_is_read_once(void **state) {
    (void)state;
    struct arena *a = arena_create();
    struct record_cache *s = record_cache_create((size_t)1 << 20);
    write_record("one.txt", 0.25);
    struct record_request request = request_of("one.txt");
    struct record direct, r;
    struct error e;
    assert_int_equal(record_read(a, &request, &direct, &e), STATUS_OK);
    assert_int_equal(record_cache_read(s, a, &request, &r, &e), STATUS_OK);
    unlink("one.txt");
    assert_int_equal(record_cache_read(s, a, &request, &r, &e), STATUS_OK);
    assert_int_equal(r.n, direct.n);
    assert_memory_equal(r.value, direct.value, direct.n * sizeof *direct.value);
    assert_true(r.dt == direct.dt && r.unit == direct.unit);
    assert_string_equal(r.format, direct.format);
    record_cache_free(s);
    arena_free(a);
}

static void another_request_for_the_file_is_another_record(void **state) {
    (void)state;
    struct arena *a = arena_create();
    struct record_cache *s = record_cache_create((size_t)1 << 20);
    write_record("two.txt", 0.25);
    struct record_request request = request_of("two.txt");
    struct record r;
    struct error e;
    assert_int_equal(record_cache_read(s, a, &request, &r, &e), STATUS_OK);
    request.gravity = 10.0;
    assert_int_equal(record_cache_read(s, a, &request, &r, &e), STATUS_OK);
    assert_true(r.unit == 10.0);
    request.dt = 0.02;
    assert_int_equal(record_cache_read(s, a, &request, &r, &e), STATUS_OK);
    assert_true(r.dt == 0.02);
    request.demean = true;
    assert_int_equal(record_cache_read(s, a, &request, &r, &e), STATUS_OK);
    assert_true(r.mean != 0.0);
    unlink("two.txt");
    record_cache_free(s);
    arena_free(a);
}

static void what_was_not_used_for_longest_makes_room(void **state) {
    (void)state;
    struct arena *a = arena_create();
    // Two records: 8 bytes a sample, the record, and what the cache notes of it.
    struct record_cache *s =
        record_cache_create(2 * (sizeof(double) * N_SAMPLE + sizeof(struct record) + 1000));
    const char *const path[] = {"a.txt", "b.txt", "c.txt"};
    for (int i = 0; i < 2; i++) {
        write_record(path[i], 0.1 * (i + 1));
        first_value(s, a, path[i]);
    }
    first_value(s, a, path[0]);
    write_record(path[2], 0.3);
    first_value(s, a, path[2]);
    for (int i = 0; i < 3; i++) {
        write_record(path[i], 0.5);
    }
    assert_true(first_value(s, a, path[0]) == 0.1);
    assert_true(first_value(s, a, path[2]) == 0.3);
    assert_true(first_value(s, a, path[1]) == 0.5);
    for (int i = 0; i < 3; i++) {
        unlink(path[i]);
    }
    record_cache_free(s);
    arena_free(a);
}

static void errors_are_those_of_the_file(void **state) {
    (void)state;
    struct arena *a = arena_create();
    struct record_cache *s = record_cache_create((size_t)1 << 20);
    struct record_request request = request_of("missing.txt");
    struct record r;
    struct error e;
    assert_int_not_equal(record_cache_read(s, a, &request, &r, &e), STATUS_OK);
    assert_int_equal(r.wrong, RECORD_PATH);
    write_record("missing.txt", 0.25);
    assert_int_equal(record_cache_read(s, a, &request, &r, &e), STATUS_OK);
    unlink("missing.txt");
    record_cache_free(s);
    arena_free(a);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_record_is_read_once),
        cmocka_unit_test(another_request_for_the_file_is_another_record),
        cmocka_unit_test(what_was_not_used_for_longest_makes_room),
        cmocka_unit_test(errors_are_those_of_the_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
