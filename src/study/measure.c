// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/measure.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/quantity.h"
#include "core/text.h"
#include "jostle/intensity.h"
#include "jostle/spectrum.h"
#include "motion/record_cache.h"
#include "study/origin.h"
#include "study/trial.h"
#include "study/workers.h"

// The periods of Sa_avg, evenly spaced (Eads et al. 2015, Earthquake Engng Struct. Dyn. 44,
// 2057-2073).
enum { AVERAGE_PERIODS = 20 };
static const double DAMPING = 0.05;  // where none is given

const char measure_help[] =
    "\nIntensities of the ground motion of each run, as it is scaled there:\n"
    "  PGA, PGV, PGD        peak acceleration, velocity and displacement\n"
    "  CAV, Arias           cumulative absolute velocity, Arias intensity\n"
    "  D5-75, D5-95         significant durations\n"
    "  Sa(1s), Sa(1s,2%)    pseudo-acceleration at a period; damping, default: 5 %\n"
    "  Sa_avg(0.2s:2s)      geometric mean of Sa at 20 periods\n"
    "PGA:A is that of the ground of building A. The deck and its records must be there.\n";

static const struct {
    const char *name;
    size_t at;
    struct dimension dimension;
} of_record[] = {
    {"PGA", offsetof(struct intensity, pga), OF_ACCELERATION},
    {"PGV", offsetof(struct intensity, pgv), OF_VELOCITY},
    {"PGD", offsetof(struct intensity, pgd), OF_LENGTH},
    {"CAV", offsetof(struct intensity, cav), OF_VELOCITY},
    {"Arias", offsetof(struct intensity, arias), OF_VELOCITY},
    {"D5-75", offsetof(struct intensity, d5_75), OF_TIME},
    {"D5-95", offsetof(struct intensity, d5_95), OF_TIME},
};
enum { N_OF_RECORD = sizeof of_record / sizeof of_record[0] };

// Whether a text begins with the name, in letters of either case, and either ends behind it or goes
// on with one of `ends`. NULL: the text may go on with any character.
static bool begins(const char *text, const char *name, const char *ends) {
    while (*name && tolower((unsigned char)*text) == tolower((unsigned char)*name)) {
        text++;
        name++;
    }
    return !*name && (!ends || strchr(ends, *text));  // strchr also finds the final 0
}

static int find_of_record(const char *text) {
    int i = 0;
    while (i < N_OF_RECORD && !begins(text, of_record[i].name, ":")) {
        i++;
    }
    return i;
}

bool measure_is_named(const char *text) {
    return find_of_record(text) < N_OF_RECORD || begins(text, "Sa(", NULL) ||
           begins(text, "Sa_avg(", NULL);
}

// Reads the brackets: a period or two, and a damping ratio. Returns the text behind them; NULL:
// they have something else.
static const char *read_periods(const struct unit_system *u, const char *at, struct measure *m) {
    const int n = m->kind == MEASURE_SA_AVG ? 2 : 1;
    for (int i = 0; i < n && at; i++) {
        at = *at == (i == 0 ? '(' : ':')
                 ? quantity_word(at + 1, u, &dimension_time, BARE_ALLOWED, &m->period[i])
                 : NULL;
    }
    m->damping = DAMPING;
    if (at && *at == ',') {
        at = quantity_word(at + 1 + strspn(at + 1, " "), u, &dimension_none, BARE_ALLOWED,
                           &m->damping);
    }
    const bool sound = at && *at == ')' && m->period[0] > 0.0 && isfinite(m->period[0]) &&
                       (n == 1 || (m->period[1] > m->period[0] && isfinite(m->period[1]))) &&
                       m->damping >= 0.0 && m->damping < 1.0;
    return sound ? at + 1 : NULL;
}

int measure_parse(const struct unit_system *u, const char *text, struct arena *a,
                  struct measure *out, struct error *e) {
    const int i = find_of_record(text);
    const char *end;
    char units[64];
    struct text_short t;
    *out = (struct measure){.text = arena_text(a, text, strlen(text)),
                            .dimension = dimension_acceleration};
    if (i < N_OF_RECORD) {
        out->at = of_record[i].at;
        out->dimension = of_record[i].dimension;
        end = text + strlen(of_record[i].name);
    } else {
        out->kind = begins(text, "Sa(", NULL) ? MEASURE_SA : MEASURE_SA_AVG;
        end = measure_is_named(text) ? read_periods(u, strchr(text, '('), out) : NULL;
    }
    if (!end || (*end != '\0' && (*end != ':' || end[1] == '\0'))) {
        return error_set(e, STATUS_INPUT,
                         "'%s' is no intensity; known are PGA, PGV, PGD, CAV, Arias, D5-75, D5-95, "
                         "Sa(PERIOD), Sa(PERIOD,DAMPING), Sa_avg(FROM:TO), and with a building "
                         "PGA:A",
                         text_short(&t, text));
    }
    unit_text(u, out->dimension, units, sizeof units);
    out->building = *end == ':' ? arena_text(a, end + 1, strlen(end + 1)) : NULL;
    out->units = arena_text(a, units, strlen(units));
    return arena_failed(a) ? error_no_memory(e) : STATUS_OK;
}

// The ground of the building that the measure names, or the only ground; NULL after an error.
static const struct ground *find_ground(const struct measure *m, const struct model *model,
                                        struct error *e) {
    for (int i = 0; m->building && i < model->n_building; i++) {
        if (strcmp(model->building[i].name, m->building) == 0) {
            return &model->ground[model->building[i].ground];
        }
    }
    if (m->building) {
        error_set(e, STATUS_INPUT, "%s: the deck has no building %s", m->text, m->building);
        return NULL;
    }
    if (model->n_ground > 1) {
        error_set(e, STATUS_INPUT, "%s: the buildings have different grounds; name one: %s:%s",
                  m->text, m->text, model->building[0].name);
        return NULL;
    }
    return &model->ground[0];
}

// The samples from the start of the run to its end.
static struct signal during(const struct signal *s, double duration) {
    struct signal cut = *s;
    const double last = floor((duration - s->start) / s->dt * (1.0 + 1e-12));
    if (last + 1.0 < (double)s->n) {
        cut.n = last > 0.0 ? (size_t)last + 1 : 1;
    }
    return cut;
}

static double average(const struct measure *m, const struct signal *ground) {
    double sum = 0.0;
    for (int i = 0; i < AVERAGE_PERIODS; i++) {
        const double t = (double)i / (AVERAGE_PERIODS - 1);
        const double period = m->period[0] + t * (m->period[1] - m->period[0]);
        sum += log(spectrum_at(ground, period, m->damping).value[SPECTRUM_PSA]);
    }
    return exp(sum / AVERAGE_PERIODS);
}

int measure_of(const struct measure *m, const struct model *model, double *out, struct error *e) {
    const struct ground *g = find_ground(m, model, e);
    if (!g) {
        return STATUS_INPUT;
    }
    if (g->n_signal != 1 || !g->signal[0].value) {
        return error_set(e, STATUS_INPUT, "%s: the ground is not a single record, but %s", m->text,
                         g->n_signal == 0  ? "at rest"
                         : g->n_signal > 1 ? "a sum of motions"
                                           : g->signal[0].name);
    }
    const struct signal ground = during(&g->signal[0], model->duration);
    if (m->kind == MEASURE_SA) {
        *out = spectrum_at(&ground, m->period[0], m->damping).value[SPECTRUM_PSA];
    } else if (m->kind == MEASURE_SA_AVG) {
        *out = average(m, &ground);
    } else {
        const struct intensity all = intensity_of(&ground, 1.0 / unit_in_g(&model->deck->units));
        *out = *(const double *)((const char *)&all + m->at);
    }
    return STATUS_OK;
}

struct measuring {
    const struct study_view *view;
    const struct measure_request *request;
    const struct measure *measure;
    int n;
    double *value;
    struct plan plan;
    struct manifest manifest;
    struct record_cache *records;
};

// The run that a thread measures.
struct measured {
    const struct measuring *of;
    long run;       // in the study
    double *value;  // (n)
};

static int measure_model(void *context, const struct model *m, struct study_outcome *outcome,
                         struct error *e) {
    const struct measured *r = context;
    (void)outcome;
    for (int i = 0; i < r->of->n; i++) {
        if (measure_of(&r->of->measure[i], m, &r->value[i], e) != STATUS_OK) {
            const struct error cause = *e;
            struct plan_text t;
            return error_set(e, STATUS_INPUT, "%s: %s", plan_describe(&r->of->plan, r->run, &t),
                             cause.message);
        }
    }
    return STATUS_OK;
}

static int work(void *context, struct workers *w, long job, void *scratch, struct error *e) {
    const struct measuring *s = context;
    const struct trial_watch watch = {.records = s->records};
    struct measured run = {s, study_view_run(s->view, job), s->value + job * s->n};
    struct study_outcome outcome;
    (void)w, (void)scratch;
    for (int i = 0; i < s->n; i++) {
        run.value[i] = NAN;
    }
    return trial_build(&s->plan, run.run, &watch, measure_model, &run, &outcome, e);
}

static int poll(void *context, struct workers *w, long n_done, struct error *e) {
    const struct measure_request *q = ((const struct measuring *)context)->request;
    (void)w;
    return q->poll ? q->poll(q->context, n_done, e) : STATUS_OK;
}

static int measure_all(struct measuring *s, struct error *e) {
    const struct workers_request request = {.n_thread = s->request->n_thread,
                                            .scratch = 1,
                                            .n_job = s->view->n_run,
                                            .work = work,
                                            .poll = poll,
                                            .context = s};
    int status = origin_check(&s->manifest, &s->plan, s->view, e);
    s->records = record_cache_create(RECORD_CACHE_BYTES);
    status = status == STATUS_OK && !s->records ? error_no_memory(e) : status;
    return status == STATUS_OK ? workers_run(&request, e) : status;
}

int measure_runs(const struct study_view *v, const struct measure_request *q,
                 const struct measure *measure, int n, double *value, struct error *e) {
    struct measuring s = {.view = v, .request = q, .measure = measure, .n = n, .value = value};
    const struct study_request study = {
        .first = q->first, .define = q->define, .n_define = q->n_define, .result = {.version = ""}};
    int status = plan_init(&s.plan, &study, e);
    if (status != STATUS_OK) {
        return status;
    }
    status = manifest_init(&s.manifest, q->first->deck->path, e);
    status = status == STATUS_OK ? measure_all(&s, e) : status;
    record_cache_free(s.records);
    manifest_close(&s.manifest);
    plan_close(&s.plan);
    return status;
}
