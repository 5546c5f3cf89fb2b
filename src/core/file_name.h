// SPDX-License-Identifier: GPL-3.0-or-later
// Files that others may move, remove or replace while they are open.
#ifndef JOSTLE_FILE_NAME_H
#define JOSTLE_FILE_NAME_H

#include <stdbool.h>

// Is the open file still the one of this name?
bool file_is_named(int file, const char *path);

#endif
