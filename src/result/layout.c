// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of layout.h.
#include "result/layout.h"

static const struct column root_column[] = {
    {.name = "title", .kind = COLUMN_TEXT, .offset = offsetof(struct report, title)},
    {.name = "program", .kind = COLUMN_TEXT, .offset = offsetof(struct report, program)},
    {.name = "version", .kind = COLUMN_TEXT, .offset = offsetof(struct report, version)},
    {.name = "created", .kind = COLUMN_TEXT, .offset = offsetof(struct report, created)},
    {.name = "deck_file", .kind = COLUMN_TEXT, .offset = offsetof(struct report, deck_file)},
    {.name = "deck", .kind = COLUMN_TEXT, .offset = offsetof(struct report, deck)},
    {.name = "includes", .kind = COLUMN_TEXT, .offset = offsetof(struct report, includes)},
    {.name = "parameters", .kind = COLUMN_TEXT, .offset = offsetof(struct report, parameters)},
    {.name = "command_line", .kind = COLUMN_TEXT, .offset = offsetof(struct report, command_line)},
    {.name = "duration", .kind = COLUMN_DOUBLE, .offset = offsetof(struct report, duration)},
    {.name = "step", .kind = COLUMN_DOUBLE, .offset = offsetof(struct report, dt)},
    {.name = "unit_force_in_N",
     .kind = COLUMN_DOUBLE,
     .offset = offsetof(struct report, units.force)},
    {.name = "unit_length_in_m",
     .kind = COLUMN_DOUBLE,
     .offset = offsetof(struct report, units.length)},
    {.name = "unit_time_in_s",
     .kind = COLUMN_DOUBLE,
     .offset = offsetof(struct report, units.time)},
    {.name = "gravity_in_m_per_s2",
     .kind = COLUMN_DOUBLE,
     .offset = offsetof(struct report, units.gravity)},
};
const struct column_table layout_root = {root_column, sizeof root_column / sizeof root_column[0],
                                         sizeof(struct report)};

static const struct column totals_column[] = {
    {.name = "steps",
     .long_name = "computed steps, split ones and shorter ones after a rejection included",
     .kind = COLUMN_LONG,
     .offset = offsetof(struct totals, steps)},
    {.name = "newton_iterations",
     .long_name = "iterations on contact and storey forces",
     .kind = COLUMN_LONG,
     .offset = offsetof(struct totals, iterations)},
    {.name = "wall_seconds", .kind = COLUMN_DOUBLE, .offset = offsetof(struct totals, seconds)},
    {.name = "steps_split",
     .long_name = "steps split where a force jumps",
     .kind = COLUMN_LONG,
     .offset = offsetof(struct totals, events)},
    {.name = "steps_cut",
     .long_name = "rejected steps",
     .kind = COLUMN_LONG,
     .offset = offsetof(struct totals, rejected)},
    {.name = "steps_unsolved",
     .long_name = "steps taken without meeting the tolerance",
     .kind = COLUMN_LONG,
     .offset = offsetof(struct totals, unsolved)},
    {.name = "contact_solves_fast",
     .long_name = "solves of the contacts by Newton sweeps",
     .kind = COLUMN_LONG,
     .offset = offsetof(struct totals, fast)},
    {.name = "contact_solves_scalar",
     .long_name = "solves by further sweeps of exact answers",
     .kind = COLUMN_LONG,
     .offset = offsetof(struct totals, scalar)},
    {.name = "contact_solves_block",
     .long_name = "solves with Newton steps on clusters",
     .kind = COLUMN_LONG,
     .offset = offsetof(struct totals, block)},
    {.name = "impacts_coarse",
     .long_name = "impacts of fewer than 10 computed steps",
     .kind = COLUMN_LONG,
     .offset = offsetof(struct totals, coarse)},
};
const struct column_table layout_totals = {
    totals_column, sizeof totals_column / sizeof totals_column[0], sizeof(struct totals)};

static const struct column link_column[] = {
    {"name", "name", NULL, COLUMN_TEXT, offsetof(struct report_link, name), 0},
    {"left", "building on the left, or wall", NULL, COLUMN_TEXT, offsetof(struct report_link, left),
     0},
    {"right", "building on the right, or wall", NULL, COLUMN_TEXT,
     offsetof(struct report_link, right), 0},
    {"law", "law of the force", NULL, COLUMN_TEXT, offsetof(struct report_link, law), 0},
    {"law_constants", "constants of the law in the deck's units", NULL, COLUMN_TEXT,
     offsetof(struct report_link, constants), 0},
    {"left_floor", "floor of the left building, 0 is the wall", NULL, COLUMN_INT,
     offsetof(struct report_link, left_floor), 0},
    {"right_floor", "floor of the right building, 0 is the wall", NULL, COLUMN_INT,
     offsetof(struct report_link, right_floor), 0},
    {"gap", "gap at rest", &dimension_length, COLUMN_DOUBLE, offsetof(struct report_link, gap), 0},
    {"effective_mass", "effective mass of the two bodies", &dimension_mass, COLUMN_DOUBLE,
     offsetof(struct report_link, mass), 0},
    {"restitution", "requested coefficient of restitution, NaN if none", NULL, COLUMN_DOUBLE,
     offsetof(struct report_link, restitution), 0},
    {"calibrated", "1: the damping delivers the restitution exactly, 0: as published", NULL,
     COLUMN_FLAG, offsetof(struct report_link, calibrated), 0},
};
const struct column_table layout_link = {link_column, sizeof link_column / sizeof link_column[0],
                                         sizeof(struct report_link)};

static const struct column level_column[] = {
    {"left_below", "floor below a level, 0 is the ground, else left_floor", NULL, COLUMN_INT,
     offsetof(struct report_link, left_below), 0},
    {"right_below", "floor below a level, 0 is the ground, else right_floor", NULL, COLUMN_INT,
     offsetof(struct report_link, right_below), 0},
    {"left_level", "level of the left end between two floors, NaN at a floor", &dimension_length,
     COLUMN_DOUBLE, offsetof(struct report_link, left_level), 0},
    {"left_weight", "weight of the left floor there, the floor below has the rest", NULL,
     COLUMN_DOUBLE, offsetof(struct report_link, left_weight), 0},
    {"right_level", "level of the right end between two floors, NaN at a floor", &dimension_length,
     COLUMN_DOUBLE, offsetof(struct report_link, right_level), 0},
    {"right_weight", "weight of the right floor there, the floor below has the rest", NULL,
     COLUMN_DOUBLE, offsetof(struct report_link, right_weight), 0},
};
const struct column_table layout_level = {
    level_column, sizeof level_column / sizeof level_column[0], sizeof(struct report_link)};

bool layout_has_levels(const struct report_link *link, int n) {
    bool any = false;
    for (int i = 0; i < n; i++) {
        any = any || link[i].left_below != link[i].left_floor ||
              link[i].right_below != link[i].right_floor;
    }
    return any;
}

static const struct column contact_column[] = {
    {"force", "largest contact force", &dimension_force, COLUMN_DOUBLE,
     offsetof(struct report_link, peak.force), 0},
    {"force_time", "time of the largest contact force", &dimension_time, COLUMN_DOUBLE,
     offsetof(struct report_link, peak.force_time), 0},
    {"penetration", "largest penetration, negative if never closed", &dimension_length,
     COLUMN_DOUBLE, offsetof(struct report_link, peak.penetration), 0},
    {"penetration_time", "time of the largest penetration", &dimension_time, COLUMN_DOUBLE,
     offsetof(struct report_link, peak.penetration_time), 0},
    {"impulse", "impulse of all impacts", &dimension_impulse, COLUMN_DOUBLE,
     offsetof(struct report_link, peak.impulse), 0},
    {"impacts", "number of impacts", NULL, COLUMN_LONG, offsetof(struct report_link, peak.impacts),
     0},
    {"dissipated", "energy dissipated in all impacts", &dimension_energy, COLUMN_DOUBLE,
     offsetof(struct report_link, peak.dissipated), 0},
};
const struct column_table layout_contact = {
    contact_column, sizeof contact_column / sizeof contact_column[0], sizeof(struct report_link)};

static const struct column link_peak_column[] = {
    {"force", "largest absolute force", &dimension_force, COLUMN_DOUBLE,
     offsetof(struct report_link, peak.force), 0},
    {"force_time", "time of the largest force", &dimension_time, COLUMN_DOUBLE,
     offsetof(struct report_link, peak.force_time), 0},
    {"deformation", "largest absolute change of length", &dimension_length, COLUMN_DOUBLE,
     offsetof(struct report_link, peak.penetration), 0},
    {"deformation_time", "time of the largest change of length", &dimension_time, COLUMN_DOUBLE,
     offsetof(struct report_link, peak.penetration_time), 0},
    {"work", "work done on the link, stored or dissipated", &dimension_energy, COLUMN_DOUBLE,
     offsetof(struct report_link, peak.dissipated), 0},
};
const struct column_table layout_link_peak = {link_peak_column,
                                              sizeof link_peak_column / sizeof link_peak_column[0],
                                              sizeof(struct report_link)};

static const struct column impact_column[] = {
    {"contact", "number of the contact, from 1", NULL, COLUMN_INT, offsetof(struct impact, contact),
     1},
    {"t_start", "time of closure", &dimension_time, COLUMN_DOUBLE, offsetof(struct impact, t_start),
     0},
    {"t_end", "time of opening, or of the end of the analysis", &dimension_time, COLUMN_DOUBLE,
     offsetof(struct impact, t_end), 0},
    {"v_approach", "closing velocity at closure", &dimension_velocity, COLUMN_DOUBLE,
     offsetof(struct impact, v_approach), 0},
    {"v_rebound", "opening velocity at t_end", &dimension_velocity, COLUMN_DOUBLE,
     offsetof(struct impact, v_rebound), 0},
    {"complete", "1: opened again, 0: still closed at the end", NULL, COLUMN_FLAG,
     offsetof(struct impact, complete), 0},
    {"peak_force", "largest contact force", &dimension_force, COLUMN_DOUBLE,
     offsetof(struct impact, peak_force), 0},
    {"max_penetration", "largest penetration", &dimension_length, COLUMN_DOUBLE,
     offsetof(struct impact, max_penetration), 0},
    {"impulse", "impulse", &dimension_impulse, COLUMN_DOUBLE, offsetof(struct impact, impulse), 0},
    {"dissipated", "energy dissipated", &dimension_energy, COLUMN_DOUBLE,
     offsetof(struct impact, dissipated), 0},
    {"steps", "computed steps in contact", NULL, COLUMN_LONG, offsetof(struct impact, steps), 0},
};
const struct column_table layout_impact = {
    impact_column, sizeof impact_column / sizeof impact_column[0], sizeof(struct impact)};

static const struct column building_column[] = {
    {"mass", "mass of the floors", &dimension_mass, COLUMN_DOUBLE,
     offsetof(struct report_building, mass), 0},
    {"stiffness", "initial stiffness of the storey below each floor", &dimension_stiffness,
     COLUMN_DOUBLE, offsetof(struct report_building, stiffness), 0},
    {"height", "height of the storey below each floor, 0 if not given", &dimension_length,
     COLUMN_DOUBLE, offsetof(struct report_building, height), 0},
    {"period", "periods of the building alone, elastic, longest first", &dimension_time,
     COLUMN_DOUBLE, offsetof(struct report_building, period), 0},
};
const struct column_table layout_building = {building_column,
                                             sizeof building_column / sizeof building_column[0],
                                             sizeof(struct report_building)};

const struct quantity layout_field[] = {
    {"displacement of the floors relative to the ground", &dimension_length},
    {"velocity of the floors relative to the ground", &dimension_velocity},
    {"total acceleration of the floors", &dimension_acceleration},
    {"drift of the storey below each floor", &dimension_length},
    {"restoring force of the storey below each floor", &dimension_force},
    {"contact force, positive in compression", &dimension_force},
    {"penetration, negative while apart", &dimension_length},
};

static const struct quantity link_field[] = {
    {"force of the link, positive in compression", &dimension_force},
    {"shortening of the link, negative when it is stretched", &dimension_length},
};

const struct quantity layout_peak[] = {
    [PEAK_DISPLACEMENT] = {"largest displacement relative to the ground", &dimension_length},
    [PEAK_VELOCITY] = {"largest velocity relative to the ground", &dimension_velocity},
    [PEAK_ACCELERATION] = {"largest total acceleration", &dimension_acceleration},
    [PEAK_DRIFT] = {"largest drift of the storey below each floor", &dimension_length},
    [PEAK_SHEAR] = {"largest restoring force of the storey below each floor", &dimension_force},
};

const struct quantity layout_residual_drift = {
    "absolute drift of the storey below each floor that remains when it unloads after the end",
    &dimension_length};
const char layout_residual_drift_name[] = "residual_drift";

const struct quantity layout_energy[] = {
    [ENERGY_INPUT] = {"work of the ground motion and the loads", &dimension_energy},
    [ENERGY_KINETIC] = {"kinetic energy relative to the ground", &dimension_energy},
    [ENERGY_STRAIN] = {"energy stored in the storeys", &dimension_energy},
    [ENERGY_DAMPING] = {"work of the buildings' damping", &dimension_energy},
    [ENERGY_HYSTERETIC] = {"energy dissipated by the storeys", &dimension_energy},
    [ENERGY_CONTACT] = {"work done on contacts and links", &dimension_energy},
    [ENERGY_RESIDUAL] = {"what the energy account misses", &dimension_energy},
};

const struct link_group layout_contacts = {"contacts",
                                           "contact",
                                           &layout_contact,
                                           {"force", "penetration"},
                                           layout_field + FLOOR_FIELD_COUNT};
const struct link_group layout_links = {
    "links", "link", &layout_link_peak, {"force", "deformation"}, link_field};

const void *layout_at(const struct column_table *t, int c, const void *base, size_t i) {
    return (const char *)base + i * t->size + t->column[c].offset;
}

void *layout_to(const struct column_table *t, int c, void *base, size_t i) {
    return (char *)base + i * t->size + t->column[c].offset;
}

long layout_whole(const struct column *c, const void *at) {
    switch (c->kind) {
        case COLUMN_LONG:
            return *(const long *)at + c->base;
        case COLUMN_INT:
            return *(const int *)at + (long)c->base;
        case COLUMN_FLAG:
            return *(const bool *)at ? 1 : 0;
        default:
            return 0;
    }
}
