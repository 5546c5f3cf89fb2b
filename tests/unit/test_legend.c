// SPDX-License-Identifier: GPL-3.0-or-later
// Legends: their entries stand on the sheet, apart from each other, and leave room for the panels.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "plot/legend.h"
#include "plot/script.h"
#include "support/support.h"

static const double WIDTH = 46, LINE = 1.35;  // [em]

struct text {
    char text[256];
    double left, y;
};

// The texts of a legend on a sheet of WIDTH em; returns how many lines it takes.
static int written(const struct legend *l, struct text *text) {
    const double top = 29;
    struct canvas c = {.to = tmpfile(),
                       .width = WIDTH,
                       .height = 29,
                       .area = {.left = 0.3, .right = WIDTH - 1, .top = top}};
    char line[512];
    int n = 0;
    assert_non_null(c.to);
    legend_write(l, &c);
    rewind(c.to);
    while (fgets(line, sizeof line, c.to)) {
        struct text *t = &text[n];
        char left[32], y[32];
        if (sscanf(line, "set label '%255[^']' at screen %31[^,],%31s left", t->text, left, y) ==
            3) {
            t->left = WIDTH * strtod(left, NULL);
            t->y = strtod(y, NULL);
            n++;
        }
    }
    fclose(c.to);
    assert_int_equal(n, l->n);
    return (int)((top - c.area.top) / LINE + 0.5);
}

// Texts follow each other without touching, and none leaves the sheet.
static void check_places(const struct text *text, int n) {
    for (int i = 0; i < n; i++) {
        const double right = text[i].left + script_width(text[i].text);
        assert_true(right < WIDTH);
        if (i + 1 < n && text[i + 1].y == text[i].y) {
            assert_true(right + 2 < text[i + 1].left);
        }
    }
}

static void add(struct legend *l, const char *name, const char *tail) {
    legend_add(l, panel_line("#000000", 0), name, tail);
}

static void short_names_stand_in_one_line(void **state) {
    (void)state;
    struct legend l = {0};
    struct text text[4];
    add(&l, "A", ", floor 5");
    add(&l, "B", ", floor 5 + gap");
    add(&l, "gap", "");
    add(&l, "impacts", "");
    assert_int_equal(written(&l, text), 1);
    check_places(text, 4);
    assert_string_equal(text[1].text, "B, floor 5 + gap");
}

static void many_long_names_leave_room_for_the_panels(void **state) {
    (void)state;
    struct legend l = {0};
    struct text text[9];
    char name[64];
    for (int i = 0; i < 7; i++) {
        snprintf(name, sizeof name, "ADMINISTRATION_BUILDING_WITH_ANNEX_NO_%d", i);
        add(&l, name, "");
    }
    assert_in_range(written(&l, text), 1, 4);
    check_places(text, 7);
    assert_string_equal(text[6].text + strlen(text[6].text) - 5, "_NO_6");
    add(&l, "with", "");
    add(&l, "without", "");
    assert_in_range(written(&l, text), 1, 4);
    check_places(text, 9);
}

static void what_is_behind_a_name_is_told_whole(void **state) {
    (void)state;
    struct legend l = {0};
    struct text text[7];
    for (int i = 0; i < 7; i++) {
        add(&l, "ADMINISTRATION_BUILDING_WITH_ANNEX", ": 0.421, 0.146, 0.0953 s");
    }
    written(&l, text);
    check_places(text, 7);
    for (int i = 0; i < 7; i++) {
        assert_non_null(strstr(text[i].text, ": 0.421, 0.146, 0.0953 s"));
        assert_memory_equal(text[i].text, "ADM", 3);
    }
}

static void what_is_wider_than_the_sheet_is_shortened(void **state) {
    (void)state;
    struct legend l = {0};
    struct text text[1];
    add(&l, "",
        "measure = 1 (gap = 0.02 m, C = 2000 kN*s^0.6/m^0.6, k = 123456 kN/m, e = 0.65, m = 1)");
    assert_int_equal(written(&l, text), 1);
    check_places(text, 1);
}

static void an_empty_legend_takes_no_room(void **state) {
    (void)state;
    const struct legend l = {0};
    struct text text[1];
    assert_int_equal(written(&l, text), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(short_names_stand_in_one_line),
        cmocka_unit_test(many_long_names_leave_room_for_the_panels),
        cmocka_unit_test(what_is_behind_a_name_is_told_whole),
        cmocka_unit_test(what_is_wider_than_the_sheet_is_shortened),
        cmocka_unit_test(an_empty_legend_takes_no_room),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
