// SPDX-License-Identifier: GPL-3.0-or-later
#include "law/storey_loop.h"

#include <assert.h>
#include <math.h>

// Where the path is at this share of the time from one target to the next, and its rate.
static double storey_loop_place(const struct storey_path *path, double from, double to,
                                double share, double *rate) {
    static const double PI = 3.14159265358979323846;
    *rate = 0.0;
    if (share >= 1.0) {
        return to;
    }
    if (path->period > 0.0) {
        *rate = (to - from) * PI * sin(PI * share) / path->period;
        return from + (to - from) * (1.0 - cos(PI * share)) / 2.0;
    }
    return from + share * (to - from);
}

void storey_loop_run(const struct storey_path *path, struct storey_point *point) {
    assert(path->n_part > 0 && path->n_step > 0);
    const int n_step = path->n_step;
    const double dt = path->period / 2.0 / path->n_part / n_step;
    double history[LOOP_HISTORY_MAX] = {0};
    struct storey_response r = loop_law_advance(path->law, path->constant, history, 0.0, 0.0, 0.0);
    double from = 0.0, drift = 0.0, work = 0.0;
    *point++ = (struct storey_point){.shear = r.shear, .tangent = r.tangent};
    for (size_t i = 0; i < path->n_target; i++) {
        for (int k = 0; k < path->n_part; k++, point++) {
            for (int j = 1; j <= n_step; j++) {
                const double share = (k + (double)j / n_step) / path->n_part;
                const double before = r.shear, left = drift;
                double rate;
                drift = storey_loop_place(path, from, path->target[i], share, &rate);
                r = loop_law_advance(path->law, path->constant, history, drift, rate, dt);
                work += (before + r.shear) / 2.0 * (drift - left);
            }
            *point = (struct storey_point){
                .drift = drift,
                .shear = r.shear,
                .tangent = r.tangent,
                .work = work,
                .dissipated = work - loop_law_stored(path->law, path->constant, history, drift),
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
            loop_law_advance(path->law, path->constant, history, path->target[i], 0.0, 0.0).shear;
    }
}
