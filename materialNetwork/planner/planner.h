// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/plan/plan.h"

namespace patina {

struct ProgramCode;

/// How methods are to be chosen.
struct Planning {
    MethodChoices forced; ///< by the user; always in force
    /// Mean relative luminance error of the image, methods and noise together. 0: the truth at
    /// every choice point; negative: the defaults.
    double tolerance = -1.0;
};

/// Share of the tolerance that methods may take; noise gets what they leave.
constexpr double methodShare = 0.4;

/// Share of the tolerance that paths may take by being cut off.
constexpr double depthShare = 0.1;

/// What a bias leaves of a tolerance to noise, both as mean sizes: sqrt(tolerance^2 - bias^2).
/// Noise does not depend on the bias, and where it is normal E|b + n| <= sqrt(b^2 + E|n|^2).
double noiseBeside(double bias, double tolerance);

/// Chooses a method at every choice point that has a truth and matters to a plan. The predicted
/// errors of the chosen methods sum up to at most methodShare of the tolerance. Among those the
/// combination is taken with which an image is done first: the error of methods leaves less of the
/// tolerance to noise, which then needs more samples.
///
/// How errors are predicted:
/// - For a lobe, a method has the table's mean error at its kind, reflectance and roughness
///   (between the two subjects that enclose it), for each quarter of the cosine, over the light
///   that the lobe reflects.
/// - The mean over the quarters and the worst quarter count half each. Of places with different
///   parameters the worst counts.
/// - The error counts by the lobe's share of the material's albedo. On the lobes beneath it counts
///   over the light that is let through.
/// - Light meets several surfaces and takes the error along each time (bounceFactor).
///
/// Among methods without bias (sampling) the one with the least noise for its time is taken. Where
/// the default is not measured, it stays.
/// @param plan with the default methods; meanings (points without a truth) are left as they are
/// @param code made from the same plan, with the forced methods and otherwise the defaults; errors
///        are the worst over the values that its textures show; without layers that are walked
MethodPlan planMethods(const Plan& plan, const ProgramCode& code, const Planning& planning);

/// How often light that a camera sees has met surfaces of such an albedo, on the average:
/// 1 / (1 - 0.75 albedo).
double bounceFactor(double albedo);

/// @returns the plan as a back end shows it that has no random walks within a surface
/// (energyCompensation = randomWalk): with the defaults in their place, and the errors that these
/// are expected to make
MethodPlan withoutWalks(MethodPlan plan);

/// @returns the choices of a plan as they go into Plan::methods
MethodChoices methodsOf(const MethodPlan& plan, MethodChoices others);

} // namespace patina
