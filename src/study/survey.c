// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/survey.h"

#include <math.h>
#include <string.h>

#include "motion/record_cache.h"
#include "study/trial.h"

// A file that was read; kept in a table of FILE_HEADS lists by a hash of its name.
struct file {
    const char *path;
    struct file *next;
};
enum { FILE_HEADS = 1024 };

struct walk {
    struct survey *survey;
    struct record_cache *records;
    struct file *file[FILE_HEADS];
    int choice[STUDY_SWEEPS_MAX];  // of the strongest run so far
    long run;                      // that was built last
    double bound, velocity;        // of it
    struct damping_finding damped;
};

static int note_file(struct walk *w, const char *path, struct error *e) {
    struct arena *a = w->survey->arena;
    unsigned hash = 5381;  // Bernstein's
    for (const char *c = path; *c; c++) {
        hash = 33 * hash + (unsigned char)*c;
    }
    struct file **head = &w->file[hash % FILE_HEADS];
    for (const struct file *f = *head; f; f = f->next) {
        if (strcmp(f->path, path) == 0) {
            return STATUS_OK;
        }
    }
    struct file *f = arena_alloc(a, 1, sizeof *f);
    const char *copy = arena_format(a, "%s", path);
    if (!f || !copy) {
        return error_no_memory(e);
    }
    *f = (struct file){copy, *head};
    *head = f;
    w->survey->n_file++;
    return STATUS_OK;
}

static int note_files(void *context, const struct deck_path *files, struct error *e) {
    int status = STATUS_OK;
    for (; files && status == STATUS_OK; files = files->next) {
        status = note_file(context, files->path, e);
    }
    return status;
}

static int note_error(struct survey *s, long run, const char *message, struct error *e) {
    s->n_failed++;
    for (struct survey_error *f = s->error; f; f = f->next) {
        if (strcmp(f->message, message) == 0) {
            f->n_more++;
            return STATUS_OK;
        }
    }
    struct survey_error *f = arena_alloc(s->arena, 1, sizeof *f);
    const char *copy = arena_format(s->arena, "%s", message);
    if (!f || !copy) {
        return error_no_memory(e);
    }
    *f = (struct survey_error){copy, run, 0, NULL};
    *(s->last ? &s->last->next : &s->error) = f;
    s->last = f;
    return STATUS_OK;
}

static int guide(void *context, const struct model *m, struct study_outcome *outcome,
                 struct error *e) {
    struct walk *w = context;
    struct guidance g;
    (void)outcome;
    int status = guidance_find(m, &g, e);
    w->bound = g.bound;
    if (status == STATUS_OK) {
        status = damping_find(m, false, &w->damped, e);
    }
    // All runs have the contacts of the first.
    struct survey *s = w->survey;
    for (int i = 0; status == STATUS_OK && i < s->n_contact && i < g.n_contact; i++) {
        if (!(s->softest[i].storeys <= g.contact[i].storeys)) {
            s->softest[i] = g.contact[i];
            s->softest_run[i] = w->run;
        }
    }
    for (int i = 0; status == STATUS_OK && i < g.n_contact; i++) {
        w->velocity = fmax(w->velocity, g.contact[i].velocity);
    }
    return status;
}

static long run_of(const struct plan *p, const int *choice) {
    long run = 0;
    int k = 0;
    for (const struct sweep *s = p->first->deck->sweeps; s; s = s->next) {
        run = run * s->n + choice[k++];
    }
    return run;
}

// Builds the model of a run, and keeps the run if it needs a smaller step than all before.
static int look(struct walk *w, const int *choice, struct error *e) {
    struct survey *s = w->survey;
    const struct trial_watch watch = {.files = note_files, .context = w, .records = w->records};
    const long run = run_of(s->plan, choice);
    struct study_outcome outcome;
    w->run = run;
    w->bound = INFINITY;
    w->velocity = 0;
    w->damped.share = 0;
    int status = trial_build(s->plan, run, &watch, guide, w, &outcome, e);
    s->n_run++;
    if (status == STATUS_INPUT) {
        status = note_error(s, run, e->message, e);
    } else if (status == STATUS_OK && outcome.status != STUDY_DONE) {
        status = note_error(s, run, outcome.message, e);
    }
    const bool more_damped = w->damped.share > s->damped.share;
    if (more_damped) {
        s->damped = w->damped;
        s->damped_run = run;
    }
    if (w->bound < s->bound || (w->bound == s->bound && w->velocity > s->velocity) ||
        (w->bound == s->bound && w->velocity == s->velocity && more_damped)) {
        s->bound = w->bound;
        s->velocity = w->velocity;
        s->strongest = run;
        memcpy(w->choice, choice, sizeof w->choice);
    }
    return status;
}

// True if the value is the smallest or the largest of the numbers of the sweep, or of one along it.
static bool is_extreme(const struct sweep *s, int i) {
    bool extreme = false;
    for (; s && !extreme; s = s->along) {
        bool least = s->number, most = s->number;
        for (int k = 0; s->number && k < s->n && (least || most); k++) {
            // Of equal ones the first counts.
            least = least && (k < i ? s->number[k] > s->number[i] : s->number[k] >= s->number[i]);
            most = most && (k < i ? s->number[k] < s->number[i] : s->number[k] <= s->number[i]);
        }
        extreme = least || most;
    }
    return extreme;
}

static bool has_text(const struct sweep *s) {
    while (s && !s->text) {
        s = s->along;
    }
    return s;
}

static bool is_picked(const struct sweep *s, int i) {
    if (s->n <= SURVEY_VALUES || has_text(s)) {
        return true;
    }
    const double gap = (s->n - 1.0) / (SURVEY_VALUES - 1.0);
    return floor(i / gap) > floor((i - 1) / gap) || i == s->n - 1 || is_extreme(s, i);
}

// Varies sweep after sweep of texts, or of numbers, the others at their choice so far.
static int vary_each(struct walk *w, bool text, struct error *e) {
    int status = STATUS_OK;
    int k = 0;
    const struct sweep *s = w->survey->plan->first->deck->sweeps;
    for (; s && status == STATUS_OK; s = s->next, k++) {
        int choice[STUDY_SWEEPS_MAX];
        memcpy(choice, w->choice, sizeof choice);
        const int known = choice[k];
        for (int i = 0; has_text(s) == text && i < s->n && status == STATUS_OK; i++) {
            choice[k] = i;
            status = i != known && is_picked(s, i) ? look(w, choice, e) : STATUS_OK;
        }
    }
    return status;
}

// All combinations of texts.
static int combine(struct walk *w, long n, struct error *e) {
    const struct sweep *first = w->survey->plan->first->deck->sweeps;
    const long known = run_of(w->survey->plan, w->choice);
    int choice[STUDY_SWEEPS_MAX];
    memcpy(choice, w->choice, sizeof choice);
    int status = STATUS_OK;
    for (long i = 0; i < n && status == STATUS_OK; i++) {
        long rest = i;
        int k = 0;
        for (const struct sweep *s = first; s; s = s->next, k++) {
            choice[k] = has_text(s) ? (int)(rest % s->n) : choice[k];
            rest /= has_text(s) ? s->n : 1;
        }
        status = run_of(w->survey->plan, choice) != known ? look(w, choice, e) : STATUS_OK;
    }
    return status;
}

static int walk(struct walk *w, struct error *e) {
    double n_text = 1;
    for (const struct sweep *s = w->survey->plan->first->deck->sweeps; s; s = s->next) {
        n_text *= has_text(s) ? s->n : 1;
    }
    int status = look(w, w->choice, e);
    if (status == STATUS_OK) {
        status = vary_each(w, false, e);
    }
    if (status != STATUS_OK) {
        return status;
    }
    return n_text <= SURVEY_COMBINATIONS ? combine(w, (long)n_text, e) : vary_each(w, true, e);
}

// Before the first model is built.
static bool begin(struct survey *s) {
    const int n = s->plan->first->n_contact;
    s->n_contact = n < GUIDANCE_CONTACTS_MAX ? n : GUIDANCE_CONTACTS_MAX;
    s->arena = arena_create();
    if (s->arena) {
        s->softest = arena_alloc(s->arena, (size_t)s->n_contact, sizeof *s->softest);
        s->softest_run = arena_alloc(s->arena, (size_t)s->n_contact, sizeof *s->softest_run);
    }
    for (int i = 0; s->softest && i < s->n_contact; i++) {
        s->softest[i].storeys = NAN;
    }
    return s->arena && !arena_failed(s->arena);
}

int survey_run(struct survey *s, const struct plan *p, struct error *e) {
    *s = (struct survey){.plan = p, .bound = INFINITY};
    struct walk w = {.survey = s, .records = record_cache_create(RECORD_CACHE_BYTES)};
    const int status = begin(s) && w.records ? walk(&w, e) : error_no_memory(e);
    record_cache_free(w.records);
    return status;
}

void survey_close(struct survey *s) {
    arena_free(s->arena);
}

// Who is shown the strongest run.
struct viewer {
    void (*use)(void *context, const struct model *m, const struct guidance *g);
    void *context;
};

static int show(void *context, const struct model *m, struct study_outcome *outcome,
                struct error *e) {
    const struct viewer *v = context;
    struct guidance g;
    (void)outcome;
    const int status = guidance_find(m, &g, e);
    if (status == STATUS_OK) {
        v->use(v->context, m, &g);
    }
    return status;
}

int survey_strongest(const struct survey *s,
                     void (*use)(void *context, const struct model *m, const struct guidance *g),
                     void *context, struct error *e) {
    struct viewer v = {use, context};
    struct study_outcome outcome;
    return trial_build(s->plan, s->strongest, &(struct trial_watch){.files = NULL}, show, &v,
                       &outcome, e);
}

static int pass(void *context, const struct model *m, struct study_outcome *outcome,
                struct error *e) {
    (void)context, (void)m, (void)outcome, (void)e;
    return STATUS_OK;
}

int survey_shapes(const struct plan *p, struct error *e) {
    if (!p->first->deck->varies) {
        return STATUS_OK;
    }
    const struct trial_watch watch = {.records = record_cache_create(RECORD_CACHE_BYTES)};
    struct study_outcome outcome;
    int status = watch.records ? STATUS_OK : error_no_memory(e);
    const bool all = p->n_run <= SURVEY_COMBINATIONS;
    for (long run = 1; all && run < p->n_run && status == STATUS_OK; run++) {
        status = trial_build(p, run, &watch, pass, NULL, &outcome, e);
    }
    long apart = p->n_run;  // runs from one value of the sweep to the next
    for (const struct sweep *s = p->first->deck->sweeps; s && !all; s = s->next) {
        apart /= s->n;
        for (int i = 1; i < s->n && status == STATUS_OK; i++) {
            status = trial_build(p, i * apart, &watch, pass, NULL, &outcome, e);
        }
    }
    record_cache_free(watch.records);
    return status;
}
