// SPDX-License-Identifier: GPL-3.0-or-later
#include "law/storey_loop.h"

#include <assert.h>

void storey_loop_run(const struct storey_path *path, struct storey_point *point) {
    assert(path->n_part > 0 && path->n_step > 0);
    const struct storey_law *law = path->law;
    const int n_step = path->n_step;
    double history[STOREY_HISTORY_MAX] = {0};
    struct storey_response r = law->respond(path->constant, history, 0.0, history);
    double from = 0.0, work = 0.0;
    *point++ = (struct storey_point){.shear = r.shear, .tangent = r.tangent};
    for (size_t i = 0; i < path->n_target; i++) {
        const double way = path->target[i] - from;
        const double step = way / path->n_part / n_step;
        for (int k = 1; k <= path->n_part; k++, point++) {
            for (int j = 1; j <= n_step; j++) {
                const double share = (k - 1 + (double)j / n_step) / path->n_part;
                const double before = r.shear,
                             drift = share < 1.0 ? from + share * way : path->target[i];
                r = law->respond(path->constant, history, drift, history);
                work += (before + r.shear) / 2.0 * step;
            }
            const double drift = k < path->n_part ? from + way * k / path->n_part : path->target[i];
            *point = (struct storey_point){
                .drift = drift,
                .shear = r.shear,
                .tangent = r.tangent,
                .work = work,
                .dissipated = work - law->stored(path->constant, history, drift),
                .plastic = path->stiffness > 0.0 ? drift - r.shear / path->stiffness : 0.0,
            };
        }
        from = path->target[i];
    }
}

void storey_loop_shears(const struct storey_path *path, double *shear) {
    double history[STOREY_HISTORY_MAX] = {0};
    for (size_t i = 0; i < path->n_target; i++) {
        shear[i] = path->law->respond(path->constant, history, path->target[i], history).shear;
    }
}
