// SPDX-License-Identifier: GPL-3.0-or-later
// What tests share: comparing numbers, files in a temporary folder, and running commands. Whatever
// goes wrong in here fails the test that asked for it.
#ifndef JOSTLE_TEST_SUPPORT_H
#define JOSTLE_TEST_SUPPORT_H

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

// |got - want| <= rtol |want|. Fails on NaN; an infinity is close to itself only.
#define assert_close(got, want, rtol) support_close((got), (want), (rtol), __FILE__, __LINE__)
void support_close(double got, double want, double rtol, const char *file, int line);

// |got - want| <= atol. Fails on NaN; an infinity is near to itself only.
#define assert_near(got, want, atol) support_near((got), (want), (atol), __FILE__, __LINE__)
void support_near(double got, double want, double atol, const char *file, int line);

// The memory of a group of tests with this set-up and tear-down.
extern struct arena *support_arena;
int support_arena_open(void **state);
int support_arena_close(void **state);

// A folder of this process, made at the first call and removed with all it holds at exit.
const char *support_temporary(void);

// The path of `name` in that folder. Texts that functions of this file return live until exit.
const char *support_path(const char *name);

// Writes `text` to the file `name` in the temporary folder and returns its path.
const char *support_write(const char *name, const char *text);

// Writes the file at `path`.
void support_write_bytes(const char *path, const char *bytes, size_t n);

// The bytes of the file at `path` and a final 0; *size may be NULL.
const char *support_read(const char *path, size_t *size);

// Runs a line of the shell without input and waits for its end. `status` is 128 + N after signal N.
// The environment variable JOSTLE names the program: support_run("\"$JOSTLE\" check %s", path).
struct support_result {
    int status;
    const char *out, *err;
};
struct support_result support_run(const char *format, ...) __attribute__((format(printf, 1, 2)));

// False if the `n` bytes are not text: contain 0 bytes or invalid UTF-8. *at: the offending offset.
bool support_is_utf8(const char *text, size_t n, size_t *at);

#endif
