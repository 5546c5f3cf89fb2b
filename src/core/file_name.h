// SPDX-License-Identifier: GPL-3.0-or-later
// Files that others may lock, move, remove or replace while they are open.
#ifndef JOSTLE_FILE_NAME_H
#define JOSTLE_FILE_NAME_H

#include <stdbool.h>

// Is the open file still the one of this name?
bool file_is_named(int file, const char *path);

// Locks the open file until it is closed. False: another has it locked. Where no file can be locked
// nothing is known of others, and it is true.
bool file_lock(int file);

#endif
