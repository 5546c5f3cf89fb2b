// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of `jostle spectrum`: accelerations in g, all else in SI units.
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "command/cells.h"
#include "command/spectrum.h"
#include "core/safe.h"

enum unit { UNIT_G, UNIT_SI };
struct column {
    const char *name, *unit_name;
    enum unit unit;
    size_t offset;  // in struct intensity
};

// The first SHOWN are in the text table.
enum { N_INTENSITY = 11, SHOWN = 7 };
static const struct column intensities[N_INTENSITY] = {
    {"PGA", "g", UNIT_G, offsetof(struct intensity, pga)},
    {"PGV", "m/s", UNIT_SI, offsetof(struct intensity, pgv)},
    {"PGD", "m", UNIT_SI, offsetof(struct intensity, pgd)},
    {"Arias", "m/s", UNIT_SI, offsetof(struct intensity, arias)},
    {"CAV", "m/s", UNIT_SI, offsetof(struct intensity, cav)},
    {"D5-75", "s", UNIT_SI, offsetof(struct intensity, d5_75)},
    {"D5-95", "s", UNIT_SI, offsetof(struct intensity, d5_95)},
    {"t(PGA)", "s", UNIT_SI, offsetof(struct intensity, pga_time)},
    {"t(PGV)", "s", UNIT_SI, offsetof(struct intensity, pgv_time)},
    {"t(PGD)", "s", UNIT_SI, offsetof(struct intensity, pgd_time)},
    {"t(5%)", "s", UNIT_SI, offsetof(struct intensity, time_5)},
};

static const struct column responses[SPECTRUM_COUNT] = {
    [SPECTRUM_PSA] = {.name = "PSA", .unit_name = "g", .unit = UNIT_G},
    [SPECTRUM_PSV] = {.name = "PSV", .unit_name = "m/s", .unit = UNIT_SI},
    [SPECTRUM_SD] = {.name = "SD", .unit_name = "m", .unit = UNIT_SI},
    [SPECTRUM_SV] = {.name = "SV", .unit_name = "m/s", .unit = UNIT_SI},
    [SPECTRUM_SA] = {.name = "SA", .unit_name = "g", .unit = UNIT_G},
};

static double in_unit(const struct spectrum_request *q, const struct column *c, double value) {
    return c->unit == UNIT_G ? value / q->record.gravity : value;
}

static double intensity_value(const struct spectrum_request *q, const struct spectrum_set *set,
                              int record, const struct column *c) {
    const char *base = (const char *)&set->intensity[record];
    return in_unit(q, c, *(const double *)(const void *)(base + c->offset));
}

static double response(const struct spectrum_request *q, const struct spectrum_set *set, int series,
                       int damping, int period, enum spectrum_quantity quantity) {
    const struct spectrum_point *p = spectra_at(&set->spectra, series, damping, period);
    return in_unit(q, &responses[quantity], p->value[quantity]);
}

static void print_intensities(const struct spectrum_request *q, const struct spectrum_set *set) {
    for (int i = 0; i < SHOWN; i++) {
        printf("%9s ", intensities[i].name);
    }
    printf("%9s  record\n", "length");
    for (int i = 0; i < SHOWN; i++) {
        printf("%*s[%s] ", 7 - (int)strlen(intensities[i].unit_name), "", intensities[i].unit_name);
    }
    printf("%9s\n", "[s]");
    for (int r = 0; r < q->n_record; r++) {
        for (int i = 0; i < SHOWN; i++) {
            printf("%9.4g ", intensity_value(q, set, r, &intensities[i]));
        }
        printf("%9.4g  ", set->ground[r].end);
        safe_put(stdout, SAFE_TERMINAL, set->name[r]);
        printf("\n");
    }
}

// Two more columns: the target, and what is shown over it.
static void end_head(const struct spectrum_request *q, const char *text) {
    printf("%s\n", q->target ? text : "");
}

static void end_row(const struct spectrum_request *q, const struct spectrum_set *set, int period,
                    double psa) {
    if (q->target) {
        const double goal = target_at(&set->target, q->periods.value[period]) / q->record.gravity;
        if (isnan(goal)) {
            printf(" %10s %10s", "-", "-");
        } else {
            printf(" %10.4g %10.4g", goal, psa / goal);
        }
    }
    printf("\n");
}

static void print_record(const struct spectrum_request *q, const struct spectrum_set *set,
                         int damping) {
    static const enum spectrum_quantity shown[] = {SPECTRUM_PSA, SPECTRUM_PSV, SPECTRUM_SD};
    printf("%10s %10s %10s %10s", "period", "PSA", "PSV", "SD");
    end_head(q, "     target      ratio");
    printf("%10s %10s %10s %10s", "[s]", "[g]", "[m/s]", "[m]");
    end_head(q, "        [g]");
    for (int p = 0; p < q->periods.n; p++) {
        printf("%10.4g", q->periods.value[p]);
        for (size_t i = 0; i < sizeof shown / sizeof shown[0]; i++) {
            printf(" %10.4g", response(q, set, 0, damping, p, shown[i]));
        }
        end_row(q, set, p, response(q, set, 0, damping, p, SPECTRUM_PSA));
    }
}

static void print_statistics(const struct spectrum_request *q, const struct spectrum_set *set,
                             int damping) {
    const int mean = q->n_record + SPECTRA_MEAN;
    printf("%10s %10s %10s %10s %10s %10s %10s", "period", "mean PSA", "16 %", "50 %", "84 %",
           "mean PSV", "mean SD");
    end_head(q, "     target      ratio");
    printf("%10s %10s %10s %10s %10s %10s %10s", "[s]", "[g]", "[g]", "[g]", "[g]", "[m/s]", "[m]");
    end_head(q, "        [g]");
    for (int p = 0; p < q->periods.n; p++) {
        printf("%10.4g", q->periods.value[p]);
        for (int k = 0; k < SPECTRA_STATISTICS; k++) {
            printf(" %10.4g", response(q, set, q->n_record + k, damping, p, SPECTRUM_PSA));
        }
        printf(" %10.4g %10.4g", response(q, set, mean, damping, p, SPECTRUM_PSV),
               response(q, set, mean, damping, p, SPECTRUM_SD));
        end_row(q, set, p, response(q, set, mean, damping, p, SPECTRUM_PSA));
    }
}

static void print_spectra(const struct spectrum_request *q, const struct spectrum_set *set) {
    for (int d = 0; d < q->n_damping; d++) {
        printf("\n%g %% damping", 100.0 * q->damping[d]);
        if (q->n_record > 1) {
            printf(", %d records\n", q->n_record);
            print_statistics(q, set, d);
        } else {
            printf("\n");
            print_record(q, set, d);
        }
    }
}

static void print_intensities_tsv(const struct spectrum_request *q,
                                  const struct spectrum_set *set) {
    struct cells c = {.to = stdout, .form = CELLS_TSV};
    printf("record\tsamples\tdt [s]\tscale");
    for (int i = 0; i < N_INTENSITY; i++) {
        printf("\t%s [%s]", intensities[i].name, intensities[i].unit_name);
    }
    printf(q->target ? "\tmisfit\n" : "\n");
    for (int r = 0; r < q->n_record; r++) {
        cells_text(&c, set->name[r]);
        cells_whole(&c, (long)set->ground[r].n);
        cells_number(&c, set->ground[r].dt);
        cells_number(&c, set->scale[r]);
        for (int i = 0; i < N_INTENSITY; i++) {
            cells_number(&c, intensity_value(q, set, r, &intensities[i]));
        }
        if (q->target) {
            cells_number(&c, set->match.misfit[r]);
        }
        cells_end(&c);
    }
}

static void print_series_tsv(const struct spectrum_request *q, const struct spectrum_set *set,
                             int series) {
    static const char *const statistic[SPECTRA_STATISTICS] = {[SPECTRA_MEAN] = "mean",
                                                              [SPECTRA_P16] = "16%",
                                                              [SPECTRA_P50] = "50%",
                                                              [SPECTRA_P84] = "84%"};
    const bool record = series < q->n_record;
    struct cells c = {.to = stdout, .form = CELLS_TSV};
    for (int d = 0; d < q->n_damping; d++) {
        for (int p = 0; p < q->periods.n; p++) {
            cells_text(&c, record ? "record" : "statistic");
            cells_text(&c, record ? set->name[series] : statistic[series - q->n_record]);
            cells_number(&c, q->damping[d]);
            cells_number(&c, q->periods.value[p]);
            for (int k = 0; k < SPECTRUM_COUNT; k++) {
                cells_number(&c, response(q, set, series, d, p, (enum spectrum_quantity)k));
            }
            cells_end(&c);
        }
    }
}

// At those of the periods that it has.
static void print_target_tsv(const struct spectrum_request *q, const struct spectrum_set *set) {
    struct cells c = {.to = stdout, .form = CELLS_TSV};
    for (int p = 0; p < q->periods.n; p++) {
        const double goal = target_at(&set->target, q->periods.value[p]);
        if (isnan(goal)) {
            continue;
        }
        cells_text(&c, "target");
        cells_text(&c, set->target_name);
        cells_number(&c, q->damping[0]);
        cells_number(&c, q->periods.value[p]);
        cells_number(&c, in_unit(q, &responses[SPECTRUM_PSA], goal));
        for (int k = SPECTRUM_PSA + 1; k < SPECTRUM_COUNT; k++) {
            cells_empty(&c);
        }
        cells_end(&c);
    }
}

static void print_spectra_tsv(const struct spectrum_request *q, const struct spectrum_set *set) {
    printf("kind\tname\tdamping\tperiod [s]");
    for (int k = 0; k < SPECTRUM_COUNT; k++) {
        printf("\t%s [%s]", responses[k].name, responses[k].unit_name);
    }
    printf("\n");
    const int n_series = q->n_record > 1 ? q->n_record + SPECTRA_STATISTICS : 1;
    for (int s = 0; s < n_series; s++) {
        print_series_tsv(q, set, s);
    }
    if (q->target) {
        print_target_tsv(q, set);
    }
}

void spectrum_print(const struct spectrum_request *q, const struct spectrum_set *set) {
    if (q->form == FORM_DECK) {
        spectrum_print_deck(q, set);
        return;
    }
    if (q->form == FORM_TSV) {
        if (q->content == CONTENT_INTENSITIES) {
            print_intensities_tsv(q, set);
        } else {
            print_spectra_tsv(q, set);
        }
        return;
    }
    print_intensities(q, set);
    if (q->target) {
        spectrum_print_match(q, set);
    }
    if (q->content == CONTENT_ALL && !picture_is_wanted(&q->picture)) {
        print_spectra(q, set);
    }
}
