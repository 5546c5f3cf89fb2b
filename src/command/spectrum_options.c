// SPDX-License-Identifier: GPL-3.0-or-later
// The command line of `jostle spectrum`. Options of records may also be written as in a deck, with
// one dash, as messages about records name them so.
#include <limits.h>
#include <math.h>
#include <string.h>

#include "command/periods.h"
#include "command/quantity_word.h"
#include "command/spectrum.h"
#include "command/threads.h"
#include "core/arena.h"

enum { DAMPING_MAX = 7 };

// Default periods: ten a decade in a table to be read, a hundred where a curve is wanted.
static const double DEFAULT_FROM = 0.01, DEFAULT_TO = 10.0;
enum { DEFAULT_TABLE = 31, DEFAULT_CURVE = 301 };

// Of a pounding force spectrum, for each structure.
static const double POUNDING_FROM = 0.1, POUNDING_TO = 2.0;
enum { POUNDING_DEFAULT = 20, POUNDING_MAX = 1000 };

// Options without a letter.
enum {
    OPTION_DAMPING = UCHAR_MAX + 1,
    OPTION_PERIODS,
    OPTION_FORMAT,
    OPTION_CHANNEL,
    OPTION_UNIT,
    OPTION_DT,
    OPTION_DEMEAN,
    OPTION_SCALE,
    OPTION_PGA,
    OPTION_TARGET,
    OPTION_MATCH,
    OPTION_DECK,
    OPTION_INTENSITIES,
    OPTION_TSV,
    OPTION_SCRIPT,
    OPTION_FORCE,
    OPTION_POUNDING,
};

static const struct command *const self = &command_spectrum;

static const double default_damping[] = {0.05};

static const char details[] =
    "For each RECORD: peak ground acceleration, velocity and displacement, Arias intensity,\n"
    "cumulative absolute velocity and significant duration. Then the elastic response spectrum, "
    "of\n"
    "several records the mean and percentiles: pseudo-acceleration PSA, pseudo-velocity PSV and\n"
    "displacement SD; in TSV also the true largest relative velocity SV and total acceleration "
    "SA.\n"
    "\n"
    "  --damping LIST   damping ratios, 0.02,0.05 or 2%,5% (default: 5%)\n"
    "  --periods P      FROM:TO:N, evenly spaced by their logarithms, or LIST, ascending; in s,\n"
    "                   0 or 0.001 to 1000 (default: 0.01:10:31 for a table,\n"
    "                   0.01:10:301 for TSV and pictures)\n"
    "  --scale S        multiplies each record by S\n"
    "  --pga A          scales each record to this peak, 0.35g or 3.4m/s2\n"
    "  --target FILE    scales each record to a spectrum, by the mean of ln(target / PSA);\n"
    "                   FILE has rows of period and PSA under a line with their units,\n"
    "                   period [s], PSA [g]\n"
    "  --match P        periods over which that mean is taken, as for --periods (default: 301\n"
    "                   over the whole target)\n"
    "  --deck           prints the records and their factors as sweeps for a deck, nothing else\n"
    "  --format F       format of the records; found if not given\n"
    "  --channel N      channel of the records, where a file holds several\n"
    "  --unit U         unit of the values, g, m/s2, cm/s2, gal ..., if a file does not say it\n"
    "  --dt DT          time between samples, if a file does not say it\n"
    "  --demean         subtracts the mean of the values from each record\n"
    "  --intensities    no spectra\n"
    "  --pounding DECK  the largest contact force of a deck over the periods of two structures,\n"
    "                   which it takes from its params T1 and T2; --periods is for both (default:\n"
    "                   0.1:2:20)\n"
    "  -D NAME=VALUE    overrides a param of that deck; may be repeated\n"
    "  -j THREADS       threads for its runs (default: all cores)\n"
    "  --tsv            tab-separated values, not rounded, one line a record (and statistic,\n"
    "                   target), damping and period; with --intensities one line a record\n"
    "  -o FILE          draws the pseudo-acceleration, or the force; .png, .svg or .pdf\n"
    "  --script DIR     writes DIR/spectrum.gp for gnuplot and its data, DIR/spectrum.dat;\n"
    "                   pounding.gp and .dat with --pounding\n"
    "  --force          overwrites what exists\n"
    "  --help           this text\n"
    "\n"
    "The ground acceleration is linear between samples and zero before and after them; its\n"
    "integrals start from rest, without correction of the baseline. g is 9.80665 m/s2. The mean "
    "is\n"
    "arithmetic; percentiles are interpolated between the sorted values. With -o or --script the\n"
    "table of the spectrum is left out.\n";

static int parse_damping(const char *text, struct spectrum_request *q) {
    double *value = arena_alloc(q->arena, DAMPING_MAX, sizeof *value);
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

static int parse_scale(const char *text, struct spectrum_request *q) {
    return quantity_whole(text, &dimension_none, BARE_ALLOWED, &q->scale) && q->scale != 0.0
               ? EXIT_DONE
               : command_usage(self, "--scale takes a factor other than 0, not '%s'", text);
}

static int parse_pga(const char *text, struct spectrum_request *q) {
    return quantity_whole(text, &dimension_acceleration, BARE_REFUSED, &q->pga) && q->pga > 0.0
               ? EXIT_DONE
               : command_usage(
                     self, "--pga takes an acceleration > 0 with its unit, such as 0.35g, not '%s'",
                     text);
}

static int parse_channel(const char *text, struct spectrum_request *q) {
    double n;
    if (!quantity_whole(text, &dimension_none, BARE_ALLOWED, &n) || n != floor(n) ||
        !(n >= 1.0 && n <= INT_MAX)) {
        return command_usage(self, "--channel takes a number from 1, not '%s'", text);
    }
    q->record.channel = (int)n;
    return EXIT_DONE;
}

static int parse_dt(const char *text, struct spectrum_request *q) {
    return quantity_whole(text, &dimension_time, BARE_ALLOWED, &q->record.dt) && q->record.dt > 0.0
               ? EXIT_DONE
               : command_usage(self, "--dt takes a time > 0 in s, not '%s'", text);
}

// Where the value of an option that is a text goes.
static const char **text_of(struct spectrum_request *q, int letter) {
    switch (letter) {
        case OPTION_FORMAT:
            return &q->record.format;
        case OPTION_UNIT:
            return &q->record.unit;
        case OPTION_SCRIPT:
            return &q->picture.script_folder;
        case OPTION_POUNDING:
            return &q->pounding;
        case OPTION_TARGET:
            return &q->target;
        default:
            return &q->picture.output;
    }
}

static const struct option option[] = {
    {"damping", required_argument, NULL, OPTION_DAMPING},
    {"periods", required_argument, NULL, OPTION_PERIODS},
    {"format", required_argument, NULL, OPTION_FORMAT},
    {"channel", required_argument, NULL, OPTION_CHANNEL},
    {"unit", required_argument, NULL, OPTION_UNIT},
    {"dt", required_argument, NULL, OPTION_DT},
    {"demean", no_argument, NULL, OPTION_DEMEAN},
    {"scale", required_argument, NULL, OPTION_SCALE},
    {"pga", required_argument, NULL, OPTION_PGA},
    {"target", required_argument, NULL, OPTION_TARGET},
    {"match", required_argument, NULL, OPTION_MATCH},
    {"deck", no_argument, NULL, OPTION_DECK},
    {"intensities", no_argument, NULL, OPTION_INTENSITIES},
    {"tsv", no_argument, NULL, OPTION_TSV},
    {"output", required_argument, NULL, 'o'},
    {"script", required_argument, NULL, OPTION_SCRIPT},
    {"force", no_argument, NULL, OPTION_FORCE},
    {"pounding", required_argument, NULL, OPTION_POUNDING},
    {"define", required_argument, NULL, 'D'},
    {"threads", required_argument, NULL, 'j'},
    {"help", no_argument, NULL, 'h'},
    {NULL, 0, NULL, 0},
};

static int take_form(struct spectrum_request *q, enum spectrum_form form) {
    if (q->form != FORM_TEXT && q->form != form) {
        return command_usage(self, "give --tsv or --deck, not both");
    }
    q->form = form;
    return EXIT_DONE;
}

static int take(void *request, int letter) {
    struct spectrum_request *q = request;
    switch (letter) {
        case OPTION_DAMPING:
            return parse_damping(optarg, q);
        case OPTION_PERIODS:
            return periods_parse(self, "--periods", optarg, q->arena, &q->periods);
        case OPTION_MATCH:
            return periods_parse(self, "--match", optarg, q->arena, &q->match);
        case OPTION_SCALE:
            return parse_scale(optarg, q);
        case OPTION_PGA:
            return parse_pga(optarg, q);
        case OPTION_CHANNEL:
            return parse_channel(optarg, q);
        case OPTION_DT:
            return parse_dt(optarg, q);
        case 'j':
            return threads_parse(self, optarg, &q->n_thread);
        case 'D':
            q->define[q->n_define++] = optarg;
            break;
        case OPTION_DEMEAN:
            q->record.demean = true;
            break;
        case OPTION_INTENSITIES:
            q->content = CONTENT_INTENSITIES;
            break;
        case OPTION_TSV:
            return take_form(q, FORM_TSV);
        case OPTION_DECK:
            return take_form(q, FORM_DECK);
        case OPTION_FORCE:
            q->picture.existing = RESULT_REPLACE;
            break;
        default:
            *text_of(q, letter) = optarg;
    }
    return EXIT_DONE;
}

static int check_pounding(const struct spectrum_request *q) {
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

static int check_target(const struct spectrum_request *q) {
    if (!q->target && (q->match.value || q->form == FORM_DECK)) {
        return command_usage(self, "%s needs --target", q->match.value ? "--match" : "--deck");
    }
    if (q->target && q->n_damping > 1) {
        return command_usage(self, "--target takes one damping ratio, that of the target");
    }
    return q->form == FORM_DECK ? spectrum_check_deck(q) : EXIT_DONE;
}

static int check(const struct spectrum_request *q) {
    if (picture_check(self, &q->picture) != EXIT_DONE || check_target(q) != EXIT_DONE) {
        return EXIT_INPUT;
    }
    if (q->pounding) {
        return check_pounding(q);
    }
    if (q->n_define > 0 || q->n_thread > 0) {
        return command_usage(self, "%s is for the deck of --pounding",
                             q->n_define > 0 ? "-D" : "-j");
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

static int set_defaults(struct spectrum_request *q) {
    if (q->pounding) {
        q->n_thread = q->n_thread > 0 ? q->n_thread : threads_all();
        return q->periods.value ? EXIT_DONE
                                : periods_range(self, POUNDING_FROM, POUNDING_TO, POUNDING_DEFAULT,
                                                q->arena, &q->periods);
    }
    if (!q->damping) {
        q->damping = default_damping;
        q->n_damping = 1;
    }
    const bool table = q->form == FORM_TEXT && !picture_is_wanted(&q->picture);
    return q->periods.value
               ? EXIT_DONE
               : periods_range(self, DEFAULT_FROM, DEFAULT_TO,
                               table ? DEFAULT_TABLE : DEFAULT_CURVE, q->arena, &q->periods);
}

static const struct command_options options = {&command_spectrum, details, NULL, getopt_long_only,
                                               ":hD:j:o:",        option,  take, "define"};

int spectrum_parse(int argc, char **argv, struct arena *a, struct spectrum_request *q) {
    struct unit_system si;
    unit_system_init(&si);
    *q = (struct spectrum_request){.arena = a,
                                   .scale = 1.0,
                                   .record = {.gravity = si.gravity},
                                   .picture.existing = RESULT_KEEP,
                                   .define = arena_alloc(a, (size_t)argc, sizeof *q->define)};
    if (!q->define) {
        return command_no_memory();
    }
    int status = command_parse(&options, argc, argv, q);
    if (status != GO_ON) {
        return status;
    }
    q->path = argv + optind;
    q->n_record = argc - optind;
    status = check(q);
    if (status == EXIT_DONE) {
        status = set_defaults(q);
    }
    return status == EXIT_DONE ? GO_ON : status;
}
