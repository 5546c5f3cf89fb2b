// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot/impact_figure.h"

#include <math.h>
#include <stdlib.h>

#include "plot/figure.h"
#include "plot/script.h"

enum { SAMPLES_SHOWN = 1500 };  // pairs of a smallest and a largest one

// Of the contact, how much of a record is shown before and after.
static const double AROUND = 0.15;

// A unit in which values need few digits.
struct scale {
    double size;
    const char *unit;
};
static const struct scale forces[] = {{1e6, "MN"}, {1e3, "kN"}, {1.0, "N"}, {0.0, NULL}};
static const struct scale times[] = {{1.0, "s"}, {1e-3, "ms"}, {1e-6, "µs"}, {0.0, NULL}};
static const struct scale lengths[] = {{1.0, "m"}, {1e-3, "mm"}, {1e-6, "µm"}, {0.0, NULL}};

// Largest and smallest values of what is shown.
struct extent {
    double force_min, force_max, time_min, time_max, depth_max;
};

struct scales {
    struct scale force, time, length;
};

static struct scale scale_for(const struct scale *known, double largest) {
    int i = 0;
    while (known[i + 1].unit && largest < known[i].size) {
        i++;
    }
    return known[i];
}

static void widen(struct extent *x, double time, double force, double depth) {
    x->time_min = fmin(x->time_min, time);
    x->time_max = fmax(x->time_max, time);
    x->force_min = fmin(x->force_min, force);
    x->force_max = fmax(x->force_max, force);
    x->depth_max = fmax(x->depth_max, depth);
}

static struct extent extent_of(const struct impact_figure *f) {
    struct extent x = {.time_min = INFINITY, .time_max = -INFINITY};
    for (int c = 0; c < f->n_curve; c++) {
        const struct impact_curve *curve = &f->curve[c];
        for (size_t i = 0; i < curve->n; i++) {
            const struct isolated_point *p = &curve->point[i];
            widen(&x, curve->start + p->time, p->force, p->penetration);
        }
    }
    if (f->n_sample > 0) {
        const double margin = AROUND * (x.time_max - x.time_min);
        x.time_min -= margin;
        x.time_max += margin;
    }
    for (size_t i = 0; i < f->n_sample; i++) {
        if (f->time[i] >= x.time_min && f->time[i] <= x.time_max) {
            widen(&x, f->time[i], f->force[i], 0.0);
        }
    }
    return x;
}

static struct scales scales_of(const struct extent *x) {
    return (struct scales){.force = scale_for(forces, fmax(x->force_max, -x->force_min)),
                           .time = scale_for(times, x->time_max - x->time_min),
                           .length = scale_for(lengths, x->depth_max)};
}

// The curve from a force of 0 at closure to one of 0 at opening.
static void write_curve(const struct impact_curve *curve, int c, const struct scales *s, FILE *to) {
    fprintf(to, "$curve%d << EOD\n# time force penetration\n", c);
    for (size_t i = 0; i < curve->n; i++) {
        const struct isolated_point *p = &curve->point[i];
        const double time = (curve->start + p->time) / s->time.size;
        const double depth = p->penetration / s->length.size;
        const bool edge = i == 0 || i + 1 == curve->n;
        if (i == 0) {
            fprintf(to, "%.9g 0 %.9g\n", time, depth);
        }
        fprintf(to, "%.9g %.9g %.9g\n", time, p->force / s->force.size, depth);
        if (edge && i > 0) {
            fprintf(to, "%.9g 0 %.9g\n", time, depth);
        }
    }
    fprintf(to, "EOD\n");
}

static int write_samples(const struct impact_figure *f, const struct scales *s, FILE *to,
                         struct error *e) {
    size_t *row = calloc(f->n_sample, sizeof *row);
    if (!row) {
        return error_no_memory(e);
    }
    const size_t n = script_thin(&f->force, 1, f->n_sample, SAMPLES_SHOWN, row);
    fprintf(to, "$measured << EOD\n# time force\n");
    for (size_t i = 0; i < n; i++) {
        fprintf(to, "%.9g %.9g\n", f->time[row[i]] / s->time.size,
                f->force[row[i]] / s->force.size);
    }
    fprintf(to, "EOD\n");
    free(row);
    return STATUS_OK;
}

static void write_legend(const struct impact_figure *f, FILE *to) {
    script_head(to, f->title, f->subtitle);
    if (f->n_curve + (f->n_sample > 0) == 1) {
        return;
    }
    for (int c = 0; c < f->n_curve; c++) {
        script_legend(to, c, 1, SCRIPT_LINE, script_colour[c], f->curve[c].name);
    }
    if (f->n_sample > 0) {
        script_legend(to, f->n_curve, 1, SCRIPT_POINT, "#808080", "measured");
    }
}

static void write_axis(FILE *to, const char *axis, const char *name, const struct scale *s,
                       double low, double high) {
    const double margin = 0.05 * (high - low);
    fprintf(to, "set %srange [%.9g:%.9g]\nset %slabel '%s [%s]'\n", axis,
            (low < 0.0 ? low - margin : low) / s->size, (high + margin) / s->size, axis, name,
            s->unit);
}

// One panel: `column` of the data against the force.
static void write_panel(const struct impact_figure *f, int column, double left, FILE *to) {
    fprintf(to, "set lmargin at screen %.4f\nset rmargin at screen %.4f\nplot \\\n", left,
            left + 0.395);
    if (f->n_sample > 0 && column == 1) {
        fprintf(to, "  $measured using 1:2 with points pt 7 ps 0.6 lc rgb '#808080', \\\n");
    }
    for (int c = 0; c < f->n_curve; c++) {
        fprintf(to, "  $curve%d using %d:2 with lines lw 1.4 lc rgb '%s'%s\n", c, column,
                script_colour[c], c + 1 < f->n_curve ? ", \\" : "");
    }
}

static void write_panels(const struct impact_figure *f, const struct extent *x,
                         const struct scales *s, FILE *to) {
    fprintf(to, "set multiplot\nset tmargin at screen 0.83\nset bmargin at screen 0.115\n"
                "set xzeroaxis lc rgb '#808080'\n");
    write_axis(to, "y", "contact force", &s->force, x->force_min, x->force_max);
    write_axis(to, "x", "time", &s->time, x->time_min, x->time_max);
    write_panel(f, 1, 0.085, to);
    fprintf(to, "unset label\nunset arrow\nunset object\n");
    write_axis(to, "x", "penetration", &s->length, 0.0, x->depth_max);
    fprintf(to, "unset ylabel\n");
    write_panel(f, 3, 0.575, to);
    fprintf(to, "unset multiplot\n");
}

int impact_figure_write(const struct impact_figure *f, const char *output, FILE *to,
                        struct error *e) {
    const struct extent x = extent_of(f);
    const struct scales s = scales_of(&x);
    int status = figure_head("impact", "force of isolated impacts", f->version, output, to, e);
    for (int c = 0; status == STATUS_OK && c < f->n_curve; c++) {
        write_curve(&f->curve[c], c, &s, to);
    }
    if (status == STATUS_OK && f->n_sample > 0) {
        status = write_samples(f, &s, to, e);
    }
    if (status == STATUS_OK) {
        write_legend(f, to);
        write_panels(f, &x, &s, to);
        figure_end(to);
    }
    return status;
}
