// SPDX-License-Identifier: GPL-3.0-or-later
// A box for each pair of periods; boxes meet halfway between periods on logarithmic axes.
#include "plot/pictures.h"

#include <math.h>

#include "plot/panel.h"

enum { SHADES = 64 };

// Five colours of viridis (Smith and van der Walt 2015), whose lightness rises evenly.
static const char palette[] = "set palette defined (0 '#440154', 1 '#3b528b', 2 '#21918c', "
                              "3 '#5ec962', 4 '#fde725')\nunset colorbox\n";

// The border below period i; i = n: above the last one.
static double border(const struct pounding_map *map, int i) {
    const double *p = map->period;
    if (i == 0) {
        return p[0] * sqrt(p[0] / p[1]);
    }
    return i == map->n ? p[i - 1] * sqrt(p[i - 1] / p[i - 2]) : sqrt(p[i - 1] * p[i]);
}

static struct span write_data(const struct pounding_map *map, FILE *to) {
    struct span force = span_none;
    fprintf(to, "$forces << EOD\n# T1, T2, borders of T1, borders of T2, force\n");
    for (int i = 0; i < map->n; i++) {
        for (int k = 0; k < map->n; k++) {
            const double value = map->force[(size_t)i * (size_t)map->n + (size_t)k];
            fprintf(to, "%.7g %.7g %.7g %.7g %.7g %.7g %.7g\n", map->period[i], map->period[k],
                    border(map, i), border(map, i + 1), border(map, k), border(map, k + 1), value);
            span_add(&force, value);
        }
    }
    fprintf(to, "EOD\n");
    force = (struct span){0, force.high > 0 ? force.high : 1};
    fprintf(to, "$shades << EOD\n# borders of the shade, its middle\n");
    for (int i = 0; i < SHADES; i++) {
        fprintf(to, "%.7g %.7g %.7g\n", force.high * i / SHADES, force.high * (i + 1) / SHADES,
                force.high * (i + 0.5) / SHADES);
    }
    fprintf(to, "EOD\n");
    return force;
}

static struct axis period_axis(const struct pounding_map *map, const char *name) {
    return (struct axis){.name = name,
                         .unit = "s",
                         .span = {border(map, 0), border(map, map->n)},
                         .kind = AXIS_LOGARITHMIC};
}

int pounding_map_write(const struct pounding_map *map, const struct figure_files *to,
                       struct error *e) {
    const struct figure_head head = {.name = "pounding",
                                     .doc = "pounding force spectrum",
                                     .version = map->version,
                                     .units = map->units};
    struct canvas c;
    int status = figure_open(&head, to, &c, e);
    if (status != STATUS_OK) {
        return status;
    }
    const struct span force = write_data(map, c.data);
    canvas_head(&c, map->title, map->subtitle);
    struct panel p = {.area = canvas_inset(c.area, 5.8, 9.5, 3.2, 0.7),
                      .x = period_axis(map, "T1, period of the left structure"),
                      .y = period_axis(map, "T2, period of the right structure")};
    panel_open(&c, &p);
    fprintf(c.to, "%sset cbrange [0:%.9g]\n", palette, force.high);
    // Each box reaches a little under the next one, lest the page shows between them.
    panel_series(&c, (struct style){.kind = STYLE_BOXES},
                 "$forces using 1:2:3:($4*1.01):5:($6*1.01):7");
    panel_close(&c);
    p.area.left = c.area.right - 2;
    p.area.right = c.area.right - 0.5;
    p.x = (struct axis){.span = {0, 1}, .kind = AXIS_WITHOUT_NUMBERS, .step = 1};
    p.y =
        (struct axis){.name = "largest contact force", .dimension = dimension_force, .span = force};
    panel_open(&c, &p);
    fprintf(c.to, "unset xtics\n");
    panel_series(&c, (struct style){.kind = STYLE_BOXES},
                 "$shades using (0.5):3:(0):(1):1:($2+%.9g):3", force.high / SHADES);
    panel_close(&c);
    figure_close(&c);
    return STATUS_OK;
}
