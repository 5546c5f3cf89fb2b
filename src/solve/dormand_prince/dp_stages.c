// SPDX-License-Identifier: GPL-3.0-or-later
// The stages of a step as a whole; dp_floors.h has the method.
#include "solve/dormand_prince/dp_stages.h"

#include <math.h>

#include "core/lanes.h"

void dp_stages_first(struct dp *p) {
    dp_rates_at(&p->system, &p->now, p->now.time, p->stage[0]);
}

void dp_stages_take(struct dp *p, double h, double end) {
    p->h = h;
    p->next.time = end;
    p->floors->take(p);
}

// The differences of u and v over the links, a run of links at a time.
LANES static void differences(const struct gaps *g, const double *restrict u,
                              const double *restrict v, double *restrict delta,
                              double *restrict rate) {
    for (int i = 0; i < g->n_run; i++) {
        const struct gap_run *r = &g->run[i];
        for (int j = 0; j < r->n; j++) {
            delta[r->first + j] = u[r->left + j] - u[r->right + j] - g->gap[r->first + j];
            rate[r->first + j] = v[r->left + j] - v[r->right + j];
        }
    }
}

void dp_stages_gaps(const struct dp *p, struct state *s, double *rate) {
    const struct model *m = p->model;
    differences(&p->gaps, s->u, s->v, s->delta, rate);
    for (int k = 0; m->n_ground > 1 && k < m->n_link; k++) {
        s->delta[k] = state_gap(&m->link[k], m, s->u, s->ground_u) - m->link[k].gap;
        rate[k] = state_rate(s, m, k);
    }
}

double dp_stages_error(const struct dp *p) {
    double largest = p->floors->error(p);
    return isfinite(largest) ? largest / p->model->control.tolerance : INFINITY;
}

const double dp_stages_whole[DP_STAGES] = {
    35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0, 0.0};

// The continuous extension of order 4: Shampine (1986), Math. Comp. 46, 135-150; here as in Hairer,
// Norsett & Wanner, eq. II.6.12.
void dp_stages_weights(double x, double *weight) {
    const double *b = dp_stages_whole;
    double rise = x * x * (3.0 - 2.0 * x);
    double bump = x * x * (x - 1.0) * (x - 1.0);
    weight[0] = rise * b[0] + x * (x - 1.0) * (x - 1.0) -
                bump * 5.0 * (2558722523.0 - 31403016.0 * x) / 11282082432.0;
    weight[1] = 0.0;
    weight[2] = rise * b[2] + bump * 100.0 * (882725551.0 - 15701508.0 * x) / 32700410799.0;
    weight[3] = rise * b[3] - bump * 25.0 * (443332067.0 - 31403016.0 * x) / 1880347072.0;
    weight[4] = rise * b[4] + bump * 32805.0 * (23143187.0 - 3489224.0 * x) / 199316789632.0;
    weight[5] = rise * b[5] - bump * 55.0 * (29972135.0 - 7076736.0 * x) / 822651844.0;
    weight[6] = x * x * (x - 1.0) + bump * 10.0 * (7414447.0 - 829305.0 * x) / 29380423.0;
}

void dp_stages_work(const struct dp *p, const double *weight, struct energy_account *energy) {
    double time[DP_STAGES];
    for (int s = 0; s < DP_STAGES; s++) {
        time[s] = p->h * weight[s];
    }
    p->floors->work(p, time, energy);
}
