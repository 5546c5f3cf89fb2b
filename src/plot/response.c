// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot/response.h"

#include <math.h>
#include <stdbool.h>

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
        const bool band = s->n_damping == 1;
        snprintf(text, sizeof text, "mean%s of the records%s", band ? " and 16 to 84 %" : "",
                 band && s->n_record <= NAMED_MAX ? "; at each name its PGA and PGV" : "");
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
        script_legend(to, 0, 1, SCRIPT_LINE, other_colour, text);
        return 1;
    }
    for (int r = 0; r < s->n_record; r++) {
        script_cut(sheet->name[r], 24, name, sizeof name);
        snprintf(text, sizeof text, "%s: %.2g g, %.2g m/s", name,
                 sheet->intensity[r].pga / sheet->gravity, sheet->intensity[r].pgv);
        script_legend(to, 2 * r, 2, SCRIPT_LINE, record_colour[r], text);
    }
    return 2 * s->n_record;
}

// Returns how many lines of four places it takes.
static int write_legend(const struct response_sheet *sheet, FILE *to) {
    const struct spectra *s = sheet->spectra;
    int n = 0;
    if (s->n_damping == 1 && s->n_record > 1) {
        n = write_record_legend(sheet, to);
        script_legend(to, n++, 1, SCRIPT_LINE, mean_colour, "mean");
        script_legend(to, n++, 1, SCRIPT_AREA, band_colour, "16 to 84 %");
    }
    for (int d = 0; s->n_damping > 1 && d < s->n_damping; d++) {
        char text[64];
        snprintf(text, sizeof text, "%g %% damping", 100.0 * s->damping[d]);
        script_legend(to, n++, 1, SCRIPT_LINE, script_colour[d % SCRIPT_COLOURS], text);
    }
    return (n + 3) / 4;
}

// A tic at 1, 2 and 5 of every decade; at every digit where there is little more than one decade.
static void write_tics(double first, double last, FILE *to) {
    const char *comma = "";
    fprintf(to, "set logscale x\nset xtics (");
    for (int decade = (int)floor(log10(first)); decade <= (int)ceil(log10(last)); decade++) {
        for (int digit = 1; digit <= 9; digit++) {
            const bool wanted = digit == 1 || digit == 2 || digit == 5 || last < 15.0 * first;
            const double tic = digit * pow(10.0, decade);
            if (wanted && tic >= first * (1.0 - 1e-9) && tic <= last * (1.0 + 1e-9)) {
                fprintf(to, "%s'%g' %g", comma, tic, tic);
                comma = ", ";
            }
        }
    }
    fprintf(to, ")\n");
}

// Periods within a factor of 2 are drawn without logarithms.
static void write_axes(const struct spectra *s, FILE *to) {
    const double last = s->period[s->n_period - 1];
    double first = last;
    for (int p = s->n_period - 1; p >= 0 && s->period[p] > 0.0; p--) {
        first = s->period[p];
    }
    if (last > 2.0 * first) {
        write_tics(first, last, to);
    }
    fprintf(to,
            "set xrange [%.9g:%.9g]\nset yrange [0:*]\nset offsets 0, 0, graph 0.04, 0\n"
            "set xlabel 'period [s]'\nset ylabel 'pseudo-acceleration [g]'\n",
            first, last);
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
    const double top = 0.859 - 0.028 * write_legend(sheet, to);
    fprintf(to,
            "set lmargin at screen 0.085\nset rmargin at screen 0.975\n"
            "set tmargin at screen %.3f\nset bmargin at screen 0.105\n",
            top);
    write_axes(sheet->spectra, to);
    write_plot(sheet->spectra, to);
    figure_end(to);
    return STATUS_OK;
}
