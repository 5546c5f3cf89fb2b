// SPDX-License-Identifier: GPL-3.0-or-later
// The checksum of a file or of what a file says: SHA-256 (FIPS 180-4).
#ifndef JOSTLE_PUBLIC_CHECKSUM_H
#define JOSTLE_PUBLIC_CHECKSUM_H

#include "jostle/names.h"

JOSTLE_C_BEGIN

enum { CHECKSUM_DIGITS = 64 };

struct checksum {
    char digits[CHECKSUM_DIGITS + 1];  // hexadecimal, lower case, and a final 0; "": there is none
};

JOSTLE_C_END

#endif
