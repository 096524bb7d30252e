// SPDX-License-Identifier: Apache-2.0
#include "shaders/tests/lobeCase.h"

#include <cmath>
#include <cstdio>

namespace patina::test {

namespace {

std::string label(const char* lobe, double a, double b, double c, int mode) {
    static const char* const modes[] = {"", "R", "T", "RT"};
    char text[128];
    std::snprintf(text, sizeof text, "%s%s(%g, %g, %g)", lobe, modes[mode], a, b, c);
    return text;
}

void addDiffuse(std::vector<LobeCase>& cases) {
    for (double r : {0.0, 0.3, 1.0}) {
        cases.push_back(PATINA_LOBE_CASE(label("orenNayar", r, 0, 0, 0), orenNayar,
                                         vec3(0.8, 0.5, 0.1), r, false));
        cases.push_back(
            PATINA_LOBE_CASE(label("eon", r, 0, 0, 0), orenNayar, vec3(1.0, 0.5, 0.1), r, true));
        cases.push_back(
            PATINA_LOBE_CASE(label("burley", r, 0, 0, 0), burley, vec3(0.8, 0.5, 0.1), r));
    }
    for (LobeCase& c : cases)
        c.reciprocal = true;
    LobeCase t = PATINA_LOBE_CASE("translucent", translucent, vec3(0.8, 0.5, 0.1));
    t.twoSided = true;
    t.reciprocal = true;
    cases.push_back(t);
}

void addSheen(std::vector<LobeCase>& cases) {
    for (double r : {0.05, 0.3, 1.0})
        for (int mode : {0, 1}) {
            LobeCase c = PATINA_LOBE_CASE(label(mode == 0 ? "contyKulla" : "zeltner", r, 0, 0, 0),
                                          sheen, vec3(1.0, 0.5, 0.1), r, mode);
            // The bound on the albedo and the fit over wo alone are declared to break it.
            c.reciprocal = mode == 0 && r >= 0.3;
            cases.push_back(c);
        }
}

void addClassic(std::vector<LobeCase>& cases) {
    const vec3 color(1.0, 0.5, 0.1);
    const auto add = [&](LobeCase c, double alpha) {
        c.alpha = alpha;
        c.reciprocal = true;
        cases.push_back(c);
    };
    for (double n : {1.0, 30.0, 500.0}) {
        const double alpha = std::sqrt(2.0 / (n + 2.0));
        add(PATINA_LOBE_CASE(label("phong", n, 0, 0, 0), phong, vec3(color), n), alpha);
        add(PATINA_LOBE_CASE(label("blinnPhong", n, 0, 0, 0), blinnPhong, vec3(color), n), alpha);
    }
    const double alphas[][2] = {{0.05, 0.05}, {0.3, 0.3}, {1.0, 1.0}, {0.1, 0.4}};
    for (const auto& a : alphas) {
        for (int form : {0, 1})
            add(PATINA_LOBE_CASE(label(form ? "wardExact" : "wardBounded", a[0], a[1], 0, 0), ward,
                                 vec3(color), vec2(a[0], a[1]), form),
                a[0]);
        if (a[0] != a[1]) continue;
        for (int fresnel : {0, 1})
            add(PATINA_LOBE_CASE(label("cookTorrance", a[0], fresnel, 0, 0), cookTorrance,
                                 vec3(color), vec3(0.183, 0.421, 1.373), vec3(3.424, 2.346, 1.77),
                                 a[0], fresnel),
                a[0]);
    }
}

// Interfaces under a film: lobe PREFIX with its inputs, and film(lobe, thickness, ior).
void addFilm(std::vector<LobeCase>& cases, int compensate) {
    for (double thickness : {400.0})
        for (double alpha : {0.3}) {
            const vec2 a(alpha);
            LobeCase metal;
            metal.f32 = bindLobe<sh::vec3>(
                sh::conductorFilm(sh::conductorSetup(sh::vec3(0.183, 0.421, 1.373),
                                                     sh::vec3(3.424, 2.346, 1.77), sh::vec2(a),
                                                     false, compensate),
                                  float(thickness), 1.6f),
                sh::conductorEval, sh::conductorSample, sh::conductorAlbedo);
            metal.f64 =
                bindLobe<vec3>(sh64::conductorFilm(sh64::conductorSetup(vec3(0.183, 0.421, 1.373),
                                                                        vec3(3.424, 2.346, 1.77), a,
                                                                        false, compensate),
                                                   thickness, 1.6f),
                               sh64::conductorEval, sh64::conductorSample, sh64::conductorAlbedo);
            metal.name = label("film conductor", thickness, alpha, 0, 0);
            metal.alpha = alpha;
            metal.reciprocal = compensate == 0;
            cases.push_back(metal);
            for (double ior : {1.5, 0.75}) {
                LobeCase d =
                    PATINA_LOBE_CASE_AS(label("film dielectric", thickness, alpha, ior, 3),
                                        filmDielectric, schlick, vec3(1.0, 0.9, 0.2), ior,
                                        vec2(alpha), thickness, 1.33, false, 3, false, compensate);
                d.alpha = alpha * std::fabs(ior - 1.0);
                d.ior = ior;
                d.twoSided = true;
                d.reciprocal = compensate == 0;
                cases.push_back(d);
            }
        }
}

void addHair(std::vector<LobeCase>& cases) {
    for (double v : {0.02, 0.3})
        for (double cuticle : {0.5, 0.53}) {
            LobeCase c = PATINA_LOBE_CASE(label("chiangHair", v, cuticle, 0, 0), chiangHair,
                                          vec3(1.0, 0.9, 0.8), vec3(1.0), vec3(0.5, 1.0, 1.0), 1.55,
                                          vec2(v, 0.2), vec2(0.5 * v, 0.1), vec2(2.0 * v, 0.3),
                                          cuticle, vec3(0.1, 0.4, 1.2));
            c.alpha = 0.1;
            c.twoSided = true;
            cases.push_back(c);
        }
}

// Beckmann facets instead of GGX. Alpha 1 has no other paths than 0.3, and interfaces differ by
// mode only in what they leave out.
void addBeckmann(std::vector<LobeCase>& cases, int compensate) {
    const double alphas[][2] = {{0.05, 0.05}, {0.5, 0.5}, {0.1, 0.4}};
    for (const auto& a : alphas) {
        const double ax = a[0], ay = a[1];
        const auto add = [&](LobeCase c, double ior, bool transmits) {
            c.alpha = ax * (transmits ? std::min(1.0, std::fabs(ior - 1.0)) : 1.0);
            c.ior = ior;
            c.twoSided = transmits;
            c.reciprocal = compensate == 0;
            cases.push_back(c);
        };
        const int ndf = sh::NDF_BECKMANN;
        add(PATINA_LOBE_CASE_WITH(label("beckmann conductor", ax, ay, 0, 0), conductor, conductor,
                                  l.ndf = ndf, vec3(0.183, 0.421, 1.373), vec3(3.424, 2.346, 1.77),
                                  vec2(ax, ay), ax == 0.5, compensate),
            1.0, false);
        add(PATINA_LOBE_CASE_WITH(label("beckmann dielectric", ax, ay, 1.5, 3), dielectric,
                                  dielectric, l.ndf = ndf, vec3(1.0, 0.9, 0.2), 1.5, vec2(ax, ay),
                                  false, 3, false, compensate),
            1.5, true);
        add(PATINA_LOBE_CASE_WITH(label("beckmann schlick", ax, ay, 0.04, 3), schlick, schlick,
                                  l.ndf = ndf, vec3(0.02, 0.04, 0.06), vec3(0.9, 1.0, 0.5),
                                  vec3(1.0, 0.9, 1.0), 5.0, vec2(ax, ay), false, 3, false,
                                  compensate),
            1.5, true);
    }
}

} // namespace

std::vector<LobeCase> lobeCases(int compensate) {
    std::vector<LobeCase> cases;
    addDiffuse(cases);
    addSheen(cases);
    addClassic(cases);
    addFilm(cases, compensate);
    addHair(cases);
    addBeckmann(cases, compensate);
    const bool bare = compensate == 0;
    const double alphas[][2] = {{0.05, 0.05}, {0.3, 0.3}, {1.0, 1.0}, {0.1, 0.4}};
    for (const auto& a : alphas) {
        const double ax = a[0];
        const double ay = a[1];
        LobeCase metal =
            PATINA_LOBE_CASE(label("conductor", ax, ay, 0, 0), conductor, vec3(0.183, 0.421, 1.373),
                             vec3(3.424, 2.346, 1.77), vec2(ax, ay), ax == 0.3, compensate);
        metal.alpha = ax;
        metal.reciprocal = bare;
        cases.push_back(metal);
        for (int mode : {1, 2, 3}) {
            for (double ior : {1.05, 1.5, 0.75}) {
                LobeCase d = PATINA_LOBE_CASE(label("dielectric", ax, ay, ior, mode), dielectric,
                                              vec3(1.0, 0.9, 0.2), ior, vec2(ax, ay), false, mode,
                                              false, compensate);
                d.alpha = ax * (mode == 1 ? 1.0 : std::min(1.0, std::fabs(ior - 1.0)));
                d.ior = ior;
                d.twoSided = true;
                d.reciprocal = bare;
                cases.push_back(d);
            }
            LobeCase s =
                PATINA_LOBE_CASE(label("schlick", ax, ay, 0.04, mode), schlick,
                                 vec3(0.02, 0.04, 0.06), vec3(0.9, 1.0, 0.5), vec3(1.0, 0.9, 1.0),
                                 5.0, vec2(ax, ay), false, mode, false, compensate);
            s.alpha = ax * (mode == 1 ? 1.0 : 0.5);
            s.ior = (1.0 + std::sqrt(0.04)) / (1.0 - std::sqrt(0.04));
            s.twoSided = true;
            s.reciprocal = bare;
            cases.push_back(s);
        }
    }
    return cases;
}

vec3 direction(double z, double phi) {
    const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
    return vec3(r * std::cos(phi), r * std::sin(phi), z);
}

std::vector<vec3> outgoing(const LobeCase& c) {
    std::vector<vec3> wo = {direction(1.0, 0.0), direction(0.7071, 0.4), direction(0.1736, 1.9),
                            direction(0.01745, 5.0)};
    if (c.twoSided) {
        wo.push_back(direction(-0.95, 0.4));
        wo.push_back(direction(-0.75, 2.0));
        wo.push_back(direction(-0.2, 4.0));
    }
    return wo;
}

vec3 quasiRandom(int i) {
    const double n = i + 0.5;
    const auto wrap = [](double x) { return x - std::floor(x); };
    return vec3(wrap(n * 0.8191725133961645), wrap(n * 0.6710436067037893),
                wrap(n * 0.5497004779019703));
}

vec3 sampledAlbedo(const BoundLobe& lobe, vec3 wo, int count) {
    vec3 sum(0.0);
    for (int i = 0; i < count; ++i)
        sum += lobe.sample(wo, quasiRandom(i)).weight;
    return sum / double(count);
}

bool finiteAndPositive(vec3 v) {
    for (int i = 0; i < 3; ++i)
        if (!(v[i] >= 0.0) || std::isinf(v[i])) return false;
    return true;
}

} // namespace patina::test
