// SPDX-License-Identifier: GPL-3.0-or-later
// Reading records in tests.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "support/reading.h"
#include "support/support.h"

int reading_setup(void **state) {
    struct reading *r = calloc(1, sizeof *r);
    if (!r) {
        return -1;
    }
    r->arena = arena_create();
    r->request = (struct record_request){.path = "a.txt", .gravity = 9.80665};
    *state = r;
    return r->arena ? 0 : -1;
}

int reading_teardown(void **state) {
    struct reading *r = *state;
    arena_free(r->arena);
    free(r);
    return 0;
}

void reading_of_text(struct reading *r, const char *text) {
    struct record_text t = {r->request.path, text, strlen(text)};
    r->error.message[0] = '\0';
    r->status = record_read_text(r->arena, &r->request, &t, &r->record, &r->error);
}

void reading_of_file(struct reading *r, const char *path) {
    r->request.path = path;
    r->error.message[0] = '\0';
    r->status = record_read(r->arena, &r->request, &r->record, &r->error);
}

void reading_of_changed(struct reading *r, const char *path, const char *from, const char *to) {
    struct record_text whole;
    struct arena *scratch;
    assert_int_equal(record_text_open(path, 1 << 20, &whole, &scratch, &r->error), STATUS_OK);
    const char *at = strstr(whole.text, from);
    assert_non_null(at);
    const size_t size = whole.size + strlen(to) + 1;
    char *text = arena_alloc(r->arena, size, 1);
    snprintf(text, size, "%.*s%s%s", (int)(at - whole.text), whole.text, to, at + strlen(from));
    arena_free(scratch);
    reading_of_text(r, text);
}

void assert_read(const struct reading *r, const char *format, size_t n, double dt) {
    assert_string_equal(r->error.message, "");
    assert_int_equal(r->status, STATUS_OK);
    assert_string_equal(r->record.format, format);
    assert_int_equal(r->record.n, n);
    assert_close(r->record.dt, dt, 1e-12);
}

void assert_refused(const struct reading *r, const char *message) {
    assert_int_equal(r->status, STATUS_INPUT);
    assert_string_equal(r->error.message, message);
}

void assert_warned(const struct reading *r, const char *message) {
    assert_int_equal(r->status, STATUS_OK);
    assert_int_equal(r->record.n_warning, 1);
    assert_string_equal(r->record.warning[0], message);
}

void assert_silent(const struct reading *r) {
    assert_int_equal(r->status, STATUS_OK);
    assert_int_equal(r->record.n_warning, 0);
}

void assert_waves(const struct reading *r, int channel, double size, double rounding) {
    assert_int_equal(r->record.n, 50);
    for (int i = 0; i < 50; i++) {
        const double period = 25.0 - 5.0 * channel;
        const double wave = exp(-i / 40.0) * sin(2.0 * acos(-1.0) * i / period);
        assert_true(fabs(r->record.value[i] - size * wave) <= rounding);
    }
}
