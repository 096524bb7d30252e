// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shaders/tests/lobeCase.h"

#include <string>
#include <vector>

namespace patina::test {

/// One lobe in three instances: GLSL text for the driver, C++ in float and in double. All read
/// their inputs from the same floats.
struct AgreementRow {
    static constexpr int maxParameters = 28;

    std::string name;
    /// GLSL expression that makes the lobe from p1(i), p2(i), p3(i), pb(i), pn(i)
    std::string setup;
    std::string prefix; ///< of the lobe's functions; empty where `setup` is a value itself
    std::string albedo; ///< function that gives the albedo
    BoundLobe (*f32)(const float* parameters) = nullptr;
    BoundLobe (*f64)(const float* parameters) = nullptr;
    std::vector<std::vector<float>> sets; ///< of parameters

    /// Whether the lobe has energy factors of its wo (`PATINA_ENERGY_KNOWN`).
    bool hasEnergy() const {
        return prefix == "conductor" || prefix == "dielectric" || prefix == "schlick";
    }
};

/// Every lobe, each over inputs with the extremes in them.
std::vector<AgreementRow> agreementRows();
/// The same, whose float is as far off as GLSL allows; see loosest.h.
std::vector<AgreementRow> loosestRows();

/// Directions and random numbers that every set of inputs is tried with.
struct AgreementPoint {
    float wo[3], wi[3], u[3];
};
std::vector<AgreementPoint> agreementPoints();

/// The answers of an instance at a point.
struct AgreementAnswer {
    sh64::LobeEval eval;
    sh64::LobeSample sample;
    vec3 albedo{0.0};
};

AgreementAnswer answerOf(const BoundLobe& lobe, const AgreementPoint& point);

/// Parts of an answer that are compared.
enum AgreementPart {
    PartEval,
    PartPdf,
    PartSample,
    PartWeight,
    PartSamplePdf,
    PartAlbedo,
    PartCount
};
extern const char* const agreementPartNames[PartCount];

/// Values that are a smaller share than this of what a white lobe would give are compared against
/// that share: float has no more digits where a reflectance is a difference of two that are equal
/// (no interface, beyond total reflection).
constexpr double agreementShare = 1e-2;

/// Relative differences of an answer from the oracle's, by part. Densities below 1e-6, which no
/// image shows, are compared against that. A direction counts by its absolute difference; a
/// different event counts as 1.
void differences(const AgreementAnswer& a, const AgreementAnswer& oracle, double out[PartCount]);

} // namespace patina::test
