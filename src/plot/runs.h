// SPDX-License-Identifier: GPL-3.0-or-later
// The run that a figure shows, and the run it is compared with: both have the same buildings.
#ifndef JOSTLE_RUNS_H
#define JOSTLE_RUNS_H

#include "jostle/error.h"
#include "jostle/result.h"
#include "plot/canvas.h"
#include "plot/legend.h"

// Histories as columns, the first of which has the times.

enum { DATA_COLUMNS_MAX = 8 };
struct data {
    size_t n_row;
    int n_column;
    double *column[DATA_COLUMNS_MAX];  // (n_row); owned, in one block
};

// Columns of zeros. Errors: STATUS_SYSTEM (no memory).
int data_create(struct data *d, long n_row, int n_column, struct error *e);
void data_free(struct data *d);

// Writes the data block $NAME, thinned so that each of `bins` equal parts keeps the extremes of
// every column. `columns` names them.
void data_write(const struct data *d, size_t bins, struct canvas *c, const char *columns,
                const char *name, ...) __attribute__((format(printf, 5, 6)));

void data_span(const struct data *d, int column, struct span *r);

// The column's value at time t, by a straight line between rows.
double data_at(const struct data *d, int column, double t);

// The first row at t or later; n_row if there is none.
size_t data_row(const struct data *d, double t);

enum { RUNS_MAX = 2 };
struct runs {
    int n;                                     // 1 or 2
    const struct result_file *file[RUNS_MAX];  // borrowed
    const struct report *r[RUNS_MAX];          // borrowed
    char name[RUNS_MAX][64];                   // the files, as short as tells them apart
    // The first run's title, or its deck where it has none; before the title of one run of a study,
    // its number; behind it, of one run, when it has collapsed. In the arena of the first run.
    const char *title;
    // Called by figures that take their time; NULL: nothing to tell.
    void (*tell)(void *context, long n_done, long n);
    void *context;
};

// `second` is NULL where one run is shown alone. Errors: STATUS_INPUT (the runs have other
// buildings or other units; names the first difference).
int runs_init(struct runs *s, const struct result_file *first, const struct result_file *second,
              struct error *e);

// Reads histories of a run, one in each column; an index below 0 leaves its column zero. Call
// data_free afterwards, also after a failure of the canvas (they take too much memory; a damaged
// file), which leaves no rows; false then.
bool runs_read(const struct runs *s, int run, const struct history *h, int n, struct data *d,
               struct canvas *c);

// True if all runs hold all these histories, bits of enum field.
bool runs_have(const struct runs *s, unsigned fields);

// STATUS_OK if all runs hold them; otherwise the error "FILE has no WHAT; see output -fields".
int runs_need(const struct runs *s, unsigned fields, const char *what, struct error *e);

// The errors "FILE has no WHAT", and that the first run has no contacts.
int runs_lack(const struct runs *s, const char *what, struct error *e);
int runs_lack_contacts(const struct runs *s, struct error *e);

// The contact with the largest force of the first run that has one, for each run: its index, or -1.
// Contacts of two runs are the same if they join the same floors.
void runs_hardest_contact(const struct runs *s, int *contact);

// The sides that figures show: those of the hardest contact of the first run, or the roofs of its
// first two buildings.
struct facing {
    int contact[RUNS_MAX];  // the hardest in each run; below 0: none
    int building[2];        // -1: a wall, or none
    int floor[2];           // from 0
    double level[2];        // between that floor and the one below; NAN: at the floor
    double weight[2];       // of the floor there
};
void runs_facing(const struct runs *s, struct facing *f);

// Index in `run` of the first run's contact `i`; -1 if it is not there.
int runs_same_contact(const struct runs *s, int run, int i);

// Index of the hardest impact of the contact; -1 if it has none. A contact of -1 has none.
long runs_hardest_impact(const struct report *r, int contact);

// Index of the contact's hardest impact in each of `parts` equal parts of the duration; -1: it has
// none there. `hardest` is (parts).
void runs_hardest_of_parts(const struct report *r, int contact, int parts, long *hardest);

// The building called `name`; -1: a wall.
int runs_building(const struct report *r, const char *name);

// True if all storeys of the building have heights.
bool runs_has_heights(const struct report_building *b);

// Of so many floors of the building: their height, or where there are no heights their number.
double runs_level(const struct report_building *b, int floors, bool heights);

// The axis of the time of all runs, for the panel at the foot of the picture or one above it.
struct axis runs_time_axis(const struct runs *s, bool at_foot);

// The axis of the height of buildings up to `top`, or of their floors where there are no heights:
// for the first of the panels beside each other, or one right of it.
struct axis runs_height_axis(bool first, bool heights, double top);

// Entries of the legend that tell two runs apart: by their colours, or where all is of one `colour`
// the second by dashes. None for one run.
void runs_legend(const struct runs *s, const char *colour, struct legend *l);

// Turns the displacements u (n) of a floor (from 0) into those of a level below it, at which the
// floor has the weight and the floor below, or the ground, the rest. False after a failure.
bool runs_move_to_level(const struct runs *s, int run, int building, int floor, double weight,
                        double *u, size_t n, struct canvas *c);

#endif
