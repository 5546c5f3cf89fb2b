// SPDX-License-Identifier: GPL-3.0-or-later
// jostle spectrum: intensities and elastic response spectra of ground motions.
#include "command/spectrum.h"

#include <math.h>
#include <string.h>

#include "command/pounding.h"
#include "command/progress.h"
#include "core/arena.h"
#include "core/text.h"
#include "plot/response.h"

static int spectrum_command(int argc, char **argv);

const struct command command_spectrum = {
    .name = "spectrum",
    .usage =
        "RECORD... [--damping LIST] [--periods FROM:TO:N|LIST] [--scale S|--pga A]\n"
        "           [--format F] [--channel N] [--unit U] [--dt DT] [--demean]\n"
        "           [--intensities] [--tsv] [-o FILE.png|.svg|.pdf] [--script DIR] [--force]\n"
        "       jostle spectrum --pounding DECK [--periods FROM:TO:N|LIST] [-D NAME=VALUE]...\n"
        "           [-j THREADS] [--tsv] [-o FILE.png|.svg|.pdf] [--script DIR] [--force]",
    .summary = "prints or draws intensities and response spectra of ground motions",
    .run = spectrum_command,
};

// Files without folder and ending; the whole path where another record has the same one.
static int name_records(const struct spectrum_request *q, struct arena *a, struct spectrum_set *set,
                        struct error *e) {
    const char **base = arena_alloc(a, (size_t)q->n_record, sizeof *base);
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

static int find_scale(const struct spectrum_request *q, const struct record *record,
                      const char *path, double *scale, struct error *e) {
    *scale = q->scale;
    if (q->pga == 0.0) {
        return STATUS_OK;
    }
    double peak = 0.0;
    for (size_t j = 0; j < record->n; j++) {
        peak = fmax(peak, fabs(record->value[j]) * record->unit);
    }
    if (peak == 0.0) {
        return error_set(e, STATUS_INPUT, "%s: every value is 0; it cannot be scaled to a peak",
                         path);
    }
    *scale = q->pga / peak;
    return STATUS_OK;
}

static int read_ground(const struct spectrum_request *q, int r, struct arena *a,
                       struct spectrum_set *set, struct error *e) {
    struct record_request request = q->record;
    struct record record;
    request.path = q->path[r];
    int status = record_read(a, &request, &record, e);
    for (int i = 0; status == STATUS_OK && i < record.n_warning; i++) {
        fprintf(stderr, "jostle: warning: %s\n", record.warning[i]);
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

static int allocate(const struct spectrum_request *q, struct arena *a, struct spectrum_set *set,
                    struct error *e) {
    const size_t n = (size_t)q->n_record;
    *set = (struct spectrum_set){
        .name = arena_alloc(a, n, sizeof *set->name),
        .scale = arena_alloc(a, n, sizeof *set->scale),
        .ground = arena_alloc(a, n, sizeof *set->ground),
        .intensity = arena_alloc(a, n, sizeof *set->intensity),
        .spectra = {.n_record = q->n_record,
                    .n_damping = q->n_damping,
                    .n_period = q->n_period,
                    .damping = q->damping,
                    .period = q->period,
                    .tell = progress_tell},
    };
    return set->name && set->scale && set->ground && set->intensity ? STATUS_OK
                                                                    : error_no_memory(e);
}

static int compute(const struct spectrum_request *q, struct arena *a, struct spectrum_set *set,
                   struct error *e) {
    int status = allocate(q, a, set, e);
    if (status == STATUS_OK) {
        status = name_records(q, a, set, e);
    }
    for (int r = 0; status == STATUS_OK && r < q->n_record; r++) {
        status = read_ground(q, r, a, set, e);
        if (status == STATUS_OK) {
            set->intensity[r] = intensity_of(&set->ground[r], q->record.gravity);
        }
    }
    if (status == STATUS_OK && q->content == CONTENT_ALL) {
        struct progress progress;
        progress_start(&progress, 1, "points");
        set->spectra.context = &progress;
        status = spectra_compute(&set->spectra, set->ground, a, e);
        set->spectra.context = NULL;
        progress_end(&progress);
    }
    return status;
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
    const struct picture_request picture = {
        .options = q->picture,
        .name = "spectrum",
        .write = write_picture,
        .context = &sheet,
    };
    return picture_make(&picture, e);
}

static int spectrum_command(int argc, char **argv) {
    struct error e;
    struct spectrum_request q;
    struct spectrum_set set;
    struct arena *a = arena_create();
    if (!a) {
        return command_no_memory();
    }
    int status = spectrum_parse(argc, argv, a, &q);
    if (status == GO_ON && q.pounding) {
        status = pounding_run(&q, a);
    } else if (status == GO_ON) {
        status = compute(&q, a, &set, &e);
        if (status == STATUS_OK && picture_is_wanted(&q.picture)) {
            status = draw(&q, &set, &e);
        }
        if (status == STATUS_OK) {
            spectrum_print(&q, &set);
        }
        status = status == STATUS_OK ? EXIT_DONE : command_fail(&e);
    }
    arena_free(a);
    return status;
}
