// SPDX-License-Identifier: GPL-3.0-or-later
// The statements columns and beams.
#include "deck/reader.h"
#include "model/frame_draft.h"

// The first row is the inertia, and the last one chooses lines or bays.
enum { INERTIA, AREA, N_COLUMN_ROW = AREA + 2, N_BEAM_ROW = 2 };

#define INERTIA_ROW                                                                                \
    { "I", ROW_LIST, ROW_REQUIRED, OF_AREA_MOMENT, &range_positive, NAN, "second moments of area" }
static const struct row column_rows[N_COLUMN_ROW] = {
    INERTIA_ROW,
    [AREA] = {"A", ROW_LIST, 0, OF_AREA, &range_positive, NAN,
              "areas of the sections, for axial deformation"},
    {"lines", ROW_LIST, 0, OF_NONE, NULL, NAN,
     "column lines, from 1 at the left; all if not given"},
};
static const struct row beam_rows[N_BEAM_ROW] = {
    INERTIA_ROW,
    {"bays", ROW_LIST, 0, OF_NONE, NULL, NAN, "bays, from 1 at the left; all if not given"},
};

// Members that a statement gives: on the selected floors, and the chosen lines or bays.
struct members {
    bool beams;
    struct building_draft *building;
    struct selection selection;
    int n_across;  // lines or bays of the frame
    bool chosen[FRAME_BAYS_MAX + 1];
    struct section_draft *member;  // (n_floor, n_across)
    const double *inertia, *area;  // (selection.n_floor); area NULL: 0
};

// Reads the words and options, but for the area. False after a report.
static bool read(struct builder *b, const struct statement *s, const struct statement_kind *kind,
                 struct argument *a, struct members *q) {
    const bool selected = builder_select(b, &s->word[1], WALL_REFUSED, &q->selection);
    const bool good = deck_options(b->deck, s, &(struct row_set){kind->row, kind->n_row, a}, 1);
    if (q->selection.building < 0) {
        return false;
    }
    q->building = builder_draft(b, q->selection.building);
    if (!frame_draft_has_frame(b, s, q->building)) {
        return false;
    }
    struct frame_draft *f = q->building->frame;
    if (!selected || !good) {
        f->torn = true;
        return false;
    }
    q->n_across = f->n_line - (q->beams ? 1 : 0);
    q->member = q->beams ? f->beam : f->column;
    f->torn |= !frame_draft_choose(b, &a[kind->n_row - 1], q->beams ? "bay" : "line", q->n_across,
                                   q->chosen);
    q->inertia = builder_spread(b, &a[INERTIA], q->selection.n_floor,
                                q->beams ? "selected floors" : "selected storeys");
    f->torn |= !q->inertia;
    return !f->torn;
}

// Puts the members in their places, and reports the first that is there already.
static void place(struct builder *b, const struct statement *s, const struct members *q) {
    for (int i = 0; i < q->selection.n_floor; i++) {
        const int level = q->selection.floor[i];
        for (int k = 0; k < q->n_across; k++) {
            struct section_draft *m = &q->member[(level - 1) * q->n_across + k];
            if (q->chosen[k] && m->word.text) {
                deck_error(b->deck, &s->word[1], "%s_%d_%d of building %s is given already, in %s",
                           q->beams ? "beam" : "column", level, k + 1, q->building->name,
                           source_mention(b->deck, &m->word.place, &s->word[0].place));
                return;
            }
            if (q->chosen[k]) {
                *m = (struct section_draft){s->word[0], q->inertia[i], q->area ? q->area[i] : 0.0};
            }
        }
    }
}

// Reports -A of a frame whose columns do not stretch, and warns of columns without -A.
static bool check_area(struct builder *b, const struct statement *s, const struct building_draft *d,
                       const struct argument *area) {
    if (area->given && d->frame->inextensible) {
        d->frame->torn = true;
        return deck_error(b->deck, &area->key,
                          "option -A has no effect, as frame %s has -columns-inextensible",
                          d->name);
    }
    if (!area->given && !d->frame->inextensible) {
        deck_warning(b->deck, &s->word[0],
                     "columns without -A do not change their lengths; to say so, give frame %s "
                     "-columns-inextensible",
                     d->name);
    }
    return true;
}

static void build_columns(struct builder *b, const struct statement *s) {
    struct members q = {.beams = false};
    struct argument a[N_COLUMN_ROW] = {0};
    if (!builder_plain(b, s, 1, 1, statement_columns.usage) ||
        !read(b, s, &statement_columns, a, &q) || !check_area(b, s, q.building, &a[AREA])) {
        return;
    }
    if (a[AREA].given) {
        q.area = builder_spread(b, &a[AREA], q.selection.n_floor, "selected storeys");
        q.building->frame->torn |= !q.area;
    }
    place(b, s, &q);
}

static void build_beams(struct builder *b, const struct statement *s) {
    struct members q = {.beams = true};
    struct argument a[N_BEAM_ROW] = {0};
    if (builder_plain(b, s, 1, 1, statement_beams.usage) && read(b, s, &statement_beams, a, &q)) {
        place(b, s, &q);
    }
}

const struct statement_kind statement_columns = {
    .name = "columns",
    .usage = "BUILDING:FLOORS -I LIST [-A LIST] [-lines LIST]",
    .summary = "columns of a frame, of the storeys below these floors",
    .example = "columns A:1:3 -I 3230in^4 -A 72.3in^2 -lines 1 3",
    .row = column_rows,
    .n_row = N_COLUMN_ROW,
    .build = build_columns,
};

const struct statement_kind statement_beams = {
    .name = "beams",
    .usage = "BUILDING:FLOORS -I LIST [-bays LIST]",
    .summary = "beams of a frame on these floors",
    .example = "beams A:1:2 -I 5120in^4",
    .row = beam_rows,
    .n_row = N_BEAM_ROW,
    .build = build_beams,
};
