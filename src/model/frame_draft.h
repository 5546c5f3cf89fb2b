// SPDX-License-Identifier: GPL-3.0-or-later
// What the statements frame, columns, beams, base and wall say of a building, and the parts that
// follow from them at the end of the deck.
#ifndef JOSTLE_FRAME_DRAFT_H
#define JOSTLE_FRAME_DRAFT_H

#include "model/builder.h"

enum { FRAME_BAYS_MAX = 50 };

// A column of a storey and line, or a beam of a floor and bay.
struct section_draft {
    struct word word;  // of its statement; text NULL: there is no such member
    double inertia;    // [L^4]
    double area;       // [L^2]; 0: the member does not stretch
};

// A base of a line, or of all lines and walls.
struct base_draft {
    struct word word;  // text NULL: not given
    double rotation;   // [F L] stiffness; 0: pinned; infinite: fixed
};

// A hinge at an end of a member.
struct hinge_draft {
    struct word word;  // of its statement; text NULL: there is no hinge
    struct storey storey;
    bool base;  // the statement is of bases
};

struct frame_draft {
    struct word word;
    int n_line;
    const double *bay;                 // [L] (n_line - 1)
    double modulus;                    // [F/L^2]
    bool inextensible;                 // no column stretches
    bool torn;                         // a statement of its members is wrong, and reported
    struct section_draft *column;      // (n_floor, n_line)
    struct section_draft *beam;        // (n_floor, n_line - 1)
    struct base_draft *base;           // (n_line)
    struct hinge_draft *column_hinge;  // (n_floor, n_line, 2) of ends i and j
    struct hinge_draft *beam_hinge;    // (n_floor, n_line - 1, 2)
};

struct wall_draft {
    struct word word;
    int n_floor;            // its storeys, from the ground
    const double *ei, *ga;  // [F L^2] [F] (n_floor); ga NULL: it does not shear
};

bool frame_draft_has_frame(struct builder *b, const struct statement *s,
                           const struct building_draft *d);

// The numbers from 1 to n that option `a` names, or all of them: chosen[i] of number i + 1. `what`
// names one of them. False after a report.
bool frame_draft_choose(struct builder *b, const struct argument *a, const char *what, int n,
                        bool *chosen);

// Adds the frame and the walls of all buildings to their parts, and reports what they miss.
void frame_draft_finish(struct builder *b);

#endif
