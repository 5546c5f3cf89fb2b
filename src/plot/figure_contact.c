// SPDX-License-Identifier: GPL-3.0-or-later
// The force of each contact and link over time, of many those with the largest, and the hardest
// impact enlarged. Rows of output may miss the peak of an impact; the largest force of each impact,
// which is kept over all computed steps, is drawn as an upright line.
#include <math.h>
#include <stdlib.h>

#include "plot/figure.h"
#include "plot/panel.h"
#include "plot/script.h"

enum { STRIPS_MAX = 6, BINS = 500, PEAKS_MAX = 500 };
enum { PULSE_ROWS = 3 };  // fewer do not tell the course of an impact: it is dotted
enum { FINE_ROWS = 10 };  // fewer are coarse: the figure says how to get more

// A contact, or behind the contacts a link, of the first run.
struct view {
    const struct runs *s;
    int n;                    // strips
    int strip[STRIPS_MAX];    // contact, or n_contact + link
    bool pushed[STRIPS_MAX];  // it ever has a force
    int n_active;             // contacts that hit and links
    int contact[RUNS_MAX];    // the hardest; -1: none
    long impact[RUNS_MAX];    // its hardest impact; -1: none, or none with a force
    int rows[RUNS_MAX];       // within that impact
    bool missed;              // rows miss the peak of an impact
    struct span force;        // of the contacts
    struct span all;          // and of the links: they share the name of the axis, and its unit
};

static int check(const struct subject *p, struct error *e) {
    const struct report *r = p->runs->r[0];
    return r->n_contact + r->n_link > 0 ? runs_need(p->runs, FIELD_FORCE, "contact forces", e)
                                        : runs_lack_contacts(p->runs, e);
}

static const struct report_link *link_of(const struct report *r, int i) {
    return i < r->n_contact ? &r->contact[i] : &r->link[i - r->n_contact];
}

// Index of the first run's contact or link in another run; -1: it has none.
static int index_in(const struct view *v, int run, int i) {
    const int n = v->s->r[0]->n_contact;
    if (i < n) {
        return runs_same_contact(v->s, run, i);
    }
    return i - n < v->s->r[run]->n_link ? v->s->r[run]->n_contact + i - n : -1;
}

// The largest force of all runs.
static double largest_force(const struct view *v, int i) {
    double force = 0;
    for (int k = 0; k < v->s->n; k++) {
        const int at = index_in(v, k, i);
        force = fmax(force, at < 0 ? 0 : link_of(v->s->r[k], at)->peak.force);
    }
    return force;
}

// Links always, contacts that were hit in any run.
static bool is_active(const struct view *v, int i) {
    bool active = i >= v->s->r[0]->n_contact;
    for (int k = 0; k < v->s->n && !active; k++) {
        const int at = index_in(v, k, i);
        active = at >= 0 && v->s->r[k]->contact[at].peak.impacts > 0;
    }
    return active;
}

// Puts `i` among the strips, the largest force first; the last one falls out.
static void place(struct view *v, int i) {
    int at = v->n;
    while (at > 0 && largest_force(v, i) > largest_force(v, v->strip[at - 1])) {
        at--;
    }
    if (at == STRIPS_MAX) {
        return;
    }
    v->n += v->n < STRIPS_MAX;
    for (int k = v->n - 1; k > at; k--) {
        v->strip[k] = v->strip[k - 1];
    }
    v->strip[at] = i;
}

static int ascending(const void *left, const void *right) {
    const int a = *(const int *)left, b = *(const int *)right;
    return (a > b) - (a < b);
}

static void choose(struct view *v) {
    const struct report *r = v->s->r[0];
    const int n = r->n_contact + r->n_link;
    for (int i = 0; i < n; i++) {
        v->n_active += is_active(v, i);
    }
    for (int i = 0; i < n; i++) {
        if (v->n_active == 0 || is_active(v, i)) {
            place(v, i);
        }
    }
    qsort(v->strip, (size_t)v->n, sizeof v->strip[0], ascending);
    runs_hardest_contact(v->s, v->contact);
    for (int k = 0; k < RUNS_MAX; k++) {
        const struct report *run = k < v->s->n ? v->s->r[k] : NULL;
        const bool force =
            run && v->contact[k] >= 0 && isfinite(run->contact[v->contact[k]].peak.force);
        v->impact[k] = force ? runs_hardest_impact(run, v->contact[k]) : -1;
    }
}

// The largest force among the impact's rows and its time; of one between two rows, its middle.
static double largest_row(const struct impact *p, const struct data *d, double *time) {
    double most = 0;
    *time = (p->t_start + p->t_end) / 2;
    for (size_t i = data_row(d, p->t_start); i < d->n_row && d->column[0][i] <= p->t_end; i++) {
        if (d->column[1][i] > most) {
            most = d->column[1][i];
            *time = d->column[0][i];
        }
    }
    return most;
}

// The largest force of each impact that the rows miss, thinned to the hardest of equal parts of the
// duration.
static void write_peaks(struct view *v, int run, int strip, const struct data *d,
                        struct canvas *c) {
    const struct report *r = v->s->r[run];
    long hardest[PEAKS_MAX];
    runs_hardest_of_parts(r, index_in(v, run, v->strip[strip]), PEAKS_MAX, hardest);
    canvas_block(c, "time of an impact, its largest force", "peaks%d%d", run, strip);
    fputs("NaN NaN\n", c->data);
    for (int k = 0; k < PEAKS_MAX; k++) {
        const struct impact *p = hardest[k] < 0 ? NULL : &r->impact[hardest[k]];
        double time;
        if (p && largest_row(p, d, &time) < 0.98 * p->peak_force) {
            fprintf(c->data, "%.7g %.7g\n", time, p->peak_force);
            v->missed = true;
        }
    }
    canvas_end(c);
}

// The rows of the hardest impact from closure on, with its ends and its peak where they are known.
static void write_pulse(struct view *v, int run, const struct data *d, struct canvas *c) {
    const struct report *r = v->s->r[run];
    const struct impact *p = &r->impact[v->impact[run]];
    const struct link_peak *peak = &r->contact[v->contact[run]].peak;
    bool done = false;
    canvas_block(c, "time from closure, force", "pulse%d", run);
    fputs("0 0\n", c->data);
    for (size_t i = data_row(d, p->t_start); i < d->n_row && d->column[0][i] <= p->t_end; i++) {
        if (!done && d->column[0][i] >= peak->force_time) {
            fprintf(c->data, "%.7g %.7g\n", peak->force_time - p->t_start, peak->force);
            done = true;
        }
        fprintf(c->data, "%.7g %.7g\n", d->column[0][i] - p->t_start, d->column[1][i]);
        v->rows[run]++;
    }
    if (!done) {
        fprintf(c->data, "%.7g %.7g\n", peak->force_time - p->t_start, peak->force);
    }
    // What is still closed when the analysis ends has not opened.
    if (p->t_end < r->duration) {
        fprintf(c->data, "%.7g 0\n", p->t_end - p->t_start);
    }
    canvas_end(c);
}

static void write_strip_data(struct view *v, int run, int strip, struct canvas *c) {
    const int i = index_in(v, run, v->strip[strip]);
    const struct report *r = v->s->r[run];
    const bool is_contact = i < r->n_contact;
    const struct history h[] = {{.kind = HISTORY_TIME},
                                {is_contact ? HISTORY_CONTACT : HISTORY_LINK, FIELD_FORCE,
                                 is_contact ? i : i - r->n_contact, 0}};
    struct data d = {.n_row = 0};
    if (i < 0 || !runs_read(v->s, run, h, 2, &d, c)) {
        data_free(&d);
        return;
    }
    data_write(&d, BINS, c, "time force", "force%d%d", run, strip);
    if (is_contact) {
        struct span force = {0, 0};
        data_span(&d, 1, &force);
        v->pushed[strip] |= force.low < force.high || r->contact[i].peak.force > 0;
        span_join(&v->force, force);
        span_add(&v->force, r->contact[i].peak.force);
        write_peaks(v, run, strip, &d, c);
    }
    if (i == v->contact[run] && v->impact[run] >= 0) {
        write_pulse(v, run, &d, c);
    }
    data_free(&d);
}

static struct span strip_span(const struct view *v, int strip) {
    const int n = v->s->r[0]->n_contact;
    if (v->strip[strip] < n) {
        return span_with_room(v->force, 0);
    }
    struct span span = span_none;
    for (int k = 0; k < v->s->n; k++) {
        const int i = index_in(v, k, v->strip[strip]);
        if (i >= 0) {
            span_add(&span, link_of(v->s->r[k], i)->peak.force);
            span_add(&span, -link_of(v->s->r[k], i)->peak.force);
        }
    }
    return span_with_room(span, NAN);
}

// Why a strip is empty; NULL: it is not.
static const char *empty_reason(const struct view *v, int strip) {
    if (v->strip[strip] >= v->s->r[0]->n_contact || v->pushed[strip]) {
        return NULL;
    }
    return is_active(v, v->strip[strip]) ? "rigid impacts have no force" : "never closed";
}

// The runs that have the contact or link, in the strip `strip` from above.
static void draw_strip(const struct view *v, struct canvas *c, double right, int strip) {
    const bool last = strip == v->n - 1;
    const double top = 1 - (double)strip / v->n, bottom = 1 - (strip + 1.0) / v->n;
    char text[320];
    snprintf(text, sizeof text, "%s%s", v->strip[strip] < v->s->r[0]->n_contact ? "" : "link ",
             link_of(v->s->r[0], v->strip[strip])->name);
    struct panel p = {
        .area = canvas_inset(canvas_part(c, 0, right, bottom, top), 5.8, 0.5, 0.2, 1.6),
        .x = runs_time_axis(v->s, last),
        .y = {.dimension = dimension_force, .span = strip_span(v, strip), .scale = v->all},
        .caption = text,
        .note = empty_reason(v, strip)};
    p.y.kind = p.note ? AXIS_WITHOUT_NUMBERS : AXIS_FULL;
    panel_open(c, &p);
    for (int k = 0; k < v->s->n; k++) {
        const char *colour = script_colour[k];
        const int i = index_in(v, k, v->strip[strip]);
        if (i >= 0) {
            panel_series(c, panel_line(colour, 0.8), "$force%d%d using 1:2", k, strip);
        }
        if (i >= 0 && i < v->s->r[k]->n_contact) {
            panel_series(c, (struct style){STYLE_UPRIGHT, .colour = colour}, "$peaks%d%d using 1:2",
                         k, strip);
        }
    }
    panel_close(c);
}

// The hardest impact of each run.
static void draw_pulse(const struct view *v, struct canvas *c, double left) {
    struct span time = span_none;
    char text[320];
    for (int k = 0; k < v->s->n; k++) {
        if (v->impact[k] >= 0) {
            const struct impact *p = &v->s->r[k]->impact[v->impact[k]];
            span_add(&time, p->t_end - p->t_start);
        }
    }
    snprintf(text, sizeof text, "hardest: %s", link_of(v->s->r[0], v->contact[0])->name);
    panel_open(
        c, &(struct panel){.area = canvas_inset(canvas_part(c, left, 1, 0, 1), 4.4, 0.5, 3.4, 1.6),
                           .x = {.name = "time from closure",
                                 .dimension = dimension_time,
                                 .span = span_with_room(time, 0)},
                           .y = {.dimension = dimension_force,
                                 .span = span_with_room(v->force, 0),
                                 .scale = v->all},
                           .caption = text});
    for (int k = 0; k < v->s->n; k++) {
        if (v->impact[k] >= 0) {
            panel_series(c,
                         (struct style){STYLE_BOTH, .colour = script_colour[k],
                                        .dash = v->rows[k] < PULSE_ROWS ? "(2,4)" : NULL,
                                        .point = k > 0 ? POINT_RING : POINT_DISC, .size = 0.8},
                         "$pulse%d using 1:2", k);
        }
    }
    panel_close(c);
}

// True if bodies met under a law without a force.
static bool is_rigid(const struct report *r) {
    bool rigid = false;
    for (int i = 0; i < r->n_contact; i++) {
        rigid |= r->contact[i].peak.impacts > 0 && isnan(r->contact[i].peak.force);
    }
    return rigid;
}

static void write_head(const struct view *v, struct canvas *c) {
    const struct report *r = v->s->r[0];
    const bool coarse = v->impact[0] >= 0 && v->rows[0] < FINE_ROWS;
    const char *missed = v->missed ? "; upright lines: peaks between rows" : "";
    const char *finer = coarse ? "; finer by output -every 1" : "";
    struct legend l = {0};
    if (v->n_active == 0) {
        canvas_head(c, v->s->title, "contact forces; no contact closed");
    } else if (is_rigid(r) || is_rigid(v->s->r[v->s->n - 1])) {
        canvas_head(c, v->s->title, "contact forces; rigid impacts have none, only rest has");
    } else if (v->n < v->n_active) {
        canvas_head(c, v->s->title, "the %d largest of %d forces%s%s", v->n, v->n_active, missed,
                    finer);
    } else {
        const char *contacts = r->n_contact > 0 ? "contact forces" : "";
        const char *between = r->n_contact > 0 && r->n_link > 0 ? " and " : "";
        canvas_head(c, v->s->title, "%s%s%s%s%s", contacts, between,
                    r->n_link > 0 ? "link forces" : "", missed, finer);
    }
    runs_legend(v->s, NULL, &l);
    legend_write(&l, c);
}

static void draw(const struct subject *subject, struct canvas *c) {
    const struct runs *s = subject->runs;
    struct view v = {.s = s, .force = span_none, .all = span_none};
    choose(&v);
    for (int k = 0; k < s->n * v.n; k++) {
        write_strip_data(&v, k / v.n, k % v.n, c);
    }
    write_head(&v, c);
    const bool zoom = v.contact[0] >= 0 && (v.impact[0] >= 0 || v.impact[1] >= 0);
    const double right = zoom ? 0.62 : 1;
    struct canvas strips = *c;
    strips.area.bottom += 3.2;
    for (int i = 0; i < v.n; i++) {
        span_join(&v.all, strip_span(&v, i));
    }
    const struct axis force = {.name = "force", .dimension = dimension_force, .span = v.all};
    canvas_upright(c, canvas_inset(canvas_part(&strips, 0, right, 0, 1), 5.8, 0.5, 0.2, 1.6),
                   &force);
    for (int i = 0; i < v.n; i++) {
        draw_strip(&v, &strips, right, i);
    }
    if (zoom) {
        draw_pulse(&v, c, right);
    }
}

const struct figure figure_contact = {
    .name = "contact",
    .doc = "force of each contact and link over time, and the strongest impact",
    .check = check,
    .draw = draw,
};
