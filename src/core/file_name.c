// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/file_name.h"

#include <errno.h>
#include <sys/file.h>
#include <sys/stat.h>

bool file_is_named(int file, const char *path) {
    struct stat own, named;
    return fstat(file, &own) == 0 && stat(path, &named) == 0 && own.st_dev == named.st_dev &&
           own.st_ino == named.st_ino;
}

bool file_lock(int file) {
    return flock(file, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}
