// SPDX-License-Identifier: GPL-3.0-or-later
// Ground-motion records (and other sampled histories) from files, read strictly: nothing is guessed
// or repaired silently.
#ifndef JOSTLE_RECORD_H
#define JOSTLE_RECORD_H

#include <stdbool.h>
#include <stddef.h>

#include "jostle/error.h"
#include "jostle/names.h"

JOSTLE_C_BEGIN

struct arena;

// The request of the user.
struct record_request {
    const char *path;
    const char *format;  // name of a record format; NULL: found from the content
    double dt;           // [s]; must agree with the file; 0: the file must have it
    const char *unit;    // "g", "m/s2", "cm/s2", "gal" ...; NULL: the file must have it
    double gravity;      // value of the unit g [m/s^2]
    int channel;         // from 1, in a file with several channels; 0: not given
    bool demean;         // subtract the mean of the values
    bool plain;          // values have no acceleration unit (a load history): read as printed
};

// The part of the request that an error concerns.
enum record_part { RECORD_PATH, RECORD_FORMAT_NAME, RECORD_DT, RECORD_UNIT, RECORD_CHANNEL };

enum { RECORD_WARNINGS_MAX = 8 };
struct record {
    enum record_part wrong;  // after an error of record_read
    const char *format;      // name of the format read
    size_t n;                // samples, at least 2
    double dt;               // [s]
    double unit;             // size of the file's unit [m/s^2]; 1 if plain
    const double *value;     // (n) in the file's unit, as printed or minus their mean
    double mean;             // mean that was subtracted, in the file's unit; 0: none
    double peak;             // the largest absolute value
    bool large;              // larger than any real ground acceleration; a warning says so
    int n_warning;
    char warning[RECORD_WARNINGS_MAX][512];  // "path:line: what is odd"
};

// Reads the record; its arrays and texts are from `a`. Errors: STATUS_INPUT with "path:line:
// cause", STATUS_SYSTEM (the file cannot be read, no memory). After an error only out->wrong is
// set.
int record_read(struct arena *a, const struct record_request *request, struct record *out,
                struct error *e);

struct record_text;
struct record_reader;

// A format is one file in src/motion/ and one line in record_list.inc. The functions are described
// with their arguments in src/motion/record_format.h.
struct record_format {
    const char *name;  // for -format
    const char *doc;   // one line
    bool channels;     // its files hold several channels
    bool certain;      // files of other formats do not have its marks
    bool plain;        // can read values without an acceleration unit

    // Text in capitals in one of the first `mark_lines` lines of the format; NULL: `matches` tells.
    const char *mark;
    int mark_lines;
    // True if the text looks like this format. jostle tries the formats in the order of the list,
    // first those that are `certain`.
    bool (*matches)(const struct record_text *t);

    // Reads the statements of the file only. record_read compares them with the request.
    bool (*read)(const struct record_reader *r);
};
extern const struct record_format *const record_formats[];
extern const int n_record_format;

JOSTLE_C_END

#endif
