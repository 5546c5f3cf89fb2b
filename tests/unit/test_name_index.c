// SPDX-License-Identifier: GPL-3.0-or-later
// The index of names against a list of all of them.
#include <stdio.h>
#include <string.h>

#include "core/arena.h"
#include "model/name_index.h"
#include "support/support.h"

static void nothing_is_found_in_an_empty_index(void **state) {
    (void)state;
    const struct name_index x = {0};
    assert_int_equal(name_index_find(&x, "A", 1), -1);
    assert_int_equal(name_index_find(&x, "", 0), -1);
}

static void each_of_many_names_is_found_and_no_other(void **state) {
    (void)state;
    enum { NAMES = 5000 };
    struct arena *a = arena_create();
    struct name_index x = {0};
    for (int i = 0; i < NAMES; i++) {
        const char *name = arena_format(a, "B%d", i);
        assert_int_equal(name_index_find(&x, name, strlen(name)), -1);
        assert_true(name_index_add(&x, a, name, i));
    }
    for (int i = 0; i < NAMES; i++) {
        char name[16];
        const int length = snprintf(name, sizeof name, "B%d", i);
        assert_int_equal(name_index_find(&x, name, (size_t)length), i);
    }
    assert_int_equal(name_index_find(&x, "B5000", 5), -1);
    arena_free(a);
}

// Of `A1:3` the building is A1, though A and A12 are there, too.
static void a_name_may_be_part_of_a_text(void **state) {
    (void)state;
    struct arena *a = arena_create();
    struct name_index x = {0};
    static const char *const name[] = {"A", "A1", "A12"};
    for (int i = 0; i < 3; i++) {
        assert_true(name_index_add(&x, a, name[i], i));
    }
    assert_int_equal(name_index_find(&x, "A1:3", 2), 1);
    assert_int_equal(name_index_find(&x, "A12", 1), 0);
    assert_int_equal(name_index_find(&x, "A123", 4), -1);
    arena_free(a);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_is_found_in_an_empty_index),
        cmocka_unit_test(each_of_many_names_is_found_and_no_other),
        cmocka_unit_test(a_name_may_be_part_of_a_text),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
