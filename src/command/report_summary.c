// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/report_summary.h"

#include <string.h>

#include "core/safe.h"
#include "core/text.h"

void report_summary_table(struct report_summary *s, const struct report_shown *shown,
                          const char *name, const struct printer_column *column, int n,
                          report_row_function *row) {
    struct printer t = {.to = s->to, .units = &s->r->units, .at_head = UNITS_BELOW};
    bool any_hit = false;
    fputc('\n', s->to);
    printer_add(&t, &(struct printer_column)COLUMN_NAME(name, shown->width), 1);
    printer_add(&t, column, n);
    printer_head(&t);
    for (int i = 0; i < shown->n; i++) {
        any_hit |= row(&t, s->r, shown->choice[i].index);
        printer_line(&t);
    }
    s->status = printer_end(&t, s->status, s->e);
    if (any_hit) {
        fprintf(s->to, "%s\n", report_hit_note);
    }
}

void report_summary_rest(const struct report_summary *s, int n, const char *what,
                         const char *order) {
    if (n > 0) {
        safe_line(s->to, "  %d more %s not shown (by %s); all are in %s%s", n, what, order,
                  s->r->file ? s->r->file : "the result file",
                  s->r->file ? " (jostle show --tsv)" : "");
    }
}

int report_summary_widest(int width, const char *text, int limit) {
    const int n = text_columns(text, strlen(text));
    return n <= width ? width : n < limit ? n : limit;
}
