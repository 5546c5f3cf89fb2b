// SPDX-License-Identifier: GPL-3.0-or-later
// Laws as uniaxial materials. The numbers of a material come from the law itself: its forces and
// tangents at some deformations, from a history of 0. So no law says its numbers a second time.
//
// A law of straight lines becomes elastoplastic springs side by side if its loops are exactly
// theirs. Other storey laws become the nearest hysteretic material.
#include <assert.h>
#include <math.h>

#include "core/root.h"
#include "export/opensees.h"
#include "law/lists.h"
#include "law/peak_oriented.h"
#include "law/points.h"
#include "law/wen.h"

// Halvings that find a corner to its last bits, and doublings in search of it.
enum { HALVINGS = 60, DOUBLINGS = 80, CORNERS_MAX = 8 };

// Tangents that differ by less than this share belong to one line.
static const double SAME = 1e-9;

// A drift rate [L/T] at which friction has its largest value.
static const double FAST = 1e9;

static const double no_history[STOREY_HISTORY_MAX];

// The first loading of a law in one direction: corners, from which the tangent is another one.
struct backbone {
    double stiffness;  // initial
    int n;             // corners; 0: it is elastic
    double at[CORNERS_MAX], shear[CORNERS_MAX];
    double slope[CORNERS_MAX];  // beyond each corner
};

// The response at the deformation x, which is fast.
static struct storey_response material_respond(const struct storey_law *law, const double *c,
                                               const double *h, double x) {
    if (law->respond_at_rate) {
        const struct storey_rate_response r =
            law->respond_at_rate(c, h, x, copysign(FAST, x), NULL);
        return (struct storey_response){.shear = r.shear, .tangent = r.tangent};
    }
    return law->respond(c, h, x, NULL);
}

// The backbone to the side `sign`. Curves have a corner wherever their slope has halved.
static struct backbone material_backbone(const struct storey_law *law, const double *c, double sign,
                                         double smallest) {
    struct backbone b = {.stiffness = material_respond(law, c, no_history, 0.0).tangent};
    const bool straight = (law->traits & STOREY_STRAIGHT) != 0 || law->respond_at_rate;
    double slope = b.stiffness, from = 0.0;
    while (b.n < CORNERS_MAX) {
        const double size = straight ? SAME * b.stiffness : 0.5 * fabs(slope);
        struct root r = {from, smallest, 1.0};
        int k = 0;
        for (; k < DOUBLINGS; k++, r.high = from + 2.0 * (r.high - from)) {
            r.high = r.high > from ? r.high : from + smallest;
            if (fabs(material_respond(law, c, no_history, sign * r.high).tangent - slope) > size) {
                break;
            }
        }
        if (k == DOUBLINGS) {
            break;
        }
        for (int i = 0; i < HALVINGS; i++) {
            const double x = root_middle(&r);
            root_halve(&r, fabs(material_respond(law, c, no_history, sign * x).tangent - slope) <=
                               size);
        }
        const double corner = sign * r.high * (straight ? 1.0 + SAME : 1.0);
        slope = material_respond(law, c, no_history, corner).tangent;
        b.at[b.n] = from = r.high;
        b.shear[b.n] = fabs(material_respond(law, c, no_history, sign * r.high).shear);
        b.slope[b.n++] = slope;
    }
    // Between corners a curve is its chords, the first of which has the initial stiffness.
    for (int i = 0; !straight && i < b.n; i++) {
        b.at[i] = i > 0 ? b.at[i] : b.shear[i] / b.stiffness;
        b.slope[i] =
            i + 1 < b.n ? (b.shear[i + 1] - b.shear[i]) / (b.at[i + 1] - b.at[i]) : b.slope[i];
    }
    return b;
}

static double material_smallest(const struct opensees *x) {
    return 1e-9 / unit_size(&x->m->deck->units, dimension_length);
}

double material_yield(const struct opensees *x, const struct storey_law *law,
                      const double *constant, double sign) {
    const struct backbone b = material_backbone(law, constant, sign, material_smallest(x));
    return b.n > 0 ? b.shear[0] : INFINITY;
}

// Does the law reload with its initial stiffness through zero shear, as springs side by side do?
static bool material_is_kinematic(const struct storey_law *law, const double *c,
                                  const struct backbone *b) {
    double after[STOREY_HISTORY_MAX] = {0};
    const double x = b->at[0] * 1.5;
    if (law->respond_at_rate) {
        return true;
    }
    const struct storey_response top = law->respond(c, no_history, x, after);
    const struct storey_response below =
        law->respond(c, after, x - 1.01 * top.shear / b->stiffness, NULL);
    return (law->traits & STOREY_STRAIGHT) && law != &storey_flag &&
           fabs(below.tangent - b->stiffness) <= SAME * b->stiffness;
}

int material_parallel(struct opensees *x, const int *material, int n) {
    assert(n > 0);
    if (n == 1) {
        return material[0];
    }
    emit_begin(&x->to, "uniaxialMaterial");
    emit_word(&x->to, 0, "Parallel");
    emit_whole(&x->to, 1, ++x->material);
    for (int i = 0; i < n; i++) {
        emit_whole(&x->to, 2 + i, material[i]);
    }
    emit_end(&x->to);
    return x->material;
}

// Elastoplastic springs, one for each corner, beside an elastic one.
static int material_springs(struct opensees *x, const struct backbone *right,
                            const struct backbone *left) {
    int material[CORNERS_MAX + 1], n = 0;
    double slope = right->stiffness;
    for (int i = 0; i < right->n; i++) {
        emit_put(&x->to, "uniaxialMaterial", "winnn", "ElasticPP", ++x->material,
                 slope - right->slope[i], right->at[i], -left->at[i]);
        material[n++] = x->material;
        slope = right->slope[i];
    }
    if (slope != 0.0 || n == 0) {
        emit_put(&x->to, "uniaxialMaterial", "win", "Elastic", ++x->material, slope);
        material[n++] = x->material;
    }
    return material_parallel(x, material, n);
}

// The height of the loop of a flag over its shear at yield.
static double material_flag_height(const struct storey_law *law, const double *c,
                                   const struct backbone *b) {
    double after[STOREY_HISTORY_MAX];
    (void)law->respond(c, no_history, 3.0 * b->at[0], after);
    const double fall = law->respond(c, no_history, 2.0 * b->at[0], NULL).shear -
                        law->respond(c, after, 2.0 * b->at[0], NULL).shear;
    return fall / (b->shear[0] - b->slope[0] * b->at[0]);
}

// Bouc and Wen's law, with the deformation z in units of length.
static int material_bouc_wen(struct opensees *x, const double *c, double stiffness) {
    const double scale = pow(c[WEN_PER_DRIFT], c[WEN_EXPONENT]);
    emit_put(&x->to, "uniaxialMaterial", "winnnnnnnnn", "BoucWen", ++x->material,
             c[WEN_BACK] / stiffness, stiffness, c[WEN_EXPONENT],
             0.5 * (c[WEN_PLUS] + c[WEN_MINUS]) * scale, 0.5 * (c[WEN_PLUS] - c[WEN_MINUS]) * scale,
             1.0, 0.0, 0.0, 0.0);
    return x->material;
}

// A weak spring beside a hook for each direction, which catches after a slack and yields. Once a
// hook has yielded, the storey has the weak spring alone at small drifts.
static int material_hooks(struct opensees *x, const struct storey_law *law, const double *c,
                          const struct backbone *b) {
    double after[STOREY_HISTORY_MAX];
    const double yield = b->at[b->n - 1], gap = b->n > 1 ? b->at[0] : 0.0;
    (void)law->respond(c, no_history, 3.0 * yield, after);
    const double weak = law->respond(c, after, 1e-3 * yield, NULL).tangent;
    const double hook = law->respond(c, no_history, yield * (1.0 - 1e-6), NULL).tangent - weak;
    const double force = b->shear[b->n - 1] - weak * yield;
    int material[3], n = 0;
    emit_put(&x->to, "uniaxialMaterial", "win", "Elastic", ++x->material, weak);
    material[n++] = x->material;
    for (int sign = 1; sign >= -1; sign -= 2) {
        emit_put(&x->to, "uniaxialMaterial", "winnnnw", "ElasticPPGap", ++x->material, hook,
                 sign * force, sign * gap, (b->slope[b->n - 1] - weak) / hook, "damage");
        material[n++] = x->material;
    }
    return material_parallel(x, material, n);
}

// The exponent of the unloading stiffness, where the law has one that its force does not tell.
static double material_unloading(const struct storey_law *law, const double *c) {
    return law == &storey_takeda                                    ? c[PEAK_ORIENTED_ALPHA]
           : law == &storey_trilinear || law == &storey_multilinear ? c[POINTS_EXPONENT]
                                                                    : 0.0;
}

// The hysteretic material through three points of both backbones, which reloads towards the largest
// deformation.
static int material_hysteretic(struct opensees *x, const struct storey_law *law, const double *c,
                               const struct backbone *right, const struct backbone *left) {
    const struct backbone *side[] = {right, left};
    int place = 0;
    emit_begin(&x->to, "uniaxialMaterial");
    emit_word(&x->to, place++, "Hysteretic");
    emit_whole(&x->to, place++, ++x->material);
    for (int k = 0; k < 2; k++) {
        const struct backbone *b = side[k];
        const double last = b->n > 1 ? b->at[1] : 4.0 * b->at[0], sign = k == 0 ? 1.0 : -1.0;
        const double at[] = {b->at[0], last, b->n > 2 ? b->at[2] : last + 10.0 * b->at[0]};
        for (int i = 0; i < 3; i++) {
            const double shear = material_respond(law, c, no_history, sign * at[i]).shear;
            emit_number(&x->to, place++, shear);
            emit_number(&x->to, place++, sign * at[i]);
        }
    }
    const double rules[] = {1.0, 1.0, 0.0, 0.0, material_unloading(law, c)};
    for (int i = 0; i < 5; i++) {
        emit_number(&x->to, place++, rules[i]);
    }
    emit_end(&x->to);
    return x->material;
}

// How Hysteretic differs from the laws that it stands for.
struct material_stand_in {
    const struct storey_law *law;
    const char *note;
};
static const struct material_stand_in stand_in[] = {
    {&storey_clough, "Hysteretic, whose partial unloading differs"},
    {&storey_takeda, "Hysteretic, which reloads towards the largest drift"},
    {&storey_trilinear, "Hysteretic through its corners, without pinching"},
    {&storey_multilinear, "Hysteretic through three corners"},
    {&storey_imk, "Hysteretic, without the deterioration in cycles"},
};

static int material_nearest(struct opensees *x, const struct storey_law *law, const double *c,
                            const struct backbone *right, const struct backbone *left,
                            const char **note) {
    if (law == &storey_bouc_wen) {
        *note = "BoucWen, which takes an implicit step and has no pinching and no degradation";
        return material_bouc_wen(x, c, right->stiffness);
    }
    if (law == &storey_flag) {
        *note = "SelfCentering, whose loops close in another way";
        emit_put(&x->to, "uniaxialMaterial", "winnnn", "SelfCentering", ++x->material,
                 right->stiffness, right->slope[0], right->shear[0],
                 material_flag_height(law, c, right));
        return x->material;
    }
    if (law == &storey_slip) {
        return material_hooks(x, law, c, right);
    }
    for (size_t i = 0; i < sizeof stand_in / sizeof stand_in[0]; i++) {
        if (law == stand_in[i].law) {
            *note = stand_in[i].note;
            return material_hysteretic(x, law, c, right, left);
        }
    }
    *note = "elastoplastic springs side by side, whose backbone is chords of the curve";
    return material_springs(x, right, left);
}

// The velocity matters if a slow motion has another force.
static bool material_has_rate(const struct storey_law *law, const double *c,
                              const struct backbone *b) {
    const double x = b->n > 0 ? 2.0 * b->at[0] : 0.0;
    return law->respond_at_rate &&
           fabs(law->respond(c, no_history, x, NULL).shear -
                material_respond(law, c, no_history, x).shear) > SAME * b->shear[0];
}

int material_storey(struct opensees *x, const struct storey_law *law, const double *constant,
                    const char *what, const void *owner) {
    const double smallest = material_smallest(x);
    const struct backbone right = material_backbone(law, constant, 1.0, smallest);
    const struct backbone left = material_backbone(law, constant, -1.0, smallest);
    const char *note = NULL;
    int material;
    if (right.n == 0 || (right.n == left.n && material_is_kinematic(law, constant, &right))) {
        const bool plain = right.n == 1 && right.shear[0] == left.shear[0] && right.slope[0] >= 0.0;
        if (material_has_rate(law, constant, &right)) {
            note = "friction of fast motion, at any velocity";
        }
        if (plain) {
            emit_put(&x->to, "uniaxialMaterial", "winnn", "Steel01", ++x->material, right.shear[0],
                     right.stiffness, right.slope[0] / right.stiffness);
        }
        material = plain ? x->material : material_springs(x, &right, &left);
    } else {
        material = material_nearest(x, law, constant, &right, &left, &note);
    }
    if (note && (x->told[0] != law || x->told[1] != owner)) {
        opensees_note(x, "%s: the law %s is %s", what, law->name, note);
        x->told[0] = law;
        x->told[1] = owner;
    }
    return material;
}
