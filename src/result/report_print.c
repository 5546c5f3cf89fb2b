// SPDX-License-Identifier: GPL-3.0-or-later
// The summary as text. Long lists are cut to the most severe entries, and a line says so.
#include <math.h>
#include <string.h>

#include "core/safe.h"
#include "core/text.h"
#include "jostle/result.h"
#include "result/choice.h"

enum { NAME_WIDTH_MAX = 16, LINK_WIDTH_MAX = 33, LAW_WIDTH_MAX = 17 };

// Unit texts of the headings, in brackets.
enum unit {
    UNIT_LENGTH,
    UNIT_TIME,
    UNIT_FORCE,
    UNIT_MASS,
    UNIT_ACCELERATION,
    UNIT_IMPULSE,
    UNIT_ENERGY,
    UNIT_COUNT
};

struct printer {
    FILE *to;
    const struct report *r;
    char unit[UNIT_COUNT][48];
};

static void units_init(struct printer *p) {
    const struct dimension *const dimension[UNIT_COUNT] = {
        [UNIT_LENGTH] = &dimension_length,
        [UNIT_TIME] = &dimension_time,
        [UNIT_FORCE] = &dimension_force,
        [UNIT_MASS] = &dimension_mass,
        [UNIT_ACCELERATION] = &dimension_acceleration,
        [UNIT_IMPULSE] = &dimension_impulse,
        [UNIT_ENERGY] = &dimension_energy,
    };
    for (int i = 0; i < UNIT_COUNT; i++) {
        char text[40];
        unit_text(&p->r->units, *dimension[i], text, sizeof text);
        snprintf(p->unit[i], sizeof p->unit[i], "[%s]", text);
    }
}

// A blank and four digits; numbers of five or six before the point are whole, with no power of ten
// to be read.
static void number(FILE *to, double value, int width) {
    const double size = fabs(value);
    if (isnan(value)) {
        fprintf(to, " %*s", width, "-");
    } else {
        fprintf(to, size >= 1e4 && size < 999999.5 ? " %*.0f" : " %*.4g", width, value);
    }
}

static int widest(int width, const char *text, int limit) {
    const int n = text_columns(text, strlen(text));
    return n <= width ? width : n < limit ? n : limit;
}

static void not_shown(const struct printer *p, int n, const char *what, const char *order) {
    if (n > 0) {
        safe_line(p->to, "  %d more %s not shown (by %s); all are in %s%s", n, what, order,
                  p->r->file ? p->r->file : "the result file",
                  p->r->file ? " (jostle show --tsv)" : "");
    }
}

// Index of the largest value; 0 if all are NaN.
static int largest(const double *value, int n) {
    int at = 0;
    for (int i = 1; i < n; i++) {
        at = value[i] > value[at] || isnan(value[at]) ? i : at;
    }
    return at;
}

static double peak_of(const struct report_building *b, enum peak p) {
    return b->peak[p] ? b->peak[p][largest(b->peak[p], b->n_floor)] : 0;
}

struct shown_buildings {
    struct choice choice[SHOWN_MAX];
    int n;
    int width;
};

static struct shown_buildings choose_buildings(const struct report *r) {
    struct shown_buildings s = {.n = 0, .width = 8};
    for (int i = 0; i < r->n_building; i++) {
        s.n = choice_add(s.choice, s.n, SHOWN_MAX,
                         (struct choice){.rank = peak_of(&r->building[i], PEAK_DRIFT), .index = i});
    }
    choice_sort(s.choice, s.n);
    for (int i = 0; i < s.n; i++) {
        s.width = widest(s.width, r->building[s.choice[i].index].name, NAME_WIDTH_MAX);
    }
    return s;
}

static void print_buildings(const struct printer *p, const struct shown_buildings *s) {
    FILE *to = p->to;
    fprintf(to, "\n%-*s %6s %10s %9s %9s %9s\n", s->width, "building", "floors", "mass", "T1", "T2",
            "T3");
    fprintf(to, "%-*s %6s %10s %9s %9s %9s\n", s->width, "", "", p->unit[UNIT_MASS],
            p->unit[UNIT_TIME], p->unit[UNIT_TIME], p->unit[UNIT_TIME]);
    for (int i = 0; i < s->n; i++) {
        const struct report_building *b = &p->r->building[s->choice[i].index];
        double mass = 0;
        for (int f = 0; f < b->n_floor; f++) {
            mass += b->mass[f];
        }
        safe_cell(to, b->name, s->width);
        fprintf(to, " %6d", b->n_floor);
        number(to, mass, 10);
        for (int t = 0; t < 3; t++) {
            number(to, t < b->n_floor ? b->period[t] : (double)NAN, 9);
        }
        fprintf(to, "\n");
    }
    not_shown(p, p->r->n_building - s->n, "buildings", "drift");
}

// The largest of the drifts; returns the index of its storey.
static int print_drift(FILE *to, const struct report_building *b, const double *drift) {
    const int i = largest(drift, b->n_floor);
    number(to, drift[i], 12);
    number(to, b->height[i] > 0 ? 100 * drift[i] / b->height[i] : (double)NAN, 9);
    fprintf(to, " %7d", i + 1);
    return i;
}

static void print_displacements(const struct printer *p, const struct shown_buildings *s) {
    FILE *to = p->to;
    fprintf(to, "\n%-*s %12s %8s %12s %9s %7s %8s\n", s->width, "peak of", "roof displ.", "time",
            "storey drift", "of height", "storey", "time");
    fprintf(to, "%-*s %12s %8s %12s %9s %7s %8s\n", s->width, "", p->unit[UNIT_LENGTH],
            p->unit[UNIT_TIME], p->unit[UNIT_LENGTH], "[%]", "", p->unit[UNIT_TIME]);
    for (int i = 0; i < s->n; i++) {
        const struct report_building *b = &p->r->building[s->choice[i].index];
        const int roof = b->n_floor - 1;
        safe_cell(to, b->name, s->width);
        number(to, b->peak[PEAK_DISPLACEMENT][roof], 12);
        number(to, b->peak_time[PEAK_DISPLACEMENT][roof], 8);
        const int storey = print_drift(to, b, b->peak[PEAK_DRIFT]);
        number(to, b->peak_time[PEAK_DRIFT][storey], 8);
        fprintf(to, "\n");
    }
}

// Of storeys that can yield.
static void print_residuals(const struct printer *p, const struct shown_buildings *s) {
    FILE *to = p->to;
    for (int i = 0, n = 0; i < s->n; i++) {
        const struct report_building *b = &p->r->building[s->choice[i].index];
        if (b->residual_drift && n++ == 0) {
            fprintf(to, "\n%-*s %12s %9s %7s\n%-*s %12s %9s\n", s->width, "residual",
                    "storey drift", "of height", "storey", s->width, "", p->unit[UNIT_LENGTH],
                    "[%]");
        }
        if (b->residual_drift) {
            safe_cell(to, b->name, s->width);
            print_drift(to, b, b->residual_drift);
            fprintf(to, "\n");
        }
    }
}

static void print_forces(const struct printer *p, const struct shown_buildings *s) {
    FILE *to = p->to;
    const double in_g = unit_in_g(&p->r->units);
    fprintf(to, "\n%-*s %13s %9s %7s %8s %12s %8s\n", s->width, "peak of", "total accel.", "",
            "floor", "time", "base shear", "time");
    fprintf(to, "%-*s %13s %9s %7s %8s %12s %8s\n", s->width, "", p->unit[UNIT_ACCELERATION], "[g]",
            "", p->unit[UNIT_TIME], p->unit[UNIT_FORCE], p->unit[UNIT_TIME]);
    bool any_hit = false;
    for (int i = 0; i < s->n; i++) {
        const struct report_building *b = &p->r->building[s->choice[i].index];
        const int floor = largest(b->peak[PEAK_ACCELERATION], b->n_floor);
        const bool hit = report_floor_was_hit(p->r, b->name, floor + 1);
        safe_cell(to, b->name, s->width);
        number(to, b->peak[PEAK_ACCELERATION][floor], 13);
        number(to, b->peak[PEAK_ACCELERATION][floor] * in_g, 9);
        fprintf(to, "%c%7d", hit ? '*' : ' ', floor + 1);
        any_hit |= hit;
        number(to, b->peak_time[PEAK_ACCELERATION][floor], 8);
        number(to, b->peak[PEAK_SHEAR][0], 12);
        number(to, b->peak_time[PEAK_SHEAR][0], 8);
        fprintf(to, "\n");
    }
    if (any_hit) {
        fprintf(to, "%s\n", report_hit_note);
    }
}

static void print_contact(FILE *to, const struct report_link *c, int name_width, int law_width) {
    safe_cell(to, c->name, name_width);
    if (law_width > 0) {
        fprintf(to, " ");
        safe_cell(to, c->law, law_width);
    }
    number(to, c->gap, 9);
    fprintf(to, " %7ld", c->peak.impacts);
    number(to, c->peak.impacts > 0 ? c->peak.force : (double)NAN, 9);
    number(to, c->peak.impacts > 0 ? c->peak.force_time : (double)NAN, 7);
    number(to, c->peak.impacts > 0 ? c->peak.penetration : (double)NAN, 9);
    number(to, c->peak.impulse, 9);
    number(to, c->peak.dissipated, 9);
    fprintf(to, "\n");
}

// The contacts that are shown: those hit hardest first.
struct shown_contacts {
    struct choice choice[SHOWN_MAX];
    int n, n_hit;
    int name_width, law_width;  // law_width 0: all contacts have the same law
};

static struct shown_contacts choose_contacts(const struct report *r) {
    struct shown_contacts s = {.name_width = 8};
    for (int i = 0; i < r->n_contact; i++) {
        const struct link_peak *peak = &r->contact[i].peak;
        s.n_hit += peak->impacts > 0;
        s.n = choice_add(
            s.choice, s.n, SHOWN_MAX,
            (struct choice){.rank = peak->impacts > 0 ? peak->force : -HUGE_VAL, .index = i});
        if (strcmp(r->contact[i].law, r->contact[0].law) != 0) {
            s.law_width = 3;
        }
    }
    for (int i = 0; i < s.n && s.law_width > 0; i++) {
        s.law_width = widest(s.law_width, r->contact[s.choice[i].index].law, LAW_WIDTH_MAX);
    }
    const int room = LINK_WIDTH_MAX - (s.law_width > 0 ? s.law_width + 1 : 0);
    for (int i = 0; i < s.n; i++) {
        s.name_width = widest(s.name_width, r->contact[s.choice[i].index].name, room);
    }
    return s;
}

static void print_contacts(const struct printer *p) {
    const struct report *r = p->r;
    const struct shown_contacts s = choose_contacts(r);
    fprintf(p->to, "\n%d %s, %d hit, %ld %s", r->n_contact,
            r->n_contact == 1 ? "contact" : "contacts", s.n_hit, r->n_impact,
            r->n_impact == 1 ? "impact" : "impacts");
    if (r->totals.coarse > 0) {
        fprintf(p->to, " (%ld of fewer than %d steps)", r->totals.coarse, IMPACT_STEPS_MIN);
    }
    if (s.n > 0 && s.law_width == 0) {
        fputs(", law ", p->to);
        safe_put(p->to, SAFE_TERMINAL, r->contact[0].law);
    }
    fprintf(p->to, "\n");
    if (s.n == 0) {
        return;
    }
    const char *const gap = s.law_width > 0 ? " " : "";
    fprintf(p->to, "%-*s%s%-*s %9s %7s %9s %7s %9s %9s %9s\n", s.name_width, "contact", gap,
            s.law_width, s.law_width > 0 ? "law" : "", "gap", "impacts", "force", "time", "penetr.",
            "impulse", "dissip.");
    fprintf(p->to, "%-*s%s%-*s %9s %7s %9s %7s %9s %9s %9s\n", s.name_width, "", gap, s.law_width,
            "", p->unit[UNIT_LENGTH], "", p->unit[UNIT_FORCE], p->unit[UNIT_TIME],
            p->unit[UNIT_LENGTH], p->unit[UNIT_IMPULSE], p->unit[UNIT_ENERGY]);
    for (int i = 0; i < s.n; i++) {
        print_contact(p->to, &r->contact[s.choice[i].index], s.name_width, s.law_width);
    }
    not_shown(p, r->n_contact - s.n, "contacts", "force");
}

static void print_links(const struct printer *p) {
    const struct report *r = p->r;
    if (r->n_link == 0) {
        return;
    }
    fprintf(p->to, "\n%-*s %10s %8s %12s %8s %10s\n", LINK_WIDTH_MAX, "link", "force", "time",
            "deformation", "time", "work");
    fprintf(p->to, "%-*s %10s %8s %12s %8s %10s\n", LINK_WIDTH_MAX, "", p->unit[UNIT_FORCE],
            p->unit[UNIT_TIME], p->unit[UNIT_LENGTH], p->unit[UNIT_TIME], p->unit[UNIT_ENERGY]);
    for (int i = 0; i < r->n_link && i < SHOWN_MAX; i++) {
        const struct link_peak *k = &r->link[i].peak;
        safe_cell(p->to, r->link[i].name, LINK_WIDTH_MAX);
        number(p->to, k->force, 10);
        number(p->to, k->force_time, 8);
        number(p->to, k->penetration, 12);
        number(p->to, k->penetration_time, 8);
        number(p->to, k->dissipated, 10);
        fprintf(p->to, "\n");
    }
    not_shown(p, r->n_link - SHOWN_MAX, "links", "number");
}

static void print_energies(const struct printer *p) {
    const struct {
        const char *name;
        enum energy energy;
    } part[] = {{"input", ENERGY_INPUT},
                {"; damping", ENERGY_DAMPING},
                {", storeys", ENERGY_HYSTERETIC},
                {p->r->n_link > 0 ? ", contacts and links" : ", contacts", ENERGY_CONTACT}};
    fprintf(p->to, "energy      %s ", p->unit[UNIT_ENERGY]);
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++) {
        fputs(part[i].name, p->to);
        number(p->to, p->r->energy[part[i].energy], 0);
    }
    fputc('\n', p->to);
}

static void print_totals(const struct printer *p) {
    const struct report *r = p->r;
    const struct totals *t = &r->totals;
    const double input = r->energy[ENERGY_INPUT];
    if (r->dt > 0.0) {
        fprintf(p->to,
                "\nsteps       %ld (%ld rejected, %ld split at impacts, %ld not to tolerance)\n",
                t->steps, t->rejected, t->events, t->unsolved);
        if (t->indefinite > 0) {
            fprintf(p->to, "            %ld of the rejected because a stiffness was negative\n",
                    t->indefinite);
        }
        fprintf(p->to, "iterations  %ld\n", t->iterations);
    } else {
        fprintf(p->to, "\nsteps       %ld (%ld rejected, %ld events located)\n", t->steps,
                t->rejected, t->events);
    }
    print_energies(p);
    fprintf(p->to, "residual    %s %.4g at the rows written", p->unit[UNIT_ENERGY],
            r->residual_peak);
    if (input > 0) {
        fprintf(p->to, ", %.2g of the input", r->residual_peak / input);
    }
    fprintf(p->to, "\nwall time   %.3g s\n", t->seconds);
    if (r->file) {
        safe_line(p->to, "results     %s", r->file);
    }
}

// The number of a run in a study, and the values of its parameters, a line each.
static void print_run(const struct report *r, FILE *to) {
    fprintf(to, "run %ld of a study\n", r->run);
    for (const char *line = r->parameters; *line;) {
        const size_t n = strcspn(line, "\n");
        safe_line(to, "  %.*s", (int)n, line);
        line += n + (line[n] == '\n');
    }
}

static void print_collapse(const struct report *r, FILE *to) {
    const struct report_collapse *c = &r->collapse;
    const char *length = r->units.length_name, *time = r->units.time_name;
    if (c->happened) {
        safe_line(
            to,
            "COLLAPSED at %.6g %s: the drift of storey %ld of building %s reached %.4g %s; the "
            "run ended there",
            c->time, time, c->storey, c->building, fabs(c->drift), length);
    }
}

void report_print(const struct report *r, FILE *to) {
    struct printer p = {.to = to, .r = r};
    units_init(&p);
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
    const struct shown_buildings s = choose_buildings(r);
    print_buildings(&p, &s);
    if (r->n_building > 0 && r->building[0].peak[0]) {
        print_displacements(&p, &s);
        print_residuals(&p, &s);
        print_forces(&p, &s);
        print_contacts(&p);
        print_links(&p);
        print_totals(&p);
    }
}
