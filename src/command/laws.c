// SPDX-License-Identifier: GPL-3.0-or-later
// jostle laws: every contact and storey law, from the descriptors in src/law/.
#include <string.h>

#include "command/rows.h"
#include "core/text.h"
#include "jostle/contact_law.h"
#include "jostle/storey_law.h"
#include "law/bilateral.h"
#include "law/link_law.h"
#include "law/power.h"
#include "law/restitution.h"
#include "law/yield.h"

static int laws_command(int argc, char **argv);

const struct command command_laws = {
    .name = "laws",
    .usage = "[NAME] [--markdown]",
    .summary = "prints the contact and storey laws with their parameters and sources",
    .run = laws_command,
};

enum { LAWS_MAX = 128 };

static const char introduction[] =
    "Symbols: d is the penetration, v = dd/dt, v0 is v at the instant of closure, e is the "
    "coefficient\n"
    "of restitution, V is the storey shear. m* = m1 m2 / (m1 + m2) is the effective mass of two\n"
    "bodies, or the mass of one body against a wall.\n\n"
    "Units and defaults are given in SI. A number may carry any unit of the same dimension; a "
    "bare\n"
    "number is in the deck's units. Of the options marked `one of`, give exactly one.\n";

// Options that many laws have in common. The Markdown page explains them once.
static const struct row shared_rows[] = {
    {"k", ROW_NUMBER, ROW_REQUIRED, OF_NONE, &range_positive, NAN, "impact stiffness"},
    RESTITUTION_ROW,
    {"zeta", ROW_NUMBER, ROW_ONE_OF, OF_NONE, &range_non_negative, NAN,
     "damping ratio zeta; if the formula has zeta d^n v or q, the number q = zeta v0 / k"},
    LEAST_V0_ROW,
    {"n", ROW_NUMBER, ROW_POWER, OF_NONE, &power_range, 1.5, "exponent"},
};

static bool shared(const struct row *row) {
    static const char *const damping[] = {"damping ratio", HYSTERESIS_ZETA_DOC};
    for (size_t i = 0; i < sizeof shared_rows / sizeof shared_rows[0]; i++) {
        const struct row *s = &shared_rows[i];
        const unsigned given = ROW_REQUIRED | ROW_ONE_OF;
        if (strcmp(s->key, row->key) == 0 && (s->flags & given) == (row->flags & given)) {
            return strcmp(s->doc, row->doc) == 0 || strcmp(damping[0], row->doc) == 0 ||
                   strcmp(damping[1], row->doc) == 0;
        }
    }
    return false;
}

// The same for storey laws.
static const struct row yield_rows[] = {YIELD_ROW, HARDENING_ROW};

static bool yields(const struct row *row) {
    for (size_t i = 0; i < sizeof yield_rows / sizeof yield_rows[0]; i++) {
        if (strcmp(row->key, yield_rows[i].key) == 0 && row->range == yield_rows[i].range) {
            return true;
        }
    }
    return false;
}

// What users need to know about the force besides its formula.
static void print_features(enum page page, const struct contact_law *law) {
    char text[128];
    const bool v0 = law->traits & CONTACT_NEEDS_V0, mass = law->traits & CONTACT_NEEDS_MASS;
    snprintf(text, sizeof text, "%s at closure, %s%s%s%s",
             law->traits & CONTACT_JUMPS ? "jump" : "no jump",
             law->traits & CONTACT_MAY_PULL ? "tension possible" : "no tension",
             v0 || mass ? ", depends on " : "", v0 ? "v0" : "", mass ? "m*" : "");
    rows_entry(page, "features", text);
}

static void print_contact_law(enum page page, const struct contact_law *law) {
    rows_heading(page, 3, law->name);
    rows_entry(page, "what", law->summary);
    rows_code(page, "force", law->formula);
    if (law->force && contact_law_find(law->name)) {
        print_features(page, law);
    }
    rows_entry(page, "remarks", law->remarks);
    rows_entry(page, "source", law->source);
    // The command that shows an impact, and on the page its picture, which `make docs` draws by it.
    char command[256];
    if (law->example) {
        snprintf(command, sizeof command, "jostle law %s %s -m1 25t -m2 40t -v 0.5m/s", law->name,
                 law->example);
        rows_example(page, command);
    }
    if (page == PAGE_MARKDOWN) {
        rows_names(law->row, law->n_row, shared);
    }
    rows_print(page, law->row, law->n_row, shared);
    if (law->example && page == PAGE_MARKDOWN) {
        printf("\n![Force of %s in this impact](pictures/law_%s.svg)\n", law->name, law->name);
    }
    printf("\n");
}

static void print_storey_law(enum page page, const struct storey_law *law) {
    rows_heading(page, 3, law->name);
    rows_entry(page, "what", law->summary);
    rows_code(page, "shear", law->formula);
    rows_entry(page, "source", law->source);
    rows_entry(page, "remarks", law->remarks);
    char command[256];
    if (law->example) {
        snprintf(command, sizeof command,
                 "jostle law storey %s %s -stiffness 60MN/m -amplitude 60mm", law->name,
                 law->example);
        rows_example(page, command);
    }
    if (page == PAGE_MARKDOWN) {
        rows_names(law->row, law->n_row, yields);
    }
    rows_print(page, law->row, law->n_row, yields);
    if (law->example && page == PAGE_MARKDOWN) {
        printf("\n![Loops of %s under the protocol of FEMA 461](pictures/storey_%s.svg)\n",
               law->name, law->name);
    }
    printf("\n");
}

// A law of links that is no storey law by its own name.
static void print_link_law(enum page page, const struct link_law *law) {
    if (law->law) {
        print_contact_law(page, law->law);
        return;
    }
    rows_heading(page, 3, law->name);
    rows_entry(page, "what", law->what);
    rows_print(page, law->row, law->row == law->storey->row ? 0 : law->n_row, NULL);
    printf("\n");
}

static void print_link_laws(enum page page) {
    rows_heading(page, 2, page == PAGE_TEXT ? "Laws of links\n" : "Laws of links");
    printf(
        "For link -law NAME. Each storey law but fps is a law of links: its shear is the tension "
        "of the link, its drift\nthe lengthening. A link with a storey law, friction, hook, cable "
        "or "
        "gap has "
        "these options, with one value\nor one for each link:\n%s",
        page == PAGE_TEXT ? "\n" : "");
    rows_print(page, link_law_rows, LINK_ROWS, NULL);
    printf("\n");
    for (int i = 0; i < n_link_law; i++) {
        const struct link_law law = link_law_at(i);
        if (law.law || law.what) {
            print_link_law(page, &law);
        }
    }
}

static void print_all(enum page page) {
    if (page == PAGE_MARKDOWN) {
        rows_generated("laws");
        rows_heading(page, 1, "Laws");
    }
    fputs(introduction, stdout);
    if (page == PAGE_MARKDOWN) {
        printf("\n[contact-values.md](contact-values.md) recommends laws and values.\n");
        printf("\nMany contact laws have these options. Below, such a law only names them:\n");
        rows_print(page, shared_rows, sizeof shared_rows / sizeof shared_rows[0], NULL);
    }
    printf("\n");
    rows_heading(page, 2,
                 page == PAGE_TEXT ? "Contact laws, for contact -law NAME\n"
                                   : "Contact laws, for `contact ... -law NAME`");
    for (int i = 0; i < n_contact_law; i++) {
        print_contact_law(page, contact_laws[i]);
    }
    rows_heading(page, 2,
                 page == PAGE_TEXT ? "Storey laws, for storey BUILDING:FLOORS NAME\n"
                                   : "Storey laws, for `storey BUILDING:FLOORS NAME`");
    if (page == PAGE_MARKDOWN) {
        printf("All storey laws except elastic have these options. In the formulas V_y is -yield, "
               "R is -hardening,\nk is the initial stiffness and d_y = V_y / k.\n");
        rows_print(page, yield_rows, sizeof yield_rows / sizeof yield_rows[0], NULL);
        printf("\n");
    }
    for (int i = 0; i < n_storey_law; i++) {
        print_storey_law(page, storey_laws[i]);
    }
    print_link_laws(page);
}

static int unknown(const char *name) {
    const char *known[LAWS_MAX];
    int n = 0;
    for (int i = 0; i < n_contact_law && n < LAWS_MAX; i++) {
        known[n++] = contact_laws[i]->name;
    }
    for (int i = 0; i < n_storey_law && n < LAWS_MAX; i++) {
        if (!contact_law_find(storey_laws[i]->name)) {
            known[n++] = storey_laws[i]->name;
        }
    }
    for (int i = 0; i < n_link_law && n < LAWS_MAX; i++) {
        const struct link_law law = link_law_at(i);
        if (law.law || law.what) {
            known[n++] = law.name;
        }
    }
    return text_nearest(name, known, n)
               ? command_unknown(&command_laws, "law", name, known, n)
               : command_usage(&command_laws, "unknown law '%s'; 'jostle laws' lists all", name);
}

static int print(enum page page, const char *name) {
    if (!name) {
        print_all(page);
        return EXIT_DONE;
    }
    const struct contact_law *contact = contact_law_find(name);
    const struct storey_law *storey = storey_law_find(name);
    bool found = contact || storey;
    for (int i = 0; i < n_link_law; i++) {
        const struct link_law law = link_law_at(i);
        if ((law.law || law.what) && strcmp(law.name, name) == 0) {
            print_link_law(page, &law);
            found = true;
        }
    }
    if (contact) {
        print_contact_law(page, contact);
    }
    if (storey) {
        print_storey_law(page, storey);
    }
    return found ? EXIT_DONE : unknown(name);
}

static int laws_command(int argc, char **argv) {
    return rows_command(&command_laws, argc, argv, print);
}
