// SPDX-License-Identifier: GPL-3.0-or-later
// The pictures of commands: response spectra, isolated impacts, pounding force spectra.
#ifndef JOSTLE_PLOT_PICTURES_H
#define JOSTLE_PLOT_PICTURES_H

#include "jostle/intensity.h"
#include "jostle/spectrum.h"
#include "law/isolated.h"
#include "law/storey_loop.h"
#include "motion/target.h"
#include "plot/figure.h"
#include "plot/panel.h"
#include "study/comparison.h"

// The picture of response spectra: pseudo-acceleration against the logarithm of the period.

// What is drawn, in SI units; periods of 0 are left out.
struct response_sheet {
    const struct spectra *spectra;
    const char *const *name;            // (n_record)
    const struct intensity *intensity;  // (n_record)
    const struct target *target;        // to which they were scaled; NULL: to none
    const double *factor;               // (n_record) by which
    struct span match;                  // the periods between which it was compared
    double gravity;                     // [m/s^2] the unit g
    const char *version;                // of the program
};

// Writes the script and its data. One damping ratio: each record, of several the mean and the band
// from 16 to 84 %, and the target. Several ratios: the record, or the mean of all. Errors:
// STATUS_INPUT (the picture has another ending). Write errors are the caller's.
int response_write(const struct response_sheet *sheet, const struct figure_files *to,
                   struct error *e);

// Units of axes in which values need few digits.
struct scale {
    double size;
    const char *unit;  // NULL behind the last of a list
};
extern const struct scale pictures_forces[], pictures_lengths[], pictures_energies[];

// The unit of the list for values up to `largest`, and an axis in it.
struct scale pictures_scale(const struct scale *known, double largest);
struct axis pictures_scaled_axis(const char *name, const struct scale *s, struct span span);

// What the pictures of laws share: a panel of curves $curve0, $curve1 ... with what was measured,
// $measured, and the legend, which a single curve does not need.

void pictures_law_panel(struct canvas *c, const struct panel *p, int n_curve, int x, int y,
                        double sample);  // size of a sample in the panel; 0: none are drawn
void pictures_law_legend(struct canvas *c, const char *const *name, int n_curve, size_t n_sample);

// The picture of isolated impacts: force against time, and against penetration.

enum { IMPACT_FIGURE_CURVES = 7 };

struct impact_curve {
    const char *name;
    size_t n;
    const struct isolated_point *point;  // (n) in SI
    double start;                        // time of the first one
};

struct impact_figure {
    const char *title, *subtitle, *version;
    const struct isolated_impact *impact;  // its numbers stand above the panels; NULL: none do
    double nominal;                        // coefficient of restitution asked of it; NAN: none
    int n_curve;                           // at most IMPACT_FIGURE_CURVES
    const struct impact_curve *curve;
    size_t n_sample;             // of a measured force; 0: there is none
    const double *time, *force;  // (n_sample)
};

// Writes the script and its data. Errors: STATUS_INPUT (the picture has another ending),
// STATUS_SYSTEM (no memory). Write errors are the caller's.
int impact_figure_write(const struct impact_figure *f, const struct figure_files *to,
                        struct error *e);

// The picture of the peak forces of isolated impacts over a velocity, a restitution or a stiffness.

struct force_curve {
    const char *name;
    size_t n;
    const double *x, *force;  // (n) in SI
};

struct force_figure {
    const char *subtitle, *version;
    const char *name, *unit;  // of the axis across; "": a number
    bool logarithmic;
    int n_curve;  // at most IMPACT_FIGURE_CURVES
    const struct force_curve *curve;
};

// Writes the script and its data. Errors: STATUS_INPUT (the picture has another ending). Write
// errors are the caller's.
int impact_figure_write_forces(const struct force_figure *f, const struct figure_files *to,
                               struct error *e);

// The picture of storeys under a protocol: shear against drift, and energy, plastic deformation and
// tangent over the turns.

enum { LOOP_FIGURE_CURVES = 7 };

struct loop_curve {
    const char *name;
    const struct storey_point *point;  // (n) in SI
    double stiffness;                  // initial
};

struct loop_figure {
    const char *title, *subtitle, *version;
    int n_curve;  // at most LOOP_FIGURE_CURVES
    const struct loop_curve *curve;
    size_t n;                     // points of each curve
    int n_part;                   // points from one turn to the next
    const char *progress;         // what the turns are called,
    const char *drifts, *shears;  // and the deformations and forces
    bool turns;                   // these are rotations and moments
    size_t n_sample;              // of a measured loop; 0: there is none
    const double *drift, *shear;  // (n_sample)
};

// Writes the script and its data. Errors: STATUS_INPUT (the picture has another ending),
// STATUS_SYSTEM (no memory). Write errors are the caller's.
int loop_figure_write(const struct loop_figure *f, const struct figure_files *to, struct error *e);

// The picture of a pounding force spectrum: the largest contact force as a colour over the periods
// of the left and the right structure.

struct pounding_map {
    const char *title, *subtitle, *version;
    const struct unit_system *units;  // of the force
    int n;                            // periods of each structure, at least 3
    const double *period;             // (n) [s] > 0, ascending
    const double *force;              // (n, n) the left structure's period first
};

// Writes the script and its data. Errors: STATUS_INPUT (the picture has another ending). Write
// errors are the caller's.
int pounding_map_write(const struct pounding_map *map, const struct figure_files *to,
                       struct error *e);

// The picture of histories beside others: a panel for each of the pairs that differ most, or one
// for all runs and a measurement.

enum { COMPARISON_PANELS = 3, COMPARISON_RUNS = 6 };

struct comparison_figure {
    const char *title, *version;
    const char *quantity;  // the name of its axis
    struct dimension dimension;
    const struct unit_system *units;
    bool measured;  // all pairs have one reference
    int n;
    const struct comparison_pair *pair;  // (n)
};

// Writes the script and its data. Errors: STATUS_INPUT (the picture has another ending),
// STATUS_SYSTEM (no memory). Write errors are the caller's.
int comparison_figure_write(const struct comparison_figure *f, const struct figure_files *to,
                            struct error *e);

#endif
