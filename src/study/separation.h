// SPDX-License-Identifier: GPL-3.0-or-later
// Separations of two buildings from their largest displacements, as building codes and the
// literature combine them.
#ifndef JOSTLE_SEPARATION_H
#define JOSTLE_SEPARATION_H

// What is known of the two sides where they face each other. Of a wall the displacement is 0.
struct separation_ends {
    double displacement[2];  // [L] the largest absolute ones: left, right
    double period[2];        // [T] of the first modes; infinite: a free body
    double damping[2];       // ratios of the first modes
};

struct separation_rule {
    const char *key;      // in a table separated by tabs
    const char *name;     // in a table to be read
    const char *formula;  // of uA, uB and rho
    const char *source;
    double (*separation)(double u_left, double u_right, double rho);  // [L]
};

enum { SEPARATION_RULES = 4 };
extern const struct separation_rule separation_rules[SEPARATION_RULES];

// Correlation coefficient of the responses of two oscillators to the same white noise; NAN where a
// period is infinite, or damping negative.
double separation_correlation(const double period[2], const double damping[2]);

// By one of the rules. NAN where it needs a correlation that does not exist.
double separation_by(const struct separation_rule *rule, const struct separation_ends *ends);

#endif
