// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of links and contacts as uniaxial materials of the lengthening of a link. As in material.c,
// the numbers come from the forces of the law. A force k d^n (1 + q v / v0) at d = 1 tells k, and
// at v = v0 it tells q.
#include <math.h>
#include <string.h>

#include "export/opensees.h"
#include "law/bilateral.h"
#include "law/link_law.h"
#include "law/lists.h"
#include "law/maxwell.h"
#include "law/restitution.h"

// A yield force that no gap reaches.
static const double NEVER = 1e20;

// A rigid impact becomes a contact that lasts so many steps.
static const double RIGID_STEPS = 20.0;

// The response of a contact at the penetration d and velocity v, after it closed with v0.
static struct contact_response material_contact_at(const struct link *l, double v0, double d,
                                                   double v) {
    double history[CONTACT_HISTORY_MAX] = {0};
    if (l->law->close) {
        l->law->close(l->constant, v0, history);
    }
    return l->law->force(l->constant, history, d, v);
}

// The stiffness with which an impact of rigid bodies lasts RIGID_STEPS steps.
static double material_rigid(const struct opensees *x, const struct link *l) {
    return l->mass * pow(acos(-1.0) / (RIGID_STEPS * x->m->dt), 2.0);
}

double material_link_stiffness(const struct opensees *x, const struct link *l) {
    if (l->bilateral) {
        return fmax(l->constant[LINK_STIFFNESS], l->constant[LINK_DASHPOT]);
    }
    return l->law->force ? material_contact_at(l, 1.0, 1.0, 0.0).dfdd : material_rigid(x, l);
}

// k and n of a spring k d^n, from its forces at d and 2 d.
struct material_power {
    double k, n;
};

static struct material_power material_power_at(const struct link *l, double d) {
    const double once = material_contact_at(l, 1.0, d, 0.0).force;
    const double n = log2(material_contact_at(l, 1.0, 2.0 * d, 0.0).force / once);
    return (struct material_power){.k = once / pow(d, n), .n = n};
}

static int material_gap(struct opensees *x, const struct link *l) {
    emit_put(&x->to, "uniaxialMaterial", "winnn", "ElasticPPGap", ++x->material,
             material_contact_at(l, 1.0, 1.0, 0.0).force, -NEVER, -l->gap);
    return x->material;
}

static int material_dashpot(struct opensees *x, const struct link *l) {
    const double k = material_contact_at(l, 1.0, 1.0, 0.0).force;
    emit_put(&x->to, "uniaxialMaterial", "winnn", "ViscoelasticGap", ++x->material, k,
             material_contact_at(l, 1.0, 1.0, 1.0).force - k, -l->gap);
    return x->material;
}

static int material_hertz_damp(struct opensees *x, double k, double q, double gap, double n) {
    emit_put(&x->to, "uniaxialMaterial", "winnnn", "Hertzdamp", ++x->material, k, q, -gap, n);
    return x->material;
}

// The velocity of closure is above every -vmin.
static int material_family(struct opensees *x, const struct link *l) {
    static const double v0 = 1e6;
    const struct material_power s = material_power_at(l, 1.0);
    return material_hertz_damp(x, s.k, material_contact_at(l, v0, 1.0, v0).force / s.k - 1.0,
                               l->gap, s.n);
}

static int material_jankowski(struct opensees *x, const struct link *l) {
    const double k = material_contact_at(l, 1.0, 1.0, 0.0).force;
    const double xi = (material_contact_at(l, 1.0, 1.0, 1.0).force - k) / (2.0 * sqrt(k * l->mass));
    emit_put(&x->to, "uniaxialMaterial", "winnnnn", "JankowskiImpact", ++x->material, k, xi,
             l->mass, -l->gap, 1.5);
    return x->material;
}

// k1 up to dy and k2 beyond: the force far beyond is k1 dy + k2 (d - dy).
static int material_bilinear(struct opensees *x, const struct link *l) {
    const double k1 = material_contact_at(l, 1.0, 0.0, 0.0).dfdd, far = 1e3;
    const struct contact_response r = material_contact_at(l, 1.0, far, 0.0);
    emit_put(&x->to, "uniaxialMaterial", "winnnn", "ImpactMaterial", ++x->material, k1, r.dfdd,
             -(r.force - r.dfdd * far) / (k1 - r.dfdd), -l->gap);
    return x->material;
}

// A spring k d^n that has the force of the law at a hundredth of the unit of length, and the
// damping with which it delivers e.
static int material_nearest_contact(struct opensees *x, const struct link *l) {
    const double e = l->restitution, small = 1e-2;
    const struct material_power s = material_power_at(l, small);
    return material_hertz_damp(x, s.k, e > 0.0 && e < 1.0 ? restitution_exact_q(e) : 0.0, l->gap,
                               s.n);
}

static int material_rigid_impact(struct opensees *x, const struct link *l) {
    const double k = material_rigid(x, l), e = fmax(l->restitution, restitution_range.min);
    emit_put(&x->to, "uniaxialMaterial", "winnn", "ViscoelasticGap", ++x->material, k,
             2.0 * restitution_kelvin_voigt(e) * sqrt(k * l->mass), -l->gap);
    return x->material;
}

// The material of a contact law. Laws that are not in the list get the nearest material. `note`:
// how the material differs; NULL: it does not.
struct material_contact {
    const struct contact_law *law;
    int (*write)(struct opensees *x, const struct link *l);
    const char *note;
};
static const struct material_contact material_contacts[] = {
    {&contact_linear, material_gap, NULL},
    {&contact_kelvin_voigt, material_dashpot, NULL},
    {&contact_komodromos, material_dashpot, "ViscoelasticGap, which pulls before the bodies part"},
    {&contact_hertz, material_family, NULL},
    {&contact_ye_kelvin, material_family, NULL},
    {&contact_power, material_family, NULL},
    {&contact_hertz_damp, material_family, NULL},
    {&contact_lankarani_nikravesh, material_family, NULL},
    {&contact_ye_hertz_damp, material_family, NULL},
    {&contact_hunt_crossley, material_family, NULL},
    {&contact_jankowski, material_jankowski, NULL},
    {&contact_bilinear, material_bilinear, NULL},
    {&contact_stereomechanical, material_rigid_impact,
     "ViscoelasticGap with the same restitution, an impact of 20 steps"},
};

static int material_contact(struct opensees *x, const struct link *l) {
    for (size_t i = 0; i < sizeof material_contacts / sizeof material_contacts[0]; i++) {
        const struct material_contact *c = &material_contacts[i];
        if (c->law == l->law) {
            if (c->note) {
                opensees_note(x, "%s: the law %s is %s", l->name, l->law->name, c->note);
            }
            return c->write(x, l);
        }
    }
    opensees_note(x, "%s: the law %s is Hertzdamp, a spring of about its force", l->name,
                  l->law->name);
    return material_nearest_contact(x, l);
}

// A spring and a damper of any exponent, side by side.
static int material_viscous(struct opensees *x, const struct link *l) {
    const double *c = l->constant;
    if (isfinite(c[BILATERAL_RELIEF])) {
        opensees_note(x, "%s: its damper has no valve", l->name);
    }
    int material[2], n = 0;
    emit_put(&x->to, "uniaxialMaterial", "winn", "Viscous", ++x->material, c[LINK_DASHPOT],
             c[LINK_EXPONENT]);
    material[n++] = x->material;
    if (c[LINK_STIFFNESS] != 0.0) {
        emit_put(&x->to, "uniaxialMaterial", "win", "Elastic", ++x->material, c[LINK_STIFFNESS]);
        material[n++] = x->material;
    }
    return material_parallel(x, material, n);
}

// A link that is slack, or acts in one direction: a gap for each direction, in which yielding
// grows.
static int material_slack(struct opensees *x, const struct link *l) {
    static const double fresh[CONTACT_HISTORY_MAX + STOREY_HISTORY_MAX];
    const struct link_storey s = link_law_storey(l->constant, fresh);
    const double slack = isnan(l->value[LINK_ROW_SLACK]) ? 0.0 : l->value[LINK_ROW_SLACK];
    int material[2], n = 0;
    if (s.law != &storey_elastic) {
        opensees_note(x, "%s: the law %s with slack is ElasticPPGap, bilinear in each direction",
                      l->name, s.law->name);
    }
    for (int sign = -1; sign <= 1; sign += 2) {
        const double yield = material_yield(x, s.law, s.constant, sign);
        const double k = l->constant[LINK_STIFFNESS];
        // Beyond, a law may have lost its strength.
        const double tight = slack + (isfinite(yield) ? yield / k : 1.0), far = slack + 1e3;
        if (l->law->force(l->constant, fresh, -sign * tight, 0.0).force != 0.0) {
            const struct contact_response r = l->law->force(l->constant, fresh, -sign * far, 0.0);
            emit_put(&x->to, "uniaxialMaterial", "winnnnw", "ElasticPPGap", ++x->material, k,
                     sign * fmin(yield, NEVER), sign * slack, isfinite(yield) ? r.dfdd / k : 0.0,
                     "damage");
            material[n++] = x->material;
        }
    }
    return material_parallel(x, material, n);
}

int material_link(struct opensees *x, const struct link *l) {
    static const double fresh[CONTACT_HISTORY_MAX + STOREY_HISTORY_MAX];
    if (!l->bilateral) {
        return material_contact(x, l);
    }
    if (l->law == &bilateral_law) {
        return material_viscous(x, l);
    }
    if (l->law == &maxwell_law) {
        emit_put(&x->to, "uniaxialMaterial", "winnn", "ViscousDamper", ++x->material,
                 l->constant[LINK_STIFFNESS], l->value[MAXWELL_DASHPOT],
                 l->value[MAXWELL_EXPONENT]);
        return x->material;
    }
    if (link_law_is_slack(l->constant)) {
        return material_slack(x, l);
    }
    const struct link_storey s = link_law_storey(l->constant, fresh);
    return material_storey(x, s.law, s.constant, l->name, l);
}
