// SPDX-License-Identifier: GPL-3.0-or-later
// Reads everything but the histories of a result file into a report.
//
// The file of one analysis has all its values in one tree. A run of a study has its histories and
// impacts in /runs. The tree of the study has what all runs have in common and, with the dimensions
// of the sweeps in front, the other values of each run.
#include "result/reader.h"

#include <math.h>
#include <string.h>

// A file with larger numbers is damaged.
enum { BUILDINGS_LIMIT = 1 << 20, LIST_LIMIT = 1 << 26, PATH_SIZE = 4096 };

bool reader_is_run(const struct result_file *r) {
    return r->root != r->h.file;
}

// Where a value may be: in the group of the analysis or run itself, or, of a run of a study, in the
// group of the same name in the tree of the study. Negative: there is no such group.
struct spot {
    hid_t own, study;
};

static struct spot root_of(const struct result_file *r) {
    return (struct spot){r->root, reader_is_run(r) ? r->h.file : -1};
}

// The group that has `name`: that of the run itself if possible, otherwise that of the study.
static hid_t holder(struct result_file *r, const struct spot *p, const char *name) {
    const bool is_own = p->study < 0 || (p->own >= 0 && h5_has(&r->h, p->own, name));
    return is_own ? p->own : p->study;
}

static struct spot open_spot(struct result_file *r, const struct spot *in, const char *name) {
    const bool is_own = holder(r, in, name) == in->own;
    return (struct spot){is_own ? h5_get_group(&r->h, in->own, name) : -1,
                         in->study >= 0 ? h5_get_group(&r->h, in->study, name) : -1};
}

static void close_spot(struct result_file *r, const struct spot *p) {
    h5_close(&r->h, p->own);
    h5_close(&r->h, p->study);
}

static void get_column(struct result_file *r, const struct spot *p, const struct column_table *t,
                       int c, void *base, size_t n) {
    const char *name = t->column[c].name;
    const hid_t group = r->h.failed ? -1 : holder(r, p, name);
    if (!r->h.failed && !(layout_is_later(&t->column[c]) && !h5_has(&r->h, group, name))) {
        h5_get_column(&r->h, r->report->arena, group, t, c, base, n);
    }
}

// Reads the columns of a table that are the same for all runs of a study, or the others.
enum columns { COLUMNS_FIXED, COLUMNS_OTHER };
static void get_columns(struct result_file *r, const struct spot *p, const struct column_table *t,
                        enum columns which, void *base, size_t n) {
    for (int c = 0; c < t->n_column; c++) {
        if (layout_is_fixed(&t->column[c]) == (which == COLUMNS_FIXED)) {
            get_column(r, p, t, c, base, n);
        }
    }
}

static void get_attributes(struct result_file *f) {
    struct report *r = f->report;
    h5_get_units(&f->h, r->arena, &r->units);
    for (int c = 0; c < layout_root.n_column && !f->h.failed; c++) {
        const struct column *column = &layout_root.column[c];
        const bool is_own = !reader_is_run(f) || H5Aexists(f->root, column->name) > 0;
        if (f->reading == READ_VALUES || layout_is_shared(column)) {
            h5_get_member(&f->h, r->arena, is_own ? f->root : f->h.file, &layout_root, c, r);
        }
    }
    if (f->reading == READ_SHAPE) {
        return;
    }
    for (int c = 0; c < layout_totals.n_column; c++) {
        h5_get_member(&f->h, r->arena, f->root, &layout_totals, c, r);
    }
    // Files of earlier versions do not have these attributes.
    r->collapse = (struct report_collapse){.building = ""};
    const bool tells = H5Aexists(f->root, layout_collapse.column[0].name) > 0;
    for (int c = 0; tells && c < layout_collapse.n_column; c++) {
        h5_get_member(&f->h, r->arena, f->root, &layout_collapse, c, r);
    }
    r->n_row = (long)h5_get_length(&f->h, f->root, "time", (size_t)1 << 30);
    if (r->n_row < 1) {
        h5_fail(&f->h, "dataset 'time' has no values");
    }
}

// Reads the names of the members of a building that has the group, and notes what their envelope
// has.
static void get_members(struct result_file *f, const struct spot *building,
                        struct report_building *b) {
    const struct spot members = open_spot(f, building, "members");
    const hid_t group = members.own >= 0 ? members.own : members.study;
    const size_t n = h5_get_length(&f->h, group, "member", LIST_LIMIT);
    b->member = h5_alloc(&f->h, f->report->arena, n, sizeof *b->member);
    get_columns(f, &members, &layout_member, COLUMNS_FIXED, b->member, n);
    const struct spot envelope = open_spot(f, &members, "envelope");
    b->hinged = !f->h.failed && h5_has(&f->h, envelope.own >= 0 ? envelope.own : envelope.study,
                                       layout_member_peak[1].column[MEMBER_PEAKS].name);
    b->extremes = f->reading == READ_VALUES && envelope.own >= 0 &&
                  h5_has(&f->h, envelope.own, layout_member_extreme[0].column[0].name);
    b->n_member = f->h.failed ? 0 : (int)n;
    close_spot(f, &envelope);
    close_spot(f, &members);
}

// Reads the names of the parts of a building that has the group.
static void get_shares(struct result_file *f, const struct spot *building,
                       struct report_building *b) {
    const struct spot parts = open_spot(f, building, "parts");
    const hid_t group = parts.own >= 0 ? parts.own : parts.study;
    const size_t n = h5_get_length(&f->h, group, "part", LIST_LIMIT);
    b->share = h5_alloc(&f->h, f->report->arena, n, sizeof *b->share);
    get_columns(f, &parts, &layout_share, COLUMNS_FIXED, b->share, n);
    b->n_share = f->h.failed ? 0 : (int)n;
    close_spot(f, &parts);
}

// The building in the group `name`, at its position, which must be free.
static herr_t visit_building(hid_t parent, const char *name, const H5L_info_t *info,
                             void *context) {
    (void)info, (void)parent;
    struct result_file *f = context;
    struct report *r = f->report;
    const struct spot root = root_of(f), all = open_spot(f, &root, "buildings");
    const struct spot building = open_spot(f, &all, name);
    const long position = h5_get_long(&f->h, building.own, "position");
    char *copy = h5_copy(&f->h, r->arena, name);
    if (!f->h.failed && (position < 0 || position >= r->n_building || r->building[position].name)) {
        h5_fail(&f->h, "building '%s' has the position %ld", name, position);
    }
    if (!f->h.failed) {
        struct report_building *b = &r->building[position];
        b->name = copy;
        layout_paths(b, r->arena);
        b->n_floor = (int)h5_get_length(&f->h, building.own, "floor", FLOORS_MAX);
        if (b->n_floor < 1) {
            h5_fail(&f->h, "building '%s' has no floors", b->name);
        }
        if (!f->h.failed && H5Aexists(building.own, layout_isolated_name) > 0) {
            b->isolated = (int)h5_get_long(&f->h, building.own, layout_isolated_name);
        }
    }
    if (!f->h.failed && h5_has(&f->h, holder(f, &building, "members"), "members")) {
        get_members(f, &building, &r->building[position]);
    }
    if (!f->h.failed && h5_has(&f->h, holder(f, &building, "parts"), "parts")) {
        get_shares(f, &building, &r->building[position]);
    }
    if (!f->h.failed && h5_has(&f->h, holder(f, &building, "foundation"), "foundation")) {
        struct report_foundation *slab = h5_alloc(&f->h, r->arena, 1, sizeof *slab);
        r->building[position].foundation = slab;
    }
    for (int i = 0; i < FLOOR_FIELD_COUNT && position == 0; i++) {
        r->fields |= h5_has(&f->h, building.own, field_names[i]) ? 1U << i : 0;
    }
    close_spot(f, &building);
    close_spot(f, &all);
    return f->h.failed ? -1 : 0;
}

static void get_buildings(struct result_file *f) {
    struct report *r = f->report;
    hid_t group = h5_get_group(&f->h, f->root, "buildings");
    H5G_info_t info = {.nlinks = 0};
    if (!f->h.failed && !h5_failed(&f->h, H5Gget_info(group, &info)) &&
        (info.nlinks < 1 || info.nlinks > BUILDINGS_LIMIT)) {
        h5_fail(&f->h, "it has %llu buildings; 1 to %d are allowed",
                (unsigned long long)info.nlinks, BUILDINGS_LIMIT);
    }
    r->building = f->h.failed ? NULL : h5_alloc(&f->h, r->arena, info.nlinks, sizeof *r->building);
    if (r->building) {
        r->n_building = (int)info.nlinks;
        h5_failed(&f->h, H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, NULL, visit_building, f));
    }
    h5_close(&f->h, group);
}

// The end of a link must be a wall, or a floor of a building of the file; 0 is the ground. `*at` is
// the building found last, with which the search starts.
static void check_end(struct result_file *f, const char *group, const char *name, int floor,
                      int *at) {
    const struct report *r = f->report;
    if (strcmp(name, "wall") == 0) {
        return;
    }
    for (int i = 0; i < r->n_building; i++) {
        const int k = (*at + i) % r->n_building;
        if (strcmp(r->building[k].name, name) == 0) {
            *at = k;
            if (floor < 0 || floor > r->building[k].n_floor) {
                h5_fail(&f->h, "a link of /%s is at floor %d of '%s', which has %d", group, floor,
                        name, r->building[k].n_floor);
            }
            return;
        }
    }
    h5_fail(&f->h, "a link of /%s is at '%s', which is not in /buildings", group, name);
}

static struct report_link *get_links(struct result_file *r, const struct link_group *g,
                                     int *n_link) {
    const struct spot root = root_of(r), links = open_spot(r, &root, g->name);
    const size_t n = h5_get_length(&r->h, links.own, g->scale, LIST_LIMIT);
    struct report_link *link = h5_alloc(&r->h, r->report->arena, n, sizeof *link);
    get_columns(r, &links, &layout_link, COLUMNS_FIXED, link, n);
    for (size_t i = 0; link && i < n; i++) {
        link[i].left_below = link[i].left_floor;
        link[i].right_below = link[i].right_floor;
        link[i].left_level = link[i].right_level = NAN;
    }
    const char *level = layout_level.column[0].name;
    if (n > 0 && h5_has(&r->h, holder(r, &links, level), level)) {
        get_columns(r, &links, &layout_level, COLUMNS_FIXED, link, n);
    }
    int left = 0, right = 0;
    for (size_t i = 0; link && i < n && !r->h.failed; i++) {
        check_end(r, g->name, link[i].left, link[i].left_floor, &left);
        check_end(r, g->name, link[i].right, link[i].right_floor, &right);
    }
    if (r->reading == READ_VALUES) {
        for (int i = 0; i < 2; i++) {
            const unsigned bit = 1U << (FLOOR_FIELD_COUNT + i);
            r->report->fields |= h5_has(&r->h, links.own, g->field[i]) ? bit : 0;
        }
    }
    close_spot(r, &links);
    *n_link = (int)n;
    return link;
}

// Of a run that failed the file has no peaks of contacts: those of its impacts take their place.
static void count_impacts(struct report *r) {
    for (int i = 0; i < r->n_contact; i++) {
        r->contact[i].peak = (struct link_peak){.penetration = NAN, .penetration_time = NAN};
    }
    for (long i = 0; i < r->n_impact; i++) {
        const struct impact *from = &r->impact[i];
        struct link_peak *to = &r->contact[from->contact].peak;
        to->impacts++;
        to->impulse += from->impulse;
        to->dissipated += from->dissipated;
        to->penetration = fmax(to->penetration, from->max_penetration);
        if (from->peak_force > to->force) {
            to->force = from->peak_force;
            to->force_time = NAN;
        }
    }
}

// Can a storey of the building in the group `path` yield? If not, the file has no residual drifts
// of it. Of a run of a study, an attribute says so.
static bool yields(struct result_file *f, const struct spot *envelope, const char *path) {
    if (envelope->own >= 0) {
        return h5_has(&f->h, envelope->own, layout_residual_drift_name);
    }
    hid_t building = h5_open_object(&f->h, f->root, path);
    const bool yields = h5_get_long(&f->h, building, "yields") != 0;
    h5_close(&f->h, building);
    return yields;
}

// Reads the values at a place. Energies and totals are not here: they are attributes.
static void get_place(void *context, const struct layout_place *p) {
    struct result_file *f = context;
    void *base = (void *)p->base;  // of the report of this file
    char owner[PATH_SIZE], path[PATH_SIZE + 16];
    if (!p->scale || f->h.failed) {
        return;
    }
    snprintf(owner, sizeof owner, "%s%s%s", p->parent, p->owner ? "/" : "",
             p->owner ? p->owner : "");
    snprintf(path, sizeof path, "%s%s%s", owner, p->leaf ? "/" : "", p->leaf ? p->leaf : "");
    const struct spot root = root_of(f), spot = open_spot(f, &root, path);
    struct column_table t = *p->table;
    if (p->table == &layout_peak && !yields(f, &spot, owner)) {
        t.n_column -= 1 + YIELD_QUANTITIES;
    }
    get_columns(f, &spot, &t, COLUMNS_OTHER, base, p->n);
    // What only a run alone has.
    const bool hinged = p->table == &layout_member_peak[1];
    const struct column_table *more = p->table == &layout_building ? &layout_pdelta
                                      : hinged || p->table == &layout_member_peak[0]
                                          ? &layout_member_extreme[hinged]
                                          : NULL;
    if (more && spot.own >= 0 && h5_has(&f->h, spot.own, more->column[0].name)) {
        get_columns(f, &spot, more, COLUMNS_OTHER, base, p->n);
    }
    close_spot(f, &spot);
}

static void get_impacts(struct result_file *f) {
    struct report *r = f->report;
    hid_t group = h5_get_group(&f->h, f->root, "impacts");
    const size_t n = h5_get_length(&f->h, group, "impact", LIST_LIMIT);
    r->impact = h5_alloc(&f->h, r->arena, n, sizeof *r->impact);
    for (int c = 0; c < layout_impact.n_column && !f->h.failed; c++) {
        h5_get_column(&f->h, r->arena, group, &layout_impact, c, r->impact, n);
    }
    r->n_impact = (long)n;
    for (size_t i = 0; i < n && !f->h.failed; i++) {
        if (r->impact[i].contact < 0 || r->impact[i].contact >= r->n_contact) {
            h5_fail(&f->h, "impact %zu is of contact %d; there are %d", i + 1,
                    r->impact[i].contact + 1, r->n_contact);
        }
    }
    if (f->h.ended_early && !f->h.failed) {
        count_impacts(r);
    }
    h5_close(&f->h, group);
}

static void get_energy(struct result_file *r) {
    hid_t group = h5_get_group(&r->h, r->root, "energy");
    for (int i = 0; i < ENERGY_COUNT && !r->h.failed; i++) {
        const char *name = energy_names[i];
        hid_t history = h5_has(&r->h, group, name) ? H5Dopen2(group, name, H5P_DEFAULT) : -1;
        if (history < 0) {
            h5_fail(&r->h, "dataset '%s' is missing", name);
        }
        r->report->energy[i] = h5_get_double(&r->h, history, "final");
        h5_close(&r->h, history);
    }
    for (int c = ENERGY_COUNT; c < layout_energy.n_column; c++) {
        h5_get_member(&r->h, r->report->arena, group, &layout_energy, c, r->report);
    }
    h5_close(&r->h, group);
}

void reader_get(struct result_file *r) {
    get_attributes(r);
    get_buildings(r);
    r->report->contact = get_links(r, &layout_contacts, &r->report->n_contact);
    if (h5_has(&r->h, r->root, layout_links.name)) {
        r->report->link = get_links(r, &layout_links, &r->report->n_link);
    }
    if (h5_has(&r->h, r->root, layout_columns.name)) {
        r->report->column = get_links(r, &layout_columns, &r->report->n_column);
    }
    if (r->reading == READ_VALUES && !r->h.failed) {
        layout_each(r->report, get_place, r);
        get_impacts(r);
        get_energy(r);
    }
}
