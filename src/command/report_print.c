// SPDX-License-Identifier: GPL-3.0-or-later
// The summary of a run as text: tables by the printer, between them sentences. Long tables are cut
// to the most severe entries, and a line says so. All values as data: show_report.c.
#include <math.h>
#include <string.h>

#include "command/report_summary.h"
#include "core/safe.h"
#include "core/text.h"
#include "jostle/result.h"

// The number of a run in a study, and the values of its parameters, a line each.
static void print_run(const struct report *r, FILE *to) {
    fprintf(to, "run %ld of a study\n", r->run);
    for (const char *line = r->parameters; *line;) {
        const int n = (int)strcspn(line, "\n");
        safe_line(to, "  %.*s", n, line);
        line += n + (line[n] == '\n');
    }
}

static void print_collapse(const struct report *r, FILE *to) {
    const struct report_collapse *c = &r->collapse;
    const char *length = r->units.length_name, *time = r->units.time_name;
    if (c->happened) {
        safe_line(to,
                  "COLLAPSED at %.6g %s: the drift of storey %ld of building %s reached %.4g %s; "
                  "the run ended there",
                  c->time, time, c->storey, c->building, fabs(c->drift), length);
    }
}

static void print_head(const struct report *r, FILE *to) {
    if (r->title[0]) {
        safe_line(to, "%s", r->title);
    }
    if (r->run > 0) {
        print_run(r, to);
    }
    fprintf(to, "units %s %s %s, duration %.6g %s, ", r->units.force_name, r->units.length_name,
            r->units.time_name, r->duration, r->units.time_name);
    if (r->dt > 0.0) {
        fprintf(to, "step %.6g %s\n", r->dt, r->units.time_name);
    } else {
        fprintf(to, "adaptive steps\n");
    }
    print_collapse(r, to);
}

// Index of the largest value of the floors or storeys in summaries; of the first if all are NaN.
static int largest(const struct report_building *b, const double *value) {
    int at = -1;
    for (int i = 0; i < b->n_floor; i++) {
        if (floor_is_summarised(b->isolated, b->n_floor, i)) {
            at = at < 0 || value[i] > value[at] || isnan(value[at]) ? i : at;
        }
    }
    return at;
}

static struct report_shown choose_buildings(const struct report *r) {
    struct report_shown s = {.width = NAME_WIDTH_MIN};
    for (int i = 0; i < r->n_building; i++) {
        const struct report_building *b = &r->building[i];
        const double *drift = b->peak[PEAK_DRIFT];
        const double rank = drift ? drift[largest(b, drift)] : 0;
        s.n = choice_add(s.choice, s.n, SHOWN_MAX, (struct choice){rank, i});
    }
    choice_sort(s.choice, s.n);
    for (int i = 0; i < s.n; i++) {
        s.width =
            report_summary_widest(s.width, r->building[s.choice[i].index].name, NAME_WIDTH_MAX);
    }
    return s;
}

static const struct printer_column buildings[] = {COUNT("floors", 6), READ("mass", 10, mass),
                                                  READ("T1", 9, time), READ("T2", 9, time),
                                                  READ("T3", 9, time)};
static bool building_row(struct printer *t, const struct report *r, int i) {
    const struct report_building *b = &r->building[i];
    double mass = 0;
    for (int f = 0; f < b->n_floor; f++) {
        mass += b->mass[f];
    }
    printer_text(t, b->name);
    printer_whole(t, b->n_floor);
    printer_number(t, mass);
    for (int k = 0; k < 3; k++) {
        printer_number(t, k < b->n_floor ? b->period[k] : (double)NAN);
    }
    return false;
}

// The largest of the drifts, over the height of its storey, and its number; returns its index.
static int drift_cells(struct printer *t, const struct report_building *b, const double *drift) {
    const int i = largest(b, drift);
    printer_number(t, drift[i]);
    printer_number(t, b->height[i] > 0 ? 100 * drift[i] / b->height[i] : (double)NAN);
    printer_whole(t, i + 1);
    return i;
}

static const struct printer_column displacements[] = {READ("roof displ.", 12, length),
                                                      READ("time", 8, time),
                                                      READ("storey drift", 12, length),
                                                      RATIO(9),
                                                      COUNT("storey", 7),
                                                      READ("time", 8, time)};
static bool displacement_row(struct printer *t, const struct report *r, int i) {
    const struct report_building *b = &r->building[i];
    printer_text(t, b->name);
    printer_number(t, b->peak[PEAK_DISPLACEMENT][b->n_floor - 1]);
    printer_number(t, b->peak_time[PEAK_DISPLACEMENT][b->n_floor - 1]);
    const int storey = drift_cells(t, b, b->peak[PEAK_DRIFT]);
    printer_number(t, b->peak_time[PEAK_DRIFT][storey]);
    return false;
}

// Energies are those of all storeys together.
static const struct printer_column residuals[] = {
    READ("residual drift", 14, length),
    RATIO(9),
    COUNT("storey", 7),
    {.head = "ductility", .width = 10, .digits = 4, .look = LOOK_READ},
    COUNT("storey", 7),
    READ("dissipated", 12, energy),
    {.head = "damage", .width = 8, .digits = 3, .look = LOOK_READ}};
static bool residual_row(struct printer *t, const struct report *r, int i) {
    const struct report_building *b = &r->building[i];
    const double *const *demand = b->demand;
    printer_text(t, b->name);
    drift_cells(t, b, b->residual_drift);
    if (!demand[YIELD_DUCTILITY]) {  // of an earlier version
        printer_numbers(t, (double[]){(double)NAN, (double)NAN, (double)NAN, (double)NAN}, 4);
        return false;
    }
    const int most = largest(b, demand[YIELD_DUCTILITY]);
    const double damage = demand[YIELD_DAMAGE][largest(b, demand[YIELD_DAMAGE])];
    double energy = 0.0;
    for (int k = 0; k < b->n_floor; k++) {
        energy += demand[YIELD_HYSTERETIC][k];
    }
    const double value[] = {demand[YIELD_DUCTILITY][most], most + 1, energy,
                            damage > 0.0 ? damage : (double)NAN};
    printer_numbers(t, value, 4);
    return false;
}

static const struct printer_column isolators[] = {
    COUNT("storey", 7),           READ("drift", 12, length), READ("time", 8, time),
    READ("residual", 12, length), READ("shear", 12, force),  READ("time", 8, time)};
static bool isolator_row(struct printer *t, const struct report *r, int k) {
    const struct report_building *b = &r->building[k];
    const double value[] = {b->isolated,
                            b->peak[PEAK_DRIFT][b->isolated - 1],
                            b->peak_time[PEAK_DRIFT][b->isolated - 1],
                            b->residual_drift ? b->residual_drift[b->isolated - 1] : (double)NAN,
                            b->peak[PEAK_SHEAR][b->isolated - 1],
                            b->peak_time[PEAK_SHEAR][b->isolated - 1]};
    printer_text(t, b->name);
    printer_numbers(t, value, 6);
    return false;
}

// The second column ends in the mark.
static const struct printer_column forces[] = {READ("total accel.", 13, acceleration),
                                               {.head = "", .unit = "g", .width = 10},
                                               COUNT("floor", 6),
                                               READ("time", 8, time),
                                               READ("base shear", 12, force),
                                               READ("time", 8, time)};
static bool force_row(struct printer *t, const struct report *r, int i) {
    const struct report_building *b = &r->building[i];
    const int floor = largest(b, b->peak[PEAK_ACCELERATION]);
    const bool hit = report_floor_was_hit(r, b->name, floor + 1);
    const double peak = b->peak[PEAK_ACCELERATION][floor];
    const double rest[] = {floor + 1, b->peak_time[PEAK_ACCELERATION][floor],
                           b->peak[PEAK_SHEAR][0], b->peak_time[PEAK_SHEAR][0]};
    char in_g[32];
    if (isnan(peak)) {
        snprintf(in_g, sizeof in_g, "- ");
    } else {
        snprintf(in_g, sizeof in_g, "%.4g%c", peak * unit_in_g(&r->units), hit ? '*' : ' ');
    }
    printer_text(t, b->name);
    printer_number(t, peak);
    printer_text(t, in_g);
    printer_numbers(t, rest, 4);
    return hit;
}

static const struct printer_column foundations[] = {
    READ("sway", 12, length),
    READ("time", 8, time),
    {.head = "rocking", .unit = "rad", .width = 12, .digits = 4, .look = LOOK_READ},
    READ("time", 8, time),
    READ("sway force", 12, force),
    READ("rocking mom.", 13, energy)};
static bool foundation_row(struct printer *t, const struct report *r, int i) {
    const double *size = r->building[i].foundation->size, *time = r->building[i].foundation->time;
    const double value[] = {size[FOUNDATION_SWAY],    time[FOUNDATION_SWAY],
                            size[FOUNDATION_ROCKING], time[FOUNDATION_ROCKING],
                            size[FOUNDATION_FORCE],   size[FOUNDATION_MOMENT]};
    printer_text(t, r->building[i].name);
    printer_numbers(t, value, 6);
    return false;
}

static void print_peaks(struct report_summary *s, const struct report_shown *shown) {
    struct report_shown yielding = {.width = shown->width}, founded = yielding, isolated = yielding;
    for (int i = 0; i < shown->n; i++) {
        const struct report_building *b = &s->r->building[shown->choice[i].index];
        if (b->residual_drift) {
            yielding.choice[yielding.n++] = shown->choice[i];
        }
        if (b->foundation) {
            founded.choice[founded.n++] = shown->choice[i];
        }
        if (b->isolated > 0) {
            isolated.choice[isolated.n++] = shown->choice[i];
        }
    }
    PRINT_TABLE(s, shown, "peak of", displacements, displacement_row);
    if (yielding.n > 0) {
        PRINT_TABLE(s, &yielding, "yielding", residuals, residual_row);
    }
    PRINT_TABLE(s, shown, "peak of", forces, force_row);
    if (founded.n > 0) {
        PRINT_TABLE(s, &founded, "peak of", foundations, foundation_row);
    }
    if (isolated.n > 0) {
        PRINT_TABLE(s, &isolated, "isolator", isolators, isolator_row);
    }
}

// The energies of the end, as the tables have numbers.
static void print_energies(const struct report_summary *s, const char *unit) {
    static const enum energy energy[] = {ENERGY_INPUT, ENERGY_DAMPING, ENERGY_HYSTERETIC,
                                         ENERGY_CONTACT};
    char text[4][32];
    for (int i = 0; i < 4; i++) {
        printer_read(s->r->energy[energy[i]], 4, text[i], sizeof text[i]);
    }
    fprintf(s->to, "energy      [%s] input %s; damping %s, storeys %s, contacts%s %s\n", unit,
            text[0], text[1], text[2], s->r->n_link > 0 ? " and links" : "", text[3]);
}

static void print_totals(const struct report_summary *s) {
    const struct report *r = s->r;
    const struct totals *t = &r->totals;
    const double input = r->energy[ENERGY_INPUT];
    char unit[40];
    unit_text(&r->units, dimension_energy, unit, sizeof unit);
    if (r->dt > 0.0) {
        fprintf(s->to,
                "\nsteps       %ld (%ld rejected, %ld split at impacts, %ld not to tolerance)\n",
                t->steps, t->rejected, t->events, t->unsolved);
        if (t->indefinite > 0) {
            fprintf(s->to, "            %ld of the rejected because a stiffness was negative\n",
                    t->indefinite);
        }
        fprintf(s->to, "iterations  %ld\n", t->iterations);
    } else {
        fprintf(s->to, "\nsteps       %ld (%ld rejected, %ld events located)\n", t->steps,
                t->rejected, t->events);
    }
    print_energies(s, unit);
    fprintf(s->to, "residual    [%s] %.4g at the rows written", unit, r->residual_peak);
    if (input > 0) {
        fprintf(s->to, ", %.2g of the input", r->residual_peak / input);
    }
    fprintf(s->to, "\nwall time   %.3g s\n", t->seconds);
    if (r->file) {
        safe_line(s->to, "results     %s", r->file);
    }
}

int report_print(const struct report *r, FILE *to, struct error *e) {
    struct report_summary s = {.to = to, .r = r, .e = e};
    print_head(r, to);
    const struct report_shown shown = choose_buildings(r);
    PRINT_TABLE(&s, &shown, "building", buildings, building_row);
    report_summary_rest(&s, r->n_building - shown.n, "buildings", "drift");
    if (r->n_building > 0 && r->building[0].peak[0]) {
        print_peaks(&s, &shown);
        const struct report_building *building[SHOWN_MAX];
        for (int i = 0; i < shown.n; i++) {
            building[i] = &r->building[shown.choice[i].index];
        }
        report_members_print(r, building, shown.n, to);
        report_links_contacts(&s);
        report_links_links(&s);
        report_links_columns(&s);
        print_totals(&s);
    }
    return s.status;
}
