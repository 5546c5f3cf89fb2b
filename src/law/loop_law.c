// SPDX-License-Identifier: GPL-3.0-or-later
#include "law/loop_law.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "law/bilateral.h"
#include "law/maxwell.h"

static void loop_law_add_row(struct loop_law *law, const struct row *row, int place) {
    assert(law->n_row < LOOP_ROWS_MAX);
    law->place[law->n_row] = place;
    law->row[law->n_row++] = *row;
}

void loop_law_of_storey(const struct storey_law *from, struct loop_law *out) {
    *out = (struct loop_law){.name = from->name,
                             .storey = from,
                             .straight = from->traits & STOREY_STRAIGHT,
                             .rated = from->respond_at_rate != NULL};
    for (int r = 0; r < from->n_row; r++) {
        loop_law_add_row(out, &from->row[r], r);
    }
}

// The first row of all laws of links is the stiffness.
void loop_law_of_link(const struct link_law *from, struct loop_law *out) {
    assert(BILATERAL_STIFFNESS == 0 && MAXWELL_STIFFNESS == 0 && LINK_ROW_STIFFNESS == 0);
    *out = (struct loop_law){.name = from->name,
                             .storey = from->storey,
                             .link = *from,
                             .contact = from->law ? *from->law : link_law_make(from),
                             .straight = from->storey && from->storey->traits & STOREY_STRAIGHT,
                             .rated = from->law != NULL};
    for (int r = 1; from->storey && r < LINK_ROWS; r++) {
        if (link_law_has(from, r)) {
            loop_law_add_row(out, &link_law_rows[r], r);
        }
    }
    for (int r = from->law ? 1 : 0; r < from->n_row; r++) {
        loop_law_add_row(out, &from->row[r], from->law ? r : LINK_ROWS + r);
    }
}

int loop_law_row(const struct loop_law *law, const char *key) {
    int r = law->n_row - 1;
    while (r >= 0 && strcmp(law->row[r].key, key) != 0) {
        r--;
    }
    return r;
}

int loop_law_prepare(const struct loop_law *law, const double *value, double stiffness,
                     double *constant, struct error *e) {
    double all[LOOP_ROWS_MAX];
    if (!law->link.name) {
        return law->storey->prepare(value, stiffness, constant, e);
    }
    for (int r = 0; r < LOOP_ROWS_MAX; r++) {
        all[r] = NAN;
    }
    all[0] = isnan(stiffness) ? 0.0 : stiffness;
    for (int r = 0; r < law->n_row; r++) {
        all[law->place[r]] = value[r];
    }
    if (law->link.law == &bilateral_law && all[0] == 0.0 && all[BILATERAL_DASHPOT] == 0.0) {
        return error_set(e, STATUS_INPUT, "a link needs -stiffness or -dashpot");
    }
    return law->link.law ? law->link.law->prepare(all, 0.0, constant, e)
                         : link_law_prepare(&law->link, all, constant, e);
}

struct storey_response loop_law_advance(const struct loop_law *law, const double *constant,
                                        double *history, double deformation, double velocity,
                                        double dt) {
    const struct contact_law *link = &law->contact;
    if (!law->link.name && law->rated) {
        const struct storey_rate_response r =
            law->storey->respond_at_rate(constant, history, deformation, velocity, history);
        return (struct storey_response){r.shear, r.tangent};
    }
    if (!law->link.name) {
        return law->storey->respond(constant, history, deformation, history);
    }
    if (link->traits & CONTACT_NEEDS_STEP) {
        history[0] = dt;
    }
    const struct contact_response r = link->force(constant, history, -deformation, -velocity);
    if (link->commit) {
        link->commit(constant, history, -deformation, -velocity);
    }
    return (struct storey_response){0.0 - r.force, r.dfdd};
}

double loop_law_stored(const struct loop_law *law, const double *constant, const double *history,
                       double deformation) {
    return law->link.name ? law->contact.stored(constant, history, -deformation)
                          : law->storey->stored(constant, history, deformation);
}
