// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef JOSTLE_WALL_H
#define JOSTLE_WALL_H

// Time [s] of a clock that nobody sets; its zero means nothing.
double wall_seconds(void);

#endif
