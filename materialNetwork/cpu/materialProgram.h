// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/cpu/bsdf.h"
#include "materialNetwork/cpu/medium.h"
#include "materialNetwork/ir/materialIr.h"
#include "materialNetwork/plan/methodPlan.h"
#include "materialNetwork/shadingPoint.h"

#include <memory>
#include <string>
#include <vector>

namespace patina {

struct ProgramCode;

/// A material compiled for the processor: a list of pattern instructions over vec4 registers, and
/// the closures that they feed. Immutable and thread safe; shared by all prims that use the
/// material. Nothing is allocated after make().
class MaterialProgram {
public:
    /// @param ir as compileIr() makes it; its textures must outlive the program
    static std::shared_ptr<const MaterialProgram>
    make(const MaterialIr& ir, const MethodSet& methods, MethodPlan planned = {});
    ~MaterialProgram();

    /// Primvars in the order of their slots (PrimvarReader::read).
    const std::vector<MaterialPrimvar>& primvars() const { return _facts.primvars; }

    bool constant() const { return _facts.constant; } ///< lobes are the same at every point
    bool hasEmission() const { return _facts.hasEmission; }
    bool isOpaque() const { return _facts.isOpaque; } ///< opacity() is 1 everywhere
    bool isThinWalled() const { return _facts.isThinWalled; }
    /// Has a hair lobe, which stands for a whole fibre: what it lets through leaves on the far
    /// side.
    bool isFibre() const { return _facts.isFibre; }
    bool hasTransmission() const {
        return _facts.hasTransmission;
    }                                                       ///< a lobe may send light through
    bool hasInterior() const { return _facts.hasInterior; } ///< a medium fills closed objects
    /// Closed objects are filled with what light goes through, be it clear.
    bool encloses() const {
        return hasInterior() || (hasTransmission() && !isThinWalled() && !isFibre());
    }
    /// There is no surface: rays go on past the boundary, and only the medium is seen.
    bool isVolumeOnly() const { return _facts.isVolumeOnly; }
    /// Rays that presence lets pass are inside the object afterwards: its boundary is there, but
    /// bends nothing.
    bool passThroughEnters() const { return _facts.hasInterior && _facts.passThroughEnters; }
    bool hasSubsurface() const { return _facts.hasSubsurface; }
    bool hasDisplacement() const { return _facts.hasDisplacement; }
    bool usesUv() const { return _facts.usesUv; } ///< reads texture coordinates
    /// The uv set that ShadingPoint::tangent follows, lengthPerUv and uvFootprint with it.
    const std::string& tangentSet() const { return _facts.tangentSet; }
    /// The same for displacement().
    const std::string& displacementSet() const { return _facts.displacementSet; }
    bool jitters() const {
        return _facts.jitters;
    } ///< blurs, with taps that ShadingPoint::seed moves

    /// Its lobes are others for each ShadingPoint::wavelength, and some let light through.
    bool disperses() const { return _facts.disperses; }
    /// Where it disperses, a path takes several wavelengths along.
    bool hasHeroWavelengths() const { return _facts.heroWavelengths; }

    /// @returns isOpaque() for a prim that lacks some primvars
    /// @param attributes per slot of primvars(): negative when the prim has no such primvar
    bool isOpaqueWith(const std::vector<int>& attributes) const;

    /// Presence of the surface, 0..1: the chance that a ray meets it at all, and does not pass
    /// straight through. Light that lobes let pass straight through is part of the presence and not
    /// of the Bsdf, so that shadow rays pass too. The presence then depends on viewDirection.
    /// @param transmittance if given: colour of the light that passes, divided by 1 - opacity
    /// @param presence if given: the part that is not absent; it emits, even where light passes
    float opacity(const ShadingPoint& point, glm::vec3* transmittance = nullptr,
                  float* presence = nullptr) const;

    /// Radiance emitted towards wo (world space, unit), where the surface is present. Both sides
    /// emit.
    glm::vec3 emission(const ShadingPoint& point, const glm::vec3& wo) const;

    /// The medium inside the object, as it is at this point.
    Medium interior(const ShadingPoint& point) const;

    /// Where the surface is moved to: along tangent, bitangent and normal, object units. Zero for
    /// values that are not finite. The mean over seeds where it jitters().
    glm::vec3 displacement(const ShadingPoint& point) const;

    /// So many seeds make a mean that stays the same, for who has no samples.
    static constexpr uint32_t steadySeeds = 16;

    /// Sets up the lobes at a point, seen from point.viewDirection.
    void evaluate(const ShadingPoint& point, Bsdf& out) const;

    /// How its methods were chosen; empty without a tolerance.
    const MethodPlan& planned() const { return _planned; }

    /// The source from which other back ends are generated, with its methods.
    const MaterialIr& ir() const;
    const ProgramCode& code() const { return *_code; }

    MaterialProgram(const MaterialProgram&) = delete;
    MaterialProgram& operator=(const MaterialProgram&) = delete;

private:
    MaterialProgram(MaterialIr ir, MethodPlan planned);
    glm::vec3 displacementAt(const ShadingPoint& point) const;

    MaterialFacts _facts;
    MethodPlan _planned;
    std::unique_ptr<const ProgramCode> _code;
};

} // namespace patina
