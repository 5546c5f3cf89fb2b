// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers and masks for arithmetic that is written once for two lane counts: for one run, and,
// where LANES_OF_RUNS is defined, for eight runs, a run a lane. With one lane a mask is true or
// false, and a choice is a branch. Both agree to the bit because these are the same operations in
// the same order. Numbers are passed by address (core/lanes.h).
#ifndef JOSTLE_MASKS_H
#define JOSTLE_MASKS_H

#include <math.h>

#include "core/lanes.h"

#ifdef LANES_OF_RUNS
typedef wide lane_number;
typedef wide_bits lane_mask;
#define LANE_INLINE LANES_WHOLE_INLINE
#define ABSOLUTE(x) WIDE_ABSOLUTE(x)
#define CHOOSE(mask, a, b) WIDE_CHOOSE(mask, a, b)
#define LESS(a, b) WIDE_LESS(a, b)
#define AT_MOST(a, b) WIDE_AT_MOST(a, b)
#define IS_EQUAL(a, b) ((wide_bits)((a) == (b)))
#define AND &
#define OR |
#define NOT(mask) (~(mask))
#define ANY(mask) wide_any(&(mask))
#else
typedef double lane_number;
typedef bool lane_mask;
#define LANE_INLINE LANES_INLINE
#define ABSOLUTE(x) fabs(x)
#define CHOOSE(mask, a, b) ((mask) ? (a) : (b))
#define LESS(a, b) ((a) < (b))
#define AT_MOST(a, b) ((a) <= (b))
#define IS_EQUAL(a, b) ((a) == (b))
#define AND &&
#define OR ||
#define NOT(mask) (!(mask))
#define ANY(mask) (mask)
#endif

#define LARGER(a, b) CHOOSE(LESS(b, a), a, b)
#define SMALLER(a, b) CHOOSE(LESS(a, b), a, b)
#define EVERYWHERE(x) ((x) - (lane_number){0.0})  // a number, in all lanes

#endif
