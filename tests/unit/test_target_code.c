// SPDX-License-Identifier: GPL-3.0-or-later
// Spectra of codes: printed values, corners, what is read and what is refused.
#include <math.h>

#include "motion/target.h"
#include "support/support.h"

static const double G = 9.80665;

static struct target open_for(const char *text, double damping) {
    struct target t = {0};
    struct error e = {0};
    if (target_open(support_arena, text, damping, &t, &e) != STATUS_OK) {
        fail_msg("%s", e.message);
    }
    return t;
}

static void refused(const char *text, double damping, const char *message) {
    struct target t;
    struct error e = {0};
    assert_int_equal(target_open(support_arena, text, damping, &t, &e), STATUS_INPUT);
    assert_string_equal(e.message, message);
}

// S, TB, TC and TD of EN 1998-1:2004, tables 3.2 and 3.3, and the values that equations (3.2) to
// (3.5) have at the corners: ag S, 2.5 ag S eta twice, 2.5 ag S eta TC/TD, and that at 4 s.
static void en1998_has_its_values_at_the_corners(void **state) {
    (void)state;
    static const double corner[2][5][4] = {{{1.0, 0.15, 0.4, 2.0},
                                            {1.2, 0.15, 0.5, 2.0},
                                            {1.15, 0.2, 0.6, 2.0},
                                            {1.35, 0.2, 0.8, 2.0},
                                            {1.4, 0.15, 0.5, 2.0}},
                                           {{1.0, 0.05, 0.25, 1.2},
                                            {1.35, 0.05, 0.25, 1.2},
                                            {1.5, 0.1, 0.25, 1.2},
                                            {1.8, 0.1, 0.3, 1.2},
                                            {1.6, 0.05, 0.25, 1.2}}};
    for (int type = 0; type < 2; type++) {
        for (int ground = 0; ground < 5; ground++) {
            char text[64];
            snprintf(text, sizeof text, "en1998:type=%d,ground=%c,ag=0.2g,eta=0.8", type + 1,
                     'A' + ground);
            const struct target t = open_for(text, 0.05);
            const double *c = corner[type][ground], top = 2.5 * 0.8 * 0.2 * G * c[0];
            assert_close(target_at(&t, 0.0), 0.2 * G * c[0], 1e-14);
            assert_close(target_at(&t, c[1] / 2.0), (0.2 * G * c[0] + top) / 2.0, 1e-14);
            assert_close(target_at(&t, c[1]), top, 1e-14);
            assert_close(target_at(&t, c[2]), top, 1e-14);
            assert_close(target_at(&t, c[3]), top * c[2] / c[3], 1e-14);
            assert_close(target_at(&t, 4.0), top * c[2] * c[3] / 16.0, 1e-14);
            assert_true(isnan(target_at(&t, 4.01)));
        }
    }
}

// eta = sqrt(10 / (5 + xi)) of (3.6): 1 at 5 %, sqrt(10/7) at 2 %, and never below 0.55, which it
// reaches at 28 %. The plateau is 2.5 eta ag S.
static void en1998_takes_the_damping_ratio(void **state) {
    (void)state;
    static const struct {
        double damping, eta;
    } known[] = {{0.05, 1.0}, {0.02, 1.19522860933}, {0.1, 0.81649658092}, {0.3, 0.55}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        const struct target t = open_for("en1998:ground=A,ag=1m/s2", known[i].damping);
        assert_close(target_at(&t, 0.0), 1.0, 1e-15);
        assert_close(target_at(&t, 0.3), 2.5 * known[i].eta, 1e-11);
    }
    const struct target national = open_for("EN1998:ground=a,ag=1m/s2,S=1.3,TC=0.9,tb=0.1", 0.05);
    assert_close(target_at(&national, 0.1), 3.25, 1e-15);
    assert_close(target_at(&national, 0.9), 3.25, 1e-15);
}

// input/en1998.txt has points of the same spectrum. It is straight on paper with logarithms, and
// the rising branch is so only nearly between its points.
static void the_example_file_has_points_of_en1998(void **state) {
    (void)state;
    const struct target file = open_for("input/en1998.txt", 0.05),
                        code = open_for("en1998:ground=B,ag=0.25g", 0.05);
    for (size_t i = 0; i < file.n; i++) {
        assert_close(target_at(&code, file.period[i]), file.psa[i], 1e-14);
    }
    for (double T = 0.0; T <= 4.0; T += 0.001) {
        assert_close(target_at(&code, T), target_at(&file, T), T > 0.05 && T < 0.15 ? 2e-3 : 1e-12);
    }
}

// With T0 = 0.12 s, TS = 0.6 s, TL = 8 s.
static void asce7_has_its_values_at_the_corners(void **state) {
    (void)state;
    const struct target t = open_for("asce7:SDS=1.0,SD1=0.6g,TL=8", 0.05);
    static const double known[][2] = {{0.0, 0.4}, {0.06, 0.7}, {0.12, 1.0},  {0.6, 1.0},
                                      {1.0, 0.6}, {2.0, 0.3},  {8.0, 0.075}, {10.0, 0.048}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        assert_close(target_at(&t, known[i][0]), known[i][1] * G, 1e-14);
    }
}

// NZS 1170.5:2004, table 3.1: Ch of modal analysis for classes A and B, C, D, E, with two decimals.
static void nzs1170_has_the_printed_shape_factors(void **state) {
    (void)state;
    static const double known[][5] = {{0.0, 1.00, 1.33, 1.12, 1.12}, {0.1, 2.35, 2.93, 3.00, 3.00},
                                      {0.2, 2.35, 2.93, 3.00, 3.00}, {0.3, 2.35, 2.93, 3.00, 3.00},
                                      {0.4, 1.89, 2.36, 3.00, 3.00}, {0.5, 1.60, 2.00, 3.00, 3.00},
                                      {0.6, 1.40, 1.74, 2.84, 3.00}, {0.7, 1.24, 1.55, 2.53, 3.00},
                                      {0.8, 1.12, 1.41, 2.29, 3.00}, {0.9, 1.03, 1.29, 2.09, 3.00},
                                      {1.0, 0.95, 1.19, 1.93, 3.00}, {1.5, 0.70, 0.88, 1.43, 2.21},
                                      {2.0, 0.53, 0.66, 1.07, 1.66}, {2.5, 0.42, 0.53, 0.86, 1.33},
                                      {3.0, 0.35, 0.44, 0.71, 1.11}, {3.5, 0.26, 0.32, 0.52, 0.81},
                                      {4.0, 0.20, 0.25, 0.40, 0.62}, {4.5, 0.16, 0.20, 0.32, 0.49}};
    for (int c = 0; c < 5; c++) {
        char text[64];
        snprintf(text, sizeof text, "nzs1170:class=%c,Z=0.1,R=1", 'A' + c);
        const struct target t = open_for(text, 0.05);
        for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
            // Rounded to two decimals.
            assert_near(target_at(&t, known[i][0]) / (0.1 * G), known[i][c == 0 ? 1 : c], 0.0051);
        }
    }
}

// N is 1 + (Nmax - 1) (20 - D) / 18 with Nmax 1.12, 1.36, 1.6 and 1.72 at 2, 3, 4 and 5 s (table
// 3.7); 1 from 20 km on, up to 1.5 s, and for R <= 0.75. Z R is at most 0.7.
static void nzs1170_grows_near_a_fault(void **state) {
    (void)state;
    const struct target far = open_for("nzs1170:class=D,Z=0.4,R=1", 0.05),
                        near = open_for("nzs1170:class=D,Z=0.4,D=1.5", 0.05),
                        between = open_for("nzs1170:class=D,Z=0.4,D=11km", 0.05),
                        away = open_for("nzs1170:class=D,Z=0.4,D=20", 0.05),
                        rare = open_for("nzs1170:class=D,Z=0.4,R=1.8,D=1", 0.05),
                        frequent = open_for("nzs1170:class=D,Z=0.4,R=0.75,D=1", 0.05);
    static const double most[][2] = {{1.0, 1.0}, {1.5, 1.0},  {2.0, 1.12}, {3.0, 1.36},
                                     {4.0, 1.6}, {5.0, 1.72}, {8.0, 1.72}};
    for (size_t i = 0; i < sizeof most / sizeof most[0]; i++) {
        const double T = most[i][0], N = most[i][1], C = target_at(&far, T);
        assert_close(target_at(&near, T), C * N, 1e-14);
        assert_close(target_at(&between, T), C * (1.0 + (N - 1.0) / 2.0), 1e-14);
        assert_close(target_at(&away, T), C, 1e-15);
        assert_close(target_at(&rare, T), C * N * 0.7 / 0.4, 1e-14);
        assert_close(target_at(&frequent, T), C * 0.75, 1e-14);
    }
}

static void faults_are_named(void **state) {
    (void)state;
    refused("en1998", 0.05, "en1998 needs ground, as in en1998:ground=C,ag=0.25g");
    refused("en1998:ground=B", 0.05, "en1998 needs ag, as in en1998:ground=C,ag=0.25g");
    refused("en1998:ground=F,ag=1g", 0.05, "ground takes A, B, C, D or E, not 'F'");
    refused("en1998:ground=AB,ag=1g", 0.05, "ground takes A, B, C, D or E, not 'AB'");
    refused("en1998:ground,ag=1g", 0.05, "ground takes A, B, C, D or E, not ''");
    refused("en1998:type=3", 0.05, "type takes 1 or 2, not '3'");
    refused("en1998:ag=0.25", 0.05, "ag takes an acceleration > 0 with its unit, not '0.25'");
    refused("en1998:ag=-1g", 0.05, "ag takes an acceleration > 0 with its unit, not '-1g'");
    refused("en1998:ag=1m", 0.05, "ag takes an acceleration > 0 with its unit, not '1m'");
    refused("en1998:ag=1gx", 0.05, "ag takes an acceleration > 0 with its unit, not '1gx'");
    refused("en1998:eta=0", 0.05, "eta takes a pure number > 0, not '0'");
    refused("en1998:soil=B", 0.05,
            "en1998 has no 'soil'; it has type, ground, ag, eta, S, TB, TC, TD");
    refused("en1998:,", 0.05, "en1998 has no ''; it has type, ground, ag, eta, S, TB, TC, TD");
    refused("en1998:ground=B,ag=1g,TB=3", 0.05, "en1998: TB, TC and TD must not descend");
    refused("asce7:SDS=1,SDS=2", 0.05, "SDS is given twice");
    refused("asce7:SDS=1,SD1=9,TL=8", 0.05, "asce7: TL must not be below TS = SD1/SDS");
    refused("asce7:SDS=1,SD1=1,TL=8", 0.02, "asce7 is a spectrum for 5 % damping, not for 2 %");
    refused("nzs1170:class=A,Z=1e999", 0.05, "Z takes a pure number > 0, not '1e999'");
    refused("nzs1170:class=A,Z=0.1,D=-1", 0.05, "D takes a length >= 0, not '-1'");
    refused("asce:SDS=1", 0.05,
            "cannot open asce:SDS=1: No such file or directory; the spectra of codes are en1998, "
            "asce7, nzs1170");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(en1998_has_its_values_at_the_corners),
        cmocka_unit_test(en1998_takes_the_damping_ratio),
        cmocka_unit_test(the_example_file_has_points_of_en1998),
        cmocka_unit_test(asce7_has_its_values_at_the_corners),
        cmocka_unit_test(nzs1170_has_the_printed_shape_factors),
        cmocka_unit_test(nzs1170_grows_near_a_fault),
        cmocka_unit_test(faults_are_named),
    };
    return cmocka_run_group_tests(tests, support_arena_open, support_arena_close);
}
