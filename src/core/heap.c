// SPDX-License-Identifier: GPL-3.0-or-later
// A page of memory that is touched for the first time stops the program for as long as it takes to
// compute ten steps of a pair. Where the system can (Linux 5.14) it is asked for many at once, at a
// third of that each; they stay in the heap, as what is freed is kept until it is more than that.
#define _DEFAULT_SOURCE
#include "core/heap.h"

#include <malloc.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

void heap_expect(size_t bytes) {
#ifdef MADV_POPULATE_WRITE
    const int more = (int)bytes + (1 << 20);
    if (mallopt(M_MMAP_THRESHOLD, more) == 0 || mallopt(M_TRIM_THRESHOLD, more) == 0) {
        return;
    }
    void *block = malloc(bytes);
    const uintptr_t page = (uintptr_t)sysconf(_SC_PAGESIZE);
    const uintptr_t start = ((uintptr_t)block + page - 1) / page * page;
    if (block) {
        madvise((void *)start, ((uintptr_t)block + bytes - start) / page * page,
                MADV_POPULATE_WRITE);
    }
    free(block);
#else
    (void)bytes;
#endif
}
