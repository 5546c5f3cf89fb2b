// SPDX-License-Identifier: GPL-3.0-or-later
// The script as a whole: what belongs to no building, and the analysis.
#include <assert.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "export/opensees.h"
#include "jostle/analysis.h"
#include "law/bilateral.h"
#include "model/link_end.h"

// The node of an end of a link. An end of several degrees of freedom gets one of its own, which
// follows them.
static int opensees_end(struct opensees *x, const struct link *l, int side) {
    const int n = link_entries(l, side);
    int node[OPENSEES_ROW_MAX];
    double b[OPENSEES_ROW_MAX] = {1.0};
    if (n <= 1) {
        return opensees_dof(x, l->dof[side]);
    }
    assert(n < OPENSEES_ROW_MAX);
    node[0] = opensees_node(x, 0.0, 0.0, 0, 1, 1);
    for (int i = 0; i < n; i++) {
        const struct link_entry e = link_entry(l, side, i);
        node[i + 1] = opensees_dof(x, e.dof);
        b[i + 1] = -e.weight;
    }
    opensees_row(x, n + 1, node, b, OPENSEES_STIFF * material_link_stiffness(x, l), 0.0);
    return node[0];
}

// A link k d + c v is a matrix over the degrees of freedom of both ends.
static void opensees_linear_link(struct opensees *x, const struct link *l) {
    int node[OPENSEES_ROW_MAX], n = 0;
    double b[OPENSEES_ROW_MAX];
    for (int side = 0; side < 2; side++) {
        for (int i = 0; i < link_entries(l, side); i++) {
            const struct link_entry e = link_entry(l, side, i);
            assert(n < OPENSEES_ROW_MAX);
            node[n] = opensees_dof(x, e.dof);
            b[n++] = side == 0 ? e.weight : -e.weight;
        }
    }
    opensees_row(x, n, node, b, l->constant[BILATERAL_STIFFNESS], l->constant[BILATERAL_DASHPOT]);
}

// Two weights 1 and -1 of a link within a building: the material joins the two floors.
static bool opensees_is_pair(const struct link *l) {
    return l->row[0].n == 2 && l->row[1].n == 0 && l->dof[1] == WALL &&
           l->row[0].entry[0].weight + l->row[0].entry[1].weight == 0.0 &&
           fabs(l->row[0].entry[0].weight) == 1.0;
}

static void opensees_link(struct opensees *x, const struct link *l) {
    emit_note(&x->to, "%s %s: %s", l->bilateral ? "link" : "contact", l->name, l->law->name);
    if (bilateral_is_linear(l->law, l->constant)) {
        opensees_linear_link(x, l);
        return;
    }
    if (l->moving_ground) {
        opensees_note(x,
                      "%s: the different ground displacements at its ends do not change its "
                      "length",
                      l->name);
    }
    int left, right;
    if (opensees_is_pair(l)) {
        const bool first = l->row[0].entry[0].weight > 0.0;
        left = opensees_dof(x, l->row[0].entry[first ? 0 : 1].dof);
        right = opensees_dof(x, l->row[0].entry[first ? 1 : 0].dof);
    } else {
        left = opensees_end(x, l, 0);
        right = opensees_end(x, l, 1);
    }
    opensees_spring(x, left, right, material_link(x, l), OPENSEES_SWAY, false);
}

// The time series of a signal. Returns its tag.
static int opensees_series(struct opensees *x, const struct signal *s) {
    const int tag = ++x->series;
    if (s->value) {
        emit_begin(&x->to, "timeSeries");
        emit_word(&x->to, 0, "Path");
        emit_whole(&x->to, 1, tag);
        emit_word(&x->to, 2, "-dt");
        emit_number(&x->to, 3, s->dt);
        emit_word(&x->to, 4, "-values");
        emit_numbers(&x->to, 5, s->value, s->n);
        emit_word(&x->to, 6, "-startTime");
        emit_number(&x->to, 7, s->start);
        emit_word(&x->to, 8, "-factor");
        emit_number(&x->to, 9, 1.0);
        emit_end(&x->to);
    } else if (s->omega == 0.0) {
        emit_put(&x->to, "timeSeries", "wiwn", "Constant", tag, "-factor",
                 s->amplitude * sin(s->phase));
    } else {
        const double end = isfinite(s->end) ? s->end : 2.0 * x->m->duration + s->start;
        emit_put(&x->to, "timeSeries", "winnnwnwn", "Trig", tag, s->start, end,
                 2.0 * acos(-1.0) / s->omega, "-shift", s->phase, "-factor", s->amplitude);
    }
    return tag;
}

static void opensees_ground(struct opensees *x) {
    for (int k = 0; k < x->m->n_ground; k++) {
        for (int i = 0; i < x->m->ground[k].n_signal; i++) {
            const struct signal *s = &x->m->ground[k].signal[i];
            emit_note(&x->to, "ground acceleration: %s", s->name);
            const int tag = opensees_series(x, s);
            if (x->m->n_ground == 1) {
                emit_put(&x->to, "pattern", "wiiwi", "UniformExcitation", tag, 1, "-accel", tag);
                continue;
            }
            emit_pattern(&x->to, tag, tag);
            for (int g = 0; g < x->m->n_body; g++) {
                const struct building *b = &x->m->building[g];
                for (int j = 0; b->ground == k && j < b->n_dof; j++) {
                    emit_put(&x->to, "load", "innn", opensees_dof(x, b->first + j), -b->mass[j],
                             0.0, 0.0);
                }
            }
            emit_close(&x->to);
        }
    }
    for (int i = 0; i < x->m->n_load; i++) {
        const struct load *l = &x->m->load[i];
        emit_note(&x->to, "load: %s", l->signal.name);
        const int tag = opensees_series(x, &l->signal);
        emit_pattern(&x->to, tag, tag);
        emit_put(&x->to, "load", "innn", opensees_dof(x, l->dof), 1.0, 0.0, 0.0);
        emit_close(&x->to);
    }
}

static const struct building *opensees_body_of(const struct opensees *x, int dof) {
    int i = 0;
    while (dof >= x->m->building[i].first + x->m->building[i].n_dof) {
        i++;
    }
    return &x->m->building[i];
}

// The state at t = 0, from which OpenSees steps on.
static int opensees_take_state(void *context, const struct row_view *row, struct error *e) {
    struct opensees *x = context;
    (void)e;
    emit_note(&x->to, "state at t = 0");
    for (int i = 0; i < x->m->n_dof; i++) {
        const int node = opensees_dof(x, i);
        const struct building *g = opensees_body_of(x, i);
        // Accelerations of rows are total ones.
        const double value[] = {row->displacement[i], row->velocity[i],
                                row->acceleration[i] - row->ground[g->ground]};
        static const char *const name[] = {"setNodeDisp", "setNodeVel", "setNodeAccel"};
        for (int k = 0; k < 3; k++) {
            if (value[k] != 0.0) {
                emit_put(&x->to, name[k], "iinw", node, 1, value[k], "-commit");
            }
        }
    }
    return STATUS_RETRY;  // there is no need to go on
}

static int opensees_state(struct opensees *x, struct error *e) {
    const struct observer observer = {.row = opensees_take_state, .context = x};
    struct results *r = NULL;
    const int status = analysis_run(x->m, &observer, &r, e);
    results_free(r);
    return status == STATUS_RETRY ? STATUS_OK : status;
}

// A file with the time and a quantity of all floors, buildings from the left.
static void opensees_recorder(struct opensees *x, const char *file, double interval,
                              const char *what) {
    int place = 0;
    emit_begin(&x->to, "recorder");
    emit_word(&x->to, place++, "Node");
    emit_word(&x->to, place++, "-file");
    emit_word(&x->to, place++, file);
    emit_word(&x->to, place++, "-precision");
    emit_whole(&x->to, place++, 17);
    emit_word(&x->to, place++, "-time");
    emit_word(&x->to, place++, "-dT");
    emit_number(&x->to, place++, interval);
    emit_word(&x->to, place++, "-node");
    for (int i = 0; i < x->m->n_building; i++) {
        const struct building *g = &x->m->building[i];
        for (int j = 0; j < g->n_floor; j++) {
            emit_whole(&x->to, place++, opensees_dof(x, g->first + j));
        }
    }
    emit_word(&x->to, place++, "-dof");
    emit_whole(&x->to, place++, 1);
    emit_word(&x->to, place++, what);
    emit_end(&x->to);
}

// The fixed step. Adaptive steps have none: OpenSees takes short ones.
static double opensees_step(struct opensees *x, long *n, long *every) {
    enum { PER_ROW = 100 };
    const struct model *m = x->m;
    if (m->integrator != INTEGRATOR_NEWMARK || m->adaptive) {
        opensees_note(x,
                      "adaptive steps: OpenSees takes %d fixed steps of Newmark's method from "
                      "row to row",
                      PER_ROW);
        *every = PER_ROW;
        *n = (long)ceil(m->duration / m->dt * PER_ROW - 1e-6);
        return m->dt / PER_ROW;
    }
    *n = m->n_step;
    *every = m->output.every;
    return m->dt;
}

// The displacement [L] below which an iteration ends. The error of the forces is this times about
// 4 m / dt^2, so it is smaller for short steps, as far as rounding allows.
static double opensees_tolerance(const struct opensees *x, double dt) {
    const struct unit_system *u = &x->m->deck->units;
    const double step = dt * unit_size(u, dimension_time) / 1e-3;  // [ms]
    return fmin(fmax(1e-12 * step * step, 1e-15), 1e-12) / unit_size(u, dimension_length);
}

static void opensees_analysis(struct opensees *x) {
    static const char message[] = "OpenSees did not converge";
    long n, every;
    const double dt = opensees_step(x, &n, &every);
    const double last = x->m->duration - (double)(n - 1) * dt;
    const bool uneven = fabs(last - dt) > 1e-9 * dt;
    emit_note(&x->to, "analysis");
    opensees_recorder(x, "displacement.out", (double)every * dt, "disp");
    opensees_recorder(x, "velocity.out", (double)every * dt, "vel");
    emit_put(&x->to, "constraints", "w", "Transformation");
    emit_put(&x->to, "numberer", "w", "RCM");
    emit_put(&x->to, "system", "w", "BandGeneral");
    emit_put(&x->to, "test", "wni", "NormDispIncr", opensees_tolerance(x, dt), 100);
    emit_put(&x->to, "algorithm", "w", "Newton");
    if (x->m->beta == 0.0) {
        opensees_note(x, "Newmark's method with beta = 0 is CentralDifference");
        emit_put(&x->to, "integrator", "w", "CentralDifference");
    } else {
        emit_put(&x->to, "integrator", "wnn", "Newmark", x->m->gamma, x->m->beta);
    }
    emit_put(&x->to, "analysis", "w", "Transient");
    emit_put(&x->to, "record", "");
    emit_must(&x->to, "analyze", (int)(n - uneven), dt, message);
    if (uneven) {
        emit_must(&x->to, "analyze", 1, last, message);
    }
}

static void opensees_head(struct opensees *x, const char *version) {
    const struct model *m = x->m;
    emit_start(&x->to, "openseespy.opensees");
    emit_note(&x->to, "%s", m->deck->title[0] ? m->deck->title : m->deck->path);
    emit_note(&x->to, "made by jostle %s from %s; units %s, %s, %s", version, m->deck->path,
              m->deck->units.force_name, m->deck->units.length_name, m->deck->units.time_name);
    emit_note(&x->to, "node i + 1 is degree of freedom i; node %d is the ground", m->n_dof + 1);
    if (m->deck->sweeps) {
        opensees_note(x, "the deck is a study: this is the model of its first run");
    }
    if (m->collapse) {
        opensees_note(x, "collapse: OpenSees goes on when a storey reaches its limit of drift");
    }
    emit_put(&x->to, "wipe", "");
    emit_put(&x->to, "model", "wwiwi", "basic", "-ndm", 2, "-ndf", 3);
    emit_put(&x->to, "geomTransf", "wi", "Linear", 1);
    x->node = m->n_dof;
    opensees_node(x, 0.0, 0.0, 1, 1, 1);
}

int opensees_write(const struct model *m, enum emit_language language, const char *version,
                   FILE *to, FILE *notes, struct error *e) {
    struct opensees x = {
        .to = {.to = to, .language = language}, .m = m, .notes = notes, .arena = arena_create()};
    if (!x.arena) {
        return error_no_memory(e);
    }
    opensees_head(&x, version);
    for (int i = 0; i < m->n_body; i++) {
        opensees_building(&x, &m->building[i]);
    }
    for (int i = 0; i < m->n_link; i++) {
        opensees_link(&x, &m->link[i]);
    }
    opensees_ground(&x);
    int status = opensees_state(&x, e);
    opensees_analysis(&x);
    status = status == STATUS_OK && arena_failed(x.arena) ? error_no_memory(e) : status;
    arena_free(x.arena);
    return status;
}
