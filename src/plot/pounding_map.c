// SPDX-License-Identifier: GPL-3.0-or-later
// A box for each pair of periods; boxes meet halfway between periods on logarithmic axes.
#include "plot/pictures.h"

#include <math.h>

#include "plot/panel.h"

// The border below period i; i = n: above the last one.
static double border(const struct pounding_map *map, int i) {
    const double *p = map->period;
    if (i == 0) {
        return p[0] * sqrt(p[0] / p[1]);
    }
    return i == map->n ? p[i - 1] * sqrt(p[i - 1] / p[i - 2]) : sqrt(p[i - 1] * p[i]);
}

static struct span write_data(const struct pounding_map *map, struct canvas *c) {
    struct span force = span_none;
    canvas_block(c, "T1, T2, borders of T1, borders of T2, force", "forces");
    for (int i = 0; i < map->n; i++) {
        for (int k = 0; k < map->n; k++) {
            const double value = map->force[(size_t)i * (size_t)map->n + (size_t)k];
            fprintf(c->data, "%.7g %.7g %.7g %.7g %.7g %.7g %.7g\n", map->period[i], map->period[k],
                    border(map, i), border(map, i + 1), border(map, k), border(map, k + 1), value);
            span_add(&force, value);
        }
    }
    canvas_end(c);
    return (struct span){0, force.high > 0 ? force.high : 1};
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
    figure_open(&head, to, &c, e);
    const struct span force = write_data(map, &c);
    canvas_head(&c, map->title, "%s", map->subtitle);
    const struct panel p = {.area = canvas_inset(c.area, 5.8, 9.5, 3.2, 0.7),
                            .x = period_axis(map, "T1, period of the left structure"),
                            .y = period_axis(map, "T2, period of the right structure")};
    panel_open(&c, &p);
    panel_shades(&c, SHADES_AREAS, force.high);
    // Each box reaches a little under the next one, lest the page shows between them.
    panel_series(&c, (struct style){.kind = STYLE_BOXES},
                 "$forces using 1:2:3:($4*1.01):5:($6*1.01):7");
    panel_close(&c);
    const struct area scale = {c.area.right - 2, c.area.right - 0.5, p.area.bottom, p.area.top};
    panel_shades_scale(&c, scale,
                       &(struct axis){.name = "largest contact force",
                                      .dimension = dimension_force,
                                      .span = force});
    return figure_close(&c);
}
