// SPDX-License-Identifier: GPL-3.0-or-later
// Sweeps as the deck language reads them: values, ranges, files, -D, and the deck of one run.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "sweep_cases.h"

static void values_keep_their_order_and_their_unit(void **state) {
    (void)state;
    const char *shown = NULL;
    struct deck *d = read_deck("units kN m s\nsweep gap values 20mm 5mm 1.5cm\nshow $gap\n", NULL,
                               NULL, NULL, &shown);
    assert_int_equal(d->diagnostics.n_error, 0);
    const struct sweep *s = d->sweeps;
    assert_string_equal(s->name, "gap");
    assert_int_equal(s->n, 3);
    assert_true(s->known && dimension_equal(s->dimension, dimension_length));
    assert_close(s->number[0], 0.02, 1e-15);
    assert_close(s->number[1], 0.005, 1e-15);
    assert_close(s->number[2], 0.015, 1e-15);
    assert_int_equal(d->n_run, 3);
    assert_true(deck_is_study(d));
    assert_string_equal(shown, "0.02");
    deck_free(d);
}

static void bare_values_are_in_the_units_of_the_deck(void **state) {
    (void)state;
    const char *shown = NULL;
    struct deck *d = read_deck("units kN mm s\nparam gap 2cm\n"
                               "sweep a values 0 1.5cm 5 $gap ${2*gap}\nsweep b range 0 5cm 3\n"
                               "sweep c random uniform 0 1cm -n 3 -seed 1\n"
                               "sweep d random normal 1cm 1mm -n 3 -seed 1 -min 0\n"
                               "show $a$b$c$d\n",
                               NULL, NULL, NULL, &shown);
    assert_int_equal(d->diagnostics.n_error, 0);
    static const double want[] = {0, 15, 5, 20, 40};
    const struct sweep *a = d->sweeps, *b = a->next, *c = b->next->along;
    const struct sweep *const all[] = {a, b, c, c->along};
    assert_int_equal(a->n, 5);
    for (int i = 0; i < 5; i++) {
        assert_close(a->number[i], want[i], 1e-15);
    }
    assert_close(b->number[1], 25, 1e-15);
    for (int i = 0; i < 4; i++) {
        assert_true(all[i]->known && dimension_equal(all[i]->dimension, dimension_length));
    }
    deck_free(d);
}

static void ranges_hold_both_ends_exactly(void **state) {
    (void)state;
    const char *shown = NULL;
    struct deck *d = read_deck("sweep a range 0.1 0.7 7\nsweep b range 1e-3 1e3 7 -log\n"
                               "sweep c range 5 -5 3\nshow $a$b$c\n",
                               NULL, NULL, NULL, &shown);
    assert_int_equal(d->diagnostics.n_error, 0);
    const struct sweep *a = d->sweeps, *b = a->next, *c = b->next;
    assert_int_equal(d->n_run, 7 * 7 * 3);
    assert_true(a->number[0] == 0.1 && a->number[6] == 0.7);
    assert_true(b->number[0] == 1e-3 && b->number[6] == 1e3);
    for (int i = 0; i < 7; i++) {
        assert_close(a->number[i], 0.1 * (i + 1), 1e-14);
        assert_close(b->number[i], pow(10.0, i - 3), 1e-13);
    }
    assert_true(c->number[0] == 5.0 && c->number[1] == 0.0 && c->number[2] == -5.0);
    deck_free(d);
}

static void a_bound_deck_takes_the_values_of_its_run(void **state) {
    (void)state;
    static const char text[] = "sweep law values hertz linear\nsweep k range 1 3 3\n"
                               "param twice ${2*k}\nshow \"$law $twice\"\n";
    const char *shown = NULL;
    struct deck *first = read_deck(text, NULL, NULL, NULL, &shown);
    assert_string_equal(shown, "hertz 2");
    for (int run = 0; run < 6; run++) {
        const int choice[] = {run / 3, run % 3};
        char want[32];
        snprintf(want, sizeof want, "%s %d", run / 3 ? "linear" : "hertz", 2 * (run % 3 + 1));
        struct deck *d = read_deck(text, NULL, first, choice, &shown);
        assert_int_equal(d->diagnostics.n_error, 0);
        assert_string_equal(shown, want);
        deck_free(d);
    }
    deck_free(first);
}

// What a run costs does not grow with the values of its study.
static void a_bound_deck_reads_no_values_again(void **state) {
    (void)state;
    const char *shown = NULL;
    const int choice[] = {1, 2, 0};
    const char *text = "units kN m s\nsweep gap \\\n values 20mm 5mm \\\n1.5cm # three\n"
                       "sweep e range 0.1 0.9 5\nsweep law values a b\nshow $gap$e$law\n"
                       "show $nobody";
    struct deck *first = read_deck(text, NULL, NULL, NULL, &shown);
    struct deck *d = read_deck(text, NULL, first, choice, &shown);
    assert_int_equal(first->diagnostics.n_error, 1);
    assert_int_equal(d->diagnostics.n_error, 1);
    assert_int_equal(d->diagnostics.item[0].line, first->diagnostics.item[0].line);
    const struct sweep *a = first->sweeps, *b = d->sweeps;
    for (int i = 0; i < 3; i++, a = a->next, b = b->next) {
        assert_true(a->number == b->number && a->text == b->text && a->n == b->n);
        assert_string_equal(a->name, b->name);
    }
    assert_null(b);
    deck_free(d);
    deck_free(first);
}

static struct deck *read_bound(const char *text, const char *define, const struct deck *first) {
    static const int choice[] = {1};
    const char *shown = NULL;
    struct deck *d = read_deck(text, define, first, choice, &shown);
    assert_int_equal(d->diagnostics.n_error, 0);
    return d;
}

// The text of the deck is that of the first run, but files that it includes may not be.
static void a_bound_deck_reads_values_again_that_may_differ(void **state) {
    (void)state;
    static const char *const text[][2] = {
        {"sweep gap values 5mm 7mm\nshow $gap\n", "sweep gap values 5mm 8mm\nshow $gap\n"},
        {"sweep gap values 5mm 7mm\nshow $gap\n", "sweep gap values 5mm 7mm 9mm\nshow $gap\n"},
        {"sweep gap values 5 7", "sweep gap values 5 78"},
        {"gravity 9.8\nsweep a values 1g 2g\nshow $a\n",
         "gravity 9.7\nsweep a values 1g 2g\nshow $a\n"},
        {"param b 2\nsweep a values 1 $b\nshow $a\n", "param b 3\nsweep a values 1 $b\nshow $a\n"},
    };
    for (size_t i = 0; i < sizeof text / sizeof text[0]; i++) {
        const char *shown = NULL;
        struct deck *first = read_deck(text[i][0], NULL, NULL, NULL, &shown);
        struct deck *d = read_deck(text[i][1], NULL, first, (const int[]){1}, &shown);
        assert_true(first->sweeps->number[1] != d->sweeps->number[1] ||
                    first->sweeps->n != d->sweeps->n);
        deck_free(d);
        deck_free(first);
    }
}

static void a_define_fixes_a_known_sweep(void **state) {
    (void)state;
    const char *text = "sweep gap values 5mm 7mm\nshow $gap\n";
    struct deck *first = read_bound(text, "gap=6mm", NULL);
    struct deck *d = read_bound(text, "gap=6mm", first);
    assert_true(d->sweeps->fixed && d->sweeps->n == 1 && d->n_run == 1);
    assert_close(d->sweeps->number[0], 0.006, 1e-15);
    deck_free(d);
    deck_free(first);
}

static void a_define_fixes_a_sweep(void **state) {
    (void)state;
    const char *shown = NULL;
    struct deck *d = read_deck("sweep k range 1 3 3\nshow $k\n", "k=7", NULL, NULL, &shown);
    assert_int_equal(d->diagnostics.n_error, 0);
    assert_string_equal(shown, "7");
    assert_true(d->sweeps->fixed && d->sweeps->n == 1 && d->sweeps->number[0] == 7.0);
    assert_int_equal(d->n_run, 1);
    assert_false(deck_is_study(d));
    deck_free(d);
}

// A param is what the deck has without the sweep; where it is used above the sweep, the runs have
// the values of the sweep there too, and so has what is made of it.
static void a_sweep_takes_over_the_param_above_or_below_it(void **state) {
    (void)state;
    static const char *const order[] = {
        "param k 9\nparam twice ${2*k}\nshow $k/$twice\nsweep k values 1 3\n",
        "param k 9\nsweep k values 1 3\nparam twice ${2*k}\nshow $k/$twice\n",
        "sweep k values 1 3\nparam k 9\nparam twice ${2*k}\nshow $k/$twice\n",
        "sweep k values 1 3\nparam twice ${2*k}\nshow $k/$twice\nparam k 9\n",
    };
    const char *shown = NULL;
    for (int i = 0; i < 4; i++) {
        struct deck *first = read_deck(order[i], NULL, NULL, NULL, &shown);
        assert_int_equal(first->diagnostics.n_error, 0);
        assert_int_equal(first->n_run, 2);
        assert_string_equal(shown, "1/2");
        struct deck *d = read_deck(order[i], NULL, first, (const int[]){1}, &shown);
        assert_int_equal(d->diagnostics.n_error, 0);
        assert_string_equal(shown, "3/6");
        deck_free(d);
        deck_free(first);
        d = read_deck(order[i], "k=7", NULL, NULL, &shown);
        assert_int_equal(d->diagnostics.n_error, 0);
        assert_string_equal(shown, "7/14");
        assert_true(d->sweeps->fixed && d->sweeps->number[0] == 7.0);
        deck_free(d);
    }
}

// Nothing is left to be found by another reading, which would end no sooner.
static void a_wrong_sweep_over_a_param_is_read_once(void **state) {
    (void)state;
    const char *shown = NULL;
    struct deck *d =
        read_deck("param k 9\nshow $k\nsweep k values 1 two\n", NULL, NULL, NULL, &shown);
    assert_int_equal(d->diagnostics.n_error, 1);
    deck_free(d);
}

// The labels of the files that a pattern matches, with blanks between.
static const char *labels(const char *pattern, char *to, size_t size) {
    char text[256];
    const char *shown = NULL;
    snprintf(text, sizeof text, "sweep f files \"%s\"\nshow $f\n", pattern);
    struct deck *d = read_deck(text, NULL, NULL, NULL, &shown);
    assert_int_equal(d->diagnostics.n_error, 0);
    to[0] = '\0';
    for (int i = 0; i < d->sweeps->n; i++) {
        const size_t used = strlen(to);
        snprintf(to + used, size - used, "%s%s", i ? " " : "", d->sweeps->label[i]);
    }
    assert_string_equal(shown, d->sweeps->text[0]);
    deck_free(d);
    return to;
}

static void files_are_sorted_and_have_the_shortest_labels_that_differ(void **state) {
    (void)state;
    char text[256];
    assert_int_equal(mkdir(support_path("one"), 0777), 0);
    assert_int_equal(mkdir(support_path("two"), 0777), 0);
    support_write("one/b.AT2", "");
    support_write("one/a.AT2", "");
    support_write("one/a.txt", "");
    support_write("two/c.AT2", "");
    assert_string_equal(labels("*/*.AT2", text, sizeof text), "a b c");
    assert_string_equal(labels("one/*", text, sizeof text), "a.AT2 a.txt b.AT2");
    support_write("two/a.AT2", "");
    assert_string_equal(labels("*/a.AT2", text, sizeof text), "one/a.AT2 two/a.AT2");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_keep_their_order_and_their_unit),
        cmocka_unit_test(bare_values_are_in_the_units_of_the_deck),
        cmocka_unit_test(ranges_hold_both_ends_exactly),
        cmocka_unit_test(a_bound_deck_takes_the_values_of_its_run),
        cmocka_unit_test(a_bound_deck_reads_no_values_again),
        cmocka_unit_test(a_bound_deck_reads_values_again_that_may_differ),
        cmocka_unit_test(a_define_fixes_a_known_sweep),
        cmocka_unit_test(a_define_fixes_a_sweep),
        cmocka_unit_test(a_sweep_takes_over_the_param_above_or_below_it),
        cmocka_unit_test(a_wrong_sweep_over_a_param_is_read_once),
        cmocka_unit_test(files_are_sorted_and_have_the_shortest_labels_that_differ),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
