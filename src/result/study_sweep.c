// SPDX-License-Identifier: GPL-3.0-or-later
#include "result/study_sweep.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Attributes of a scale with the names of the parameters along it: "together" has all of them
// where they are not all random, "sampled" those that are.
static const char together_attribute[] = "together", sampled_attribute[] = "sampled";

enum which { ALL, RANDOM };

bool study_sweep_has(const struct sweep *const *sweep, int n, const char *name) {
    for (int i = 0; i < n; i++) {
        for (const struct sweep *p = sweep[i]; p; p = p->along) {
            if (strcmp(p->name, name) == 0) {
                return true;
            }
        }
    }
    return false;
}

struct h5_box study_sweep_box(const struct sweep *const *sweep, int n, long first, long most) {
    hsize_t dim[STUDY_SWEEPS_MAX];
    for (int i = 0; i < n; i++) {
        dim[i] = (hsize_t)sweep[i]->n;
    }
    return h5_box(dim, n, (hsize_t)first, (hsize_t)most);
}

// Writes the names of parameters along the sweeps with blanks between; no attribute if there are
// none.
static void put_names(struct h5 *h, hid_t object, const char *attribute,
                      const struct sweep *const *sweep, int n, enum which which) {
    char *names = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&names, &size);
    for (int i = 0; to && i < n; i++) {
        for (const struct sweep *p = sweep[i]->along; p; p = p->along) {
            if (which == ALL || p->random) {
                fprintf(to, "%s%s", ftell(to) > 0 ? " " : "", p->name);
            }
        }
    }
    if (!to || fclose(to) != 0) {
        h5_no_memory(h);
    } else if (size > 0) {
        h5_put_text(h, object, attribute, names);
    }
    free(names);
}

static const char *const exponents[] = {"exponent_force", "exponent_length", "exponent_time"};

void study_sweep_put_dimension(struct h5 *h, hid_t values, const struct sweep *s) {
    const double power[] = {s->dimension.force, s->dimension.length, s->dimension.time};
    for (int i = 0; i < 3 && s->known; i++) {
        h5_put_double(h, values, exponents[i], power[i]);
    }
}

void study_sweep_get_dimension(struct h5 *h, hid_t values, struct sweep *s) {
    double *const power[] = {&s->dimension.force, &s->dimension.length, &s->dimension.time};
    s->known = !h->failed && H5Aexists(values, exponents[0]) > 0;
    for (int i = 0; i < 3 && s->known; i++) {
        *power[i] = h5_get_double(h, values, exponents[i]);
    }
}

// The values of a sweep, open: a scale, or, with the `scale` of their dimension, values along it. A
// number without a unit may be of any dimension: only its use says which.
static hid_t put_values(struct h5 *h, hid_t group, const struct sweep *s, hid_t scale) {
    const hid_t type = s->number ? H5T_NATIVE_DOUBLE : h->text;
    const struct h5_dataset d = {
        .name = s->name,
        .quantity = {"swept parameter", s->number && s->known ? &s->dimension : NULL},
        .file_type = s->number ? H5T_IEEE_F64LE : h->text,
        .n_dim = 1,
        .dim = {(hsize_t)s->n},
        .scale = {scale},
        .many_users = true,
    };
    hid_t dataset = h5_dataset(h, group, &d);
    if (s->number && !s->known) {
        h5_put_text(h, dataset, "units", "unknown");
    }
    if (s->n > 0) {
        h5_put_box(h, dataset, NULL, type, s->number ? (const void *)s->number : s->label);
    }
    return dataset;
}

hid_t study_sweep_put(struct h5 *h, hid_t group, const struct sweep *s) {
    hid_t scale = put_values(h, group, s, 0);
    bool sampled = true;
    for (const struct sweep *p = s->along; p; p = p->along) {
        hid_t values = put_values(h, group, p, scale);
        study_sweep_put_dimension(h, values, p);
        h5_close(h, values);
        sampled = sampled && p->random;
    }
    if (!sampled) {
        put_names(h, scale, together_attribute, &s, 1, ALL);
    }
    put_names(h, scale, sampled_attribute, &s, 1, RANDOM);
    return scale;
}

void study_sweep_link(struct h5 *h, hid_t group, const struct sweep *const *sweep,
                      const hid_t *scale, int n) {
    for (int i = 0; i < n; i++) {
        h5_hard_link(h, scale[i], group, sweep[i]->name);
        for (const struct sweep *p = sweep[i]->along; p && !h->failed; p = p->along) {
            hid_t sweeps = h5_get_group(h, h->file, "sweep");
            hid_t values = h5_open_object(h, sweeps, p->name);
            h5_hard_link(h, values, group, p->name);
            h5_close(h, values);
            h5_close(h, sweeps);
        }
    }
    put_names(h, group, "coordinates", sweep, n, ALL);
}

// The values in an open dataset of this name.
static struct sweep *get_values(struct h5 *h, struct arena *a, hid_t group, hid_t values,
                                const char *name) {
    struct sweep *s = h5_alloc(h, a, 1, sizeof *s);
    if (!s) {
        return NULL;
    }
    *s = (struct sweep){.name = h5_copy(h, a, name), .units = ""};
    s->n = (int)h5_get_length(h, group, name, STUDY_RUNS_MAX);
    if (h5_is_number(values)) {
        s->number = h5_get_doubles(h, a, group, name, (size_t)s->n);
        s->units = h5_get_line(h, a, values, "units");
    } else {
        s->label = (const char *const *)h5_get_texts(h, a, group, name, (size_t)s->n);
        s->text = s->label;
    }
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

struct sweep *study_sweep_get(struct h5 *h, struct arena *a, hid_t group, hid_t scale,
                              const char *name) {
    struct sweep *s = get_values(h, a, group, scale, name);
    if (!s || !s->number) {
        return s;
    }
    const char *sampled = get_names(h, a, scale, sampled_attribute);
    char *names = get_names(h, a, scale, together_attribute), *rest = NULL;
    names = names ? names : get_names(h, a, scale, sampled_attribute);
    const struct sweep **next = &s->along;
    for (char *along = names ? strtok_r(names, " ", &rest) : NULL; along && !h->failed;
         along = strtok_r(NULL, " ", &rest)) {
        hid_t values = h5_open_object(h, group, along);
        struct sweep *p = h->failed ? NULL : get_values(h, a, group, values, along);
        if (p && p->n != s->n) {
            h5_fail(h, "dataset '%s' has %d values, not %d", along, p->n, s->n);
        }
        if (p && p->number) {
            study_sweep_get_dimension(h, values, p);
        }
        if (p) {
            p->random = is_among(sampled, along);
            *next = p;
            next = &p->along;
        }
        h5_close(h, values);
    }
    return h->failed ? NULL : s;
}
