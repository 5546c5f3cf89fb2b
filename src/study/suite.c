// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/suite.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/arena.h"
#include "study/demands.h"
#include "study/percentile.h"
#include "study/roles.h"

// A suite while it is made.
struct maker {
    struct suite *s;
    struct roles roles;
    double *value, *reached;
    bool *hit, *collapsed;
    long *row, n_row;  // of the file; those read
    int *place;        // (values of the abscissa) the place of each among the points
    bool no_memory;
};

static void *take(struct maker *m, size_t n, size_t size) {
    void *p = arena_alloc(m->s->arena, n, size);
    m->no_memory |= !p;
    return p;
}

static const char *append(struct maker *m, const char *text, const char *more) {
    const char *all = arena_format(m->s->arena, "%s%s", text, more);
    m->no_memory |= !all;
    return all ? all : "";
}

static const char *append_value(struct maker *m, const char *text, const struct sweep *s, int k) {
    char number[40];
    snprintf(number, sizeof number, "%.6g", s->number ? s->number[k] : 0.0);
    return append(m, text, s->number ? number : s->label[k]);
}

static const char *append_pair(struct maker *m, const char *text, const struct sweep *s, int k,
                               const char *equals) {
    const char *units = unit_suffix(s->units);
    text = append_value(m, append(m, append(m, text, s->name), equals), s, k);
    return units[0] ? append(m, append(m, text, " "), units) : text;
}

// Appends "NAME = VALUE UNIT" or "NAME VALUE", and in brackets those of what goes together along
// it.
static const char *append_choice(struct maker *m, const char *text, int sweep, int k,
                                 const char *equals) {
    const struct sweep *s = m->s->view->sweep[sweep], *along = sweep_named(s->along);
    text = append_pair(m, text[0] ? append(m, text, ", ") : text, s, k, equals);
    const char *before = " (";
    for (const struct sweep *p = along; p; p = sweep_named(p->along)) {
        text = append_pair(m, append(m, text, before), p, k, equals);
        before = ", ";
    }
    return along ? append(m, text, ")") : text;
}

// The number of a run among the values of the sweeps of a role.
static int index_of(const struct maker *m, enum role role, const int *k) {
    int index = 0;
    for (int i = 0; i < m->s->view->n_sweep; i++) {
        if (m->roles.role[i] == role) {
            index = index * m->s->view->sweep[i]->n + k[i];
        }
    }
    return index;
}

// Names of all values of the sweeps of a role.
static const char *const *name_all(struct maker *m, enum role role, int n, const char *equals) {
    const struct study_view *v = m->s->view;
    const char **name = take(m, (size_t)n, sizeof *name);
    for (int at = 0; name && at < n; at++) {
        int k[STUDY_SWEEPS_MAX] = {0};
        int rest = at;
        for (int i = v->n_sweep - 1; i >= 0; i--) {
            if (m->roles.role[i] == role) {
                k[i] = rest % v->sweep[i]->n;
                rest /= v->sweep[i]->n;
            }
        }
        name[at] = "";
        for (int i = 0; i < v->n_sweep; i++) {
            if (m->roles.role[i] == role) {
                name[at] = append_choice(m, name[at], i, k[i], equals);
            }
        }
    }
    return name;
}

static void name_roles(struct maker *m) {
    struct suite *s = m->s;
    const struct study_view *v = s->view;
    int *group_sweep = take(m, (size_t)v->n_sweep, sizeof *group_sweep);
    s->group_sweep = group_sweep;
    s->over = s->fixed = "";
    for (int i = 0; i < v->n_sweep; i++) {
        if (m->roles.role[i] == ROLE_SAMPLE) {
            s->over = arena_format(s->arena, "%s%s%s", s->over, s->over[0] ? ", " : "",
                                   v->sweep[i]->name);
            m->no_memory |= !s->over;
            s->over = s->over ? s->over : "";
        } else if (m->roles.role[i] == ROLE_FIXED) {
            s->fixed = append_choice(m, s->fixed, i, m->roles.fixed[i], " = ");
        } else if (m->roles.role[i] == ROLE_GROUP && group_sweep) {
            group_sweep[s->n_group_sweep++] = i;
        }
    }
    s->sample = name_all(m, ROLE_SAMPLE, s->n_sample, " ");
    s->group = name_all(m, ROLE_GROUP, s->n_group, " = ");
}

// Points in ascending order of their numbers; texts in the order of the deck.
static void order_points(struct maker *m) {
    struct suite *s = m->s;
    const size_t n = (size_t)s->n_point;
    size_t *sorted = take(m, n, sizeof *sorted);
    int *order = take(m, n, sizeof *order);
    double *point = take(m, n, sizeof *point);
    m->place = take(m, n, sizeof *m->place);
    if (m->no_memory) {
        return;
    }
    for (size_t i = 0; i < n; i++) {
        sorted[i] = i;
    }
    if (s->abscissa->number) {
        gsl_sort_index(sorted, s->abscissa->number, 1, n);
    }
    for (size_t i = 0; i < n; i++) {
        order[i] = (int)sorted[i];
        point[i] = s->abscissa->number ? s->abscissa->number[order[i]] : (double)i + 1.0;
        m->place[order[i]] = (int)i;
    }
    s->order = order;
    s->point = point;
}

// The numbers of a dimension, with the values of what goes together along it.
static void name_numbers(struct maker *m, const struct sweep *along) {
    struct suite *s = m->s;
    const char **name = take(m, (size_t)s->n_point, sizeof *name);
    for (int k = 0; name && k < s->n_point; k++) {
        name[k] = append_value(m, "", s->abscissa, k);
    }
    const char *title = s->abscissa->name, *before = ": ";
    for (const struct sweep *p = along; name && p; p = sweep_named(p->along)) {
        for (int k = 0; k < s->n_point; k++) {
            name[k] = append_value(m, append(m, name[k], before), p, k);
        }
        const char *units = unit_suffix(p->units);
        title = append(m, append(m, title, before), p->name);
        title = units[0] ? append(m, append(m, append(m, title, " ["), units), "]") : title;
        before = ", ";
    }
    s->point_name = name;
    s->point_title = title;
}

static void name_failed(struct maker *m, long run, const int *k, const char *why) {
    struct suite *s = m->s;
    if (s->n_failed++ >= SUITE_NAMED_MAX) {
        return;
    }
    const char *values = "";
    for (int i = 0; i < s->view->n_sweep; i++) {
        values = append_choice(m, values, i, k[i], " = ");
    }
    const char *all = arena_format(s->arena, "run %ld (%s): %s", run + 1, values, why);
    m->no_memory |= !all;
    s->failed[s->n_failed - 1] = all;
}

static int take_run(void *context, const struct study_run *r, struct error *e) {
    struct maker *m = context;
    struct suite *s = m->s;
    const struct study_outcome *outcome = r->outcome;
    const long row = m->n_row++;
    int k[STUDY_SWEEPS_MAX];
    bool looked_at = outcome->status == STUDY_DONE || outcome->status == STUDY_FAILED;
    for (int i = 0; i < s->view->n_sweep; i++) {
        k[i] = study_view_choice(s->view, r->number, i);
        looked_at = looked_at && (m->roles.role[i] != ROLE_FIXED || k[i] == m->roles.fixed[i]);
    }
    if (!looked_at) {
        return STATUS_OK;
    }
    s->n_missing--;
    const size_t sample = (size_t)index_of(m, ROLE_SAMPLE, k);
    const size_t group = (size_t)index_of(m, ROLE_GROUP, k);
    const size_t at = (group * (size_t)s->n_sample + sample) * (size_t)s->n_point +
                      (size_t)m->place[k[m->roles.abscissa]];
    int place;
    m->row[at] = row;
    m->value[at] = edp_value(&s->edp, r->value, &place);
    m->reached[at] = m->value[at];
    m->collapsed[at] = outcome->status == STUDY_DONE && edp_collapsed(s->view, r->value);
    s->n_collapsed += m->collapsed[at];
    if (m->collapsed[at] &&
        (s->edp.quantity->owner == EDP_OF_BUILDING || edp_is_collapse(&s->edp))) {
        m->value[at] = INFINITY;
        return STATUS_OK;
    }
    if (outcome->status == STUDY_DONE && isfinite(m->value[at])) {
        m->hit[at] = edp_hit(&s->edp, s->view, place, r->value) > 0;
        s->n_hit += m->hit[at];
        return STATUS_OK;
    }
    if (outcome->status == STUDY_DONE && isnan(m->value[at])) {
        return edp_absent(&s->edp, place, e);
    }
    m->value[at] = s->rule == SUITE_FAILED_ABOVE ? INFINITY : NAN;
    name_failed(m, r->number, k,
                outcome->status == STUDY_DONE ? "its value is not finite" : outcome->message);
    return STATUS_OK;
}

static int make(struct maker *m, struct study_file *f, const struct suite_request *q,
                struct error *e) {
    struct suite *s = m->s;
    const struct study_view *v = s->view;
    int status = demands_find(f, q->edp, s->arena, &s->edp, e);
    if (status == STATUS_OK) {
        status = roles_find(v, q, &m->roles, e);
    }
    if (status != STATUS_OK) {
        return status;
    }
    const struct sweep *dimension = v->sweep[m->roles.abscissa];
    s->abscissa = m->roles.along;
    s->is_intensity = m->roles.is_intensity;
    s->im = s->abscissa->name;
    s->abscissa_dimension = edp_units(s->abscissa->units, v->units.gravity, &s->abscissa_size);
    s->abscissa_units =
        dimension_equal(s->abscissa_dimension, dimension_none) ? "" : s->abscissa->units;
    // Why other things change along the abscissa, too.
    s->mixed =
        s->abscissa != dimension
            ? (s->abscissa->random ? "a random parameter" : "a sweep that is paired with others")
        : sweep_named(dimension->along) ? "a dimension of paired sweeps"
                                        : NULL;
    s->n_point = s->abscissa->n;
    s->n_sample = roles_count(v, &m->roles, ROLE_SAMPLE);
    s->n_group = roles_count(v, &m->roles, ROLE_GROUP);
    s->n_run = (long)s->n_point * s->n_sample * s->n_group;
    s->value = m->value = take(m, (size_t)s->n_run, sizeof *m->value);
    s->reached = m->reached = take(m, (size_t)s->n_run, sizeof *m->reached);
    s->collapsed = m->collapsed = take(m, (size_t)s->n_run, sizeof *m->collapsed);
    s->hit = m->hit = take(m, (size_t)s->n_run, sizeof *m->hit);
    s->row = m->row = take(m, (size_t)s->n_run, sizeof *m->row);
    order_points(m);
    s->n_missing = s->n_run;
    for (long i = 0; !m->no_memory && i < s->n_run; i++) {
        m->value[i] = m->reached[i] = NAN;
        m->row[i] = -1;
    }
    if (!m->no_memory) {
        name_roles(m);
        const struct sweep *along = sweep_named(s->abscissa->along);
        if (!s->abscissa->number) {
            s->point_name = s->abscissa->label;
            s->point_title = s->abscissa->name;
        } else if (along && s->abscissa == v->sweep[m->roles.abscissa]) {
            name_numbers(m, along);
        }
    }
    if (!m->no_memory) {
        status = study_file_each(f, take_run, m, e);
    }
    return m->no_memory ? error_no_memory(e) : status;
}

int suite_create(struct study_file *f, const struct suite_request *q, struct suite **out,
                 struct error *e) {
    struct arena *a = arena_create();
    struct suite *s = a ? arena_alloc(a, 1, sizeof *s) : NULL;
    if (!s) {
        arena_free(a);
        return error_no_memory(e);
    }
    *s = (struct suite){.arena = a, .view = study_file_view(f), .rule = q->failed};
    struct maker m = {.s = s};
    int status = make(&m, f, q, e);
    if (status != STATUS_OK) {
        arena_free(a);
        return status;
    }
    *out = s;
    return STATUS_OK;
}

void suite_free(struct suite *s) {
    if (s) {
        arena_free(s->arena);
    }
}

int suite_measure(struct suite *s, const struct measure *m, const double *value, struct error *e) {
    double *intensity = arena_alloc(s->arena, (size_t)s->n_run, sizeof *intensity);
    double *demand = arena_alloc(s->arena, (size_t)s->n_run, sizeof *demand);
    if (!intensity || !demand) {
        return error_no_memory(e);
    }
    for (long i = 0; i < s->n_run; i++) {
        const double x = s->row[i] < 0 ? NAN : value[s->row[i]];
        intensity[i] = isnan(x) ? 0.0 : x;
        demand[i] = isnan(x) ? NAN : s->value[i];
        s->n_unplaced += isnan(x) && !isnan(s->value[i]);
    }
    s->intensity = intensity;
    s->value = demand;
    s->im = m->text;
    s->is_intensity = true;
    s->abscissa_dimension = edp_units(m->units, s->view->units.gravity, &s->abscissa_size);
    s->abscissa_units = unit_suffix(m->units);
    return STATUS_OK;
}

int suite_group_choice(const struct suite *s, int group, int i) {
    for (int k = s->n_group_sweep - 1; k > i; k--) {
        group /= s->view->sweep[s->group_sweep[k]]->n;
    }
    return group % s->view->sweep[s->group_sweep[i]]->n;
}

static size_t place_of(const struct suite *s, int group, int sample, int point) {
    const size_t row = (size_t)group * (size_t)s->n_sample + (size_t)sample;
    return row * (size_t)s->n_point + (size_t)point;
}

double suite_intensity(const struct suite *s, int group, int sample, int point) {
    return s->intensity ? s->intensity[place_of(s, group, sample, point)] : s->point[point];
}

double suite_value(const struct suite *s, int group, int sample, int point) {
    return s->value[place_of(s, group, sample, point)];
}

double suite_reached(const struct suite *s, int group, int sample, int point) {
    return s->reached[place_of(s, group, sample, point)];
}

bool suite_collapsed(const struct suite *s, int group, int sample, int point) {
    return s->collapsed[place_of(s, group, sample, point)];
}

bool suite_hit(const struct suite *s, int group, int sample, int point) {
    return s->hit[place_of(s, group, sample, point)];
}

int suite_samples(const struct suite *s, int group, int point, double *value) {
    size_t n = 0;
    for (int k = 0; k < s->n_sample; k++) {
        const double x = suite_value(s, group, k, point);
        if (!isnan(x)) {
            value[n++] = x;
        }
    }
    gsl_sort(value, 1, n);
    return (int)n;
}

double suite_percentile(const struct suite *s, int group, int point, double fraction,
                        double *work) {
    const int n = suite_samples(s, group, point, work);
    return n > 0 ? percentile_sorted(work, (size_t)n, fraction) : NAN;
}
