// SPDX-License-Identifier: GPL-3.0-or-later
// The command line of `jostle spectrum`. Options of records may also be written as in a deck, with
// one dash, as messages about records name them so.
#include <limits.h>
#include <math.h>

#include "command/deck_command.h"
#include "command/spectrum.h"
#include "core/arena.h"
#include "core/quantity.h"
#include "core/text.h"

enum { DAMPING_MAX = 7 };

// Default periods: ten a decade in a table to be read, a hundred where a curve is wanted.
static const double DEFAULT_FROM = 0.01, DEFAULT_TO = 10.0;
enum { DEFAULT_TABLE = 31, DEFAULT_CURVE = 301 };

// Of a pounding force spectrum, for each structure.
static const double POUNDING_FROM = 0.1, POUNDING_TO = 2.0;
enum { POUNDING_DEFAULT = 20, POUNDING_MAX = 1000 };

static const struct command *const self = &command_spectrum;

static const double default_damping[] = {0.05};

static const char introduction[] =
    "For each RECORD: peak ground acceleration, velocity and displacement, Arias intensity, "
    "cumulative\nabsolute velocity, significant duration. Then the elastic response spectrum, or "
    "the mean and\npercentiles of several records: pseudo-acceleration PSA, pseudo-velocity PSV "
    "and displacement SD. In\nTSV also the largest relative velocity SV and total acceleration "
    "SA.\n\n";
static const char explanation[] =
    "\nThe ground acceleration is linear between samples and zero before and after them. Its "
    "integrals\nstart from rest, without baseline correction. g is 9.80665 m/s2. The mean is "
    "arithmetic; percentiles\nare interpolated between the sorted values. With -o or --script "
    "there is no table of the spectrum.\n";

static int read_damping(void *request, struct arena *a, const char *text) {
    struct spectrum_request *q = request;
    double *value = arena_alloc(a, DAMPING_MAX, sizeof *value);
    if (!value) {
        return command_no_memory();
    }
    if (quantity_count(text) > DAMPING_MAX) {
        return command_usage(self, "--damping has %d ratios; at most %d are taken",
                             quantity_count(text), DAMPING_MAX);
    }
    q->n_damping = quantity_list(text, &dimension_none, DAMPING_MAX, value);
    if (q->n_damping == 0) {
        return command_usage(self, "--damping takes ratios such as 0.05 or 2%%,5%%, not '%s'",
                             text);
    }
    for (int i = 0; i < q->n_damping; i++) {
        if (!(value[i] >= 0.0 && value[i] < 1.0)) {
            return command_usage(
                self, "a damping ratio is %g; it must be >= 0 and < 1 (5%% is 0.05)", value[i]);
        }
    }
    q->damping = value;
    return EXIT_DONE;
}

static int read_periods(void *request, struct arena *a, const char *text) {
    return periods_parse(self, "--periods", text, a,
                         &((struct spectrum_request *)request)->periods);
}

static int read_match(void *request, struct arena *a, const char *text) {
    return periods_parse(self, "--match", text, a, &((struct spectrum_request *)request)->match);
}

static int read_scale(void *request, struct arena *a, const char *text) {
    (void)a;
    double *scale = &((struct spectrum_request *)request)->scale;
    return quantity_whole(text, &dimension_none, BARE_ALLOWED, scale) && *scale != 0.0
               ? EXIT_DONE
               : command_usage(self, "--scale takes a factor other than 0, not '%s'", text);
}

static int read_pga(void *request, struct arena *a, const char *text) {
    (void)a;
    double *pga = &((struct spectrum_request *)request)->pga;
    return quantity_whole(text, &dimension_acceleration, BARE_REFUSED, pga) && *pga > 0.0
               ? EXIT_DONE
               : command_usage(
                     self, "--pga takes an acceleration > 0 with its unit, such as 0.35g, not '%s'",
                     text);
}

static int read_factors(void *request, struct arena *a, const char *text) {
    (void)a;
    struct spectrum_request *q = request;
    const char *end;
    return text_number(text, &end, &q->least) == TEXT_NUMBER_OK && *end == ':' &&
                   text_number(end + 1, &end, &q->most) == TEXT_NUMBER_OK && *end == '\0' &&
                   q->least > 0.0 && q->least < q->most
               ? EXIT_DONE
               : command_usage(self, "--factors takes two factors > 0 such as 0.5:2, not '%s'",
                               text);
}

static int read_dt(void *request, struct arena *a, const char *text) {
    (void)a;
    double *dt = &((struct spectrum_request *)request)->record.dt;
    return quantity_whole(text, &dimension_time, BARE_ALLOWED, dt) && *dt > 0.0
               ? EXIT_DONE
               : command_usage(self, "--dt takes a time > 0 in s, not '%s'", text);
}

static int check_target(const struct spectrum_request *q) {
    if (!q->target && (q->match.value || q->form == SPECTRUM_DECK)) {
        return command_usage(self, "%s needs --target", q->match.value ? "--match" : "--deck");
    }
    if (q->target && q->n_damping > 1) {
        return command_usage(self, "--target takes one damping ratio, that of the target");
    }
    if (!q->target && (q->n_select > 0 || q->n_component > 1)) {
        return command_usage(self, "%s needs --target", q->n_select > 0 ? "--select" : "--pairs");
    }
    if (q->n_select == 0 && (q->improve || q->least > 0.0)) {
        return command_usage(self, "%s needs --select", q->improve ? "--improve" : "--factors");
    }
    if (q->n_component > 1 && q->n_record % 2 == 1) {
        return command_usage(self, "--pairs takes an even number of records, not %d", q->n_record);
    }
    return q->form == SPECTRUM_DECK ? spectrum_check_deck(q) : EXIT_DONE;
}

static int check(const struct spectrum_request *q) {
    if (picture_check(self, &q->picture) != EXIT_DONE || check_target(q) != EXIT_DONE) {
        return EXIT_INPUT;
    }
    if (q->load.path) {
        const struct record_request *r = &q->record;
        if (q->n_record > 0 || r->format || r->unit || r->dt != 0.0 || r->demean || r->channel ||
            q->scale != 1.0 || q->pga != 0.0 || q->target || q->damping ||
            q->content == CONTENT_INTENSITIES) {
            return command_usage(self, "--pounding takes records and damping from the deck");
        }
        if (q->periods.value && q->periods.value[0] == 0.0) {
            return command_usage(self, "a structure of period 0 does not pound");
        }
        if (q->periods.value && q->periods.n > POUNDING_MAX) {
            return command_usage(self, "%d periods; --pounding takes up to %d", q->periods.n,
                                 POUNDING_MAX);
        }
        if (picture_is_wanted(&q->picture) && q->periods.value && q->periods.n < 3) {
            return command_usage(self, "a picture needs at least three periods > 0");
        }
        return EXIT_DONE;
    }
    if (q->load.define.n > 0 || q->n_thread > 0) {
        return command_usage(self, "%s is for the deck of --pounding",
                             q->load.define.n > 0 ? "-D" : "-j");
    }
    if (q->n_record < 1) {
        return command_usage(self, "a record is expected");
    }
    if ((q->scale != 1.0) + (q->pga > 0.0) + (q->target != NULL) > 1) {
        return command_usage(self, "give one of --scale, --pga and --target");
    }
    if (q->content == CONTENT_INTENSITIES &&
        (picture_is_wanted(&q->picture) || q->damping || q->periods.value)) {
        return command_usage(self, "--intensities leaves no spectrum to draw, damp or sample");
    }
    if (picture_is_wanted(&q->picture) && q->periods.value &&
        (q->periods.n < 3 || q->periods.value[q->periods.n - 3] == 0.0)) {
        return command_usage(self, "a picture needs at least three periods > 0");
    }
    return EXIT_DONE;
}

static int set_defaults(struct spectrum_request *q, struct arena *a) {
    if (q->load.path) {
        q->n_thread = q->n_thread > 0 ? q->n_thread : deck_command_threads();
        return q->periods.value ? EXIT_DONE
                                : periods_range(self, POUNDING_FROM, POUNDING_TO, POUNDING_DEFAULT,
                                                a, &q->periods);
    }
    if (!q->damping) {
        q->damping = default_damping;
        q->n_damping = 1;
    }
    const bool table = q->form == FORM_TEXT && !picture_is_wanted(&q->picture);
    return q->periods.value ? EXIT_DONE
                            : periods_range(self, DEFAULT_FROM, DEFAULT_TO,
                                            table ? DEFAULT_TABLE : DEFAULT_CURVE, a, &q->periods);
}

static int use(void *request, struct arena *a, const struct words *operand) {
    struct spectrum_request *q = request;
    q->path = operand->word;
    q->n_record = operand->n;
    int status = check(q);
    if (status == EXIT_DONE) {
        status = set_defaults(q, a);
    }
    return status == EXIT_DONE ? spectrum_run(q, a) : status;
}

#define AT(member) offsetof(struct spectrum_request, member)
static const struct option_row rows[] = {
    {"damping", 0, "LIST", OPTION_OWN, .own = read_damping,
     .doc = "damping ratios, 0.02,0.05 or 2%,5% (default: 5%)"},
    {"periods", 0, "P", OPTION_OWN, .own = read_periods,
     .doc = "periods in s: FROM:TO:N with equal ratios, or an ascending LIST; 0 or 0.001 to 1000 "
            "(default: 0.01:10:31 for a table, 0.01:10:301 for --tsv, --csv, --json and plots)"},
    {"scale", 0, "S", OPTION_OWN, .own = read_scale, .doc = "multiplies each record by S"},
    {"pga", 0, "A", OPTION_OWN, .own = read_pga,
     .doc = "scales each record to this peak, 0.35g or 3.4m/s2"},
    {"target", 0, "SPECTRUM", OPTION_TEXT, 0, AT(target),
     .doc = "scales each record to a target spectrum by the mean of ln(target / PSA). SPECTRUM is "
            "that of a code, see below, or a file with rows of period and PSA below a line with "
            "their units, period [s], PSA [g]"},
    {"match", 0, "P", OPTION_OWN, .own = read_match,
     .doc = "periods of this mean, as for --periods (default: 301 over the whole target)"},
    {"pairs", .kind = OPTION_SET, .at = AT(n_component), .set = 2,
     .doc = "successive records are the two horizontal components of a motion, with one factor"},
    {"select", 0, "N", OPTION_WHOLE, 0, AT(n_select), 1, INT_MAX,
     .doc = "chooses the N records, or pairs, with the smallest misfits"},
    {"factors", 0, "LOW:HIGH", OPTION_OWN, .own = read_factors,
     .doc = "chooses among records with a factor within these limits"},
    {"improve", .kind = OPTION_TRUE, .at = AT(improve),
     .doc = "exchanges chosen records while this brings the mean of the scaled spectra nearer to "
            "the target"},
    {"deck", .kind = OPTION_SET, .at = AT(form), .set = SPECTRUM_DECK,
     .doc = "prints only the records and their factors, as sweeps for a deck"},
    {"format", 0, "F", OPTION_TEXT, 0, AT(record.format),
     .doc = "format of the records; default: detected from their content"},
    {"channel", 0, "N", OPTION_WHOLE, 0, AT(record.channel), 1, INT_MAX, .what = "a number",
     .doc = "channel of the records, if a file has several"},
    {"unit", 0, "U", OPTION_TEXT, 0, AT(record.unit),
     .doc = "unit of the values, such as g, m/s2 or gal, if the file does not state it"},
    {"dt", 0, "DT", OPTION_OWN, .own = read_dt,
     .doc = "time between samples, if the file does not state it"},
    {"demean", .kind = OPTION_TRUE, .at = AT(record.demean),
     .doc = "subtracts the mean of the values from each record"},
    {"intensities", .kind = OPTION_SET, .at = AT(content), .set = CONTENT_INTENSITIES,
     .doc = "prints the intensities only"},
    {"pounding", 0, "DECK", OPTION_TEXT, 0, AT(load.path),
     .doc = "the largest contact force over the periods of two structures, the params T1 and T2 of "
            "DECK; --periods is for both (default: 0.1:2:20)"},
    {"define", 'D', "NAME=VALUE", OPTION_WORDS, OPTION_LETTER_ONLY, AT(load.define),
     .doc = "replaces the value of a param of that deck; may be repeated"},
    DECK_THREADS_ROW(AT(n_thread), "threads for its runs (default: all cores)"),
    {"output", 'o', "FILE", OPTION_TEXT, OPTION_LETTER_ONLY, AT(picture.output),
     .doc = "draws the pseudo-acceleration, or the contact force; extension .png, .svg or .pdf"},
    {"script", 0, "DIR", OPTION_TEXT, 0, AT(picture.script_folder),
     .doc = "writes DIR/spectrum.gp for gnuplot and its data, DIR/spectrum.dat; pounding.gp and "
            ".dat with --pounding"},
    {"force", .kind = OPTION_SET, .at = AT(picture.existing), .set = RESULT_REPLACE,
     .doc = "overwrites existing files"},
    {"tsv", .kind = OPTION_SET, .at = AT(form), .set = FORM_TSV,
     .doc = "tab-separated values, not rounded: one line per record (or statistic, target), "
            "damping and period; with --intensities one line per record"},
    {0}};

int spectrum_command(int argc, char **argv) {
    static const struct option_part parts[] = {{.text = introduction},
                                               {.row = rows},
                                               {.row = printer_rows, .at = AT(form)},
                                               {.row = option_help},
                                               {.print = spectrum_print_codes},
                                               {.text = explanation},
                                               {0}};
    static const struct option_list list = {&command_spectrum, parts, DASH_ONE, .use = use};
    struct unit_system si;
    unit_system_init(&si);
    struct spectrum_request q = {.scale = 1.0,
                                 .n_component = 1,
                                 .most = INFINITY,
                                 .record = {.gravity = si.gravity},
                                 .picture.existing = RESULT_KEEP};
    return option_run(&list, argc, argv, &q);
}
