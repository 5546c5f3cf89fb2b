// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/fragility_runs.h"

#include <math.h>
#include <stdlib.h>

#include "core/arena.h"

int fragility_runs_create(const struct suite *s, struct fragility_runs *out, struct error *e) {
    const int n = s->n_sample * s->n_point;
    const bool each = s->n_sample == 1;
    *out = (struct fragility_runs){.n = n, .n_unit = each ? n : s->n_sample, .each = each};
    out->run = arena_alloc(s->arena, (size_t)n, sizeof *out->run);
    return out->run ? STATUS_OK : error_no_memory(e);
}

// By intensity, and by unit where it is the same.
static int compare(const void *a, const void *b) {
    const struct fragility_run *x = a, *y = b;
    return x->intensity != y->intensity ? (x->intensity > y->intensity ? 1 : -1)
                                        : (x->unit > y->unit) - (x->unit < y->unit);
}

void fragility_runs_take(struct fragility_runs *r, const struct suite *s, int group) {
    for (int i = 0; i < r->n; i++) {
        const int sample = i / s->n_point, point = i % s->n_point;
        r->run[i] = (struct fragility_run){.intensity = suite_intensity(s, group, sample, point),
                                           .demand = suite_value(s, group, sample, point),
                                           .unit = sample};
    }
    qsort(r->run, (size_t)r->n, sizeof *r->run, compare);
    for (int i = 0; i < r->n && r->each; i++) {
        r->run[i].unit = i;
    }
}

int fragility_runs_count(const struct fragility_runs *r, double limit, const int *weight,
                         struct fragility_level *level) {
    int n = 0;
    for (int i = 0; i < r->n; i++) {
        const struct fragility_run *run = &r->run[i];
        const int times = isnan(run->demand) ? 0 : weight ? weight[run->unit] : 1;
        if (n == 0 || run->intensity > level[n - 1].intensity) {
            level[n++] = (struct fragility_level){.intensity = run->intensity};
        }
        level[n - 1].n += times;
        level[n - 1].exceeded += run->demand > limit ? times : 0;
    }
    return n;
}

static struct fragility_record first(const struct fragility_runs *r, int unit, double limit) {
    struct fragility_record c = {CROSSING_NO_RUNS, NAN};
    double last = NAN;
    for (int i = 0; i < r->n; i++) {
        const struct fragility_run *run = &r->run[i];
        const double x = run->demand;
        if (run->unit != unit || isnan(x)) {
            continue;
        }
        if (x > limit && c.crossing == CROSSING_NO_RUNS) {
            return (struct fragility_record){CROSSING_BELOW, run->intensity};
        }
        if (x > limit) {
            const double share = isinf(x) ? 1.0 : (limit - last) / (x - last);
            return (struct fragility_record){CROSSING_AT,
                                             c.intensity + share * (run->intensity - c.intensity)};
        }
        c = (struct fragility_record){CROSSING_ABOVE, run->intensity};
        last = x;
    }
    return c;
}

void fragility_runs_first(const struct fragility_runs *r, double limit,
                          struct fragility_record *record) {
    for (int k = 0; k < r->n_unit; k++) {
        record[k] = first(r, k, limit);
    }
}
