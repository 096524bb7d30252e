// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/messages.h"
#include "materialNetwork/glsl/glslTextures.h"
#include "materialNetwork/ir/materialIr.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace patina {

/// A material as GLSL functions, generated from the program that the path tracer runs, so that both
/// have the same registers, lobes and weights.
///
/// The text expects shaders/raster/material.glsl before it, and defines
///   void materialSetup()                     patterns, frames and lobes at `point`
///   float materialPresence(out vec3 passes)  as MaterialProgram::opacity()
///   vec3 materialEmission(vec3 wo)
///   MaterialEval materialEval(vec3 wi)       as Bsdf::eval()
///   Medium materialMedium()                 as MaterialProgram::interior(), if `hasInterior`
///   MaterialSample materialSample(vec3 u, float uLobe)  as Bsdf::sample()
/// No string of a scene is part of it, and no number but those that choose the shape of the
/// program: every other is in `parameters`, so that equal graphs have equal text.
struct GlslMaterial {
    std::string text;
    std::string albedoText;            ///< may follow: vec3 materialAlbedo(), as Bsdf::albedo()
    std::string passesText;            ///< may follow: vec3 materialPasses(), what lobes refract
    std::string traitsText;            ///< may follow: see glslTraits()
    std::vector<glm::vec4> parameters; ///< `vec4 parameters[]` of the text
    std::vector<GlslTexture> textures; ///< those of `texture0`...
    std::vector<Message> leftOut;      ///< patterns that have no GLSL: their value at one point
    bool presence = false;             ///< materialPresence() may be less than 1
    bool emission = false;
    bool hasColoredPresence = false; ///< what passes where the surface is absent may be coloured
    bool transmits = false; ///< light passes by a lobe, or through a boundary: needs what is behind
    bool hasInterior = false; ///< there is a medium inside: the text has materialMedium()
    bool volumeOnly = false;  ///< there is a boundary, but no surface
    bool thin = false;        ///< there is no inside
    bool fibre = false;       ///< lobes stand for the whole width of a curve
    std::string definitions;  ///< may stand before material.glsl: what holds for all lobes
};

/// Features that the text may use.
struct GlslFeatures {
    bool textureArrays = true; ///< else UDIM shows its first tile, and every texture has a unit
    bool energyCurves = true;  ///< albedos of constant interfaces from curves in the parameters
};

GlslMaterial makeGlslMaterial(const MaterialIr& ir, const GlslFeatures& features = {});

} // namespace patina
