// SPDX-License-Identifier: GPL-3.0-or-later
// Makes one allocation fail. Works in programs linked with --wrap=malloc and so on (FAIL_ALLOC of
// the Makefile; every tests/*/test_alloc*.c is), for calls from jostle's own code; libraries are
// not touched. What is asked of an arena counts as well, though its blocks seldom need more memory.
#ifndef JOSTLE_TEST_FAIL_ALLOC_H
#define JOSTLE_TEST_FAIL_ALLOC_H

#include "jostle/error.h"

// From now on count allocations from 1 and let the k-th fail, once; k = 0: count only.
void fail_alloc_at(long k);

// Stops that and returns how many allocations were asked for since.
long fail_alloc_stop(void);

// Makes an attempt, which must succeed, and then one with each of its allocations failing in its
// turn, `least` or more of them: each must end in STATUS_SYSTEM with "out of memory" in its
// message. With JOSTLE_SANITIZED in the environment, every third allocation.
void fail_alloc_each(int (*attempt)(void *context, struct error *e), void *context, long least);

#endif
