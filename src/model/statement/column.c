// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/struck_column.h"

#include "deck/reader.h"
#include "model/pairs.h"
#include "model/storey_choice.h"

enum { NAME, BENDING, MODULUS, INERTIA, NUMBER, MASS, DAMPING, SHEAR, MOMENT, N_ROW };

#define OF_BENDING                                                                                 \
    { 1, 2, 0 }
#define OF_INERTIA                                                                                 \
    { 0, 4, 0 }
#define OF_MOMENT                                                                                  \
    { 1, 1, 0 }

static const struct range number_range = {.min = 1.0, .max = 1000.0, .text = ">= 1 and <= 1000"};
static const struct range damping_range = {
    .min = 0.0, .max = 1.0, .max_open = true, .text = ">= 0 and < 1"};

static const struct row rows[N_ROW] = {
    [NAME] = {"name", ROW_TEXT, ROW_REQUIRED, OF_NONE, NULL, NAN, "name of the column"},
    [BENDING] = {"EI", ROW_NUMBER, 0, OF_BENDING, &range_positive, NAN,
                 "bending stiffness of one column"},
    [MODULUS] = {"E", ROW_NUMBER, 0, OF_STRESS, &range_positive, NAN, "modulus, with -I"},
    [INERTIA] = {"I", ROW_NUMBER, 0, OF_INERTIA, &range_positive, NAN,
                 "second moment of area of one column, with -E"},
    [NUMBER] = {"n", ROW_INTEGER, 0, OF_NONE, &number_range, 1.0,
                "number of columns that are struck together"},
    [MASS] = {"mass", ROW_NUMBER, ROW_REQUIRED, OF_MASS, &range_positive, NAN,
              "mass of one column that moves with the struck point"},
    [DAMPING] = {"damping", ROW_NUMBER, 0, OF_NONE, &damping_range, 0.0,
                 "damping ratio of the point against the floors"},
    [SHEAR] = {"shear-strength", ROW_NUMBER, 0, OF_FORCE, &range_positive, INFINITY,
               "shear strength of one column"},
    [MOMENT] = {"moment-strength", ROW_NUMBER, 0, OF_MOMENT, &range_positive, INFINITY,
                "moment strength of one column"},
};

// E I of one column; 0 after a report.
static double bending_of(struct builder *b, const struct statement *s, const struct argument *a) {
    const bool pair = a[MODULUS].given || a[INERTIA].given;
    if (a[BENDING].given == pair) {
        deck_error(b->deck, pair ? &a[BENDING].key : &s->word[0],
                   pair ? "give -EI, or -E and -I" : "column needs -EI, or -E and -I");
    } else if (pair && !(a[MODULUS].given && a[INERTIA].given)) {
        deck_error(b->deck, a[MODULUS].given ? &a[MODULUS].key : &a[INERTIA].key,
                   "-E and -I go together");
    } else {
        return pair ? a[MODULUS].number[0] * a[INERTIA].number[0] : a[BENDING].number[0];
    }
    return 0.0;
}

// Reads BUILDING@LEVEL, a level between two floors. False after a report.
static bool read_place(struct builder *b, const struct statement *s, struct selection *place,
                       double *level) {
    struct word w = s->word[1];
    const enum end_kind kind = level_kind(b, &w);
    if (kind == END_FLOORS) {
        deck_error(b->deck, &w, "column needs a level between two floors, such as B@6.8m");
    }
    if (kind != END_LEVEL || !level_read(b, &w, place, level)) {
        return false;
    }
    if (isnan(*level)) {
        deck_error(b->deck, &w,
                   "floor %d of building %s is at this level; a column is struck "
                   "between two floors",
                   place->floor[0], builder_draft(b, place->building)->name);
        return false;
    }
    return true;
}

// Reads the options, and those of the law, if there is one. False after a report.
static bool read_options(struct builder *b, const struct statement *s, struct argument *a,
                         struct storey_choice *c) {
    struct row_set own = {rows, N_ROW, a};
    if (s->n_plain <= 2) {
        return deck_options(b->deck, s, &own, 1);
    }
    const struct storey_law *law = storey_choice_find(b->deck, &s->word[2]);
    for (int i = 0; law && i < N_ROW; i++) {
        if (storey_choice_row(law, rows[i].key) >= 0) {
            deck_error(b->deck, &s->word[2],
                       "law %s has the option -%s, which column has, too; give another law",
                       law->name, rows[i].key);
            return false;
        }
    }
    if (!law || !storey_choice_read(b->deck, s, law, &own, NULL, c)) {
        return false;
    }
    if (a[DAMPING].given) {
        deck_error(b->deck, &a[DAMPING].key, "-damping is for elastic columns; this one has a law");
        return false;
    }
    return true;
}

static void build(struct builder *b, const struct statement *s) {
    if (!builder_plain(b, s, 1, 2, statement_column.usage)) {
        return;
    }
    struct selection place;
    double level = NAN;
    const bool placed = read_place(b, s, &place, &level);
    struct argument a[N_ROW] = {0};
    struct storey_choice choice = {0};
    if (!read_options(b, s, a, &choice)) {
        return;
    }
    bool good = placed;
    const char *name = pairs_name(b, &a[NAME], &good);
    const double bending = bending_of(b, s, a);
    if (!placed || !good || bending == 0.0) {
        return;
    }
    const double n = a[NUMBER].number[0];
    struck_column_add(b,
                      &(struct struck_column){
                          .name = name,
                          .building = place.building,
                          .floor = place.floor[0],
                          .level = level,
                          .mass = n * a[MASS].number[0],
                          .bending = n * bending,
                          .n = n,
                          .shear_strength = a[SHEAR].number[0],
                          .moment_strength = a[MOMENT].number[0],
                      },
                      a[DAMPING].number[0], choice.law ? &choice : NULL, &s->word[1]);
}

const struct statement_kind statement_column = {
    .name = "column",
    .usage = "BUILDING@LEVEL [LAW ...] -name NAME -EI V|-E V -I V -mass M [-n N] [-damping RATIO] "
             "[-shear-strength V] [-moment-strength M]",
    .summary = "a column that contacts strike between two floors: it bends at that point",
    .example = "column B@6.8m -name c1 -E 30GPa -I 0.0021333m^4 -mass 600kg",
    .row = rows,
    .n_row = N_ROW,
    .build = build,
};
