// SPDX-License-Identifier: GPL-3.0-or-later
// Volume 1 in Caltech's layout, which several networks use (volume1.h).
#include "motion/volume1.h"

#include <math.h>

#include "motion/channels.h"
#include "motion/header.h"

enum { LINE_NAME = 7, LINE_POINTS = 11, LINE_UNITS = 12, HEADER_LINES = 27 };

static const double DURATION_ROUNDING = 0.001;  // [s]

// The line with this number in a channel, from 1; the last line of the file if the file ends
// before.
static struct lines line_of(struct lines title, int number) {
    for (int i = 1; i < number && lines_next(&title); i++) {
    }
    return title;
}

bool volume1_matches(const struct volume1 *v, const struct record_text *t) {
    struct lines l;
    lines_init(&l, t);
    return lines_next(&l) && lines_contain(l.line, v->title) &&
           lines_contain(line_of(l, LINE_UNITS).line, v->units);
}

bool volume1_next(const struct volume1 *v, struct lines *l, struct piece *name) {
    while (lines_next(l)) {
        if (lines_contain(l->line, v->title)) {
            *name = line_of(*l, LINE_NAME).line;
            return true;
        }
    }
    return false;
}

// Reads the number of values and the time step.
static int read_sizes(const struct volume1 *v, const struct record_text *t, const struct lines *l,
                      double *n, struct record_content *out, struct error *e) {
    const struct header h = {.text = t};
    struct header_entry points = {"NO. OF POINTS", {0}, l->number};
    struct header_entry length = {v->length, {0}, l->number};
    if (!lines_value(l->line, points.key, &points.value) ||
        !lines_value(l->line, length.key, &length.value)) {
        return lines_error(e, t->path, l->number, "no '%s =' and '%s ='", points.key, length.key);
    }
    double duration = 0;
    int status = header_read_count(&h, &points, n, e);
    if (status == STATUS_OK) {
        status = header_read_positive(&h, &length, length.value, &duration, e);
    }
    if (status != STATUS_OK) {
        return status;
    }
    if (*n > (double)t->size) {
        return lines_error(e, t->path, l->number, "%.0f values; the file ends before", *n);
    }
    const double rate = round(*n / duration);
    if (rate < 1 || fabs(*n / rate - duration) > DURATION_ROUNDING) {
        return lines_error(e, t->path, l->number,
                           "%.0f values in %g s are %g a second; that must be a whole number", *n,
                           duration, *n / duration);
    }
    out->dt = 1 / rate;
    out->dt_line = l->number;
    return STATUS_OK;
}

// Reads the unit, and the peak against which the values are checked. The peak has its own unit.
static int read_unit(const struct record_request *request, const struct record_text *t,
                     const struct lines *l, struct record_content *out, struct error *e) {
    const struct header h = {.text = t};
    const struct header_entry entry = {"MAX", {0}, l->number};
    struct record_content peak = {0};
    struct piece rest = lines_behind(l->line, "AND");
    struct piece unit, value;
    if (lines_field(&rest, ".", &unit)) {
        header_read_unit(request, &entry, unit, out);
    }
    if (!lines_value(l->line, "MAX", &value)) {
        return STATUS_OK;
    }
    rest = (struct piece){value.text + value.n,
                          (size_t)(l->line.text + l->line.n - value.text) - value.n};
    lines_field(&rest, ",", &unit);
    header_read_unit(request, &entry, unit, &peak);
    if (peak.unit == 0) {
        return lines_error(e, t->path, l->number, "unit '%s' of MAX is not a unit of acceleration",
                           peak.unit_text.text);
    }
    return header_read_peak_of_unit(&h, &entry, value, peak.unit, out, e);
}

// Goes over the line `/&`, unless the file ends.
static int check_end(const struct record_text *t, struct lines l, size_t n, struct error *e) {
    while (lines_next(&l)) {
        if (l.line.n > 0) {
            return l.line.n > 1 && l.line.text[0] == '/' && l.line.text[1] == '&'
                       ? STATUS_OK
                       : lines_error(e, t->path, l.number,
                                     "'%s' is where '/&' should end the channel of %zu values",
                                     lines_excerpt(l.line).text, n);
        }
    }
    return STATUS_OK;
}

int volume1_read(const struct volume1 *v, struct arena *a, const struct record_request *request,
                 const struct record_text *t, struct record_content *out, struct error *e) {
    struct lines l;
    struct piece name;
    double n = 0;
    int status = channels_seek(request, t, v->next, v->none, &l, out, e);
    if (status != STATUS_OK) {
        return status;
    }
    v->next(&l, &name);
    const struct lines points = line_of(l, LINE_POINTS);
    const struct lines units = line_of(l, LINE_UNITS);
    status = read_sizes(v, t, &points, &n, out, e);
    if (status == STATUS_OK) {
        status = read_unit(request, t, &units, out, e);
    }
    if (status == STATUS_OK) {
        struct fixed_format format = v->format;
        format.stated = points.number;
        l = line_of(l, HEADER_LINES);
        status = fixed_read(a, t, &l, &format, (size_t)n, out, e);
    }
    return status == STATUS_OK ? check_end(t, l, out->n, e) : status;
}
