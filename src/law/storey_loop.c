// SPDX-License-Identifier: GPL-3.0-or-later
#include "law/storey_loop.h"

#include <assert.h>
#include <gsl/gsl_math.h>

#include "law/bilateral.h"
#include "law/maxwell.h"
#include "law/yield.h"

static void storey_loop_add_row(struct loop_law *law, const struct row *row, int place) {
    assert(law->n_row < LOOP_ROWS_MAX);
    law->place[law->n_row] = place;
    law->row[law->n_row++] = *row;
}

void storey_loop_of_storey(const struct storey_law *from, struct loop_law *out) {
    *out = (struct loop_law){.name = from->name,
                             .storey = from,
                             .straight = from->traits & STOREY_STRAIGHT,
                             .rated = from->respond_at_rate != NULL};
    for (int r = 0; r < from->n_row; r++) {
        storey_loop_add_row(out, &from->row[r], r);
    }
}

static_assert(BILATERAL_STIFFNESS == 0 && (int)MAXWELL_STIFFNESS == 0 &&
                  (int)LINK_ROW_STIFFNESS == 0,
              "the first row of all laws of links is the stiffness");
void storey_loop_of_link(const struct link_law *from, struct loop_law *out) {
    *out = (struct loop_law){.name = from->name,
                             .storey = from->storey,
                             .link = *from,
                             .contact = from->law ? *from->law : link_law_make(from),
                             .straight = from->storey && from->storey->traits & STOREY_STRAIGHT,
                             .rated = from->law != NULL};
    for (int r = 1; from->storey && r < LINK_ROWS; r++) {
        if (link_law_has(from, r)) {
            storey_loop_add_row(out, &link_law_rows[r], r);
        }
    }
    for (int r = from->law ? 1 : 0; r < from->n_row; r++) {
        storey_loop_add_row(out, &from->row[r], from->law ? r : LINK_ROWS + r);
    }
}

int storey_loop_prepare(const struct loop_law *law, const double *value, double stiffness,
                        double *constant, struct error *e) {
    double all[LOOP_ROWS_MAX];
    if (!law->link.name) {
        return storey_law_prepare(law->storey, value, stiffness, constant, e);
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

// Goes to this deformation in a step of length `dt`, and brings the history there. `velocity` is
// that at the end of the step. The tangent is the derivative of the force by the deformation.
static struct storey_response storey_loop_advance(const struct loop_law *law,
                                                  const double *constant, double *history,
                                                  double deformation, double velocity, double dt) {
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

// Recoverable energy at this deformation.
static double storey_loop_stored(const struct loop_law *law, const double *constant,
                                 const double *history, double deformation) {
    return law->link.name ? law->contact.stored(constant, history, -deformation)
                          : law->storey->stored(constant, history, deformation);
}

// Where the path is at this share of the time from one target to the next, and its rate.
static double storey_loop_place(const struct storey_path *path, double from, double to,
                                double share, double *rate) {
    *rate = 0.0;
    if (share >= 1.0) {
        return to;
    }
    if (path->period > 0.0) {
        *rate = (to - from) * M_PI * sin(M_PI * share) / path->period;
        return from + (to - from) * (1.0 - cos(M_PI * share)) / 2.0;
    }
    return from + share * (to - from);
}

void storey_loop_run(const struct storey_path *path, struct storey_point *point) {
    assert(path->n_part > 0 && path->n_step > 0);
    const int n_step = path->n_step;
    const double dt = path->period / 2.0 / path->n_part / n_step;
    double history[LOOP_HISTORY_MAX] = {0};
    struct storey_response r =
        storey_loop_advance(path->law, path->constant, history, 0.0, 0.0, 0.0);
    double from = 0.0, drift = 0.0, work = 0.0;
    *point++ = (struct storey_point){.shear = r.shear, .tangent = r.tangent};
    for (size_t i = 0; i < path->n_target; i++) {
        for (int k = 0; k < path->n_part; k++, point++) {
            for (int j = 1; j <= n_step; j++) {
                const double share = (k + (double)j / n_step) / path->n_part;
                const double before = r.shear, left = drift;
                double rate;
                drift = storey_loop_place(path, from, path->target[i], share, &rate);
                r = storey_loop_advance(path->law, path->constant, history, drift, rate, dt);
                work += (before + r.shear) / 2.0 * (drift - left);
            }
            *point = (struct storey_point){
                .drift = drift,
                .shear = r.shear,
                .tangent = r.tangent,
                .work = work,
                .dissipated = work - storey_loop_stored(path->law, path->constant, history, drift),
                .plastic = path->stiffness > 0.0 ? drift - r.shear / path->stiffness : 0.0,
            };
        }
        from = path->target[i];
    }
}

void storey_loop_shears(const struct storey_path *path, double *shear) {
    double history[LOOP_HISTORY_MAX] = {0};
    for (size_t i = 0; i < path->n_target; i++) {
        shear[i] =
            storey_loop_advance(path->law, path->constant, history, path->target[i], 0.0, 0.0)
                .shear;
    }
}

// FEMA 461 (2007), Interim testing protocols: two cycles of each amplitude, which
// rises by 1.4. SAC/BD-97/02 (Clark, Frank, Krawinkler & Shaw 1997), as in AISC 341, section K2:
// storey drift angles of 0.375, 0.5, 0.75, 1, 1.5, 2, 3 and 4 %.
const struct protocol storey_loop_protocols[] = {
    {"fema461",
     "FEMA 461 (2007), Interim testing protocols",
     10,
     {0.048, 0.068, 0.095, 0.133, 0.186, 0.26, 0.364, 0.51, 0.714, 1.0},
     {2, 2, 2, 2, 2, 2, 2, 2, 2, 2}},
    {"sac",
     "SAC/BD-97/02 (1997), as in AISC 341, section K2",
     8,
     {0.09375, 0.125, 0.1875, 0.25, 0.375, 0.5, 0.75, 1.0},
     {6, 6, 6, 4, 2, 2, 2, 2}},
};
const int n_storey_loop_protocol = sizeof storey_loop_protocols / sizeof storey_loop_protocols[0];

int storey_loop_targets(const struct protocol *p, double amplitude,
                        double target[PROTOCOL_TARGETS_MAX]) {
    int n = 0;
    for (int i = 0; i < p->n; i++) {
        for (int k = 0; k < p->cycles[i]; k++) {
            assert(n + 3 <= PROTOCOL_TARGETS_MAX);
            target[n++] = p->amplitude[i] * amplitude;
            target[n++] = -p->amplitude[i] * amplitude;
        }
    }
    target[n++] = 0.0;
    return n;
}
