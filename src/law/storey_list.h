// SPDX-License-Identifier: GPL-3.0-or-later
// Declares the descriptors named in storey_list.inc.
#ifndef JOSTLE_STOREY_LIST_H
#define JOSTLE_STOREY_LIST_H

#include "jostle/storey_law.h"

#define STOREY_LAW(descriptor) extern const struct storey_law descriptor;
#include "law/storey_list.inc"
#undef STOREY_LAW

#endif
