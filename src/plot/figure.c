// SPDX-License-Identifier: GPL-3.0-or-later
// The list of figures and the head that all scripts share: terminal, text, lines.
#include "plot/figure.h"

#include <string.h>

#include "plot/script.h"

#define FIGURE(name) extern const struct figure figure_##name;
#include "plot/figure_list.inc"
#undef FIGURE

#define FIGURE(name) &figure_##name,
const struct figure *const figures[] = {
#include "plot/figure_list.inc"
};
#undef FIGURE
const int n_figure = sizeof figures / sizeof figures[0];

struct picture {
    const char *ending, *terminal, *title_font;
};
static const struct picture pictures[] = {
    {"png", "pngcairo size 1600,1000 font 'Sans,17' linewidth 1.6", "Sans,21"},
    {"svg", "svg size 1120,700 font 'Sans,14' linewidth 1.2 background '#ffffff'", "Sans,17"},
    {"pdf", "pdfcairo size 25.6cm,16cm font 'Sans,12' linewidth 1.2", "Sans,15"},
};
enum { N_PICTURE = sizeof pictures / sizeof pictures[0] };

const struct figure *figure_find(const char *name) {
    for (int i = 0; i < n_figure; i++) {
        if (strcmp(figures[i]->name, name) == 0) {
            return figures[i];
        }
    }
    return NULL;
}

static const struct picture *picture_of(const char *path) {
    const char *dot = strrchr(path, '.');
    for (int i = 0; dot && i < N_PICTURE; i++) {
        if (strcmp(dot + 1, pictures[i].ending) == 0) {
            return &pictures[i];
        }
    }
    return NULL;
}

const char *figure_ending(const char *path) {
    const struct picture *p = picture_of(path);
    return p ? p->ending : NULL;
}

int figure_head(const char *name, const char *doc, const char *version, const char *output,
                FILE *to, struct error *e) {
    const struct picture *p = picture_of(output);
    if (!p) {
        return error_set(e, STATUS_INPUT, "%s is no picture: it must end in .png, .svg or .pdf",
                         output);
    }
    fprintf(to, "# %s: %s. Written by jostle %s; run with gnuplot.\n", name, doc, version);
    fprintf(to, "set encoding utf8\nset terminal %s\nset output ", p->terminal);
    script_text(to, output);
    fprintf(to,
            "\nset termoption noenhanced\n"
            "title_font = '%s'\n"
            "unset key\n"
            "set border 3 lc rgb '#404040'\n"
            "set tics nomirror out scale 0.6\n"
            "set grid lc rgb '#e4e4e4' lt 1 lw 0.6\n"
            "set tics textcolor rgb '#202020'\n",
            p->title_font);
    return STATUS_OK;
}

void figure_end(FILE *to) {
    fprintf(to, "unset output\n");
}

int figure_write(const struct figure *f, const struct result_file *file, const char *output,
                 FILE *to, struct error *e) {
    int status = figure_head(f->name, f->doc, result_report(file)->version, output, to, e);
    if (status == STATUS_OK) {
        status = f->draw(file, to, e);
        figure_end(to);
    }
    return status;
}
