// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/frame_draft.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "deck/reader.h"
#include "model/frame.h"
#include "model/hinges.h"
#include "model/struck_column.h"

bool frame_draft_has_frame(struct builder *b, const struct statement *s,
                           const struct building_draft *d) {
    if (!d->frame && !d->any_frame) {
        deck_error(b->deck, &s->word[1],
                   "building %s has no frame; write one above: frame %s -bays LIST -modulus E",
                   d->name, d->name);
    }
    return d->frame != NULL;
}

bool frame_draft_choose(struct builder *b, const struct argument *a, const char *what, int n,
                        bool *chosen) {
    memset(chosen, a->given ? 0 : 1, (size_t)n * sizeof *chosen);
    for (int i = 0; a->given && i < a->n; i++) {
        const double x = a->number[i];
        if (!(x >= 1.0 && x <= n && x == floor(x))) {
            return deck_error(b->deck, &a->word[i], "%s %.10g is not one of 1 to %d", what, x, n);
        }
        if (chosen[(int)x - 1]) {
            return deck_error(b->deck, &a->word[i], "%s %.10g is selected twice", what, x);
        }
        chosen[(int)x - 1] = true;
    }
    return true;
}

static void set_base(struct plane_frame *f, int line, const struct base_draft *own,
                     const struct base_draft *all) {
    const struct base_draft *base = own && own->word.text ? own : all;
    const double rotation = base ? base->rotation : (double)INFINITY;
    struct frame_joint *j = &f->joint[line];
    j->turns = isfinite(rotation);
    j->spring = j->turns ? rotation : 0.0;
}

// A frame without members yet; NULL: no memory.
static struct plane_frame *begin(struct builder *b, const struct building_draft *d, int n_line,
                                 int n_member) {
    struct plane_frame *f = arena_alloc(b->arena, 1, sizeof *f);
    if (f) {
        *f = (struct plane_frame){.n_floor = d->n_floor, .n_line = n_line};
        f->n_joint = (d->n_floor + 1) * n_line;
        f->joint = arena_alloc(b->arena, (size_t)f->n_joint, sizeof *f->joint);
        f->member = arena_alloc(b->arena, (size_t)n_member, sizeof *f->member);
    }
    return f && f->joint && f->member ? f : NULL;
}

// Condenses the frame and adds it to the parts of the building. `hinge` (n_hinge) are its hinges.
static void end(struct builder *b, struct building_draft *d, struct plane_frame *f,
                const struct part_kind *kind, const struct hinge *hinge, const struct word *word,
                const char *source) {
    struct error e;
    int status = frame_condense(f, b->arena, &e);
    if (status == STATUS_OK && f->n_hinge > 0) {
        status = hinges_create(f, hinge, b->arena, &e);
    }
    if (status == STATUS_INPUT) {
        deck_error(b->deck, word, "%s of building %s: %s", kind->name, d->name, e.message);
    } else if (status != STATUS_OK) {
        deck_error_of(b->deck, word, &e);
    } else if (source) {
        struct part part = {
            .kind = kind, .source = source, .n = d->n_floor, .stiffness = f->stiffness, .data = f};
        if (f->n_hinge > 0) {
            part.kind = hinges_kind(f->hinges);
            part.stiffness = NULL;
            part.n_history = hinges_n_history(f->hinges);
            part.n_scratch = hinges_n_scratch(f->hinges);
        }
        builder_add_part(b, d, &part);
    }
}

// Takes the hinges at the ends of the member that was added last.
static void take_hinges(struct plane_frame *f, struct hinge *hinge,
                        const struct hinge_draft *draft) {
    for (int end = 0; end < 2; end++) {
        if (draft[end].word.text) {
            f->member[f->n_member - 1].hinge[end] = f->n_hinge;
            hinge[f->n_hinge++] =
                (struct hinge){.member = f->n_member - 1, .end = end, .storey = draft[end].storey};
        }
    }
}

// A pinned base has no moment, so a column has no hinge there. Reports one that `hinges A bases`
// gave.
static void drop_pinned(struct builder *b, const struct building_draft *d,
                        const struct plane_frame *f, int line) {
    struct hinge_draft *hinge = &d->frame->column_hinge[(ptrdiff_t)2 * line];
    if (!hinge->word.text || !f->joint[line].turns || f->joint[line].spring > 0.0) {
        return;
    }
    if (hinge->base) {
        deck_error(b->deck, &hinge->word,
                   "the base of line %d of building %s is pinned: it has no "
                   "hinge",
                   line + 1, d->name);
    }
    *hinge = (struct hinge_draft){0};
}

// Has the storey a column? Reports one that has none.
static bool has_columns(struct builder *b, const struct building_draft *d, int storey) {
    const struct frame_draft *f = d->frame;
    for (int line = 0; line < f->n_line; line++) {
        if (f->column[(storey - 1) * f->n_line + line].word.text) {
            return true;
        }
    }
    return deck_error(b->deck, &f->word, "the frame of building %s has no columns in storey %d",
                      d->name, storey);
}

// Warns about the first bay between two columns without a beam.
static void warn_open(struct builder *b, const struct building_draft *d) {
    const struct frame_draft *f = d->frame;
    for (int i = 0; i < d->n_floor; i++) {
        for (int bay = 0; bay < f->n_line - 1; bay++) {
            const struct section_draft *left = &f->column[i * f->n_line + bay];
            if (left[0].word.text && left[1].word.text &&
                !f->beam[i * (f->n_line - 1) + bay].word.text) {
                deck_warning(b->deck, &f->word,
                             "the frame of building %s has no beam on floor %d in bay %d", d->name,
                             i + 1, bay + 1);
                return;
            }
        }
    }
}

// Takes the columns that are struck on lines of the frame of building `index`. False after a
// report.
static bool take_points(struct builder *b, int index, struct plane_frame *f) {
    f->point = arena_alloc(b->arena, (size_t)struck_column_points(b, index), sizeof *f->point);
    for (int i = 0; f->point && i < b->columns.n; i++) {
        struct struck_draft *d = struck_column_draft(b, i);
        struct struck_column *c = &d->column;
        if (c->building != index || c->line == 0) {
            continue;
        }
        int k = 0;
        while (k < f->n_member &&
               !(f->member[k].kind == FRAME_COLUMN && f->member[k].level == c->floor &&
                 f->member[k].number == c->line)) {
            k++;
        }
        if (k == f->n_member || f->n_hinge > 0) {
            const char *name = builder_draft(b, index)->name;
            return deck_error(
                b->deck, &d->word,
                f->n_hinge > 0 ? "the frame of building %s has hinges: -line needs an elastic frame"
                               : "the frame of building %s has no column in storey %d on line %d",
                name, c->floor, c->line);
        }
        c->point = f->n_point;
        f->point[f->n_point++] = (struct frame_point){k, c->below / c->height};
    }
    return f->point != NULL;
}

static void add_frame(struct builder *b, int index) {
    struct building_draft *d = builder_draft(b, index);
    const struct frame_draft *f = d->frame;
    const int n = f->n_line, n_bay = n - 1;
    struct plane_frame *to = begin(b, d, n, d->n_floor * (n + n_bay));
    struct hinge *hinge = arena_alloc(b->arena, 4 * (size_t)d->n_floor * (size_t)n, sizeof *hinge);
    bool stands = to && hinge;
    for (int i = 1; stands && i <= d->n_floor; i++) {
        stands = has_columns(b, d, i);
    }
    if (!stands) {
        return;
    }
    int n_column = 0;
    for (int k = 0; k < n; k++) {
        if (f->column[k].word.text) {
            set_base(to, k, &f->base[k], d->base);
            drop_pinned(b, d, to, k);
        } else if (f->base[k].word.text) {
            deck_error(b->deck, &f->base[k].word,
                       "the frame of building %s has no column in storey 1 on line %d", d->name,
                       k + 1);
        }
    }
    for (int level = 1; level <= d->n_floor; level++) {
        for (int k = 0; k < n; k++) {
            const struct section_draft *m = &f->column[(level - 1) * n + k];
            if (m->word.text) {
                to->member[to->n_member++] =
                    frame_member(FRAME_COLUMN, level, k + 1, d->height[level - 1],
                                 f->modulus * m->inertia, INFINITY, f->modulus * m->area);
                take_hinges(to, hinge, &f->column_hinge[(ptrdiff_t)2 * ((level - 1) * n + k)]);
                n_column++;
            }
        }
        for (int k = 0; k < n_bay; k++) {
            const struct section_draft *m = &f->beam[(level - 1) * n_bay + k];
            if (m->word.text) {
                to->member[to->n_member++] = frame_member(FRAME_BEAM, level, k + 1, f->bay[k],
                                                          f->modulus * m->inertia, INFINITY, 0.0);
                take_hinges(to, hinge, &f->beam_hinge[(ptrdiff_t)2 * ((level - 1) * n_bay + k)]);
            }
        }
    }
    warn_open(b, d);
    if (!take_points(b, index, to)) {
        return;
    }
    char hinges[32] = "";
    if (to->n_hinge > 0) {
        snprintf(hinges, sizeof hinges, ", %d hinge%s", to->n_hinge, to->n_hinge > 1 ? "s" : "");
    }
    end(b, d, to, &frame_part, hinge, &f->word,
        arena_format(b->arena, "%d columns and %d beams%s", n_column, to->n_member - n_column,
                     hinges));
}

static void add_wall(struct builder *b, struct building_draft *d, const struct wall_draft *w) {
    struct plane_frame *to = begin(b, d, 1, w->n_floor);
    if (!to) {
        return;
    }
    int number = 1;
    for (int i = 0; i < d->parts.n; i++) {
        number += ((const struct part *)d->parts.item)[i].kind == &frame_wall;
    }
    for (int i = 0; i < w->n_floor; i++) {
        to->member[to->n_member++] = frame_member(FRAME_WALL, i + 1, number, d->height[i], w->ei[i],
                                                  w->ga ? w->ga[i] : INFINITY, 0.0);
    }
    set_base(to, 0, NULL, d->base);
    end(b, d, to, &frame_wall, NULL, &w->word,
        arena_format(b->arena, "%d storey%s", w->n_floor, w->n_floor == 1 ? "" : "s"));
}

// Reports walls that end below the roof of a building that nothing else holds.
static void check_top(struct builder *b, const struct building_draft *d) {
    const struct wall_draft *wall = d->walls.item;
    int top = 0;
    for (int i = 0; i < d->walls.n; i++) {
        top = wall[i].n_floor > top ? wall[i].n_floor : top;
    }
    if (d->walls.n > 0 && !d->frame && !d->any_stiffness && d->parts.n == 0 && top < d->n_floor &&
        d->stiffness[top] == 0.0) {
        deck_error(b->deck, &wall[0].word, "nothing resists in storey %d of building %s", top + 1,
                   d->name);
    }
}

void frame_draft_finish(struct builder *b) {
    for (int i = 0; !b->deck->torn && i < b->buildings.n; i++) {
        struct building_draft *d = builder_draft(b, i);
        if (d->base && !d->any_frame && !d->any_wall) {
            deck_error(b->deck, &d->base->word,
                       "building %s has no frame and no wall that stands on a base", d->name);
        }
        check_top(b, d);
        if (d->frame && !d->frame->torn) {
            add_frame(b, i);
        }
        for (int k = 0; k < d->walls.n; k++) {
            add_wall(b, d, (const struct wall_draft *)d->walls.item + k);
        }
    }
}
