// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef JOSTLE_WALL_H
#define JOSTLE_WALL_H

// Time [s] of a monotonic clock, which is never set. Only differences have a meaning.
double wall_seconds(void);

#endif
