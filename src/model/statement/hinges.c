// SPDX-License-Identifier: GPL-3.0-or-later
// The law of a storey, of shear and drift, becomes one of moment and rotation: forces become
// moments, and lengths become angles.
#include <string.h>

#include "deck/reader.h"
#include "model/frame_draft.h"
#include "model/storey_choice.h"

enum { STIFFNESS, LINES, BAYS, DAMAGE, N_ROW = DAMAGE + STOREY_DAMAGE_COUNT };

static const struct row rows[N_ROW] = {
    [STIFFNESS] = {"stiffness", ROW_LIST, ROW_REQUIRED, OF_MOMENT, &range_positive, NAN,
                   "initial stiffnesses of the hinges, moment over rotation"},
    [LINES] = {"lines", ROW_LIST, 0, OF_NONE, NULL, NAN,
               "column lines, from 1 at the left; all if not given"},
    [BAYS] = {"bays", ROW_LIST, 0, OF_NONE, NULL, NAN,
              "bays of beams, from 1 at the left; all if not given"},
    STOREY_CHOICES_DAMAGE(OF_NONE),
};

enum where { COLUMNS, BEAMS, BASES, N_WHERE };
static const char *const where_names[N_WHERE] = {
    [COLUMNS] = "columns", [BEAMS] = "beams", [BASES] = "bases"};

// The members whose ends get hinges.
struct hinged_members {
    enum where where;
    struct frame_draft *frame;
    struct selection selection;
    int n_floor;  // of the selection; bases: 1
    int n_across;
    bool given;  // lines or bays are given by their numbers
    bool chosen[FRAME_BAYS_MAX + 1];
    const struct section_draft *member;  // (floors, n_across)
    struct hinge_draft *hinge;           // (floors, n_across, 2)
};

static bool choose(struct builder *b, const struct statement *s, const struct argument *a,
                   struct hinged_members *q) {
    const bool beams = q->where == BEAMS;
    const struct argument *other = &a[beams ? LINES : BAYS];
    const struct argument *own = &a[beams ? BAYS : LINES];
    if (other->given) {
        return deck_error(b->deck, &other->key, "%s are chosen by -%s", where_names[q->where],
                          rows[beams ? BAYS : LINES].key);
    }
    if (q->where == BASES && !q->selection.all &&
        !(q->selection.n_floor == 1 && q->selection.floor[0] == 1)) {
        return deck_error(b->deck, &s->word[1],
                          "bases are below floor 1; write the building, or its :1");
    }
    const struct frame_draft *f = q->frame;
    q->n_floor = q->where == BASES ? 1 : q->selection.n_floor;
    q->n_across = f->n_line - (beams ? 1 : 0);
    q->member = beams ? f->beam : f->column;
    q->hinge = beams ? f->beam_hinge : f->column_hinge;
    q->given = own->given;
    return frame_draft_choose(b, own, beams ? "bay" : "line", q->n_across, q->chosen);
}

// Sets a hinge at an end that has none; false after a report.
static bool set(struct builder *b, const struct statement *s, const struct building_draft *d,
                const struct storey *storey, int member, int end, const struct hinged_members *q) {
    struct hinge_draft *hinge = &q->hinge[2 * member + end];
    if (hinge->word.text) {
        return deck_error(b->deck, &s->word[1],
                          "%s_%d_%d of building %s has a hinge at end %c already, in %s",
                          q->where == BEAMS ? "beam" : "column", member / q->n_across + 1,
                          member % q->n_across + 1, d->name, "ij"[end],
                          source_mention(b->deck, &hinge->word.place, &s->word[0].place));
    }
    *hinge = (struct hinge_draft){s->word[0], *storey, q->where == BASES};
    return true;
}

// Sets the hinges of the member; false after a report.
static bool set_ends(struct builder *b, const struct statement *s, const struct building_draft *d,
                     const struct storey *storey, int member, const struct hinged_members *q) {
    return set(b, s, d, storey, member, 0, q) &&
           (q->where == BASES || set(b, s, d, storey, member, 1, q));
}

static void place(struct builder *b, const struct statement *s, const struct argument *a,
                  struct storey_choices *c, const struct hinged_members *q) {
    const struct building_draft *d = builder_draft(b, q->selection.building);
    const char *owner = q->where == BEAMS ? "selected floors" : "selected storeys";
    const double *stiffness = builder_spread(b, &a[STIFFNESS], q->n_floor, owner);
    bool good = stiffness && storey_choices_spread(b, c, q->n_floor, owner), any = false;
    for (int i = 0; good && i < q->n_floor; i++) {
        const int level = q->where == BASES ? 1 : q->selection.floor[i];
        struct storey storey = {0};
        good = storey_choices_prepare(b, &s->word[2], c, i, stiffness[i], &storey);
        for (int k = 0; good && k < q->n_across; k++) {
            const int member = (level - 1) * q->n_across + k;
            const bool there = q->member[member].word.text;
            if (q->chosen[k] && !there && q->given) {
                deck_error(b->deck, &s->word[1],
                           "building %s has no %s_%d_%d; write the statement of its members above",
                           d->name, q->where == BEAMS ? "beam" : "column", level, k + 1);
                good = false;
            } else if (q->chosen[k] && there) {
                good = set_ends(b, s, d, &storey, member, q);
                any = true;
            }
        }
    }
    if (good && !any) {
        deck_error(b->deck, &s->word[1],
                   "building %s has no %s there; write the statement of its members above", d->name,
                   q->where == BEAMS ? "beams" : "columns");
    }
    q->frame->torn |= !good || !any;
}

static void build(struct builder *b, const struct statement *s) {
    if (!builder_plain(b, s, 3, 3, statement_hinges.usage)) {
        return;
    }
    struct hinged_members q = {0};
    struct argument a[N_ROW] = {0};
    struct row turned[STOREY_ROWS_MAX];
    const bool selected = builder_select(b, &s->word[1], WALL_REFUSED, &q.selection);
    const int where = deck_keyword(b->deck, &s->word[2], "place of hinges", where_names, N_WHERE);
    struct storey_choices c = {.law = storey_choice_find_rateless(b->deck, &s->word[3]),
                               .damage = a + DAMAGE};
    if (!selected || where < 0 || !c.law) {
        return;
    }
    storey_choice_turn(c.law->row, c.law->n_row, turned);
    struct row_set set[] = {{rows, N_ROW, a}, {turned, c.law->n_row, c.given}};
    struct building_draft *d = builder_draft(b, q.selection.building);
    if (!deck_options(b->deck, s, set, 2) || !frame_draft_has_frame(b, s, d)) {
        return;
    }
    q.where = (enum where)where;
    q.frame = d->frame;
    if (choose(b, s, a, &q)) {
        place(b, s, a, &c, &q);
    }
}

const struct statement_kind statement_hinges = {
    .name = "hinges",
    .usage = "BUILDING:FLOORS columns|beams|bases LAW ... -stiffness LIST [-lines LIST | -bays "
             "LIST] [-damage-ultimate LIST] [-damage-beta LIST]",
    .summary = "hinges at both ends of members of a frame, or at its bases, in series with them: "
               "a storey law of moment and rotation",
    .example = "hinges A:1:3 beams bilinear -yield 220kN*m -hardening 0.03 -stiffness 500MN*m",
    .row = rows,
    .n_row = N_ROW,
    .build = build,
};
