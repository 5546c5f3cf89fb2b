// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot/panel.h"

#include <math.h>
#include <stdarg.h>

#include "core/safe.h"
#include "plot/script.h"

struct style panel_line(const char *colour, double width) {
    return (struct style){STYLE_LINE, .colour = colour, .width = width};
}

struct style panel_area(const char *colour) {
    return (struct style){STYLE_AREA, .colour = colour};
}

struct style panel_points(const char *colour, int point, double size) {
    return (struct style){STYLE_POINTS, .colour = colour, .point = point, .size = size};
}

void panel_open(struct canvas *c, const struct panel *p) {
    const struct area *a = &p->area;
    canvas_axes(c, *a, &p->x, &p->y);
    if (p->caption) {
        const char *tail = p->tail ? p->tail : "";
        char cut[256], text[320];
        script_shorten(p->caption, a->right - a->left + 1 - script_width(tail), cut, sizeof cut);
        snprintf(text, sizeof text, "%s%s", cut, tail);
        canvas_label(c, text, INFINITY);
        canvas_place(c, a->left, a->top + 0.65);
        fprintf(c->to, " left\n");
    }
    if (p->note) {
        canvas_label(c, p->note, a->right - a->left);
        canvas_place(c, (a->left + a->right) / 2, (a->bottom + a->top) / 2);
        fprintf(c->to, " center textcolor rgb '#606060'\n");
    }
    c->n_series = 0;
}

void panel_series(struct canvas *c, struct style s, const char *data, ...) {
    static const char *const words[] = {
        [STYLE_LINE] = "lines",
        [STYLE_AREA] = "filledcurves",
        [STYLE_AREA_BELOW] = "filledcurves below",
        [STYLE_POINTS] = "points",
        [STYLE_BOTH] = "linespoints",
        [STYLE_UPRIGHT] = "impulses",
        [STYLE_VECTOR] = "vectors nohead",
        [STYLE_SHADED] = "vectors nohead lc palette",
        [STYLE_BARS] = "yerrorbars pt 7 ps 0",
        [STYLE_BOXES] = "boxxyerror fc palette",
    };
    const bool filled = s.kind == STYLE_AREA || s.kind == STYLE_AREA_BELOW;
    va_list list;
    fprintf(c->to, "%s \\\n  ", c->n_series++ == 0 ? "plot" : ",");
    va_start(list, data);
    vfprintf(c->to, data, list);
    va_end(list);
    fprintf(c->to, " with %s", words[s.kind]);
    if (s.kind == STYLE_POINTS || s.kind == STYLE_BOTH) {
        fprintf(c->to, " pt %d ps ", s.point > 0 ? s.point : POINT_DISC);
        if (s.size > 0) {
            fprintf(c->to, "%.3g*", s.size);
        }
        fprintf(c->to, "%s", s.size < 0 ? "variable" : "point");
    }
    if (s.colour) {
        fprintf(c->to, " %s rgb '%s'", filled ? "fc" : "lc", s.colour);
    }
    if (s.width > 0) {
        fprintf(c->to, " lw %g", s.width);
    }
    if (s.dash) {
        fprintf(c->to, " dt %s", s.dash);
    }
}

void panel_upright(const struct canvas *c, double x, struct style s) {
    fprintf(c->to,
            "set arrow from first %.9g, graph 0 to first %.9g, graph 1 nohead lc rgb '%s' lw %g", x,
            x, s.colour, s.width);
    if (s.dash) {
        fprintf(c->to, " dt %s", s.dash);
    }
    fprintf(c->to, "\n");
}

void panel_tic(const struct canvas *c, int i, const char *name, double width, int place) {
    char cut[128];
    script_shorten(name, width, cut, sizeof cut);
    fprintf(c->to, "%s", i > 0 ? ", " : "");
    safe_put(c->to, SAFE_TIC, cut);
    fprintf(c->to, " %d", place);
}

void panel_close(struct canvas *c) {
    fprintf(c->to, "\nunset label\nunset arrow\nunset object\n");
}

enum { N_SHADE = 64 };

// Five colours of viridis (Smith and van der Walt 2015) and of OrRd (Brewer 2003), whose lightness
// changes evenly.
static const char *const palette[] = {
    [SHADES_AREAS] = "set palette defined (0 '#440154', 1 '#3b528b', 2 '#21918c', 3 '#5ec962', "
                     "4 '#fde725')\n",
    [SHADES_LINES] = "set palette defined (0 '#fdd49e', 1 '#fdbb84', 2 '#ef6548', 3 '#b30000', "
                     "4 '#4d0000')\n",
};

void panel_shades(const struct canvas *c, enum shades shades, double most) {
    fprintf(c->to, "%sunset colorbox\nset cbrange [0:%.9g]\n", palette[shades], most);
}

void panel_shades_scale(struct canvas *c, struct area a, const struct axis *axis) {
    const double most = axis->span.high;
    canvas_block(c, "borders of the shade, its middle", "shades");
    for (int i = 0; i < N_SHADE; i++) {
        fprintf(c->data, "%.7g %.7g %.7g\n", most * i / N_SHADE, most * (i + 1) / N_SHADE,
                most * (i + 0.5) / N_SHADE);
    }
    canvas_end(c);
    panel_open(c, &(struct panel){
                      .area = a,
                      .x = {.span = {0, 1}, .kind = AXIS_WITHOUT_NUMBERS, .step = 1},
                      .y = *axis,
                  });
    fprintf(c->to, "unset xtics\n");
    panel_series(c, (struct style){.kind = STYLE_BOXES},
                 "$shades using (0.5):3:(0):(1):1:($2+%.9g):3", most / N_SHADE);
    panel_close(c);
}
