// SPDX-License-Identifier: GPL-3.0-or-later
// The decks that are measured: two buildings of 8 and 5 storeys, and rows of equal buildings whose
// stiffness varies from one to the next.
#include <gsl/gsl_rng.h>
#include <stdio.h>
#include <stdlib.h>

#include "bench/bench.h"

static void write_buildings(FILE *f, const struct bench_case *c) {
    if (c->n_building == 0) {
        fputs("building B1 -floors 8 -mass 300t -stiffness 345MN/m -height 3.2m\n"
              "building B2 -floors 5 -mass 300t -stiffness 345MN/m -height 3.2m\n",
              f);
        return;
    }
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);  // from its default seed
    for (int i = 1; random && i <= c->n_building; i++) {
        fprintf(f, "building B%d -floors %d -mass 300t -stiffness %.6fMN/m\n", i, c->n_floor,
                345.0 * (0.7 + 0.8 * gsl_rng_uniform(random)));
    }
    gsl_rng_free(random);
}

static void write_deck(FILE *f, const struct bench_case *c) {
    int n = c->n_building > 0 ? c->n_building : 2;
    write_buildings(f, c);
    for (int i = 1; i <= n; i++) {
        fprintf(f, "damping B%d rayleigh 5%%\n", i);
    }
    for (int i = 1; i < n; i++) {
        fprintf(f, "contact B%d B%d %s\n", i, i + 1, c->contact);
    }
    fprintf(f,
            "%s"
            "param record " BENCH_RECORD "\n"
            "ground record $record\n"
            "duration %gs\n",
            c->statements ? c->statements : "", c->duration);
    if (c->dt > 0.0) {
        fprintf(f, "integrator newmark\nstep fixed %gs\n", c->dt);
    } else {
        fputs("integrator dormand-prince\nstep adaptive -tolerance " BENCH_TOLERANCE "\n", f);
    }
}

char *bench_deck(const struct bench_case *c) {
    char *text = NULL;
    size_t size = 0;
    FILE *f = open_memstream(&text, &size);
    if (!f) {
        return NULL;
    }
    write_deck(f, c);
    if (fclose(f) != 0) {
        free(text);
        return NULL;
    }
    return text;
}

int bench_model(const struct bench_case *c, struct model **out, struct error *e) {
    char *text = bench_deck(c);
    if (!text) {
        return error_no_memory(e);
    }
    struct deck *deck = NULL;
    int status = deck_open_text("input/bench.deck", text, NULL, 0, &deck, e);
    free(text);
    if (status == STATUS_OK && (status = model_build(deck, out, e)) != STATUS_OK) {
        diagnostics_print(&deck->diagnostics, stderr, false);
        deck_free(deck);
    }
    return status;
}
