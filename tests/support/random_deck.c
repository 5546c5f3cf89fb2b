// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random_deck.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/random.h"
#include "support/support.h"

struct maker {
    struct random random;
    char *text;
    size_t size, used;
    bool monotone;  // laws that may pull are left out
    int n_building;
    int floors[6];
};

__attribute__((format(printf, 2, 3))) static void add(struct maker *m, const char *format, ...) {
    va_list list;
    va_start(list, format);
    int n = vsnprintf(m->text + m->used, m->size - m->used, format, list);
    va_end(list);
    assert_true(n >= 0 && (size_t)n < m->size - m->used);
    m->used += (size_t)n;
}

static void add_damping(struct maker *m, int i) {
    switch (random_below(&m->random, 4)) {
        case 0:
            add(m, "damping B%d rayleigh %.4g\n", i, random_uniform(&m->random, 0.0, 0.1));
            break;
        case 1:
            add(m, "damping B%d modal %.4g\n", i, random_uniform(&m->random, 0.0, 0.2));
            break;
        case 2:
            add(m, "damping B%d dashpot %.4g\n", i, random_logarithmic(&m->random, 1.0, 1e6));
            break;
        default:
            break;
    }
}

static void add_building(struct maker *m, int i) {
    m->floors[i] = 1 + random_below(&m->random, 6);
    double mass = random_logarithmic(&m->random, 1e2, 1e8);
    double omega = random_logarithmic(&m->random, 1.0, 100.0);
    double stiffness = random_below(&m->random, 12) ? mass * omega * omega : 0.0;
    add(m, "building B%d -floors %d -mass %.6g -stiffness %.6g\n", i, m->floors[i], mass,
        stiffness);
    if (stiffness > 0.0) {
        add_damping(m, i);
    }
    if (stiffness > 0.0 && random_below(&m->random, 3) == 0) {
        static const char *const law[] = {"bilinear", "bouc-wen", "clough", "takeda"};
        add(m, "storey B%d:all %s -yield %.6g -hardening %.3g\n", i,
            law[random_below(&m->random, 4)], mass * random_logarithmic(&m->random, 0.1, 10.0),
            random_below(&m->random, 2) ? 0.0 : random_uniform(&m->random, 0.0, 0.5));
    }
    if (random_below(&m->random, 3) == 0) {
        add(m, "initial B%d:all -velocity %.4g\n", i, random_uniform(&m->random, -1.0, 1.0));
    }
}

// A law with parameters of its own, of a stiffness of about k.
static void add_odd_law(struct maker *m, double k) {
    static const char *const units[] = {"mm kN", "cm kN", "mm MN", "m MN"};
    const char *calibrate = random_below(&m->random, 2) ? "" : " -calibrate";
    switch (random_below(&m->random, 7)) {
        case 0:
            add(m, "bilinear -k1 %.6g -k2 %.6g -dy %.4g\n", k,
                k * random_uniform(&m->random, 0.01, 1.0),
                random_logarithmic(&m->random, 1e-6, 0.1));
            break;
        case 1:
            add(m, "bilinear -kh %.6g -e %.4g -v0 %.4g%s\n", k,
                random_uniform(&m->random, 0.05, 1.0), random_logarithmic(&m->random, 0.01, 3.0),
                calibrate);
            break;
        case 2:
            add(m, "wang -k %.6g -zeta %.6g -residual %.4g\n", k,
                k * random_logarithmic(&m->random, 0.01, 10.0),
                random_uniform(&m->random, 0.0, 0.8));
            break;
        case 3:
            add(m, "wang -k %.6g -e %.4g -residual 0.3 -n %.3g%s\n", k,
                random_uniform(&m->random, 0.05, 0.8), random_uniform(&m->random, 1.0, 2.5),
                calibrate);
            break;
        case 4:
            add(m, "rubber -k %.6g -n %.3g -e %.4g -du %.4g -ky %.6g%s\n", k,
                random_uniform(&m->random, 1.0, 3.0), random_uniform(&m->random, 0.05, 1.0),
                random_logarithmic(&m->random, 1e-4, 0.1), k, calibrate);
            break;
        case 5:
            add(m, "stereomechanical -e %.4g\n", random_uniform(&m->random, 0.0, 1.0));
            break;
        default:
            add(m, "table -file tests/deck/pad.txt -units %s\n",
                units[random_below(&m->random, 4)]);
            break;
    }
}

// A law with a stiffness of about k.
static void add_law(struct maker *m) {
    enum { ELASTIC = 3, WITH_E = 10, ODD = 5 };
    static const struct {
        const char *text;
        bool pulls;
    } law[ELASTIC + WITH_E + ODD] = {
        {"linear", false},
        {"hertz", false},
        {"power -n 1.3", true},
        {"kelvin-voigt", true},
        {"komodromos", false},
        {"ye-kelvin", true},
        {"hertz-damp", true},
        {"lankarani-nikravesh", true},
        {"mahmoud-jankowski", false},
        {"jankowski", false},
        {"hunt-crossley", true},
        {"ye-hertz-damp", true},
        {"khatami", false},
    };
    int i = random_below(&m->random, ELASTIC + WITH_E + ODD);
    while (m->monotone && law[i].pulls) {
        i = random_below(&m->random, ELASTIC + WITH_E + ODD);
    }
    double k = random_logarithmic(&m->random, 1e6, 1e13);
    add(m, " -law ");
    if (i >= ELASTIC + WITH_E) {
        add_odd_law(m, k);
        return;
    }
    add(m, "%s -k %.6g", law[i].text, k);
    if (i >= ELASTIC) {
        add(m, " -e %.4g%s", random_uniform(&m->random, 0.05, 1.0),
            random_below(&m->random, 3) ? "" : " -calibrate");
    }
    add(m, "\n");
}

static double gap(struct maker *m) {
    return random_below(&m->random, 4) ? random_logarithmic(&m->random, 1e-4, 0.1) : 0.0;
}

static void add_link_law(struct maker *m) {
    static const char *const one_way[] = {"", " -tension-only", " -compression-only"};
    static const char *const law[] = {"bilinear -hardening 0.1", "clough -hardening 0.02",
                                      "flag -hardening 0.1 -b 0.7"};
    const double stiffness = random_logarithmic(&m->random, 1e3, 1e10);
    const double dashpot = random_logarithmic(&m->random, 1e2, 1e8);
    const double exponent = random_uniform(&m->random, 0.2, 2.0);
    const int kind = random_below(&m->random, 4);
    if (kind < 2) {
        add(m, "%s -stiffness %.5g -dashpot %.5g -exponent %.3g\n",
            kind == 0 ? "" : " -law maxwell", stiffness, dashpot, exponent);
        return;
    }
    const char *direction = one_way[random_below(&m->random, 3)];
    const double force = random_logarithmic(&m->random, 1e3, 1e8), slack = gap(m);
    if (kind == 2) {
        add(m, " -law friction -slip %.5g", force);
    } else {
        add(m, " -law %s -yield %.5g", law[random_below(&m->random, 3)], force);
    }
    add(m, " -stiffness %.5g -slack %.5g%s\n", stiffness, slack, direction);
}

static void add_links(struct maker *m) {
    for (int i = 0; i + 1 < m->n_building; i++) {
        add(m, "contact B%d B%d -gap %.5g", i, i + 1, gap(m));
        add_law(m);
        if (random_below(&m->random, 3) == 0) {
            add(m, "link B%d:1 B%d:1", i, i + 1);
            add_link_law(m);
        }
    }
    if (random_below(&m->random, 3) == 0) {
        add(m, "contact wall B0 -gap %.5g", gap(m));
        add_law(m);
    }
    if (random_below(&m->random, 3) == 0) {
        add(m, "contact B%d wall -gap %.5g", m->n_building - 1, gap(m));
        add_law(m);
    }
}

static void add_ground(struct maker *m) {
    if (random_below(&m->random, 2)) {
        add(m, "ground record input/records/ELCENTRO_1940_NS.AT2 -pga %.4gg\n",
            random_logarithmic(&m->random, 0.01, 3.0));
    } else {
        add(m, "ground sine -amplitude %.4g -frequency %.4g\n",
            random_logarithmic(&m->random, 0.1, 30.0), random_logarithmic(&m->random, 0.1, 20.0));
    }
    if (random_below(&m->random, 6) == 0) {
        add(m, "ground sine -amplitude 2 -frequency 0.7 -buildings B%d\n",
            random_below(&m->random, m->n_building));
    }
}

// Another building of the row, its floors of masses of their own.
static void add_free_building(struct maker *m, int i) {
    m->floors[i] = 1 + random_below(&m->random, 8);
    add(m, "building B%d -floors %d -mass", i, m->floors[i]);
    double mass = random_logarithmic(&m->random, 1e2, 1e8);
    bool even = random_below(&m->random, 2) == 0;
    for (int floor = 0; floor < m->floors[i]; floor++) {
        add(m, " %.6g", even ? mass : random_logarithmic(&m->random, 1e2, 1e8));
    }
    double omega = random_logarithmic(&m->random, 1.0, 100.0);
    add(m, " -stiffness %.6g\n", mass * omega * omega);
}

void random_deck_cluster(uint64_t seed, char *text, size_t size) {
    text[0] = '\0';
    struct maker m = {.random = {seed}, .text = text, .size = size};
    m.monotone = seed % 2 == 0;
    m.n_building = 2 + random_below(&m.random, 5);
    for (int i = 0; i < m.n_building; i++) {
        add_free_building(&m, i);
    }
    for (int i = 0; i + 1 < m.n_building; i++) {
        int n = m.floors[i] < m.floors[i + 1] ? m.floors[i] : m.floors[i + 1];
        for (int floor = 1; floor <= n; floor++) {
            add(&m, "contact B%d:%d B%d:%d -gap 0", i, floor, i + 1, floor);
            add_law(&m);
        }
    }
    if (random_below(&m.random, 3) == 0) {
        add(&m, "contact wall B0 -gap 0");
        add_law(&m);
    }
    add(&m, "ground sine -amplitude 1 -frequency 1\nduration 1\nstep fixed 1e-3\n");
}

// A frame of the building, of members of one section each, and hinges at some of their ends.
static void add_hinges(struct maker *m, int i) {
    static const char *const law[] = {"bilinear",    "clough",
                                      "takeda",      "bouc-wen",
                                      "flag -b 0.5", "imk -post-capping -0.05 -capping"};
    static const char *const place[] = {":all columns", ":all beams", " bases"};
    const double yield = random_logarithmic(&m->random, 1e4, 1e6);
    for (int k = 0; k < 3; k++) {
        // Columns of storey 1 have hinges at the bases, too.
        const bool twice = k == 2 && strstr(m->text, ":all columns") != NULL;
        if (!twice && random_below(&m->random, 4)) {
            const double own =
                yield * (random_below(&m->random, 2) ? 1.0 : random_uniform(&m->random, 0.5, 2.0));
            const double stiffness = own * random_logarithmic(&m->random, 30.0, 1e5);
            const int which = random_below(&m->random, 6);
            add(m, "hinges B%d%s %s", i, place[k], law[which]);
            if (which == 5) {
                add(m, " %.4g", own / stiffness * random_uniform(&m->random, 1.5, 10.0));
            }
            add(m, " -yield %.6g -hardening %.3g -stiffness %.6g\n", own,
                random_below(&m->random, 2) ? 0.0 : random_uniform(&m->random, 0.0, 0.3),
                stiffness);
        }
    }
}

static void add_frame(struct maker *m, int i) {
    const bool stretch = random_below(&m->random, 2);
    m->floors[i] = 1 + random_below(&m->random, 5);
    add(m,
        "building B%d -floors %d -mass %.6g -height %.4g\nframe B%d -bays %d*%.4g -modulus "
        "2e11%s\n",
        i, m->floors[i], random_logarithmic(&m->random, 1e4, 2e5),
        random_uniform(&m->random, 2.5, 5.0), i, 1 + random_below(&m->random, 3),
        random_uniform(&m->random, 3.0, 9.0), stretch ? "" : " -columns-inextensible");
    add(m, "columns B%d:all -I %.4g%s\nbeams B%d:all -I %.4g\n", i,
        random_logarithmic(&m->random, 5e-5, 2e-3), stretch ? " -A 0.02" : "", i,
        random_logarithmic(&m->random, 5e-5, 2e-3));
    if (random_below(&m->random, 4) == 0) {
        add(m, "base B%d -rotation %.4g\n", i, random_logarithmic(&m->random, 1e6, 1e9));
    }
    if (random_below(&m->random, 3) == 0) {
        add(m, "pdelta B%d -weight %.4g\n", i, random_logarithmic(&m->random, 1e2, 1e5));
    }
    if (random_below(&m->random, 4) == 0) {
        add(m, "wall B%d:1 -EI %.4g -GA 1e9\n", i, random_logarithmic(&m->random, 1e7, 1e10));
    }
    const bool founded = random_below(&m->random, 4) == 0;
    if (founded) {
        add(m, "foundation B%d -mass 1e5 -inertia 1e6 -sway %.4g -rocking %.4g -sway-dashpot 1e6\n",
            i, random_logarithmic(&m->random, 1e7, 1e10),
            random_logarithmic(&m->random, 1e8, 1e11));
    }
    if (random_below(&m->random, 4)) {
        add(m, "damping B%d rayleigh %.4g%s\n", i, random_uniform(&m->random, 0.0, 0.1),
            founded || random_below(&m->random, 2) ? "" : " -tangent");
    }
    if (random_below(&m->random, 4) == 0) {
        add(m, "storey B%d:1 bilinear -yield 1e5 -hardening 0.02 -stiffness 1e7\n", i);
    }
    if (random_below(&m->random, 4)) {
        add_hinges(m, i);
    }
}

// Columns of both buildings, which floors strike where they do not meet.
static void add_columns(struct maker *m) {
    const char *bays = strstr(m->text, "-bays ");
    const long n = bays ? strtol(bays + strlen("-bays "), NULL, 10) : 0;
    assert_true(n > 0);
    if (random_below(&m->random, 2)) {
        add(m, "column B1%s -name b -EI %.4g -mass 500\n",
            random_below(&m->random, 2) ? "" : " bilinear -yield 2e5 -hardening 0.02",
            random_logarithmic(&m->random, 1e6, 1e8));
    }
    if (!strstr(m->text, "hinges") && random_below(&m->random, 4)) {
        add(m, "column B0 -name a -line %ld -mass 500\n", n + 1);
    } else {
        add(m, "column B0 -name a -EI %.4g -mass 500 -damping 0.05\n",
            random_logarithmic(&m->random, 1e6, 1e8));
    }
    add(m, "contact B0 B1 -by-level -gap %.5g -law kelvin-voigt -k %.4g -e 0.6\n", gap(m),
        random_logarithmic(&m->random, 1e7, 1e10));
}

void random_deck_framed(uint64_t seed, char *text, size_t size) {
    text[0] = '\0';
    struct maker m = {.random = {seed}, .text = text, .size = size, .n_building = 2};
    add_frame(&m, 0);
    const bool levels = random_below(&m.random, 2) == 0;
    if (!levels && random_below(&m.random, 2)) {
        add_building(&m, 1);
    } else {
        add(&m, "building B1 -floors 2 -mass 5e4 -stiffness 3e7 -height 3.7\n");
    }
    if (levels) {
        add_columns(&m);
    } else if (random_below(&m.random, 2)) {
        add(&m, "contact B0 B1 -gap %.5g -law kelvin-voigt -k %.4g -e 0.6\n", gap(&m),
            random_logarithmic(&m.random, 1e7, 1e10));
    }
    add(&m,
        "ground record input/records/ELCENTRO_1940_NS.AT2 -pga %.4gg\nstep fixed %.6g\n"
        "duration 6\n",
        random_logarithmic(&m.random, 0.1, 3.0), random_logarithmic(&m.random, 1e-3, 0.02));
}

void random_deck(uint64_t seed, char *text, size_t size) {
    text[0] = '\0';
    struct maker m = {.random = {seed}, .text = text, .size = size};
    m.n_building = 2 + random_below(&m.random, 3);
    for (int i = 0; i < m.n_building; i++) {
        add_building(&m, i);
    }
    add_links(&m);
    add_ground(&m);
    if (random_below(&m.random, 4) == 0) {
        double gamma = random_uniform(&m.random, 0.5, 0.9);
        add(&m, "integrator newmark -gamma %.4g -beta %.4g\n", gamma,
            random_uniform(&m.random, gamma / 2.0, 0.6));
    }
    double dt = random_logarithmic(&m.random, 1e-5, 0.05);
    add(&m, "step fixed %.6g\nduration %.6g\n", dt, dt * 250.0 < 3.0 ? dt * 250.0 : 3.0);
}

void random_deck_stepped(uint64_t seed, const char *steps, char *text, size_t size) {
    char deck[4096];
    size_t n = (size_t)snprintf(text, size, "%s\n", steps);
    random_deck(seed, deck, sizeof deck);
    for (const char *line = deck; *line;) {
        int length = (int)strcspn(line, "\n");
        if (strncmp(line, "step ", 5) != 0 && strncmp(line, "integrator ", 11) != 0) {
            n += (size_t)snprintf(text + n, size - n, "%.*s\n", length, line);
        }
        assert_true(n < size);
        line += length + (line[length] == '\n');
    }
}
