// SPDX-License-Identifier: GPL-3.0-or-later
// Declares the descriptors named in contact_list.inc and storey_list.inc.
#ifndef JOSTLE_LAW_LISTS_H
#define JOSTLE_LAW_LISTS_H

#include "jostle/contact_law.h"
#include "jostle/storey_law.h"

#define CONTACT_LAW(descriptor) extern const struct contact_law descriptor;
#include "law/contact_list.inc"
#undef CONTACT_LAW

#define STOREY_LAW(descriptor) extern const struct storey_law descriptor;
#include "law/storey_list.inc"
#undef STOREY_LAW

#endif
