// SPDX-License-Identifier: GPL-3.0-or-later
// What the program says when it comes to harm.
#ifndef JOSTLE_CRASH_H
#define JOSTLE_CRASH_H

// From now on a signal of harm (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT) ends the program with a
// message and EXIT_SYSTEM, unless somebody else has asked for it, as the sanitizers do. The HDF5
// library answers some damaged files that way, and a want of memory amid its work; files without
// their last name stay behind, as they do when the program is killed.
void crash_catch(void);

#endif
