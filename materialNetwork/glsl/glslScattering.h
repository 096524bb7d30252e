// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/messages.h"
#include "materialNetwork/ir/materialIr.h"

#include <string>
#include <vector>

namespace patina {

/// @returns GLSL for the frame of a lobe
std::string glslFrameOf(const MaterialIr& code, size_t lobe);

/// @returns text of materialEval() and materialEvalBut(), as Bsdf::eval()
std::string glslEval(const MaterialIr& code);

/// @returns text of materialSample(), as Bsdf::sample()
std::string glslSample(const MaterialIr& code);

/// @returns text of materialAlbedo(), as Bsdf::albedo(). Only who asks for it takes it in
std::string glslAlbedo(const MaterialIr& code);

/// @returns whether a lobe refracts, so that lobeTransmittance[] is set
bool glslRefracts(const LobeTemplate& lobe);

/// @returns text of materialPasses(): the share of light that lobes refract. Empty where none does
std::string glslPasses(const MaterialIr& code);

/// @returns text of LOBES, lobeKind(), lobeAlpha(), lobeIsRound() and lobeFrame(): what lights that
/// go through lobes one by one have to know. Only who asks for it takes it in
std::string glslTraits(const MaterialIr& code);

/// @returns what all lobes have in common, for before the text; see shaders/compat/glsl.glsl
std::string glslDefinitions(const MaterialIr& code);

/// @returns a line for each method of the program that walks, whose values are random and not
/// GLSL's
std::vector<Message> glslWalksLeftOut(const MaterialIr& code);

} // namespace patina
