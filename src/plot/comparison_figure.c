// SPDX-License-Identifier: GPL-3.0-or-later
#include <math.h>

#include "plot/legend.h"
#include "plot/panel.h"
#include "plot/pictures.h"
#include "plot/script.h"

enum { BINS = 800 };

static const char reference_colour[] = "#808080";

static void comparison_block(const struct time_series *s, struct canvas *c, const char *data,
                             int number) {
    struct data d;
    if (c->status == STATUS_OK) {
        c->status = data_create(&d, (long)s->n, 2, c->e);
    }
    if (c->status != STATUS_OK) {
        return;
    }
    for (size_t i = 0; i < s->n; i++) {
        d.column[0][i] = s->time[i];
        d.column[1][i] = s->value[i];
    }
    data_write(&d, BINS, c, "time, value", "%s%d", data, number);
    data_free(&d);
}

static void comparison_span(const struct time_series *s, struct span *time, struct span *value) {
    for (size_t i = 0; i < s->n; i++) {
        span_add(time, s->time[i]);
        span_add(value, s->value[i]);
    }
}

// The pairs that are drawn: the first ones, which rank best, or those that differ most, in their
// order.
static int comparison_choose(const struct comparison_figure *f, int *chosen) {
    const int most = f->measured ? COMPARISON_RUNS : COMPARISON_PANELS;
    int n = 0;
    for (int i = 0; i < f->n; i++) {
        int larger = 0;
        for (int k = 0; !f->measured && k < f->n; k++) {
            const double other = f->pair[k].result.difference, own = f->pair[i].result.difference;
            larger += other > own || (other == own && k < i);
        }
        if (n < most && larger < most) {
            chosen[n++] = i;
        }
    }
    return n;
}

// Panel `i` of `n`, with the series from `first` on.
static void comparison_panel(const struct comparison_figure *f, const int *chosen, int first,
                             int last, int i, int n, struct canvas *c) {
    struct span time = span_none, value = span_none;
    const struct comparison_pair *p = &f->pair[chosen[first]];
    for (int k = first; k < last; k++) {
        comparison_span(&f->pair[chosen[k]].computed, &time, &value);
    }
    comparison_span(&p->reference, &time, &value);
    const double y0 = 1.0 - (i + 1.0) / n, y1 = 1.0 - (double)i / n;
    const bool foot = i + 1 == n;
    panel_open(c, &(struct panel){.area = canvas_inset(canvas_part(c, 0, 1, y0, y1), 0, 0.8, 0.8,
                                                       f->measured ? 0.7 : 1.6),
                                  .x = {.name = foot ? "time" : NULL,
                                        .dimension = dimension_time,
                                        .span = time,
                                        .kind = foot ? AXIS_FULL : AXIS_WITHOUT_NUMBERS},
                                  .y = {.name = n > 1 ? "" : f->quantity,
                                        .dimension = f->dimension,
                                        .span = span_with_room(value, NAN)},
                                  .caption = f->measured ? NULL : p->name});
    panel_series(c, panel_line(reference_colour, 2.0), "$reference%d using 1:2", first);
    for (int k = first; k < last; k++) {
        panel_series(c, panel_line(script_colour[k - first], 0), "$computed%d using 1:2", k);
    }
    panel_close(c);
}

static void comparison_legend(const struct comparison_figure *f, const int *chosen, int n,
                              struct canvas *c) {
    struct legend l = {0};
    legend_add(&l, panel_line(reference_colour, 2.0), f->measured ? "measured" : "other", "");
    for (int k = 0; k < (f->measured ? n : 1); k++) {
        char error[48];
        snprintf(error, sizeof error, ", error %.3g", f->pair[chosen[k]].result.error);
        legend_add(&l, panel_line(script_colour[k], 0),
                   f->measured ? f->pair[chosen[k]].name : "run", f->measured ? error : "");
    }
    legend_write(&l, c);
}

int comparison_figure_write(const struct comparison_figure *f, const struct figure_files *to,
                            struct error *e) {
    const struct figure_head head = {.name = "compare",
                                     .doc = "histories beside others",
                                     .version = f->version,
                                     .units = f->units};
    int chosen[COMPARISON_RUNS] = {0};
    const int n = comparison_choose(f, chosen), n_panel = f->measured ? 1 : n;
    struct canvas c;
    figure_open(&head, to, &c, e);
    for (int k = 0; k < n; k++) {
        comparison_block(&f->pair[chosen[k]].computed, &c, "computed", k);
        if (k == 0 || !f->measured) {
            comparison_block(&f->pair[chosen[k]].reference, &c, "reference", k);
        }
    }
    canvas_head(&c, f->title, f->measured ? "runs and a measurement" : "two histories");
    comparison_legend(f, chosen, n, &c);
    c.area.left += 5.8;
    c.area.bottom += 2.4;  // for the numbers and the name of the time
    for (int i = 0; i < n_panel; i++) {
        comparison_panel(f, chosen, i, f->measured ? n : i + 1, i, n_panel, &c);
    }
    return figure_close(&c);
}
