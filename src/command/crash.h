// SPDX-License-Identifier: GPL-3.0-or-later
// What the program says when it comes to harm.
#ifndef JOSTLE_CRASH_H
#define JOSTLE_CRASH_H

// From now on a signal of harm (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT) ends the program with a
// message and EXIT_SYSTEM, unless somebody else has asked for it, as the sanitizers do; while a
// file is read and there is memory, with EXIT_INPUT. The HDF5 library answers some damaged files
// that way, and a want of memory amid its work; files without their last name stay behind, as they
// do when the program is killed. The same holds where a library calls exit(), as HDF5 does where
// memory runs out while it starts.
void crash_catch(void);

// The message names this file from now on; NULL: none. `context` is not used.
void crash_reading(void *context, const char *path);

// The program ends by itself: exit() is no harm from now on.
void crash_release(void);

#endif
