// SPDX-License-Identifier: GPL-3.0-or-later
// Limits of demands, as commands read them.
#include <math.h>

#include "core/text.h"
#include "study/edp.h"

// A limit with its unit, or without.
static int read_limit(const struct edp *p, const struct unit_system *units, const char *text,
                      double *limit, struct error *e) {
    const char *end, *behind;
    struct dimension dimension;
    struct text_short t;
    double size, own;
    if (text_number(text, &end, limit) != TEXT_NUMBER_OK) {
        return error_set(e, STATUS_INPUT, "limit '%s' is not a number", text_short(&t, text));
    }
    if (*end == '\0') {
        return STATUS_OK;
    }
    if (!unit_parse(end, units->gravity, &behind, &dimension, &size) || *behind != '\0') {
        return error_set(e, STATUS_INPUT, "limit '%s' ends in no unit", text_short(&t, text));
    }
    if (!dimension_equal(dimension, p->dimension)) {
        const char *noun = dimension_noun(dimension), *want = dimension_noun(p->dimension);
        return error_set(e, STATUS_INPUT, "limit %s is %s; %s needs %s (%s)", text,
                         noun ? noun : "of another dimension", p->text, want ? want : "another",
                         p->units);
    }
    edp_units(p->units, units->gravity, &own);
    *limit = unit_convert(*limit, size, own);
    return isfinite(*limit) ? STATUS_OK
                            : error_set(e, STATUS_INPUT, "limit '%s' is too large", text);
}

struct dimension edp_units(const char *text, double gravity, double *size) {
    struct dimension dimension = dimension_none;
    const char *end;
    if (!unit_parse(text, gravity, &end, &dimension, size) || *end != '\0') {
        *size = 1.0;
        return dimension_none;
    }
    return dimension;
}

int edp_limit(const struct edp *p, const struct unit_system *units, const char *text, double *limit,
              struct error *e) {
    int status = read_limit(p, units, text, limit, e);
    if (status == STATUS_OK && *limit < 0.0 && p->quantity->reduction != EDP_HIGHEST) {
        return error_set(e, STATUS_INPUT, "limit %s is below 0, where %s never is", text, p->text);
    }
    return status;
}
