// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/target_code.h"

#include <string.h>
#include <strings.h>

#include "core/text.h"
#include "jostle/units.h"

static bool equal(const char *text, size_t n, const char *word) {
    return strlen(word) == n && strncasecmp(text, word, n) == 0;
}

const struct target_code *target_code_find(const char *text) {
    const size_t n = strcspn(text, ":");
    for (int i = 0; i < n_target_code; i++) {
        if (equal(text, n, target_codes[i]->name)) {
            return target_codes[i];
        }
    }
    return NULL;
}

int target_code_hint(struct error *e) {
    const struct error cause = *e;
    const char *known[8];
    char list[128];
    for (int i = 0; i < n_target_code; i++) {
        known[i] = target_codes[i]->name;
    }
    return error_set(e, cause.status, "%s; the spectra of codes are %s", cause.message,
                     text_list(list, sizeof list, known, n_target_code));
}

// Sets *value to the number of the word; false: it is none of them.
static bool read_word(const struct row *r, const char *text, size_t n, double *value) {
    for (int i = 0; r->range->word[i]; i++) {
        if (equal(text, n, r->range->word[i])) {
            *value = i;
            return true;
        }
    }
    return false;
}

static bool read_number(const struct target_row *r, const char *text, size_t n, double *value) {
    struct unit_system si;
    struct dimension found;
    const char *end, *behind;
    double size;
    unit_system_init(&si);
    if (text_number(text, &end, value) != TEXT_NUMBER_OK) {
        return false;
    }
    if (!unit_parse(end, si.gravity, &behind, &found, &size)) {
        *value *= r->bare;
        return end == text + n && r->bare > 0.0;
    }
    *value *= size;
    return behind == text + n && dimension_equal(found, r->row.dimension);
}

// Reads the `n` characters KEY=VALUE at `text`.
static int read_pair(const struct target_code *c, const char *text, size_t n, double *value,
                     bool *given, struct error *e) {
    const size_t n_key = strcspn(text, "=") < n ? strcspn(text, "=") : n;
    int i = 0;
    while (i < c->n && !equal(text, n_key, c->row[i].row.key)) {
        i++;
    }
    if (i == c->n) {
        const char *known[TARGET_CODE_ROWS_MAX];
        char list[128];
        for (int k = 0; k < c->n; k++) {
            known[k] = c->row[k].row.key;
        }
        return error_set(e, STATUS_INPUT, "%s has no '%.*s'; it has %s", c->name, (int)n_key, text,
                         text_list(list, sizeof list, known, c->n));
    }
    const struct row *r = &c->row[i].row;
    if (given[i]) {
        return error_set(e, STATUS_INPUT, "%s is given twice", r->key);
    }
    given[i] = true;
    const char *word = text + (n_key < n ? n_key + 1 : n);
    const size_t n_word = (size_t)(text + n - word);
    if (r->kind == ROW_CHOICE
            ? read_word(r, word, n_word, &value[i])
            : read_number(&c->row[i], word, n_word, &value[i]) && range_holds(r->range, value[i])) {
        return STATUS_OK;
    }
    const char *noun = r->kind == ROW_CHOICE ? "" : dimension_noun(r->dimension);
    return error_set(e, STATUS_INPUT, "%s takes %s%s%s%s, not '%.*s'", r->key, noun,
                     noun[0] ? " " : "", r->range->text,
                     r->kind != ROW_CHOICE && c->row[i].bare == 0.0 ? " with its unit" : "",
                     (int)n_word, word);
}

int target_code_read(const struct target_code *c, const char *text, double damping, double *value,
                     struct error *e) {
    bool given[TARGET_CODE_ROWS_MAX] = {false};
    for (int i = 0; i < c->n; i++) {
        value[i] = c->row[i].row.fallback;
    }
    text += strcspn(text, ":");
    text += *text == ':';
    while (*text) {
        const size_t n = strcspn(text, ",");
        const int status = read_pair(c, text, n, value, given, e);
        if (status != STATUS_OK) {
            return status;
        }
        text += n + (text[n] == ',');
    }
    for (int i = 0; i < c->n; i++) {
        if (!given[i] && c->row[i].row.flags & ROW_REQUIRED) {
            return error_set(e, STATUS_INPUT, "%s needs %s, as in %s", c->name, c->row[i].row.key,
                             c->example);
        }
    }
    if (!c->damped && damping != 0.05) {
        return error_set(e, STATUS_INPUT, "%s is a spectrum for 5 %% damping, not for %g %%",
                         c->name, 100.0 * damping);
    }
    const char *fault = c->settle(value, damping);
    return fault ? error_set(e, STATUS_INPUT, "%s: %s", c->name, fault) : STATUS_OK;
}
