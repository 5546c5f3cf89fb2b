// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/edp.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/text.h"

#define BUILDING(name, item, divisor, doc)                                                         \
    { name, EDP_OF_BUILDING, "buildings", item, divisor, EDP_LARGEST, doc }
#define WITHIN(owner, name, item, doc)                                                             \
    { name, EDP_OF_##owner, NULL, item, NULL, EDP_LARGEST, doc }
const struct edp_quantity edp_quantities[] = {
    BUILDING("drift", "drift", NULL, "drift of a storey"),
    BUILDING("drift-ratio", "drift", "height", "drift of a storey over its height"),
    BUILDING("residual-drift", "residual_drift", NULL,
             "drift of a storey that remains after the shaking"),
    BUILDING("residual-drift-ratio", "residual_drift", "height", "residual drift over height"),
    BUILDING("ductility", "ductility", NULL, "drift of a storey over its drift at yield"),
    BUILDING("storey-hysteretic", "hysteretic", NULL, "energy dissipated by the law of a storey"),
    BUILDING("deterioration", "deterioration", NULL, "energy consumed over least capacity"),
    BUILDING("damage", "damage", NULL, "damage index of Park and Ang of a storey"),
    BUILDING("displacement", "displacement", NULL,
             "displacement of a floor relative to the ground"),
    BUILDING("velocity", "velocity", NULL, "velocity of a floor relative to the ground"),
    BUILDING("acceleration", "acceleration", NULL, "total acceleration of a floor"),
    BUILDING("storey-shear", "storey_shear", NULL, "restoring force of a storey"),
    WITHIN(MEMBER, "member-moment", "moment",
           "moment on an end of a column, a beam or a wall: member-moment:A, "
           "member-moment:A:beam_1_2"),
    WITHIN(MEMBER, "member-shear", "shear", "shear of such a member"),
    WITHIN(MEMBER, "member-axial", "axial", "normal force of a column"),
    WITHIN(MEMBER, "plastic-rotation", "plastic_rotation",
           "plastic rotation of the hinges of a member"),
    WITHIN(MEMBER, "hinge-ductility", "ductility",
           "rotation of a hinge over its rotation at yield"),
    WITHIN(MEMBER, "hinge-hysteretic", "hysteretic", "energy dissipated by the hinges of a member"),
    WITHIN(MEMBER, "hinge-deterioration", "deterioration",
           "energy that a hinge consumed over its least capacity"),
    WITHIN(MEMBER, "hinge-damage", "damage", "damage index of Park and Ang of a hinge"),
    WITHIN(FOUNDATION, "foundation-sway", "sway",
           "displacement of a foundation relative to the ground"),
    WITHIN(FOUNDATION, "foundation-rocking", "rocking", "rotation of a foundation"),
    WITHIN(FOUNDATION, "foundation-force", "sway_force", "force of the spring against sway"),
    WITHIN(FOUNDATION, "foundation-moment", "rocking_moment",
           "moment of the spring against rocking"),
    {"force", EDP_OF_CONTACT, "contacts", "force", NULL, EDP_LARGEST, "contact force"},
    {"penetration", EDP_OF_CONTACT, "contacts", "penetration", NULL, EDP_HIGHEST,
     "penetration of a contact, negative if it stays open"},
    {"impacts", EDP_OF_CONTACT, "contacts", "impacts", NULL, EDP_SUM, "number of impacts"},
    {"impulse", EDP_OF_CONTACT, "contacts", "impulse", NULL, EDP_SUM, "impulse of all impacts"},
    {"dissipated", EDP_OF_CONTACT, "contacts", "dissipated", NULL, EDP_SUM,
     "energy dissipated in all impacts"},
    {"link-force", EDP_OF_LINK, "links", "force", NULL, EDP_LARGEST, "force of a bilateral link"},
    {"link-deformation", EDP_OF_LINK, "links", "deformation", NULL, EDP_LARGEST,
     "change of length of a bilateral link"},
    {"link-work", EDP_OF_LINK, "links", "work", NULL, EDP_SUM, "work done on bilateral links"},
    {"link-dissipated", EDP_OF_LINK, "links", "dissipated", NULL, EDP_SUM,
     "energy dissipated by bilateral links"},
    {"link-residual", EDP_OF_LINK, "links", "residual_deformation", NULL, EDP_LARGEST,
     "deformation of a bilateral link that remains without force"},
    {"column-shear", EDP_OF_COLUMN, "columns", "shear", NULL, EDP_LARGEST,
     "shear in a struck column"},
    {"column-moment", EDP_OF_COLUMN, "columns", "moment", NULL, EDP_LARGEST,
     "moment in a struck column"},
    {"column-demand", EDP_OF_COLUMN, "columns", "demand", NULL, EDP_LARGEST,
     "shear or moment in a struck column over its strength"},
    {"hysteretic", EDP_OF_ALL, "energy", "hysteretic", NULL, EDP_SUM,
     "energy dissipated by all storeys"},
    {EDP_COLLAPSE, EDP_OF_ALL, "totals", "collapsed", NULL, EDP_SUM,
     "1 if a storey has collapsed, else 0"},
};
const int n_edp_quantity = sizeof edp_quantities / sizeof edp_quantities[0];

static bool same_name(const char *name, const char *text, size_t n) {
    for (size_t i = 0; i < n; i++) {
        if (name[i] == '\0' || (name[i] != text[i] && !(name[i] == '-' && text[i] == '_'))) {
            return false;
        }
    }
    return name[n] == '\0';
}

static const struct edp_quantity *find_quantity(const char *text, size_t n, struct error *e) {
    const char *known[sizeof edp_quantities / sizeof edp_quantities[0]];
    char name[64];
    for (int i = 0; i < n_edp_quantity; i++) {
        if (same_name(edp_quantities[i].name, text, n)) {
            return &edp_quantities[i];
        }
        known[i] = edp_quantities[i].name;
    }
    text_clean(name, sizeof name, text, n);
    const char *near = text_nearest(name, known, n_edp_quantity);
    error_set(e, STATUS_INPUT, "unknown EDP '%s'%s%s%s", name, near ? "; did you mean '" : "",
              near ? near : "", near ? "'?" : "; jostle fragility --help lists them");
    return NULL;
}

// The dataset that the quantity is in, or a property, of the owner; -1 if there is none.
static int find_item(const struct study_view *v, const struct edp_quantity *q, const char *owner,
                     const char *name) {
    for (int i = 0; i < v->table.n_item; i++) {
        const struct study_item *item = &v->table.item[i];
        const bool peak = name == q->item && q->owner != EDP_OF_ALL;
        if (strcmp(item->parent, q->parent) == 0 && strcmp(item->name, name) == 0 &&
            (item->leaf != NULL) == peak &&
            (!owner || (item->owner && strcmp(item->owner, owner) == 0))) {
            return i;
        }
    }
    return -1;
}

struct reading {
    const struct study_view *view;
    const struct edp_quantity *quantity;
    const char *text;   // as asked for
    const char *place;  // what follows the first colon; NULL: everywhere
    struct arena *arena;
    struct edp *out;
    struct edp_term *term;
};

static int add_term(struct reading *r, const struct edp_term *t, const char *location) {
    struct edp_term *to = &r->term[r->out->n_term++];
    *to = *t;
    to->location = location;
    return location ? STATUS_OK : STATUS_SYSTEM;
}

// The floors of one building; `floor` 0: all.
static int add_floors(struct reading *r, const struct study_item *item, long floor,
                      struct error *e) {
    const struct study_view *v = r->view;
    const struct edp_quantity *q = r->quantity;
    const int divisor = q->divisor ? find_item(v, q, item->owner, q->divisor) : -1;
    if (q->divisor && divisor < 0) {
        return error_set(e, STATUS_INPUT, "%s: the file has no %s of building %s", r->text,
                         q->divisor, item->owner);
    }
    if (floor > (long)item->n) {
        return error_set(e, STATUS_INPUT, "%s: building %s has %zu floor%s", r->text, item->owner,
                         item->n, item->n > 1 ? "s" : "");
    }
    for (size_t i = 0; i < item->n; i++) {
        if (floor > 0 && i + 1 != (size_t)floor) {
            continue;
        }
        const struct edp_term t = {.value = item->first + i,
                                   .item = item,
                                   .apart = floor == 0 && !study_view_counts(v, item, i),
                                   .divisor =
                                       divisor < 0 ? SIZE_MAX : v->table.item[divisor].first + i};
        if (add_term(r, &t, arena_format(r->arena, "%s:%zu", item->owner, i + 1)) != STATUS_OK) {
            return error_no_memory(e);
        }
    }
    return STATUS_OK;
}

// True if `place` is the building, or the building and a floor: *floor, 0: all; < 0: no number.
static bool is_building(const char *place, const char *building, long *floor) {
    const size_t n = strlen(building);
    *floor = 0;
    if (!place || strcmp(place, building) == 0) {
        return true;
    }
    if (strncmp(place, building, n) != 0 || place[n] != ':') {
        return false;
    }
    char *end;
    const char *digits = place + n + 1;
    *floor = *digits >= '1' && *digits <= '9' ? strtol(digits, &end, 10) : -1;
    *floor = *floor > 0 && *end != '\0' ? -1 : *floor;
    return true;
}

static int add_buildings(struct reading *r, struct error *e) {
    const struct study_view *v = r->view;
    const struct edp_quantity *q = r->quantity;
    const char *known = "";
    for (int i = 0; i < v->table.n_item; i++) {
        const struct study_item *item = &v->table.item[i];
        long floor;
        if (!item->owner || !item->leaf || strcmp(item->parent, q->parent) != 0 ||
            strcmp(item->name, q->item) != 0) {
            continue;
        }
        known = arena_format(r->arena, "%s%s%s", known, known[0] ? ", " : "", item->owner);
        if (!known) {
            return error_no_memory(e);
        }
        if (is_building(r->place, item->owner, &floor)) {
            if (floor < 0) {
                return error_set(e, STATUS_INPUT, "%s: a floor is a number from 1", r->text);
            }
            int status = add_floors(r, item, floor, e);
            if (status != STATUS_OK) {
                return status;
            }
        }
    }
    return r->out->n_term > 0
               ? STATUS_OK
               : error_set(e, STATUS_INPUT, "%s: unknown building; available: %s", r->text, known);
}

// True if `place` is the building, or the building and the member.
static bool is_member(const char *place, const char *building, const char *member) {
    const size_t n = strlen(building);
    return !place || strcmp(place, building) == 0 ||
           (strncmp(place, building, n) == 0 && place[n] == ':' &&
            strcmp(place + n + 1, member) == 0);
}

// The members of a building, whose values are in `item`; beams and walls have no normal force.
static int add_members(struct reading *r, const struct report_building *b,
                       const struct study_item *item, struct error *e) {
    const bool axial = strcmp(item->name, "axial") == 0;
    for (size_t i = 0; i < item->n && i < (size_t)b->n_member; i++) {
        const char *name = b->member[i].name;
        if (!is_member(r->place, b->name, name) || (axial && strncmp(name, "column", 6) != 0)) {
            continue;
        }
        const struct edp_term t = {.value = item->first + i, .divisor = SIZE_MAX, .item = item};
        if (add_term(r, &t, arena_format(r->arena, "%s:%s", b->name, name)) != STATUS_OK) {
            return error_no_memory(e);
        }
    }
    return STATUS_OK;
}

// The values of members or foundations that the quantity is about.
static int add_all(struct reading *r, const char *owner, struct error *e) {
    const struct study_view *v = r->view;
    const bool members = r->quantity->owner == EDP_OF_MEMBER;
    bool any = false;
    for (int i = 0; i < v->table.n_item; i++) {
        const struct study_item *item = &v->table.item[i];
        const struct report_building *b = study_view_building(v, item, owner);
        if (!b || strcmp(item->name, r->quantity->item) != 0) {
            continue;
        }
        any = true;
        r->out->units = item->units;
        if (members && add_members(r, b, item, e) != STATUS_OK) {
            return STATUS_SYSTEM;
        }
        if (!members && (!r->place || strcmp(r->place, b->name) == 0)) {
            add_term(r, &(struct edp_term){item->first, SIZE_MAX, NULL, NULL, false}, b->name);
        }
    }
    bool framed = false;
    for (int i = 0; i < v->n_building; i++) {
        framed |= v->building[i].n_member > 0;
    }
    const char *none = !members ? "such building has a foundation"
                       : any    ? "building has such a member"
                       : framed ? "building has hinges"  // which other quantities do not need
                                : "building has a frame or a wall";
    return r->out->n_term > 0 ? STATUS_OK : error_set(e, STATUS_INPUT, "%s: no %s", r->text, none);
}

static int add_links(struct reading *r, const struct study_item *item, struct error *e) {
    const struct study_view *v = r->view;
    const enum edp_owner owner = r->quantity->owner;
    const bool contact = owner == EDP_OF_CONTACT, column = owner == EDP_OF_COLUMN;
    const int n = contact ? v->n_contact : column ? v->n_column : v->n_link;
    const struct report_link *link = contact ? v->contact : column ? v->column : v->link;
    for (int i = 0; i < n && (size_t)i < item->n; i++) {
        if (!r->place || strcmp(r->place, link[i].name) == 0) {
            add_term(r, &(struct edp_term){.value = item->first + (size_t)i, .divisor = SIZE_MAX},
                     link[i].name);
        }
    }
    if (r->out->n_term > 0) {
        return STATUS_OK;
    }
    const char *what = contact ? "contact" : column ? "column" : "link";
    return n == 0
               ? error_set(e, STATUS_INPUT, "%s: there is no %s", r->text, what)
               : error_set(e, STATUS_INPUT, "%s: unknown %s; %d available: %s%s%s", r->text, what,
                           n, link[0].name, n > 1 ? " ... " : "", n > 1 ? link[n - 1].name : "");
}

static int add_terms(struct reading *r, struct error *e) {
    const struct edp_quantity *q = r->quantity;
    if (q->owner == EDP_OF_MEMBER) {
        return add_all(r, "members", e);
    }
    if (q->owner == EDP_OF_FOUNDATION) {
        return add_all(r, "foundation", e);
    }
    const int i = find_item(r->view, q, NULL, q->item);
    if (i < 0) {
        return error_set(e, STATUS_INPUT, "%s: there is no %s", r->text,
                         q->owner == EDP_OF_LINK     ? "link"
                         : q->owner == EDP_OF_COLUMN ? "column"
                                                     : q->name);
    }
    const struct study_item *item = &r->view->table.item[i];
    r->out->units = q->divisor ? "1" : item->units;
    switch (q->owner) {
        case EDP_OF_BUILDING:
            return add_buildings(r, e);
        case EDP_OF_CONTACT:
        case EDP_OF_LINK:
        case EDP_OF_COLUMN:
            return add_links(r, item, e);
        default:
            if (r->place) {
                return error_set(e, STATUS_INPUT,
                                 "%s: %s is one number for the whole; no place "
                                 "is named",
                                 r->text, q->name);
            }
            return add_term(r, &(struct edp_term){.value = item->first, .divisor = SIZE_MAX}, "");
    }
}

int edp_parse(const struct study_view *v, const char *text, struct arena *a, struct edp *out,
              struct error *e) {
    const size_t n = strcspn(text, ":");
    *out = (struct edp){.quantity = find_quantity(text, n, e)};
    if (!out->quantity) {
        return STATUS_INPUT;
    }
    out->text = arena_text(a, text, strlen(text));
    struct reading r = {.view = v,
                        .quantity = out->quantity,
                        .text = out->text,
                        .place = text[n] == ':' ? out->text + n + 1 : NULL,
                        .arena = a,
                        .out = out,
                        .term = arena_alloc(a, v->table.n_value, sizeof *r.term)};
    if (!out->text || !r.term) {
        return error_no_memory(e);
    }
    int status = add_terms(&r, e);
    double size;
    out->term = r.term;
    if (status == STATUS_OK) {
        out->dimension = edp_units(out->units, v->units.gravity, &size);
    }
    return status;
}

double edp_term_value(const struct edp *p, int term, const double *value) {
    const struct edp_term *t = &p->term[term];
    const double by = t->divisor == SIZE_MAX ? 1.0 : value[t->divisor];
    return by > 0.0 ? value[t->value] / by : (double)NAN;
}

double edp_value(const struct edp *p, const double *value, int *at) {
    double largest = NAN, sum = 0.0;
    *at = 0;
    for (int i = 0; i < p->n_term; i++) {
        const double x = p->term[i].apart ? -INFINITY : edp_term_value(p, i, value);
        sum += x;
        if (!(x <= largest)) {
            largest = x;
            *at = i;
        }
        if (isnan(x)) {
            break;
        }
    }
    return p->quantity->reduction == EDP_SUM ? sum : largest;
}

bool edp_is_collapse(const struct edp *p) {
    return strcmp(p->quantity->name, EDP_COLLAPSE) == 0;
}

bool edp_collapsed(const struct study_view *v, const double *value) {
    for (int i = 0; i < v->table.n_item; i++) {
        if (strcmp(v->table.item[i].name, "collapsed") == 0) {
            return value[v->table.item[i].first] > 0.0;
        }
    }
    return false;
}

int edp_hit(const struct edp *p, const struct study_view *v, int at, const double *value) {
    const struct edp_term *t = &p->term[at];
    return t->item ? study_view_hit(v, t->item, t->value - t->item->first, value) : -1;
}

int edp_absent(const struct edp *p, int at, struct error *e) {
    const char *place = p->term[at].location;
    return p->quantity->divisor
               ? error_set(e, STATUS_INPUT, "%s: the deck gives no height of storey %s", p->text,
                           place)
               : error_set(e, STATUS_INPUT, "%s: %s is rigid: it has an impulse, but no force",
                           p->text, place);
}
