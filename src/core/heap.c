// SPDX-License-Identifier: GPL-3.0-or-later
// The first access to a page of memory stops the program for the time of dozens of steps of two
// buildings, and a short run uses 600 pages. So the heap is moved to the start of a huge page, and
// the program requests huge pages: one takes less time than 100 small pages. If the system has no
// huge pages, the program requests all small pages together (Linux 5.14), which halves their time.
// The pages stay in the heap, because the C library keeps freed memory up to the limits set here.
#define _DEFAULT_SOURCE
#include "core/heap.h"

#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

enum { HUGE_PAGE = 2 << 20 };  // bytes, on most machines; on others the request has no effect

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
    // The library writes in front of a block and after its end. The first page is left out, so that
    // no other page has been accessed yet.
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
