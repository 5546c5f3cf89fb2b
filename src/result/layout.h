// SPDX-License-Identifier: GPL-3.0-or-later
// What is in a result file: a row for each dataset or attribute of the tree. Runs and studies are
// written and read from these tables, and `show` prints them. A run is a study without sweeps.
#ifndef JOSTLE_LAYOUT_H
#define JOSTLE_LAYOUT_H

#include <stddef.h>

#include "jostle/result.h"

// COLUMN_ARRAY: the member is a pointer to numbers over the dimension of the table, or NULL.
enum column_kind { COLUMN_DOUBLE, COLUMN_LONG, COLUMN_INT, COLUMN_FLAG, COLUMN_TEXT, COLUMN_ARRAY };

// One member of a struct, as a dataset over an array of them or as an attribute.
struct column {
    const char *name;
    const char *long_name;              // NULL for attributes
    const struct dimension *dimension;  // NULL: a pure number or a text
    enum column_kind kind;
    size_t offset;  // in the struct
    int base;       // added to whole numbers in the file: 1 turns an index into a number from 1
};

struct column_table {
    const struct column *column;
    int n_column;
    size_t size;  // of the struct
};

extern const struct column_table layout_root;      // of struct report: attributes of /
extern const struct column_table layout_totals;    // the same; of a study: /totals
extern const struct column_table layout_collapse;  // the same, which earlier versions do not have
extern const struct column_table layout_energy;    // of struct report: /energy
extern const struct column_table layout_building;  // of struct report_building: /buildings/*
extern const struct column_table layout_pdelta;    // the same, of a run alone with P-delta
extern const struct column_table layout_peak;      // the same: /buildings/*/envelope
extern const struct column_table layout_member;    // of struct report_member: .../members
// The same: .../members/envelope; of runs besides the signed extremes. [1]: with hinges, whose
// columns come after those of [0].
enum { MEMBER_PEAKS = 3, MEMBER_EXTREMES = 4 * MEMBER_FORCES };
extern const struct column_table layout_member_peak[2], layout_member_extreme[2];
extern const struct column_table layout_share;        // of struct report_share: .../parts
extern const struct column_table layout_share_peak;   // the same: .../parts/*/envelope
extern const struct column_table layout_foundation;   // of struct report_foundation:
                                                      // .../foundation/envelope
extern const struct column_table layout_link;         // of struct report_link: /contacts and /links
extern const struct column_table layout_level;        // the same, where layout_has_levels
extern const struct column_table layout_contact;      // of struct report_link: /contacts/envelope
extern const struct column_table layout_link_peak;    // of struct report_link: /links/envelope
extern const struct column_table layout_column_peak;  // the same: /columns/envelope
extern const struct column_table layout_impact;       // of struct impact: /impacts

// A run has this column of layout_peak, and the YIELD_QUANTITIES behind it, of buildings that can
// yield.
extern const char layout_residual_drift_name[];

// Do files of earlier versions not have the column? It is one of those quantities.
bool layout_is_later(const struct column *c);

// The attribute of a building with isolators: their storey.
extern const char layout_isolated_name[];

// Quantities with a history; the name is in field_names.
struct quantity {
    const char *long_name;
    const struct dimension *dimension;
};
extern const struct quantity layout_field[];         // in the order of enum field's bits, up to the
                                                     // seventh
extern const struct quantity layout_member_field[];  // member_force, then member_rotation
extern const struct quantity layout_share_field;
extern const struct quantity layout_foundation_field[];  // in the order of enum foundation_quantity

enum { FLOOR_FIELD_COUNT = 5, FIELD_COUNT = 7 };

// A group of links: contacts, or bilateral links.
struct link_group {
    const char *name, *scale;          // of the group, and of its dimension
    const struct column_table *peaks;  // of its envelope
    const char *field[2];              // its histories: force, and penetration or deformation
    const struct quantity *quantity;   // (2) of them
};
extern const struct link_group layout_contacts, layout_links, layout_columns;

// Is an end of a link at a level between two floors?
bool layout_has_levels(const struct report_link *link, int n);

// Is an attribute of / the same for all runs of a study?
bool layout_is_shared(const struct column *c);
// Is a column of links the same for all runs of a study: names and floors? Are its values among
// those of a run? Neither is the law, which the deck says.
bool layout_is_fixed(const struct column *c);
bool layout_is_value(const struct column *c);

// Address of value `i` of column `c`: in struct number `i` of the array at `base`, or in the array
// that is a member of the struct there. NULL: there is no such array.
const void *layout_at(const struct column_table *t, int c, const void *base, size_t i);

// What the file has for a member there: of kind COLUMN_LONG, COLUMN_INT or COLUMN_FLAG, and of any
// kind but COLUMN_TEXT.
long layout_whole(const struct column *c, const void *at);
double layout_number(const struct column *c, const void *at);

// A group of the tree of a run or of a study.
enum layout_kind {
    LAYOUT_BUILDING,
    LAYOUT_MEMBERS,
    LAYOUT_PARTS,  // the names of the parts, of which each has a group
    LAYOUT_PART,
    LAYOUT_FOUNDATION,
    LAYOUT_LINKS,  // contacts, links or struck columns
    LAYOUT_ENERGY,
    LAYOUT_TOTALS,  // of a study; the root of a run has these attributes
};
struct layout_group {
    enum layout_kind kind;
    const char *parent, *name;            // "buildings", "A"; parent NULL: the root
    const char *scale;                    // dimension of the values: "floor"; NULL: one value
    size_t n;                             // values of each column
    const void *base;                     // of the first struct
    const struct column_table *own[2];    // properties; NULL: none
    const struct column_table *envelope;  // NULL: none
    int building;                         // its number, from 0
    int number;                           // of the part, or of the first link, from 0
    const struct link_group *links;
};
typedef void layout_visit_group(void *context, const struct layout_group *g);

// Visits all groups in the order of the file.
void layout_groups(const struct report *r, layout_visit_group *visit, void *context);

// The columns of a table for one owner.
struct layout_place {
    const char *parent, *owner, *leaf;  // group: "buildings", "A", "envelope"; NULL: none
    const char *scale;                  // dimension of the values: "floor"; NULL: one value
    const struct column_table *table;
    const void *base;  // of the first struct
    size_t n;          // values of each column
};
typedef void layout_visit(void *context, const struct layout_place *p);

// Sets the paths of a building whose name is there.
void layout_paths(struct report_building *b, struct arena *a);

// Visits the places of all groups, in the order of the values of a run.
void layout_each(const struct report *r, layout_visit *visit, void *context);

#endif
