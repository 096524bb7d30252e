// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <string>

namespace patina {

/// Reads primvars of the surface at a shading point.
class PrimvarReader {
public:
    virtual ~PrimvarReader() = default;
    /// @param slot index into MaterialProgram::primvars()
    /// @returns false when the geometry has no such primvar; out is untouched then
    virtual bool read(int slot, float out[4]) const = 0;
};

/// The primvar of a uv set: "st", as every exporter to USD writes it, "st1" and so on.
std::string texcoordPrimvar(int index);

/// The primvar that stands for the tangents of a uv set: dP/du in object space, and the side of
/// the bitangent, 1 or -1 where coordinates are mirrored. Geometry makes it from the set. Its name
/// is none that USD has.
std::string tangentPrimvar(const std::string& set);
/// The uv set of a tangentPrimvar(); empty for the names of other primvars.
std::string setOfTangents(const std::string& primvar);

/// The primvars of a coordinate system that is bound to a prim by that name: four rows of the
/// matrix into it, for row vectors. The last one's fourth number says from where: 0 the world, 1
/// the object. Their names are none that USD has.
std::string spacePrimvar(const std::string& space, int row);
/// The coordinate system of such a primvar; empty for the names of other primvars.
std::string spaceOfPrimvar(const std::string& primvar);

/// Where a material is evaluated. World space, unit vectors.
struct ShadingPoint {
    glm::vec3 position{0.0f};
    glm::vec3 worldOrigin{0.0f}; ///< what `position` is relative to
    glm::vec3 objectPosition{0.0f};
    glm::vec3 geometricNormal{0, 0, 1}; ///< points out of the front side
    glm::vec3 normal{0, 0, 1};          ///< interpolated; same hemisphere as geometricNormal
    glm::vec3 tangent{1, 0, 0};         ///< along dP/du, orthogonal to normal
    glm::vec3 bitangent{0, 1,
                        0}; ///< along dP/dv, orthogonal to normal (carries the handedness of uv)
    glm::vec3 viewDirection{0, 0, 1}; ///< towards the viewer
    glm::mat3 objectToWorldNormal{1.0f};
    float lengthPerUv = 1.0f; ///< world length of one unit of the default uv set
    float uvFootprint = 0.0f; ///< width of the ray cone in units of the default uv set
    const PrimvarReader* primvars = nullptr;
    /// One per sample where MaterialProgram::jitters(): patterns whose values are random have
    /// others then, with the same mean. 0: the values that stand for all.
    uint32_t seed = 0;
    /// Of the light that is asked for, nm, where MaterialProgram::disperses(); 0: no one
    /// wavelength.
    float wavelength = 0.0f;
    /// Ior of what the surface borders on: on the side that its own ior is not of.
    float surroundingIor = 1.0f;
    /// GGX alpha that microfacets have at least, but for materials that let light pass straight on:
    /// their opacity() depends on their lobes, and shadow rays ask for it too.
    float leastRoughness = 0.0f;

    glm::vec3 worldPosition() const { return position + worldOrigin; }
};

} // namespace patina
