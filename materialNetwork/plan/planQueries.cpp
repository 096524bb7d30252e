// SPDX-License-Identifier: Apache-2.0
// Questions about a plan and its closures.

#include "materialNetwork/plan/plan.h"

#include "shaders/shaders.h"

#include <algorithm>
#include <vector>

namespace patina {

bool matters(const Plan& plan, const PlanClosure& c, Choice point) {
    switch (point) {
#define PATINA_CHOICE(Type, name, truth, matters)                                                  \
    case Choice::Type: return matters;
        // one case per row
#include "materialNetwork/plan/choicePoints.inc"
    case Choice::Count: break;
    }
    return false;
}

std::vector<std::string> choicesThatMatter(const Plan& plan) {
    std::vector<std::string> result;
    for (size_t i = 0; i < choicePoints().size(); ++i)
        if (std::any_of(plan.closures.begin(), plan.closures.end(),
                        [&](const PlanClosure& c) { return matters(plan, c, Choice(i)); }))
            result.push_back(choicePoints()[i].name);
    return result;
}

const Operand& closureInput(const Plan& plan, const PlanClosure& closure, const char* name) {
    const GraphNode& node = plan.graph.nodes[size_t(closure.node)];
    return node.inputs[size_t(node.def->findInput(name))];
}

namespace {

/// Place of what a string input says in its list of words.
int chosenWord(const Plan& plan, const PlanClosure& closure, const char* name) {
    const GraphNode& node = plan.graph.nodes[size_t(closure.node)];
    const size_t i = size_t(node.def->findInput(name));
    return wordIndex(node.def->inputs[i], node.inputs[i].value.text);
}

} // namespace

int scatterMode(const Plan& plan, const PlanClosure& closure) {
    return sh::SCATTER_R + chosenWord(plan, closure, "scatter_mode");
}

int microfacetDistribution(const Plan& plan, const PlanClosure& closure) {
    const GraphNode& node = plan.graph.nodes[size_t(closure.node)];
    return node.def->findInput("distribution") < 0
               ? sh::NDF_GGX
               : sh::NDF_GGX + chosenWord(plan, closure, "distribution");
}

int lobeVariant(const Plan& plan, const PlanClosure& closure) {
    if (closure.has(lobe::Microfacet)) return 0;
    const NodeDef& def = *plan.graph.nodes[size_t(closure.node)].def;
    for (const InputDef& input : def.inputs)
        if (!input.words.empty()) return chosenWord(plan, closure, input.name.c_str());
    return 0;
}

bool hasFilm(const Plan& plan, const PlanClosure& closure) {
    const GraphNode& node = plan.graph.nodes[size_t(closure.node)];
    if (node.def->findInput("thinfilm_thickness") < 0) return false;
    // A film on a thin slab's transmission is that of the reflection over it.
    if (closure.thin && node.def->findInput("scatter_mode") >= 0 &&
        scatterMode(plan, closure) == sh::SCATTER_T)
        return false;
    return !isConstantValue(closureInput(plan, closure, "thinfilm_thickness"), 0.0f) &&
           !isConstantValue(closureInput(plan, closure, "thinfilm_ior"), 1.0f);
}

bool walksBeneath(const PlanClosure& closure, method::Subsurface subsurface) {
    return closure.kind == ClosureKind::Subsurface && !closure.thin &&
           subsurface == method::Subsurface::RandomWalk;
}

bool refracts(const Plan& plan, const PlanClosure& closure) {
    if (!closure.has(lobe::Interface)) return false;
    if ((scatterMode(plan, closure) & sh::SCATTER_T) == 0) return false;
    return closure.kind == ClosureKind::Schlick ||
           !isConstantValue(closureInput(plan, closure, "ior"), 1.0f);
}

namespace {

/// Nodes come before those that read them.
bool readsWavelength(const Graph& graph, const Operand& operand) {
    if (operand.isConstant()) return false;
    std::vector<bool> needed(size_t(operand.node) + 1, false);
    needed.back() = true;
    for (size_t i = needed.size(); i-- > 0;) {
        if (!needed[i]) continue;
        const GraphNode& node = graph.nodes[i];
        if (node.def->pattern && node.def->pattern->spectral()) return true;
        for (const Operand& input : node.inputs)
            if (!input.isConstant()) needed[size_t(input.node)] = true;
    }
    return false;
}

} // namespace

bool disperses(const Plan& plan, const PlanClosure& closure) {
    return !closure.thin && closure.kind == ClosureKind::Dielectric && refracts(plan, closure) &&
           readsWavelength(plan.graph, closureInput(plan, closure, "ior"));
}

} // namespace patina
