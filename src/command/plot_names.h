// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef JOSTLE_PLOT_NAMES_H
#define JOSTLE_PLOT_NAMES_H

enum { PLOT_PATH_SIZE = 4096 };

// FILE.h5 -> FILE-KIND.png, FILE.h5#7 -> FILE-7-KIND.png, without its folder, into `name`
// (PLOT_PATH_SIZE); returns it.
const char *plot_name_output(const char *result, const char *kind, char *name);

#endif
