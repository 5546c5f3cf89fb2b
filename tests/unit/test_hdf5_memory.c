// SPDX-License-Identifier: GPL-3.0-or-later
// Where the HDF5 library gets no memory: the file is complete, or there is a message, status 3 and
// no file. The library crashes or calls exit() at some places, so each attempt is a process of its
// own, guarded as the program is. The functions below take the place of the C library's for all.
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "command/crash.h"
#include "support/made_up.h"
#include "support/support.h"

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t n, size_t size);
void *__libc_realloc(void *p, size_t size);

enum { MANY = 1 << 20 };
static atomic_long count, first, last;  // allocations that fail; last 0: none
static atomic_bool active;

static bool fails_now(void) {
    const long k = active ? atomic_fetch_add(&count, 1) + 1 : 0;
    return k > 0 && k >= first && k <= last;
}

void *malloc(size_t size) {
    return fails_now() ? NULL : __libc_malloc(size);
}

void *calloc(size_t nmemb, size_t size) {
    return fails_now() ? NULL : __libc_calloc(nmemb, size);
}

void *realloc(void *ptr, size_t size) {
    return fails_now() ? NULL : __libc_realloc(ptr, size);
}

static int write_file(struct made_up *f, struct error *e) {
    return made_up_write(f, RESULT_KEEP, e);
}

static int read_file(struct made_up *f, struct error *e) {
    struct result_file *file = NULL;
    const int status = result_open(f->path, &file, e);
    result_close(file);
    return status;
}

typedef int attempt(struct made_up *f, struct error *e);

// In the child: the attempt with allocations from k on failing. Ends as the program would, with the
// number of allocations in the file `counted`.
static void fail_at(attempt *make, struct made_up *f, long k, long fails, const char *counted) {
    static const int caught[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};  // by cmocka
    struct error e = {.message = ""};
    for (size_t i = 0; i < sizeof caught / sizeof caught[0]; i++) {
        signal(caught[i], SIG_DFL);
    }
    crash_catch();
    first = k;
    last = k == 0 ? 0 : k + fails - 1;
    active = true;
    const int status = make(f, &e);
    active = false;
    crash_release();
    FILE *to = fopen(counted, "w");
    fprintf(to, "%ld", (long)count);
    fclose(to);
    dprintf(STDERR_FILENO, "%s", e.message);
    _exit(status == STATUS_OK ? 0 : status == STATUS_SYSTEM ? 3 : 2);
}

// The status of such a child; what it said is in the file `said`.
static int status_at(attempt *make, struct made_up *f, long k, long fails) {
    const char *counted = support_path("counted"), *said = support_path("said");
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        if (!freopen(said, "w", stderr)) {
            _exit(127);
        }
        fail_at(make, f, k, fails, counted);
    }
    int state = -1;
    assert_true(child > 0 && waitpid(child, &state, 0) == child);
    assert_true(WIFEXITED(state));
    return WEXITSTATUS(state);
}

// Every `step`-th allocation fails in turn, with `fails` - 1 behind it. `check` is called after
// each attempt.
static void fail_each(attempt *make, struct made_up *f, long step, long fails,
                      void (*check)(struct made_up *f, int status)) {
    assert_int_equal(status_at(make, f, 0, 0), 0);
    const long n = strtol(support_read(support_path("counted"), NULL), NULL, 10);
    assert_in_range(n, 1000, 1000000);
    check(f, 0);
    for (long k = 1; k <= n; k += step) {
        const int status = status_at(make, f, k, fails);
        const char *said = support_read(support_path("said"), NULL);
        if (status != 0 && (status != 3 || said[0] == '\0')) {
            fail_msg("allocation %ld of %ld: status %d and the message '%s'", k, n, status, said);
        }
        check(f, status);
    }
}

static void check_written(struct made_up *f, int status) {
    if (status == 0) {
        assert_int_equal(status_at(read_file, f, 0, 0), 0);
    }
    assert_int_equal(access(f->path, F_OK), status == 0 ? 0 : -1);
    unlink(f->path);
}

static void a_file_is_written_whole_or_not_at_all(void **state) {
    fail_each(write_file, *state, 97, 1, check_written);
    fail_each(write_file, *state, 97, MANY, check_written);
}

static void check_read(struct made_up *f, int status) {
    (void)f, (void)status;
}

static void a_file_that_cannot_be_read_for_want_of_memory_is_not_called_damaged(void **state) {
    struct made_up *f = *state;
    assert_int_equal(status_at(write_file, f, 0, 0), 0);  // here the library is not started
    fail_each(read_file, f, 29, MANY, check_read);
    fail_each(read_file, f, 7, 1, check_read);
}
#else
static void a_file_is_written_whole_or_not_at_all(void **state) {
    (void)state;
    skip();
}

static void a_file_that_cannot_be_read_for_want_of_memory_is_not_called_damaged(void **state) {
    (void)state;
    skip();
}
#endif

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_file_is_written_whole_or_not_at_all, made_up_setup,
                                        made_up_teardown),
        cmocka_unit_test_setup_teardown(
            a_file_that_cannot_be_read_for_want_of_memory_is_not_called_damaged, made_up_setup,
            made_up_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
