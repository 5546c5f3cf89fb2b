// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/rows.h"

#include <string.h>

#include "core/text.h"

enum { WIDTH = 100, CELL = 96 };

// Columns of a table; the meaning comes last and may be long.
enum column { OPTION, UNIT, RANGE, DEFAULT, MEANING, N_COLUMN };
static const char *const headings[N_COLUMN] = {"option", "unit", "range", "default", "meaning"};

struct line {
    char cell[MEANING][CELL];
    const char *meaning;
};

static const char *text_of(const struct line *l, int column) {
    return column == MEANING ? l->meaning : l->cell[column];
}

static bool is_number(const struct row *row) {
    return row->kind == ROW_NUMBER || row->kind == ROW_LIST || row->kind == ROW_INTEGER;
}

// The key of the row that holds the exponent p of other rows' dimensions.
static const char *power_key(const struct row *row, int n_row) {
    for (int i = 0; i < n_row; i++) {
        if (row[i].flags & ROW_POWER) {
            return row[i].key;
        }
    }
    return "p";
}

// The SI unit of the row as a deck would have it: "N/m", "N/m^n"; "" for pure numbers and texts.
static void put_unit(const struct row *row, const char *power, char *cell) {
    struct unit_system si;
    unit_system_init(&si);
    cell[0] = '\0';
    if (!is_number(row)) {
        return;
    }
    if (!dimension_equal(row->dimension, dimension_none)) {
        unit_text(&si, row->dimension, cell, CELL);
    }
    size_t used = strlen(cell);
    if (row->flags & ROW_PER_LENGTH_POWER) {
        snprintf(cell + used, CELL - used, "/%s^%s", si.length_name, power);
    } else if (row->flags & ROW_PER_VELOCITY_POWER) {
        snprintf(cell + used, CELL - used, "*%s^%s/%s^%s", si.time_name, power, si.length_name,
                 power);
    }
}

static void put_default(const struct row *row, const char *unit, char *cell) {
    cell[0] = '\0';
    if (row->flags & ROW_REQUIRED) {
        snprintf(cell, CELL, "required");
    } else if (row->flags & ROW_ONE_OF) {
        snprintf(cell, CELL, "one of");
    } else if (row->kind == ROW_CHOICE && !isnan(row->fallback)) {
        snprintf(cell, CELL, "%s", row->range->word[(int)row->fallback]);
    } else if (is_number(row) && isfinite(row->fallback)) {
        bool bare = unit[0] == '\0' || row->fallback == 0.0;
        snprintf(cell, CELL, "%.6g%s%.80s", row->fallback, bare ? "" : " ", bare ? "" : unit);
    }
}

static struct line make_line(const struct row *row, const char *power) {
    struct line l;
    static const char *const value[] = {
        [ROW_NUMBER] = " NUMBER", [ROW_LIST] = " LIST",   [ROW_INTEGER] = " INTEGER",
        [ROW_TEXT] = " WORD",     [ROW_TEXTS] = " WORDS", [ROW_FILE] = " FILE",
        [ROW_FLAG] = "",          [ROW_CHOICE] = " WORD",
    };
    snprintf(l.cell[OPTION], CELL, "-%s%s", row->key, value[row->kind]);
    put_unit(row, power, l.cell[UNIT]);
    put_default(row, l.cell[UNIT], l.cell[DEFAULT]);
    snprintf(l.cell[RANGE], CELL, "%s", row->range ? row->range->text : "");
    l.meaning = row->doc;
    return l;
}

static void widen(int *width, const struct line *l) {
    for (int c = 0; c < N_COLUMN; c++) {
        int n = text_columns(text_of(l, c), strlen(text_of(l, c)));
        width[c] = n > width[c] ? n : width[c];
    }
}

static void print_text(const struct line *l, const int *width) {
    int column = printf("  ");
    for (int c = 0; c < MEANING; c++) {
        const char *text = l->cell[c];
        printf("%s%*s  ", text, width[c] - text_columns(text, strlen(text)), "");
        column += width[c] + 2;
    }
    option_wrap(l->meaning, column, WIDTH);
}

// One row of the Markdown table. Unit, range and default share a cell, because most are empty.
static void print_markdown(const struct line *l) {
    printf("| `%s` | %s |", l->cell[OPTION], l->meaning);
    const char *before = " ";
    for (int c = UNIT; c <= DEFAULT; c++) {
        const char *text = l->cell[c];
        const bool value = c == DEFAULT && text[0] && text[0] != 'r' && text[0] != 'o';
        if (text[0]) {
            printf("%s%s%s", before, value ? "default " : "", text);
            before = ", ";
        }
    }
    printf(" |\n");
}

static void print_rows_markdown(const struct row *row, int n_row,
                                bool (*left_out)(const struct row *row)) {
    const char *power = power_key(row, n_row);
    bool any = false;
    for (int i = 0; i < n_row; i++) {
        if (left_out && left_out(&row[i])) {
            continue;
        }
        if (!any) {
            printf("\n| option | meaning | value |\n| --- | --- | --- |\n");
            any = true;
        }
        struct line l = make_line(&row[i], power);
        print_markdown(&l);
    }
}

void rows_names(const struct row *row, int n_row, bool (*named)(const struct row *row)) {
    const char *power = power_key(row, n_row);
    const char *before = "- options: ";
    for (int i = 0; i < n_row; i++) {
        if (named(&row[i])) {
            char unit[CELL];
            put_unit(&row[i], power, unit);
            const bool shown = row[i].flags & ROW_REQUIRED && unit[0];
            printf("%s`-%s`%s%s%s", before, row[i].key, shown ? " [" : "", shown ? unit : "",
                   shown ? "]" : "");
            before = ", ";
        }
    }
    if (before[0] == ',') {
        printf("\n");
    }
}

void rows_print(enum page page, const struct row *row, int n_row,
                bool (*left_out)(const struct row *row)) {
    if (n_row == 0) {
        return;
    }
    if (page == PAGE_MARKDOWN) {
        print_rows_markdown(row, n_row, left_out);
        return;
    }
    int width[N_COLUMN] = {0};
    struct line head;
    const char *power = power_key(row, n_row);
    for (int c = 0; c < MEANING; c++) {
        snprintf(head.cell[c], CELL, "%s", headings[c]);
    }
    head.meaning = headings[MEANING];
    widen(width, &head);
    for (int i = 0; i < n_row; i++) {
        struct line l = make_line(&row[i], power);
        widen(width, &l);
    }
    printf("\n");
    print_text(&head, width);
    for (int i = 0; i < n_row; i++) {
        struct line l = make_line(&row[i], power);
        print_text(&l, width);
    }
}

void rows_entry(enum page page, const char *label, const char *text) {
    if (!text) {
        return;
    }
    if (page == PAGE_MARKDOWN) {
        printf("- %s: %s\n", label, text);
        return;
    }
    option_wrap(text, printf("  %-9s", label), WIDTH);
}

void rows_code(enum page page, const char *label, const char *text) {
    if (page == PAGE_MARKDOWN) {
        printf("- %s: `%s`\n", label, text);
    } else {
        rows_entry(page, label, text);
    }
}

void rows_example(enum page page, const char *text) {
    if (page == PAGE_TEXT && text) {
        printf("  %-9s%s\n", "example", text);
    } else {
        rows_code(page, "example", text);
    }
}

void rows_heading(enum page page, int depth, const char *text) {
    if (page == PAGE_MARKDOWN) {
        printf("%.*s %s\n\n", depth, "######", text);
    } else {
        printf("%s\n", text);
    }
}

void rows_generated(const char *command) {
    printf(
        "<!-- SPDX-License-Identifier: GPL-3.0-or-later -->\n"
        "<!-- Printed by `jostle %s --markdown`: change the source, then run `make docs`. -->\n\n",
        command);
}

struct reference {
    const struct command *command;
    enum page page;
    int (*print)(enum page page, const char *name);
};

static int use(void *request, struct arena *a, const struct words *operand) {
    (void)a;
    const struct reference *r = request;
    return operand->n > 1 ? command_usage(r->command, "one name is expected, not %d", operand->n)
                          : r->print(r->page, operand->n > 0 ? operand->word[0] : NULL);
}

int rows_command(const struct command *c, int argc, char **argv,
                 int (*print)(enum page page, const char *name)) {
    static const struct option_row rows[] = {
        {"markdown", .kind = OPTION_SET, .at = offsetof(struct reference, page),
         .set = PAGE_MARKDOWN, .doc = "prints the page of the documentation"},
        {0}};
    static const struct option_part parts[] = {{.row = rows}, {.row = option_help}, {0}};
    const struct option_list list = {c, parts, .use = use};
    return option_run(&list, argc, argv, &(struct reference){c, PAGE_TEXT, print});
}
