// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/study_print.h"

#include <math.h>
#include <string.h>

#include "command/choice.h"
#include "command/sweeps.h"
#include "core/safe.h"
#include "core/text.h"
#include "result/layout.h"
#include "study/edp.h"

// Of the largest values: buildings shown, and the width of names.
enum { BUILDINGS_MAX = 8, NAME_WIDTH_MIN = 12, NAME_WIDTH_MAX = 33 };

void study_print_curve(const struct fragility *f, const char *unit, const struct unit_system *u) {
    printf("median %.4g%s%s%s, dispersion %.4g", f->median, unit[0] ? " " : "", unit,
           study_print_g(u, unit, f->median).added, f->dispersion);
    if (!isnan(f->log_median_error)) {
        printf("; standard errors: %.2g of ln median, %.2g of the dispersion", f->log_median_error,
               f->dispersion_error);
    }
    putchar('\n');
}

void study_print_bootstrap(const struct bootstrap *b, const char *unit) {
    if (b->n_draw == 0) {
        return;
    }
    printf("95 %% of %d bootstraps: median %.4g to %.4g%s%s, dispersion %.4g to %.4g", b->n_fitted,
           b->median[0], b->median[1], unit[0] ? " " : "", unit, b->dispersion[0],
           b->dispersion[1]);
    if (b->n_fitted < b->n_draw) {
        printf("; %d more have no curve", b->n_draw - b->n_fitted);
    }
    putchar('\n');
}

void study_print_bootstrap_columns(struct printer *t) {
    static const struct printer_column columns[] = {
        COLUMN_DATA("median_low"), COLUMN_DATA("median_high"), COLUMN_DATA("dispersion_low"),
        COLUMN_DATA("dispersion_high"), COLUMN_DATA("bootstraps")};
    PRINTER_ADD(t, columns);
}

void study_print_bootstrap_cells(const struct bootstrap *b, struct printer *t) {
    for (int i = 0; i < 4; i++) {
        if (b->n_fitted > 0) {
            printer_number(t, i < 2 ? b->median[i] : b->dispersion[i - 2]);
        } else {
            printer_empty(t);
        }
    }
    printer_whole(t, b->n_fitted);
}

void study_print_rate(double rate) {
    printf("exceeded %.4g times a year, once in %.4g years; probability in 50 years %.4g %%\n",
           rate, 1.0 / rate, -100.0 * expm1(-50.0 * rate));
}

// A curve that is too short for the rate may change it by this share without a warning.
static const double BEYOND_MAX = 0.01;

double study_print_find_rate(const struct hazard *h, const struct fragility *f, const char *unit) {
    if (!h || f->outcome != FRAGILITY_FITTED) {
        return NAN;
    }
    const size_t last = h->n - 1;
    const double rate = hazard_exceedances(h, f, INFINITY), beyond = hazard_beyond(h, f);
    const double first = fragility_probability(f, h->intensity[0]);
    const char *blank = unit[0] ? " " : "";
    if (beyond > BEYOND_MAX * rate) {
        fprintf(
            stderr,
            "jostle: warning: the hazard curve ends at %.4g%s%s, where the probability is %.3g; "
            "the rate may be up to %.4g a year\n",
            h->intensity[last], blank, unit, fragility_probability(f, h->intensity[last]),
            rate + beyond);
    }
    if (first * h->rate[0] > BEYOND_MAX * rate) {
        fprintf(stderr,
                "jostle: warning: the hazard curve begins at %.4g%s%s, where the probability is "
                "%.3g; the rate leaves out what is exceeded at lower intensities\n",
                h->intensity[0], blank, unit, first);
    }
    return rate;
}

const char *study_print_status(const struct study_outcome *outcome) {
    switch (outcome->status) {
        case STUDY_DONE:
            return "done";
        case STUDY_FAILED:
            return "failed";
        default:
            return "missing";
    }
}

const char *study_print_name(const struct study_view *v, const struct study_item *item, size_t i) {
    const struct report_building *b = study_view_building(v, item, "members");
    if (b && i < (size_t)b->n_member) {
        return b->member[i].name;
    }
    if (item->owner) {
        const struct report_building *founded = study_view_building(v, item, "foundation");
        return founded ? founded->name : item->owner;
    }
    if (!item->scale) {
        return "";
    }
    const bool contact = strcmp(item->parent, "contacts") == 0;
    const bool column = strcmp(item->parent, "columns") == 0;
    const size_t n = (size_t)(contact ? v->n_contact : column ? v->n_column : v->n_link);
    return i < n ? (contact ? v->contact : column ? v->column : v->link)[i].name : "";
}

static void add_values(struct study_peaks *p, const struct study_view *v,
                       const struct study_run *r) {
    for (int k = 0; k < v->table.n_item; k++) {
        const struct study_item *item = &v->table.item[k];
        struct study_peak *peak = &p->peak[k];
        // Times of peaks are no quantities of their own, and signed extremes are many.
        const char *underscore = strrchr(item->name, '_');
        const bool detail =
            underscore && (strcmp(underscore, "_time") == 0 || strcmp(underscore, "_max") == 0 ||
                           strcmp(underscore, "_min") == 0);
        const bool shown = item->leaf && !detail;
        for (size_t i = 0; shown && i < item->n; i++) {
            const double x = r->value[item->first + i];
            if (!isnan(x) && study_view_counts(v, item, i) && (!peak->found || x > peak->value)) {
                *peak = (struct study_peak){.found = true, .value = x, .run = r->number, .at = i};
                peak->hit = study_view_hit(v, item, i, r->value) > 0;
            }
        }
    }
}

void study_peaks_add(struct study_peaks *p, const struct study_view *v, const struct study_run *r) {
    if (r->outcome->status == STUDY_DONE) {
        p->n_collapsed += edp_collapsed(v, r->value);
        add_values(p, v, r);
    } else if (r->outcome->status == STUDY_MISSING) {
        p->n_missing++;
    } else if (p->n_failed++ == 0) {
        p->failed = r->number;
        snprintf(p->message, sizeof p->message, "%s", r->outcome->message);
    }
}

static void print_value(const char *before, const struct sweep *s, int k, FILE *to) {
    struct text_short t;
    fprintf(to, "%s%s ", before, text_short(&t, s->name));
    if (s->number) {
        fprintf(to, "%.4g", s->number[k]);
    } else {
        fputs(text_short(&t, s->label[k]), to);
    }
}

static void print_run(const struct study_view *v, long run, FILE *to) {
    fprintf(to, "%ld (", run + 1);
    for (int i = 0; i < v->n_sweep; i++) {
        const int k = study_view_choice(v, run, i);
        const struct sweep *along = sweep_named(v->sweep[i]->along);
        print_value(i > 0 ? ", " : "", v->sweep[i], k, to);
        for (const struct sweep *s = along; s; s = sweep_named(s->along)) {
            print_value(s == along ? " (" : ", ", s, k, to);
        }
        fputs(along ? ")" : "", to);
    }
    fputs(")\n", to);
}

static void print_head(const struct study_peaks *p, const struct study_view *v, FILE *to) {
    const struct study_shard *part = &v->part.shard;
    if (v->title[0]) {
        safe_line(to, "%s", v->title);
    }
    if (part->n > 0) {
        fprintf(to, "part %ld of %ld: %ld of the ", part->number, part->n, v->n_run);
    }
    fprintf(to, part->n > 0 ? "%ld runs of a study, %ld failed" : "study of %ld runs, %ld failed",
            v->n_study, p->n_failed);
    if (p->n_missing > 0) {
        fprintf(to, ", %ld missing", p->n_missing);
    }
    if (p->n_collapsed > 0) {
        fprintf(to, ", %ld collapsed", p->n_collapsed);
    }
    fputc('\n', to);
    for (int i = 0; i < v->n_sweep; i++) {
        sweeps_print(v->sweep[i], NULL, to);
    }
}

// The buildings that are shown: those with the largest drifts.
struct shown {
    int n, n_building;
    struct choice choice[BUILDINGS_MAX];  // (n) items of drifts
};

static struct shown choose_buildings(const struct study_peaks *p, const struct study_view *v) {
    struct shown s = {.n = 0};
    for (int k = 0; k < v->table.n_item; k++) {
        const struct study_item *item = &v->table.item[k];
        if (item->leaf && item->owner && strcmp(item->name, "drift") == 0) {
            const double drift = p->peak[k].found ? p->peak[k].value : -HUGE_VAL;
            s.n = choice_add(s.choice, s.n, BUILDINGS_MAX, (struct choice){drift, k});
            s.n_building++;
        }
    }
    return s;
}

struct study_g study_print_g(const struct unit_system *u, const char *units, double value) {
    struct study_g g = {.text = ""};
    double size;
    if (dimension_equal(edp_units(units, u->gravity, &size), dimension_acceleration)) {
        snprintf(g.text, sizeof g.text, "%.4g", value * size / u->gravity);
        snprintf(g.added, sizeof g.added, " (%s g)", g.text);
    }
    return g;
}

// Elastic storeys keep no drift, and do not yield: such zeros are not printed.
static bool is_printed(const struct shown *s, const struct study_view *v, int k,
                       const struct study_peak *peak) {
    const struct study_item *item = &v->table.item[k];
    bool hidden = item->owner != NULL;
    for (int i = 0; i < s->n && hidden; i++) {
        hidden = strcmp(v->table.item[s->choice[i].index].owner, item->owner) != 0;
    }
    const bool yields = strcmp(item->name, layout_residual_drift_name) == 0 ||
                        layout_is_later(&(struct column){.name = item->name});
    const bool nothing = yields && item->owner && peak->value == 0;
    return peak->found && !nothing && !hidden;
}

// Of the longest name printed.
static int name_width(const struct study_peaks *p, const struct study_view *v,
                      const struct shown *s) {
    int width = NAME_WIDTH_MIN;
    for (int k = 0; k < v->table.n_item; k++) {
        const struct study_item *item = &v->table.item[k];
        if (is_printed(s, v, k, &p->peak[k])) {
            const char *name = study_print_name(v, item, p->peak[k].at);
            const int n = text_columns(name, strlen(name));
            width = n > width ? n : width;
        }
    }
    return width < NAME_WIDTH_MAX ? width : NAME_WIDTH_MAX;
}

static void print_peaks(const struct study_peaks *p, const struct study_view *v, FILE *to) {
    const struct shown shown = choose_buildings(p, v);
    const int width = name_width(p, v, &shown);
    bool any_hit = false;
    fprintf(to, "\nlargest values\n%-*s %-14s %5s %12s %-8s %6s  run\n", width, "", "quantity",
            "floor", "", "unit", "[g]");
    for (int k = 0; k < v->table.n_item; k++) {
        const struct study_item *item = &v->table.item[k];
        const struct study_peak *peak = &p->peak[k];
        struct text_short quantity, units;
        char floor[24] = "";
        if (!is_printed(&shown, v, k, peak)) {
            continue;
        }
        if (item->owner) {
            snprintf(floor, sizeof floor, "%zu", peak->at + 1);
        }
        any_hit |= peak->hit;
        safe_cell(to, study_print_name(v, item, peak->at), width);
        fprintf(to, " %-14s %5s %12.5g %-8s %6s%c ", text_short(&quantity, item->name), floor,
                peak->value, text_short(&units, item->units),
                study_print_g(&v->units, item->units, peak->value).text, peak->hit ? '*' : ' ');
        print_run(v, peak->run, to);
    }
    if (any_hit) {
        fprintf(to, "%s\n", report_hit_note);
    }
    if (shown.n_building > shown.n) {
        safe_line(to, "  %d more buildings not shown (by drift); all are in %s (jostle show --tsv)",
                  shown.n_building - shown.n, v->path);
    }
}

void study_peaks_print(const struct study_peaks *p, const struct study_view *v, FILE *to) {
    print_head(p, v, to);
    print_peaks(p, v, to);
    if (p->n_failed > 0) {
        fprintf(to, "\nthe first failed run: ");
        print_run(v, p->failed, to);
        safe_line(to, "  %s", p->message);
    }
    fprintf(to, "\nwall time   %.3g s", v->seconds);
    if (v->n_thread > 0) {
        fprintf(to, " on %d thread%s", v->n_thread, v->n_thread == 1 ? "" : "s");
    }
    if (v->n_part > 0) {
        fprintf(to, ", the sum of %d part%s", v->n_part, v->n_part == 1 ? "" : "s");
    }
    if (v->n_kept > 0) {
        fprintf(to, "; %ld runs computed, %ld taken", v->n_run - v->n_kept, v->n_kept);
    }
    fputc('\n', to);
    safe_line(to, "results     %s", v->path);
}
