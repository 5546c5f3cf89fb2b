// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot/pictures.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "plot/legend.h"
#include "plot/panel.h"
#include "plot/script.h"

// More records than this are grey lines without names.
enum { NAMED_MAX = 6 };

static const char band_colour[] = "#d8d8d8";
static const char other_colour[] = "#a0a0a0";
static const char mean_colour[] = "#000000";
static const struct style target = {STYLE_LINE, "#c00000", 1.6, "(10,6)", 0, 0};
static const char *const record_colour[NAMED_MAX] = {
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
};

// Columns of the data: the period, then for each damping ratio the series of the spectra, that is
// the records and the statistics. The target is behind them all.
static int column(const struct spectra *s, int series, int damping) {
    return 2 + damping * (s->n_record + SPECTRA_STATISTICS) + series;
}

// In g; NAN where there is none.
static double target_value(const struct response_sheet *sheet, double period) {
    return sheet->target ? target_at(sheet->target, period) / sheet->gravity : NAN;
}

static void write_data(const struct response_sheet *sheet, struct canvas *c) {
    const struct spectra *s = sheet->spectra;
    const char *columns =
        sheet->target
            ? "period, then for each damping ratio: records, mean, 16 %, 50 %, 84 %; target"
            : "period, then for each damping ratio: records, mean, 16 %, 50 %, 84 %";
    canvas_block(c, columns, "spectra");
    for (int p = 0; p < s->n_period; p++) {
        if (s->period[p] == 0.0) {
            continue;
        }
        fprintf(c->data, "%.9g", s->period[p]);
        for (int d = 0; d < s->n_damping; d++) {
            for (int k = 0; k < s->n_record + SPECTRA_STATISTICS; k++) {
                fprintf(c->data, " %.9g",
                        spectra_at(s, k, d, p)->value[SPECTRUM_PSA] / sheet->gravity);
            }
        }
        if (sheet->target) {
            fprintf(c->data, " %.9g", target_value(sheet, s->period[p]));
        }
        fprintf(c->data, "\n");
    }
    canvas_end(c);
}

// Behind its name: the factor that brings it to the target.
static void write_factor(const struct response_sheet *sheet, int record, char *text, size_t size) {
    text[0] = '\0';
    if (sheet->target) {
        snprintf(text, size, " × %.2g", sheet->factor[record]);
    }
}

static void write_head(const struct response_sheet *sheet, const char *title, struct canvas *c) {
    const struct spectra *s = sheet->spectra;
    const struct intensity *i = &sheet->intensity[0];
    const bool band = s->n_damping == 1;
    if (sheet->target) {
        canvas_head(c, title, "%sscaled to the target from %.4g to %.4g s",
                    s->n_record > 1 ? "mean and 16 to 84 % of the records, " : "", sheet->match.low,
                    sheet->match.high);
    } else if (s->n_record > 1) {
        canvas_head(c, title, "mean%s of the records%s", band ? " and 16 to 84 %" : "",
                    band && s->n_record <= NAMED_MAX ? "; at each name its PGA" : "");
    } else {
        canvas_head(c, title,
                    "PGA %.3g g, PGV %.3g m/s, Arias %.3g m/s, CAV %.3g m/s, D5-95 %.3g s",
                    i->pga / sheet->gravity, i->pgv, i->arias, i->cav, i->d5_95);
    }
}

// Each record by name with its factor or peak, or all as one entry.
static void write_records(const struct response_sheet *sheet, struct legend *l) {
    const struct spectra *s = sheet->spectra;
    char text[128];
    if (s->n_record > NAMED_MAX) {
        snprintf(text, sizeof text, "%d records", s->n_record);
        legend_add(l, panel_line(other_colour, 0), text, "");
        return;
    }
    for (int r = 0; r < s->n_record; r++) {
        write_factor(sheet, r, text, sizeof text);
        if (!sheet->target) {
            snprintf(text, sizeof text, ": %.2g g", sheet->intensity[r].pga / sheet->gravity);
        }
        legend_add(l, panel_line(record_colour[r], 0), sheet->name[r], text);
    }
}

static void write_legend(const struct response_sheet *sheet, struct canvas *c) {
    const struct spectra *s = sheet->spectra;
    struct legend l = {0};
    if (s->n_damping == 1 && s->n_record > 1) {
        write_records(sheet, &l);
        legend_add(&l, panel_line(mean_colour, 0), "mean", "");
        legend_add(&l, panel_area(band_colour), "16 to 84 %", "");
    }
    if (sheet->target) {
        legend_add(&l, target, "target", "");
    }
    for (int d = 0; s->n_damping > 1 && d < s->n_damping; d++) {
        char text[64];
        snprintf(text, sizeof text, "%g %% damping", 100.0 * s->damping[d]);
        const char *colour = script_colour[d % SCRIPT_COLOURS];
        legend_add(&l, panel_line(colour, 0), text, "");
    }
    legend_write(&l, c);
}

// Periods within a factor of 2 are drawn without logarithms.
static struct axis period_axis(const struct spectra *s) {
    const double last = s->period[s->n_period - 1];
    double first = last;
    for (int p = s->n_period - 1; p >= 0 && s->period[p] > 0.0; p--) {
        first = s->period[p];
    }
    return (struct axis){.name = "period",
                         .dimension = dimension_time,
                         .span = {first, last},
                         .kind = last > 2.0 * first ? AXIS_LOGARITHMIC : AXIS_FULL};
}

// Of several ratios the mean is drawn, of one every record.
static struct axis acceleration_axis(const struct response_sheet *sheet) {
    const struct spectra *s = sheet->spectra;
    struct span span = span_none;
    for (int d = 0; d < s->n_damping; d++) {
        for (int k = 0; k < s->n_record + SPECTRA_STATISTICS; k++) {
            const bool drawn = s->n_damping == 1 || k == s->n_record + SPECTRA_MEAN;
            for (int p = 0; drawn && p < s->n_period; p++) {
                span_add(&span, spectra_at(s, k, d, p)->value[SPECTRUM_PSA] / sheet->gravity);
            }
        }
    }
    for (int p = 0; p < s->n_period; p++) {
        span_add(&span, target_value(sheet, s->period[p]));
    }
    return (struct axis){
        .name = "pseudo-acceleration", .unit = "g", .span = span_with_room(span, 0)};
}

static void draw_line(struct canvas *c, int at, const char *colour, double width) {
    panel_series(c, panel_line(colour, width), "$spectra using 1:%d", at);
}

// Of several damping ratios the means; of one the records, with mean and band where they are many.
static void draw_series(const struct response_sheet *sheet, struct canvas *c) {
    const struct spectra *s = sheet->spectra;
    const int n = s->n_record;
    for (int d = 0; s->n_damping > 1 && d < s->n_damping; d++) {
        draw_line(c, column(s, n + SPECTRA_MEAN, d), script_colour[d % SCRIPT_COLOURS], 1.2);
    }
    if (s->n_damping == 1 && n == 1) {
        draw_line(c, column(s, 0, 0), script_colour[0], 1.2);
    } else if (s->n_damping == 1) {
        panel_series(c, panel_area(band_colour), "$spectra using 1:%d:%d",
                     column(s, n + SPECTRA_P16, 0), column(s, n + SPECTRA_P84, 0));
        for (int r = 0; r < n; r++) {
            draw_line(c, column(s, r, 0), n > NAMED_MAX ? other_colour : record_colour[r], 0.7);
        }
        draw_line(c, column(s, n + SPECTRA_MEAN, 0), mean_colour, 1.6);
    }
    if (sheet->target) {
        panel_series(c, target, "$spectra using 1:%d", column(s, 0, s->n_damping));
    }
}

static void write_title(const struct response_sheet *sheet, struct canvas *c) {
    const struct spectra *s = sheet->spectra;
    char title[256], damping[64] = "", name[128], factor[32];
    if (s->n_damping == 1) {
        snprintf(damping, sizeof damping, ", %g %% damping", 100.0 * s->damping[0]);
    }
    if (s->n_record > 1) {
        snprintf(title, sizeof title, "Response spectra of %d%s records%s", s->n_record,
                 sheet->target ? " scaled" : "", damping);
    } else {
        write_factor(sheet, 0, factor, sizeof factor);
        script_shorten(sheet->name[0], 20, name, sizeof name);
        snprintf(title, sizeof title, "Response spectrum of %s%s%s", name, factor, damping);
    }
    write_head(sheet, title, c);
}

int response_write(const struct response_sheet *sheet, const struct figure_files *to,
                   struct error *e) {
    struct unit_system si;
    unit_system_init(&si);
    const struct figure_head head = {.name = "spectrum",
                                     .doc = "elastic response spectra",
                                     .version = sheet->version,
                                     .units = &si};
    struct canvas c;
    figure_open(&head, to, &c, e);
    write_data(sheet, &c);
    write_title(sheet, &c);
    write_legend(sheet, &c);
    const struct panel p = {.area = canvas_inset(c.area, 5.8, 0.5, 3.2, 0.7),
                            .x = period_axis(sheet->spectra),
                            .y = acceleration_axis(sheet)};
    panel_open(&c, &p);
    // The ends of the periods at which the target was compared, where they are within the picture.
    const double end[] = {sheet->match.low, sheet->match.high};
    for (int i = 0; sheet->target && i < 2; i++) {
        if (end[i] > p.x.span.low && end[i] < p.x.span.high) {
            panel_upright(&c, end[i], (struct style){STYLE_LINE, target.colour, 1, "(2,4)", 0, 0});
        }
    }
    draw_series(sheet, &c);
    panel_close(&c);
    return figure_close(&c);
}
