// SPDX-License-Identifier: GPL-3.0-or-later
// Result files as somebody else may have made them: texts and numbers in them are replaced, and
// their histories are drawn out by compression.
#ifndef JOSTLE_TEST_FOREIGN_H
#define JOSTLE_TEST_FOREIGN_H

#include <stddef.h>

// A field is a text attribute, a text of a dataset, or the name of a building or a sweep, in the
// order of the file. Fields that tell the reader what it reads are fixed: format, status, units.
enum { FOREIGN_FIELDS_MAX = 1024 };
struct foreign_field {
    char path[256];  // "/contacts/name", "/@title", "/buildings/A"
    int fixed;
};

// All fields of the file; returns how many.
int foreign_fields(const char *file, struct foreign_field *field);

// Copies the file `from` to `to` with another text in field `i`; i < 0: in all that are not fixed.
// A name that HDF5 does not take for a link (empty, with a slash) stays. Ends of links follow the
// names of buildings.
void foreign_text(const char *from, const char *to, int i, const char *text);

// Copies the file with another value in all its numbers but scales of floors and links.
void foreign_numbers(const char *from, const char *to, double value);

// Copies the file of a run with histories of `n` million zeros, which take a thousandth of that.
void foreign_histories(const char *from, const char *to, int n);

#endif
