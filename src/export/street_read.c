// SPDX-License-Identifier: GPL-3.0-or-later
// The buildings of a street from its table: what the table does not give follows from the type, or
// from the values below.
#include <gsl/gsl_math.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "core/text.h"
#include "export/street.h"
#include "export/street_table.h"
#include "model/name_index.h"

enum { FILE_SIZE_MAX = 16 << 20 };

// Where the table and the type say nothing.
static const double HEIGHT = 3.0;         // [m] of a storey
static const double AREA = 100.0;         // [m^2] of a floor
static const double MASS_PER_AREA = 1e3;  // [kg/m^2] Lu et al. (2014)
static const double DAMPING = 0.05;
static const double STIFFER = 20.0;  // contacts: times the stiffer of both storeys 1
static const double RESTITUTION = 0.65;

// Of two columns only one may be given.
static void exclude(struct street_table *r, int one, int other) {
    if (r->cell[one].n > 0 && r->cell[other].n > 0) {
        street_table_report(r, SEVERITY_ERROR, r->cell[other],
                            "%s is given beside %s; give one of both", street_columns[other].name,
                            street_columns[one].name);
    }
}

static double or_else(double value, double other) {
    return isnan(value) ? other : value;
}

// Which of `n` words the cell of the key has; -1: none. Another word is an error, whose message
// says which words are `required`.
static int read_choice(struct street_table *r, int key, const char *const *word, int n,
                       const char *required) {
    const struct piece p = r->cell[key];
    for (int k = 0; k < n; k++) {
        if (street_table_is(p, word[k])) {
            return k;
        }
    }
    if (p.n > 0) {
        street_table_report(r, SEVERITY_ERROR, p, "%s is '%s'; it must be %s",
                            street_columns[key].name, lines_excerpt(p).text, required);
    }
    return -1;
}

static const char *read_name(struct street_table *r, struct name_index *names, int number) {
    const struct piece p = r->cell[STREET_NAME];
    const char *name =
        p.n > 0 ? street_table_text(r, p) : arena_format(r->arena, "H%d", number + 1);
    if (!name) {
        return "";
    }
    const int first = name_index_find(names, name, strlen(name));
    if (!text_is_name(name) || text_not_plain(name) || strcmp(name, "wall") == 0) {
        street_table_report(r, SEVERITY_ERROR, p,
                            "'%s' cannot name a building; use up to 64 letters, digits, _ and -",
                            lines_excerpt(p).text);
    } else if (first >= 0) {
        street_table_report(r, SEVERITY_ERROR, p, "a second building %s; the first is number %d",
                            name, first + 1);
    } else {
        name_index_add(names, r->arena, name, number);
    }
    return name;
}

static void read_type(struct street_table *r, enum street_zone zone, struct street_building *b) {
    const struct piece p = r->cell[STREET_TYPE];
    exclude(r, STREET_CODE, STREET_YEAR);
    b->code = STREET_MODERATE;
    if (p.n == 0) {
        const int useless = r->cell[STREET_CODE].n > 0   ? STREET_CODE
                            : r->cell[STREET_YEAR].n > 0 ? STREET_YEAR
                                                         : -1;
        if (useless >= 0) {
            street_table_report(r, SEVERITY_WARNING, r->cell[useless],
                                "%s is not used without a type", street_columns[useless].name);
        }
        return;
    }
    const char *name = street_table_text(r, p);
    b->type = street_type_find(name, b->storeys);
    if (!b->type) {
        street_table_report(
            r, SEVERITY_ERROR, p,
            "unknown type '%s' with %d storeys; types are those of HAZUS, such as W1, S1, C1 and "
            "URM: see jostle street --types",
            lines_excerpt(p).text, b->storeys);
    } else if (b->storeys < b->type->least || b->storeys > b->type->most) {
        street_table_report(r, SEVERITY_ERROR, p, "type %s has %d to %d storeys, not %d", name,
                            b->type->least, b->type->most, b->storeys);
    }
    if (!isnan(r->value[STREET_YEAR])) {
        b->code = street_code_of(zone, r->value[STREET_YEAR], street_table_is(p, "W1"));
    }
    const int code =
        read_choice(r, STREET_CODE, street_code_names, STREET_CODES, "high, moderate, low or pre");
    b->code = code < 0 ? b->code : (enum street_code)code;
}

// Height and mass, and the stiffness from the period, or the period from the stiffness.
static void read_dynamics(struct street_table *r, struct street_building *b) {
    const double *v = r->value;
    exclude(r, STREET_HEIGHT, STREET_STOREY_HEIGHT);
    exclude(r, STREET_MASS, STREET_AREA);
    exclude(r, STREET_PERIOD, STREET_STIFFNESS);
    const double n = b->storeys;
    b->height = or_else(or_else(v[STREET_STOREY_HEIGHT], v[STREET_HEIGHT] / n),
                        b->type ? b->type->height : HEIGHT);
    b->mass = or_else(v[STREET_MASS], or_else(v[STREET_AREA], AREA) * MASS_PER_AREA);
    const double sum = b->mass * n * (n + 1.0) / 2.0;  // k_1 / omega^2
    if (!isnan(v[STREET_STIFFNESS])) {
        b->period = 2.0 * M_PI * sqrt(sum / v[STREET_STIFFNESS]);
    } else {
        b->period =
            or_else(v[STREET_PERIOD], b->type ? b->type->period * n / b->type->storeys : NAN);
    }
    b->stiffness = sum * gsl_pow_2(2.0 * M_PI / b->period);
    b->damping = or_else(v[STREET_DAMPING], DAMPING);
    if (isnan(b->period) && r->cell[STREET_TYPE].n == 0) {
        street_table_report(r, SEVERITY_ERROR, r->lines.line,
                            "the building needs a type, a period or a stiffness");
    }
}

static void read_law(struct street_table *r, struct street_building *b) {
    enum { ELASTIC, BILINEAR, CLOUGH, TAKEDA, LAWS };
    static const char *const laws[LAWS] = {"elastic", "bilinear", "clough", "takeda"};
    const double of_type =
        b->type ? b->type->strength[b->code] * street_effective_mass(b->storeys) : (double)NAN;
    b->yield = or_else(r->value[STREET_YIELD], of_type);
    b->hardening = or_else(r->value[STREET_HARDENING],
                           b->type ? street_type_hardening(b->type, b->code) : 0.0);
    const int given = read_choice(r, STREET_LAW, laws, LAWS, "elastic, bilinear, clough or takeda");
    const int law = given >= 0 ? given : isnan(b->yield) ? ELASTIC : BILINEAR;
    const bool elastic = law == ELASTIC;
    b->law = laws[law];
    if (!elastic && isnan(b->yield)) {
        street_table_report(r, SEVERITY_ERROR, r->cell[STREET_LAW],
                            "law %s needs a type or a yield", b->law);
    }
    for (int k = STREET_YIELD; k <= STREET_HARDENING && elastic; k++) {
        if (r->cell[k].n > 0) {
            street_table_report(r, SEVERITY_ERROR, r->cell[k],
                                "%s has no meaning for the law elastic", street_columns[k].name);
        }
    }
    b->yield = elastic ? (double)NAN : b->yield;
}

static void read_gap(struct street_table *r, struct street_building *b) {
    b->joined = r->cell[STREET_GAP].n > 0 && !street_table_is(r->cell[STREET_GAP], "none");
    b->gap = r->value[STREET_GAP];
    b->k = r->value[STREET_K];
    b->e = or_else(r->value[STREET_E], RESTITUTION);
    for (int k = STREET_K; k <= STREET_E && !b->joined; k++) {
        if (r->cell[k].n > 0) {
            street_table_report(r, SEVERITY_WARNING, r->cell[k],
                                "%s is not used, because no gap to a next building is given",
                                street_columns[k].name);
        }
    }
}

static void read_building(struct street_table *r, enum street_zone zone, struct name_index *names,
                          int number, struct street_building *b) {
    b->name = read_name(r, names, number);
    if (r->cell[STREET_STOREYS].n == 0) {
        street_table_report(r, SEVERITY_ERROR, r->cell[STREET_STOREYS],
                            "the building has no number of storeys");
        return;
    }
    b->storeys = (int)r->value[STREET_STOREYS];
    read_type(r, zone, b);
    read_dynamics(r, b);
    read_law(r, b);
    read_gap(r, b);
}

// Reports a missing gap, in the line of the building, once the next building is there; and a gap
// behind the last building.
static void check_gap(struct street_table *r, const struct street_table *line, bool last) {
    struct street_table at = *line;
    at.d = r->d;
    const struct piece gap = at.cell[STREET_GAP];
    if (!last && gap.n == 0) {
        street_table_report(&at, SEVERITY_ERROR, gap,
                            "the building has no gap to the next one; give a length or none");
    } else if (last && gap.n > 0 && !street_table_is(gap, "none")) {
        street_table_report(&at, SEVERITY_WARNING, gap, "the gap is not used: no building follows");
    }
}

static void read_all(struct street_table *r, enum street_zone zone, struct street *out) {
    struct name_index names = {.n = 0};
    struct street_table before;
    bool good, good_before = false;
    while (street_table_next(r, &good)) {
        if (good) {
            read_building(r, zone, &names, out->n, &out->building[out->n]);
        }
        if (good_before) {
            check_gap(r, &before, false);
        }
        before = *r;
        good_before = good;
        out->n++;
    }
    if (out->n == 0 && r->d->n_error == 0) {
        street_table_report(r, SEVERITY_ERROR, r->lines.line, "the table has no building");
    } else if (good_before) {
        check_gap(r, &before, true);
        out->building[out->n - 1].joined = false;
    }
}

static void set_stiffness(struct street *s) {
    for (int i = 0; i + 1 < s->n; i++) {
        struct street_building *b = &s->building[i];
        b->k = or_else(b->k, STIFFER * fmax(b->stiffness, b[1].stiffness));
    }
}

int street_read(struct arena *a, const char *path, enum street_zone zone, struct street *out,
                struct diagnostics *d, struct error *e) {
    struct street_table r = {.arena = a, .d = d};
    struct record_text text;
    struct arena *scratch;
    *out = (struct street){.path = path};
    int status = record_text_open(path, FILE_SIZE_MAX, &text, &scratch, e);
    if (status != STATUS_OK) {
        return status;
    }
    status = record_clean(&text, &r.text, e);
    // No more buildings than lines.
    out->building = arena_alloc(a, text.size / 2 + 2, sizeof *out->building);
    if (status == STATUS_OK && out->building) {
        street_table_begin(&r);
        if (d->n_error == 0) {
            read_all(&r, zone, out);
        }
        if (d->n_error > 0) {
            status = error_set(e, STATUS_INPUT, "%d error%s in %s", d->n_error,
                               d->n_error == 1 ? "" : "s", path);
        } else {
            set_stiffness(out);
        }
    }
    arena_free(scratch);
    return arena_failed(a) || d->out_of_memory ? error_no_memory(e) : status;
}
