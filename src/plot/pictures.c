// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot/pictures.h"

#include "plot/legend.h"
#include "plot/script.h"

static const char sample_colour[] = "#808080";

const struct scale pictures_forces[] = {{1e6, "MN"}, {1e3, "kN"}, {1.0, "N"}, {0.0, NULL}};
const struct scale pictures_lengths[] = {{1.0, "m"}, {1e-3, "mm"}, {1e-6, "µm"}, {0.0, NULL}};
const struct scale pictures_energies[] = {{1e6, "MJ"}, {1e3, "kJ"}, {1.0, "J"}, {0.0, NULL}};

struct scale pictures_scale(const struct scale *known, double largest) {
    int i = 0;
    while (known[i + 1].unit && largest < known[i].size) {
        i++;
    }
    return known[i];
}

struct axis pictures_scaled_axis(const char *name, const struct scale *s, struct span span) {
    return (struct axis){
        .name = name, .unit = s->unit, .span = {span.low / s->size, span.high / s->size}};
}

void pictures_law_panel(struct canvas *c, const struct panel *p, int n_curve, int x, int y,
                        double sample) {
    panel_open(c, p);
    fprintf(c->to, "set xzeroaxis lc rgb '#808080' lt 1 lw 0.6\n");
    if (sample > 0) {
        panel_series(c, panel_points(sample_colour, POINT_DISC, sample), "$measured using 1:2");
    }
    for (int k = 0; k < n_curve; k++) {
        panel_series(c, panel_line(script_colour[k], 0), "$curve%d using %d:%d", k, x, y);
    }
    panel_close(c);
}

void pictures_law_legend(struct canvas *c, const char *const *name, int n_curve, size_t n_sample) {
    struct legend l = {0};
    for (int k = 0; k < n_curve; k++) {
        legend_add(&l, panel_line(script_colour[k], 0), name[k], "");
    }
    if (n_sample > 0) {
        legend_add(&l, panel_points(sample_colour, POINT_DISC, 0.8), "measured", "");
    }
    if (l.n != 1) {
        legend_write(&l, c);
    }
}
