// SPDX-License-Identifier: GPL-3.0-or-later
// A result file whose texts are damaged is read to its end or refused: nobody waits, and nothing
// is read from elsewhere. Texts lie in the global heap of HDF5, of which the tests take the layout
// from the HDF5 File Format Specification Version 3.0, III.E.
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "support/made_up.h"
#include "support/support.h"

// Reading the file takes a millisecond; whoever waits this long waits for ever.
enum { PATIENCE = 120 };  // [s]
enum { EVERY = 7 };       // object or reference is damaged
enum { HEAD = 16, COLLECTIONS_MAX = 64, REFERENCE = 16 };

static const uint64_t sizes[] = {0,
                                 1,
                                 7,
                                 16,
                                 UINT32_MAX,
                                 UINT64_C(1) << 40,
                                 UINT64_MAX - 31,
                                 UINT64_MAX - 15,
                                 UINT64_MAX - 7,
                                 UINT64_MAX};
enum { N_SIZE = sizeof sizes / sizeof sizes[0] };

struct image {
    const char *path;
    unsigned char *bytes;  // (n) heap
    size_t n;
    size_t collection[COLLECTIONS_MAX];  // where they start
    int n_collection;
    int n_read, n_refused;
};

static struct image image_of(struct made_up *f) {
    struct image image = {.path = f->path};
    struct stat s;
    result_close(made_up_written(f));
    assert_int_equal(stat(f->path, &s), 0);
    image.n = (size_t)s.st_size;
    image.bytes = malloc(image.n);
    FILE *from = fopen(f->path, "rb");
    assert_int_equal(fread(image.bytes, 1, image.n, from), image.n);
    fclose(from);
    for (size_t i = 0; i + HEAD < image.n; i += 8) {
        if (memcmp(image.bytes + i, "GCOL", 4) == 0 && image.n_collection < COLLECTIONS_MAX) {
            image.collection[image.n_collection++] = i;
        }
    }
    assert_in_range(image.n_collection, 1, COLLECTIONS_MAX - 1);
    alarm(PATIENCE);
    return image;
}

static void image_close(struct image *image) {
    alarm(0);
    free(image->bytes);
}

static uint64_t get(const struct image *image, size_t at, int n) {
    uint64_t x = 0;
    while (n-- > 0) {
        x = x << 8 | image->bytes[at + (size_t)n];
    }
    return x;
}

static void put(struct image *image, size_t at, uint64_t x, int n) {
    for (int i = 0; i < n; i++, x >>= 8) {
        image->bytes[at + (size_t)i] = (unsigned char)x;
    }
}

static void write_at(const struct image *image, size_t at, size_t n) {
    FILE *to = fopen(image->path, "r+b");
    assert_int_equal(fseek(to, (long)at, SEEK_SET), 0);
    assert_int_equal(fwrite(image->bytes + at, 1, n, to), n);
    fclose(to);
}

// Reads the file with `n` bytes of it changed to `x`, which are restored.
static int read_with(struct image *image, size_t at, uint64_t x, int n) {
    const uint64_t before = get(image, at, n);
    struct result_file *file = NULL;
    struct error e = {.message = ""};
    put(image, at, x, n);
    write_at(image, at, (size_t)n);
    const int status = result_open(image->path, &file, &e);
    if (status == STATUS_OK) {
        result_close(file);
        image->n_read++;
    } else {
        assert_int_equal(status, STATUS_INPUT);
        assert_non_null(strstr(e.message, image->path));
        image->n_refused++;
    }
    put(image, at, before, n);
    write_at(image, at, (size_t)n);
    return status;
}

// The next object of a collection; 0 at its end.
static size_t next_object(const struct image *image, size_t collection, size_t at) {
    const size_t end = collection + get(image, collection + 8, 8);
    const size_t next =
        at == 0 ? collection + HEAD : at + HEAD + (get(image, at + 8, 8) + 7) / 8 * 8;
    return next + HEAD < end && get(image, next, 2) != 0 ? next : 0;
}

static void objects_of_any_size_and_number_in_the_heap_are_read_or_refused(void **state) {
    struct image image = image_of(*state);
    for (int c = 0; c < image.n_collection; c++) {
        const size_t start = image.collection[c];
        int n = 0;
        for (size_t at = next_object(&image, start, 0); at; at = next_object(&image, start, at)) {
            if (n++ % EVERY != 0) {
                continue;
            }
            for (int k = 0; k < N_SIZE; k++) {
                read_with(&image, at + 8, sizes[k], 8);
            }
            read_with(&image, at, 0, 2);
            read_with(&image, at, UINT16_MAX, 2);
        }
        for (int k = 0; k < N_SIZE; k++) {
            read_with(&image, start + 8, sizes[k], 8);
        }
        read_with(&image, start, 0, 4);
    }
    assert_true(image.n_read > 0 && image.n_refused > 100);
    image_close(&image);
}

static void free_space_of_no_size_is_no_place_to_stay(void **state) {
    struct image image = image_of(*state);
    const size_t start = image.collection[0], first = next_object(&image, start, 0);
    memset(image.bytes + first, 0, HEAD);
    write_at(&image, first, HEAD);
    assert_int_equal(read_with(&image, first, 0, 8), STATUS_INPUT);
    image_close(&image);
}

// A reference is {length, address of the collection, number of the object}.
static void references_to_anywhere_are_read_or_refused(void **state) {
    struct image image = image_of(*state);
    int n_reference = 0;
    for (size_t at = 4; at + REFERENCE < image.n; at++) {
        const uint64_t address = get(&image, at, 8), object = get(&image, at + 8, 4);
        bool is = false;
        for (int c = 0; c < image.n_collection; c++) {
            is = is || address == image.collection[c];
        }
        if (!is || object < 1 || object > UINT16_MAX || n_reference++ % EVERY != 0) {
            continue;
        }
        const uint64_t length = get(&image, at - 4, 4);
        read_with(&image, at - 4, length + 8, 4);
        read_with(&image, at - 4, UINT32_MAX, 4);
        read_with(&image, at + 8, UINT32_MAX, 4);
        read_with(&image, at + 8, 0, 4);
        read_with(&image, at, address + 8, 8);
        read_with(&image, at, image.n - 8, 8);
        read_with(&image, at, UINT64_MAX, 8);
        read_with(&image, at, UINT64_MAX - 8, 8);
    }
    // Most are units and long names, which a report does not ask for.
    assert_true(image.n_refused > 20 && image.n_read > 20);
    image_close(&image);
}

// A header goes on elsewhere, as a message {type 16, 16 bytes, flags, place, size} says: III.A.1.a
// and IV.A.2.q. The library asks for memory of that size.
static void headers_larger_than_the_memory_are_damage(void **state) {
    static const unsigned char message[] = {16, 0, 16, 0};
    struct image image = image_of(*state);
    int n = 0;
    for (size_t at = 0; at + 24 < image.n; at += 8) {
        if (memcmp(image.bytes + at, message, sizeof message) == 0) {
            const uint64_t size = get(&image, at + 16, 8) | UINT64_C(1) << 44;
            struct result_sums sums;
            struct error e;
            read_with(&image, at + 16, size, 8);
            put(&image, at + 16, size, 8);
            write_at(&image, at + 16, 8);
            assert_int_equal(result_verify(image.path, &sums, &e), STATUS_INPUT);
            put(&image, at + 16, size ^ UINT64_C(1) << 44, 8);
            write_at(&image, at + 16, 8);
            n++;
        }
    }
    assert_true(n > 3 && image.n_refused > 0);
    image_close(&image);
}

// The name of a group is in a local heap, that of an end of a link in the global heap.
static void a_link_at_a_building_of_another_name_is_damage(void **state) {
    struct image image = image_of(*state);
    struct result_file *file;
    struct error e = {.message = ""};
    int n = 0;
    for (size_t at = 0; at + 8 < image.n; at += 8) {
        bool in_heap = false;
        for (int c = 0; c < image.n_collection; c++) {
            const size_t start = image.collection[c];
            in_heap = in_heap || (at >= start && at < start + get(&image, start + 8, 8));
        }
        if (!in_heap && memcmp(image.bytes + at, "East\0\0\0", 8) == 0) {
            image.bytes[at + 1] = 'e';
            write_at(&image, at, 8);
            n++;
        }
    }
    assert_true(n > 0);
    assert_int_equal(result_open(image.path, &file, &e), STATUS_INPUT);
    assert_non_null(strstr(e.message, "'East', which is not in /buildings"));
    image_close(&image);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(
            objects_of_any_size_and_number_in_the_heap_are_read_or_refused, made_up_setup,
            made_up_teardown),
        cmocka_unit_test_setup_teardown(free_space_of_no_size_is_no_place_to_stay, made_up_setup,
                                        made_up_teardown),
        cmocka_unit_test_setup_teardown(references_to_anywhere_are_read_or_refused, made_up_setup,
                                        made_up_teardown),
        cmocka_unit_test_setup_teardown(a_link_at_a_building_of_another_name_is_damage,
                                        made_up_setup, made_up_teardown),
        cmocka_unit_test_setup_teardown(headers_larger_than_the_memory_are_damage, made_up_setup,
                                        made_up_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
