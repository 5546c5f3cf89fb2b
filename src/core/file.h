// SPDX-License-Identifier: GPL-3.0-or-later
// Files by their descriptors. Other programs may lock, move, remove or replace a file meanwhile. A
// call that a signal interrupts (EINTR) is repeated.
#ifndef JOSTLE_FILE_H
#define JOSTLE_FILE_H

#include <stdbool.h>
#include <sys/types.h>

#include "jostle/error.h"

// Opens a file for reading; it does not wait if the file is a pipe. Errors: STATUS_INPUT (does
// not exist), STATUS_SYSTEM; they name the path.
int file_open(const char *path, int *file, struct error *e);

// Reads `n` bytes at `at`. Returns the number read, fewer at the end of the file; -1 with errno
// after an error.
ssize_t file_read(int file, void *to, size_t n, off_t at);

// Writes `n` bytes at `at`. Returns 0, or -1 with errno.
int file_write(int file, const void *from, size_t n, off_t at);

// Makes the file `size` bytes long. Returns 0, or -1 with errno.
int file_cut(int file, off_t size);

// The content of the file is on disk when this returns. Returns 0, or -1 with errno.
int file_sync(int file);

// The names in the open folder are on disk when this returns. Returns 0, or -1 with errno. A file
// system that cannot do this for folders is not an error.
int file_sync_folder(int folder);

// Opens the folder that contains `path`. Returns -1 if the folder cannot be read.
int file_open_folder(const char *path);

// The reason why a file cannot be written under this name: "a directory", "a symbolic link", "not a
// regular file". NULL: `path` is a regular file or does not exist. Only this function decides it. A
// link in place of a file is never followed and never replaced. Links to folders, before the last
// slash, are followed. `path` is relative to `folder`, or to the current folder (AT_FDCWD).
const char *file_obstacle(int folder, const char *path);

// True if the open file is a regular file and `path` still names it.
bool file_is_named(int file, const char *path);

// Opens `path` for reading and writing and locks it until it is closed. `flags` is 0 (*file is -1
// if the file does not exist), O_CREAT or O_CREAT | O_EXCL. Errors name `wanted`, the file that the
// caller writes in the end: STATUS_RETRY (another run has created, removed or replaced the file
// meanwhile), STATUS_SYSTEM (another run has locked the file, it is not a regular file, or it
// cannot be opened).
int file_claim(const char *wanted, const char *path, int flags, int *file, struct error *e);

// Repeats an attempt to claim or create `path` while it returns STATUS_RETRY. Before a new file is
// locked, another run may take it for the file of a run that was killed. Then both runs try again
// until one of them finds the file locked. Errors: those of the attempt, STATUS_SYSTEM.
typedef int file_attempt(void *context, struct error *e);
int file_retry(const char *wanted, const char *path, file_attempt *attempt, void *context,
               struct error *e);

// Locks the open file until it is closed. False: another run has locked it. On a file system
// without locks the result is true.
bool file_lock(int file);

// Changes the lock so that other runs can lock the file for reading, but not for writing. False:
// another run has locked the file.
bool file_share(int file);

#endif
