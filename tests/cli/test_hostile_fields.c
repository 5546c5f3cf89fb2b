// SPDX-License-Identifier: GPL-3.0-or-later
// A hostile text in each field of result files alone: fields that all together hide each other, and
// those that the reader checks.
#include <string.h>

#include "support/foreign.h"
#include "support/hostile.h"

static void each_text_field_alone_is_shown_escaped_or_refused(void **state) {
    static const char all[] = "'\"\\`touch marker`$(touch marker)%s{\033[31m\x7f\xc2\x9b\xff\n"
                              "EOD\nsystem(\"touch marker\")\n!touch marker\n\\";
    static struct foreign_field field[FOREIGN_FIELDS_MAX];
    (void)state;
    for (int k = 0; k < N_HOSTILE_FILE; k++) {
        const int n = foreign_fields(support_path(hostile_file[k].file), field);
        assert_in_range(n, 20, FOREIGN_FIELDS_MAX);
        for (int i = 0; i < n; i++) {
            const char *last = strrchr(field[i].path, '@');
            if (last && i % 16 != 0 &&
                (strcmp(last, "@long_name") == 0 || strcmp(last, "@units") == 0)) {
                continue;  // there is one of each for every dataset
            }
            foreign_text(support_path(hostile_file[k].file), support_path("x.h5"), i, all);
            hostile_tried(hostile_file[k].some, field[i].path, all);
        }
        hostile_drawn(hostile_file[k].file, all);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_text_field_alone_is_shown_escaped_or_refused),
    };
    return cmocka_run_group_tests(tests, hostile_make_files, NULL);
}
