// What can be asked of a plan and its closures.

#include "materialNetwork/plan/plan.h"

#include "shaders/shaders.h"

#include <set>

namespace patina {

std::set<std::string> choicesOf(const Plan& plan, const PlanClosure& c) {
    std::set<std::string> matter;
    const bool interface = c.has(lobe::Interface);
    if (c.has(lobe::Facets)) matter.insert({"energyCompensation", "directionalAlbedo", "sampling"});
    if (c.kind == ClosureKind::Dielectric || c.kind == ClosureKind::Conductor)
        matter.insert("fresnel");
    if (hasFilm(plan, c)) matter.insert("thinFilm");
    if (c.kind == ClosureKind::OrenNayar) matter.insert("diffuse");
    if (c.kind == ClosureKind::Subsurface && !c.thin) matter.insert("subsurface");
    if (c.kind == ClosureKind::Sheen && lobeVariant(plan, c) == sh::SHEEN_CONTY_KULLA)
        matter.insert("sheen");
    if (c.kind == ClosureKind::Layer) matter.insert({"layering", "layerTransmittance"});
    if (c.underReflection && interface && scatterMode(plan, c) == sh::SCATTER_T)
        matter.insert("reflectionOverTransmission");
    if (c.inThinWall && interface && (scatterMode(plan, c) & sh::SCATTER_T) != 0)
        matter.insert("thinWalled");
    return matter;
}

std::vector<std::string> choicesThatMatter(const Plan& plan) {
    std::set<std::string> matter;
    for (const PlanClosure& c : plan.closures)
        matter.merge(choicesOf(plan, c));
    std::vector<std::string> result;
    for (const ChoicePoint& point : choicePoints())
        if (matter.count(point.name)) result.push_back(point.name);
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
    if (closure.has(lobe::Facets)) return 0;
    const NodeDef& def = *plan.graph.nodes[size_t(closure.node)].def;
    for (const InputDef& input : def.inputs)
        if (!input.words.empty()) return chosenWord(plan, closure, input.name.c_str());
    return 0;
}

bool hasFilm(const Plan& plan, const PlanClosure& closure) {
    const GraphNode& node = plan.graph.nodes[size_t(closure.node)];
    if (node.def->findInput("thinfilm_thickness") < 0) return false;
    // A film on a thin wall's transmission is that of the reflection over it.
    if (closure.thin && node.def->findInput("scatter_mode") >= 0 &&
        scatterMode(plan, closure) == sh::SCATTER_T)
        return false;
    return !isConstantValue(closureInput(plan, closure, "thinfilm_thickness"), 0.0f) &&
           !isConstantValue(closureInput(plan, closure, "thinfilm_ior"), 1.0f);
}

bool walksBeneath(const Plan& plan, const PlanClosure& closure) {
    return closure.kind == ClosureKind::Subsurface && !closure.thin &&
           chosenMethod(plan.methods, "subsurface") == "randomWalk";
}

bool refracts(const Plan& plan, const PlanClosure& closure) {
    if (!closure.has(lobe::Interface)) return false;
    if ((scatterMode(plan, closure) & sh::SCATTER_T) == 0) return false;
    return closure.kind == ClosureKind::Schlick ||
           !isConstantValue(closureInput(plan, closure, "ior"), 1.0f);
}

} // namespace patina
