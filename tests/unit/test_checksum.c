// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/checksum.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "support/support.h"

// The first three vectors of the test suite that comes with the draft of the function
// (Fowler, Noll, Vo, Eastlake: The FNV Non-Cryptographic Hash Algorithm, IETF).
static void bytes_have_the_published_sums(void **state) {
    (void)state;
    assert_int_equal(checksum_add(checksum_start, "", 0), UINT64_C(0xcbf29ce484222325));
    assert_int_equal(checksum_add(checksum_start, "a", 1), UINT64_C(0xaf63dc4c8601ec8c));
    assert_int_equal(checksum_add(checksum_start, "foobar", 6), UINT64_C(0x85944171f73967e8));
}

static void a_changed_bit_changes_the_sum_of_many(void **state) {
    (void)state;
    enum { LONGEST = 140 };
    unsigned char text[LONGEST];
    for (size_t n = 0; n < LONGEST; n++) {
        text[n] = (unsigned char)(7 * n);
    }
    for (size_t n = 1; n <= LONGEST; n++) {
        const uint64_t sum = checksum_many(checksum_start, text, n);
        assert_int_not_equal(sum, checksum_many(checksum_start, text, n - 1));
        for (size_t bit = 0; bit < 8 * n; bit++) {
            text[bit / 8] ^= (unsigned char)(1U << bit % 8);
            assert_int_not_equal(sum, checksum_many(checksum_start, text, n));
            text[bit / 8] ^= (unsigned char)(1U << bit % 8);
        }
    }
}

// Two signs that change places, among others.
static void two_changed_bits_change_the_sum_of_many(void **state) {
    (void)state;
    enum { LONG = 72, BITS = 8 * LONG };  // so long that two words share each of the four sums
    unsigned char text[LONG] = {0};
    const uint64_t sum = checksum_many(checksum_start, text, LONG);
    for (size_t one = 0; one < BITS; one++) {
        text[one / 8] ^= (unsigned char)(1U << one % 8);
        for (size_t other = one + 1; other < BITS; other++) {
            text[other / 8] ^= (unsigned char)(1U << other % 8);
            assert_int_not_equal(sum, checksum_many(checksum_start, text, LONG));
            text[other / 8] ^= (unsigned char)(1U << other % 8);
        }
        text[one / 8] ^= (unsigned char)(1U << one % 8);
    }
}

static void a_file_has_a_sum_of_all_its_bytes(void **state) {
    (void)state;
    enum { SIZE = 200001 };
    const char *path = support_path("summed");
    uint64_t sum[3];
    struct error e;
    for (int i = 0; i < 3; i++) {
        FILE *f = fopen(path, "w");
        assert_non_null(f);
        for (int k = 0; k < SIZE; k++) {
            putc(i > 0 && k == SIZE - 1 ? 1 : 0, f);
        }
        assert_int_equal(fclose(f), 0);
        assert_int_equal(checksum_file(path, &sum[i], &e), STATUS_OK);
    }
    assert_int_not_equal(sum[0], sum[1]);
    assert_int_equal(sum[1], sum[2]);
    unlink(path);
    assert_int_equal(checksum_file(path, &sum[0], &e), STATUS_INPUT);
    assert_non_null(strstr(e.message, path));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bytes_have_the_published_sums),
        cmocka_unit_test(a_changed_bit_changes_the_sum_of_many),
        cmocka_unit_test(two_changed_bits_change_the_sum_of_many),
        cmocka_unit_test(a_file_has_a_sum_of_all_its_bytes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
