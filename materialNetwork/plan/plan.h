// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/graph/graph.h"
#include "materialNetwork/plan/methodPlan.h"
#include "materialNetwork/plan/methods.h"

#include <string>
#include <vector>

namespace patina {

/// A closure of the plan: a lobe, an EDF or VDF leaf, or a combination of two earlier ones.
struct PlanClosure {
    ClosureKind kind = ClosureKind::None;
    int node = -1;                ///< of Plan::graph; its operands are the parameters
    int a = -1, b = -1;           ///< Layer: top, base. Mix: fg, bg. Add: both. Multiply: a
    bool reflects = false;        ///< contains the reflecting half of an interface
    bool sharedInterface = false; ///< a transmission lobe under a reflection lobe, see Plan
    bool thin = false;            ///< of a surface without an inside
    /// Where the network has it, whatever the methods make of that.
    bool inThinSlab = false, underReflection = false;

    bool isLobe() const { return patina::isLobe(kind); }
    /// False of what is no lobe.
    bool has(lobe::Trait trait) const { return lobeHas(kind, trait); }
};

/// A material as back ends render it: closures with their parameters, and the patterns that these
/// need.
///
/// Three meanings that the field leaves open are choice points (methods.h). Their defaults:
/// - A layer lets through 1 - E of its top. E is the top's directional albedo at wo without tint.
///   If the interface itself is coloured, its largest channel counts, so that no channel gains
///   energy. A diffuse or metal top lets through 1 - weight. Mix and add follow from their parts. A
///   product counts by the largest channel of its factor.
/// - A reflection lobe over a transmission lobe is one interface ("sharedInterface"). The layer has
///   already taken the reflected light from the base, so the transmission lobe leaves out its own
///   loss; otherwise it would count twice.
/// - thin_walled surfaces have no inside. Transmission goes straight through, is tinted once, and
///   nothing is absorbed. An interface of mode RT or T under no reflection lobe is a slab with two
///   faces, between which light bounces: it reflects 2 r / (1 + r) and passes (1 - r) / (1 + r).
struct Plan {
    Graph graph;                       ///< simplified
    std::vector<PlanClosure> closures; ///< parts before wholes
    int bsdf = -1, edf = -1;           ///< roots in closures, -1 for none
    int vdf = -1, volumeEdf = -1;      ///< of the medium inside
    Operand opacity;                   ///< presence
    int displacementNode = -1;         ///< in graph.nodes; -1: the surface stays where it is
    bool thinWalled = false;           ///< all of it; see PlanClosure::thin
    bool volumeOnly = false;           ///< a medium without a surface around it
    MethodChoices methods;             ///< at every choice point, as far as they are known yet
    MethodPlan planned;                ///< how they were found; empty: defaults and what was forced
    std::vector<std::string> leftOut;  ///< what is not modelled, one line each
};

/// @param graph simplified
/// @param cuts what simplify() removed; becomes the beginning of Plan::leftOut
Plan makePlan(const Graph& graph, std::vector<std::string> cuts, Diagnostics& diagnostics,
              const MethodChoices& methods = {});

/// Whether the method of a choice point makes a difference to a closure, but not by itself to
/// others.
bool matters(const Plan& plan, const PlanClosure& closure, Choice point);

/// Choice points whose method makes a difference to this plan, in the order of choicePoints().
std::vector<std::string> choicesThatMatter(const Plan& plan);

/// Index of an input of the closure's node by name.
const Operand& closureInput(const Plan& plan, const PlanClosure& closure, const char* name);

/// The scatter_mode of a dielectric or Schlick lobe: sh::SCATTER_*.
int scatterMode(const Plan& plan, const PlanClosure& closure);

/// The distribution of facets of a microfacet lobe: sh::NDF_*.
int microfacetDistribution(const Plan& plan, const PlanClosure& closure);

/// Which of the models of a lobe its string input chooses, the place of the word in its list:
/// sh::SHEEN_*, sh::WARD_*, sh::COOK_TORRANCE_*. 0 for lobes with one model.
int lobeVariant(const Plan& plan, const PlanClosure& closure);

/// Whether a lobe may have a thin film; false when it certainly shows none.
bool hasFilm(const Plan& plan, const PlanClosure& closure);

/// Whether light scatters beneath the surface of a subsurface lobe; else it shows as diffuse.
bool walksBeneath(const PlanClosure& closure, method::Subsurface subsurface);

/// Whether light that is transmitted changes direction, so that the surface has an inside.
bool refracts(const Plan& plan, const PlanClosure& closure);

/// Whether light that it refracts may change direction by its wavelength.
bool disperses(const Plan& plan, const PlanClosure& closure);

} // namespace patina
