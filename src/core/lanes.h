// SPDX-License-Identifier: GPL-3.0-or-later
// Loops over flat arrays in wide lanes.
#ifndef JOSTLE_LANES_H
#define JOSTLE_LANES_H

#include <assert.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>  // any header of the library says which library it is
#include <string.h>

// LANES_WIDEST is the processor that has lanes_wide in one register, and LANES_HALF one that has
// lanes; neither is named where there is nobody to ask for the processor at hand, or no need to, as
// the compiler was told its name (-march=native): functions for one of fewer traits could not have
// those in them that are in line. Of x86-64 and its levels gcc says __k8__, and of no newer name.
// LANES_HALF_AT_MOST makes the program that runs on processors without AVX-512 (make bench-half).
#if defined(__x86_64__) && defined(__k8__) && defined(__GLIBC__) && defined(__GNUC__) &&           \
    !defined(__clang__)
#define LANES_HALF "avx2"
#if __GNUC__ >= 12 && !defined(LANES_HALF_AT_MOST)
#define LANES_WIDEST "x86-64-v4"
#endif
#endif

// In front of a function: it is compiled for the baseline, for AVX2 and for AVX-512, and the loader
// takes what the processor has. Each element sees the same operations in the same order either way,
// so the bits are the same. Elsewhere, and under sanitizers, which the loader asks before they can
// answer, it is compiled once.
#if !defined(LANES_HALF) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define LANES
#elif defined(LANES_WIDEST)
#define LANES __attribute__((target_clones("default", LANES_HALF, "arch=" LANES_WIDEST)))
#else
#define LANES __attribute__((target_clones("default", LANES_HALF)))
#endif

// LANES_WHOLE is in front of a function that only a processor is asked to run that has lanes_wide
// in one register: and of all that have such lanes in them, as compilers take lanes apart that the
// processor they are compiled for does not have, before they expand one function in another.
// LANES_HOLD_WIDE says whether that at hand is one, and is not defined where none can be.
#if defined(__AVX512F__)
#define LANES_WHOLE
#define LANES_HOLD_WIDE true
#elif defined(LANES_WIDEST)
#define LANES_WHOLE __attribute__((target("arch=" LANES_WIDEST)))
#define LANES_HOLD_WIDE __builtin_cpu_supports(LANES_WIDEST)
#else
#define LANES_WHOLE
#endif

// What is made of such functions, where the processor at hand has those registers, or else what all
// have; the first is not there to be linked where no processor has them.
#ifdef LANES_HOLD_WIDE
#define LANES_WIDEST_OF(wide, narrow) (LANES_HOLD_WIDE ? (wide) : (narrow))
#else
#define LANES_WIDEST_OF(wide, narrow) (narrow)
#endif

// In front of what such functions are made of: what is not expanded in them has baseline code only.
#if defined(__GNUC__)
#define LANES_INLINE static inline __attribute__((always_inline))
#else
#define LANES_INLINE static inline
#endif
#define LANES_WHOLE_INLINE LANES_WHOLE LANES_INLINE

// In front of a loop over arrays: no turn reads what another one writes. For loops in functions
// that are expanded in others, where the compiler forgets what `restrict` said.
#if defined(__clang__)
#define LANES_LOOP _Pragma("clang loop vectorize(assume_safety)")
#elif defined(__GNUC__)
#define LANES_LOOP _Pragma("GCC ivdep")
#else
#define LANES_LOOP
#endif

struct arena;

// Bytes of a line of the cache, which no access of whole lanes should straddle.
enum { LANES_LINE = 64 };

// Arrays for such loops have a multiple of LANES_WIDTH elements, those beyond the end 0, and as
// many zeros in front, so that element -1 can be read.
enum { LANES_WIDTH = 8 };

// Neighbours in an array, for what the compiler does not see by itself. The only types that need
// names of their own. `lanes` are as many as AVX2 has in one register; `lanes_wide` serve where no
// value is carried from one turn of a loop to the next, as it would be in memory there.
enum { LANES_VECTOR = 4 };
typedef double lanes
    __attribute__((vector_size(LANES_VECTOR * sizeof(double)), aligned(sizeof(double)), may_alias));
typedef double lanes_wide
    __attribute__((vector_size(LANES_WIDTH * sizeof(double)), aligned(sizeof(double)), may_alias));
typedef int64_t lanes_bits __attribute__((vector_size(LANES_VECTOR * sizeof(int64_t))));
typedef int64_t lanes_wide_bits __attribute__((vector_size(LANES_WIDTH * sizeof(int64_t))));

// Elements i to i + LANES_WIDTH - 1 of an array.
#define LANES_AT(x, i) (*(const lanes_wide *)((x) + (i)))

// Rows of a square become its columns.
LANES_INLINE void lanes_transpose(lanes x[LANES_VECTOR]) {
    const lanes a = x[0], b = x[1], c = x[2], d = x[3];
#if defined(__has_builtin) && __has_builtin(__builtin_shufflevector)
    const lanes ab0 = __builtin_shufflevector(a, b, 0, 4, 2, 6);
    const lanes ab1 = __builtin_shufflevector(a, b, 1, 5, 3, 7);
    const lanes cd0 = __builtin_shufflevector(c, d, 0, 4, 2, 6);
    const lanes cd1 = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    x[0] = __builtin_shufflevector(ab0, cd0, 0, 1, 4, 5);
    x[1] = __builtin_shufflevector(ab1, cd1, 0, 1, 4, 5);
    x[2] = __builtin_shufflevector(ab0, cd0, 2, 3, 6, 7);
    x[3] = __builtin_shufflevector(ab1, cd1, 2, 3, 6, 7);
#else
    for (int i = 0; i < LANES_VECTOR; i++) {
        x[i] = (lanes){a[i], b[i], c[i], d[i]};
    }
#endif
}

// One value of each of eight runs that are computed in lockstep.
enum { WIDE_RUNS = 8 };
typedef double wide __attribute__((vector_size(WIDE_RUNS * sizeof(double))));
typedef long long wide_bits __attribute__((vector_size(WIDE_RUNS * sizeof(long long))));
typedef signed char wide_bytes __attribute__((vector_size(WIDE_RUNS)));

// Is a mask of all bits or none set in some lane? For processors that have such lanes in a
// register.
LANES_INLINE bool wide_any(const wide_bits *mask) {
    const wide_bytes byte = __builtin_convertvector(*mask, wide_bytes);
    int64_t all;
    memcpy(&all, &byte, sizeof all);
    return all != 0;
}

// |x|, and a where a mask has all bits of a lane and b where it has none.
#define WIDE_ABSOLUTE(x) ((wide)((wide_bits)(x)&INT64_MAX))
#define WIDE_CHOOSE(mask, a, b) ((wide)(((mask) & (wide_bits)(a)) | (~(mask) & (wide_bits)(b))))

// All bits where it is so, and the larger and the smaller of two, lane by lane.
#define WIDE_LESS(a, b) ((wide_bits)((a) < (b)))
#define WIDE_AT_MOST(a, b) ((wide_bits)((a) <= (b)))
#define WIDE_LARGER(a, b) WIDE_CHOOSE(WIDE_LESS(b, a), a, b)
#define WIDE_SMALLER(a, b) WIDE_CHOOSE(WIDE_LESS(a, b), a, b)

// Does a register of the processor at hand hold it, or half of it? Where it is split further, gcc
// passes it through memory in pieces, and eight runs one after the other are faster.
bool lanes_hold_wide(void);
bool lanes_hold_half(void);

// A zeroed array for n things of such values, `size` bytes each, with one in front and one behind;
// NULL: no memory.
void *lanes_wide_array(struct arena *a, int n, size_t size);

// A zeroed array for n values, with at least one 0 behind them and behind the lanes in which that
// one lies, so that element i + 1 can be read there too; NULL: no memory.
double *lanes_array(struct arena *a, int n);

// Asserts what loops over such an array rely on: the zeros in front of it and behind.
static inline void lanes_assert(const double *x, int n) {
    assert(x[-1] == 0.0 && x[(n + LANES_WIDTH) & ~(LANES_WIDTH - 1)] == 0.0);
}

// n zeroed things of `size` bytes, the first at the start of a line of the cache; NULL: no memory.
void *lanes_lines(struct arena *a, size_t n, size_t size);

// n rounded up to whole lanes.
static inline int lanes_whole(int n) {
    return (n + LANES_WIDTH - 1) & ~(LANES_WIDTH - 1);
}

// y = from + A x for a matrix A (n, n) that is symmetric to the bit, so that its rows are its
// columns. `from` may be y, and NULL is 0. The products of each y are added in the order of x.
void lanes_add_symmetric(int n, const double *matrix, const double *x, const double *from,
                         double *y);

#endif
