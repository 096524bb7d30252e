// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/color/renderingSpace.h"
#include "materialNetwork/cpu/materialProgram.h"
#include "base/diagnostics.h"
#include "materialNetwork/plan/methods.h"

#include <map>
#include <memory>
#include <string>

namespace patina {

/// Inputs that replace authored ones: "node path.input" or just "input" of the surface node, and
/// the value that it takes. A connection to that input is dropped.
using MaterialOverrides = std::map<std::string, Value>;

/// Takes a material from its network as authored to a program: expand, simplify, plan, compile,
/// each once; then its methods are chosen and bound. Never fails: every problem is reported by prim
/// and input, and a documented fallback used (an input's default, or makeDisplayColorNetwork() for
/// a surface that cannot be understood at all).
/// @param methods that are forced
/// @param tolerance of the image, from which the other methods follow (Planning); negative:
/// defaults
/// @param space of the program's colours
std::shared_ptr<const MaterialProgram>
compileMaterial(const Network& network, TextureSource& textures, Diagnostics& diagnostics,
                const MethodChoices& methods = {}, double tolerance = -1.0,
                const RenderingSpace& space = RenderingSpace::rec709());

/// How the methods of a material are chosen, and what they cost. With a negative tolerance: what
/// the defaults cost.
MethodPlan planMaterialMethods(const Network& network, TextureSource& textures,
                               Diagnostics& diagnostics, const MethodChoices& methods,
                               double tolerance);

/// The stages of compileMaterial(), as text: the network, the simplified graph, the plan,
/// what was cut on the way, and the methods at the choice points that matter to it.
std::string explainMaterial(const Network& network, Diagnostics& diagnostics,
                            const MethodChoices& methods = {});

/// The simplified graph of a material, as a network of primitive nodes. Of a material without a
/// usable surface: that of makeDisplayColorNetwork().
Network expandedMaterial(const Network& network, Diagnostics& diagnostics);

/// @returns the network with inputs replaced. An override that names no input of the network is
/// reported through diagnostics.
Network applyOverrides(const Network& network, const MaterialOverrides& overrides,
                       Diagnostics& diagnostics);

/// Parses a value written on a command line, "0.5", "1,0,0", "(1, 0, 0)" or text, as the type that
/// the named input has. @returns false when it cannot be read as that type.
bool parseOverride(const Network& network, const std::string& target, const std::string& text,
                   Value& out);

/// The material of prims that have none: a UsdPreviewSurface of roughness 0.5 whose diffuse colour
/// is the primvar displayColor (0.18 without one) and whose presence is the primvar displayOpacity,
/// which is how Storm draws such prims.
Network makeDisplayColorNetwork();

/// A simple material that looks much like another: for renderers that have to show something before
/// the other is ready. It is a UsdPreviewSurface of constants, which give back the mean reflectance
/// of the other seen from straight ahead, and how rough that is. Textures are taken by their means.
/// Light of its own, displacement and media are left out. Surfaces that transmit are half
/// transparent.
///
/// All such networks compile to one of two texts: one for opaque materials, one for all others. So
/// two programs of a graphics processor draw them all.
Network makeStandInNetwork(const MaterialProgram& program);

/// Whether such a material looks like this one: not where it reads other primvars than texture
/// coordinates, and not where it is a volume alone.
bool hasStandIn(const MaterialProgram& program);

} // namespace patina
