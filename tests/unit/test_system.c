// SPDX-License-Identifier: GPL-3.0-or-later
// In which order files are written, named and removed, what a kill or a reader finds in between,
// and that calls of the system which a signal interrupts are repeated. The linker sends these calls
// to the __wrap_ functions below.
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "command/picture.h"
#include "core/arena.h"
#include "core/text.h"
#include "jostle/study.h"
#include "study/journal.h"
#include "support/made_up.h"
#include "support/support.h"

int __real_open(const char *path, int flags, ...);
int __wrap_open(const char *path, int flags, ...);
int __real_fsync(int file);
int __wrap_fsync(int file);
int __real_flock(int file, int kind);
int __wrap_flock(int file, int kind);
ssize_t __real_pread(int file, void *to, size_t n, off_t at);
ssize_t __wrap_pread(int file, void *to, size_t n, off_t at);
ssize_t __real_pwrite(int file, const void *from, size_t n, off_t at);
ssize_t __wrap_pwrite(int file, const void *from, size_t n, off_t at);
int __real_ftruncate(int file, off_t size);
int __wrap_ftruncate(int file, off_t size);
int __real_linkat(int folder, const char *from, int other, const char *to, int flags);
int __wrap_linkat(int folder, const char *from, int other, const char *to, int flags);
int __real_renameat(int folder, const char *from, int other, const char *to);
int __wrap_renameat(int folder, const char *from, int other, const char *to);
int __real_waitid(idtype_t kind, id_t process, siginfo_t *ended, int options);
int __wrap_waitid(idtype_t kind, id_t process, siginfo_t *ended, int options);
int __real_unlink(const char *path);
int __wrap_unlink(const char *path);
int __real_unlinkat(int folder, const char *path, int flags);
int __wrap_unlinkat(int folder, const char *path, int flags);

// Calls by letters, for the order in which they were done.
enum call {
    OPEN = 'o',
    LOCK = 'l',
    READ = 'r',
    WRITE = 'w',
    CUT = 'c',
    SYNC = 's',         // of a file
    SYNC_FOLDER = 'S',  // of a folder
    NAME = 'N',         // a file gets its name
    WAIT = 'p',
    REMOVE = 'u'
};

enum { CALLS_MAX = 8192 };
static char done[CALLS_MAX + 1];
static size_t n_done;
static bool interrupts;  // every call ends with EINTR before it is repeated
static long n_interrupted;
static void (*look)(void *context, enum call call);  // before each call; NULL: nobody looks
static void *looking;

static void record_calls(void (*function)(void *, enum call), void *context) {
    n_done = 0;
    done[0] = '\0';
    look = function;
    looking = context;
}

static void note(enum call call) {
    void (*const function)(void *, enum call) = look;
    if (function) {
        look = NULL;  // not at its own calls
        function(looking, call);
        look = function;
    }
    if (n_done < CALLS_MAX) {
        done[n_done++] = (char)call;
        done[n_done] = '\0';
    }
}

static bool is_interrupted(enum call call) {
    static bool last;
    last = interrupts && !last;
    if (!last) {
        note(call);
        return false;
    }
    n_interrupted++;
    errno = EINTR;
    return true;
}

int __wrap_open(const char *path, int flags, ...) {
    return is_interrupted(OPEN) ? -1 : __real_open(path, flags, 0666);
}

int __wrap_fsync(int file) {
    struct stat s;
    const bool folder = fstat(file, &s) == 0 && S_ISDIR(s.st_mode);
    return is_interrupted(folder ? SYNC_FOLDER : SYNC) ? -1 : __real_fsync(file);
}

int __wrap_flock(int file, int kind) {
    return is_interrupted(LOCK) ? -1 : __real_flock(file, kind);
}

ssize_t __wrap_pread(int file, void *to, size_t n, off_t at) {
    return is_interrupted(READ) ? -1 : __real_pread(file, to, n, at);
}

ssize_t __wrap_pwrite(int file, const void *from, size_t n, off_t at) {
    return is_interrupted(WRITE) ? -1 : __real_pwrite(file, from, n, at);
}

int __wrap_ftruncate(int file, off_t size) {
    return is_interrupted(CUT) ? -1 : __real_ftruncate(file, size);
}

int __wrap_waitid(idtype_t kind, id_t process, siginfo_t *ended, int options) {
    return is_interrupted(WAIT) ? -1 : __real_waitid(kind, process, ended, options);
}

// POSIX lets no signal interrupt those below.
int __wrap_linkat(int folder, const char *from, int other, const char *to, int flags) {
    note(NAME);
    return __real_linkat(folder, from, other, to, flags);
}

int __wrap_renameat(int folder, const char *from, int other, const char *to) {
    note(NAME);
    return __real_renameat(folder, from, other, to);
}

int __wrap_unlink(const char *path) {
    note(REMOVE);
    return __real_unlink(path);
}

int __wrap_unlinkat(int folder, const char *path, int flags) {
    note(REMOVE);
    return __real_unlinkat(folder, path, flags);
}

// --- results -------------------------------------------------------------------------------------

static const char old[] = "the old file";

static void write_old(const char *path) {
    FILE *to = fopen(path, "w");
    assert_non_null(to);
    fputs(old, to);
    fclose(to);
}

// What was done last, without `without`.
static const char *last_calls(const char *without, size_t n) {
    static char kept[CALLS_MAX + 1];
    size_t m = 0;
    for (size_t i = 0; i < n_done; i++) {
        if (!strchr(without, done[i])) {
            kept[m++] = done[i];
        }
    }
    kept[m] = '\0';
    return kept + (m > n ? m - n : 0);
}

static void a_result_is_on_disk_before_its_name_and_then_the_name_is(void **state) {
    struct made_up *f = *state;
    struct error e;
    record_calls(NULL, NULL);
    assert_int_equal(made_up_write(f, RESULT_KEEP, &e), STATUS_OK);
    assert_string_equal(last_calls("olr", 4), "sNuS");  // PATH.part is removed after link()
    record_calls(NULL, NULL);
    assert_int_equal(made_up_write(f, RESULT_REPLACE, &e), STATUS_OK);
    assert_string_equal(last_calls("olr", 4), "sNS");
}

// A reader who comes before a call finds what a kill at that place would leave.
static void expect_old_or_new(void *context, enum call call) {
    const struct made_up *f = context;
    struct result_file *file;
    struct error e;
    if (strcmp(support_read(f->path, NULL), old) != 0) {
        if (result_open(f->path, &file, &e) != STATUS_OK) {
            fail_msg("before call %c after %s: %s", call, done, e.message);
        }
        result_close(file);
    }
}

static void the_old_file_or_the_new_one_can_be_read_at_any_time(void **state) {
    struct made_up *f = *state;
    struct error e;
    write_old(f->path);
    record_calls(expect_old_or_new, f);
    assert_int_equal(made_up_write(f, RESULT_REPLACE, &e), STATUS_OK);
    assert_non_null(strchr(done, NAME));
    record_calls(NULL, NULL);
    expect_old_or_new(f, NAME);
}

// Puts another file in the place of the partial file before its name is given.
static void exchange(void *context, enum call call) {
    const struct made_up *f = context;
    if (call == SYNC) {
        unlink(f->part);
        write_old(f->part);
    }
}

static void the_file_of_another_does_not_get_the_name(void **state) {
    struct made_up *f = *state;
    struct error e;
    record_calls(exchange, f);
    assert_int_equal(made_up_write(f, RESULT_KEEP, &e), STATUS_SYSTEM);
    record_calls(NULL, NULL);
    assert_non_null(strstr(e.message, "another program has taken"));
    assert_int_not_equal(access(f->path, F_OK), 0);
}

// --- studies -------------------------------------------------------------------------------------

enum { RUNS = 60 };

struct study_case {
    struct model *model;
    const char *result, *record;
};

static const char deck[] = "sweep k range 100 200 60\n"
                           "building A -floors 1 -mass 1 -stiffness $k\n"
                           "ground record system.txt -dt 0.1 -unit m/s2\n"
                           "step fixed 0.01\n"
                           "duration 1\n";

static struct study_case study_case(void) {
    struct study_case s = {.result = support_path("system.h5"),
                           .record = support_write("system.txt", "0\n1\n-2\n1\n0\n")};
    struct deck *d;
    struct error e;
    const char *path = support_write("system.deck", deck);
    unlink(s.result);
    assert_int_equal(deck_open(path, NULL, 0, &d, &e), STATUS_OK);
    assert_int_equal(model_build(d, &s.model, &e), STATUS_OK);
    return s;
}

static int run_study(const struct study_case *s, struct study_progress *p, struct error *e) {
    const struct study_request q = {.first = s->model,
                                    .n_thread = 1,
                                    .journal = STUDY_RESTART,
                                    .result = {.path = s->result, .version = "1"}};
    return study_run(&q, p, e);
}

static void a_journal_is_on_disk_before_the_result_and_goes_after_it(void **state) {
    (void)state;
    struct study_case s = study_case();
    struct study_progress p;
    struct error e;
    record_calls(NULL, NULL);
    assert_int_equal(run_study(&s, &p, &e), STATUS_OK);
    // The name of the journal, then its runs, and at the end: all of the journal on disk, the
    // result on disk, its name, PATH.part is removed, the name is on disk, the journal is removed.
    const char *calls = last_calls("olr", CALLS_MAX);
    const char *first = strchr(calls, WRITE), *folder = strchr(calls, SYNC_FOLDER);
    assert_true(folder && first && folder < first);
    assert_string_equal(last_calls("olr", 7), "wssNuSu");
    model_free(s.model);
}

// Changes the record as soon as the first run is in the journal.
static void change_record(void *context, enum call call) {
    const struct study_case *s = context;
    enum { HEADS = 3 };  // magic word, head, the record
    long n = call == WRITE;
    for (size_t i = 0; i < n_done; i++) {
        n += done[i] == WRITE;
    }
    if (call == WRITE && n == HEADS + 1) {
        FILE *to = fopen(s->record, "w");
        fputs("0\n1\n-3\n1\n0\n", to);
        fclose(to);
    }
}

static void a_record_that_changes_in_mid_study_ends_it(void **state) {
    (void)state;
    struct study_case s = study_case();
    struct study_progress p;
    struct error e;
    record_calls(change_record, &s);
    assert_int_equal(run_study(&s, &p, &e), STATUS_INPUT);
    record_calls(NULL, NULL);
    assert_non_null(strstr(e.message, "system.txt has changed since the study was started"));
    assert_in_range(p.n_done, 1, RUNS - 1);
    assert_int_not_equal(access(s.result, F_OK), 0);
    unlink(support_path("system.h5.runs"));
    model_free(s.model);
}

// --- signals -------------------------------------------------------------------------------------

// Enters a run and reads it again, from a journal that is opened twice.
static void use_journal(const char *path) {
    static const char head[] = "the deck\t1\n";
    const struct study_outcome outcome = {.status = STUDY_DONE};
    struct study_outcome found;
    struct journal j;
    struct keys keys;
    struct error e;
    double value = 1.5;
    assert_int_equal(keys_open(&keys, 1, &e), STATUS_OK);
    keys.key[0].byte[0] = 1;
    keys_index(&keys);
    assert_int_equal(journal_open(&j, path, &keys, 1, &e), STATUS_OK);
    assert_int_equal(journal_reset(&j, head, &e), STATUS_OK);
    assert_int_equal(journal_add_run(&j, 0, &outcome, false, &value, &e), STATUS_OK);
    assert_int_equal(journal_sync(&j, &e), STATUS_OK);
    journal_close(&j);
    assert_int_equal(journal_open(&j, path, &keys, 1, &e), STATUS_OK);
    assert_string_equal(j.head, head);
    assert_int_equal(journal_load(&j, &e), STATUS_OK);
    value = 0;
    assert_int_equal(journal_read(&j, 0, &found, &value, &e), STATUS_OK);
    assert_true(value == 1.5);
    journal_remove(&j);
    keys_close(&keys);
}

static int write_nothing(void *context, const struct figure_files *to, struct error *e) {
    (void)context, (void)to, (void)e;
    return STATUS_OK;
}

// A picture by something that stands for gnuplot.
static int draw(struct error *e) {
    chmod(support_write("gnuplot", "#!/bin/sh\necho 'a picture of nothing </svg>' >figure.svg\n"),
          0700);
    setenv("PATH", support_temporary(), 1);
    const struct picture_request q = {.options = {.output = support_path("nothing.svg")},
                                      .write = write_nothing};
    return picture_make(&q, e);
}

static void calls_that_a_signal_interrupts_are_repeated(void **state) {
    struct made_up *f = *state;
    struct study_case s = study_case();
    struct study_progress p;
    struct error e;
    char *text = NULL;
    size_t size = 0;
    struct arena *a = arena_create();
    record_calls(NULL, NULL);
    interrupts = true;
    n_interrupted = 0;
    use_journal(support_path("signal.runs"));
    const int studied = run_study(&s, &p, &e);
    const int read = text_file(a, s.record, CALLS_MAX, &text, &size, &e);
    const int written = made_up_write(f, RESULT_KEEP, &e);
    const int drawn = draw(&e);
    interrupts = false;
    assert_int_equal(studied, STATUS_OK);
    assert_int_equal(p.n_done, RUNS);
    assert_int_equal(read, STATUS_OK);
    assert_string_equal(text, support_read(s.record, NULL));
    assert_int_equal(written, STATUS_OK);
    assert_int_equal(drawn, STATUS_OK);
    assert_in_range(n_interrupted, RUNS, CALLS_MAX);
    for (const char *call = "olrwcsSp"; *call; call++) {
        assert_non_null(strchr(done, *call));
    }
    arena_free(a);
    model_free(s.model);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_result_is_on_disk_before_its_name_and_then_the_name_is,
                                        made_up_setup, made_up_teardown),
        cmocka_unit_test_setup_teardown(the_old_file_or_the_new_one_can_be_read_at_any_time,
                                        made_up_setup, made_up_teardown),
        cmocka_unit_test_setup_teardown(the_file_of_another_does_not_get_the_name, made_up_setup,
                                        made_up_teardown),
        cmocka_unit_test(a_journal_is_on_disk_before_the_result_and_goes_after_it),
        cmocka_unit_test(a_record_that_changes_in_mid_study_ends_it),
        cmocka_unit_test_setup_teardown(calls_that_a_signal_interrupts_are_repeated, made_up_setup,
                                        made_up_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
