// SPDX-License-Identifier: GPL-3.0-or-later
// Integrates x'' = -F with the Runge-Kutta method of Prince & Dormand, 8(7), of the GSL. The units
// are the approach velocity v0, the effective mass m and a length L at which the force of the law
// is about m v0^2 / L.
//
// Laws change their branch at v = 0. So an impact is a sequence of phases of approach and release.
// Within a phase, the law is evaluated only at velocities of the sign of the phase. A step that
// passes v = 0 or d = 0 is taken again with the length that ends there. Then the history is
// committed. The first steps are very short, because the force of some laws has an infinite slope
// at closure. The root of dF/dt = dF/dd v - dF/dv F/m gives the peak of the force within a step.
//
// Impulse and energy follow from the velocities: m (v0 + v1) and m (v0^2 - v1^2) / 2.
#include "law/isolated.h"

#include <assert.h>
#include <float.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <string.h>

#include "core/root.h"

enum { DEPTH, SPEED, N_STATE };  // penetration and velocity in units of L and v0

// Tolerance of a step, and the first and the longest one in units of L / v0.
struct accuracy {
    double tolerance, first_step, longest_step;
    bool peaks;  // true: finds the peak of the force
};
static const struct accuracy full = {1e-13, 1e-12, 0.02, true}, rough = {1e-8, 1e-4, 0.2, false};

static const double JUMP = 1e-9;  // share of the peak force: a larger jump gives two points
enum { STEPS_MAX = 200000 };

enum phase { APPROACH, RELEASE };

// An impact in progress.
struct flight {
    const struct contact_law *law;
    const double *constant;
    double history[CONTACT_HISTORY_MAX];
    double mass, velocity, length;
    const struct accuracy *accuracy;
    enum phase phase;

    gsl_odeiv2_system system;
    gsl_odeiv2_step *step;
    gsl_odeiv2_control *control;
    gsl_odeiv2_evolve *evolve;
    double time, state[N_STATE];    // present instant, in units of L / v0
    double before, start[N_STATE];  // at the start of the last step
    double next_step;

    const struct isolated_observer *observer;
    int n_sampled;  // instants that the observer has seen
    double peak_force, deepest;
};

// The law at a state, on the branch of the phase.
static struct contact_response response(const struct flight *f, const double *state) {
    double v = f->velocity * state[SPEED];
    v = f->phase == APPROACH ? fmax(v, DBL_MIN) : fmin(v, -DBL_MIN);
    return f->law->force(f->constant, f->history, f->length * fmax(state[DEPTH], 0.0), v);
}

static int rates(double time, const double state[], double rate[], void *context) {
    (void)time;
    const struct flight *f = context;
    rate[DEPTH] = state[SPEED];
    rate[SPEED] = -response(f, state).force * f->length / (f->mass * f->velocity * f->velocity);
    return isfinite(rate[SPEED]) ? GSL_SUCCESS : GSL_EBADFUNC;
}

// dF/dt at a state.
static double force_rate(const struct flight *f, const double *state) {
    struct contact_response r = response(f, state);
    return r.dfdd * f->velocity * state[SPEED] - r.dfdv * r.force / f->mass;
}

// Takes the last step again with length h, into `state`.
static void retake(const struct flight *f, double h, double *state) {
    double error[N_STATE];
    memcpy(state, f->start, sizeof f->start);
    if (h > 0.0 && gsl_odeiv2_step_apply(f->step, f->before, h, state, error, NULL, NULL,
                                         &f->system) != GSL_SUCCESS) {
        state[DEPTH] = state[SPEED] = NAN;
    }
}

static double depth_after(double h, void *context) {
    double state[N_STATE];
    retake(context, h, state);
    return state[DEPTH];
}

static double speed_after(double h, void *context) {
    double state[N_STATE];
    retake(context, h, state);
    return state[SPEED];
}

static double force_rate_after(double h, void *context) {
    double state[N_STATE];
    retake(context, h, state);
    return force_rate(context, state);
}

// The length of the last step at which `function` passes zero.
static double locate(struct flight *f, double (*function)(double h, void *context)) {
    return root_find(function, f, 0.0, f->time - f->before, DBL_EPSILON);
}

static void note_peak(struct flight *f) {
    f->peak_force = fmax(f->peak_force, response(f, f->state).force);
    f->deepest = fmax(f->deepest, f->state[DEPTH]);
    if (f->time > f->before && force_rate(f, f->start) > 0.0 && force_rate(f, f->state) < 0.0) {
        double state[N_STATE];
        retake(f, locate(f, force_rate_after), state);
        f->peak_force = fmax(f->peak_force, response(f, state).force);
    }
}

static struct isolated_point point_at(const struct flight *f, double time, const double *state) {
    return (struct isolated_point){
        .time = time * f->length / f->velocity,
        .penetration = f->length * fmax(state[DEPTH], 0.0),
        .velocity = f->velocity * state[SPEED],
        .force = response(f, state).force,
        .rate = force_rate(f, state),
    };
}

// Calls the observer for the requested instants in the last step.
static void show_samples(struct flight *f) {
    const struct isolated_observer *o = f->observer;
    for (; f->n_sampled < o->n_time; f->n_sampled++) {
        double time = o->time[f->n_sampled] * f->velocity / f->length;
        if (time > f->time) {
            return;
        }
        double state[N_STATE];
        retake(f, time - f->before, state);
        struct isolated_point point = point_at(f, time, state);
        o->sample(o->context, f->n_sampled, &point);
    }
}

static void show(const struct flight *f) {
    struct isolated_point point = point_at(f, f->time, f->state);
    f->observer->point(f->observer->context, &point);
}

// Accepts the state: peak, history, observer.
static void accept(struct flight *f) {
    if (f->accuracy->peaks) {
        note_peak(f);
    }
    if (f->observer) {
        show_samples(f);
    }
    if (f->law->commit) {
        f->law->commit(f->constant, f->history, f->length * fmax(f->state[DEPTH], 0.0),
                       f->velocity * f->state[SPEED]);
    }
    if (f->observer) {
        show(f);
    }
}

// Changes to the other phase. The force may jump here.
static void turn(struct flight *f) {
    const double before = response(f, f->state).force;
    f->phase = f->phase == APPROACH ? RELEASE : APPROACH;
    if (f->observer && fabs(response(f, f->state).force - before) > JUMP * f->peak_force) {
        show(f);
    }
}

// Shortens the last step to the zero of `function`. False: not found.
static bool cut(struct flight *f, double (*function)(double h, void *context)) {
    double h = locate(f, function);
    retake(f, h, f->state);
    f->time = f->before + h;
    gsl_odeiv2_evolve_reset(f->evolve);
    return isfinite(f->state[DEPTH]) && isfinite(f->state[SPEED]);
}

// Takes one step, at most to the end of the phase. *parted: the step ended at d = 0.
static bool advance(struct flight *f, bool *parted) {
    f->before = f->time;
    memcpy(f->start, f->state, sizeof f->state);
    f->next_step = fmin(f->next_step, f->accuracy->longest_step);
    if (gsl_odeiv2_evolve_apply(f->evolve, f->control, f->step, &f->system, &f->time, INFINITY,
                                &f->next_step, f->state) != GSL_SUCCESS) {
        return false;
    }
    bool turned = f->phase == APPROACH ? f->state[SPEED] < 0.0 : f->state[SPEED] > 0.0;
    if (turned && !cut(f, speed_after)) {
        return false;
    }
    *parted = f->state[DEPTH] <= 0.0;
    if (*parted && !cut(f, depth_after)) {
        return false;
    }
    accept(f);
    if (turned && !*parted) {
        turn(f);
    }
    return true;
}

static int fly(struct flight *f, struct error *e) {
    bool parted = false;
    accept(f);
    for (int i = 0; i < STEPS_MAX && !parted; i++) {
        if (!advance(f, &parted)) {
            return error_set(e, STATUS_FAILED,
                             "the impact under %s cannot be followed beyond %.6g after closure",
                             f->law->name, f->before * f->length / f->velocity);
        }
    }
    if (!parted) {
        return error_set(e, STATUS_FAILED,
                         "under %s the bodies have not separated %.6g after closure", f->law->name,
                         f->time * f->length / f->velocity);
    }
    return STATUS_OK;
}

// A power of 2 near the L with F(L) L = m v0^2. 0: the law has no such L.
static double find_length(const struct flight *f) {
    double energy = f->mass * f->velocity * f->velocity;
    double length = 1.0;
    while (length > 0.0 &&
           f->law->force(f->constant, f->history, length, 0.0).force * length > energy) {
        length /= 2.0;
    }
    while (isfinite(length) &&
           f->law->force(f->constant, f->history, length, 0.0).force * length < energy) {
        length *= 2.0;
    }
    return isfinite(length) ? length : 0.0;
}

static void summarise(const struct flight *f, struct isolated_impact *out) {
    double e = -f->state[SPEED];
    double momentum = f->mass * f->velocity;
    *out = (struct isolated_impact){
        .restitution = e,
        .peak_force = f->peak_force,
        .duration = f->time * f->length / f->velocity,
        .max_penetration = f->deepest * f->length,
        .impulse = momentum * (1.0 + e),
        .dissipated = momentum * f->velocity * (1.0 - e) * (1.0 + e) / 2.0,
    };
}

static bool allocate(struct flight *f) {
    f->system = (gsl_odeiv2_system){.function = rates, .dimension = N_STATE, .params = f};
    f->step = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, N_STATE);
    f->control = gsl_odeiv2_control_y_new(f->accuracy->tolerance, f->accuracy->tolerance);
    f->evolve = gsl_odeiv2_evolve_alloc(N_STATE);
    return f->step && f->control && f->evolve;
}

// An impact under a law without a force has no duration.
static void rigid(const struct contact_law *law, const double *constant, double mass,
                  double velocity, const struct isolated_observer *observer,
                  struct isolated_impact *out) {
    double rebound = law->rebound(constant, velocity);
    *out = (struct isolated_impact){
        .restitution = rebound / velocity,
        .peak_force = NAN,
        .impulse = mass * (velocity + rebound),
        .dissipated = mass * (velocity - rebound) * (velocity + rebound) / 2.0,
    };
    for (int i = 0; observer && i < 2; i++) {
        struct isolated_point point = {.velocity = i == 0 ? velocity : -rebound, .force = NAN};
        observer->point(observer->context, &point);
    }
}

// Computes the impact of a flight. Its law, constants, mass and velocity are given, and whether
// peaks and an observer are needed.
static int follow(struct flight *f, struct isolated_impact *out, struct error *e) {
    f->state[SPEED] = f->start[SPEED] = 1.0;
    f->next_step = f->accuracy->first_step;
    if (f->law->close) {
        f->law->close(f->constant, f->velocity, f->history);
    }
    f->length = find_length(f);
    if (f->length == 0.0) {
        return error_set(e, STATUS_FAILED, "%s has no force to separate the bodies", f->law->name);
    }
    int status = allocate(f) ? fly(f, e) : error_no_memory(e);
    if (status == STATUS_OK) {
        summarise(f, out);
    }
    if (f->evolve) {
        gsl_odeiv2_evolve_free(f->evolve);
    }
    if (f->control) {
        gsl_odeiv2_control_free(f->control);
    }
    if (f->step) {
        gsl_odeiv2_step_free(f->step);
    }
    return status;
}

int isolated_run(const struct contact_law *law, const double *constant, double mass,
                 double velocity, const struct isolated_observer *observer,
                 struct isolated_impact *out, struct error *e) {
    assert(law && constant && mass >= 0.0 && velocity > 0.0);
    if (law->rebound) {
        rigid(law, constant, mass, velocity, observer, out);
        return STATUS_OK;
    }
    struct flight f = {.law = law,
                       .constant = constant,
                       .mass = mass,
                       .velocity = velocity,
                       .accuracy = &full,
                       .observer = observer};
    return follow(&f, out, e);
}

int isolated_duration(const struct contact_law *law, const double *constant, double mass,
                      double velocity, double *out, struct error *e) {
    assert(law && constant && mass >= 0.0 && velocity > 0.0);
    struct isolated_impact impact = {.duration = 0.0};
    struct flight f = {
        .law = law, .constant = constant, .mass = mass, .velocity = velocity, .accuracy = &rough};
    int status = law->rebound ? STATUS_OK : follow(&f, &impact, e);
    *out = status == STATUS_OK ? impact.duration : NAN;
    return status;
}
