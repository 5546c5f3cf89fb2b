// SPDX-License-Identifier: GPL-3.0-or-later
// Reads curves of force against penetration from files.
#ifndef JOSTLE_MOTION_CURVE_FILE_H
#define JOSTLE_MOTION_CURVE_FILE_H

#include "jostle/curve.h"
#include "jostle/error.h"
#include "jostle/units.h"

struct arena;
struct record_text;

struct curve_request {
    const char *path;
    double length, force;             // [m] [N] units of the file; 0: those of its caption, if any,
    const struct unit_system *units;  // or else the deck's, in which the curve is wanted
};

// What lasts is from `a`. Errors: STATUS_INPUT with "path:line:column: cause", STATUS_SYSTEM when
// the file cannot be read or memory runs out.
int curve_read(struct arena *a, const struct curve_request *request, struct curve *out,
               struct error *e);

// The same from a text in memory; the path of the request is not looked at.
int curve_read_text(struct arena *a, const struct curve_request *request,
                    const struct record_text *t, struct curve *out, struct error *e);

#endif
