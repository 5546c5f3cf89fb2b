// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/run_pairs.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "study/demands.h"
#include "study/percentile.h"
#include "study/roles.h"

// Numbers that differ by less are the same, as those of a range have rounding errors.
static const double SAME = 1e-9;

// A parameter that both studies sweep.
struct common {
    const struct sweep *sweep[2];
    int dimension[2];
    int *code[2];  // (n of each) equal values have equal codes
};

// A value of it.
struct value {
    const char *text;  // NULL: a number
    double number;     // in SI
    int side, at;
};

// A run of one of the studies. Runs of equal ranks have the same values so far.
struct entry {
    long rank;
    int code, side;
    long row;
};

static bool differ(const struct value *a, const struct value *b) {
    return a->text ? strcmp(a->text, b->text) != 0
                   : fabs(a->number - b->number) > SAME * fmax(fabs(a->number), fabs(b->number));
}

static int compare_values(const void *a, const void *b) {
    const struct value *p = a, *q = b;
    return p->text ? strcmp(p->text, q->text) : (p->number > q->number) - (p->number < q->number);
}

static int compare_entries(const void *a, const void *b) {
    const struct entry *p = a, *q = b;
    if (p->rank != q->rank) {
        return p->rank < q->rank ? -1 : 1;
    }
    if (p->code != q->code) {
        return p->code < q->code ? -1 : 1;
    }
    return p->side != q->side ? p->side - q->side : (p->row > q->row) - (p->row < q->row);
}

static int compare_pairs(const void *a, const void *b) {
    const struct run_pair *p = a, *q = b;
    return p->row[0] != q->row[0] ? (p->row[0] > q->row[0]) - (p->row[0] < q->row[0])
                                  : (p->row[1] > q->row[1]) - (p->row[1] < q->row[1]);
}

static double in_si(const struct study_view *v, const struct sweep *s, int i) {
    return s->known ? s->number[i] * unit_size(&v->units, s->dimension) : s->number[i];
}

static int number_values(struct run_pairs *p, struct common *c, struct error *e) {
    const size_t n = (size_t)c->sweep[0]->n + (size_t)c->sweep[1]->n;
    struct value *value = arena_alloc(p->arena, n, sizeof *value);
    struct value *to = value;
    for (int side = 0; side < 2; side++) {
        const struct sweep *s = c->sweep[side];
        c->code[side] = arena_alloc(p->arena, (size_t)s->n, sizeof *c->code[side]);
        for (int i = 0; value && i < s->n; i++) {
            *to++ = (struct value){s->number ? NULL : s->label[i],
                                   s->number ? in_si(p->view[side], s, i) : 0.0, side, i};
        }
    }
    if (!value || arena_failed(p->arena)) {
        return error_no_memory(e);
    }
    qsort(value, n, sizeof *value, compare_values);
    int code = 0;
    for (size_t i = 0; i < n; i++) {
        code += i > 0 && differ(&value[i - 1], &value[i]);
        c->code[value[i].side][value[i].at] = code;
    }
    return STATUS_OK;
}

// The parameter of this name; NULL: there is none. The number of a dimension of paired sweeps is
// not a parameter.
static const struct sweep *find(const struct study_view *v, const char *name, int *dimension) {
    const struct sweep *s = roles_find_name(v, name, strlen(name), dimension);
    const bool counts = s && s == v->sweep[*dimension] && s->along;
    return counts ? NULL : s;
}

// Multiplies the ranks by the values of a parameter.
static void rank(const struct run_pairs *p, const struct common *c, struct entry *entry, long n) {
    for (long i = 0; i < n; i++) {
        struct entry *x = &entry[i];
        const struct study_view *v = p->view[x->side];
        const long run = study_view_run(v, x->row);
        x->code = c->code[x->side][study_view_choice(v, run, c->dimension[x->side])];
    }
    qsort(entry, (size_t)n, sizeof *entry, compare_entries);
    long next = 0, rank = 0;
    int code = 0;
    for (long i = 0; i < n; i++) {
        const bool other = i > 0 && (entry[i].rank != rank || entry[i].code != code);
        next += other;
        rank = entry[i].rank;
        code = entry[i].code;
        entry[i].rank = next;
    }
}

static int add_name(struct run_pairs *p, const char *name, struct error *e) {
    const char *more =
        arena_format(p->arena, "%s%s%s", p->matched, p->matched[0] ? ", " : "", name);
    p->matched = more ? more : p->matched;
    return more ? STATUS_OK : error_no_memory(e);
}

// Ranks the runs by each parameter that both have. *complete[k]: file k sweeps no others.
static int rank_all(struct run_pairs *p, struct entry *entry, long n, bool complete[2],
                    struct error *e) {
    bool seen[2][STUDY_SWEEPS_MAX] = {{false}};
    int status = STATUS_OK;
    const struct study_view *v = p->view[0];
    for (int i = 0; i < v->n_sweep && status == STATUS_OK; i++) {
        const struct sweep *s = v->sweep[i]->along ? v->sweep[i]->along : v->sweep[i];
        for (; s && status == STATUS_OK; s = s->along) {
            struct common c = {.sweep = {s, NULL}, .dimension = {i, 0}};
            c.sweep[1] = find(p->view[1], s->name, &c.dimension[1]);
            if (!c.sweep[1] || !s->number != !c.sweep[1]->number ||
                (s->n == 1 && c.sweep[1]->n == 1)) {
                continue;
            }
            seen[0][i] = seen[1][c.dimension[1]] = true;
            status = add_name(p, s->name, e);
            status = status == STATUS_OK ? number_values(p, &c, e) : status;
            if (status == STATUS_OK) {
                rank(p, &c, entry, n);
            }
        }
    }
    for (int side = 0; side < 2; side++) {
        complete[side] = true;
        for (int i = 0; i < p->view[side]->n_sweep; i++) {
            complete[side] = complete[side] && (seen[side][i] || p->view[side]->sweep[i]->n == 1);
        }
    }
    return status;
}

// The runs of one rank: `n` of each side, those of the first side in front.
static int join(struct run_pairs *p, const struct entry *entry, const long n[2], bool ordered,
                struct error *e) {
    if (n[0] > 1 && n[1] > 1 && !(ordered && n[0] == n[1])) {
        return error_set(e, STATUS_INPUT,
                         "%ld runs of %s and %ld of %s have the same %s; fix a sweep of one of the "
                         "studies with -D",
                         n[0], p->view[0]->path, n[1], p->view[1]->path,
                         p->matched[0] ? p->matched : "parameters");
    }
    const long most = n[0] > n[1] ? n[0] : n[1];
    for (long i = 0; i < most && n[0] > 0 && n[1] > 0; i++) {
        const long a = n[0] == 1 ? 0 : i, b = n[0] + (n[1] == 1 ? 0 : i);
        p->pair[p->n++] = (struct run_pair){{entry[a].row, entry[b].row}};
    }
    p->n_only[0] += n[1] == 0 ? n[0] : 0;
    p->n_only[1] += n[0] == 0 ? n[1] : 0;
    return STATUS_OK;
}

static int make_pairs(struct run_pairs *p, struct entry *entry, long n, struct error *e) {
    bool complete[2];
    int status = rank_all(p, entry, n, complete, e);
    for (long i = 0; i < n && status == STATUS_OK;) {
        long count[2] = {0, 0}, end = i;
        for (; end < n && entry[end].rank == entry[i].rank; end++) {
            count[entry[end].side]++;
        }
        status = join(p, entry + i, count, complete[0] && complete[1], e);
        i = end;
    }
    if (status == STATUS_OK) {
        qsort(p->pair, (size_t)p->n, sizeof *p->pair, compare_pairs);
    }
    return status == STATUS_OK && p->n == 0
               ? error_set(e, STATUS_INPUT, "no run of %s has the %s of a run of %s",
                           p->view[0]->path, p->matched, p->view[1]->path)
               : status;
}

int run_pairs_open(struct run_pairs *p, struct study_file *first, struct study_file *second,
                   struct error *e) {
    *p = (struct run_pairs){.arena = arena_create(),
                            .file = {first, second},
                            .view = {study_file_view(first), study_file_view(second)},
                            .matched = ""};
    const long n[2] = {p->view[0]->n_run, p->view[1]->n_run}, sum = n[0] + n[1];
    struct entry *entry = calloc((size_t)sum + 1, sizeof *entry);
    p->pair = p->arena ? arena_alloc(p->arena, (size_t)sum, sizeof *p->pair) : NULL;
    if (!entry || !p->pair) {
        free(entry);
        return error_no_memory(e);
    }
    for (long i = 0; i < sum; i++) {
        entry[i] = (struct entry){.side = i >= n[0], .row = i < n[0] ? i : i - n[0]};
    }
    const int status = make_pairs(p, entry, sum, e);
    free(entry);
    return status;
}

void run_pairs_close(struct run_pairs *p) {
    arena_free(p->arena);
    *p = (struct run_pairs){.arena = NULL};
}

// Median, dispersion and extremes of the ratios.
static int summarise(const struct run_pairs *p, struct run_ratios *r, struct error *e) {
    double *ratio = malloc(((size_t)p->n + 1) * sizeof *ratio), sum = 0.0, square = 0.0;
    if (!ratio) {
        return error_no_memory(e);
    }
    r->n = 0;
    for (long i = 0; i < p->n; i++) {
        const double a = r->value[0][i], b = r->value[1][i];
        if (!(a > 0.0 && b > 0.0 && isfinite(a) && isfinite(b))) {
            continue;
        }
        const double x = a / b;
        if (r->n == 0 || x < r->smallest) {
            r->smallest = x;
            r->at_smallest = i;
        }
        if (r->n == 0 || x > r->largest) {
            r->largest = x;
            r->at_largest = i;
        }
        ratio[r->n++] = x;
        sum += log(x);
    }
    const double n = (double)r->n, mean = sum / n;
    for (long i = 0; i < r->n; i++) {
        square += (log(ratio[i]) - mean) * (log(ratio[i]) - mean);
    }
    gsl_sort(ratio, 1, (size_t)r->n);
    r->median = r->n > 0 ? percentile_sorted(ratio, (size_t)r->n, 0.5) : NAN;
    r->dispersion = r->n > 1 ? sqrt(square / (n - 1.0)) : NAN;
    free(ratio);
    return STATUS_OK;
}

// Reads the demand of the pairs from one file. *size: of its unit in SI.
static int read_side(const struct run_pairs *p, int side, const char *text, struct run_ratios *out,
                     double *size, struct error *e) {
    const struct study_view *v = p->view[side];
    struct edp *edp = &out->edp[side];
    double *all = malloc(((size_t)v->n_run + 1) * sizeof *all);
    double *value = arena_alloc(p->arena, (size_t)p->n, sizeof *value);
    const struct demands demands = {p->file[side], 1, edp, DEMANDS_NAN, all};
    if (!all || !value) {
        free(all);
        return error_no_memory(e);
    }
    int status = demands_find(p->file[side], text, p->arena, edp, e);
    if (status == STATUS_INPUT) {
        const struct error cause = *e;
        error_set(e, status, "%s: %s", v->path, cause.message);
    }
    status = status == STATUS_OK ? demands_read(&demands, e) : status;
    if (status == STATUS_OK) {
        edp_units(edp->units, v->units.gravity, size);
    }
    for (long i = 0; i < p->n && status == STATUS_OK; i++) {
        value[i] = all[p->pair[i].row[side]];
    }
    out->value[side] = value;
    free(all);
    return status;
}

int run_pairs_read(const struct run_pairs *p, const char *text, struct run_ratios *out,
                   struct error *e) {
    double size[2] = {1.0, 1.0};
    *out = (struct run_ratios){.smallest = NAN, .largest = NAN};
    int status = read_side(p, 0, text, out, &size[0], e);
    out->text = out->edp[0].text;
    status = status == STATUS_OK ? read_side(p, 1, out->text, out, &size[1], e) : status;
    for (long i = 0; i < p->n && status == STATUS_OK; i++) {
        out->value[1][i] = unit_convert(out->value[1][i], size[1], size[0]);
    }
    return status == STATUS_OK ? summarise(p, out, e) : status;
}
