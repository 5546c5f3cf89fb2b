// SPDX-License-Identifier: GPL-3.0-or-later
// Measures the cases of cases.c. The table of times is for people (docs/performance.md); counts of
// instructions, which repeat, are for count.sh, which runs this program under valgrind.
#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>
#include <time.h>
#include <unistd.h>

#include "bench/bench.h"
#include "jostle/result.h"

#ifdef __clang__
static const char compiler[] = __VERSION__;
#else
static const char compiler[] = "gcc " __VERSION__;
#endif

// A case is run until it took SECONDS together, but RUNS_MIN to RUNS_MAX times.
enum { RUNS_MIN = 3, RUNS_MAX = 25 };
static const double SECONDS = 1.0;

static const char usage[] =
    "bench [-t] [-f TEXT] JOSTLE FOLDER: a table of the cases whose names contain TEXT\n"
    "bench -c: the names of the cases whose instructions are counted\n"
    "bench -c NAME: runs one of them once and prints its steps\n"
    "  -t  columns separated by tabs\n";

enum layout { LAYOUT_TABLE, LAYOUT_TABS };

struct times {
    int n;
    double run[RUNS_MAX];  // [s] ascending
};

static int compare(const void *a, const void *b) {
    const double *x = a;
    const double *y = b;
    return (*x > *y) - (*x < *y);
}

static int measure(const struct bench_case *c, const struct model *m,
                   const struct bench_place *place, struct times *t, struct error *e) {
    *t = (struct times){0};
    for (double sum = 0.0; t->n < RUNS_MIN || (t->n < RUNS_MAX && sum < SECONDS); t->n++) {
        if (c->measure(c, m, place, &t->run[t->n], e) != STATUS_OK) {
            return e->status;
        }
        sum += t->run[t->n];
    }
    qsort(t->run, (size_t)t->n, sizeof t->run[0], compare);
    return STATUS_OK;
}

// What the processor calls itself, else the kind of machine.
static void machine_name(char *name, size_t size) {
    struct utsname u;
    snprintf(name, size, "%s", uname(&u) == 0 ? u.machine : "unknown machine");
    FILE *f = fopen("/proc/cpuinfo", "r");
    char line[256];
    while (f && fgets(line, sizeof line, f)) {
        const char *value = strchr(line, ':');
        if (strncmp(line, "model name", strlen("model name")) == 0 && value) {
            snprintf(name, size, "%.*s", (int)strcspn(value + 2, "\n"), value + 2);
            break;
        }
    }
    if (f) {
        fclose(f);
    }
}

static void print_head(enum layout layout) {
    char machine[256];
    char date[32];
    machine_name(machine, sizeof machine);
    time_t now = time(NULL);
    strftime(date, sizeof date, "%Y-%m-%d", gmtime(&now));
    printf("%s%s, %s, %s, %s\n", layout == LAYOUT_TABS ? "# " : "", date, machine, compiler,
           BENCH_FLAGS);
    const char *format = layout == LAYOUT_TABS
                             ? "%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\n"
                             : "\n%-24s %7s %7s %10s %8s %7s %5s %8s %8s %6s\n";
    printf(format, "model", "dt s", "steps", "ns/step", "ns/dof", "spread", "runs", "limit",
           "target", "ratio");
}

// Numbers that are not there are a dash.
static void format_number(char *text, size_t size, const char *format, double value) {
    if (value > 0.0) {
        snprintf(text, size, format, value);
    } else {
        snprintf(text, size, "-");
    }
}

static void print_row(const struct bench_case *c, const struct model *m, const struct times *t,
                      enum layout layout) {
    double median = t->n % 2 ? t->run[t->n / 2] : (t->run[t->n / 2 - 1] + t->run[t->n / 2]) / 2.0;
    double step = 1e9 * median / (double)m->n_step;
    double spread = 100.0 * (t->run[t->n - 1] - t->run[0]) / median;
    char limit[32];
    char target[32];
    char ratio[32];
    format_number(limit, sizeof limit, "%.4g", c->limit);
    format_number(target, sizeof target, "%.4g", c->target);
    format_number(ratio, sizeof ratio, "%.2f", c->target > 0.0 ? step / c->target : 0.0);
    const char *format = layout == LAYOUT_TABS
                             ? "%s\t%g\t%ld\t%.4g\t%.3g\t%.0f\t%d\t%s\t%s\t%s\n"
                             : "%-24s %7g %7ld %10.4g %8.3g %5.0f %% %5d %8s %8s %6s\n";
    printf(format, c->name, c->dt, m->n_step, step, step / m->n_dof, spread, t->n, limit, target,
           ratio);
    fflush(stdout);
}

static int table(const struct bench_place *place, const char *filter, enum layout layout,
                 struct error *e) {
    int status = STATUS_OK;
    print_head(layout);
    for (int i = 0; status == STATUS_OK && i < n_bench_case; i++) {
        const struct bench_case *c = &bench_cases[i];
        struct model *m;
        struct times times;
        if (!strstr(c->name, filter)) {
            continue;
        }
        status = bench_model(c, &m, e);
        if (status == STATUS_OK) {
            status = measure(c, m, place, &times, e);
            if (status == STATUS_OK) {
                print_row(c, m, &times, layout);
            }
            model_free(m);
        }
    }
    return status;
}

static int run_counted(const char *name, struct error *e) {
    const struct bench_case *c = NULL;
    for (int i = 0; i < n_bench_counted; i++) {
        c = strcmp(bench_counted[i].name, name) == 0 ? &bench_counted[i] : c;
    }
    if (!c) {
        return error_set(e, STATUS_INPUT, "no case '%s'", name);
    }
    struct model *m;
    int status = bench_model(c, &m, e);
    if (status == STATUS_OK) {
        double seconds;
        status = c->measure(c, m, NULL, &seconds, e);
        printf("%ld\n", m->n_step);
        model_free(m);
    }
    return status;
}

static int list_counted(void) {
    for (int i = 0; i < n_bench_counted; i++) {
        puts(bench_counted[i].name);
    }
    return STATUS_OK;
}

int main(int argc, char **argv) {
    enum layout layout = LAYOUT_TABLE;
    const char *filter = "";
    bool counts = false;
    for (int c; (c = getopt(argc, argv, "tcf:")) != -1;) {
        switch (c) {
            case 't':
                layout = LAYOUT_TABS;
                break;
            case 'c':
                counts = true;
                break;
            case 'f':
                filter = optarg;
                break;
            default:
                fputs(usage, stderr);
                return EXIT_FAILURE;
        }
    }
    int n = argc - optind;
    if (counts ? n > 1 : n != 2) {
        fputs(usage, stderr);
        return EXIT_FAILURE;
    }
    struct error e = {0};
    gsl_set_error_handler_off();
    result_init();
    int status;
    if (counts) {
        status = n == 0 ? list_counted() : run_counted(argv[optind], &e);
    } else {
        struct bench_place place = {.program = argv[optind], .folder = argv[optind + 1]};
        status = table(&place, filter, layout, &e);
    }
    if (status != STATUS_OK) {
        fprintf(stderr, "bench: %s\n", e.message);
    }
    return status == STATUS_OK ? EXIT_SUCCESS : EXIT_FAILURE;
}
