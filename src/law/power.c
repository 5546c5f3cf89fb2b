// SPDX-License-Identifier: GPL-3.0-or-later
#include "law/power.h"

#include <math.h>

const struct range power_range = {.min = 1.0, .max = 3.0, .text = ">= 1 and <= 3"};

struct contact_response power_spring(double k, double n, double d) {
    double slope = k * (n == 1.5 ? sqrt(d) : pow(d, n - 1.0));
    return (struct contact_response){.force = slope * d, .dfdd = n * slope};
}
