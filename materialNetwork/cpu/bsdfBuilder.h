// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/cpu/programCode.h"
#include "materialNetwork/shadingPoint.h"

namespace patina {

/// Fills a Bsdf from the registers of a program: frames, lobes, weights, probabilities.
class BsdfBuilder {
public:
    static void build(const ProgramCode& code, const ShadingPoint& point,
                      const glm::vec4* registers, Bsdf& out);

    /// As build(), but every lobe keeps its place in the program, whatever its weight, and none has
    /// a probability: for looking at.
    static void assemble(const ProgramCode& code, const ShadingPoint& point,
                         const glm::vec4* registers, Bsdf& out);

    /// The same for a part of the material.
    /// @param op  root of the part, in ProgramCode::bsdf
    /// @param view  towards where the light of a walk comes from
    static void buildPart(const LayeredPoint& layered, int op, const glm::vec3& view, Bsdf& out);

    /// @returns the share of light that lobes pass straight on, 0..1. It is no part of what build()
    /// makes, and counts as absence of the surface.
    static glm::vec3 passThrough(const ProgramCode& code, const ShadingPoint& point,
                                 const glm::vec4* registers);

private:
    class LobeNumbers;

    /// @param slabs is set for lobes that pass light straight on
    /// @param root in ProgramCode::bsdf
    static void instantiate(const ProgramCode& code, const ShadingPoint& point,
                            const glm::vec4* registers, int root, sh::Slab* slabs, Bsdf& out);
    static glm::vec3 passThroughWeight(const ProgramCode& code, const sh::Slab* slabs,
                                       const Bsdf& bsdf);
    static void setWeights(const ProgramCode& code, const glm::vec4* registers,
                           const glm::vec3* coverage, int root, Bsdf& out);
    static void setLayer(const ProgramCode& code, const glm::vec3& weight, int op, int index,
                         Bsdf& out);
    static void setSelectionPdfs(const ProgramCode& code, Bsdf& out);
};

/// Value of a tree of EDFs, which are linear: sum of leaf values times factors.
/// @param wo direction of emission; @param normal and tangent of the surface; all 0 inside a
/// medium, which emits the same everywhere
glm::vec3 linearClosure(const std::vector<ClosureOp>& ops, const glm::vec4* registers,
                        const glm::vec3& wo, const glm::vec3& normal, const glm::vec3& tangent);

} // namespace patina
