// SPDX-License-Identifier: GPL-3.0-or-later
// The arithmetic of a step is in link_terms.h. A^-1 is almost diagonal, for beta h^2 K << M: links
// disturb each other where they share a floor, and little else.
//
// Laws are asked before the first sweep, a group of links at a time so that the cache holds them
// until they are visited; evaluations there need not wait for each other. From then on the tangent
// replaces the law, at little cost, and the law is asked again, at once, where that is not accurate
// enough. A link of a smooth law within that reach is settled, and passed over where the tangent
// gives no change that matters.
//
// A settled link is only disturbed by the changes of others after its own. They change its force by
//     |df_l| <= t / (1 + s) sum over m of |S_lm df_m| <= s sum of |S_lm| / S_ll max |df_m|,
// so that another sweep would change forces by such a share of what this one did. Where that does
// not matter there is no other sweep.
#include "solve/contact/sweep.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "core/lanes.h"
#include "core/number.h"
#include "solve/contact/link_terms.h"

// Floors of the building at an end, in whole lanes.
static int lanes_at(const struct model *m, const struct link *l, int side) {
    return l->row[side].n > 0 ? lanes_whole(m->building[l->building[side]].n_floor) : 0;
}

bool sweep_init(struct link_scratch *p, const struct model *m, int k, struct arena *a) {
    const struct link *l = &m->link[k];
    const bool plain = link_is_plain(l);
    *p = (struct link_scratch){
        .end = {plain ? state_end(l, m, 0) : -1, plain ? state_end(l, m, 1) : -1},
        .combined = plain ? NULL : lanes_array(a, lanes_at(m, l, 0) + lanes_at(m, l, 1)),
        .link = l,
        .index = k,
        .kind = l->law,
        .constant = l->constant,
        .gap = l->gap,
        .bilateral = l->bilateral,
        .moving_ground = l->moving_ground,
    };
    return plain || p->combined;
}

double sweep_across_rows(const struct link_scratch *p, const double *x) {
    return link_across(p->link, x);
}

static double sum_of_sizes(const double *x, int n) {
    double sum = 0.0;
    for (int i = 0; i < n; i++) {
        sum += fabs(x[i]);
    }
    return sum;
}

// A^-1 b' of an end that is a row, into `column` (n_floor in whole lanes); returns b A^-1 b'.
static double combine_columns(struct effective *a, const struct link *l, int side, double *column,
                              struct reach *reach) {
    const int n = lanes_whole(a->building->n_floor);
    const struct link_row *row = &l->row[side];
    double flexibility = 0.0;
    memset(column, 0, (size_t)n * sizeof *column);
    *reach = (struct reach){n, 0};
    for (int i = 0; i < row->n; i++) {
        const int floor = row->entry[i].dof - a->building->first;
        const double *one = effective_column(a, floor);
        for (int j = 0; j < n; j++) {
            column[j] += row->entry[i].weight * one[j];
        }
        const struct reach own = a->reach[floor];
        *reach = (struct reach){own.from < reach->from ? own.from : reach->from,
                                own.to > reach->to ? own.to : reach->to};
    }
    for (int i = 0; i < row->n; i++) {
        flexibility += row->entry[i].weight * column[row->entry[i].dof - a->building->first];
    }
    return flexibility;
}

// How the floors of its buildings respond to its force.
static void find_columns(const struct work *w, struct link_scratch *p) {
    const struct link *l = p->link;
    double *combined = p->combined;
    p->factors = w->factors;
    p->flexibility = 0.0;
    if (p->resolved->factors != w->factors) {
        p->resolved->factors = w->factors;
        p->resolved->depth = 0.0;
    }
    double sum = 0.0;
    for (int i = 0; i < 2; i++) {
        if (l->dof[i] != WALL) {
            struct effective *a = &w->effective[l->building[i]];
            int floor = l->floor[i] - 1;
            const double *column;
            struct reach reach;
            if (l->row[i].n > 0) {
                p->flexibility += combine_columns(a, l, i, combined, &reach);
                column = combined;
                combined += lanes_whole(a->building->n_floor);
            } else {
                column = effective_column(a, floor);
                reach = a->reach[floor];
                p->flexibility += column[floor];
            }
            sum += sum_of_sizes(column, a->building->n_floor);
            p->column[i] = column + reach.from;
            p->first[i] = a->building->first + reach.from;
            p->lanes[i] = reach.to - reach.from;
        }
    }
    p->others = number_max(w->crowd * sum / p->flexibility - 1.0, 0.0);
    p->unmoved = 1.0 / (p->flexibility * p->others + DBL_MIN);
}

// Asks the law of a link at x. False: a Newton step is not safe.
static inline bool ask(const struct work *w, struct link_scratch *p, double x, struct progress *s) {
    double d = END(p->d_trial, w->b, x);
    double v = END(p->v_trial, w->g, x);
    if (!p->trusted || !(d > 0.0 || p->bilateral)) {
        return false;
    }
    p->ask = true;
    struct contact_response law = p->kind->force(p->constant, p->history, d, v);
    double share = p->flexibility * SLOPE(w, &law);
    if (!IS_SHALLOW(share)) {
        return false;
    }
    p->ask = false;
    p->dfdd = law.dfdd;
    p->dfdv = law.dfdv;
    double near = p->bilateral ? INFINITY : LINK_NEAR * d * w->per_b;
    struct link_asked asked = {x, v, near, p->force, s->enough, law.force, law.dfdd, law.dfdv};
    link_linearise(w, &asked, &share, p->kind->traits & CONTACT_SMOOTH, &p->tangent);
    s->echo = number_max(s->echo, share * p->others);
    return true;
}

// d and v of a link without corrections, and its columns unless they are those of the last step.
static inline void gather(struct work *w, const struct state *next, struct link_scratch *p) {
    p->trusted = p->branch == BRANCH_CLOSED && p->kind->force && !p->clamped;
    p->open = false;
    p->ask = true;
    p->d_trial = sweep_across(p, w->u_trial) - p->gap;
    p->v_trial = sweep_across(p, w->v_trial);
    if (p->moving_ground) {
        p->d_trial += state_ground_gap(p->link, w->model, next->ground_u);
        p->v_trial += state_ground_gap(p->link, w->model, next->ground_v);
    }
    if (p->factors != w->factors) {
        find_columns(w, p);
    }
}

void sweep_begin(struct work *w, const struct state *next, struct progress *s) {
    *s = (struct progress){0};
    w->n_acting = next->n_live;
    for (int i = 0; i < w->n_acting; i++) {
        int k = next->live[i];
        w->acting[i] = &w->link[k];
        w->link[k].force = next->link[k].force;
        s->largest = number_max(s->largest, fabs(next->link[k].force));
    }
}

// x of link_terms.h.
static inline double sees(const struct work *w, const struct link_scratch *p) {
    return sweep_across(p, w->correction);
}

void sweep_gather(struct work *w, const struct state *next, int first, int end,
                  struct progress *s) {
    for (int i = first; i < end; i++) {
        struct link_scratch *p = w->acting[i];
        gather(w, next, p);
        ask(w, p, sees(w, p), s);
    }
    s->loosest = s->enough;
}

void sweep_ask_again(struct work *w, struct progress *s) {
    bool looser = s->loosest > LINK_LOOSER * s->enough;
    for (int i = 0, n = looser ? w->n_acting : 0; i < n; i++) {
        struct link_scratch *p = w->acting[i];
        p->ask = true;
        ask(w, p, sees(w, p), s);
    }
    s->loosest = looser ? s->enough : number_max(s->loosest, s->enough);
}

// q += f column; beyond the floors of the building the column is 0.
static inline void push(double *restrict q, const double *restrict column, int n, double f) {
    for (int i = 0; i != n; i += LANES_WIDTH) {
        lanes low = *(const lanes *)(q + i) + f * *(const lanes *)(column + i);
        lanes high = *(const lanes *)(q + i + LANES_VECTOR) +
                     f * *(const lanes *)(column + i + LANES_VECTOR);
        *(lanes *)(q + i) = low;
        *(lanes *)(q + i + LANES_VECTOR) = high;
    }
}

static inline void push_ends(const struct work *w, const struct link_scratch *p, double df) {
    push(w->correction + p->first[0], p->column[0], p->lanes[0], -df);
    push(w->correction + p->first[1], p->column[1], p->lanes[1], df);
}

void sweep_push(const struct work *w, const struct link_scratch *p, double df) {
    push_ends(w, p, df);
}

// The sizes of x at both ends, one of which is a row; and of any link.
static __attribute__((noinline)) double size_rows(const struct link_scratch *p, const double *x) {
    return link_size(p->link, x);
}

static inline double size(const struct link_scratch *p, const double *x) {
    return p->end[0] >= 0 ? fabs(x[p->end[0]]) + fabs(x[p->end[1]]) : size_rows(p, x);
}

// Is a change of the force no more than the rounding of d and v makes of it?
static inline bool negligible(const struct work *w, const struct link_scratch *p, double df) {
    double q = size(p, w->correction);
    double d = size(p, w->u_trial) + p->gap + w->b * q;
    double v = size(p, w->v_trial) + w->g * q;
    return fabs(df) <= ROUNDING(p->tangent.damped, p->dfdd, d, p->dfdv, v);
}

// Records the change df of a force, by whether its law must be asked again.
static inline void note(const struct work *w, const struct link_scratch *p, double df,
                        struct progress *s) {
    double *most = &s->moved[p->ask ? LAW_UNKNOWN : LAW_KNOWN];
    if (fabs(df) > *most && fabs(df) > s->enough && !negligible(w, p, df)) {
        *most = fabs(df);
    }
}

// A link that is `far` from where its tangent begins stays within its reach as long as the forces
// of others change by no more than this.
static inline double room(const struct link_scratch *p, double far) {
    return number_max(p->tangent.reach - far, 0.0) * p->unmoved;
}

// A Newton step of a link at x; false: not safe.
static inline bool step(const struct work *w, struct link_scratch *p, double x, struct progress *s,
                        double *clear) {
    struct tangent *t = &p->tangent;
    double dx = x - t->asked;
    double df = CHANGE(t, dx);
    if (IS_IDLE(t, dx, df, s->enough)) {
        *clear = number_min(*clear, room(p, fabs(dx)));
        return true;
    }
    double led = LED(dx, p->flexibility, df);
    if (!IS_SAFE(t, led, df, p->force)) {
        return false;
    }
    p->force += df;
    t->base -= t->damped * df;
    p->ask = !(led <= t->reach);
    *clear = number_min(*clear, room(p, led));
    push_ends(w, p, df);
    note(w, p, df, s);
    return true;
}

// Does a link at x stay open?
static inline bool stays_open(const struct work *w, const struct link_scratch *p, double x,
                              double *clear) {
    double d = p->d_trial + w->b * x;
    if (!(p->open && d <= 0.0)) {
        return false;
    }
    *clear = number_min(*clear, -d * w->per_b * p->unmoved);
    return true;
}

LANES int sweep_newton(struct work *w, int first, int end, struct progress *s) {
    double clear = s->clear, largest = s->largest;
    int i = first;
    for (; i < end; i++) {
        struct link_scratch *p = w->acting[i];
        double x = sees(w, p);
        double dx = x - p->tangent.asked;
        bool known = (!p->ask && IS_ON_TANGENT(&p->tangent, dx)) || ask(w, p, x, s);
        if (known ? !step(w, p, x, s, &clear) : !stays_open(w, p, x, &clear)) {
            break;
        }
        largest = number_max(largest, fabs(p->force));
    }
    s->clear = clear;
    s->largest = largest;
    return i;
}
