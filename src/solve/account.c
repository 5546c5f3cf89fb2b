// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/account.h"

#include "solve/floors.h"

void account_step(struct energy_account *a, struct results *r, struct floors_late *late,
                  const struct model *m, const struct state *now, struct state *next) {
    if (!state_is_linear(m)) {
        energy_step(a, m, now, next);
        peaks_all_floors(r, m, next);
    } else if (late->possible) {
        floors_defer(late, now);
    } else {
        floors_account(a, r, m, now, next);
    }
}
