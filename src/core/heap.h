// SPDX-License-Identifier: GPL-3.0-or-later
// The heap of the process as a whole.
#ifndef JOSTLE_CORE_HEAP_H
#define JOSTLE_CORE_HEAP_H

#include <stddef.h>

// Prepares the heap for `bytes` bytes, most of them in small pieces. It changes only the speed. For
// main programs, before they start threads.
void heap_expect(size_t bytes);

#endif
