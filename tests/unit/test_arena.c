// SPDX-License-Identifier: GPL-3.0-or-later
// Memory that is given back all at once.
#include <stdalign.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/lanes.h"
#include "support/support.h"

static void memory_is_zeroed_and_aligned(void **state) {
    (void)state;
    struct arena *a = arena_create();
    for (size_t n = 1; n < 10000; n = 3 * n + 1) {
        unsigned char *p = arena_alloc(a, n, 1);
        assert_non_null(p);
        assert_int_equal((uintptr_t)p % alignof(max_align_t), 0);
        for (size_t i = 0; i < n; i++) {
            assert_int_equal(p[i], 0);
        }
        memset(p, 0xFF, n);
    }
    arena_free(a);
}

static void a_size_that_overflows_is_refused(void **state) {
    (void)state;
    struct arena *a = arena_create();
    assert_null(arena_alloc(a, SIZE_MAX / 4, 8));
    assert_null(arena_alloc(a, SIZE_MAX, 1));
    assert_non_null(arena_alloc(a, 0, 8));
    arena_free(a);
}

static void a_failure_is_remembered(void **state) {
    (void)state;
    struct arena *a = arena_create();
    assert_non_null(arena_alloc(a, 1, 8));
    assert_false(arena_failed(a));
    assert_null(arena_alloc(a, SIZE_MAX, 1));
    assert_non_null(arena_alloc(a, 1, 8));
    assert_true(arena_failed(a));
    arena_free(a);
}

static void texts_are_copied_with_a_final_0(void **state) {
    (void)state;
    struct arena *a = arena_create();
    assert_string_equal(arena_text(a, "storey", 5), "store");
    assert_string_equal(arena_format(a, "%s %d", "floor", 3), "floor 3");
    arena_free(a);
}

// Loops over whole lanes read the elements before and behind the one they are at.
static void arrays_for_lanes_are_0_from_one_before_to_one_behind_whole_lanes(void **state) {
    (void)state;
    for (int n = 1; n <= 2 * LANES_WIDTH + 1; n++) {
        struct arena *a = arena_create();
        memset(arena_alloc(a, 64, 1), 0xFF, 64);
        double *x = lanes_array(a, n);
        memset(arena_alloc(a, 64, 1), 0xFF, 64);
        for (int i = -1; i <= lanes_whole(n); i++) {
            assert_true(x[i] == 0.0);
        }
        arena_free(a);
    }
}

static void freeing_nothing_is_allowed(void **state) {
    (void)state;
    arena_free(NULL);
    struct arena *a = arena_create();
    assert_non_null(a);
    arena_free(a);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_is_zeroed_and_aligned),
        cmocka_unit_test(a_size_that_overflows_is_refused),
        cmocka_unit_test(a_failure_is_remembered),
        cmocka_unit_test(texts_are_copied_with_a_final_0),
        cmocka_unit_test(arrays_for_lanes_are_0_from_one_before_to_one_behind_whole_lanes),
        cmocka_unit_test(freeing_nothing_is_allowed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
