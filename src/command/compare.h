// SPDX-License-Identifier: GPL-3.0-or-later
// What jostle compare reads: histories of runs, and those beside them.
#ifndef JOSTLE_COMPARE_H
#define JOSTLE_COMPARE_H

#include "command/printer.h"
#include "core/arena.h"
#include "jostle/result.h"
#include "study/comparison.h"
#include "study/run_pairs.h"

extern const struct command command_compare;

struct comparing {
    const char *quantity;  // as asked for; NULL: all displacements
    const char *measured;  // the file; NULL: none
    struct arena *arena;
    int field;          // its place in field_names; 0: displacement
    const char *owner;  // of the quantity; NULL: all
    int floor;          // from 1; 0: all
    struct unit_system units;
    const char *title;
    int n;
    struct comparison_pair *pair;  // (n)
};

// Reads `quantity`. Returns EXIT_DONE or, after a message, the exit status.
int compare_read_quantity(struct comparing *c);

// Replaces every `from` in the text.
void compare_replace(char *text, char from, char to);

// The histories of a run and those of another one, or of a file of columns; those of all runs and
// the measured one. Errors: STATUS_INPUT, STATUS_SYSTEM.
int compare_two(struct comparing *c, const char *path, const char *other, struct error *e);
int compare_all(struct comparing *c, const struct words *run, struct error *e);

// Two studies: the ratios of demands of runs with the same parameters, and of the fragilities for a
// limit.
struct compare_studies {
    const char *path[2];
    const char *edp, *limit;  // NULL: all demands; no fragilities
    enum printer_form form;
};
int compare_studies(struct compare_studies *q, struct error *e);

// Opens two studies, finds their pairs of runs and uses them. Errors: STATUS_INPUT, STATUS_SYSTEM,
// those of `use`.
typedef int compare_pairs_use(void *context, const struct run_pairs *p, struct error *e);
int compare_pairs(const char *const path[2], compare_pairs_use *use, void *context,
                  struct error *e);

#endif
