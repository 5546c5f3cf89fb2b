// SPDX-License-Identifier: GPL-3.0-or-later
// Newton's impact of rigid bodies. There is no force: the velocities jump at the instant of
// closure. The bodies separate with e times their approach velocity, and the momentum does not
// change:
//     v1' = v1 - (1 + e) m2 (v1 - v2) / (m1 + m2),
//     v2' = v2 + (1 + e) m1 (v1 - v2) / (m1 + m2).
// One paper prints the relative momentum in place of the relative velocity.
//
// src/solve/event/impulse.c treats impacts of several contacts at one instant, and bounces that are
// too short to follow.
#include "law/lists.h"

enum { E, N_ROW };

static const struct range restitution = {.min = 0.0, .max = 1.0, .text = ">= 0 and <= 1"};

static const struct row rows[N_ROW] = {
    [E] = {"e", ROW_NUMBER, ROW_REQUIRED, OF_NONE, &restitution, NAN, "coefficient of restitution"},
};

static int stereomechanical_prepare(const double *value, double m_eff, double *constant,
                                    struct error *e) {
    (void)m_eff, (void)e;
    constant[E] = value[E];
    return STATUS_OK;
}

static double stereomechanical_rebound(const double *c, double v) {
    return c[E] * v;
}

const struct contact_law contact_stereomechanical = {
    .name = "stereomechanical",
    .summary = "rigid impact: velocities jump at closure",
    .formula = "v1' = v1 - (1 + e) m2 (v1 - v2) / (m1 + m2), v2' = v2 + (1 + e) m1 (v1 - v2) / "
               "(m1 + m2)",
    .source =
        "Newton's law of impact; Goldsmith (1960), Impact, chapter 2; for buildings Conoscente, "
        "Hamburger & Johnson (1992), 10WCEE, 3765-3768",
    .remarks = "It delivers e exactly and needs no stiffness. The result has no contact force, no "
               "duration and no acceleration during impact.",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = N_ROW,
    .traits = CONTACT_EXACT,
    .prepare = stereomechanical_prepare,
    .rebound = stereomechanical_rebound,
};
