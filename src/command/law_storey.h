// SPDX-License-Identifier: GPL-3.0-or-later
// What the words of `jostle law storey` say, and the loops they ask for.
#ifndef JOSTLE_LAW_STOREY_H
#define JOSTLE_LAW_STOREY_H

#include "command/command.h"
#include "command/law_words.h"
#include "command/printer.h"
#include "law/storey_fit.h"
#include "law/storey_loop.h"
#include "model/storey_choice.h"

// Laws of storeys; laws of hinges, which are storey laws of moment and rotation; laws of links.
struct law_storey_kind {
    const char *name;                 // behind `jostle law`
    const char *deformation, *force;  // what its quantities are called
    struct dimension of_deformation, of_force, of_stiffness;
    const char *unit, *force_unit;  // in SI
    bool turns;                     // rotations and moments
    bool links;                     // laws of links
};
extern const struct law_storey_kind law_storey_kinds[];
enum { LAW_STOREY_KINDS = 3 };

struct law_storey_words {
    struct law_words laws;
    const struct law_storey_kind *kind;
    const char *protocol;  // a file or the name of a protocol; NULL: the first one
};

// One law and its path. Values in SI.
struct law_storey {
    struct loop_law law;
    struct storey_choice choice;
    double stiffness;  // initial; NAN: none
    double constant[LOOP_CONSTANTS_MAX];
    struct storey_point *point;  // (n_point)
    // Where a loop was measured:
    int found[LOOP_ROWS_MAX + 1];  // (n_found) rows, or STOREY_FIT_STIFFNESS
    int n_found;
    struct storey_fit_result fit;
};

struct law_storeys {
    const struct law_storey_kind *kind;
    struct deck *deck;  // owns what is below
    struct law_storey *storey;
    int n;
    const char *protocol;
    double period;         // [T] of a cycle; 0: slowly
    const double *target;  // (n_target) deformations
    size_t n_target;
    int n_part;           // points from one target to the next
    size_t n_point;       // n_target n_part + 1
    const double *shear;  // (n_target) measured at the targets; NULL: none were
};

// Reads the laws and runs them. Returns EXIT_DONE or, after a message, the exit status.
int law_storey_run(const struct law_storey_words *words, struct law_storeys *out);
void law_storey_free(struct law_storeys *l);

// A law and the options given or found, "bilinear -yield 6e+05 -stiffness 6e+07", cut where `text`
// ends.
void law_storey_text(const struct law_storey *s, char *text, size_t size);

// Warnings of a fit: parameters that the loop does not determine.
void law_storey_warn(const struct law_storeys *l, FILE *to);

// Text is for readers: largest values, and a table of the turns of each law. Data has a line for
// each law and turn; of a fit, one for each parameter. Returns EXIT_DONE or, after a message, the
// exit status.
int law_storey_print(const struct law_storeys *l, enum printer_form form, FILE *to);

// All points of the first law as TSV. Returns as law_storey_print.
int law_storey_print_path(const struct law_storeys *l, FILE *to);

#endif
