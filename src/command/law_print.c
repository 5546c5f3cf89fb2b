// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/law_print.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { NAME_SIZE = 512, LAWS_IN_A_ROW = 4 };
static const double ROUNDING = 1e-10;

// Quantities of an impact, in the order of the tables.
static const struct quantity {
    const char *name, *words;
    const struct dimension *dimension;
} quantities[] = {
    {"nominal_restitution", "nominal restitution", &dimension_none},
    {"achieved_restitution", "achieved restitution", &dimension_none},
    {"peak_force", "peak force", &dimension_force},
    {"duration", "duration of contact", &dimension_time},
    {"max_penetration", "largest penetration", &dimension_length},
    {"impulse", "impulse", &dimension_impulse},
    {"dissipated", "dissipated energy", &dimension_energy},
};
enum { N_QUANTITY = sizeof quantities / sizeof quantities[0] };

static double quantity(const struct law_impact *i, int q) {
    const double value[N_QUANTITY] = {
        i->nominal,           i->impact.restitution,     i->impact.peak_force,
        i->impact.duration,   i->impact.max_penetration, i->impact.impulse,
        i->impact.dissipated,
    };
    return value[q];
}

void law_print_bodies(const struct law_impacts *l, char *text, size_t size) {
    if (isnan(l->m2)) {
        snprintf(text, size, "%.6g kg at %.6g m/s against a wall", l->m1, l->velocity);
    } else {
        snprintf(text, size, "%.6g kg at %.6g m/s against %.6g kg", l->m1, l->velocity, l->m2);
    }
}

static void print_parameter(const char *name, const struct fit_parameter *p, FILE *to) {
    fprintf(to, "%s %.6g +- %.2g %%%s", name, p->value, 100.0 * p->error / p->value,
            fit_is_undetermined(p) ? " (undetermined)" : "");
}

static void print_fit(const struct law_impact *i, FILE *to) {
    const struct fit_result *f = &i->fit;
    print_parameter("  k", &f->k, to);
    if (!isnan(f->zeta.value)) {
        print_parameter(", zeta", &f->zeta, to);
    }
    fprintf(to, ", closure at %.6g s +- %.2g s\n", f->start.value, f->start.error);
    fprintf(to, "  normalised error %.4g %%\n", 100.0 * f->normalised_error);
}

double law_print_dissipated(const struct law_impacts *l, const struct law_impact *i) {
    const double energy = l->mass * l->velocity * l->velocity / 2.0;
    return fabs(i->impact.dissipated) < ROUNDING * energy ? 0.0 : i->impact.dissipated;
}

// What a reader is shown.
static double shown(const struct law_impacts *l, int i, int q) {
    return quantities[q].dimension == &dimension_energy ? law_print_dissipated(l, &l->impact[i])
                                                        : quantity(&l->impact[i], q);
}

// The laws from `first` up to `last`, side by side.
static int print_columns(const struct law_impacts *l, int first, int last, FILE *to) {
    struct unit_system si;
    struct printer t = {.to = to};
    unit_system_init(&si);
    printer_add(&t, &(struct printer_column)COLUMN_TEXT("", -21), 1);
    printer_add(&t, &(struct printer_column)COLUMN_TEXT("", 4), 1);
    for (int i = first; i < last; i++) {
        const char *name = l->impact[i].choice.law->name;
        printer_add(&t, &(struct printer_column)COLUMN_G(name, 17, 6), 1);
    }
    printer_head(&t);
    for (int q = 0; q < N_QUANTITY; q++) {
        char unit[32];
        unit_text(&si, *quantities[q].dimension, unit, sizeof unit);
        printer_text(&t, quantities[q].words);
        printer_text(&t, unit_suffix(unit));
        for (int i = first; i < last; i++) {
            printer_number(&t, shown(l, i, q));
        }
        printer_line(&t);
    }
    return printer_close(&t);
}

void law_print_warnings(const struct law_impacts *l, FILE *to) {
    for (int i = 0; i < l->n && l->measured.n > 0; i++) {
        const struct fit_result *f = &l->impact[i].fit;
        const struct fit_parameter *const p[] = {&f->k, &f->zeta};
        static const char *const name[] = {"k", "zeta"};
        for (int u = 0; u < 2; u++) {
            if (fit_is_undetermined(p[u])) {
                fprintf(to,
                        "jostle: warning: %s of %s is undetermined: its standard error of %.3g "
                        "exceeds its value of %.3g\n",
                        name[u], l->impact[i].choice.law->name, p[u]->error, p[u]->value);
            }
        }
    }
    if (l->measured.n > 0 && l->impact[0].fit.cut > 0.0) {
        fprintf(to,
                "jostle: warning: the record is cut off at %.2g %% of its peak force, so that its "
                "impulse does not say whether m* and v are right\n",
                100.0 * l->impact[0].fit.cut);
    }
}

static int print_text(const struct law_impacts *l, FILE *to) {
    char bodies[128];
    int status = EXIT_DONE;
    law_print_bodies(l, bodies, sizeof bodies);
    fprintf(to, "%s, effective mass %.6g kg\n\n", bodies, l->mass);
    for (int i = 0; i < l->n; i++) {
        char name[NAME_SIZE];
        law_print_words(l->impact[i].choice.law, l->impact[i].value, name, sizeof name);
        fprintf(to, "%s%s\n", name, l->impact[i].choice.calibrated ? " (calibrated)" : "");
        if (l->measured.n > 0) {
            print_fit(&l->impact[i], to);
        }
    }
    for (int first = 0; first < l->n && status == EXIT_DONE; first += LAWS_IN_A_ROW) {
        const int last = first + LAWS_IN_A_ROW;
        fputc('\n', to);
        status = print_columns(l, first, last < l->n ? last : l->n, to);
    }
    return status;
}

static void print_row(const char *name, const struct law_impacts *l,
                      double (*value)(const struct law_impact *i, int which), int which,
                      struct printer *t) {
    printer_text(t, name);
    for (int i = 0; i < l->n; i++) {
        printer_number(t, value(&l->impact[i], which));
    }
    printer_line(t);
}

static const char *const fitted[] = {
    "k", "k_error", "zeta", "zeta_error", "start", "start_error", "normalised_error",
};
enum { N_FITTED = sizeof fitted / sizeof fitted[0] };

static double fitted_value(const struct law_impact *i, int which) {
    const struct fit_result *f = &i->fit;
    const double value[N_FITTED] = {
        f->k.value,     f->k.error,     f->zeta.value,       f->zeta.error,
        f->start.value, f->start.error, f->normalised_error,
    };
    return value[which];
}

static double found_stiffness(const struct law_impact *i, int which) {
    (void)which;
    return i->value[contact_law_row(i->choice.law, "k")];
}

int law_print(const struct law_impacts *l, enum printer_form form, FILE *to) {
    if (form == FORM_TEXT) {
        return print_text(l, to);
    }
    struct printer t = {.to = to, .form = form};
    printer_add(&t, &(struct printer_column)COLUMN_DATA("law"), 1);
    for (int i = 0; i < l->n; i++) {
        printer_add(&t, &(struct printer_column)COLUMN_DATA(l->impact[i].choice.law->name), 1);
    }
    if (l->n > 1 || form != FORM_TSV) {
        printer_head(&t);
    }
    for (int q = 0; q < N_QUANTITY; q++) {
        print_row(quantities[q].name, l, quantity, q, &t);
    }
    if (l->found_k) {
        print_row("k", l, found_stiffness, 0, &t);
    }
    for (int f = 0; f < N_FITTED && l->measured.n > 0; f++) {
        print_row(fitted[f], l, fitted_value, f, &t);
    }
    return printer_close(&t);
}

int law_print_history(const struct law_impact *i, FILE *to) {
    static const struct printer_column columns[] = {{.key = "time", .unit = "s"},
                                                    {.key = "penetration", .unit = "m"},
                                                    {.key = "velocity", .unit = "m/s"},
                                                    {.key = "force", .unit = "N"}};
    struct printer t = {.to = to, .form = FORM_TSV};
    PRINTER_ADD(&t, columns);
    printer_head(&t);
    for (size_t k = 0; k < i->n_point; k++) {
        const struct isolated_point *p = &i->point[k];
        printer_numbers(&t, (const double[]){p->time, p->penetration, p->velocity, p->force}, 4);
        printer_line(&t);
    }
    return printer_close(&t);
}

void law_print_words(const struct contact_law *law, const double *value, char *text, size_t size) {
    size_t used = (size_t)snprintf(text, size, "%s", law->name);
    for (int r = 0; r < law->n_row && used < size; r++) {
        const struct row *row = &law->row[r];
        if (row->kind == ROW_FILE) {
            used += (size_t)snprintf(text + used, size - used, " -%s (%.0f points)", row->key,
                                     value[r]);
        } else if (row->kind == ROW_FLAG && !isnan(value[r])) {
            used += (size_t)snprintf(text + used, size - used, " -%s", row->key);
        } else if (row->kind == ROW_CHOICE && !isnan(value[r])) {
            used += (size_t)snprintf(text + used, size - used, " -%s %s", row->key,
                                     row->range->word[(int)value[r]]);
        } else if (!isnan(value[r])) {
            used += (size_t)snprintf(text + used, size - used, " -%s %.6g", row->key, value[r]);
        }
    }
}
