// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/color/renderingSpace.h"

#include "materialNetwork/color/colorSpaces.h"
#include "materialNetwork/color/colorSpacesBuiltin.h"

#include <cmath>
#include <map>
#include <memory>
#include <mutex>

namespace patina {

namespace {

bool isGrey(const glm::vec3& c) {
    return c.x == c.y && c.y == c.z;
}

bool close(const glm::vec3& a, const glm::vec3& b) {
    // Of matrices in 32 bits.
    return glm::length(a - b) <= 1e-5f * std::max(1.0f, glm::length(b));
}

/// The matrix of a transform. @returns false where it is none
bool matrixOf(const ColorTransform& transform, glm::mat3& matrix) {
    const auto apply = [&](glm::vec3 c) {
        transform.apply(&c.x, 1, 3);
        return c;
    };
    for (int i = 0; i < 3; ++i) {
        glm::vec3 axis(0.0f);
        axis[i] = 1.0f;
        matrix[i] = apply(axis);
    }
    for (const glm::vec3 probe :
         {glm::vec3(0.0f), glm::vec3(0.18f, 0.4f, 0.05f), glm::vec3(16.0f, 2.0f, 0.5f)})
        if (!close(apply(probe), matrix * probe)) return false;
    return std::abs(glm::determinant(matrix)) > 1e-4f; // that of the widest is 0.2
}

std::array<float, 8> chromaticitiesOf(const RenderingSpace& space) {
    if (const auto known = builtinChromaticities(space.name)) return *known;
    // Seen under D65, to which the configuration adapts it.
    const glm::mat3 xyz = glm::mat3(rec709ToXyz()) * space.toRec709;
    std::array<float, 8> xy;
    for (int i = 0; i < 4; ++i) {
        const glm::vec3 c = i < 3 ? xyz[i] : xyz * glm::vec3(1.0f);
        xy[size_t(2 * i)] = c.x / (c.x + c.y + c.z);
        xy[size_t(2 * i + 1)] = c.y / (c.x + c.y + c.z);
    }
    return xy;
}

} // namespace

glm::vec3 RenderingSpace::from709(const glm::vec3& color) const {
    return isRec709() || isGrey(color) ? color : fromRec709 * color;
}

glm::vec3 RenderingSpace::to709(const glm::vec3& color) const {
    return isRec709() || isGrey(color) ? color : toRec709 * color;
}

const RenderingSpace& RenderingSpace::rec709() {
    static const RenderingSpace space;
    return space;
}

const RenderingSpace* RenderingSpace::find(const std::string& name) {
    if (name.empty()) return &rec709();
    static std::mutex mutex;
    static std::map<std::string, std::unique_ptr<const RenderingSpace>> known;
    const std::lock_guard<std::mutex> lock(mutex);
    const ColorSpaces& spaces = ColorSpaces::shared();
    const std::string spelled = spaces.nameOf(name);
    if (spelled.empty() || ColorSpaces::isData(name)) return nullptr;
    const auto found = known.find(spelled);
    if (found != known.end()) return found->second.get();
    const ColorTransformPtr transform = spaces.toRec709(name);
    if (!transform) return nullptr;
    if (transform->isIdentity()) return &rec709();
    RenderingSpace space;
    if (!matrixOf(*transform, space.toRec709)) return nullptr;
    if (close(space.toRec709[0], {1, 0, 0}) && close(space.toRec709[1], {0, 1, 0}) &&
        close(space.toRec709[2], {0, 0, 1}))
        return &rec709();
    space.name = spelled;
    space.fromRec709 = glm::inverse(space.toRec709);
    space.chromaticities = chromaticitiesOf(space);
    return (known[spelled] = std::make_unique<const RenderingSpace>(space)).get();
}

} // namespace patina
