// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of layout.h.
#include "result/layout.h"

#include <string.h>

// A row of a table of struct `type`.
#define ROW(type, name, kind, member, dimension, long_name)                                        \
    { name, long_name, dimension, COLUMN_##kind, offsetof(struct type, member), 0 }
#define TABLE(columns, type)                                                                       \
    { columns, sizeof(columns) / sizeof(columns)[0], sizeof(struct type) }

#define ROOT(name, kind, member) ROW(report, name, kind, member, NULL, NULL)
static const struct column root_column[] = {
    ROOT("title", TEXT, title),
    ROOT("program", TEXT, program),
    ROOT("version", TEXT, version),
    ROOT("created", TEXT, created),
    ROOT("deck_file", TEXT, deck_file),
    ROOT("deck", TEXT, deck),
    ROOT("includes", TEXT, includes),
    ROOT("parameters", TEXT, parameters),
    ROOT("command_line", TEXT, command_line),
    ROW(report, "duration", DOUBLE, duration, &dimension_time, "length of the analysis"),
    ROW(report, "step", DOUBLE, dt, &dimension_time, "time step"),
    ROOT("unit_force_in_N", DOUBLE, units.force),
    ROOT("unit_length_in_m", DOUBLE, units.length),
    ROOT("unit_time_in_s", DOUBLE, units.time),
    ROOT("gravity_in_m_per_s2", DOUBLE, units.gravity),
};
const struct column_table layout_root = TABLE(root_column, report);

#define TOTAL(name, member, long_name) ROW(report, name, LONG, totals.member, NULL, long_name)
static const struct column totals_column[] = {
    TOTAL("steps", steps, "computed steps, split ones and shorter ones after a rejection included"),
    TOTAL("newton_iterations", iterations, "iterations on contact and storey forces"),
    ROOT("wall_seconds", DOUBLE, totals.seconds),
    TOTAL("steps_split", events, "steps split where a force jumps"),
    TOTAL("steps_cut", rejected, "rejected steps"),
    TOTAL("steps_unsolved", unsolved, "steps taken without meeting the tolerance"),
    TOTAL("contact_solves_fast", fast, "solves of the contacts by Newton sweeps"),
    TOTAL("contact_solves_scalar", scalar, "solves by further sweeps of exact answers"),
    TOTAL("contact_solves_block", block, "solves with Newton steps on clusters"),
    TOTAL("impacts_coarse", coarse, "impacts of fewer than 10 computed steps"),
};
const struct column_table layout_totals = TABLE(totals_column, report);

static const struct column collapse_column[] = {
    ROW(report, "collapsed", LONG, collapse.happened, NULL,
        "1: a storey has reached its limit of drift and the run has ended there, 0: none has"),
    ROW(report, "collapse_time", DOUBLE, collapse.time, &dimension_time,
        "time of the collapse, 0 if there is none"),
    ROW(report, "collapse_building", TEXT, collapse.building, NULL, "building that has collapsed"),
    ROW(report, "collapse_storey", LONG, collapse.storey, NULL,
        "storey that has collapsed, 0 if none has"),
    ROW(report, "collapse_drift", DOUBLE, collapse.drift, &dimension_length,
        "its drift then, 0 if there is none"),
    TOTAL("steps_cut_indefinite", indefinite,
          "rejected steps whose matrix a negative stiffness made not positive definite"),
};
const struct column_table layout_collapse = TABLE(collapse_column, report);

// First those with a history, in the order of enum energy.
#define ENERGY(name, member, long_name)                                                            \
    ROW(report, name, DOUBLE, member, &dimension_energy, long_name)
static const struct column energy_column[] = {
    ENERGY("input", energy[ENERGY_INPUT], "work of the ground motion and the loads"),
    ENERGY("kinetic", energy[ENERGY_KINETIC], "kinetic energy relative to the ground"),
    ENERGY("strain", energy[ENERGY_STRAIN], "energy stored in the storeys"),
    ENERGY("damping", energy[ENERGY_DAMPING], "work of the buildings' damping"),
    ENERGY("hysteretic", energy[ENERGY_HYSTERETIC], "energy dissipated by the storeys"),
    ENERGY("contact", energy[ENERGY_CONTACT], "work done on contacts and links"),
    ENERGY("residual", energy[ENERGY_RESIDUAL], "what the energy account misses"),
    ENERGY("initial", initial_energy, "kinetic and strain energy at t = 0"),
    ENERGY("residual_peak", residual_peak, "largest absolute residual"),
};
const struct column_table layout_energy = TABLE(energy_column, report);

#define FLOORS(name, member, dimension, long_name)                                                 \
    ROW(report_building, name, ARRAY, member, dimension, long_name)
static const struct column building_column[] = {
    FLOORS("mass", mass, &dimension_mass, "mass of the floors"),
    FLOORS("stiffness", stiffness, &dimension_stiffness,
           "initial stiffness of the storey below each floor"),
    FLOORS("height", height, &dimension_length,
           "height of the storey below each floor, 0 if not given"),
    FLOORS("period", period, &dimension_time,
           "periods of the building alone, elastic, longest first"),
};
const struct column_table layout_building = TABLE(building_column, report_building);

static const struct column pdelta_column[] = {
    FLOORS("gravity_load", axial, &dimension_force,
           "gravity load that the storey below each floor carries, for P-delta"),
    FLOORS("stability_coefficient", theta, NULL,
           "gravity load times drift over shear times height of the storey, in the first mode"),
};
const struct column_table layout_pdelta = TABLE(pdelta_column, report_building);

// A peak and its time.
#define PEAK(name, number, dimension, long_name)                                                   \
    FLOORS(name, peak[number], dimension, long_name),                                              \
        FLOORS(name "_time", peak_time[number], &dimension_time, "time of the " long_name)
const char layout_residual_drift_name[] = "residual_drift";
static const struct column peak_column[] = {
    PEAK("displacement", PEAK_DISPLACEMENT, &dimension_length,
         "largest displacement relative to the ground"),
    PEAK("velocity", PEAK_VELOCITY, &dimension_velocity, "largest velocity relative to the ground"),
    PEAK("acceleration", PEAK_ACCELERATION, &dimension_acceleration, "largest total acceleration"),
    PEAK("drift", PEAK_DRIFT, &dimension_length, "largest drift of the storey below each floor"),
    PEAK("storey_shear", PEAK_SHEAR, &dimension_force,
         "largest restoring force of the storey below each floor"),
    FLOORS(layout_residual_drift_name, residual_drift, &dimension_length,
           "absolute drift of the storey below each floor that remains when it unloads after the "
           "end"),
    FLOORS("ductility", demand[YIELD_DUCTILITY], NULL,
           "largest drift of the storey below each floor over that at yield"),
    FLOORS("hysteretic", demand[YIELD_HYSTERETIC], &dimension_energy,
           "energy dissipated by the storey below each floor"),
    FLOORS("deterioration", demand[YIELD_DETERIORATION], NULL,
           "energy consumed over the least capacity of the storey below each floor"),
    FLOORS("damage", demand[YIELD_DAMAGE], NULL,
           "damage index of Park and Ang of the storey below each floor"),
};
const struct column_table layout_peak = TABLE(peak_column, report_building);

#define MEMBER(name, kind, member, dimension, long_name)                                           \
    ROW(report_member, name, kind, member, dimension, long_name)
static const struct column member_column[] = {MEMBER("name", TEXT, name, NULL, "name")};
const struct column_table layout_member = TABLE(member_column, report_member);

static const struct column member_peak_column[] = {
    MEMBER("moment", DOUBLE, moment, &dimension_energy, "largest absolute moment on either end"),
    MEMBER("shear", DOUBLE, shear, &dimension_force, "largest absolute shear"),
    MEMBER("axial", DOUBLE, axial, &dimension_force,
           "largest absolute normal force, NaN of beams and walls"),
    MEMBER("plastic_rotation", DOUBLE, plastic, NULL,
           "largest absolute plastic rotation of a hinge, 0 without hinges"),
    MEMBER("ductility", DOUBLE, demand.value[YIELD_DUCTILITY], NULL,
           "largest rotation of a hinge over its rotation at yield, 0 without hinges"),
    MEMBER("hysteretic", DOUBLE, demand.value[YIELD_HYSTERETIC], &dimension_energy,
           "energy dissipated by the hinges"),
    MEMBER("deterioration", DOUBLE, demand.value[YIELD_DETERIORATION], NULL,
           "energy consumed over the least capacity of a hinge"),
    MEMBER("damage", DOUBLE, demand.value[YIELD_DAMAGE], NULL, "damage index of a hinge"),
};
const struct column_table layout_member_peak[] = {
    {member_peak_column, MEMBER_PEAKS, sizeof(struct report_member)},
    TABLE(member_peak_column, report_member)};

#define EXTREME(name, number, dimension, long_name)                                                \
    MEMBER(name "_max", DOUBLE, extreme[number].max, dimension, "largest " long_name),             \
        MEMBER(name "_max_time", DOUBLE, extreme[number].max_time, &dimension_time,                \
               "time of the largest " long_name),                                                  \
        MEMBER(name "_min", DOUBLE, extreme[number].min, dimension, "smallest " long_name),        \
        MEMBER(name "_min_time", DOUBLE, extreme[number].min_time, &dimension_time,                \
               "time of the smallest " long_name)
static const struct column member_extreme_column[] = {
    EXTREME("M_i", MEMBER_M_I, &dimension_energy, "moment on the lower or left end"),
    EXTREME("M_j", MEMBER_M_J, &dimension_energy, "moment on the upper or right end"),
    EXTREME("V", MEMBER_V, &dimension_force, "shear"),
    EXTREME("N", MEMBER_N, &dimension_force, "normal force, tension positive"),
    EXTREME("rotation_i", MEMBER_ROTATION_I, NULL, "rotation of the hinge at end i, NaN without"),
    EXTREME("rotation_j", MEMBER_ROTATION_J, NULL, "rotation of the hinge at end j, NaN without"),
    EXTREME("plastic_rotation_i", MEMBER_PLASTIC_I, NULL,
            "plastic rotation of the hinge at end i, NaN without"),
    EXTREME("plastic_rotation_j", MEMBER_PLASTIC_J, NULL,
            "plastic rotation of the hinge at end j, NaN without"),
};
const struct column_table layout_member_extreme[] = {
    {member_extreme_column, MEMBER_EXTREMES, sizeof(struct report_member)},
    TABLE(member_extreme_column, report_member)};

const struct quantity layout_member_field[] = {
    {"moment on the lower or left end, counterclockwise positive", &dimension_energy},
    {"moment on the upper or right end, counterclockwise positive", &dimension_energy},
    {"shear, (M_i + M_j) / length", &dimension_force},
    {"normal force, tension positive, NaN of beams and walls", &dimension_force},
    {"rotation of the hinge at the lower or left end, NaN without", NULL},
    {"rotation of the hinge at the upper or right end, NaN without", NULL},
    {"plastic rotation of the hinge at the lower or left end, NaN without", NULL},
    {"plastic rotation of the hinge at the upper or right end, NaN without", NULL},
};

const struct quantity layout_share_field = {
    "share of the restoring force of the storey below each floor", &dimension_force};

#define SHARE(name, kind, member, dimension, long_name)                                            \
    ROW(report_share, name, kind, member, dimension, long_name)
static const struct column share_column[] = {SHARE("name", TEXT, name, NULL, "name")};
const struct column_table layout_share = TABLE(share_column, report_share);

static const struct column share_peak_column[] = {
    SHARE("storey_shear", ARRAY, shear, &dimension_force,
          "largest share of the restoring force of the storey below each floor"),
    SHARE("storey_shear_time", ARRAY, shear_time, &dimension_time,
          "time of the largest share of the restoring force of the storey below each floor"),
};
const struct column_table layout_share_peak = TABLE(share_peak_column, report_share);

#define FOUNDATION(name, number, dimension, long_name)                                             \
    ROW(report_foundation, name, DOUBLE, size[number], dimension, "largest " long_name),           \
        ROW(report_foundation, name "_time", DOUBLE, time[number], &dimension_time,                \
            "time of the largest " long_name)
static const struct column foundation_column[] = {
    FOUNDATION("sway", FOUNDATION_SWAY, &dimension_length, "sway of the foundation"),
    FOUNDATION("rocking", FOUNDATION_ROCKING, NULL, "rotation of the foundation"),
    FOUNDATION("sway_force", FOUNDATION_FORCE, &dimension_force, "sway spring force"),
    FOUNDATION("rocking_moment", FOUNDATION_MOMENT, &dimension_energy, "rocking spring moment"),
};
const struct column_table layout_foundation = TABLE(foundation_column, report_foundation);
const struct quantity layout_foundation_field[] = {
    {"displacement of the foundation relative to the ground", &dimension_length},
    {"rotation of the foundation, clockwise positive", NULL},
    {"force of the spring against sway, positive if it pushes to the left", &dimension_force},
    {"moment of the spring against rocking, positive counterclockwise", &dimension_energy},
};
#define LINK(name, kind, member, dimension, long_name)                                             \
    ROW(report_link, name, kind, member, dimension, long_name)
static const struct column link_column[] = {
    LINK("name", TEXT, name, NULL, "name"),
    LINK("left", TEXT, left, NULL, "building on the left, or wall"),
    LINK("right", TEXT, right, NULL, "building on the right, or wall"),
    LINK("law", TEXT, law, NULL, "law of the force"),
    LINK("law_constants", TEXT, constants, NULL, "constants of the law in the deck's units"),
    LINK("left_floor", INT, left_floor, NULL, "floor of the left building, 0 is the wall"),
    LINK("right_floor", INT, right_floor, NULL, "floor of the right building, 0 is the wall"),
    LINK("gap", DOUBLE, gap, &dimension_length, "gap at rest"),
    LINK("effective_mass", DOUBLE, mass, &dimension_mass, "effective mass of the two bodies"),
    LINK("restitution", DOUBLE, restitution, NULL,
         "requested coefficient of restitution, NaN if none"),
    LINK("calibrated", FLAG, calibrated, NULL,
         "1: the damping delivers the restitution exactly, 0: as published"),
};
const struct column_table layout_link = TABLE(link_column, report_link);

static const struct column level_column[] = {
    LINK("left_below", INT, left_below, NULL,
         "floor below a level, 0 is the ground, else left_floor"),
    LINK("right_below", INT, right_below, NULL,
         "floor below a level, 0 is the ground, else right_floor"),
    LINK("left_level", DOUBLE, left_level, &dimension_length,
         "level of the left end between two floors, NaN at a floor"),
    LINK("left_weight", DOUBLE, left_weight, NULL,
         "weight of the left floor there, the floor below has the rest"),
    LINK("right_level", DOUBLE, right_level, &dimension_length,
         "level of the right end between two floors, NaN at a floor"),
    LINK("right_weight", DOUBLE, right_weight, NULL,
         "weight of the right floor there, the floor below has the rest"),
};
const struct column_table layout_level = TABLE(level_column, report_link);

static const struct column contact_column[] = {
    LINK("force", DOUBLE, peak.force, &dimension_force, "largest contact force"),
    LINK("force_time", DOUBLE, peak.force_time, &dimension_time,
         "time of the largest contact force"),
    LINK("penetration", DOUBLE, peak.penetration, &dimension_length,
         "largest penetration, negative if never closed"),
    LINK("penetration_time", DOUBLE, peak.penetration_time, &dimension_time,
         "time of the largest penetration"),
    LINK("impulse", DOUBLE, peak.impulse, &dimension_impulse, "impulse of all impacts"),
    LINK("impacts", LONG, peak.impacts, NULL, "number of impacts"),
    LINK("dissipated", DOUBLE, peak.dissipated, &dimension_energy,
         "energy dissipated in all impacts"),
};
const struct column_table layout_contact = TABLE(contact_column, report_link);

static const struct column link_peak_column[] = {
    LINK("force", DOUBLE, peak.force, &dimension_force, "largest absolute force"),
    LINK("force_time", DOUBLE, peak.force_time, &dimension_time, "time of the largest force"),
    LINK("deformation", DOUBLE, peak.penetration, &dimension_length,
         "largest absolute change of length"),
    LINK("deformation_time", DOUBLE, peak.penetration_time, &dimension_time,
         "time of the largest change of length"),
    LINK("work", DOUBLE, peak.dissipated, &dimension_energy,
         "work done on the link, stored or dissipated"),
    LINK("dissipated", DOUBLE, peak.lost, &dimension_energy,
         "work that the link does not give back after the end"),
    LINK("residual_deformation", DOUBLE, peak.residual, &dimension_length,
         "absolute deformation that remains without force, slack left out"),
};
const struct column_table layout_link_peak = TABLE(link_peak_column, report_link);

#define EXTREMES(name, number, dimension, what)                                                    \
    LINK(name "_max", DOUBLE, column[number].max, dimension, "largest " what),                     \
        LINK(name "_max_time", DOUBLE, column[number].max_time, &dimension_time,                   \
             "time of the largest " what),                                                         \
        LINK(name "_min", DOUBLE, column[number].min, dimension, "smallest " what),                \
        LINK(name "_min_time", DOUBLE, column[number].min_time, &dimension_time,                   \
             "time of the smallest " what)
static const struct column column_column[] = {
    LINK("force", DOUBLE, peak.force, &dimension_force,
         "largest absolute force between the struck point and the floors"),
    LINK("force_time", DOUBLE, peak.force_time, &dimension_time, "time of the largest force"),
    LINK("deformation", DOUBLE, peak.penetration, &dimension_length,
         "largest absolute displacement of the struck point against the unloaded column"),
    LINK("deformation_time", DOUBLE, peak.penetration_time, &dimension_time,
         "time of the largest deformation"),
    LINK("shear", DOUBLE, shear, &dimension_force, "largest absolute shear in one column"),
    LINK("moment", DOUBLE, moment, &dimension_energy, "largest absolute moment in one column"),
    LINK("demand", DOUBLE, demand, NULL, "largest of both over its strength, NaN if none"),
    EXTREMES("shear_below", COLUMN_SHEAR_BELOW, &dimension_force, "shear below the struck point"),
    EXTREMES("shear_above", COLUMN_SHEAR_ABOVE, &dimension_force, "shear above the struck point"),
    EXTREMES("moment_below", COLUMN_MOMENT_BELOW, &dimension_energy, "moment at the floor below"),
    EXTREMES("moment_point", COLUMN_MOMENT_POINT, &dimension_energy,
             "moment at the struck point, on the part below"),
    EXTREMES("moment_above", COLUMN_MOMENT_ABOVE, &dimension_energy, "moment at the floor above"),
};
const struct column_table layout_column_peak = TABLE(column_column, report_link);

#define IMPACT(name, kind, member, dimension, long_name)                                           \
    ROW(impact, name, kind, member, dimension, long_name)
static const struct column impact_column[] = {
    {"contact", "number of the contact, from 1", NULL, COLUMN_INT, offsetof(struct impact, contact),
     1},
    IMPACT("t_start", DOUBLE, t_start, &dimension_time, "time of closure"),
    IMPACT("t_end", DOUBLE, t_end, &dimension_time,
           "time of opening, or of the end of the analysis"),
    IMPACT("v_approach", DOUBLE, v_approach, &dimension_velocity, "closing velocity at closure"),
    IMPACT("v_rebound", DOUBLE, v_rebound, &dimension_velocity, "opening velocity at t_end"),
    IMPACT("complete", FLAG, complete, NULL, "1: opened again, 0: still closed at the end"),
    IMPACT("peak_force", DOUBLE, peak_force, &dimension_force, "largest contact force"),
    IMPACT("max_penetration", DOUBLE, max_penetration, &dimension_length, "largest penetration"),
    IMPACT("impulse", DOUBLE, impulse, &dimension_impulse, "impulse"),
    IMPACT("dissipated", DOUBLE, dissipated, &dimension_energy, "energy dissipated"),
    IMPACT("steps", LONG, steps, NULL, "computed steps in contact"),
};
const struct column_table layout_impact = TABLE(impact_column, impact);

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
const struct link_group layout_contacts = {"contacts",
                                           "contact",
                                           &layout_contact,
                                           {"force", "penetration"},
                                           layout_field + FLOOR_FIELD_COUNT};
const struct link_group layout_links = {
    "links", "link", &layout_link_peak, {"force", "deformation"}, link_field};

const struct link_group layout_columns = {
    "columns", "column", &layout_column_peak, {"force", "deformation"}, link_field};

bool layout_has_levels(const struct report_link *link, int n) {
    bool any = false;
    for (int i = 0; i < n; i++) {
        any = any || link[i].left_below != link[i].left_floor ||
              link[i].right_below != link[i].right_floor;
    }
    return any;
}

bool layout_is_later(const struct column *c) {
    return strcmp(c->name, "ductility") == 0 || strcmp(c->name, "hysteretic") == 0 ||
           strcmp(c->name, "deterioration") == 0 || strcmp(c->name, "damage") == 0;
}

bool layout_is_shared(const struct column *c) {
    return !c->long_name && strcmp(c->name, "parameters") != 0 &&
           strcmp(c->name, "command_line") != 0;
}

bool layout_is_fixed(const struct column *c) {
    return c->kind == COLUMN_INT || (c->kind == COLUMN_TEXT && strncmp(c->name, "law", 3) != 0);
}

bool layout_is_value(const struct column *c) {
    return c->kind != COLUMN_TEXT && c->kind != COLUMN_INT;
}
