// SPDX-License-Identifier: GPL-3.0-or-later
// Plane frames and walls: members between joints that turn and rise, condensed to storey drifts.
//
// Floors are axially rigid. A column is sheared by the drift of its storey only, so a frame is a
// part on drifts (jostle/part.h). With K theta theta of the unknown turns and rises of its joints
// at rest floors, and the columns k_j of the coupling to drift j, joints move by x_j = -K^-1 k_j
// for a unit drift j, and D_ij is the shear of storey i then. The rotations of hinges at the ends
// of members are actions as drifts are (model/hinges.h).
//
// Signs: moments on the ends of members and turns of joints are counterclockwise positive. End i is
// the lower end of a column, the left end of a beam. The shear is (M_i + M_j) / length: of a
// column, the force to the right on its upper end; of a beam, the upward force on its left end. A
// normal force is positive in tension.
#ifndef JOSTLE_FRAME_H
#define JOSTLE_FRAME_H

#include "core/arena.h"
#include "jostle/error.h"
#include "jostle/part.h"

enum frame_kind { FRAME_COLUMN, FRAME_BEAM, FRAME_WALL };

// A joint of a line with a floor, or with the ground.
struct frame_joint {
    bool turns;     // a member ends there, and the joint is not clamped
    double spring;  // [F L] stiffness of a base against its turning; else 0
    int turn;       // the number of its turn among the unknowns; -1: none
    int rise;       // of its rise; that of the joint below where the column does not stretch
};

// A beam-column. With a and b, the turns of its ends from its chord,
//     M_i = bend (a - b) + sway (a + b),  M_j = -bend (a - b) + sway (a + b).
struct frame_member {
    enum frame_kind kind;
    int level, number;  // storey of a column, floor of a beam; line or bay; from 1
    int joint[2];       // of end i and of end j
    double length;      // [L]
    double bend;        // [F L] E I / L
    double sway;        // [F L] 3 / (L (1 / (E I) + 12 / (G A L^2)))
    double axial;       // [F/L] E A / L; 0: it does not stretch
    int hinge[2];       // the number of the hinge at end i and at end j; -1: none
};

// A point of a column that a force pushes to the right.
struct frame_point {
    int member;
    double share;  // of the length, from the lower end
};

struct hinges;

// The uncondensed frame, and what it is condensed to. Actions are the drifts of all storeys, then
// the rotations of all hinges: what an end of a member turns more than its joint.
struct plane_frame {
    int n_floor, n_line;
    int n_joint;  // (n_floor + 1) n_line, level by level from the ground
    int n_member;
    struct frame_joint *joint;    // (n_joint)
    struct frame_member *member;  // (n_member) level by level, columns before beams
    int n_hinge, n_action;        // n_floor + n_hinge
    const struct hinges *hinges;  // their laws (model/hinges.h); NULL: there are none
    int n_unknown;
    double *stiffness;  // [F/L] [F] [F L] (n_action, n_action) storey shears and moments on ends
                        // with hinges, by unit actions; symmetric to the bit
    int n_point;
    struct frame_point *point;  // (n_point)
    double *force;  // (n_member, FRAME_FORCES, n_action + n_point) forces of members by unit
                    // actions, then by unit forces at the points while floors are at rest
};

// The forces of a member.
enum frame_force { FRAME_MOMENT_I, FRAME_MOMENT_J, FRAME_SHEAR, FRAME_NORMAL, FRAME_FORCES };

// What is known of a member of a building with hinges besides: the rotations of its hinges, and
// what they would be if the moment vanished along the initial stiffness.
enum {
    FRAME_ROTATION_I = FRAME_FORCES,
    FRAME_ROTATION_J,
    FRAME_PLASTIC_I,
    FRAME_PLASTIC_J,
    FRAME_QUANTITIES
};

// A member with bending stiffness `ei` [F L^2]; infinite `ga` [F]: without shear deformation; `ea`
// [F] 0: it does not stretch.
struct frame_member frame_member(enum frame_kind kind, int level, int number, double length,
                                 double ei, double ga, double ea);

// Does the member have this force (enum frame_force), or this rotation? Beams and walls have no
// normal force, as floors are rigid.
bool frame_has(const struct frame_member *m, int force);

// Joins the members to joints, numbers the unknowns and condenses the frame. The caller has set the
// numbers of floors, lines, members and hinges, and the members without their joints; and of the
// joints at the ground `turns` and `spring`. STATUS_INPUT: some joint is held by nothing, or a
// stiffness is not finite; STATUS_SYSTEM: no memory.
int frame_condense(struct plane_frame *f, struct arena *a, struct error *e);

// The columns of the forces of the frame.
static inline int frame_n_load(const struct plane_frame *f) {
    return f->n_action + f->n_point;
}

// How far a point moves to the right against the floor below it, by a unit drift of storey `storey`
// (from 0), and by a unit force on it while floors are at rest. Joints and the point itself turn
// freely. The shear of the member is that of its end moments: what is beside the point has the
// reaction of a hinged member more.
double frame_point_by_drift(const struct plane_frame *f, int point, int storey);
double frame_point_by_force(const struct plane_frame *f, int point);

// "column_2_3": storey 2, third line.
const char *frame_member_name(const struct frame_member *m, struct arena *a);

// The frame of a part that is one; NULL: it is none.
const struct plane_frame *frame_of(const struct part *p);

// Frames with hinges: whose laws are smooth, and of straight lines.
extern const struct part_kind frame_part, frame_wall, hinges_part, hinges_straight_part;

#endif
