// SPDX-License-Identifier: GPL-3.0-or-later
// Which models run in lockstep on which processor.
#include "jostle/ensemble.h"
#include "support/support.h"

// With eight numbers in a register lockstep is always faster, with four for some models only: not
// for the pair of 8 and 5 storeys, nor for ten buildings of ten.
static void lockstep_is_taken_where_it_has_been_measured_to_be_faster(void **state) {
    (void)state;
    assert_true(ensemble_pays_with(8, 13) && ensemble_pays_with(8, 100));
    assert_false(ensemble_pays_with(4, 13) || ensemble_pays_with(4, 16));
    assert_true(ensemble_pays_with(4, 17) && ensemble_pays_with(4, 26));
    assert_false(ensemble_pays_with(4, 30) || ensemble_pays_with(4, 100));
    assert_false(ensemble_pays_with(2, 20) || ensemble_pays_with(1, 20));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lockstep_is_taken_where_it_has_been_measured_to_be_faster),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
