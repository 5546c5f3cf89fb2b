// SPDX-License-Identifier: GPL-3.0-or-later
// An open result file, shared by reader.c (tables) and histories.c, and what study_report.c reads
// in the same way.
#ifndef JOSTLE_READER_H
#define JOSTLE_READER_H

#include "result/h5.h"

struct result_file {
    struct h5 h;
    hid_t root;             // the file, or the group of a run of a study
    struct report *report;  // owned
    const char *path;       // in the report's arena
};

// Whether the file, or the run, `root` is a complete result that this program can read. Errors:
// STATUS_INPUT (it is not), STATUS_SYSTEM (no memory); they name the path.
int reader_check_format(struct h5 *h, hid_t root, struct arena *a, const char *path,
                        struct error *e);

// A group of one analysis; of a run of a study that of the run and that of the study. Negative:
// there is none.
struct reader_place {
    hid_t own, study;
};

// Is it a run of a study?
bool reader_is_run(const struct result_file *f);

// Prepares for reading the values of run `run` of an open study, numbered from 1.
void reader_place_find(struct result_file *f, long run);

struct reader_place reader_place_root(const struct result_file *f);
struct reader_place reader_place_open(struct result_file *f, const struct reader_place *in,
                                      const char *name);
void reader_place_close(struct result_file *f, const struct reader_place *p);

// The group of these two that has `name`: that of the run itself, if it does.
hid_t reader_place_holder(struct result_file *f, const struct reader_place *p, const char *name);

// Room for the buildings of the file, or of the run, `root`; `visit` is called for the group of
// each in it, with `context`.
void reader_buildings(struct h5 *h, hid_t root, struct report *r, H5L_iterate_t visit,
                      void *context);

// The building in `group`, with its name, at its position, which must be free; NULL after a
// failure.
struct report_building *reader_building(struct h5 *h, hid_t group, const char *name,
                                        struct report *r);

#endif
