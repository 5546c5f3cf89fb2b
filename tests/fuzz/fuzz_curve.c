// SPDX-License-Identifier: GPL-3.0-or-later
// Feeds bytes to the reader of curves and looks whether what it takes is a curve.
#include <assert.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "motion/curve_file.h"
#include "motion/record_format.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void check_curve(const struct curve *c) {
    assert(c->n >= 2);
    for (int i = 0; i < c->n; i++) {
        const double *p = c->point + (size_t)i * CURVE_COLUMNS;
        assert(isfinite(p[CURVE_PENETRATION]) && isfinite(p[CURVE_LOADING]));
        assert(p[CURVE_UNLOADING] >= 0 && p[CURVE_UNLOADING] <= p[CURVE_LOADING]);
        assert(i == 0 || (p[CURVE_PENETRATION] > p[CURVE_PENETRATION - CURVE_COLUMNS] &&
                          p[CURVE_LOADING] >= p[CURVE_LOADING - CURVE_COLUMNS]));
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char *text = malloc(size + 1);
    struct arena *a = arena_create();
    struct unit_system units;
    unit_system_init(&units);
    if (text && a) {
        memcpy(text, data, size);
        text[size] = '\0';
        struct curve_request request = {.units = &units};
        struct record_text t = {"fuzz.txt", text, size};
        struct curve curve;
        struct error e;
        if (curve_read_text(a, &request, &t, &curve, &e) == STATUS_OK) {
            check_curve(&curve);
        } else {
            assert(strncmp(e.message, "fuzz.txt:", 9) == 0 && !strchr(e.message, '\n'));
        }
    }
    arena_free(a);
    free(text);
    return 0;
}
