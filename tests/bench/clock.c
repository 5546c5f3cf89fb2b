// SPDX-License-Identifier: GPL-3.0-or-later
// A multiplication of integers takes three cycles on every x86-64 processor since 2008 (Fog,
// Instruction tables), so a chain of them, each waiting for the one before, tells the clock.
#include <math.h>
#include <time.h>

#include "bench/bench.h"

#if defined(__x86_64__) && defined(__GNUC__)

enum { ROUNDS = 9, TURNS = 100000, CHAIN = 16 };
static const double CYCLES = 3.0;

static double seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

// The empty instruction keeps the compiler from joining multiplications.
static void multiply(unsigned long factor) {
    unsigned long x = factor;
    for (int i = 0; i < TURNS; i++) {
        for (int j = 0; j < CHAIN; j++) {
            x *= factor;
            __asm__ volatile("" : "+r"(x));
        }
    }
}

double bench_clock(void) {
    double fastest = INFINITY;
    for (int i = 0; i < ROUNDS; i++) {
        double start = seconds();
        multiply((unsigned long)i + 7);
        fastest = fmin(fastest, seconds() - start);
    }
    return 1e-9 * CYCLES * TURNS * CHAIN / fastest;
}

#else

double bench_clock(void) {
    return 0.0;
}

#endif
