// SPDX-License-Identifier: GPL-3.0-or-later
// Model building types of HAZUS: FEMA (2003), Multi-hazard Loss Estimation Methodology, Earthquake
// Model, HAZUS-MH Technical Manual, chapter 5. Table 5.1: classes of height, typical storeys and
// heights (in feet there). Tables 5.5 and 5.6: period, overstrength lambda and ductility mu. Tables
// 5.7: strength A_y. The capacity curve is
//
//     D_y = A_y T^2 / (4 pi^2),   A_u = lambda A_y,   D_u = lambda mu D_y,
//
// so its second slope over the first is (lambda - 1) / (lambda mu - 1). The HAZUS tables round.
// HAZUS has no high and moderate code for S5, C3 and URM: they have the values of low code here.
#include <string.h>

#include "core/text.h"
#include "export/street.h"

const char *const street_code_names[STREET_CODES] = {"high", "moderate", "low", "pre"};

enum { ANY = 1000 };  // storeys

// name, least and most storeys, typical storeys, T [s], storey height [m], lambda, A_y [g] and mu
// of high, moderate, low and pre code
// clang-format off
const struct street_type street_types[] = {
    {"W1", 1, 2, 1, 0.35, 4.27, 3, {0.4, 0.3, 0.2, 0.2}, {8, 6, 6, 6}},
    {"W2", 1, ANY, 2, 0.4, 3.66, 2.5, {0.4, 0.2, 0.1, 0.1}, {8, 6, 6, 6}},
    {"S1L", 1, 3, 2, 0.5, 3.66, 3, {0.25, 0.125, 0.062, 0.062}, {8, 6, 5, 6}},
    {"S1M", 4, 7, 5, 1.08, 3.66, 3, {0.156, 0.078, 0.039, 0.039}, {5.3, 4, 3.3, 4}},
    {"S1H", 8, ANY, 13, 2.21, 3.66, 3, {0.098, 0.049, 0.024, 0.024}, {4, 3, 2.5, 3}},
    {"S2L", 1, 3, 2, 0.4, 3.66, 2, {0.4, 0.2, 0.1, 0.1}, {8, 6, 5, 6}},
    {"S2M", 4, 7, 5, 0.86, 3.66, 2, {0.333, 0.167, 0.083, 0.083}, {5.3, 4, 3.3, 4}},
    {"S2H", 8, ANY, 13, 1.77, 3.66, 2, {0.254, 0.127, 0.063, 0.063}, {4, 3, 2.5, 3}},
    {"S3", 1, ANY, 1, 0.4, 4.57, 2, {0.4, 0.2, 0.1, 0.1}, {8, 6, 5, 6}},
    {"S4L", 1, 3, 2, 0.35, 3.66, 2.25, {0.32, 0.16, 0.08, 0.08}, {8, 6, 5, 6}},
    {"S4M", 4, 7, 5, 0.65, 3.66, 2.25, {0.267, 0.133, 0.067, 0.067}, {5.3, 4, 3.3, 4}},
    {"S4H", 8, ANY, 13, 1.32, 3.66, 2.25, {0.203, 0.102, 0.051, 0.051}, {4, 3, 2.5, 3}},
    {"S5L", 1, 3, 2, 0.35, 3.66, 2, {0.1, 0.1, 0.1, 0.1}, {5, 5, 5, 5}},
    {"S5M", 4, 7, 5, 0.65, 3.66, 2, {0.083, 0.083, 0.083, 0.083}, {3.3, 3.3, 3.3, 3.3}},
    {"S5H", 8, ANY, 13, 1.32, 3.66, 2, {0.063, 0.063, 0.063, 0.063}, {2.5, 2.5, 2.5, 2.5}},
    {"C1L", 1, 3, 2, 0.4, 3.05, 3, {0.25, 0.125, 0.062, 0.062}, {8, 6, 5, 6}},
    {"C1M", 4, 7, 5, 0.75, 3.05, 3, {0.208, 0.104, 0.052, 0.052}, {5.3, 4, 3.3, 4}},
    {"C1H", 8, ANY, 12, 1.45, 3.05, 3, {0.098, 0.049, 0.024, 0.024}, {4, 3, 2.5, 3}},
    {"C2L", 1, 3, 2, 0.35, 3.05, 2.5, {0.4, 0.2, 0.1, 0.1}, {8, 6, 5, 6}},
    {"C2M", 4, 7, 5, 0.56, 3.05, 2.5, {0.333, 0.167, 0.083, 0.083}, {5.3, 4, 3.3, 4}},
    {"C2H", 8, ANY, 12, 1.09, 3.05, 2.5, {0.254, 0.127, 0.063, 0.063}, {4, 3, 2.5, 3}},
    {"C3L", 1, 3, 2, 0.35, 3.05, 2.25, {0.1, 0.1, 0.1, 0.1}, {5, 5, 5, 5}},
    {"C3M", 4, 7, 5, 0.56, 3.05, 2.25, {0.083, 0.083, 0.083, 0.083}, {3.3, 3.3, 3.3, 3.3}},
    {"C3H", 8, ANY, 12, 1.09, 3.05, 2.25, {0.063, 0.063, 0.063, 0.063}, {2.5, 2.5, 2.5, 2.5}},
    {"PC1", 1, ANY, 1, 0.35, 4.57, 2, {0.6, 0.3, 0.15, 0.15}, {8, 6, 5, 6}},
    {"PC2L", 1, 3, 2, 0.35, 3.05, 2, {0.4, 0.2, 0.1, 0.1}, {8, 6, 5, 6}},
    {"PC2M", 4, 7, 5, 0.56, 3.05, 2, {0.333, 0.167, 0.083, 0.083}, {5.3, 4, 3.3, 4}},
    {"PC2H", 8, ANY, 12, 1.09, 3.05, 2, {0.254, 0.127, 0.063, 0.063}, {4, 3, 2.5, 3}},
    {"RM1L", 1, 3, 2, 0.35, 3.05, 2, {0.533, 0.267, 0.133, 0.133}, {8, 6, 5, 6}},
    {"RM1M", 4, ANY, 5, 0.56, 3.05, 2, {0.444, 0.222, 0.111, 0.111}, {5.3, 4, 3.3, 4}},
    {"RM2L", 1, 3, 2, 0.35, 3.05, 2, {0.533, 0.267, 0.133, 0.133}, {8, 6, 5, 6}},
    {"RM2M", 4, 7, 5, 0.56, 3.05, 2, {0.444, 0.222, 0.111, 0.111}, {5.3, 4, 3.3, 4}},
    {"RM2H", 8, ANY, 12, 1.09, 3.05, 2, {0.338, 0.169, 0.085, 0.085}, {4, 3, 2.5, 3}},
    {"URML", 1, 2, 1, 0.35, 4.57, 2, {0.2, 0.2, 0.2, 0.2}, {5, 5, 5, 5}},
    {"URMM", 3, ANY, 3, 0.5, 3.56, 2, {0.111, 0.111, 0.111, 0.111}, {3.3, 3.3, 3.3, 3.3}},
    {"MH", 1, ANY, 1, 0.35, 3.05, 2, {0.15, 0.15, 0.15, 0.15}, {6, 6, 6, 6}},
};
// clang-format on
const int n_street_type = sizeof street_types / sizeof street_types[0];

const struct street_type *street_type_find(const char *name, int storeys) {
    const size_t n = strlen(name);
    for (int i = 0; i < n_street_type; i++) {
        const struct street_type *t = &street_types[i];
        const bool whole = strcmp(t->name, name) == 0;
        const bool class = strncmp(t->name, name, n) == 0 && n > 0 && strlen(t->name) == n + 1 &&
                           strchr("LMH", t->name[n]);
        if (whole || (class && storeys >= t->least && storeys <= t->most)) {
            return t;
        }
    }
    return NULL;
}

double street_type_hardening(const struct street_type *t, enum street_code code) {
    return (t->overstrength - 1.0) / (t->overstrength * t->ductility[code] - 1.0);
}

// HAZUS-MH Technical Manual, table 5.20, for zones 4, 3, 2B, 2A, 1 and 0: before 1941, to 1975, and
// later. Light wood frames are never below the second column, nor below low code.
enum street_code street_code_of(enum street_zone zone, double year, bool light_wood) {
    static const enum street_code table[STREET_ZONES][3] = {
        [ZONE_0] = {STREET_PRE, STREET_PRE, STREET_PRE},
        [ZONE_1] = {STREET_PRE, STREET_PRE, STREET_LOW},
        [ZONE_2A] = {STREET_PRE, STREET_LOW, STREET_LOW},
        [ZONE_2B] = {STREET_PRE, STREET_LOW, STREET_MODERATE},
        [ZONE_3] = {STREET_PRE, STREET_MODERATE, STREET_MODERATE},
        [ZONE_4] = {STREET_PRE, STREET_MODERATE, STREET_HIGH},
    };
    const int age = (year > 1940.0) + (year > 1975.0);
    if (light_wood && table[zone][age] == STREET_PRE) {
        return table[zone][1] == STREET_PRE ? STREET_LOW : table[zone][1];
    }
    return table[zone][age];
}
