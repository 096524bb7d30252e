#pragma once

#include "materialNetwork/cpu/bsdf.h"
#include "materialNetwork/cpu/medium.h"
#include "materialNetwork/cpu/shadingPoint.h"
#include "materialNetwork/diagnostics.h"
#include "materialNetwork/plan/methodPlan.h"
#include "materialNetwork/network/network.h"
#include "materialNetwork/textureSource.h"

#include <memory>
#include <string>
#include <vector>

namespace patina {

struct Plan;
struct ProgramCode;

/// A primvar that a material reads.
struct MaterialPrimvar {
    std::string name;
    ValueType type = ValueType::Float; ///< what the material wants; up to four components
};

/// A material compiled for the processor: a list of pattern instructions over vec4 registers, and
/// the closures that they feed. Immutable and thread safe; shared by all prims that use the
/// material. Nothing is allocated after compile().
class MaterialProgram {
public:
    /// Compiles a plan. Never fails: what cannot be compiled is reported and left out.
    /// @param textures must outlive the program
    static std::shared_ptr<const MaterialProgram> compile(const Plan& plan, TextureSource& textures,
                                                          Diagnostics& diagnostics);
    ~MaterialProgram();

    /// Primvars in the order of their slots (PrimvarReader::read).
    const std::vector<MaterialPrimvar>& primvars() const { return _primvars; }

    bool constant() const { return _constant; } ///< lobes are the same at every point
    bool hasEmission() const { return _hasEmission; }
    bool isOpaque() const { return _isOpaque; } ///< opacity() is 1 everywhere
    bool isThinWalled() const { return _isThinWalled; }
    /// Has a hair lobe, which stands for a whole fibre: what it lets through leaves on the far
    /// side.
    bool isFibre() const { return _isFibre; }
    bool hasTransmission() const { return _hasTransmission; } ///< a lobe may send light through
    bool hasInterior() const { return _hasInterior; }         ///< a medium fills closed objects
    /// There is no surface: rays go on past the boundary, and only the medium is seen.
    bool isVolumeOnly() const { return _isVolumeOnly; }
    /// Rays that presence lets pass are inside the object afterwards: its boundary is there, but
    /// bends nothing.
    bool passingEnters() const { return _hasInterior && _passingEnters; }
    bool hasSubsurface() const { return _hasSubsurface; }
    bool hasDisplacement() const { return _hasDisplacement; }
    bool usesUv() const { return _usesUv; }   ///< reads texture coordinates
    bool jitters() const { return _jitters; } ///< blurs, with taps that ShadingPoint::seed moves

    /// @returns isOpaque() for a prim that lacks some primvars
    /// @param attributes per slot of primvars(): negative when the prim has no such primvar
    bool isOpaqueWith(const std::vector<int>& attributes) const;

    /// Presence of the surface, 0..1: the chance that a ray meets it at all, instead of passing
    /// straight on. What lobes would pass straight on is part of this and not of the Bsdf, so that
    /// shadow rays see through them; it then depends on viewDirection.
    /// @param passes if given: colour of the light that passes, divided by 1 - opacity
    /// @param presence if given: the part that is not absent; it emits, even where light passes
    float opacity(const ShadingPoint& point, glm::vec3* passes = nullptr,
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

    /// What other back ends are generated from.
    const ProgramCode& code() const { return *_code; }

    MaterialProgram(const MaterialProgram&) = delete;
    MaterialProgram& operator=(const MaterialProgram&) = delete;

private:
    friend class ProgramBuilder;
    MaterialProgram();
    glm::vec3 displacementAt(const ShadingPoint& point) const;

    std::vector<MaterialPrimvar> _primvars;
    bool _constant = false;
    bool _hasEmission = false;
    bool _isOpaque = true;
    bool _isThinWalled = false;
    bool _hasTransmission = false;
    bool _isFibre = false;
    bool _hasInterior = false;
    bool _isVolumeOnly = false;
    bool _hasSubsurface = false;
    bool _hasDisplacement = false;
    bool _passingEnters = false;
    bool _usesUv = false;
    bool _jitters = false;
    MethodPlan _planned;
    std::unique_ptr<ProgramCode> _code;
};

} // namespace patina
