// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/plan/layering.h"

#include "shaders/shaders.h"

#include <algorithm>

namespace patina {

namespace {

/// Layers inside layers multiply the work; those above that many keep albedo scaling.
constexpr int maxLayerDepth = 4;

bool isInterface(const PlanClosure& c) {
    return c.has(lobe::Interface);
}

/// Why no light can be walked over this closure, apart from its parts.
std::string whyNotOver(const Plan& plan, const PlanClosure& c, method::Subsurface subsurface) {
    if (walksBeneath(c, subsurface)) return "light goes beneath the surface of its base";
    if (c.has(lobe::Fibre)) return "its base is hair";
    if (!isInterface(c)) return "";
    const int mode = scatterMode(plan, c);
    if (mode == sh::SCATTER_T) return "its top and base are halves of one interface";
    if (mode == sh::SCATTER_RT && (c.thin || !refracts(plan, c)))
        return "light passes its base straight";
    return "";
}

} // namespace

bool darkensItself(const Plan& plan, const PlanClosure& closure) {
    const std::string& category = plan.graph.nodes[size_t(closure.node)].def->category;
    return closure.kind == ClosureKind::Layer && category == "patina_coat";
}

std::vector<LayerWalkability> layerWalkability(const Plan& plan, method::Subsurface subsurface) {
    const size_t n = plan.closures.size();
    std::vector<LayerWalkability> found(n);
    std::vector<std::string> blocked(n); // parts come before wholes
    std::vector<int> depth(n, 0);        // of walked layers
    for (size_t i = 0; i < n; ++i) {
        const PlanClosure& c = plan.closures[i];
        blocked[i] = whyNotOver(plan, c, subsurface);
        for (const int part : {c.a, c.b}) {
            if (part < 0) continue;
            depth[i] = std::max(depth[i], depth[size_t(part)]);
            if (blocked[i].empty()) blocked[i] = blocked[size_t(part)];
        }
        if (c.kind != ClosureKind::Layer) continue;
        const PlanClosure& top = plan.closures[size_t(c.a)];
        if (darkensItself(plan, c))
            found[i].reason = "its model says how much it darkens its base";
        else if (!isInterface(top) || scatterMode(plan, top) != sh::SCATTER_R)
            found[i].reason = "its top is no interface that reflects";
        else if (depth[i] >= maxLayerDepth)
            found[i].reason = "too many layers are nested";
        else
            found[i].reason = blocked[size_t(c.b)];
        found[i].walks = found[i].reason.empty();
        depth[i] += found[i].walks;
    }
    return found;
}

} // namespace patina
