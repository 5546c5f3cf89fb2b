// SPDX-License-Identifier: GPL-3.0-or-later
// Feeds bytes to the record readers: a file, and its last byte chooses the request, its size the
// channel. A file that ends with a line end is read with nothing else given, so that real files are
// good seeds.
#include <assert.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "motion/record_format.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static struct record_request make_request(unsigned choice, size_t size) {
    unsigned format = choice & 15;
    bool known = format > 0 && format <= (unsigned)n_record_format;
    return (struct record_request){
        .path = "fuzz.AT2",
        .format = known ? record_formats[format - 1]->name : NULL,
        .dt = choice & 16 ? 0.01 : 0,
        .unit = choice & 32 ? "g" : NULL,
        .gravity = 9.80665,
        .channel = (int)(size % 4),
        .demean = (choice & 192) == 64,
        .plain = choice & 128,
    };
}

// What holds for every record that was read.
static void check_record(const struct record *r) {
    assert(r->n >= 2 && r->n_warning <= RECORD_WARNINGS_MAX);
    assert(r->dt > 0 && isfinite(r->dt));
    assert(r->unit > 0 && isfinite(r->unit));
    for (size_t i = 0; i < r->n; i++) {
        assert(isfinite(r->value[i]));
    }
    for (int i = 0; i < r->n_warning; i++) {
        assert(strncmp(r->warning[i], "fuzz.AT2:", 9) == 0 && !strchr(r->warning[i], '\n'));
    }
}

static void read_bytes(const uint8_t *data, size_t size, unsigned choice) {
    char *text = malloc(size + 1);
    struct arena *a = arena_create();
    if (text && a) {
        memcpy(text, data, size);
        text[size] = '\0';
        struct record_request request = make_request(choice, size);
        struct record_text t = {request.path, text, size};
        struct record record;
        struct error e;
        if (record_read_text(a, &request, &t, &record, &e) == STATUS_OK) {
            check_record(&record);
        } else {
            assert(strncmp(e.message, "fuzz.AT2:", 9) == 0 && !strchr(e.message, '\n'));
        }
    }
    arena_free(a);
    free(text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (size > 0) {
        read_bytes(data, size, data[size - 1] ^ '\n');
    }
    return 0;
}
