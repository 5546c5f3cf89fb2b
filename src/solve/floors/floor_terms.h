// SPDX-License-Identifier: GPL-3.0-or-later
// The arithmetic of a step of Newmark's method at one floor i, written once for all ways of taking
// steps: newmark.c goes floor by floor, floor_step.h by vectors of floors or of runs. They agree to
// the bit because these are the same operations in the same order. They are macros because the
// types differ.
//     trial      u_t = u + (h v + h^2 a / 2),   v_t = v + h a
//     drift      d_i = u_i - u_(i-1),   shear  s_i = k_i d_i, or on a line s_i = back_i d_i + f_i
//                with f_i = spring_i (d_i - rest_i), which leaves the line where |f_i| > limit_i
//     residual   r_i = p_i - m_i a_i - (C v_t)_i - s_i + s_(i+1)
//     end        u = u_t + b q,   v = v_t + g q,   a = a + q,   where A q = r
//     (the solution of A q = r, tridiagonal: by L D L^T)
//     works      2 W_ground -= (a_g0 + a_g1) m_i (u1_i - u0_i),
//                2 W_damping += (u1_i - u0_i) (C (v0 + v1))_i
#ifndef JOSTLE_FLOOR_TERMS_H
#define JOSTLE_FLOOR_TERMS_H

// half is h^2 / 2.
#define TRIAL_U(u, v, a, h, half) ((u) + ((h) * (v) + (half) * (a)))
#define TRIAL_V(v, a, h) ((v) + (h) * (a))

#define LINE_FORCE(spring, rest, drift) ((spring) * ((drift) - (rest)))
#define LINE_SHEAR(back, drift, force) ((back) * (drift) + (force))

// Row i of C times the velocities of the floor below, its own, and that of the floor above.
#define BANDS(c_below, v_below, c, v, c_above, v_above)                                            \
    ((c_below) * (v_below) + (c) * (v) + (c_above) * (v_above))

// p - m a is p_ma.
#define RESIDUAL(p_ma, damping, shear, shear_above) ((p_ma) - (damping) - (shear) + (shear_above))

// The end of the step from its trial; factor is beta h^2 or gamma h.
#define END(trial, factor, q) ((trial) + (factor) * (q))

// Twice the work of a ground acceleration whose sum at both ends is ground_2x, and of damping.
#define WORK_OF_GROUND(ground_2x, mass, du) ((ground_2x) * ((mass) * (du)))
#define WORK_OF_DAMPING(du, bands) ((du) * (bands))

// The solution of A x = r by A = L D L^T. On the way up, r less what the floor below has left; on
// the way down, x from the one above. `factor` is the entry of L between those two floors, `pivot`
// the reciprocal of that of D.
#define FORWARD(r, factor, below) ((r) - (factor) * (below))
#define BACKWARD(left, pivot, factor, above) ((left) * (pivot) - (factor) * (above))

#endif
