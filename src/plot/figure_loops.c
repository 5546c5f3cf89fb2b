// SPDX-License-Identifier: GPL-3.0-or-later
// Force against deformation: the contact that was hit hardest, of the buildings beside it, or the
// first two, the storey with the largest drift, and the link that has dissipated most. The rows of
// output are drawn; a contact needs many of them.
#include <math.h>
#include <stdlib.h>

#include "plot/figure.h"
#include "plot/panel.h"
#include "plot/script.h"

enum { BINS = 800, IMPACTS_MAX = 12, LOOP_ROWS = 6, FINE_ROWS = 10 };
enum { STOREYS_MAX = 2, LOOPS_MAX = STOREYS_MAX + 1, PANELS_MAX = 1 + LOOPS_MAX };

struct view {
    const struct runs *s;
    int contact[RUNS_MAX];                     // the hardest; -1: none
    long impact[RUNS_MAX];                     // its hardest impact
    size_t rows[RUNS_MAX];                     // within that
    bool others;                               // loops of other impacts are drawn
    int n_loop;                                // of storeys, then of a link
    int building[LOOPS_MAX];                   // -1: it is a link
    int number[LOOPS_MAX];                     // of the storey or the link, from 0
    struct span x[PANELS_MAX], y[PANELS_MAX];  // the contact's first
    struct span all_x, all_y;                  // drifts, forces: one unit for one quantity
};

static const unsigned storey_fields = FIELD_DRIFT | FIELD_STOREY_SHEAR;
static const unsigned contact_fields = FIELD_FORCE | FIELD_PENETRATION;

// A free body has none.
static bool has_storeys(const struct runs *s, int building) {
    return runs_have(s, storey_fields) && s->r[0]->building[building].stiffness[0] > 0;
}

// Rigid impacts have no force.
static bool has_contact(const struct runs *s) {
    int contact[RUNS_MAX];
    runs_hardest_contact(s, contact);
    return runs_have(s, contact_fields) && runs_hardest_impact(s->r[0], contact[0]) >= 0 &&
           isfinite(s->r[0]->contact[contact[0]].peak.force);
}

// The link that has dissipated most; where none has, that with the largest force. -1: there is no
// such link, or no history of it.
static int hardest_link(const struct runs *s) {
    const struct report *r = s->r[0];
    int most = -1;
    for (int i = 0; i < r->n_link && runs_have(s, contact_fields); i++) {
        const struct link_peak *p = &r->link[i].peak;
        const struct link_peak *best = most < 0 ? NULL : &r->link[most].peak;
        const bool harder =
            !best || p->lost > best->lost || (p->lost == best->lost && p->force > best->force);
        most = p->force > 0.0 && harder ? i : most;
    }
    return most;
}

static int check(const struct subject *p, struct error *e) {
    const struct runs *s = p->runs;
    bool any = has_contact(s) || hardest_link(s) >= 0;
    for (int i = 0; i < s->r[0]->n_building && !any; i++) {
        any = has_storeys(s, i);
    }
    if (any) {
        return STATUS_OK;
    }
    const unsigned fields = storey_fields | contact_fields;
    return runs_have(s, fields) ? runs_lack(s, "storeys, and no impact with a force", e)
                                : runs_need(s, fields, "forces with their deformations", e);
}

static void add_storey(struct view *v, int building) {
    if (building < 0 || v->n_loop == STOREYS_MAX || !has_storeys(v->s, building)) {
        return;
    }
    const struct report_building *b = &v->s->r[0]->building[building];
    int most = 0;
    for (int i = 1; i < b->n_floor; i++) {
        most = b->peak[PEAK_DRIFT][i] > b->peak[PEAK_DRIFT][most] ? i : most;
    }
    v->building[v->n_loop] = building;
    v->number[v->n_loop++] = most;
}

static void choose(struct view *v) {
    const struct report *r = v->s->r[0];
    int hit[RUNS_MAX];
    runs_hardest_contact(v->s, hit);
    const struct report_link *c = hit[0] >= 0 ? &r->contact[hit[0]] : NULL;
    for (int k = 0; k < RUNS_MAX; k++) {
        v->contact[k] = has_contact(v->s) ? hit[k] : -1;
        v->impact[k] = k < v->s->n ? runs_hardest_impact(v->s->r[k], v->contact[k]) : -1;
    }
    if (c) {
        add_storey(v, runs_building(r, c->left));
        add_storey(v, runs_building(r, c->right));
    }
    for (int i = 0; i < r->n_building && !c; i++) {
        add_storey(v, i);
    }
    const int link = hardest_link(v->s);
    if (link >= 0) {
        v->building[v->n_loop] = -1;
        v->number[v->n_loop++] = link;
    }
}

// Whether the impact is among the hardest of its contact.
static bool is_shown(const struct report *r, long i) {
    int harder = 0;
    for (long k = 0; k < r->n_impact && harder < IMPACTS_MAX; k++) {
        harder += r->impact[k].contact == r->impact[i].contact &&
                  r->impact[k].peak_force > r->impact[i].peak_force;
    }
    return harder < IMPACTS_MAX;
}

// Fewer rows than make a loop are left unjoined, each in a block of its own. Returns how many.
static size_t write_loop(const struct data *d, const struct impact *p, FILE *to) {
    const size_t first = data_row(d, p->t_start);
    size_t end = first;
    while (end < d->n_row && d->column[0][end] <= p->t_end) {
        end++;
    }
    const char *between = end - first < LOOP_ROWS ? "\n" : "";
    for (size_t i = first; i < end; i++) {
        fprintf(to, "%.7g %.7g\n%s", d->column[1][i], d->column[2][i], between);
    }
    fprintf(to, "\n");
    return end - first;
}

static void write_contact_data(struct view *v, int run, struct canvas *c) {
    const struct report *r = v->s->r[run];
    const int contact = v->contact[run];
    const struct history h[] = {{.kind = HISTORY_TIME},
                                {HISTORY_CONTACT, FIELD_PENETRATION, contact, 0},
                                {HISTORY_CONTACT, FIELD_FORCE, contact, 0}};
    struct data d;
    if (runs_read(v->s, run, h, 3, &d, c)) {
        canvas_block(c, "penetration force, an impact a block", "loops%d", run);
        fputs("NaN NaN\n\n", c->data);
        for (long i = 0; i < r->n_impact; i++) {
            if (r->impact[i].contact == contact && is_shown(r, i)) {
                const bool loop = write_loop(&d, &r->impact[i], c->data) >= LOOP_ROWS;
                v->others = v->others || (loop && i != v->impact[run]);
            }
        }
        canvas_end(c);
        canvas_block(c, "penetration force", "hardest%d", run);
        fputs("NaN NaN\n", c->data);
        v->rows[run] = write_loop(&d, &r->impact[v->impact[run]], c->data);
        canvas_end(c);
        // The largest penetration and force of each impact in the figure, over all computed steps.
        canvas_block(c, "largest penetration, largest force", "largest%d", run);
        for (long i = 0; i < r->n_impact; i++) {
            if (r->impact[i].contact == contact && is_shown(r, i)) {
                fprintf(c->data, "%.7g %.7g\n", r->impact[i].max_penetration,
                        r->impact[i].peak_force);
            }
        }
        canvas_end(c);
        span_add(&v->x[0], r->contact[contact].peak.penetration);
        span_add(&v->y[0], r->contact[contact].peak.force);
        data_span(&d, 2, &v->y[0]);
    }
    data_free(&d);
}

static void write_loop_data(struct view *v, int run, int k, struct canvas *c) {
    const int building = v->building[k], number = v->number[k];
    const bool storey = building >= 0;
    const enum history_kind kind = storey ? HISTORY_FLOOR : HISTORY_LINK;
    const int index = storey ? building : number, floor = storey ? number : 0;
    const struct history h[] = {{.kind = HISTORY_TIME},
                                {kind, storey ? FIELD_DRIFT : FIELD_PENETRATION, index, floor},
                                {kind, storey ? FIELD_STOREY_SHEAR : FIELD_FORCE, index, floor}};
    struct data d;
    if (runs_read(v->s, run, h, 3, &d, c)) {
        data_write(&d, BINS, c, "time deformation force", "storey%d%d", run, k);
        data_span(&d, 1, &v->x[1 + k]);
        data_span(&d, 2, &v->y[1 + k]);
    }
    data_free(&d);
}

// Panel 0 is that of the contact, those behind it are of storeys and of a link.
static struct panel panel_of(const struct view *v, int i, struct area a) {
    const double from = i == 0 ? 0 : (double)NAN;
    const bool link = i > 0 && v->building[i - 1] < 0;
    return (struct panel){.area = a,
                          .x = {.name = i == 0 ? "penetration"
                                        : link ? "shortening"
                                               : "drift",
                                .dimension = dimension_length,
                                .span = span_with_room(v->x[i], from),
                                .scale = i == 0 ? span_none : v->all_x},
                          .y = {.name = i == 0 ? "contact force"
                                        : link ? "link force"
                                               : "storey shear",
                                .dimension = dimension_force,
                                .span = span_with_room(v->y[i], from),
                                .scale = v->all_y}};
}

static void draw_contact(const struct view *v, struct canvas *c, struct area a) {
    struct panel p = panel_of(v, 0, a);
    p.caption = v->s->r[0]->contact[v->contact[0]].name;
    panel_open(c, &p);
    for (int k = 0; k < v->s->n; k++) {
        const char *colour = script_colour[k];
        if (v->impact[k] >= 0) {
            panel_series(c, panel_line(colour, 0.5), "$loops%d using 1:2", k);
            panel_series(c,
                         (struct style){STYLE_BOTH, .colour = colour, .width = 1.3,
                                        .point = k > 0 ? POINT_RING : POINT_DISC, .size = 0.8},
                         "$hardest%d using 1:2", k);
            panel_series(c, panel_points(k > 0 ? colour : "#404040", POINT_CROSS, 1.3),
                         "$largest%d using 1:2", k);
        }
    }
    panel_close(c);
}

static void draw_loop(const struct view *v, struct canvas *c, struct area a, int k) {
    struct panel p = panel_of(v, 1 + k, a);
    char storey[32];
    snprintf(storey, sizeof storey, ", storey %d", v->number[k] + 1);
    if (v->building[k] < 0) {
        p.caption = v->s->r[0]->link[v->number[k]].name;
    } else {
        p.caption = v->s->r[0]->building[v->building[k]].name;
        p.tail = storey;
    }
    panel_open(c, &p);
    for (int run = 0; run < v->s->n; run++) {
        panel_series(c, panel_line(script_colour[run], 0.7), "$storey%d%d using 2:3", run, k);
    }
    panel_close(c);
}

static void write_head(const struct view *v, struct canvas *c) {
    const bool coarse = v->impact[0] >= 0 && v->rows[0] < FINE_ROWS;
    struct legend l = {0};
    canvas_head(c, v->s->title, "forces against deformations%s",
                coarse ? "; output -every 1 gives whole contact loops" : "");
    if (v->impact[0] >= 0) {
        legend_add(&l, panel_points("#404040", POINT_CROSS, 1.3), "largest force, penetration", "");
    }
    if (v->rows[0] > 0 && v->s->n == 1) {
        legend_add(&l,
                   (struct style){.kind = v->rows[0] < LOOP_ROWS ? STYLE_POINTS : STYLE_LINE,
                                  .colour = script_colour[0],
                                  .size = 0.8,
                                  .point = POINT_DISC},
                   "hardest impact, at rows", "");
    }
    if (v->others && v->s->n == 1) {
        legend_add(&l, panel_line(script_colour[0], 0), "other impacts", "");
    }
    runs_legend(v->s, NULL, &l);
    legend_write(&l, c);
}

static void draw(const struct subject *subject, struct canvas *c) {
    const struct runs *s = subject->runs;
    struct view v = {.s = s, .all_x = span_none, .all_y = span_none};
    for (int i = 0; i < PANELS_MAX; i++) {
        v.x[i] = v.y[i] = span_none;
    }
    choose(&v);
    for (int run = 0; run < v.s->n; run++) {
        if (v.impact[run] >= 0) {
            write_contact_data(&v, run, c);
        }
        for (int k = 0; k < v.n_loop; k++) {
            write_loop_data(&v, run, k, c);
        }
    }
    // Penetrations are apart from the drifts, and mostly far smaller.
    for (int i = 0; i < PANELS_MAX; i++) {
        span_join(&v.all_y, v.y[i]);
        span_join(&v.all_x, i > 0 ? v.x[i] : span_none);
    }
    write_head(&v, c);
    const bool contact = v.contact[0] >= 0;
    const int n = contact + v.n_loop;
    for (int i = 0; i < n; i++) {
        const struct area a =
            canvas_inset(canvas_part(c, (double)i / n, (i + 1.0) / n, 0, 1), 5.6, 0.8, 3.2, 1.8);
        if (contact && i == 0) {
            draw_contact(&v, c, a);
        } else {
            draw_loop(&v, c, a, i - contact);
        }
    }
}

const struct figure figure_loops = {
    .name = "loops",
    .doc = "contact force against penetration, storey shear against drift, link force against "
           "shortening",
    .check = check,
    .draw = draw,
};
