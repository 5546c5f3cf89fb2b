// SPDX-License-Identifier: GPL-3.0-or-later
// Measures the cases of cases.c. The table of times is for people (docs/performance.md); counts of
// instructions, which repeat, are for count.sh, which runs this program under valgrind.
#include <gsl/gsl_errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "bench/bench.h"

static const char usage[] =
    "bench [-t] JOSTLE FOLDER: tables of all cases\n"
    "bench [-t] -f TEXT JOSTLE FOLDER: times per step of those whose names contain TEXT\n"
    "bench -c: the names of the cases whose instructions are counted\n"
    "bench -c NAME: runs one of them once and prints its steps\n"
    "  -t  columns separated by tabs\n";

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
    int status;
    if (counts) {
        status = n == 0 ? list_counted() : run_counted(argv[optind], &e);
    } else {
        struct bench_place place = {.program = argv[optind], .folder = argv[optind + 1]};
        bench_head(layout);
        status = filter[0] ? STATUS_OK : bench_table_built(&place, layout, &e);
        status = status == STATUS_OK ? bench_table(&place, filter, layout, &e) : status;
    }
    if (status != STATUS_OK) {
        fprintf(stderr, "bench: %s\n", e.message);
    }
    return status == STATUS_OK ? EXIT_SUCCESS : EXIT_FAILURE;
}
