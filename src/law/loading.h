// SPDX-License-Identifier: GPL-3.0-or-later
// Storeys of straight lines that unload to zero shear and then load in the other direction.
//
// A storey is on its loading path, or it unloads from the last point of this path (the anchor)
// along a line of slope K to zero shear. A storey that is partly unloaded and loaded again returns
// along this line to the anchor and continues on its path. At zero shear the path of the other side
// begins. A law says how K follows from a turn, and how the path of a side follows from its start.
// Drifts and shears of a side count positive in its direction.
//
// The history does not change before the first yield, nor while a storey unloads. All steps are
// exact, so their number does not matter.
#ifndef JOSTLE_LOADING_H
#define JOSTLE_LOADING_H

#include "jostle/storey_law.h"

enum loading_constant {
    LOADING_STIFFNESS,  // initial stiffness
    LOADING_YIELD,      // drift at which the storey leaves its first line, to the right
    LOADING_YIELD_LEFT,
    LOADING_CONSTANTS
};

enum { LOADING_LINES_MAX = 9 };

enum loading_history {
    LOADING_SIDE,    // of the path: 1 right, -1 left, 0 before the first yield
    LOADING_DRIFT,   // anchor, counted in the direction of the side
    LOADING_SHEAR,   // >= 0
    LOADING_SLOPE,   // K
    LOADING_TURNED,  // 1: the storey has unloaded from the anchor
    LOADING_WORK,    // integral of the shear from the last zero shear to the anchor
    LOADING_N,       // number of lines of the path
    LOADING_AT,      // the line with the anchor
    LOADING_OWN      // the law's own values, then starts and slopes of the lines
};

enum { LOADING_PATH_SIZE = 3 * LOADING_LINES_MAX };  // drift, shear and slope of each line

// A straight line of a path, from its start to the start of the next line.
struct loading_line {
    double drift, shear, slope;
};

struct loading_rule {
    int path;  // place of the lines in the history, its last LOADING_PATH_SIZE values

    // Sets SLOPE and the law's own values where a storey yields for the first time.
    void (*start)(const double *constant, double *history);

    // Sets SLOPE for unloading from the anchor. NULL: it stays.
    void (*turn)(const double *constant, double *history);

    // Sets the path of the side that the storey enters at the anchor, where its shear is 0; WORK is
    // the work since the last zero shear. Calls loading_follow.
    void (*enter)(const double *constant, double *history);

    // Notes that the storey has come along its path to the anchor. NULL: nothing is noted.
    void (*arrive)(const double *constant, double *history);
};

// Makes the path of the history: from the anchor along `line`, the last of which has no end, but
// nowhere steeper than SLOPE: the path goes with SLOPE where the lines are steeper or above it.
void loading_follow(const struct loading_rule *rule, double *history,
                    const struct loading_line *line, int n);

// The slope of the path at the anchor.
double loading_path_slope(const struct loading_rule *rule, const double *history);

// respond and stored of the descriptors.
struct storey_response loading_respond(const struct loading_rule *rule, const double *constant,
                                       const double *history, double drift, double *after);
double loading_stored(const struct loading_rule *rule, const double *constant,
                      const double *history, double drift);

#endif
