// SPDX-License-Identifier: Apache-2.0
// Nodes that bring points, vectors and normals from one space to another, and what belongs to the
// frame and the view.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/space.glsl"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/patternFunctions.h"

namespace patina {

namespace {

void prepareSpaces(PatternSetup& setup, PatternData& data) {
    const auto world = [&](const char* input) {
        const std::string space = setup.text(input);
        if (space != "world" && space != "object" && space != "model" && !space.empty())
            setup.warn(input, "unknown space '" + space + "'; world space is used");
        return space != "object" && space != "model";
    };
    const bool from = world("fromspace"), to = world("tospace");
    data.mode = from == to ? sh::SPACE_KEPT : to ? sh::SPACE_TO_WORLD : sh::SPACE_TO_OBJECT;
}

#define PATINA_SPACES "string fromspace=, string tospace="

const NodeRow rows[] = {
    {"ND_transformpoint_vector3", "transformpoint", "vector3 in=0, " PATINA_SPACES, "vector3",
     PATINA_PATTERN(nodeTransformPoint), Algebra::None, nullptr, prepareSpaces},
    {"ND_transformvector_vector3", "transformvector", "vector3 in=0, " PATINA_SPACES, "vector3",
     PATINA_PATTERN(nodeTransformVector), Algebra::None, nullptr, prepareSpaces},
    {"ND_transformnormal_vector3", "transformnormal", "vector3 in=0 0 1, " PATINA_SPACES, "vector3",
     PATINA_PATTERN(nodeTransformNormal), Algebra::None, nullptr, prepareSpaces},
    {"ND_reflect_vector3", "reflect", "vector3 in=1 0 0, vector3 normal=@Nworld", "vector3",
     PATINA_PATTERN(nodeReflect)},
    {"ND_refract_vector3", "refract", "vector3 in=1 0 0, vector3 normal=@Nworld, float ior=1",
     "vector3", PATINA_PATTERN(nodeRefract)},
    {"ND_facingratio_float", "facingratio",
     "vector3 viewdirection=@Vworld, vector3 normal=@Nworld, boolean faceforward=1, "
     "boolean invert=0",
     "float", PATINA_PATTERN(nodeFacingRatio)},
    {"ND_gooch_shade", "gooch_shade",
     "color3 warm_color=0.8 0.8 0.7, color3 cool_color=0.3 0.3 0.8, float specular_intensity=1, "
     "float shininess=64, vector3 light_direction=1 -0.5 -0.5",
     "color3", PATINA_PATTERN(nodeGooch)},
    // The host writes the number of the PATINA_PATTERN(nodeFrame) into the input `frame`, which
    // MaterialX does not have.
    {"ND_frame_float", "frame", "float frame=1", "float", PATINA_PATTERN(nodeFrame)},
    {"ND_time_float", "time", "float fps=24, float frame=1", "float", PATINA_PATTERN(nodeTime)},
};

} // namespace

NodeRows spaceNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina
