// SPDX-License-Identifier: GPL-3.0-or-later
// One page of the other figures, those that the files hold the data for.
#include "plot/figure.h"
#include "plot/script.h"

// A strip of the page: one figure, or two side by side.
struct strip {
    const char *figure[2];
    double height;  // share of the page
};
static const struct strip strips[] = {
    {{"histories", NULL}, 23},
    {{"contact", NULL}, 23},
    {{"profiles", NULL}, 23},
    {{"impacts", "energy"}, 25},
};
enum { STRIPS = sizeof strips / sizeof strips[0] };

static const struct figure *drawn(const struct subject *p, const char *name) {
    const struct figure *f = name ? figure_find(name) : NULL;
    return f && figure_can_draw(f, p) ? f : NULL;
}

static double strip_height(const struct subject *p, const struct strip *strip) {
    return drawn(p, strip->figure[0]) || drawn(p, strip->figure[1]) ? strip->height : 0;
}

static void draw_strip(const struct strip *strip, const struct subject *p, struct canvas *page,
                       struct area a) {
    const struct figure *const f[] = {drawn(p, strip->figure[0]), drawn(p, strip->figure[1])};
    const double middle = (a.left + a.right) / 2;
    for (int i = 0; i < 2; i++) {
        struct canvas block = *page;
        block.kind = CANVAS_BLOCK;
        block.area = a;
        if (f[1 - i]) {
            *(i == 0 ? &block.area.right : &block.area.left) = middle + (i == 0 ? -0.8 : 0.8);
        }
        if (f[i]) {
            f[i]->draw(p, &block);
        }
        page->status = block.status;
    }
}

static void draw(const struct subject *p, struct canvas *c) {
    const struct runs *s = p->runs;
    const struct report *r = s->r[0];
    if (s->n > 1) {
        canvas_head(c, s->title, "%s and %s", s->name[0], s->name[1]);
    } else {
        canvas_head(c, s->title, "%d building%s, %ld impact%s, %.4g %s", r->n_building,
                    r->n_building == 1 ? "" : "s", r->n_impact, r->n_impact == 1 ? "" : "s",
                    r->duration, r->units.time_name);
    }
    double total = 0, above = 0;
    for (int i = 0; i < STRIPS; i++) {
        total += strip_height(p, &strips[i]);
    }
    for (int i = 0; i < STRIPS; i++) {
        const double height = strip_height(p, &strips[i]) / total;
        const struct area part = canvas_part(c, 0, 1, 1 - above - height, 1 - above);
        draw_strip(&strips[i], p, c, canvas_inset(part, 0.5, 0.5, 0.8, 0.8));
        above += height;
    }
}

const struct figure figure_overview = {
    .name = "overview",
    .doc = "one page with histories, contact, profiles, impacts and energy",
    .sheet = SHEET_PAGE,
    .draw = draw,
};
