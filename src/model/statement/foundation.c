// SPDX-License-Identifier: GPL-3.0-or-later
// A foundation from springs and dashpots, or from the soil below a disk.
#include "model/foundation.h"

#include <gsl/gsl_math.h>

#include "core/arena.h"
#include "deck/reader.h"

enum {
    MASS,
    INERTIA,
    SWAY,
    SWAY_DASHPOT,
    ROCKING,
    ROCKING_DASHPOT,
    RADIUS,
    VELOCITY,
    DENSITY,
    POISSON,
    N_ROW
};

#define OF_INERTIA                                                                                 \
    { 1, 1, 2 }
#define OF_ROCKING_DASHPOT                                                                         \
    { 1, 1, 1 }
#define OF_DENSITY                                                                                 \
    { 1, -4, 2 }

static const struct range poisson_range = {.min = 0.0, .max = 0.5, .text = ">= 0 and <= 0.5"};

static const struct row rows[N_ROW] = {
    [MASS] = {"mass", ROW_NUMBER, ROW_REQUIRED, OF_MASS, &range_positive, NAN, "mass of the slab"},
    [INERTIA] = {"inertia", ROW_NUMBER, ROW_REQUIRED, OF_INERTIA, &range_positive, NAN,
                 "moment of inertia of the slab, and of the floors about their own axes"},
    [SWAY] = {"sway", ROW_NUMBER, 0, OF_STIFFNESS, &range_positive, NAN, "stiffness against sway"},
    [SWAY_DASHPOT] = {"sway-dashpot", ROW_NUMBER, 0, OF_DASHPOT, &range_non_negative, 0.0,
                      "dashpot against sway"},
    [ROCKING] = {"rocking", ROW_NUMBER, 0, OF_MOMENT, &range_positive, NAN,
                 "stiffness against rocking, moment over angle"},
    [ROCKING_DASHPOT] = {"rocking-dashpot", ROW_NUMBER, 0, OF_ROCKING_DASHPOT, &range_non_negative,
                         0.0, "dashpot against rocking"},
    [RADIUS] = {"radius", ROW_NUMBER, 0, OF_LENGTH, &range_positive, NAN,
                "radius of a disk on soil, in place of -sway and -rocking"},
    [VELOCITY] = {"vs", ROW_NUMBER, 0, OF_VELOCITY, &range_positive, NAN,
                  "shear wave velocity of the soil"},
    [DENSITY] = {"density", ROW_NUMBER, 0, OF_DENSITY, &range_positive, NAN, "density of the soil"},
    [POISSON] = {"poisson", ROW_NUMBER, 0, OF_NONE, &poisson_range, NAN,
                 "Poisson's ratio of the soil"},
};

// Springs and dashpots of a rigid disk on a half-space (Wolf 1994, Foundation Vibration Analysis
// Using Simple Physical Models, tables 2-2 and 2-3): the static stiffness, and the dashpot of waves
// that leave in a cone, density times wave velocity times area, or moment of inertia of the area.
// The waves of rocking are those of compression; above a Poisson's ratio of 1/3, where their
// velocity grows without limit, twice the shear wave velocity. There the soil below the disk also
// moves with it.
static void take_soil(const struct argument *a, struct foundation *f) {
    const double r = a[RADIUS].number[0], vs = a[VELOCITY].number[0], rho = a[DENSITY].number[0];
    const double nu = a[POISSON].number[0], shear = rho * vs * vs;
    const double area = M_PI * r * r, second = area * r * r / 4.0;
    const bool stiff = nu <= 1.0 / 3.0;
    const double velocity = stiff ? vs * sqrt(2.0 * (1.0 - nu) / (1.0 - 2.0 * nu)) : 2.0 * vs;
    f->sway = 8.0 * shear * r / (2.0 - nu);
    f->rocking = 8.0 * shear * r * r * r / (3.0 * (1.0 - nu));
    f->sway_dashpot = a[SWAY_DASHPOT].given ? a[SWAY_DASHPOT].number[0] : rho * vs * area;
    f->rocking_dashpot =
        a[ROCKING_DASHPOT].given ? a[ROCKING_DASHPOT].number[0] : rho * velocity * second;
    f->inertia += stiff ? 0.0 : 1.2 * (nu - 1.0 / 3.0) * rho * second * r;
}

// Springs or soil, and whole; false after a report.
static bool check_kind(struct builder *b, const struct statement *s, const struct argument *a) {
    const bool springs = a[SWAY].given || a[ROCKING].given;
    bool soil = false, whole = true;
    for (int i = RADIUS; i <= POISSON; i++) {
        soil |= a[i].given;
        whole &= a[i].given;
    }
    if (springs && soil) {
        deck_error(b->deck, &a[SWAY].key,
                   "give -sway and -rocking, or -radius, -vs, -density and "
                   "-poisson of the soil");
    } else if (soil ? !whole : !(a[SWAY].given && a[ROCKING].given)) {
        deck_error(b->deck, &s->word[0],
                   "foundation needs -sway and -rocking, or -radius, -vs, "
                   "-density and -poisson of the soil");
    } else {
        return true;
    }
    return false;
}

// The first contact or link at a level in the lowest storey of the building, which moves with the
// slab; NULL: none.
static const struct link *find_level(const struct builder *b, int building) {
    const struct link_draft *d = b->links.item;
    for (int i = 0; i < b->links.n; i++) {
        const struct link *l = &d[i].link;
        for (int side = 0; side < 2; side++) {
            const int own = l->building[l->within ? 0 : side];
            if (own == building && l->floor[side] == 1 && !isnan(l->level[side]) &&
                l->column[side] < 0) {
                return l;
            }
        }
    }
    return NULL;
}

static void build(struct builder *b, const struct statement *s) {
    if (!builder_plain(b, s, 1, 1, statement_foundation.usage)) {
        return;
    }
    const int i = builder_building(b, &s->word[1]);
    struct argument a[N_ROW] = {0};
    if (!deck_options(b->deck, s, &(struct row_set){rows, N_ROW, a}, 1) || !check_kind(b, s, a) ||
        i < 0) {
        return;
    }
    struct building_draft *d = builder_draft(b, i);
    const struct link *low = find_level(b, i);
    if (low) {
        deck_error(b->deck, &s->word[1],
                   "%s %s has named a level in storey 1 before; write the foundation first",
                   low->bilateral ? "link" : "contact", low->name);
    } else if (d->foundation) {
        deck_error(b->deck, &s->word[1], "building %s has a foundation already", d->name);
    } else if (d->n_floor > FLOORS_MAX - 2) {
        deck_error(b->deck, &s->word[1], "a building with a foundation has at most %d floors",
                   FLOORS_MAX - 2);
    } else if (d->n_floor > 0 && builder_has_heights(b, d, &s->word[1], "a foundation")) {
        struct foundation *f = arena_alloc(b->arena, 1, sizeof *f);
        if (!f) {
            return;
        }
        *f = (struct foundation){
            .mass = a[MASS].number[0],
            .inertia = a[INERTIA].number[0],
            .sway = a[SWAY].given ? a[SWAY].number[0] : 0.0,
            .rocking = a[ROCKING].given ? a[ROCKING].number[0] : 0.0,
            .sway_dashpot = a[SWAY_DASHPOT].number[0],
            .rocking_dashpot = a[ROCKING_DASHPOT].number[0],
        };
        if (a[RADIUS].given) {
            take_soil(a, f);
        }
        d->foundation = f;
    }
}

const struct statement_kind statement_foundation = {
    .name = "foundation",
    .usage = "BUILDING -mass M -inertia J -sway K -rocking K [-sway-dashpot C] "
             "[-rocking-dashpot C] | -mass M -inertia J -radius R -vs V -density RHO -poisson NU",
    .summary = "a rigid slab below a building that sways and rocks on springs and dashpots",
    .example = "foundation A -mass 150t -inertia 4000t*m^2 -sway 600MN/m -rocking 12000MN*m",
    .row = rows,
    .n_row = N_ROW,
    .build = build,
};
