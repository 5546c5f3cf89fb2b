// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/quantity.h"

#include <stddef.h>
#include <string.h>

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

static const char *read_si(const char *text, const struct dimension *dimension, enum bare bare,
                           double *value) {
    struct unit_system si;
    unit_system_init(&si);
    return quantity_word(text, &si, dimension, bare, value);
}

bool quantity_whole(const char *text, const struct dimension *dimension, enum bare bare,
                    double *value) {
    const char *end = read_si(text, dimension, bare, value);
    return end && *end == '\0';
}

int quantity_list(const char *text, const struct dimension *dimension, int max, double *value) {
    for (int n = 0; n < max;) {
        text = read_si(text, dimension, BARE_ALLOWED, &value[n++]);
        if (!text || (*text != ',' && *text != '\0')) {
            return 0;
        }
        if (*text++ == '\0') {
            return n;
        }
    }
    return 0;
}

int quantity_count(const char *list) {
    int n = 1;
    for (; (list = strchr(list, ',')) != NULL; list++) {
        n++;
    }
    return n;
}
