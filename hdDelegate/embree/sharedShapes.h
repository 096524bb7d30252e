// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/compat.h"
#include "hdDelegate/geometry/triangleMesh.h"
#include "base/diagnostics.h"

#include <array>
#include <map>
#include <memory>
#include <optional>

namespace patina {

/// The triangles of many equal implicit prims, and one acceleration structure over them: the prims
/// are instances of it.
struct SharedShape {
    TriangleMesh mesh; ///< in a space of its own, see SharedShapes::placement()
    RTCScene scene = nullptr;

    SharedShape() = default;
    SharedShape(const SharedShape&) = delete;
    SharedShape& operator=(const SharedShape&) = delete;
    ~SharedShape();
};

/// The common part of implicit prims whose triangles are the same.
using ShapeKey = std::array<float, 9>;

/// Shapes that enough prims have in common.
class SharedShapes {
public:
    /// From so many equal prims on, the time that rays take for one more transform is less than
    /// what is saved.
    static constexpr int minInstances = 16;

    /// @param roundEdge as in TessellationOptions
    /// @returns nothing where a prim is not alone in being as it is, or has parts of its own
    static std::optional<ShapeKey> keyOf(const Implicit& prim, float roundEdge);
    /// From the space of a shape to that of a prim: spheres and cubes differ in size only.
    static mat4 placement(const Implicit& prim);

    /// Makes what is missing, and forgets what is no longer asked for.
    /// @param uses prims by key
    void update(RTCDevice device, const std::map<ShapeKey, int>& uses,
                const std::map<ShapeKey, const Implicit*>& examples, Diagnostics& diagnostics);
    /// Null where too few prims are alike.
    std::shared_ptr<const SharedShape> find(const ShapeKey& key) const;
    void clear() { _shapes.clear(); }
    size_t bytes() const; ///< without Embree's structures
    size_t triangles() const;

private:
    std::map<ShapeKey, std::shared_ptr<const SharedShape>> _shapes;
};

} // namespace patina
