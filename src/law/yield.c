// SPDX-License-Identifier: GPL-3.0-or-later
#include "law/yield.h"

const struct range yield_hardening_range = {
    .min = 0.0, .max = 1.0, .max_open = true, .text = ">= 0 and < 1"};
