// SPDX-License-Identifier: GPL-3.0-or-later
// Storeys of straight lines under protocols of drifts. Shears marked "independent solution" come
// from another implementation of the rules, written independently.
#include <math.h>

#include "support/storey.h"
#include "support/support.h"

#define TARGETS(array) array, (int)(sizeof(array) / sizeof(array)[0])

static const double protocol[] = {1,  -1, 2,  -2, 2, -2, 3.5, -3.5, 1.5, 3,   -0.5, -3,  5,
                                  -5, 7,  -6, 2,  4, -8, 9,   -9,   12,  -12, 20,   -20, 0};

// Independent solutions. Shears in the middle and at the end of each leg of the protocol.
static const double bilinear[] = {
    73549.875,    147099.75,    -0,           -147099.75,   73549.875,    151512.7425,
    -142686.7575, -151512.7425, 142686.7575,  151512.7425,  -142686.7575, -151512.7425,
    145996.5019,  158132.2313,  -142686.7575, -158132.2313, 138273.765,   149306.2463,
    152615.9906,  155925.735,   -101498.8275, -144893.2538, -150409.4944, -155925.735,
    147099.75,    148570.7475,  -142686.7575, -148570.7475, 147099.75,    125034.7875,
    -140480.2612, -136802.7675, 125034.7875,  125034.7875,  125034.7875,  125034.7875,
    -136802.7675, -113266.8075, 125034.7875,  101498.8275,  -113266.8075, -101498.8275,
    101498.8275,  66194.8875,   -101498.8275, -66194.8875,  66194.8875,   29419.95,
    -66194.8875,  -29419.95,    29419.95,     29419.95,
};
static const double origin_oriented[] = {
    49033.25,
    63743.225,
    0,
    -63743.225,
    31871.6125,
    93163.175,
    0,
    -93163.175,
    0,
    93163.175,
    0,
    -93163.175,
    34936.19062,
    137293.1,
    0,
    -137293.1,
    -39226.6,
    58839.9,
    88259.85,
    117679.8,
    49033.25,
    -19613.3,
    -68646.55,
    -117679.8,
    39226.6,
    149387.9683,
    0,
    -149387.9683,
    29877.59367,
    153310.6283,
    10950.75917,
    -151349.2983,
    -50449.76611,
    43803.03667,
    65704.555,
    87606.07333,
    -50449.76611,
    -155271.9583,
    10950.75917,
    157233.2883,
    0,
    -157233.2883,
    26205.54806,
    163117.2783,
    0,
    -163117.2783,
    54372.42611,
    178807.9183,
    0,
    -178807.9183,
    -89403.95917,
    0,
};
static const double peak_oriented[] = {
    49033.25,     63743.225,    -20190.16176, -63743.225,   40134.62315, 93163.175,    -32648.9689,
    -93163.175,   32072.56844,  93163.175,    -32072.56844, -93163.175,  54981.5459,   137293.1,
    -47717.72378, -137293.1,    26968.2875,   88259.85,     106647.3188, 125034.7875,  -12481.19091,
    -58464.52584, -91309.76507, -124155.0043, 71715.21834,  149387.9683, -68416.96288, -149387.9683,
    78894.23573,  153310.6283,  -70662.27439, -151349.2983, 32874.58047, 86401.71285,  99783.49595,
    113165.279,   -82912.17677, -155271.9583, 79035.91399,  157233.2883, -74593.73794, -157233.2883,
    85313.2032,   163117.2783,  -84051.09931, -163117.2783, 104695.9281, 178807.9183,  -98252.34936,
    -178807.9183, 38297.02468,  85133.98923,
};

static void follow(const char *law, const char *values, double unit, const double *want) {
    for (int steps = 1; steps <= 256; steps *= 16) {
        struct test_storey s = test_storey_of(law, 10966227.11, values);
        for (int i = 0; i < 26; i++) {
            const double target = protocol[i] * unit, middle = (s.drift + target) / 2.0;
            // The reference has ten digits.
            assert_near(test_storey_go(&s, middle, steps), want[2 * (ptrdiff_t)i], 1e-9 * 2e5);
            assert_near(test_storey_go(&s, target, steps), want[2 * (ptrdiff_t)i + 1], 1e-9 * 2e5);
        }
    }
}

static void paths_are_those_of_independent_solutions(void **state) {
    (void)state;
    follow("imk",
           "yield 147099.75 hardening 0.03 capping 0.05365555482 post-capping -0.08 residual 0.2 "
           "cycle bilinear",
           0.01341388871, bilinear);
    static const char lines[] = "crack 49033.25 yield 147099.75 cracked 0.3 hardening 0.02 ";
    char values[256];
    snprintf(values, sizeof values, "%sorigin", lines);
    follow("trilinear", values, 0.00894259247, origin_oriented);
    follow("trilinear", lines, 0.00894259247, peak_oriented);
}

static void check(const char *law, const char *values, const double *target, const double *want,
                  int n, double digits) {
    const struct test_storey s = test_storey_of(law, 1.0, values);
    test_storey_protocol(&s, target, want, n, 1, digits);
    test_storey_protocol(&s, target, want, n, 400, digits);
}

#define LINES "crack 0.5 yield 1.5 cracked 0.3 hardening 0.02 "
static const double turns[] = {0.4, -0.4, 1, -1, 2, -2, 6, -6, 3, -1, 7, -4, 5, 1, 6, -8, 0};

// Independent solution: peak-oriented, with an unloading stiffness that falls, and with pinching
// and damage.
static void trilinear_storeys_have_the_shears_of_an_independent_solution(void **state) {
    (void)state;
    static const double peak[] = {0.4,    -0.4,    0.65,   -0.65,   0.95,   -0.95,
                                  1.5433, -1.5433, 1.1006, -0.5665, 1.5633, -1.2734,
                                  1.2419, -0.4362, 1.2823, -1.5833, 0.7477};
    static const double takeda[] = {0.8475, -0.2708, 1.5633,  -1.1117, 1.1260,
                                    0.0569, 1.3447,  -1.5833, 0.3006};
    check("trilinear", LINES, turns, peak, 17, 5e-5);
    struct test_storey s = test_storey_of("trilinear", 1.0, LINES "takeda b 0.5");
    struct test_storey pinched =
        test_storey_of("trilinear", 1.0,
                       LINES "takeda b 0.3 pinch-drift 0.5 pinch-shear 0.25 damage-peak 0.01 "
                             "damage-energy 0.02 damage-drift 40 damage-every");
    static const double damaged[] = {0.8402,  -0.3151, 1.4579,  -0.9553, 0.9428,
                                     -0.1606, 0.7725,  -1.2631, 0.2924};
    for (int i = 0; i < 17; i++) {
        const double shear = test_storey_go(&s, turns[i], 3);
        const double low = test_storey_go(&pinched, turns[i], 3);
        if (i >= 8) {
            assert_near(shear, takeda[i - 8], 5e-5);
            assert_near(low, damaged[i - 8], 5e-5);
        }
    }
}

// Independent solution of a self-centring storey.
static void a_flag_has_the_shears_of_an_independent_solution(void **state) {
    (void)state;
    static const double target[] = {2, -1.5, 3, 1, 2.5, 0.2, 4, -4, 0.5, -2, 0};
    static const double want[] = {1.05, -1.025, 1.1, 0.24, 1.075, 0.2, 1.15, -1.15, 0.5, -1.05, 0};
    check("flag", "yield 1 hardening 0.05 b 0.8", target, want, 11, 1e-12);
}

// An excursion to d > D and back dissipates b V_y (1 - R) (d - D).
static void a_flag_dissipates_its_area(void **state) {
    (void)state;
    struct test_storey s = test_storey_of("flag", 2.0, "yield 1 hardening 0.1 b 0.6");
    const double work = test_storey_work(&s, 3.0, 10000) + test_storey_work(&s, 0.0, 10000);
    assert_near(work, 0.6 * 0.9 * (3.0 - 0.5), 1e-6);
    assert_true(test_storey_go(&s, 0.0, 1) == 0.0);
}

// Independent solutions of Bouc-Wen storeys that degrade, and that slip.
static void worn_storeys_have_the_shears_of_an_independent_solution(void **state) {
    (void)state;
    static const double target[] = {2, -2, 3, -3, 1, 2.5, -1, 4, -4, 0};
    static const double n1[] = {0.90611, -0.95422, 0.97470, -0.92161, 0.75262,
                                0.84502, -0.68722, 0.86579, -0.82137, 0.55888};
    static const double n2[] = {1.00280, -1.01023, 1.03347, -0.99701, 0.86688,
                                0.94323, -0.81525, 0.98737, -0.95097, 0.70294};
    static const double slips[] = {0.92139, -1.00510, 1.07267, -1.07735, 0.61905,
                                   0.98785, -0.35273, 1.04142, -1.13737, 0.26780};
#define WORN "yield 1 hardening 0.05 beta 0.5 gamma 0.5 delta-A 0.01 delta-nu 0.02 delta-eta 0.03 "
    check("bouc-wen", WORN "n 1", target, n1, 10, 5e-6);
    check("bouc-wen", WORN "n 2", target, n2, 10, 5e-6);
    check("bouc-wen",
          "yield 1 hardening 0.05 n 1 beta 0.5 gamma 0.5 q 0.1 zeta-s 0.9 p 0.5 psi 0.2 "
          "delta-psi 0.01 lambda 0.3",
          target, slips, 10, 5e-6);
}

// By hand: k = 1, weak 0.1, slack 0.5: Y = (1 - 0.05) 0.9 = 0.855, yield at 0.5 + 0.95 = 1.45.
// At 2.45 with the slope 0.2 V = 1.2, and p = (2.45 - 0.5) - (1.2 - 0.245) / 0.9.
static void a_slipping_storey_catches_later_after_each_yielding(void **state) {
    (void)state;
    struct test_storey s = test_storey_of("slip", 1.0, "yield 1 hardening 0.2 slack 0.5 weak 0.1");
    const double p = 1.95 - 0.955 / 0.9;
    assert_near(test_storey_go(&s, 0.4, 1), 0.04, 1e-14);
    assert_near(test_storey_go(&s, 1.45, 1), 1.0, 1e-14);
    assert_near(test_storey_go(&s, 2.45, 7), 1.2, 1e-14);
    assert_near(test_storey_go(&s, 1.45, 1), 0.2, 1e-14);
    assert_near(test_storey_go(&s, 0.5 + p, 1), 0.1 * (0.5 + p), 1e-14);
    assert_near(test_storey_go(&s, -0.5, 1), -0.05, 1e-14);
    assert_near(test_storey_go(&s, -1.0, 1), -0.55, 1e-14);
    assert_near(test_storey_go(&s, 1.0 + p, 1), 0.1 * (1.0 + p) + 0.45, 1e-14);
    assert_near(test_storey_go(&s, 3.45, 1), 1.4, 1e-14);
}

// By hand, k = 1: yield at 1 to the right and at 0.5 to the left.
static void directions_may_yield_at_different_shears(void **state) {
    (void)state;
#define UNEQUAL "yield 1 yield-negative 0.5 hardening "
    static const double target[] = {2, -3, -1.5, 0, 4, 3, 1.25, -2, -1.5};
    static const double kinematic[] = {1, -0.5, 1, 1, 1, 0, -0.5, -0.5, 0};
    // From (-3, -0.5) up to 0 at -2.5, then to (2, 1) and down from (4, 1) to (-3, -0.5).
    static const double clough[] = {1, -0.5, 2.0 / 9, 5.0 / 9, 1, 0, -1.75 / 12, -5.0 / 12, 0};
    check("bilinear", UNEQUAL "0", target, kinematic, 9, 1e-12);
    check("clough", UNEQUAL "0", target, clough, 8, 1e-12);
    check("takeda", UNEQUAL "0 alpha 0", target, clough, 8, 1e-12);
    // To the left it yields first.
    const struct test_storey virgin = test_storey_of("clough", 1.0, UNEQUAL "0");
    assert_near(test_storey_at(&virgin, -0.8).shear, -0.5, 1e-14);
    assert_near(test_storey_at(&virgin, 0.8).shear, 0.8, 1e-14);
    // A left turn softens by its own drift at yield: k (0.5 / 2)^0.5 = 0.5.
    struct test_storey s = test_storey_of("takeda", 1.0, UNEQUAL "0 alpha 0.5");
    test_storey_go(&s, -2.0, 1);
    assert_near(test_storey_at(&s, -1.5).shear, -0.25, 1e-14);
    // To the right it has not yielded yet; a line to (1, 1) starts at (-1, 0).
    assert_near(test_storey_at(&s, 0.0).shear, 0.5, 1e-14);
}

// By hand: the backbone falls from (1, 1) to 0 at 6.
static void a_negative_hardening_loses_strength(void **state) {
    (void)state;
    static const double target[] = {2, 1, -4, -1, 7, 8, 7.5, 1};
    static const double clough[] = {0.8, -0.2 / 2.2,      -0.4,         0.8 * 2.6 / 5.6, 0,
                                    0,   -0.4 * 0.5 / 12, -0.4 * 7 / 12};
    check("clough", "yield 1 hardening -0.2", target, clough, 8, 1e-12);
    // Kinematic: the elastic range is 2 wide after each yielding.
    struct test_storey s = test_storey_of("bilinear", 1.0, "yield 1 hardening -0.2");
    assert_near(test_storey_go(&s, 2.0, 1), 0.8, 1e-14);
    assert_near(test_storey_go(&s, 1.0, 1), -0.2, 1e-14);
    assert_near(test_storey_go(&s, 7.0, 3), -0.2, 1e-14);
    assert_near(test_storey_at(&s, 5.0).shear, -2.2, 1e-14);
    assert_near(test_storey_at(&s, 4.0).shear, -2.0, 1e-14);
}

// One point is a bilinear or Clough storey, two are a trilinear one.
static void multilinear_storeys_of_few_points_are_known_ones(void **state) {
    (void)state;
    static const char *const pair[][4] = {
        {"bilinear", "yield 1 hardening 0.1", "multilinear", "yield 1 hardening 0.1"},
        {"bilinear", "yield 1 hardening -0.1", "multilinear", "yield 1 hardening -0.1"},
        {"clough", "yield 1 hardening 0.1", "multilinear", "yield 1 hardening 0.1 cycle peak"},
        {"trilinear", LINES "takeda b 0.5", "multilinear",
         "yield 0.5 drift-2 3.833333333333333 shear-2 1.5 hardening 0.02 cycle peak b 0.5"},
    };
    for (size_t k = 0; k < sizeof pair / sizeof pair[0]; k++) {
        struct test_storey a = test_storey_of(pair[k][0], 1.0, pair[k][1]);
        struct test_storey b = test_storey_of(pair[k][2], 1.0, pair[k][3]);
        for (int i = 0; i < 26; i++) {
            assert_near(test_storey_go(&a, protocol[i], 3), test_storey_go(&b, protocol[i], 5),
                        1e-12);
        }
    }
}

// By hand: springs of 0.5 that yields at 1, of 0.4 at 3, and of 0.1.
static void a_kinematic_backbone_is_twice_as_large_after_a_turn(void **state) {
    (void)state;
    static const double target[] = {1, 2, 5, 4, 1, -2, -6, 5};
    static const double want[] = {1, 1.5, 2.2, 1.2, -0.8, -1.9, -2.3, 2.2};
    check("multilinear", "yield 1 drift-2 3 shear-2 2 hardening 0.1", target, want, 8, 1e-12);
}

// Falls from (3, 2) to (5, 1), and keeps this.
static void a_peak_oriented_backbone_may_keep_a_residual_strength(void **state) {
    (void)state;
    static const double target[] = {3, 4, 5, 9, 8};
    static const double want[] = {2, 1.5, 1, 1, 0};
    struct test_storey s = test_storey_of(
        "multilinear", 1.0, "yield 1 drift-2 3 shear-2 2 drift-3 5 shear-3 1 cycle peak");
    for (int i = 0; i < 5; i++) {
        assert_near(test_storey_go(&s, target[i], 1 + i), want[i], 1e-14);
    }
}

// drift = f (1 + eta |f|^(r - 1)) with f = V / V_y; after a turn twice as large.
static double ramberg_osgood_drift(double f) {
    return f * (1.0 + 0.2 * pow(fabs(f), 5.5));
}

static void ramberg_osgood_loops_are_masings(void **state) {
    (void)state;
    struct test_storey s = test_storey_of("ramberg-osgood", 2.0, "yield 4 eta 0.2 r 6.5");
    const double top = 2.0 * ramberg_osgood_drift(1.4), mid = 2.0 * ramberg_osgood_drift(1.2);
    assert_near(test_storey_go(&s, top, 10), 4.0 * 1.4, 1e-13);
    // From 1.4 by 2.4 down to f = -1, up by 1.2 and down again: a closed loop within.
    const double low = top - 2.0 * mid, in = low + 4.0 * ramberg_osgood_drift(0.6);
    assert_near(test_storey_go(&s, low, 7), -4.0, 1e-12);
    const double before = test_storey_at(&s, low - 0.3).shear;
    assert_near(test_storey_go(&s, in, 7), 4.0 * 0.2, 1e-12);
    assert_near(test_storey_at(&s, low).shear, -4.0, 1e-12);
    assert_near(test_storey_at(&s, low - 0.3).shear, before, 1e-12);
    assert_near(test_storey_go(&s, -top, 1), -4.0 * 1.4, 1e-12);
    const struct test_storey virgin =
        test_storey_of("ramberg-osgood", 2.0, "yield 4 eta 0.2 r 6.5");
    assert_near(test_storey_go(&s, -9.0, 1), test_storey_at(&virgin, -9.0).shear, 1e-12);
}

// More loops within loops than a storey remembers: the shear has no jump and every leg dissipates.
static void ramberg_osgood_storeys_forget_small_loops_without_a_jump(void **state) {
    (void)state;
    struct test_storey s = test_storey_of("ramberg-osgood", 1.0, "yield 1 eta 0.2 r 7");
    double work = 0.0;
    for (int i = 0; i < 60; i++) {
        const double d = (i % 2 ? -3.0 : 3.0) * exp(-0.05 * i);
        work += test_storey_work(&s, d, 4000);
        assert_true(work - s.law->stored(s.constant, s.history, d) > 0.0);
    }
    // On to both sides, out of all loops.
    for (int side = -1; side <= 1; side += 2) {
        struct test_storey out = s;
        double shear = test_storey_at(&out, out.drift).shear;
        for (int i = 0; i < 3000; i++) {
            const double before = shear;
            shear = test_storey_go(&out, out.drift + side * 2e-3, 1);
            const double rise = side * (shear - before);
            assert_true(rise > 0.0 && rise <= 2e-3 * (1.0 + 1e-9));
        }
        assert_near(shear + side * 0.2 * pow(fabs(shear), 7.0), out.drift, 1e-12);
    }
}

// Closed cycles of any size give no energy back.
static void closed_cycles_make_no_energy(void **state) {
    (void)state;
    static const char *const law[][2] = {
        {"trilinear", LINES},
        {"trilinear", LINES "origin"},
        {"trilinear", LINES "takeda b 0.5 pinch-drift 0.5 pinch-shear 0.25"},
        {"trilinear", LINES "takeda b 0.9 damage-peak 0.05"},
        {"trilinear", "crack 0.5 yield 1.5 cracked 0.3 hardening -0.1"},
        {"flag", "yield 1 hardening 0.05 b 0.8"},
        {"slip", "yield 1 hardening 0.1 slack 0.5"},
        {"imk", "yield 1 hardening 0.03 capping 4 post-capping -0.08"},
    };
    unsigned seed = 7;
    for (size_t k = 0; k < sizeof law / sizeof law[0]; k++) {
        struct test_storey s = test_storey_of(law[k][0], 1.0, law[k][1]);
        double work = 0.0, dissipated = 0.0;
        for (int i = 0; i < 4000; i++) {
            seed = seed * 1664525u + 1013904223u;
            const double u = (double)seed / 4294967296.0 - 0.5;
            work += test_storey_work(&s, i % 5 ? s.drift + u : floor(i / 400.0) * u, 100);
            const double now = work - s.law->stored(s.constant, s.history, s.drift);
            // The work errs by the corners within steps.
            assert_true(now >= dissipated - 1e-3);
            dissipated = now;
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(paths_are_those_of_independent_solutions),
        cmocka_unit_test(trilinear_storeys_have_the_shears_of_an_independent_solution),
        cmocka_unit_test(a_flag_has_the_shears_of_an_independent_solution),
        cmocka_unit_test(a_flag_dissipates_its_area),
        cmocka_unit_test(worn_storeys_have_the_shears_of_an_independent_solution),
        cmocka_unit_test(a_slipping_storey_catches_later_after_each_yielding),
        cmocka_unit_test(directions_may_yield_at_different_shears),
        cmocka_unit_test(a_negative_hardening_loses_strength),
        cmocka_unit_test(multilinear_storeys_of_few_points_are_known_ones),
        cmocka_unit_test(a_kinematic_backbone_is_twice_as_large_after_a_turn),
        cmocka_unit_test(a_peak_oriented_backbone_may_keep_a_residual_strength),
        cmocka_unit_test(ramberg_osgood_loops_are_masings),
        cmocka_unit_test(ramberg_osgood_storeys_forget_small_loops_without_a_jump),
        cmocka_unit_test(closed_cycles_make_no_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
