// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot/shades.h"

enum { N_SHADE = 64 };

// Five colours of viridis (Smith and van der Walt 2015) and of OrRd (Brewer 2003), whose lightness
// changes evenly.
static const char *const palette[] = {
    [SHADES_AREAS] = "set palette defined (0 '#440154', 1 '#3b528b', 2 '#21918c', 3 '#5ec962', "
                     "4 '#fde725')\n",
    [SHADES_LINES] = "set palette defined (0 '#fdd49e', 1 '#fdbb84', 2 '#ef6548', 3 '#b30000', "
                     "4 '#4d0000')\n",
};

void shades_use(const struct canvas *c, enum shades shades, double most) {
    fprintf(c->to, "%sunset colorbox\nset cbrange [0:%.9g]\n", palette[shades], most);
}

void shades_scale(struct canvas *c, struct area a, const struct axis *axis) {
    const double most = axis->span.high;
    fprintf(c->data, "$shades << EOD\n# borders of the shade, its middle\n");
    for (int i = 0; i < N_SHADE; i++) {
        fprintf(c->data, "%.7g %.7g %.7g\n", most * i / N_SHADE, most * (i + 1) / N_SHADE,
                most * (i + 0.5) / N_SHADE);
    }
    fprintf(c->data, "EOD\n");
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
