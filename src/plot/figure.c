// SPDX-License-Identifier: GPL-3.0-or-later
// The list of figures and the head that all scripts share: terminal, text, lines.
#include "plot/figure.h"

#include <assert.h>
#include <string.h>

#include "core/safe.h"
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

// Sizes in em. A picture across is a column wide or two, a page is an A4 page within its margins.
struct sheet_size {
    double width, height;
};
static const struct sheet_size sheets[] = {
    [SHEET_ACROSS] = {46, 29},
    [SHEET_PAGE] = {70, 99},
};

// How a terminal is told what the canvas wants.
struct picture {
    const char *ending, *format;
    const char *last_mark;
    const char *font;     // a browser knows no font called Sans
    const char *heading;  // the font of headings, heading_size times as large; svg has no bold one
    double heading_size;
    double em[2];       // the terminal's unit of size, on each sheet
    double text;        // gnuplot's size of text of one em: it counts points, 4/3 pixels each for
                        // pngcairo, and pdfcairo halves them
    double point;       // makes a point of size 1 a quarter of an em on the sheet across
    double below_axis;  // [characters] raises the numbers, which svg puts lower than the others
};
static const struct picture pictures[] = {
    {.ending = "png",
     .format = "pngcairo size %.0f,%.0f linewidth 1.5",
     .last_mark = "IEND",
     .font = "Sans",
     .heading = "Sans:Bold",
     .heading_size = 1,
     .em = {26, 19},
     .text = 0.75,
     .point = 1},
    {.ending = "svg",
     .format = "svg size %.0f,%.0f linewidth 1 background '#ffffff'",
     .last_mark = "</svg>",
     .font = "sans-serif",
     .heading = "sans-serif",
     .heading_size = 1.15,
     .em = {16, 14},
     .text = 1,
     .point = 0.33,
     .below_axis = 0.4},
    {.ending = "pdf",
     .format = "pdfcairo size %.4fin,%.4fin linewidth 1",
     .last_mark = "%%EOF",
     .font = "Sans",
     .heading = "Sans:Bold",
     .heading_size = 1,
     .em = {10 / 72.0, 8.4 / 72.0},
     .text = 108,
     .point = 0.4},
};
enum { N_PICTURE = sizeof pictures / sizeof pictures[0] };

const struct figure *figure_find(const char *name) {
    assert(name);
    for (int i = 0; i < n_figure; i++) {
        if (strcmp(figures[i]->name, name) == 0) {
            return figures[i];
        }
    }
    return NULL;
}

static enum subject_kind kind_of(const struct subject *p) {
    return p->model ? SUBJECT_DECK : p->suite ? SUBJECT_STUDY : SUBJECT_RUNS;
}

bool figure_can_draw(const struct figure *f, const struct subject *p) {
    struct error e;
    return f->of == kind_of(p) && (!f->check || f->check(p, &e) == STATUS_OK);
}

const struct figure *figure_default(const struct subject *p) {
    const struct suite *s = p->suite;
    if (s) {
        const bool scaled = s->is_intensity && s->abscissa->number && !s->mixed && s->n_point > 1 &&
                            s->n_sample > 1 && s->n_group == 1;
        return figure_find(scaled ? "ida" : "response");
    }
    int i = 0;
    while (i < n_figure - 1 && !figure_can_draw(figures[i], p)) {
        i++;
    }
    return figures[i];
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

const char *figure_last_mark(const char *path) {
    return picture_of(path)->last_mark;
}

static void write_head(const struct figure_head *head, const struct figure_files *to,
                       const struct picture *p) {
    const struct sheet_size *sheet = &sheets[head->sheet];
    const double em = p->em[head->sheet], size = em * p->text;
    fprintf(to->data, "# Data of %s.gp, written by jostle ", head->name);
    safe_put(to->data, SAFE_COMMENT, head->version);
    fprintf(to->data, ".\n");
    fprintf(to->script, "# %s: %s. Written by jostle ", head->name, head->doc);
    safe_put(to->script, SAFE_COMMENT, head->version);
    fprintf(to->script, "; run with gnuplot.\n"
                        "load ARG0[1:strlen(ARG0)-3].'.dat'  # stands beside this script\n"
                        "set encoding utf8\nset terminal ");
    fprintf(to->script, p->format, sheet->width * em, sheet->height * em);
    fprintf(to->script, " font '%s,%g'\nset output ", p->font, size);
    safe_put(to->script, SAFE_GNUPLOT, to->picture);
    fprintf(to->script,
            "\nset termoption noenhanced\npoint = %.3g\n"
            "title_font = '%s,%g'\nblock_font = '%s,%g'\nsmall_font = '%s,%g'\n"
            "unset key\n"
            "set border 3 lc rgb '#404040' lw 0.8\n"
            "set tics nomirror out scale 0.5 textcolor rgb '#202020'\n"
            "set xtics offset 0,%g\n"
            "set grid lc rgb '#e4e4e4' lt 1 lw 0.6\n"
            "set style fill solid noborder\n"
            "set multiplot\n",
            p->point * em / p->em[SHEET_ACROSS], p->font, 1.2 * size, p->heading,
            p->heading_size * size, p->font, 0.75 * size, p->below_axis);
}

void figure_open(const struct figure_head *head, const struct figure_files *to, struct canvas *c,
                 struct error *e) {
    const struct picture *p = picture_of(to->picture);
    const struct sheet_size *size = &sheets[head->sheet];
    *c = (struct canvas){.to = to->script,
                         .data = to->data,
                         .kind = CANVAS_SHEET,
                         .units = head->units,
                         .e = e,
                         .width = size->width,
                         .height = size->height,
                         .area = {0.3, size->width - 1, 0.3, size->height - 0.3}};
    if (p) {
        write_head(head, to, p);
    } else {
        canvas_fail(c, STATUS_INPUT, "%s is not a picture: its name must end in .png, .svg or .pdf",
                    to->picture);
    }
}

int figure_close(const struct canvas *c) {
    fprintf(c->to, "unset multiplot\nunset output\n");
    return c->status;
}

int figure_write(const struct figure *f, const struct subject *p, const struct figure_files *to,
                 struct error *e) {
    struct figure_head head = {.name = f->name, .doc = f->doc, .sheet = f->sheet};
    struct canvas c;
    struct error why;
    int status = f->check ? f->check(p, &why) : STATUS_OK;
    if (status != STATUS_OK) {
        return error_set(e, status, "%s cannot be drawn: %s", f->name, why.message);
    }
    switch (kind_of(p)) {
        case SUBJECT_DECK:
            head.version = p->version;
            head.units = &p->model->deck->units;
            break;
        case SUBJECT_STUDY:
            head.version = p->suite->view->version;
            head.units = &p->suite->view->units;
            break;
        case SUBJECT_RUNS:
            head.version = p->runs->r[0]->version;
            head.units = &p->runs->r[0]->units;
    }
    figure_open(&head, to, &c, e);
    f->draw(p, &c);
    return figure_close(&c);
}
