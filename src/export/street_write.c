// SPDX-License-Identifier: GPL-3.0-or-later
// A street as a deck. Floors have equal masses m and storeys equal heights. Storeys of stiffness
//
//     k_i = omega^2 m (i + (i+1) + ... + n),   i = 1 ... n,
//
// have the first mode u_i = i / n of the circular frequency omega: the inertia forces omega^2 m u_j
// above storey i are k_i / n, and so all drifts are equal. The capacity curve of HAZUS is that of
// this mode. Its base shear at yield is V = A_y a M, with the effective mass
//
//     a M = (sum m u)^2 / (sum m u^2) = 3 (n + 1) / (2 (2 n + 1)) M,
//
// and all storeys yield at the same drift: V_i = V k_i / k_1, with one ratio of stiffnesses.
#include <math.h>

#include "core/safe.h"
#include "export/street.h"

static const double G = 9.80665;  // [m/s^2]

// Floors at levels that differ by less, relative to their height, meet.
static const double SAME = 1e-6;

double street_storey_share(int storeys, int i) {
    const double n = storeys;
    return 1.0 - (double)i * (i + 1.0) / (n * (n + 1.0));
}

double street_effective_mass(int storeys) {
    return 1.5 * (storeys + 1.0) / (2.0 * storeys + 1.0);
}

static void put(FILE *to, const char *key, double value) {
    fprintf(to, " %s %.6g", key, value);
}

// `most` times the share of each storey.
static void put_storeys(FILE *to, const char *key, const struct street_building *b, double most) {
    fprintf(to, " %s", key);
    for (int i = 0; i < b->storeys; i++) {
        fprintf(to, " %.6g", most * street_storey_share(b->storeys, i));
    }
}

// In t, m and kN.
static void write_building(const struct street_building *b, FILE *to) {
    fprintf(to, "\n#");
    if (b->type) {
        fprintf(to, " %s, %s code,", b->type->name, street_code_names[b->code]);
    }
    fprintf(to, " T1 = %.4g s\nbuilding %s -floors %d", b->period, b->name, b->storeys);
    put(to, "-mass", b->mass / 1e3);
    put(to, "-height", b->height);
    put_storeys(to, "-stiffness", b, b->stiffness / 1e3);
    fprintf(to, "\n");
    if (b->damping > 0.0) {
        // On the tangent stiffness: dashpots on the initial one would not yield.
        fprintf(to, "damping %s rayleigh %.6g%s\n", b->name, b->damping,
                isnan(b->yield) ? "" : " -tangent");
    }
    if (!isnan(b->yield)) {
        fprintf(to, "storey %s:all %s", b->name, b->law);
        put_storeys(to, "-yield", b, b->yield * b->storeys * b->mass * G / 1e3);
        put(to, "-hardening", b->hardening);
        fprintf(to, "\n");
    }
}

static void write_contact(const struct street_building *b, FILE *to) {
    const struct street_building *next = b + 1;
    const bool level = fabs(b->height - next->height) <= SAME * b->height;
    fprintf(to, "contact %s %s%s", b->name, next->name, level ? "" : " -by-level");
    put(to, "-gap", b->gap);
    fprintf(to, " -law hunt-crossley -n 1");
    put(to, "-k", b->k / 1e3);
    put(to, "-e", b->e);
    fprintf(to, "\n");
}

static void write_motion(const struct street_motion *m, FILE *to) {
    fprintf(to, "\nground record \"%s\"", m->record);
    if (!isnan(m->pga)) {
        put(to, "-pga", m->pga);
    }
    fprintf(to, "\nstep fixed 0.0005\noutput -interval 0.02 -precision single\n");
}

void street_write(const struct street *s, const struct street_motion *m, FILE *to) {
    fprintf(to, "# Made by jostle street from ");
    safe_put(to, SAFE_COMMENT, s->path);
    fprintf(to, "\ntitle \"Street of %d building%s\"\nunits kN m s\n", s->n, s->n == 1 ? "" : "s");
    for (int i = 0; i < s->n; i++) {
        write_building(&s->building[i], to);
    }
    fprintf(to, "\n");
    for (int i = 0; i + 1 < s->n; i++) {
        if (s->building[i].joined) {
            write_contact(&s->building[i], to);
        }
    }
    if (m->record) {
        write_motion(m, to);
    } else {
        fprintf(to, "\n# Add a ground motion and steps here, or include this deck in one that has "
                    "them.\n");
    }
}
