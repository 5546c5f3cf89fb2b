// SPDX-License-Identifier: GPL-3.0-or-later
// The version of the numerics: a number that is raised when the same deck gives other numbers, by
// as little as the last bit. Result files tell it, and runs of different versions are not mixed.
// docs/architecture.md says when and how it is raised.
#ifndef JOSTLE_NUMERICS_H
#define JOSTLE_NUMERICS_H

#include "jostle/names.h"

JOSTLE_C_BEGIN

enum { NUMERICS_VERSION = 10 };

JOSTLE_C_END

#endif
