// SPDX-License-Identifier: GPL-3.0-or-later
// The models measured. Limits are the times of prototypes that did nothing but this, targets are
// those that the program was written against; docs/performance.md says where both come from.
#include "bench/bench.h"

#define JANKOWSKI "-law jankowski -k 2.75e9N/m^1.5 -zeta 0.35"
#define NEAR "-gap 20mm "
#define APART "-gap 2m "  // never meets

// A yield shear of a sixth of the building's weight.
static const char bilinear[] = "storey B1:all bilinear -yield 4MN -hardening 0.05\n"
                               "storey B2:all bilinear -yield 2.5MN -hardening 0.05\n";

// One that rests on friction pendulums; and damping that follows the tangents of yielding storeys.
#define ISOLATOR "isolator B1:1 fps -radius 2m -mu 6% -mu-slow 3% -rate 30s/m\n"
#define TANGENT(name) "damping " name " rayleigh -alpha 0 -beta 2ms -tangent\n"
#define TANGENTS                                                                                   \
    TANGENT("B1")                                                                                  \
    TANGENT("B2")                                                                                  \
    "storey B1:all bilinear -yield 4MN -hardening 0.05\n"                                          \
    "storey B2:all bilinear -yield 2.5MN -hardening 0.05\n"

// Storeys of other laws with the same yield shear.
#define STOREYS(law, options)                                                                      \
    "storey B1:all " law " -yield 4MN -hardening 0.05" options "\nstorey B2:all " law              \
    " -yield 2.5MN -hardening 0.05" options "\n"

#define TRILINEAR                                                                                  \
    "storey B1:all trilinear -crack 2MN -yield 4MN -cracked 0.3 -hardening 0.05\n"                 \
    "storey B2:all trilinear -crack 1.3MN -yield 2.5MN -cracked 0.3 -hardening 0.05\n"

#define RAMBERG_OSGOOD                                                                             \
    "storey B1:all ramberg-osgood -yield 4MN -eta 0.3 -r 7\n"                                      \
    "storey B2:all ramberg-osgood -yield 2.5MN -eta 0.3 -r 7\n"

// A wall in each building, whose stiffness matrix is full.
#define WALLS                                                                                      \
    "matrix B1 ../tests/bench/wall8.txt -unit MN/m\n"                                              \
    "matrix B2 ../tests/bench/wall5.txt -unit MN/m\n"

// A frame of two bays in each building.
#define FRAME(name)                                                                                \
    "frame " name " -bays 2*6m -modulus 30GPa\ncolumns " name                                      \
    " -I 5e-3m^4 -A 0.25m^2\nbeams " name " -I 5e-3m^4\n"
#define FRAMES FRAME("B1") FRAME("B2")
#define HINGES(name)                                                                               \
    "hinges " name                                                                                 \
    ":all beams bilinear -yield 0.3MN*m -hardening 0.02 -stiffness 1GN*m\nhinges " name            \
    " bases bilinear -yield 0.3MN*m -hardening 0.02 -stiffness 1GN*m\n"

const struct bench_case bench_cases[] = {
    {"pair", 0, 0, NEAR JANKOWSKI, NULL, 1e-3, 40.0, bench_analysis, 15.0, 60.0},
    {"pair", 0, 0, NEAR JANKOWSKI, NULL, 1e-4, 40.0, bench_analysis, 12.7, 60.0},
    {"row 2x10", 2, 10, NEAR JANKOWSKI, NULL, 1e-3, 40.0, bench_analysis, 35.0, 0.0},
    {"row 10x10", 10, 10, NEAR JANKOWSKI, NULL, 1e-3, 40.0, bench_analysis, 158.0, 400.0},
    {"row 100x20", 100, 20, NEAR JANKOWSKI, NULL, 1e-3, 10.0, bench_analysis, 5300.0, 8000.0},
    {"row 1000x50", 1000, 50, NEAR JANKOWSKI, NULL, 1e-3, 3.0, bench_analysis, 179e3, 300e3},
    {"pair, bilinear storeys", 0, 0, NEAR JANKOWSKI, bilinear, 1e-3, 40.0, bench_analysis, 84.0,
     120.0},
    {"pair, clough storeys", 0, 0, NEAR JANKOWSKI, STOREYS("clough", ""), 1e-3, 40.0,
     bench_analysis, 0.0, 250.0},
    {"pair, takeda storeys", 0, 0, NEAR JANKOWSKI, STOREYS("takeda", " -alpha 0.4"), 1e-3, 40.0,
     bench_analysis, 0.0, 300.0},
    {"pair, bouc-wen storeys", 0, 0, NEAR JANKOWSKI, STOREYS("bouc-wen", " -n 2"), 1e-3, 40.0,
     bench_analysis, 0.0, 400.0},
    {"pair, bouc-wen, pinching", 0, 0, NEAR JANKOWSKI,
     STOREYS("bouc-wen", " -n 1 -delta-nu 0.02 -zeta-s 0.9"), 1e-3, 40.0, bench_analysis, 0.0,
     500.0},
    {"pair, ramberg-osgood storeys", 0, 0, NEAR JANKOWSKI, RAMBERG_OSGOOD, 1e-3, 40.0,
     bench_analysis, 0.0, 500.0},
    {"pair, multilinear storeys", 0, 0, NEAR JANKOWSKI,
     STOREYS("multilinear", " -drift-2 50mm -shear-2 6MN"), 1e-3, 40.0, bench_analysis, 0.0, 500.0},
    {"pair, trilinear storeys", 0, 0, NEAR JANKOWSKI, TRILINEAR, 1e-3, 40.0, bench_analysis, 0.0,
     500.0},
    {"pair, imk storeys", 0, 0, NEAR JANKOWSKI,
     STOREYS("imk", " -capping 60mm -post-capping -0.1 -gamma-s 100 -gamma-k 100"), 1e-3, 40.0,
     bench_analysis, 0.0, 500.0},
    {"pair, flag storeys", 0, 0, NEAR JANKOWSKI, STOREYS("flag", " -b 0.8"), 1e-3, 40.0,
     bench_analysis, 0.0, 500.0},
    {"pair, slip storeys", 0, 0, NEAR JANKOWSKI, STOREYS("slip", " -slack 5mm"), 1e-3, 40.0,
     bench_analysis, 0.0, 500.0},
    {"pair, modal damping", 0, 0, NEAR JANKOWSKI, "damping B1 modal 1%\ndamping B2 modal 1%\n",
     1e-3, 40.0, bench_analysis, 0.0, 90.0},
    {"pair, full matrices", 0, 0, NEAR JANKOWSKI, WALLS, 1e-3, 40.0, bench_analysis, 0.0, 120.0},
    {"pair, isolator", 0, 0, NEAR JANKOWSKI, ISOLATOR, 1e-3, 40.0, bench_analysis, 0.0, 500.0},
    {"pair, tangent damping", 0, 0, NEAR JANKOWSKI, TANGENTS, 1e-3, 40.0, bench_analysis, 0.0,
     1000.0},
    {"pair, frames", 0, 0, NEAR JANKOWSKI, FRAMES, 1e-3, 40.0, bench_analysis, 0.0, 150.0},
    {"pair, frames with hinges", 0, 0, NEAR JANKOWSKI, FRAMES HINGES("B1") HINGES("B2"), 1e-3, 40.0,
     bench_analysis, 0.0, 5000.0},
    {"pair, damper link", 0, 0, NEAR JANKOWSKI, "link B1:5 B2:5 -dashpot 2MN*s/m\n", 1e-3, 40.0,
     bench_analysis, 0.0, 100.0},
    {"pair, spring link", 0, 0, NEAR JANKOWSKI, "link B1:5 B2:5 -stiffness 50MN/m\n", 1e-3, 40.0,
     bench_analysis, 0.0, 80.0},
    {"pair, linear", 0, 0, NEAR "-law linear -k 100MN/m", NULL, 1e-3, 40.0, bench_analysis, 0.0,
     60.0},
    {"pair, kelvin-voigt", 0, 0, NEAR "-law kelvin-voigt -k 100MN/m -e 0.65", NULL, 1e-3, 40.0,
     bench_analysis, 0.0, 60.0},
    {"pair, hertz", 0, 0, NEAR "-law hertz -k 2.75e9N/m^1.5", NULL, 1e-3, 40.0, bench_analysis, 0.0,
     60.0},
    {"pair, hertz-damp", 0, 0, NEAR "-law hertz-damp -k 2.75e9N/m^1.5 -e 0.65", NULL, 1e-3, 40.0,
     bench_analysis, 0.0, 60.0},
    {"pair, no contact", 0, 0, APART JANKOWSKI, NULL, 1e-3, 40.0, bench_analysis, 10.0, 0.0},
    {"row 2x10, no contact", 2, 10, APART JANKOWSKI, NULL, 1e-3, 40.0, bench_analysis, 0.0, 0.0},
    {"row 10x10, no contact", 10, 10, APART JANKOWSKI, NULL, 1e-3, 40.0, bench_analysis, 62.0, 0.0},
    {"row 100x20, no contact", 100, 20, APART JANKOWSKI, NULL, 1e-3, 10.0, bench_analysis, 952.0,
     0.0},
    {"row 1000x50, no contact", 1000, 50, APART JANKOWSKI, NULL, 1e-3, 3.0, bench_analysis, 30.7e3,
     0.0},
    {"ensemble of 8 pairs", 0, 0, NEAR JANKOWSKI, NULL, 1e-3, 40.0, bench_ensemble, 6.2, 10.0},
    {"ensemble of 8 pairs", 0, 0, NEAR JANKOWSKI, NULL, 1e-4, 40.0, bench_ensemble, 5.4, 10.0},
    {"ensemble of 8, bilinear", 0, 0, NEAR JANKOWSKI, bilinear, 1e-3, 40.0, bench_ensemble, 0.0,
     60.0},
    {"ensemble of 8, no contact", 0, 0, APART JANKOWSKI, NULL, 1e-3, 40.0, bench_ensemble, 2.15,
     0.0},
    {"ensemble of 8 rows 2x10", 2, 10, NEAR JANKOWSKI, NULL, 1e-3, 40.0, bench_ensemble, 9.0, 0.0},
    {"ensemble of 8 rows 10x10", 10, 10, NEAR JANKOWSKI, NULL, 1e-3, 40.0, bench_ensemble, 93.0,
     0.0},
    {"ensemble of 8 2x10, apart", 2, 10, APART JANKOWSKI, NULL, 1e-3, 40.0, bench_ensemble, 0.0,
     0.0},
    {"ensemble of 8 10x10, apart", 10, 10, APART JANKOWSKI, NULL, 1e-3, 40.0, bench_ensemble, 0.0,
     0.0},
    {"pair, dormand-prince", 0, 0, NEAR JANKOWSKI, NULL, 0.0, 40.0, bench_analysis, 127.0, 500.0},
    {"row 10x10, dormand-prince", 10, 10, NEAR JANKOWSKI, NULL, 0.0, 40.0, bench_analysis, 0.0,
     0.0},
    {"pair, rows of 0.01 s", 0, 0, NEAR JANKOWSKI, "output -interval 0.01s\n", 1e-3, 40.0,
     bench_histories, 0.0, 0.0},
    {"pair, rows of each step", 0, 0, NEAR JANKOWSKI, "output -every 1\n", 1e-3, 40.0,
     bench_histories, 0.0, 0.0},
    {"pair, each step, compressed", 0, 0, NEAR JANKOWSKI, "output -every 1 -compress 1\n", 1e-3,
     40.0, bench_histories, 0.0, 0.0},
    {"pair, whole program", 0, 0, NEAR JANKOWSKI, NULL, 1.25e-3, 2.5, bench_program, 0.0, 2500.0},
};
const int n_bench_case = sizeof bench_cases / sizeof bench_cases[0];

const struct bench_case bench_built[] = {
    {"pair", 0, 0, NEAR JANKOWSKI, NULL, 1e-3, 40.0, bench_build, 0.0, 0.0},
    {"row 10x50", 10, 50, NEAR JANKOWSKI, NULL, 1e-3, 40.0, bench_build, 0.0, 0.0},
    {"row 100x50", 100, 50, NEAR JANKOWSKI, NULL, 1e-3, 40.0, bench_build, 0.0, 0.0},
    {"row 1000x50", 1000, 50, NEAR JANKOWSKI, NULL, 1e-3, 40.0, bench_build, 0.0, 0.0},
    {"row 5000x10", 5000, 10, NEAR JANKOWSKI, NULL, 1e-3, 40.0, bench_build, 0.0, 0.0},
};
const int n_bench_built = sizeof bench_built / sizeof bench_built[0];

// Short, but with impacts.
const struct bench_case bench_counted[] = {
    {"pair", 0, 0, NEAR JANKOWSKI, NULL, 1e-3, 5.0, bench_analysis, 0.0, 0.0},
    {"pair, kelvin-voigt", 0, 0, NEAR "-law kelvin-voigt -k 100MN/m -e 0.65", NULL, 1e-3, 5.0,
     bench_analysis, 0.0, 0.0},
    {"pair, bilinear storeys", 0, 0, NEAR JANKOWSKI, bilinear, 1e-3, 5.0, bench_analysis, 0.0, 0.0},
    {"pair, clough storeys", 0, 0, NEAR JANKOWSKI, STOREYS("clough", ""), 1e-3, 5.0, bench_analysis,
     0.0, 0.0},
    {"pair, bouc-wen storeys", 0, 0, NEAR JANKOWSKI, STOREYS("bouc-wen", " -n 2"), 1e-3, 5.0,
     bench_analysis, 0.0, 0.0},
    {"pair, modal damping", 0, 0, NEAR JANKOWSKI, "damping B1 modal 1%\ndamping B2 modal 1%\n",
     1e-3, 5.0, bench_analysis, 0.0, 0.0},
    {"pair, full matrices", 0, 0, NEAR JANKOWSKI, WALLS, 1e-3, 5.0, bench_analysis, 0.0, 0.0},
    {"pair, isolator", 0, 0, NEAR JANKOWSKI, ISOLATOR, 1e-3, 5.0, bench_analysis, 0.0, 0.0},
    {"pair, tangent damping", 0, 0, NEAR JANKOWSKI, TANGENTS, 1e-3, 5.0, bench_analysis, 0.0, 0.0},
    {"pair, spring link", 0, 0, NEAR JANKOWSKI, "link B1:5 B2:5 -stiffness 50MN/m\n", 1e-3, 5.0,
     bench_analysis, 0.0, 0.0},
    {"row 10x10", 10, 10, NEAR JANKOWSKI, NULL, 1e-3, 4.0, bench_analysis, 0.0, 0.0},
    {"row 100x20", 100, 20, NEAR JANKOWSKI, NULL, 1e-3, 5.0, bench_analysis, 0.0, 0.0},
    {"pair, dormand-prince", 0, 0, NEAR JANKOWSKI, NULL, 0.0, 40.0, bench_analysis, 0.0, 0.0},
};
const int n_bench_counted = sizeof bench_counted / sizeof bench_counted[0];
