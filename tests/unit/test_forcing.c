// SPDX-License-Identifier: GPL-3.0-or-later
// Corners of the forcing at which it jumps, and those at which it only seems to, by rounding.
#include "solve/forcing.h"

#include <math.h>
#include <stdio.h>

#include "core/arena.h"
#include "support/analysis.h"
#include "support/support.h"

// At how many of its corners after the first, which is the start, the forcing of a deck jumps.
static int jumps_of(const char *ground) {
    struct model *m = analysis_model("building A -floors 1 -mass 1 -stiffness 1\n"
                                     "step fixed 1\nduration 60\n%s",
                                     ground);
    struct arena *a = arena_create();
    struct forcing f = {.model = m};
    int jumps = 0;
    assert_true(a && fields_alloc(&forcing_fields, m, &f, a));
    (void)forcing_turn(&f, 0.0);
    while (f.corner < INFINITY) {
        jumps += forcing_turn(&f, f.corner);
    }
    arena_free(a);
    model_free(m);
    return jumps;
}

// Many samples of both are 0, which the lines that end there miss by rounding.
static void a_record_jumps_at_its_ends_only(void **state) {
    (void)state;
    assert_int_equal(jumps_of("ground record input/records/RIDGECREST_2019_CLC_360.AT2\n"), 1);
    assert_int_equal(jumps_of("ground record input/records/NAPA_2014_68150_HNE.AT2 -delay 0.3\n"),
                     2);
}

static void a_sine_jumps_where_its_phase_says_so(void **state) {
    (void)state;
    const char *const sine = "ground sine -amplitude 3 -frequency 0.7 -cycles 9 -delay 0.1";
    char text[128];
    static const struct {
        const char *phase;
        int jumps;
    } want[] = {{"0", 0}, {"180deg", 0}, {"90deg", 2}, {"1e-6", 2}};
    for (size_t i = 0; i < sizeof want / sizeof want[0]; i++) {
        (void)snprintf(text, sizeof text, "%s -phase %s\n", sine, want[i].phase);
        assert_int_equal(jumps_of(text), want[i].jumps);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_record_jumps_at_its_ends_only),
        cmocka_unit_test(a_sine_jumps_where_its_phase_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
