// SPDX-License-Identifier: GPL-3.0-or-later
// A page of memory that is touched for the first time stops the program for as long as it takes to
// compute dozens of steps of a pair, and a short run touches six hundred. So the heap is moved to
// where huge pages begin, and the system is asked for such pages: one comes in less time than
// a hundred small ones. Where it has none, it is asked for all small ones in one go (Linux 5.14),
// which takes half their time. They stay in the heap, as the C library keeps what is freed up to
// the limits set.
#define _DEFAULT_SOURCE
#include "core/heap.h"

#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

enum { HUGE_PAGE = 2 << 20 };  // bytes, on most machines; elsewhere the advice is of no use

void heap_expect(size_t bytes) {
#if defined(__GLIBC__) && defined(MADV_POPULATE_WRITE)
    const size_t page = (size_t)sysconf(_SC_PAGESIZE);
    const size_t size = (bytes + HUGE_PAGE - 1) / HUGE_PAGE * HUGE_PAGE;
    const int more = (int)size + (1 << 20);
    const uintptr_t end = (uintptr_t)sbrk(0);
    const uintptr_t start = (end + page + HUGE_PAGE - 1) / HUGE_PAGE * HUGE_PAGE;
    if (mallopt(M_MMAP_THRESHOLD, more) == 0 || mallopt(M_TRIM_THRESHOLD, more) == 0 ||
        sbrk((intptr_t)(start - page - end)) == (void *)-1) {
        return;
    }
    // The library writes in front of a block and behind it. Its first page is kept out, so that
    // none of the others has been touched yet.
    char *block = malloc(size + page);
    if (block && (uintptr_t)block <= start && start <= (uintptr_t)block + page) {
        madvise((char *)start, size, MADV_HUGEPAGE);
        madvise((char *)start, size, MADV_POPULATE_WRITE);
    }
    free(block);
#else
    (void)bytes;
#endif
}
