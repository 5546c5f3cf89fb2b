// SPDX-License-Identifier: GPL-3.0-or-later
// Names give way before the entries stand below each other in one column, or take more than
// LINES_MAX lines from the panels.
#include "plot/legend.h"

#include <assert.h>
#include <math.h>

#include "core/safe.h"
#include "plot/script.h"

enum { LINES_MAX = 4 };

// Widths [em].
static const double MARK = 2.1;     // a mark with its distance from the name
static const double BETWEEN = 1.6;  // entries
static const double NAME = 4;       // that is left of a long name

void legend_add(struct legend *l, struct style mark, const char *name, const char *tail) {
    assert(name && tail && l->n < LEGEND_MAX);
    struct legend_entry *entry = &l->entry[l->n++];
    entry->mark = mark;
    snprintf(entry->name, sizeof entry->name, "%s", name);
    snprintf(entry->tail, sizeof entry->tail, "%s", tail);
}

// With a name of at most `name` em.
static double entry_width(const struct legend_entry *entry, double name) {
    return MARK + fmin(name, script_width(entry->name)) + script_width(entry->tail) + BETWEEN;
}

static double widest(const struct legend *l, double name) {
    double width = 0;
    for (int i = 0; i < l->n; i++) {
        width = fmax(width, entry_width(&l->entry[i], name));
    }
    return width;
}

static int columns_of(double entry, double width) {
    return (int)fmax(1, width / entry);
}

static int lines_of(const struct legend *l, int columns) {
    return (l->n + columns - 1) / columns;
}

// Of `width` em; 0: all entries find room in one line.
static int find_columns(const struct legend *l, double width) {
    double all = 0;
    for (int i = 0; i < l->n; i++) {
        all += entry_width(&l->entry[i], INFINITY);
    }
    if (all <= width) {
        return 0;
    }
    int columns = columns_of(widest(l, INFINITY), width);
    const int enough = l->n > 2 * LINES_MAX ? (l->n + LINES_MAX - 1) / LINES_MAX : l->n > 2 ? 2 : 1;
    if (columns < enough) {
        const int most = columns_of(widest(l, NAME), width);
        columns = most < enough ? most : enough;
    }
    return lines_of(l, lines_of(l, columns));  // as many in each line
}

static void write_mark(const struct canvas *c, struct style mark, double x, double y) {
    if (mark.kind == STYLE_AREA) {
        fprintf(c->to,
                "set object rectangle from screen %.4f,%.4f rto screen %.4f,%.4f "
                "fc rgb '%s' fs solid noborder\n",
                x / c->width, (y - 0.35) / c->height, 1.6 / c->width, 0.7 / c->height, mark.colour);
        return;
    }
    if (mark.kind != STYLE_POINTS) {
        // A line. A dashed line is several short lines, because gnuplot's svg terminal draws dashed
        // arrows solid.
        const bool dashed = mark.dash && mark.dash[0] == '(';  // not "solid"
        const double length = dashed ? 0.4 : 1.6;
        for (double at = 0; at + length < 1.65; at += 0.6) {
            fprintf(c->to,
                    "set arrow from screen %.4f,%.4f rto screen %.4f,0 nohead lc rgb '%s' lw 1.5\n",
                    (x + at) / c->width, y / c->height, length / c->width, mark.colour);
        }
    }
    if (mark.kind == STYLE_POINTS || mark.point > 0) {
        fprintf(c->to, "set label ''");
        canvas_place(c, x + 0.8, y);
        fprintf(c->to, " point pt %d ps %.3g*point lc rgb '%s'\n",
                mark.point > 0 ? mark.point : POINT_DISC, mark.size > 0 ? mark.size : 1,
                mark.colour);
    }
}

// Within `width` em, of which the mark and the distance from the next one are part.
static void write_entry(const struct canvas *c, const struct legend_entry *entry, double x,
                        double width) {
    char name[128], text[256], shown[256];
    const double y = c->area.top + 0.5, room = width - MARK - BETWEEN + 1e-9;
    script_shorten(entry->name, room - script_width(entry->tail), name, sizeof name);
    snprintf(text, sizeof text, "%s%s", name, entry->tail);
    script_shorten(text, room, shown, sizeof shown);
    write_mark(c, entry->mark, x, y);
    fprintf(c->to, "set label ");
    safe_put(c->to, SAFE_GNUPLOT, shown);
    canvas_place(c, x + MARK, y);
    fprintf(c->to, " left\n");
}

void legend_write(const struct legend *l, struct canvas *c) {
    const double left = c->area.left + (c->kind == CANVAS_SHEET ? 1 : 0);
    const double width = c->area.right + 1 - left;
    const int columns = find_columns(l, width);
    const double column = columns > 0 ? fmin(width / columns, widest(l, INFINITY)) : 0;
    double x = left;
    for (int i = 0; i < l->n; i++) {
        if (i == 0 || (columns > 0 && i % columns == 0)) {
            c->area.top -= 1.35;
            x = left;
        }
        const double room = columns > 0 ? column : entry_width(&l->entry[i], INFINITY);
        write_entry(c, &l->entry[i], x, room);
        x += room;
    }
}
