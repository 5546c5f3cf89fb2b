// SPDX-License-Identifier: GPL-3.0-or-later
// Of two linear buildings under the same stationary random ground motion, the variance of the
// relative displacement is s_A^2 + s_B^2 - 2 rho s_A s_B. With peaks in place of standard
// deviations, and first modes only, that is the double difference combination
//
//   s = sqrt(uA^2 + uB^2 - 2 rho uA uB)
//
//   rho = 8 sqrt(zA zB) (zA + r zB) r^(3/2)
//         / ((1 - r^2)^2 + 4 zA zB r (1 + r^2) + 4 (zA^2 + zB^2) r^2),   r = TA / TB = wB / wA
//
// Der Kiureghian (1980), Structural response to stationary excitation, J. Eng. Mech. Div. ASCE 106,
// 1195-1213: rho. Jeng, Kasai & Maison (1992), A spectral difference method to estimate building
// separations to avoid pounding, Earthquake Spectra 8, 201-223, and Penzien (1997), Evaluation of
// building separation distance required to prevent pounding during strong earthquakes, Earthquake
// Eng. Struct. Dyn. 26, 849-858: its use for pounding.
#include "study/contact_free.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics.h>
#include <math.h>
#include <stdlib.h>

#include "core/number.h"
#include "model/link_end.h"

static double absolute_sum(const struct separation_ends *e, double rho,
                           const struct separation_site *s) {
    (void)rho, (void)s;
    return e->displacement[0] + e->displacement[1];
}

static double root_of_squares(const struct separation_ends *e, double rho,
                              const struct separation_site *s) {
    (void)rho, (void)s;
    return hypot(e->displacement[0], e->displacement[1]);
}

static double reduced_root(const struct separation_ends *e, double rho,
                           const struct separation_site *s) {
    return 0.7 * root_of_squares(e, rho, s);
}

static double double_difference(const struct separation_ends *e, double rho,
                                const struct separation_site *s) {
    (void)s;
    const double left = e->displacement[0], right = e->displacement[1];
    const double square = left * left + right * right - 2.0 * rho * left * right;
    return square < 0.0 ? 0.0 : sqrt(square);  // rounding may leave a trace below 0; NAN stays
}

// Of the lower building, and never below 100 mm.
static double by_height(const struct separation_ends *e, double rho,
                        const struct separation_site *s) {
    (void)rho;
    if (!(s->gb_step > 0.0) || isnan(e->height[0]) || isnan(e->height[1])) {
        return NAN;
    }
    const double height = fmin(e->height[0], e->height[1]) / s->metre;
    const double frame = 0.1 + 0.02 * fmax(0.0, height - 15.0) / s->gb_step;
    return fmax(0.1, s->gb_share * frame) * s->metre;
}

// Each building keeps its part from the property line; a wall none.
static double by_level(const struct separation_ends *e, double rho,
                       const struct separation_site *s) {
    (void)rho;
    double sum = 0.0;
    for (int side = 0; side < 2; side++) {
        if (!isinf(e->height[side])) {
            const double part = e->displacement[side] + s->ntc_slope * e->level[side];
            sum += isnan(part) ? part : fmax(0.05 * s->metre, part);
        }
    }
    return sum;
}

const struct separation_rule contact_free_rules[SEPARATION_RULES] = {
    {"absolute_sum", "abs. sum", "uA + uB",
     "both set back from a property line: ASCE/SEI 7-16, 12.12.3; EN 1998-1:2004, 4.4.2.7(2)a",
     absolute_sum},
    {"srss", "SRSS", "sqrt(uA^2 + uB^2)",
     "on one property: ASCE/SEI 7-16, 12.12.3; EN 1998-1:2004, 4.4.2.7(2)b; NBCC 2015, 4.1.8.14",
     root_of_squares},
    {"srss_level", "0.7 SRSS", "0.7 sqrt(uA^2 + uB^2)",
     "the same if all floors are at the same levels: EN 1998-1:2004, 4.4.2.7(3)", reduced_root},
    {"double_difference", "double diff.", "sqrt(uA^2 + uB^2 - 2 rho uA uB)",
     "Jeng, Kasai & Maison (1992); Penzien (1997); rho: Der Kiureghian (1980)", double_difference},
    {"gb50011", "GB 50011", "share (100 mm + 20 mm (H - 15 m) / step), H the lower height",
     "reinforced concrete, at least 100 mm: GB 50011-2010, 6.1.4", by_height},
    {"ntc2004", "NTC 2004", "sum over A and B of max(50 mm, u + slope h), h the level",
     "Mexico City, NTC for seismic design (2004), 1.10", by_level},
};

double contact_free_correlation(const double period[2], const double damping[2]) {
    const double a = damping[0], b = damping[1];
    if (!isfinite(period[0]) || !isfinite(period[1])) {
        return NAN;
    }
    if (period[0] == period[1] && a == b) {
        return 1.0;  // of no damping as well, where the formula is 0 / 0
    }
    if (a < 0.0 || b < 0.0) {
        return NAN;  // such a response is never stationary
    }
    const double r = period[0] / period[1], square = r * r, away = 1.0 - square;
    return 8.0 * sqrt(a * b) * (a + r * b) * r * sqrt(r) /
           (away * away + 4.0 * a * b * r * (1.0 + square) + 4.0 * (a * a + b * b) * square);
}

double contact_free_separation(const struct separation_rule *rule,
                               const struct separation_ends *ends,
                               const struct separation_site *site) {
    const double rho = ends->displacement[0] > 0.0 && ends->displacement[1] > 0.0
                           ? contact_free_correlation(ends->period, ends->damping)
                           : 0.0;
    return rule->separation(ends, rho, site);
}

// The level of an end above the ground of its building, and the height of the building.
static void read_heights(const struct link *l, int side, const struct building *g, double *level,
                         double *height) {
    double sum = 0.0, at = NAN;
    for (int floor = 1; floor <= g->n_floor && g->height; floor++) {
        sum += g->height[floor - 1];
        at = floor == l->floor[side] ? sum : at;
    }
    *level = isnan(l->level[side]) ? at : l->level[side];
    *height = g->height ? sum : NAN;
}

static void read_contact(const struct model *m, const struct model *deck, const struct results *r,
                         int i, double *value) {
    const struct link *l = &m->link[i];
    for (int side = 0; side < 2; side++) {
        // Of the first mode of the building alone.
        double period = NAN, damping = NAN, level = NAN, height = INFINITY;
        if (l->building[side] != WALL) {
            const struct building *g = &m->building[l->building[side]];
            period = 2.0 * M_PI / g->omega[0];
            damping = building_damping_ratio(g, 1);
            read_heights(l, side, g, &level, &height);
        }
        value[FREE_LEFT + side] = link_at(l, side, r->peak[PEAK_DISPLACEMENT]);
        value[FREE_PERIOD_LEFT + side] = period;
        value[FREE_DAMPING_LEFT + side] = damping;
        value[FREE_LEVEL_LEFT + side] = level;
        value[FREE_HEIGHT_LEFT + side] = height;
    }
    value[FREE_GAP] = deck->link[i].gap;
    value[FREE_CLOSING] = r->link[i].penetration + l->gap;
    value[FREE_RHO] = contact_free_correlation(value + FREE_PERIOD_LEFT, value + FREE_DAMPING_LEFT);
}

// The separations of a contact after its other values.
static void apply_rules(const struct link *l, const struct separation_site *site, double *value) {
    struct separation_ends ends;
    for (int side = 0; side < 2; side++) {
        const int building = l->building[side];
        const double factor = building != WALL && site->factor ? site->factor[building] : 1.0;
        ends.displacement[side] = factor * value[FREE_LEFT + side];
        ends.period[side] = value[FREE_PERIOD_LEFT + side];
        ends.damping[side] = value[FREE_DAMPING_LEFT + side];
        ends.level[side] = value[FREE_LEVEL_LEFT + side];
        ends.height[side] = value[FREE_HEIGHT_LEFT + side];
    }
    for (int k = 0; k < SEPARATION_RULES; k++) {
        value[FREE_RULE + k] = contact_free_separation(&contact_free_rules[k], &ends, site);
    }
}

static int read_run(void *context, const struct model *m, const struct model *deck,
                    const struct results *r, double *value, struct error *e) {
    (void)context;
    if (r->collapse.happened) {
        return error_set(e, STATUS_FAILED, "it collapses without contact, at t = %.6g",
                         r->collapse.time);
    }
    for (int i = 0; i < m->n_contact; i++) {
        read_contact(m, deck, r, i, value + (size_t)i * FREE_VALUES);
    }
    return STATUS_OK;
}

// Whether two runs differ in nothing but their gaps.
static bool same_run(const struct contact_free *a, long one, long other) {
    bool same = a->outcome[one].status == a->outcome[other].status;
    for (int i = 0; i < a->n_contact && same; i++) {
        const double *x = contact_free_values(a, one, i), *y = contact_free_values(a, other, i);
        for (int j = FREE_CLOSING; j < FREE_VALUES; j++) {
            same = same && number_bits(x[j]) == number_bits(y[j]);
        }
    }
    return same;
}

// Finds the sweeps that change nothing; of their values the first counts. `later` is how many runs
// each value of a sweep has in a row.
static void find_idle(const struct plan *plan, struct contact_free *a) {
    long later = a->n_run;
    int k = 0;
    for (const struct sweep *s = plan->first->deck->sweeps; s; s = s->next, k++) {
        later /= s->n;
        a->idle[k] = s->n > 1;
        for (long run = 0; run < a->n_run && a->idle[k]; run++) {
            a->idle[k] = same_run(a, run, run - run / later % s->n * later);
        }
        for (long run = 0; run < a->n_run; run++) {
            a->counts[run] = a->counts[run] && !(a->idle[k] && run / later % s->n > 0);
        }
    }
}

int contact_free_run(const struct plan *plan, const struct gap_runs *how,
                     const struct separation_site *site, struct contact_free *out,
                     struct error *e) {
    const struct gap_runs_case which = {.plan = plan, .gap = INFINITY};
    struct gap_runs s = *how;
    const size_t n_run = (size_t)plan->n_run;
    s.which = &which;
    s.n_case = 1;
    s.n_value = (size_t)plan->first->n_contact * FREE_VALUES;
    s.read = read_run;
    *out = (struct contact_free){.n_run = plan->n_run, .n_contact = plan->first->n_contact};
    s.outcome = out->outcome = calloc(n_run, sizeof *out->outcome);
    s.value = out->value = calloc(n_run * s.n_value + 1, sizeof *out->value);
    out->counts = calloc(n_run, sizeof *out->counts);
    if (!s.outcome || !s.value || !out->counts) {
        return error_no_memory(e);
    }
    int status = gap_runs_run(&s, e);
    if (status == STATUS_OK) {
        for (long run = 0; run < out->n_run; run++) {
            out->counts[run] = true;
            out->n_failed += out->outcome[run].status == STUDY_FAILED;
            for (int i = 0; i < out->n_contact; i++) {
                double *value = out->value + (run * out->n_contact + i) * FREE_VALUES;
                apply_rules(&plan->first->link[i], site, value);
            }
        }
        find_idle(plan, out);
    }
    return status;
}

void contact_free_close(struct contact_free *a) {
    free(a->outcome);
    free(a->value);
    free(a->counts);
    *a = (struct contact_free){.n_run = 0};
}

const double *contact_free_values(const struct contact_free *a, long run, int contact) {
    return a->value + ((size_t)run * (size_t)a->n_contact + (size_t)contact) * FREE_VALUES;
}

struct contact_free_summary contact_free_summarise(const struct contact_free *a, int contact,
                                                   int value, int below, double *scratch) {
    struct contact_free_summary s = {NAN, NAN, NAN, NAN, NAN, NAN, 0};
    size_t n = 0;
    for (long run = 0; run < a->n_run; run++) {
        const double *v = contact_free_values(a, run, contact);
        const double x = below == FREE_VALUES ? v[value]
                         : v[below] > 0.0     ? v[value] / v[below]
                                              : NAN;
        if (!isnan(x) && (a->counts[run] || value == FREE_GAP)) {
            s.run = n == 0 || x > s.largest ? run : s.run;
            s.largest = n == 0 || x > s.largest ? x : s.largest;
            scratch[n++] = x;
        }
    }
    if (n > 0) {
        gsl_sort(scratch, 1, n);
        s.least = scratch[0];
        s.mean = gsl_stats_mean(scratch, 1, n);
        s.low = gsl_stats_quantile_from_sorted_data(scratch, 1, n, 0.16);
        s.median = gsl_stats_quantile_from_sorted_data(scratch, 1, n, 0.5);
        s.high = gsl_stats_quantile_from_sorted_data(scratch, 1, n, 0.84);
    }
    return s;
}

long contact_free_hits(const struct contact_free *a, int contact) {
    long n = 0;
    for (long run = 0; run < a->n_run; run++) {
        const double *v = contact_free_values(a, run, contact);
        n += v[FREE_CLOSING] > v[FREE_GAP];
    }
    return n;
}
