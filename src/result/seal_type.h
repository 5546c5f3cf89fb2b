// SPDX-License-Identifier: GPL-3.0-or-later
// The types of values in a result file, for its checksum.
#ifndef JOSTLE_SEAL_TYPE_H
#define JOSTLE_SEAL_TYPE_H

#include <hdf5.h>

#include "core/checksum.h"

// How values of a type are added: as bytes, as texts of any length, as lists of references to
// dimension scales, as the users of such a scale. KIND_NONE: jostle does not write such a type.
enum seal_kind { KIND_NONE, KIND_BYTES, KIND_TEXT, KIND_SCALES, KIND_USES };

enum seal_kind seal_kind_of(hid_t type);

// Adds everything about a type on which the values depend.
void seal_add_type(struct checksum_sum *to, hid_t type, enum seal_kind kind);

#endif
