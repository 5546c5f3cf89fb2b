// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the statements of a file with those of the user, and with the properties of ground
// motions.
//
// Time step: a step that the user gives must be that of the file. A step from the file alone must
// be plausible for an accelerogram, from DT_MIN to DT_MAX. -dt confirms another step. A -dt above
// DT_MAX that the file does not confirm gives a warning.
//
// Unit: the unit of the user replaces that of the file, with a warning.
//
// Size: the largest recorded accelerations are 2 to 4 g. Above WARN_G the unit is probably wrong.
// This gives a warning, because a factor of 981 (cm/s^2 read as g) or 9807 is easy to recognise.
// Wrong units cannot explain more than REFUSE_G, nor a single value SPIKE times larger than all
// others. Such values are damaged numbers, an error.
//
// Peak: if the file states a peak, the peak of the values must agree to its last digit. Otherwise
// there is a warning.
//
// Offset: the final velocity is the mean times the duration. It is at most 0.25 m/s in about 120
// records of PEER and others, as released. Uncorrected records have offsets larger than their
// peaks. -demean subtracts them.
#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "motion/header.h"
#include "motion/values.h"

static const double G = 9.80665;
static const double DT_MIN = 1e-5;
static const double DT_MAX = 1.0;
static const double WARN_G = 10;
static const double SPIKE_G = 100;
static const double REFUSE_G = 1e5;
static const double SPIKE = 10;
static const double END_VELOCITY = 0.5;  // [m/s]
static const double TIME_ERROR = 0.01;   // in steps; a larger error gives a warning

// Share of a step. The step of 256 samples a second with three printed decimals is 2.4 % off.
static const double NOTED_STEP_ERROR = 0.03;

// What is checked, and the place for warnings.
struct check {
    const struct record_reader *reader;
    const struct record_request *request;
    const struct record_content *content;
    struct record *out;
};

__attribute__((format(printf, 3, 4))) static void warn(const struct check *c, int line,
                                                       const char *format, ...) {
    if (c->out->n_warning == RECORD_WARNINGS_MAX) {
        return;
    }
    char *to = c->out->warning[c->out->n_warning++];
    size_t size = sizeof c->out->warning[0];
    size_t used = (size_t)snprintf(to, size, "%s: ", lines_place(c->reader->text->path, line).text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(to + used, size - used, format, arguments);
    va_end(arguments);
}

static bool check_dt(const struct check *c) {
    const struct record_reader *r = c->reader;
    double given = c->request->dt;
    double read = c->content->dt;
    int line = c->content->dt_line;
    if (given == 0 && read == 0) {
        return record_fail(r, line, "the file gives no time step; give -dt DT");
    }
    if (given == 0) {
        c->out->dt = read;
        return c->request->plain || (read >= DT_MIN && read <= DT_MAX) ||
               record_fail(r, line,
                           "a time step of %g s is not believable for an accelerogram (%g to %g "
                           "s); confirm it with -dt %g",
                           read, DT_MIN, DT_MAX, read);
    }
    c->out->wrong = RECORD_DT;
    if (!(given > 0 && isfinite(given))) {
        return record_fail(r, 0, "-dt is %g s; it must be > 0", given);
    }
    if (read > 0 && !(fabs(given - read) <= fmax(1e-6 * read, c->content->dt_tolerance))) {
        return record_fail(r, line, "-dt %.9g contradicts the time step of %.9g s in the file",
                           given, read);
    }
    if (read == 0 && !c->request->plain && given > DT_MAX) {
        warn(c, 0, "-dt is %g s; accelerograms have %g s at most", given, DT_MAX);
    }
    c->out->wrong = RECORD_PATH;
    c->out->dt = given;
    return true;
}

static bool check_given_unit(const struct check *c) {
    const struct record_content *content = c->content;
    const struct piece text = {c->request->unit, strlen(c->request->unit)};
    const double unit = header_unit(c->reader, text);
    if (unit == 0) {
        c->out->wrong = RECORD_UNIT;
        return record_fail(c->reader, 0,
                           "-unit '%s' is not a unit of acceleration (g, m/s2, cm/s2, gal, ...)",
                           lines_excerpt(text).text);
    }
    if (content->unit_line > 0 && fabs(unit - content->unit) > 1e-9 * unit) {
        warn(c, content->unit_line, "-unit %s overrides the '%s' of the file", c->request->unit,
             content->unit_text.text);
    }
    c->out->unit = unit;
    return true;
}

static bool check_unit(const struct check *c) {
    const struct record_content *content = c->content;
    c->out->unit = 1;
    if (c->request->plain) {
        return true;
    }
    if (c->request->unit) {
        return check_given_unit(c);
    }
    if (content->unit_line == 0) {
        return record_fail(c->reader, 0,
                           "the file gives no unit; give -unit U (g, m/s2, cm/s2, gal, ...)");
    }
    c->out->unit = content->unit;
    return content->unit != 0 ||
           record_fail(c->reader, content->unit_line,
                       "'%s' is not a unit of acceleration; give -unit U (g, m/s2, cm/s2, gal, "
                       "...)",
                       content->unit_text.text);
}

// True if the peak is much larger than any other value.
static bool is_spike(const struct record_content *content) {
    double second = 0;
    for (size_t i = 0; i < content->n; i++) {
        second = i == content->peak ? second : fmax(second, fabs(content->value[i]));
    }
    return fabs(content->value[content->peak]) > SPIKE * second;
}

static bool check_peak(const struct check *c) {
    const struct record_content *content = c->content;
    double value = content->value[content->peak];
    double peak = fabs(value) * c->out->unit / G;
    if (peak > REFUSE_G || (peak > SPIKE_G && is_spike(content))) {
        return record_fail(c->reader, content->peak_line,
                           "value %zu is %g, that is %.3g g; no ground acceleration is so large",
                           content->peak + 1, value, peak);
    }
    c->out->large = peak > WARN_G;
    if (c->out->large) {
        warn(c, content->peak_line,
             "the largest acceleration is %.3g g; if the values are in "
             "another unit, say so with -unit (cm/s2, m/s2, ...)",
             peak);
    }
    return true;
}

// The stated peak may be that of another version of the record. So a different peak is only a
// warning.
static void check_stated_peak(const struct check *c) {
    const struct record_content *content = c->content;
    if (content->stated_line == 0) {
        return;
    }
    double middle = content->stated_about_mean ? values_mean(content->value, content->n) : 0;
    double peak = 0;
    for (size_t i = 0; i < content->n; i++) {
        peak = fmax(peak, fabs(content->value[i] - middle));
    }
    if (fabs(peak - content->stated_peak) > (1 + 1e-6) * content->stated_rounding) {
        warn(c, content->stated_line,
             "the header states a largest acceleration of %.7g %s; that of the values%s is %.7g",
             content->stated_peak, content->unit_text.text,
             content->stated_about_mean ? ", less their mean," : "", peak);
    }
}

// Warns about statements of the file that differ from its values.
static void check_statements(const struct check *c) {
    const struct record_content *content = c->content;
    const double dt = c->out->dt;
    if (content->n_filling > 0) {
        warn(c, content->count_line,
             "the header says %zu rows; the file holds %zu more, which repeat the last of them and "
             "are read too",
             content->n - content->n_filling, content->n_filling);
    }
    if (content->other_line > 0) {
        warn(c, content->other_line,
             "NPTS is given twice, as %.9g here and as %.9g in line %d; the file holds %zu values",
             content->other_npts, content->npts, content->count_line, content->n);
    }
    if (content->noted_line > 0 && fabs(content->noted_dt - dt) > NOTED_STEP_ERROR * dt) {
        warn(c, content->noted_line,
             "the comment gives a time step of %.6g s; that of the %s is %.6g s and is used",
             content->noted_dt, content->dt > 0 ? "times" : "option -dt", dt);
    }
}

static void check_offset(const struct check *c) {
    const struct record_content *content = c->content;
    double mean = values_mean(content->value, content->n) * c->out->unit;
    double velocity = mean * c->out->dt * (double)(content->n - 1);
    if (!c->out->large && fabs(velocity) > END_VELOCITY) {
        warn(c, 0,
             "the mean is %.3g g, so that the ground is left with a velocity of %.3g m/s; "
             "-demean subtracts the mean, or correct the baseline of the record",
             mean / G, velocity);
    }
}

// Subtracts the mean from the values. The checks before this use the values as printed.
static void demean(const struct record_content *content, struct record *out) {
    out->mean = values_mean(content->value, content->n);
    out->peak = 0;
    for (size_t i = 0; i < content->n; i++) {
        content->value[i] -= out->mean;
        out->peak = fmax(out->peak, fabs(content->value[i]));
    }
}

static void check_times(const struct check *c) {
    const struct record_content *content = c->content;
    if (fabs(content->time_offset) > TIME_ERROR * c->out->dt) {
        warn(c, content->dt_line, "the first time is %g s; it is taken as the start of the record",
             content->time_offset);
    }
    if (content->time_error > TIME_ERROR) {
        warn(c, content->dt_line,
             "times are up to %.2g steps off an even grid of %g s; taken as "
             "rounded",
             content->time_error, c->out->dt);
    }
}

bool record_check(const struct record_reader *r, struct record *out) {
    struct record_content *content = r->out;
    const struct check c = {r, r->request, content, out};
    if (content->n < 2) {
        return record_fail(r, 0, "the file holds %zu values; at least 2 are needed", content->n);
    }
    out->n = content->n;
    out->value = content->value;
    out->peak = fabs(content->value[content->peak]);
    if (!check_dt(&c) || !check_unit(&c) || (!r->request->plain && !check_peak(&c))) {
        return false;
    }
    check_statements(&c);
    check_stated_peak(&c);
    if (r->request->demean) {
        demean(content, out);
    } else if (!r->request->plain) {
        check_offset(&c);
    }
    check_times(&c);
    return true;
}
