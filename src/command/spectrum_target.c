// SPDX-License-Identifier: GPL-3.0-or-later
// jostle spectrum --target: records scaled to a target spectrum, and what came of it.
#include <math.h>
#include <string.h>

#include "command/spectrum.h"
#include "core/arena.h"
#include "core/safe.h"
#include "core/text.h"

enum { DEFAULT_MATCH = 301 };
static const double DEFAULT_FIRST = 0.05;  // [s] for the spectra of codes, which begin at 0

// What building codes ask of the mean of the scaled spectra.
static const double CODE_SHARE = 0.9;

int spectrum_check_deck(const struct spectrum_request *q) {
    for (int r = 0; r < q->n_record; r++) {
        if (text_not_plain(q->path[r]) || strpbrk(q->path[r], "\"$")) {
            struct text_short t;
            return command_usage(
                &command_spectrum,
                "'%s' cannot stand in a deck: it contains a quote, a $ or bytes that are not text",
                text_short(&t, q->path[r]));
        }
    }
    return EXIT_DONE;
}

// The target's values at the periods of the request.
static int sample(const struct spectrum_request *q, struct arena *a, struct spectrum_set *set) {
    const struct target *t = &set->target;
    double *goal = arena_alloc(a, (size_t)q->match.n, sizeof *goal);
    if (!goal) {
        return command_no_memory();
    }
    for (int p = 0; p < q->match.n; p++) {
        goal[p] = target_at(t, q->match.value[p]);
        if (isnan(goal[p])) {
            return command_usage(&command_spectrum,
                                 "%s goes from %g to %g s, without %g s of --match", q->target,
                                 t->first, t->last, q->match.value[p]);
        }
    }
    set->goal = goal;
    return GO_ON;
}

int spectrum_read_target(struct spectrum_request *q, struct arena *a, struct spectrum_set *set) {
    struct error e;
    const struct target *t = &set->target;
    if (target_open(a, q->target, q->damping[0], &set->target, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    size_t n;
    const char *stem = text_stem(q->target, &n);
    set->target_name = t->code ? t->code->name : arena_text(a, stem, n);
    if (!set->target_name) {
        return command_no_memory();
    }
    int status = EXIT_DONE;
    if (!q->match.value) {
        const double first = t->code ? DEFAULT_FIRST : t->first == 0.0 ? t->period[1] : t->first;
        status = periods_range(&command_spectrum, first, t->last, DEFAULT_MATCH, a, &q->match);
    }
    return status == EXIT_DONE ? sample(q, a, set) : status;
}

// Leaves the records that were chosen, with their factors.
static void keep_chosen(struct spectrum_request *q, struct spectrum_set *set) {
    struct match *m = &set->match;
    for (int i = 0; i < m->n_chosen; i++) {
        const int r = m->chosen[i];
        q->path[i] = q->path[r];
        set->name[i] = set->name[r];
        set->ground[i] = set->ground[r];
        set->scale[i] = m->factor[i] = m->factor[r];
        m->misfit[i] = m->misfit[r];
    }
    set->n_read = q->n_record;
    q->n_record = m->n_chosen;
}

int spectrum_match(struct spectrum_request *q, struct arena *a, struct spectrum_set *set,
                   struct error *e) {
    struct spectra s = {.n_record = q->n_record,
                        .n_damping = 1,
                        .n_period = q->match.n,
                        .damping = q->damping,
                        .period = q->match.value};
    const struct match_request request = {.spectra = &s,
                                          .goal = set->goal,
                                          .n_component = q->n_component,
                                          .n_select = q->n_select,
                                          .low = q->least,
                                          .high = q->most,
                                          .exchange = q->improve};
    int status = spectrum_compute(&s, set->ground, a, e);
    if (status == STATUS_OK) {
        status = target_match(&set->match, &request, a, e);
    }
    if (status == STATUS_OK) {
        keep_chosen(q, set);
    }
    for (int r = 0; status == STATUS_OK && r < q->n_record; r++) {
        struct signal *g = &set->ground[r];
        status = signal_init_samples(g, a, g->value, g->n, g->dt, set->scale[r], 0.0, e);
    }
    return status;
}

// What was chosen, and what the exchanges came to.
static void print_choice(const struct spectrum_request *q, const struct spectrum_set *set) {
    const struct match *m = &set->match;
    const char *noun = q->n_component > 1 ? "pair" : "record";
    const int n = q->n_record / q->n_component, n_read = set->n_read / q->n_component;
    printf("%d of %d %ss chosen", n, n_read, noun);
    if (m->n_outside > 0) {
        printf("; %d %s%s a factor outside %g to %g", m->n_outside, noun,
               m->n_outside > 1 ? "s have" : " has", q->least, q->most);
    }
    printf("\nmisfit of the mean of the scaled spectra: %.4f", m->of_mean);
    if (q->improve) {
        printf("; %.4f before %d exchange%s", m->of_best, m->n_exchange,
               m->n_exchange == 1 ? "" : "s");
    }
    printf("\n");
}

// EN 1998-1:2004, 3.2.3.1.2 (4) b, limits this ratio.
static void print_peaks(const struct spectrum_request *q, const struct spectrum_set *set) {
    const double goal = target_at(&set->target, 0.0);
    double sum = 0.0;
    for (int r = 0; r < q->n_record; r++) {
        sum += set->intensity[r].pga;
    }
    if (!isnan(goal)) {
        printf("%s over the target at 0 s: %.4g\n", q->n_record > 1 ? "mean PGA" : "PGA",
               sum / q->n_record / goal);
    }
}

int spectrum_print_match(const struct spectrum_request *q, const struct spectrum_set *set) {
    static const struct printer_column columns[] = {
        COLUMN_G("factor", 9, 4), COLUMN_G("misfit", 9, 4), COLUMN_TEXT("record", 0)};
    const struct match *m = &set->match;
    struct printer t = {.to = stdout};
    PRINTER_ADD(&t, columns);
    printf("\n");
    printer_head(&t);
    for (int r = 0; r < q->n_record; r++) {
        printer_number(&t, m->factor[r]);
        printer_number(&t, m->misfit[r]);
        printer_text(&t, set->name[r]);
        printer_line(&t);
    }
    printf("\ntarget ");
    safe_put(stdout, SAFE_TERMINAL, q->target);
    printf(", compared at %d periods from %.4g to %.4g s\n", q->match.n, q->match.value[0],
           q->match.value[q->match.n - 1]);
    if (q->n_select > 0) {
        print_choice(q, set);
    }
    printf("%s over the target: from %.4g at %.4g s to %.4g at %.4g s\n",
           q->n_record > 1 ? "mean of the scaled spectra" : "scaled spectrum", m->least.value,
           m->least.period, m->largest.value, m->largest.period);
    printf("nowhere below %g %% with all factors times %.4f\n", 100.0 * CODE_SHARE,
           ceil(1e4 * CODE_SHARE / m->least.value) / 1e4);
    print_peaks(q, set);
    return printer_close(&t);
}

void spectrum_print_deck(const struct spectrum_request *q, const struct spectrum_set *set) {
    printf("sweep record values");
    for (int r = 0; r < q->n_record; r++) {
        printf(" \\\n    \"%s\"", q->path[r]);
    }
    printf(" -as motion\nsweep factor values");
    for (int r = 0; r < q->n_record; r++) {
        printf(" %.6g", set->match.factor[r]);
    }
    printf(" -as motion\n");
}

void spectrum_print_codes(void) {
    enum { WIDTH = 95 };
    for (int i = 0; i < n_target_code; i++) {
        const struct target_code *c = target_codes[i];
        printf("\n%s, as in --target %s:\n", c->title, c->example);
        for (int k = 0; k < c->n; k++) {
            const struct row *r = &c->row[k].row;
            char text[256], fallback[32] = "";
            if (r->kind == ROW_CHOICE && !isnan(r->fallback)) {
                snprintf(fallback, sizeof fallback, "; default: %s",
                         r->range->word[(int)r->fallback]);
            } else if (!isnan(r->fallback)) {
                snprintf(fallback, sizeof fallback, "; default: %g", r->fallback);
            }
            snprintf(text, sizeof text, "%s%s%s%s", r->doc, r->kind == ROW_CHOICE ? ", " : "",
                     r->kind == ROW_CHOICE ? r->range->text : "", fallback);
            option_wrap(text, printf("  %-8s", r->key), WIDTH);
        }
    }
}
