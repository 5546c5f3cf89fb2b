// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of `make bench`.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <time.h>

#include "bench/bench.h"

#ifdef __clang__
static const char compiler[] = __VERSION__;
#else
static const char compiler[] = "gcc " __VERSION__;
#endif

// A case is run until it took SECONDS together, but RUNS_MIN to RUNS_MAX times.
enum { RUNS_MIN = 3, RUNS_MAX = 25 };
static const double SECONDS = 1.0;

// Clock of the machine for which limits and targets were set [GHz].
static const double TARGET_CLOCK = 4.2;

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

void bench_head(enum layout layout) {
    char machine[256];
    char date[32];
    machine_name(machine, sizeof machine);
    time_t now = time(NULL);
    strftime(date, sizeof date, "%Y-%m-%d", gmtime(&now));
    char clock[32] = "";
    if (bench_clock() > 0.0) {
        snprintf(clock, sizeof clock, " at %.2f GHz", bench_clock());
    }
    printf("%s%s, %s%s, %s, %s\n", layout == LAYOUT_TABS ? "# " : "", date, machine, clock,
           compiler, BENCH_FLAGS);
}

static void print_columns(enum layout layout) {
    const char *format = layout == LAYOUT_TABS
                             ? "%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\n"
                             : "\n%-28s %7s %7s %10s %8s %7s %5s %8s %8s %6s %8s\n";
    printf(format, "model", "dt s", "steps", "ns/step", "ns/dof", "spread", "runs", "limit",
           "target", "ratio", "by clock");
}

// Numbers that are not there are a dash.
static void format_number(char *text, size_t size, const char *format, double value) {
    if (value > 0.0) {
        snprintf(text, size, format, value);
    } else {
        snprintf(text, size, "-");
    }
}

static double median(const struct times *t) {
    int half = t->n / 2;
    return t->n % 2 ? t->run[half] : (t->run[half - 1] + t->run[half]) / 2.0;
}

static void print_row(const struct bench_case *c, const struct model *m, const struct times *t,
                      enum layout layout) {
    double seconds = median(t);
    double step = 1e9 * seconds / (double)m->n_step;
    double spread = 100.0 * (t->run[t->n - 1] - t->run[0]) / seconds;
    char limit[32];
    char target[32];
    char ratio[32];
    char by_clock[32];
    double over = c->target > 0.0 ? step / c->target : 0.0;
    format_number(limit, sizeof limit, "%.4g", c->limit);
    format_number(target, sizeof target, "%.4g", c->target);
    format_number(ratio, sizeof ratio, "%.2f", over);
    format_number(by_clock, sizeof by_clock, "%.2f", over * bench_clock() / TARGET_CLOCK);
    const char *format = layout == LAYOUT_TABS
                             ? "%s\t%g\t%ld\t%.4g\t%.3g\t%.0f\t%d\t%s\t%s\t%s\t%s\n"
                             : "%-28s %7g %7ld %10.4g %8.3g %5.0f %% %5d %8s %8s %6s %8s\n";
    printf(format, c->name, c->dt, m->n_step, step, step / m->n_dof, spread, t->n, limit, target,
           ratio, by_clock);
    fflush(stdout);
}

// Largest memory of this process so far [MiB]; the system counts in KiB.
static double memory(void) {
    struct rusage r;
    return getrusage(RUSAGE_SELF, &r) == 0 ? (double)r.ru_maxrss / 1024.0 : 0.0;
}

static void print_built(const struct bench_case *c, const struct model *m, const struct times *t,
                        enum layout layout) {
    const char *format = layout == LAYOUT_TABS ? "%s\t%d\t%d\t%.4g\t%.3g\t%.0f\n"
                                               : "%-28s %7d %7d %10.4g %8.3g %7.0f\n";
    double seconds = median(t);
    printf(format, c->name, m->n_dof, m->n_link, 1e3 * seconds, 1e6 * seconds / m->n_dof, memory());
    fflush(stdout);
}

typedef void print_case(const struct bench_case *c, const struct model *m, const struct times *t,
                        enum layout layout);

// Measures and prints one case.
static int walk(const struct bench_case *c, const struct bench_place *place, enum layout layout,
                print_case *print, struct error *e) {
    struct model *m;
    struct times times;
    int status = bench_model(c, &m, e);
    if (status != STATUS_OK) {
        return status;
    }
    status = measure(c, m, place, &times, e);
    if (status == STATUS_OK) {
        print(c, m, &times, layout);
    }
    model_free(m);
    return status;
}

int bench_table(const struct bench_place *place, const char *filter, enum layout layout,
                struct error *e) {
    int status = STATUS_OK;
    print_columns(layout);
    for (int i = 0; status == STATUS_OK && i < n_bench_case; i++) {
        if (strstr(bench_cases[i].name, filter)) {
            status = walk(&bench_cases[i], place, layout, print_row, e);
        }
    }
    return status;
}

int bench_table_built(const struct bench_place *place, enum layout layout, struct error *e) {
    const char *format =
        layout == LAYOUT_TABS ? "%s\t%s\t%s\t%s\t%s\t%s\n" : "\n%-28s %7s %7s %10s %8s %7s\n";
    printf(format, "built", "dofs", "links", "ms", "us/dof", "MiB");
    int status = STATUS_OK;
    for (int i = 0; status == STATUS_OK && i < n_bench_built; i++) {
        status = walk(&bench_built[i], place, layout, print_built, e);
    }
    return status;
}
