// SPDX-License-Identifier: GPL-3.0-or-later
// Dimensions of quantities, the units of a deck, and unit texts such as `kN/mm` or `N/m^1.5`.
#ifndef JOSTLE_UNITS_H
#define JOSTLE_UNITS_H

#include <stdbool.h>
#include <stddef.h>

#include "jostle/names.h"

JOSTLE_C_BEGIN

// Exponents of force, length and time.
struct dimension {
    double force, length, time;
};

// The same as initialisers, for tables.
// clang-format off
#define OF_NONE {0, 0, 0}  // a pure number
#define OF_FORCE {1, 0, 0}
#define OF_LENGTH {0, 1, 0}
#define OF_TIME {0, 0, 1}
#define OF_MASS {1, -1, 2}
#define OF_STIFFNESS {1, -1, 0}
#define OF_HERTZ_STIFFNESS {1, -1.5, 0}
#define OF_DASHPOT {1, -1, 1}
#define OF_VELOCITY {0, 1, -1}
#define OF_PER_VELOCITY {0, -1, 1}
#define OF_ACCELERATION {0, 1, -2}
#define OF_FREQUENCY {0, 0, -1}
#define OF_AREA {0, 2, 0}
#define OF_STRESS {1, -2, 0}
#define OF_MOMENT {1, 1, 0}
#define OF_BENDING {1, 2, 0}      // E I
#define OF_AREA_MOMENT {0, 4, 0}  // I
// clang-format on

extern const struct dimension dimension_none;
extern const struct dimension dimension_force;
extern const struct dimension dimension_length;
extern const struct dimension dimension_time;
extern const struct dimension dimension_mass;
extern const struct dimension dimension_stiffness;  // force / length
extern const struct dimension dimension_dashpot;    // force time / length
extern const struct dimension dimension_velocity;
extern const struct dimension dimension_acceleration;
extern const struct dimension dimension_frequency;  // 1 / time
extern const struct dimension dimension_impulse;    // force time
extern const struct dimension dimension_energy;     // force length

bool dimension_equal(struct dimension a, struct dimension b);

// "a length", "a mass", "a pure number"; NULL: the dimension has no name.
const char *dimension_noun(struct dimension dimension);

// The units of a deck. A mass is force time^2 / length.
enum { UNIT_NAME_MAX = 16 };
struct unit_system {
    double force, length, time;  // one deck unit in N, m, s
    double gravity;              // acceleration of gravity [m/s^2]; the value of the unit `g`
    char force_name[UNIT_NAME_MAX], length_name[UNIT_NAME_MAX], time_name[UNIT_NAME_MAX];
};

// N, m, s and 9.80665 m/s^2.
void unit_system_init(struct unit_system *s);
bool unit_system_equal(const struct unit_system *a, const struct unit_system *b);
// The deck's unit of acceleration in g.
double unit_in_g(const struct unit_system *u);

// Reads the longest unit at the start of `text`: names joined by * and /, each with an optional
// power (`m/s2`, `m/s^2`, `N/m^1.5`, `kN*s/m`, `g`, `gal`, `%`). Gives its dimension and the size
// of one such unit in SI. `*end` is the first character not used. False: no unit stands there, and
// *end = text; an operator that no unit name follows is left unread. A power is below 10. *si
// is 0 or infinite for the longest products. The angles rad and deg stand alone: rad/s would pass
// for Hz, which is 2 pi times as large.
bool unit_parse(const char *text, double gravity, const char **end, struct dimension *dimension,
                double *si);

// What one unit of `dimension` in the system `s` is in SI.
double unit_size(const struct unit_system *s, struct dimension dimension);

// `value` units of the size `from` as units of the size `to`, rounded as little as possible. The
// result has no meaning if a size is 0, infinite or NAN, which the caller checks.
double unit_convert(double value, double from, double to);

// The unit of `dimension` in the system `s` as text, "m/s^2", "kN/m", "kg"; "1" for a pure number.
void unit_text(const struct unit_system *s, struct dimension dimension, char *text, size_t size);

// What stands behind a number in the unit `text`: nothing where that is "1", "unknown" or "".
const char *unit_suffix(const char *text);

// Names of all simple units, for "nearest word" messages; NULL-terminated.
extern const char *const unit_names[];

JOSTLE_C_END

#endif
