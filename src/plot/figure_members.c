// SPDX-License-Identifier: GPL-3.0-or-later
// Frames and walls with their members in the colours of their demand: each half of a member has the
// largest moment of its end, as a share of the largest one of its kind in the building. Rings are
// plastic rotations of hinges.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "plot/elevation.h"
#include "plot/figure.h"
#include "plot/legend.h"
#include "plot/script.h"

enum { NUMBER_MAX = 1000 };
#define N_KIND (FRAME_WALL + 1)  // enum frame_kind

static const char *const kind_name[N_KIND] = {
    [FRAME_COLUMN] = "column", [FRAME_BEAM] = "beam", [FRAME_WALL] = "wall"};
static const char *const kind_line[N_KIND] = {
    [FRAME_COLUMN] = "columns", [FRAME_BEAM] = "beams", [FRAME_WALL] = "walls"};

static const double NEAR_END = 0.1;     // place of a hinge, as a share of its member
static const double RING = 3, DOT = 1;  // of the largest plastic rotation, and of none

// A member by its name.
struct member_place {
    enum frame_kind kind;
    int level, number;
};

struct view {
    struct elevation at;
    const struct report_building *building[ELEVATION_MAX];
    double most[ELEVATION_MAX][N_KIND];  // the largest moment of each kind; 0: there is none
    const struct report_member *hardest[ELEVATION_MAX][N_KIND];
    int across[ELEVATION_MAX][N_KIND];  // lines of the frame, or walls
    double plastic;                     // the largest plastic rotation of all
    bool plain, any[N_KIND];            // some hinge has not yielded; which kinds there are
    bool left_out;                      // some building is not drawn
};

// Reads "_12", a number from 1 to `most`.
static bool take_number(const char **at, int most, int *out) {
    char *end;
    if ((*at)[0] != '_' || (*at)[1] < '1' || (*at)[1] > '9') {
        return false;
    }
    const long value = strtol(*at + 1, &end, 10);
    *at = end;
    *out = (int)(value <= most ? value : 0);
    return *out > 0;
}

static bool find_place(const struct report_building *b, const struct report_member *m,
                       struct member_place *out) {
    for (enum frame_kind kind = 0; kind < N_KIND; kind++) {
        const size_t n = strlen(kind_name[kind]);
        if (strncmp(m->name, kind_name[kind], n) == 0) {
            const char *at = m->name + n;
            out->kind = kind;
            return take_number(&at, b->n_floor, &out->level) &&
                   take_number(&at, NUMBER_MAX, &out->number) && !*at;
        }
    }
    return false;
}

static double larger_of(const struct member_extreme *e) {
    return fmax(e->max, -e->min);
}

// The largest moment of an end; where it is not known, that of both.
static double end_moment(const struct report_building *b, const struct report_member *m, int end) {
    const double value = b->extremes ? larger_of(&m->extreme[MEMBER_M_I + end]) : m->moment;
    return value > 0 && value < 1e300 ? value : 0;
}

// The largest plastic rotation of an end, 0 where it is rounding only; NAN: the end has no hinge,
// or it is not known.
static double end_rotation(const struct report_building *b, const struct report_member *m,
                           int end) {
    if (!b->hinged || !b->extremes) {
        return NAN;
    }
    const double plastic = larger_of(&m->extreme[MEMBER_PLASTIC_I + end]);
    const double all = larger_of(&m->extreme[MEMBER_ROTATION_I + end]);
    if (!(plastic < 1e300)) {
        return NAN;
    }
    return plastic > 1e-9 * all ? plastic : 0.0;
}

static void look_at_member(struct view *v, int k, const struct report_member *m) {
    const struct report_building *b = v->building[k];
    struct member_place p;
    if (!find_place(b, m, &p)) {
        return;
    }
    const enum frame_kind across = p.kind == FRAME_WALL ? FRAME_WALL : FRAME_COLUMN;
    const int lines = p.number + (p.kind == FRAME_BEAM);
    v->across[k][across] = lines > v->across[k][across] ? lines : v->across[k][across];
    v->across[k][FRAME_BEAM] = v->across[k][FRAME_COLUMN];
    v->any[p.kind] = true;
    for (int end = 0; end < 2; end++) {
        const double moment = end_moment(b, m, end), rotation = end_rotation(b, m, end);
        if (moment > v->most[k][p.kind]) {
            v->most[k][p.kind] = moment;
            v->hardest[k][p.kind] = m;
        }
        v->plastic = fmax(v->plastic, rotation);
        v->plain = v->plain || rotation == 0;
    }
}

// The heights of the storeys, if all are given.
static const double *heights_of(const struct report_building *b) {
    double sum = 0;
    for (int i = 0; i < b->n_floor; i++) {
        sum = b->height[i] > 0 ? sum + b->height[i] : (double)NAN;
    }
    return sum < 1e300 ? b->height : NULL;
}

static struct view look(const struct report *r) {
    struct view v = {0};
    for (int i = 0; i < r->n_building; i++) {
        const struct report_building *b = &r->building[i];
        const struct elevation_building shown = {b->name, b->n_floor, heights_of(b)};
        if (b->n_member == 0 || !elevation_add(&v.at, &shown)) {
            v.left_out = true;
            continue;
        }
        const int k = v.at.n - 1;
        v.building[k] = b;
        for (int m = 0; m < b->n_member; m++) {
            look_at_member(&v, k, &b->member[m]);
        }
    }
    return v;
}

static int check(const struct subject *p, struct error *e) {
    const struct runs *s = p->runs;
    bool any = false;
    for (int i = 0; i < s->r[0]->n_building; i++) {
        any = any || s->r[0]->building[i].n_member > 0;
    }
    if (!any) {
        return runs_lack(s, "frames and no walls", e);
    }
    return s->n > 1 ? error_set(e, STATUS_INPUT, "it shows one run, not two") : STATUS_OK;
}

// Blocks of data: halves of the members of a kind with their shares in percent, then hinges that
// have yielded with the sizes of their points, and the others.
enum { BLOCK_YIELDED = N_KIND, BLOCK_PLAIN, N_BLOCK };
static const char *const block_data[N_BLOCK] = {"columns", "beams", "walls", "yielded", "plain"};

static void put_end(const struct view *v, int k, const struct report_member *m,
                    const struct member_place *p, int end, int block, FILE *to) {
    const struct elevation_ends at =
        elevation_member(&v->at, k, p->kind, p->level, p->number, v->across[k][p->kind]);
    const double x = at.x[end], y = at.y[end], dx = at.x[1 - end] - x, dy = at.y[1 - end] - y;
    const double rotation = end_rotation(v->building[k], m, end), most = v->most[k][p->kind];
    const double share = most > 0 ? end_moment(v->building[k], m, end) / most : 0;
    const double size = rotation > 0 ? DOT + (RING - DOT) * rotation / v->plastic : DOT;
    if (block == (int)p->kind) {
        fprintf(to, "%.6g %.7g %.6g %.7g %.6g\n", x, y, dx / 2, dy / 2, 100 * share);
    } else if ((block == BLOCK_YIELDED && rotation > 0) ||
               (block == BLOCK_PLAIN && rotation == 0)) {
        fprintf(to, "%.6g %.7g %.4g\n", x + NEAR_END * dx, y + NEAR_END * dy, size);
    }
}

static void write_block(const struct view *v, int block, FILE *to) {
    for (int k = 0; k < v->at.n; k++) {
        const struct report_building *b = v->building[k];
        for (int i = 0; i < 2 * b->n_member; i++) {
            struct member_place p;
            if (find_place(b, &b->member[i / 2], &p)) {
                put_end(v, k, &b->member[i / 2], &p, i % 2, block, to);
            }
        }
    }
}

// The largest moment of a kind below its building, and the storey or floor and the line or bay of
// its member, where there is room.
static void write_moment(const struct view *v, int k, enum frame_kind kind, int line,
                         struct canvas *c) {
    const double x = elevation_x(&v->at, k, 0.5);
    char value[48], text[96];
    if (v->most[k][kind] > 0) {
        const char *name = v->hardest[k][kind]->name + strlen(kind_name[kind]) + 1;
        script_number(v->most[k][kind], value, sizeof value);
        snprintf(text, sizeof text, "%s at %s", value, name);
        if (elevation_fits(&v->at, text)) {
            elevation_below(&v->at, c, text, x, line, INFINITY);
        } else {
            elevation_number(&v->at, c, v->most[k][kind], x, line);
        }
    }
}

static void write_rotation(const struct view *v, int k, int line, struct canvas *c) {
    double most = NAN;
    for (int i = 0; i < 2 * v->building[k]->n_member; i++) {
        most = fmax(most, end_rotation(v->building[k], &v->building[k]->member[i / 2], i % 2));
    }
    if (!isnan(most)) {
        elevation_number(&v->at, c, most, elevation_x(&v->at, k, 0.5), line);
    }
}

// The lines below the buildings: their names, largest moments, largest plastic rotations.
static void write_lines(const struct view *v, struct canvas *c) {
    char unit[64], text[96];
    int line = 0;
    script_unit(c->units, dimension_energy, unit, sizeof unit);
    for (enum frame_kind kind = 0; kind < N_KIND; kind++) {
        if (v->any[kind]) {
            line++;
            snprintf(text, sizeof text, "%s [%s]", kind_line[kind], unit);
            elevation_line(&v->at, c, text, line);
            for (int k = 0; k < v->at.n; k++) {
                write_moment(v, k, kind, line, c);
            }
        }
    }
    if (v->plastic > 0) {
        elevation_line(&v->at, c, "plastic [rad]", line + 1);
    }
    for (int k = 0; k < v->at.n; k++) {
        elevation_name(&v->at, c, k, 0);
        if (v->plastic > 0) {
            write_rotation(v, k, line + 1, c);
        }
    }
}

static const struct style yielded = {STYLE_POINTS, "#0072b2", 1.5, NULL, POINT_RING, -1};
static const struct style plain = {STYLE_POINTS, "#606060", 0, NULL, POINT_RING, DOT};

static void write_head(const struct view *v, const struct runs *s, struct canvas *c) {
    struct legend l = {0};
    canvas_head(c, s->title, "largest end moments, as shares of those of columns, beams, walls%s",
                v->left_out ? "; not all buildings are drawn" : "");
    if (v->plastic > 0) {
        struct style mark = yielded;
        mark.size = 1.8;
        legend_add(&l, mark, "plastic rotation", "");
    }
    if (v->plain) {
        legend_add(&l, plain, "hinge that has not yielded", "");
    }
    legend_write(&l, c);
}

static void draw_blocks(const struct view *v, struct canvas *c) {
    static const double width[N_KIND] = {[FRAME_COLUMN] = 4, [FRAME_BEAM] = 4, [FRAME_WALL] = 9};
    static const int order[] = {FRAME_WALL, FRAME_BEAM, FRAME_COLUMN, BLOCK_PLAIN, BLOCK_YIELDED};
    for (int i = 0; i < N_BLOCK; i++) {
        const int block = order[i];
        const bool there = block == BLOCK_YIELDED ? v->plastic > 0
                           : block == BLOCK_PLAIN ? v->plain
                                                  : v->any[block];
        if (!there) {
            continue;
        }
        canvas_block(c, "place [em], level, value", "%s", block_data[block]);
        write_block(v, block, c->data);
        canvas_end(c);
        if (block >= N_KIND) {
            panel_series(c, block == BLOCK_PLAIN ? plain : yielded,
                         block == BLOCK_PLAIN ? "$plain using 1:2" : "$yielded using 1:2:3");
        } else {
            panel_series(c, (struct style){.kind = STYLE_SHADED, .width = width[block]},
                         "$%s using 1:2:3:4:5", block_data[block]);
        }
    }
}

static void draw(const struct subject *p, struct canvas *c) {
    static const double SCALE_ROOM = 6.5, SCALE_WIDTH = 1.2;  // [em]
    struct view v = look(p->runs->r[0]);
    const int lines = 1 + v.any[FRAME_COLUMN] + v.any[FRAME_BEAM] + v.any[FRAME_WALL];
    write_head(&v, p->runs, c);
    const double right = c->area.right;
    c->area.right -= SCALE_ROOM;
    elevation_open(&v.at, c, lines + (v.plastic > 0));
    panel_shades(c, SHADES_LINES, 100);
    write_lines(&v, c);
    draw_blocks(&v, c);
    panel_close(c);
    const struct area scale = {right - SCALE_WIDTH, right, v.at.area.bottom, v.at.area.top};
    panel_shades_scale(
        c, scale, &(struct axis){.name = "share of the largest", .unit = "%", .span = {0, 100}});
}

const struct figure figure_members = {
    .name = "members",
    .doc = "frames and walls with the largest end moments and plastic rotations",
    .check = check,
    .draw = draw,
};
