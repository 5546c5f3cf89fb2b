// SPDX-License-Identifier: GPL-3.0-or-later
// Files by their descriptors: reading them, and what others may do with them meanwhile, as they
// lock, move, remove or replace them.
#ifndef JOSTLE_FILE_H
#define JOSTLE_FILE_H

#include <stdbool.h>
#include <sys/types.h>

#include "jostle/error.h"

// Opens a file for reading; a pipe in its place does not make it wait. Errors: STATUS_INPUT (does
// not exist), STATUS_SYSTEM; they name the path.
int file_open(const char *path, int *file, struct error *e);

// Reads `n` bytes at `at`: how many, fewer where the file ends; -1 after an error, with errno.
ssize_t file_read(int file, void *to, size_t n, off_t at);

// Is the open file still the one of this name?
bool file_is_named(int file, const char *path);

// Locks the open file until it is closed. False: another has it locked. Where no file can be locked
// nothing is known of others, and it is true.
bool file_lock(int file);

#endif
