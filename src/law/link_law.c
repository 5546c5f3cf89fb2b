// SPDX-License-Identifier: GPL-3.0-or-later
// A storey law as the law of a link, with slack s in series. At the lengthening x the law is at the
// deformation q, with V(q) from the committed history:
//     q = x - s,    if V(x - s) > 0: the link is tight in tension,
//     q = x + s',   if V(x + s') < 0: it is tight in compression,
//     otherwise the link is loose: it has no force, and q is where V = 0.
// With tension only s' is infinite, with compression only s is. A link that becomes loose rests on
// the side of V = 0 from which it comes. It has not crossed the axis, where laws such as clough
// change their path.
// A contact law counts the shortening d = -x and the compression.
#include "law/link_law.h"

#include <assert.h>
#include <string.h>

#include "core/root.h"
#include "law/bilateral.h"
#include "law/lists.h"
#include "law/maxwell.h"
#include "law/yield.h"

enum { LAW = LINK_CONSTANTS, SLACK, SLACK_SHORT, OWN };  // s and s'
enum { DEFORMATION, LOOSE, HISTORY };                    // q; 1: the link is loose

// Halvings that find an end of a line to the last bits.
enum { HALVINGS = 60 };

// Tangents belong to one line if they differ by less than this share of the initial stiffness.
static const double SAME = 1e-7;

const struct row link_law_rows[LINK_ROWS] = {
    [LINK_ROW_STIFFNESS] = {"stiffness", ROW_LIST, ROW_REQUIRED, OF_STIFFNESS, &range_positive, NAN,
                            "initial stiffness of the link"},
    [LINK_ROW_SLACK] = {"slack", ROW_LIST, 0, OF_LENGTH, &range_non_negative, 0.0,
                        "change of length before the link carries a force"},
    [LINK_ROW_TENSION_ONLY] = {"tension-only", ROW_FLAG, 0, OF_NONE, NULL, NAN,
                               "the link carries no compression"},
    [LINK_ROW_COMPRESSION_ONLY] = {"compression-only", ROW_FLAG, 0, OF_NONE, NULL, NAN,
                                   "the link carries no tension"},
};

enum { SLIP, FRICTION_ROWS };
static const struct row friction_rows[FRICTION_ROWS] = {
    [SLIP] = {"slip", ROW_LIST, ROW_REQUIRED, OF_FORCE, &range_positive, NAN,
              "force at which the link slips"},
};

enum { VISCOUS, MAXWELL, FRICTION, HOOK, CABLE, GAP, N_OWN };

struct link_law link_law_of_storey(const struct storey_law *law) {
    assert(!law->respond_at_rate);
    return (struct link_law){
        .name = law->name, .storey = law, .row = law->row, .n_row = law->n_row};
}

#define STOREY_LAW(descriptor) +1
#define STOREY_WITHOUT_RATE
const int n_link_law = N_OWN
#include "law/storey_list.inc"
    ;
#undef STOREY_WITHOUT_RATE
#undef STOREY_LAW
struct link_law link_law_at(int i) {
    switch (i) {
        case VISCOUS:
            return (struct link_law){.name = "viscous",
                                     .law = &bilateral_law,
                                     .row = bilateral_rows,
                                     .n_row = BILATERAL_ROWS};
        case MAXWELL:
            return (struct link_law){
                .name = "maxwell", .law = &maxwell_law, .row = maxwell_rows, .n_row = MAXWELL_ROWS};
        case FRICTION:
            return (struct link_law){.name = "friction",
                                     .storey = &storey_bilinear,
                                     .row = friction_rows,
                                     .n_row = FRICTION_ROWS,
                                     .what = "bilinear with -yield SLIP and -hardening 0"};
        case HOOK:
        case CABLE:
            return (struct link_law){.name = i == HOOK ? "hook" : "cable",
                                     .storey = &storey_elastic,
                                     .what = "elastic with -tension-only",
                                     .only = LINK_ROW_TENSION_ONLY};
        case GAP:
            return (struct link_law){.name = "gap",
                                     .storey = &storey_bilinear,
                                     .row = storey_bilinear.row,
                                     .n_row = storey_bilinear.n_row,
                                     .what = "bilinear with -compression-only: a gap spring whose "
                                             "-slack is the gap, and grows by what impacts crush",
                                     .only = LINK_ROW_COMPRESSION_ONLY};
        default:
            break;
    }
    return link_law_of_storey(storey_laws[i - N_OWN]);
}

bool link_law_has(const struct link_law *law, int row) {
    return (law->only == 0 || row < LINK_ROW_TENSION_ONLY) &&
           row_find(law->row, law->n_row, link_law_rows[row].key) < 0;
}

static const struct storey_law *link_law_of(const double *constant) {
    return storey_laws[(int)constant[LAW]];
}

struct link_storey link_law_storey(const double *constant, const double *history) {
    return (struct link_storey){.law = link_law_of(constant),
                                .constant = constant + OWN,
                                .history = history + HISTORY,
                                .deformation = history[DEFORMATION]};
}

bool link_law_is_slack(const double *c) {
    return c[SLACK] + c[SLACK_SHORT] > 0.0;
}

static struct storey_response link_law_respond(const double *c, const double *h, double q) {
    return link_law_of(c)->respond(c + OWN, h + HISTORY, q, NULL);
}

// The response at the lengthening x, and q. NAN: the link is loose.
static struct storey_response link_law_extend(const double *c, const double *h, double x,
                                              double *q) {
    struct storey_response r = {0};
    *q = x - c[SLACK];
    if (isfinite(*q)) {
        r = link_law_respond(c, h, *q);
        if (r.shear > 0.0 || !link_law_is_slack(c)) {
            return r;
        }
    }
    *q = x + c[SLACK_SHORT];
    if (isfinite(*q)) {
        r = link_law_respond(c, h, *q);
        if (r.shear < 0.0) {
            return r;
        }
    }
    *q = NAN;
    return (struct storey_response){0};
}

static struct contact_response link_law_force(const double *c, const double *h, double d,
                                              double v) {
    (void)v;
    double q;
    const struct storey_response r = link_law_extend(c, h, -d, &q);
    return (struct contact_response){.force = 0.0 - r.shear, .dfdd = r.tangent};
}

// Where the force of the law comes to 0 on the way of a link that has become loose at x.
static double link_law_rest(const double *c, const double *h, double x) {
    const double force = link_law_respond(c, h, h[DEFORMATION]).shear;
    struct root way = {h[DEFORMATION], force > 0.0 ? x - c[SLACK] : x + c[SLACK_SHORT], 1.0};
    for (int i = 0; i < HALVINGS && force != 0.0; i++) {
        root_halve(&way, link_law_respond(c, h, root_middle(&way)).shear * force > 0.0);
    }
    return way.low;
}

static void link_law_commit(const double *c, double *h, double d, double v) {
    (void)v;
    double q;
    (void)link_law_extend(c, h, -d, &q);
    const bool loose = isnan(q);
    if (loose && h[LOOSE] != 0.0) {
        return;
    }
    h[DEFORMATION] = loose ? link_law_rest(c, h, -d) : q;
    h[LOOSE] = loose;
    (void)link_law_of(c)->respond(c + OWN, h + HISTORY, h[DEFORMATION], h + HISTORY);
}

// Are the lengthenings x and y on different lines? A law that is curved has the ends of its slack
// only.
static bool link_law_parts(const double *c, const double *h, double x, double y) {
    double at_x, at_y;
    const double tangent = link_law_extend(c, h, x, &at_x).tangent;
    const double change = link_law_extend(c, h, y, &at_y).tangent - tangent;
    const bool straight =
        link_law_of(c)->n_history == 0 || link_law_of(c)->traits & STOREY_STRAIGHT;
    return straight ? fabs(change) > SAME * c[LINK_STIFFNESS] : isnan(at_x) != isnan(at_y);
}

// A kink beyond the way is looked for as far as the way is long.
static double link_law_kink(const double *c, const double *h, const struct contact_way *way) {
    const double start = -way->d0, end = -way->d, ahead = end + (end - start);
    const bool passed = link_law_parts(c, h, start, end);
    if (!passed && !link_law_parts(c, h, start, ahead)) {
        return fabs(end - start);
    }
    struct root r = {start, passed ? end : ahead, 1.0};
    for (int i = 0; i < HALVINGS; i++) {
        root_halve(&r, !link_law_parts(c, h, start, root_middle(&r)));
    }
    return passed ? -fabs(end - r.high) : fabs(end - r.high);
}

static double link_law_stored(const double *c, const double *h, double d) {
    (void)d;
    return link_law_of(c)->stored(c + OWN, h + HISTORY, h[DEFORMATION]);
}

struct contact_law link_law_make(const struct link_law *from) {
    assert(from->storey);
    return (struct contact_law){
        .name = from->name,
        .summary = from->storey->summary,
        .formula = from->storey->formula,
        .source = from->storey->source,
        .n_constant = OWN + from->storey->n_constant,
        .n_history = HISTORY + from->storey->n_history,
        .traits = CONTACT_MAY_PULL | CONTACT_TURNS,
        .force = link_law_force,
        .kink = link_law_kink,
        .commit = link_law_commit,
        .stored = link_law_stored,
    };
}

// The values of the rows of the bilinear law for friction.
static void link_law_slip(double slip, double *value) {
    for (int r = 0; r < storey_bilinear.n_row; r++) {
        const struct row *row = &storey_bilinear.row[r];
        value[r] = strcmp(row->key, "yield") == 0       ? slip
                   : strcmp(row->key, "hardening") == 0 ? 0.0
                                                        : row->fallback;
    }
}

// Does the link act in that direction only?
static bool link_law_is(const struct link_law *from, enum link_law_row row, const double *value) {
    return from->only == row || !isnan(value[row]);
}

int link_law_prepare(const struct link_law *from, const double *value, double *constant,
                     struct error *e) {
    const double stiffness = value[LINK_ROW_STIFFNESS];
    const double slack = isnan(value[LINK_ROW_SLACK]) ? 0.0 : value[LINK_ROW_SLACK];
    const double *own = value + LINK_ROWS;
    double bilinear[STOREY_ROWS_MAX];
    int law = 0;
    while (storey_laws[law] != from->storey) {
        law++;
        assert(law < n_storey_law);
    }
    if (!isnan(value[LINK_ROW_TENSION_ONLY]) && !isnan(value[LINK_ROW_COMPRESSION_ONLY])) {
        return error_set(e, STATUS_INPUT, "-tension-only and -compression-only cannot be combined");
    }
    if (from->row == friction_rows) {
        link_law_slip(own[SLIP], bilinear);
        own = bilinear;
    }
    constant[LINK_STIFFNESS] = stiffness;
    constant[LINK_DASHPOT] = 0.0;
    constant[LINK_EXPONENT] = 1.0;
    constant[LAW] = law;
    constant[SLACK] = link_law_is(from, LINK_ROW_COMPRESSION_ONLY, value) ? INFINITY : slack;
    constant[SLACK_SHORT] = link_law_is(from, LINK_ROW_TENSION_ONLY, value) ? INFINITY : slack;
    return storey_law_prepare(from->storey, own, stiffness, constant + OWN, e);
}
