// SPDX-License-Identifier: GPL-3.0-or-later
// Nothing but time depends on what heap_expect does: memory is there before and after.
#include "core/heap.h"

#include <stdlib.h>
#include <string.h>

#include "support/support.h"

enum { PIECES = 500, PIECE = 4096 };

static void use_memory(void) {
    char *piece[PIECES];
    for (int i = 0; i < PIECES; i++) {
        piece[i] = malloc(PIECE);
        assert_non_null(piece[i]);
        memset(piece[i], i % 100, PIECE);
    }
    for (int i = 0; i < PIECES; i++) {
        assert_int_equal(piece[i][PIECE - 1], i % 100);
        free(piece[i]);
    }
}

static void memory_is_there_whatever_was_expected(void **state) {
    (void)state;
    static const size_t expected[] = {0, 1, (size_t)PIECES * PIECE, (size_t)20 << 20};
    for (size_t k = 0; k < sizeof expected / sizeof expected[0]; k++) {
        heap_expect(expected[k]);
        use_memory();
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_is_there_whatever_was_expected),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
