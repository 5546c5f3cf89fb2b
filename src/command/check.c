// SPDX-License-Identifier: GPL-3.0-or-later
// jostle check: reads a deck and prints the model it describes.
#include <gsl/gsl_math.h>
#include <string.h>

#include "command/check.h"
#include "command/deck_command.h"
#include "command/law_print.h"
#include "command/printer.h"
#include "command/sweeps.h"
#include "core/safe.h"
#include "model/foundation.h"
#include "model/frame.h"

static int check_command(int argc, char **argv);

const struct command command_check = {
    .name = "check",
    .usage = "DECK [-D NAME=VALUE]...",
    .summary = "checks a deck and prints its model and the step that it needs",
    .run = check_command,
};

enum { UNIT_TEXT = 48, MODES_SHOWN = 3 };

struct unit_texts {
    char force[UNIT_TEXT], mass[UNIT_TEXT], acceleration[UNIT_TEXT];
    const char *time;
};

static struct unit_texts units_of(const struct model *m) {
    const struct unit_system *s = &m->deck->units;
    struct unit_texts t = {.time = s->time_name};
    unit_text(s, dimension_force, t.force, sizeof t.force);
    unit_text(s, dimension_mass, t.mass, sizeof t.mass);
    unit_text(s, dimension_acceleration, t.acceleration, sizeof t.acceleration);
    return t;
}

static const struct printer_column storey_columns[] = {
    COLUMN_TEXT("floor", 8),
    {"mass", NULL, NULL, &dimension_mass, 14, 6, LOOK_G},
    {"storey stiffness", NULL, NULL, &dimension_stiffness, 18, 6, LOOK_G},
    {"height", NULL, NULL, &dimension_length, 10, 4, LOOK_G},
    COLUMN_TEXT("storey law", 0)};
static const struct printer_column link_columns[] = {
    COLUMN_TEXT("contact or link", -28),
    {"gap", NULL, NULL, &dimension_length, 10, 4, LOOK_G},
    {"m*", NULL, NULL, &dimension_mass, 12, 6, LOOK_G},
    COLUMN_TEXT("law", 0)};

// Has a column of the storey below floor `i` (from 0), or a beam of that floor, hinges?
static bool has_hinges(const struct building *own, int i) {
    for (int p = 0; p < own->n_part; p++) {
        const struct plane_frame *f = frame_of(&own->part[p]);
        for (int k = 0; f && k < f->n_member; k++) {
            const struct frame_member *member = &f->member[k];
            if (member->level == i + 1 && (member->hinge[0] >= 0 || member->hinge[1] >= 0)) {
                return true;
            }
        }
    }
    return false;
}

// The law of a storey, and whether its frame yields.
enum { LAW_TEXT = 48 };
static const char *law_of(const struct model *m, const struct building *g, int i,
                          char text[LAW_TEXT]) {
    const struct storey_law *law = foundation_storey(m, g, i)->law;
    const bool hinges = has_hinges(g->fixed ? g->fixed : g, i);
    const bool both = hinges && law->n_history > 0;
    snprintf(text, LAW_TEXT, "%s%s", hinges && !both ? "hinges" : law->name,
             both ? ", hinges" : "");
    return text;
}

// The last of the storeys from `first` on that are like it.
static int last_alike(const struct model *m, const struct building *g, const struct building *own,
                      int first) {
    char law[LAW_TEXT], other[LAW_TEXT];
    int last = first;
    law_of(m, g, first, law);
    while (last + 1 < g->n_floor && own->mass[last + 1] == own->mass[first] &&
           own->stiffness[last + 1] == own->stiffness[first] &&
           (!g->height || g->height[last + 1] == g->height[first]) &&
           strcmp(law_of(m, g, last + 1, other), law) == 0) {
        last++;
    }
    return last;
}

static int print_storeys(const struct model *m, const struct building *g) {
    struct printer t = {.to = stdout, .units = &m->deck->units, .at_head = UNITS_BELOW_BARE};
    const struct building *own = g->fixed ? g->fixed : g;
    PRINTER_ADD(&t, storey_columns);
    printer_head(&t);
    for (int i = 0, last; i < g->n_floor; i = last + 1) {
        char floors[32], law[LAW_TEXT];
        last = last_alike(m, g, own, i);
        snprintf(floors, sizeof floors, last > i ? "%d:%d" : "%d", i + 1, last + 1);
        printer_text(&t, floors);
        printer_number(&t, own->mass[i]);
        printer_number(&t, own->stiffness[i]);
        printer_number(&t, g->height ? g->height[i] : (double)NAN);
        printer_text(&t, law_of(m, g, i, law));
        printer_line(&t);
    }
    return printer_close(&t);
}

// The loads of P-delta at the base, and how far the building is from buckling under them.
static void print_pdelta(const struct building *g, const struct unit_texts *t) {
    int most = 0;
    for (int i = 1; i < g->n_floor; i++) {
        most = g->theta[i] > g->theta[most] ? i : most;
    }
    safe_line(stdout,
              "  P-delta: %.6g %s at the base, largest P drift / (V h) %.4g in storey %d, buckling "
              "factor %.4g",
              g->axial[0], t->force, g->theta[most], most + 1, g->buckling);
}

// The drifts at which a run ends.
static void print_collapse(const struct model *m, const struct building *g) {
    double least = INFINITY, most = 0.0;
    for (int i = g->first; m->collapse && i < g->first + g->n_floor; i++) {
        least = fmin(least, m->collapse[i]);
        most = isinf(m->collapse[i]) ? most : fmax(most, m->collapse[i]);
    }
    if (most > least) {
        printf("  a run ends, collapsed, at a storey drift of %.4g to %.4g %s\n", least, most,
               m->deck->units.length_name);
    } else if (most > 0.0) {
        printf("  a run ends, collapsed, at a storey drift of %.4g %s\n", most,
               m->deck->units.length_name);
    }
}

static void print_foundation(const struct model *m, const struct foundation *f) {
    const struct unit_system *u = &m->deck->units;
    char mass[UNIT_TEXT], sway[UNIT_TEXT], rocking[UNIT_TEXT];
    unit_text(u, dimension_mass, mass, sizeof mass);
    unit_text(u, dimension_stiffness, sway, sizeof sway);
    unit_text(u, dimension_energy, rocking, sizeof rocking);
    safe_line(stdout, "  foundation: mass %.6g %s, sway %.6g %s, rocking %.6g %s", f->mass, mass,
              f->sway, sway, f->rocking, rocking);
}

static int print_building(const struct model *m, const struct building *g,
                          const struct unit_texts *t) {
    double mass = 0.0;
    for (int i = 0; i < g->n_floor; i++) {
        mass += g->mass[i];
    }
    fputc('\n', stdout);
    safe_line(stdout, "building %s: %d floor%s, mass %.6g %s", g->name, g->n_floor,
              g->n_floor == 1 ? "" : "s", mass, t->mass);
    // Periods and damping ratios of the first modes.
    for (int k = 0; k < g->n_dof && k < MODES_SHOWN; k++) {
        double ratio = building_damping_ratio(g, k + 1);
        if (g->omega[k] == 0.0) {
            printf("  mode %d: rigid body\n", k + 1);
            continue;
        }
        printf("  mode %d: period %.4g %s", k + 1, 2.0 * M_PI / g->omega[k], t->time);
        if (!isnan(ratio)) {
            printf(", damping %.4g %%", 100.0 * ratio);
        }
        printf("\n");
    }
    if (g->axial) {
        print_pdelta(g, t);
    }
    print_collapse(m, g);
    const struct building *own = g->fixed ? g->fixed : g;
    for (int i = 0; i < own->n_part; i++) {
        if (own->part[i].kind->traits & PART_SHARELESS) {
            continue;
        }
        safe_line(stdout, "  %s: %d x %d from %s", own->part[i].name, g->n_floor, g->n_floor,
                  own->part[i].source);
    }
    if (g->isolated > 0) {
        printf("  isolators: storey %d\n", g->isolated);
    }
    if (g->foundation) {
        print_foundation(m, g->foundation);
    }
    return print_storeys(m, g);
}

static void print_signals(const struct model *m, const struct unit_texts *t) {
    const struct unit_system *u = &m->deck->units;
    const double gravity = unit_size(u, dimension_acceleration) / u->gravity;
    for (int k = 0; k < m->n_ground; k++) {
        const struct ground *g = &m->ground[k];
        printf("\nground under");
        for (int i = 0; i < m->n_building; i++) {
            if (m->building[i].ground == k) {
                printf(" %s", m->building[i].name);
            }
        }
        printf(g->n_signal ? ":\n" : ": at rest\n");
        for (int i = 0; i < g->n_signal; i++) {
            const struct signal *s = &g->signal[i];
            safe_line(stdout, "  %s: peak %.4g %s = %.4g g, from %.4g to %.4g %s", s->name,
                      signal_peak(s), t->acceleration, signal_peak(s) * gravity, s->start, s->end,
                      t->time);
            if (s->mean != 0.0) {
                printf("    a mean of %.4g %s was subtracted\n", s->mean, t->acceleration);
            }
            if (s->scaled) {
                safe_line(stdout, "    %s", s->scaled);
            }
        }
    }
}

static bool same_law(const struct link *a, const struct link *b) {
    return a->law == b->law && a->calibrated == b->calibrated &&
           contact_law_n_value(a->law, a->value) == contact_law_n_value(b->law, b->value) &&
           memcmp(a->value, b->value,
                  (size_t)contact_law_n_value(a->law, a->value) * sizeof *a->value) == 0;
}

enum { WORDS_SIZE = 256 };

static int print_links(const struct model *m) {
    struct printer t = {.to = stdout, .units = &m->deck->units, .at_head = UNITS_BELOW_BARE};
    if (m->n_link == 0) {
        printf("\nno contacts\n");
        return EXIT_DONE;
    }
    printf("\n");
    PRINTER_ADD(&t, link_columns);
    printer_head(&t);
    for (int k = 0; k < m->n_link; k++) {
        const struct link *l = &m->link[k];
        printer_text(&t, l->name);
        printer_number(&t, l->bilateral ? (double)NAN : l->gap);
        printer_number(&t, l->mass);
        printer_text(&t, l->law->name);
        printer_line(&t);
    }
    // The parameters of the laws as a deck would give them, once for neighbours that share them.
    printf("\n");
    for (int first = 0, last; first < m->n_link; first = last + 1) {
        const struct link *l = &m->link[first];
        last = first;
        while (last + 1 < m->n_link && same_law(l, &m->link[last + 1])) {
            last++;
        }
        char words[WORDS_SIZE], calibrated[48] = "";
        law_print_words(l->law, l->value, words, sizeof words);
        if (l->calibrated) {
            snprintf(calibrated, sizeof calibrated, ", calibrated for e = %.6g", l->restitution);
        }
        safe_line(stdout, "%s%s%s: %s%s", l->name, last > first ? " to " : "",
                  last > first ? m->link[last].name : "", words, calibrated);
    }
    return printer_close(&t);
}

static void print_time(const struct model *m, const struct unit_texts *t) {
    if (m->adaptive) {
        double omega = 0.0;
        for (int k = 0; k < m->n_building; k++) {
            const struct building *g = &m->building[k];
            omega = fmax(omega, g->omega[g->n_dof - 1]);
        }
        if (m->integrator == INTEGRATOR_NEWMARK) {
            printf("\nnewmark beta %g gamma %g", m->beta, m->gamma);
        } else {
            printf("\ndormand-prince");
        }
        printf(", adaptive steps to the tolerance %g, duration %.6g %s\n", m->control.tolerance,
               m->duration, t->time);
        if (omega > 0.0) {
            printf("shortest period of a building %.4g %s\n", 2.0 * M_PI / omega, t->time);
        }
        printf("a row of output every %.6g %s, %ld rows\n", m->dt, t->time, m->n_step + 1);
        return;
    }
    printf("\nnewmark beta %g gamma %g, %ld steps of %.6g %s, duration %.6g %s\n", m->beta,
           m->gamma, m->n_step, m->dt, t->time, m->duration, t->time);
    printf("a row of output every %d step%s, %ld rows\n", m->output.every,
           m->output.every == 1 ? "" : "s", model_rows(m));
}

struct check_options {
    struct load_request load;
    struct guidance guidance;
};

static int check(void *options, const struct model *m) {
    const struct check_options *o = options;
    struct unit_texts t = units_of(m);
    const struct unit_system *s = &m->deck->units;
    if (m->deck->title[0]) {
        safe_line(stdout, "%s", m->deck->title);
    }
    printf("units %s %s %s, mass in %s\n", s->force_name, s->length_name, s->time_name, t.mass);
    sweeps_print_first(m->deck, "\n", "");
    int status = EXIT_DONE;
    for (int k = 0; k < m->n_building && status == EXIT_DONE; k++) {
        status = print_building(m, &m->building[k], &t);
    }
    status = status == EXIT_DONE ? print_links(m) : status;
    if (status != EXIT_DONE) {
        return status;
    }
    print_signals(m, &t);
    for (int i = 0; i < m->n_load; i++) {
        const struct load *load = &m->load[i];
        const struct building *g = m->building;
        while (load->dof >= g->first + g->n_dof) {
            g++;
        }
        if (load->dof - g->first >= g->n_floor) {
            continue;  // it belongs to a foundation
        }
        fputs(i ? "" : "\n", stdout);
        safe_line(stdout, "load on %s:%d: %s, peak %.4g %s", g->name, load->dof - g->first + 1,
                  load->signal.name, signal_peak(&load->signal), t.force);
    }
    print_time(m, &t);
    if (deck_is_study(m->deck)) {
        return check_study(&o->load, m);
    }
    if (!m->adaptive) {
        guidance_print(m, &o->guidance);
    }
    return EXIT_DONE;
}

static int check_command(int argc, char **argv) {
    static const struct option_row rows[] = {DECK_DEFINE_ROW, {0}};
    static const struct option_part parts[] = {{.row = rows}, {.row = option_help}, {0}};
    static const struct deck_command c = {&command_check, parts, .use = check};
    struct check_options o = {.load = {.guidance = &o.guidance, .checks = true}};
    return deck_command_run(&c, argc, argv, &o.load);
}
