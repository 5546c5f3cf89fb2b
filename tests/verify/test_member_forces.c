// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of members in runs: their envelopes are the extremes over all steps.
#include <math.h>
#include <stdio.h>

#include "model/forces.h"
#include "support/analysis.h"
#include "support/support.h"

// What rows of every step say: extremes of all forces, and the largest error of shares.
struct watched {
    const struct model *model;
    double most[512], least[512], most_time[512], least_time[512];
    double error, shear;
    long n;
};

static int watch(void *context, const struct row_view *row, struct error *e) {
    struct watched *w = context;
    const struct building *g = &w->model->building[0];
    (void)e;
    for (int i = 0; i < g->n_force; i++) {
        const double x = row->member_force[i];
        if (w->n == 0 || x > w->most[i]) {
            w->most[i] = x;
            w->most_time[i] = row->time;
        }
        if (w->n == 0 || x < w->least[i]) {
            w->least[i] = x;
            w->least_time[i] = row->time;
        }
    }
    const int n_part = (g->fixed ? g->fixed : g)->n_part;
    for (int i = 0; i < g->n_floor; i++) {
        double sum = 0;
        for (int k = 0; k <= n_part; k++) {
            sum += row->member_force[forces_of_share(g, k) + i];
        }
        w->error = fmax(w->error, fabs(sum - row->storey_shear[i]));
        w->shear = fmax(w->shear, fabs(sum));
    }
    w->n++;
    return STATUS_OK;
}

static const char dual[] =
    "building A -floors 5 -mass 100t -height 3 -stiffness 40e6\n"
    "frame A -bays 6 5 -modulus 30e9\ncolumns A:1:5 -I 2e-3 -A 0.16\nbeams A:1:5 -I 3e-3\n"
    "wall A:1:4 -EI 3e9 -GA 1e9\nbase A pinned -lines 1 2 3\ndamping A rayleigh 5%\n"
    "building B -floors 3 -mass 100t -stiffness 60e6\ndamping B rayleigh 5%\n"
    "contact A B -gap 5mm -law linear -k 93.5e6\n"
    "ground record input/records/ELCENTRO_1940_NS.AT2\nduration 5\n";

static void envelopes_are_the_extremes_of_all_steps(void **state) {
    (void)state;
    static const char *const steps[] = {
        "", "initial A:5 -displacement 20mm\n", "storey B bilinear -yield 300e3 -hardening 0.05\n",
        "foundation A -mass 50t -inertia 1e6 -sway 4e8 -rocking 2e10 "
        "-sway-dashpot 3e6\n",
        "pdelta A -leaning 2000e3\nfoundation A -mass 50t "
        "-inertia 1e6 -sway 4e8 -rocking 2e10\n"};
    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++) {
        struct model *m =
            analysis_model("%s%sstep fixed 2ms\noutput -every 1 -fields members\n", dual, steps[i]);
        static struct watched w;
        w = (struct watched){.model = m};
        struct results *r;
        struct error e;
        assert_int_equal(analysis_run(m, &(struct observer){.row = watch, .context = &w}, &r, &e),
                         STATUS_OK);
        const struct building *g = &m->building[0];
        assert_true(r->n_impact > 3 && w.n == 2501);
        for (int k = 0; k < g->n_force; k++) {
            if (!isnan(w.most[k])) {  // beams and walls have no normal force
                assert_true(r->force_max[k] == w.most[k] && r->force_min[k] == w.least[k]);
                assert_true(r->force_max_time[k] == w.most_time[k]);
                assert_true(r->force_min_time[k] == w.least_time[k]);
            }
        }
        assert_near(w.error, 0, 1e-12 * w.shear);
        assert_true(r->residual_peak < 1e-9 * r->energy[ENERGY_INPUT]);
        results_free(r);
        model_free(m);
    }
}

// Storeys that yield beside a frame: the frame's share and its members follow from the drifts.
static void members_beside_yielding_storeys_follow_the_drifts(void **state) {
    (void)state;
    static const char *const method[] = {"step fixed 1ms\n", "step adaptive -tolerance 1e-7\n"};
    double moment[2];
    for (int i = 0; i < 2; i++) {
        struct analysis a = analysis_of(
            "building A -floors 2 -mass 100t -height 3 -stiffness 40e6\n"
            "frame A -bays 6 -modulus 30e9 -columns-inextensible\ncolumns A:1:2 -I 2e-3\n"
            "beams A:1:2 -I 3e-3\nstorey A bilinear -yield 200e3 -hardening 0.02\n"
            "damping A rayleigh 3%%\nground record input/records/ELCENTRO_1940_NS.AT2\n"
            "duration 6\n%s",
            method[i]);
        const struct building *g = &a.model->building[0];
        assert_false(g->elastic);
        assert_int_equal(forces_of_share(g, 0), -1);
        assert_int_equal(forces_of_share(g, 1), 0);
        const int at = forces_of_members(g, 0, FRAME_MOMENT_I);
        moment[i] = a.results->force_max[at];
        assert_true(a.results->residual_drift[0] > 0);
        analysis_free(&a);
    }
    assert_close(moment[0], moment[1], 1e-3);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(envelopes_are_the_extremes_of_all_steps),
        cmocka_unit_test(members_beside_yielding_storeys_follow_the_drifts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
