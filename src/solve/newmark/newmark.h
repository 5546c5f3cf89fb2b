// SPDX-License-Identifier: GPL-3.0-or-later
// One step of Newmark's method, and many in free flight.
#ifndef JOSTLE_NEWMARK_H
#define JOSTLE_NEWMARK_H

#include "solve/account/account.h"
#include "solve/work.h"

// Takes the committed state `now` over a step of size h to `next`, whose time is `end`. `now` is
// not touched. Internal forces of linear models are left to floors_account. STATUS_RETRY: not
// solved, `next` is meaningless. STATUS_FAILED: the state is not finite. The accounts of `w`
// (floors_account_to) must be set.
int newmark_step(struct work *w, const struct state *now, struct state *next, double end, double h,
                 struct error *e);

// Free flight: steps of the model's size in which no contact is closed, no storey changes its
// branch, and the links that act are linear. They need no iteration and no search, and most steps
// are such, so they have a way of their own through the solver. Without links it gives the same
// bits as newmark_step and floors_account.

struct flight {
    const struct model *model;  // borrowed, as are the next two
    struct work *work;
    const struct floors_account *account;  // where works and peaks go,
    struct impact_log *impacts;            // and those of links; borrowed
    bool possible;                         // with this model
    bool on_lines;                         // some storey yields, or some building is full
    bool uniform;                          // one ground moves all, and there are no loads

    double *back, *spring, *rest, *limit;  // (n_dof) the storeys' branches: struct storey_branch

    int *run_end;  // by block of floors: after it, runs of gaps.h below this can be checked

    int n_link;        // bilateral links, all linear
    double *transfer;  // (n_link, n_link) (I + D S)^-1, by columns
    long factors;      // of struct work, for which it is; 0: there is none
    size_t *order;     // (n_link) scratch, as is the next
    double *force;     // [F] (n_link)
};

// Room for the flights of a run with this scratch, whose accounts (floors_account_to) must be set;
// false: no memory.
bool flight_alloc(struct flight *f, struct work *w, struct impact_log *impacts, struct arena *a);

// Steps from step `n` of the model, whose state is `*now`, as far as step `end`, but stops before a
// step in which a contact would close or a storey change its branch. Returns the step that it has
// reached; `*now` is its state, and `*next` is of no meaning.
long flight_take(struct flight *f, struct state **now, struct state **next, long n, long end);

// Finds the lines that the storeys of state `s`, to which a step led from `before`, are on. False:
// they have left their lines in that step, or buildings are not factorised for these.
bool flight_is_on_lines(struct flight *f, const struct state *before, const struct state *s);

// Finds the forces of the links at the end of the step from `now` to `next`, whose trial is in
// struct work, from the corrections without them in work.correction; and adds to those what the
// forces do.
void flight_join(const struct flight *f, const struct state *now, struct state *next);

// Takes the step from `now` to `next` into the works and peaks of the links.
void flight_account_links(const struct flight *f, const struct state *now, struct state *next);

#endif
