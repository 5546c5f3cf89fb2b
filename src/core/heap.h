// SPDX-License-Identifier: GPL-3.0-or-later
// The heap of the process as a whole.
#ifndef JOSTLE_CORE_HEAP_H
#define JOSTLE_CORE_HEAP_H

#include <stddef.h>

// Says that the process is going to use so many bytes of its heap, most of them in small pieces.
// Nothing depends on it but time. For main programs, before there are threads.
void heap_expect(size_t bytes);

#endif
