// SPDX-License-Identifier: GPL-3.0-or-later
#include <math.h>
#include <string.h>

#include "command/report_summary.h"
#include "core/safe.h"
#include "core/text.h"

static bool contact_row(struct printer *t, const struct report *r, int i) {
    const struct report_link *c = &r->contact[i];
    const struct link_peak *p = &c->peak;
    const double none = NAN;
    const bool hit = p->impacts > 0;
    const double value[] = {c->gap,
                            (double)p->impacts,
                            hit ? p->force : none,
                            hit ? p->force_time : none,
                            hit ? p->penetration : none,
                            p->impulse,
                            p->dissipated};
    printer_text(t, c->name);
    printer_text(t, c->law);
    printer_numbers(t, value, 7);
    return false;
}

// Those that were hit hardest come first. Laws have a column where they differ.
void report_links_contacts(struct report_summary *s) {
    const struct report *r = s->r;
    struct printer_column contacts[] = {{0},
                                        READ("gap", 9, length),
                                        COUNT("impacts", 7),
                                        READ("force", 9, force),
                                        READ("time", 7, time),
                                        READ("penetr.", 9, length),
                                        READ("impulse", 9, impulse),
                                        READ("dissip.", 9, energy)};
    struct report_shown shown = {.width = NAME_WIDTH_MIN};
    int n_hit = 0, law = 3, room = LINK_WIDTH_MAX;
    bool differ = false;
    for (int i = 0; i < r->n_contact; i++) {
        const bool hit = r->contact[i].peak.impacts > 0;
        const double rank = hit ? r->contact[i].peak.force : -HUGE_VAL;
        n_hit += hit;
        differ = differ || strcmp(r->contact[i].law, r->contact[0].law) != 0;
        shown.n = choice_add(shown.choice, shown.n, SHOWN_MAX, (struct choice){rank, i});
    }
    for (int i = 0; i < shown.n && differ; i++) {
        law = report_summary_widest(law, r->contact[shown.choice[i].index].law, LAW_WIDTH_MAX);
        contacts[0] = (struct printer_column)COLUMN_NAME("law", law);
        room = LINK_WIDTH_MAX - law - 2;
    }
    for (int i = 0; i < shown.n; i++) {
        shown.width =
            report_summary_widest(shown.width, r->contact[shown.choice[i].index].name, room);
    }
    fprintf(s->to, "\n%d %s, %d hit, %ld %s", r->n_contact,
            r->n_contact == 1 ? "contact" : "contacts", n_hit, r->n_impact,
            r->n_impact == 1 ? "impact" : "impacts");
    if (r->totals.coarse > 0) {
        fprintf(s->to, " (%ld of fewer than %d steps)", r->totals.coarse, IMPACT_STEPS_MIN);
    }
    if (shown.n > 0 && !differ) {
        fputs(", law ", s->to);
        safe_put(s->to, SAFE_TERMINAL, r->contact[0].law);
    }
    if (shown.n > 0) {
        PRINT_TABLE(s, &shown, "contact", contacts, contact_row);
        report_summary_rest(s, r->n_contact - shown.n, "contacts", "force");
    } else {
        fputc('\n', s->to);
    }
}

static const struct printer_column links[] = {
    READ("force", 10, force),    READ("time", 8, time),    READ("deformation", 12, length),
    READ("time", 8, time),       READ("work", 10, energy), READ("dissip.", 10, energy),
    READ("residual", 10, length)};
static bool link_row(struct printer *t, const struct report *r, int i) {
    const struct link_peak *p = &r->link[i].peak;
    const double value[] = {p->force,      p->force_time, p->penetration, p->penetration_time,
                            p->dissipated, p->lost,       p->residual};
    printer_text(t, r->link[i].name);
    printer_numbers(t, value, 7);
    return false;
}

// Shows the first of n links, or columns, in the order of their numbers.
static struct report_shown first_of(const struct report_link *link, int n) {
    struct report_shown shown = {.width = NAME_WIDTH_MIN};
    for (int i = 0; i < n && i < SHOWN_MAX; i++) {
        shown.choice[shown.n++] = (struct choice){.index = i};
        shown.width = report_summary_widest(shown.width, link[i].name, LINK_WIDTH_MAX);
    }
    return shown;
}

void report_links_links(struct report_summary *s) {
    struct report_shown shown = first_of(s->r->link, s->r->n_link);
    if (shown.n > 0) {
        PRINT_TABLE(s, &shown, "link", links, link_row);
        report_summary_rest(s, s->r->n_link - shown.n, "links", "number");
    }
}

static const struct printer_column columns[] = {
    READ("force", 10, force),
    READ("shear", 10, force),
    READ("moment", 10, energy),
    {.head = "demand", .width = 8, .digits = 4, .look = LOOK_READ}};
static bool column_row(struct printer *t, const struct report *r, int i) {
    const struct report_link *c = &r->column[i];
    const double value[] = {c->peak.force, c->shear, c->moment, c->demand};
    printer_text(t, c->name);
    printer_numbers(t, value, 4);
    return false;
}

void report_links_columns(struct report_summary *s) {
    struct report_shown shown = first_of(s->r->column, s->r->n_column);
    bool fails = false;
    if (shown.n > 0) {
        PRINT_TABLE(s, &shown, "column", columns, column_row);
        report_summary_rest(s, s->r->n_column - shown.n, "columns", "number");
    }
    for (int i = 0; i < s->r->n_column; i++) {
        fails |= s->r->column[i].demand > 1.0;
    }
    fputs(fails ? "a column with a demand above 1 would fail; without a law it stays elastic\n"
                : "",
          s->to);
}
