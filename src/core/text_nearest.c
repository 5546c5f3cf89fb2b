// SPDX-License-Identifier: GPL-3.0-or-later
// The known word that an unknown word may mean.
#include "core/text.h"

#include <assert.h>
#include <ctype.h>
#include <stdio.h>
#include <string.h>

enum {
    WORD_MAX = 64,
    SHARED_MIN = 3,  // letters of the shorter word, at least, if the other word begins with it
};

static int lower(char c) {
    return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c;
}

static int smaller(int a, int b) {
    return a < b ? a : b;
}

static int exact(char c) {
    return c;
}

// Edit distance with swaps of neighbours (restricted Damerau-Levenshtein distance), row by row.
// Both words have fewer than WORD_MAX bytes. `fold` maps letters that count as equal to one letter.
static int edit_distance(const char *a, int n, const char *b, int m, int (*fold)(char)) {
    int row[3][WORD_MAX];
    int *before = row[0], *last = row[1], *now = row[2];
    for (int j = 0; j <= m; j++) {
        last[j] = j;
    }
    for (int i = 1; i <= n; i++) {
        now[0] = i;
        for (int j = 1; j <= m; j++) {
            bool same = fold(a[i - 1]) == fold(b[j - 1]);
            now[j] = smaller(last[j - 1] + !same, 1 + smaller(last[j], now[j - 1]));
            if (i > 1 && j > 1 && fold(a[i - 1]) == fold(b[j - 2]) &&
                fold(a[i - 2]) == fold(b[j - 1])) {
                now[j] = smaller(now[j], before[j - 2] + 1);
            }
        }
        int *spare = before;
        before = last;
        last = now;
        now = spare;
    }
    return last[m];
}

// True if one word begins with the other. If `word` is the longer one, no letter or digit may
// follow the part that they share.
static bool is_relative(const char *word, const char *known) {
    size_t shared = 0;
    while (word[shared] && word[shared] == known[shared]) {
        shared++;
    }
    bool whole = !word[shared] || (!known[shared] && !isalnum((unsigned char)word[shared]));
    return whole && shared >= SHARED_MIN;
}

// The only known word of which is_relative is true; NULL: there is none, or there are several.
static const char *only_relative(const char *word, const char *const *known, int n) {
    const char *relative = NULL;
    for (int i = 0; i < n; i++) {
        if (is_relative(word, known[i])) {
            if (relative) {
                return NULL;
            }
            relative = known[i];
        }
    }
    return relative;
}

const char *text_nearest(const char *word, const char *const *known, int n) {
    assert(word && n >= 0 && (known || n == 0));
    size_t length = strlen(word);
    if (length >= WORD_MAX || length == 0) {
        return NULL;
    }
    int limit = length >= 6 ? (int)length / 3 : 1;
    limit = smaller(limit, (int)length - (word[0] == '-') - 1);
    int best = WORD_MAX * WORD_MAX;
    const char *nearest = NULL;
    for (int i = 0; i < n; i++) {
        int other = (int)strnlen(known[i], WORD_MAX);
        if (other == WORD_MAX) {
            continue;
        }
        int folded = edit_distance(word, (int)length, known[i], other, lower);
        int score = WORD_MAX * folded + edit_distance(word, (int)length, known[i], other, exact);
        if (folded <= limit && score < best) {
            best = score;
            nearest = known[i];
        }
    }
    return nearest ? nearest : only_relative(word, known, n);
}

const char *text_list(char *to, size_t size, const char *const *known, int n) {
    assert(size > 0 && n >= 0 && (known || n == 0));
    size_t used = 0;
    to[0] = '\0';
    for (int i = 0; i < n; i++) {
        struct text_short name;
        const size_t left = size - used;
        const size_t more = strlen(text_short(&name, known[i])) + 2;
        if (more + sizeof ", ..." > left) {
            snprintf(to + used, left, ", ...");
            break;
        }
        used += (size_t)snprintf(to + used, left, "%s%s", i ? ", " : "", name.text);
    }
    return to;
}
