// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/single_step.h"

#include "core/arena.h"
#include "solve/account/account.h"
#include "support/support.h"

void single_step_init(struct single_step *s, struct model *m) {
    *s = (struct single_step){.model = m, .arena = arena_create()};
    assert_non_null(s->arena);
    assert_true(state_alloc(&s->now, m, s->arena) && state_alloc(&s->next, m, s->arena) &&
                peaks_alloc(&s->results, m, s->arena) &&
                fields_alloc(&energy_fields, m, &s->energy, s->arena) &&
                state_memory_alloc(&s->memory, m, s->arena) &&
                work_alloc(&s->work, m, &s->results, &s->memory, s->arena));
    floors_account_to(&s->work, &s->energy, &s->results, NULL);
    s->work.strictness = STEP_ACCEPT;
}

void single_step_free(struct single_step *s) {
    arena_free(s->arena);
    model_free(s->model);
}

void single_step_take(struct single_step *s, double h) {
    struct error e = {0};
    assert_int_equal(newmark_step(&s->work, &s->now, &s->next, h, h, &e), STATUS_OK);
}
