// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the one message of an error value.
#include "jostle/error.h"

#include <assert.h>
#include <stdarg.h>

#include "core/text.h"

int error_set(struct error *e, int status, const char *format, ...) {
    assert(status != STATUS_OK && format);
    e->status = status;
    va_list list;
    va_start(list, format);
    text_compose(e->message, sizeof e->message, format, list);
    va_end(list);
    return status;
}

int error_no_memory(struct error *e) {
    return error_set(e, STATUS_SYSTEM, "out of memory");
}
