// SPDX-License-Identifier: GPL-3.0-or-later
// Loops over flat arrays in wide lanes.
#ifndef JOSTLE_LANES_H
#define JOSTLE_LANES_H

#include <assert.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>  // any header of the library says which library it is
#include <string.h>

// LANES_WIDEST names the processors that hold lanes_wide in one register, LANES_HALF those that
// hold lanes. Neither is defined if the program cannot detect its processor when it starts, or if
// the compiler got a processor by name (-march=native): a function compiled for an older processor
// cannot inline functions of that processor. gcc defines __k8__ for x86-64 and its levels only.
// LANES_HALF_AT_MOST builds the program as it runs on processors without AVX-512 (make bench-half).
#if defined(__x86_64__) && defined(__k8__) && defined(__GLIBC__) && defined(__GNUC__) &&           \
    !defined(__clang__)
#define LANES_HALF "avx2"
#if __GNUC__ >= 12 && !defined(LANES_HALF_AT_MOST)
#define LANES_WIDEST "x86-64-v4"
#endif
#endif

// Before a function: it is compiled for the baseline, for AVX2 and for AVX-512, and the loader
// selects the version for the processor. Each element gets the same operations in the same order in
// all versions, so the bits are the same. On other systems the function is compiled once. So it is
// under sanitizers, because the loader selects before sanitizers are initialised.
#if !defined(LANES_HALF) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define LANES
#elif defined(LANES_WIDEST)
#define LANES __attribute__((target_clones("default", LANES_HALF, "arch=" LANES_WIDEST)))
#else
#define LANES __attribute__((target_clones("default", LANES_HALF)))
#endif

// LANES_WHOLE is before a function that runs only on processors that hold lanes_wide in one
// register. All functions with lanes_wide that it inlines need it too: compilers split lanes that
// the processor of a function does not have, and they do so before they inline. LANES_HOLD_WIDE is
// true if this processor is one of them. It is not defined if no processor of this build can be.
#if defined(__AVX512F__)
#define LANES_WHOLE
#define LANES_HOLD_WIDE true
#elif defined(LANES_WIDEST)
#define LANES_WHOLE __attribute__((target("arch=" LANES_WIDEST)))
#define LANES_HOLD_WIDE __builtin_cpu_supports(LANES_WIDEST)
#else
#define LANES_WHOLE
#endif

// Selects `wide`, made of LANES_WHOLE functions, if this processor has the registers, else
// `narrow`. If no processor of this build has them, `wide` is not compiled and not referred to.
#ifdef LANES_HOLD_WIDE
#define LANES_WIDEST_OF(wide, narrow) (LANES_HOLD_WIDE ? (wide) : (narrow))
#else
#define LANES_WIDEST_OF(wide, narrow) (narrow)
#endif

// Before the parts of LANES functions: a part that is not inlined would have baseline code only.
#if defined(__GNUC__)
#define LANES_INLINE static inline __attribute__((always_inline))
#else
#define LANES_INLINE static inline
#endif
#define LANES_WHOLE_INLINE LANES_WHOLE LANES_INLINE

// Before a loop over arrays in which no iteration reads what another one writes. It is needed in
// inlined functions, where the compiler ignores `restrict`.
#if defined(__clang__)
#define LANES_LOOP _Pragma("clang loop vectorize(assume_safety)")
#elif defined(__GNUC__)
#define LANES_LOOP _Pragma("GCC ivdep")
#else
#define LANES_LOOP
#endif

struct arena;

// Bytes of a cache line. An access to lanes should not cross the end of a line.
enum { LANES_LINE = 64 };

// Arrays for such loops have a multiple of LANES_WIDTH elements. Elements beyond the end are 0. As
// many zeros are in front of the array, so that element -1 can be read.
enum { LANES_WIDTH = 8 };

// Neighbouring elements of an array, for loops that the compiler does not vectorise. `lanes` fill
// one register of AVX2. `lanes_wide` are for loops that carry no value from one iteration to the
// next: on AVX2 such a value would be kept in memory.
enum { LANES_VECTOR = 4 };
typedef double lanes
    __attribute__((vector_size(LANES_VECTOR * sizeof(double)), aligned(sizeof(double)), may_alias));
typedef double lanes_wide
    __attribute__((vector_size(LANES_WIDTH * sizeof(double)), aligned(sizeof(double)), may_alias));
typedef int64_t lanes_bits __attribute__((vector_size(LANES_VECTOR * sizeof(int64_t))));
typedef int64_t lanes_wide_bits __attribute__((vector_size(LANES_WIDTH * sizeof(int64_t))));

// Elements i to i + LANES_WIDTH - 1 of an array.
#define LANES_AT(x, i) (*(const lanes_wide *)((x) + (i)))

// Transposes a square matrix of lanes.
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

// True if some lane of the mask is set. In each lane all bits are set, or none. For processors that
// hold such lanes in one register.
LANES_INLINE bool wide_any(const wide_bits *mask) {
    const wide_bytes byte = __builtin_convertvector(*mask, wide_bytes);
    int64_t all;
    memcpy(&all, &byte, sizeof all);
    return all != 0;
}

// |x| lane by lane; and a in the lanes where the mask is set, b in the others.
#define WIDE_ABSOLUTE(x) ((wide)((wide_bits)(x)&INT64_MAX))
#define WIDE_CHOOSE(mask, a, b) ((wide)(((mask) & (wide_bits)(a)) | (~(mask) & (wide_bits)(b))))

// Masks of comparisons, and the larger of two values, lane by lane.
#define WIDE_LESS(a, b) ((wide_bits)((a) < (b)))
#define WIDE_AT_MOST(a, b) ((wide_bits)((a) <= (b)))
#define WIDE_LARGER(a, b) WIDE_CHOOSE(WIDE_LESS(b, a), a, b)

// True if a register of this processor holds a wide, or half of it. With smaller registers gcc
// passes a wide through memory, and computing eight runs one after the other is faster.
bool lanes_hold_wide(void);
bool lanes_hold_half(void);

// A zeroed array of n elements of `size` bytes, made of wide values, with one more element in front
// and one after the end; NULL: no memory.
void *lanes_wide_array(struct arena *a, int n, size_t size);

// A zeroed array of n values for lanes. At least one 0 follows the values and the last lanes, so
// that element i + 1 can be read there, too. NULL: no memory.
double *lanes_array(struct arena *a, int n);

// Asserts the zeros in front of such an array and after its end, which loops read.
static inline void lanes_assert(const double *x, int n) {
    assert(x[-1] == 0.0 && x[(n + LANES_WIDTH) & ~(LANES_WIDTH - 1)] == 0.0);
}

// n zeroed elements of `size` bytes, the first at the start of a cache line; NULL: no memory.
void *lanes_lines(struct arena *a, size_t n, size_t size);

// n rounded up to whole lanes.
static inline int lanes_whole(int n) {
    return (n + LANES_WIDTH - 1) & ~(LANES_WIDTH - 1);
}

// n, which is in whole lanes. The mask shows the compiler that no elements are left over.
static inline int lanes_rounded(int n) {
    return n & ~(LANES_WIDTH - 1);
}

// y = from + A x for a matrix A (n, n) that is exactly symmetric, so that its rows are its columns.
// `from` may be y; NULL stands for 0. The products of each y are added in the order of x.
void lanes_add_symmetric(int n, const double *matrix, const double *x, const double *from,
                         double *y);

#endif
