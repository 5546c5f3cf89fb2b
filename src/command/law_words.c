// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/law_words.h"

#include <stdlib.h>
#include <string.h>

#include "command/command.h"

// A word as a deck would have it: quoted where it would otherwise be split.
static void append_word(FILE *to, const char *word) {
    const size_t n = strlen(word);
    const bool quoted = n == 0 || strpbrk(word, " \t") || word[0] == '#' || word[n - 1] == '\\';
    const char *quote = quoted ? "\"" : "";
    fprintf(to, " %s%s%s", quote, word, quote);
}

// "LAW,LAW" as one statement each; a text with options unchanged.
static void append_compared(FILE *to, const char *laws) {
    if (strpbrk(laws, " \t")) {
        fprintf(to, "law %s\n", laws);
        return;
    }
    const char *at = laws;
    const char *end;
    do {
        end = at + strcspn(at, ",");
        fprintf(to, "law %.*s\n", (int)(end - at), at);
        at = end + 1;
    } while (*end);
}

static int append_all(const struct law_words *words, FILE *to, struct error *e) {
    fputs("law", to);
    for (int i = 0; i < words->n_word; i++) {
        if (strpbrk(words->word[i], "\r\n")) {
            return error_set(e, STATUS_INPUT, "a word of the command line has a line end");
        }
        append_word(to, words->word[i]);
    }
    fputc('\n', to);
    for (int i = 0; i < words->n_compare; i++) {
        if (strpbrk(words->compare[i], "\r\n")) {
            return error_set(e, STATUS_INPUT, "a law to compare with has a line end");
        }
        append_compared(to, words->compare[i]);
    }
    return STATUS_OK;
}

int law_words_open(const struct law_words *words, struct deck **deck, size_t *n_law,
                   struct error *e) {
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    if (!to) {
        return error_no_memory(e);
    }
    int status = append_all(words, to, e);
    if (fclose(to) != 0 && status == STATUS_OK) {
        status = error_no_memory(e);
    }
    if (status == STATUS_OK) {
        status = deck_open_text("command line", text, NULL, 0, deck, e);
    }
    for (size_t i = 0; i < size; i++) {
        *n_law += text[i] == '\n';
    }
    free(text);
    return status;
}

bool law_words_take_name(struct deck *d, struct statement *s) {
    if (s->n_plain != 2) {
        const struct word *w = &s->word[s->n_plain > 2 ? 2 : 0];
        return deck_error(
            d, w, s->n_plain > 2 ? "'%s' is not expected" : "%s needs the name of a law", w->text);
    }
    s->word++;
    s->n_word--;
    s->n_plain--;
    return true;
}

bool law_words_lend(struct deck *d, const struct statement *first, law_words_key *has_key,
                    const void *context, struct statement *s) {
    struct word *word = deck_array(d, (size_t)first->n_word, sizeof *word);
    if (!word) {
        return false;
    }
    word[0] = s->word[0];
    int n = 1;
    bool taken = false;
    for (int i = first->n_plain; i < first->n_word; i++) {
        taken = deck_is_option(&first->word[i]) ? has_key(context, first->word[i].text + 1) : taken;
        if (taken) {
            word[n++] = first->word[i];
        }
    }
    *s = (struct statement){.word = word, .n_word = n, .n_plain = 1};
    return true;
}

int law_words_check(const struct deck *deck, struct error *e) {
    const struct diagnostics *d = &deck->diagnostics;
    if (d->n_error == 0 && !d->out_of_memory) {
        return STATUS_OK;
    }
    diagnostics_print(d, stderr, command_colour());
    return error_set(e, d->out_of_memory ? STATUS_SYSTEM : STATUS_INPUT,
                     "the command line has %d error%s", d->n_error, d->n_error == 1 ? "" : "s");
}
