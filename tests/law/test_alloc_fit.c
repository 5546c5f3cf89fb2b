// SPDX-License-Identifier: GPL-3.0-or-later
// A fit, and `jostle law`, whichever allocation fails.
#include <fcntl.h>
#include <gsl/gsl_errno.h>
#include <math.h>
#include <unistd.h>

#include "command/law_impacts.h"
#include "command/law_storey.h"
#include "support/fail_alloc.h"
#include "support/support.h"

enum { SAMPLES = 60 };

static int fit(void *request, struct error *e) {
    struct fit_result r = {.normalised_error = NAN};
    return fit_run(request, &r, e);
}

static void a_fit_reports_that_there_is_no_memory(void **state) {
    (void)state;
    double time[SAMPLES], force[SAMPLES];
    for (int i = 0; i < SAMPLES; i++) {
        time[i] = 0.1 * i - 1.0;
        force[i] = time[i] > 0.0 && time[i] < 3.14159 ? sin(time[i]) : 0.0;
    }
    const double value[CONTACT_ROWS_MAX] = {NAN};
    struct fit_request q = {contact_law_find("linear"), value, 1.0, 1.0, SAMPLES, time, force};
    fail_alloc_each(fit, &q, 3);
}

static int fit_loop(void *request, struct error *e) {
    struct storey_fit_result r;
    return storey_fit_run(request, &r, e);
}

static void so_does_the_fit_of_a_loop(void **state) {
    (void)state;
    double drift[SAMPLES], shear[SAMPLES];
    for (int i = 0; i < SAMPLES; i++) {
        drift[i] = 0.1 * i;
        shear[i] = fmin(drift[i], 1.0 + 0.1 * (drift[i] - 1.0));
    }
    const double value[STOREY_ROWS_MAX] = {NAN, NAN, NAN};
    const int row[] = {STOREY_FIT_STIFFNESS, 0, 1};
    struct loop_law law;
    storey_loop_of_storey(storey_law_find("bilinear"), &law);
    struct storey_fit_request q = {&law, value, NAN, row, 3, SAMPLES, drift, shear};
    fail_alloc_each(fit_loop, &q, 3);
}

static int run_impacts(void) {
    static const char *const word[] = {"jankowski", "-k", "2.75e9", "-e", "0.65",
                                       "-m1",       "2",  "-v",     "1"};
    static const char *const compare[] = {"hertz-damp,hertz", "linear -k 93.5MN/m"};
    const struct law_words words = {.word = word, .n_word = 9, .compare = compare, .n_compare = 2};
    struct law_impacts impacts;
    const int status = law_impacts_run(&words, &impacts);
    if (status == EXIT_DONE) {
        law_impacts_free(&impacts);
    }
    return status;
}

static int run_loops(void) {
    static const char *const word[] = {"bilinear",   "-yield", "6e5",        "-hardening", "0.05",
                                       "-stiffness", "6e7",    "-amplitude", "0.02"};
    static const char *const compare[] = {"clough,takeda"};
    const struct law_storey_words words = {
        .laws = {.word = word, .n_word = 9, .compare = compare, .n_compare = 1},
        .kind = &law_storey_kinds[0]};
    struct law_storeys loops;
    const int status = law_storey_run(&words, &loops);
    if (status == EXIT_DONE) {
        law_storey_free(&loops);
    }
    return status;
}

// Its messages go nowhere.
static int run_law(int (*run)(void)) {
    const int kept = dup(STDERR_FILENO);
    const int nowhere = open("/dev/null", O_WRONLY);
    assert_true(kept >= 0 && nowhere >= 0 && dup2(nowhere, STDERR_FILENO) >= 0);
    const int status = run();
    assert_true(dup2(kept, STDERR_FILENO) >= 0);
    close(kept);
    close(nowhere);
    return status;
}

static void check_command(int (*run)(void)) {
    fail_alloc_at(0);
    assert_int_equal(run_law(run), EXIT_DONE);
    const long n = fail_alloc_stop();
    assert_true(n > 20);
    for (long k = 1; k <= n; k++) {
        fail_alloc_at(k);
        int status = run_law(run);
        fail_alloc_stop();
        if (status != EXIT_SYSTEM) {
            print_message("allocation %ld of %ld fails and the status is %d\n", k, n, status);
            fail();
        }
    }
    assert_int_equal(run_law(run), EXIT_DONE);
}

static void the_command_ends_with_the_status_of_the_system(void **state) {
    (void)state;
    check_command(run_impacts);
    check_command(run_loops);
}

int main(void) {
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_fit_reports_that_there_is_no_memory),
        cmocka_unit_test(so_does_the_fit_of_a_loop),
        cmocka_unit_test(the_command_ends_with_the_status_of_the_system),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
