// SPDX-License-Identifier: GPL-3.0-or-later
// What a record format is given and what it hands back. Internal to src/motion/.
#ifndef JOSTLE_MOTION_RECORD_FORMAT_H
#define JOSTLE_MOTION_RECORD_FORMAT_H

#include "jostle/record.h"
#include "motion/lines.h"

// A file that was read whole and is known to be text, without byte-order mark and DOS end mark.
struct record_text {
    const char *path;
    const char *text;  // 0-terminated, line ends as in the file
    size_t size;
};

// Reads the file whole. The text is to be freed by arena_free of *scratch; after an error there is
// none. Errors: those of text_file.
int record_text_open(const char *path, size_t limit, struct record_text *out,
                     struct arena **scratch, struct error *e);

// What a file says about itself. Lines are counted from 1.
struct record_content {
    enum record_part wrong;  // after an error, as in struct record

    size_t n;
    double *value;  // (n) from the arena, as printed
    size_t peak;    // index of the first largest |value|
    int peak_line;  // where it stands

    size_t n_filling;  // so many values at the end repeat the one before, beyond the stated number
    int count_line;    // where that is stated

    double npts, other_npts;  // numbers of values where a header states two
    int other_line;           // where it states the other one; 0: it states one

    double dt;            // [s] > 0; 0: the file does not say it
    int dt_line;          // where it says or should say so
    double dt_tolerance;  // [s] how well the file says it; 0 unless made from rounded times

    double unit;               // [m/s^2]; 0: the file does not say one that is an acceleration
    struct excerpt unit_text;  // as the file writes it
    int unit_line;             // where; 0: the file says nothing about a unit

    double stated_peak;      // the largest acceleration that the file states, in its unit
    double stated_rounding;  // its last digit
    bool stated_about_mean;  // it is that of the values less their mean
    int stated_line;         // where; 0: the file states none

    double noted_dt;  // [s] of a comment above the values
    int noted_line;   // where; 0: there is none

    double time_offset;  // [s] time of the first sample
    double time_error;   // largest distance of a time from the even grid, in steps
};

// Reads a text in memory; `t` need not be checked before. What record_read does after having read
// the file.
int record_read_text(struct arena *a, const struct record_request *request,
                     const struct record_text *t, struct record *out, struct error *e);

// `t` without the byte-order mark that spreadsheets write and the Ctrl-Z that DOS ended files with.
// Errors: STATUS_INPUT (empty, or no text).
int record_clean(const struct record_text *t, struct record_text *out, struct error *e);

// The name of a known format that cannot be read yet; NULL: none looks like it.
const char *foreign_format(const struct record_text *t);

// What the file is if it is certainly no record: "an HTML page"; NULL: may be one.
const char *foreign_file(const struct record_text *t);

// The final value of dt and unit from what the user and the file say, and whether the record is
// believable as an accelerogram.
int record_check(const struct record_request *request, const struct record_text *t,
                 const struct record_content *content, struct record *out, struct error *e);

#endif
