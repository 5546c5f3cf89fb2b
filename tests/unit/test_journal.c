// SPDX-License-Identifier: GPL-3.0-or-later
// The journal of a study: what is entered is read back; a torn tail and any damaged byte cost the
// entries from there on, and never give a wrong value.
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "study/journal.h"
#include "support/support.h"

enum { RUNS = 5, VALUES = 3 };
static const char head[] = "the deck\t1\n";
static const char file_path[] = "records/a.AT2";

static double value_of(long run, int i) {
    return 100.0 * (double)run + i + 0.1;
}

static int note_file(void *context, const char *path, uint64_t sum, struct error *e) {
    (void)e;
    assert_string_equal(path, file_path);
    assert_int_equal(sum, 42);
    ++*(int *)context;
    return STATUS_OK;
}

// The runs in the order 3 1 0 2, of which run 1 failed; run 4 is missing.
static const char *write_journal(const char *name) {
    const char *path = support_path(name);
    static const long order[] = {3, 1, 0, 2};
    struct journal j;
    struct error e;
    unlink(path);
    assert_int_equal(journal_open(&j, path, RUNS, VALUES, &e), STATUS_OK);
    assert_null(j.head);
    assert_int_equal(journal_reset(&j, head, &e), STATUS_OK);
    assert_int_equal(journal_add_file(&j, file_path, 42, &e), STATUS_OK);
    for (int k = 0; k < 4; k++) {
        double value[VALUES];
        struct study_outcome outcome = {.status = order[k] == 1 ? STUDY_FAILED : STUDY_DONE};
        snprintf(outcome.message, sizeof outcome.message, "%s", order[k] == 1 ? "it broke" : "");
        for (int i = 0; i < VALUES; i++) {
            value[i] = value_of(order[k], i);
        }
        assert_int_equal(journal_add_run(&j, order[k], &outcome, value, &e), STATUS_OK);
    }
    assert_int_equal(journal_sync(&j, &e), STATUS_OK);
    journal_close(&j);
    return path;
}

// Checks every run that the journal has against what was entered.
static void check_runs(struct journal *j) {
    long done = 0;
    for (long run = 0; run < RUNS; run++) {
        struct study_outcome outcome;
        double value[VALUES];
        struct error e;
        if (j->offset[run] == 0) {
            continue;
        }
        done++;
        assert_int_not_equal(run, 4);
        assert_int_equal(journal_read(j, run, &outcome, value, &e), STATUS_OK);
        assert_int_equal(outcome.status, run == 1 ? STUDY_FAILED : STUDY_DONE);
        assert_string_equal(outcome.message, run == 1 ? "it broke" : "");
        for (int i = 0; i < VALUES; i++) {
            assert_true(run == 1 ? isnan(value[i]) : value[i] == value_of(run, i));
        }
    }
    assert_int_equal(done, j->n_done);
}

// Opens and loads a journal; the number of runs in it, -1: it is refused.
static long load(const char *path, int *n_file) {
    struct journal j;
    struct error e;
    *n_file = 0;
    if (journal_open(&j, path, RUNS, VALUES, &e) != STATUS_OK) {
        assert_non_null(strstr(e.message, "not the journal of a study"));
        return -1;
    }
    long n = 0;
    const off_t size = lseek(j.file, 0, SEEK_END);
    const size_t whole = 8 + 8 + strlen(head) + 8;  // magic word, start of the entry, its checksum
    assert_true(journal_is_new(&j, head) == (size < (off_t)whole));
    if (j.head && strcmp(j.head, head) == 0) {
        assert_int_equal(journal_load(&j, note_file, n_file, &e), STATUS_OK);
        check_runs(&j);
        n = j.n_done;
    }
    journal_close(&j);
    return n;
}

static void what_is_entered_is_read_back(void **state) {
    (void)state;
    int n_file;
    const char *path = write_journal("whole.runs");
    assert_int_equal(load(path, &n_file), 4);
    assert_int_equal(n_file, 1);
}

static void a_run_more_goes_behind_the_others(void **state) {
    (void)state;
    int n_file = 0;
    struct journal j;
    struct error e;
    const double value[VALUES] = {value_of(0, 0), value_of(0, 1), value_of(0, 2)};
    const char *path = write_journal("more.runs");
    assert_int_equal(truncate(path, (off_t)200), 0);
    assert_int_equal(journal_open(&j, path, RUNS, VALUES, &e), STATUS_OK);
    assert_int_equal(journal_load(&j, note_file, &n_file, &e), STATUS_OK);
    const long before = j.n_done;
    assert_int_equal(j.offset[0], 0);
    assert_int_equal(
        journal_add_run(&j, 0, &(struct study_outcome){.status = STUDY_DONE}, value, &e),
        STATUS_OK);
    journal_close(&j);
    assert_int_equal(load(path, &n_file), before + 1);
}

static void a_file_cut_anywhere_keeps_the_entries_before_the_cut(void **state) {
    (void)state;
    size_t size;
    int n_file;
    const char *text = support_read(write_journal("cut.runs"), &size);
    const char *path = support_path("short.runs");
    long last = 0;
    for (size_t n = 0; n <= size; n++) {
        FILE *to = fopen(path, "wb");
        assert_non_null(to);
        assert_int_equal(fwrite(text, 1, n, to), n);
        fclose(to);
        const long kept = load(path, &n_file);
        assert_true(kept >= last && kept <= last + 1);
        last = kept;
    }
    assert_int_equal(last, 4);
}

static void a_flipped_byte_never_gives_a_wrong_value(void **state) {
    (void)state;
    size_t size;
    int n_file;
    char *text = (char *)support_read(write_journal("flip.runs"), &size);
    const char *path = support_path("flipped.runs");
    for (size_t at = 0; at < size; at++) {
        text[at] ^= 0x10;
        FILE *to = fopen(path, "wb");
        assert_non_null(to);
        assert_int_equal(fwrite(text, 1, size, to), size);
        fclose(to);
        const long kept = load(path, &n_file);
        assert_true(at < 8 ? kept == -1 : kept >= 0 && kept < 4);
        text[at] ^= 0x10;
    }
}

// As a machine would write it whose numbers start with their highest byte.
static void a_journal_from_a_machine_with_another_order_of_bytes_is_not_read(void **state) {
    (void)state;
    enum { MAGIC = 8, WORD = 4 };
    const char *path = write_journal("foreign.runs");
    char kind[WORD], turned[WORD];
    int file = open(path, O_RDWR);
    assert_int_equal(pread(file, kind, WORD, MAGIC), WORD);
    for (int i = 0; i < WORD; i++) {
        turned[i] = kind[WORD - 1 - i];
    }
    assert_int_equal(pwrite(file, turned, WORD, MAGIC), WORD);
    const off_t size = lseek(file, 0, SEEK_END);
    struct journal j;
    struct error e;
    assert_int_equal(journal_open(&j, path, RUNS, VALUES, &e), STATUS_OK);
    assert_string_equal(j.head, "");  // which is the head of no study
    journal_close(&j);
    assert_int_equal(lseek(file, 0, SEEK_END), size);
    close(file);
}

static void a_journal_is_open_once(void **state) {
    (void)state;
    struct journal j, other;
    struct error e;
    const char *path = write_journal("locked.runs");
    assert_int_equal(journal_open(&j, path, RUNS, VALUES, &e), STATUS_OK);
    assert_int_equal(journal_open(&other, path, RUNS, VALUES, &e), STATUS_SYSTEM);
    assert_non_null(strstr(e.message, "another run is writing it"));
    journal_close(&j);
    assert_int_equal(journal_open(&other, path, RUNS, VALUES, &e), STATUS_OK);
    journal_remove(&other);
    assert_int_not_equal(access(path, F_OK), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_entered_is_read_back),
        cmocka_unit_test(a_run_more_goes_behind_the_others),
        cmocka_unit_test(a_file_cut_anywhere_keeps_the_entries_before_the_cut),
        cmocka_unit_test(a_flipped_byte_never_gives_a_wrong_value),
        cmocka_unit_test(a_journal_from_a_machine_with_another_order_of_bytes_is_not_read),
        cmocka_unit_test(a_journal_is_open_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
