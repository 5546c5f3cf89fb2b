// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of a study: which runs they have, and how missing ones are named.
#include <stdlib.h>
#include <string.h>

#include "jostle/study_merge.h"
#include "study/number_list.h"
#include "support/support.h"

static void parts_have_every_run_once_and_sizes_differ_by_one(void **state) {
    (void)state;
    for (long n_run = 1; n_run <= 40; n_run++) {
        for (long n = 1; n <= 45; n++) {
            int seen[40] = {0};
            for (long k = 1; k <= n; k++) {
                const struct study_shard s = {k, n};
                const long size = study_shard_size(&s, n_run);
                assert_in_range(size, n_run / n, (n_run + n - 1) / n);
                long before = -1;
                for (long i = 0; i < size; i++) {
                    const long run = study_shard_run(&s, i);
                    assert_true(run > before && run < n_run);
                    seen[run]++;
                    before = run;
                }
                assert_true(study_shard_run(&s, size) >= n_run);
            }
            for (long run = 0; run < n_run; run++) {
                assert_int_equal(seen[run], 1);
            }
        }
    }
}

static void no_part_is_the_whole_study(void **state) {
    (void)state;
    const struct study_shard whole = {0, 0};
    assert_int_equal(study_shard_size(&whole, 7), 7);
    assert_int_equal(study_shard_run(&whole, 5), 5);
}

// Of 44 records, 3 gaps and 20 intensities, which vary fastest, in 20 parts: each part has each
// intensity as often as any other part has, but for one.
static void parts_share_out_the_values_of_the_last_sweep(void **state) {
    (void)state;
    for (long k = 1; k <= 20; k++) {
        const struct study_shard s = {k, 20};
        int n[20] = {0};
        assert_int_equal(study_shard_size(&s, 2640), 132);
        for (long i = 0; i < 132; i++) {
            n[study_shard_run(&s, i) % 20]++;
        }
        for (int j = 0; j < 20; j++) {
            assert_in_range(n[j], 132 / 20, 132 / 20 + 1);
        }
    }
}

static const char *listed(char *text, size_t size, const long *number, int n) {
    struct number_list list = {.text = text, .size = size};
    text[0] = '\0';
    for (int i = 0; i < n; i++) {
        number_list_add(&list, number[i]);
    }
    number_list_end(&list);
    return text;
}

static void numbers_are_listed_with_their_ranges(void **state) {
    (void)state;
    char text[64];
    const long number[] = {1, 3, 4, 6, 7, 8, 20};
    assert_string_equal(listed(text, sizeof text, number, 0), "");
    assert_string_equal(listed(text, sizeof text, number, 1), "1");
    assert_string_equal(listed(text, sizeof text, number, 3), "1, 3, 4");
    assert_string_equal(listed(text, sizeof text, number, 7), "1, 3, 4, 6-8, 20");
}

static void a_list_without_room_ends_in_dots(void **state) {
    (void)state;
    const long number[] = {1000, 2000, 3000, 4000, 5000};
    for (size_t size = 8; size <= 40; size++) {
        char text[40 + 8];
        memset(text, '#', sizeof text);
        listed(text, size, number, 5);
        assert_true(strlen(text) < size && text[size] == '#');
        assert_true(strlen(text) == 28 || strcmp(text + strlen(text) - 3, "...") == 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_have_every_run_once_and_sizes_differ_by_one),
        cmocka_unit_test(no_part_is_the_whole_study),
        cmocka_unit_test(parts_share_out_the_values_of_the_last_sweep),
        cmocka_unit_test(numbers_are_listed_with_their_ranges),
        cmocka_unit_test(a_list_without_room_ends_in_dots),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
