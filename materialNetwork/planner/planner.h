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

/// Share of the tolerance that is kept for paths being cut off.
constexpr double depthShare = 0.1;

/// Chooses a method at every choice point that matters to a plan and has a truth: those whose
/// predicted errors sum up to at most methodShare of the tolerance, and with which an image is
/// done first: error that methods take is missing to noise, which then needs more samples.
///
/// The prediction for one method is the table's mean error at the lobe's own kind, reflectance and
/// roughness (between the two subjects that enclose it), per quarter of the cosine, over what
/// is reflected; times the lobe's share of the material's albedo, and on what lies beneath it the
/// error over what is let through. Of the quarters the mean and the worst count half each, of
/// places with different parameters the worst. Layers are predicted channel by channel of their
/// base. Light that meets several surfaces takes the error along each time, which a factor allows
/// for (bounceFactor). Among methods without bias (sampling) the one with the least noise for its
/// time is taken. Where the default is not measured, it stays.
/// @param plan with the default methods; meanings (points without a truth) are left as they are
/// @param code made of the same plan, with what is forced and else the defaults; errors are worst
/// over what is seen in its textures
MethodPlan planMethods(const Plan& plan, const ProgramCode& code, const Planning& planning);

/// How often light that a camera sees has met surfaces of such an albedo, on the average:
/// 1 / (1 - 0.75 albedo).
double bounceFactor(double albedo);

/// @returns the plan as a back end shows it that has no random walks within a surface
/// (energyCompensation = randomWalk, layering = positionFree): with the defaults in their place,
/// and the errors that these are expected to make
MethodPlan withoutWalks(MethodPlan plan);

/// @returns the choices of a plan as they go into Plan::methods
MethodChoices methodsOf(const MethodPlan& plan, MethodChoices others);

} // namespace patina
