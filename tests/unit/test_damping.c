// SPDX-License-Identifier: GPL-3.0-or-later
// Several damping statements of one building add up. The warnings about damping are in
// test_slips.c and test_damping_warnings.c.
#include "support/analysis.h"
#include "support/support.h"

enum { N = 3 };

static struct model *model_with(const char *damping) {
    return analysis_model("building A -floors 3 -mass 2 -stiffness 800 600 400\n%s"
                          "initial A:1 -velocity 1\nstep fixed 0.01s\nduration 1s\n",
                          damping);
}

// The coefficients have exact sums in binary, so all entries of C are equal to the bit.
static void statements_of_one_kind_are_one_statement_with_the_sums(void **state) {
    (void)state;
    static const struct {
        const char *several, *one;
    } of[] = {
        {"damping A rayleigh -alpha 0.25\ndamping A rayleigh -alpha 0.5 -beta 0.125\n",
         "damping A rayleigh -alpha 0.75 -beta 0.125\n"},
        {"damping A dashpot 1 2 3\ndamping A dashpot 0.5 0 4\n", "damping A dashpot 1.5 2 7\n"},
        {"damping A modal 0.25\ndamping A modal 0.125 0 0.5\n",
         "damping A modal 0.375 0.25 0.75\n"},
    };
    for (size_t k = 0; k < sizeof of / sizeof of[0]; k++) {
        struct model *several = model_with(of[k].several);
        struct model *one = model_with(of[k].one);
        const struct building *a = several->building, *b = one->building;
        assert_int_equal(several->deck->diagnostics.n_warning, 0);
        assert_memory_equal(a->damping_diagonal, b->damping_diagonal, N * sizeof(double));
        assert_memory_equal(a->damping_off, b->damping_off, N * sizeof(double));
        assert_int_equal(a->damping_full != NULL, b->damping_full != NULL);
        if (b->damping_full) {
            assert_memory_equal(a->damping_full, b->damping_full, sizeof(double[N * N]));
        }
        model_free(several);
        model_free(one);
    }
}

// The forces C v of unit velocities, which are the columns of C.
static void take_matrix(const char *damping, double c[N * N]) {
    struct model *m = model_with(damping);
    for (int j = 0; j < N; j++) {
        const double v[N] = {j == 0, j == 1, j == 2};
        building_damping_force(m->building, v, &c[(size_t)N * (size_t)j]);
    }
    model_free(m);
}

// Entries are up to 10; 1e-14 leaves room for a few roundings.
static void the_matrices_of_all_kinds_add_up(void **state) {
    (void)state;
    static const char *const alone[] = {"damping A rayleigh 5%\n", "damping A dashpot 1 0 3\n",
                                        "damping A modal 3% 2% 0\n"};
    for (int without = 0; without <= 3; without++) {
        char deck[256];
        snprintf(deck, sizeof deck, "%s%s%s", without == 0 ? "" : alone[0],
                 without == 1 ? "" : alone[1], without == 2 ? "" : alone[2]);
        double sum[N * N] = {0}, all[N * N];
        for (int k = 0; k < 3; k++) {
            double own[N * N] = {0};
            if (k != without) {
                take_matrix(alone[k], own);
            }
            for (int i = 0; i < N * N; i++) {
                sum[i] += own[i];
            }
        }
        take_matrix(deck, all);
        for (int i = 0; i < N * N; i++) {
            assert_near(all[i], sum[i], 1e-14);
        }
    }
}

// Dashpots of b K have the ratio b omega / 2, and ratios of C that is diagonal in the modes add up.
static void ratios_of_modes_add_up(void **state) {
    (void)state;
    struct model *m = model_with("damping A rayleigh 5% 4% -modes 1 3\n"
                                 "damping A dashpot 1.6 1.2 0.8\ndamping A modal 1% 2% 3%\n");
    const double want[] = {0.06, NAN, 0.07};
    for (int i = 0; i < N; i += 2) {
        double ratio = building_damping_ratio(m->building, i + 1);
        assert_close(ratio, want[i] + 0.002 * m->building->omega[i] / 2.0, 1e-13);
    }
    model_free(m);
}

static void take_all(const char *building, const char *damping, double c[N * N]) {
    struct model *m = analysis_model("%s%sinitial A:1 -velocity 1\nstep fixed 0.01s\nduration 1s\n",
                                     building, damping);
    for (int j = 0; j < N; j++) {
        const double v[N] = {j == 0, j == 1, j == 2};
        building_damping_force(m->building, v, &c[(size_t)N * (size_t)j]);
    }
    model_free(m);
}

// With K on drifts, rows and columns of storeys that are left out are 0. So a chain has dashpots in
// the others, and its matrix, in place of its storeys, the same C. Isolators are left out by
// default. alpha and beta of ratios are those of the whole building: 5 % of modes 1 and 2 here.
static void storeys_are_left_out_of_the_stiffness_proportional_part(void **state) {
    (void)state;
    static const char chain[] = "building A -floors 3 -mass 2 -stiffness 800 600 400\n",
                      isolated[] = "building A -floors 3 -mass 2 -stiffness 800 600 400 "
                                   "-isolated 2\n";
    static const struct {
        const char *building, *damping, *same;
    } of[] = {
        {chain, "damping A rayleigh -alpha 0.25 -beta 0.125 -storeys 1,3\n",
         "damping A rayleigh -alpha 0.25\ndamping A dashpot 100 0 50\n"},
        {chain, "damping A rayleigh -beta 0.125 -storeys 3\ndamping A rayleigh -beta 0.5\n",
         "damping A dashpot 400 300 250\n"},
        {chain, "damping A rayleigh -beta 0.125 -storeys 3\ndamping A modal 2%\n",
         "damping A dashpot 0 0 50\ndamping A modal 2%\n"},
        {chain, "damping A rayleigh -beta 0.125 -storeys all\n",
         "damping A rayleigh -beta 0.125\n"},
        {isolated, "damping A rayleigh -alpha 0.25 -beta 0.125\n",
         "damping A rayleigh -alpha 0.25\ndamping A dashpot 100 0 50\n"},
        {isolated, "damping A rayleigh -beta 0.125 -storeys 2:3\n", "damping A dashpot 0 75 50\n"},
        {isolated, "damping A rayleigh 5%\n", "damping A rayleigh 5% -storeys 1,3\n"},
        {chain, "damping A rayleigh 5% -tangent\n", "damping A rayleigh 5%\n"},
    };
    const char *file = support_write("chain.txt", "1400 -600 0\n-600 1000 -400\n0 -400 400\n");
    for (size_t k = 0; k < sizeof of / sizeof of[0]; k++) {
        double got[N * N], want[N * N], full[N * N];
        char matrix[256];
        snprintf(matrix, sizeof matrix, "building A -floors 3 -mass 2 %s\nmatrix A %s\n",
                 of[k].building == isolated ? "-isolated 2" : "", file);
        take_all(of[k].building, of[k].damping, got);
        take_all(of[k].building, of[k].same, want);
        take_all(matrix, of[k].damping, full);
        for (int i = 0; i < N * N; i++) {
            assert_near(got[i], want[i], 1e-13);
            assert_near(full[i], want[i], 1e-12);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(statements_of_one_kind_are_one_statement_with_the_sums),
        cmocka_unit_test(the_matrices_of_all_kinds_add_up),
        cmocka_unit_test(ratios_of_modes_add_up),
        cmocka_unit_test(storeys_are_left_out_of_the_stiffness_proportional_part),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
