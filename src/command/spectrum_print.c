// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of `jostle spectrum`: accelerations in g, all else in SI units.
#include <math.h>

#include "command/spectrum.h"

enum { N_INTENSITY = 13, WIDTH = 10 };

// Text shows the first ones.
static const struct printer_column intensity_columns[N_INTENSITY] = {
    {"PGA", "PGA", "g", NULL, 9, 4, LOOK_G},
    {"PGV", "PGV", "m/s", NULL, 9, 4, LOOK_G},
    {"PGD", "PGD", "m", NULL, 9, 4, LOOK_G},
    {"Arias", "Arias", "m/s", NULL, 9, 4, LOOK_G},
    {"CAV", "CAV", "m/s", NULL, 9, 4, LOOK_G},
    {"D5-75", "D5-75", "s", NULL, 9, 4, LOOK_G},
    {"D5-95", "D5-95", "s", NULL, 9, 4, LOOK_G},
    {.key = "t(PGA)", .unit = "s"},
    {.key = "t(PGV)", .unit = "s"},
    {.key = "t(PGD)", .unit = "s"},
    {.key = "t(5%)", .unit = "s"},
    {.key = "Arias_trapezoid", .unit = "m/s"},
    {.key = "CAV_trapezoid", .unit = "m/s"}};

// Around them.
static const struct printer_column of_record[] = {COLUMN_DATA("record"),
                                                  COLUMN_DATA("samples"),
                                                  {.key = "dt", .unit = "s"},
                                                  COLUMN_DATA("scale")};
static const struct printer_column length_and_name[] = {
    {.head = "length", .unit = "s", .width = 9, .digits = 4}, COLUMN_TEXT("record", 0)};

static const struct printer_column series_columns[] = {COLUMN_DATA("kind"),
                                                       COLUMN_DATA("name"),
                                                       COLUMN_DATA("damping"),
                                                       {.key = "period", .unit = "s"}};
static const struct printer_column response_columns[SPECTRUM_COUNT] = {
    [SPECTRUM_PSA] = {"PSA", "PSA", "g", NULL, WIDTH, 4, LOOK_G},
    [SPECTRUM_PSV] = {"PSV", "PSV", "m/s", NULL, WIDTH, 4, LOOK_G},
    [SPECTRUM_SD] = {"SD", "SD", "m", NULL, WIDTH, 4, LOOK_G},
    [SPECTRUM_SV] = {.key = "SV", .unit = "m/s"},
    [SPECTRUM_SA] = {.key = "SA", .unit = "g"}};

// Of text: a record, or statistics of several, and the target with what is shown over it.
static const struct printer_column period_column[] = {
    {.head = "period", .unit = "s", .width = WIDTH, .digits = 4}};
static const struct printer_column statistic_columns[] = {
    {"mean PSA", NULL, "g", NULL, WIDTH, 4, LOOK_G},
    {"16 %", NULL, "g", NULL, WIDTH, 4, LOOK_G},
    {"50 %", NULL, "g", NULL, WIDTH, 4, LOOK_G},
    {"84 %", NULL, "g", NULL, WIDTH, 4, LOOK_G},
    {"mean PSV", NULL, "m/s", NULL, WIDTH, 4, LOOK_G},
    {"mean SD", NULL, "m", NULL, WIDTH, 4, LOOK_G}};
static const struct printer_column target_columns[] = {
    {"target", NULL, "g", NULL, WIDTH, 4, LOOK_G}, {"ratio", NULL, NULL, NULL, WIDTH, 4, LOOK_G}};

static double response(const struct spectrum_request *q, const struct spectrum_set *set, int series,
                       int damping, int period, enum spectrum_quantity quantity) {
    const double value = spectra_at(&set->spectra, series, damping, period)->value[quantity];
    return quantity == SPECTRUM_PSA || quantity == SPECTRUM_SA ? value / q->record.gravity : value;
}

static int print_intensities(const struct spectrum_request *q, const struct spectrum_set *set) {
    static const struct printer_column misfit = COLUMN_DATA("misfit");
    struct printer t = {.to = stdout, .form = (enum printer_form)q->form, .at_head = UNITS_BELOW};
    PRINTER_ADD(&t, of_record);
    PRINTER_ADD(&t, intensity_columns);
    PRINTER_ADD(&t, length_and_name);
    if (q->target) {
        printer_add(&t, &misfit, 1);
    }
    printer_head(&t);
    for (int r = 0; r < q->n_record; r++) {
        const struct signal *g = &set->ground[r];
        printer_text(&t, set->name[r]);
        printer_whole(&t, (long)g->n);
        printer_number(&t, g->dt);
        printer_number(&t, set->scale[r]);
        // Accelerations in g.
        const struct intensity *i = &set->intensity[r];
        const double value[N_INTENSITY] = {i->pga / q->record.gravity,
                                           i->pgv,
                                           i->pgd,
                                           i->arias,
                                           i->cav,
                                           i->d5_75,
                                           i->d5_95,
                                           i->pga_time,
                                           i->pgv_time,
                                           i->pgd_time,
                                           i->time_5,
                                           i->arias_trapezoid,
                                           i->cav_trapezoid};
        printer_numbers(&t, value, N_INTENSITY);
        printer_number(&t, g->end);
        printer_text(&t, set->name[r]);
        printer_number(&t, q->target ? set->match.misfit[r] : (double)NAN);
        printer_line(&t);
    }
    return printer_close(&t);
}

// The target at a period in g; NAN: it has none there.
static double goal_at(const struct spectrum_request *q, const struct spectrum_set *set,
                      int period) {
    return target_at(&set->target, q->periods.value[period]) / q->record.gravity;
}

// The PSA of a record or the mean goes over the target.
static void end_row(struct printer *t, const struct spectrum_request *q,
                    const struct spectrum_set *set, int period, double psa) {
    if (q->target) {
        const double goal = goal_at(q, set, period);
        printer_number(t, goal);
        printer_number(t, psa / goal);
    }
    printer_line(t);
}

static void print_record(struct printer *t, const struct spectrum_request *q,
                         const struct spectrum_set *set, int damping, int p) {
    for (int k = SPECTRUM_PSA; k < SPECTRUM_COUNT; k++) {
        printer_number(t, response(q, set, 0, damping, p, (enum spectrum_quantity)k));
    }
    end_row(t, q, set, p, response(q, set, 0, damping, p, SPECTRUM_PSA));
}

static void print_statistics(struct printer *t, const struct spectrum_request *q,
                             const struct spectrum_set *set, int damping, int p) {
    const int mean = q->n_record + SPECTRA_MEAN;
    for (int k = 0; k < SPECTRA_STATISTICS; k++) {
        printer_number(t, response(q, set, q->n_record + k, damping, p, SPECTRUM_PSA));
    }
    printer_number(t, response(q, set, mean, damping, p, SPECTRUM_PSV));
    printer_number(t, response(q, set, mean, damping, p, SPECTRUM_SD));
    end_row(t, q, set, p, response(q, set, mean, damping, p, SPECTRUM_PSA));
}

static int print_spectra(const struct spectrum_request *q, const struct spectrum_set *set) {
    int status = EXIT_DONE;
    for (int d = 0; d < q->n_damping && status == EXIT_DONE; d++) {
        printf("\n%g %% damping", 100.0 * q->damping[d]);
        if (q->n_record > 1) {
            printf(", %d records", q->n_record);
        }
        printf("\n");
        // A table for readers, of one damping ratio.
        struct printer t = {.to = stdout, .at_head = UNITS_BELOW};
        PRINTER_ADD(&t, period_column);
        if (q->n_record > 1) {
            PRINTER_ADD(&t, statistic_columns);
        } else {
            PRINTER_ADD(&t, response_columns);
        }
        if (q->target) {
            PRINTER_ADD(&t, target_columns);
        }
        printer_head(&t);
        for (int p = 0; p < q->periods.n; p++) {
            printer_number(&t, q->periods.value[p]);
            (q->n_record > 1 ? print_statistics : print_record)(&t, q, set, d, p);
        }
        status = printer_close(&t);
    }
    return status;
}

static int print_data(const struct spectrum_request *q, const struct spectrum_set *set) {
    struct printer t = {.to = stdout, .form = (enum printer_form)q->form};
    const int n_series = q->n_record > 1 ? q->n_record + SPECTRA_STATISTICS : 1;
    PRINTER_ADD(&t, series_columns);
    PRINTER_ADD(&t, response_columns);
    printer_head(&t);
    for (int s = 0; s < n_series; s++) {
        static const char *const statistic[SPECTRA_STATISTICS] = {[SPECTRA_MEAN] = "mean",
                                                                  [SPECTRA_P16] = "16%",
                                                                  [SPECTRA_P50] = "50%",
                                                                  [SPECTRA_P84] = "84%"};
        const bool record = s < q->n_record;
        for (int d = 0; d < q->n_damping; d++) {
            for (int p = 0; p < q->periods.n; p++) {
                printer_text(&t, record ? "record" : "statistic");
                printer_text(&t, record ? set->name[s] : statistic[s - q->n_record]);
                printer_number(&t, q->damping[d]);
                printer_number(&t, q->periods.value[p]);
                for (int k = 0; k < SPECTRUM_COUNT; k++) {
                    printer_number(&t, response(q, set, s, d, p, (enum spectrum_quantity)k));
                }
                printer_line(&t);
            }
        }
    }
    if (q->target) {
        // The target at its periods.
        for (int p = 0; p < q->periods.n; p++) {
            const double goal = goal_at(q, set, p);
            if (!isnan(goal)) {
                printer_text(&t, "target");
                printer_text(&t, set->target_name);
                printer_number(&t, q->damping[0]);
                printer_number(&t, q->periods.value[p]);
                printer_number(&t, goal);
                printer_line(&t);
            }
        }
    }
    return printer_close(&t);
}

int spectrum_print(const struct spectrum_request *q, const struct spectrum_set *set) {
    if (q->form == SPECTRUM_DECK) {
        spectrum_print_deck(q, set);
        return EXIT_DONE;
    }
    if (q->form != FORM_TEXT && q->content == CONTENT_ALL) {
        return print_data(q, set);
    }
    int status = print_intensities(q, set);
    if (q->form != FORM_TEXT) {
        return status;
    }
    if (status == EXIT_DONE && q->target) {
        status = spectrum_print_match(q, set);
    }
    const bool spectra = q->content == CONTENT_ALL && !picture_is_wanted(&q->picture);
    return status == EXIT_DONE && spectra ? print_spectra(q, set) : status;
}
