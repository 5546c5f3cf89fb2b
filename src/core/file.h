// SPDX-License-Identifier: GPL-3.0-or-later
// Files by their descriptors: reading and writing them, and what others may do with them meanwhile,
// as they lock, move, remove or replace them. A call that a signal interrupts (EINTR) is repeated.
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

// Writes `n` bytes at `at`. Returns 0, or -1 with errno.
int file_write(int file, const void *from, size_t n, off_t at);

// Makes the file `size` bytes long. Returns 0, or -1 with errno.
int file_cut(int file, off_t size);

// The content of the file is on disk when this returns. Returns 0, or -1 with errno.
int file_sync(int file);

// The names in the open folder are on disk when this returns. Returns 0, or -1 with errno. A file
// system that cannot do this for folders is not an error.
int file_sync_folder(int folder);

// Opens the folder that `path` is in. Returns -1 where the folder cannot be read.
int file_open_folder(const char *path);

// What prevents that a file is written under this name: "a directory", "a symbolic link", "not a
// regular file". NULL: nothing, as `path` is a regular file or does not exist. This is the only
// place that decides: a link in place of a file is never followed, and never replaced, whatever it
// points to. Links to folders, in front of the last slash, are followed. `path` is relative to
// `folder`, or to the current folder (AT_FDCWD).
const char *file_obstacle(int folder, const char *path);

// Is the open file a regular file, and still the one of this name?
bool file_is_named(int file, const char *path);

// Opens `path` for reading and writing and locks it until it is closed. `flags` is 0 (*file is -1
// where there is no such file), O_CREAT or O_CREAT | O_EXCL. Errors name `wanted`, the file that is
// to be written in the end: STATUS_RETRY (another run has made, removed or replaced it in between),
// STATUS_SYSTEM (another run has locked it, something else has this name, it cannot be opened).
int file_claim(const char *wanted, const char *path, int flags, int *file, struct error *e);

// Repeats an attempt to claim or make `path` as long as it returns STATUS_RETRY. Between the making
// and the locking of a file another run may take it for one that was left: then both try again,
// until one finds the file of another locked. Errors: what the attempt returns, STATUS_SYSTEM.
typedef int file_attempt(void *context, struct error *e);
int file_retry(const char *wanted, const char *path, file_attempt *attempt, void *context,
               struct error *e);

// Locks the open file until it is closed. False: another has it locked. Where no file can be locked
// nothing is known of others, and it is true.
bool file_lock(int file);

// Lets others read the locked file as they lock it for reading; none can lock it for writing.
// False: another has locked the file.
bool file_share(int file);

#endif
