// SPDX-License-Identifier: GPL-3.0-or-later
// Reading records in tests: from a text in memory or from a file, and what is expected of it.
#ifndef JOSTLE_TEST_READING_H
#define JOSTLE_TEST_READING_H

#include <stddef.h>

#include "motion/record_format.h"

// The header of a PEER file up to the line with NPTS.
#define PEER_TITLE "T\nT\nACCELERATION TIME SERIES IN UNITS OF G\n"

// What a test reads with, and what came of it.
struct reading {
    struct arena *arena;
    struct record_request request;  // path "a.txt", gravity 9.80665, nothing else given
    struct record record;
    struct error error;
    int status;
};

// Set-up and tear-down of a test whose state is a struct reading.
int reading_setup(void **state);
int reading_teardown(void **state);

void reading_of_text(struct reading *r, const char *text);
void reading_of_file(struct reading *r, const char *path);

// Reads the text of a file whose first `from` is replaced by `to`.
void reading_of_changed(struct reading *r, const char *path, const char *from, const char *to);

// That the record was read, whatever it was warned about.
void assert_read(const struct reading *r, const char *format, size_t n, double dt);

// That it was refused with exactly this message.
void assert_refused(const struct reading *r, const char *message);

// That it was read with exactly this warning, or none.
void assert_warned(const struct reading *r, const char *message);
void assert_silent(const struct reading *r);

// That its 50 values are size exp(-i / 40) sin(2 pi i / (25 - 5 channel)), rounded: what the files
// of several channels in tests/records/good hold.
void assert_waves(const struct reading *r, int channel, double size, double rounding);

#define TEST_READING(name) cmocka_unit_test_setup_teardown(name, reading_setup, reading_teardown)

#endif
