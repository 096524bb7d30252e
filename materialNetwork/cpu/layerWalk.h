// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/cpu/bsdf.h"
#include "base/hashedNumbers.h"
#include "materialNetwork/cpu/programCode.h"
#include "materialNetwork/shadingPoint.h"

#include <memory>
#include <vector>

namespace patina {

/// A shading point whose layers are walked: what their parts are built from, seen from any side.
struct LayeredPoint : std::enable_shared_from_this<LayeredPoint> {
    LayeredPoint(const ProgramCode* c, const ShadingPoint& p) : code(c), point(p) {}

    const ProgramCode* code; ///< outlives the point
    ShadingPoint point;
    std::vector<glm::vec4> registers;
};

/// The choice point layering, method positionFree: light bounces between the interface on top of a
/// layer and its base until it leaves (Guo, Hasan and Zhao 2018, "Position-Free Monte Carlo
/// Simulation for Arbitrary Layered BSDFs"). The layer is infinitely thin, so only directions
/// matter. The top reflects and refracts; its tint colours only the light that it reflects
/// outwards. The base is any BSDF, with layers of its own.
///
/// Values are random: a walk from wo that is connected to wi through the top at every visit of the
/// base, from both ends of the connection (balance heuristic). Densities are estimates, see
/// Bsdf::stochastic(). All directions are in world space.
class LayerWalk {
public:
    /// @param op a walked layer of the program's BSDF; @param wo towards the viewer
    LayerWalk(const LayeredPoint& point, int op, const glm::vec3& wo);

    BsdfEval eval(const glm::vec3& wi, HashedNumbers& random) const;
    BsdfSample sample(const glm::vec3& u, HashedNumbers& random) const;
    /// Of the top's reflection, the base as seen through a smooth top, and diffuse light.
    float density(const glm::vec3& wi) const;

private:
    struct TopSample {
        glm::vec3 wi{0.0f};
        glm::vec3 weight{0.0f};
        float pdf = 0.0f;
        int event = 0; ///< as LobeSample
        float eta = 1.0f;
    };

    bool above(const glm::vec3& d) const {
        return (glm::dot(d, _point.point.geometricNormal) > 0.0f) == _aboveIsOutside;
    }
    /// False where the shading normal and the surface disagree about the side of d.
    bool agrees(const glm::vec3& d, const glm::vec3& local) const {
        return (local.z > 0.0f) == above(d);
    }
    BsdfLobe topAt(const glm::vec3& v) const;
    sh::LobeEval topEval(const glm::vec3& v, const glm::vec3& wi, HashedNumbers& random) const;
    float topDensity(const glm::vec3& v, const glm::vec3& wi) const;
    TopSample topSample(const glm::vec3& v, const glm::vec3& u, HashedNumbers& random) const;
    void baseAt(const glm::vec3& v, uint32_t seed, Bsdf& out) const;

    /// How light that leaves the base along -d gets out along wi, where d was found from wi.
    glm::vec3 outwards(const TopSample& entry, const glm::vec3& wi, HashedNumbers& random) const;
    /// The direction within the layer of light along d from above, if the top is smooth; points up.
    /// @returns the change of solid angle; 0 for total reflection
    float refracted(glm::vec3& d) const;

    const LayeredPoint& _point;
    const ClosureOp& _op;
    glm::vec3 _wo;
    BsdfFrame _frame; ///< of the top
    bool _aboveIsOutside;
    BsdfLobe _top;   ///< reflects and refracts, untinted
    glm::vec3 _tint; ///< of what is reflected outwards
};

} // namespace patina
