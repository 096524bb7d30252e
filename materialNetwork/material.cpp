// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/material.h"

#include "materialNetwork/cpu/programCode.h"
#include "materialNetwork/graph/expand.h"
#include "materialNetwork/graph/graphNetwork.h"
#include "materialNetwork/graph/mergeSurfaceShaders.h"
#include "materialNetwork/graph/simplify.h"
#include "materialNetwork/ir/irBuilder.h"
#include "materialNetwork/network/renderingColors.h"
#include "materialNetwork/plan/dump.h"
#include "materialNetwork/planner/planner.h"

namespace patina {

namespace {

const char* const displayColorPath = "/displayColor";

Graph simplifyMaterial(const Graph& graph, std::vector<std::string>& cuts,
                       Diagnostics& diagnostics) {
    Graph simple = simplify(graph, cuts);
    return mergeSurfaceShaders(simple, diagnostics) ? simplify(simple, cuts) : simple;
}

/// Whether nothing is known of a surface: grey or the prim's own colour is better than a black
/// hole.
bool isLost(const Graph& graph, const Network& network, Diagnostics& diagnostics) {
    if (graph.terminals.count("surface") || graph.terminals.count("volume") ||
        network.path == displayColorPath)
        return false;
    diagnostics.warn(network.path, "outputs:surface", messages::noUsableSurface);
    return true;
}

Plan planMaterial(const Network& network, Diagnostics& diagnostics, const MethodChoices& methods) {
    const Network expanded = expand(network, diagnostics);
    const Graph graph = buildGraph(expanded, diagnostics);
    if (isLost(graph, network, diagnostics)) {
        Plan plan = planMaterial(makeDisplayColorNetwork(), diagnostics, methods);
        plan.planned.fallback = true;
        return plan;
    }
    std::vector<std::string> cuts;
    const Graph simple = simplifyMaterial(graph, cuts, diagnostics);
    return makePlan(simple, std::move(cuts), diagnostics, methods);
}

/// Lobes have no weights of their own in layers that are walked, so `returned` stands for these.
MethodPlan planOf(const Plan& plan, const MaterialIr& ir, const MethodChoices& methods,
                  double tolerance) {
    MethodChoices probed = methods;
    if (chosenMethod(methods, "layering") == "positionFree") probed["layering"] = "returned";
    return planMethods(plan, MaterialProgram::make(ir, MethodSet(probed))->code(),
                       {methods, tolerance});
}

} // namespace

std::shared_ptr<const MaterialProgram>
compileMaterial(const Network& network, TextureSource& textures, Diagnostics& diagnostics,
                const MethodChoices& methods, double tolerance, const RenderingSpace& space) {
    const Plan plan = planMaterial(space.isRec709() ? network : inRenderingSpace(network, space),
                                   diagnostics, methods);
    const MaterialIr ir = compileIr(plan, textures, diagnostics);
    if (tolerance < 0.0) return MaterialProgram::make(ir, MethodSet(methods), plan.planned);
    const MethodPlan planned = planOf(plan, ir, methods, tolerance);
    return MaterialProgram::make(ir, MethodSet(methodsOf(planned, methods)), planned);
}

MethodPlan planMaterialMethods(const Network& network, TextureSource& textures,
                               Diagnostics& diagnostics, const MethodChoices& methods,
                               double tolerance) {
    const Plan plan = planMaterial(network, diagnostics, methods);
    return planOf(plan, compileIr(plan, textures, diagnostics), methods, tolerance);
}

std::string explainMaterial(const Network& network, Diagnostics& diagnostics,
                            const MethodChoices& methods) {
    const Network expanded = expand(network, diagnostics);
    std::vector<std::string> cuts;
    const Graph graph = buildGraph(expanded, diagnostics);
    if (isLost(graph, network, diagnostics))
        return dumpNetwork(network) +
               "\nThis material has no usable surface and is not shown. displayColor is shown in "
               "its "
               "place; what follows is of that fallback.\n\n" +
               explainMaterial(makeDisplayColorNetwork(), diagnostics, methods);
    const Graph simple = simplifyMaterial(graph, cuts, diagnostics);
    const size_t before = graph.nodes.size();
    std::string text = dumpNetwork(network) + "\n" + dumpGraph(simple);
    text += "(" + std::to_string(before) + " nodes before simplification, " +
            std::to_string(simple.nodes.size()) + " after)\n\n";
    return text + dumpPlan(makePlan(simple, std::move(cuts), diagnostics, methods));
}

Network expandedMaterial(const Network& network, Diagnostics& diagnostics) {
    const Graph graph = buildGraph(expand(network, diagnostics), diagnostics);
    if (isLost(graph, network, diagnostics))
        return expandedMaterial(makeDisplayColorNetwork(), diagnostics);
    std::vector<std::string> cuts;
    return graphNetwork(simplifyMaterial(graph, cuts, diagnostics));
}

Network makeDisplayColorNetwork() {
    NetworkNode color;
    color.path = "/displayColor/color";
    color.id = "UsdPrimvarReader_float3";
    color.inputs["varname"] = Value::makeString("displayColor");
    color.inputs["fallback"] = Value::makeVec3(0.18f, 0.18f, 0.18f);
    NetworkNode opacity;
    opacity.path = "/displayColor/opacity";
    opacity.id = "UsdPrimvarReader_float";
    opacity.inputs["varname"] = Value::makeString("displayOpacity");
    opacity.inputs["fallback"] = Value::makeFloat(1.0f);
    NetworkNode surface;
    surface.path = "/displayColor/surface";
    surface.id = "UsdPreviewSurface";
    surface.inputs["opacityMode"] = Value::makeString("presence");
    surface.connections["diffuseColor"] = {color.path, "result"};
    surface.connections["opacity"] = {opacity.path, "result"};
    Network network;
    network.path = displayColorPath;
    network.nodes = {color, opacity, surface};
    network.terminals["surface"] = {surface.path, "surface"};
    return network;
}

} // namespace patina
