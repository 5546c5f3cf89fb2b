// SPDX-License-Identifier: GPL-3.0-or-later
#include <assert.h>
#include <math.h>

#include "plot/pictures.h"
#include "plot/script.h"

// What is shown, in SI; the tangent over the initial stiffness.
struct extent {
    struct span drift, shear, energy, plastic, tangent;
};

struct scales {
    struct scale drift, shear, energy;
};

static double tangent_of(const struct loop_curve *c, const struct storey_point *p) {
    return c->stiffness > 0.0 ? p->tangent / c->stiffness : 0.0;
}

static struct extent extent_of(const struct loop_figure *f) {
    struct extent x = {span_none, span_none, span_none, span_none, span_none};
    for (int c = 0; c < f->n_curve; c++) {
        for (size_t i = 0; i < f->n; i++) {
            const struct storey_point *p = &f->curve[c].point[i];
            span_add(&x.drift, p->drift);
            span_add(&x.shear, p->shear);
            span_add(&x.energy, p->dissipated);
            span_add(&x.plastic, p->plastic);
            span_add(&x.tangent, tangent_of(&f->curve[c], p));
        }
    }
    for (size_t i = 0; i < f->n_sample; i++) {
        span_add(&x.drift, f->drift[i]);
        span_add(&x.shear, f->shear[i]);
    }
    return x;
}

static double largest(struct span s) {
    return fmax(s.high, -s.low);
}

enum { COLUMNS = 5 };

// The numbers of a point over those that are shown.
static void numbers(const struct loop_curve *c, const struct extent *x, size_t i,
                    double value[COLUMNS]) {
    const struct storey_point *p = &c->point[i];
    const double all[COLUMNS] = {p->drift, p->shear, p->dissipated, p->plastic, tangent_of(c, p)};
    const struct span of[COLUMNS] = {x->drift, x->shear, x->energy, x->plastic, x->tangent};
    for (int k = 0; k < COLUMNS; k++) {
        value[k] = all[k] / (of[k].high > of[k].low ? of[k].high - of[k].low : 1.0);
    }
}

// Do the points between `from` and `to` lie on a line, as far as the one in the middle tells?
static bool is_line(const struct loop_curve *c, const struct extent *x, size_t from, size_t to) {
    static const double THIN = 5e-4;
    double start[COLUMNS], middle[COLUMNS], end[COLUMNS];
    const size_t at = from + (to - from + 1) / 2;
    const double share = (double)(at - from) / (double)(to - from);
    numbers(c, x, from, start);
    numbers(c, x, at, middle);
    numbers(c, x, to, end);
    for (int k = 0; k < COLUMNS; k++) {
        if (fabs(start[k] + share * (end[k] - start[k]) - middle[k]) > THIN) {
            return false;
        }
    }
    return true;
}

// Points on a line are left out, but not turns.
static void write_curve(const struct loop_figure *f, int k, const struct extent *x,
                        const struct scales *s, struct canvas *c) {
    canvas_block(c, "turn drift shear energy plastic tangent", "curve%d", k);
    size_t kept = 0;
    for (size_t i = 0; i < f->n; i++) {
        const bool turns = i % (size_t)f->n_part == 0;
        if (!turns && is_line(&f->curve[k], x, kept, i + 1)) {
            continue;
        }
        kept = i;
        const struct storey_point *p = &f->curve[k].point[i];
        fprintf(c->data, "%.6g %.6g %.6g %.6g %.6g %.6g\n", (double)i / f->n_part,
                p->drift / s->drift.size, p->shear / s->shear.size, p->dissipated / s->energy.size,
                p->plastic / s->drift.size, tangent_of(&f->curve[k], p));
    }
    canvas_end(c);
}

static void draw_panels(const struct loop_figure *f, const struct extent *x, const struct scales *s,
                        struct canvas *c) {
    const struct scale number = {1.0, ""};
    const struct span turns = {0.0, (double)(f->n - 1) / f->n_part};
    struct panel p = {
        .area = canvas_inset(canvas_part(c, 0, 0.55, 0, 1), 6.0, 1.0, 3.2, 0.7),
        .x = pictures_scaled_axis(f->drifts, &s->drift, span_with_room(x->drift, NAN)),
        .y = pictures_scaled_axis(f->shears, &s->shear, span_with_room(x->shear, NAN))};
    pictures_law_panel(c, &p, f->n_curve, 2, 3, f->n_sample > 0 ? 0.5 : 0);
    const struct axis axis[] = {
        pictures_scaled_axis("dissipated", &s->energy, span_with_room(x->energy, x->energy.low)),
        pictures_scaled_axis("plastic", &s->drift, span_with_room(x->plastic, NAN)),
        pictures_scaled_axis("tangent / k", &number, span_with_room(x->tangent, NAN)),
    };
    for (int i = 0; i < 3; i++) {
        const bool last = i == 2;
        const struct area part = canvas_part(c, 0.55, 1, (2 - i) / 3.0 * 0.9 + (last ? 0 : 0.1),
                                             (3 - i) / 3.0 * 0.9 + 0.1);
        p.area = canvas_inset(part, 6.0, 0.5, last ? 3.2 : 0.6, 0.7);
        p.x = pictures_scaled_axis(last ? f->progress : NULL, &number, turns);
        p.x.kind = last ? AXIS_FULL : AXIS_WITHOUT_NUMBERS;
        p.y = axis[i];
        pictures_law_panel(c, &p, f->n_curve, 1, 4 + i, 0);
    }
}

int loop_figure_write(const struct loop_figure *f, const struct figure_files *to, struct error *e) {
    assert(f->n_curve <= LOOP_FIGURE_CURVES);
    struct unit_system si;
    unit_system_init(&si);
    const struct figure_head head = {
        .name = "loops", .doc = "storeys under a protocol", .version = f->version, .units = &si};
    const struct extent x = extent_of(f);
    static const struct scale rotations[] = {{1.0, "rad"}, {1e-3, "mrad"}, {0.0, NULL}};
    static const struct scale moments[] = {{1e6, "MN m"}, {1e3, "kN m"}, {1.0, "N m"}, {0.0, NULL}};
    const struct scales s = {
        .drift = pictures_scale(f->turns ? rotations : pictures_lengths, largest(x.drift)),
        .shear = pictures_scale(f->turns ? moments : pictures_forces, largest(x.shear)),
        .energy = pictures_scale(pictures_energies, largest(x.energy))};
    struct canvas canvas;
    figure_open(&head, to, &canvas, e);
    const char *name[LOOP_FIGURE_CURVES];
    for (int c = 0; c < f->n_curve; c++) {
        name[c] = f->curve[c].name;
        write_curve(f, c, &x, &s, &canvas);
    }
    if (f->n_sample > 0) {
        canvas_block(&canvas, "drift shear", "measured");
        for (size_t i = 0; i < f->n_sample; i++) {
            fprintf(to->data, "%.6g %.6g\n", f->drift[i] / s.drift.size,
                    f->shear[i] / s.shear.size);
        }
        canvas_end(&canvas);
    }
    canvas_head(&canvas, f->title, "%s", f->subtitle);
    pictures_law_legend(&canvas, name, f->n_curve, f->n_sample);
    draw_panels(f, &x, &s, &canvas);
    return figure_close(&canvas);
}
