// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "shaders/oracle.h"

namespace patina::test {

using sh64::vec2;
using sh64::vec3;

/// One precision of a lobe with its inputs bound, in double at the interface.
struct BoundLobe {
    std::function<sh64::LobeEval(vec3 wo, vec3 wi)> eval;
    std::function<sh64::LobeSample(vec3 wo, vec3 u)> sample;
    std::function<vec3(vec3 wo)> albedo;
};

/// A lobe with chosen inputs: the float instance that ships and the double one that judges it.
struct LobeCase {
    std::string name;
    BoundLobe f32;
    BoundLobe f64;
    double alpha = 1.0;      ///< smallest roughness, 1 for diffuse lobes
    double ior = 1.0;        ///< inside over outside
    bool twoSided = false;   ///< wo below the surface is valid
    bool reciprocal = false; ///< f(o, i) n(o)^2 = f(i, o) n(i)^2
};

template <class T> T widen(const T& ofDoubles) {
    return ofDoubles;
}
inline sh64::LobeEval widen(const sh::LobeEval& e) {
    return {vec3(e.value), double(e.pdf)};
}
inline sh64::LobeSample widen(const sh::LobeSample& s) {
    return {vec3(s.wi), vec3(s.weight), double(s.pdf), s.event, double(s.eta)};
}

template <typename Vec, typename Lobe, typename Eval, typename Sample, typename Albedo>
BoundLobe bindLobe(Lobe l, Eval eval, Sample sample, Albedo albedo) {
    BoundLobe b;
    b.eval = [=](vec3 wo, vec3 wi) { return widen(eval(l, Vec(wo), Vec(wi))); };
    b.sample = [=](vec3 wo, vec3 u) { return widen(sample(l, Vec(wo), Vec(u))); };
    b.albedo = [=](vec3 wo) { return vec3(albedo(l, Vec(wo))); };
    return b;
}

/// LobeCase of lobe PREFIX with the inputs of its setup function; vec2 and vec3 in the inputs mean
/// those of either instance.
#define PATINA_LOBE_CASE(NAME, PREFIX, ...) PATINA_LOBE_CASE_AS(NAME, PREFIX, PREFIX, __VA_ARGS__)

/// The same where SETUP##Setup makes a lobe PREFIX.
#define PATINA_LOBE_CASE_AS(NAME, SETUP, PREFIX, ...)                                              \
    PATINA_LOBE_CASE_WITH(NAME, SETUP, PREFIX, (void)l, __VA_ARGS__)

/// The same after the statement CHANGE to the lobe `l`.
#define PATINA_LOBE_CASE_WITH(NAME, SETUP, PREFIX, CHANGE, ...)                                    \
    [&] {                                                                                          \
        patina::test::LobeCase c;                                                                  \
        c.name = NAME;                                                                             \
        PATINA_BIND_LOBE(c.f32, sh, SETUP, PREFIX, CHANGE, __VA_ARGS__)                            \
        PATINA_BIND_LOBE(c.f64, sh64, SETUP, PREFIX, CHANGE, __VA_ARGS__)                          \
        return c;                                                                                  \
    }()

#define PATINA_BIND_LOBE(BOUND, SPACE, SETUP, PREFIX, CHANGE, ...)                                 \
    {                                                                                              \
        using patina::SPACE::vec2;                                                                 \
        using patina::SPACE::vec3;                                                                 \
        auto l = patina::SPACE::SETUP##Setup(__VA_ARGS__);                                         \
        CHANGE;                                                                                    \
        BOUND = patina::test::bindLobe<vec3>(l, patina::SPACE::PREFIX##Eval,                       \
                                             patina::SPACE::PREFIX##Sample,                        \
                                             patina::SPACE::PREFIX##Albedo);                       \
    }

/// Every lobe over a grid of regular inputs. compensate: 0 or 1.
std::vector<LobeCase> lobeCases(int compensate);

/// Gold, as an ior and an extinction.
inline const vec3 goldIor(0.183, 0.421, 1.373), goldExtinction(3.424, 2.346, 1.77);

inline double largest(vec3 v) {
    return std::max(std::fabs(v.x), std::max(std::fabs(v.y), std::fabs(v.z)));
}

/// Unit direction at cosine `z` and azimuth `phi`.
vec3 direction(double z, double phi);

/// Point `u` of the unit square as a direction of equal solid angle.
inline vec3 sphereDirection(vec3 u) {
    return direction(2.0 * u.x - 1.0, 2.0 * sh64::PI * u.y);
}

/// Directions a case is tried from: normal to grazing, and below the surface where that is valid.
std::vector<vec3> outgoing(const LobeCase& c);

/// Point i of a low-discrepancy sequence in the unit cube (Roberts 2018, generalized golden ratio).
vec3 quasiRandom(int i);

/// Density and weight of samples are those of eval(), in double and without mirrors.
/// @param tolerance of the density, where wi does not graze
void expectSamplesAreOfEval(const LobeCase& c, vec3 wo, int count, double tolerance);

/// Largest relative difference of f(o, i) and f(i, o) over a set of direction pairs.
double asymmetry(const LobeCase& c);

/// Root mean square and largest of errors.
struct Error {
    double square = 0.0;
    double largest = 0.0;
    int count = 0;

    void add(double e) {
        square += e * e;
        largest = std::max(largest, std::fabs(e));
        ++count;
    }
    double rms() const { return std::sqrt(square / count); }
};

/// Mean sample weight over `count` quasi-random points: the albedo as the sampler sees it.
vec3 sampledAlbedo(const BoundLobe& lobe, vec3 wo, int count);

bool finiteAndPositive(vec3 v);

} // namespace patina::test
