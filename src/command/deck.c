// SPDX-License-Identifier: GPL-3.0-or-later
// jostle deck: the statements of a deck, from their descriptors in src/deck/ and src/model/.
#include <string.h>

#include "command/rows.h"
#include "core/text.h"
#include "jostle/contact_law.h"
#include "jostle/model.h"
#include "jostle/storey_law.h"

static int deck_command(int argc, char **argv);

const struct command command_deck = {
    .name = "deck",
    .usage = "[STATEMENT] [--markdown]",
    .summary = "prints the statements of a deck, or explains one",
    .run = deck_command,
};

enum { STATEMENTS_MAX = 128, USAGE_SIZE = 512 };

static const char introduction[] =
    "Units and defaults are given in SI. A number may carry any unit of the same dimension; a "
    "bare\n"
    "number is in the deck's units. A LIST is one value for all, or one value for each.\n"
    "[deck.md](deck.md) explains words, numbers, units and floors.\n\n";

// Every simple unit with the quantity it measures and its size in SI. The size of g is that of the
// default gravity.
static void print_units(enum page page) {
    struct unit_system si;
    unit_system_init(&si);
    if (page == PAGE_MARKDOWN) {
        printf("\n| quantity | units with their sizes in SI |\n| --- | --- |");
    } else {
        printf("\n  %-5s %-15s %s\n", "unit", "quantity", "size");
    }
    const char *before = "";
    for (int i = 0; unit_names[i]; i++) {
        const char *end;
        struct dimension dimension;
        double size;
        char unit[64] = "";
        unit_parse(unit_names[i], si.gravity, &end, &dimension, &size);
        if (!dimension_equal(dimension, dimension_none)) {
            unit_text(&si, dimension, unit, sizeof unit);
        }
        const char *noun = dimension_noun(dimension);
        const char *article = noun ? strchr(noun, ' ') : NULL;
        const char *quantity = article ? article + 1 : "stress";
        if (page == PAGE_TEXT) {
            printf("  %-5s %-15s %.10g%s%s\n", unit_names[i], quantity, size, unit[0] ? " " : "",
                   unit);
        } else if (strcmp(quantity, before) != 0) {
            printf("%s\n| %s%s%s%s | `%s` %.10g", before[0] ? " |" : "", quantity,
                   unit[0] ? " [" : "", unit, unit[0] ? "]" : "", unit_names[i], size);
        } else {
            printf(", `%s` %.10g", unit_names[i], size);
        }
        before = quantity;
    }
    printf(page == PAGE_MARKDOWN ? " |\n" : "");
}

static void print_language(enum page page, const struct deck_statement *s) {
    rows_heading(page, 2, s->name);
    rows_entry(page, "what", s->doc);
    rows_code(page, "usage", s->usage);
    if (strcmp(s->name, "units") == 0) {
        print_units(page);
    }
    printf("\n");
}

static bool names_storey_law(const struct statement_kind *kind) {
    return strcmp(kind->name, "storey") == 0 || strcmp(kind->name, "hinges") == 0 ||
           strcmp(kind->name, "column") == 0;
}

static void print_kind(enum page page, const struct statement_kind *kind) {
    char usage[USAGE_SIZE];
    snprintf(usage, sizeof usage, "%s %s", kind->name, kind->usage);
    rows_heading(page, 2, kind->name);
    rows_entry(page, "what", kind->summary);
    rows_code(page, "usage", usage);
    // The laws that the statement can choose.
    const char *name[STATEMENTS_MAX];
    char list[USAGE_SIZE], text[2 * USAGE_SIZE];
    const bool contact = strcmp(kind->name, "contact") == 0;
    const int n = contact ? n_contact_law : names_storey_law(kind) ? n_storey_law : 0;
    for (int i = 0; i < n && i < STATEMENTS_MAX; i++) {
        name[i] = contact ? contact_laws[i]->name : storey_laws[i]->name;
    }
    if (n > 0) {
        snprintf(text, sizeof text, "%s; %s", text_list(list, sizeof list, name, n),
                 page == PAGE_TEXT ? "'jostle laws LAW' explains one" : "see [laws.md](laws.md)");
        rows_entry(page, "laws", text);
    }
    rows_example(page, kind->example);
    rows_print(page, kind->row, kind->n_row, NULL);
    for (int i = 0; i < kind->n_variant; i++) {
        const struct statement_variant *v = &kind->variant[i];
        if (v->name && page == PAGE_MARKDOWN) {
            printf("\n`%s ... %s`: %s\n", kind->name, v->name, v->summary);
        } else if (v->name) {
            printf("\n  %s ... %s: %s\n", kind->name, v->name, v->summary);
        }
        rows_print(page, v->row, v->n_row, NULL);
    }
    printf("\n");
}

static int print(enum page page, const char *name) {
    if (name) {
        const char *known[STATEMENTS_MAX];
        int n = 0;
        for (int i = 0; i < n_deck_statement && n < STATEMENTS_MAX; i++) {
            known[n++] = deck_statements[i].name;
            if (strcmp(deck_statements[i].name, name) == 0) {
                print_language(page, &deck_statements[i]);
                return EXIT_DONE;
            }
        }
        for (int i = 0; i < n_statement_kind && n < STATEMENTS_MAX; i++) {
            known[n++] = statement_kinds[i]->name;
            if (strcmp(statement_kinds[i]->name, name) == 0) {
                print_kind(page, statement_kinds[i]);
                return EXIT_DONE;
            }
        }
        return command_unknown(&command_deck, "statement", name, known, n);
    }
    if (page == PAGE_MARKDOWN) {
        rows_generated("deck");
        rows_heading(PAGE_MARKDOWN, 1, "Statements of a deck");
        fputs(introduction, stdout);
        for (int i = 0; i < n_deck_statement; i++) {
            print_language(PAGE_MARKDOWN, &deck_statements[i]);
        }
        for (int i = 0; i < n_statement_kind; i++) {
            print_kind(PAGE_MARKDOWN, statement_kinds[i]);
        }
    } else {
        for (int i = 0; i < n_deck_statement; i++) {
            printf("  %-11s %s\n", deck_statements[i].name, deck_statements[i].doc);
        }
        for (int i = 0; i < n_statement_kind; i++) {
            printf("  %-11s %s\n", statement_kinds[i]->name, statement_kinds[i]->summary);
        }
        printf("\n'jostle deck STATEMENT' explains one of them.\n");
    }
    return EXIT_DONE;
}

static int deck_command(int argc, char **argv) {
    return rows_command(&command_deck, argc, argv, print);
}
