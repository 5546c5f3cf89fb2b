// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/output_name.h"

#include <ctype.h>
#include <stdlib.h>
#include <sys/stat.h>

#include "core/text.h"
#include "jostle/model.h"

const char *output_part_name(struct arena *a, const char *path, const struct study_shard *s) {
    size_t n;
    const char *end = text_stem(path, &n) + n;
    return arena_format(a, "%.*s.%ld-of-%ld%s", (int)(end - path), path, s->number, s->n, end);
}

const char *output_choose(const struct model *m, const char *given, const struct study_shard *s) {
    struct arena *a = m->deck->arena;
    if (given) {
        return given;
    }
    // Without a name: that of the deck with the extension .h5, without its folder.
    size_t n;
    const char *stem = text_stem(m->deck->path, &n);
    const char *path = m->output.file ? m->output.file : arena_format(a, "%.*s.h5", (int)n, stem);
    return path && s->n > 0 ? output_part_name(a, path, s) : path;
}

bool output_is_same_file(const char *a, const char *b) {
    struct stat of_a, of_b;
    return stat(a, &of_a) == 0 && stat(b, &of_b) == 0 && of_a.st_dev == of_b.st_dev &&
           of_a.st_ino == of_b.st_ino;
}

// Digits, to *end; what is too large stays so, as LONG_MAX.
static bool parse_digits(const char *text, const char **end, long *value) {
    char *behind;
    if (!isdigit((unsigned char)text[0])) {
        return false;
    }
    *value = strtol(text, &behind, 10);
    *end = behind;
    return true;
}

bool output_parse_shard(const char *text, struct study_shard *s) {
    const char *end;
    return parse_digits(text, &end, &s->number) && *end == '/' &&
           parse_digits(end + 1, &end, &s->n) && *end == '\0' && s->number >= 1 &&
           s->number <= s->n && s->n <= STUDY_RUNS_MAX;
}
