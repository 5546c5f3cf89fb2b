// SPDX-License-Identifier: GPL-3.0-or-later
// A floor strikes a column of a frame, whose joints turn.
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "model/forces.h"
#include "model/parts.h"
#include "model/struck_column.h"
#include "support/analysis.h"
#include "support/support.h"

// A frame of two storeys and two bays by direct stiffness, with a node at the struck point. The
// first degrees of freedom are both floors and the point; each joint and the point then rise and
// turn.
enum { FLOORS = 2, LINES = 3, POINT = 2, KEPT = 3, NODES = FLOORS * LINES + 1, HELD = -1 };
enum { ALL = KEPT + 2 * NODES, ENTRIES = ALL * ALL, MEMBERS_MAX = 12 };

static const double height[FLOORS] = {3.4, 3.1}, bay[] = {6.0, 5.0}, modulus = 30e9;
static const double column_i[FLOORS] = {2.4e-3, 1.8e-3}, column_a = 0.12, beam_i = 2.1e-3;

struct member {
    int p[2], turn[2], along[2];  // across, turns and along of both ends
    double length, ei, ea, sign;  // sign: of the chord's turn by p_j - p_i, reversed
};

struct direct {
    struct member member[MEMBERS_MAX];
    int n;
    double k[ENTRIES], x[KEPT][ALL];  // displacements for unit ones of those kept
};

// Node of a line and level (1, 2), or of the point (level 0: the ground).
static int rise_of(int level, int line) {
    return level == 0 ? HELD : KEPT + 2 * ((level - 1) * LINES + line);
}

static int turn_of(int level, int line) {
    return level == 0 ? HELD : rise_of(level, line) + 1;
}

static void add_product(struct direct *d, int n, const int *dof, const double *p, const double *q,
                        double k) {
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) {
            if (dof[i] != HELD && dof[j] != HELD) {
                d->k[dof[i] * ALL + dof[j]] += k * p[i] * q[j];
            }
        }
    }
}

static void add_member(struct direct *d, struct member m) {
    const int dof[] = {m.p[0], m.turn[0], m.p[1], m.turn[1]};
    const double s = m.sign / m.length;
    const double a[] = {-s, 1, s, 0}, b[] = {-s, 0, s, 1}, stretch[] = {-1, 1};
    add_product(d, 4, dof, a, a, 4 * m.ei / m.length);
    add_product(d, 4, dof, a, b, 2 * m.ei / m.length);
    add_product(d, 4, dof, b, a, 2 * m.ei / m.length);
    add_product(d, 4, dof, b, b, 4 * m.ei / m.length);
    add_product(d, 2, m.along, stretch, stretch, m.ea / m.length);
    d->member[d->n++] = m;
}

// With the point at this share of the storey (from 0) of a line (from 0). Columns come first, and
// the part above the point is behind the beams.
static void build_direct(struct direct *d, int storey, int struck, double share) {
    const int point_rise = KEPT + 2 * FLOORS * LINES, point_turn = point_rise + 1;
    struct member upper = {.length = 0};
    *d = (struct direct){.n = 0};
    for (int i = 0; i < FLOORS; i++) {
        for (int line = 0; line < LINES; line++) {
            struct member m = {.p = {i - 1, i},
                               .turn = {turn_of(i, line), turn_of(i + 1, line)},
                               .along = {rise_of(i, line), rise_of(i + 1, line)},
                               .length = height[i],
                               .ei = modulus * column_i[i],
                               .ea = modulus * column_a,
                               .sign = 1};
            if (i == storey && line == struck) {
                upper = m;
                upper.p[0] = m.p[1] = POINT;
                upper.turn[0] = m.turn[1] = point_turn;
                upper.along[0] = m.along[1] = point_rise;
                m.length = share * height[i];
                upper.length = (1 - share) * height[i];
            }
            add_member(d, m);
        }
    }
    for (int i = 1; i <= FLOORS; i++) {
        for (int line = 0; line + 1 < LINES; line++) {
            add_member(d, (struct member){.p = {rise_of(i, line), rise_of(i, line + 1)},
                                          .turn = {turn_of(i, line), turn_of(i, line + 1)},
                                          .along = {HELD, HELD},
                                          .length = bay[line],
                                          .ei = modulus * beam_i,
                                          .sign = -1});
        }
    }
    add_member(d, upper);
}

// Condenses all but floors and point.
static void condense(struct direct *d, double k[KEPT][KEPT]) {
    enum { REST = ALL - KEPT };
    double inner[REST * REST];
    for (int i = 0; i < REST; i++) {
        memcpy(inner + (ptrdiff_t)i * REST, d->k + (ptrdiff_t)(KEPT + i) * ALL + KEPT,
               REST * sizeof *inner);
    }
    gsl_matrix_view factors = gsl_matrix_view_array(inner, REST, REST);
    assert_int_equal(gsl_linalg_cholesky_decomp1(&factors.matrix), 0);
    for (int j = 0; j < KEPT; j++) {
        for (int i = 0; i < ALL; i++) {
            d->x[j][i] = i < KEPT ? i == j : -d->k[i * ALL + j];
        }
        gsl_vector_view x = gsl_vector_view_array(d->x[j] + KEPT, REST);
        gsl_linalg_cholesky_svx(&factors.matrix, &x.vector);
        for (int i = 0; i < KEPT; i++) {
            k[i][j] = 0;
            for (int l = 0; l < ALL; l++) {
                k[i][j] += d->k[i * ALL + l] * d->x[j][l];
            }
        }
    }
}

static double at(const double *x, int dof) {
    return dof == HELD ? 0 : x[dof];
}

static void end_moments(const struct member *m, const double *x, double moment[2]) {
    const double chord = m->sign * (at(x, m->p[1]) - at(x, m->p[0])) / m->length;
    const double a = at(x, m->turn[0]) + chord, b = at(x, m->turn[1]) + chord;
    moment[0] = m->ei / m->length * (4 * a + 2 * b);
    moment[1] = m->ei / m->length * (2 * a + 4 * b);
}

static const char frame[] = "building A -floors 1 -mass 90t -stiffness 30e6 -height %gm\n"
                            "building B -floors 2 -mass 60t -height 3.4m 3.1m\n"
                            "frame B -bays 6 5 -modulus 30e9\n"
                            "columns B:1:2 -I 2.4e-3 1.8e-3 -A 0.12\nbeams B:1:2 -I 2.1e-3\n";

static const struct {
    int storey, line;
    double share;
} places[] = {{0, 0, 0.25}, {1, 0, 0.6}, {0, 2, 0.5}, {1, 2, 0.1}};
enum { N_PLACE = sizeof places / sizeof places[0] };

static double level_of(int i) {
    return (places[i].storey > 0 ? height[0] : 0) + places[i].share * height[places[i].storey];
}

static struct model *struck_model(int i, const char *more) {
    char text[1024];
    snprintf(text, sizeof text, frame, level_of(i));
    return analysis_model("units N m s\n%scolumn B@%.17gm -name c -line %d -mass 600 -n 2\n"
                          "duration 1\nstep fixed 1ms\n%s",
                          text, level_of(i), places[i].line + 1, more);
}

static void stiffness_of_floors_and_point_is_that_of_the_frame_with_a_node_there(void **state) {
    (void)state;
    for (int i = 0; i < N_PLACE; i++) {
        struct direct d;
        double want[KEPT][KEPT];
        build_direct(&d, places[i].storey, places[i].line, places[i].share);
        condense(&d, want);
        struct model *m = struck_model(i, "");
        const struct building *g = &m->building[1];
        const struct struck_column *c = m->column;
        const double row[] = {c->rest[0], c->rest[1], -1};
        for (int p = 0; p < KEPT; p++) {
            for (int q = 0; q < KEPT; q++) {
                const double own =
                    p < FLOORS && q < FLOORS ? parts_on_floors(g->part_stiffness, FLOORS, p, q) : 0;
                assert_near(own + c->stiffness * row[p] * row[q], want[p][q],
                            1e-11 * want[POINT][POINT]);
            }
        }
        model_free(m);
    }
}

// Forces by unit displacements of both floors and of the point.
static void forces_are_those_of_the_frame_with_a_node_there(void **state) {
    (void)state;
    for (int i = 0; i < N_PLACE; i++) {
        struct direct d;
        double k[KEPT][KEPT];
        build_direct(&d, places[i].storey, places[i].line, places[i].share);
        condense(&d, k);
        struct model *m = struck_model(i, "");
        const struct building *g = &m->building[1];
        const struct plane_frame *f = frame_of(&g->part[0]);
        const int struck = places[i].storey * (LINES + 2) + places[i].line;
        for (int j = 0; j < KEPT; j++) {
            double u[4] = {0}, drift[4] = {0}, force[128];
            assert_true(m->n_dof == 4 && g->n_force <= 128);
            u[1 + j] = 1;
            for (int p = 1; p < 4; p++) {
                drift[p] = u[p] - (p == 2 ? u[p - 1] : 0);
            }
            forces_at(g, drift + g->first, NULL, u, force);
            const double size = k[POINT][POINT];
            double low[2], high[2];
            end_moments(&d.member[places[i].storey * LINES + places[i].line], d.x[j], low);
            end_moments(&d.member[d.n - 1], d.x[j], high);
            const double below = places[i].share * height[places[i].storey];
            const double above = height[places[i].storey] - below;
            const double want[COLUMN_FORCE_COUNT] = {
                (low[0] + low[1]) / below, (high[0] + high[1]) / above, low[0], low[1], high[1]};
            for (enum column_force q = 0; q < COLUMN_FORCE_COUNT; q++) {
                assert_near(struck_column_force(m->column, q, u, 0), want[q] / 2, 1e-11 * size);
            }
            for (int n = 0; n < f->n_member; n++) {
                const int level = n / (LINES + 2), own = n % (LINES + 2);
                const int same = own < LINES ? level * LINES + own
                                             : FLOORS * LINES + level * (LINES - 1) + own - LINES;
                double moment[2];
                end_moments(&d.member[same], d.x[j], moment);
                moment[1] = n == struck ? high[1] : moment[1];
                const double shear = (moment[0] + moment[1]) / f->member[n].length;
                const double axial =
                    modulus * column_a / d.member[same].length *
                    (at(d.x[j], d.member[same].along[1]) - at(d.x[j], d.member[same].along[0]));
                const double got[] = {force[forces_of_members(g, 0, FRAME_MOMENT_I) + n],
                                      force[forces_of_members(g, 0, FRAME_MOMENT_J) + n],
                                      force[forces_of_members(g, 0, FRAME_SHEAR) + n],
                                      force[forces_of_members(g, 0, FRAME_NORMAL) + n]};
                assert_near(got[0], moment[0], 1e-11 * size);
                assert_near(got[1], moment[1], 1e-11 * size);
                assert_near(got[2], shear, 1e-11 * size);
                assert_near(got[3], own < LINES ? axial : 0, 1e-11 * size);
            }
        }
        model_free(m);
    }
}

// The floors and the point as a building of three floors with this matrix, in the order 1, point, 2
// or point, 1, 2.
static void a_run_is_that_of_the_matrix_with_the_point(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct direct d;
        double k[KEPT][KEPT];
        build_direct(&d, places[i].storey, places[i].line, places[i].share);
        condense(&d, k);
        const int point = places[i].storey, order[2][KEPT] = {{POINT, 0, 1}, {0, POINT, 1}};
        char text[512], deck[1024];
        size_t used = 0;
        for (int p = 0; p < KEPT; p++) {
            const int *o = order[point];
            const double *row = k[o[p]];
            used += (size_t)snprintf(text + used, sizeof text - used, "%.17g %.17g %.17g\n",
                                     row[o[0]], row[o[1]], row[o[2]]);
        }
        snprintf(deck, sizeof deck, frame, level_of(i));
        const char *const end = "initial A:1 -velocity 0.3\nduration 0.3\nstep fixed 50us\n";
        struct analysis got =
            analysis_of("units N m s\n%scolumn B@%.17gm -name c -line 1 -mass 600\n"
                        "contact A:1 B@%.17gm -gap 1mm -law hertz -k 5e9\n%s",
                        deck, level_of(i), level_of(i), end);
        struct analysis want =
            analysis_of("units N m s\nbuilding A -floors 1 -mass 90t -stiffness 30e6 -height 1m\n"
                        "building B -floors 3 -mass %s -height 1m\n"
                        "matrix B %s\ncontact A:1 B:%d -gap 1mm -law hertz -k 5e9\n%s",
                        point == 0 ? "600 60e3 60e3" : "60e3 600 60e3",
                        support_write("struck_frame.txt", text), point + 1, end);
        const struct results *r = got.results, *s = want.results;
        assert_int_equal(r->link[0].impacts, s->link[0].impacts);
        assert_true(r->link[0].force > 5e5);
        assert_close(r->link[0].force, s->link[0].force, 1e-9);
        assert_close(r->link[0].impulse, s->link[0].impulse, 1e-9);
        const int floors[] = {point == 0 ? 2 : 1, 3};
        for (int p = 0; p < FLOORS; p++) {
            assert_close(r->peak[PEAK_DISPLACEMENT][1 + p], s->peak[PEAK_DISPLACEMENT][floors[p]],
                         1e-9);
        }
        assert_true(r->residual_peak < 1e-11 * analysis_flow(&got));
        analysis_free(&got);
        analysis_free(&want);
    }
}

// Envelopes of members see the contact force: those of Newmark's steps and of Dormand & Prince's,
// and those of a column that yields, too. The first column has the moments of the struck column.
static struct analysis run_struck(const char *law, const char *steps, double most[64]) {
    char deck[1024];
    snprintf(deck, sizeof deck, frame, 2.0);
    struct analysis a =
        analysis_of("units N m s\n%scolumn B@2m %s -name c -line 1 -mass 600 %s\n"
                    "contact A:1 B@2m -gap 1mm -law hertz -k 5e9\ninitial A:1 -velocity 0.3\n"
                    "duration 0.2\n%s",
                    deck, law, *law ? "" : "-damping 5%", steps);
    const struct building *g = &a.model->building[1];
    assert_true(g->n_force <= 64);
    for (int i = 0; i < g->n_force; i++) {
        most[i] = fmax(a.results->force_max[g->force + i], -a.results->force_min[g->force + i]);
    }
    const struct column_peak *p = a.results->column[0];
    const int foot = g->force + forces_of_members(g, 0, FRAME_MOMENT_I);
    const int head = g->force + forces_of_members(g, 0, FRAME_MOMENT_J);
    assert_close(a.results->force_max[foot], p[COLUMN_MOMENT_BELOW].max, 1e-9);
    assert_close(a.results->force_min[foot], p[COLUMN_MOMENT_BELOW].min, 1e-9);
    assert_close(a.results->force_max[head], p[COLUMN_MOMENT_ABOVE].max, 1e-9);
    assert_close(a.results->force_min[head], p[COLUMN_MOMENT_ABOVE].min, 1e-9);
    return a;
}

static const char newmark[] = "step fixed 10us";
static const char dormand_prince[] = "integrator dormand-prince\nstep adaptive -tolerance 1e-9";

static void envelopes_of_members_have_the_force_on_the_column(void **state) {
    (void)state;
    static const char *const laws[] = {"", "bilinear -yield 60kN -hardening 2%"};
    for (int k = 0; k < 2; k++) {
        double most[2][64] = {{0}};
        struct analysis a = run_struck(laws[k], newmark, most[0]);
        struct analysis b = run_struck(laws[k], dormand_prince, most[1]);
        for (int i = 0; i < a.model->building[1].n_force; i++) {
            assert_close(most[1][i], most[0][i], 1e-3);
        }
        assert_true(a.results->residual_peak < 1e-11 * analysis_flow(&a));
        // The law limits the force on the point, and the floors have its shares.
        const struct link_peak *spring = &a.results->link[1];
        const double elastic = a.model->column->stiffness * spring->penetration;
        assert_true(elastic > 180e3);
        assert_close(spring->force, k ? 60e3 + 0.02 * (elastic - 60e3) : elastic, 1e-2);
        analysis_free(&a);
        analysis_free(&b);
    }
}

static void a_column_of_a_frame_that_never_yields_is_the_elastic_one(void **state) {
    (void)state;
    double most[2][64] = {{0}};
    struct analysis a = run_struck("bilinear -yield 1GN -hardening 2%", newmark, most[0]);
    struct analysis b = run_struck("elastic", newmark, most[1]);
    assert_close(a.results->link[0].force, b.results->link[0].force, 1e-9);
    for (int i = 0; i < a.model->building[1].n_force; i++) {
        assert_close(most[1][i], most[0][i], 1e-9);
    }
    analysis_free(&a);
    analysis_free(&b);
}

// Where joints cannot turn, the column is clamped.
static void in_a_frame_with_rigid_beams_it_is_clamped(void **state) {
    (void)state;
    struct model *m[2];
    for (int k = 0; k < 2; k++) {
        m[k] = analysis_model("units N m s\nbuilding B -floors 2 -mass 60t -height 3m\n"
                              "frame B -bays 6 -modulus 30e9 -columns-inextensible\n"
                              "columns B:1:2 -I 2e-3\nbeams B:1:2 -I 1e9\n"
                              "column B@3.9m -name c %s -mass 600 -damping 3%%\n"
                              "duration 1\nstep fixed 1ms\ninitial B:1 -displacement 1mm\n",
                              k ? "-line 2" : "-E 30e9 -I 2e-3");
    }
    const struct struck_column *clamped = m[0]->column, *framed = m[1]->column;
    assert_close(framed->stiffness, clamped->stiffness, 1e-9);
    assert_close(framed->dashpot, clamped->dashpot, 1e-9);
    assert_close(m[1]->displacement[2], m[0]->displacement[2], 1e-9);
    assert_int_equal(clamped->n_dof, 3);
    for (int dof = 0; dof < 3; dof++) {
        double u[3] = {0};
        u[dof] = 1;
        for (enum column_force q = 0; q < COLUMN_FORCE_COUNT; q++) {
            assert_near(struck_column_force(framed, q, u, 0), struck_column_force(clamped, q, u, 0),
                        1e-9 * clamped->stiffness);
        }
    }
    model_free(m[0]);
    model_free(m[1]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stiffness_of_floors_and_point_is_that_of_the_frame_with_a_node_there),
        cmocka_unit_test(forces_are_those_of_the_frame_with_a_node_there),
        cmocka_unit_test(a_run_is_that_of_the_matrix_with_the_point),
        cmocka_unit_test(envelopes_of_members_have_the_force_on_the_column),
        cmocka_unit_test(a_column_of_a_frame_that_never_yields_is_the_elastic_one),
        cmocka_unit_test(in_a_frame_with_rigid_beams_it_is_clamped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
