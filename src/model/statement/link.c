// SPDX-License-Identifier: GPL-3.0-or-later
#include "law/bilateral.h"
#include "model/builder.h"
#include "model/pairs.h"

enum { NAME, N_ROW };

static const struct row rows[N_ROW] = {
    [NAME] = {"name", ROW_TEXT, 0, OF_NONE, NULL, NAN, "name of the link"},
};

enum { N_VARIANT = 1 };
static const struct statement_variant variants[N_VARIANT] = {
    {.row = bilateral_rows, .n_row = BILATERAL_ROWS},
};

static void append(struct builder *b, const struct pairs *p, const struct argument *own,
                   const struct law_choice *choice) {
    bool good = true;
    const char *name = pairs_name(b, &own[NAME], &good);
    for (int k = 0; good && k < p->n; k++) {
        struct link_draft *d =
            pairs_append(b, p, k, name, own[NAME].given ? own[NAME].word : p->word);
        if (!d) {
            return;
        }
        d->link.bilateral = true;
        pairs_set_law(b, &d->link, choice);
    }
}

static bool is_zero(const struct argument *a) {
    return !a->given || a->number[0] == 0.0;
}

static void build(struct builder *b, const struct statement *s) {
    if (!builder_plain(b, s, 2, 2, statement_link.usage)) {
        return;
    }
    struct pairs p;
    bool paired = pairs_read(b, s, GROUND_ALLOWED, &p);
    struct argument own[N_ROW] = {0};
    struct law_choice choice = {.law = &bilateral_law, .word = &s->word[1], .restitution = NAN};
    const struct argument *given = choice.given;
    struct row_set set[] = {{rows, N_ROW, own}, {bilateral_rows, BILATERAL_ROWS, choice.given}};
    if (!deck_options(b->deck, s, set, 2)) {
        return;
    }
    const struct argument *exponent = &given[BILATERAL_EXPONENT];
    if (!given[BILATERAL_STIFFNESS].given && !given[BILATERAL_DASHPOT].given) {
        deck_error(b->deck, &s->word[0], "a link needs -stiffness or -dashpot");
    } else if (exponent->given && !given[BILATERAL_DASHPOT].given) {
        deck_error(b->deck, &exponent->key, "-exponent needs -dashpot");
    } else if (paired) {
        // A parameter of 0 may remove the link on purpose, so this is a warning.
        if (is_zero(&given[BILATERAL_STIFFNESS]) && is_zero(&given[BILATERAL_DASHPOT])) {
            deck_warning(b->deck, &s->word[0], "this link does nothing: its values are 0");
        }
        append(b, &p, own, &choice);
    }
}

const struct statement_kind statement_link = {
    .name = "link",
    .usage = "LEFT RIGHT [-stiffness K] [-dashpot C [-exponent A]] [-name NAME]",
    .summary = "spring and viscous damper between two floors or levels (B@6.8m); it acts in both "
               "directions",
    .example = "link A:5 B:5 -dashpot 2MN*s/m",
    .row = rows,
    .n_row = N_ROW,
    .variant = variants,
    .n_variant = N_VARIANT,
    .build = build,
};
