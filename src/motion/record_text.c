// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/arena.h"
#include "core/text.h"
#include "motion/record_format.h"

int record_text_open(const char *path, size_t limit, struct record_text *out,
                     struct arena **scratch, struct error *e) {
    *scratch = arena_create();
    if (!*scratch) {
        return error_no_memory(e);
    }
    char *text;
    *out = (struct record_text){.path = path};
    const int status = text_file(*scratch, path, limit, &text, &out->size, e);
    if (status != STATUS_OK) {
        arena_free(*scratch);
        return status;
    }
    out->text = text;
    return STATUS_OK;
}
