// SPDX-License-Identifier: GPL-3.0-or-later
// jostle spectrum: intensities and elastic response spectra of ground motions.
#include "command/spectrum.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "command/progress.h"
#include "core/arena.h"
#include "core/safe.h"
#include "core/text.h"
#include "plot/pictures.h"

const struct command command_spectrum = {
    .name = "spectrum",
    .usage =
        "RECORD... [--damping LIST] [--periods FROM:TO:N|LIST]\n"
        "           [--scale S|--pga A|--target SPECTRUM [--match FROM:TO:N|LIST] [--pairs]\n"
        "           [--select N [--factors LOW:HIGH] [--improve]] [--deck]]\n"
        "           [--format F] [--channel N] [--unit U] [--dt DT] [--demean]\n"
        "           [--intensities] [--tsv|--csv|--json] [-o FILE.png|.svg|.pdf] [--script DIR] "
        "[--force]\n"
        "       jostle spectrum --pounding DECK [--periods FROM:TO:N|LIST] [-D NAME=VALUE]...\n"
        "           [-j THREADS] [--tsv|--csv|--json] [-o FILE.png|.svg|.pdf] [--script DIR] "
        "[--force]",
    .summary = "prints or draws intensities and response spectra of ground motions",
    .run = spectrum_command,
};

// Files without folder and ending; the whole path where another record has the same one.
static int name_records(const struct spectrum_request *q, struct arena *a, struct spectrum_set *set,
                        struct error *e) {
    const char **base = arena_alloc(a, (size_t)q->n_record, sizeof *base);
    assert(set->name);
    if (!base) {
        return error_no_memory(e);
    }
    for (int r = 0; r < q->n_record; r++) {
        size_t n;
        const char *stem = text_stem(q->path[r], &n);
        base[r] = arena_text(a, stem, n);
        if (!base[r]) {
            return error_no_memory(e);
        }
    }
    for (int r = 0; r < q->n_record; r++) {
        set->name[r] = base[r];
        for (int k = 0; k < q->n_record; k++) {
            if (k != r && strcmp(base[k], base[r]) == 0) {
                set->name[r] = q->path[r];
            }
        }
    }
    return STATUS_OK;
}

// A target is scaled to when the spectra are known.
static int find_scale(const struct spectrum_request *q, const struct record *record,
                      const char *path, double *scale, struct error *e) {
    *scale = q->scale;
    if (q->pga == 0.0 && !q->target) {
        return STATUS_OK;
    }
    double peak = 0.0;
    for (size_t j = 0; j < record->n; j++) {
        peak = fmax(peak, fabs(record->value[j]) * record->unit);
    }
    if (peak == 0.0) {
        return error_set(e, STATUS_INPUT, "%s: every value is 0; it cannot be scaled to a %s", path,
                         q->target ? "target" : "peak");
    }
    *scale = q->target ? 1.0 : q->pga / peak;
    return STATUS_OK;
}

static int read_ground(const struct spectrum_request *q, int r, struct arena *a,
                       struct spectrum_set *set, struct error *e) {
    struct record_request request = q->record;
    struct record record;
    request.path = q->path[r];
    int status = record_read(a, &request, &record, e);
    for (int i = 0; status == STATUS_OK && i < record.n_warning; i++) {
        safe_line(stderr, "jostle: warning: %s", record.warning[i]);
    }
    if (status == STATUS_OK) {
        status = find_scale(q, &record, request.path, &set->scale[r], e);
    }
    if (status == STATUS_OK) {
        status = signal_init_samples(&set->ground[r], a, record.value, record.n, record.dt,
                                     set->scale[r] * record.unit, 0.0, e);
    }
    return status;
}

int spectrum_compute(struct spectra *s, const struct signal *ground, struct arena *a,
                     struct error *e) {
    struct progress progress;
    progress_start(&progress, 1, "points");
    s->tell = progress_tell;
    s->context = &progress;
    const int status = spectra_compute(s, ground, a, e);
    s->context = NULL;
    progress_end(&progress);
    return status;
}

static int compute(struct spectrum_request *q, struct arena *a, struct spectrum_set *set,
                   struct error *e) {
    const size_t n = (size_t)q->n_record;
    set->name = arena_alloc(a, n, sizeof *set->name);
    set->scale = arena_alloc(a, n, sizeof *set->scale);
    set->ground = arena_alloc(a, n, sizeof *set->ground);
    set->intensity = arena_alloc(a, n, sizeof *set->intensity);
    int status =
        set->name && set->scale && set->ground && set->intensity ? STATUS_OK : error_no_memory(e);
    if (status == STATUS_OK) {
        status = name_records(q, a, set, e);
    }
    for (int r = 0; status == STATUS_OK && r < q->n_record; r++) {
        status = read_ground(q, r, a, set, e);
    }
    if (status == STATUS_OK && q->target) {
        status = spectrum_match(q, a, set, e);
    }
    for (int r = 0; status == STATUS_OK && r < q->n_record; r++) {
        set->intensity[r] = intensity_of(&set->ground[r], q->record.gravity);
    }
    set->spectra = (struct spectra){.n_record = q->n_record,
                                    .n_damping = q->n_damping,
                                    .n_period = q->periods.n,
                                    .damping = q->damping,
                                    .period = q->periods.value};
    return status == STATUS_OK && q->content == CONTENT_ALL
               ? spectrum_compute(&set->spectra, set->ground, a, e)
               : status;
}

static int write_picture(void *context, const struct figure_files *to, struct error *e) {
    return response_write(context, to, e);
}

static int draw(const struct spectrum_request *q, const struct spectrum_set *set, struct error *e) {
    struct response_sheet sheet = {
        .spectra = &set->spectra,
        .name = set->name,
        .intensity = set->intensity,
        .gravity = q->record.gravity,
        .version = JOSTLE_VERSION,
    };
    if (q->target) {
        sheet.target = &set->target;
        sheet.factor = set->scale;
        sheet.match = (struct span){q->match.value[0], q->match.value[q->match.n - 1]};
    }
    const struct picture_request picture = {
        .options = q->picture,
        .name = "spectrum",
        .write = write_picture,
        .context = &sheet,
    };
    return picture_make(&picture, e);
}

static int show_records(struct spectrum_request *q, struct arena *a) {
    struct spectrum_set set = {0};
    struct error e;
    if (q->target) {
        const int answer = spectrum_read_target(q, a, &set);
        if (answer != GO_ON) {
            return answer;
        }
    }
    int status = compute(q, a, &set, &e);
    if (status == STATUS_OK && picture_is_wanted(&q->picture)) {
        status = draw(q, &set, &e);
    }
    if (status != STATUS_OK) {
        return command_fail(&e);
    }
    return spectrum_print(q, &set);
}

int spectrum_run(struct spectrum_request *q, struct arena *a) {
    return q->load.path ? pounding_run(q, a) : show_records(q, a);
}
