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
            assert_near(test_storey_go(&s, middle, steps), want[2 * i], 1e-9 * 2e5);
            assert_near(test_storey_go(&s, target, steps), want[2 * i + 1], 1e-9 * 2e5);
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
            work += test_storey_work(&s, i % 5 ? s.drift + u : (i / 400) * u, 100);
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
        cmocka_unit_test(a_slipping_storey_catches_later_after_each_yielding),
        cmocka_unit_test(closed_cycles_make_no_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
