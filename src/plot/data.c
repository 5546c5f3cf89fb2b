// SPDX-License-Identifier: GPL-3.0-or-later
// Histories of a figure.
#include "plot/runs.h"

#include <assert.h>
#include <stdarg.h>
#include <stdlib.h>

#include "plot/script.h"

int data_create(struct data *d, long n_row, int n_column, struct error *e) {
    assert(n_row > 0 && n_column > 0 && n_column <= DATA_COLUMNS_MAX);
    const size_t n = (size_t)n_row;
    *d = (struct data){.n_row = n, .n_column = n_column};
    double *block = calloc(n * (size_t)n_column, sizeof *block);
    if (!block) {
        return error_no_memory(e);
    }
    for (int c = 0; c < n_column; c++) {
        d->column[c] = block + (size_t)c * n;
    }
    return STATUS_OK;
}

void data_free(struct data *d) {
    free(d->column[0]);
    d->column[0] = NULL;
}

void data_write(const struct data *d, size_t bins, struct canvas *c, const char *columns,
                const char *name, ...) {
    const double *series[DATA_COLUMNS_MAX];
    const int n_series = d->n_column - 1;
    char data[32];
    if (c->status != STATUS_OK) {
        return;
    }
    for (int k = 0; k < n_series; k++) {
        series[k] = d->column[k + 1];
    }
    const size_t most = 2 * (size_t)n_series * bins + 2;
    size_t *row = malloc((d->n_row < most ? d->n_row : most) * sizeof *row);
    if (!row) {
        c->status = error_no_memory(c->e);
        return;
    }
    va_list list;
    va_start(list, name);
    vsnprintf(data, sizeof data, name, list);
    va_end(list);
    canvas_block(c, columns, "%s", data);
    const size_t n = script_thin(series, n_series, d->n_row, bins, row);
    for (size_t i = 0; i < n; i++) {
        for (int k = 0; k < d->n_column; k++) {
            fprintf(c->data, "%s%.7g", k > 0 ? " " : "", d->column[k][row[i]]);
        }
        fputc('\n', c->data);
    }
    canvas_end(c);
    free(row);
}

void data_span(const struct data *d, int column, struct span *r) {
    assert(column >= 0 && column < d->n_column);
    for (size_t i = 0; i < d->n_row; i++) {
        span_add(r, d->column[column][i]);
    }
}

size_t data_row(const struct data *d, double t) {
    assert(d->n_row > 0);
    size_t low = 0, high = d->n_row;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (d->column[0][middle] < t) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

double data_at(const struct data *d, int column, double t) {
    assert(column >= 0 && column < d->n_column && d->n_row > 0);
    const size_t high = data_row(d, t);
    const double *time = d->column[0], *value = d->column[column];
    if (high == 0 || high == d->n_row) {
        return value[high == 0 ? 0 : d->n_row - 1];
    }
    const double part = (t - time[high - 1]) / (time[high] - time[high - 1]);
    return value[high - 1] + part * (value[high] - value[high - 1]);
}
