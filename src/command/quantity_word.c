// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/quantity_word.h"

#include <stddef.h>

#include "core/text.h"

const char *quantity_word(const char *text, const struct unit_system *u,
                          const struct dimension *dimension, enum bare bare, double *value) {
    const char *end, *behind;
    struct dimension found;
    double size;
    if (text_number(text, &end, value) != TEXT_NUMBER_OK) {
        return NULL;
    }
    if (!unit_parse(end, u->gravity, &behind, &found, &size)) {
        return bare == BARE_ALLOWED ? end : NULL;
    }
    *value = unit_convert(*value, size, unit_size(u, *dimension));
    return dimension_equal(found, *dimension) ? behind : NULL;
}
