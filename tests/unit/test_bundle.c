// SPDX-License-Identifier: GPL-3.0-or-later
// Sweeps that go together: samples of random ones, and those of the same -as.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sweep_cases.h"

static const char random_text[] = "units kN m s\n"
                                  "sweep k random lognormal 40MN/m 0.3 -n 5 -seed 1 -lhs\n"
                                  "sweep v values 1 2\n"
                                  "sweep gap random normal 20mm 4mm -n 5 -seed 1 -min 0mm\n"
                                  "sweep z random uniform 0 1 -n 3 -seed 1 -as other\n"
                                  "show \"$k $v $gap $z $sample $other\"\n";

// Random sweeps of one sample make one dimension, where its first one stands; others multiply.
static void random_sweeps_are_sampled_together(void **state) {
    (void)state;
    const char *shown = NULL;
    struct deck *d = read_deck(random_text, NULL, NULL, NULL, &shown);
    assert_int_equal(d->diagnostics.n_error, 0);
    const struct sweep *sample = d->sweeps, *v = sample->next, *third = v->next;
    assert_int_equal(d->n_run, 5 * 2 * 3);
    assert_string_equal(sample->name, "sample");
    assert_string_equal(v->name, "v");
    assert_string_equal(third->name, "other");
    assert_null(third->next);
    const struct sweep *k = sample->along, *gap = k->along;
    assert_string_equal(k->name, "k");
    assert_string_equal(gap->name, "gap");
    assert_null(gap->along);
    assert_null(v->along);
    assert_string_equal(third->along->name, "z");
    assert_true(sample->number[0] == 1.0 && sample->number[4] == 5.0);
    assert_int_equal(gap->n, 5);
    assert_true(gap->known && dimension_equal(gap->dimension, dimension_length));
    deck_free(d);
}

static void read_six(const char *text, double *to) {
    for (int i = 0; i < 6; i++) {
        char *end;
        to[i] = strtod(text, &end);
        assert_true(end > text);
        text = end;
    }
}

static void a_bound_deck_takes_the_values_of_its_sample(void **state) {
    (void)state;
    const char *shown = NULL;
    struct deck *first = read_deck(random_text, NULL, NULL, NULL, &shown);
    const struct sweep *sample = first->sweeps, *z = sample->next->next->along;
    for (int run = 0; run < 30; run++) {
        const int choice[] = {run / 6, run / 3 % 2, run % 3};
        char want[128];
        snprintf(want, sizeof want, "%.17g %d %.17g %.17g %d %d", sample->along->number[choice[0]],
                 choice[1] + 1, sample->along->along->number[choice[0]], z->number[choice[2]],
                 choice[0] + 1, choice[2] + 1);
        struct deck *d = read_deck(random_text, NULL, first, choice, &shown);
        assert_int_equal(d->diagnostics.n_error, 0);
        double got[6], expected[6];
        read_six(shown, got);
        read_six(want, expected);
        for (int i = 0; i < 6; i++) {
            assert_close(got[i], expected[i], 1e-14);
        }
        deck_free(d);
    }
    deck_free(first);
}

// Then the study is refused; until it is, there is no value to be read.
static void a_bound_deck_with_fewer_values_takes_the_first(void **state) {
    (void)state;
    const char *shown = NULL;
    struct deck *first = read_deck("sweep k random uniform 1 2 -n 5000 -seed 1\nshow $k\n", NULL,
                                   NULL, NULL, &shown);
    struct deck *d = read_deck("sweep k random uniform 1 2 -n 3 -seed 1\nshow $k\n", NULL, first,
                               (const int[]){4999}, &shown);
    assert_int_equal(d->diagnostics.n_error, 0);
    assert_close(strtod(shown, NULL), d->sweeps->along->number[0], 1e-14);
    deck_free(d);
    deck_free(first);
}

// -D sample=I is run I; -D of a random parameter fixes that one and leaves the others as they are.
static void a_define_fixes_a_sample_or_a_parameter_of_it(void **state) {
    (void)state;
    const char *shown = NULL;
    struct deck *all = read_deck(random_text, NULL, NULL, NULL, &shown);
    struct deck *one = read_deck(random_text, "sample=4", NULL, NULL, &shown);
    assert_int_equal(one->diagnostics.n_error, 0);
    assert_int_equal(one->n_run, 6);
    const struct sweep *k = one->sweeps->along, *gap = k->along;
    assert_true(one->sweeps->fixed && k->fixed && k->n == 1);
    assert_true(k->number[0] == all->sweeps->along->number[3]);
    assert_true(gap->number[0] == all->sweeps->along->along->number[3]);
    struct deck *other = read_deck(random_text, "k=3e4", NULL, NULL, &shown);
    assert_int_equal(other->diagnostics.n_error, 0);
    assert_int_equal(other->n_run, 30);
    assert_true(other->sweeps->fixed && other->sweeps->number[0] == 3e4);
    const struct sweep *sample = other->sweeps->next->next;
    assert_string_equal(sample->name, "sample");
    assert_memory_equal(sample->along->number, all->sweeps->along->along->number,
                        5 * sizeof(double));
    deck_free(other);
    deck_free(one);
    deck_free(all);
}

static void a_random_sweep_takes_over_its_param_too(void **state) {
    (void)state;
    static const char text[] = "param k 9\nparam f x.txt\nshow $k/$f\nsweep f values a b\n"
                               "sweep k random uniform 1 2 -n 3 -seed 1\n";
    const char *shown = NULL;
    struct deck *first = read_deck(text, NULL, NULL, NULL, &shown);
    assert_int_equal(first->n_run, 6);
    const double *k = first->sweeps->next->along->number;
    for (int run = 0; run < 6; run++) {
        struct deck *d = read_deck(text, NULL, first, (const int[]){run / 3, run % 3}, &shown);
        assert_int_equal(d->diagnostics.n_error, 0);
        char *rest;
        assert_close(strtod(shown, &rest), k[run % 3], 1e-14);  // texts have 15 digits
        assert_string_equal(rest, run / 3 ? "/b" : "/a");
        deck_free(d);
    }
    deck_free(first);
}

// Motions of a record and a factor each, at two gaps.
#define MOTIONS                                                                                    \
    "sweep factor values 1.31 0.84 1.31 -as motion\n"                                              \
    "sweep gap values 10mm 20mm\n"                                                                 \
    "sweep record files \"*.at2\" -as motion\n"
static const char motions[] = "units kN m s\n" MOTIONS "show \"$motion $factor $gap $record\"\n";

static void write_records(void) {
    support_write("a.at2", "");
    support_write("b.at2", "");
    support_write("c.at2", "");
}

static void sweeps_with_the_same_as_go_together(void **state) {
    (void)state;
    const char *shown = NULL;
    write_records();
    struct deck *first = read_deck(motions, NULL, NULL, NULL, &shown);
    assert_int_equal(first->diagnostics.n_error, 0);
    assert_int_equal(first->n_run, 6);
    const struct sweep *motion = first->sweeps, *factor = motion->along, *record = factor->along;
    assert_string_equal(motion->name, "motion");
    assert_string_equal(motion->next->name, "gap");
    assert_null(motion->next->next);
    assert_string_equal(factor->name, "factor");
    assert_string_equal(record->label[2], "c");
    static const char *const want[] = {"1 1.31 0.01 a.at2", "2 0.84 0.01 b.at2",
                                       "3 1.31 0.01 c.at2"};
    for (int i = 0; i < 3; i++) {
        struct deck *d = read_deck(motions, NULL, first, (const int[]){i, 0}, &shown);
        assert_int_equal(d->diagnostics.n_error, 0);
        assert_string_equal(shown, want[i]);
        assert_ptr_equal(d->sweeps->along->number, factor->number);
        assert_ptr_equal(d->sweeps->along->along->text, record->text);
        deck_free(d);
    }
    deck_free(first);
}

static void a_random_sweep_goes_together_with_others(void **state) {
    (void)state;
    static const char text[] = "sweep k random uniform 1 2 -n 3 -seed 1 -as both\n"
                               "sweep word values x y x -as both\n"
                               "sweep z range 1 4 3 -log -as both\nshow \"$k $word $z\"\n";
    const char *shown = NULL;
    struct deck *first = read_deck(text, NULL, NULL, NULL, &shown);
    assert_int_equal(first->n_run, 3);
    struct deck *d = read_deck(text, NULL, first, (const int[]){1}, &shown);
    char *rest;
    assert_close(strtod(shown, &rest), first->sweeps->along->number[1], 1e-14);
    assert_string_equal(rest, " y 2");
    deck_free(d);
    deck_free(first);
}

// A number of the dimension chooses, and so does a text of one of its sweeps, wherever it is used;
// any other value takes the place of those of its sweep.
static void a_define_chooses_one_of_what_goes_together(void **state) {
    (void)state;
    static const char early[] = "units kN m s\nparam record x.at2\nparam used \"$record\"\n" MOTIONS
                                "show \"$motion $factor $gap $used\"\n";
    static const struct {
        const char *text, *define, *shown;
        int n_run;
    } cases[] = {
        {motions, "motion=2", "2 0.84 0.01 b.at2", 2},
        {motions, "record=b", "2 0.84 0.01 b.at2", 2},
        {motions, "record=b.at2", "2 0.84 0.01 b.at2", 2},
        {early, "record=c", "3 1.31 0.01 c.at2", 2},
        {early, "motion=3", "3 1.31 0.01 c.at2", 2},
        {motions, "factor=1.31", "1 1.31 0.01 a.at2", 6},
        {motions, "gap=1m", "1 1.31 1 a.at2", 3},
    };
    const char *shown = NULL;
    write_records();
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct deck *d = read_deck(cases[i].text, cases[i].define, NULL, NULL, &shown);
        assert_int_equal(d->diagnostics.n_error, 0);
        assert_string_equal(shown, cases[i].shown);
        assert_int_equal(d->n_run, cases[i].n_run);
        struct deck *bound =
            read_deck(cases[i].text, cases[i].define, d, (const int[STUDY_SWEEPS_MAX]){0}, &shown);
        assert_int_equal(bound->diagnostics.n_error, 0);
        assert_string_equal(shown, cases[i].shown);
        deck_free(bound);
        deck_free(d);
    }
}

static void a_define_of_another_file_leaves_the_others(void **state) {
    (void)state;
    const char *shown = NULL;
    write_records();
    support_write("other.txt", "");
    struct deck *d = read_deck(motions, "record=other.txt", NULL, NULL, &shown);
    assert_int_equal(d->diagnostics.n_error, 0);
    assert_string_equal(shown, "1 1.31 0.01 other.txt");
    assert_int_equal(d->n_run, 6);
    deck_free(d);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_sweeps_are_sampled_together),
        cmocka_unit_test(a_bound_deck_takes_the_values_of_its_sample),
        cmocka_unit_test(a_bound_deck_with_fewer_values_takes_the_first),
        cmocka_unit_test(a_define_fixes_a_sample_or_a_parameter_of_it),
        cmocka_unit_test(a_random_sweep_takes_over_its_param_too),
        cmocka_unit_test(sweeps_with_the_same_as_go_together),
        cmocka_unit_test(a_random_sweep_goes_together_with_others),
        cmocka_unit_test(a_define_chooses_one_of_what_goes_together),
        cmocka_unit_test(a_define_of_another_file_leaves_the_others),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
