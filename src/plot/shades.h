// SPDX-License-Identifier: GPL-3.0-or-later
// Values as colours (STYLE_BOXES, STYLE_SHADED), and the scale that tells them.
#ifndef JOSTLE_SHADES_H
#define JOSTLE_SHADES_H

#include "plot/panel.h"

// Colours of areas, the highest value light; and of lines on white, the highest value dark.
enum shades { SHADES_AREAS, SHADES_LINES };

// Sets the colours of values from 0 to `most` > 0, in a panel that is open.
void shades_use(const struct canvas *c, enum shades shades, double most);

// Draws the scale as a panel of its own; `axis` spans from 0 to `most`.
void shades_scale(struct canvas *c, struct area a, const struct axis *axis);

#endif
