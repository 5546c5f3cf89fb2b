// SPDX-License-Identifier: GPL-3.0-or-later
// What the words of `jostle law` say, and the impacts they ask for.
#ifndef JOSTLE_LAW_IMPACTS_H
#define JOSTLE_LAW_IMPACTS_H

#include "command/command.h"
#include "command/law_words.h"
#include "law/fit.h"
#include "model/law_choice.h"
#include "motion/time_series.h"

// One law and its impact. Values in SI.
struct law_impact {
    struct law_choice choice;
    const double *value;     // (choice.law->n_row)
    const double *constant;  // (choice.law->n_constant)
    double nominal;          // coefficient of restitution asked for; NAN: none
    struct isolated_impact impact;
    const struct isolated_point *point;  // (n_point) from closure to opening
    size_t n_point;
    struct fit_result fit;  // where a force was measured
};

struct law_impacts {
    struct deck *deck;          // owns what is below
    double m1, m2, velocity;    // m2 NAN: a wall
    double mass;                // effective
    struct law_impact *impact;  // (n)
    int n;
    bool found_k;                 // k is that of a peak force
    struct time_series measured;  // n = 0: nothing was
};

// Reads the words and runs the impacts; prints what is wrong with the words. Returns EXIT_DONE with
// *out to be given to law_impacts_free, or another exit status, when nothing is to be freed.
int law_impacts_run(const struct law_words *words, struct law_impacts *out);
void law_impacts_free(struct law_impacts *l);

#endif
