// SPDX-License-Identifier: GPL-3.0-or-later
// Khatami's law: F = k d^(3/2) (1 + f) while v > 0, F = k d^(3/2) afterwards, f = alpha e^beta v0
// (1 - e), as published.
//
// The published f has the dimension of a velocity. jostle takes alpha in s/m, so that decks in
// other units give the same force. f is so small that the law dissipates almost nothing: at 0.5 m/s
// an e of 0.65 gives 0.9988. f = (1 - e^2) / e^2 delivers e: use -calibrate or -zeta. The force
// jumps at v = 0.
#include <math.h>

#include "law/lists.h"
#include "law/power.h"
#include "law/restitution.h"

enum { K, E, ZETA, ALPHA, BETA, N_ROW };
enum { STIFFNESS, FIXED, PER_VELOCITY, N_CONSTANT };  // f = FIXED + PER_VELOCITY v0
enum { FACTOR, N_HISTORY };                           // 1 + f

static const struct row rows[N_ROW] = {
    [K] = {"k", ROW_NUMBER, ROW_REQUIRED, OF_HERTZ_STIFFNESS, &range_positive, NAN,
           "impact stiffness"},
    [E] = RESTITUTION_ROW,
    [ZETA] = {"zeta", ROW_NUMBER, ROW_ONE_OF, OF_NONE, &range_non_negative, NAN,
              "f itself, instead of -e"},
    [ALPHA] = {"alpha", ROW_NUMBER, 0, OF_PER_VELOCITY, &range_non_negative, 0.01557,
               "factor of v0, with -e"},
    [BETA] = {"beta", ROW_NUMBER, 0, OF_NONE, NULL, 0.2706, "exponent of e, with -e"},
};

static int khatami_prepare(const double *value, double m_eff, double *constant, struct error *e) {
    (void)m_eff, (void)e;
    bool printed = !isnan(value[E]);
    constant[STIFFNESS] = value[K];
    constant[FIXED] = printed ? 0.0 : value[ZETA];
    constant[PER_VELOCITY] =
        printed ? value[ALPHA] * pow(value[E], value[BETA]) * (1.0 - value[E]) : 0.0;
    return STATUS_OK;
}

static void khatami_close(const double *c, double v0, double *history) {
    history[FACTOR] = 1.0 + c[FIXED] + c[PER_VELOCITY] * v0;
}

static struct contact_response khatami_force(const double *c, const double *h, double d, double v) {
    return power_spring(v > 0.0 ? c[STIFFNESS] * h[FACTOR] : c[STIFFNESS], 1.5, d);
}

static double exact_factor(double e) {
    return (1.0 - e) * (1.0 + e) / (e * e);
}

const struct contact_law contact_khatami = {
    .name = "khatami",
    .summary = "Hertz, stiffer during approach",
    .formula = "F = k d^1.5 (1 + f) while v > 0, k d^1.5 after; f = alpha e^beta v0 (1 - e)",
    .source = "Naderpour, Barros & Khatami (2015), Scientia Iranica 22, 59-68; force as printed in "
              "reviews of impact models",
    .remarks = "Use it for comparison only. As printed it loses almost no energy: it delivers "
               "0.9988 for an e of 0.65 at 0.5 m/s. -calibrate delivers e. The force jumps at the "
               "end of the approach.",
    .example = "-k 2.75e9N/m^1.5 -e 0.65",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = N_CONSTANT,
    .n_history = N_HISTORY,
    .traits = CONTACT_NEEDS_V0 | CONTACT_SMOOTH,
    .prepare = khatami_prepare,
    .close = khatami_close,
    .force = khatami_force,
    .exact = exact_factor,
};
