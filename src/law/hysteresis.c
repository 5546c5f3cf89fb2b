// SPDX-License-Identifier: GPL-3.0-or-later
#include "law/hysteresis.h"

#include <math.h>

#include "law/power.h"
#include "law/restitution.h"

enum { STIFFNESS, EXPONENT, Q, LEAST_V0 };
enum { DAMPING };  // q / v0 [T/L]

const struct row hysteresis_rows[HYSTERESIS_ROWS] = {
    [HYSTERESIS_K] = POWER_STIFFNESS_ROW("impact stiffness"),
    [HYSTERESIS_E] = RESTITUTION_ROW,
    [HYSTERESIS_ZETA] = HYSTERESIS_ZETA_ROW,
    [HYSTERESIS_VMIN] = HYSTERESIS_VMIN_ROW,
    [HYSTERESIS_N] = {"n", ROW_NUMBER, ROW_POWER, OF_NONE, &power_range, 1.5, "exponent"},
};

int hysteresis_prepare(const double *value, double (*relation)(double e), double *constant,
                       struct error *e) {
    constant[STIFFNESS] = value[HYSTERESIS_K];
    constant[EXPONENT] = value[HYSTERESIS_N];
    constant[Q] = restitution_ratio(value[HYSTERESIS_E], value[HYSTERESIS_ZETA], relation);
    constant[LEAST_V0] = value[HYSTERESIS_VMIN];
    return isnan(constant[Q]) ? error_no_memory(e) : STATUS_OK;
}

void hysteresis_close(const double *constant, double v0, double *history) {
    history[DAMPING] = constant[Q] / fmax(v0, constant[LEAST_V0]);
}

struct contact_response hysteresis_force(const double *constant, const double *history, double d,
                                         double v) {
    struct contact_response spring = power_spring(constant[STIFFNESS], constant[EXPONENT], d);
    double factor = 1.0 + history[DAMPING] * v;
    return (struct contact_response){
        .force = spring.force * factor,
        .dfdd = spring.dfdd * factor,
        .dfdv = spring.force * history[DAMPING],
    };
}
