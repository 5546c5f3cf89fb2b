// SPDX-License-Identifier: GPL-3.0-or-later
#include "law/power.h"

const struct range power_range = {.min = 1.0, .max = 3.0, .text = ">= 1 and <= 3"};
