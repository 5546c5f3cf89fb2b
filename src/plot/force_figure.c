// SPDX-License-Identifier: GPL-3.0-or-later
#include <assert.h>

#include "plot/legend.h"
#include "plot/panel.h"
#include "plot/pictures.h"
#include "plot/scale.h"
#include "plot/script.h"

int force_figure_write(const struct force_figure *f, const struct figure_files *to,
                       struct error *e) {
    assert(f->n_curve <= IMPACT_FIGURE_CURVES);
    struct unit_system si;
    unit_system_init(&si);
    const struct figure_head head = {.name = "over",
                                     .doc = "peak force of isolated impacts",
                                     .version = f->version,
                                     .units = &si};
    struct span x = span_none, y = span_none;
    for (int c = 0; c < f->n_curve; c++) {
        for (size_t i = 0; i < f->curve[c].n; i++) {
            span_add(&x, f->curve[c].x[i]);
            span_add(&y, f->curve[c].force[i]);
        }
    }
    struct canvas canvas;
    figure_open(&head, to, &canvas, e);
    const struct scale force = scale_for(scale_forces, y.high);
    struct legend l = {0};
    for (int c = 0; c < f->n_curve; c++) {
        fprintf(to->data, "$force%d << EOD\n# value force\n", c);
        for (size_t i = 0; i < f->curve[c].n; i++) {
            fprintf(to->data, "%.9g %.9g\n", f->curve[c].x[i], f->curve[c].force[i] / force.size);
        }
        fprintf(to->data, "EOD\n");
        legend_add(&l, panel_line(script_colour[c], 0), f->curve[c].name, "");
    }
    canvas_head(&canvas, "Peak force of an isolated impact", "%s", f->subtitle);
    legend_write(&l, &canvas);
    panel_open(&canvas,
               &(struct panel){.area = canvas_inset(canvas.area, 5.8, 0.8, 3.2, 0.7),
                               .x = {.name = f->name,
                                     .unit = f->unit,
                                     .span = x,
                                     .kind = f->logarithmic ? AXIS_LOGARITHMIC : AXIS_FULL},
                               .y = scale_axis("peak force", &force, span_with_room(y, 0))});
    for (int c = 0; c < f->n_curve; c++) {
        panel_series(&canvas, panel_line(script_colour[c], 0), "$force%d using 1:2", c);
    }
    panel_close(&canvas);
    return figure_close(&canvas);
}
