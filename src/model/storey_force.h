// SPDX-License-Identifier: GPL-3.0-or-later
// The restoring force of one storey: that of its law, and of P-delta, which takes P/h times the
// drift off it. Its energy is recoverable, and negative.
#ifndef JOSTLE_STOREY_FORCE_H
#define JOSTLE_STOREY_FORCE_H

#include "jostle/model.h"

// As in struct storey_law; `history` and `after` are the storey histories of states.
static inline struct storey_response storey_respond(const struct storey *s, const double *history,
                                                    double drift, double *after) {
    struct storey_response r = s->law->respond(s->constant, history + s->history, drift,
                                               after ? after + s->history : NULL);
    r.shear -= s->pdelta * drift;
    r.tangent -= s->pdelta;
    return r;
}

// The force of the law alone, at a drift rate.
static inline struct storey_rate_response storey_respond_at_rate(const struct storey *s,
                                                                 const double *history,
                                                                 double drift, double rate,
                                                                 double *after) {
    double *own = after ? after + s->history : NULL;
    history += s->history;
    if (s->law->respond_at_rate) {
        return s->law->respond_at_rate(s->constant, history, drift, rate, own);
    }
    const struct storey_response r = s->law->respond(s->constant, history, drift, own);
    return (struct storey_rate_response){.shear = r.shear, .tangent = r.tangent};
}

static inline double storey_stored(const struct storey *s, const double *history, double drift) {
    return s->law->stored(s->constant, history + s->history, drift) -
           s->pdelta * drift * drift / 2.0;
}

#endif
