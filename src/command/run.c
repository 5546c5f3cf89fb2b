// SPDX-License-Identifier: GPL-3.0-or-later
// jostle run: a deck through time, into a result file, and a summary.
#include <assert.h>
#include <limits.h>
#include <math.h>
#include <string.h>

#include "command/command.h"
#include "command/deck_command.h"
#include "command/interrupt.h"
#include "command/output_name.h"
#include "command/progress.h"
#include "command/show.h"
#include "core/checksum.h"
#include "core/heap.h"
#include "core/safe.h"
#include "jostle/numerics.h"
#include "jostle/result.h"
#include "jostle/study.h"
#include "model/guidance.h"
#include "study/selection.h"

static int run_command(int argc, char **argv);

struct run_options {
    struct load_request load;
    struct guidance guidance;
    int n_word;
    char **word;  // (n_word) of the command
    const char *output;
    enum result_existing existing;
    enum study_journal journal;
    struct words take;  // files
    bool retry;
    const char *histories;     // which runs of a study have them; NULL: as the deck says
    int steps_max;             // 0: no limit
    double seconds_max;        // 0: no limit
    int n_thread;              // 0: all cores
    struct study_shard shard;  // of a study; n = 0: the whole
};
#define AT(member) offsetof(struct run_options, member)

const struct command command_run = {
    .name = "run",
    .usage = "DECK [-o FILE.h5] [-D NAME=VALUE]... [-j THREADS] [-q] [--shard K/N] [--force]\n"
             "                  [--take FILE.h5]... [--retry] [--restart] [--histories RUNS]",
    .summary = "runs a deck, writes its result file and prints a summary",
    .run = run_command,
};

// Shows progress, and ends the run on a signal.
static int watch_poll(void *context, double time, struct error *e) {
    progress_show(context, time);
    const int signal = interrupt_number();
    return signal ? error_set(e, STATUS_SYSTEM,
                              "interrupted by signal %d at t = %.6g; nothing was written", signal,
                              time)
                  : STATUS_OK;
}

static int read_shard(void *options, struct arena *a, const char *text) {
    (void)a;
    struct run_options *o = options;
    return output_parse_shard(text, &o->shard)
               ? EXIT_DONE
               : command_usage(&command_run,
                               "--shard takes K/N, part K of N, with 1 <= K <= N <= %d, not '%s'",
                               STUDY_RUNS_MAX, text);
}

static int settle(void *options) {
    struct run_options *o = options;
    o->load.guidance = o->load.quiet ? NULL : &o->guidance;
    return EXIT_DONE;
}

static int analyse(const struct model *m, const struct run_options *o,
                   const struct result_options *result, struct results **out, struct error *e) {
    struct result_writer *writer;
    int status = result_create(m, result, &writer, e);
    if (status != STATUS_OK) {
        return status;
    }
    struct progress progress;
    progress_start(&progress, m->duration, m->deck->units.time_name);
    progress.enabled = progress.enabled && !o->load.quiet;
    const struct observer watch = {.poll = watch_poll, .context = &progress};
    status = result_analyse(writer, &watch, out, e);
    progress_end(&progress);
    return status;
}

static int print_summary(const struct model *m, const struct results *r, const char *path,
                         struct error *e) {
    struct report *report;
    int status = report_create(m, r, path, JOSTLE_VERSION, &report, e);
    if (status == STATUS_OK) {
        status = report_print(report, stdout, e);
        report_free(report);
    }
    return status;
}

// Results never replace what they are made from, not even with --force.
static int check_output(const struct model *m, const struct run_options *o, const char *path,
                        struct error *e) {
    if (output_is_same_file(path, o->load.path)) {
        return error_set(e, STATUS_INPUT, "%s is the deck; give the result another name", path);
    }
    for (const struct deck_path *file = m->deck->files; file; file = file->next) {
        if (output_is_same_file(path, file->path)) {
            return error_set(e, STATUS_INPUT,
                             "%s is read by the deck; give the result another name", path);
        }
    }
    return STATUS_OK;
}

// The hardest impact that too few steps cover; NULL: none.
static const struct impact *hardest_coarse(const struct model *m, const struct results *r) {
    const struct impact *hardest = NULL;
    for (long i = 0; i < r->n_impact; i++) {
        const struct impact *other = &r->impact[i];
        if (impacts_is_coarse(m, other) && (!hardest || other->peak_force > hardest->peak_force)) {
            hardest = other;
        }
    }
    return hardest;
}

// Impacts with less than this share of the largest force change no result that matters.
static const double WEAK = 0.05;

// One analysis, with its summary.
static int run_once(const struct model *m, const struct run_options *o,
                    const struct result_options *result) {
    struct results *results;
    struct error e;
    int status = analyse(m, o, result, &results, &e);
    if (status != STATUS_OK) {
        return command_fail(&e);
    }
    if (!o->load.quiet) {
        // Newmark's method with these parameters conserves energy, so the residual is a rounding
        // error. The residual of Dormand & Prince's method is of the size of the tolerance.
        double scale = fmax(fabs(results->energy[ENERGY_INPUT]), results->initial_energy);
        bool closes = m->integrator == INTEGRATOR_NEWMARK && m->beta == 0.25 && m->gamma == 0.5;
        if (closes && results->residual_peak > 1e-6 * scale) {
            fprintf(stderr,
                    "jostle: warning: the energy account misses %.2g of the input; stiffnesses or "
                    "masses differ by more than double precision can carry\n",
                    results->residual_peak / scale);
        }
        const struct impact *i = hardest_coarse(m, results);
        double largest = 0.0;
        for (int k = 0; k < m->n_contact; k++) {
            largest =
                fmax(largest, results->link[k].force);  // NAN of rigid contacts is passed over
        }
        if (i && !(i->peak_force < WEAK * largest)) {
            const char *unit = m->deck->units.time_name;
            const double lasted = i->t_end - i->t_start;
            fprintf(stderr,
                    "jostle: warning: fewer than %d steps cover %ld of %ld impacts; the hardest, "
                    "of contact %s at t = %.6g %s, lasted %.3g %s; step fixed %g resolves it\n",
                    IMPACT_STEPS_MIN, results->totals.coarse, results->n_impact,
                    m->link[i->contact].name, i->t_start, unit, lasted, unit,
                    guidance_round(lasted / IMPACT_STEPS_MIN));
        }
        for (int k = 0; k < m->n_building; k++) {
            char text[DAMPING_TEXT_SIZE];
            const struct building *g = &m->building[k];
            if (damping_warning(m, g, results->drift_rate + g->first, "", text) > 0.0) {
                fprintf(stderr, "jostle: warning: %s\n", text);
            }
        }
        status = print_summary(m, results, result->path, &e);
    }
    results_free(results);
    return status == STATUS_OK ? EXIT_DONE : command_fail(&e);
}

static int watch(void *context, const struct study_progress *p, struct error *e) {
    struct study_display *display = context;
    study_display_show(display, p);
    return interrupt_check(e);
}

// Tells builds apart in the result file; "" where the system does not show the program.
static struct checksum program_sum(void) {
    struct checksum sum;
    struct error e;
    return checksum_file("/proc/self/exe", &sum, &e) == STATUS_OK ? sum
                                                                  : (struct checksum){.digits = ""};
}

// What ended the study, and what is left of it.
static int report_error(const struct study_progress *p, const char *path, struct error *e) {
    int status = command_fail(e);
    if (p->n_left > 0) {
        const bool goes_on = e->status == STATUS_SYSTEM;  // else something must change first
        safe_line(stderr, "jostle: %ld of %ld runs are kept in %s.runs%s", p->n_left, p->n_run,
                  path, goes_on ? "; the same command goes on with them" : "");
    } else if (p->n_done > 0) {
        safe_line(stderr, "jostle: %s.runs is gone, and with it %ld of %ld runs", path, p->n_done,
                  p->n_run);
    }
    return status;
}

static int run_study(const struct model *first, const struct run_options *o,
                     const struct result_options *result) {
    struct study_display display;
    const struct study_request request = {
        .first = first,
        .define = o->load.define.word,
        .n_define = o->load.define.n,
        .n_thread = o->n_thread ? o->n_thread : deck_command_threads(),
        .shard = o->shard,
        .journal = o->journal,
        .take = o->take.word,
        .n_take = o->take.n,
        .retry = o->retry,
        .histories = o->histories,
        .steps_max = o->steps_max,
        .seconds_max = o->seconds_max,
        .numerics = NUMERICS_VERSION,
        .program = program_sum(),
        .result = *result,
        .poll = watch,
        .context = &display,
    };
    struct study_progress p;
    struct error e;
    study_display_start(&display, o->load.quiet ? DISPLAY_NOTHING : DISPLAY_PROGRESS);
    int status = study_run(&request, &p, &e);
    study_display_end(&display);
    if (!o->load.quiet && p.n_damaged > 0) {
        safe_line(stderr,
                  "jostle: warning: %s.runs is damaged in %ld %s; of %ld runs %ld were found in "
                  "it, the others are run again",
                  result->path, p.n_damaged, p.n_damaged == 1 ? "place" : "places", p.n_run,
                  p.n_kept);
    }
    if (status != STATUS_OK) {
        return report_error(&p, result->path, &e);
    }
    if (!o->load.quiet && p.n_kept == p.n_run) {
        safe_line(stderr, "jostle: all %ld runs were there; none was computed", p.n_run);
    }
    if (p.left_histories) {
        safe_line(stderr,
                  "jostle: warning: the histories of single runs in %s are gone with the old "
                  "file; --histories makes them again",
                  result->path);
    }
    if (!o->load.quiet && show_study_summary(result->path, stdout, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    if (!o->load.quiet && o->histories && !p.histories[0]) {
        puts("histories   of no run, as none is chosen");
    } else if (!o->load.quiet && o->histories) {
        safe_line(stdout, "histories   of run%s %s", strpbrk(p.histories, ",-") ? "s" : "",
                  p.histories);
    }
    return study_display_status(p.n_failed, p.n_run, result->path, p.failure);
}

// Is an option given that has no meaning for a single analysis?
static bool wants_study(const struct run_options *o) {
    return o->shard.n > 0 || o->take.n > 0 || o->retry || o->histories || o->steps_max > 0 ||
           o->seconds_max > 0.0;
}

static int run_model(void *options, const struct model *m) {
    const struct run_options *o = options;
    assert(o->load.path);
    const struct result_options result = {
        .path = output_choose(m, o->output, &o->shard),
        .existing = o->existing,
        .command_line = command_line(m->deck->arena, o->n_word, o->word),
        .version = JOSTLE_VERSION,
    };
    struct error e;
    if (!result.path || !result.command_line) {
        return command_no_memory();
    }
    if (check_output(m, o, result.path, &e) != STATUS_OK ||
        (wants_study(o) && deck_command_check_study(m, &e) != STATUS_OK)) {
        return command_fail(&e);
    }
    interrupt_catch();
    return deck_is_study(m->deck) ? run_study(m, o, &result) : run_once(m, o, &result);
}

static int run_command(int argc, char **argv) {
    enum { SHORT_RUN = 2 << 20 };  // bytes that the library takes for the smallest of files
    static const struct option_row rows[] = {
        {"output", 'o', "FILE", OPTION_TEXT, 0, AT(output),
         .doc = "the result file; default: the name of the deck with .h5, in the current "
                "directory"},
        DECK_DEFINE_ROW,
        DECK_THREADS_ROW(AT(n_thread),
                         "threads of a study, default: all cores; a single analysis uses one"),
        {"quiet", 'q', .kind = OPTION_TRUE, .at = AT(load.quiet), .doc = "prints errors only"},
        {"shard", 0, "K/N", OPTION_OWN, .own = read_shard,
         .doc = "runs part K of N of a study, into NAME.K-of-N.h5 without -o; jostle merge joins "
                "the parts"},
        {"force", .kind = OPTION_SET, .at = AT(existing), .set = RESULT_REPLACE,
         .doc = "overwrites an existing result file"},
        {"restart", .kind = OPTION_SET, .at = AT(journal), .set = STUDY_RESTART,
         .doc = "discards the finished runs of an interrupted study; without this option the "
                "study continues"},
        {"take", 0, "FILE.h5", OPTION_WORDS, 0, AT(take),
         .doc = "takes from the file of another study the runs that this one has too; may be "
                "repeated"},
        {"retry", .kind = OPTION_TRUE, .at = AT(retry),
         .doc = "computes failed runs again that the result file, --take or an interrupted start "
                "have"},
        {"histories", 0, "RUNS", OPTION_TEXT, 0, AT(histories),
         .doc = "computes these runs of a study once more and adds their histories to the result "
                "file: a list of " SELECTION_FORM},
        {"steps", 0, "N", OPTION_WHOLE, 0, AT(steps_max), 1, INT_MAX,
         .doc = "limit of steps: a run of a study with N of them fails"},
        {"seconds", 0, "S", OPTION_NUMBER, 0, AT(seconds_max), 1e-3, 1e9,
         .doc = "limit of time: a run of a study fails after S seconds of processor time"},
        {0}};
    static const struct option_part parts[] = {{.row = rows}, {.row = option_help}, {0}};
    static const struct deck_command c = {&command_run, parts, .settle = settle, .use = run_model};
    struct run_options o = {
        .existing = RESULT_KEEP, .journal = STUDY_RESUME, .n_word = argc, .word = argv};
    heap_expect(SHORT_RUN);
    return deck_command_run(&c, argc, argv, &o.load);
}
