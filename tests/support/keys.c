// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/keys.h"

#include "support/support.h"

void keys_made_up(struct keys *keys, long n, const int *byte) {
    struct error e;
    assert_int_equal(keys_open(keys, n, &e), STATUS_OK);
    for (long run = 0; run < n; run++) {
        keys->key[run].byte[31] = (unsigned char)(byte ? byte[run] : run + 1);
    }
    keys_index(keys);
}
