// SPDX-License-Identifier: GPL-3.0-or-later
// Engineering demand parameters: what an engineer asks of each run of a study, by a name such as
// `drift`, `drift:A:3` or `force:A:5-B:5`. It is one number of a run: the largest value, or the
// sum, of a quantity at the places named.
#ifndef JOSTLE_EDP_H
#define JOSTLE_EDP_H

#include "jostle/study_file.h"

enum edp_reduction {
    EDP_LARGEST,  // of sizes
    EDP_HIGHEST,  // of values that may be negative
    EDP_SUM,
};

// A quantity that can be asked for. `owner` is what follows the first colon.
enum edp_owner {
    EDP_OF_BUILDING,
    EDP_OF_MEMBER,
    EDP_OF_FOUNDATION,
    EDP_OF_CONTACT,
    EDP_OF_LINK,
    EDP_OF_COLUMN,
    EDP_OF_ALL
};
struct edp_quantity {
    const char *name;
    enum edp_owner owner;
    const char *parent, *item;  // where the file has it
    const char *divisor;        // property of the building that it is divided by; NULL: none
    enum edp_reduction reduction;
    const char *doc;  // half a line
};
extern const struct edp_quantity edp_quantities[];
extern const int n_edp_quantity;

// A value of a run that counts.
struct edp_term {
    size_t value, divisor;          // indices among a run's values; divisor SIZE_MAX: none
    const char *location;           // "A:3", "A:5-B:5"; "" for the whole
    const struct study_item *item;  // of a building; NULL: others
};

struct edp {
    const struct edp_quantity *quantity;
    const char *text;   // as asked for
    const char *units;  // "1": a number
    struct dimension dimension;
    int n_term;
    const struct edp_term *term;  // (n_term)
};

// Reads `text` against the file's table: NAME, NAME:BUILDING, NAME:BUILDING:FLOOR,
// NAME:BUILDING:MEMBER, NAME:CONTACT or NAME:LINK; in names, _ stands for - too. What lasts is from
// `a`. Errors: STATUS_INPUT (no such quantity or place, and what there is), STATUS_SYSTEM.
int edp_parse(const struct study_view *v, const char *text, struct arena *a, struct edp *out,
              struct error *e);

// The number of a run from its values (n_value); *at is the term that is largest, for a sum too.
// NAN where a term has no value, as it may be the largest: *at is the first such.
double edp_value(const struct edp *p, const double *value, int *at);

// The demand whose name this is counts collapses.
#define EDP_COLLAPSE "collapse"
bool edp_is_collapse(const struct edp *p);

// Has the run with these values (n_value) collapsed?
bool edp_collapsed(const struct study_view *v, const double *value);

// What study_view_hit says of term `at`; -1 for terms that are not of a building.
int edp_hit(const struct edp *p, const struct study_view *v, int at, const double *value);

// Sets the error of a run that is done, but has no value at term `at`: STATUS_INPUT.
int edp_absent(const struct edp *p, int at, struct error *e);

// The value of one term.
double edp_term_value(const struct edp *p, int term, const double *value);

// "20mm" in the units of `p`; a bare number is in them already. Errors: STATUS_INPUT (no number,
// another dimension, not finite, below 0 where values never are).
int edp_limit(const struct edp *p, const struct unit_system *units, const char *text, double *limit,
              struct error *e);

// The dimension and size [SI] of a text such as "m/s^2"; a pure number where it is none.
struct dimension edp_units(const char *text, double gravity, double *size);

#endif
