// SPDX-License-Identifier: GPL-3.0-or-later
// What the figures share: thinning, texts, numbers, spans.
#include <math.h>
#include <string.h>

#include "plot/canvas.h"
#include "plot/runs.h"
#include "plot/script.h"
#include "support/support.h"

enum { N = 10000, BINS = 50 };

static void thinning_keeps_the_extremes_of_every_part_and_the_order(void **state) {
    (void)state;
    static double wave[N], spike[N];
    static size_t row[4 * BINS + 2];
    for (int i = 0; i < N; i++) {
        wave[i] = sin(0.01 * i);
        spike[i] = i == 4321 ? 7 : i == 8765 ? -9 : 0;
    }
    const double *series[] = {wave, spike};
    const size_t n = script_thin(series, 2, N, BINS, row);
    bool high = false, low = false;
    assert_in_range(n, BINS, 4 * BINS + 2);
    for (size_t i = 0; i < n; i++) {
        assert_true(i == 0 || row[i] > row[i - 1]);
        high = high || row[i] == 4321;
        low = low || row[i] == 8765;
    }
    assert_true(high && low);
    assert_int_equal(row[0], 0);
    assert_int_equal(row[n - 1], N - 1);
}

static void few_rows_are_not_thinned(void **state) {
    (void)state;
    const double value[] = {1, 2, 3, 2, 1};
    const double *series[] = {value};
    size_t row[5];
    assert_int_equal(script_thin(series, 1, 5, BINS, row), 5);
    for (size_t i = 0; i < 5; i++) {
        assert_int_equal(row[i], i);
    }
}

static void a_name_is_shortened_in_its_middle(void **state) {
    (void)state;
    char cut[64];
    script_shorten("tower", 3, cut, sizeof cut);
    assert_string_equal(cut, "tower");
    script_shorten("north_tower:19", 4.9, cut, sizeof cut);
    assert_string_equal(cut, "nort…:19");
    assert_true(script_width(cut) <= 4.9);
    script_shorten("NORTH_TOWER:19", 4.9, cut, sizeof cut);
    assert_string_equal(cut, "NOR…:19");
    script_shorten("2: NAPA_2014_BROADWAY 0.869247", 11, cut, sizeof cut);
    assert_non_null(strstr(cut, "… 0.869247"));  // a word keeps the blank before it
    script_shorten("", 1, cut, sizeof cut);
    assert_string_equal(cut, "");
    script_cut("Gebäude für alle", 4.5, cut, sizeof cut);
    assert_string_equal(cut, "Gebäude…");
}

static void texts_are_about_as_wide_as_in_dejavu_sans(void **state) {
    (void)state;
    // As ImageMagick sets them in DejaVu Sans 2.37, and how far kinds of letters may be off.
    static const struct {
        const char *text;
        double width;
    } known[] = {
        {"administration", 7.25},
        {"ADMINISTRATION", 8.61},
        {"acceleration [10³ m/s²]", 11.5},
        {"Gebäude_mit_sehr_langem_Namen_und_Höhe_0", 24.3},
        {"largest absolute values over all computed steps; total accelerations", 33.96},
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        assert_close(script_width(known[i].text), known[i].width, 0.04);
    }
}

static void powers_and_units_have_raised_characters(void **state) {
    (void)state;
    struct unit_system units;
    char text[64];
    unit_system_init(&units);
    script_power(-12, text, sizeof text);
    assert_string_equal(text, "10⁻¹²");
    script_power(3, text, sizeof text);
    assert_string_equal(text, "10³");
    script_unit(&units, dimension_acceleration, text, sizeof text);
    assert_string_equal(text, "m/s²");
    script_unit(&units, dimension_energy, text, sizeof text);
    assert_string_equal(text, "N·m");
}

static void numbers_in_texts_have_a_power_of_ten_where_one_is_needed(void **state) {
    (void)state;
    char text[32];
    script_number(12804.4, text, sizeof text);
    assert_string_equal(text, "12804");
    script_number(0.012345678, text, sizeof text);
    assert_string_equal(text, "0.01235");
    script_number(3e9, text, sizeof text);
    assert_string_equal(text, "3·10⁹");
    script_number(-4416929, text, sizeof text);
    assert_string_equal(text, "-4.417·10⁶");
    script_number(1e-9, text, sizeof text);
    assert_string_equal(text, "1·10⁻⁹");
    script_number(INFINITY, text, sizeof text);
    assert_string_equal(text, "inf");
}

static void numbers_that_belong_together_share_a_power_of_ten(void **state) {
    (void)state;
    assert_int_equal(script_exponent(9999, 0.05, 1e4), 0);
    assert_int_equal(script_exponent(1e7, 0.05, 1e4), 6);  // 1, 5 and 10 of them
    assert_int_equal(script_exponent(2e4, 0.05, 1e4), 3);
    assert_int_equal(script_exponent(0.05, 0.05, 1e4), 0);
    assert_int_equal(script_exponent(0.02, 0.05, 1e4), -3);
    assert_int_equal(script_exponent(0, 0.05, 1e4), 0);
    // Powers of what a foreign file may have are integers, too.
    assert_int_equal(script_exponent((double)NAN, 0.05, 1e4), 0);
    assert_int_equal(script_exponent(INFINITY, 0.05, 1e4), 0);
    assert_int_equal(script_exponent(1e300, 0.05, 1e4), 300);
}

static void a_step_is_1_2_or_5_times_a_power_of_ten(void **state) {
    (void)state;
    assert_close(script_step(1, 5), 0.2, 1e-12);
    assert_close(script_step(7, 5), 2, 1e-12);
    assert_close(script_step(0.013, 4), 0.005, 1e-12);
    assert_close(script_step(0, 4), 1, 0);
}

static void a_span_is_never_empty_and_keeps_its_fixed_end(void **state) {
    (void)state;
    struct span span = span_none;
    span_add(&span, NAN);
    span_add(&span, INFINITY);
    assert_close(span_with_room(span, 0).high, 1, 0);
    span_add(&span, 2);
    span_add(&span, 4);
    const struct span from_zero = span_with_room(span, 0);
    assert_close(from_zero.low, 0, 0);
    assert_close(from_zero.high, 4.2, 1e-12);
    const struct span free = span_with_room(span, NAN);
    assert_close(free.low, 1.9, 1e-12);
    assert_close(free.high, 4.1, 1e-12);
    struct span nothing = span_none;
    span_add(&nothing, 0);
    assert_true(span_with_room(nothing, 0).high > span_with_room(nothing, 0).low);
    assert_true(span_with_room(nothing, NAN).high > span_with_room(nothing, NAN).low);
}

static void a_history_is_a_straight_line_between_its_rows(void **state) {
    (void)state;
    struct data d;
    struct error e;
    assert_int_equal(data_create(&d, 3, 2, &e), 0);
    for (size_t i = 0; i < 3; i++) {
        d.column[0][i] = (double)i;
        d.column[1][i] = (double)(i * i);
    }
    assert_close(data_at(&d, 1, 1.5), 2.5, 1e-12);
    assert_close(data_at(&d, 1, 1), 1, 1e-12);
    assert_close(data_at(&d, 1, -1), 0, 0);
    assert_close(data_at(&d, 1, 5), 4, 0);
    assert_int_equal(data_row(&d, 0.5), 1);
    assert_int_equal(data_row(&d, 2.5), 3);
    data_free(&d);
}

// What the canvas writes for a panel of 8 em by `height`, whose axes show the spans.
static void written_panel(double height, const struct axis *x, const struct axis *y, char *text,
                          size_t size) {
    struct unit_system units;
    unit_system_init(&units);
    struct canvas c = {.to = tmpfile(), .units = &units, .width = 50, .height = 50};
    assert_non_null(c.to);
    canvas_axes(&c, (struct area){10, 18, 10, 10 + height}, x, y);
    rewind(c.to);
    text[fread(text, 1, size - 1, c.to)] = '\0';
    fclose(c.to);
}

static void numbers_above_each_other_do_not_touch_in_a_low_panel(void **state) {
    (void)state;
    char text[4096];
    const struct axis x = {.span = {0, 1}};
    const struct axis upwards = {.span = {0, 1600}, .dimension = dimension_force};
    written_panel(1.0, &x, &upwards, text, sizeof text);
    assert_non_null(strstr(text, "set ytics ('1000' 1000)\n"));
    const struct axis both = {.span = {-640, 640}, .dimension = dimension_force};
    written_panel(1.6, &x, &both, text, sizeof text);
    assert_non_null(strstr(text, "set ytics ('-600' -600, '600' 600)\n"));
    written_panel(0.8, &x, &both, text, sizeof text);
    assert_non_null(strstr(text, "set ytics ('600' 600)\n"));
    const struct axis downwards = {.span = {-640, 0}, .dimension = dimension_force};
    written_panel(0.8, &x, &downwards, text, sizeof text);
    assert_non_null(strstr(text, "set ytics ('-500' -500)\n"));
}

static void numbers_beside_each_other_do_not_touch(void **state) {
    (void)state;
    char text[4096];
    const struct axis y = {.span = {0, 1}};
    // Of 0, 0.2 ... 1.2 in 10^6 the first and the last but one are short, those between are not.
    const struct axis x = {.span = {0, 1.3e6}};
    written_panel(5, &x, &y, text, sizeof text);
    assert_non_null(strstr(text, "set xtics ('0' 0, '0.5' 500000, '1' 1000000)\n"));
}

static void decades_have_as_many_numbers_as_find_room(void **state) {
    (void)state;
    char text[4096];
    const struct axis y = {.span = {0, 1}};
    struct axis x = {.span = {0.5, 6}, .kind = AXIS_LOGARITHMIC};
    written_panel(5, &x, &y, text, sizeof text);
    assert_non_null(strstr(text, "set xtics ('0.5' 0.5, '0.6' 0.6, '0.7' 0.7, '0.8' 0.8"));
    x.span = (struct span){0.1, 1e3};
    written_panel(5, &x, &y, text, sizeof text);
    assert_non_null(strstr(text, "set xtics ('1' 1, '100' 100)\n"));
    x.span = (struct span){1e-6, 1e6};
    written_panel(5, &x, &y, text, sizeof text);
    assert_non_null(strstr(text, "set xtics ('10⁻⁴' 0.0001, '1' 1, '10000' 10000)\n"));
    written_panel(30, &y, &x, text, sizeof text);  // upright there is room
    assert_non_null(strstr(text, "set ytics ('10⁻⁶' 1e-06, '10⁻⁵' 1e-05, "));
    assert_null(strstr(text, "'2·10⁻⁶'"));
    x.span = (struct span){1e-6, 1e-4};
    written_panel(30, &y, &x, text, sizeof text);
    assert_non_null(strstr(text, "set ytics ('10⁻⁶' 1e-06, '2·10⁻⁶' 2e-06, "));
}

static void a_name_too_long_for_the_axis_gives_way_to_the_brief_one(void **state) {
    (void)state;
    char text[4096];
    const struct axis y = {.span = {0, 1}};
    struct axis x = {.name = "acceleration", .brief = "accel.", .unit = "m/s²", .span = {0, 5}};
    written_panel(5, &x, &y, text, sizeof text);
    assert_non_null(strstr(text, "'acceleration [m/s²]'"));
    x.span.high = 5e4;
    written_panel(5, &x, &y, text, sizeof text);
    assert_non_null(strstr(text, "'accel. [10³ m/s²]'"));
    x.brief = NULL;
    written_panel(5, &x, &y, text, sizeof text);
    assert_non_null(strstr(text, "'acceleration [10³ m/s²]'"));
}

static void a_unit_too_long_beside_a_low_panel_takes_a_second_line_and_a_third(void **state) {
    (void)state;
    char text[4096];
    const struct axis x = {.span = {0, 1}};
    const struct axis y = {
        .name = "ground acc.", .dimension = dimension_acceleration, .span = {-5e3, 5e3}};
    written_panel(16, &x, &y, text, sizeof text);
    assert_non_null(strstr(text, "'ground acc. [10³ m/s² = 102 g]'"));
    written_panel(8, &x, &y, text, sizeof text);
    assert_non_null(strstr(text, "'[10³ m/s² = 102 g]'"));
    written_panel(4, &x, &y, text, sizeof text);
    assert_non_null(strstr(text, "'[10³ m/s²'"));
    assert_non_null(strstr(text, "'= 102 g]'"));
}

static void a_heading_too_wide_for_its_block_is_small(void **state) {
    (void)state;
    char text[4096];
    struct canvas c = {.to = tmpfile(), .kind = CANVAS_BLOCK, .width = 50, .height = 50};
    assert_non_null(c.to);
    c.area = (struct area){10, 20, 10, 20};
    canvas_head(&c, "", "energy of a block");
    rewind(c.to);
    text[fread(text, 1, sizeof text - 1, c.to)] = '\0';
    fclose(c.to);
    assert_non_null(strstr(text, "'energy of a block'"));
    assert_non_null(strstr(text, "left font small_font"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(thinning_keeps_the_extremes_of_every_part_and_the_order),
        cmocka_unit_test(few_rows_are_not_thinned),
        cmocka_unit_test(a_name_is_shortened_in_its_middle),
        cmocka_unit_test(texts_are_about_as_wide_as_in_dejavu_sans),
        cmocka_unit_test(powers_and_units_have_raised_characters),
        cmocka_unit_test(numbers_in_texts_have_a_power_of_ten_where_one_is_needed),
        cmocka_unit_test(numbers_that_belong_together_share_a_power_of_ten),
        cmocka_unit_test(a_step_is_1_2_or_5_times_a_power_of_ten),
        cmocka_unit_test(a_span_is_never_empty_and_keeps_its_fixed_end),
        cmocka_unit_test(numbers_above_each_other_do_not_touch_in_a_low_panel),
        cmocka_unit_test(numbers_beside_each_other_do_not_touch),
        cmocka_unit_test(decades_have_as_many_numbers_as_find_room),
        cmocka_unit_test(a_name_too_long_for_the_axis_gives_way_to_the_brief_one),
        cmocka_unit_test(a_unit_too_long_beside_a_low_panel_takes_a_second_line_and_a_third),
        cmocka_unit_test(a_heading_too_wide_for_its_block_is_small),
        cmocka_unit_test(a_history_is_a_straight_line_between_its_rows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
