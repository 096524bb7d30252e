// SPDX-License-Identifier: Apache-2.0
// Nodes that read the surface.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/geometry.glsl"
#include "materialNetwork/shadingPoint.h"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/patternFunctions.h"

namespace patina {

namespace {

void prepareSpace(PatternSetup& setup, PatternData& data) {
    data.mode = setup.text("space") == "world" ? sh::SPACE_WORLD : sh::SPACE_OBJECT;
}

void prepareTexcoord(PatternSetup& setup, PatternData& data) {
    data.slot =
        setup.primvarSlot(texcoordPrimvar(int(setup.number("index", 0.0f))), ValueType::Vec2);
}

void prepareSetTangent(PatternSetup& setup, PatternData& data) {
    prepareSpace(setup, data);
    data.slot = setup.primvarSlot(tangentPrimvar(setup.text("set")), ValueType::Vec4);
}

void prepareGeomColor(PatternSetup& setup, PatternData& data) {
    const int index = int(setup.number("index", 0.0f));
    data.slot = setup.primvarSlot(
        index > 0 ? "displayColor" + std::to_string(index) : "displayColor", ValueType::Color4);
}

void prepareNamed(PatternSetup& setup, PatternData& data, const char* input) {
    const std::string name = setup.text(input);
    const Value* fallback =
        setup.constant(input == std::string("varname") ? "fallback" : "default");
    if (name.empty())
        setup.warn(input, messages::primvarUnnamed);
    else
        data.slot = setup.primvarSlot(name, fallback ? fallback->type : ValueType::Vec4);
}
void prepareGeomprop(PatternSetup& setup, PatternData& data) {
    prepareNamed(setup, data, "geomprop");
}
void prepareVarname(PatternSetup& setup, PatternData& data) {
    prepareNamed(setup, data, "varname");
}

void prepareFallback(PatternSetup& setup, PatternData&) {
    setup.warn("varname", messages::primvarTypeFallback);
}
void prepareUniform(PatternSetup& setup, PatternData&) {
    setup.warn("geomprop", messages::primvarTypeDefault);
}

#define PATINA_NODE_ROWS
#include PATINA_NODE_FUNCTIONS

} // namespace

NodeRows geometryNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina
