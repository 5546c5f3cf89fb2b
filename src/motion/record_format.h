// SPDX-License-Identifier: GPL-3.0-or-later
// The input and the output of a record format. Internal to src/motion/.
#ifndef JOSTLE_MOTION_RECORD_FORMAT_H
#define JOSTLE_MOTION_RECORD_FORMAT_H

#include "jostle/record.h"
#include "jostle/units.h"
#include "motion/lines.h"

// A whole file that has been checked to be text, without byte-order mark and DOS end mark.
struct record_text {
    const char *path;
    const char *text;  // 0-terminated, line ends as in the file
    size_t size;
};

// Reads the whole file. The caller frees the text with arena_free of *scratch, except after an
// error. Errors: those of text_file.
int record_text_open(const char *path, size_t limit, struct record_text *out,
                     struct arena **scratch, struct error *e);

// The values of a file, and what the file states about them. Lines are counted from 1.
struct record_content {
    enum record_part wrong;  // after an error, as in struct record

    size_t n;
    double *value;  // (n) from the arena, as printed
    size_t peak;    // index of the first largest |value|
    int peak_line;  // line of the peak

    size_t n_filling;  // values beyond the stated number, which repeat the last value
    int count_line;    // line that states the number

    double npts, other_npts;  // numbers of values that the file states
    int other_line;           // line of other_npts; 0: the header states one number

    double dt;            // [s] > 0; 0: the file does not state it
    double rate;          // [1/s] > 0; 0: the file does not state it
    int dt_line;          // line that states it or should state it
    double dt_tolerance;  // [s] rounding error of dt if it is computed from times; else 0

    double unit;               // [m/s^2]; 0: the file does not state a unit of acceleration
    struct excerpt unit_text;  // text of the unit in the file
    int unit_line;             // line of the unit; 0: the file does not state a unit

    double stated_peak;      // the largest acceleration that the file states, in its unit
    double stated_rounding;  // one unit of its last digit
    bool stated_about_mean;  // it is the peak of the values minus their mean
    int stated_line;         // line of the stated peak; 0: the file does not state one

    double noted_dt;  // [s] time step in a comment above the values
    int noted_line;   // line of this comment; 0: there is none

    double time_offset;  // [s] time of the first sample
    double time_error;   // largest distance of a time from the even grid, in steps
};

// What a reader of a format works with. Its functions return true, or false after an error. All of
// them are borrowed.
struct record_reader {
    struct arena *arena;  // of the values
    const struct record_request *request;
    const struct record_text *text;
    struct record_content *out;
    struct error *e;
};

// Sets an error of STATUS_INPUT whose message begins with "path:line: ", or "path: " if line is 0.
// Returns false.
bool record_fail(const struct record_reader *r, int line, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// Sets the error "out of memory"; returns false.
bool record_fail_memory(const struct record_reader *r);

// Reads a field that should be a number.
struct number_field;
bool record_number(const struct record_reader *r, const struct number_field *f, double *value);

// True if one of the first `n_line` lines contains the text, in any case; `mark` in capitals.
bool record_has_mark(const struct record_text *t, const char *mark, int n_line);

// Reads a record from a text in memory, as record_read does from a file. `t` may be any bytes.
int record_read_text(struct arena *a, const struct record_request *request,
                     const struct record_text *t, struct record *out, struct error *e);

// Removes the byte-order mark of spreadsheets and the final Ctrl-Z of DOS. Errors: STATUS_INPUT
// (empty, or not text).
int record_clean(const struct record_text *t, struct record_text *out, struct error *e);

// The name of a format that jostle recognises but cannot read; NULL: another format.
const char *foreign_format(const struct record_text *t);

// A description of a file that cannot be a record, such as "an HTML page"; NULL: it may be a
// record.
const char *foreign_file(const struct record_text *t);

// Decides time step and unit from those of the user and the file, and checks that the record is
// plausible as an accelerogram. False after an error.
bool record_check(const struct record_reader *r, struct record *out);

// Units as record files and users write them.

// Reads the whole of `text` as a unit: a unit of unit_parse, or also G, CM/S/S, cm/sec/sec,
// cm/sec**2. False: it is not a unit.
bool record_unit(struct piece text, double gravity, struct dimension *dimension, double *si);

#endif
