// SPDX-License-Identifier: GPL-3.0-or-later
#include <assert.h>

#include "core/arena.h"
#include "deck/reader.h"
#include "model/frame_draft.h"
#include "model/pairs.h"
#include "model/storey_choice.h"
#include "model/struck_column.h"

enum { NAME, BENDING, MODULUS, INERTIA, LINE, NUMBER, MASS, DAMPING, SHEAR, MOMENT, N_ROW };

static const struct range number_range = {.min = 1.0, .max = 1000.0, .text = ">= 1 and <= 1000"};
static const struct range line_range = {
    .min = 1.0, .max = FRAME_BAYS_MAX + 1, .text = "the number of a line"};
static const struct range damping_range = {
    .min = 0.0, .max = 1.0, .max_open = true, .text = ">= 0 and < 1"};

static const struct row rows[N_ROW] = {
    [NAME] = {"name", ROW_TEXT, ROW_REQUIRED, OF_NONE, NULL, NAN, "name of the column"},
    [BENDING] = {"EI", ROW_NUMBER, 0, OF_BENDING, &range_positive, NAN,
                 "bending stiffness of one column"},
    [MODULUS] = {"E", ROW_NUMBER, 0, OF_STRESS, &range_positive, NAN, "modulus, with -I"},
    [INERTIA] = {"I", ROW_NUMBER, 0, OF_AREA_MOMENT, &range_positive, NAN,
                 "second moment of area of one column, with -E"},
    [LINE] = {"line", ROW_INTEGER, 0, OF_NONE, &line_range, NAN,
              "outer line of the frame on which the column is, instead of -EI"},
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

// Is the column on an outer line of a frame that there is? False after a report.
static bool check_line(struct builder *b, const struct statement *s, const struct argument *a,
                       int building) {
    const struct building_draft *d = builder_draft(b, building);
    const int line = (int)a[LINE].number[0];
    if (!frame_draft_has_frame(b, s, d)) {
        return false;
    }
    if (line != 1 && line != d->frame->n_line) {
        return deck_error(
            b->deck, &a[LINE].word[0],
            "line %d is inside the frame of building %s: only lines 1 and %d can be struck", line,
            d->name, d->frame->n_line);
    }
    return true;
}

// Sets E I of all columns, or their line. False after a report.
static bool set_section(struct builder *b, const struct statement *s, const struct argument *a,
                        struct struck_column *c) {
    const bool pair = a[MODULUS].given || a[INERTIA].given;
    if (a[LINE].given) {
        const int extra = a[BENDING].given ? BENDING : a[MODULUS].given ? MODULUS : INERTIA;
        if (a[BENDING].given || pair) {
            return deck_error(b->deck, &a[extra].key,
                              "the frame has the stiffness of its columns: -line goes without -%s",
                              rows[extra].key);
        }
        c->line = (int)a[LINE].number[0];
        return check_line(b, s, a, c->building);
    }
    if (a[BENDING].given == pair) {
        return deck_error(b->deck, pair ? &a[BENDING].key : &s->word[0],
                          pair ? "give -EI, or -E and -I" : "column needs -EI, or -E and -I");
    }
    if (pair && !(a[MODULUS].given && a[INERTIA].given)) {
        return deck_error(b->deck, a[MODULUS].given ? &a[MODULUS].key : &a[INERTIA].key,
                          "-E and -I go together");
    }
    c->bending = c->n * (pair ? a[MODULUS].number[0] * a[INERTIA].number[0] : a[BENDING].number[0]);
    return true;
}

// Reads BUILDING@LEVEL, a level between two floors, or BUILDING[:FLOORS], the storeys below these
// floors, with *level NAN. False after a report.
static bool read_place(struct builder *b, const struct statement *s, struct selection *place,
                       double *level) {
    struct word w = s->word[1];
    const enum end_kind kind = level_kind(b, &w);
    *level = NAN;
    if (kind == END_FLOORS) {
        return builder_select(b, &w, WALL_REFUSED, place) &&
               builder_has_heights(b, builder_draft(b, place->building), &w, "a column");
    }
    if (kind != END_LEVEL || !level_read(b, &w, place, level)) {
        return false;
    }
    if (isnan(*level)) {
        return deck_error(b->deck, &w,
                          "floor %d of building %s is at this level; a column is struck "
                          "between two floors",
                          place->floor[0], builder_draft(b, place->building)->name);
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
    const struct storey_law *law = storey_choice_find_rateless(b->deck, &s->word[2]);
    for (int i = 0; law && i < N_ROW; i++) {
        if (row_find(law->row, law->n_row, rows[i].key) >= 0) {
            return deck_error(b->deck, &s->word[2],
                              "law %s has the option -%s, which column has, too; give another law",
                              law->name, rows[i].key);
        }
    }
    if (!law || !storey_choice_read(b->deck, s, law->row, law->n_row, &own, NULL, c)) {
        return false;
    }
    c->law = law;
    if (a[DAMPING].given) {
        return deck_error(b->deck, &a[DAMPING].key,
                          "-damping is for elastic columns; this one has a law");
    }
    return true;
}

static void add(struct builder *b, const struct statement *s, const struct argument *a,
                const struct selection *place, double level, struct struck_draft draft) {
    if (!set_section(b, s, a, &draft.column)) {
        return;
    }
    if (isnan(level)) {
        struck_column_add_storeys(b, &(struct struck_storeys){*place, draft, false});
    } else {
        struck_column_add(b, &draft, place->floor[0], level);
    }
}

static void build(struct builder *b, const struct statement *s) {
    if (!builder_plain(b, s, 1, 2, statement_column.usage)) {
        return;
    }
    struct selection place;
    double level = NAN;
    const bool placed = read_place(b, s, &place, &level);
    struct argument a[N_ROW] = {0};
    struct storey_choice *choice = arena_alloc(b->arena, 1, sizeof *choice);
    if (!choice || !read_options(b, s, a, choice)) {
        return;
    }
    assert(a[NUMBER].number && a[MASS].number && a[SHEAR].number && a[MOMENT].number);
    bool good = placed;
    const struct struck_draft draft = {
        .column =
            {
                .name = pairs_name(b, &a[NAME], &good),
                .building = placed ? place.building : 0,
                .mass = a[NUMBER].number[0] * a[MASS].number[0],
                .n = a[NUMBER].number[0],
                .shear_strength = a[SHEAR].number[0],
                .moment_strength = a[MOMENT].number[0],
            },
        .damping = a[DAMPING].number[0],
        .choice = choice->law ? choice : NULL,
        .word = s->word[1],
    };
    if (placed && good) {
        add(b, s, a, &place, level, draft);
    }
}

const struct statement_kind statement_column = {
    .name = "column",
    .usage =
        "BUILDING@LEVEL|BUILDING[:FLOORS] [LAW ...] -name NAME -EI V|-E V -I V|-line N -mass M "
        "[-n N] [-damping RATIO] [-shear-strength V] [-moment-strength M]",
    .summary = "a column that contacts strike between two floors: it bends at that point; or the "
               "columns of storeys, struck wherever a contact names a level",
    .example = "column B@6.8m -name c1 -E 30GPa -I 0.0021333m^4 -mass 600kg",
    .row = rows,
    .n_row = N_ROW,
    .build = build,
};
