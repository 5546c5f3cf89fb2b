// SPDX-License-Identifier: GPL-3.0-or-later
#include "result/study_samples.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The names with blanks between, to be given to free; NULL: no memory.
static char *names_of(const struct sweep *const *sweep, int n) {
    size_t size = 1;
    for (int i = 0; i < n; i++) {
        for (const struct sweep *p = sweep[i]->along; p; p = p->along) {
            size += strlen(p->name) + 1;
        }
    }
    char *names = calloc(size, 1);
    for (int i = 0; names && i < n; i++) {
        for (const struct sweep *p = sweep[i]->along; p; p = p->along) {
            const size_t used = strlen(names);
            snprintf(names + used, size - used, "%s%s", used ? " " : "", p->name);
        }
    }
    return names;
}

void study_samples_name(struct h5 *h, hid_t object, const struct sweep *const *sweep, int n,
                        const char *attribute) {
    char *names = names_of(sweep, n);
    if (!names) {
        h5_no_memory(h);
    } else if (names[0]) {
        h5_put_text(h, object, attribute, names);
    }
    free(names);
}

static const char *const exponents[] = {"exponent_force", "exponent_length", "exponent_time"};

void study_samples_put_dimension(struct h5 *h, hid_t values, const struct sweep *s) {
    const double power[] = {s->dimension.force, s->dimension.length, s->dimension.time};
    for (int i = 0; i < 3 && s->known; i++) {
        h5_put_double(h, values, exponents[i], power[i]);
    }
}

void study_samples_get_dimension(struct h5 *h, hid_t values, struct sweep *s) {
    double *const power[] = {&s->dimension.force, &s->dimension.length, &s->dimension.time};
    s->known = !h->failed && H5Aexists(values, exponents[0]) > 0;
    for (int i = 0; i < 3 && s->known; i++) {
        *power[i] = h5_get_double(h, values, exponents[i]);
    }
}

void study_samples_link(struct study_writer *w, hid_t group, const struct sweep *s) {
    for (const struct sweep *p = s->along; p && !w->h.failed; p = p->along) {
        hid_t sweeps = h5_get_group(&w->h, w->h.file, "sweep");
        hid_t values = h5_open_object(&w->h, sweeps, p->name);
        h5_hard_link(&w->h, values, group, p->name);
        h5_close(&w->h, values);
        h5_close(&w->h, sweeps);
    }
}

bool study_samples_has(const struct sweep *const *sweep, int n, const char *name) {
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
    *s = (struct sweep){.name = name, .n = n};
    s->number = h5_get_doubles(h, a, group, name, (size_t)n);
    hid_t values = h5_open_object(h, group, name);
    s->units = h5_get_text(h, a, values, "units");
    study_samples_get_dimension(h, values, s);
    h5_close(h, values);
    return h->failed ? NULL : s;
}

void study_samples_get(struct h5 *h, struct arena *a, hid_t group, hid_t scale, struct sweep *s) {
    const htri_t found = h->failed ? 0 : H5Aexists(scale, STUDY_SAMPLES_NAMES);
    char *names = found > 0 ? h5_get_text(h, a, scale, STUDY_SAMPLES_NAMES) : NULL;
    const struct sweep **next = &s->along;
    char *rest = NULL;
    for (char *name = names ? strtok_r(names, " ", &rest) : NULL; name && !h->failed;
         name = strtok_r(NULL, " ", &rest)) {
        struct sweep *p = get_values(h, a, group, name, s->n);
        *next = p;
        next = p ? &p->along : next;
    }
}
