// SPDX-License-Identifier: GPL-3.0-or-later
// Isolated impacts: closed forms, an independent integration of every law, and what the published
// relations deliver.
#include <gsl/gsl_errno.h>
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "support/impact.h"
#include "support/support.h"

static const double MASS = 15384.615384615385;  // 25 t against 40 t
static const double V0 = 0.5;

static void a_linear_spring_gives_half_a_period(void **state) {
    (void)state;
    struct isolated_impact i = impact_under("linear", "k 93.5e6", MASS, V0);
    double omega = sqrt(93.5e6 / MASS);
    assert_close(i.restitution, 1.0, 1e-11);
    assert_close(i.max_penetration, V0 / omega, 1e-11);
    assert_close(i.peak_force, V0 * sqrt(93.5e6 * MASS), 1e-11);
    assert_close(i.duration, M_PI / omega, 1e-11);
    assert_close(i.impulse, 2.0 * MASS * V0, 1e-11);
    assert_near(i.dissipated, 0.0, 1e-10 * MASS * V0 * V0);
}

static void hertz_gives_its_closed_forms(void **state) {
    (void)state;
    struct isolated_impact i = impact_under("hertz", "k 2.75e9", MASS, V0);
    double energy = 1.25 * MASS * V0 * V0;
    double depth = pow(energy / 2.75e9, 0.4);
    assert_close(i.restitution, 1.0, 1e-11);
    assert_close(i.max_penetration, depth, 1e-11);
    assert_close(i.peak_force, pow(2.75e9, 0.4) * pow(energy, 0.6), 1e-11);
    // 2 times the integral of 1 / sqrt(1 - x^2.5) from 0 to 1: (4/5) B(2/5, 1/2).
    double integral = 0.8 * tgamma(0.4) * tgamma(0.5) / tgamma(0.9);
    assert_close(i.duration, integral * depth / V0, 1e-10);
    assert_close(integral, 2.943275, 1e-6);
}

// x = exp(-zeta t) sin(s t) / s, in units of the undamped frequency; the tension is kept.
static void kelvin_voigt_is_a_damped_half_wave(void **state) {
    (void)state;
    const double ratio[] = {0.01, 0.2, 0.5, 0.9};
    for (int k = 0; k < 4; k++) {
        double z = ratio[k];
        double s = sqrt(1.0 - z * z);
        char text[64];
        snprintf(text, sizeof text, "k 1 zeta %.17g", z);
        struct isolated_impact i = impact_under("kelvin-voigt", text, 1.0, 1.0);
        assert_close(i.restitution, exp(-z * M_PI / s), 1e-10);
        assert_close(i.duration, M_PI / s, 1e-11);
        assert_close(i.max_penetration, exp(-z / s * atan2(s, z)), 1e-11);
        // F = x + 2 zeta x' is largest at closure where zeta >= 1/2; else where its rate is zero.
        double t = z >= 0.5 ? 0.0 : atan2(s * (1.0 - 4.0 * z * z), z * (3.0 - 4.0 * z * z)) / s;
        double x = exp(-z * t) * sin(s * t) / s;
        double v = exp(-z * t) * (cos(s * t) - z / s * sin(s * t));
        assert_close(i.peak_force, x + 2.0 * z * v, 1e-11);
    }
}

// The steps of the integration do not end at kinks of a force within a phase, but its tolerance
// makes them so short there that eleven digits stay.
static void kinks_of_the_force_cost_no_digits(void **state) {
    (void)state;
    const double k1 = 560e6, k2 = 60e6, yield = 5e-4;
    for (int i = 0; i < 20; i++) {
        const double v = 0.2 + 0.07 * i;
        const double energy = 0.5 * MASS * v * v;
        struct isolated_impact b = impact_under("bilinear", "k1 560e6 k2 60e6 dy 5e-4", MASS, v);
        // k1 dy^2 / 2 + k1 dy x + k2 x^2 / 2 = energy, of which (k1 - k2) dy x is lost.
        const double rest = energy - 0.5 * k1 * yield * yield;
        const double x =
            2.0 * rest / (k1 * yield + sqrt(k1 * yield * k1 * yield + 2.0 * k2 * rest));
        assert_close(b.max_penetration, yield + x, 2e-11);
        assert_close(b.restitution, sqrt(1.0 - (k1 - k2) * yield * x / energy), 2e-11);

        // F = 0 ends the pull of the dashpot where tan(s t) = 2 z s / (z^2 - s^2); then d falls
        // evenly.
        const double z = 0.3 + 0.03 * i, s = sqrt(1.0 - z * z);
        char text[64];
        snprintf(text, sizeof text, "k 1 zeta %.17g", z);
        struct isolated_impact c = impact_under("komodromos", text, 1.0, 1.0);
        const double t = atan2(2.0 * z * s, z * z - s * s) / s;
        const double d = exp(-z * t) * sin(s * t) / s;
        const double e = -exp(-z * t) * (cos(s * t) - z / s * sin(s * t));
        assert_close(c.restitution, e, 2e-11);
        assert_close(c.duration, t + d / e, 2e-11);
    }
}

// Facts from an independent integration: Dormand-Prince 8(5,3), relative tolerance 1e-12, every
// switch located; 25 t at 0.5 m/s against 40 t at rest. SI.
static const struct {
    const char *law, *parameters;
    double restitution, peak_force, duration, max_penetration, impulse, dissipated;
} row[] = {
    {"linear", "k 93500000.0", 1, 599679.40152667, 0.0402983615474933, 0.00641368343878791,
     15384.6153846154, 1.83475457049553e-12},
    {"hertz", "k 2750000000.0", 1.00000000000159, 965817.513962465, 0.029302350099333,
     0.00497784751072327, 15384.6153846276, -6.1058963384473e-09},
    {"kelvin-voigt", "k 93500000.0 e 0.4", 0.400000000000001, 486173.667814422, 0.0419774343532815,
     0.00440641048001796, 10769.2307692308, 1615.38461538461},
    {"kelvin-voigt", "k 93500000.0 e 0.65", 0.649999999999999, 511353.857270238, 0.0406754535954706,
     0.00526840849156078, 12692.3076923077, 1110.57692307693},
    {"kelvin-voigt", "k 93500000.0 e 0.9", 0.900000000000001, 570827.983697066, 0.040321017971104,
     0.00609139924349111, 14615.3846153846, 365.384615384612},
    {"komodromos", "k 93500000.0 e 0.4", 0.472013980170598, 486173.667814422, 0.0415767455650412,
     0.00440641048001796, 11323.1844628508, 1494.62077408367},
    {"komodromos", "k 93500000.0 e 0.65", 0.674751472505317, 511353.857270238, 0.0406319290886212,
     0.00526840849156078, 12882.7036346563, 1047.52009683059},
    {"komodromos", "k 93500000.0 e 0.9", 0.902026068717015, 570827.983697066, 0.0403203733291898,
     0.00609139924349111, 14630.9697593617, 358.363406451782},
    {"mahmoud-jankowski", "k 93500000.0 e 0.4", 0.407076199888987, 1025244.43921718,
     0.0336357189534824, 0.00261085788155271, 10823.6630760691, 1604.40186054604},
    {"mahmoud-jankowski", "k 93500000.0 e 0.65", 0.653787390424622, 491492.621276959,
     0.0369733382830088, 0.00419318535845477, 12721.4414648048, 1101.08086177262},
    {"mahmoud-jankowski", "k 93500000.0 e 0.9", 0.900392328428273, 545240.750573492,
     0.039450132141425, 0.00577483136525212, 14618.4025263713, 364.026259437525},
    {"ye-kelvin", "k 93500000.0 e 0.4", 0.379646382208992, 674364.761001624, 0.0439541678047772,
     0.00417258002417103, 10612.6644785307, 1645.90120091466},
    {"ye-kelvin", "k 93500000.0 e 0.65", 0.645714575160629, 577235.048102639, 0.0410255993204357,
     0.00521485798543898, 12659.342885851, 1121.25516812525},
    {"ye-kelvin", "k 93500000.0 e 0.9", 0.899899943072231, 576295.167254091, 0.0403404036186834,
     0.00608844402582387, 14614.6149467095, 365.730947035758},
    {"hunt-crossley", "k 93500000.0 e 0.4 n 1", 0.4, 662327.722605321, 0.0435595007130028,
     0.00426028740074989, 10769.2307692308, 1615.38461538462},
    {"hunt-crossley", "k 93500000.0 e 0.65 n 1", 0.65, 576528.531980323, 0.0410036384478105,
     0.00523031218163262, 12692.3076923077, 1110.57692307692},
    {"hunt-crossley", "k 93500000.0 e 0.9 n 1", 0.9, 576311.755005567, 0.0403403149987712,
     0.00608877358895436, 14615.3846153846, 365.384615384614},
    {"hertz-damp", "k 2750000000.0 e 0.4", 0.70163472767532, 873014.909767461, 0.0307102370489115,
     0.00434695818073728, 13089.4979051948, 976.362901769185},
    {"hertz-damp", "k 2750000000.0 e 0.65", 0.774819081180936, 881019.76027558, 0.0302393063136758,
     0.00450949418910903, 13652.4544706226, 768.568060457558},
    {"hertz-damp", "k 2750000000.0 e 0.9", 0.913176677806588, 922183.614896411, 0.0295920703973449,
     0.00480222526472013, 14716.7436754353, 319.439144442546},
    {"ye-hertz-damp", "k 2750000000.0 e 0.4", 0.362872318509711, 959391.795197087,
     0.0355993579922772, 0.0034792103930023, 10483.6332193055, 1669.85323165265},
    {"ye-hertz-damp", "k 2750000000.0 e 0.65", 0.630329684881092, 873941.609851408,
     0.0312900308792034, 0.00418230951886575, 12540.9975760084, 1159.00863145711},
    {"ye-hertz-damp", "k 2750000000.0 e 0.9", 0.893920692664142, 914359.054790726,
     0.0296669636545225, 0.00476248888561441, 14568.6207128011, 386.357298513197},
    {"hunt-crossley", "k 2750000000.0 e 0.4", 0.400000000000476, 938274.72418337,
     0.0346617860819494, 0.00358844827237456, 10769.2307692344, 1615.38461538386},
    {"hunt-crossley", "k 2750000000.0 e 0.65", 0.650000000001525, 872837.795218776,
     0.0311160435113694, 0.00422841554848186, 12692.3076923194, 1110.5769230731},
    {"hunt-crossley", "k 2750000000.0 e 0.9", 0.900000000002407, 916755.735999634,
     0.0296428582105151, 0.00477506658734831, 14615.3846154031, 365.384615376288},
    {"jankowski", "k 2750000000.0 e 0.4", 0.392976517317825, 960836.627706993, 0.0288044207019958,
     0.00235795150045688, 10715.2039793679, 1626.09510930147},
    {"jankowski", "k 2750000000.0 e 0.65", 0.647029026882227, 692516.74167309, 0.0289959527745732,
     0.00351382881518338, 12669.4540529402, 1117.98738148432},
    {"jankowski", "k 2750000000.0 e 0.9", 0.899723312117764, 857832.811523644, 0.0292186899878425,
     0.00457434342932688, 14613.2562470597, 366.342233907399},
    {"khatami", "k 2750000000.0 e 0.4", 0.998182342929366, 967224.23537298, 0.0292863735533314,
     0.00497060777828531, 15370.633407149, 6.984635123169},
    {"khatami", "k 2750000000.0 e 0.65", 0.998789730632073, 966753.653171038, 0.0292917118381469,
     0.00497302729803124, 15375.3056202467, 4.65206535368801},
    {"khatami", "k 2750000000.0 e 0.9", 0.999621905567537, 966109.749587736, 0.0292990264665179,
     0.00497634177663828, 15381.7069659041, 1.45393444140627},
    {"jankowski", "k 2750000000.0 zeta 0.14", 0.833260231671849, 796580.477682684,
     0.0291613635013913, 0.00430195747013272, 14102.0017820911, 587.841127527275},
    {"jankowski", "k 2750000000.0 zeta 0.35", 0.661787654844286, 695436.270576524,
     0.0290090917764942, 0.00357780377243843, 12782.9819603407, 1080.84057672252},
    {"jankowski", "k 2750000000.0 zeta 0.99", 0.398155647052393, 947888.830677093,
     0.0288067099269161, 0.00238277970421282, 10755.0434388646, 1618.21553984673},
    {"wang", "k 2750000000.0 zeta 0.0 residual 0.0", 1.00000000000159, 965817.513962465,
     0.029302350099333, 0.00497784751072327, 15384.6153846276, -6.10936393687457e-09},
    {"wang", "k 2750000000.0 zeta 0.0 residual 0.25", 0.86602540378617, 965817.513962465,
     0.0302134264382657, 0.00497784751072327, 14354.0415675859, 480.769230763481},
    {"wang", "k 2750000000.0 zeta 0.0 residual 0.5", 0.707106781187738, 965817.513962465,
     0.032050859740715, 0.00497784751072327, 13131.5906245211, 961.538461535245},
    {"wang", "k 2750000000.0 zeta 2750000000.0 residual 0.0", 0.869643107913639, 877068.502804263,
     0.0287718471709167, 0.0044515825982292, 14381.8700608742, 468.693970881361},
    {"wang", "k 2750000000.0 zeta 2750000000.0 residual 0.25", 0.753133023677126, 877068.502804263,
     0.0297087327541074, 0.0044515825982292, 13485.6386436702, 832.289708936451},
    {"wang", "k 2750000000.0 zeta 2750000000.0 residual 0.5", 0.614930538816398, 877068.502804263,
     0.0315982174191908, 0.0044515825982292, 12422.54260628, 1195.88544698266},
    {"wang", "k 2750000000.0 zeta 5500000000.0 residual 0.0", 0.783393667884007, 877730.449260747,
     0.0284259889121084, 0.00409473342832831, 13718.412829877, 742.873771383157},
    {"wang", "k 2750000000.0 zeta 5500000000.0 residual 0.25", 0.678438817552367, 877730.449260747,
     0.0293826514255555, 0.00409473342832831, 12911.0678273259, 1037.92455930413},
    {"wang", "k 2750000000.0 zeta 5500000000.0 residual 0.5", 0.553942974906531, 877730.449260747,
     0.0313120216508783, 0.00409473342832831, 11953.407499281, 1332.97534721482},
    {"wang", "k 2750000000.0 zeta 16500000000.0 residual 0.0", 0.598833243136729, 999538.617529389,
     0.0277138369052604, 0.0033028306762218, 12298.7172548979, 1233.45912868144},
    {"wang", "k 2750000000.0 zeta 16500000000.0 residual 0.25", 0.518604801186832, 999538.617529389,
     0.0287233073023035, 0.0033028306762218, 11681.5753937449, 1405.8635772807},
    {"wang", "k 2750000000.0 zeta 16500000000.0 residual 0.5", 0.423439047023107, 999538.617529389,
     0.0307591789917284, 0.0033028306762218, 10949.531130947, 1578.26802587724},
    {"bilinear", "k1 845940811.1247536 k2 121587823.00569856 dy 0.0004977847510723812",
     0.660030334988637, 787071.155170052, 0.0275965726036874, 0.00350774668669479, 12769.4641152972,
     1085.30760941305},
    {"bilinear", "k1 741944417.8305178 k2 17591429.711462796 dy 0.0004977847510723812", 0.4,
     448139.326478658, 0.0505732483068391, 0.00497784751072381, 10769.2307692308, 1615.38461538461},
    {"bilinear", "k1 642216533.2162695 k2 144223853.88441902 dy 0.0004977847510723812",
     0.757686779762259, 796212.91361954, 0.0278917538640391, 0.00380186589759202, 13520.6675366328,
     819.059122641343},
    {"bilinear", "k1 558592567.712882 k2 60599888.38103167 dy 0.0004977847510723812",
     0.650000000000001, 549550.165444733, 0.0397663592119084, 0.00497784751072381, 12692.3076923077,
     1110.57692307692},
    {"bilinear", "k1 341480694.3989831 k2 177638947.08633974 dy 0.0004977847510723812",
     0.917197404126201, 834919.308692619, 0.0280238829166507, 0.00424096966148514, 14747.6723394323,
     305.286388200305},
    {"bilinear", "k1 287930312.7773244 k2 124088565.46468101 dy 0.0004977847510723812",
     0.899999999999999, 699251.880108939, 0.0332744422220059, 0.00497784751072381, 14615.3846153846,
     365.38461538462},
};

static void every_law_agrees_with_an_independent_integration(void **state) {
    (void)state;
    const double tolerance = 1e-8;
    for (size_t k = 0; k < sizeof row / sizeof row[0]; k++) {
        struct isolated_impact i = impact_under(row[k].law, row[k].parameters, MASS, V0);
        assert_close(i.restitution, row[k].restitution, tolerance);
        assert_close(i.peak_force, row[k].peak_force, tolerance);
        assert_close(i.duration, row[k].duration, tolerance);
        assert_close(i.max_penetration, row[k].max_penetration, tolerance);
        assert_close(i.impulse, row[k].impulse, tolerance);
        assert_near(i.dissipated, row[k].dissipated, tolerance * MASS * V0 * V0 / 2.0);
    }
}

// What isolated.h promises.
static void durations_alone_are_right_to_six_digits(void **state) {
    (void)state;
    for (size_t k = 0; k < sizeof row / sizeof row[0]; k++) {
        double value[CONTACT_ROWS_MAX], constant[CONTACT_CONSTANTS_MAX], duration;
        struct error e;
        const struct contact_law *law = impact_law(row[k].law, row[k].parameters, value);
        assert_int_equal(law->prepare(value, MASS, constant, &e), STATUS_OK);
        assert_int_equal(isolated_duration(law, constant, MASS, V0, &duration, &e), STATUS_OK);
        assert_close(duration, row[k].duration, 1e-6);
    }
}

// To the four digits that the descriptions of the laws quote.
static void the_published_relations_deliver_what_is_said_of_them(void **state) {
    (void)state;
    static const double asked[] = {0.40, 0.65, 0.90};
    static const struct {
        const char *law, *more;
        double delivered[3];
    } table[] = {
        {"kelvin-voigt", "", {0.4000, 0.6500, 0.9000}},
        {"hunt-crossley", "", {0.4000, 0.6500, 0.9000}},
        {"hunt-crossley", " n 1", {0.4000, 0.6500, 0.9000}},
        {"power", " n 2.2", {0.4000, 0.6500, 0.9000}},
        {"komodromos", "", {0.4720, 0.6748, 0.9020}},
        {"mahmoud-jankowski", "", {0.4071, 0.6538, 0.9004}},
        {"mahmoud-jankowski", " relation 2011", {0.4071, 0.6538, 0.9004}},
        {"mahmoud-jankowski", " relation 2008", {0.4706, 0.6848, 0.9037}},
        {"ye-kelvin", "", {0.3796, 0.6457, 0.8999}},
        {"hertz-damp", "", {0.7016, 0.7748, 0.9132}},
        {"lankarani-nikravesh", "", {0.7016, 0.7748, 0.9132}},
        {"ye-hertz-damp", "", {0.3629, 0.6303, 0.8939}},
        {"jankowski", "", {0.3930, 0.6470, 0.8997}},
        {"khatami", "", {0.9982, 0.9988, 0.9996}},
        {"rubber", " n 2.5", {0.4000, 0.6500, 0.9000}},
        {"rubber", " n 2.5 du 1e-3 ky 1e8", {0.4000, 0.6500, 0.9000}},
        {"wang", " residual 0.1", {0.4000, 0.6500, 0.9000}},
    };
    for (size_t k = 0; k < sizeof table / sizeof table[0]; k++) {
        for (int i = 0; i < 3; i++) {
            char text[64];
            snprintf(text, sizeof text, "k 1e9 e %.17g%s", asked[i], table[k].more);
            double e = impact_under(table[k].law, text, MASS, V0).restitution;
            assert_near(e, table[k].delivered[i], 0.6e-4);
        }
    }
}

struct seen {
    int n;
    struct isolated_point first, last;
    double deepest, work;
    int n_sample;
    double error, rate_error;  // of samples, over the peak
};

static void look(void *context, const struct isolated_point *p) {
    struct seen *s = context;
    if (s->n == 0) {
        s->first = *p;
    } else {
        assert_true(p->time >= s->last.time);
        s->work += (p->force + s->last.force) / 2.0 * (p->penetration - s->last.penetration);
    }
    s->deepest = fmax(s->deepest, p->penetration);
    s->last = *p;
    s->n++;
}

static void an_observer_sees_the_whole_impact(void **state) {
    (void)state;
    double value[CONTACT_ROWS_MAX], constant[CONTACT_CONSTANTS_MAX];
    struct isolated_impact i;
    struct seen seen = {0};
    struct error e;
    const struct contact_law *law = impact_law("jankowski", "k 2.75e9 e 0.65", value);
    assert_int_equal(law->prepare(value, MASS, constant, &e), STATUS_OK);
    const struct isolated_observer observer = {.point = look, .context = &seen};
    assert_int_equal(isolated_run(law, constant, MASS, V0, &observer, &i, &e), STATUS_OK);
    assert_true(seen.n > 100);
    assert_true(seen.first.time == 0.0 && seen.first.penetration == 0.0);
    assert_true(seen.first.velocity == V0 && seen.first.force == 0.0);
    assert_true(seen.last.time == i.duration && seen.deepest == i.max_penetration);
    assert_near(seen.last.penetration, 0.0, 1e-15 * seen.deepest);
    assert_close(seen.last.velocity, -V0 * i.restitution, 1e-14);
    assert_close(seen.work, i.dissipated, 1e-3);  // trapezoidal rule over 150 points
}

// Half a sine, F = v0 sqrt(k m) sin(omega t).
static void compare(void *context, int i, const struct isolated_point *p) {
    struct seen *s = context;
    double omega = sqrt(93.5e6 / MASS);
    double peak = V0 * sqrt(93.5e6 * MASS);
    assert_int_equal(i, s->n_sample);
    s->error = fmax(s->error, fabs(p->force - peak * sin(omega * p->time)) / peak);
    s->rate_error = fmax(s->rate_error, fabs(p->rate / omega - peak * cos(omega * p->time)) / peak);
    s->n_sample++;
}

static void samples_lie_on_the_force_at_their_instants(void **state) {
    (void)state;
    const double duration = M_PI / sqrt(93.5e6 / MASS);
    double value[CONTACT_ROWS_MAX], constant[CONTACT_CONSTANTS_MAX], time[1000];
    struct isolated_impact i;
    struct seen seen = {0};
    struct error e;
    for (int k = 0; k < 1000; k++) {
        time[k] = 1e-9 + k * duration / 900.0;  // the last hundred come after the opening
    }
    const struct contact_law *law = impact_law("linear", "k 93.5e6", value);
    assert_int_equal(law->prepare(value, MASS, constant, &e), STATUS_OK);
    struct isolated_observer observer = {.point = look, .context = &seen};
    assert_int_equal(isolated_run(law, constant, MASS, V0, &observer, &i, &e), STATUS_OK);
    const int n = seen.n;
    observer = (struct isolated_observer){look, &seen, compare, time, 1000};
    seen = (struct seen){0};
    assert_int_equal(isolated_run(law, constant, MASS, V0, &observer, &i, &e), STATUS_OK);
    assert_int_equal(seen.n, n);
    assert_int_equal(seen.n_sample, 900);
    assert_near(seen.error, 0.0, 1e-11);
    assert_near(seen.rate_error, 0.0, 1e-11);
}

// Bodies glued together by an overdamped dashpot that pulls approach d = 0 for ever.
static void bodies_that_do_not_part_are_an_error(void **state) {
    (void)state;
    double value[CONTACT_ROWS_MAX], constant[CONTACT_CONSTANTS_MAX];
    struct isolated_impact i;
    struct error e = {0};
    const struct contact_law *law = impact_law("kelvin-voigt", "k 1 zeta 2", value);
    assert_int_equal(law->prepare(value, 1.0, constant, &e), STATUS_OK);
    assert_int_equal(isolated_run(law, constant, 1.0, 1.0, NULL, &i, &e), STATUS_FAILED);
    assert_non_null(strstr(e.message, "under kelvin-voigt the bodies have not separated "));
}

static void scales_of_bodies_and_units_do_not_matter(void **state) {
    (void)state;
    struct isolated_impact a = impact_under("jankowski", "k 1 e 0.5", 1.0, 1.0);
    struct isolated_impact b = impact_under("jankowski", "k 1e13 e 0.5", 1e-3, 1e-4);
    struct isolated_impact c = impact_under("jankowski", "k 1e-6 e 0.5", 1e8, 1e3);
    assert_close(b.restitution, a.restitution, 1e-11);
    assert_close(c.restitution, a.restitution, 1e-11);
}

int main(void) {
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_linear_spring_gives_half_a_period),
        cmocka_unit_test(hertz_gives_its_closed_forms),
        cmocka_unit_test(kelvin_voigt_is_a_damped_half_wave),
        cmocka_unit_test(kinks_of_the_force_cost_no_digits),
        cmocka_unit_test(every_law_agrees_with_an_independent_integration),
        cmocka_unit_test(durations_alone_are_right_to_six_digits),
        cmocka_unit_test(the_published_relations_deliver_what_is_said_of_them),
        cmocka_unit_test(an_observer_sees_the_whole_impact),
        cmocka_unit_test(samples_lie_on_the_force_at_their_instants),
        cmocka_unit_test(bodies_that_do_not_part_are_an_error),
        cmocka_unit_test(scales_of_bodies_and_units_do_not_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
