// SPDX-License-Identifier: GPL-3.0-or-later
// Hostile texts in all fields of result files: no command is executed, no control character reaches
// a terminal, and files that jostle has not completed are refused.
#include <string.h>

#include "support/foreign.h"
#include "support/hostile.h"

static void texts_of_result_files_are_shown_escaped_and_never_executed(void **state) {
    (void)state;
    for (int k = 0; k < N_HOSTILE_FILE; k++) {
        for (int i = 0; i < N_HOSTILE; i++) {
            foreign_text(support_path(hostile_file[k].file), support_path("x.h5"), -1,
                         hostile_text[i]);
            // The product of texts, files and commands is that of the ordinary tests: a sanitizer
            // needs each text in each file, and each command with several texts.
            const bool all = !hostile_is_short() || (i + k) % 3 == 0;
            hostile_tried(all ? hostile_file[k].commands : hostile_file[k].some,
                          hostile_file[k].file, hostile_text[i]);
            hostile_drawn(hostile_file[k].file, hostile_text[i]);
        }
    }
}

static void study_files_of_another_format_or_that_are_not_complete_are_refused(void **state) {
    static struct foreign_field field[FOREIGN_FIELDS_MAX];
    static const char *const refused[][2] = {{"/@format", "is not a result file of jostle"},
                                             {"/@status", "is not complete"}};
    (void)state;
    const int n = foreign_fields(support_path("study.h5"), field);
    for (int r = 0, found = 0; r < 2; r++, found = 0) {
        for (int i = 0; i < n; i++) {
            if (strcmp(field[i].path, refused[r][0]) == 0) {
                foreign_text(support_path("study.h5"), support_path("x.h5"), i, "other");
                const struct support_result said =
                    hostile_tried("\"$JOSTLE\" show x.h5", "", "other");
                assert_int_equal(said.status, 2);
                assert_non_null(strstr(said.err, refused[r][1]));
                found = 1;
            }
        }
        assert_true(found);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texts_of_result_files_are_shown_escaped_and_never_executed),
        cmocka_unit_test(study_files_of_another_format_or_that_are_not_complete_are_refused),
    };
    return cmocka_run_group_tests(tests, hostile_make_files, NULL);
}
