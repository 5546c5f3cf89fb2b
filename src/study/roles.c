// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/roles.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/text.h"

// Values typed by hand may differ from those of a range in their last digits.
static const double SAME_VALUE = 1e-9;

static bool is_name(const struct sweep *s, const char *name, size_t n) {
    return strlen(s->name) == n && strncmp(s->name, name, n) == 0;
}

// The random parameter of this name; NULL: there is none. *sweep is the sample it is along.
static const struct sweep *find_random(const struct study_view *v, const char *name, size_t n,
                                       int *sweep) {
    for (*sweep = 0; *sweep < v->n_sweep; ++*sweep) {
        for (const struct sweep *p = v->sweep[*sweep]->along; p; p = p->along) {
            if (is_name(p, name, n)) {
                return p;
            }
        }
    }
    return NULL;
}

// The sweep of this name; -1 after an error, which lists those of the study.
static int find_sweep(const struct study_view *v, const char *name, size_t n, const char *option,
                      struct error *e) {
    char list[256] = "";
    for (int i = 0; i < v->n_sweep; i++) {
        const char *known = v->sweep[i]->name;
        if (is_name(v->sweep[i], name, n)) {
            return i;
        }
        const size_t used = strlen(list);
        snprintf(list + used, sizeof list - used, "%s%s", used ? ", " : "", known);
    }
    int sample;
    if (find_random(v, name, n, &sample)) {
        error_set(e, STATUS_INPUT, "%s: '%.*s' is a random parameter; name its sweep '%s'", option,
                  (int)n, name, v->sweep[sample]->name);
        return -1;
    }
    error_set(e, STATUS_INPUT, "%s: the study has no sweep '%.*s'; there are %s", option, (int)n,
              name, list);
    return -1;
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
static int find_number(const struct study_view *v, int sweep, const char *text) {
    const struct sweep *s = v->sweep[sweep];
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

static int find_label(const struct sweep *s, const char *text) {
    for (int i = 0; i < s->n; i++) {
        if (strcmp(s->label[i], text) == 0) {
            return i;
        }
    }
    return -1;
}

static int fix(const struct study_view *v, const char *text, struct roles *r, struct error *e) {
    const size_t n = strcspn(text, "=");
    if (text[n] == '\0') {
        return error_set(e, STATUS_INPUT, "--at takes NAME=VALUE, not '%s'", text);
    }
    const int i = find_sweep(v, text, n, "--at", e);
    if (i < 0) {
        return STATUS_INPUT;
    }
    const struct sweep *s = v->sweep[i];
    r->fixed[i] = s->number ? find_number(v, i, text + n + 1) : find_label(s, text + n + 1);
    if (r->fixed[i] >= 0) {
        return set_role(v, r, i, ROLE_FIXED, e);
    }
    if (s->number) {
        return error_set(e, STATUS_INPUT, "--at %s: '%s' has %d values, from %.9g to %.9g %s", text,
                         s->name, s->n, s->number[0], s->number[s->n - 1], s->units);
    }
    return error_set(e, STATUS_INPUT, "--at %s: '%s' has %d values: %s%s%s", text, s->name, s->n,
                     s->label[0], s->n > 1 ? " ... " : "", s->n > 1 ? s->label[s->n - 1] : "");
}

static int take_samples(const struct study_view *v, const char *over, struct roles *r,
                        struct error *e) {
    for (const char *at = over; *at; at += strspn(at, ",")) {
        const size_t n = strcspn(at, ",");
        const int i = find_sweep(v, at, n, "--over", e);
        int status = i < 0 ? STATUS_INPUT : set_role(v, r, i, ROLE_SAMPLE, e);
        if (status != STATUS_OK) {
            return status;
        }
        at += n;
    }
    return STATUS_OK;
}

// The first sweep still free that has one of these names, else the only one that is free among
// texts (or numbers, but for those that count the realisations of random parameters); -1.
enum value_kind { VALUES_TEXT, VALUES_NUMBER };
static int guess(const struct study_view *v, const struct roles *r, const char *const *name,
                 enum value_kind kind) {
    int only = -1, n = 0;
    for (int i = 0; i < v->n_sweep; i++) {
        if (r->role[i] == ROLE_GROUP && !v->sweep[i]->along &&
            (v->sweep[i]->number != NULL) == (kind == VALUES_NUMBER)) {
            only = i;
            n++;
        }
    }
    for (const char *const *at = name; *at; at++) {
        for (int i = 0; i < v->n_sweep; i++) {
            if (r->role[i] == ROLE_GROUP && strcmp(v->sweep[i]->name, *at) == 0) {
                return i;
            }
        }
    }
    return n == 1 ? only : -1;
}

static const char *const intensities[] = {"im", "sa", "pga", "intensity", "scale", NULL};
static const char *const records[] = {"record", "records", NULL};

// How well a sweep does as the one to go along: numbers, texts, the count of realisations.
static int rank(const struct sweep *s) {
    return s->along ? 1 : s->number ? 3 : 2;
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

// Records, and realisations of random parameters.
static void default_samples(const struct study_view *v, struct roles *r) {
    const int found = guess(v, r, records, VALUES_TEXT);
    for (int i = 0; i < v->n_sweep; i++) {
        if (r->role[i] == ROLE_GROUP && (i == found || v->sweep[i]->along)) {
            r->role[i] = ROLE_SAMPLE;
        }
    }
}

static bool is_one_of(const char *name, const char *const *known) {
    while (*known && strcmp(name, *known) != 0) {
        known++;
    }
    return *known != NULL;
}

// The sweep along which `name` goes, a sweep or a random parameter; -1 after an error.
static int find_named(const struct study_view *v, const char *name, struct roles *r,
                      struct error *e) {
    int sweep;
    r->along = find_random(v, name, strlen(name), &sweep);
    return r->along ? sweep : find_sweep(v, name, strlen(name), "--im or --against", e);
}

static int guess_abscissa(const struct study_view *v, const struct suite_request *q,
                          const struct roles *r, struct error *e) {
    int i = guess(v, r, intensities, VALUES_NUMBER);
    if (i < 0 && q->guess == SUITE_ANY) {
        i = any_free(v, r);
    }
    if (i < 0) {
        error_set(e, STATUS_INPUT,
                  "%s has no sweep 'im', 'sa' or 'pga'; name the one to go along by --im NAME",
                  v->path);
    }
    return i;
}

static int find_abscissa(const struct study_view *v, const struct suite_request *q, struct roles *r,
                         struct error *e) {
    const int i = q->abscissa ? find_named(v, q->abscissa, r, e) : guess_abscissa(v, q, r, e);
    if (i < 0) {
        return STATUS_INPUT;
    }
    r->abscissa = i;
    r->along = r->along ? r->along : v->sweep[i];
    r->is_intensity = is_one_of(r->along->name, intensities);
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
    if (status == STATUS_OK && !q->over) {
        default_samples(v, out);
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
