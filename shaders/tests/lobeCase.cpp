// SPDX-License-Identifier: Apache-2.0
#include "shaders/tests/lobeCase.h"

#include <cstdio>

#include <gtest/gtest.h>

namespace patina::test {

namespace {

const double ggxAlphas[][2] = {{0.05, 0.05}, {0.3, 0.3}, {1.0, 1.0}, {0.1, 0.4}};

std::string label(const char* lobe, double a, double b, double c, int mode) {
    static const char* const modes[] = {"", "R", "T", "RT"};
    char text[128];
    std::snprintf(text, sizeof text, "%s%s(%g, %g, %g)", lobe, modes[mode], a, b, c);
    return text;
}

/// A case with what it is declared to be.
LobeCase declared(LobeCase c, double alpha, bool reciprocal, double ior = 1.0,
                  bool twoSided = false) {
    c.alpha = alpha;
    c.ior = ior;
    c.twoSided = twoSided;
    c.reciprocal = reciprocal;
    return c;
}

using Cases = std::vector<LobeCase>;

void addDiffuse(Cases& cases) {
    for (double r : {0.0, 0.3, 1.0})
        for (const LobeCase& c :
             {PATINA_LOBE_CASE(label("orenNayar", r, 0, 0, 0), orenNayar, vec3(0.8, 0.5, 0.1), r,
                               false),
              PATINA_LOBE_CASE(label("eon", r, 0, 0, 0), orenNayar, vec3(1.0, 0.5, 0.1), r, true),
              PATINA_LOBE_CASE(label("burley", r, 0, 0, 0), burley, vec3(0.8, 0.5, 0.1), r)})
            cases.push_back(declared(c, 1.0, true));
    cases.push_back(declared(PATINA_LOBE_CASE("translucent", translucent, vec3(0.8, 0.5, 0.1)), 1.0,
                             true, 1.0, true));
}

void addSheen(Cases& cases) {
    for (double r : {0.05, 0.3, 1.0})
        for (int mode : {0, 1})
            // The bound on the albedo and the fit over wo alone are declared to break it.
            cases.push_back(
                declared(PATINA_LOBE_CASE(label(mode == 0 ? "contyKulla" : "zeltner", r, 0, 0, 0),
                                          sheen, vec3(1.0, 0.5, 0.1), r, mode),
                         1.0, mode == 0 && r >= 0.3));
}

void addClassic(Cases& cases) {
    const vec3 color(1.0, 0.5, 0.1);
    const auto add = [&](const LobeCase& c, double alpha) {
        cases.push_back(declared(c, alpha, true));
    };
    for (double n : {1.0, 30.0, 500.0}) {
        const double alpha = std::sqrt(2.0 / (n + 2.0));
        add(PATINA_LOBE_CASE(label("phong", n, 0, 0, 0), phong, vec3(color), n), alpha);
        add(PATINA_LOBE_CASE(label("blinnPhong", n, 0, 0, 0), blinnPhong, vec3(color), n), alpha);
    }
    for (const auto& a : ggxAlphas) {
        for (int form : {0, 1})
            add(PATINA_LOBE_CASE(label(form ? "wardExact" : "wardBounded", a[0], a[1], 0, 0), ward,
                                 vec3(color), vec2(a[0], a[1]), form),
                a[0]);
        if (a[0] != a[1]) continue;
        for (int fresnel : {0, 1})
            add(PATINA_LOBE_CASE(label("cookTorrance", a[0], fresnel, 0, 0), cookTorrance,
                                 vec3(color), vec3(goldIor), vec3(goldExtinction), a[0], fresnel),
                a[0]);
    }
}

// Interfaces under a film: lobe PREFIX with its inputs, and film(lobe, thickness, ior).
void addFilm(Cases& cases, int compensate) {
    const double thickness = 400.0, alpha = 0.3;
    const bool bare = compensate == 0;
    cases.push_back(declared(
        PATINA_LOBE_CASE_WITH(label("film conductor", thickness, alpha, 0, 0), conductor, conductor,
                              l = conductorFilm(l, thickness, 1.6f), vec3(goldIor),
                              vec3(goldExtinction), vec2(alpha), false, compensate),
        alpha, bare));
    for (double ior : {1.5, 0.75})
        cases.push_back(
            declared(PATINA_LOBE_CASE_AS(label("film dielectric", thickness, alpha, ior, 3),
                                         filmDielectric, schlick, vec3(1.0, 0.9, 0.2), ior,
                                         vec2(alpha), thickness, 1.33, false, 3, false, compensate),
                     alpha * std::fabs(ior - 1.0), bare, ior, true));
}

void addHair(Cases& cases) {
    for (double v : {0.02, 0.3})
        for (double cuticle : {0.5, 0.53})
            cases.push_back(
                declared(PATINA_LOBE_CASE(label("chiangHair", v, cuticle, 0, 0), chiangHair,
                                          vec3(1.0, 0.9, 0.8), vec3(1.0), vec3(0.5, 1.0, 1.0), 1.55,
                                          vec2(v, 0.2), vec2(0.5 * v, 0.1), vec2(2.0 * v, 0.3),
                                          cuticle, vec3(0.1, 0.4, 1.2)),
                         0.1, false, 1.0, true));
}

// Beckmann facets instead of GGX. Alpha 1 has no other paths than 0.3, and interfaces differ by
// mode only in what they leave out.
void addBeckmann(Cases& cases, int compensate) {
    const double alphas[][2] = {{0.05, 0.05}, {0.5, 0.5}, {0.1, 0.4}};
    const int ndf = sh::NDF_BECKMANN;
    const bool bare = compensate == 0;
    for (const auto& a : alphas) {
        const double ax = a[0], ay = a[1];
        cases.push_back(declared(PATINA_LOBE_CASE_WITH(label("beckmann conductor", ax, ay, 0, 0),
                                                       conductor, conductor, l.ndf = ndf,
                                                       vec3(goldIor), vec3(goldExtinction),
                                                       vec2(ax, ay), ax == 0.5, compensate),
                                 ax, bare));
        for (const LobeCase& c :
             {PATINA_LOBE_CASE_WITH(label("beckmann dielectric", ax, ay, 1.5, 3), dielectric,
                                    dielectric, l.ndf = ndf, vec3(1.0, 0.9, 0.2), 1.5, vec2(ax, ay),
                                                false, 3, false, compensate),
              PATINA_LOBE_CASE_WITH(label("beckmann schlick", ax, ay, 0.04, 3), schlick, schlick,
                                    l.ndf = ndf, vec3(0.02, 0.04, 0.06), vec3(0.9, 1.0, 0.5),
                                    vec3(1.0, 0.9, 1.0), 5.0, vec2(ax, ay), false, 3, false,
                                    compensate)})
            cases.push_back(declared(c, ax * 0.5, bare, 1.5, true));
    }
}

void addGgx(Cases& cases, int compensate) {
    const bool bare = compensate == 0;
    for (const auto& a : ggxAlphas) {
        const double ax = a[0], ay = a[1];
        cases.push_back(
            declared(PATINA_LOBE_CASE(label("conductor", ax, ay, 0, 0), conductor, vec3(goldIor),
                                      vec3(goldExtinction), vec2(ax, ay), ax == 0.3, compensate),
                     ax, bare));
        for (int mode : {1, 2, 3}) {
            for (double ior : {1.05, 1.5, 0.75})
                cases.push_back(declared(
                    PATINA_LOBE_CASE(label("dielectric", ax, ay, ior, mode), dielectric,
                                     vec3(1.0, 0.9, 0.2), ior, vec2(ax, ay), false, mode, false,
                                     compensate),
                    ax * (mode == 1 ? 1.0 : std::min(1.0, std::fabs(ior - 1.0))), bare, ior, true));
            cases.push_back(declared(PATINA_LOBE_CASE(label("schlick", ax, ay, 0.04, mode), schlick,
                                                      vec3(0.02, 0.04, 0.06), vec3(0.9, 1.0, 0.5),
                                                      vec3(1.0, 0.9, 1.0), 5.0, vec2(ax, ay), false,
                                                      mode, false, compensate),
                                     ax * (mode == 1 ? 1.0 : 0.5), bare,
                                     (1.0 + std::sqrt(0.04)) / (1.0 - std::sqrt(0.04)), true));
        }
    }
}

} // namespace

std::vector<LobeCase> lobeCases(int compensate) {
    Cases cases;
    addDiffuse(cases);
    addSheen(cases);
    addClassic(cases);
    addFilm(cases, compensate);
    addHair(cases);
    addBeckmann(cases, compensate);
    addGgx(cases, compensate);
    return cases;
}

vec3 direction(double z, double phi) {
    const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
    return vec3(r * std::cos(phi), r * std::sin(phi), z);
}

std::vector<vec3> outgoing(const LobeCase& c) {
    std::vector<vec3> wo = {direction(1.0, 0.0), direction(0.7071, 0.4), direction(0.1736, 1.9),
                            direction(0.01745, 5.0)};
    if (c.twoSided)
        wo.insert(wo.end(), {direction(-0.95, 0.4), direction(-0.75, 2.0), direction(-0.2, 4.0)});
    return wo;
}

vec3 quasiRandom(int i) {
    const double n = i + 0.5;
    const auto wrap = [](double x) { return x - std::floor(x); };
    return vec3(wrap(n * 0.8191725133961645), wrap(n * 0.6710436067037893),
                wrap(n * 0.5497004779019703));
}

void expectSamplesAreOfEval(const LobeCase& c, vec3 wo, int count, double tolerance) {
    for (int i = 0; i < count; ++i) {
        const sh64::LobeSample s = c.f64.sample(wo, quasiRandom(i));
        if (s.event == 0 || (s.event & sh::LOBE_DELTA) != 0) continue;
        const sh64::LobeEval e = c.f64.eval(wo, s.wi);
        ASSERT_GT(s.pdf, 0.0) << c.name;
        // Where wi grazes, its cosine is a difference of two near numbers.
        const double tol = tolerance / std::max(std::fabs(s.wi.z), 1e-6);
        ASSERT_NEAR(e.pdf / s.pdf, 1.0, tol) << c.name << " wo.z " << wo.z;
        ASSERT_LT(largest(e.value / e.pdf - s.weight),
                  tol * std::max(largest(s.weight), 1e-3) + 1e-10)
            << c.name << " wo.z " << wo.z << " wi.z " << s.wi.z;
    }
}

double asymmetry(const LobeCase& c) {
    double worst = 0.0;
    for (int i = 0; i < 500; ++i) {
        const vec3 u = quasiRandom(i);
        const vec3 v = quasiRandom(i + 7000);
        const vec3 o = c.twoSided ? sphereDirection(u) : direction(u.x, 6.2831853 * u.y);
        vec3 w = c.twoSided ? sphereDirection(v) : direction(v.x, 6.2831853 * v.y);
        if (i % 2 == 0) {
            const sh64::LobeSample s = c.f64.sample(o, v);
            if (s.event == 0) continue;
            w = s.wi;
        }
        const double no = o.z >= 0.0 ? 1.0 : c.ior;
        const double nw = w.z >= 0.0 ? 1.0 : c.ior;
        const vec3 there = c.f64.eval(o, w).value / std::fabs(w.z) * (no * no);
        const vec3 back = c.f64.eval(w, o).value / std::fabs(o.z) * (nw * nw);
        for (int k = 0; k < 3; ++k) {
            const double sum = there[k] + back[k];
            if (sum > 1e-6) worst = std::max(worst, std::fabs(there[k] - back[k]) / sum);
        }
    }
    return worst;
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
