// SPDX-License-Identifier: GPL-3.0-or-later
// The model of a deck, seen from the front, before it runs: storeys and floors at their heights,
// frames, walls, foundations, contacts, links, struck columns. Below each building are its numbers,
// below each gap its size. Of many buildings the first are shown.
#include <math.h>
#include <string.h>

#include "core/text.h"
#include "model/foundation.h"
#include "model/frame.h"
#include "plot/deck_links.h"
#include "plot/legend.h"
#include "plot/script.h"

// What is drawn in one style: a data block of lines, polygons or points with blank lines between
// them. One of `write` and `member` draws it.
struct layer {
    const char *data;  // the name of its block
    const char *name;  // in the legend; NULL: not there
    struct style style;
    deck_layer *write;
    deck_drawing *member;
};

static const struct building *without_foundation(const struct building *g) {
    return g->fixed ? g->fixed : g;
}

static bool storey_resists(const struct building *own, int i) {
    return own->spring[i] + (own->pdelta ? own->pdelta[i] : 0.0) > 0.0;
}

// A building of one floor that nothing holds.
static bool is_body(const struct building *g) {
    return g->n_dof == 1 && g->n_part == 0 && !storey_resists(g, 0);
}

static void write_ground(const struct deck_view *v, int k, struct deck_shapes *s) {
    if (k == 0) {
        deck_put_box(s, 0, v->at.area.right - v->at.area.left, v->at.at.low, 0);
    }
}

static void write_yielding(const struct deck_view *v, int k, struct deck_shapes *s) {
    const struct building *g = &v->m->building[k];
    for (int i = 0; i < g->n_floor; i++) {
        if (foundation_storey(v->m, g, i)->law->n_history > 0) {
            deck_put_box(s, elevation_x(&v->at, k, 0), elevation_x(&v->at, k, 1),
                         elevation_level(&v->at, k, i), elevation_level(&v->at, k, i + 1));
        }
    }
}

static void write_foundations(const struct deck_view *v, int k, struct deck_shapes *s) {
    if (v->m->building[k].foundation) {
        deck_put_box(s, elevation_x(&v->at, k, -0.12), elevation_x(&v->at, k, 1.12),
                     0.7 * v->at.at.low, 0);
    }
}

static void write_bodies(const struct deck_view *v, int k, struct deck_shapes *s) {
    if (is_body(&v->m->building[k])) {
        const double half = 0.35 * elevation_per_em(&v->at), level = elevation_level(&v->at, k, 1);
        deck_put_box(s, elevation_x(&v->at, k, 0), elevation_x(&v->at, k, 1), level - half,
                     level + half);
    }
}

static void write_floors(const struct deck_view *v, int k, struct deck_shapes *s) {
    const struct building *g = &v->m->building[k];
    for (int i = 1; i <= g->n_floor && !is_body(g); i++) {
        const double level = elevation_level(&v->at, k, i);
        deck_put_line(s, elevation_x(&v->at, k, 0), level, elevation_x(&v->at, k, 1), level);
    }
}

// Both sides of a storey.
static void put_sides(const struct deck_view *v, int k, int storey, struct deck_shapes *s) {
    for (int side = 0; side < 2; side++) {
        const double x = elevation_x(&v->at, k, side);
        deck_put_line(s, x, elevation_level(&v->at, k, storey), x,
                      elevation_level(&v->at, k, storey + 1));
    }
}

static void write_storeys(const struct deck_view *v, int k, struct deck_shapes *s) {
    const struct building *g = &v->m->building[k];
    for (int i = 0; i < g->n_floor; i++) {
        if (storey_resists(without_foundation(g), i)) {
            put_sides(v, k, i, s);
        }
    }
}

static void write_matrices(const struct deck_view *v, int k, struct deck_shapes *s) {
    const struct building *g = without_foundation(&v->m->building[k]);
    for (int p = 0; p < g->n_part; p++) {
        for (int i = 0; !frame_of(&g->part[p]) && i < g->n_dof; i++) {
            put_sides(v, k, i, s);
        }
    }
}

#define GREY "#808080"
#define BLUE "#0072b2"

// From the lowest to the topmost.
static const struct layer layers[] = {
    {"ground", NULL, {STYLE_AREA, .colour = "#e8e4dc"}, .write = write_ground},
    {"yielding", "storeys that yield", {STYLE_AREA, .colour = "#fbe3c0"}, .write = write_yielding},
    {"foundations", "foundation", {STYLE_AREA, .colour = "#b08d57"}, .write = write_foundations},
    {"matrices",
     "stiffness matrix",
     {STYLE_LINE, GREY, 1.2, "(6,5)", 0, 0},
     .write = write_matrices},
    {"storeys", "shear storeys", {STYLE_LINE, GREY, 1.2, NULL, 0, 0}, .write = write_storeys},
    {"walls", "wall", {STYLE_LINE, "#9a9a9a", 7, NULL, 0, 0}, .member = deck_members_wall},
    {"floors", NULL, {STYLE_LINE, "#202020", 2, NULL, 0, 0}, .write = write_floors},
    {"frames", "frame", {STYLE_LINE, BLUE, 1.6, NULL, 0, 0}, .member = deck_members_frame},
    {"fixed",
     "fixed base",
     {STYLE_POINTS, .colour = BLUE, .point = 5, .size = 1},
     .member = deck_members_fixed},
    {"pinned",
     "pinned base",
     {STYLE_POINTS, .colour = BLUE, .point = 8, .size = 1.4},
     .member = deck_members_pinned},
    {"springs",
     "base on a spring",
     {STYLE_POINTS, .colour = BLUE, .point = 12, .size = 1.4},
     .member = deck_members_spring},
    {"hinges",
     "hinge",
     {STYLE_POINTS, .colour = BLUE, .point = 6, .size = 1},
     .member = deck_members_hinges},
    {"bodies", "free body", {STYLE_AREA, .colour = "#56b4e9"}, .write = write_bodies},
    {"rigid", "rigid wall", {STYLE_AREA, .colour = "#606060"}, .write = deck_links_write_rigid},
    {"struck",
     "column that is struck",
     {STYLE_LINE, "#e69f00", 3.5, NULL, 0, 0},
     .write = deck_links_write_struck},
    {"links", "link", {STYLE_BOTH, "#009e73", 1.6, NULL, 13, 1}, .write = deck_links_write_links},
    {"contacts",
     "contact",
     {STYLE_BOTH, "#d00000", 1.6, NULL, POINT_DISC, 0.8},
     .write = deck_links_write_contacts},
};
enum { N_LAYER = sizeof layers / sizeof layers[0] };

static struct deck_view view_of(const struct model *m) {
    struct deck_view v = {.m = m};
    for (int k = 0; k < m->n_building; k++) {
        const struct building *g = &m->building[k];
        if (!elevation_add(&v.at, &(struct elevation_building){g->name, g->n_floor, g->height})) {
            break;
        }
    }
    return v;
}

static void add_count(char *text, size_t size, int n, const char *one, const char *many) {
    const size_t used = strlen(text);
    if (n > 0) {
        snprintf(text + used, size - used, "%s%d %s", used > 0 ? ", " : "", n, n > 1 ? many : one);
    }
}

static void write_head(const struct deck_view *v, const bool *there, struct canvas *c) {
    const struct model *m = v->m;
    char text[200] = "";
    struct legend l = {0};
    add_count(text, sizeof text, m->n_building, "building", "buildings");
    add_count(text, sizeof text, m->n_contact, "contact", "contacts");
    add_count(text, sizeof text, m->n_link - m->n_contact - m->n_column, "link", "links");
    add_count(text, sizeof text, m->n_column, "struck column", "struck columns");
    const size_t n = strlen(text);
    if (m->n_building > v->at.n) {
        snprintf(text + n, sizeof text - n, "; the first %d buildings are drawn", v->at.n);
    } else if (!v->at.heights) {
        snprintf(text + n, sizeof text - n, "; not all storeys have heights");
    } else {
        snprintf(text + n, sizeof text - n, "; heights are to scale, widths and gaps are not");
    }
    size_t stem;
    const char *name = text_stem(m->deck->path, &stem);
    canvas_head(c, m->deck->title[0] ? m->deck->title : name, "%s", text);
    for (int i = 0; i < N_LAYER; i++) {
        if (there[i] && layers[i].name) {
            legend_add(&l, layers[i].style, layers[i].name, "");
        }
    }
    legend_write(&l, c);
}

// "4, 5 × 3.2": the heights of the storeys, from the ground.
static void write_heights(const struct building *g, char *text, size_t size) {
    size_t n = 0;
    for (int i = 0, last; i < g->n_floor && n < size; i = last + 1) {
        char height[32];
        last = i;
        while (last + 1 < g->n_floor && g->height[last + 1] == g->height[i]) {
            last++;
        }
        script_number(g->height[i], height, sizeof height);
        n += (size_t)snprintf(text + n, size - n, i > 0 ? ", " : "");
        if (last > i && n < size) {
            n += (size_t)snprintf(text + n, size - n, "%d × ", last - i + 1);
        }
        n += n < size ? (size_t)snprintf(text + n, size - n, "%s", height) : 0;
    }
}

enum line { LINE_GAPS, LINE_NAMES, LINE_STOREYS, LINE_MASS, LINE_PERIOD, N_LINE };

static void write_line_names(const struct deck_view *v, struct canvas *c) {
    char unit[64], text[96];
    script_unit(c->units, dimension_length, unit, sizeof unit);
    snprintf(text, sizeof text, "gap [%s]", unit);
    elevation_line(&v->at, c, text, LINE_GAPS);
    snprintf(text, sizeof text, v->at.heights ? "storeys [%s]" : "storeys", unit);
    elevation_line(&v->at, c, text, LINE_STOREYS);
    script_unit(c->units, dimension_mass, unit, sizeof unit);
    snprintf(text, sizeof text, "mass [%s]", unit);
    elevation_line(&v->at, c, text, LINE_MASS);
    snprintf(text, sizeof text, "T1 [%s]", c->units->time_name);
    elevation_line(&v->at, c, text, LINE_PERIOD);
}

// The numbers of a building.
static void write_numbers(const struct deck_view *v, int k, struct canvas *c) {
    const struct building *g = &v->m->building[k];
    const double x = elevation_x(&v->at, k, 0.5), room = 0.96 * v->at.slot;
    char text[512];
    double mass = 0;
    for (int i = 0; i < g->n_floor; i++) {
        mass += g->mass[i];
    }
    if (g->height) {
        write_heights(g, text, sizeof text);
    } else {
        snprintf(text, sizeof text, "%d", g->n_floor);
    }
    elevation_below(&v->at, c, text, x, LINE_STOREYS, room);
    elevation_number(&v->at, c, mass, x, LINE_MASS);
    if (g->omega[0] > 0) {
        elevation_number(&v->at, c, 2 * acos(-1.0) / g->omega[0], x, LINE_PERIOD);
    } else {
        elevation_below(&v->at, c, "free", x, LINE_PERIOD, room);
    }
}

// Draws a layer of all buildings; to NULL: only counts. Returns how many shapes it has.
static int write_layer(const struct layer *l, const struct deck_view *v, FILE *to) {
    struct deck_shapes s = {.to = to};
    for (int k = 0; k < v->at.n; k++) {
        if (l->member) {
            deck_members_write(v, k, &s, l->member);
        } else {
            l->write(v, k, &s);
        }
    }
    return s.n;
}

static void draw(const struct subject *p, struct canvas *c) {
    struct deck_view v = view_of(p->model);
    bool there[N_LAYER];
    for (int i = 0; i < N_LAYER; i++) {
        there[i] = write_layer(&layers[i], &v, NULL) > 0;
    }
    write_head(&v, there, c);
    elevation_open(&v.at, c, N_LINE);
    for (int k = 0; k < v.at.n; k++) {
        v.dense = v.dense || !canvas_has_room(c, 2 * v.m->building[k].n_floor);
    }
    write_line_names(&v, c);
    for (int k = 0; k < v.at.n; k++) {
        elevation_name(&v.at, c, k, LINE_NAMES);
        write_numbers(&v, k, c);
    }
    deck_links_write_gaps(&v, c, LINE_GAPS);
    for (int i = 0; i < N_LAYER; i++) {
        if (there[i]) {
            canvas_block(c, "place [em], level", "%s", layers[i].data);
            write_layer(&layers[i], &v, c->data);
            canvas_end(c);
            struct style style = layers[i].style;
            style.width *= v.dense ? 0.5 : 1;
            panel_series(c, style, "$%s using 1:2", layers[i].data);
        }
    }
    panel_close(c);
}

const struct figure figure_deck = {
    .name = "deck",
    .doc = "the model of a deck before it runs",
    .of = SUBJECT_DECK,
    .draw = draw,
};
