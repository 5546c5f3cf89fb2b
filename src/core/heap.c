// SPDX-License-Identifier: GPL-3.0-or-later
// A page of memory that is touched for the first time stops the program for as long as it takes to
// compute dozens of steps of a pair, and a short run touches six hundred. Where the system can
// (Linux 5.14), it is asked for all of them in one go, in less than half the time; they stay in the
// heap, as the C library keeps what is freed up to the limits set.
#define _DEFAULT_SOURCE
#include "core/heap.h"

#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

void heap_expect(size_t bytes) {
#if defined(__GLIBC__) && defined(MADV_POPULATE_WRITE)
    const int more = (int)bytes + (1 << 20);
    if (mallopt(M_MMAP_THRESHOLD, more) == 0 || mallopt(M_TRIM_THRESHOLD, more) == 0) {
        return;
    }
    const size_t page = (size_t)sysconf(_SC_PAGESIZE);
    char *block = malloc(bytes);
    if (block && bytes > page) {
        char *start = block + page - (uintptr_t)block % page;
        madvise(start, (bytes - page) / page * page, MADV_POPULATE_WRITE);
    }
    free(block);
#else
    (void)bytes;
#endif
}
