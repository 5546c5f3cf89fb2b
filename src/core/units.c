// SPDX-License-Identifier: GPL-3.0-or-later
// Simple units, products of them, and the units of a deck.
//
// Sizes are exact by definition: the international foot and avoirdupois pound of 1959, the standard
// acceleration of gravity 9.80665 m/s^2 (CGPM 1901) behind kgf, tf and lbf (NIST SP 811, appendix
// B).
#include "jostle/units.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

const struct dimension dimension_none = OF_NONE;
const struct dimension dimension_force = OF_FORCE;
const struct dimension dimension_length = OF_LENGTH;
const struct dimension dimension_time = OF_TIME;
const struct dimension dimension_mass = OF_MASS;
const struct dimension dimension_stiffness = OF_STIFFNESS;
const struct dimension dimension_dashpot = OF_DASHPOT;
const struct dimension dimension_velocity = OF_VELOCITY;
const struct dimension dimension_acceleration = OF_ACCELERATION;
const struct dimension dimension_frequency = OF_FREQUENCY;
const struct dimension dimension_impulse = {1, 0, 1};
const struct dimension dimension_energy = {1, 1, 0};

static const double standard_gravity = 9.80665;

// A size of 0 stands for the gravity of the deck. Angles do not join with other units: rad/s would
// pass for Hz, which is 2 pi times as large.
#define SIMPLE_UNITS(UNIT)                                                                         \
    UNIT("N", 1, 0, 0, 1, false)                                                                   \
    UNIT("kN", 1, 0, 0, 1e3, false)                                                                \
    UNIT("MN", 1, 0, 0, 1e6, false)                                                                \
    UNIT("GN", 1, 0, 0, 1e9, false)                                                                \
    UNIT("kgf", 1, 0, 0, 9.80665, false)                                                           \
    UNIT("tf", 1, 0, 0, 9806.65, false)                                                            \
    UNIT("lbf", 1, 0, 0, 4.4482216152605, false)                                                   \
    UNIT("kip", 1, 0, 0, 4448.2216152605, false)                                                   \
    UNIT("m", 0, 1, 0, 1, false)                                                                   \
    UNIT("mm", 0, 1, 0, 1e-3, false)                                                               \
    UNIT("cm", 0, 1, 0, 1e-2, false)                                                               \
    UNIT("km", 0, 1, 0, 1e3, false)                                                                \
    UNIT("in", 0, 1, 0, 0.0254, false)                                                             \
    UNIT("ft", 0, 1, 0, 0.3048, false)                                                             \
    UNIT("s", 0, 0, 1, 1, false)                                                                   \
    UNIT("ms", 0, 0, 1, 1e-3, false)                                                               \
    UNIT("us", 0, 0, 1, 1e-6, false)                                                               \
    UNIT("min", 0, 0, 1, 60, false)                                                                \
    UNIT("kg", 1, -1, 2, 1, false)                                                                 \
    UNIT("t", 1, -1, 2, 1e3, false)                                                                \
    UNIT("lb", 1, -1, 2, 0.45359237, false)                                                        \
    UNIT("slug", 1, -1, 2, 4.4482216152605 / 0.3048, false)                                        \
    UNIT("g", 0, 1, -2, 0, false)                                                                  \
    UNIT("gal", 0, 1, -2, 1e-2, false)                                                             \
    UNIT("Pa", 1, -2, 0, 1, false)                                                                 \
    UNIT("kPa", 1, -2, 0, 1e3, false)                                                              \
    UNIT("MPa", 1, -2, 0, 1e6, false)                                                              \
    UNIT("GPa", 1, -2, 0, 1e9, false)                                                              \
    UNIT("psi", 1, -2, 0, 4.4482216152605 / 0.00064516, false)                                     \
    UNIT("ksi", 1, -2, 0, 4448.2216152605 / 0.00064516, false)                                     \
    UNIT("Hz", 0, 0, -1, 1, false)                                                                 \
    UNIT("J", 1, 1, 0, 1, false)                                                                   \
    UNIT("kJ", 1, 1, 0, 1e3, false)                                                                \
    UNIT("MJ", 1, 1, 0, 1e6, false)                                                                \
    UNIT("rad", 0, 0, 0, 1, true)                                                                  \
    UNIT("deg", 0, 0, 0, 3.14159265358979323846 / 180, true)                                       \
    UNIT("%", 0, 0, 0, 1e-2, false)

struct simple {
    struct dimension dimension;
    double size;  // in SI
    bool alone;   // does not join with other units
};

#define UNIT_ROW(name, f, l, t, size, alone) {{f, l, t}, size, alone},
static const struct simple simple_units[] = {SIMPLE_UNITS(UNIT_ROW)};

#define UNIT_NAME(name, f, l, t, size, alone) name,
const char *const unit_names[] = {SIMPLE_UNITS(UNIT_NAME) NULL};

static const struct {
    const struct dimension *dimension;
    const char *noun;
} dimension_nouns[] = {
    {&dimension_none, "a pure number"},
    {&dimension_force, "a force"},
    {&dimension_length, "a length"},
    {&dimension_time, "a time"},
    {&dimension_mass, "a mass"},
    {&dimension_stiffness, "a stiffness"},
    {&dimension_dashpot, "a dashpot coefficient"},
    {&dimension_velocity, "a velocity"},
    {&dimension_acceleration, "an acceleration"},
    {&dimension_frequency, "a frequency"},
    {&dimension_impulse, "an impulse"},
    {&dimension_energy, "a moment or energy"},
};

bool dimension_equal(struct dimension a, struct dimension b) {
    const double small = 1e-9;  // far below any difference between powers that are written out
    return fabs(a.force - b.force) < small && fabs(a.length - b.length) < small &&
           fabs(a.time - b.time) < small;
}

const char *dimension_noun(struct dimension dimension) {
    for (size_t i = 0; i < sizeof dimension_nouns / sizeof dimension_nouns[0]; i++) {
        if (dimension_equal(dimension, *dimension_nouns[i].dimension)) {
            return dimension_nouns[i].noun;
        }
    }
    return NULL;
}

bool unit_system_equal(const struct unit_system *a, const struct unit_system *b) {
    return a->force == b->force && a->length == b->length && a->time == b->time &&
           a->gravity == b->gravity;
}

double unit_in_g(const struct unit_system *u) {
    return unit_size(u, dimension_acceleration) / u->gravity;
}

void unit_system_init(struct unit_system *s) {
    *s = (struct unit_system){
        .force = 1,
        .length = 1,
        .time = 1,
        .gravity = standard_gravity,
        .force_name = "N",
        .length_name = "m",
        .time_name = "s",
    };
}

static bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

static bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

// The simple unit whose name is the letters (or the `%`) at *at; NULL: there is none.
static const struct simple *simple_parse(const char **at) {
    size_t n = 0;
    if (**at == '%') {
        n = 1;
    }
    while (n < UNIT_NAME_MAX && is_letter((*at)[n])) {
        n++;
    }
    for (int i = 0; unit_names[i]; i++) {
        if (n == strlen(unit_names[i]) && strncmp(*at, unit_names[i], n) == 0) {
            *at += n;
            return &simple_units[i];
        }
    }
    return NULL;
}

// The power at *at: one digit, or `^` and a number of one digit before and up to 6 behind the
// point. 1 if there is none, and what is something else is left unread.
static double power_parse(const char **at) {
    const char *p = *at;
    double sign = 1;
    bool caret = *p == '^';
    if (caret) {
        p++;
        sign = *p == '-' ? -1 : 1;
        p += *p == '-';
    }
    if (!is_digit(*p) || is_digit(p[1])) {
        return 1;
    }
    double digits = *p++ - '0', scale = 1;
    if (caret && *p == '.') {
        for (p++; is_digit(*p) && scale < 1e6; p++) {
            digits = 10 * digits + (*p - '0');
            scale *= 10;
        }
    }
    if (is_digit(*p)) {
        return 1;
    }
    *at = p;
    return sign * digits / scale;
}

bool unit_parse(const char *text, double gravity, const char **end, struct dimension *dimension,
                double *si) {
    assert(text && end && dimension && si);
    *end = text;
    *dimension = dimension_none;
    *si = 1;
    double sign = 1;
    for (const char *at = text;; at++) {
        const struct simple *unit = simple_parse(&at);
        if (!unit || (unit->alone && *end != text)) {
            break;
        }
        double power = sign * (unit->alone ? 1 : power_parse(&at));
        double size = unit->size > 0 ? unit->size : gravity;
        if (power >= 0) {
            *si *= pow(size, power);
        } else {
            *si /= pow(size, -power);
        }
        dimension->force += power * unit->dimension.force;
        dimension->length += power * unit->dimension.length;
        dimension->time += power * unit->dimension.time;
        *end = at;
        if (unit->alone || (*at != '*' && *at != '/')) {
            break;
        }
        sign = *at == '/' ? -1 : 1;
    }
    return *end != text;
}

double unit_size(const struct unit_system *s, struct dimension dimension) {
    return pow(s->force, dimension.force) * pow(s->length, dimension.length) *
           pow(s->time, dimension.time);
}

double unit_convert(double value, double from, double to) {
    return from >= to ? value * (from / to) : value / (to / from);
}

static void append(char *text, size_t size, const char *joint, const char *name, double power) {
    size_t used = strlen(text);
    if (power == 1) {
        snprintf(text + used, size - used, "%s%s", joint, name);
    } else {
        snprintf(text + used, size - used, "%s%s^%.6g", joint, name, power);
    }
}

// The name of the unit of mass that is `kilogram` kg; NULL: it has no name.
static const char *mass_name(double kilogram) {
    for (int i = 0; unit_names[i]; i++) {
        if (dimension_equal(simple_units[i].dimension, dimension_mass) &&
            fabs(simple_units[i].size - kilogram) <= 1e-12 * kilogram) {
            return unit_names[i];
        }
    }
    return NULL;
}

void unit_text(const struct unit_system *s, struct dimension dimension, char *text, size_t size) {
    assert(text && size > 0);
    const char *mass = mass_name(unit_size(s, dimension_mass));
    if (dimension_equal(dimension, dimension_mass) && mass) {
        snprintf(text, size, "%s", mass);
        return;
    }
    const char *name[3] = {s->force_name, s->length_name, s->time_name};
    const double power[3] = {dimension.force, dimension.length, dimension.time};
    text[0] = 0;
    for (int i = 0; i < 3; i++) {
        if (power[i] > 0) {
            append(text, size, text[0] ? "*" : "", name[i], power[i]);
        }
    }
    if (!text[0]) {
        snprintf(text, size, "1");
    }
    for (int i = 0; i < 3; i++) {
        if (power[i] < 0) {
            append(text, size, "/", name[i], -power[i]);
        }
    }
}

const char *unit_suffix(const char *text) {
    return strcmp(text, "1") == 0 || strcmp(text, "unknown") == 0 ? "" : text;
}
