// SPDX-License-Identifier: GPL-3.0-or-later
// Places on the sheet.
#include "plot/canvas.h"

#include <assert.h>
#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "core/safe.h"
#include "plot/script.h"

static const double SMALL = 0.75;  // of small_font
static const char small_font[] = " font small_font", block_font[] = " font block_font";
static const double BOLD = 1.15;   // width of bold text over that of plain text
static const double OVERHANG = 2;  // of an upright text over both ends of its axis [em]
static const double TIGHT = 0.9;   // numbers above each other that are nearer [em] touch

void canvas_fail(struct canvas *c, int status, const char *format, ...) {
    if (c->status == STATUS_OK) {
        char message[sizeof c->e->message];
        va_list list;
        va_start(list, format);
        vsnprintf(message, sizeof message, format, list);
        va_end(list);
        c->status = error_set(c->e, status, "%s", message);
    }
}

void canvas_block(struct canvas *c, const char *columns, const char *name, ...) {
    va_list list;
    fputc('$', c->data);
    va_start(list, name);
    vfprintf(c->data, name, list);
    va_end(list);
    fputs(" << EOD\n# ", c->data);
    safe_put(c->data, SAFE_COMMENT, columns);
    fputc('\n', c->data);
}

void canvas_end(struct canvas *c) {
    fputs("EOD\n", c->data);
}

void canvas_place(const struct canvas *c, double x, double y) {
    fprintf(c->to, " at screen %.4f,%.4f", x / c->width, y / c->height);
}

void canvas_label(const struct canvas *c, const char *text, double width) {
    char cut[512];
    script_cut(text, width, cut, sizeof cut);
    fprintf(c->to, "set label ");
    safe_put(c->to, SAFE_GNUPLOT, cut);
}

void canvas_head(struct canvas *c, const char *title, const char *text, ...) {
    struct area *a = &c->area;
    char subtitle[512];
    va_list list;
    va_start(list, text);
    vsnprintf(subtitle, sizeof subtitle, text, list);
    va_end(list);
    if (c->kind == CANVAS_BLOCK) {
        const bool fits = BOLD * script_width(subtitle) <= a->right - a->left;
        canvas_label(c, subtitle, fits ? INFINITY : (a->right - a->left) / SMALL);
        canvas_place(c, a->left, a->top - 0.7);
        fprintf(c->to, " left%s\n", fits ? block_font : small_font);
        a->top -= 1.5;
        return;
    }
    canvas_label(c, title, c->width / 1.25);
    canvas_place(c, c->width / 2, a->top - 1);
    fprintf(c->to, " center font title_font\n");
    const bool fits = script_width(subtitle) <= c->width;
    canvas_label(c, subtitle, fits ? c->width : c->width / SMALL);
    canvas_place(c, c->width / 2, a->top - 2.5);
    fprintf(c->to, " center%s\n", fits ? "" : small_font);
    a->top -= 3.3;
}

struct area canvas_part(const struct canvas *c, double x0, double x1, double y0, double y1) {
    assert(x0 <= x1 && y0 <= y1);
    const struct area *a = &c->area;
    const double width = a->right - a->left, height = a->top - a->bottom;
    return (struct area){a->left + x0 * width, a->left + x1 * width, a->bottom + y0 * height,
                         a->bottom + y1 * height};
}

bool canvas_has_room(const struct canvas *c, int n) {
    return c->area.top - c->area.bottom > 0.6 * n;
}

struct area canvas_inset(struct area a, double left, double right, double bottom, double top) {
    return (struct area){a.left + left, a.right - right, a.bottom + bottom, a.top - top};
}

// Numbers too long to stand beside an axis are shown in this power of ten; 0: as they are.
static int axis_power(const struct axis *axis) {
    const struct span s = axis->scale.high > axis->scale.low ? axis->scale : axis->span;
    const double largest = fmax(fabs(s.low), fabs(s.high));
    // Below these an eighth of the axis would ask for three digits behind the point.
    const double least = s.low < 0 ? 0.02 : 0.04;
    const double most = s.low <= -1e3 ? 1e3 : 1e4;
    return axis->kind == AXIS_FULL ? script_exponent(largest, least, most) : 0;
}

// One of what the axis counts, in g: " = 0.102 g"; nothing where it shows no acceleration.
static void axis_in_g(const struct axis *axis, const struct unit_system *units, char *text,
                      size_t size) {
    const bool acceleration =
        !axis->unit && dimension_equal(axis->dimension, dimension_acceleration);
    text[0] = '\0';
    if (acceleration) {
        snprintf(text, size, " = %.3g g", unit_in_g(units) * pow(10, axis_power(axis)));
    }
}

static void axis_text(const struct axis *axis, const char *name, const struct unit_system *units,
                      char *text, size_t size) {
    char unit[64], power[32] = "", g[32];
    script_unit(units, axis->dimension, unit, sizeof unit);
    if (axis_power(axis) != 0) {
        script_power(axis_power(axis), power, sizeof power);
    }
    const char *shown = axis->unit ? axis->unit : unit;
    const char *between = power[0] && shown[0] ? " " : "";
    axis_in_g(axis, units, g, sizeof g);
    snprintf(text, size, power[0] || shown[0] ? "%s [%s%s%s%s]" : "%s", name, power, between, shown,
             g);
}

// How far neighbouring numbers across must be apart [em], with this step.
static double number_room(const struct axis *axis, double step) {
    const double unit = pow(10, axis_power(axis));
    const long first = (long)ceil(axis->span.low / step), last = (long)(axis->span.high / step);
    int before = 0, most = 0;
    for (long i = first; i <= last; i++) {
        char text[32];
        const int n = snprintf(text, sizeof text, "%.5g", (double)i * step / unit);
        most = before + n > most ? before + n : most;
        before = n;
    }
    return 0.3 * most + 0.5;
}

// The smallest step whose numbers find room along `length` em; `line` is the room of one across. At
// least two numbers are shown: where zero would stand alone, the largest round one is the step.
static double fitting_step(const struct axis *axis, double length, double line) {
    const double size = axis->span.high - axis->span.low;
    double step = 0;
    for (int n = 8; n > 1; n--) {
        step = fmax(script_step(size, n), axis->step);
        const double room = line > 0 ? line : number_room(axis, step);
        if (step / size * length >= room) {
            break;
        }
    }
    if (floor(axis->span.high / step) > ceil(axis->span.low / step)) {
        return step;
    }
    const double most = fmax(fabs(axis->span.low), fabs(axis->span.high));
    const double power = pow(10, floor(log10(most)));
    const double round = power * floor(most / power);
    return round > axis->span.low && -round < axis->span.high ? round : script_step(size, 2);
}

// The tics one by one, as multiples of the axis's power of ten. Where they stand nearer than `room`
// em, of both ends or of the outer one only; zero is where the axis ends or the line begins.
static void write_numbers(const struct canvas *c, char letter, const struct axis *axis, double step,
                          double room) {
    const double unit = pow(10, axis_power(axis));
    long first = (long)ceil(axis->span.low / step);
    long last = (long)(axis->span.high / step), by = 1;
    if (room < TIGHT && (double)(last - first) * room >= TIGHT) {
        by = last - first;
    } else if (room < TIGHT) {
        first = last = last > 0 ? last : first;
    }
    fprintf(c->to, "set %ctics (", letter);
    for (long i = first; i <= last; i += by) {
        fprintf(c->to, "%s'%.5g' %.9g", i > first ? ", " : "", (double)i * step / unit,
                (double)i * step);
    }
    fprintf(c->to, ")\n");
}

static void write_digit(FILE *to, int digit, int exponent) {
    char power[32];
    if (exponent >= -3 && exponent < 5) {
        fprintf(to, "'%g'", digit * pow(10, exponent));
        return;
    }
    script_power(exponent, power, sizeof power);
    if (digit == 1) {
        fprintf(to, "'%s'", power);
    } else {
        fprintf(to, "'%d·%s'", digit, power);
    }
}

// Tics at 1, 2 and 5 of every decade; at every digit where there is little more than one decade; at
// 1 of as many decades as find room, where there are many. `line` is the room of a number [em].
static void write_decades(const struct canvas *c, char letter, const struct axis *axis,
                          double length, double line) {
    const double low = axis->span.low, high = axis->span.high;
    const double decade = length / (log10(high) - log10(low));  // [em]
    const bool every = high / 15 < low;
    const bool some = decade * log10(2) > line;
    const int step = (int)ceil(line / decade);
    const char *between = "";
    fprintf(c->to, "set logscale %c\nset %ctics (", letter, letter);
    for (int exponent = (int)floor(log10(low)); pow(10, exponent) <= high; exponent++) {
        for (int digit = 1; digit <= 9; digit++) {
            const bool wanted = every || (digit == 1 && exponent % step == 0) ||
                                (some && (digit == 2 || digit == 5));
            const double at = digit * pow(10, exponent);
            if (wanted && at >= low * (1 - 1e-9) && at <= high * (1 + 1e-9)) {
                fprintf(c->to, "%s", between);
                write_digit(c->to, digit, exponent);
                fprintf(c->to, " %g", at);
                between = ", ";
            }
        }
    }
    fprintf(c->to, ")\n");
}

static void write_scale(const struct canvas *c, char letter, const struct axis *axis, double length,
                        double line) {
    fprintf(c->to, "set %crange [%.9g:%.9g]\n", letter, axis->span.low, axis->span.high);
    if (axis->kind == AXIS_LOGARITHMIC) {
        write_decades(c, letter, axis, length, line > 0 ? line : 2.5);
        return;
    }
    const double step = fitting_step(axis, length, line);
    const double room = step / (axis->span.high - axis->span.low) * length;
    const bool tight = line > 0 && room < TIGHT && axis->kind == AXIS_FULL;
    if (axis_power(axis) != 0 || tight) {
        write_numbers(c, letter, axis, step, tight ? room : TIGHT);
        return;
    }
    fprintf(c->to, "set %ctics %.9g\nset format %c '%s'\n", letter, step, letter,
            axis->kind == AXIS_FULL ? "%h" : "");
}

// In the middle of `a`, or downwards from its top where it is longer: below is room, above may
// stand the name of another axis.
static void write_upright(const struct canvas *c, const char *text, double x, struct area a,
                          const char *font) {
    fprintf(c->to, "set label ");
    safe_put(c->to, SAFE_GNUPLOT, text);
    const double width = (font[0] ? SMALL : 1.0) * script_width(text);
    const double highest = a.top + 0.5 - width / 2;
    canvas_place(c, x, fmin((a.top + a.bottom) / 2, highest));
    fprintf(c->to, " center rotate by 90%s\n", font);
}

void canvas_upright(const struct canvas *c, struct area a, const struct axis *axis) {
    char text[160];
    axis_text(axis, axis->name, c->units, text, sizeof text);
    const double height = a.top - a.bottom;
    char *unit = strstr(text, " [");
    if (!unit || script_width(text) <= height) {
        write_upright(c, text, a.left - 4.4, a, "");
        return;
    }
    *unit++ = '\0';
    char *in_g = strstr(unit, " = ");
    if (in_g && SMALL * script_width(unit) > height + OVERHANG) {
        *in_g++ = '\0';
        write_upright(c, text, a.left - 6.1, a, "");
        write_upright(c, unit, a.left - 4.9, a, small_font);
        write_upright(c, in_g, a.left - 3.9, a, small_font);
        return;
    }
    write_upright(c, text, a.left - 5.35, a, "");
    write_upright(c, unit, a.left - 4.05, a, in_g ? small_font : "");
}

void canvas_axes(const struct canvas *c, struct area a, const struct axis *x,
                 const struct axis *y) {
    fprintf(c->to,
            "unset logscale\nset lmargin at screen %.4f\nset rmargin at screen %.4f\n"
            "set bmargin at screen %.4f\nset tmargin at screen %.4f\n",
            a.left / c->width, a.right / c->width, a.bottom / c->height, a.top / c->height);
    write_scale(c, 'x', x, a.right - a.left, 0);
    write_scale(c, 'y', y, a.top - a.bottom, 1.5);
    if (x->name) {
        // The name of the horizontal axis. If there is no room, the brief name; if there is no room
        // for that, a small font.
        char text[160];
        axis_text(x, x->name, c->units, text, sizeof text);
        const double room = a.right - a.left + 2;
        if (x->brief && script_width(text) > room) {
            axis_text(x, x->brief, c->units, text, sizeof text);
        }
        fprintf(c->to, "set label ");
        safe_put(c->to, SAFE_GNUPLOT, text);
        canvas_place(c, (a.left + a.right) / 2, a.bottom - 2.5);
        fprintf(c->to, " center%s\n", x->brief && script_width(text) > room ? small_font : "");
    }
    if (y->name) {
        canvas_upright(c, a, y);
    }
}
