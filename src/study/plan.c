// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/plan.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "jostle/study_merge.h"
#include "model/frame.h"

int plan_init(struct plan *p, const struct study_request *q, struct error *e) {
    const long n_run = q->first->deck->n_run;
    *p = (struct plan){.first = q->first,
                       .define = q->define,
                       .n_define = q->n_define,
                       .n_run = n_run,
                       .shard = q->shard,
                       .n_mine = study_shard_size(&q->shard, n_run)};
    int status = report_create(q->first, NULL, q->result.path, q->result.version, &p->report, e);
    if (status == STATUS_OK) {
        status = study_table_create(p->report, &p->table, e);
    }
    if (status != STATUS_OK) {
        plan_close(p);
    }
    return status;
}

void plan_close(struct plan *p) {
    study_table_free(p->table);
    report_free(p->report);
    *p = (struct plan){.first = NULL};
}

int plan_open_with(const struct plan *p, const char *define, struct plan *out, struct error *e) {
    const struct deck *from = p->first->deck;
    const size_t n = (size_t)p->n_define + 1;
    const char **all = malloc(n * sizeof *all);
    struct deck *deck = NULL;
    struct model *m = NULL;
    *out = (struct plan){.define = all, .n_define = (int)n};
    if (!all) {
        return error_no_memory(e);
    }
    for (int i = 0; i < p->n_define; i++) {
        all[i] = p->define[i];
    }
    all[n - 1] = define;
    int status = deck_open_text(from->path, from->text, all, (int)n, &deck, e);
    if (status == STATUS_OK && (status = model_build(deck, &m, e)) != STATUS_OK) {
        status = diagnostics_cause(&deck->diagnostics, e);
        deck_free(deck);
    }
    if (status == STATUS_OK) {
        out->first = m;
        out->n_run = m->deck->n_run;
        status = plan_check_shape(p, 0, m, e);
    }
    return status;
}

void plan_close_with(struct plan *p) {
    model_free((struct model *)p->first);
    free((void *)p->define);
    *p = (struct plan){.first = NULL};
}

void plan_choose(const struct plan *p, long run, int *choice) {
    int n = 0;
    long later = p->n_run;  // runs for each value of the sweep
    for (const struct sweep *s = p->first->deck->sweeps; s; s = s->next) {
        later /= s->n;
        choice[n++] = (int)(run / later % s->n);
    }
}

// Appends to the text, as far as there is room.
static void append(struct plan_text *t, const char *text) {
    const size_t used = strlen(t->text);
    snprintf(t->text + used, sizeof t->text - used, "%s", text);
}

static void append_value(struct plan_text *t, const char *before, const struct sweep *s,
                         int choice) {
    char number[32];
    append(t, before);
    append(t, s->name);
    snprintf(number, sizeof number, "%.6g", s->number ? s->number[choice] : 0.0);
    append(t, " = ");
    append(t, s->number ? number : s->label[choice]);
}

const char *plan_describe(const struct plan *p, long run, struct plan_text *t) {
    int choice[STUDY_SWEEPS_MAX];
    plan_choose(p, run, choice);
    snprintf(t->text, sizeof t->text, "run %ld", run + 1);
    const char *before = " (";
    int i = 0;
    for (const struct sweep *s = p->first->deck->sweeps; s; s = s->next, i++) {
        if (s->fixed) {
            continue;
        }
        const struct sweep *along = sweep_named(s->along);
        append_value(t, before, s, choice[i]);
        for (const struct sweep *v = along; v; v = sweep_named(v->along)) {
            append_value(t, v == along ? " (" : ", ", v, choice[i]);
        }
        append(t, along ? ")" : "");
        before = ", ";
    }
    t->text[sizeof t->text - 2] = '\0';
    append(t, ")");
    return t->text;
}

static bool same_values(const struct sweep *a, const struct sweep *b) {
    if (strcmp(a->name, b->name) != 0 || a->n != b->n || !a->number != !b->number) {
        return false;
    }
    if (a->number == b->number && a->text == b->text) {
        return true;
    }
    if (a->number) {
        return memcmp(a->number, b->number, (size_t)a->n * sizeof *a->number) == 0;
    }
    for (int i = 0; i < a->n; i++) {
        if (strcmp(a->text[i], b->text[i]) != 0) {
            return false;
        }
    }
    return true;
}

static bool same_sweeps(const struct sweep *a, const struct sweep *b) {
    for (; a && b; a = a->next, b = b->next) {
        const struct sweep *x = a, *y = b;
        while (x && y && same_values(x, y)) {
            x = x->along;
            y = y->along;
        }
        if (x || y) {
            return false;
        }
    }
    return !a && !b;
}

static int differs(const struct plan *p, long run, struct error *e, const char *cause) {
    struct plan_text t;
    return error_set(e, STATUS_INPUT,
                     "%s differs from the first run in its %s; all runs of a study need the same",
                     plan_describe(p, run, &t), cause);
}

// Have both buildings the same parts with the same members?
static bool same_parts(const struct building *a, const struct building *b) {
    bool same = a->n_force == b->n_force;
    a = a->fixed ? a->fixed : a;
    b = b->fixed ? b->fixed : b;
    same = same && a->n_part == b->n_part;
    for (int i = 0; same && i < a->n_part; i++) {
        const struct plane_frame *f = frame_of(&a->part[i]), *g = frame_of(&b->part[i]);
        same = strcmp(a->part[i].kind->name, b->part[i].kind->name) == 0 && !f == !g &&
               (!f || f->n_member == g->n_member);
        for (int k = 0; same && f && k < f->n_member; k++) {
            const struct frame_member *x = &f->member[k], *y = &g->member[k];
            same = x->kind == y->kind && x->level == y->level && x->number == y->number &&
                   x->hinge[0] == y->hinge[0] && x->hinge[1] == y->hinge[1];
        }
    }
    return same;
}

static int check_buildings(const struct plan *p, long run, const struct model *m, struct error *e) {
    if (m->n_building != p->first->n_building) {
        return differs(p, run, e, "number of buildings");
    }
    for (int i = 0; i < m->n_building; i++) {
        const struct building *a = &p->first->building[i], *b = &m->building[i];
        if (strcmp(a->name, b->name) != 0) {
            return differs(p, run, e, "names of buildings");
        }
        if (a->n_floor != b->n_floor || !a->fixed != !b->fixed) {
            struct plan_text t;
            return error_set(e, STATUS_INPUT,
                             "%s has %d floors in building %s, the first run has %d; all runs of "
                             "a study need the same",
                             plan_describe(p, run, &t), b->n_floor, b->name, a->n_floor);
        }
        if (a->isolated != b->isolated) {
            return differs(p, run, e, "isolators of buildings");
        }
        if (!same_parts(a, b)) {
            return differs(p, run, e, "parts and members of buildings");
        }
    }
    return STATUS_OK;
}

static int check_links(const struct plan *p, long run, const struct model *m, struct error *e) {
    bool same = m->n_contact == p->first->n_contact && m->n_link == p->first->n_link;
    if (!same) {
        return differs(p, run, e, "number of contacts and links");
    }
    for (int i = 0; i < m->n_link; i++) {
        const struct link *a = &p->first->link[i], *b = &m->link[i];
        same = same && strcmp(a->name, b->name) == 0 && a->within == b->within;
        for (int k = 0; k < 2; k++) {
            // At the same floor, or at levels in the same storey?
            same = same && a->building[k] == b->building[k] && a->floor[k] == b->floor[k] &&
                   isnan(a->level[k]) == isnan(b->level[k]);
        }
    }
    return same ? STATUS_OK : differs(p, run, e, "contacts and links");
}

int plan_check(const struct plan *p, long run, const struct model *m, struct error *e) {
    return same_sweeps(p->first->deck->sweeps, m->deck->sweeps) ? plan_check_shape(p, run, m, e)
                                                                : differs(p, run, e, "sweeps");
}

int plan_check_shape(const struct plan *p, long run, const struct model *m, struct error *e) {
    const struct unit_system *a = &p->first->deck->units, *b = &m->deck->units;
    if (a->force != b->force || a->length != b->length || a->time != b->time) {
        return differs(p, run, e, "units");
    }
    int status = check_buildings(p, run, m, e);
    return status == STATUS_OK ? check_links(p, run, m, e) : status;
}

static void fix_sweep(struct sweep *s, const double *number) {
    s->n = 1;
    s->fixed = true;
    s->number = number;
}

void plan_fix(const struct plan *p, plan_fixed_at *at, const void *context,
              struct plan_fixed *out) {
    static const double first = 1.0;  // number 1 of a dimension
    int n = 0, n_paired = 0;
    long n_run = p->n_run;
    out->model = *p->first;
    out->deck = *p->first->deck;
    for (const struct sweep *s = p->first->deck->sweeps; s; s = s->next, n++) {
        const double *number = at(context, s->along ? s->along : s);
        struct sweep *own = &out->sweep[n];
        *own = *s;
        if (number) {
            n_run /= s->n;
            fix_sweep(own, s->along ? &first : number);
        }
        const struct sweep **last = &own->along;
        for (const struct sweep *v = s->along; v && number; v = v->along) {
            assert(n_paired < PLAN_PAIRED_MAX);
            struct sweep *paired = &out->paired[n_paired++];
            *paired = *v;
            fix_sweep(paired, at(context, v));
            *last = paired;
            last = &paired->along;
        }
        if (n > 0) {
            out->sweep[n - 1].next = own;
        }
    }
    out->deck.sweeps = out->sweep;
    out->model.deck = &out->deck;
    out->plan = (struct plan){
        .first = &out->model, .define = p->define, .n_define = p->n_define, .n_run = n_run};
}

struct study_view plan_view(const struct plan *p) {
    const struct report *r = p->report;
    struct study_view v = {.path = p->first->deck->path,
                           .title = p->first->deck->title,
                           .units = r->units,
                           .n_run = p->n_run,
                           .n_study = p->n_run,
                           .table = *p->table,
                           .n_building = r->n_building,
                           .building = r->building,
                           .n_contact = r->n_contact,
                           .n_link = r->n_link,
                           .contact = r->contact,
                           .link = r->link,
                           .n_column = r->n_column,
                           .column = r->column};
    for (const struct sweep *s = p->first->deck->sweeps; s; s = s->next) {
        v.sweep[v.n_sweep++] = s;
    }
    return v;
}

long study_shard_run(const struct study_shard *s, long i) {
    if (s->n == 0) {
        return i;
    }
    return i * s->n + (s->number - 1 - i % s->n + s->n) % s->n;
}

long study_shard_size(const struct study_shard *s, long n_run) {
    if (s->n == 0) {
        return n_run;
    }
    const long rows = n_run / s->n;  // complete ones
    return rows + (study_shard_run(s, rows) < n_run);
}
