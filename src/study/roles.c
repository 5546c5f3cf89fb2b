// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/roles.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/text.h"

// Values typed by hand may differ from those of a range in their last digits.
static const double SAME_VALUE = 1e-9;

const struct sweep *roles_find_name(const struct study_view *v, const char *name, size_t n,
                                    int *sweep) {
    for (*sweep = 0; *sweep < v->n_sweep; ++*sweep) {
        for (const struct sweep *p = v->sweep[*sweep]; p; p = p->along) {
            if (strlen(p->name) == n && strncmp(p->name, name, n) == 0) {
                return p;
            }
        }
    }
    return NULL;
}

static int report_unknown(const struct study_view *v, const char *name, size_t n,
                          const char *option, struct error *e) {
    char list[256] = "";
    for (int i = 0; i < v->n_sweep; i++) {
        const size_t used = strlen(list);
        snprintf(list + used, sizeof list - used, "%s%s", used ? ", " : "", v->sweep[i]->name);
    }
    return error_set(e, STATUS_INPUT, "%s: the study has no sweep '%.*s'; there are %s", option,
                     (int)n, name, list);
}

// The sweep of this name, or one that goes together with others, along a dimension; NULL after an
// error.
static const struct sweep *find_sweep(const struct study_view *v, const char *name, size_t n,
                                      const char *option, int *sweep, struct error *e) {
    const struct sweep *s = roles_find_name(v, name, n, sweep);
    if (!s) {
        report_unknown(v, name, n, option, e);
    } else if (s->random) {
        error_set(e, STATUS_INPUT, "%s: '%s' is a random parameter; name its sweep '%s'", option,
                  s->name, v->sweep[*sweep]->name);
    }
    return s && !s->random ? s : NULL;
}

static int set_role(const struct study_view *v, struct roles *r, int sweep, enum role role,
                    struct error *e) {
    if (r->role[sweep] != ROLE_GROUP) {
        return error_set(e, STATUS_INPUT, "sweep '%s' is named for two different parts",
                         v->sweep[sweep]->name);
    }
    r->role[sweep] = role;
    return STATUS_OK;
}

// The index of the only number that tables show so, by six digits; -1: there is none, or several.
static int find_shown(const struct sweep *s, const char *text) {
    int found = -1;
    for (int i = 0; i < s->n; i++) {
        char shown[32];
        snprintf(shown, sizeof shown, "%.6g", s->number[i]);
        if (strcmp(shown, text) == 0) {
            if (found >= 0) {
                return -1;
            }
            found = i;
        }
    }
    return found;
}

// The index of a number as typed, with or without a unit, among those of a sweep; -1: it is none.
static int find_number(const struct study_view *v, const struct sweep *s, const char *text) {
    const char *end, *behind;
    struct dimension dimension;
    double value, size, own;
    if (text_number(text, &end, &value) != TEXT_NUMBER_OK) {
        return -1;
    }
    const struct dimension wanted = edp_units(s->units, v->units.gravity, &own);
    if (*end != '\0') {
        if (!unit_parse(end, v->units.gravity, &behind, &dimension, &size) || *behind != '\0' ||
            !dimension_equal(dimension, wanted)) {
            return -1;
        }
        value = unit_convert(value, size, own);
    }
    for (int i = 0; i < s->n; i++) {
        if (fabs(s->number[i] - value) <= SAME_VALUE * fabs(s->number[i])) {
            return i;
        }
    }
    return *end == '\0' ? find_shown(s, text) : -1;
}

// The index of a label, but for the one at `other`; -1: it is none.
static int find_label(const struct sweep *s, const char *text, int other) {
    for (int i = 0; i < s->n; i++) {
        if (i != other && strcmp(s->label[i], text) == 0) {
            return i;
        }
    }
    return -1;
}

// Whether a value stands elsewhere, too.
static bool is_repeated(const struct sweep *s, int k) {
    bool repeated = !s->number && find_label(s, s->label[k], k) >= 0;
    for (int i = 0; s->number && i < s->n; i++) {
        repeated = repeated || (i != k && s->number[i] == s->number[k]);
    }
    return repeated;
}

static int report_value(const struct sweep *s, const char *text, struct error *e) {
    if (s->number) {
        return error_set(e, STATUS_INPUT, "--at %s: '%s' has %d values, from %.9g to %.9g %s", text,
                         s->name, s->n, s->number[0], s->number[s->n - 1], s->units);
    }
    return error_set(e, STATUS_INPUT, "--at %s: '%s' has %d values: %s%s%s", text, s->name, s->n,
                     s->label[0], s->n > 1 ? " ... " : "", s->n > 1 ? s->label[s->n - 1] : "");
}

static int fix(const struct study_view *v, const char *text, struct roles *r, struct error *e) {
    const size_t n = strcspn(text, "=");
    if (text[n] == '\0') {
        return error_set(e, STATUS_INPUT, "--at takes NAME=VALUE, not '%s'", text);
    }
    int i;
    const struct sweep *s = find_sweep(v, text, n, "--at", &i, e);
    if (!s) {
        return STATUS_INPUT;
    }
    r->fixed[i] = s->number ? find_number(v, s, text + n + 1) : find_label(s, text + n + 1, -1);
    if (r->fixed[i] < 0) {
        return report_value(s, text, e);
    }
    if (is_repeated(s, r->fixed[i])) {
        return error_set(e, STATUS_INPUT,
                         "--at %s: this occurs more than once; give a number of '%s'", text,
                         v->sweep[i]->name);
    }
    return set_role(v, r, i, ROLE_FIXED, e);
}

static int take_samples(const struct study_view *v, const char *over, struct roles *r,
                        struct error *e) {
    for (const char *at = over; *at; at += strspn(at, ",")) {
        const size_t n = strcspn(at, ",");
        int i;
        const bool found = find_sweep(v, at, n, "--over", &i, e);
        int status = found ? set_role(v, r, i, ROLE_SAMPLE, e) : STATUS_INPUT;
        if (status != STATUS_OK) {
            return status;
        }
        at += n;
    }
    return STATUS_OK;
}

// Whether the sweep, or one of those that go together along it, has texts.
static bool has_texts(const struct sweep *s) {
    while (s && s->number) {
        s = s->along;
    }
    return s;
}

static bool has_random(const struct sweep *s) {
    while (s && !s->random) {
        s = s->along;
    }
    return s;
}

// Whether it has the name, or, where texts are looked for, one along it has.
enum value_kind { VALUES_TEXT, VALUES_NUMBER };
static bool is_called(const struct sweep *s, const char *name, enum value_kind kind) {
    const bool own = strcmp(s->name, name) == 0;
    const struct sweep *p = kind == VALUES_TEXT ? s->along : NULL;
    while (p && strcmp(p->name, name) != 0) {
        p = p->along;
    }
    return own || p;
}

// The first sweep still free that has one of these names, else the only one that is free among
// those of texts (or of numbers, but for those that count what goes together); -1.
static int guess(const struct study_view *v, const struct roles *r, const char *const *name,
                 enum value_kind kind) {
    int only = -1, n = 0;
    for (int i = 0; i < v->n_sweep; i++) {
        const struct sweep *s = v->sweep[i];
        if (r->role[i] == ROLE_GROUP &&
            (kind == VALUES_TEXT ? has_texts(s) : s->number && !s->along)) {
            only = i;
            n++;
        }
    }
    for (const char *const *at = name; *at; at++) {
        for (int i = 0; i < v->n_sweep; i++) {
            if (r->role[i] == ROLE_GROUP && is_called(v->sweep[i], *at, kind)) {
                return i;
            }
        }
    }
    return n == 1 ? only : -1;
}

static const char *const intensities[] = {"im", "sa", "pga", "intensity", "scale", NULL};
static const char *const records[] = {"record", "records", NULL};

// How well a sweep does as the one to go along: numbers, texts and what goes together, the count of
// realisations.
static int rank(const struct sweep *s) {
    return has_random(s) ? 1 : s->number && !s->along ? 3 : 2;
}

// The first free sweep of the highest rank; -1.
static int any_free(const struct study_view *v, const struct roles *r) {
    int any = -1;
    for (int i = v->n_sweep - 1; i >= 0; i--) {
        if (r->role[i] == ROLE_GROUP && (any < 0 || rank(v->sweep[i]) >= rank(v->sweep[any]))) {
            any = i;
        }
    }
    return any;
}

static bool is_intensity(const struct sweep *s) {
    const char *const *name = intensities;
    while (*name && strcmp(s->name, *name) != 0) {
        name++;
    }
    return *name;
}

int roles_intensity(const struct study_view *v) {
    const struct roles none = {.abscissa = 0};
    const int i = guess(v, &none, intensities, VALUES_NUMBER);
    return i >= 0 && is_intensity(v->sweep[i]) && v->sweep[i]->n > 1 ? i : -1;
}

// The first paired sweep of numbers that is free and has the name of an intensity; NULL.
static const struct sweep *find_paired(const struct study_view *v, const struct roles *r, int *i) {
    for (*i = 0; *i < v->n_sweep; ++*i) {
        for (const struct sweep *s = v->sweep[*i]->along; s; s = s->along) {
            if (r->role[*i] == ROLE_GROUP && s->number && !s->random && is_intensity(s)) {
                return s;
            }
        }
    }
    return NULL;
}

// The abscissa that is not named; -1 after an error. A measured intensity needs none: then the
// records do, so that other numbers stay groups.
static int guess_abscissa(const struct study_view *v, const struct suite_request *q,
                          struct roles *r, struct error *e) {
    int paired, i = guess(v, r, intensities, VALUES_NUMBER);
    const bool named = i >= 0 && is_intensity(v->sweep[i]);
    r->along = named ? NULL : find_paired(v, r, &paired);
    if (r->along) {
        return paired;
    }
    if (q->measured && !named) {
        i = guess(v, r, records, VALUES_TEXT);
    }
    if (i < 0 && (q->measured || q->guess == SUITE_ANY)) {
        i = any_free(v, r);
    }
    r->along = i >= 0 ? v->sweep[i] : NULL;
    if (i < 0) {
        error_set(e, STATUS_INPUT,
                  "%s has no sweep 'im', 'sa' or 'pga'; name the intensity with --im NAME",
                  v->path);
    }
    return i;
}

static int find_abscissa(const struct study_view *v, const struct suite_request *q, struct roles *r,
                         struct error *e) {
    int i = -1;
    if (!q->abscissa) {
        i = guess_abscissa(v, q, r, e);
    } else {
        r->along = roles_find_name(v, q->abscissa, strlen(q->abscissa), &i);
        if (!r->along) {
            report_unknown(v, q->abscissa, strlen(q->abscissa), "--im or --against", e);
        }
    }
    if (!r->along) {
        return STATUS_INPUT;
    }
    r->abscissa = i;
    r->is_intensity = is_intensity(r->along);
    return set_role(v, r, i, ROLE_ABSCISSA, e);
}

int roles_find(const struct study_view *v, const struct suite_request *q, struct roles *out,
               struct error *e) {
    *out = (struct roles){.abscissa = -1};
    int status = STATUS_OK;
    for (int i = 0; i < q->n_at && status == STATUS_OK; i++) {
        status = fix(v, q->at[i], out, e);
    }
    if (status == STATUS_OK && q->over) {
        status = take_samples(v, q->over, out, e);
    }
    if (status == STATUS_OK) {
        status = find_abscissa(v, q, out, e);
    }
    // Records, and realisations of random parameters.
    const int found = status == STATUS_OK && !q->over ? guess(v, out, records, VALUES_TEXT) : -1;
    for (int i = 0; i < v->n_sweep && status == STATUS_OK && !q->over; i++) {
        if (out->role[i] == ROLE_GROUP && (i == found || has_random(v->sweep[i]))) {
            out->role[i] = ROLE_SAMPLE;
        }
    }
    return status;
}

int roles_count(const struct study_view *v, const struct roles *r, enum role role) {
    int n = 1;
    for (int i = 0; i < v->n_sweep; i++) {
        n *= r->role[i] == role ? v->sweep[i]->n : 1;
    }
    return n;
}
