// SPDX-License-Identifier: GPL-3.0-or-later
// jostle laws: every contact and storey law, from the descriptors in src/law/.
#include <string.h>

#include "command/rows.h"
#include "jostle/contact_law.h"
#include "jostle/storey_law.h"
#include "law/bilateral.h"

static int laws_command(int argc, char **argv);

const struct command command_laws = {
    .name = "laws",
    .usage = "[NAME] [--markdown]",
    .summary = "prints the contact and storey laws with their parameters and sources",
    .run = laws_command,
};

enum { LAWS_MAX = 128 };

static const char introduction[] =
    "d: penetration, v = dd/dt, v0: v at the instant of closure, m*: effective mass of the two\n"
    "bodies, m1 m2 / (m1 + m2), or the mass itself against a wall; e: coefficient of restitution;\n"
    "V: storey shear. Units and defaults are given in SI; a number may carry any unit of the same\n"
    "dimension, and a bare one is in the deck's units. Of the options marked `one of`, exactly\n"
    "one must be given.\n\n";

static void print_contact_law(enum page page, const struct contact_law *law) {
    rows_heading(page, 3, law->name);
    rows_entry(page, "what", law->summary);
    rows_code(page, "force", law->formula);
    rows_entry(page, "source", law->source);
    rows_entry(page, "remarks", law->remarks);
    static const struct {
        enum contact_trait trait;
        const char *text;
    } known[] = {
        {CONTACT_JUMPS, "the force jumps at closure"},
        {CONTACT_MAY_PULL, "the force may be tension"},
        {CONTACT_NEEDS_V0, "the force depends on v0"},
        {CONTACT_NEEDS_MASS, "the force depends on m*"},
    };
    char text[256] = "";
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (law->traits & known[i].trait) {
            size_t used = strlen(text);
            snprintf(text + used, sizeof text - used, "%s%s", used ? "; " : "", known[i].text);
        }
    }
    rows_entry(page, "solver", text[0] ? text : NULL);
    // The command that shows an impact, and on the page its picture, which `make docs` draws by it.
    char command[256];
    if (law->example) {
        snprintf(command, sizeof command, "jostle law %s %s -m1 25t -m2 40t -v 0.5m/s", law->name,
                 law->example);
        rows_example(page, command);
        if (page == PAGE_MARKDOWN) {
            printf("\n![Force of %s in this impact](pictures/law_%s.svg)\n", law->name, law->name);
        }
    }
    rows_print(page, law->row, law->n_row);
    printf("\n");
}

static void print_storey_law(enum page page, const struct storey_law *law) {
    rows_heading(page, 3, law->name);
    rows_entry(page, "what", law->summary);
    rows_code(page, "shear", law->formula);
    rows_entry(page, "source", law->source);
    rows_entry(page, "remarks", law->remarks);
    rows_print(page, law->row, law->n_row);
    printf("\n");
}

static void print_all(enum page page) {
    if (page == PAGE_MARKDOWN) {
        rows_generated("laws");
        rows_heading(page, 1, "Laws");
    }
    fputs(introduction, stdout);
    rows_heading(page, 2,
                 page == PAGE_TEXT ? "Contact laws, for contact -law NAME\n"
                                   : "Contact laws, for `contact ... -law NAME`");
    for (int i = 0; i < n_contact_law; i++) {
        print_contact_law(page, contact_laws[i]);
    }
    rows_heading(page, 2,
                 page == PAGE_TEXT ? "Storey laws, for storey BUILDING:FLOORS NAME\n"
                                   : "Storey laws, for `storey BUILDING:FLOORS NAME`");
    for (int i = 0; i < n_storey_law; i++) {
        print_storey_law(page, storey_laws[i]);
    }
    rows_heading(page, 2, page == PAGE_TEXT ? "The law of link\n" : "The law of `link`");
    print_contact_law(page, &bilateral_law);
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
    return command_unknown(&command_laws, "law", name, known, n);
}

static int print(enum page page, const char *name) {
    if (!name) {
        print_all(page);
        return EXIT_DONE;
    }
    const struct contact_law *contact = contact_law_find(name);
    const struct storey_law *storey = storey_law_find(name);
    if (!contact && strcmp(name, bilateral_law.name) == 0) {
        contact = &bilateral_law;
    }
    if (contact) {
        print_contact_law(page, contact);
    }
    if (storey) {
        print_storey_law(page, storey);
    }
    return contact || storey ? EXIT_DONE : unknown(name);
}

static int laws_command(int argc, char **argv) {
    return rows_command(&command_laws, argc, argv, print);
}
