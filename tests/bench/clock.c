// SPDX-License-Identifier: GPL-3.0-or-later
// A multiplication of integers takes three cycles on every x86-64 processor since 2008 (Fog,
// Instruction tables), so a chain of them, each waiting for the one before, tells the clock.
#include "bench/bench.h"

#include <math.h>

double bench_seconds(clockid_t clock) {
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

#if defined(__x86_64__) && defined(__GNUC__)

enum { ROUNDS = 9, TURNS = 100000, CHAIN = 16 };
static const double CYCLES = 3.0;

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
        double start = bench_seconds(CLOCK_THREAD_CPUTIME_ID);
        multiply((unsigned long)i + 7);
        fastest = fmin(fastest, bench_seconds(CLOCK_THREAD_CPUTIME_ID) - start);
    }
    return 1e-9 * CYCLES * TURNS * CHAIN / fastest;
}

#else

double bench_clock(void) {
    return 0.0;
}

#endif
