// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot/scale.h"

const struct scale scale_forces[] = {{1e6, "MN"}, {1e3, "kN"}, {1.0, "N"}, {0.0, NULL}};
const struct scale scale_lengths[] = {{1.0, "m"}, {1e-3, "mm"}, {1e-6, "µm"}, {0.0, NULL}};
const struct scale scale_energies[] = {{1e6, "MJ"}, {1e3, "kJ"}, {1.0, "J"}, {0.0, NULL}};

struct scale scale_for(const struct scale *known, double largest) {
    int i = 0;
    while (known[i + 1].unit && largest < known[i].size) {
        i++;
    }
    return known[i];
}

struct axis scale_axis(const char *name, const struct scale *s, struct span span) {
    return (struct axis){
        .name = name, .unit = s->unit, .span = {span.low / s->size, span.high / s->size}};
}
