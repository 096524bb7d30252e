// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/types.h"

#include <string>
#include <vector>

namespace patina {

enum class LightFilterType {
#define PATINA_FILTER_TYPE(Type, word, schemas) Type,
#include "hdDelegate/scene/lightFilterInputs.inc"
};

/// A row of lightFilterInputs.inc.
struct LightFilterRow {
    LightFilterType type;
    const char *word, *schemas;
};

inline constexpr LightFilterRow lightFilterRows[] = {
#define PATINA_FILTER_TYPE(Type, word, schemas) {LightFilterType::Type, word, schemas},
#include "hdDelegate/scene/lightFilterInputs.inc"
};

/// An input that is read only to say that it is not evaluated.
struct IgnoredFilterInput {
    const char *names, *idle;
};

inline constexpr IgnoredFilterInput ignoredFilterInputs[] = {
#define PATINA_FILTER_IGNORED(names, idle) {names, idle},
#include "hdDelegate/scene/lightFilterInputs.inc"
};

/// A filter, which changes a light on its way to a point: a prim that the light's `light:filters`
/// names. The inputs are explained in lightFilterInputs.inc.
struct LightFilter {
    using floats = std::vector<float>;
    using vec3s = std::vector<vec3>;
    using text = std::string;

    std::string path;
    LightFilterType type = LightFilterType::Barn;
    MotionTransform transform{mat4(1.0f)}; ///< to the space that the light's own transform leads to
#define PATINA_FILTER_INPUT(type, field, names, fallback, description) type field = fallback;
#include "hdDelegate/scene/lightFilterInputs.inc"
};

} // namespace patina
