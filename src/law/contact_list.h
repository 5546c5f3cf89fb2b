// SPDX-License-Identifier: GPL-3.0-or-later
// Declares the descriptors named in contact_list.inc.
#ifndef JOSTLE_CONTACT_LIST_H
#define JOSTLE_CONTACT_LIST_H

#include "jostle/contact_law.h"

#define CONTACT_LAW(descriptor) extern const struct contact_law descriptor;
#include "law/contact_list.inc"
#undef CONTACT_LAW

#endif
