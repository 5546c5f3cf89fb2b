// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of result files that somebody else has written: none leads astray.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/foreign.h"
#include "support/hostile.h"

static void any_numbers_of_result_files_are_drawn_or_refused(void **state) {
    static const double value[] = {1e300, -1e300, 1e308, 1e-310, 5e-324, 0, -1, 1e18, 3e9};
    (void)state;
    for (int k = 0; k < N_HOSTILE_FILE; k++) {
        for (size_t i = 0; i < sizeof value / sizeof value[0] + 3; i++) {
            const double x = i < 9     ? value[i]
                             : i == 9  ? (double)NAN
                             : i == 10 ? INFINITY
                                       : -INFINITY;
            char shown[32];
            snprintf(shown, sizeof shown, "%g", x);
            foreign_numbers(support_path(hostile_file[k].file), support_path("x.h5"), x);
            hostile_tried(hostile_file[k].commands, hostile_file[k].file, shown);
        }
        hostile_draw(hostile_file[k].file, "numbers");
    }
}

// 40 million rows of 8 histories take 2.6 GB.
static void a_small_file_takes_no_large_memory(void **state) {
    (void)state;
    foreign_histories(support_path("run.h5"), support_path("x.h5"), 40);
    size_t size;
    support_read(support_path("x.h5"), &size);
    assert_in_range(size, 1 << 20, 4 << 20);
    const char *limit = getenv("JOSTLE_SANITIZED") ? "" : "ulimit -v 700000; ";
    char line[256];
    snprintf(line, sizeof line, "%s\"$JOSTLE\" plot x.h5 energy -o x.svg", limit);
    const struct support_result r = hostile_tried(line, "x.h5", "40 million rows");
    assert_int_equal(r.status, 2);
    assert_non_null(strstr(r.err, "2.56e+03 MB of memory"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_numbers_of_result_files_are_drawn_or_refused),
        cmocka_unit_test(a_small_file_takes_no_large_memory),
    };
    return cmocka_run_group_tests(tests, hostile_make_files, NULL);
}
