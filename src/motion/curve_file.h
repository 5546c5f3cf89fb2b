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
    double length, force;  // [m] [N] units of the file; 0: units of its caption or, without
                           // a caption, of the deck
    const struct unit_system *units;  // units of the deck, into which the curve is converted
};

// Reads a curve into memory from `a`. Errors: STATUS_INPUT with "path:line:column: cause";
// STATUS_SYSTEM: the file cannot be read, no memory.
int curve_read(struct arena *a, const struct curve_request *request, struct curve *out,
               struct error *e);

// Reads a curve from a text in memory, as curve_read does; the path of the request is ignored.
int curve_read_text(struct arena *a, const struct curve_request *request,
                    const struct record_text *t, struct curve *out, struct error *e);

#endif
