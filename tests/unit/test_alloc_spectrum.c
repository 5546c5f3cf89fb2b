// SPDX-License-Identifier: GPL-3.0-or-later
// Every allocation on the way from a record to its spectra and its factor for a target is made to
// fail in its turn.
#include "core/arena.h"
#include "jostle/record.h"
#include "jostle/spectrum.h"
#include "motion/target.h"
#include "support/fail_alloc.h"
#include "support/support.h"

static const char *target_path;

static int match_of(const struct spectra *s, struct arena *a, struct error *e) {
    struct target t;
    struct match m;
    const int status = target_read(a, target_path, &t, e);
    if (status != STATUS_OK) {
        return status;
    }
    const double goal[] = {target_at(&t, s->period[0]), target_at(&t, s->period[1])};
    const struct match_request q = {.spectra = s, .goal = goal, .n_component = 1, .high = INFINITY};
    return target_match(&m, &q, a, e);
}

static int spectra_of(const char *path, struct arena *a, struct error *e) {
    static const double period[] = {0.1, 1.0}, damping[] = {0.05};
    const struct record_request request = {.path = path, .dt = 0.1, .unit = "g", .gravity = 9.81};
    struct record r;
    struct signal ground[2];
    int status = record_read(a, &request, &r, e);
    for (int i = 0; status == STATUS_OK && i < 2; i++) {
        status = signal_init_samples(&ground[i], a, r.value, r.n, r.dt, 1.0, 0.0, e);
    }
    struct spectra s = {
        .n_record = 2, .n_damping = 1, .n_period = 2, .damping = damping, .period = period};
    if (status == STATUS_OK) {
        status = spectra_compute(&s, ground, a, e);
    }
    return status == STATUS_OK ? match_of(&s, a, e) : status;
}

static int attempt(void *path, struct error *e) {
    struct arena *a = arena_create();
    int status = a ? spectra_of(path, a, e) : error_no_memory(e);
    arena_free(a);
    return status;
}

static void every_allocation_that_fails_ends_in_an_error(void **state) {
    (void)state;
    target_path = support_write("target.txt", "T [s] PSA [g]\n0.1 1\n1 0.5\n");
    fail_alloc_each(attempt, (void *)support_write("record.txt", "0\n1\n-2\n0\n"), 8);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_allocation_that_fails_ends_in_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
