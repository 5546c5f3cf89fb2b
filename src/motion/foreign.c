// SPDX-License-Identifier: GPL-3.0-or-later
// Tables that identify files that are not records, and formats that jostle cannot read. So a
// message names the kind of the file instead of what is missing in it.
#include <string.h>

#include "motion/lines.h"
#include "motion/record_format.h"

struct mark {
    const char *name;
    const char *text;
    size_t n;
};

// First bytes.
static const struct mark files[] = {
    {"a zip archive", "PK\x03\x04", 4},
    {"a gzip archive", "\x1f\x8b", 2},
    {"an HDF5 file", "\x89HDF", 4},
    {"a PDF document", "%PDF-", 5},
    {"UTF-16 text", "\xff\xfe", 2},
    {"UTF-16 text", "\xfe\xff", 2},
    {"a Git LFS pointer", "version https://git-lfs", 23},
};

// Words in capitals in one of the first lines.
static const struct {
    const char *name, *text;
    int n_line;  // the words are in one of the first n_line lines
} formats[] = {
    {"SMC of uncorrected accelerations (times that are not even)", "1 UNCORRECTED ACCELEROGRAM", 1},
    {"SMC of velocities", "3 VELOCITY", 1},
    {"SMC of displacements", "4 DISPLACEMENT", 1},
    {"USC volume 1 (times that are not even)", "OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME", 1},
    {"CSMIP or USC without values", "CORRECTED ACCELEROGRAM", 3},
};

const char *foreign_file(const struct record_text *t) {
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        if (t->size >= files[i].n && memcmp(t->text, files[i].text, files[i].n) == 0) {
            return files[i].name;
        }
    }
    struct lines l;
    lines_init(&l, t);
    while (lines_next(&l) && l.line.n == 0) {
    }
    bool is_markup = l.line.n > 0 && l.line.text[0] == '<';
    return is_markup ? "an HTML or XML page" : NULL;
}

const char *foreign_format(const struct record_text *t) {
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        if (record_has_mark(t, formats[i].text, formats[i].n_line)) {
            return formats[i].name;
        }
    }
    return NULL;
}
