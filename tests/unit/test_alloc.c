// SPDX-License-Identifier: GPL-3.0-or-later
// Every allocation of a whole analysis is made to fail in its turn: reading a deck with includes,
// parameters and a record, building the model, running it, and making the report. Each failure must
// come back as an error that says so; a crash or a leak shows under `make asan`.
#include <stdio.h>
#include <string.h>

#include "jostle/analysis.h"
#include "jostle/result.h"
#include "support/fail_alloc.h"
#include "support/support.h"

// Contact and yielding happen within the 50 steps; every kind of damping, ground, load and link is
// there.
static const char everything[] = "units kN m s\n"
                                 "param n 3\n"
                                 "param gap 1mm\n"
                                 "title \"memory $n\"\n"
                                 "include part.deck\n"
                                 "building B -floors $n -mass 3*80t -stiffness 40MN/m -height 3\n"
                                 "building C -floors 1 -mass 50t -stiffness 10MN/m\n"
                                 "building D -floors ${n - 1} -mass 50t -stiffness 10MN/m\n"
                                 "frame B -bays 5 -modulus 30GPa -columns-inextensible\n"
                                 "columns B:all -I 0.002\nbeams B:all -I 0.002\n"
                                 "hinges B:all beams takeda -yield 50 -hardening 0.1 -stiffness "
                                 "1e6\n"
                                 "damping A rayleigh 5% -modes 1 2\n"
                                 "damping B modal 3*5%\n"
                                 "damping C dashpot 100\n"
                                 "storey A:1:2 bilinear -yield 20 -hardening 0.05\n"
                                 "contact A B -gap $gap -law hertz-damp -k 1e6 -e 0.6 -name joint\n"
                                 "contact B:1 C -gap 2mm -law kelvin-voigt -k 1e5 -e 0.6\n"
                                 "contact B:1 C -gap 3mm -law jankowski -k 1e5 -e 0.6\n"
                                 "contact D:1,2 wall -gap 1 1 -law linear -k 1e5\n"
                                 "contact A wall -gap 1 -law table -file pad.txt -units mm kN\n"
                                 "contact wall A -gap 1 -law wang -residual 0.2 -e 0.5 -k-from "
                                 "hertz -radius1 1 -modulus1 30GPa -poisson1 0.2\n"
                                 "contact wall B -gap 1 -law bilinear -kh 1e6 -e 0.5 -v0 1 "
                                 "-calibrate\n"
                                 "link C D:1 -stiffness 100 -dashpot 10 -exponent 0.5\n"
                                 "link A:1 A:2 -law bilinear -stiffness 900 -yield 2 -hardening 0 "
                                 "-slack 1mm -tension-only\n"
                                 "link A B -law maxwell -stiffness 900 -dashpot 10\n"
                                 "ground record record.txt -unit g -dt 0.02 -pga 0.4g\n"
                                 "ground sine -amplitude 0.1g -frequency 2 -buildings A D\n"
                                 "load A:2 sine -amplitude 5 -frequency 3\n"
                                 "load B:1,3 history record.txt -dt 0.02 -scale 10\n"
                                 "initial A:2 -velocity 1m/s\n"
                                 "output -fields displacement force\n"
                                 "duration 0.1\n";

static int keep_row(void *context, const struct row_view *row, struct error *e) {
    (void)e;
    *(double *)context = row->time;
    return STATUS_OK;
}

static int report(const struct model *m, const struct results *r, struct error *e) {
    struct report *out = NULL;
    int status = report_create(m, r, "a.h5", "0.0.0", &out, e);
    report_free(out);
    return status;
}

static int run(const struct model *m, struct error *e) {
    double time = -1.0;
    const struct observer observer = {.row = keep_row, .context = &time};
    struct results *results = NULL;
    int status = analysis_run(m, &observer, &results, e);
    if (status == STATUS_OK) {
        assert_close(time, 0.1, 1e-12);
        assert_true(results->n_impact > 0);
        status = report(m, results, e);
        results_free(results);
    }
    return status;
}

static void assert_no_memory(const struct deck *d, const struct error *e) {
    if (strstr(e->message, "out of memory") || d->diagnostics.out_of_memory) {
        return;
    }
    for (int i = 0; i < d->diagnostics.n_item; i++) {
        if (strstr(d->diagnostics.item[i].message, "out of memory")) {
            return;
        }
    }
    diagnostics_print(&d->diagnostics, stderr, false);
    fail_msg("'%s' does not speak of memory", e->message);
}

// Everything, with the k-th allocation failing (0: none); the status, and in *n how many there
// were.
static int attempt(const char *path, long k, long *n) {
    static const char *const define[] = {"gap=${2mm / 2}"};
    struct error e = {.message = ""};
    struct deck *deck = NULL;
    struct model *m = NULL;
    fail_alloc_at(k);
    int status = deck_open(path, define, 1, &deck, &e);
    if (status != STATUS_OK) {
        *n = fail_alloc_stop();
        assert_null(deck);
        assert_string_equal(e.message, "out of memory");
        return status;
    }
    status = model_build(deck, &m, &e);
    if (status == STATUS_OK) {
        status = run(m, &e);
    }
    *n = fail_alloc_stop();
    if (status != STATUS_OK) {
        assert_no_memory(deck, &e);
    }
    deck_free(deck);
    return status;
}

static const char *write_deck(const char *text, const char *step) {
    char deck[4096];
    int n = snprintf(deck, sizeof deck, "%s%s\n", text, step);
    assert_in_range(n, 1, sizeof deck - 1);
    support_write("record.txt", "0\n1\n-2\n4\n-3\n2\n0\n");
    support_write("pad.txt", "0 0 0\n1 5 1\n2 20 20\n");
    support_write("part.deck", "building A -floors 2 -mass 100t -stiffness 30MN/m 20MN/m\n");
    return support_write("top.deck", deck);
}

static void every_allocation_that_fails_ends_in_an_error(void **state) {
    const char *path = write_deck(everything, *state);
    long n;
    assert_int_equal(attempt(path, 0, &n), STATUS_OK);
    assert_in_range(n, 20, 20000);
    for (long k = 1; k <= n; k++) {
        long made;
        int status = attempt(path, k, &made);
        if (status >= 0) {
            fail_msg("allocation %ld of %ld failed unnoticed", k, n);
        }
        assert_in_range(made, k, n + 1);
    }
    long made;
    assert_int_equal(attempt(path, n + 1, &made), STATUS_OK);
    assert_int_equal(made, n);
}

// Messages need memory, too.
static void an_error_message_that_finds_no_memory_is_still_an_error(void **state) {
    (void)state;
    const char *path = write_deck("building A -floors 2 -mass 1 -stifness 1\nimpact A\n"
                                  "contact A Bee -gap 1mm -law herz -k 1\n",
                                  "step fixed 1");
    for (long k = 0;; k++) {
        struct error e = {.message = ""};
        struct deck *deck = NULL;
        struct model *m = NULL;
        fail_alloc_at(k);
        int status = deck_open(path, NULL, 0, &deck, &e);
        if (status == STATUS_OK) {
            status = model_build(deck, &m, &e);
            assert_true(deck->diagnostics.n_error > 0 || status == STATUS_SYSTEM);
        }
        long made = fail_alloc_stop();
        deck_free(deck);
        assert_true(status < 0);
        assert_true(e.message[0] != 0);
        if (k > made) {
            break;
        }
    }
}

int main(void) {
    static char fixed[] = "step fixed 0.002";
    static char adaptive[] = "step adaptive";
    static char newmark[] = "integrator newmark\nstep adaptive";
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(every_allocation_that_fails_ends_in_an_error, fixed),
        cmocka_unit_test_prestate(every_allocation_that_fails_ends_in_an_error, adaptive),
        cmocka_unit_test_prestate(every_allocation_that_fails_ends_in_an_error, newmark),
        cmocka_unit_test(an_error_message_that_finds_no_memory_is_still_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
