// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/selection.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/text.h"
#include "study/demands.h"

struct selection {
    struct study_file *file;  // NULL: the text is checked only
    const struct study_view *view;
    struct arena *arena;
    unsigned char *chosen;  // (n_run of the file)
};

struct rank {
    double demand;
    long row;
};

// The largest demand first; of equal ones the run that comes first.
static int compare(const void *a, const void *b) {
    const struct rank *p = a, *q = b;
    const int fall = (p->demand < q->demand) - (p->demand > q->demand);
    return fall ? fall : (p->row > q->row) - (p->row < q->row);
}

static int unknown(const char *word, struct error *e) {
    struct text_short t;
    return error_set(e, STATUS_INPUT, "'%s' chooses no runs; give " SELECTION_FORM,
                     text_short(&t, word));
}

// A whole number from 1; *end is what follows. False if there is none.
static bool read_number(const char *text, const char **end, long *out) {
    char *behind;
    errno = 0;
    *out = strtol(text, &behind, 10);
    *end = behind;
    return *text >= '0' && *text <= '9' && errno == 0 && *out >= 1;
}

static int choose_worst(const struct selection *s, const char *text, struct error *e) {
    const long n_run = s->view->n_run;
    const char *end;
    struct edp edp;
    long n, left = 0;
    if (!read_number(text, &end, &n) || (*end != '\0' && *end != ':')) {
        return unknown(text, e);
    }
    const char *wanted = *end ? end + 1 : NULL;
    if (!s->file) {
        return wanted ? edp_parse(s->view, wanted, s->arena, &edp, e) : STATUS_OK;
    }
    int status = demands_find(s->file, wanted, s->arena, &edp, e);
    double *value = malloc(((size_t)n_run + 1) * sizeof *value);
    struct rank *rank = malloc(((size_t)n_run + 1) * sizeof *rank);
    const struct demands demands = {s->file, 1, &edp, DEMANDS_ERROR, value};
    if (status == STATUS_OK) {
        status = value && rank ? demands_read(&demands, e) : error_no_memory(e);
    }
    for (long i = 0; i < n_run && status == STATUS_OK; i++) {
        if (!isnan(value[i])) {
            rank[left++] = (struct rank){value[i], i};
        }
    }
    if (status == STATUS_OK) {
        qsort(rank, (size_t)left, sizeof *rank, compare);
    }
    for (long i = 0; i < n && i < left && status == STATUS_OK; i++) {
        s->chosen[rank[i].row] = 1;
    }
    free(value);
    free(rank);
    return status;
}

// Runs that have collapsed, or, without the mask STUDY_COLLAPSED, failed.
static int choose_ending(const struct selection *s, int wanted, struct error *e) {
    int *ending = NULL;
    const int status = s->file ? study_file_endings(s->file, &ending, e) : STATUS_OK;
    for (long i = 0; ending && i < s->view->n_run; i++) {
        if (wanted & STUDY_COLLAPSED ? (ending[i] & STUDY_COLLAPSED) != 0
                                     : (ending[i] & STUDY_STATUS) == wanted) {
            s->chosen[i] = 1;
        }
    }
    free(ending);
    return status;
}

// The runs of these numbers.
static int choose_range(const struct selection *s, long first, long last, struct error *e) {
    const char *path = s->view->path;
    long n = 0;
    if (last > s->view->n_study) {
        return error_set(e, STATUS_INPUT, "%s has no run %ld; its study has the runs 1 to %ld",
                         path, last, s->view->n_study);
    }
    for (long i = 0; s->file && i < s->view->n_run; i++) {
        const long number = study_view_run(s->view, i) + 1;
        if (number >= first && number <= last) {
            s->chosen[i] = 1;
            n++;
        }
    }
    return n > 0 || !s->file ? STATUS_OK
                             : error_set(e, STATUS_INPUT,
                                         "%s is part of a study and has no run %ld", path, first);
}

static int choose(const struct selection *s, const char *word, struct error *e) {
    const char *end;
    long first, last;
    if (strcmp(word, "failed") == 0) {
        return choose_ending(s, STUDY_FAILED, e);
    }
    if (strcmp(word, "collapsed") == 0) {
        return choose_ending(s, STUDY_COLLAPSED, e);
    }
    if (strncmp(word, "worst:", 6) == 0) {
        return choose_worst(s, word + 6, e);
    }
    bool sound = read_number(word, &end, &first);
    last = first;
    if (sound && *end == '-') {
        sound = read_number(end + 1, &end, &last) && last >= first;
    }
    return sound && *end == '\0' ? choose_range(s, first, last, e) : unknown(word, e);
}

static int read(struct study_file *f, const struct study_view *v, const char *text,
                unsigned char *chosen, struct error *e) {
    const struct selection s = {f, v, arena_create(), chosen};
    char *word = s.arena ? arena_text(s.arena, text, strlen(text)) : NULL;
    int status = word ? STATUS_OK : error_no_memory(e);
    while (word && status == STATUS_OK) {
        char *comma = strchr(word, ',');
        if (comma) {
            *comma++ = '\0';
        }
        status = choose(&s, word, e);
        word = comma;
    }
    arena_free(s.arena);
    return status;
}

int selection_read(struct study_file *f, const char *text, unsigned char *chosen, struct error *e) {
    return read(f, study_file_view(f), text, chosen, e);
}

int selection_check(const struct study_view *v, const char *text, struct error *e) {
    return read(NULL, v, text, NULL, e);
}
