// SPDX-License-Identifier: GPL-3.0-or-later
#include "result/study_along.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char together_attribute[] = "together", sampled_attribute[] = "sampled";

enum which { ALL, RANDOM };

static bool is_meant(const struct sweep *s, enum which which) {
    return which == ALL || s->random;
}

// Writes the names with blanks between; no attribute if there are none.
static void put_names(struct h5 *h, hid_t object, const char *attribute,
                      const struct sweep *const *sweep, int n, enum which which) {
    size_t size = 1;
    for (int i = 0; i < n; i++) {
        for (const struct sweep *p = sweep[i]->along; p; p = p->along) {
            size += is_meant(p, which) ? strlen(p->name) + 1 : 0;
        }
    }
    char *names = calloc(size, 1);
    for (int i = 0; names && i < n; i++) {
        for (const struct sweep *p = sweep[i]->along; p; p = p->along) {
            const size_t used = strlen(names);
            if (is_meant(p, which)) {
                snprintf(names + used, size - used, "%s%s", used ? " " : "", p->name);
            }
        }
    }
    if (!names) {
        h5_no_memory(h);
    } else if (names[0]) {
        h5_put_text(h, object, attribute, names);
    }
    free(names);
}

void study_along_put_coordinates(struct h5 *h, hid_t group, const struct sweep *const *sweep,
                                 int n) {
    put_names(h, group, "coordinates", sweep, n, ALL);
}

void study_along_put_names(struct h5 *h, hid_t scale, const struct sweep *s) {
    bool sampled = true;
    for (const struct sweep *p = s->along; p; p = p->along) {
        sampled = sampled && p->random;
    }
    if (!sampled) {
        put_names(h, scale, together_attribute, &s, 1, ALL);
    }
    put_names(h, scale, sampled_attribute, &s, 1, RANDOM);
}

static const char *const exponents[] = {"exponent_force", "exponent_length", "exponent_time"};

void study_along_put_dimension(struct h5 *h, hid_t values, const struct sweep *s) {
    const double power[] = {s->dimension.force, s->dimension.length, s->dimension.time};
    for (int i = 0; i < 3 && s->known; i++) {
        h5_put_double(h, values, exponents[i], power[i]);
    }
}

void study_along_get_dimension(struct h5 *h, hid_t values, struct sweep *s) {
    double *const power[] = {&s->dimension.force, &s->dimension.length, &s->dimension.time};
    s->known = !h->failed && H5Aexists(values, exponents[0]) > 0;
    for (int i = 0; i < 3 && s->known; i++) {
        *power[i] = h5_get_double(h, values, exponents[i]);
    }
}

void study_along_link(struct study_writer *w, hid_t group, const struct sweep *s) {
    for (const struct sweep *p = s->along; p && !w->h.failed; p = p->along) {
        hid_t sweeps = h5_get_group(&w->h, w->h.file, "sweep");
        hid_t values = h5_open_object(&w->h, sweeps, p->name);
        h5_hard_link(&w->h, values, group, p->name);
        h5_close(&w->h, values);
        h5_close(&w->h, sweeps);
    }
}

bool study_along_has(const struct sweep *const *sweep, int n, const char *name) {
    for (int i = 0; i < n; i++) {
        for (const struct sweep *p = sweep[i]; p; p = p->along) {
            if (strcmp(p->name, name) == 0) {
                return true;
            }
        }
    }
    return false;
}

static struct sweep *get_values(struct h5 *h, struct arena *a, hid_t group, const char *name,
                                int n) {
    struct sweep *s = h5_alloc(h, a, 1, sizeof *s);
    if (!s) {
        return NULL;
    }
    *s = (struct sweep){.name = name, .n = n, .units = ""};
    hid_t values = h5_open_object(h, group, name);
    if (h5_is_number(values)) {
        s->number = h5_get_doubles(h, a, group, name, (size_t)n);
        s->units = h5_get_text(h, a, values, "units");
        study_along_get_dimension(h, values, s);
    } else {
        s->label = (const char *const *)h5_get_texts(h, a, group, name, (size_t)n);
        s->text = s->label;
    }
    h5_close(h, values);
    return h->failed ? NULL : s;
}

// The attribute; NULL: there is none.
static char *get_names(struct h5 *h, struct arena *a, hid_t scale, const char *attribute) {
    const htri_t found = h->failed ? 0 : H5Aexists(scale, attribute);
    return found > 0 ? h5_get_text(h, a, scale, attribute) : NULL;
}

static bool is_among(const char *names, const char *name) {
    const size_t length = strlen(name);
    while (names && !(strncmp(names, name, length) == 0 &&
                      (names[length] == ' ' || names[length] == '\0'))) {
        names = strchr(names, ' ');
        names += names ? 1 : 0;
    }
    return names;
}

void study_along_get(struct h5 *h, struct arena *a, hid_t group, hid_t scale, struct sweep *s) {
    const char *sampled = get_names(h, a, scale, sampled_attribute);
    char *names = get_names(h, a, scale, together_attribute);
    names = names ? names : get_names(h, a, scale, sampled_attribute);
    const struct sweep **next = &s->along;
    char *rest = NULL;
    for (char *name = names ? strtok_r(names, " ", &rest) : NULL; name && !h->failed;
         name = strtok_r(NULL, " ", &rest)) {
        struct sweep *p = get_values(h, a, group, name, s->n);
        if (p) {
            p->random = is_among(sampled, name);
            *next = p;
            next = &p->along;
        }
    }
}
