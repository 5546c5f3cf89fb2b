// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot/response.h"

#include <math.h>

#include "plot/figure.h"
#include "plot/script.h"

// More records than this are grey lines without names.
enum { NAMED_MAX = 6 };

static const char band_colour[] = "#d8d8d8";
static const char other_colour[] = "#a0a0a0";
static const char mean_colour[] = "#000000";
static const char *const record_colour[NAMED_MAX] = {
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
};

// Columns of the data: the period, then for each damping ratio the series of the spectra, that is
// the records and the statistics.
static int column(const struct spectra *s, int series, int damping) {
    return 2 + damping * (s->n_record + SPECTRA_STATISTICS) + series;
}

static void write_data(const struct response_sheet *sheet, FILE *to) {
    const struct spectra *s = sheet->spectra;
    fprintf(to, "# period, then for each damping ratio: records, mean, 16 %%, 50 %%, 84 %%\n"
                "$spectra << EOD\n");
    for (int p = 0; p < s->n_period; p++) {
        if (s->period[p] == 0.0) {
            continue;
        }
        fprintf(to, "%.9g", s->period[p]);
        for (int d = 0; d < s->n_damping; d++) {
            for (int k = 0; k < s->n_record + SPECTRA_STATISTICS; k++) {
                fprintf(to, " %.9g", spectra_at(s, k, d, p)->value[SPECTRUM_PSA] / sheet->gravity);
            }
        }
        fprintf(to, "\n");
    }
    fprintf(to, "EOD\n");
}

static void write_title(const struct response_sheet *sheet, FILE *to) {
    const struct spectra *s = sheet->spectra;
    const struct intensity *i = &sheet->intensity[0];
    char title[256], text[256], damping[64] = "";
    if (s->n_damping == 1) {
        snprintf(damping, sizeof damping, ", %g %% damping", 100.0 * s->damping[0]);
    }
    if (s->n_record > 1) {
        snprintf(title, sizeof title, "Response spectra of %d records%s", s->n_record, damping);
        snprintf(text, sizeof text,
                 s->n_damping == 1 ? "mean and 16 to 84 %% of the records" : "mean of the records");
    } else {
        snprintf(title, sizeof title, "Response spectrum of %s%s", sheet->name[0], damping);
        snprintf(text, sizeof text,
                 "PGA %.3g g, PGV %.3g m/s, PGD %.3g m, Arias intensity %.3g m/s, CAV %.3g m/s, "
                 "D5-95 %.3g s",
                 i->pga / sheet->gravity, i->pgv, i->pgd, i->arias, i->cav, i->d5_95);
    }
    script_head(to, title, text);
}

// Each record by name with its peaks, or all as one entry. Returns the next place of the legend.
static int write_record_legend(const struct response_sheet *sheet, FILE *to) {
    const struct spectra *s = sheet->spectra;
    char text[320], name[256];
    if (s->n_record > NAMED_MAX) {
        snprintf(text, sizeof text, "%d records", s->n_record);
        script_legend(to, 4, 1, SCRIPT_LINE, other_colour, text);
        return 5;
    }
    for (int r = 0; r < s->n_record; r++) {
        script_cut(sheet->name[r], 24, name, sizeof name);
        snprintf(text, sizeof text, "%s: %.2g g, %.2g m/s", name,
                 sheet->intensity[r].pga / sheet->gravity, sheet->intensity[r].pgv);
        script_legend(to, 2 * r, 2, SCRIPT_LINE, record_colour[r], text);
    }
    return 2 * s->n_record;
}

static void write_legend(const struct response_sheet *sheet, FILE *to) {
    const struct spectra *s = sheet->spectra;
    if (s->n_damping == 1 && s->n_record > 1) {
        const int place = write_record_legend(sheet, to);
        script_legend(to, place, 1, SCRIPT_LINE, mean_colour, "mean");
        script_legend(to, place + 1, 1, SCRIPT_AREA, band_colour, "16 to 84 %");
    }
    for (int d = 0; s->n_damping > 1 && d < s->n_damping; d++) {
        char text[64];
        snprintf(text, sizeof text, "%g %% damping", 100.0 * s->damping[d]);
        script_legend(to, d, 1, SCRIPT_LINE, script_colour[d % SCRIPT_COLOURS], text);
    }
}

// A tic at 1, 2 and 5 of every decade.
static void write_axes(const struct spectra *s, FILE *to) {
    const double last = s->period[s->n_period - 1];
    double first = last;
    for (int p = s->n_period - 1; p >= 0 && s->period[p] > 0.0; p--) {
        first = s->period[p];
    }
    fprintf(to, "set logscale x\nset xrange [%.9g:%.9g]\nset yrange [0:*]\nset xtics (", first,
            last);
    const char *comma = "";
    for (int decade = (int)floor(log10(first)); decade <= (int)ceil(log10(last)); decade++) {
        for (int i = 0; i < 3; i++) {
            const double tic = (i == 0 ? 1.0 : i == 1 ? 2.0 : 5.0) * pow(10.0, decade);
            if (tic >= first * (1.0 - 1e-9) && tic <= last * (1.0 + 1e-9)) {
                fprintf(to, "%s'%g' %g", comma, tic, tic);
                comma = ", ";
            }
        }
    }
    fprintf(to, ")\nset offsets 0, 0, graph 0.04, 0\n"
                "set xlabel 'period [s]'\nset ylabel 'pseudo-acceleration [g]'\n");
}

static void write_line(FILE *to, const char **comma, int at, const char *colour, double width) {
    fprintf(to, "%s \\\n  $spectra using 1:%d with lines lw %g lc rgb '%s'", *comma, at, width,
            colour);
    *comma = ",";
}

static void write_plot(const struct spectra *s, FILE *to) {
    const char *comma = "";
    fprintf(to, "plot");
    if (s->n_damping > 1) {
        for (int d = 0; d < s->n_damping; d++) {
            write_line(to, &comma, column(s, s->n_record + SPECTRA_MEAN, d),
                       script_colour[d % SCRIPT_COLOURS], 1.5);
        }
        fprintf(to, "\n");
        return;
    }
    if (s->n_record == 1) {
        write_line(to, &comma, column(s, 0, 0), script_colour[0], 1.5);
        fprintf(to, "\n");
        return;
    }
    fprintf(to, " \\\n  $spectra using 1:%d:%d with filledcurves fc rgb '%s'",
            column(s, s->n_record + SPECTRA_P16, 0), column(s, s->n_record + SPECTRA_P84, 0),
            band_colour);
    comma = ",";
    for (int r = 0; r < s->n_record; r++) {
        write_line(to, &comma, column(s, r, 0),
                   s->n_record > NAMED_MAX ? other_colour : record_colour[r], 0.8);
    }
    write_line(to, &comma, column(s, s->n_record + SPECTRA_MEAN, 0), mean_colour, 2.0);
    fprintf(to, "\n");
}

int response_write(const struct response_sheet *sheet, const char *picture, FILE *to,
                   struct error *e) {
    int status =
        figure_head("spectrum", "elastic response spectra", sheet->version, picture, to, e);
    if (status != STATUS_OK) {
        return status;
    }
    write_data(sheet, to);
    write_title(sheet, to);
    write_legend(sheet, to);
    fprintf(to, "set lmargin at screen 0.085\nset rmargin at screen 0.975\n"
                "set tmargin at screen 0.775\nset bmargin at screen 0.105\n");
    write_axes(sheet->spectra, to);
    write_plot(sheet->spectra, to);
    figure_end(to);
    return STATUS_OK;
}
