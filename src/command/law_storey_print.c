// SPDX-License-Identifier: GPL-3.0-or-later
#include <math.h>
#include <stdio.h>

#include "command/law_storey.h"

enum { TEXT_SIZE = 512, NAMES_IN_A_ROW = 4 };

void law_storey_text(const struct law_storey *s, char *text, size_t size) {
    const struct loop_law *law = &s->law;
    size_t used = (size_t)snprintf(text, size, "%s", law->name);
    for (int r = 0; r < law->n_row && used < size; r++) {
        const struct row *row = &law->row[r];
        const double value = s->choice.value[r];
        bool shown = s->choice.given[r].given;
        for (int i = 0; i < s->n_found; i++) {
            shown |= s->found[i] == r;
        }
        if (!shown) {
            continue;
        }
        used += (size_t)snprintf(text + used, size - used, " -%s", row->key);
        if (row->kind != ROW_FLAG && used < size) {
            used += (size_t)(row->kind == ROW_CHOICE
                                 ? snprintf(text + used, size - used, " %s",
                                            row->range->word[(int)value])
                                 : snprintf(text + used, size - used, " %.6g", value));
        }
    }
    if (used < size && !isnan(s->stiffness)) {
        snprintf(text + used, size - used, " -stiffness %.6g", s->stiffness);
    }
}

static const char *found_key(const struct law_storey *s, int i) {
    return s->found[i] == STOREY_FIT_STIFFNESS ? "stiffness" : s->law.row[s->found[i]].key;
}

static double found_value(const struct law_storey *s, int i) {
    return s->found[i] == STOREY_FIT_STIFFNESS ? s->stiffness : s->choice.value[s->found[i]];
}

// The error of measured loops that are good. A loop without errors does not tell which parameters
// it determines.
static const double GOOD = 0.01;

// The standard error of a parameter in a loop with the errors of this one, or of a good one.
static double likely_error(const struct law_storey *s, int i) {
    const double error = s->fit.normalised_error;
    return error < GOOD ? s->fit.error[i] / error * GOOD : s->fit.error[i];
}

static bool is_undetermined(const struct law_storey *s, int i) {
    return !(likely_error(s, i) <= fabs(found_value(s, i)));
}

void law_storey_warn(const struct law_storeys *l, FILE *to) {
    for (int k = 0; k < l->n; k++) {
        const struct law_storey *s = &l->storey[k];
        for (int i = 0; i < s->n_found; i++) {
            if (is_undetermined(s, i)) {
                fprintf(to,
                        "jostle: warning: -%s of %s is undetermined: with errors of %.2g %% in the "
                        "loop its standard error of %.3g exceeds its value of %.3g\n",
                        found_key(s, i), s->law.name, 100.0 * fmax(s->fit.normalised_error, GOOD),
                        likely_error(s, i), found_value(s, i));
            }
        }
    }
}

// The largest values of a path.
struct largest {
    double shear, least;
    const struct storey_point *last;
};

static struct largest largest_of(const struct law_storeys *l, const struct law_storey *s) {
    struct largest m = {.last = &s->point[l->n_point - 1]};
    for (size_t i = 0; i < l->n_point; i++) {
        m.shear = fmax(m.shear, s->point[i].shear);
        m.least = fmin(m.least, s->point[i].shear);
    }
    return m;
}

enum { N_QUANTITY = 4 };

static int print_summary(const struct law_storeys *l, int first, int last, FILE *to) {
    struct printer t = {.to = to};
    printer_add(&t, &(struct printer_column)COLUMN_TEXT("", -21), 1);
    printer_add(&t, &(struct printer_column)COLUMN_TEXT("", 4), 1);
    for (int i = first; i < last; i++) {
        const char *name = l->storey[i].law.name;
        printer_add(&t, &(struct printer_column)COLUMN_G(name, 17, 6), 1);
    }
    printer_head(&t);
    char largest[32], least[32];
    snprintf(largest, sizeof largest, "largest %s", l->kind->force);
    snprintf(least, sizeof least, "least %s", l->kind->force);
    const char *const words[N_QUANTITY] = {largest, least, "dissipated energy",
                                           "plastic deformation"};
    const char *const unit[N_QUANTITY] = {l->kind->force_unit, l->kind->force_unit, "N*m",
                                          l->kind->unit};
    for (int q = 0; q < N_QUANTITY; q++) {
        printer_text(&t, words[q]);
        printer_text(&t, unit[q]);
        for (int i = first; i < last; i++) {
            const struct largest m = largest_of(l, &l->storey[i]);
            const double value[N_QUANTITY] = {m.shear, m.least, m.last->dissipated,
                                              m.last->plastic};
            printer_number(&t, value[q]);
        }
        printer_line(&t);
    }
    return printer_close(&t);
}

enum { TURN_COLUMNS = 7 };

// The columns of a table, from number `first` on; the first is the number of the turn.
static void add_turn_columns(const struct law_storey_kind *k, int first, struct printer *t) {
    const char *const head[TURN_COLUMNS] = {"turn", k->deformation, k->force, "tangent",
                                            "work", "dissipated",   "plastic"};
    const struct dimension *const of[TURN_COLUMNS] = {NULL,
                                                      &k->of_deformation,
                                                      &k->of_force,
                                                      &k->of_stiffness,
                                                      &dimension_energy,
                                                      &dimension_energy,
                                                      &k->of_deformation};
    for (int i = first; i < TURN_COLUMNS; i++) {
        const struct printer_column column = {.head = head[i],
                                              .key = head[i],
                                              .dimension = of[i],
                                              .width = i == 0 ? 5 : 13,
                                              .digits = i == 0 ? 0 : 6};
        printer_add(t, &column, 1);
    }
}

// Readers are shown 0 where there is only rounding.
static double shown(const struct printer *t, double value, double size) {
    static const double ROUNDING = 1e-9;
    return t->form == FORM_TEXT && fabs(value) < ROUNDING * fabs(size) ? 0.0 : value;
}

static void print_point(const struct storey_point *p, struct printer *t) {
    const double dissipated = shown(t, p->dissipated, p->work);
    const double plastic = shown(t, p->plastic, p->drift);
    printer_numbers(
        t, (const double[]){p->drift, p->shear, p->tangent, p->work, dissipated, plastic}, 6);
    printer_line(t);
}

static void print_turns(const struct law_storeys *l, const struct law_storey *s,
                        struct printer *t) {
    for (size_t i = 0; i <= l->n_target; i++) {
        if (t->form != FORM_TEXT) {
            printer_text(t, s->law.name);
        }
        printer_whole(t, (long)i);
        print_point(&s->point[i * (size_t)l->n_part], t);
    }
}

static int print_fit_data(const struct law_storeys *l, struct printer *t) {
    static const struct printer_column columns[] = {COLUMN_DATA("law"), COLUMN_DATA("parameter"),
                                                    COLUMN_DATA("value"), COLUMN_DATA("error")};
    PRINTER_ADD(t, columns);
    printer_head(t);
    for (int k = 0; k < l->n; k++) {
        const struct law_storey *s = &l->storey[k];
        for (int i = 0; i <= s->n_found; i++) {
            const bool last = i == s->n_found;
            printer_text(t, s->law.name);
            printer_text(t, last ? "normalised_error" : found_key(s, i));
            printer_number(t, last ? s->fit.normalised_error : found_value(s, i));
            printer_number(t, last ? NAN : s->fit.error[i]);
            printer_line(t);
        }
    }
    return printer_close(t);
}

static void print_fit(const struct law_storey *s, FILE *to) {
    for (int i = 0; i < s->n_found; i++) {
        const double value = found_value(s, i);
        fprintf(to, "%s%s %.6g +- %.2g %%%s", i == 0 ? "  " : ", ", found_key(s, i), value,
                100.0 * s->fit.error[i] / fabs(value),
                is_undetermined(s, i) ? " (undetermined)" : "");
    }
    fprintf(to, "\n  normalised error %.4g %%\n", 100.0 * s->fit.normalised_error);
}

static int print_text(const struct law_storeys *l, FILE *to) {
    struct unit_system si;
    int status = EXIT_DONE;
    unit_system_init(&si);
    fprintf(to, "%s %s, %zu %s\n\n", l->shear ? "loop" : "protocol", l->protocol, l->n_target,
            l->shear ? "samples" : "turns");
    for (int i = 0; i < l->n; i++) {
        char text[TEXT_SIZE];
        law_storey_text(&l->storey[i], text, sizeof text);
        fprintf(to, "%s\n", text);
        if (l->shear) {
            print_fit(&l->storey[i], to);
        }
    }
    for (int first = 0; first < l->n && status == EXIT_DONE; first += NAMES_IN_A_ROW) {
        const int last = first + NAMES_IN_A_ROW;
        fputc('\n', to);
        status = print_summary(l, first, last < l->n ? last : l->n, to);
    }
    for (int i = 0; i < l->n && status == EXIT_DONE && !l->shear; i++) {
        struct printer t = {.to = to, .units = &si, .at_head = UNITS_BELOW_BARE};
        fprintf(to, "\n%s\n", l->storey[i].law.name);
        add_turn_columns(l->kind, 0, &t);
        printer_head(&t);
        print_turns(l, &l->storey[i], &t);
        status = printer_close(&t);
    }
    return status;
}

int law_storey_print(const struct law_storeys *l, enum printer_form form, FILE *to) {
    struct unit_system si;
    unit_system_init(&si);
    if (form == FORM_TEXT) {
        return print_text(l, to);
    }
    struct printer t = {.to = to, .form = form, .units = &si};
    if (l->shear) {
        return print_fit_data(l, &t);
    }
    printer_add(&t, &(struct printer_column)COLUMN_DATA("law"), 1);
    add_turn_columns(l->kind, 0, &t);
    printer_head(&t);
    for (int i = 0; i < l->n; i++) {
        print_turns(l, &l->storey[i], &t);
    }
    return printer_close(&t);
}

int law_storey_print_path(const struct law_storeys *l, FILE *to) {
    struct unit_system si;
    unit_system_init(&si);
    struct printer t = {.to = to, .form = FORM_TSV, .units = &si};
    add_turn_columns(l->kind, 1, &t);
    printer_head(&t);
    for (size_t i = 0; i < l->n_point; i++) {
        print_point(&l->storey[0].point[i], &t);
    }
    return printer_close(&t);
}
