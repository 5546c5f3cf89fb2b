// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random_deck.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "support/support.h"

struct maker {
    uint64_t state;
    char *text;
    size_t size, used;
    int n_building;
    int floors[4];
};

// SplitMix64: Steele, Lea & Flood (2014), OOPSLA.
static uint64_t next(struct maker *m) {
    uint64_t z = m->state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

static double uniform(struct maker *m, double from, double to) {
    return from + (to - from) * (double)(next(m) >> 11) * 0x1p-53;
}

static double logarithmic(struct maker *m, double from, double to) {
    return exp(uniform(m, log(from), log(to)));
}

static int below(struct maker *m, int n) {
    return (int)(next(m) % (uint64_t)n);
}

__attribute__((format(printf, 2, 3))) static void add(struct maker *m, const char *format, ...) {
    va_list list;
    va_start(list, format);
    int n = vsnprintf(m->text + m->used, m->size - m->used, format, list);
    va_end(list);
    assert_true(n >= 0 && (size_t)n < m->size - m->used);
    m->used += (size_t)n;
}

static void add_damping(struct maker *m, int i) {
    switch (below(m, 4)) {
        case 0:
            add(m, "damping B%d rayleigh %.4g\n", i, uniform(m, 0.0, 0.1));
            break;
        case 1:
            add(m, "damping B%d modal %.4g\n", i, uniform(m, 0.0, 0.2));
            break;
        case 2:
            add(m, "damping B%d dashpot %.4g\n", i, logarithmic(m, 1.0, 1e6));
            break;
        default:
            break;
    }
}

static void add_building(struct maker *m, int i) {
    m->floors[i] = 1 + below(m, 6);
    double mass = logarithmic(m, 1e2, 1e8);
    double omega = logarithmic(m, 1.0, 100.0);
    double stiffness = below(m, 12) ? mass * omega * omega : 0.0;
    add(m, "building B%d -floors %d -mass %.6g -stiffness %.6g\n", i, m->floors[i], mass,
        stiffness);
    if (stiffness > 0.0) {
        add_damping(m, i);
    }
    if (stiffness > 0.0 && below(m, 3) == 0) {
        static const char *const law[] = {"bilinear", "bouc-wen", "clough", "takeda"};
        add(m, "storey B%d:all %s -yield %.6g -hardening %.3g\n", i, law[below(m, 4)],
            mass * logarithmic(m, 0.1, 10.0), below(m, 2) ? 0.0 : uniform(m, 0.0, 0.5));
    }
    if (below(m, 3) == 0) {
        add(m, "initial B%d:all -velocity %.4g\n", i, uniform(m, -1.0, 1.0));
    }
}

// A law with parameters of its own, of a stiffness of about k.
static void add_odd_law(struct maker *m, double k) {
    static const char *const units[] = {"mm kN", "cm kN", "mm MN", "m MN"};
    const char *calibrate = below(m, 2) ? "" : " -calibrate";
    switch (below(m, 7)) {
        case 0:
            add(m, "bilinear -k1 %.6g -k2 %.6g -dy %.4g\n", k, k * uniform(m, 0.01, 1.0),
                logarithmic(m, 1e-6, 0.1));
            break;
        case 1:
            add(m, "bilinear -kh %.6g -e %.4g -v0 %.4g%s\n", k, uniform(m, 0.05, 1.0),
                logarithmic(m, 0.01, 3.0), calibrate);
            break;
        case 2:
            add(m, "wang -k %.6g -zeta %.6g -residual %.4g\n", k, k * logarithmic(m, 0.01, 10.0),
                uniform(m, 0.0, 0.8));
            break;
        case 3:
            add(m, "wang -k %.6g -e %.4g -residual 0.3 -n %.3g%s\n", k, uniform(m, 0.05, 0.8),
                uniform(m, 1.0, 2.5), calibrate);
            break;
        case 4:
            add(m, "rubber -k %.6g -n %.3g -e %.4g -du %.4g -ky %.6g%s\n", k, uniform(m, 1.0, 3.0),
                uniform(m, 0.05, 1.0), logarithmic(m, 1e-4, 0.1), k, calibrate);
            break;
        case 5:
            add(m, "stereomechanical -e %.4g\n", uniform(m, 0.0, 1.0));
            break;
        default:
            add(m, "table -file tests/deck/pad.txt -units %s\n", units[below(m, 4)]);
            break;
    }
}

// A law with a stiffness of about k.
static void add_law(struct maker *m) {
    enum { ELASTIC = 3, WITH_E = 10, ODD = 5 };
    static const char *const law[] = {
        "linear",
        "hertz",
        "power -n 1.3",
        "kelvin-voigt",
        "komodromos",
        "ye-kelvin",
        "hertz-damp",
        "lankarani-nikravesh",
        "mahmoud-jankowski",
        "jankowski",
        "hunt-crossley",
        "ye-hertz-damp",
        "khatami",
    };
    int i = below(m, ELASTIC + WITH_E + ODD);
    double k = logarithmic(m, 1e6, 1e13);
    add(m, " -law ");
    if (i >= ELASTIC + WITH_E) {
        add_odd_law(m, k);
        return;
    }
    add(m, "%s -k %.6g", law[i], k);
    if (i >= ELASTIC) {
        add(m, " -e %.4g%s", uniform(m, 0.05, 1.0), below(m, 3) ? "" : " -calibrate");
    }
    add(m, "\n");
}

static double gap(struct maker *m) {
    return below(m, 4) ? logarithmic(m, 1e-4, 0.1) : 0.0;
}

static void add_links(struct maker *m) {
    for (int i = 0; i + 1 < m->n_building; i++) {
        add(m, "contact B%d B%d -gap %.5g", i, i + 1, gap(m));
        add_law(m);
        if (below(m, 4) == 0) {
            add(m, "link B%d:1 B%d:1 -stiffness %.5g -dashpot %.5g -exponent %.3g\n", i, i + 1,
                logarithmic(m, 1e3, 1e10), logarithmic(m, 1e2, 1e8), uniform(m, 0.2, 2.0));
        }
    }
    if (below(m, 3) == 0) {
        add(m, "contact wall B0 -gap %.5g", gap(m));
        add_law(m);
    }
    if (below(m, 3) == 0) {
        add(m, "contact B%d wall -gap %.5g", m->n_building - 1, gap(m));
        add_law(m);
    }
}

static void add_ground(struct maker *m) {
    if (below(m, 2)) {
        add(m, "ground record input/records/ELCENTRO_1940_NS.AT2 -pga %.4gg\n",
            logarithmic(m, 0.01, 3.0));
    } else {
        add(m, "ground sine -amplitude %.4g -frequency %.4g\n", logarithmic(m, 0.1, 30.0),
            logarithmic(m, 0.1, 20.0));
    }
    if (below(m, 6) == 0) {
        add(m, "ground sine -amplitude 2 -frequency 0.7 -buildings B%d\n", below(m, m->n_building));
    }
}

void random_deck(uint64_t seed, char *text, size_t size) {
    text[0] = '\0';
    struct maker m = {.state = seed, .text = text, .size = size};
    m.n_building = 2 + below(&m, 3);
    for (int i = 0; i < m.n_building; i++) {
        add_building(&m, i);
    }
    add_links(&m);
    add_ground(&m);
    if (below(&m, 4) == 0) {
        double gamma = uniform(&m, 0.5, 0.9);
        add(&m, "integrator newmark -gamma %.4g -beta %.4g\n", gamma,
            uniform(&m, gamma / 2.0, 0.6));
    }
    double dt = logarithmic(&m, 1e-5, 0.05);
    add(&m, "step fixed %.6g\nduration %.6g\n", dt, dt * 250.0 < 3.0 ? dt * 250.0 : 3.0);
}
