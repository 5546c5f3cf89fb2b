// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/builder.h"
#include "model/law_choice.h"
#include "model/pairs.h"
#include "model/struck_column.h"

enum { GAP, LAW, NAME, MEFF, OVERLAP, BY_LEVEL, DEPTH, N_ROW };

static const double DEPTH_USUAL = 0.5;  // [m] of beams and slabs

static const struct row rows[N_ROW] = {
    [GAP] = {"gap", ROW_LIST, ROW_REQUIRED, OF_LENGTH, NULL, NAN, "clear distance at rest"},
    [LAW] = {"law", ROW_TEXT, ROW_REQUIRED, OF_NONE, NULL, NAN, "contact law, see `jostle laws`"},
    [NAME] = {"name", ROW_TEXT, 0, OF_NONE, NULL, NAN, "name of the contact"},
    [MEFF] = {"meff", ROW_NUMBER, 0, OF_MASS, &range_positive, NAN,
              "effective mass, instead of m1 m2 / (m1 + m2)"},
    [OVERLAP] = {"allow-overlap", ROW_FLAG, 0, OF_NONE, NULL, NAN,
                 "allows a negative gap or an initial penetration"},
    [BY_LEVEL] = {"by-level", ROW_FLAG, 0, OF_NONE, NULL, NAN,
                  "pairs all floors of two buildings by their levels"},
    [DEPTH] = {"depth", ROW_NUMBER, 0, OF_LENGTH, &range_positive, NAN,
               "with -by-level: pairs floors whose levels differ by less; default: 0.5 m"},
};

static const struct contact_law *find_law(struct builder *b, const struct statement *s,
                                          const struct word **name) {
    int n = 0;
    const struct word *w = deck_option(s, "law", &n);
    if (!w || n == 0) {
        deck_error(b->deck, w ? w - 1 : &s->word[0], "%s: %s",
                   w ? "-law needs a value" : "contact needs -law", rows[LAW].doc);
        return NULL;
    }
    *name = w;
    return law_choice_find(b->deck, w);
}

static bool check_gaps(struct builder *b, const struct argument *a) {
    for (int i = 0; i < a[GAP].n; i++) {
        if (a[GAP].number[i] < 0.0 && !a[OVERLAP].given) {
            return deck_error(b->deck, &a[GAP].word[i],
                              "gap is %.6g %s; it must be >= 0 unless -allow-overlap is given",
                              a[GAP].number[i], b->deck->units.length_name);
        }
    }
    return true;
}

static void append(struct builder *b, const struct pairs *p, const struct argument *own,
                   const struct law_choice *choice) {
    bool good = check_gaps(b, own);
    const char *name = pairs_name(b, &own[NAME], &good);
    const double *gap = builder_spread(b, &own[GAP], p->n, "contacts");
    for (int k = 0; good && gap && k < p->n; k++) {
        for (int i = 0; i < 2; i++) {
            struck_column_strike(b, p->building[i], p->floor[i][k], p->level[i][k]);
        }
        struct link_draft *d =
            pairs_append(b, p, k, name, own[NAME].given ? own[NAME].word : p->word);
        if (!d) {
            return;
        }
        d->link.gap = gap[k];
        d->overlap = own[OVERLAP].given;
        if (own[MEFF].given) {
            d->link.mass = own[MEFF].number[0];
        }
        good = pairs_set_law(b, &d->link, choice);
    }
}

static void build(struct builder *b, const struct statement *s) {
    if (!builder_plain(b, s, 2, 2, statement_contact.usage)) {
        return;
    }
    int n_flag = 0;
    const bool by_level = deck_option(s, "by-level", &n_flag) != NULL;
    struct pairs p;
    bool paired = by_level || pairs_read(b, s, WALL_ALLOWED, &p);
    const struct word *name;
    const struct contact_law *law = find_law(b, s, &name);
    if (!law) {
        return;
    }
    struct argument own[N_ROW] = {0};
    struct row_set set = {rows, N_ROW, own};
    struct law_choice choice;
    bool read = law_choice_read(b->deck, s, law, name, &set, &choice);
    if (by_level && read) {
        const double depth = own[DEPTH].given ? own[DEPTH].number[0] : DEPTH_USUAL;
        paired = pairs_by_level(b, s, own[DEPTH].given ? depth : depth / b->deck->units.length, &p);
    } else if (read && own[DEPTH].given) {
        deck_error(b->deck, &own[DEPTH].key, "-depth needs -by-level");
        return;
    }
    if (own[MEFF].given && !(law->traits & CONTACT_NEEDS_MASS)) {
        deck_error(b->deck, &own[MEFF].key,
                   "-meff has no effect: %s does not depend on the effective mass", law->name);
    } else if (read && paired) {
        append(b, &p, own, &choice);
    }
}

enum { N_VARIANT = 3 };
static const struct statement_variant variants[N_VARIANT] = {
    {.row = law_choice_rows, .n_row = LAW_CHOICE_ROWS},
    {
        .name = "-k-from hertz",
        .summary = "k = (4/3) sqrt(R) E* of two spheres, or of a sphere and a flat face",
        .row = stiffness_hertz_rows,
        .n_row = STIFFNESS_HERTZ_ROWS,
    },
    {
        .name = "-k-from slab",
        .summary = "k = E A / L of the slab that is struck",
        .row = stiffness_slab_rows,
        .n_row = STIFFNESS_SLAB_ROWS,
    },
};

const struct statement_kind statement_contact = {
    .name = "contact",
    .usage = "LEFT RIGHT -gap LIST -law LAW ... [-by-level [-depth D]] [-name NAME] [-meff M] "
             "[-allow-overlap] "
             "[-calibrate] [-k-from hertz|slab ...]",
    .summary = "unilateral contacts between facing floors or levels (B@6.8m), or with a wall",
    .example = "contact A B -gap 20mm -law jankowski -k 2.75e9N/m^1.5 -e 0.65",
    .row = rows,
    .n_row = N_ROW,
    .variant = variants,
    .n_variant = N_VARIANT,
    .build = build,
};
