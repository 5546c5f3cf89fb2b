// SPDX-License-Identifier: GPL-3.0-or-later
// The histories of runs in the journal of a study: they are read back; a damaged byte of them costs
// their run, and never gives a wrong value.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "study/journal.h"
#include "study/journal_entry.h"
#include "support/keys.h"
#include "support/support.h"

enum { RUNS = 5, VALUES = 3, FAILED = 1 };
static const char head[] = "the deck\t1\n";

static struct keys keys;

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

enum { SHAPE = 7, BLOCKS = 3, LONG_BLOCK = ENTRY_BLOCK_BYTES };

static void fill_block(unsigned char *bytes, size_t n, long run, long index) {
    for (size_t i = 0; i < n; i++) {
        bytes[i] = (unsigned char)((size_t)run + 3 * (size_t)index + i);
    }
}

static size_t block_size(long run, long index) {
    return index == 1 ? LONG_BLOCK : (size_t)(40 + run);
}

static void open_with_histories(struct journal *j, const char *path, uint64_t shape) {
    struct error e;
    assert_int_equal(journal_open(j, path, &keys, VALUES, &e), STATUS_OK);
    if (shape != 0) {
        assert_int_equal(journal_want_histories(j, shape, &e), STATUS_OK);
    }
}

static void add_done(struct journal *j, long run) {
    struct error e;
    const double value[VALUES] = {1.0, 2.0, (double)run};
    assert_int_equal(
        journal_add_run(j, run, &(struct study_outcome){.status = STUDY_DONE}, false, value, &e),
        STATUS_OK);
}

static void add_block(struct journal *j, long run, long index) {
    static unsigned char bytes[LONG_BLOCK];
    struct error e;
    fill_block(bytes, block_size(run, index), run, index);
    assert_int_equal(journal_add_block(j, run, bytes, block_size(run, index), &e), STATUS_OK);
}

// Runs 0 and 2 with the blocks of both mixed, after an attempt at run 2 that was broken off.
static const char *write_histories(const char *name) {
    const char *path = support_path(name);
    struct journal j;
    struct error e;
    unlink(path);
    open_with_histories(&j, path, SHAPE);
    assert_int_equal(journal_reset(&j, head, &e), STATUS_OK);
    add_block(&j, 2, 0);
    journal_begin_run(&j, 0);
    journal_begin_run(&j, 2);
    for (long index = 0; index < BLOCKS; index++) {
        add_block(&j, 2, index);
        add_block(&j, 0, index);
    }
    add_done(&j, 2);
    add_done(&j, 0);
    journal_close(&j);
    return path;
}

static void check_blocks(struct journal *j, long run) {
    static unsigned char wanted[LONG_BLOCK];
    int64_t *offset;
    struct error e;
    assert_int_equal(j->chain[run].n, BLOCKS);
    assert_int_equal(journal_find_blocks(j, run, &offset, &e), STATUS_OK);
    for (long index = 0; index < BLOCKS; index++) {
        const unsigned char *bytes;
        size_t n;
        assert_int_equal(journal_read_block(j, run, offset[index], &bytes, &n, &e), STATUS_OK);
        assert_int_equal(n, block_size(run, index));
        fill_block(wanted, n, run, index);
        assert_memory_equal(bytes, wanted, n);
    }
    free(offset);
}

// Loads it and checks the histories of the runs that it has; how many there are.
static long load_histories(const char *path, uint64_t shape) {
    struct journal j;
    struct error e;
    open_with_histories(&j, path, shape);
    assert_int_equal(journal_load(&j, &e), STATUS_OK);
    for (long run = 0; run < RUNS; run++) {
        if (j.offset[run] != 0 && j.chain && run != FAILED) {
            check_blocks(&j, run);
        }
    }
    const long n = j.n_done;
    journal_close(&j);
    return n;
}

static void histories_are_read_back(void **state) {
    (void)state;
    assert_int_equal(load_histories(write_histories("histories.runs"), SHAPE), 2);
}

static void runs_without_the_histories_that_are_wanted_are_not_there(void **state) {
    (void)state;
    const char *path = support_path("without.runs");
    struct journal j;
    struct error e;
    unlink(path);
    open_with_histories(&j, path, 0);
    assert_int_equal(journal_reset(&j, head, &e), STATUS_OK);
    add_done(&j, 3);
    journal_close(&j);
    assert_int_equal(load_histories(path, 0), 1);
    assert_int_equal(load_histories(path, SHAPE), 0);
    path = write_histories("others.runs");
    assert_int_equal(load_histories(path, SHAPE + 1), 0);
    assert_int_equal(load_histories(path, 0), 0);
}

static void a_run_that_failed_needs_no_histories(void **state) {
    (void)state;
    const char *path = write_histories("failed.runs");
    struct journal j;
    struct error e;
    const double value[VALUES] = {0.0};
    open_with_histories(&j, path, SHAPE);
    assert_int_equal(journal_load(&j, &e), STATUS_OK);
    assert_int_equal(journal_add_run(&j, FAILED, &(struct study_outcome){.status = STUDY_FAILED},
                                     false, value, &e),
                     STATUS_OK);
    journal_close(&j);
    assert_int_equal(load_histories(path, SHAPE), 3);
}

// Each byte of the first and of the last entries, and some between.
static void a_flipped_byte_of_histories_costs_their_run(void **state) {
    (void)state;
    size_t size;
    char *text = (char *)support_read(write_histories("block.runs"), &size);
    const char *path = support_path("blocks.runs");
    const size_t first = 8 + 8 + strlen(head) + 8;
    const size_t broken_off = 8 + sizeof(struct entry_block) + block_size(2, 0) + 8;
    for (size_t at = first; at < size; at += at < first + 400 || at + 400 > size ? 1 : 9973) {
        text[at] ^= 0x10;
        support_write_bytes(path, text, size);
        assert_int_equal(load_histories(path, SHAPE), at < first + broken_off ? 2 : 1);
        text[at] ^= 0x10;
    }
}

static void histories_that_are_cut_cost_their_run(void **state) {
    (void)state;
    size_t size;
    const char *text = support_read(write_histories("cutting.runs"), &size);
    const char *path = support_path("cut_blocks.runs");
    const size_t first = 8 + 8 + strlen(head) + 8;
    for (size_t n = first; n <= size; n += n + 400 > size ? 1 : 9973) {
        support_write_bytes(path, text, n);
        const size_t entry = 8 + journal_entry_run_size(VALUES) - STUDY_MESSAGE_MAX + 8;
        assert_int_equal(load_histories(path, SHAPE), n == size ? 2 : n + entry >= size ? 1 : 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(histories_are_read_back),
        cmocka_unit_test(runs_without_the_histories_that_are_wanted_are_not_there),
        cmocka_unit_test(a_run_that_failed_needs_no_histories),
        cmocka_unit_test(a_flipped_byte_of_histories_costs_their_run),
        cmocka_unit_test(histories_that_are_cut_cost_their_run),
    };
    return cmocka_run_group_tests(tests, make_keys, free_keys);
}
