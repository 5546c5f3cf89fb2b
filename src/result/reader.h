// SPDX-License-Identifier: GPL-3.0-or-later
// What reading the files of runs and of studies has in common: reader.c (values), result_file.c
// (the file of a run) and study_reader.c (that of a study).
#ifndef JOSTLE_READER_H
#define JOSTLE_READER_H

#include "result/h5.h"

// READ_VALUES: the values of a run; READ_SHAPE: what all runs of a study have in common.
enum reading { READ_VALUES, READ_SHAPE };

// An open file that is read into a report.
struct result_file {
    struct h5 h;
    hid_t root;             // the file, or the group of a run of a study
    struct report *report;  // owned
    const char *path;       // in the report's arena
    enum reading reading;
};

// Room for the report of the file at `path`, which is not open yet. To be given to reader_close,
// whatever happens. Errors: STATUS_SYSTEM (no memory).
int reader_init(struct result_file *f, const char *path, enum reading reading, struct error *e);
void reader_close(struct result_file *f);

// Opens the file `path` with buffers of `sieve` bytes for each dataset that is read piece by piece,
// and checks that it is a complete result that this program can read. Errors: STATUS_INPUT (it is
// not), STATUS_SYSTEM (no memory); they name the path.
int reader_open(struct result_file *r, const char *path, size_t sieve, struct error *e);

// Reads attributes, buildings and links into the report; of a run impacts and energies, too. Errors
// are noted in r->h.
void reader_get(struct result_file *r);

// Is it a run of a study?
bool reader_is_run(const struct result_file *r);

#endif
