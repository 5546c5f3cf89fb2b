// SPDX-License-Identifier: GPL-3.0-or-later
// The gap beyond which a limit is met: a scan over gaps, then bisection at its last change.
#ifndef JOSTLE_GAP_SEARCH_H
#define JOSTLE_GAP_SEARCH_H

#include "study/edp.h"
#include "study/gap_runs.h"

enum { GAP_POINTS_MAX = 10000 };

struct gap_search_request {
    const struct plan *plan;  // made by plan_init
    const char *parameter;    // of the deck that is the gap; NULL: the gaps of all contacts
    struct edp edp;           // of the values of the plan
    double limit;             // in its units
    double percentile;        // of the runs that must keep it, 0 ... 100; 100: all
    double from, to;          // [L] gaps scanned
    int n;                    // of them, >= 2
    double tolerance;         // [L] of the gap found
};

enum gap_stage { GAP_SCAN, GAP_BISECTION, GAP_OPEN };

struct gap_point {
    enum gap_stage stage;
    double gap;    // [L]; infinite: the contacts never close
    double value;  // the percentile of the runs; NAN if one of them failed; infinite: collapse
    bool kept;     // value <= limit; a run that fails keeps nothing
    long n_failed, n_collapsed;
    long run;                         // of the largest value, or the first that failed
    char message[STUDY_MESSAGE_MAX];  // of that
};

struct gap_search {
    long n_run;  // of each gap; a sweep of the parameter makes fewer than the deck has
    int n_point;
    struct gap_point *point;  // (n_point) the scan first, by gap
    bool opened;              // the demand is not one of the contacts: `open` has a value
    struct gap_point open;    // runs without any contact, to which no gap makes a difference
    bool found;
    double gap;    // [L] kept from here on as far as was scanned
    double below;  // [L] not kept here; NAN: kept from request.from on
};

// `how` says how runs are made; what they read is set here. *out must be given to
// gap_search_close, whatever happens. Errors: those of gap_runs_run, STATUS_INPUT (the deck has no
// such parameter, or another shape for its values; runs without a value of the EDP).
int gap_search_run(const struct gap_search_request *q, const struct gap_runs *how,
                   struct gap_search *out, struct error *e);
void gap_search_close(struct gap_search *s);

#endif
