// SPDX-License-Identifier: GPL-3.0-or-later
// The report of a run from the model and the results in memory.
#include <math.h>
#include <string.h>
#include <time.h>

#include "core/arena.h"
#include "jostle/result.h"
#include "model/forces.h"
#include "model/struck_column.h"
#include "result/layout.h"

static const char *const wall = "wall";

const char *const report_foundation_names[] = {"sway", "rocking", "sway_force", "rocking_moment"};

const char *const report_force_names[] = {
    "M_i", "M_j", "V", "N", "rotation_i", "rotation_j", "plastic_rotation_i", "plastic_rotation_j"};

static const double *copy(struct arena *a, const double *from, size_t n) {
    double *to = arena_alloc(a, n, sizeof *to);
    if (to && from) {
        memcpy(to, from, n * sizeof *to);
    }
    return to;
}

static double larger_of(const struct member_extreme *e) {
    return fmax(e->max, -e->min);
}

// What the hinges of a member have gone through. An end without a hinge has NAN, which fmax
// ignores.
static void hinges_fill(struct report_member *to, const struct results *r, int first,
                        const struct frame_member *m) {
    const struct member_extreme *e = to->extreme;
    for (int end = 0; end < 2; end++) {
        if (m->hinge[end] >= 0) {
            const double *own = r->hinge_demand[first + m->hinge[end]].value;
            to->plastic = fmax(to->plastic, larger_of(&e[MEMBER_PLASTIC_I + end]));
            for (int q = 0; q < YIELD_QUANTITIES; q++) {
                to->demand.value[q] = q == YIELD_HYSTERETIC ? to->demand.value[q] + own[q]
                                                            : fmax(to->demand.value[q], own[q]);
            }
        }
    }
}

static void member_fill(struct report_member *to, const struct plane_frame *f, int i,
                        const struct building *b, int part, const struct results *r) {
    for (int q = 0; r && q < forces_quantities(b); q++) {
        const int at = b->force + forces_of_members(b, part, q) + i;
        const bool has = frame_has(&f->member[i], q);
        to->extreme[q] = has ? (struct member_extreme){r->force_max[at], r->force_max_time[at],
                                                       r->force_min[at], r->force_min_time[at]}
                             : (struct member_extreme){NAN, NAN, NAN, NAN};
    }
    const struct member_extreme *e = to->extreme;
    to->moment = fmax(larger_of(&e[MEMBER_M_I]), larger_of(&e[MEMBER_M_J]));
    to->shear = larger_of(&e[MEMBER_V]);
    to->axial = larger_of(&e[MEMBER_N]);
    if (r) {
        hinges_fill(to, r, b->first_hinge, &f->member[i]);
    }
}

static void members_fill(struct report_building *to, struct arena *a, const struct building *b,
                         const struct building *own, const struct results *r) {
    for (int p = 0; p < own->n_part; p++) {
        const struct plane_frame *f = frame_of(&own->part[p]);
        to->n_member += f ? f->n_member : 0;
    }
    struct report_member *m = arena_alloc(a, (size_t)to->n_member, sizeof *m);
    to->member = m;
    to->extremes = r && to->n_member > 0;
    to->hinged = b->n_hinge > 0;
    for (int p = 0; m && p < own->n_part; p++) {
        const struct plane_frame *f = frame_of(&own->part[p]);
        for (int i = 0; f && i < f->n_member; i++, m++) {
            m->name = frame_member_name(&f->member[i], a);
            member_fill(m, f, i, b, p, r);
        }
    }
}

static void share_fill(struct report_share *to, struct arena *a, const struct building *b,
                       int share, const struct results *r) {
    const size_t n = (size_t)b->n_floor;
    const char *name = forces_share_name(b, share);
    double *shear = arena_alloc(a, n, sizeof *shear), *time = arena_alloc(a, n, sizeof *time);
    to->name = arena_text(a, name, strlen(name));
    for (size_t i = 0; r && shear && time && i < n; i++) {
        const size_t at = (size_t)(b->force + forces_of_share(b, share)) + i;
        const bool most = r->force_max[at] >= -r->force_min[at];
        shear[i] = most ? r->force_max[at] : -r->force_min[at];
        time[i] = most ? r->force_max_time[at] : r->force_min_time[at];
    }
    to->shear = shear;
    to->shear_time = time;
}

static void shares_fill(struct report_building *to, struct arena *a, const struct building *b,
                        const struct building *own, const struct results *r) {
    to->share = arena_alloc(a, (size_t)own->n_part + 1, sizeof *to->share);
    for (int i = 0; to->share && own->n_part > 0 && i <= own->n_part; i++) {
        if (forces_of_share(b, i) >= 0) {
            share_fill(&to->share[to->n_share++], a, b, i, r);
        }
    }
}

static void foundation_fill(struct report_building *to, struct arena *a, const struct building *b,
                            const struct results *r) {
    to->foundation = b->foundation ? arena_alloc(a, 1, sizeof *to->foundation) : NULL;
    for (int q = 0; r && to->foundation && q < FOUNDATION_QUANTITIES; q++) {
        const int at = b->force + forces_of_foundation(b) + q;
        const bool most = r->force_max[at] >= -r->force_min[at];
        to->foundation->size[q] = most ? r->force_max[at] : -r->force_min[at];
        to->foundation->time[q] = most ? r->force_max_time[at] : r->force_min_time[at];
    }
}

static void building_fill(struct report_building *to, struct arena *a, const struct building *b,
                          const struct results *r) {
    const size_t n = (size_t)b->n_floor;
    const struct building *own = b->fixed ? b->fixed : b;  // storeys without the foundation
    double *period = arena_alloc(a, n, sizeof *period);
    to->name = arena_text(a, b->name, strlen(b->name));
    to->n_floor = b->n_floor;
    to->isolated = b->isolated;
    to->mass = copy(a, own->mass, n);
    to->stiffness = copy(a, own->stiffness, n);
    to->height = copy(a, b->height, n);
    to->period = period;
    to->axial = b->axial ? copy(a, b->axial, n) : NULL;
    to->theta = b->theta ? copy(a, b->theta, n) : NULL;
    for (size_t i = 0; period && i < n; i++) {
        period[i] = 2 * acos(-1.0) / b->omega[i];
    }
    for (int p = 0; r && p < PEAK_COUNT; p++) {
        to->peak[p] = copy(a, r->peak[p] + b->first, n);
        to->peak_time[p] = copy(a, r->peak_time[p] + b->first, n);
    }
    if (r && !b->elastic) {
        to->residual_drift = copy(a, r->residual_drift + b->first, n);
        for (int q = 0; q < YIELD_QUANTITIES; q++) {
            double *of = arena_alloc(a, n, sizeof *of);
            for (size_t i = 0; of && i < n; i++) {
                of[i] = r->storey_demand[(size_t)b->first + i].value[q];
            }
            to->demand[q] = of;
        }
    }
    layout_paths(to, a);
    members_fill(to, a, b, own, r);
    shares_fill(to, a, b, own, r);
    foundation_fill(to, a, b, r);
}

static const char *constants_text(struct arena *a, const struct link *l) {
    enum { NUMBER_MAX = 24 };
    size_t n = (size_t)contact_law_n_constant(l->law, l->value);
    char *text = arena_alloc(a, n + 1, NUMBER_MAX);
    size_t used = 0;
    for (size_t i = 0; text && i < n; i++) {
        used +=
            (size_t)snprintf(text + used, NUMBER_MAX, "%s%.9g", i > 0 ? " " : "", l->constant[i]);
    }
    return text;
}

// The name of the building at an end, which may be a column of that building; or "wall".
static const char *end_name(const struct model *m, const struct report *r, int building) {
    const int own = struck_column_host(m, building);
    return own == WALL ? wall : r->building[own].name;
}

static void link_fill(struct report_link *to, const struct report *r, const struct model *m,
                      const struct link *l) {
    *to = (struct report_link){
        .name = arena_text(r->arena, l->name, strlen(l->name)),
        .left = end_name(m, r, l->building[0]),
        .right = end_name(m, r, l->building[l->within ? 0 : 1]),
        .law = l->law->name,
        .constants = constants_text(r->arena, l),
        .left_floor = l->floor[0],
        .right_floor = l->floor[1],
        .left_below = l->floor[0] - !isnan(l->level[0]),
        .right_below = l->floor[1] - !isnan(l->level[1]),
        .left_level = l->level[0],
        .left_weight = l->weight[0],
        .right_level = l->level[1],
        .right_weight = l->weight[1],
        .gap = l->gap,
        .mass = l->mass,
        .restitution = l->restitution,
        .calibrated = l->calibrated,
    };
}

static void collapse_fill(struct report_collapse *to, const struct model *m,
                          const struct report *report, const struct collapse *c) {
    *to = (struct report_collapse){.building = ""};
    for (int k = 0; c && c->happened && k < m->n_building; k++) {
        const int floor = c->dof - m->building[k].first;
        if (floor >= 0 && floor < m->building[k].n_floor) {
            *to =
                (struct report_collapse){1, c->time, report->building[k].name, floor + 1, c->drift};
        }
    }
}

static double larger_size(double most, const struct column_peak *p) {
    return fmax(most, fmax(p->max, -p->min));
}

static void column_fill(struct report_link *to, const struct struck_column *c,
                        const struct column_peak peak[COLUMN_FORCE_COUNT]) {
    memcpy(to->column, peak, sizeof to->column);
    for (enum column_force q = 0; q < COLUMN_FORCE_COUNT; q++) {
        double *most = q <= COLUMN_SHEAR_ABOVE ? &to->shear : &to->moment;
        *most = larger_size(*most, &peak[q]);
    }
    const double demand = fmax(to->shear / c->shear_strength, to->moment / c->moment_strength);
    to->demand = isinf(fmin(c->shear_strength, c->moment_strength)) ? (double)NAN : demand;
}

static void results_fill(struct report *to, const struct model *m, const struct results *r) {
    to->n_impact = r->n_impact;
    to->impact = arena_alloc(to->arena, (size_t)r->n_impact, sizeof *to->impact);
    if (to->impact && r->n_impact > 0) {
        memcpy(to->impact, r->impact, (size_t)r->n_impact * sizeof *to->impact);
    }
    for (int i = 0; i < to->n_contact; i++) {
        to->contact[i].peak = r->link[i];
    }
    for (int i = 0; i < to->n_link; i++) {
        to->link[i].peak = r->link[to->n_contact + i];
    }
    for (int i = 0; i < to->n_column; i++) {
        to->column[i].peak = r->link[to->n_contact + to->n_link + i];
        column_fill(&to->column[i], &m->column[i], r->column[i]);
    }
    memcpy(to->energy, r->energy, sizeof to->energy);
    to->initial_energy = r->initial_energy;
    to->residual_peak = r->residual_peak;
    to->totals = r->totals;
}

static const char *text_or_nothing(struct arena *a, const char *text) {
    return text ? arena_text(a, text, strlen(text)) : "";
}

static void texts_fill(struct report *to, const struct model *m, const char *file,
                       const char *version) {
    struct arena *a = to->arena;
    const time_t seconds = time(NULL);
    struct tm utc;
    char created[32];
    if (!gmtime_r(&seconds, &utc) ||
        !strftime(created, sizeof created, "%Y-%m-%dT%H:%M:%SZ", &utc)) {
        created[0] = '\0';
    }
    to->file = file ? arena_text(a, file, strlen(file)) : NULL;
    to->title = text_or_nothing(a, m->deck->title);
    to->program = "jostle";
    to->version = text_or_nothing(a, version);
    to->created = arena_text(a, created, strlen(created));
    to->deck_file = text_or_nothing(a, m->deck->path);
    to->deck = text_or_nothing(a, m->deck->text);
    to->includes = text_or_nothing(a, deck_includes(m->deck));
    to->parameters = text_or_nothing(a, deck_parameters(m->deck));
    to->command_line = "";
}

static void model_fill(struct report *to, const struct model *m, const struct results *r) {
    to->units = m->deck->units;
    to->duration = m->duration;
    to->dt = m->adaptive ? 0.0 : m->dt;
    to->fields = m->output.fields;
    to->n_row = model_rows(m);
    to->n_building = m->n_building;
    to->n_contact = m->n_contact;
    to->n_link = m->n_link - m->n_contact - m->n_column;
    to->n_column = m->n_column;
    to->building = arena_alloc(to->arena, (size_t)to->n_building, sizeof *to->building);
    to->contact = arena_alloc(to->arena, (size_t)to->n_contact, sizeof *to->contact);
    to->link = arena_alloc(to->arena, (size_t)to->n_link, sizeof *to->link);
    to->column = arena_alloc(to->arena, (size_t)to->n_column, sizeof *to->column);
    if (arena_failed(to->arena)) {
        return;
    }
    for (int i = 0; i < m->n_building; i++) {
        building_fill(&to->building[i], to->arena, &m->building[i], r);
    }
    for (int i = 0; i < m->n_link; i++) {
        const int link = i - m->n_contact, column = link - to->n_link;
        struct report_link *l = link < 0     ? &to->contact[i]
                                : column < 0 ? &to->link[link]
                                             : &to->column[column];
        link_fill(l, to, m, &m->link[i]);
    }
    collapse_fill(&to->collapse, m, to, r ? &r->collapse : NULL);
    if (r) {
        results_fill(to, m, r);
    }
}

int report_create(const struct model *m, const struct results *r, const char *file,
                  const char *version, struct report **out, struct error *e) {
    struct arena *a = arena_create();
    struct report *report = a ? arena_alloc(a, 1, sizeof *report) : NULL;
    if (!report) {
        arena_free(a);
        return error_no_memory(e);
    }
    report->arena = a;
    texts_fill(report, m, file, version);
    model_fill(report, m, r);
    if (arena_failed(a) || arena_failed(m->deck->arena)) {
        arena_free(a);
        return error_no_memory(e);
    }
    *out = report;
    return STATUS_OK;
}

void report_free(struct report *r) {
    if (r) {
        arena_free(r->arena);
    }
}

// Does a force on an end act on the floor?
static bool acts_on(int floor, int end_floor, int below) {
    return floor == end_floor || floor == below;
}

const char report_hit_note[] = "* this floor was hit: its peak depends on the contact stiffness";
const char report_hit_name[] = "floor that was hit";

bool report_link_joins(const struct report_link *c, const char *building, int floor) {
    return (acts_on(floor, c->left_floor, c->left_below) && strcmp(c->left, building) == 0) ||
           (acts_on(floor, c->right_floor, c->right_below) && strcmp(c->right, building) == 0);
}

bool report_floor_was_hit(const struct report *r, const char *building, int floor) {
    bool hit = false;
    for (int i = 0; i < r->n_contact && !hit; i++) {
        const struct report_link *c = &r->contact[i];
        hit = c->peak.force > 0.0 && report_link_joins(c, building, floor);
    }
    return hit;
}
