// SPDX-License-Identifier: GPL-3.0-or-later
// A part with a stiffness matrix of the floor displacements from another program: a frame or a wall
// with condensed rotations. Linear and elastic.
#include "motion/matrix_file.h"

#include "deck/reader.h"
#include "model/builder.h"
#include "model/parts.h"

enum { UNIT, N_ROW };

static const struct row rows[N_ROW] = {
    [UNIT] = {"unit", ROW_TEXT, 0, OF_NONE, NULL, NAN,
              "unit of the values, such as kN/mm or kip/in; default: that of the deck"},
};

static const struct part_kind part_matrix = {
    .name = "matrix",
    .traits = PART_LINEAR,
    .respond = parts_linear_respond,
    .stored = parts_linear_stored,
};

// Reads the unit of the file; false after a report.
static bool read_unit(struct builder *b, const struct argument *a, struct matrix_request *q) {
    char deck_unit[64];
    struct deck_quote quote;
    struct dimension dimension;
    const char *end;
    q->to = q->from = unit_size(&b->deck->units, dimension_stiffness);
    if (!a->given) {
        unit_text(&b->deck->units, dimension_stiffness, deck_unit, sizeof deck_unit);
        q->unit = arena_format(b->arena, "%s", deck_unit);
        return q->unit != NULL;
    }
    q->unit = a->text[0];
    const bool whole = unit_parse(q->unit, b->deck->units.gravity, &end, &dimension, &q->from);
    const bool measures = q->from > 0.0 && isfinite(q->from);  // not so after many factors
    if (!whole || *end || !measures || !dimension_equal(dimension, dimension_stiffness)) {
        return deck_error(b->deck, &a->word[0],
                          "%s is not a unit of stiffness, such as N/m or kip/in",
                          deck_quote(&quote, &a->word[0], q->unit));
    }
    return true;
}

// Reads the file `name` and returns the stiffness on drifts; NULL after a report.
static const double *read_file(struct builder *b, const struct statement *s,
                               const struct building_draft *d, const char *name,
                               const struct argument *unit) {
    struct matrix_request q = {
        .path = name ? deck_file(b->deck, &s->word[2], name) : NULL,
        .n = d->n_floor,
        .of = arena_format(b->arena, "building %s", d->name),
    };
    double *k = NULL;
    struct error e;
    if (!q.path || !q.of || !read_unit(b, unit, &q)) {
        return NULL;
    }
    if (matrix_read(b->arena, &q, &k, &e) != STATUS_OK) {
        deck_error_of(b->deck, &s->word[2], &e);
        return NULL;
    }
    // From floor displacements to drifts: entry (i, j) becomes the sum over the floors from i and
    // from j up to the roof. The result is symmetric to the bit.
    size_t n = (size_t)d->n_floor;
    for (size_t i = n; i-- > 0;) {
        for (size_t j = n; j-- > 0;) {
            k[i * n + j] += j + 1 < n ? k[i * n + j + 1] : 0.0;
        }
    }
    for (size_t i = n; i-- > 1;) {
        for (size_t j = 0; j < n; j++) {
            k[(i - 1) * n + j] += k[i * n + j];
        }
    }
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < i; j++) {
            k[i * n + j] = k[j * n + i];
        }
    }
    return k;
}

static void build(struct builder *b, const struct statement *s) {
    if (!builder_plain(b, s, 2, 2, statement_matrix.usage)) {
        return;
    }
    struct argument a[N_ROW] = {0};
    const int i = builder_building(b, &s->word[1]);
    if (!deck_options(b->deck, s, &(struct row_set){rows, N_ROW, a}, 1) || i < 0) {
        return;
    }
    struct building_draft *d = builder_draft(b, i);
    const char *name = deck_text(b->deck, &s->word[2]);
    d->any_part = true;
    struct part part = {.kind = &part_matrix, .source = name, .n = d->n_floor};
    if (d->n_floor > 0 && (part.stiffness = read_file(b, s, d, name, &a[UNIT]))) {
        builder_add_part(b, d, &part);
    }
}

const struct statement_kind statement_matrix = {
    .name = "matrix",
    .usage = "BUILDING FILE [-unit U]",
    .summary = "stiffness matrix of a building on its floor displacements, from a file; it adds to "
               "the storeys and to other matrices",
    .example = "matrix A frame.txt -unit kN/m",
    .row = rows,
    .n_row = N_ROW,
    .build = build,
};
