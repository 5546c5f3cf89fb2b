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

// Room for the buildings of the file, or of the run, `root`; `visit` is called for the group of
// each in it, with `context`.
void reader_buildings(struct h5 *h, hid_t root, struct report *r, H5L_iterate_t visit,
                      void *context);

// The building in `group`, with its name, at its position, which must be free; NULL after a
// failure.
struct report_building *reader_building(struct h5 *h, hid_t group, const char *name,
                                        struct report *r);

#endif
