// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a deck statement by statement into a builder, and finishes the model.
#include "jostle/model.h"

#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "core/lanes.h"
#include "model/statement.h"

#define STATEMENT(descriptor) &descriptor,
const struct statement_kind *const statement_kinds[] = {
#include "model/statement_list.inc"
};
#undef STATEMENT
const int n_statement_kind = sizeof statement_kinds / sizeof statement_kinds[0];

static const double STEP_ROUNDING = 1e-9;  // of a step, in counting steps

static void build_statement(struct builder *b, const struct statement *s) {
    for (int i = 0; i < n_statement_kind; i++) {
        if (strcmp(statement_kinds[i]->name, s->word[0].text) == 0) {
            statement_kinds[i]->build(b, s);
            return;
        }
    }
    b->deck->torn = true;
    int n = n_statement_kind + n_deck_statement;
    const char **known = arena_alloc(b->arena, (size_t)n, sizeof *known);
    for (int i = 0; known && i < n; i++) {
        known[i] = i < n_statement_kind ? statement_kinds[i]->name
                                        : deck_statements[i - n_statement_kind].name;
    }
    if (known) {
        deck_unknown(b->deck, &s->word[0], s->word[0].text, "statement", known, n);
    }
}

static int build_all(struct builder *b, struct error *e) {
    struct statement s;
    while (deck_next(b->deck, &s)) {
        build_statement(b, &s);
        if (arena_failed(b->arena) || b->deck->diagnostics.out_of_memory) {
            return error_no_memory(e);
        }
    }
    return STATUS_OK;
}

int model_build(struct deck *deck, struct model **out, struct error *e) {
    return model_build_shared(deck, NULL, out, e);
}

int model_build_shared(struct deck *deck, struct shelf *records, struct model **out,
                       struct error *e) {
    const struct builder empty = {
        .deck = deck,
        .arena = deck->arena,
        .records = records,
        .beta = 0.25,
        .gamma = 0.5,
        .tolerance = 1e-12,
        .iterations = 100,
        .out = {.fields = FIELD_ALL},
    };
    struct builder b;
    struct model *m = arena_alloc(deck->arena, 1, sizeof *m);
    if (!m) {
        return error_no_memory(e);
    }
    int status;
    do {
        b = empty;
        status = build_all(&b, e);
    } while (status == STATUS_OK && deck_rewind(deck));
    if (status == STATUS_OK) {
        status = builder_finish(&b, m, e);
    }
    if (status != STATUS_OK) {
        return status;
    }
    m->deck = deck;
    *out = m;
    return STATUS_OK;
}

long model_rows(const struct model *m) {
    return 1 + m->n_step / m->output.every + (m->n_step % m->output.every != 0);
}

void model_free(struct model *m) {
    if (m) {
        deck_free(m->deck);
    }
}

double model_time(const struct model *m, long n) {
    return n >= m->n_step ? m->duration : (double)n * m->dt;
}

LANES void model_times(const struct model *m, long first, int n, double *time) {
    for (int i = 0; i < n; i++) {
        time[i] = (double)(first + i) * m->dt;
    }
    for (long i = m->n_step > first ? m->n_step - first : 0; i < n; i++) {
        time[i] = m->duration;
    }
}

double model_order(const struct model *m) {
    return m->integrator == INTEGRATOR_DORMAND_PRINCE ? 5.0 : m->gamma > 0.5 ? 1.0 : 2.0;
}

// The tolerance is on the local error: of Newmark's method one order above the global one, and of
// the fourth order formula beside Dormand & Prince's.
static double tolerance_per_halving(const struct model *m) {
    return exp2(m->integrator == INTEGRATOR_DORMAND_PRINCE ? 5.0 : model_order(m) + 1.0);
}

struct model model_refined(const struct model *m, int level) {
    struct model finer = *m;
    if (m->adaptive) {
        finer.control.tolerance = m->control.tolerance / pow(tolerance_per_halving(m), level);
        return finer;
    }
    const long parts = 1L << level;
    const double last = m->duration - (double)(m->n_step - 1) * m->dt;
    finer.dt = m->dt / (double)parts;
    finer.n_step = (m->n_step - 1) * parts + (long)ceil(last / finer.dt - STEP_ROUNDING);
    finer.output.every = m->output.every > OUTPUT_EVERY_MAX / parts ? OUTPUT_EVERY_MAX
                                                                    : m->output.every * (int)parts;
    return finer;
}
