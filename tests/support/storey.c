// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/storey.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "support/support.h"

// The number in the text, or the place of the word in the row's choice.
static double value_of(const struct row *row, const char *text) {
    if (row->kind != ROW_CHOICE) {
        return strtod(text, NULL);
    }
    int i = 0;
    while (row->range->word[i] && strcmp(row->range->word[i], text) != 0) {
        i++;
    }
    assert_non_null(row->range->word[i]);
    return i;
}

double test_storey_value(const char *key, double hardening) {
    static const struct {
        const char *key;
        double value;
    } known[] = {{"yield", 1.5e5}, {"crack", 0.7e5},  {"cracked", 0.6}, {"b", 0.9},
                 {"eta", 0.3},     {"r", 5.0},        {"weight", 3e6},  {"radius", 2.0},
                 {"mu", 0.05},     {"mu-slow", 0.03}, {"rate", 20.0}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (strcmp(known[i].key, key) == 0) {
            return known[i].value;
        }
    }
    return strcmp(key, "hardening") == 0 ? hardening : NAN;
}

void test_storey_values(const struct storey_law *law, const char *text, double *value) {
    for (int i = 0; i < law->n_row; i++) {
        value[i] = law->row[i].fallback;
    }
    char copy[512];
    assert_true(strlen(text) < sizeof copy);
    memcpy(copy, text, strlen(text) + 1);
    char *rest = NULL;
    for (char *key = strtok_r(copy, " ", &rest); key; key = strtok_r(NULL, " ", &rest)) {
        int i = 0;
        while (i < law->n_row && strcmp(law->row[i].key, key) != 0) {
            i++;
        }
        assert_true(i < law->n_row);
        value[i] =
            law->row[i].kind == ROW_FLAG ? 1.0 : value_of(&law->row[i], strtok_r(NULL, " ", &rest));
    }
}

struct test_storey test_storey_of(const char *name, double stiffness, const char *text) {
    struct test_storey s = {.law = storey_law_find(name)};
    assert_non_null(s.law);
    double value[STOREY_ROWS_MAX];
    test_storey_values(s.law, text, value);
    struct error e;
    assert_int_equal(s.law->prepare(value, stiffness, s.constant, &e), STATUS_OK);
    return s;
}

struct storey_response test_storey_at(const struct test_storey *s, double drift) {
    return s->law->respond(s->constant, s->history, drift, NULL);
}

double test_storey_go(struct test_storey *s, double drift, int n) {
    const double from = s->drift;
    double shear = 0.0;
    for (int i = 1; i <= n; i++) {
        const double to = i == n ? drift : from + (drift - from) * i / n;
        shear = s->law->respond(s->constant, s->history, to, s->history).shear;
    }
    s->drift = drift;
    return shear;
}

double test_storey_work(struct test_storey *s, double drift, int n) {
    const double from = s->drift;
    double work = 0.0;
    for (int i = 1; i <= n; i++) {
        const double before = test_storey_at(s, s->drift).shear;
        const double to = from + (drift - from) * i / n;
        const double way = to - s->drift;
        work += (before + test_storey_go(s, to, 1)) / 2.0 * way;
    }
    return work;
}

void test_storey_protocol(const struct test_storey *virgin, const double *target,
                          const double *want, int n, int steps, double tolerance) {
    struct test_storey s = *virgin;
    for (int i = 0; i < n; i++) {
        assert_near(test_storey_go(&s, target[i], steps), want[i], tolerance);
    }
}
