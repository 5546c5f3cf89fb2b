// SPDX-License-Identifier: GPL-3.0-or-later
// Hostile texts, the files in which they are put, and the commands that are tried on them.
#include "support/hostile.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/text.h"
#include "support/foreign.h"

static char very_long[3001];
const char *const hostile_text[N_HOSTILE] = {
    "it's",
    "''a''b'",
    "\"; system(\"touch marker\"); \"",
    "'; system(\"touch marker\"); '",
    "back\\slash\\",
    "`touch marker`",
    "$(touch marker)",
    "a\nsystem(\"touch marker\")\n#",
    "a\r\nsystem(\"touch marker\")\r\n#",
    "a\n!touch marker\n",
    "EOD\nsystem(\"touch marker\")\n",
    "a\nEOD\nsystem(\"touch marker\")\n",
    "\033[31mred\033]0;title\a\b\b",
    "\177\302\23331m",
    "stray \xff\xc0\x80 \x9b bytes",
    "EOD",
    "5%s%n%d 50% %%",
    "{/=50 x} a_b^c @d &{e} ~f{g}",
    "</text><script>x</script>",
    "=cmd|' /c calc'!A0",
    "Zürich – 東京",
    very_long,
    "",
};

static const char run_deck[] = "title \"two\"\n"
                               "units kN m s\n"
                               "building A -floors 2 -mass 100t -stiffness 50MN/m -height 3m\n"
                               "building B -floors 2 -mass 80t -stiffness 20MN/m -height 3m\n"
                               "contact A:2 B:2 -gap 1mm -law kelvin-voigt -k 1e5 -e 0.6\n"
                               "contact A:1 B:1 -gap 1mm -law jankowski -k 1e6 -e 0.6\n"
                               "link A:1 B:1 -stiffness 1000\n"
                               "ground sine -amplitude 0.3g -frequency 1.5 -cycles 2\n"
                               "step fixed 1ms\n";
static const char study_deck[] = "sweep record files \"*.AT2\"\n"
                                 "sweep scale values 1 2 3\n"
                                 "sweep word values jankowski hunt-crossley\n"
                                 "building A -floors 1 -mass 1 -stiffness 100 -height 3\n"
                                 "building B -floors 1 -mass 1 -stiffness 50 -height 3\n"
                                 "contact A B -gap 1mm -law $word -k 1e5 -e 0.6\n"
                                 "ground record $record -scale $scale\n"
                                 "step fixed 0.01\n";
const char hostile_record[] = "PEER NGA STRONG MOTION DATABASE RECORD\nNowhere\n"
                              "ACCELERATION TIME SERIES IN UNITS OF G\n"
                              "NPTS= 6, DT= .01 SEC\n0 1 -1 0.5 0 0\n";

static const char run_commands[] =
    "\"$JOSTLE\" show x.h5; \"$JOSTLE\" show --tsv x.h5; \"$JOSTLE\" show --csv x.h5; "
    "\"$JOSTLE\" show --json x.h5; \"$JOSTLE\" verify x.h5; "
    "for kind in loops spectrum modes overview; do "
    "\"$JOSTLE\" plot x.h5 $kind --force --script scripts; done; "
    "\"$JOSTLE\" plot x.h5 modes --compare run.h5 --force --script scripts";
static const char study_commands[] =
    "\"$JOSTLE\" show x.h5; \"$JOSTLE\" show --tsv x.h5; \"$JOSTLE\" show --csv x.h5; "
    "\"$JOSTLE\" show --json x.h5; \"$JOSTLE\" show --long x.h5; \"$JOSTLE\" verify x.h5 --run 1; "
    "\"$JOSTLE\" fragility x.h5 --edp drift --limit 1mm; "
    "\"$JOSTLE\" fragility x.h5 --edp drift --limit 1mm --method ida --at word=jankowski; "
    "for kind in ida response; do "
    "\"$JOSTLE\" plot x.h5 $kind --edp drift --force --script scripts; done; "
    "\"$JOSTLE\" plot x.h5 response --edp drift --against record --over scale --force "
    "--script scripts; "
    "\"$JOSTLE\" plot x.h5 fragility --edp drift --limit 1mm --force --script scripts";
static const char part_commands[] = "\"$JOSTLE\" show x.h5; \"$JOSTLE\" show --csv x.h5; "
                                    "\"$JOSTLE\" merge x.h5 two.h5 -o merged.h5; rm -f merged.h5";
static const char remove_scripts[] = "mkdir -p scripts; rm -f scripts/*";
static const char draw_scripts[] = "mkdir -p scripts; cd scripts; set -- *.gp; [ ! -e $1 ] || "
                                   "LC_ALL=C.UTF-8 gnuplot *.gp; s=$?; rm -f *; "
                                   "exit $s";

const struct hostile_file hostile_file[N_HOSTILE_FILE] = {
    {"run.h5", run_commands,
     "\"$JOSTLE\" show x.h5; \"$JOSTLE\" show --csv x.h5; \"$JOSTLE\" show --json x.h5; "
     "\"$JOSTLE\" plot x.h5 --force --script scripts; "
     "\"$JOSTLE\" plot x.h5 contact --compare run.h5 --force --script scripts"},
    {"study.h5", study_commands,
     "\"$JOSTLE\" show x.h5; \"$JOSTLE\" show --csv x.h5; \"$JOSTLE\" show --long x.h5; "
     "\"$JOSTLE\" fragility x.h5 --edp drift --limit 1mm; "
     "\"$JOSTLE\" plot x.h5 response --edp drift --force --script scripts"},
    {"one.h5", part_commands, part_commands}};

// What a terminal shows: UTF-8 without control characters but line feeds and tabs.
static bool is_shown(const char *text) {
    while ((text = text_not_plain(text)) != NULL && (*text == '\n' || *text == '\t')) {
        text++;
    }
    return !text;
}

bool hostile_is_short(void) {
    return getenv("JOSTLE_SANITIZED") != NULL;
}

struct support_result hostile_tried(const char *line, const char *where, const char *text) {
    const struct support_result r = support_run("cd '%s'; %s", support_temporary(), line);
    const bool executed =
        unlink(support_path("marker")) == 0 || unlink(support_path("scripts/marker")) == 0;
    if (executed || !is_shown(r.out) || !is_shown(r.err) || r.status >= 128) {
        char shown[128];
        text_clean(shown, sizeof shown, text, strlen(text));
        fail_msg("'%s' in %s, %s: %sstatus %d\n%.2000s\n%.2000s", shown, where, line,
                 executed ? "executed; " : "", r.status, r.out, r.err);
    }
    return r;
}

struct support_result hostile_draw(const char *where, const char *text) {
    return hostile_tried(hostile_is_short() ? remove_scripts : draw_scripts, where, text);
}

void hostile_drawn(const char *where, const char *text) {
    const struct support_result r = hostile_draw(where, text);
    if (r.status != 0 || r.err[0]) {
        fail_msg("'%s' in %s: %s", text, where, r.err);
    }
}

// Commands run in the folder of the test.
static bool set_program(void) {
    const char *program = getenv("JOSTLE");
    program = program ? program : "build/jostle";
    char folder[2048], path[4096];
    if (!getcwd(folder, sizeof folder)) {
        return false;
    }
    snprintf(path, sizeof path, "%s%s%s", program[0] == '/' ? "" : folder,
             program[0] == '/' ? "" : "/", program);
    return setenv("JOSTLE", path, 1) == 0;
}

int hostile_make_files(void **state) {
    (void)state;
    if (!set_program()) {
        return 1;
    }
    memset(very_long, 'x', sizeof very_long - 1);
    support_write("run.deck", run_deck);
    support_write("study.deck", study_deck);
    support_write("r.AT2", hostile_record);
    support_write("s.AT2", hostile_record);
    const struct support_result r =
        support_run("cd '%s' && \"$JOSTLE\" run -q run.deck && \"$JOSTLE\" run -q study.deck && "
                    "\"$JOSTLE\" run -q study.deck --shard 1/2 -o one.h5 && "
                    "\"$JOSTLE\" run -q study.deck --shard 2/2 -o two.h5",
                    support_temporary());
    if (r.status != 0) {
        print_error("%s", r.err);
    }
    return r.status;
}
