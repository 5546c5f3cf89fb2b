// SPDX-License-Identifier: GPL-3.0-or-later
// Banded systems against solutions that they are made up from.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "solve/contact/contact.h"
#include "support/random.h"
#include "support/support.h"

enum { N_MAX = 60 };

struct system {
    int n, width;
    double a[N_MAX * N_MAX], b[N_MAX], x[N_MAX];
};

// A third of the diagonal is 0, so that rows have to be exchanged.
static void make_up(struct random *r, struct system *s) {
    *s = (struct system){.n = 1 + random_below(r, N_MAX)};
    s->width = random_below(r, s->n);
    for (int i = 0; i < s->n; i++) {
        s->x[i] = random_uniform(r, -1.0, 1.0);
    }
    for (int i = 0; i < s->n; i++) {
        for (int j = 0; j < s->n; j++) {
            bool zero = abs(i - j) > s->width || (i == j && s->width > 0 && i % 3 == 1);
            s->a[i * s->n + j] = zero ? 0.0 : random_uniform(r, -1.0, 1.0);
            s->b[i] += s->a[i * s->n + j] * s->x[j];
        }
    }
}

// A pivot is the largest of its column, so that what remains of A x - b is rounding, however far x
// is from what it was.
static void what_is_found_solves_the_system(void **state) {
    (void)state;
    struct random r = {7};
    int solved = 0;
    for (int i = 0; i < 500; i++) {
        struct system s;
        make_up(&r, &s);
        double a[N_MAX * N_MAX], x[N_MAX];
        memcpy(a, s.a, sizeof a);
        memcpy(x, s.b, sizeof x);
        if (!cluster_eliminate(a, x, s.n, s.width)) {
            continue;
        }
        solved++;
        for (int j = 0; j < s.n; j++) {
            double left = -s.b[j], size = fabs(s.b[j]);
            for (int k = 0; k < s.n; k++) {
                left += s.a[j * s.n + k] * x[k];
                size += fabs(s.a[j * s.n + k] * x[k]);
            }
            assert_near(left, 0.0, 1e-11 * size);
        }
    }
    assert_true(solved > 490);
}

static void a_singular_system_is_told(void **state) {
    (void)state;
    double a[] = {1.0, 2.0, 0.0, 2.0, 4.0, 0.0, 0.0, 0.0, 1.0}, b[] = {1.0, 2.0, 3.0};
    assert_false(cluster_eliminate(a, b, 3, 1));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_found_solves_the_system),
        cmocka_unit_test(a_singular_system_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
