// SPDX-License-Identifier: GPL-3.0-or-later
// A table without memory for its columns prints nothing and says so.
#include <stdio.h>
#include <stdlib.h>

#include "command/printer.h"
#include "support/fail_alloc.h"
#include "support/support.h"

static int print(void *context, struct error *e) {
    static const struct printer_column column[] = {COLUMN_DATA("x")};
    struct printer t = {.to = context, .form = FORM_TSV};
    for (int i = 0; i < 40; i++) {
        PRINTER_ADD(&t, column);
    }
    printer_head(&t);
    printer_number(&t, 1.0);
    printer_line(&t);
    return printer_end(&t, STATUS_OK, e);
}

static void no_memory_for_columns_is_an_error(void **state) {
    (void)state;
    char *text;
    size_t size;
    FILE *to = open_memstream(&text, &size);
    assert_non_null(to);
    fail_alloc_each(print, to, 2);
    fclose(to);
    assert_int_equal(size, 2 * 40 + 1 + 40);  // head and line of the first attempt
    free(text);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_memory_for_columns_is_an_error)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
