// SPDX-License-Identifier: GPL-3.0-or-later
#include <assert.h>
#include <string.h>

#include "law/bilateral.h"
#include "law/link_law.h"
#include "law/maxwell.h"
#include "model/builder.h"
#include "model/pairs.h"
#include "model/storey_choice.h"

enum { NAME, LAW, N_ROW };

static const struct row rows[N_ROW] = {
    [NAME] = {"name", ROW_TEXT, 0, OF_NONE, NULL, NAN, "name of the link"},
    [LAW] = {"law", ROW_TEXT, 0, OF_NONE, NULL, NAN,
             "viscous (the default), maxwell, friction, hook, cable, gap, or any storey law"},
};

enum { N_VARIANT = 3 };
static const struct statement_variant variants[N_VARIANT] = {
    {
        .name = "-law viscous",
        .summary = "spring and viscous damper; -law may be left out",
        .row = bilateral_rows,
        .n_row = BILATERAL_ROWS,
    },
    {
        .name = "-law maxwell",
        .summary = "spring and viscous damper in series",
        .row = maxwell_rows,
        .n_row = MAXWELL_ROWS,
    },
    {
        .name = "-law NAME",
        .summary = "friction (-slip LIST), hook, cable, gap, or a storey law with its options",
        .row = link_law_rows,
        .n_row = LINK_ROWS,
    },
};

// Appends the pairs of the statement. `set` gives link k its law. False after a report.
typedef bool set_law(struct builder *b, struct link *link, int k, const void *context);

static void append(struct builder *b, const struct pairs *p, const struct argument *own,
                   set_law *set, const void *context) {
    bool good = true;
    const char *name = pairs_name(b, &own[NAME], &good);
    for (int k = 0; good && k < p->n; k++) {
        struct link_draft *d =
            pairs_append(b, p, k, name, own[NAME].given ? own[NAME].word : p->word);
        if (!d) {
            return;
        }
        d->link.bilateral = true;
        good = set(b, &d->link, k, context);
    }
}

static bool set_choice(struct builder *b, struct link *link, int k, const void *context) {
    (void)k;
    return pairs_set_law(b, link, context);
}

static bool is_zero(const struct argument *a) {
    return !a->given || a->number[0] == 0.0;
}

// False after a report about the options of a spring and damper.
static bool check_viscous(struct builder *b, const struct statement *s,
                          const struct argument *given) {
    static const enum bilateral_row of_dashpot[] = {BILATERAL_EXPONENT, BILATERAL_RELIEF};
    if (!given[BILATERAL_STIFFNESS].given && !given[BILATERAL_DASHPOT].given) {
        return deck_error(b->deck, &s->word[0], "a link needs -stiffness or -dashpot");
    }
    for (size_t i = 0; i < sizeof of_dashpot / sizeof of_dashpot[0]; i++) {
        const struct argument *a = &given[of_dashpot[i]];
        if (a->given && !given[BILATERAL_DASHPOT].given) {
            return deck_error(b->deck, &a->key, "-%s needs -dashpot",
                              bilateral_rows[of_dashpot[i]].key);
        }
    }
    if (given[BILATERAL_RELIEF_DASHPOT].given && !given[BILATERAL_RELIEF].given) {
        return deck_error(b->deck, &given[BILATERAL_RELIEF_DASHPOT].key,
                          "-relief-dashpot needs -relief");
    }
    // A parameter of 0 may remove the link on purpose, so this is a warning.
    if (is_zero(&given[BILATERAL_STIFFNESS]) && is_zero(&given[BILATERAL_DASHPOT])) {
        deck_warning(b->deck, &s->word[0], "this link does nothing: its values are 0");
    }
    return true;
}

// A link with a contact law: viscous or maxwell.
static void build_plain(struct builder *b, const struct statement *s, const struct pairs *p,
                        const struct link_law *law) {
    struct argument own[N_ROW] = {0};
    struct law_choice choice = {.law = law->law, .word = &s->word[1], .restitution = NAN};
    struct row_set set[] = {{rows, N_ROW, own}, {law->row, law->n_row, choice.given}};
    if (deck_options(b->deck, s, set, 2) &&
        (law->law != &bilateral_law || check_viscous(b, s, choice.given)) && p) {
        append(b, p, own, set_choice, &choice);
    }
}

// A storey law as the law of the links of a statement.
struct storey_links {
    const struct statement *statement;
    const struct link_law *law;
    const struct contact_law *made;
    double **value;  // (made->n_row), each (number of pairs); NULL: not given
};

static bool set_storey_law(struct builder *b, struct link *link, int k, const void *context) {
    const struct storey_links *c = context;
    double *value = arena_alloc(b->arena, (size_t)c->made->n_row, sizeof *value);
    for (int r = 0; value && r < c->made->n_row; r++) {
        value[r] = c->value[r] ? c->value[r][k] : NAN;
    }
    link->law = c->made;
    link->value = value;
    link->constant =
        value ? pairs_storey_constants(b, c->law, c->made, value, &c->statement->word[0]) : NULL;
    link->restitution = NAN;
    return link->constant != NULL;
}

static void build_storey_law(struct builder *b, const struct statement *s, const struct pairs *p,
                             const struct link_law *law) {
    const int n_row = LINK_ROWS + law->n_row;
    struct argument own[N_ROW] = {0}, given[LINK_ROWS + STOREY_ROWS_MAX] = {0};
    const struct contact_law *made = pairs_storey_law(b, law);
    double **value = arena_alloc(b->arena, (size_t)n_row, sizeof *value);
    struct row_set set[2 + LINK_ROWS] = {{rows, N_ROW, own},
                                         {law->row, law->n_row, given + LINK_ROWS}};
    int n_set = 2;
    for (int r = 0; r < LINK_ROWS; r++) {
        if (link_law_has(law, r)) {
            set[n_set++] = (struct row_set){&link_law_rows[r], 1, &given[r]};
        }
    }
    if (!made || !value || !deck_options(b->deck, s, set, n_set) || !p) {
        return;
    }
    const struct storey_links choice = {s, law, made, value};
    if (storey_choices_rows(b, made->row, n_row, given, p->n, "links", value)) {
        append(b, p, own, set_storey_law, &choice);
    }
}

// The law that -law names. False after a report.
static bool find_law(struct builder *b, const struct statement *s, struct link_law *law) {
    int n = 0;
    const struct word *w = deck_option(s, rows[LAW].key, &n);
    *law = link_law_at(0);
    // deck_options reports -law without a value
    return !w || n == 0 || storey_choice_find_link(b->deck, w, law);
}

static void build(struct builder *b, const struct statement *s) {
    if (!builder_plain(b, s, 2, 2, statement_link.usage)) {
        return;
    }
    struct pairs p;
    struct link_law law;
    const bool paired = pairs_read(b, s, GROUND_ALLOWED, &p);
    if (find_law(b, s, &law)) {
        (law.storey ? build_storey_law : build_plain)(b, s, paired ? &p : NULL, &law);
    }
}

const struct statement_kind statement_link = {
    .name = "link",
    .usage = "LEFT RIGHT [-law LAW] ... [-name NAME]",
    .summary = "spring, damper, brace or cable between two floors or levels (B@6.8m); it acts in "
               "both directions unless it is slack or in tension only",
    .example = "link A:5 B:5 -dashpot 2MN*s/m",
    .row = rows,
    .n_row = N_ROW,
    .variant = variants,
    .n_variant = N_VARIANT,
    .build = build,
};
