// SPDX-License-Identifier: GPL-3.0-or-later
#include <assert.h>
#include <string.h>

#include "deck/reader.h"
#include "model/builder.h"

enum { MODES, ALPHA, BETA, STOREYS, TANGENT, N_ROW };

static const struct range mode_range = {.min = 1.0, .max = FLOORS_MAX, .text = ">= 1 and <= 1000"};
static const struct range ratio_range = {
    .min = 0.0, .max = 2.0, .text = ">= 0 and <= 2 (5 % is 0.05)"};

static const struct row rows[N_ROW] = {
    [MODES] = {"modes", ROW_LIST, 0, OF_NONE, &mode_range, NAN,
               "the two modes with these ratios; default: 1 2"},
    [ALPHA] = {"alpha", ROW_NUMBER, 0, OF_FREQUENCY, NULL, NAN, "mass-proportional coefficient"},
    [BETA] = {"beta", ROW_NUMBER, 0, OF_TIME, NULL, NAN, "stiffness-proportional coefficient"},
    [STOREYS] = {"storeys", ROW_TEXT, 0, OF_NONE, NULL, NAN,
                 "storeys with the stiffness-proportional part, such as 2:7; default: all but the "
                 "isolators"},
    [TANGENT] = {"tangent", ROW_FLAG, 0, OF_NONE, NULL, NAN,
                 "stiffness-proportional part on the tangent stiffness of the last step, not the "
                 "initial one"},
};

static const struct row ratio_row = {"ratio",      ROW_LIST, ROW_REQUIRED,   OF_NONE,
                                     &ratio_range, NAN,      "damping ratio"};
static const struct row dashpot_row = {"dashpot",           ROW_LIST, ROW_REQUIRED,     OF_DASHPOT,
                                       &range_non_negative, NAN,      "storey dashpots"};

static bool refuse_options(struct builder *b, const struct argument *a, const char *kind) {
    for (int i = 0; i < N_ROW; i++) {
        if (a[i].given) {
            return deck_error(b->deck, &a[i].key, "option -%s has no effect with %s", rows[i].key,
                              kind);
        }
    }
    return true;
}

static bool read_modes(struct builder *b, const struct building_draft *d, const struct argument *a,
                       int mode[2]) {
    mode[0] = 1;
    mode[1] = d->n_floor > 1 ? 2 : 1;
    if (!a->given) {
        return true;
    }
    if (a->n != 2) {
        return deck_error(b->deck, &a->key, "-modes takes two modes, not %d", a->n);
    }
    for (int i = 0; i < 2; i++) {
        mode[i] = (int)a->number[i];
        if (mode[i] != a->number[i] || mode[i] > d->n_floor) {
            return deck_error(b->deck, &a->word[i],
                              "mode %.10g is not one of 1 to %d of building %s", a->number[i],
                              d->n_floor, d->name);
        }
    }
    if (mode[0] == mode[1]) {
        return deck_error(b->deck, &a->key, "-modes takes two different modes");
    }
    return true;
}

// A ratio of 2 probably means 2 %, not twice the critical damping.
static void warn_overdamped(struct builder *b, const struct argument *ratio) {
    for (int i = 0; i < ratio->n; i++) {
        if (ratio->number[i] >= 1.0) {
            deck_warning(b->deck, &ratio->word[i],
                         "ratio %g is %g %% of the critical damping; 2 %% is 2%% or 0.02",
                         ratio->number[i], 100.0 * ratio->number[i]);
            return;
        }
    }
}

// Reports too many ratios, n from `word` on; the user may mean modes by those after the second.
static bool refuse_ratios(struct builder *b, const struct building_draft *d,
                          const struct word *word, int n) {
    if (d->n_floor == 1) {
        deck_error(b->deck, word, "rayleigh takes one ratio for a building of one storey, not %d",
                   n);
    } else {
        deck_error(b->deck, word,
                   "rayleigh takes one or two ratios, not %d; -modes I J names their modes", n);
    }
    return false;
}

static bool rayleigh(struct builder *b, const struct building_draft *d, const struct argument *a,
                     const struct statement *s, struct damping_draft *out) {
    if (a[ALPHA].given || a[BETA].given) {
        if (a[MODES].given || s->n_plain > 3) {
            return deck_error(b->deck, &s->word[0],
                              "give rayleigh either ratios, or -alpha and -beta");
        }
        double *value = arena_alloc(b->arena, 2, sizeof *value);
        if (value) {
            value[0] = a[ALPHA].given ? a[ALPHA].number[0] : 0.0;
            value[1] = a[BETA].given ? a[BETA].number[0] : 0.0;
            out->kind = DAMPING_COEFFICIENTS;
            out->n = 2;
            out->value = value;
        }
        return value != NULL;
    }
    if (s->n_plain < 4) {
        return deck_error(b->deck, &s->word[2], "rayleigh needs a ratio, or -alpha and -beta");
    }
    const int most = d->n_floor == 1 ? 1 : 2;
    struct argument ratio = {0};
    if (s->n_plain - 3 > most) {
        return refuse_ratios(b, d, &s->word[3], s->n_plain - 3);
    }
    if (!deck_values(b->deck, &ratio_row, 0.0, &s->word[3], s->n_plain - 3, &ratio) ||
        !read_modes(b, d, &a[MODES], out->mode)) {
        return false;
    }
    if (ratio.n > most) {
        return refuse_ratios(b, d, &s->word[3], ratio.n);
    }
    warn_overdamped(b, &ratio);
    out->kind = DAMPING_RATIOS;
    out->n = 2;
    out->value = builder_spread(b, &ratio, 2, "modes");
    return out->value != NULL;
}

// Reads what the stiffness-proportional part is of; false after a report.
static bool read_part(struct builder *b, int building, const struct argument *a,
                      struct damping_draft *out) {
    const bool none = out->kind == DAMPING_COEFFICIENTS && out->value[1] == 0.0;
    for (int i = STOREYS; none && i <= TANGENT; i++) {
        if (a[i].given) {
            return deck_error(b->deck, &a[i].key, "option -%s has no effect without -beta",
                              rows[i].key);
        }
    }
    if (a[TANGENT].given) {
        out->tangent = a[TANGENT].key;
    }
    if (!a[STOREYS].given) {
        return true;
    }
    struct selection *s = arena_alloc(b->arena, 1, sizeof *s);
    out->storeys = s;
    return s && builder_floors(b, a[STOREYS].word, building, s);
}

static bool list(struct builder *b, const struct building_draft *d, const struct argument *a,
                 const struct statement *s, struct damping_draft *out) {
    if (s->n_plain < 4) {
        return deck_error(b->deck, &s->word[2], "%s needs a list of values", s->word[2].text);
    }
    struct argument value = {0};
    const bool modal = out->kind == DAMPING_MODAL;
    const struct row *row = modal ? &ratio_row : &dashpot_row;
    if (!refuse_options(b, a, s->word[2].text) ||
        !deck_values(b->deck, row, 0.0, &s->word[3], s->n_plain - 3, &value)) {
        return false;
    }
    value.key = s->word[3];
    if (modal) {
        warn_overdamped(b, &value);
    }
    out->n = d->n_floor;
    out->value = builder_spread(b, &value, d->n_floor, modal ? "modes" : "storeys");
    return out->value != NULL;
}

static bool same_storeys(const struct selection *a, const struct selection *b) {
    return a && b ? a->n_floor == b->n_floor &&
                        memcmp(a->floor, b->floor, (size_t)a->n_floor * sizeof *a->floor) == 0
                  : a == b;
}

static bool is_the_same(const struct damping_draft *a, const struct damping_draft *b) {
    assert(a->value && b->value);
    return same_storeys(a->storeys, b->storeys) && !a->tangent.text == !b->tangent.text &&
           a->kind == b->kind && a->mode[0] == b->mode[0] && a->mode[1] == b->mode[1] &&
           memcmp(a->value, b->value, (size_t)a->n * sizeof *a->value) == 0;
}

static void build(struct builder *b, const struct statement *s) {
    enum { RAYLEIGH, MODAL, DASHPOT, N_KIND };
    static const char *const kinds[N_KIND] = {
        [RAYLEIGH] = "rayleigh", [MODAL] = "modal", [DASHPOT] = "dashpot"};
    if (!builder_plain(b, s, 2, 2 + 2 * FLOORS_MAX, statement_damping.usage)) {
        return;
    }
    struct argument a[N_ROW] = {0};
    int i = builder_building(b, &s->word[1]);
    if (!deck_options(b->deck, s, &(struct row_set){rows, N_ROW, a}, 1) || i < 0) {
        return;
    }
    struct building_draft *d = builder_draft(b, i);
    if (d->n_floor == 0) {
        return;
    }
    struct damping_draft new = {.word = s->word[2]};
    const int kind = deck_keyword(b->deck, &s->word[2], "damping", kinds, N_KIND);
    new.kind = kind == MODAL ? DAMPING_MODAL : DAMPING_DASHPOT;
    if (kind == RAYLEIGH ? rayleigh(b, d, a, s, &new) && read_part(b, i, a, &new)
                         : kind >= 0 && list(b, d, a, s, &new)) {
        const struct damping_draft *old = d->damping.item;
        for (int k = 0; k < d->damping.n; k++) {
            if (is_the_same(&old[k], &new)) {
                deck_warning(b->deck, &new.word,
                             "the same damping of building %s is in %s already, and both add up; "
                             "give the sum in one statement if that is meant",
                             d->name, source_mention(b->deck, &old[k].word.place, &new.word.place));
                break;
            }
        }
        struct damping_draft *room = builder_append(b, &d->damping, sizeof *room);
        if (room) {
            *room = new;
        }
    }
}

const struct statement_kind statement_damping = {
    .name = "damping",
    .usage =
        "NAME rayleigh RATIO [RATIO2] [-modes I J] [-storeys FLOORS] [-tangent] | rayleigh -alpha "
        "A0 -beta A1 [-storeys FLOORS] [-tangent] | modal LIST | dashpot LIST",
    .summary =
        "damping of one building, on its initial stiffness unless -tangent is given; several "
        "statements add up; default: no damping",
    .example = "damping A rayleigh 5% -modes 1 3",
    .row = rows,
    .n_row = N_ROW,
    .build = build,
};
