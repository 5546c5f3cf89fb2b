// SPDX-License-Identifier: GPL-3.0-or-later
// What a deck means, as a checksum: of its statements, word by word, without comments, blanks, line
// breaks and the title. All other statements count as they are written: `output` too, as adaptive
// steps end at its rows and as it says which histories are kept.
#include <string.h>

#include "core/checksum.h"
#include "deck/reader.h"

static void add_statement(struct checksum_sum *sum, const struct statement *s) {
    if (strcmp(s->word[0].text, "title") == 0) {
        return;
    }
    checksum_add_number(sum, (uint64_t)s->n_word);
    for (int i = 0; i < s->n_word; i++) {
        checksum_add_number(sum, s->word[i].quoted);
        checksum_add_text(sum, s->word[i].text);
    }
}

// Of an opened deck, which is then freed. What cannot be parted into statements counts as a whole.
static int find(struct deck *d, struct checksum *out, struct error *e) {
    struct checksum_sum sum;
    struct statement s;
    checksum_start(&sum);
    while (scan_statement(d, &d->reader->frame[0], &s)) {
        add_statement(&sum, &s);
    }
    if (d->torn) {
        checksum_add_text(&sum, d->text);
    }
    checksum_end(&sum, out);
    const bool no_memory = d->diagnostics.out_of_memory;
    deck_free(d);
    return no_memory ? error_no_memory(e) : STATUS_OK;
}

int deck_meaning(const char *text, struct checksum *out, struct error *e) {
    struct deck *d;
    const int status = deck_open_text("", text, NULL, 0, &d, e);
    return status == STATUS_OK ? find(d, out, e) : status;
}

int deck_meaning_of_file(const char *path, struct checksum *out, struct error *e) {
    struct deck *d;
    const int status = deck_open(path, NULL, 0, &d, e);
    return status == STATUS_OK ? find(d, out, e) : status;
}
