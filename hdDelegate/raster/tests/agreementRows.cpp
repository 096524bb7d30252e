// SPDX-License-Identifier: Apache-2.0
// The table of lobes whose GLSL is compared with C++. A new lobe is one more row. Compiled twice,
// see agreementLoosest.cpp.

#include "hdDelegate/raster/tests/agreement.h"

#ifndef PATINA_SINGLE
#define PATINA_SINGLE sh
#define PATINA_ROWS agreementRows
#endif

namespace patina::test {

namespace {

using Options = std::vector<float>;

/// `count` sets of inputs: each input takes its options in an order of its own, so that all of them
/// meet.
std::vector<std::vector<float>> mixed(const std::vector<Options>& inputs, int count = 48) {
    std::vector<std::vector<float>> sets;
    unsigned state = 12345;
    for (int i = 0; i < count; ++i) {
        std::vector<float> set;
        for (const Options& options : inputs) {
            state = state * 1664525u + 1013904223u;
            set.push_back(options[(state >> 10) % options.size()]);
        }
        set.resize(AgreementRow::maxParameters, 0.0f);
        sets.push_back(set);
    }
    return sets;
}

const Options color{0.0f, 0.18f, 0.5f, 0.8f, 1.0f};
const Options roughness{0.0f, 0.1f, 0.5f, 1.0f};
const Options alpha{0.0f, 0.01f, 0.05f, 0.2f, 0.5f, 1.0f};
const Options ior{1.0f, 1.0001f, 1.01f, 1.33f, 1.5f, 2.5f, 1.0f / 1.5f};
const Options index{0.2f, 1.0f, 1.4f, 3.0f};
const Options extinction{0.0f, 1.7f, 3.5f, 7.0f};
const Options flag{0.0f, 1.0f};
const Options mode{1.0f, 2.0f, 3.0f};
const Options exponent{1.0f, 8.0f, 100.0f, 2000.0f};
const Options schlickExponent{5.0f, 1.0f, 3.0f, 5.0f};
const Options thickness{0.0f, 100.0f, 400.0f, 1000.0f};
const Options three{0.0f, 1.0f, 2.0f};
const Options albedo{0.0f, 1.0f, 2.0f};
const Options filmIor{1.0f, 1.3f, 1.6f, 2.0f};
const Options rarely{0, 0, 0, 1};
const Options hairIor{1.3f, 1.55f, 2.0f};
const Options along{0.001f, 0.05f, 0.5f};
const Options around{0.05f, 0.3f, 1.0f};
const Options tilt{0.0f, 0.45f, 0.5f, 0.52f, 1.0f};
const Options pigment{0.0f, 0.3f, 3.0f};

// The instances of a lobe: __VA_ARGS__ is one expression of three languages.
#define PATINA_INSTANCE(NS, PREFIX, ALBEDO, ...)                                                   \
    [](const float* p) {                                                                           \
        using namespace patina::NS;                                                                \
        const auto p1 = [p](int i) { return p[i]; };                                               \
        const auto p2 = [p](int i) { return patina::NS::vec2(p[i], p[i + 1]); };                   \
        const auto p3 = [p](int i) { return patina::NS::vec3(p[i], p[i + 1], p[i + 2]); };         \
        const auto pb = [p](int i) { return p[i] > 0.5f; };                                        \
        const auto pn = [p](int i) { return int(p[i] + 0.5f); };                                   \
        (void)p1, (void)p2, (void)p3, (void)pb, (void)pn;                                          \
        return bindLobe<patina::NS::vec3>(__VA_ARGS__, PREFIX##Eval, PREFIX##Sample, ALBEDO);      \
    }
#define PATINA_ROW(NAME, PREFIX, ALBEDO, SETS, ...)                                                \
    AgreementRow {                                                                                 \
        NAME, #__VA_ARGS__, #PREFIX, #ALBEDO,                                                      \
            PATINA_INSTANCE(PATINA_SINGLE, PREFIX, ALBEDO, __VA_ARGS__),                           \
            PATINA_INSTANCE(sh64, PREFIX, ALBEDO, __VA_ARGS__), SETS                               \
    }

// An EDF is a value at wo and nothing else.
#define PATINA_VALUE(NS, ...)                                                                      \
    [](const float* p) {                                                                           \
        BoundLobe b;                                                                               \
        b.eval = [p](vec3 w, vec3) {                                                               \
            using namespace patina::NS;                                                            \
            const auto p1 = [p](int i) { return p[i]; };                                           \
            const auto p3 = [p](int i) { return patina::NS::vec3(p[i], p[i + 1], p[i + 2]); };     \
            const auto splat = [](double x) { return patina::NS::vec3(x); };                       \
            const patina::NS::vec3 wo(w);                                                          \
            (void)p1, (void)p3, (void)splat;                                                       \
            return sh64::LobeEval{vec3(__VA_ARGS__), 0.0};                                         \
        };                                                                                         \
        b.sample = [](vec3, vec3) { return sh64::lobeSampleNone(); };                              \
        b.albedo = [](vec3) { return vec3(0.0); };                                                 \
        return b;                                                                                  \
    }
#define PATINA_VALUE_ROW(NAME, SETS, ...)                                                          \
    AgreementRow {                                                                                 \
        NAME, #__VA_ARGS__, "", "", PATINA_VALUE(PATINA_SINGLE, __VA_ARGS__),                      \
            PATINA_VALUE(sh64, __VA_ARGS__), SETS                                                  \
    }

} // namespace

std::vector<AgreementRow> PATINA_ROWS() {
    return {
        PATINA_ROW("orenNayar", orenNayar, orenNayarAlbedo,
                   mixed({color, color, color, roughness, flag}),
                   orenNayarSetup(p3(0), p1(3), pb(4))),
        PATINA_ROW("burley", burley, burleyAlbedo, mixed({color, color, color, roughness}),
                   burleySetup(p3(0), p1(3))),
        PATINA_ROW("translucent", translucent, translucentAlbedo, mixed({color, color, color}),
                   translucentSetup(p3(0))),
        PATINA_ROW("conductor", conductor, conductorAlbedo,
                   mixed({index, index, index, extinction, extinction, extinction, alpha, alpha,
                          flag, flag}),
                   conductorSetup(p3(0), p3(3), p2(6), pb(8), pn(9))),
        // Methods at choice points, but for those that add up many facets.
        PATINA_ROW("methods of conductor", conductor, conductorAlbedo,
                   mixed({index, extinction, alpha, alpha, three, albedo, flag}, 96),
                   conductorMethods(conductorSetup(vec3(p1(0)), vec3(p1(1)), p2(2), false, pn(4)),
                                    pn(5), pn(6), 0)),
        PATINA_ROW("methods of dielectric", dielectric, dielectricAlbedo,
                   mixed({color, ior, alpha, alpha, mode, three, albedo, flag}, 160),
                   dielectricMethods(
                       dielectricSetup(vec3(p1(0)), p1(1), p2(2), false, pn(4), false, pn(5)),
                       pn(6), pn(7))),
        PATINA_ROW("methods of schlick", schlick, schlickAlbedo,
                   mixed({color, color, alpha, alpha, mode, three, albedo, flag}, 96),
                   schlickMethods(schlickSetup(vec3(p1(0)), vec3(1.0f), vec3(p1(1)), 5.0f, p2(2),
                                               false, pn(4), false, pn(5)),
                                  pn(6), pn(7), 0)),
        PATINA_ROW("models of orenNayar", orenNayar, orenNayarAlbedo,
                   mixed({color, roughness, flag, {0, 1, 2, 3}}),
                   orenNayarModel(vec3(p1(0)), p1(1), pb(2), pn(3))),
        PATINA_ROW("methods of film", conductor, conductorAlbedo,
                   mixed({index, extinction, alpha, thickness, filmIor, three}, 48),
                   conductorMethods(conductorFilm(conductorSetup(vec3(p1(0)), vec3(p1(1)),
                                                                 vec2(p1(2)), false, 1),
                                                  p1(3), p1(4)),
                                    1, 0, pn(5))),
        PATINA_ROW("dielectric", dielectric, dielectricAlbedo,
                   mixed({color, color, color, ior, alpha, alpha, rarely, mode, flag, flag}, 120),
                   dielectricSetup(p3(0), p1(3), p2(4), pb(6), pn(7), pb(8), pn(9))),
        PATINA_ROW(
            "schlick", schlick, schlickAlbedo,
            mixed({color, color, color, color, color, color, color, color, color, schlickExponent,
                   alpha, alpha, rarely, mode, flag, flag},
                  120),
            schlickSetup(p3(0), p3(3), p3(6), p1(9), p2(10), pb(12), pn(13), pb(14), pn(15))),
        PATINA_ROW(
            "film conductor", conductor, conductorAlbedo,
            mixed({index, index, index, extinction, extinction, extinction, alpha, alpha, flag,
                   flag, thickness, filmIor}),
            conductorFilm(conductorSetup(p3(0), p3(3), p2(6), pb(8), pn(9)), p1(10), p1(11))),
        PATINA_ROW("film schlick", schlick, schlickAlbedo,
                   mixed({color, color, color, color, color, color, color, color, color,
                          schlickExponent, alpha, alpha, mode, flag, flag, thickness, filmIor},
                         120),
                   schlickFilm(schlickSetup(p3(0), p3(3), p3(6), p1(9), p2(10), false, pn(12),
                                            pb(13), pn(14)),
                               p1(15), p1(16))),
        PATINA_ROW(
            "film dielectric", schlick, schlickAlbedo,
            mixed({color, color, color, ior, alpha, alpha, thickness, filmIor, mode, flag, flag}),
            filmDielectricSetup(p3(0), p1(3), p2(4), p1(6), p1(7), false, pn(8), pb(9), pn(10))),
        PATINA_ROW("sheen", sheen, sheenAlbedo, mixed({color, color, color, roughness, flag}),
                   sheenSetup(p3(0), p1(3), pn(4))),
        PATINA_ROW("methods of sheen", sheen, sheenAlbedo, mixed({color, roughness, flag}, 24),
                   sheenMethods(sheenSetup(vec3(p1(0)), p1(1), 0), pn(2))),
        PATINA_ROW("phong", phong, phongAlbedo, mixed({color, color, color, exponent}),
                   phongSetup(p3(0), p1(3))),
        PATINA_ROW("blinnPhong", blinnPhong, blinnPhongAlbedo,
                   mixed({color, color, color, exponent}), blinnPhongSetup(p3(0), p1(3))),
        PATINA_ROW("ward", ward, wardAlbedo, mixed({color, color, color, alpha, alpha, flag}),
                   wardSetup(p3(0), p2(3), pn(5))),
        PATINA_ROW("cookTorrance", cookTorrance, cookTorranceAlbedo,
                   mixed({color, color, color, index, index, index, extinction, extinction,
                          extinction, alpha, flag}),
                   cookTorranceSetup(p3(0), p3(3), p3(6), p1(9), pn(10))),
        PATINA_ROW(
            "chiangHair", chiangHair, chiangHairAlbedo,
            mixed({color, color,  color, color,  color, color,  color, color,   color,   hairIor,
                   along, around, along, around, along, around, tilt,  pigment, pigment, pigment}),
            chiangHairSetup(p3(0), p3(3), p3(6), p1(9), p2(10), p2(12), p2(14), p1(16), p3(17))),
        PATINA_ROW("phaseHenyeyGreenstein", phaseHenyeyGreenstein, phaseHenyeyGreensteinAlbedo,
                   mixed({{-1.0f, -0.9f, -0.3f, 0.0f, 0.01f, 0.6f, 0.95f, 1.0f}}, 16),
                   phaseHenyeyGreensteinSetup(p1(0))),
        PATINA_VALUE_ROW(
            "edf schlick",
            mixed({color, color, color, color, color, color, {0.0f, 1.0f, 5.0f, 8.0f}}),
            edfSchlick(p3(0), p3(3), p1(6), wo.z)),
        PATINA_VALUE_ROW("edf conical",
                         mixed({{0.0f, 20.0f, 60.0f, 180.0f}, {0.0f, 20.0f, 90.0f, 180.0f}}, 16),
                         splat(edfConical(p1(0), p1(1), wo.z))),
    };
}

} // namespace patina::test
