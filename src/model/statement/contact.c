// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/pairs.h"
#include "model/statement.h"

enum { GAP, LAW, NAME, MEFF, OVERLAP, CALIBRATE, N_ROW };

static const struct row rows[N_ROW] = {
    [GAP] = {"gap", ROW_LIST, ROW_REQUIRED, {0, 1, 0}, NULL, NAN, "clear distance at rest"},
    [LAW] = {"law", ROW_TEXT, ROW_REQUIRED, {0}, NULL, NAN, "contact law, see `jostle laws`"},
    [NAME] = {"name", ROW_TEXT, 0, {0}, NULL, NAN, "name of the contact"},
    [MEFF] = {"meff",
              ROW_NUMBER,
              0,
              {1, -1, 2},
              &range_positive,
              NAN,
              "effective mass in place of m1 m2 / (m1 + m2)"},
    [OVERLAP] = {"allow-overlap",
                 ROW_FLAG,
                 0,
                 {0},
                 NULL,
                 NAN,
                 "allow a negative gap, or an initial penetration"},
    [CALIBRATE] = {"calibrate",
                   ROW_FLAG,
                   0,
                   {0},
                   NULL,
                   NAN,
                   "replace the published damping by that which delivers -e exactly"},
};

static const struct contact_law *find_law(struct builder *b, const struct statement *s) {
    static const char *const later[] = {"stereomechanical", NULL};
    int n = 0;
    const struct word *w = deck_option(s, "law", &n);
    if (!w || n == 0) {
        deck_error(b->deck, w ? w - 1 : &s->word[0], "%s: %s",
                   w ? "-law needs a value" : "contact needs -law", rows[LAW].doc);
        return NULL;
    }
    const char *name = deck_text(b->deck, w);
    const struct contact_law *law = name ? contact_law_find(name) : NULL;
    if (name && !law) {
        const char **known = builder_array(b, (size_t)n_contact_law, sizeof *known);
        for (int i = 0; known && i < n_contact_law; i++) {
            known[i] = contact_laws[i]->name;
        }
        if (known) {
            builder_unknown(b, w, name, "contact law", known, n_contact_law, later);
        }
    }
    return law;
}

static bool check_gaps(struct builder *b, const struct argument *a) {
    for (int i = 0; i < a[GAP].n; i++) {
        if (a[GAP].number[i] < 0.0 && !a[OVERLAP].given) {
            deck_error(b->deck, &a[GAP].word[i],
                       "gap is %.6g %s; it must be >= 0 unless -allow-overlap is given",
                       a[GAP].number[i], b->deck->units.length_name);
            return false;
        }
    }
    return true;
}

// Puts the damping that delivers -e exactly in place of -e.
static bool calibrate(struct builder *b, const struct contact_law *law, const struct word *flag,
                      struct argument *given) {
    int restitution = contact_law_row(law, "e");
    if (!law->exact) {
        deck_error(b->deck, flag, "contact law %s takes no -e that could be calibrated", law->name);
        return false;
    }
    if (!given[restitution].given) {
        deck_error(b->deck, flag, "-calibrate needs -e: coefficient of restitution to deliver");
        return false;
    }
    double *zeta = builder_array(b, 1, sizeof *zeta);
    if (!zeta) {
        return false;
    }
    *zeta = law->exact(given[restitution].number[0]);
    if (isnan(*zeta)) {
        deck_error(b->deck, &given[restitution].word[0],
                   "no damping is found with which %s delivers e = %.6g", law->name,
                   given[restitution].number[0]);
        return false;
    }
    given[restitution].n = 0;
    struct argument *damping = &given[contact_law_row(law, "zeta")];
    damping->number = zeta;
    damping->n = 1;
    return true;
}

static void append(struct builder *b, const struct pairs *p, const struct contact_law *law,
                   const struct argument *own, const struct argument *given) {
    bool good = check_gaps(b, own);
    const char *name = pairs_name(b, &own[NAME], &good);
    const double *gap = builder_spread(b, &own[GAP], p->n, "contacts");
    for (int k = 0; good && gap && k < p->n; k++) {
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
        good = pairs_set_law(b, &d->link, law, given, own[LAW].word);
    }
}

static void build(struct builder *b, const struct statement *s) {
    if (!builder_plain(b, s, 2, 2, statement_contact.usage)) {
        return;
    }
    struct pairs p;
    bool paired = pairs_read(b, s, &p);
    const struct contact_law *law = find_law(b, s);
    if (!law) {
        return;
    }
    struct argument own[N_ROW] = {0};
    struct argument given[CONTACT_ROWS_MAX] = {0};
    struct row_set set[] = {{rows, N_ROW, own}, {law->row, law->n_row, given}};
    bool good = deck_options(b->deck, s, set, 2);
    if (good && own[CALIBRATE].given) {
        good = calibrate(b, law, &own[CALIBRATE].key, given);
    }
    if (good && paired) {
        append(b, &p, law, own, given);
    }
}

const struct statement_kind statement_contact = {
    .name = "contact",
    .usage = "LEFT RIGHT -gap LIST -law LAW ... [-name NAME] [-meff M] [-allow-overlap] "
             "[-calibrate]",
    .summary = "unilateral contact links between facing floors, or floors and a wall",
    .example = "contact A B -gap 20mm -law jankowski -k 2.75e9N/m^1.5 -e 0.65",
    .row = rows,
    .n_row = N_ROW,
    .build = build,
};
