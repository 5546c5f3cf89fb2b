// SPDX-License-Identifier: GPL-3.0-or-later
// The journal of a study: what is entered is read back; a damaged byte costs the entry it stands
// in, and never gives a wrong value.
#include <fcntl.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/file.h"
#include "study/journal.h"
#include "support/keys.h"
#include "support/support.h"

enum { RUNS = 5, VALUES = 3 };
static const char head[] = "the deck\t1\n";
static struct keys keys;

static double value_of(long run, int i) {
    return 100.0 * (double)run + i + 0.1;
}

static int make_keys(void **state) {
    (void)state;
    keys_made_up(&keys, RUNS, NULL);
    return 0;
}

static int free_keys(void **state) {
    (void)state;
    keys_close(&keys);
    return 0;
}

// The runs in the order 3 1 0 2, of which run 1 failed; run 4 is missing.
static const char *write_journal(const char *name) {
    const char *path = support_path(name);
    static const long order[] = {3, 1, 0, 2};
    struct journal j;
    struct error e;
    unlink(path);
    assert_int_equal(journal_open(&j, path, &keys, VALUES, &e), STATUS_OK);
    assert_null(j.head);
    assert_int_equal(journal_reset(&j, head, &e), STATUS_OK);
    for (int k = 0; k < 4; k++) {
        double value[VALUES];
        struct study_outcome outcome = {.status = order[k] == 1 ? STUDY_FAILED : STUDY_DONE};
        snprintf(outcome.message, sizeof outcome.message, "%s", order[k] == 1 ? "it broke" : "");
        for (int i = 0; i < VALUES; i++) {
            value[i] = value_of(order[k], i);
        }
        assert_int_equal(journal_add_run(&j, order[k], &outcome, false, value, &e), STATUS_OK);
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
static long load_and_count(const char *path, long *n_damaged) {
    struct journal j;
    struct error e;
    if (journal_open(&j, path, &keys, VALUES, &e) != STATUS_OK) {
        assert_non_null(strstr(e.message, "not the journal of a study"));
        return -1;
    }
    long n = 0;
    const off_t size = lseek(j.file, 0, SEEK_END);
    const size_t whole = 8 + 8 + strlen(head) + 8;  // magic word, start of the entry, its checksum
    assert_true(journal_is_new(&j, head) == (size < (off_t)whole));
    if (j.head && strcmp(j.head, head) == 0) {
        assert_int_equal(journal_load(&j, &e), STATUS_OK);
        check_runs(&j);
        n = j.n_done;
        *n_damaged = j.n_damaged;
    }
    journal_close(&j);
    return n;
}

static long load(const char *path) {
    long n_damaged = 0;
    const long n = load_and_count(path, &n_damaged);
    assert_int_equal(n_damaged, 0);
    return n;
}

static void what_is_entered_is_read_back(void **state) {
    (void)state;
    const char *path = write_journal("whole.runs");
    assert_int_equal(load(path), 4);
}

static void a_run_more_goes_behind_the_others(void **state) {
    (void)state;
    struct journal j;
    struct error e;
    const double value[VALUES] = {value_of(0, 0), value_of(0, 1), value_of(0, 2)};
    const char *path = write_journal("more.runs");
    assert_int_equal(truncate(path, (off_t)200), 0);
    assert_int_equal(journal_open(&j, path, &keys, VALUES, &e), STATUS_OK);
    assert_int_equal(journal_load(&j, &e), STATUS_OK);
    const long before = j.n_done;
    assert_int_equal(j.offset[0], 0);
    assert_int_equal(
        journal_add_run(&j, 0, &(struct study_outcome){.status = STUDY_DONE}, false, value, &e),
        STATUS_OK);
    journal_close(&j);
    assert_int_equal(load(path), before + 1);
}

static void a_file_cut_anywhere_keeps_the_entries_before_the_cut(void **state) {
    (void)state;
    size_t size;
    const char *text = support_read(write_journal("cut.runs"), &size);
    const char *path = support_path("short.runs");
    long last = 0;
    for (size_t n = 0; n <= size; n++) {
        support_write_bytes(path, text, n);
        const long kept = load(path);
        assert_true(kept >= last && kept <= last + 1);
        last = kept;
    }
    assert_int_equal(last, 4);
}

// Where the entries of the runs start, and the last one ends.
enum { ENTRIES = 4 };

static void find_entries(const char *text, size_t size, size_t start[ENTRIES + 1]) {
    size_t at = 8;
    for (int i = -1; i <= ENTRIES; i++) {
        uint32_t n = 0;
        if (i >= 0) {
            start[i] = at;
        }
        if (at < size) {
            memcpy(&n, text + at + 4, sizeof n);
        }
        at += 8 + n + 8;
    }
    assert_int_equal(start[ENTRIES], size);
}

static void a_flipped_byte_costs_its_entry(void **state) {
    (void)state;
    size_t size, start[ENTRIES + 1];
    char *text = (char *)support_read(write_journal("flip.runs"), &size);
    const char *path = support_path("flipped.runs");
    find_entries(text, size, start);
    for (size_t at = 0; at < size; at++) {
        long n_damaged = 0;
        text[at] ^= 0x10;
        support_write_bytes(path, text, size);
        const long kept = load_and_count(path, &n_damaged);
        assert_int_equal(kept, at < 8          ? -1
                               : at < start[0] ? 0  // of the head
                                               : 3);
        // With a length that is too long the last entry looks as if it had not all been written.
        const size_t last = start[ENTRIES - 1];
        if (at < last + 4 || at >= last + 8) {
            assert_int_equal(n_damaged, at < start[0] ? 0 : 1);
        }
        // The next one finds the same, although it may have been cut behind the last entry.
        n_damaged = 0;
        assert_int_equal(load_and_count(path, &n_damaged), kept);
        text[at] ^= 0x10;
    }
}

static void bytes_that_are_gone_or_too_many_cost_their_entry(void **state) {
    (void)state;
    size_t size, start[ENTRIES + 1];
    const char *text = support_read(write_journal("moved.runs"), &size);
    const char *path = support_path("shifted.runs");
    char *moved = malloc(size + 100);
    find_entries(text, size, start);
    for (size_t at = start[1]; at + 3 < start[ENTRIES - 1]; at++) {
        long n_damaged = 0;
        memcpy(moved, text, at);
        memcpy(moved + at, text + at + 3, size - at - 3);
        support_write_bytes(path, moved, size - 3);
        const long kept = load_and_count(path, &n_damaged);
        assert_true(kept >= 2 && n_damaged == 1);  // three bytes may be of two entries
        memset(moved + at, 'r', 100);
        memcpy(moved + at + 100, text + at, size - at);
        support_write_bytes(path, moved, size + 100);
        assert_true(load_and_count(path, &n_damaged) >= 3 && n_damaged == 1);
    }
    free(moved);
}

static void a_long_stretch_without_an_entry_is_passed_over(void **state) {
    (void)state;
    enum { STRETCH = 3000001 };
    size_t size, start[ENTRIES + 1];
    long n_damaged = 0;
    const char *text = support_read(write_journal("long.runs"), &size);
    const char *path = support_path("stretched.runs");
    char *bytes = calloc(1, size + STRETCH);
    find_entries(text, size, start);
    memcpy(bytes, text, start[2]);
    memcpy(bytes + start[2] + STRETCH, text + start[2], size - start[2]);
    support_write_bytes(path, bytes, size + STRETCH);
    assert_int_equal(load_and_count(path, &n_damaged), 4);
    assert_int_equal(n_damaged, 1);
    free(bytes);
}

// No run has so many bytes: that is damage, and not an entry that was cut off as it was written.
static void a_last_entry_that_claims_more_than_there_can_be_is_damaged(void **state) {
    (void)state;
    size_t size, start[ENTRIES + 1];
    long n_damaged = 0;
    char *text = (char *)support_read(write_journal("claims.runs"), &size);
    const char *path = support_path("claimed.runs");
    find_entries(text, size, start);
    text[start[ENTRIES - 1] + 6] ^= 1;
    support_write_bytes(path, text, size);
    const long kept = load_and_count(path, &n_damaged);
    assert_int_equal(n_damaged, 1);
    support_write_bytes(path, text, start[ENTRIES - 1]);
    assert_int_equal(load_and_count(path, &n_damaged), kept);
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
    assert_int_equal(journal_open(&j, path, &keys, VALUES, &e), STATUS_OK);
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
    assert_int_equal(journal_open(&j, path, &keys, VALUES, &e), STATUS_OK);
    assert_int_equal(journal_open(&other, path, &keys, VALUES, &e), STATUS_SYSTEM);
    assert_non_null(strstr(e.message, "another run is writing it"));
    journal_close(&j);
    assert_int_equal(journal_open(&other, path, &keys, VALUES, &e), STATUS_OK);
    journal_remove(&other);
    assert_int_not_equal(access(path, F_OK), 0);
}

enum { TURNS = 3000 };

// Opens and removes it again and again, as studies do that end.
static void come_and_go(const char *path) {
    struct journal j;
    struct error e;
    for (int i = 0; i < TURNS; i++) {
        if (journal_open(&j, path, &keys, VALUES, &e) == STATUS_OK) {
            journal_remove(&j);
        }
    }
}

static void a_journal_that_is_open_has_its_name_though_others_end(void **state) {
    (void)state;
    const char *path = support_path("race.runs");
    int n_open = 0, n_lost = 0, result = -1;
    const pid_t other = fork();
    if (other == 0) {
        come_and_go(path);
        _exit(0);
    }
    // The other process may stand still with the journal open for all of these turns, but it ends.
    for (int i = 0; i < TURNS || n_open == 0; i++) {
        struct journal j;
        struct error e;
        if (journal_open(&j, path, &keys, VALUES, &e) == STATUS_OK) {
            n_open++;
            n_lost += !file_is_named(j.file, path);
            journal_remove(&j);
        }
    }
    assert_int_equal(waitpid(other, &result, 0), other);
    assert_int_equal(result, 0);
    assert_int_not_equal(n_open, 0);
    assert_int_equal(n_lost, 0);
}

static void a_journal_removes_nothing_but_itself(void **state) {
    (void)state;
    struct journal j, other;
    struct error e;
    const char *path = write_journal("moved.runs");
    assert_int_equal(journal_open(&j, path, &keys, VALUES, &e), STATUS_OK);
    assert_true(journal_is_there(&j));
    assert_int_equal(rename(path, support_path("elsewhere.runs")), 0);
    assert_false(journal_is_there(&j));
    assert_int_equal(journal_open(&other, path, &keys, VALUES, &e), STATUS_OK);
    journal_remove(&j);
    assert_true(journal_is_there(&other));
    journal_remove(&other);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_entered_is_read_back),
        cmocka_unit_test(a_run_more_goes_behind_the_others),
        cmocka_unit_test(a_file_cut_anywhere_keeps_the_entries_before_the_cut),
        cmocka_unit_test(a_flipped_byte_costs_its_entry),
        cmocka_unit_test(bytes_that_are_gone_or_too_many_cost_their_entry),
        cmocka_unit_test(a_long_stretch_without_an_entry_is_passed_over),
        cmocka_unit_test(a_last_entry_that_claims_more_than_there_can_be_is_damaged),
        cmocka_unit_test(a_journal_from_a_machine_with_another_order_of_bytes_is_not_read),
        cmocka_unit_test(a_journal_is_open_once),
        cmocka_unit_test(a_journal_that_is_open_has_its_name_though_others_end),
        cmocka_unit_test(a_journal_removes_nothing_but_itself),
    };
    return cmocka_run_group_tests(tests, make_keys, free_keys);
}
