// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/law_words.h"

#include <stdio.h>

void law_words(const struct contact_law *law, const double *value, char *text, size_t size) {
    size_t used = (size_t)snprintf(text, size, "%s", law->name);
    for (int r = 0; r < law->n_row && used < size; r++) {
        const struct row *row = &law->row[r];
        if (row->kind == ROW_FILE) {
            used += (size_t)snprintf(text + used, size - used, " -%s (%.0f points)", row->key,
                                     value[r]);
        } else if (!isnan(value[r])) {
            used += (size_t)snprintf(text + used, size - used, " -%s %.6g", row->key, value[r]);
        }
    }
}
