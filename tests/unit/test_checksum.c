// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/checksum.h"
#include "core/hash.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "support/support.h"

// The first three vectors of the test suite that comes with the draft of the function
// (Fowler, Noll, Vo, Eastlake: The FNV Non-Cryptographic Hash Algorithm, IETF).
static void hashes_of_names_are_those_published(void **state) {
    (void)state;
    assert_int_equal(hash_add(hash_start, "", 0), UINT64_C(0xcbf29ce484222325));
    assert_int_equal(hash_add(hash_start, "a", 1), UINT64_C(0xaf63dc4c8601ec8c));
    assert_int_equal(hash_add(hash_start, "foobar", 6), UINT64_C(0x85944171f73967e8));
}

// FIPS 180-2, appendix B.1 and B.2, and the empty message.
static void checksums_are_those_published(void **state) {
    (void)state;
    static const struct {
        const char *text, *digits;
    } known[] = {
        {"", "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"},
        {"abc", "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"},
        {"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq",
         "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1"},
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        struct checksum_sum sum;
        struct checksum out;
        checksum_start(&sum);
        for (const char *c = known[i].text; *c; c++) {
            checksum_add(&sum, c, 1);
        }
        checksum_end(&sum, &out);
        assert_string_equal(out.digits, known[i].digits);
    }
    assert_memory_equal(&(uint64_t){checksum_short("abc", 3)}, "\xba\x78\x16\xbf\x8f\x01\xcf\xea",
                        8);
}

static void texts_and_numbers_do_not_run_into_each_other(void **state) {
    (void)state;
    struct checksum_sum sum;
    struct checksum one, other;
    checksum_start(&sum);
    checksum_add_text(&sum, "ab");
    checksum_add_text(&sum, "c");
    checksum_end(&sum, &one);
    checksum_add_text(&sum, "a");
    checksum_add_text(&sum, "bc");
    checksum_end(&sum, &other);
    assert_false(checksum_equal(&one, &other));
    checksum_add_number(&sum, 0x0201);
    checksum_end(&sum, &one);
    checksum_add(&sum, "\1\2\0\0\0\0\0\0", 8);
    checksum_end(&sum, &other);
    assert_true(checksum_equal(&one, &other));
}

static void a_file_has_a_checksum_of_all_its_bytes(void **state) {
    (void)state;
    enum { SIZE = 200001 };
    const char *path = support_path("summed");
    struct checksum sum[3];
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
    assert_false(checksum_equal(&sum[0], &sum[1]));
    assert_true(checksum_equal(&sum[1], &sum[2]));
    unlink(path);
    assert_int_equal(checksum_file(path, &sum[0], &e), STATUS_INPUT);
    assert_non_null(strstr(e.message, path));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hashes_of_names_are_those_published),
        cmocka_unit_test(checksums_are_those_published),
        cmocka_unit_test(texts_and_numbers_do_not_run_into_each_other),
        cmocka_unit_test(a_file_has_a_checksum_of_all_its_bytes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
