// SPDX-License-Identifier: GPL-3.0-or-later
// Horizontal elastic spectra of EN 1998-1:2004, ASCE/SEI 7-16 and NZS 1170.5:2004.
//
// EN 1998-1:2004, 3.2.2.2, equations (3.2) to (3.6), with the recommended values of tables 3.2 and
// 3.3, which a National Annex may replace:
//     Se = ag S (1 + T/TB (2.5 eta - 1))    T <= TB      eta = sqrt(10 / (5 + xi)) >= 0.55,
//     Se = ag S 2.5 eta                     T <= TC      xi the damping ratio in %
//     Se = ag S 2.5 eta TC/T                T <= TD
//     Se = ag S 2.5 eta TC TD/T^2           T <= 4 s
//
// ASCE/SEI 7-16, 11.4.6, equations (11.4-5) to (11.4-7), the two-period spectrum, for 5 % damping,
// with T0 = 0.2 SD1/SDS and TS = SD1/SDS:
//     Sa = SDS (0.4 + 0.6 T/T0)    T < T0         Sa = SD1/T           T <= TL
//     Sa = SDS                     T <= TS        Sa = SD1 TL/T^2      beyond
//
// NZS 1170.5:2004, 3.1.1: C(T) = Ch(T) Z R N(T,D) in units of g for 5 % damping, Z R <= 0.7. Ch is
// that of modal analysis and of histories (table 3.1), by the equations of its commentary, N that
// of 3.1.6. Where two of these equations meet, they differ by up to 0.4 %. Between plateau and
// power the smaller value is used, so that no step is left there; the step of up to 0.3 % at 1.5 s
// is that of the equations.
//
// The standards were not at hand. Tables and equations are those of public programs and pages:
// S, TB, TC and TD of EN 1998-1 from three programs, of which two had an error in one row each;
// Ch from two programs with equations, and the 18 printed periods of table 3.1 from a third one. Of
// class E beyond 3 s, one program has 9.66, which leaves a step of 3 % and differs from table 3.1.
// The other one has 9.96, which does not.
#include <math.h>

#include "motion/target_code.h"

#define G 9.80665  // [m/s^2]

// Letters of ground types and subsoil classes, by their numbers.
static const char *const letters[] = {"A", "B", "C", "D", "E", NULL};
static const struct range letter_range = {0.0, 4.0, false, false, "A, B, C, D or E", letters};

enum { EN_TYPE, EN_GROUND, EN_AG, EN_ETA, EN_S, EN_TB, EN_TC, EN_TD, N_EN };

static const char *const en_types[] = {"1", "2", NULL};
static const struct range en_type_range = {0.0, 1.0, false, false, "1 or 2", en_types};

static const struct target_row en_rows[N_EN] = {
    [EN_TYPE] = {{"type", ROW_CHOICE, 0, OF_NONE, &en_type_range, 0.0,
                  "type of spectrum (2 if earthquakes of magnitude Ms <= 5.5 govern)"},
                 0.0},
    [EN_GROUND] = {{"ground", ROW_CHOICE, ROW_REQUIRED, OF_NONE, &letter_range, NAN, "ground type"},
                   0.0},
    [EN_AG] = {{"ag", ROW_NUMBER, ROW_REQUIRED, OF_ACCELERATION, &range_positive, NAN,
                "design ground acceleration on ground A, with its unit"},
               0.0},
    [EN_ETA] = {{"eta", ROW_NUMBER, 0, OF_NONE, &range_positive, NAN,
                 "damping correction; default: sqrt(10 / (5 + xi)) >= 0.55, with xi = --damping in "
                 "%"},
                1.0},
    [EN_S] = {{"S", ROW_NUMBER, 0, OF_NONE, &range_positive, NAN,
               "soil factor of a National Annex, in place of table 3.2 or 3.3"},
              1.0},
    [EN_TB] = {{"TB", ROW_NUMBER, 0, OF_TIME, &range_positive, NAN,
                "period in s where the plateau begins, likewise"},
               1.0},
    [EN_TC] = {{"TC", ROW_NUMBER, 0, OF_TIME, &range_positive, NAN, "period where it ends"}, 1.0},
    [EN_TD] = {{"TD", ROW_NUMBER, 0, OF_TIME, &range_positive, NAN,
                "period where the constant displacement begins"},
               1.0},
};

static const char *en_settle(double *value, double damping) {
    // Tables 3.2 and 3.3: S, TB, TC, TD.
    static const double table[2][5][4] = {{{1.0, 0.15, 0.4, 2.0},
                                           {1.2, 0.15, 0.5, 2.0},
                                           {1.15, 0.2, 0.6, 2.0},
                                           {1.35, 0.2, 0.8, 2.0},
                                           {1.4, 0.15, 0.5, 2.0}},
                                          {{1.0, 0.05, 0.25, 1.2},
                                           {1.35, 0.05, 0.25, 1.2},
                                           {1.5, 0.1, 0.25, 1.2},
                                           {1.8, 0.1, 0.3, 1.2},
                                           {1.6, 0.05, 0.25, 1.2}}};
    const double *of_ground = table[(int)value[EN_TYPE]][(int)value[EN_GROUND]];
    for (int i = EN_S; i <= EN_TD; i++) {
        value[i] = isnan(value[i]) ? of_ground[i - EN_S] : value[i];
    }
    if (isnan(value[EN_ETA])) {
        value[EN_ETA] = fmax(sqrt(10.0 / (5.0 + 100.0 * damping)), 0.55);
    }
    return value[EN_TB] <= value[EN_TC] && value[EN_TC] <= value[EN_TD]
               ? NULL
               : "TB, TC and TD must not descend";
}

static double en_at(const double *value, double period) {
    const double least = value[EN_AG] * value[EN_S], plateau = 2.5 * value[EN_ETA] * least;
    const double TB = value[EN_TB], TC = value[EN_TC], TD = value[EN_TD];
    return period < TB    ? least + (plateau - least) * period / TB
           : period <= TC ? plateau
           : period <= TD ? plateau * TC / period
                          : plateau * TC * TD / (period * period);
}

static const struct target_code en1998 = {
    .name = "en1998",
    .title = "elastic spectrum of EN 1998-1:2004, 3.2.2.2, to 4 s",
    .example = "en1998:ground=C,ag=0.25g",
    .row = en_rows,
    .n = N_EN,
    .last = 4.0,
    .damped = true,
    .settle = en_settle,
    .at = en_at,
};

enum { ASCE_SDS, ASCE_SD1, ASCE_TL, N_ASCE };

static const struct target_row asce_rows[N_ASCE] = {
    [ASCE_SDS] = {{"SDS", ROW_NUMBER, ROW_REQUIRED, OF_ACCELERATION, &range_positive, NAN,
                   "design acceleration at short periods, in g without a unit"},
                  G},
    [ASCE_SD1] = {{"SD1", ROW_NUMBER, ROW_REQUIRED, OF_ACCELERATION, &range_positive, NAN,
                   "design acceleration at 1 s, in g without a unit"},
                  G},
    [ASCE_TL] = {{"TL", ROW_NUMBER, ROW_REQUIRED, OF_TIME, &range_positive, NAN,
                  "long-period transition period, in s without a unit"},
                 1.0},
};

static const char *asce_settle(double *value, double damping) {
    (void)damping;
    return value[ASCE_SD1] <= value[ASCE_SDS] * value[ASCE_TL]
               ? NULL
               : "TL must not be below TS = SD1/SDS";
}

static double asce_at(const double *value, double period) {
    const double SDS = value[ASCE_SDS], SD1 = value[ASCE_SD1], TL = value[ASCE_TL];
    const double TS = SD1 / SDS, T0 = 0.2 * TS;  // [s]: SD1 is the acceleration at 1 s
    return period < T0    ? SDS * (0.4 + 0.6 * period / T0)
           : period <= TS ? SDS
           : period <= TL ? SD1 / period
                          : SD1 * TL / (period * period);
}

static const struct target_code asce7 = {
    .name = "asce7",
    .title = "design spectrum of ASCE/SEI 7-16, 11.4.6",
    .example = "asce7:SDS=1.0,SD1=0.6,TL=8",
    .row = asce_rows,
    .n = N_ASCE,
    .last = 10.0,
    .settle = asce_settle,
    .at = asce_at,
};

enum { NZS_CLASS, NZS_Z, NZS_R, NZS_D, N_NZS };

static const struct target_row nzs_rows[N_NZS] = {
    [NZS_CLASS] = {{"class", ROW_CHOICE, ROW_REQUIRED, OF_NONE, &letter_range, NAN,
                    "site subsoil class"},
                   0.0},
    [NZS_Z] = {{"Z", ROW_NUMBER, ROW_REQUIRED, OF_NONE, &range_positive, NAN,
                "hazard factor; Z R counts as 0.7 where it is more"},
               1.0},
    [NZS_R] = {{"R", ROW_NUMBER, 0, OF_NONE, &range_positive, 1.0, "return period factor"}, 1.0},
    [NZS_D] = {{"D", ROW_NUMBER, 0, OF_LENGTH, &range_non_negative, NAN,
                "distance to the nearest major fault, in km without a unit; default: none is near"},
               1e3},
};

static const char *nzs_settle(double *value, double damping) {
    (void)damping;
    value[NZS_D] = isnan(value[NZS_D]) ? INFINITY : value[NZS_D];
    return NULL;
}

// Table 3.7 and 3.1.6.2; without effect where the annual probability of exceedance is 1/250 or
// more, which is R <= 0.75.
static double nzs_near_fault(double period, double distance, double R) {
    static const double near = 2e3, far = 20e3;  // [m]
    const double most = period <= 1.5   ? 1.0
                        : period <= 4.0 ? 1.0 + 0.24 * (period - 1.5)
                        : period <= 5.0 ? 1.6 + 0.12 * (period - 4.0)
                                        : 1.72;
    const double share = distance <= near  ? 1.0
                         : distance <= far ? (far - distance) / (far - near)
                                           : 0.0;
    return R <= 0.75 ? 1.0 : 1.0 + (most - 1.0) * share;
}

static double nzs_shape(int class, double period) {
    // Ch at 0 s, the plateau, a point of the branch T^(-3/4), and v of v/T and 3 v/T^2.
    static const struct {
        double first, plateau, at, period, v;  // `at`: Ch at `period` [s]
    } table[5] = {{1.0, 2.35, 1.6, 0.5, 1.05},
                  {1.0, 2.35, 1.6, 0.5, 1.05},
                  {1.33, 2.93, 2.0, 0.5, 1.32},
                  {1.12, 3.0, 2.4, 0.75, 2.14},
                  {1.12, 3.0, 3.0, 1.0, 3.32}};
    const double first = table[class].first, plateau = table[class].plateau;
    return period < 0.1 ? first + (plateau - first) * period / 0.1
           : period <= 1.5
               ? fmin(plateau, table[class].at * pow(table[class].period / period, 0.75))
           : period <= 3.0 ? table[class].v / period
                           : 3.0 * table[class].v / (period * period);
}

static double nzs_at(const double *value, double period) {
    return nzs_shape((int)value[NZS_CLASS], period) * fmin(value[NZS_Z] * value[NZS_R], 0.7) *
           nzs_near_fault(period, value[NZS_D], value[NZS_R]) * G;
}

static const struct target_code nzs1170 = {
    .name = "nzs1170",
    .title = "elastic site spectrum of NZS 1170.5:2004, 3.1.1",
    .example = "nzs1170:class=C,Z=0.4",
    .row = nzs_rows,
    .n = N_NZS,
    .last = 10.0,
    .settle = nzs_settle,
    .at = nzs_at,
};

const struct target_code *const target_codes[] = {&en1998, &asce7, &nzs1170};
const int n_target_code = sizeof target_codes / sizeof target_codes[0];
